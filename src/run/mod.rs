//! A run from start to end: segments between outputs, what is written, and what stops it.

mod balance;
mod checkpoint;
mod fault;
mod files;
mod meetings;
mod stop;
mod summary;
mod warn;
mod watch;

pub use files::{Files, folder};
pub use stop::Stop;
pub use summary::{Counted, Said, StepLengths, Stopwatch, Summary};

use balance::Balance;
use checkpoint::{Checkpoint, Story};
use meetings::Meetings;
use watch::{Verdict, Watch};

use crate::backend::{Backend, Choice, open};
use crate::fields::Field;
use crate::observable::{Moment, Observer, Table, Value, fields_read, observers, profile};
use crate::rows::{Clock, Fault};
use crate::scene::Scene;
use crate::scene::file::EnergyWatch;
use crate::scene::interval::ROUNDING;
use indicatif::{ProgressBar, ProgressStyle};
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

/// What the command line asks of a run.
#[derive(Debug, Clone, Default)]
pub struct Options {
    pub choice: Choice,
    /// Folder for the output; `out/SCENE[-VARIANT]` unless given. None of it is written if `dry`.
    pub out: Option<PathBuf>,
    pub dry: bool,
    pub force: bool,
    pub quiet: bool,
    /// What happens when the energy drifts, in place of the scene's `watch.energy`.
    pub energy: Option<EnergyWatch>,
    /// Wall time after which the run is given up as if interrupted.
    pub within: Option<Duration>,
}

impl Options {
    /// For studies that run what fails, and measure the failure themselves.
    pub const UNWATCHED: Option<EnergyWatch> = Some(EnergyWatch::Off);
}

/// A finished run.
pub struct Finished {
    pub table: Table,
    /// Profiles by name: position and value.
    pub profiles: BTreeMap<String, Vec<(f64, f64)>>,
    pub summary: Summary,
    pub folder: Option<PathBuf>,
}

/// Steps after which a segment ends even if no output is due, so that particles that move far are sorted again.
const SEGMENT_STEPS: u32 = 1000;

/// Set by the signal handler.
pub static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// Runs a scene from its start.
pub fn run(scene: &Scene, options: &Options) -> Result<Finished, Stop> {
    if !options.dry {
        files::refuse_existing(scene, options).map_err(Stop::Refused)?;
    }
    // A study whose runs keep nothing and may gain energy looks for such limits itself.
    let sought = options.dry && options.energy == Options::UNWATCHED;
    let warnings = if sought { scene.warnings.clone() } else { warn::of(scene) };
    // The backend is opened before the folder is made, so that a run without a backend leaves no folder behind.
    let backend = open(scene, &options.choice).map_err(Stop::Refused)?;
    begin(scene, options, backend, warnings)
}

/// The same on a backend that is open and at the scene's start.
pub fn run_on(scene: &Scene, options: &Options, backend: Box<dyn Backend>) -> Result<Finished, Stop> {
    begin(scene, options, backend, scene.warnings.clone())
}

fn begin(scene: &Scene, options: &Options, backend: Box<dyn Backend>, warnings: Vec<String>) -> Result<Finished, Stop> {
    warn::say(&warnings);
    let files = if options.dry { None } else { Some(Files::create(scene, options)?) };
    Run::new(scene, options, backend, files, warnings).go()
}

