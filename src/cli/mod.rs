//! The command-line program: arguments, files, terminal. Everything else is in
//! the library.
//!
//! The program is a module of the library: `dam::cli::main` is all that `src/main.rs` calls, so
//! that what both need is compiled once. The library prints nothing; terminal, progress and
//! results are handled here. The program, not the library, allocates with `mimalloc` (a
//! feature, on by default): a run allocates some hundreds of small arrays, which for a cell of
//! a map was a sixth of the instructions.

mod accuracy;
mod answer;
mod args;
mod asker;
mod bar;
mod cam;
mod check;
mod compare;
mod console;
mod described;
mod expected;
mod failure;
mod find;
mod forces;
mod gradient;
mod identify;
mod input;
mod interrupt;
mod journal;
mod kinematics;
mod law;
mod linearise;
mod manual;
mod map;
mod methods;
mod new;
mod optimize;
mod orders;
mod output;
mod progress;
mod quantity;
#[cfg(feature = "live")]
pub(crate) mod questions;
mod reduce;
mod response;
mod run;
mod show;
mod shown;
mod status;
mod steady;
mod studio;
mod tolerance;
mod verify;

use args::{Cli, Command};
use asker::Terminal;
use clap::Parser;
use failure::Failure;
use status::Status;
use std::ffi::OsString;
use std::process::ExitCode;
use std::time::Duration;

/// Runs the program.
pub fn main() -> ExitCode {
    ExitCode::from(main_with(std::env::args_os()))
}

/// Runs the program with these arguments, of which the first is its name; its exit status.
pub fn main_with(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    let cli = match Cli::try_parse_from(arguments) {
        Ok(cli) => cli,
        Err(told) => return without_command(&told),
    };
    let json = cli.command.json();
    interrupt::start(cli.time_limit.map(Duration::from_secs_f64), json);
    shown::start(cli.units, cli.significant.map(usize::from));
    match run(&cli.command) {
        Ok(status) => status.code(),
        Err(failure) => {
            report(&failure, json);
            failure.code()
        }
    }
}

fn run(command: &Command) -> Result<Status, Failure> {
    match command {
        Command::Run(args) => run::command(args, &Terminal),
        Command::Check(args) => check::command(args),
        Command::Schema(args) => check::print_schema(args),
        Command::New(args) => new::command(args),
        Command::Completions(args) => manual::completions(args),
        Command::Manual(args) => manual::page(args),
        Command::Verify(args) => verify::command(args),
        Command::Show(args) => show::command(args),
        Command::Compare(args) => compare::command(args),
        Command::Find(args) => find::command(args, &Terminal),
        Command::Gradient(args) => gradient::command(args),
        Command::Optimize(args) => optimize::command(args),
        Command::Tolerance(args) => tolerance::command(args, &Terminal),
        Command::Identify(args) => identify::command(args),
        Command::Reduce(args) => reduce::command(args, &Terminal),
        Command::Law(args) => law::command(args, &Terminal),
        Command::Linearise(args) => linearise::command(args, &Terminal),
        Command::Response(args) => response::command(args, &Terminal),
        Command::Orders(args) => orders::command(args, &Terminal),
        Command::Cam(args) => cam::command(args, &Terminal),
        Command::Map(args) => map::command(args),
        Command::Methods(args) => methods::command(args, &Terminal),
        Command::Kinematics(args) => kinematics::command(args, &Terminal),
        Command::Steady(args) => steady::command(args, &Terminal),
        Command::Forces(args) => forces::command(args, &Terminal),
        Command::Studio(args) => studio::command(args),
    }
}

/// The program in a browser tab, which has no server.
#[cfg(feature = "live")]
pub fn tab() -> crate::studio::tab::Tab {
    crate::studio::tab::Tab::new(&questions::Program)
}

/// Help, the version, or what is wrong with the arguments.
fn without_command(told: &clap::Error) -> u8 {
    let words = told.render().to_string();
    if told.use_stderr() {
        console::print_message(&words);
        return 2;
    }
    match console::print_text(&words) {
        Ok(()) => 0,
        Err(failure) => {
            failure.print_message();
            failure.code()
        }
    }
}

/// Tells why a command came to nothing: programs on standard output, people on
/// standard error.
fn report(failure: &Failure, json: bool) {
    if json && console::json(&failure.json()).is_ok() {
        return;
    }
    failure.print_message();
}
