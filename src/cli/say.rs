//! What a command prints.

use std::io::Write;

/// Prints to a reader that may be gone: `lithosph list | head` is no error.
pub(super) fn say(text: &str) {
    let _ = writeln!(std::io::stdout(), "{text}");
}
