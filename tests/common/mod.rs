//! What several tests share: random numbers, the device, runs of a scene's text, and folders to run the program in.

pub mod deformation;
pub mod matrix;
pub mod patches;
pub mod sandbox;

use lithosph::backend::device::{Want, choose};
use lithosph::backend::{Backend, Fetched};
use lithosph::fields::Field;
use lithosph::rows::Clock;
use lithosph::scene::Scene;
use std::io::Write;
use std::path::{Path, PathBuf};

/// A seeded sequence of numbers: SplitMix64 of Steele, Lea & Flood 2014.
pub struct Random(pub u64);

impl Random {
    pub fn word(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ z >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ z >> 31
    }
    /// From 0 to 1.
    pub fn unit(&mut self) -> f64 {
        (self.word() >> 11) as f64 / (1u64 << 53) as f64
    }
    /// From -1 to 1.
    pub fn signed(&mut self) -> f64 {
        2.0 * self.unit() - 1.0
    }
    pub fn below(&mut self, end: usize) -> usize {
        (self.word() % end as u64) as usize
    }
    pub fn coin(&mut self) -> bool {
        self.word() & 1 == 1
    }
}

/// The device to test on. None, with one line that says so, where there is none, which `LITHOSPH_NEED_GPU=1` forbids.
pub fn adapter() -> Option<wgpu::Adapter> {
    if let Ok(Some(adapter)) = choose(Want::Gpu, None) {
        return Some(adapter);
    }
    let needed = std::env::var("LITHOSPH_NEED_GPU").is_ok_and(|value| value == "1");
    assert!(!needed, "LITHOSPH_NEED_GPU is 1, but there is no graphics adapter, not even a software one");
    // Past the test harness, which hides what a passing test prints.
    let _ = writeln!(std::io::stderr(), "no graphics adapter: a test of the GPU path is left out");
    None
}

pub fn scene_folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("scenes")
}

/// A scene by its stem.
pub fn scene_file(name: &str) -> PathBuf {
    scene_folder().join(name).with_extension("toml")
}

/// All of them, in order of their names.
pub fn scene_files() -> Vec<PathBuf> {
    let entries = std::fs::read_dir(scene_folder()).expect("there is a folder of scenes");
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.expect("an entry").path()).collect();
    files.retain(|path| path.extension().is_some_and(|e| e == "toml"));
    files.sort();
    files
}

/// A scene from text, which must be sound.
pub fn parse(text: &str) -> Scene {
    Scene::parse(text, "test", None, &[]).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// Steps a number of times, from the start of a run, as the run loop does it.
pub fn steps(backend: &mut dyn Backend, steps: u32) -> Clock<f64> {
    backend.begin_segment(0.0, 1e9, steps, true).unwrap();
    loop {
        let clock = backend.advance().unwrap();
        assert_eq!(clock.fault, 0);
        if clock.running == 0 {
            return clock;
        }
    }
}

/// A field with its particles in order of their numbers, `width` numbers a particle.
pub fn in_order(backend: &mut dyn Backend, field: Field) -> Vec<f64> {
    let columns: Fetched = backend.fetch(&[Field::Number, field]).unwrap();
    let (numbers, values) = (&columns[&Field::Number], &columns[&field]);
    let width = values.len() / numbers.len();
    let mut ordered = vec![0.0; values.len()];
    for (&number, value) in numbers.iter().zip(values.chunks(width)) {
        ordered[number as usize * width..][..width].copy_from_slice(value);
    }
    ordered
}

pub fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, |largest, value| f64::max(largest, value.abs()))
}
