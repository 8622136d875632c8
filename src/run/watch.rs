//! Keeps an eye on the energy of a run.
//!
//! Where a scene keeps its energy, or adds up all that it loses, the sum of [`Energies`] is a constant. Where something is lost
//! and not added up, the sum can only fall. Where an end or an obstacle is driven, its work is not known and nothing can be said.
//! Drift is what the sum is off by, over the scale: the largest of kinetic energy, stored energy and work of steady forces that
//! the run has seen. At 1 % of drift the run says so once, at 10 % it stops, unless `[watch]` says otherwise.

mod judge;

pub use judge::Judged;

use crate::fields::Field;
use crate::observable::{Energies, Moment};
use crate::scene::Scene;
use crate::scene::file::EnergyWatch;
use serde_json::{Value, json};

/// Drift at which a run says so.
const NOTED: f64 = 0.01;
/// Drift at which a run stops unless the scene says otherwise.
const USUAL_LIMIT: f64 = 0.1;
/// Steps between two looks, so that these cost little beside the steps: a look takes as long as half a step of the CPU path, and
/// as a thousand of a fast GPU's, which only large scenes keep busy.
const APART: u32 = 20;
const PARTICLES_A_STEP: usize = 1000;
/// Energy over M c^2 below which nothing is judged: that of a strain of 1e-6, which f32 makes of nothing.
const FLOOR: f64 = 1e-12;

/// What a run keeps of its energy. All but the judgement goes into a checkpoint.
#[derive(Debug, Clone)]
pub struct Watch {
    judged: Judged,
    /// Drift at which the run stops; none where it goes on.
    limit: Option<f64>,
    floor: f64,
    /// Steps between two looks.
    apart: u32,
    kept: Option<Kept>,
}

/// What must be known of the rows before.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Kept {
    first: f64,
    lowest: f64,
    last: f64,
    scale: f64,
    /// Largest drift, with its sign, and when it was seen.
    worst: f64,
    time: f64,
    noted: bool,
    step: u32,
}

/// What a look at the energy asks the run to do.
#[derive(Debug, Clone, PartialEq)]
pub enum Verdict {
    Well,
    Warn(String),
    Stop(String),
}

impl Watch {
    pub fn new(scene: &Scene, told: Option<EnergyWatch>) -> Self {
        let typed = &scene.file.watch;
        let watch = told.unwrap_or(typed.energy);
        let limit = (watch == EnergyWatch::Stop).then_some(typed.energy_drift.unwrap_or(USUAL_LIMIT));
        let judged = match watch {
            EnergyWatch::Off => Judged::Not("watch.energy, or --energy, is `off`".into()),
            EnergyWatch::Stop | EnergyWatch::Warn => judge::judged(scene),
        };
        let wave = |i: usize| {
            let speed = scene.bodies[scene.particles[i].body as usize].material.sound_speed();
            scene.mass(i) * speed * speed
        };
        let floor = FLOOR * (0..scene.particles.len()).map(wave).sum::<f64>();
        let apart = APART.max((scene.particles.len() / PARTICLES_A_STEP) as u32);
        Self { judged, limit, floor, apart, kept: None }
    }

    /// Whether the energy must be looked at after so many steps.
    pub fn due(&self, step: u32, last: bool) -> bool {
        let watched = !matches!(self.judged, Judged::Not(_));
        watched && self.kept.is_none_or(|kept| last || step >= kept.step + self.apart)
    }

    pub fn fields(scene: &Scene) -> Vec<Field> {
        Energies::fields(scene)
    }

    /// Looks at the energies of a moment.
    pub fn look(&mut self, moment: &Moment) -> Verdict {
        let energies = Energies::of(moment);
        let (total, step) = (energies.total(), moment.step as u32);
        let start = Kept { first: total, lowest: total, last: total, scale: 0.0, worst: 0.0, time: 0.0, noted: false, step };
        let kept = self.kept.get_or_insert(start);
        let stored = energies.elastic.abs().max(energies.stray.abs());
        kept.scale = kept.scale.max(energies.kinetic).max(stored).max(energies.potential.abs());
        let off = match self.judged {
            Judged::Kept => total - kept.first,
            Judged::Falling { .. } => (total - kept.lowest).max(0.0),
            Judged::Bounded { .. } => (total - kept.first).max(0.0),
            Judged::Not(_) => 0.0,
        };
        (kept.last, kept.step, kept.lowest) = (total, step, kept.lowest.min(total));
        let drift = if kept.scale > self.floor { off / kept.scale } else { 0.0 };
        // Energies that are no numbers are the business of the run's faults.
        if drift.abs() > kept.worst.abs() {
            (kept.worst, kept.time) = (drift, moment.time);
        }
        if self.limit.is_some_and(|limit| drift.abs() >= limit) {
            return Verdict::Stop(self.sentence(moment.scene, drift, moment));
        }
        if drift.abs() >= NOTED && !kept.noted {
            kept.noted = true;
            return Verdict::Warn(self.sentence(moment.scene, drift, moment));
        }
        Verdict::Well
    }

