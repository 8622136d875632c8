//! The list of files that a run wrote into its folder, with their checksums: what is its own, and whether it is as it was written.
//!
//! A line is appended before its file is put into its place, so that no file of a run is without one:
//!
//! ```text
//! lithosph-manifest 1 {"scene":"rings","variant":null} 0a1b2c3d
//! BLAKE3 BYTES NAME CHECK
//! ```
//!
//! A name may come again: a file that is replaced has had each of its contents, and a file that grows was as long as each of its
//! lines says. CHECK is the beginning of the BLAKE3 of the line before it, so that damage to the list itself is noticed.

use super::durable::{self, failed};
use blake3::Hash;
use std::collections::BTreeMap;
use std::fs::{self, File, OpenOptions};
use std::io::{Read, Write};
use std::path::{Path, PathBuf};

/// Its name in the folder.
pub const NAME: &str = "manifest.txt";
const TITLE: &str = "lithosph-manifest 1 ";

/// What a file consisted of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Content {
    pub hash: Hash,
    pub bytes: u64,
}

impl Content {
    pub fn of(parts: &[&[u8]]) -> Self {
        let mut hasher = blake3::Hasher::new();
        parts.iter().for_each(|part| _ = hasher.update(part));
        Self { hash: hasher.finalize(), bytes: parts.iter().map(|part| part.len() as u64).sum() }
    }

    /// Of the first so many bytes of a file; none where it is shorter or cannot be read.
    fn of_file(path: &Path, bytes: u64) -> Option<Self> {
        let (file, mut hasher) = (File::open(path).ok()?, blake3::Hasher::new());
        hasher.update_reader(file.take(bytes)).ok()?;
        (hasher.count() == bytes).then(|| Self { hash: hasher.finalize(), bytes })
    }
}

/// What a look at a file found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Found {
    /// As it was written.
    Whole,
    Missing,
    Changed,
    /// The list has no line of it.
    Unknown,
}

/// An open list.
#[derive(Debug)]
pub struct Manifest {
    folder: PathBuf,
    file: File,
    about: String,
    contents: BTreeMap<String, Vec<Content>>,
    /// Numbers of lines that are not as they were written.
    pub damaged: Vec<usize>,
}

fn checked(line: &str) -> String {
    format!("{line} {}\n", &blake3::hash(line.as_bytes()).to_hex()[..8])
}

/// The line without its check, if that is right.
fn unchecked(line: &str) -> Option<&str> {
    let (text, check) = line.rsplit_once(' ')?;
    (blake3::hash(text.as_bytes()).to_hex()[..8] == *check).then_some(text)
}

fn parse(text: &str) -> Option<(String, Content)> {
    let mut words = text.splitn(3, ' ');
    let (hash, bytes, name) = (words.next()?, words.next()?, words.next()?);
    Some((name.to_string(), Content { hash: Hash::from_hex(hash).ok()?, bytes: bytes.parse().ok()? }))
}

impl Manifest {
    /// Begins a list. `about` is one line that says whose it is.
    pub fn create(folder: &Path, about: &str) -> Result<Self, String> {
        let path = folder.join(NAME);
        durable::put(&path, &[checked(&format!("{TITLE}{about}")).as_bytes()])?;
        Self::append_to(folder, about.to_string(), BTreeMap::new(), Vec::new())
    }

    fn append_to(
        folder: &Path,
        about: String,
        contents: BTreeMap<String, Vec<Content>>,
        damaged: Vec<usize>,
    ) -> Result<Self, String> {
        let path = folder.join(NAME);
        let file = OpenOptions::new().append(true).open(&path).map_err(|error| failed(&path, &error))?;
        Ok(Self { folder: folder.to_path_buf(), file, about, contents, damaged })
    }

    /// Opens the list of a folder; none where it has none. A last line that a kill cut short is dropped.
    pub fn open(folder: &Path) -> Result<Option<Self>, String> {
        let path = folder.join(NAME);
        let bytes = match fs::read(&path) {
            Ok(bytes) => bytes,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(format!("cannot read {}: {error}", path.display())),
        };
        let whole = bytes.iter().rposition(|&byte| byte == b'\n').map_or(0, |end| end + 1);
        let text = String::from_utf8_lossy(&bytes[..whole]);
        if !text.starts_with("lithosph-manifest ") {
            return Err(format!("{} is no list of files of lithosph: move it away, or choose another folder", path.display()));
        }
        let (mut about, mut contents, mut damaged) = (String::new(), BTreeMap::<String, Vec<Content>>::new(), Vec::new());
        for (number, line) in text.lines().enumerate() {
            let line = unchecked(line);
            match (number, line.and_then(|line| line.strip_prefix(TITLE)), line.and_then(parse)) {
                (0, Some(typed), _) => about = typed.into(),
                (1.., _, Some((name, content))) => contents.entry(name).or_default().push(content),
                _ => damaged.push(number + 1),
            }
        }
        let manifest = Self::append_to(folder, about, contents, damaged)?;
        if whole < bytes.len() {
            manifest.file.set_len(whole as u64).map_err(|error| failed(&path, &error))?;
        }
        Ok(Some(manifest))
    }

    /// Whose list it is; empty where that line is damaged.
    pub fn about(&self) -> &str {
        &self.about
    }

    /// Puts a file into the folder, of which the list tells first.
    pub fn put(&mut self, name: &str, parts: &[&[u8]]) -> Result<(), String> {
        self.note(name, Content::of(parts))?;
        durable::put(&self.folder.join(name), parts)
    }

