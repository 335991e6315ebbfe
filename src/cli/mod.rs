//! The command-line program: arguments, files, terminal. Everything else is in
//! the library.

mod args;
mod cam;
mod check;
mod compare;
mod console;
mod expected;
mod failure;
mod forces;
mod input;
mod interrupt;
mod journal;
mod kinematics;
mod law;
mod map;
mod methods;
mod output;
mod progress;
mod run;
mod show;
mod steady;
mod tables;
mod terminal;

use args::{Cli, Command};
use clap::Parser;
use std::process::ExitCode;

/// Runs the program.
pub(crate) fn main() -> ExitCode {
    let cli = Cli::parse();
    let (result, scene) = match &cli.command {
        Command::Run(args) => (run::command(args), Some(&args.scene)),
        Command::Check(args) => (check::command(args), Some(&args.scene)),
        Command::Schema => (Ok(check::schema()), None),
        Command::Show(args) => (show::command(args), Some(&args.scene)),
        Command::Compare(args) => (compare::command(args), Some(&args.scene)),
        Command::Law(args) => (law::command(args), None),
        Command::Cam(args) => (cam::command(args), Some(&args.scene)),
        Command::Map(args) => (map::command(args), Some(&args.scene)),
        Command::Methods(args) => (methods::command(args), Some(&args.scene)),
        Command::Kinematics(args) => (kinematics::command(args), Some(&args.scene)),
        Command::Steady(args) => (steady::command(args), None),
        Command::Forces(args) => (forces::command(args), Some(&args.scene)),
    };
    match result {
        Ok(status) => ExitCode::from(status.code()),
        Err(failure) => {
            let json = match &cli.command {
                Command::Law(args) => args.json(),
                Command::Steady(args) => args.json,
                _ => scene.is_some_and(|args| args.json),
            };
            report(&failure, json);
            ExitCode::from(2)
        }
    }
}

fn report(failure: &failure::Failure, json: bool) {
    if json && console::json(&failure.json()).is_ok() {
        return;
    }
    console::talk(&failure.text(console::colour()));
}
