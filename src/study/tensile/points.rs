//! The runs of Swegle's test: their cases, their scene, and the files that keep them.

use super::case::{Case, STABLE, Spacing, zone};
use super::particles::{Rule, border};
use super::published as strand;
use crate::backend::Choice;
use crate::output::csv;
use crate::run::{Options, Stop, run};
use crate::scene::Scene;
use crate::study::accuracy::source::hash;
use crate::study::von_neumann::{Waves as _, fixed_wave_vectors};
use std::path::Path;

const SCENE: &str = include_str!("../../../scenes/tension_square.toml");
/// Spacing, m, and c/dx, 1/s, of the scene.
const DX: f64 = 1e-3;
const UNIT_RATE: f64 = super::compression::UNIT_RATE;

/// A curve of the thesis, and whether it calls it stable; or one of none, where there is no word of it.
#[derive(Debug, Clone, Copy)]
pub struct Point {
    pub figure: &'static str,
    pub case: Case,
    pub published: Option<bool>,
}

impl Point {
    const fn new(figure: &'static str, case: Case, published: Option<bool>) -> Self {
        Self { figure, case, published }
    }

    /// Name of its file and curve.
    pub fn name(&self) -> String {
        let Case { dimension, ratio, volume, epsilon, spacing, .. } = self.case;
        let force = if epsilon == 0.0 { String::new() } else { format!("-eps{epsilon}-{}", spacing.word()) };
        format!("{dimension}d-h{ratio}-v{volume}{force}")
    }

    /// Particles along an axis, and layers that are held on each side.
    pub fn size(&self) -> [usize; 2] {
        [if self.case.dimension == 3 { 25 } else { 51 }, border(self.case, Rule::default())]
    }

    /// Largest growth rate of the standing waves of a block with that many particles along an axis, in c/dx.
    pub fn theory(&self, side: usize) -> f64 {
        let free = side - 2 * self.size()[1];
        let free = std::array::from_fn(|axis| if axis < self.case.dimension { free } else { 0 });
        self.case.equations().map_or(f64::INFINITY, |equations| equations.fastest(&fixed_wave_vectors(free, 1.0)).1)
    }

    /// Duration and time step, in dx/c. A growing run is 16 e-foldings long, but no longer than 800 dx/c, or than 300 (five times
    /// the 12 us in which the thesis sees the plain method clump) where the thesis calls it stable.
    fn times(&self) -> [f64; 2] {
        let rate = self.theory(self.size()[0]);
        let equations = self.case.equations();
        let fastest = equations.map_or(1.0, |equations| equations.largest_frequency(&zone(self.case.dimension)));
        let longest = if self.published == Some(true) { 300.0 } else { 800.0 };
        let duration = if rate < STABLE { 300.0 } else { (16.0 / rate).min(longest) };
        [duration, (0.25_f64).min(0.4 / fastest).min(0.08 / rate.max(1e-3))]
    }

    /// The variant of the scene.
    pub fn text(&self) -> String {
        let Case { dimension, ratio, volume, epsilon, .. } = self.case;
        let [side, border] = self.size();
        let [duration, step] = self.times().map(|time| time / UNIT_RATE);
        let spacing = if self.case.spacing == Spacing::Mean { "mean" } else { "initial" };
        let force = if epsilon == 0.0 {
            String::new()
        } else {
            format!("formulation.artificial_stress = {{ form = \"scalar\", epsilon = {epsilon:?}, spacing = \"{spacing}\" }}\n")
        };
        let [low, high, end, middle] = [border as f64, (side - border) as f64, side as f64, 0.5 * side as f64].map(|n| n * DX);
        format!(
            "{SCENE}\n[variant.study]\ndimension = {dimension}\nduration = {duration:e}\n\
             body = [{{ name = \"block\", relative_volume = {volume:?}, shape = {{ block = {{ min = [0, 0, 0], max = [{end}, {end}, {end}] }} }} }}]\n\
             boundary = [{{ name = \"border\", select.inside.cut.remove = [{{ block = {{ min = [{low}, {low}, {low}], max = [{high}, {high}, {high}] }} }}] }}]\n\
             kick = [{{ at = [{middle}, {middle}, {middle}], velocity = [1e-6] }}]\n\
             formulation.smoothing_length = {ratio:?}\n{force}time.step = {step:e}\noutput.series = {:e}\noutput.frames = 0\n\
             observe.growth = \"none\"\nexpect.growth = \"none\"\nexpect.nearest = \"none\"\n",
            duration / 80.0
        )
    }

