//! Command line of lithosph; see [`lithosph::cli`].

fn main() {
    // SAFETY: no other thread runs yet.
    unsafe { lithosph::backend::device::quiet_drivers() };
    std::process::exit(lithosph::cli::main());
}
