//! The `dam` program: all of it is in the library, so that what both need is compiled once.

fn main() -> std::process::ExitCode {
    dam::cli::main()
}
