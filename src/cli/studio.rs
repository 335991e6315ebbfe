//! `dam studio`: scenes changed in the browser.

use super::args::StudioArgs;
use super::failure::Failure;
use super::status::Status;

/// Serves the studio until the program ends.
#[cfg(feature = "studio")]
pub(crate) fn command(args: &StudioArgs) -> Result<Status, Failure> {
    let options = crate::studio::Options {
        target: args.target.clone(),
        port: args.port,
        open: !args.no_open,
    };
    crate::studio::serve(
        &options,
        &super::questions::Program,
        super::console::print_message,
    )?;
    Ok(Status::Answered)
}

/// Says how to get it.
#[cfg(not(feature = "studio"))]
pub(crate) fn command(_: &StudioArgs) -> Result<Status, Failure> {
    Err(Failure::Other(
        "this dam was built without its studio: build it with --features studio".to_owned(),
    ))
}
