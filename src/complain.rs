//! What is said on standard error, whose reader may be gone.

use std::io::Write;

/// Says a line. That nobody listens any more is no reason to break off a run, as `eprintln` would.
pub fn complain(line: &str) {
    let _ = writeln!(std::io::stderr(), "{line}");
}
