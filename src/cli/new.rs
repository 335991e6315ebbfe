//! `dam new`: a scene to begin with.

use super::args::NewArgs;
use super::console;
use super::failure::Failure;
use super::status::Status;
use std::fs::File;
use std::io::Write;

/// Writes a template into a new file, or shows it.
pub(crate) fn command(args: &NewArgs) -> Result<Status, Failure> {
    let text = args.template.text();
    let Some(path) = &args.file else {
        console::data(text)?;
        return Ok(Status::Answered);
    };
    let shown = path.display();
    // Nobody's file is overwritten.
    let mut file = File::create_new(path)
        .map_err(|error| format!("cannot make the scene `{shown}`: {error}"))?;
    file.write_all(text.as_bytes())
        .and_then(|()| file.sync_all())
        .map_err(|error| Failure::Output(format!("cannot write `{shown}`: {error}")))?;
    console::print_message(&format!("scene: {shown}; try `dam run {shown}`"));
    Ok(Status::Answered)
}