/// Goes on from the last good state in a run's folder, or from the start where the run had not come to its first, to the same
/// bits as a run that was never broken off; `None` where the run had come to its end.
pub fn resume(scene: &Scene, options: &Options, folder: PathBuf) -> Result<Option<Finished>, Stop> {
    let mut known = files::find(&folder)?;
    let mut scene = scene.clone();
    // The folder's `run.toml` has lost them.
    match &known.saved {
        Some(saved) => (scene.name, scene.variant) = (saved.name.clone(), saved.variant.clone()),
        None => files::begun_as(&mut scene, known.manifest.about()),
    }
    let (scene, label) = (&scene, scene.label());
    let damage: Vec<String> = std::mem::take(&mut known.damage).into_iter().map(|what| format!("{label}: {what}")).collect();
    let Some(saved) = &mut known.saved else {
        let warnings = warn::of(scene);
        let backend = open(scene, &options.choice).map_err(Stop::Refused)?;
        warn::say(&warnings);
        let (files, _) = Files::reopen(options, folder, known)?;
        return Run::new(scene, options, backend, Some(files), warnings).go().map(Some);
    };
    saved.check_scene(scene).map_err(Stop::Refused)?;
    damage.iter().for_each(|sentence| warn::say_one(sentence));
    if saved.event >= Schedule::new(scene).events().len() && known.finished {
        return Ok(None);
    }
    let warnings = warn::of(scene);
    let mut backend = open(scene, &options.choice).map_err(Stop::Refused)?;
    saved.check_device(&*backend).map_err(Stop::Refused)?;
    backend.load(&std::mem::take(&mut saved.groups)).map_err(Stop::Refused)?;
    backend.set_clocks(&saved.story.clocks).map_err(Stop::Failed)?;
    warn::say(&warnings);
    let (event, time, steps) = (saved.event, saved.time, saved.steps);
    let (watch, story) = (std::mem::take(&mut saved.watch), saved.story.clone());
    let (files, table) = Files::reopen(options, folder, known)?;
    let mut run = Run::new(scene, options, backend, Some(files), warnings);
    (run.event, run.time, run.steps, run.table) = (event, time, steps, table);
    (run.lists, run.lengths) = (story.lists, story.lengths);
    run.energy.load(&watch);
    run.meetings = Meetings::load(&story.told);
    run.balance = Balance::load(&story.balance);
    run.stopwatch.go_on(story.spent);
    run.neighbors = story.neighbors;
    run.warnings = story.warnings;
    run.warnings.extend(damage);
    run.go().map(Some)
}

/// Times at which something is written.
struct Schedule {
    series: f64,
    /// 0 for none.
    frames: f64,
    duration: f64,
    /// Load steps, each of which is a row; 0 where time goes on.
    load_steps: u32,
}

impl Schedule {
    fn new(scene: &Scene) -> Self {
        let file = &scene.file;
        Self {
            series: file.rows(),
            frames: file.frames(),
            duration: file.duration,
            load_steps: file.quasi_static.as_ref().map_or(0, |q| q.load_steps),
        }
    }

    /// Each load step is a row, and a frame where an interval between frames has passed.
    fn load_events(&self) -> Vec<(f64, bool, bool)> {
        let time = |k: u32| self.duration * f64::from(k) / f64::from(self.load_steps);
        let interval = |k: u32| (time(k) / self.frames + 1e-9).floor();
        let passed = |k: u32| k == 0 || k == self.load_steps || interval(k) > interval(k - 1);
        (0..=self.load_steps).map(|k| (time(k), true, self.frames > 0.0 && passed(k))).collect()
    }

    /// All times in order, each with whether a row and whether a frame is due.
    fn events(&self) -> Vec<(f64, bool, bool)> {
        if self.load_steps > 0 {
            return self.load_events();
        }
        // Two times that differ by rounding are one: the last row at the end may be a typed decimal of a third.
        let shortest = [self.series, self.frames].into_iter().filter(|&t| t > 0.0).fold(self.duration, f64::min);
        let rounding = ROUNDING * shortest;
        let count = |interval: f64| (self.duration / interval + ROUNDING) as u64;
        let every = |interval: f64| -> Vec<f64> {
            if interval == 0.0 {
                return Vec::new();
            }
            (0..=count(interval)).map(|k| k as f64 * interval).collect()
        };
        let (rows, frames) = (every(self.series), every(self.frames));
        let mut times: Vec<f64> = rows.iter().chain(&frames).copied().chain([self.duration]).collect();
        times.sort_by(f64::total_cmp);
        times.dedup_by(|a, b| (*a - *b).abs() < rounding);
        // Of two times that are one the earlier is left.
        if let Some(end) = times.last_mut() {
            *end = self.duration;
        }
        let due = |interval: f64, t: f64| {
            let nearest = (t / interval).round().min(count(interval) as f64) * interval;
            (nearest - t).abs() < rounding
        };
        let last = times.len() - 1;
        let event = |(k, &t): (usize, &f64)| {
            (t, k == last || due(self.series, t), self.frames > 0.0 && (k == last || due(self.frames, t)))
        };
        times.iter().enumerate().map(event).collect()
    }
}

struct Run<'a> {
    scene: &'a Scene,
    backend: Box<dyn Backend>,
    files: Option<Files>,
    observers: Vec<Observer>,
    fields: Vec<Field>,
    frame_fields: Vec<Field>,
    table: Table,
    events: Vec<(f64, bool, bool)>,
    /// Next event.
    event: usize,
    time: f64,
    steps: u32,
    lists: u32,
    lengths: StepLengths,
    meetings: Meetings,
    bar: ProgressBar,
    stopwatch: Stopwatch,
    /// As a checkpoint at the end tells it.
    neighbors: Option<f64>,
    energy: Watch,
    within: Option<Duration>,
    balance: Balance,
    /// What the run has said beside the results: first what the scene gave reason for.
    warnings: Vec<String>,
}

