//! `dam kinematics`: positions, transfer functions, speeds and accelerations of
//! a linkage.

pub(super) mod multi_input;

use super::answer::{Answer, AnswerForm, Content, PAGE, add_warning, ignores_until};
use super::args::{CourseArgs, KinematicsArgs};
use super::asker::Asker;
use super::expected::Expectations;
use super::failure::Failure;
use super::input::Ready;
use super::output::OutputFolder;
use super::status::Status;
use crate::dynamics::model::Coordinate;
use crate::frontend::object::Measures;
use crate::frontend::object::law::read_argument;
use crate::frontend::read::{Bounds, QuantityChoice};
use crate::kinematics::linkage::Linkage;
use crate::report::findings::Source;
use crate::report::kinematics::{document, drawing, findings, picture, rows};
use crate::studies::kinematics::{
    AskedSeveral, Kinematics, KinematicsRequest, Over, Question, Subject, kinematics,
    multi_input_kinematics, several_of, whole_travel,
};
use crate::studies::rigid::Rigid;
use crate::studies::studied::{POSITIONS, check_kinematics};
use crate::units::quantities as q;
use crate::units::with_common_unit;

const FILES: [&str; 4] = ["kinematics.csv", "kinematics.json", "mechanism.svg", PAGE];

/// Runs the command.
pub(crate) fn command(args: &KinematicsArgs, asker: &dyn Asker) -> Result<Status, Failure> {
    let input = asker.input(&args.scene)?;
    let ready = input.prepare_and_warn(args.scene.quiet)?;
    let model = ready.system.model();
    let object = args.course.object.as_deref();
    let (question, found) = match several_of(model, object) {
        Some(body) => {
            let mut question =
                multi_input::question(&args.course, args.positions, &ready, &body.linkage)?;
            if let Some(at) = &args.svg {
                question.also = Some(multi_input::read_picture_place(
                    &question,
                    at,
                    &body.linkage,
                )?);
            }
            let asked = AskedSeveral::new(model, body, &question)?;
            (question, Study::Several(asked))
        }
        None => {
            let subject = Subject::of(model, object)?;
            let own = Measures(Some(subject.input));
            let over = requested_range(&args.course, &ready, own)?;
            let mut question = question(&args.course, args.positions, &ready, own)?;
            question.over = over;
            if let Some(at) = &args.svg {
                read_picture_place(&mut question, at, &subject.linkage, subject.input)?;
            }
            let asked = KinematicsRequest::of(model, subject, &question)?;
            (question, Study::One(asked))
        }
    };
    let folder = OutputFolder::from_args(&args.out, &ready.scene().name, &FILES)?;
    let found = match &found {
        Study::One(asked) => kinematics(asked),
        Study::Several(asked) => multi_input_kinematics(asked),
    };
    let expected = expectations(args, &ready, &found);
    let (name, hash) = (&ready.scene().name, &ready.scene().hash);
    let at = question.also;
    let at = at.and_then(|at| found.axis.values.iter().position(|&place| place == at));
    if args.svg.is_some() && at.is_none() {
        let why = "the linkage cannot be assembled at that place";
        return Err(why.to_owned().into());
    }
    let label = Rigid::label(model, &["dam run"]);
    let mut shown = findings(name, &found, Source::scene(input.text(), hash));
    shown.label(label.as_ref(), "positions, speeds and accelerations are");
    let mut written = document(name, hash, &found);
    shown.judge(&mut written, label.as_ref());
    add_warning(&mut shown, &mut written, ignores_until(model));
    let answer = Answer {
        command: "kinematics",
        findings: &shown,
        document: expected.add_verdicts(written).into(),
        files: vec![
            (FILES[0].into(), Content::made(|| rows(&found).csv())),
            (FILES[1].into(), Content::Document),
            (FILES[2].into(), Content::made(|| drawing(&found).svg(0))),
            (FILES[3].into(), Content::Page),
        ],
        quiet: args.scene.quiet,
    };
    let shown = match (at, args.scene.json, args.csv) {
        (Some(row), ..) => AnswerForm::Made(picture(&found, row)),
        (_, true, _) => AnswerForm::Json,
        (_, _, true) => AnswerForm::File(FILES[0]),
        _ => AnswerForm::Text,
    };
    asker.deliver(&answer, folder.as_ref(), shown)?;
    if !args.scene.quiet {
        expected.print_verdicts();
    }
    let whole = found.stopped.is_none() && found.warnings.is_empty();
    Ok(match whole && expected.all_hold() {
        true => Status::Answered,
        false => Status::NotTrusted,
    })
}

