//! What a run that is to go on finds in its folder: the last good state, and what is damaged.

#[cfg(feature = "hdf5")]
use super::names::PARTICLES;
use super::names::{Frame, SERIES, SUMMARY, picture_name};
use crate::output::csv::{Rows, Series};
use crate::output::lock::Lock;
use crate::output::manifest::{Found, Manifest};
use crate::run::Stop;
use crate::run::checkpoint::{self, Checkpoint};
use rayon::prelude::*;
use std::fs;
use std::path::Path;

/// What was found.
pub struct Known {
    pub lock: Lock,
    pub manifest: Manifest,
    /// The state to go on from; none where the run was broken off before the first.
    pub saved: Option<Checkpoint>,
    /// Whether `checkpoint.h5` is that state.
    pub keep_checkpoint: bool,
    /// The series up to that state, with its columns and rows.
    pub series: Option<(Series, Rows)>,
    /// What `particles.vtkhdf` refers to.
    pub listed: Vec<Frame>,
    /// Numbers of frames whose particles are damaged.
    pub lost: Vec<u32>,
    /// A sentence for each thing that is not as it was written.
    pub damage: Vec<String>,
    /// Whether the summary is there.
    pub finished: bool,
}

/// Looks through a folder that nobody else may write to meanwhile.
pub fn find(folder: &Path) -> Result<Known, Stop> {
    let lock = Lock::take(folder).map_err(Stop::of)?;
    let mut damage: Vec<String> = Vec::new();
    let opened = Manifest::open(folder).map_err(Stop::Refused)?;
    let had_list = opened.is_some();
    let (mut saved, mut series, mut keep_checkpoint, mut any) = (None, None, true, false);
    for name in [checkpoint::NAME, checkpoint::PREVIOUS] {
        let path = folder.join(name);
        if !path.exists() {
            continue;
        }
        any = true;
        match state(folder, &path, opened.as_ref()) {
            Ok((state, rows)) => {
                if let Some(why) = damage.last_mut() {
                    why.push_str(&format!(": the run goes on from t = {:.6e}, of {name}", state.time));
                }
                (saved, series) = (Some(state), rows);
                break;
            }
            Err(why) => {
                damage.push(why);
                keep_checkpoint = false;
            }
        }
    }
    // The list tells of a file before it is there.
    let begun = opened.as_ref().is_some_and(|list| list.contents(checkpoint::NAME).len() <= 1 && list.damaged.is_empty());
    if saved.is_none() && (any || !begun) {
        return Err(Stop::Refused(match damage.is_empty() {
            true => format!("{} holds no checkpoint.h5 to resume from", folder.display()),
            false => format!("{}; no good state is left: run the scene again, with --force", damage.join("; ")),
        }));
    }
    let manifest = match opened {
        Some(manifest) => manifest,
        None => begin_anew(folder, saved.as_ref(), &mut damage)?,
    };
    if let Some(line) = manifest.damaged.first() {
        damage.push(format!("line {line} of manifest.txt is not as it was written"));
    }
    let frames: Vec<Frame> = saved.as_ref().map_or_else(Vec::new, |saved| saved.story.frames.clone());
    let lost = if had_list { lost(folder, &manifest, &frames, &mut damage) } else { Vec::new() };
    let listed = listed(folder, &manifest, &lost, !frames.is_empty(), &mut damage);
    let finished = matches!(manifest.look(SUMMARY), Found::Whole | Found::Unknown);
    Ok(Known { lock, manifest, saved, keep_checkpoint, series, listed, lost, damage, finished })
}

/// A checkpoint with the series that belongs to it, if both are as they were written.
fn state(folder: &Path, path: &Path, manifest: Option<&Manifest>) -> Result<(Checkpoint, Option<(Series, Rows)>), String> {
    let saved = checkpoint::read(path)?;
    let series = saved.story.series.map(|then| Series::reopen(&folder.join(SERIES), then)).transpose();
    let series = series.map_err(|why| why + &manifest.map_or_else(String::new, |list| since(folder, list)))?;
    Ok((saved, series))
}

