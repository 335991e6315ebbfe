//! `dam kinematics`: positions, transfer functions, speeds and accelerations of
//! a linkage.

use super::args::{CourseArgs, KinematicsArgs};
use super::console;
use super::expected;
use super::failure::Failure;
use super::input::{Input, Ready};
use super::output::{self, OutputFolder, ResultFile};
use super::status::Status;
use crate::dynamics::model::Coordinate;
use crate::frontend::object::Measures;
use crate::frontend::object::law::read_argument;
use crate::frontend::read::{Bounds, Wanted};
use crate::kinematics::linkage::Linkage;
use crate::report::kinematics::{
    KinematicsReport, document, drawing, kinematics_csv, page, picture, text,
};
use crate::studies::expectations::Verdict;
use crate::studies::kinematics::{
    Asked, Kinematics, Over, Question, Subject, kinematics, whole_travel,
};
use crate::studies::studied::{POSITIONS, check_kinematics};
use crate::units::quantities as q;
use crate::units::with_common_unit;

const FILES: [&str; 4] = [
    "kinematics.csv",
    "kinematics.json",
    "mechanism.svg",
    "report.html",
];

/// Runs the command.
pub(crate) fn command(args: &KinematicsArgs) -> Result<Status, Failure> {
    let input = Input::load(&args.scene)?;
    let ready = input.prepare(&[])?;
    let model = ready.system.model();
    let subject = Subject::of(model, args.course.object.as_deref())?;
    let mut question = question(args, &ready, subject.input)?;
    if let Some(at) = &args.svg {
        place(&mut question, at, &subject.linkage, subject.input)?;
    }
    let asked = Asked::of(model, subject, &question)?;
    let folder = OutputFolder::asked(&args.out, &ready.scene().name, &FILES)?;
    let found = kinematics(&asked);
    let verdicts = verdicts(args, &ready, &found);
    let files = || files(&input, &ready, &found, &verdicts);
    let show = || show(args, &ready, &found, &verdicts, question.also);
    let hash = &ready.scene().hash;
    output::deliver(folder.as_ref(), "kinematics", hash, files, show)?;
    if !args.scene.quiet {
        for warning in &found.warnings {
            console::talk(&format!("warning: {warning}"));
        }
        expected::talk(&verdicts);
    }
    if let (Some(folder), false) = (&folder, args.scene.quiet) {
        folder.tell_report();
    }
    let whole = found.stopped.is_none() && found.warnings.is_empty();
    Ok(match whole && expected::hold(&verdicts) {
        true => Status::Answered,
        false => Status::NotTrusted,
    })
}

/// Another mechanism than the scene's, or another question, has no expectations.
fn verdicts(args: &KinematicsArgs, ready: &Ready, found: &Kinematics) -> Vec<Verdict> {
    let course = &args.course;
    let as_scene = args.scene.set.is_empty()
        && !course.turn
        && course.range.is_none()
        && course.time.is_none()
        && args.speed.is_none()
        && args.acceleration.is_none()
        && args.svg.is_none()
        && args.positions as usize == POSITIONS;
    match as_scene {
        true => check_kinematics(&ready.scene().expect, found),
        false => Vec::new(),
    }
}

fn show(
    args: &KinematicsArgs,
    ready: &Ready,
    found: &Kinematics,
    verdicts: &[Verdict],
    also: Option<f64>,
) -> Result<(), Failure> {
    let scene = ready.scene();
    if let Some(at) = also {
        let row = found.axis.values.iter().position(|&place| place == at);
        match row {
            Some(row) => console::data(&picture(found, row))?,
            None => {
                return Err("the linkage cannot be assembled at that place"
                    .to_owned()
                    .into());
            }
        }
    } else if args.scene.json {
        let document = document(&scene.name, &scene.hash, found);
        console::json(&expected::beside(document, verdicts))?;
    } else if args.csv {
        console::data(&kinematics_csv(found).map_err(|error| error.to_string())?)?;
    } else {
        console::text(&text(&scene.name, found))?;
    }
    Ok(())
}

pub(super) fn quantity(name: &str, text: &str, wanted: Wanted) -> Result<f64, Failure> {
    Ok(read_argument(name, text, |slot| {
        slot.quantity(wanted, Bounds::ANY)
    })?)
}

/// Course over which the linkage is to be looked at, where it is said.
pub(super) fn asked_over(
    args: &CourseArgs,
    ready: &Ready,
    input: Measures,
) -> Result<Option<Over>, Failure> {
    Ok(match (&args.range, &args.time) {
        (Some(range), _) => Some(range_of(range, input)?),
        (None, Some(time)) => Some(Over::Time {
            to: match time.as_str() {
                "" => ready.settings.duration,
                time => quantity("--time", time, q::TIME.into())?,
            },
        }),
        (None, None) => args.turn.then_some(Over::Turn),
    })
}

fn question(args: &KinematicsArgs, ready: &Ready, input: Coordinate) -> Result<Question, Failure> {
    let own = Measures(Some(input));
    let over = asked_over(&args.course, ready, own)?;
    let read = |name: &str, text: &Option<String>, wanted: Wanted| {
        let text = text.as_deref();
        text.map(|text| quantity(name, text, wanted)).transpose()
    };
    Ok(Question {
        object: args.course.object.clone(),
        over,
        positions: args.positions as usize,
        speed: read("--speed", &args.speed, own.speed())?,
        acceleration: read("--acceleration", &args.acceleration, own.acceleration())?,
        duration: ready.settings.duration,
        also: None,
    })
}

/// The place of the picture: a time or an input coordinate. Where it is not
/// said over what the linkage is looked at, the place's unit tells.
fn place(
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
        let message = format!("--range {text}: {what}; give FROM:TO, as 0:180 deg");
        Failure::Other(message)
    };
    let ends = text.split_once(':').ok_or_else(|| wrong("no `:`"))?;
    let ends = with_common_unit(&[ends.0, ends.1]).map_err(|what| wrong(&what))?;
    Ok(Over::Range {
        from: quantity("--range", &ends[0], own.displacement())?,
        to: quantity("--range", &ends[1], own.displacement())?,
    })
}

fn files(
    input: &Input,
    ready: &Ready,
    found: &Kinematics,
    verdicts: &[Verdict],
) -> Result<Vec<ResultFile>, Failure> {
    let scene = ready.scene();
    let report = page(&KinematicsReport {
        found,
        name: &scene.name,
        hash: &scene.hash,
        scene: input.text(),
        version: env!("CARGO_PKG_VERSION"),
    });
    let document = document(&scene.name, &scene.hash, found);
    let document = expected::beside(document, verdicts);
    Ok(vec![
        ResultFile::new(
            FILES[0],
            kinematics_csv(found).map_err(|error| error.to_string())?,
        ),
        ResultFile::new(FILES[1], format!("{document:#}\n")),
        ResultFile::new(FILES[2], drawing(found).svg(0)),
        ResultFile::new(FILES[3], report),
    ])
}
