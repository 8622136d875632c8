//! Why a run ends early, and the exit code of the command that asked for it.

use crate::output::lock::Refusal;
use std::path::Path;

/// Why a run ended before its time.
#[derive(Debug)]
pub enum Stop {
    /// Bad input: exit code 2.
    Refused(String),
    /// Went wrong: exit code 1.
    Failed(String),
    /// By the user: exit code 130.
    Interrupted(String),
}

impl Stop {
    /// Why a folder could not be taken.
    pub(super) fn of(refusal: Refusal) -> Self {
        match refusal {
            Refusal::Taken(reason) => Self::Refused(reason),
            Refusal::Failed(reason) => Self::Failed(reason),
        }
    }

    /// Why a folder could not be made: a disk that is full, or fails, is no fault of the name that was typed.
    pub(super) fn of_folder(folder: &Path, error: &std::io::Error) -> Self {
        let reason = crate::output::durable::failed(folder, error);
        match error.raw_os_error() {
            Some(libc::ENOSPC | libc::EDQUOT | libc::EIO) => Self::Failed(reason),
            _ => Self::Refused(reason),
        }
    }
}
