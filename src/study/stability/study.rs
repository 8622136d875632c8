//! `lithosph study stability`: the zone of each setting of a matrix, runs of some of its waves, and the integrators'
//! longest steps.

use super::limits::{self, Limit, Secular, limits, secular};
use super::points::{Runs, chosen};
use super::report;
use super::setting::Setting;
use super::zone::Zone;
use super::{Growth, growth};
use crate::output::csv::shortest;
use crate::run::{INTERRUPTED, Stop};
use crate::study::accuracy::matrix::{Matrix, Setting as Values};
use crate::study::accuracy::source::Source;
use crate::study::accuracy::table::line;
use indicatif::{ProgressBar, ProgressStyle};
use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;

/// What the command line asks for.
#[derive(Debug, Clone, Default)]
pub struct Request {
    pub scene: PathBuf,
    pub variant: Option<String>,
    /// `path=value` of every setting.
    pub set: Vec<String>,
    /// `path=value,value` for each axis; one setting where empty.
    pub vary: Vec<String>,
    /// Particles along each axis of the periodic box whose waves are looked at.
    pub cells: usize,
    /// Waves of each setting that are run.
    pub simulate: usize,
    pub limits: bool,
    /// The table of settings; `out/study/SCENE[-VARIANT]-stability.csv` unless given. What else is written lies beside it.
    pub out: Option<PathBuf>,
    pub force: bool,
}

/// A setting with all that was found.
pub struct Found {
    /// Values of the axes.
    pub values: Vec<String>,
    pub setting: Setting,
    pub growth: Growth,
    pub zone: Zone,
    pub limits: Option<(Vec<Limit>, Secular)>,
}

/// More settings than this, each with its maps, are taken for a slip.
const MOST_SETTINGS: usize = 100;

/// Does the study; gives the table for the end.
///
/// # Errors
/// A setting that the theory lacks, a run that fails, files of another study, or the user.
pub fn run(request: &Request) -> Result<String, Stop> {
    let source = Source::new(request.scene.clone(), request.variant.clone()).map_err(Stop::Refused)?;
    let open = |overrides: &[String]| source.open(&[&request.set[..], overrides].concat());
    let scene = open(&[]).map_err(Stop::Refused)?;
    scene.one_formulation("study stability").map_err(Stop::Refused)?;
    if request.cells < 4 {
        return Err(Stop::Refused("--cells must be 4 or more".into()));
    }
    let (paths, values) = matrix(request, &source, open).map_err(Stop::Refused)?;
    let resolved = |values: &Values| Setting::new(&open(&values.overrides)?);
    let settings: Vec<Setting> = values.iter().map(resolved).collect::<Result<_, _>>().map_err(Stop::Refused)?;
    if request.limits {
        settings.iter().try_for_each(limits::check).map_err(Stop::Refused)?;
    }
    let out = request.out.clone().unwrap_or_else(|| format!("out/study/{}-stability.csv", scene.label()).into());
    let mut runs = runs(request, &source, &scene, &paths, &out)?;

    let mut found = Vec::new();
    for (values, setting) in values.into_iter().zip(settings) {
        let (growth, zone) = (growth(&setting, request.cells), Zone::new(&setting, request.cells));
        found.push(Found { values: values.shown, setting, growth, zone, limits: None });
    }
    write_zones(&paths, &found, request.cells, &out).map_err(Stop::Failed)?;
    if let Some(runs) = &mut runs {
        simulate_all(request, &found, runs)?;
    }
    if request.limits {
        find_limits(&mut found)?;
        write(&beside(&out, "-limits.csv"), &report::limit_rows(&paths, &found)).map_err(Stop::Failed)?;
    }
    report::write(&scene.label(), &paths, &found, runs.as_ref(), &out).map_err(Stop::Failed)?;
    Ok(report::text(&paths, &found, runs.as_ref(), &out))
}

