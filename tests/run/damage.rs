//! Folders that are damaged, shared, or hold what others left.

use crate::common::sandbox::{Said, Sandbox, signal, until};
use lithosph::output::vtkhdf;
use std::collections::BTreeMap;
use std::path::Path;
use std::process::Child;

const RUN: [&str; 8] = ["run", "s.toml", "--backend", "cpu", "--threads", "1", "--out", "out"];
const RESUME: [&str; 7] = ["run", "--resume", "out", "--backend", "cpu", "--threads", "1"];

/// A run of five frames that was broken off when it had made its third, and an unbroken one beside it.
fn broken_off(name: &str) -> Sandbox {
    let sandbox = Sandbox::new(name);
    let longer = ["--set", "duration=8", "--set", "output.series=0.5"];
    let whole = sandbox.lithosph(&[&RUN[..7], &["whole"], &longer].concat());
    assert_eq!(whole.code, Some(0), "{whole:?}");
    // Goes on for long, so that there is time to end it.
    let child = sandbox.command(&[&RUN[..], &longer].concat()).spawn().unwrap();
    until("there are frames", || sandbox.exists("out/frames/00002.png") && sandbox.exists("out/checkpoint.previous.h5"));
    signal(&child, libc::SIGKILL);
    child.wait_with_output().unwrap();
    assert!(!sandbox.exists("out/summary.json"), "the run was over before it was ended");
    sandbox
}

/// What a run leaves that does not tell of wall time.
fn left(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut all = BTreeMap::new();
    for place in ["", "frames", "particles"] {
        for entry in std::fs::read_dir(folder.join(place)).unwrap().flatten().filter(|entry| entry.path().is_file()) {
            let name = format!("{place}/{}", entry.file_name().to_string_lossy());
            if !name.starts_with("/checkpoint") && !["/manifest.txt", "/summary.json"].contains(&name.as_str()) {
                all.insert(name, std::fs::read(entry.path()).unwrap());
            }
        }
    }
    all
}

#[track_caller]
fn resumes_to_the_same(sandbox: &Sandbox) -> Said {
    let said = sandbox.lithosph(&RESUME);
    assert_eq!(said.code, Some(0), "{said:?}");
    let (whole, parts) = (left(&sandbox.path("whole")), left(&sandbox.path("out")));
    assert_eq!(whole.keys().collect::<Vec<_>>(), parts.keys().collect::<Vec<_>>());
    whole.iter().for_each(|(name, bytes)| assert!(*bytes == parts[name], "{name} differs"));
    said
}

fn flip(path: &Path, place: usize) {
    let mut bytes = std::fs::read(path).unwrap();
    let count = bytes.len();
    bytes[place % count] ^= 0x04;
    std::fs::write(path, bytes).unwrap();
}

#[test]
fn no_flipped_bit_of_a_checkpoint_is_taken_for_a_state() {
    let sandbox = broken_off("flipped");
    let (path, kept) = (sandbox.path("out/checkpoint.h5"), sandbox.path("kept.h5"));
    std::fs::copy(&path, &kept).unwrap();
    let length = std::fs::metadata(&kept).unwrap().len() as usize;
    // Of both checkpoints, so that nothing is run: what is refused leaves the folder as it is.
    let previous = std::fs::read(sandbox.path("out/checkpoint.previous.h5")).unwrap();
    std::fs::write(sandbox.path("out/checkpoint.previous.h5"), &previous[..previous.len() / 2]).unwrap();
    for k in 0..40 {
        std::fs::copy(&kept, &path).unwrap();
        flip(&path, k * length / 40 + k % 7);
        let said = sandbox.lithosph(&RESUME);
        assert_eq!(said.code, Some(2), "{k}: {said:?}");
        assert!(said.err.contains("out/checkpoint.h5 is damaged") && said.err.contains("no good state is left"), "{said:?}");
    }
    std::fs::copy(&kept, &path).unwrap();
    std::fs::write(sandbox.path("out/checkpoint.previous.h5"), previous).unwrap();
    resumes_to_the_same(&sandbox);
}

#[test]
fn a_damaged_checkpoint_sends_the_run_back_to_the_one_before() {
    let sandbox = broken_off("previous");
    flip(&sandbox.path("out/checkpoint.h5"), 5000);
    let said = resumes_to_the_same(&sandbox);
    assert!(
        said.err.contains("checkpoint.h5 is damaged: its checksum") && said.err.contains("of checkpoint.previous.h5"),
        "{said:?}"
    );
    let summary = std::fs::read_to_string(sandbox.path("out/summary.json")).unwrap();
    assert!(summary.contains("is damaged"), "the summary keeps it: {summary}");
}

