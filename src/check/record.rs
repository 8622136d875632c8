//! Rows kept in a file as they come, so that a check that was stopped goes on where it was.

use super::Row;
use crate::scene::Scene;
use serde::{Deserialize, Serialize};
use std::collections::HashMap;
use std::hash::{DefaultHasher, Hasher};
use std::io::Write;
use std::path::{Path, PathBuf};

/// Lines of JSON, one for each scene with its variant.
pub struct Record {
    path: PathBuf,
    /// What the rows of all scenes hang on beside the scene: this program and the device.
    stamp: String,
    known: HashMap<String, Vec<Row>>,
}

#[derive(Serialize, Deserialize)]
struct Line {
    key: String,
    rows: Vec<Row>,
}

impl Record {
    /// Reads what is there; lines that a kill cut short are left out.
    ///
    /// # Errors
    /// One sentence where the file or this program cannot be read.
    pub fn open(path: &Path, device: &str) -> Result<Self, String> {
        let program = std::env::current_exe().and_then(std::fs::read).map_err(|e| format!("cannot read this program: {e}"))?;
        let text = match std::fs::read_to_string(path) {
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => String::new(),
            read => read.map_err(|error| format!("cannot read {}: {error}", path.display()))?,
        };
        let lines = text.lines().filter_map(|line| serde_json::from_str::<Line>(line).ok());
        let known = lines.map(|line| (line.key, line.rows)).collect();
        Ok(Self { path: path.into(), stamp: format!("{:016x} {device}", hash(&program)), known })
    }

    /// Rows that this program has found of the same scene with the same references.
    pub fn rows(&self, scene: &Scene, folder: &Path) -> Option<Vec<Row>> {
        self.known.get(&self.key(scene, folder)).cloned()
    }

    /// Adds the rows of a scene.
    ///
    /// # Errors
    /// One sentence where the file cannot be written.
    pub fn add(&self, scene: &Scene, folder: &Path, rows: &[Row]) -> Result<(), String> {
        let line = Line { key: self.key(scene, folder), rows: rows.to_vec() };
        let text = serde_json::to_string(&line).map_err(|error| error.to_string())? + "\n";
        let open = || {
            self.path.parent().map_or(Ok(()), std::fs::create_dir_all)?;
            std::fs::OpenOptions::new().create(true).append(true).open(&self.path)
        };
        // One call for the whole line: a kill leaves it out or leaves it whole.
        let written = open().and_then(|mut file| file.write_all(text.as_bytes()));
        written.map_err(|error| format!("cannot write {}: {error}", self.path.display()))
    }

    fn key(&self, scene: &Scene, folder: &Path) -> String {
        let mut text = scene.text.clone();
        for reference in scene.file.expect.values().filter_map(|expect| expect.reference.as_ref()) {
            text += &std::fs::read_to_string(folder.join(reference)).unwrap_or_default();
        }
        format!("{} {:016x} {}", scene.label(), hash(text.as_bytes()), self.stamp)
    }
}

/// Compared only with what the same program has made of it.
fn hash(bytes: &[u8]) -> u64 {
    let mut hasher = DefaultHasher::new();
    hasher.write(bytes);
    hasher.finish()
}