    fn sentence(&self, scene: &Scene, drift: f64, moment: &Moment) -> String {
        let scale = self.kept.map_or(0.0, |kept| kept.scale);
        let unit = unit(scene);
        let way = if drift > 0.0 { "grown" } else { "shrunk" };
        let number = |value: f64| format!("{}{unit}", short(value));
        format!(
            "the energy has {way} by {} at t = {}, step {}, {} % of the largest that the run has seen of kinetic energy, stored energy \
             and work ({}): {}",
            number((drift * scale).abs()),
            short(moment.time),
            moment.step,
            short(100.0 * drift.abs()),
            number(scale),
            judge::remedy(scene)
        )
    }

    /// Numbers for a checkpoint; none before the first look.
    pub fn save(&self) -> Vec<f64> {
        let numbers =
            |k: Kept| vec![k.first, k.lowest, k.last, k.scale, k.worst, k.time, f64::from(u8::from(k.noted)), f64::from(k.step)];
        self.kept.map_or_else(Vec::new, numbers)
    }

    /// Goes on from the numbers of a checkpoint.
    pub fn load(&mut self, numbers: &[f64]) {
        if let &[first, lowest, last, scale, worst, time, noted, step] = numbers {
            self.kept = Some(Kept { first, lowest, last, scale, worst, time, noted: noted > 0.0, step: step as u32 });
        }
    }

    pub fn report(&self, scene: &Scene) -> Report {
        Report { judged: self.judged.clone(), kept: self.kept, unit: unit(scene), time: scene.unit_names()[2] }
    }
}

/// What is told of the energy at the end of a run.
#[derive(Debug, Clone)]
pub struct Report {
    judged: Judged,
    kept: Option<Kept>,
    unit: &'static str,
    time: &'static str,
}

impl Report {
    /// Largest drift, with its sign; none where the energy was not watched.
    pub fn drift(&self) -> Option<f64> {
        self.kept.filter(|_| !matches!(self.judged, Judged::Not(_))).map(|kept| kept.worst)
    }

    pub fn text(&self) -> String {
        let (Some(kept), None) = (self.kept, self.judged.reason_against()) else {
            return format!("energy not watched: {}", self.judged.reason_against().unwrap_or("no row was written"));
        };
        let (scale, unit) = (short(kept.scale), self.unit);
        let share = |part: f64| format!("{:.1e} of {scale}{unit}", part.abs());
        match &self.judged {
            Judged::Kept if kept.worst == 0.0 => format!("energy: no drift, to rounding, of {scale}{unit}"),
            Judged::Kept => format!("energy: drift of {}, largest at t = {} {}", share(kept.worst), short(kept.time), self.time),
            judged => {
                let lost = if kept.scale > 0.0 { (kept.first - kept.last) / kept.scale } else { 0.0 };
                let grown = if kept.worst > 0.0 { format!("growth of {}", share(kept.worst)) } else { "no growth".into() };
                let change = if lost >= 0.0 { "less" } else { "more" };
                format!(
                    "energy: {grown}; {} {change} at the end than at the start, with losses that are not added up ({})",
                    share(lost),
                    judged.losses().unwrap_or_default()
                )
            }
        }
    }

    pub fn json(&self) -> Value {
        match (self.kept, self.judged.reason_against()) {
            (_, Some(because)) => json!({ "watched": false, "because": because }),
            (None, None) => json!({ "watched": false, "because": "no row was written" }),
            (Some(kept), None) => json!({
                "watched": true, "counted_losses": matches!(self.judged, Judged::Kept), "uncounted": self.judged.losses(),
                "first": kept.first, "last": kept.last, "scale": kept.scale, "drift": kept.worst, "at": kept.time,
            }),
        }
    }
}

/// Unit of an energy after a blank; nothing where the scene has no dimensions.
fn unit(scene: &Scene) -> &'static str {
    use crate::scene::file::Units;
    match (scene.file.units, scene.dimension()) {
        (Units::Dimensionless, _) => "",
        // Bodies in the plane are a unit thick, and so are bars on a line in both other directions.
        (Units::Si, 3) => " J",
        (Units::MillimetreTonneSecond, 3) => " mJ",
        (Units::Si, 2) => " J/m",
        (Units::MillimetreTonneSecond, 2) => " mJ/mm",
        (Units::Si, _) => " J/m^2",
        (Units::MillimetreTonneSecond, _) => " mJ/mm^2",
    }
}

/// A number to three digits.
fn short(value: f64) -> String {
    match value.abs() {
        0.0 => "0".into(),
        size if (1e-2..1e4).contains(&size) => {
            let digits = (2 - size.log10().floor() as i32).max(0) as usize;
            format!("{value:.digits$}")
        }
        _ => format!("{value:.2e}"),
    }
}

#[cfg(test)]
mod tests;