impl<'a> Run<'a> {
    fn new(scene: &'a Scene, options: &Options, backend: Box<dyn Backend>, files: Option<Files>, warnings: Vec<String>) -> Self {
        let observers = observers(scene);
        let mut fields = fields_read(&observers, scene);
        if (Meetings::possible(scene) || meetings::may_cross(scene)) && !fields.contains(&Field::Displacement) {
            fields.push(Field::Displacement);
        }
        let mut frame_fields = fields.clone();
        frame_fields.extend(files::fields_stored(scene));
        frame_fields.sort_unstable();
        frame_fields.dedup();
        // The bar hides itself where stderr is no terminal.
        let bar = if options.quiet { ProgressBar::hidden() } else { ProgressBar::new(1000) };
        if let Ok(style) = ProgressStyle::with_template("{bar:40} {percent:>3} %  {msg}  {eta_precise} left") {
            bar.set_style(style);
        }
        Self {
            scene,
            backend,
            files,
            observers,
            fields,
            frame_fields,
            table: Table::default(),
            events: Schedule::new(scene).events(),
            event: 0,
            time: 0.0,
            steps: 0,
            lists: 0,
            lengths: StepLengths::default(),
            meetings: Meetings::default(),
            bar,
            stopwatch: Stopwatch::start(),
            neighbors: None,
            energy: Watch::new(scene, options.energy),
            within: options.within,
            balance: Balance::default(),
            warnings,
        }
    }

    fn go(mut self) -> Result<Finished, Stop> {
        // A run that begins also makes its first acceleration; one that resumes has loaded it.
        if self.event == 0 {
            self.segment(0.0, true)?;
            self.output()?;
        }
        while self.event < self.events.len() {
            self.reach(self.events[self.event].0)?;
            self.output()?;
        }
        self.bar.finish_and_clear();
        self.finish()
    }

    /// Steps until an absolute time.
    fn reach(&mut self, target: f64) -> Result<(), Stop> {
        while self.time < target {
            self.segment(target - self.time, false)?;
            let elapsed = self.segment_steps()?;
            // The device's own sum of steps may differ from the segment's length by rounding alone.
            let arrived = elapsed >= (target - self.time) * (1.0 - 1e-5);
            self.time = if arrived { target } else { self.time + elapsed };
        }
        Ok(())
    }

    fn segment(&mut self, duration: f64, first: bool) -> Result<(), Stop> {
        let steps = self.scene.file.quasi_static.as_ref().map_or(SEGMENT_STEPS, |q| q.most_steps);
        self.backend.begin_segment(self.time, duration, steps, first).map_err(|e| self.fail(&e))
    }

    /// Advances to the end of a segment; gives the time that it covered.
    fn segment_steps(&mut self) -> Result<f64, Stop> {
        loop {
            let clock = self.backend.advance().map_err(|e| self.fail(&e))?;
            (self.steps, self.lists) = (clock.steps_done, clock.lists_built);
            self.lengths.see(&clock);
            let now = self.time + clock.elapsed;
            self.bar.set_position((1000.0 * now / self.scene.file.duration) as u64);
            self.bar.set_message(format!("t = {now:.4e}, step {}", self.steps));
            if let Some(fault) = Fault::from_number(clock.fault) {
                return Err(self.broken(fault, &clock));
            }
            if INTERRUPTED.load(Ordering::Relaxed) {
                return Err(Stop::Interrupted(format!("interrupted at t = {now:.6e}, step {}{}", self.steps, self.advice())));
            }
            if let Some(within) = self.within.filter(|&within| self.stopwatch.elapsed() > within) {
                let (limit, end) = (within.as_secs_f64(), self.scene.file.duration);
                return Err(Stop::Interrupted(format!("not finished in {limit:.0} s: t = {now:.3e} of {end:.3e}")));
            }
            if clock.running == 0 {
                return Ok(clock.elapsed);
            }
        }
    }

    fn sentence(&self, fault: Fault, residual: f64) -> String {
        match &self.scene.file.quasi_static {
            Some(typed) if fault == Fault::NoEquilibrium => format!(
                "no equilibrium within the {} steps of quasi_static.most_steps: the out-of-balance force is {residual:.1e} of the \
                 force scale, and quasi_static.residual asks for {:.1e}",
                typed.most_steps, typed.residual
            ),
            _ => fault.sentence().to_string(),
        }
    }

