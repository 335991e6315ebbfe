//! `dam` and general solvers side by side on the same problems.
//!
//! Made to be started by `peers/run`, which builds the CVODE program
//! and says what the options are.

#![allow(clippy::print_stdout, clippy::print_stderr)] // a program of its own

mod case;
mod cases;
mod chain;
mod cvode_peer;
mod diffsol_drive;
mod diffsol_peer;
mod exact_peer;
mod ladder;
mod map;
mod ode_solvers_peer;
mod peer;
mod press;
mod process;
mod solution;
mod table;
#[cfg(test)]
mod tests;

use cvode_peer::Cvode;
use std::path::Path;
use std::process::ExitCode;

/// The allocator of the program.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

const USAGE: &str = "peers cases|map|press [--only ABCDE] [--quick] [--cvode PROGRAM]";

/// What was asked for.
#[derive(Default)]
struct Options {
    part: String,
    only: Option<String>,
    cvode: Option<Cvode>,
    quick: bool,
}

fn options() -> Result<Options, String> {
    let mut options = Options::default();
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        let mut value = || arguments.next().ok_or(format!("{argument}: no value"));
        match argument.as_str() {
            "--quick" => options.quick = true,
            "--only" => options.only = Some(value()?),
            "--cvode" => options.cvode = Some(Cvode::at(Path::new(&value()?))),
            part if !part.starts_with('-') => options.part = part.to_owned(),
            other => return Err(format!("unknown option {other}")),
        }
    }
    Ok(options)
}

fn run() -> Result<(), String> {
    let options = options()?;
    let cvode = options.cvode.as_ref();
    match options.part.as_str() {
        "cases" => {
            let names = options.only.as_deref().unwrap_or("ABCDE");
            println!("{}", cases::cases(names, cvode, options.quick)?);
            Ok(())
        }
        "map" => {
            println!("{}", map::map(cvode, options.quick)?);
            Ok(())
        }
        "press" => {
            println!("{}", press::press(cvode, options.quick)?);
            Ok(())
        }
        other => Err(format!("unknown part {other}")),
    }
}

fn main() -> ExitCode {
    match run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}\nusage: {USAGE}");
            ExitCode::from(2)
        }
    }
}
