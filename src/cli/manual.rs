//! `dam completions` and `dam manual`: what a shell and a reader of manuals want to
//! know of the program, made from its arguments.

use super::args::{Cli, CompletionsArgs, ManualArgs};
use super::console;
use super::failure::Failure;
use super::status::Status;
use clap::CommandFactory;

/// Prints the completions of a shell.
pub(crate) fn completions(args: &CompletionsArgs) -> Result<Status, Failure> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut Cli::command(), "dam", &mut script);
    console::data(&String::from_utf8_lossy(&script))?;
    Ok(Status::Answered)
}

/// Prints the manual page of the program or of a command.
pub(crate) fn page(args: &ManualArgs) -> Result<Status, Failure> {
    let mut whole = Cli::command();
    whole.build();
    let mut command = &whole;
    for name in &args.command {
        command = command.find_subcommand(name).ok_or_else(|| {
            let known = command.get_subcommands().map(clap::Command::get_name);
            let known: Vec<&str> = known.collect();
            format!("there is no command `{name}`; one of {}", known.join(", "))
        })?;
    }
    let mut page = Vec::new();
    clap_mangen::Man::new(command.clone())
        .render(&mut page)
        .map_err(|error| error.to_string())?;
    console::data(&String::from_utf8_lossy(&page))?;
    Ok(Status::Answered)
}
