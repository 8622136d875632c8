//! Signals that ask a run to end.

use signal_hook::consts as signal;
use signal_hook::low_level;
use std::io;
use std::sync::atomic::{AtomicBool, Ordering};

#[cfg(unix)]
const ENDING: [i32; 4] = [signal::SIGINT, signal::SIGTERM, signal::SIGHUP, signal::SIGQUIT];
#[cfg(not(unix))]
const ENDING: [i32; 2] = [signal::SIGINT, signal::SIGTERM];

/// Raises a flag at the first such signal; a second ends the process at once.
pub fn listen(flag: &'static AtomicBool) -> io::Result<()> {
    for number in ENDING.into_iter().filter(|&number| !is_ignored(number)) {
        let answer = || {
            if flag.swap(true, Ordering::Relaxed) {
                low_level::exit(130);
            }
        };
        // SAFETY: a swap of an atomic flag and an exit at once are allowed in a signal handler.
        unsafe { low_level::register(number, answer) }?;
    }
    Ok(())
}

/// Whether whoever started us wants a hang-up passed over, as `nohup` does, or a quit.
#[cfg(unix)]
fn is_ignored(number: i32) -> bool {
    // SAFETY: all zeros are a valid action, and one that is only asked for changes nothing.
    let (asked, action) = unsafe {
        let mut action: libc::sigaction = std::mem::zeroed();
        (libc::sigaction(number, std::ptr::null(), &raw mut action), action)
    };
    matches!(number, signal::SIGHUP | signal::SIGQUIT) && asked == 0 && action.sa_sigaction == libc::SIG_IGN
}

#[cfg(not(unix))]
fn is_ignored(_: i32) -> bool {
    false
}
