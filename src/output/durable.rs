//! Files that are whole or absent, whatever ends the program: written aside, synced and renamed, each call's result looked at.
//!
//! Nothing else in this program writes what a run keeps, but for rows at the end of a series ([`super::csv::Series`]) and lines
//! at the end of a manifest ([`super::manifest::Manifest`]).

use std::fs::{self, File};
use std::io::{self, ErrorKind, Read, Write};
use std::path::{Path, PathBuf};

/// Puts a file that consists of some parts into its folder, which must be there. A file that holds these very bytes is left
/// alone. The error is a sentence with the path and the system's reason; what was there before is there still.
pub fn put(path: &Path, parts: &[&[u8]]) -> Result<(), String> {
    if holds(path, parts) {
        return Ok(());
    }
    let part = aside(path);
    let put = write(&part, parts).and_then(|()| fs::rename(&part, path)).and_then(|()| sync_folder(path));
    put.map_err(|error| {
        // The disk may be full: what is of no use gives its room back.
        let _ = fs::remove_file(&part);
        failed(path, &error)
    })
}

/// [`put`], where what was there before takes another name in the same folder.
pub fn put_and_keep(path: &Path, parts: &[&[u8]], previous: &Path) -> Result<(), String> {
    let part = aside(path);
    let renamed = || fs::rename(path, previous).and_then(|()| fs::rename(&part, path)).and_then(|()| sync_folder(path));
    write(&part, parts).and_then(|()| renamed()).map_err(|error| {
        let _ = fs::remove_file(&part);
        failed(path, &error)
    })
}

/// The name under which a file is written before it takes its own: `x.png` becomes `x.png.part`.
pub fn aside(path: &Path) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(".part");
    name.into()
}

/// The sentence for a file that could not be written.
pub fn failed(path: &Path, error: &io::Error) -> String {
    format!("cannot write {}: {error}", path.display())
}

fn write(path: &Path, parts: &[&[u8]]) -> io::Result<()> {
    let mut file = File::create(path)?;
    parts.iter().try_for_each(|part| file.write_all(part))?;
    file.sync_all()
}

/// Brings a name onto the disk. A network file system that cannot sync a folder says so, and does it by itself.
fn sync_folder(path: &Path) -> io::Result<()> {
    if !cfg!(unix) {
        return Ok(());
    }
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    match File::open(folder)?.sync_all() {
        Err(error) if matches!(error.kind(), ErrorKind::InvalidInput | ErrorKind::Unsupported) => Ok(()),
        synced => synced,
    }
}

/// Whether a file consists of these bytes.
pub fn holds(path: &Path, parts: &[&[u8]]) -> bool {
    let length: usize = parts.iter().map(|part| part.len()).sum();
    let Ok(mut file) = File::open(path) else { return false };
    if !file.metadata().is_ok_and(|about| about.is_file() && about.len() == length as u64) {
        return false;
    }
    let mut block = vec![0; 1 << 16];
    parts.iter().flat_map(|part| part.chunks(1 << 16)).all(|wanted| {
        let seen = &mut block[..wanted.len()];
        file.read_exact(seen).is_ok() && seen == wanted
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scratch(name: &str) -> PathBuf {
        let folder = std::env::temp_dir().join(format!("lithosph-durable-{name}-{}", std::process::id()));
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).unwrap();
        folder
    }

    #[test]
    fn parts_become_one_file_and_nothing_lies_aside() {
        let folder = scratch("parts");
        put(&folder.join("x"), &[b"one", b"", b"two"]).unwrap();
        put(&folder.join("x"), &[b"three", b"four"]).unwrap();
        assert_eq!(fs::read(folder.join("x")).unwrap(), b"threefour");
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 1);
        fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn a_file_of_the_same_bytes_is_left_alone() {
        let folder = scratch("same");
        let path = folder.join("x");
        put(&path, &[b"one two"]).unwrap();
        let before = fs::metadata(&path).unwrap().modified().unwrap();
        put(&path, &[b"one", b" two"]).unwrap();
        assert_eq!(fs::metadata(&path).unwrap().modified().unwrap(), before);
        assert!(!holds(&path, &[b"one"]) && !holds(&path, &[b"one tw", b"O"]));
        fs::remove_dir_all(folder).unwrap();
    }

    #[test]
    fn what_cannot_be_written_leaves_what_was_there() {
        let folder = scratch("failed");
        let path = folder.join("x");
        put(&path, &[b"old"]).unwrap();
        // A folder lies where the file would be written aside.
        fs::create_dir(aside(&path)).unwrap();
        let error = put(&path, &[b"new"]).unwrap_err();
        assert!(error.starts_with("cannot write ") && error.contains("x: "), "{error}");
        assert_eq!(fs::read(&path).unwrap(), b"old");
        assert!(put(&folder.join("missing/x"), &[b"new"]).unwrap_err().contains("missing/x"));
        fs::remove_dir_all(folder).unwrap();
    }
}