/// Up to when the series is as it was written.
fn since(folder: &Path, manifest: &Manifest) -> String {
    let text = fs::read(folder.join(SERIES)).unwrap_or_default();
    let good = manifest.begins(SERIES).and_then(|content| text.get(..content.bytes as usize));
    let good = good.map(|bytes| String::from_utf8_lossy(bytes).into_owned()).unwrap_or_default();
    match good.lines().skip(1).last().and_then(|line| line.split(',').next()) {
        Some(time) => format!(", later than t = {time}"),
        None => ", from its first rows on".into(),
    }
}

/// Begins the list again where it was lost.
fn begin_anew(folder: &Path, saved: Option<&Checkpoint>, damage: &mut Vec<String>) -> Result<Manifest, Stop> {
    damage.push("manifest.txt is missing: nothing tells whether the frames are as they were written".into());
    let story =
        saved.map(|saved| serde_json::json!({ "scene": saved.name, "variant": saved.variant, "warnings": saved.story.warnings }));
    Manifest::create(folder, &story.unwrap_or_default().to_string()).map_err(Stop::Failed)
}

/// Looks at the files of all frames; gives the numbers of those whose particles cannot be read.
fn lost(folder: &Path, manifest: &Manifest, frames: &[Frame], damage: &mut Vec<String>) -> Vec<u32> {
    let not_whole = |name: fn(u32) -> String| -> Vec<&Frame> {
        let bad = |frame: &&Frame| match manifest.look(&name(frame.0)) {
            Found::Whole => false,
            Found::Missing | Found::Changed => true,
            // Its line is damaged: then the checksums within the file must do.
            Found::Unknown => !reads(&folder.join(name(frame.0))),
        };
        frames.par_iter().filter(bad).collect()
    };
    let mut say = |bad: &[&Frame], name: fn(u32) -> String, remedy: &str| {
        let Some((number, time, _)) = bad.first() else { return };
        let others = if bad.len() > 1 { format!(" and {} later frames", bad.len() - 1) } else { String::new() };
        let name = name(*number);
        let what = if manifest.look(&name) == Found::Missing { "missing" } else { "not as it was written" };
        damage.push(format!("{name} (t = {time:.6e}){others}: {what}; {remedy}"));
    };
    let pictures = not_whole(picture_name);
    say(&pictures, picture_name, "`lithosph render` paints it from particles.vtkhdf");
    #[cfg(feature = "hdf5")]
    {
        use crate::output::vtkhdf::frame_name;
        let particles = not_whole(frame_name);
        say(&particles, frame_name, "particles.vtkhdf leaves it out, and only a run of the scene from its start makes it again");
        particles.iter().map(|frame| frame.0).collect()
    }
    #[cfg(not(feature = "hdf5"))]
    Vec::new()
}

/// Whether the particles of a frame can be read. A picture is believed.
fn reads(path: &Path) -> bool {
    #[cfg(feature = "hdf5")]
    if path.extension().is_some_and(|end| end == "vtkhdf") {
        return crate::output::vtkhdf::read_step(path, 0).is_ok();
    }
    path.exists()
}

/// What the master refers to, if it is as it was written. One that refers to a damaged frame is made again without a word.
#[cfg(feature = "hdf5")]
fn listed(folder: &Path, manifest: &Manifest, lost: &[u32], wanted: bool, damage: &mut Vec<String>) -> Vec<Frame> {
    use crate::output::vtkhdf;
    let kept = match manifest.look(PARTICLES) {
        Found::Whole => vtkhdf::kept(&folder.join(PARTICLES)),
        Found::Missing => Err(String::new()),
        Found::Changed | Found::Unknown => {
            Err("particles.vtkhdf is not as it was written, and is made again from particles/".into())
        }
    };
    match kept {
        Ok(kept) => kept.into_iter().map(|kept| (kept.number, kept.time, kept.step)).filter(|k| !lost.contains(&k.0)).collect(),
        Err(why) => {
            damage.extend(Some(why).filter(|why| wanted && !why.is_empty()));
            Vec::new()
        }
    }
}

#[cfg(not(feature = "hdf5"))]
fn listed(_: &Path, _: &Manifest, _: &[u32], _: bool, _: &mut Vec<String>) -> Vec<Frame> {
    Vec::new()
}
