//! The scene of a study: its text, what it expects, and what its errors hang on.

use super::front::Expected;
use crate::check;
use crate::scene::Scene;
use crate::scene::file::Expect;
use crate::scene::read::{self, Read, hint};
use std::path::{Path, PathBuf};

/// The scene's text as it was when the study began: what is typed into the file later does not count.
pub struct Source {
    path: PathBuf,
    text: String,
    variant: Option<String>,
}

impl Source {
    pub fn new(path: PathBuf, variant: Option<String>) -> Result<Self, String> {
        Ok(Self { text: read::text_of(&path)?, path, variant })
    }

    /// As typed, with its lines.
    pub fn read(&self) -> Result<Read, String> {
        self.read_with(&[])
    }

    /// The same with overrides.
    pub fn read_with(&self, overrides: &[String]) -> Result<Read, String> {
        read::read_text(&self.text, &self.path.display().to_string(), self.variant.as_deref(), overrides)
    }

    pub fn open(&self, overrides: &[String]) -> Result<Scene, String> {
        Scene::open_text(&self.text, &self.path, self.variant.as_deref(), overrides)
    }

    pub fn folder(&self) -> &Path {
        self.path.parent().unwrap_or(Path::new("."))
    }

    /// Version, study, scene, and a hash of the scene's text and its references: what has another stamp does not compare.
    pub fn stamp(&self, study: &str, scene: &Scene) -> Result<String, String> {
        let mut hash = fnv(self.text.as_bytes(), FNV_BASIS);
        for reference in scene.file.expect.values().filter_map(|expect| expect.reference.as_ref()) {
            hash = fnv(read::text_of(&self.folder().join(reference))?.as_bytes(), hash);
        }
        let (version, label) = (env!("CARGO_PKG_VERSION"), scene.label());
        Ok(format!("{version} study {study}: {label}, scene and references {hash:016x}"))
    }
}

/// Expectations with a value or a reference that hold for the scene's variant; one of them where it is named.
pub fn expected(scene: &Scene, only: Option<&str>) -> Result<Vec<Expected>, String> {
    let known = scene.file.expect.iter().filter(|(_, expect)| check::applies(scene, expect));
    let known = known.filter(|(_, expect)| expect.value.is_some() || expect.reference.is_some());
    let expected = |(name, expect): (&String, &Expect)| Expected { name: name.clone(), tolerance: expect.tolerance };
    let all: Vec<Expected> = known.map(expected).collect();
    let names: Vec<&str> = all.iter().map(|expected| expected.name.as_str()).collect();
    match only {
        _ if all.is_empty() => {
            Err(format!("{} expects no value and names no reference, so that there is no error", scene.label()))
        }
        None => Ok(all),
        Some(name) if names.contains(&name) => Ok(all.into_iter().filter(|expected| expected.name == name).collect()),
        Some(name) => Err(format!("--observable {name}: no expectation with a value or a reference{}", hint(name, &names))),
    }
}

/// A hash that is the same on every machine and with every compiler.
pub fn hash(bytes: &[u8]) -> u64 {
    fnv(bytes, FNV_BASIS)
}

const FNV_BASIS: u64 = 0xcbf2_9ce4_8422_2325;

/// Fowler, Noll and Vo's hash 1a: the same with every compiler, unlike the standard library's.
fn fnv(bytes: &[u8], basis: u64) -> u64 {
    bytes.iter().fold(basis, |hash, &byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}
