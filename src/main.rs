//! Command line of lithosph; see [`lithosph::cli`].

fn main() {
    std::process::exit(lithosph::cli::main());
}
