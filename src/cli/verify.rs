//! `dam verify`: whether scenes meet what they expect, by every study that it takes.

use super::args::scene::SceneArgs;
use super::args::{VerifyArgs, VerifyForm};
use super::console;
use super::failure::Failure;
use super::input::{Input, print_doubts};
use super::interrupt;
use super::status::Status;
use crate::ask::ModelAssessment;
use crate::report::quantity::counted;
use crate::report::requirements::{VerifiedScene, document, findings, junit, suite};
use std::path::Path;

/// Runs the command.
pub(crate) fn command(args: &VerifyArgs) -> Result<Status, Failure> {
    let _keeping = interrupt::hold_interrupt();
    let (mut all, mut wrong, mut suites) = (Vec::new(), Vec::new(), Vec::new());
    for path in &args.scenes {
        let one = match verified(args, path) {
            Ok(one) => one,
            Err(failure) => {
                let file = path.display().to_string();
                let why = failure.message();
                wrong.push(failure);
                VerifiedScene {
                    scene: file.clone(),
                    file,
                    requirements: Err(why),
                }
            }
        };
        // (In its own units.)
        suites.push(suite(&one));
        if !args.json && args.form == VerifyForm::Text && one.requirements.is_ok() {
            console::findings(&findings(&one))?;
        }
        all.push(one);
        if interrupt::budget().is_spent() {
            break;
        }
    }
    match (args.json, args.form) {
        (true, _) => console::json(&document(&all))?,
        (false, VerifyForm::Junit) => {
            console::data(&junit(&suites))?;
        }
        (false, VerifyForm::Text) => {}
    }
    for failure in &wrong {
        failure.print_message();
    }
    let expects = all.iter().any(|one| one.held_and_all()[1] > 0);
    if !args.quiet {
        let [held, count] = all
            .iter()
            .map(VerifiedScene::held_and_all)
            .fold([0, 0], |sum, one| [sum[0] + one[0], sum[1] + one[1]]);
        let scenes = counted(all.len() - wrong.len(), "scene");
        let refused = match wrong.len() {
            0 => String::new(),
            count => format!("; {} refused", counted(count, "scene")),
        };
        console::print_message(&format!(
            "{held} of {} in {scenes} hold{refused}",
            counted(count, "requirement")
        ));
        if !expects && wrong.is_empty() {
            console::print_message("no scene expects anything: `expect` says what a scene must do");
        }
    }
    if interrupt::budget().is_spent() {
        return Ok(interrupt::status());
    }
    if !wrong.is_empty() {
        return Ok(Status::WrongScene);
    }
    Ok(match expects && all.iter().all(VerifiedScene::holds) {
        true => Status::Answered,
        false => Status::NotTrusted,
    })
}

fn verified(args: &VerifyArgs, path: &Path) -> Result<VerifiedScene, Failure> {
    let scene = SceneArgs {
        set: args.set.clone(),
        ..SceneArgs::of(path)
    };
    let ready = Input::load(&scene)?.prepare_judging(&[], ModelAssessment::Asked)?;
    print_doubts(&ready.reading, args.quiet);
    let requirements = ready.verify_within(interrupt::budget())?;
    Ok(VerifiedScene {
        file: path.display().to_string(),
        scene: ready.scene().name.clone(),
        requirements: Ok(requirements),
    })
}