    /// Tells of a file.
    pub fn note(&mut self, name: &str, content: Content) -> Result<(), String> {
        let before = self.contents.entry(name.into()).or_default();
        if before.last() == Some(&content) {
            return Ok(());
        }
        before.push(content);
        if name.contains('\n') {
            return Err(format!("{name:?} cannot be the name of a file"));
        }
        let line = checked(&format!("{} {} {name}", content.hash, content.bytes));
        // One call for the whole line: a kill leaves it out or leaves it whole.
        self.file.write_all(line.as_bytes()).map_err(|error| failed(&self.folder.join(NAME), &error))
    }

    /// Brings the list onto the disk.
    pub fn sync(&self) -> Result<(), String> {
        self.file.sync_data().map_err(|error| failed(&self.folder.join(NAME), &error))
    }

    /// What a file has been, the latest last.
    pub fn contents(&self, name: &str) -> &[Content] {
        self.contents.get(name).map_or(&[], Vec::as_slice)
    }

    /// Looks whether a file is as it was written, at any time.
    pub fn look(&self, name: &str) -> Found {
        let (path, contents) = (self.folder.join(name), self.contents(name));
        match fs::symlink_metadata(&path) {
            Err(_) => Found::Missing,
            Ok(_) if contents.is_empty() => Found::Unknown,
            Ok(about) if !about.is_file() => Found::Changed,
            Ok(about) => {
                let fits = contents.iter().filter(|content| content.bytes == about.len());
                let seen = fits.clone().next().and_then(|content| Content::of_file(&path, content.bytes));
                if fits.map(Some).any(|content| content == seen.as_ref()) { Found::Whole } else { Found::Changed }
            }
        }
    }

    /// The longest that a growing file was said to be and still begins with; none where it does not begin as it ever was.
    pub fn begins(&self, name: &str) -> Option<Content> {
        let path = self.folder.join(name);
        let holds = |content: &&Content| Content::of_file(&path, content.bytes).as_ref() == Some(*content);
        self.contents(name).iter().rev().find(holds).copied()
    }

    /// Names of all files that the list has.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.contents.keys().map(String::as_str)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scratch(name: &str) -> PathBuf {
        let folder = std::env::temp_dir().join(format!("lithosph-manifest-{name}-{}", std::process::id()));
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).unwrap();
        folder
    }

    #[test]
    fn files_are_told_from_what_others_left() {
        let folder = scratch("own");
        let mut manifest = Manifest::create(&folder, "a test").unwrap();
        for name in ["a b.txt", "changed", "gone", "turns"] {
            manifest.put(name, &[b"text of ", name.as_bytes()]).unwrap();
        }
        manifest.put("turns", &[b"later"]).unwrap();
        manifest.put("turns", &[b"text of turns"]).unwrap();
        fs::write(folder.join("changed"), "text of changes").unwrap();
        fs::write(folder.join("holiday"), "mine").unwrap();
        fs::remove_file(folder.join("gone")).unwrap();
        let manifest = Manifest::open(&folder).unwrap().unwrap();
        assert_eq!((manifest.about(), manifest.damaged.len()), ("a test", 0));
        let looks = ["a b.txt", "changed", "gone", "turns", "holiday"].map(|name| manifest.look(name));
        assert_eq!(looks, [Found::Whole, Found::Changed, Found::Missing, Found::Whole, Found::Unknown]);
        assert_eq!(manifest.names().collect::<Vec<_>>(), ["a b.txt", "changed", "gone", "turns"]);
        fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn a_growing_file_is_known_by_how_it_begins() {
        let folder = scratch("grows");
        let mut manifest = Manifest::create(&folder, "a test").unwrap();
        let text = b"one two three";
        for bytes in [3, 7] {
            manifest.note("x", Content::of(&[&text[..bytes]])).unwrap();
        }
        fs::write(folder.join("x"), text).unwrap();
        assert_eq!(manifest.begins("x").unwrap().bytes, 7);
        fs::write(folder.join("x"), b"one tWo three").unwrap();
        assert_eq!(manifest.begins("x").unwrap().bytes, 3);
        fs::write(folder.join("x"), b"on").unwrap();
        assert_eq!(manifest.begins("x"), None);
        fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn damage_to_the_list_is_noticed_and_a_torn_line_dropped() {
        let folder = scratch("damage");
        let mut manifest = Manifest::create(&folder, "a test").unwrap();
        manifest.put("x", &[b"one"]).unwrap();
        manifest.put("y", &[b"two"]).unwrap();
        let path = folder.join(NAME);
        let whole = fs::read_to_string(&path).unwrap();
        fs::write(&path, format!("{whole}torn")).unwrap();
        assert!(Manifest::open(&folder).unwrap().unwrap().damaged.is_empty());
        assert_eq!(fs::read_to_string(&path).unwrap(), whole);
        let second = whole.find('\n').unwrap() + 1;
        let title = "lithosph-manifest ".len();
        for place in (title..whole.len()).filter(|&place| whole.as_bytes()[place] != b'\n') {
            let mut bytes = whole.clone().into_bytes();
            bytes[place] ^= 1;
            fs::write(&path, bytes).unwrap();
            let damaged = Manifest::open(&folder).unwrap().unwrap().damaged;
            assert!(!damaged.is_empty() && (damaged[0] == 1) == (place < second), "{place}: {damaged:?}");
        }
        fs::write(&path, "my notes\n").unwrap();
        assert!(Manifest::open(&folder).unwrap_err().contains("no list of files"));
        fs::remove_dir_all(folder).unwrap();
    }
}