    /// Time in dx/c and total velocity in m/s, from the file of an earlier run or from a new one.
    pub fn curve(&self, folder: &Path, tell: &dyn Fn(&str)) -> Result<Vec<(f64, f64)>, Stop> {
        let text = self.text();
        let key = format!("# {} {:016x}", env!("CARGO_PKG_VERSION"), hash(text.as_bytes()));
        let path = folder.join(format!("{}.csv", self.name()));
        if std::fs::read_to_string(&path).is_ok_and(|kept| kept.starts_with(&key)) {
            let (_, rows) = csv::read(&path).map_err(Stop::Failed)?;
            return Ok(rows.iter().map(|row| (row[0], row[1])).collect());
        }
        tell(&self.name());
        let scene = Scene::parse(&text, "tension_square", Some("study"), &[]).map_err(Stop::Failed)?;
        let options = Options { choice: Choice::Cpu, dry: true, quiet: true, energy: Options::UNWATCHED, ..Options::default() };
        let finished = run(&scene, &options)?;
        let speeds = &finished.table.columns["speed"];
        let rows: Vec<(f64, f64)> = finished.table.times.iter().map(|t| t * UNIT_RATE).zip(speeds.iter().copied()).collect();
        let lines: String = rows.iter().map(|(t, v)| format!("{},{}\n", csv::shortest(*t), csv::shortest(*v))).collect();
        // Aside and renamed, so that a kill leaves no half of it.
        let part = path.with_extension("part");
        let written = std::fs::write(&part, format!("{key}\ntime,speed\n{lines}")).and_then(|()| std::fs::rename(&part, &path));
        written.map_err(|error| Stop::Failed(format!("{}: {error}", path.display())))?;
        Ok(rows)
    }
}

/// The runs by figure.
pub fn points() -> Vec<Point> {
    let (stable, unstable) = (Some(true), Some(false));
    let plane = Case::new(2, 1.3);
    let line = Case::new(1, 1.3);
    let wide = Case::new(2, 1.8);
    let mut list = Vec::new();
    let mut add = |figure, case, published| list.push(Point::new(figure, case, published));
    add("5.1-3", plane.volume(0.999), stable);
    for volume in [1.001, 1.01, 1.03, 1.05] {
        add("5.1-3", plane.volume(volume), unstable);
    }
    for epsilon in [1.0, 1.3, 10.0] {
        add("5.1-6", plane.epsilon(epsilon).spacing(Spacing::Mean), unstable);
    }
    for epsilon in [0.1, 0.3, 1.3] {
        add("5.1-6", plane.epsilon(epsilon), unstable);
    }
    add("5.1-7", line, unstable);
    add("5.1-7", line.epsilon(0.3), unstable);
    add("5.1-7", line.epsilon(1.119), stable);
    add("5.1-7", line.epsilon(1.3), stable);
    add("5.1-7", line.epsilon(90.0), unstable);
    add("5.1-7", line.epsilon(1.045).spacing(Spacing::Mean), stable);
    add("5.1-10", Case::new(1, 0.7), unstable);
    add("5.1-10", Case::new(1, 0.7).epsilon(0.3), unstable);
    add("5.1-10", Case::new(1, 1.8), unstable);
    add("5.1-10", Case::new(1, 1.8).epsilon(0.6), stable);
    add("5.1-11", Case::new(2, 1.52), unstable);
    add("5.1-11", Case::new(2, 1.52).epsilon(0.95), unstable);
    add("5.1-11", wide, unstable);
    add("5.1-11", wide.epsilon(0.5), None);
    add("5.1-11", wide.epsilon(0.95), stable);
    add("5.1-11", wide.epsilon(10.0), unstable);
    add("5.1-11", wide.volume(0.95), unstable);
    add("5.1-12", wide.volume(1.001).epsilon(0.9), unstable);
    add("5.1-12", wide.volume(1.03).epsilon(1.3), stable);
    add("5.1-12", wide.volume(1.05).epsilon(1.3), stable);
    add("3D", Case::new(3, 1.3), None);
    add("3D", Case::new(3, 1.3).epsilon(strand::LIBERSKY[2]), None);
    list
}
