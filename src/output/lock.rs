//! One writer for a folder. The system lets go of the lock however the program ends, so that none is left behind by a kill.

use super::durable::failed;
use fs4::{FileExt, TryLockError};
use std::fs::{self, File, OpenOptions};
use std::io::{ErrorKind, Read, Seek, Write};
use std::path::{Path, PathBuf};

/// Its name in the folder.
pub const NAME: &str = "lock";

/// Keeps all other runs out of a folder until it is dropped.
#[derive(Debug)]
pub struct Lock {
    path: PathBuf,
    file: File,
}

/// Why a folder was not taken, as a sentence.
#[derive(Debug)]
pub enum Refusal {
    /// Another process has it, which the sentence names.
    Taken(String),
    /// The disk, or the file system, does not let us.
    Failed(String),
}

impl Lock {
    /// Takes the folder.
    pub fn take(folder: &Path) -> Result<Self, Refusal> {
        let no = |path: &Path, error: &std::io::Error| Refusal::Failed(failed(path, error));
        let path = folder.join(NAME);
        loop {
            let opened = OpenOptions::new().read(true).write(true).create(true).truncate(false).open(&path);
            let mut file = opened.map_err(|error| no(&path, &error))?;
            match FileExt::try_lock(&file) {
                Ok(()) => {}
                Err(TryLockError::WouldBlock) => {
                    return Err(Refusal::Taken(format!(
                        "{} is being written by {}: wait for its end, or choose another folder with --out",
                        folder.display(),
                        owner(&mut file)
                    )));
                }
                // Some network file systems have no locks: better a run without than none.
                Err(TryLockError::Error(error)) if error.kind() == ErrorKind::Unsupported => {}
                Err(TryLockError::Error(error)) => return Err(no(&path, &error)),
            }
            // The one that had it may have taken the file away after we opened it.
            if is_same(&file, &path) {
                sign(&mut file).map_err(|error| no(&path, &error))?;
                return Ok(Self { path, file });
            }
        }
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        // Before it is let go, so that nobody else's is taken away.
        let _ = fs::remove_file(&self.path);
        let _ = FileExt::unlock(&self.file);
    }
}

/// Writes who we are, for people and for the sentence of one that comes second.
fn sign(file: &mut File) -> std::io::Result<()> {
    let host = fs::read_to_string("/proc/sys/kernel/hostname").unwrap_or_default();
    let place = if host.trim().is_empty() { String::new() } else { format!(" on {}", host.trim()) };
    file.set_len(0)?;
    file.write_all(format!("process {}{place}\n", std::process::id()).as_bytes())
}

fn owner(file: &mut File) -> String {
    let mut text = String::new();
    let read = file.rewind().and_then(|()| file.take(200).read_to_string(&mut text));
    let line = text.lines().next().unwrap_or_default();
    if read.is_ok() && line.starts_with("process ") { line.to_string() } else { "another process".into() }
}

#[cfg(unix)]
fn is_same(file: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let identity = |about: fs::Metadata| (about.dev(), about.ino());
    matches!((file.metadata().map(identity), fs::metadata(path).map(identity)), (Ok(ours), Ok(theirs)) if ours == theirs)
}

/// A file that is open cannot be taken away.
#[cfg(not(unix))]
fn is_same(_: &File, _: &Path) -> bool {
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_at_a_time_and_whoever_died_left_nothing_in_the_way() {
        let folder = std::env::temp_dir().join(format!("lithosph-lock-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        // What a killed run leaves.
        fs::write(folder.join(NAME), "process 1 on elsewhere\n").unwrap();
        let first = Lock::take(&folder).unwrap();
        let Err(Refusal::Taken(refused)) = Lock::take(&folder) else { panic!("two have it") };
        assert!(refused.contains(&format!("process {}", std::process::id())) && refused.contains("--out"), "{refused}");
        drop(first);
        assert!(!folder.join(NAME).exists());
        drop(Lock::take(&folder).unwrap());
        fs::remove_dir_all(folder).unwrap();
    }
}