    fn fail(&self, reason: &str) -> Stop {
        Stop::Failed(format!(
            "{}: stopped after t = {:.6e}, step {}: {reason}{}",
            self.scene.label(),
            self.time,
            self.steps,
            self.advice()
        ))
    }

    /// Says where a fault is, and keeps the state that it left as a frame.
    fn broken(&mut self, fault: Fault, clock: &Clock<f64>) -> Stop {
        let (began, kind) = (self.time, self.sentence(fault, clock.residual));
        // Where equilibrium is sought, the loads are those of the end of the load step.
        self.time += if self.scene.file.quasi_static.is_some() { clock.duration } else { clock.elapsed };
        let mut fields = fault::fields(self.scene);
        if self.files.is_some() {
            fields.extend(&self.frame_fields);
            fields.sort_unstable();
            fields.dedup();
        }
        let mut parts = vec![kind];
        if let Ok(fetched) = self.backend.fetch(&fields) {
            let moment = Moment::new(self.scene, self.time, u64::from(self.steps), &fetched);
            if let Some(place) = fault::find(&moment, fault) {
                parts[0] += &format!(": {}", place.sentence(&moment));
            }
            parts.extend(fault::remedy(self.scene, fault, clock));
            if let Some(Ok(picture)) = self.files.as_mut().map(|files| files.frame(self.scene, &moment)) {
                parts.push(format!("the last state is the picture {picture} and the last one in particles.vtkhdf"));
            }
        }
        let stop = self.fail(&parts.join("; "));
        self.time = began;
        stop
    }

    fn advice(&self) -> String {
        let Some(files) = &self.files else { return String::new() };
        format!("; what was written so far is in {}", files.folder.display())
    }

    /// Fields to fetch at an event, for its frame and for a look at the energy if these are due.
    fn wanted(&self, frame: bool, looks: bool) -> Vec<Field> {
        let mut fields = if frame && self.files.is_some() { self.frame_fields.clone() } else { self.fields.clone() };
        if looks {
            fields.extend(Watch::fields(self.scene));
        }
        if self.scene.file.quasi_static.is_some() {
            fields.extend(balance::fields(self.scene));
        }
        fields.sort_unstable();
        fields.dedup();
        fields
    }

    /// Writes what is due at the present event.
    fn output(&mut self) -> Result<(), Stop> {
        let (time, row, frame) = self.events[self.event];
        self.event += 1;
        let looks = row && self.energy.due(self.steps, self.event == self.events.len());
        let fetched = self.backend.fetch(&self.wanted(frame, looks));
        let fetched = fetched.map_err(|e| self.fail(&e))?;
        let moment = Moment::new(self.scene, time, u64::from(self.steps), &fetched);
        for sentence in self.meetings.look(&moment) {
            self.warn(Some(sentence));
        }
        if row {
            self.table.times.push(time);
            for observer in &self.observers {
                if let Value::Series(of) = observer.kind.value {
                    let column = self.table.columns.entry(observer.name.clone()).or_default();
                    column.push(unwrapped(observer, of(&moment, observer), column.last()));
                }
            }
        }
        let verdict = if looks { self.energy.look(&moment) } else { Verdict::Well };
        if self.scene.file.quasi_static.is_some() && self.event > 1 {
            let warning = self.balance.look(&moment, self.event - 1);
            self.warn(warning);
        }
        let verdict = match meetings::crossed(&moment) {
            Some(sentence) => Verdict::Stop(sentence),
            None => verdict,
        };
        // Before the checkpoint, which remembers that it was said.
        if let Verdict::Warn(sentence) = &verdict {
            self.warn(Some(sentence.clone()));
        }
        if matches!(verdict, Verdict::Stop(_)) && !frame && self.files.is_some() {
            // The last state is kept as a frame to look at, whose fields this event alone would not have fetched.
            let fetched = self.backend.fetch(&self.frame_fields).map_err(|e| self.fail(&e))?;
            let moment = Moment::new(self.scene, time, u64::from(self.steps), &fetched);
            self.write(&moment, row, true).map_err(|e| self.fail(&e))?;
        } else {
            self.write(&moment, row, frame).map_err(|e| self.fail(&e))?;
        }
        match verdict {
            Verdict::Well | Verdict::Warn(_) => Ok(()),
            Verdict::Stop(sentence) => Err(self.fail(&sentence)),
        }
    }

    /// Says a thing and keeps it for the summary.
    fn warn(&mut self, sentence: Option<String>) {
        let Some(sentence) = sentence else { return };
        let sentence = format!("{}: {sentence}", self.scene.label());
        self.bar.suspend(|| warn::say_one(&sentence));
        self.warnings.push(sentence);
    }

