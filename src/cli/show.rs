//! `dam show`: the three models of a scene.

use super::args::{ShowArgs, ShowForm, View};
use super::console;
use super::failure::Failure;
use super::input::Input;
use super::status::Status;
use crate::report::show::scene::{ShownForm, ShownPart, check_form, document, show};

/// Runs the command.
pub(crate) fn command(args: &ShowArgs) -> Result<Status, Failure> {
    let (part, form) = (part(args.view), form(args.form));
    check_form(part, form)?;
    let ready = Input::load(&args.scene)?.prepare_and_warn(args.scene.quiet)?;
    let (system, settings) = (&ready.system, &ready.settings);
    match args.scene.json {
        true => console::json(&document(&ready.scene().name, system, settings))?,
        false => console::print_text(&show(part, form, system, settings)?)?,
    }
    Ok(Status::Answered)
}

fn part(view: View) -> ShownPart {
    match view {
        View::All => ShownPart::All,
        View::Graph => ShownPart::Graph,
        View::Model => ShownPart::Model,
        View::Equations => ShownPart::Equations,
    }
}

fn form(form: ShowForm) -> ShownForm {
    match form {
        ShowForm::Text => ShownForm::Text,
        ShowForm::Dot => ShownForm::Dot,
        ShowForm::Svg => ShownForm::Svg,
        ShowForm::Latex => ShownForm::Latex,
    }
}
