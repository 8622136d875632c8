//! What `--force` may take away: files that the folder's manifest says a run wrote, as long as they are as it wrote them.

use super::names::{PARTICLES, SERIES, SUMMARY};
use crate::output::durable::{aside, failed};
use crate::output::manifest::{Found, Manifest};
use crate::run::Stop;
use crate::run::checkpoint;
use std::collections::BTreeSet;
use std::fs;
use std::io::ErrorKind;
use std::path::{Component, Path};

/// Whether a run may write a file of this name.
fn is_of_runs(name: &str) -> bool {
    let name = name.strip_suffix(".part").unwrap_or(name);
    let own = ["run.toml", SERIES, PARTICLES, SUMMARY, checkpoint::NAME, checkpoint::PREVIOUS];
    let numbered = |folder: &str, end: &str| {
        let number = name.strip_prefix(folder).and_then(|name| name.strip_suffix(end));
        number.is_some_and(|number| number.len() >= 5 && number.bytes().all(|byte| byte.is_ascii_digit()))
    };
    own.contains(&name)
        || (name.starts_with("profile-") && name.ends_with(".csv"))
        || numbered("frames/", ".png")
        || numbered("particles/", ".vtkhdf")
}

/// Names of what lies in the folder, and in those of a run's below it.
fn names(folder: &Path) -> Vec<String> {
    let within = |place: &str| -> Vec<String> {
        let entries = fs::read_dir(folder.join(place)).into_iter().flatten().flatten();
        entries.map(|entry| format!("{place}{}", entry.file_name().to_string_lossy())).collect()
    };
    ["", "frames/", "particles/"].into_iter().flat_map(within).collect()
}

/// No line of a list, whoever wrote it, leads out of the folder.
fn stays_within(name: &str) -> bool {
    Path::new(name).components().all(|part| matches!(part, Component::Normal(_)))
}

/// Takes away what a run wrote, and nothing else; refuses, before anything is gone, where a file of another lies in the way.
pub fn clear(folder: &Path) -> Result<(), Stop> {
    let manifest = Manifest::open(folder).map_err(Stop::Refused)?;
    let (mut own, mut folders) = (BTreeSet::new(), BTreeSet::new());
    let is_whole = |manifest: &Manifest, name: &str| {
        // A series has grown since the list last told of it.
        manifest.look(name) == Found::Whole || (name == SERIES && manifest.begins(name).is_some())
    };
    for name in names(folder).into_iter().filter(|name| is_of_runs(name)) {
        let half = name.strip_suffix(".part").map(|base| manifest.as_ref().is_some_and(|list| !list.contents(base).is_empty()));
        if !half.unwrap_or_else(|| manifest.as_ref().is_some_and(|list| is_whole(list, &name))) {
            return Err(Stop::Refused(format!(
                "{} is not as a run of this version wrote it, and --force takes away no file of others: move it away, or choose \
                 another folder with --out",
                folder.join(name).display()
            )));
        }
        own.insert(name);
    }
    for name in manifest.iter().flat_map(Manifest::names).filter(|name| stays_within(name)) {
        if manifest.as_ref().is_some_and(|list| is_whole(list, name)) {
            own.insert(name.to_string());
        }
        folders.extend(Path::new(name).parent().filter(|place| !place.as_os_str().is_empty()));
    }
    for name in &own {
        let path = folder.join(name);
        for path in [aside(&path), path] {
            match fs::remove_file(&path) {
                Err(error) if error.kind() != ErrorKind::NotFound => return Err(Stop::Failed(failed(&path, &error))),
                _ => {}
            }
        }
    }
    for place in folders {
        // It stays where something of another is in it.
        let _ = fs::remove_dir(folder.join(place));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_runs_are_told_from_others() {
        for name in ["series.csv", "frames/00012.png", "particles/123456.vtkhdf", "profile-cut.csv", "checkpoint.h5.part"] {
            assert!(is_of_runs(name), "{name}");
        }
        for name in ["frames/holiday.png", "frames/1.png", "notes.csv", "frames/00012.png.bak", "particles/00000.h5"] {
            assert!(!is_of_runs(name), "{name}");
        }
        assert!(stays_within("frames/00001.png") && !stays_within("../x") && !stays_within("/etc/x"));
    }
}