fn matrix(
    request: &Request,
    source: &Source,
    open: impl Fn(&[String]) -> Result<crate::scene::Scene, String>,
) -> Result<(Vec<String>, Vec<Values>), String> {
    if request.vary.is_empty() {
        return Ok((Vec::new(), vec![Values::default()]));
    }
    let matrix = Matrix::new(&request.vary, &source.read()?, open)?;
    match matrix.settings.len() {
        count if count > MOST_SETTINGS => Err(format!("{count} settings, each with its maps: no more than {MOST_SETTINGS}")),
        _ => Ok((matrix.paths, matrix.settings)),
    }
}

/// The file of runs, where some are asked for.
fn runs(
    request: &Request,
    source: &Source,
    scene: &crate::scene::Scene,
    paths: &[String],
    out: &Path,
) -> Result<Option<Runs>, Stop> {
    if request.simulate == 0 {
        return Ok(None);
    }
    let stamp = source.stamp("stability", scene).map_err(Stop::Refused)?;
    let stamp = format!("{stamp}; {} cells; {}", request.cells, request.set.join(" "));
    Runs::open(&beside(out, "-runs.csv"), stamp.trim_end(), paths, request.force).map(Some).map_err(Stop::Refused)
}

fn simulate_all(request: &Request, found: &[Found], runs: &mut Runs) -> Result<(), Stop> {
    let total: usize = found.iter().map(|found| chosen(&found.setting, request.cells, request.simulate).len()).sum();
    let bar = bar(total as u64);
    bar.set_position(runs.rows.len() as u64);
    for one in found {
        runs.fill(&one.values, &one.setting, request.cells, request.simulate, |_| bar.inc(1))?;
    }
    bar.finish_and_clear();
    Ok(())
}

fn find_limits(found: &mut [Found]) -> Result<(), Stop> {
    let bar = bar(found.len() as u64);
    for one in found {
        let both = limits(&one.setting, |_| {}).and_then(|limits| Ok((limits, secular(&one.setting)?)));
        one.limits = Some(both.map_err(|reason| match INTERRUPTED.load(Ordering::Relaxed) {
            true => Stop::Interrupted(reason),
            false => Stop::Refused(reason),
        })?);
        bar.inc(1);
    }
    bar.finish_and_clear();
    Ok(())
}

/// A bar that shows the progress; it hides itself where stderr is no terminal.
fn bar(length: u64) -> ProgressBar {
    let bar = ProgressBar::new(length);
    if let Ok(style) = ProgressStyle::with_template("{bar:40} {pos}/{len}  {eta_precise} left") {
        bar.set_style(style);
    }
    bar
}

/// The table of settings, and every wave of the maps.
fn write_zones(paths: &[String], found: &[Found], cells: usize, out: &Path) -> Result<(), String> {
    write(out, &report::setting_rows(paths, found))?;
    let own = ["kx dx", "ky dx", "rate dx/c", "frequency dx/c"];
    let mut rows = vec![paths.iter().cloned().chain(own.map(str::to_string)).collect::<Vec<_>>()];
    rows.reserve(found.len() * cells * cells);
    for one in found {
        for sample in one.zone.rows.iter().flatten().filter(|sample| sample.rate.is_finite()) {
            let numbers = [sample.wave[0], sample.wave[1], sample.rate, sample.frequency];
            rows.push(one.values.iter().cloned().chain(numbers.map(shortest)).collect());
        }
    }
    write(&beside(out, "-zone.csv"), &rows)
}

/// A file of the same stem with another end.
pub(super) fn beside(out: &Path, end: &str) -> PathBuf {
    let stem = out.file_stem().unwrap_or_default().display();
    out.with_file_name(format!("{stem}{end}"))
}

fn write(path: &Path, rows: &[Vec<String>]) -> Result<(), String> {
    let place = |error: std::io::Error| format!("{}: {error}", path.display());
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder).map_err(place)?;
    }
    let text: String = rows.iter().map(|row| line(row) + "\n").collect();
    crate::output::durable::put(path, &[text.as_bytes()])
}
