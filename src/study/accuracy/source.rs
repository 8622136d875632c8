//! The scene of a study: its text, what it expects, and what its errors hang on.

use super::matrix::{NONE, VARIANT};
use crate::scene::Scene;
use crate::scene::read::{self, Read};
use std::collections::BTreeSet;
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

    /// The scene with overrides, of which `variant` chooses another variant.
    pub fn open(&self, overrides: &[String]) -> Result<Scene, String> {
        let (variant, overrides) = self.chosen(overrides);
        Scene::open_text(&self.text, &self.path, variant.as_deref(), &overrides)
    }

    /// Variant and overrides of a setting.
    pub fn chosen(&self, overrides: &[String]) -> (Option<String>, Vec<String>) {
        let word = |text: &String| text.strip_prefix(VARIANT)?.strip_prefix('=').map(|word| word.trim_matches('"').to_string());
        let variant = match overrides.iter().find_map(word) {
            Some(word) => Some(word).filter(|word| word != NONE),
            None => self.variant.clone(),
        };
        (variant, overrides.iter().filter(|text| word(text).is_none()).cloned().collect())
    }

    pub fn path(&self) -> &Path {
        &self.path
    }

    pub fn folder(&self) -> &Path {
        self.path.parent().unwrap_or(Path::new("."))
    }

    /// Version, study, scene, and a hash of the scene's text and its references: what has another stamp does not compare.
    pub fn stamp(&self, study: &str, scene: &Scene) -> Result<String, String> {
        let mut hash = fnv(self.text.as_bytes(), FNV_BASIS);
        for reference in references(scene) {
            hash = fnv(read::text_of(&self.folder().join(reference))?.as_bytes(), hash);
        }
        let (version, label) = (env!("CARGO_PKG_VERSION"), scene.label());
        Ok(format!("{version} study {study}: {label}, scene and references {hash:016x}"))
    }
}

/// References of the scene and of its variants, each once.
fn references(scene: &Scene) -> BTreeSet<String> {
    let own = scene.file.expect.values().filter_map(|expect| expect.reference.clone());
    let expects = scene.file.variant.values().filter_map(|variant| variant.get("expect")?.as_table());
    let theirs = expects.flat_map(|expects| expects.values()).filter_map(|expect| expect.get("reference")?.as_str());
    own.chain(theirs.filter(|name| *name != NONE).map(str::to_string)).collect()
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
