//! `dam cam`: the cam of an object in a scene.

mod lift_off;
mod question;

use super::answer::{Answer, AnswerForm, Content, PAGE, files};
use super::args::{CamArgs, CamForm};
use super::asker::Asker;
use super::console;
use super::expected::Expectations;
use super::failure::Failure;
use super::input::Ready;
use super::interrupt;
use super::law::argument_failure;
use super::output::OutputFolder;
use super::status::Status;
use crate::kinematics::cam::DiscCam;
use crate::report::cam::{CamReport, curves, cycle_rows, dxf, findings, picture, polygon_rows};
use crate::report::findings::Source;
use crate::studies::Control;
use crate::studies::cam::{CamForce, ElasticContact, disc_cam, figures, objects_with_cam};
use crate::studies::lookup::{Subject, check_cam};

const FILES: [&str; 6] = [
    "cam.json",
    "cycle.csv",
    "profile.csv",
    "profile.dxf",
    "cam.svg",
    PAGE,
];

/// Rows of the cycle's table in a turn.
const ROWS: usize = 720;

/// Runs the command.
pub(crate) fn command(args: &CamArgs, asker: &dyn Asker) -> Result<Status, Failure> {
    let input = asker.input(&args.scene)?;
    let ready = input.prepare_and_warn(args.scene.quiet)?;
    let id = chosen_object(args, &ready)?;
    let folder = OutputFolder::from_args(&args.out, &ready.scene().name, &FILES)?;
    let model = ready.system.model();
    let diagnose = |faults: Vec<crate::fault::Fault>| ready.reading.places.diagnose(&faults);
    let cam = disc_cam(ready.scene(), model, &id).map_err(diagnose)?;
    let asked = question::read(args, &cam)?;
    let index = model.objects.iter().position(|part| part.id == id);
    let index = index.ok_or_else(|| format!("there is no object `{id}`"))?;
    let force = CamForce::new(model, index, &cam, asked.speed);
    let force_or_why = force.as_ref().map_err(String::as_str);
    let mut found = figures(&cam, &asked.question, force_or_why)
        .map_err(|faults| argument_failure(&faults, "--"))?;
    let closed = found
        .force
        .as_ref()
        .and_then(|force| force.closing.as_ref());
    if args.reserve.is_some() && closed.is_none() {
        let why = "--reserve has no effect: no force keeps this contact closed";
        return Err(Failure::Other(why.to_owned()));
    }
    let mut status = Status::Answered;
    let _keeping = args.lift_off.then(|| asker.guard_from_interrupt());
    if args.lift_off {
        let search = lift_off::search_of(&ready, &id, force.as_ref().ok())?;
        match lift_off::search((args, asker), &ready, &search)? {
            Some(speed) => {
                if let Some(force) = &mut found.force {
                    force.elastic = Some(speed);
                    let contact = ElasticContact {
                        system: &ready.system,
                        object: index,
                        settings: &ready.settings,
                        control: asker.budget(),
                    };
                    let is_elastic = force.rigid.is_some();
                    let elastic = is_elastic.then(|| contact.figures_at(force.speed));
                    force.elastic_contact = elastic.flatten();
                    if is_elastic {
                        let note = lift_off::note_on_start(&contact, &search, speed);
                        force.notes.extend(note);
                    }
                }
            }
            None => {
                status = interrupt::status();
                if let (Some(spent), false) = (asker.budget().spent(), args.scene.quiet) {
                    console::print_message(&format!(
                        "warning: the search for the lift-off of the elastic follower was ended \
                         before it had found it ({spent}): it is missing"
                    ));
                }
            }
        }
    }
    let curves = curves(&cam, asked.tolerance, asked.cutter);
    let curves = curves.map_err(|fault| argument_failure(&[fault], "--"))?;
    let (name, hash) = (&ready.scene().name, &ready.scene().hash);
    let report = CamReport {
        name,
        id: &id,
        cam: &cam,
        figures: &found,
        force: force.as_ref().ok(),
        curves: &curves,
        tolerance: asked.tolerance,
    };
    let expected = expectations((args, asker.budget()), &ready, (&id, &cam));
    let answer = Answer {
        command: "cam",
        findings: &findings(&report, Source::scene(input.text(), hash)),
        document: expected.add_verdicts(report.document(hash)).into(),
        files: files(
            FILES,
            [
                Content::Document,
                Content::made(|| cycle_rows(&cam, found.unit, report.force, ROWS).csv()),
                Content::made(|| polygon_rows(&curves).csv()),
                Content::made(|| dxf(&curves, cam.geometry().base_radius)),
                Content::made(|| picture(&id, &cam, cam.motion().range().0)),
                Content::Page,
            ],
        ),
        quiet: args.scene.quiet,
    };
    let shown = match args.form {
        CamForm::Text => AnswerForm::Text,
        CamForm::Cycle => AnswerForm::File(FILES[1]),
        CamForm::Profile => AnswerForm::File(FILES[2]),
        CamForm::Dxf => AnswerForm::File(FILES[3]),
        CamForm::Svg => AnswerForm::File(FILES[4]),
    };
    let shown = AnswerForm::json_or(args.scene.json, shown);
    asker.deliver(&answer, folder.as_ref(), shown)?;
    if !args.scene.quiet {
        expected.print_verdicts();
    }
    Ok(match (status, expected.all_hold()) {
        (Status::Answered, false) => Status::NotTrusted,
        (status, _) => status,
    })
}

/// Another mechanism than the scene's, or another speed, has no expectations.
fn expectations<'r>(
    (args, control): (&CamArgs, &Control<'_>),
    ready: &'r Ready,
    (id, cam): (&str, &DiscCam),
) -> Expectations<'r> {
    let as_scene = args.scene.set.is_empty() && args.speed.is_none();
    let all = &ready.scene().expect;
    Expectations::judge_scene("cam", all, as_scene, |all| {
        let subject = Subject {
            scene: ready.scene(),
            system: &ready.system,
            settings: &ready.settings,
            control,
        };
        check_cam(all, subject, (id, cam))
    })
}

/// The object asked for, or the only one with a cam.
fn chosen_object(args: &CamArgs, ready: &Ready) -> Result<String, Failure> {
    if let Some(id) = &args.object {
        return Ok(id.clone());
    }
    match objects_with_cam(ready.scene()).as_slice() {
        [only] => Ok((*only).to_owned()),
        [] => Err(Failure::Other(
            "no object of the scene describes its cam: give a cam follower or rocker the property \
             `cam`, as in \"cam\": { \"base_radius\": \"20 mm\", \"contact\": { \"roller\": \"8 \
             mm\" } }"
                .to_owned(),
        )),
        several => Err(Failure::Other(format!(
            "several objects describe their cam: choose one with --object ({})",
            several.join(", ")
        ))),
    }
}