    /// Row, frame and checkpoint of a moment.
    fn write(&mut self, moment: &Moment, row: bool, frame: bool) -> Result<(), String> {
        if self.event == self.events.len() && self.files.is_some() {
            self.neighbors = Some(self.neighbors()?);
        }
        let Some(files) = &mut self.files else { return Ok(()) };
        if row {
            files.row(moment.time, &self.observers, &self.table)?;
        }
        if frame {
            files.frame(self.scene, moment)?;
        }
        // A run without frames still has to go on from where it was broken off.
        if frame || (row && self.scene.file.frames() == 0.0) {
            let groups = self.backend.save()?;
            let mut saved = Checkpoint::new(self.scene, &*self.backend, (self.event, moment.time, self.steps), groups);
            saved.watch = self.energy.save();
            saved.story = Story {
                clocks: self.backend.clocks()?,
                lists: self.lists,
                lengths: self.lengths,
                warnings: self.warnings.clone(),
                told: self.meetings.save(),
                balance: self.balance.save(),
                neighbors: self.neighbors,
                spent: self.stopwatch.spent(),
                ..Story::default()
            };
            files.checkpoint(saved)?;
        }
        Ok(())
    }

    fn finish(mut self) -> Result<Finished, Stop> {
        let fetched = self.backend.fetch(&self.fields).map_err(|e| self.fail(&e))?;
        let moment = Moment::new(self.scene, self.time, u64::from(self.steps), &fetched);
        let profiles = self.profiles(&moment);
        let said = Said {
            warnings: std::mem::take(&mut self.warnings),
            energy: self.energy.report(self.scene),
            balance: self.balance.report(self.scene),
        };
        let neighbors = self.neighbors().map_err(|e| self.fail(&e))?;
        let counts = Counted { steps: self.steps, lists_built: self.lists, lengths: self.lengths, neighbors };
        let summary = Summary::new(self.scene, &*self.backend, counts, &self.stopwatch, said);
        let finished = Finished { table: self.table, profiles, summary, folder: self.files.as_ref().map(|f| f.folder.clone()) };
        if let Some(files) = &mut self.files {
            files.finish(self.scene, &finished).map_err(Stop::Failed)?;
        }
        Ok(finished)
    }

    /// Mean number of neighbours over all particles at the end. A run that goes on there has no list to count.
    fn neighbors(&mut self) -> Result<f64, String> {
        if let Some(neighbors) = self.neighbors {
            return Ok(neighbors);
        }
        let counts = self.backend.fetch(&[Field::NeighborCount])?;
        Ok(counts[&Field::NeighborCount].iter().sum::<f64>() / self.scene.particles.len() as f64)
    }

    fn profiles(&self, moment: &Moment) -> BTreeMap<String, Vec<(f64, f64)>> {
        let take = |observer: &Observer| {
            let mut rows = profile(moment, observer);
            let scale = observer.typed.over.as_ref().and_then(|o| self.table.columns.get(o)).and_then(|c| c.last());
            rows.iter_mut().for_each(|row| row.1 /= scale.copied().unwrap_or(1.0));
            (observer.name.clone(), rows)
        };
        self.observers.iter().filter(|o| matches!(o.kind.value, Value::Profile)).map(take).collect()
    }
}

/// An angle is found between -180 and 180 degrees; a series of them goes on over full turns.
fn unwrapped(observer: &Observer, value: f64, before: Option<&f64>) -> f64 {
    match before {
        Some(before) if observer.kind.word == "rotation_angle" => value - 360.0 * ((value - before) / 360.0).round(),
        _ => value,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn events_hold_every_row_and_frame_once() {
        let schedule = Schedule { series: 0.1, frames: 0.25, duration: 1.0, load_steps: 0 };
        let events = schedule.events();
        assert_eq!(events.iter().filter(|e| e.1).count(), 11);
        assert_eq!(events.iter().filter(|e| e.2).count(), 5);
        assert_eq!(events.len(), 13);
        assert_eq!(events.last().map(|e| e.0), Some(1.0));
    }

    #[test]
    fn load_steps_are_rows_and_some_are_frames() {
        let schedule = Schedule { series: 0.0, frames: 0.25, duration: 1.0, load_steps: 10 };
        let events = schedule.events();
        assert!(events.iter().all(|e| e.1));
        let frames: Vec<usize> = (0..events.len()).filter(|&k| events[k].2).collect();
        assert_eq!(frames, [0, 3, 5, 8, 10]);
        assert_eq!(events.last().map(|e| e.0), Some(1.0));
    }
}
