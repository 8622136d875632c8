//! From a scene file to a scene that can run and give what it is asked for.

use crate::observable;
use crate::scene::file::File;
use crate::scene::read::{self, Read};
use crate::scene::{Scene, resolve};
use std::path::Path;

impl Scene {
    /// Reads and resolves a scene file. Errors are one sentence with file and line.
    pub fn open(path: &Path, variant: Option<&str>, overrides: &[String]) -> Result<Self, String> {
        Self::open_text(&read::text_of(path)?, path, variant, overrides)
    }

    /// The same from a text that was read from the file before.
    pub fn open_text(text: &str, path: &Path, variant: Option<&str>, overrides: &[String]) -> Result<Self, String> {
        let name = path.file_stem().map_or_else(|| "scene".into(), |s| s.to_string_lossy().into_owned());
        Self::of(name, read::read_text(text, &path.display().to_string(), variant, overrides)?)
    }

    /// The same from text.
    pub fn parse(text: &str, name: &str, variant: Option<&str>, overrides: &[String]) -> Result<Self, String> {
        Self::of(name.into(), read::read_text(text, name, variant, overrides)?)
    }

    /// [`Self::open`] without the flaws of the bodies' shapes.
    pub fn open_flawless(path: &Path, variant: Option<&str>, overrides: &[String]) -> Result<Self, String> {
        let name = path.file_stem().map_or_else(|| "scene".into(), |s| s.to_string_lossy().into_owned());
        Self::of(name, read::read(path, variant, overrides)?.flawless())
    }

    /// A scene whose tables the program made itself.
    pub fn from_file(file: File, name: &str) -> Result<Self, String> {
        Self::of(name.into(), Read::made(file, name))
    }

    /// What was read, resolved, if every observable and expectation can be had from it.
    fn of(name: String, read: Read) -> Result<Self, String> {
        let source = read.source.clone();
        let scene = resolve(name, read)?;
        observable::check(&scene, |path, message| format!("{}: {message}", source.place(path)))?;
        Ok(scene)
    }
}
