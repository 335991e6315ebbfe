//! What is asked of the forces: loads, friction, the course.

use crate::cli::args::{ConventionName, CourseArgs, Direction, ForcesArgs};
use crate::cli::failure::Failure;
use crate::cli::input::Ready;
use crate::cli::kinematics;
use crate::cli::kinematics::multi_input;
use crate::dynamics::model::{Coordinate, LinkageBody, MultiLinkageBody};
use crate::frontend::object::Measures;
use crate::kinematics::linkage::Linkage;
use crate::kinematics::linkage::kinetostatics::Convention;
use crate::studies::forces::{Course, ForceChoice, course_of, course_of_record};
use crate::studies::kinematics::{
    AskedSeveral, KinematicsRequest, Question, even_motion, whole_travel,
};
use crate::units::number_and_unit;
use std::path::Path;

/// A linkage of several inputs, and what is asked of it.
pub(super) fn multi_input_request<'m>(
    args: &ForcesArgs,
    ready: &'m Ready,
    body: &MultiLinkageBody,
) -> Result<AskedSeveral<'m>, Failure> {
    let of_one = [
        (args.at.is_some(), "--at"),
        (args.record.is_some(), "--record"),
        (args.load.is_some(), "--load"),
        (!args.compare_massless.is_empty(), "--compare-massless"),
        (args.direction.is_some(), "--direction"),
    ];
    if let Some((_, option)) = of_one.iter().find(|(given, _)| *given) {
        let id = &ready.system.model().objects[body.object].id;
        let message = format!("{option} belongs to a linkage of one input, and `{id}` has several");
        return Err(Failure::Other(message));
    }
    let question = multi_input::question(&args.course, args.positions, ready, &body.linkage)?;
    Ok(AskedSeveral::new(ready.system.model(), body, &question)?)
}

/// What is asked besides the course.
pub(super) fn choice(args: &ForcesArgs) -> ForceChoice {
    ForceChoice {
        load: args.load.clone(),
        convention: match args.convention {
            None | Some(ConventionName::Paper) => Convention::Paper,
            Some(ConventionName::LoadPositive) => Convention::LoadPositive,
        },
        frictionless: args.frictionless,
        direction: args.direction.map(|direction| match direction {
            Direction::Forwards => 1.0,
            Direction::Backwards => -1.0,
        }),
    }
}

/// The course asked for, and in words how the input moves.
pub(super) fn read_course(
    args: &ForcesArgs,
    ready: &Ready,
    body: &LinkageBody,
) -> Result<(Course, String), Failure> {
    let model = ready.system.model();
    let part = &model.objects[body.object];
    if let Some(path) = &args.record {
        let text = read(path)?;
        let outputs = body.linkage.spec().outputs.iter();
        let outputs: Vec<&str> = outputs.map(|output| output.name.as_str()).collect();
        let course = course_of_record(&text, &part.id, &outputs)
            .map_err(|reason| format!("`{}`: {reason}", path.display()))?;
        return Ok((course, format!("motion of the record {}", path.display())));
    }
    let question = question(args, ready, &body.linkage, part.coordinate)?;
    let asked = KinematicsRequest::new(model, &question)?;
    let course = course_of(&asked)?;
    let motion = match &course {
        Course::Instants { .. } => "motion of the scene's drive".to_owned(),
        Course::Even {
            speed,
            acceleration,
            ..
        } => even_motion([*speed, *acceleration], part.coordinate.unit()),
    };
    Ok((course, motion))
}

fn question(
    args: &ForcesArgs,
    ready: &Ready,
    linkage: &Linkage,
    input: Coordinate,
) -> Result<Question, Failure> {
    let own = Measures(Some(input));
    let (course, positions) = course_and_intervals(args)?;
    let asked = kinematics::question(&course, positions, ready, own)?;
    // A speed, or a comparison over speeds, is meant for the whole travel.
    let whole = asked.speed.or(asked.acceleration).is_some() || !args.compare_massless.is_empty();
    let over = kinematics::requested_range(&course, ready, own)?;
    let over = over.or_else(|| whole.then(|| whole_travel(linkage)));
    Ok(Question { over, ..asked })
}

/// Most positions of `--at`, as of `--positions`.
const MOST_POSITIONS: f64 = 100_000.0;

/// The course and its number of intervals: those of `--at`, or as they are given.
fn course_and_intervals(args: &ForcesArgs) -> Result<(CourseArgs, u32), Failure> {
    let Some(text) = &args.at else {
        return Ok((args.course.clone(), args.positions));
    };
    let (range, positions) = parse_range_and_intervals(text).map_err(|what| {
        Failure::Other(format!(
            "--at {text}: {what}; give FROM:TO:STEP, as 0:330:30 deg, or one position, as 30 deg"
        ))
    })?;
    let course = CourseArgs {
        range: Some(range),
        ..args.course.clone()
    };
    Ok((course, positions))
}

/// `0:330:30 deg` as a range, `0:330 deg`, and its number of intervals.
fn parse_range_and_intervals(text: &str) -> Result<(String, u32), String> {
    let parts: Vec<&str> = text.split(':').map(str::trim).collect();
    let [from, to, step] = match parts.as_slice() {
        [one] => return Ok((format!("{one}:{one}"), 1)),
        [from, to, step] => [*from, *to, *step],
        _ => return Err("these are not three numbers".to_owned()),
    };
    let (step, unit) = number_and_unit(step).ok_or("the step is no number")?;
    let number = |text: &str| {
        text.parse::<f64>()
            .map_err(|_| format!("`{text}` is no number"))
    };
    let (first, last, width) = (number(from)?, number(to)?, number(step)?);
    let count = (last - first) / width;
    if !(1.0..=MOST_POSITIONS).contains(&count) {
        return Err("the step does not lead from the first to the last position".to_owned());
    }
    let whole = count.round();
    if (count - whole).abs() > 1e-9 * whole {
        let end = first + count.floor() * width;
        return Err(format!(
            "the step does not divide the range, but {from}:{end} {unit}"
        ));
    }
    Ok((format!("{from}:{to} {unit}"), whole as u32))
}

/// Largest record that is read at all.
const LARGEST: u64 = 1 << 30;

fn read(path: &Path) -> Result<String, String> {
    use std::io::Read;
    let failed =
        |error: std::io::Error| format!("cannot read the record `{}`: {error}", path.display());
    let file = std::fs::File::open(path).map_err(failed)?;
    let mut text = String::new();
    file.take(LARGEST)
        .read_to_string(&mut text)
        .map_err(failed)?;
    Ok(text)
}