#[test]
fn missing_and_changed_rows_are_told_with_their_time() {
    let sandbox = broken_off("rows");
    let path = sandbox.path("out/series.csv");
    let whole = std::fs::read_to_string(&path).unwrap();
    let refused = |text: &str, words: &str| {
        std::fs::write(&path, text).unwrap();
        let said = sandbox.lithosph(&RESUME);
        assert_eq!(said.code, Some(2), "{said:?}");
        assert!(said.err.contains(words) && said.err.contains("from its first rows on"), "{words}: {said:?}");
        assert_eq!(std::fs::read_to_string(&path).unwrap(), text, "it was written to");
    };
    let lines: Vec<&str> = whole.split_inclusive('\n').collect();
    refused(&[&lines[..1], &lines[2..]].concat().concat(), "not as it was written");
    refused(lines[0], "lacks rows");
    let changed = |k: usize| whole.replacen(lines[k], &lines[k].replacen(',', ",1", 1), 1);
    refused(&changed(1), "not as it was written");
    // Rows later than the state before are made again from there.
    std::fs::write(&path, changed(2)).unwrap();
    let said = resumes_to_the_same(&sandbox);
    assert!(said.err.contains("not as it was written, later than t = 0: the run goes on from t = 0"), "{said:?}");
}

#[test]
fn a_row_that_a_kill_cut_short_is_no_damage() {
    let sandbox = broken_off("torn");
    let path = sandbox.path("out/series.csv");
    let whole = std::fs::read_to_string(&path).unwrap();
    std::fs::write(&path, format!("{whole}77.5,0.00")).unwrap();
    let said = resumes_to_the_same(&sandbox);
    assert!(!said.err.contains("damage") && !said.err.contains("written"), "{said:?}");
}

#[test]
fn lost_frames_are_told_and_left_out_of_the_master() {
    let sandbox = broken_off("frames");
    flip(&sandbox.path("out/particles/00001.vtkhdf"), 3000);
    std::fs::remove_file(sandbox.path("out/frames/00000.png")).unwrap();
    let said = sandbox.lithosph(&RESUME);
    assert_eq!(said.code, Some(0), "{said:?}");
    assert!(said.err.contains("particles/00001.vtkhdf (t = 2.000000e0): not as it was written"), "{said:?}");
    assert!(said.err.contains("frames/00000.png (t = 0.000000e0): missing"), "{said:?}");
    let times = |folder: &str| vtkhdf::read(&sandbox.path(folder).join("particles.vtkhdf")).unwrap();
    let mut wanted = times("whole");
    wanted.remove(1);
    assert_eq!(times("out"), wanted);
    (0..wanted.len())
        .for_each(|k| assert_eq!(vtkhdf::read_step(&sandbox.path("out/particles.vtkhdf"), k).unwrap().time, wanted[k]));
}

#[test]
fn a_damaged_master_or_list_is_made_again() {
    let sandbox = broken_off("master");
    flip(&sandbox.path("out/particles.vtkhdf"), 700);
    let said = resumes_to_the_same(&sandbox);
    assert!(said.err.contains("particles.vtkhdf is not as it was written"), "{said:?}");
    let sandbox = broken_off("list");
    flip(&sandbox.path("out/manifest.txt"), 300);
    let said = resumes_to_the_same(&sandbox);
    assert!(said.err.contains("of manifest.txt is not as it was written"), "{said:?}");
    let sandbox = broken_off("no-list");
    std::fs::remove_file(sandbox.path("out/manifest.txt")).unwrap();
    let said = resumes_to_the_same(&sandbox);
    assert!(said.err.contains("manifest.txt is missing"), "{said:?}");
}

#[test]
fn a_run_that_had_no_state_yet_begins_again() {
    let sandbox = broken_off("begin");
    for name in ["checkpoint.h5", "checkpoint.previous.h5"] {
        std::fs::remove_file(sandbox.path("out").join(name)).unwrap();
    }
    let said = sandbox.lithosph(&RESUME);
    assert!(said.code == Some(2) && said.err.contains("holds no checkpoint.h5"), "{said:?}");
    // As a kill before the first state leaves it.
    let list = std::fs::read_to_string(sandbox.path("out/manifest.txt")).unwrap();
    let early: String = list.split_inclusive('\n').take_while(|line| !line.contains("checkpoint")).collect();
    std::fs::write(sandbox.path("out/manifest.txt"), early).unwrap();
    resumes_to_the_same(&sandbox);
}

#[test]
fn force_takes_away_what_a_run_wrote_and_nothing_else() {
    let sandbox = Sandbox::new("holiday");
    let forced = || sandbox.lithosph(&[&RUN[..], &["--force"]].concat());
    assert_eq!(sandbox.lithosph(&[&RUN[..], &["--set", "duration=8"]].concat()).code, Some(0));
    let others = ["out/frames/holiday.png", "out/profile.csv", "out/particles/mine", "out/notes.txt"];
    others.iter().for_each(|name| sandbox.write(name, "mine"));
    assert!(sandbox.exists("out/frames/00004.png"));
    let said = forced();
    assert_eq!(said.code, Some(0), "{said:?}");
    others.iter().for_each(|name| assert_eq!(std::fs::read(sandbox.path(name)).unwrap(), b"mine", "{name}"));
    // The second run is shorter: nothing of the first is left that could be read as its.
    assert!(!sandbox.exists("out/frames/00004.png") && !sandbox.exists("out/particles/00004.vtkhdf"));
    for (name, back) in [("out/profile-x.csv", None), ("out/frames/00007.png", None), ("out/series.csv", Some("time,kinetic\n"))]
    {
        let before = back.map(|_| std::fs::read_to_string(sandbox.path(name)).unwrap());
        sandbox.write(name, "mine");
        let said = forced();
        assert!(said.code == Some(2) && said.err.contains(name) && said.err.contains("--out"), "{said:?}");
        assert_eq!(std::fs::read(sandbox.path(name)).unwrap(), b"mine");
        assert!(sandbox.exists("out/summary.json") && sandbox.exists("out/frames/00000.png"), "half of it is gone");
        match before {
            Some(text) => sandbox.write(name, &text),
            None => std::fs::remove_file(sandbox.path(name)).unwrap(),
        }
    }
    assert_eq!(forced().code, Some(0));
}

