//! The `dam` program: all of it is in the library, so that what both need is compiled once.

#[cfg(feature = "mimalloc")]
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> std::process::ExitCode {
    dam::cli::main()
}