/// What is studied: a linkage of one input or of several.
enum Study<'a> {
    One(KinematicsRequest<'a>),
    Several(AskedSeveral<'a>),
}

/// Another mechanism than the scene's, or another question, has no expectations.
fn expectations<'r>(
    args: &KinematicsArgs,
    ready: &'r Ready,
    found: &Kinematics,
) -> Expectations<'r> {
    let as_scene = args.scene.set.is_empty()
        && args.course.is_of_scene()
        && args.svg.is_none()
        && args.positions as usize == POSITIONS;
    let all = &ready.scene().expect;
    Expectations::judge_scene("kinematics", all, as_scene, |all| {
        check_kinematics(all, found)
    })
}

pub(super) fn quantity(name: &str, text: &str, wanted: QuantityChoice) -> Result<f64, Failure> {
    Ok(read_argument(name, text, |slot| {
        slot.quantity(wanted, Bounds::ANY)
    })?)
}

/// Course over which the linkage is to be looked at, where it is said.
pub(super) fn requested_range(
    args: &CourseArgs,
    ready: &Ready,
    input: Measures,
) -> Result<Option<Over>, Failure> {
    match &args.range {
        Some(range) => range_of(range, input).map(Some),
        None => Ok(time(args, ready)?.or(args.turn.then_some(Over::Turn))),
    }
}

/// The time asked for.
fn time(args: &CourseArgs, ready: &Ready) -> Result<Option<Over>, Failure> {
    let to = match args.time.as_deref() {
        None => return Ok(None),
        Some("") => ready.settings.duration,
        Some(time) => quantity("--time", time, q::TIME.into())?,
    };
    Ok(Some(Over::Time { to }))
}

/// What is asked of a linkage of one input, but for what it is looked at over.
pub(super) fn question(
    args: &CourseArgs,
    positions: u32,
    ready: &Ready,
    own: Measures,
) -> Result<Question, Failure> {
    let [speed, acceleration] = of_one(args, own)?;
    Ok(Question {
        object: args.object.clone(),
        positions: positions as usize,
        speed,
        acceleration,
        duration: ready.settings.duration,
        ..Question::default()
    })
}

/// Refuses what belongs to several inputs; speed and acceleration of the one input.
fn of_one(args: &CourseArgs, own: Measures) -> Result<[Option<f64>; 2], Failure> {
    if let Some(input) = args.inputs.first() {
        return Err(Failure::Other(format!(
            "--input {input}: the linkage has one input; give --range, --turn or --time"
        )));
    }
    let read = |name: &str, texts: &[String], wanted: QuantityChoice| match texts {
        [] => Ok(None),
        [text] => quantity(name, text, wanted).map(Some),
        [_, again, ..] => {
            let message = format!("{name} {again}: given twice, and the linkage has one input");
            Err(Failure::Other(message))
        }
    };
    Ok([
        read("--speed", &args.speed, own.speed())?,
        read("--acceleration", &args.acceleration, own.acceleration())?,
    ])
}

/// The place of the picture: a time or an input coordinate. Where it is not
/// said over what the linkage is looked at, the place's unit tells.
fn read_picture_place(
    question: &mut Question,
    text: &str,
    linkage: &Linkage,
    input: Coordinate,
) -> Result<(), Failure> {
    let own = Measures(Some(input)).displacement();
    let time = |text: &str| quantity("--svg", text, q::TIME.into());
    let over_time = match question.over {
        Some(over) => matches!(over, Over::Time { .. }),
        None => read_argument("--svg", text, |slot| slot.quantity(own, Bounds::ANY)).is_err(),
    };
    question.also = Some(match over_time {
        true => time(text)?,
        false => quantity("--svg", text, own)?,
    });
    question.over = question.over.or(Some(match over_time {
        true => Over::Time {
            to: question.duration,
        },
        false => whole_travel(linkage),
    }));
    Ok(())
}

/// `FROM:TO`, each with its unit or the last unit for both.
pub(super) fn range_of(text: &str, own: Measures) -> Result<Over, Failure> {
    let wrong = |what: &str| {
        let message = format!(
            "--range {text}: {what}; give FROM:TO, as 0:180 deg; 30:30 deg is one position"
        );
        Failure::Other(message)
    };
    let ends = text.split_once(':').ok_or_else(|| wrong("no `:`"))?;
    let ends = with_common_unit(&[ends.0, ends.1]).map_err(|what| wrong(&what))?;
    Ok(Over::Range {
        from: quantity("--range", &ends[0], own.displacement())?,
        to: quantity("--range", &ends[1], own.displacement())?,
    })
}