#[test]
fn rendered_pictures_are_not_overwritten_without_force() {
    let sandbox = Sandbox::new("rendered");
    assert_eq!(sandbox.lithosph(&RUN).code, Some(0));
    let before = std::fs::read(sandbox.path("out/frames/00000.png")).unwrap();
    let render = ["render", "out", "--field", "velocity.y", "--step", "0"];
    assert_eq!(sandbox.lithosph(&render).code, Some(0));
    assert!(sandbox.exists("out/frames-velocity.y/00000.png"));
    assert!(std::fs::read(sandbox.path("out/frames/00000.png")).unwrap() == before);
    let said = sandbox.lithosph(&render);
    assert!(said.code == Some(2) && said.err.contains("exists already; --force"), "{said:?}");
    assert_eq!(sandbox.lithosph(&[&render[..], &["--force"]].concat()).code, Some(0));
    // A run that is forced takes them away: they would show the run before.
    assert_eq!(sandbox.lithosph(&[&RUN[..], &["--force"]].concat()).code, Some(0));
    assert!(!sandbox.exists("out/frames-velocity.y"));
}

#[test]
fn of_many_that_start_at_once_one_gets_the_folder() {
    let sandbox = Sandbox::new("shared");
    let long = ["--set", "duration=1e6", "--force"];
    let mut children: Vec<_> = (0..6).map(|_| sandbox.command(&[&RUN[..], &long].concat()).spawn().unwrap()).collect();
    let ended = |child: &mut Child| child.try_wait().unwrap().is_some();
    let running = |children: &mut Vec<Child>| children.iter_mut().map(|child| u32::from(!ended(child))).sum::<u32>();
    let counted = std::cell::RefCell::new(&mut children);
    until("one is left", || running(&mut counted.borrow_mut()) <= 1);
    until("it has a state", || sandbox.exists("out/checkpoint.h5"));
    for arguments in [&RESUME[..], &[&RUN[..], &["--force"]].concat()] {
        let said = sandbox.lithosph(arguments);
        assert!(said.code == Some(2) && said.err.contains("out is being written by process "), "{said:?}");
        assert_eq!(said.err.lines().count(), 1);
    }
    assert_eq!(running(&mut children), 1);
    let last = children.iter_mut().find_map(|child| (!ended(child)).then_some(child)).unwrap();
    signal(last, libc::SIGKILL);
    last.wait().unwrap();
    // What the kill left in the folder stands in nobody's way.
    assert!(sandbox.exists("out/lock"));
    assert_eq!(sandbox.lithosph(&[&RUN[..], &["--force"]].concat()).code, Some(0));
    assert!(!sandbox.exists("out/lock"));
}

#[test]
fn every_signal_that_asks_for_an_end_leaves_a_run_that_goes_on() {
    let sandbox = Sandbox::new("signals");
    for number in [libc::SIGINT, libc::SIGTERM, libc::SIGHUP, libc::SIGQUIT] {
        let child = sandbox.command(&[&RUN[..], &["--set", "duration=1e6"]].concat()).spawn().unwrap();
        until("it has a state", || sandbox.exists("out/checkpoint.h5"));
        signal(&child, number);
        let said = crate::common::sandbox::said(child);
        assert_eq!(said.code, Some(130), "{number}: {said:?}");
        assert!(said.err.contains("interrupted at t = "), "{said:?}");
        assert!(sandbox.exists("out/checkpoint.h5") && !sandbox.exists("out/lock"));
        std::fs::remove_dir_all(sandbox.path("out")).unwrap();
    }
}

#[test]
fn nobody_at_the_other_end_is_no_error() {
    let sandbox = Sandbox::new("closed");
    let mut command = sandbox.command(&[&RUN[..], &["--set", "formulation.viscosity.alpha=0.5"]].concat());
    let mut child = command.spawn().unwrap();
    drop((child.stdout.take(), child.stderr.take()));
    assert_eq!(child.wait().unwrap().code(), Some(0));
    assert!(sandbox.exists("out/summary.json"));
    let mut child = sandbox.command(&["run", "none.toml"]).spawn().unwrap();
    drop(child.stderr.take());
    assert_eq!(child.wait().unwrap().code(), Some(2));
}
