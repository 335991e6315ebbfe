//! `dam forces`: kinetostatics of a linkage.

use super::args::{ConventionName, Direction, ForcesArgs};
use super::console;
use super::expected;
use super::failure::Failure;
use super::input::{Input, Ready};
use super::kinematics::{asked_over, quantity};
use super::output::{self, OutputFolder, ResultFile};
use super::status::Status;
use crate::dynamics::model::{Coordinate, LinkageBody, Model, ObjectPart};
use crate::fault::Fault;
use crate::frontend::object::Measures;
use crate::kinematics::linkage::Linkage;
use crate::kinematics::linkage::kinetostatics::{Convention, ForceFailure, Kinetostatics, Options};
use crate::report::forces::{
    ForcesReport, document, drawing, forces_csv, massless_chart, page, text,
};
use crate::studies::expectations::Verdict;
use crate::studies::forces::{
    Course, ForceSettings, ForceStudy, LinkagePositions, compare_massless, course_of,
    course_of_record, only_loaded_output, study,
};
use crate::studies::kinematics::{Asked, Question, even_motion, linkage_of, whole_travel};
use crate::studies::studied::{POSITIONS, check_forces};
use serde_json::Value;
use std::path::Path;

const FILES: [&str; 5] = [
    "forces.csv",
    "forces.json",
    "mechanism.svg",
    "report.html",
    "massless.svg",
];

/// Size of the picture of the comparison (pixels).
const PICTURE: (f64, f64) = (900.0, 480.0);

/// Runs the command.
pub(crate) fn command(args: &ForcesArgs) -> Result<Status, Failure> {
    let input = Input::load(&args.scene)?;
    let ready = input.prepare(&[])?;
    let model = ready.system.model();
    let body = linkage_of(model, args.course.object.as_deref())?;
    let object = model.objects[body.object].id.as_str();
    let told = |faults: Vec<Fault>| faults_of(&ready, object, faults);
    let solver = Kinetostatics::new(body.linkage.spec()).map_err(told)?;
    let settings = settings(args, &solver)?;
    if let Some(value) = args
        .compare_massless
        .iter()
        .find(|x| !(x.is_finite() && **x > 0.0))
    {
        let message = format!("--compare-massless: {value} is not a number above zero");
        return Err(Failure::Other(message));
    }
    let (course, motion) = course(args, &ready, body)?;
    let rests = matches!(course, Course::Even { speed, acceleration, .. } if speed == 0.0 && acceleration == 0.0);
    if rests && solver.has_friction() && !args.frictionless && args.direction.is_none() {
        return Err(Failure::Other(format!(
            "{}: give --direction forwards or backwards, or --frictionless",
            ForceFailure::NoDirection
        )));
    }
    let folder = OutputFolder::asked(&args.out, &ready.scene().name, &FILES)?;
    let mut source = LinkagePositions::new(&body.linkage);
    let spec = body.linkage.spec();
    let massless = match args.compare_massless.as_slice() {
        [] => None,
        list => Some(compare_massless(spec, &mut source, &course, &settings, list).map_err(told)?),
    };
    let found = study(spec, &mut source, course, settings).map_err(told)?;
    let warnings = warnings(args, &found, &behind(model, object));
    let report = ForcesReport {
        study: &found,
        warnings: &warnings,
        massless: massless.as_ref(),
        object,
        motion: &motion,
        name: &ready.scene().name,
        hash: &ready.scene().hash,
        scene: input.text(),
        version: env!("CARGO_PKG_VERSION"),
    };
    let verdicts = verdicts(args, &ready, object, &found);
    let document = || expected::beside(document(&report), &verdicts);
    let files = || files(&report, document());
    let show = || show(args, &report, document);
    output::deliver(folder.as_ref(), "forces", report.hash, files, show)?;
    talk(args, &found, &warnings);
    if !args.scene.quiet {
        expected::talk(&verdicts);
    }
    if let (Some(folder), false) = (&folder, args.scene.quiet) {
        folder.tell_report();
    }
    let solved = found.rows.iter().all(|row| row.forces.is_ok());
    let sound = solved && found.worst_balance() < 1e-8;
    Ok(match sound && expected::hold(&verdicts) {
        true => Status::Answered,
        false => Status::NotTrusted,
    })
}

/// Another mechanism than the scene's, or another question, has no expectations.
fn verdicts(args: &ForcesArgs, ready: &Ready, object: &str, found: &ForceStudy) -> Vec<Verdict> {
    let course = &args.course;
    let same_course = !course.turn
        && course.range.is_none()
        && course.time.is_none()
        && args.record.is_none()
        && args.speed.is_none()
        && args.acceleration.is_none()
        && args.compare_massless.is_empty()
        && args.positions as usize == POSITIONS;
    let same_forces = args.scene.set.is_empty()
        && args.load.is_none()
        && args.convention == ConventionName::Paper
        && !args.frictionless
        && args.direction.is_none();
    match same_course && same_forces {
        true => check_forces(&ready.scene().expect, object, found),
        false => Vec::new(),
    }
}

/// Faults with their place in the scene where they have one.
fn faults_of(ready: &Ready, object: &str, faults: Vec<Fault>) -> Failure {
    let placed = faults.into_iter().map(|mut fault| {
        fault.path = match fault.path.as_str() {
            "" => object.to_owned(),
            path => format!("{object}.{path}"),
        };
        fault
    });
    ready
        .reading
        .places
        .diagnose(&placed.collect::<Vec<_>>())
        .into()
}

fn settings(args: &ForcesArgs, solver: &Kinetostatics) -> Result<ForceSettings, Failure> {
    let (output, loads) = match &args.load {
        None => (only_loaded_output(solver), None),
        Some(text) => load(text, solver)?,
    };
    Ok(ForceSettings {
        options: Options {
            friction: !args.frictionless,
            direction: args.direction.map(|direction| match direction {
                Direction::Forwards => 1.0,
                Direction::Backwards => -1.0,
            }),
            ..Options::default()
        },
        output,
        loads,
        convention: match args.convention {
            ConventionName::Paper => Convention::Paper,
            ConventionName::LoadPositive => Convention::LoadPositive,
        },
    })
}

/// `OUTPUT` or `OUTPUT=FORCE,FORCE`.
fn load(text: &str, solver: &Kinetostatics) -> Result<(Option<usize>, Option<Vec<usize>>), String> {
    let spec = solver.spec();
    let (output, forces) = match text.split_once('=') {
        Some((output, forces)) => (output, Some(forces)),
        None => (text, None),
    };
    let outputs: Vec<&str> = spec
        .outputs
        .iter()
        .map(|output| output.name.as_str())
        .collect();
    let index = position(output, &outputs, "output")?;
    let names: Vec<&str> = spec
        .forces
        .iter()
        .map(|force| force.name.as_str())
        .collect();
    let chosen = forces.map(|forces| {
        let list = forces
            .split(',')
            .map(|name| position(name.trim(), &names, "force"));
        list.collect::<Result<Vec<usize>, String>>()
    });
    Ok((Some(index), chosen.transpose()?))
}

fn position(name: &str, names: &[&str], what: &str) -> Result<usize, String> {
    let found = names.iter().position(|known| *known == name);
    found.ok_or_else(|| match names {
        [] => format!("--load: the linkage has no {what}"),
        _ => format!(
            "--load: there is no {what} `{name}`; one of {}",
            names.join(", ")
        ),
    })
}

/// The course asked for, and in words how the input moves.
fn course(
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
    let asked = Asked::new(model, &question)?;
    let course = course_of(&asked)?;
    let unit = match part.coordinate {
        Coordinate::Turning => "rad",
        Coordinate::Sliding => "m",
    };
    let motion = match &course {
        Course::Instants { .. } => "motion of the scene's drive".to_owned(),
        Course::Even {
            speed,
            acceleration,
            ..
        } => even_motion([*speed, *acceleration], unit),
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
    let speed = args.speed.as_deref();
    let speed = speed
        .map(|text| quantity("--speed", text, own.speed()))
        .transpose()?;
    let acceleration = args.acceleration.as_deref();
    let acceleration = acceleration
        .map(|text| quantity("--acceleration", text, own.acceleration()))
        .transpose()?;
    // A speed, or a comparison over speeds, is meant for the whole travel.
    let whole = speed.or(acceleration).is_some() || !args.compare_massless.is_empty();
    let over = asked_over(&args.course, ready, own)?;
    let over = over.or_else(|| whole.then(|| whole_travel(linkage)));
    Ok(Question {
        object: args.course.object.clone(),
        over,
        positions: args.positions as usize,
        speed,
        acceleration,
        duration: ready.settings.duration,
        also: None,
    })
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

fn show(
    args: &ForcesArgs,
    report: &ForcesReport<'_>,
    document: impl FnOnce() -> Value,
) -> Result<(), Failure> {
    if args.scene.json {
        console::json(&document())?;
    } else if args.csv {
        console::data(&forces_csv(report.study).map_err(|error| error.to_string())?)?;
    } else {
        console::text(&text(report))?;
    }
    Ok(())
}

/// Objects that hang on the linkage's outputs, and outputs that carry loads of their own.
fn behind<'m>(model: &'m Model, object: &str) -> Vec<&'m str> {
    let own = |id: &str| {
        id == object
            || id
                .strip_prefix(object)
                .is_some_and(|rest| rest.starts_with('.'))
    };
    let hangs = |part: &ObjectPart| {
        !own(&part.id) && (part.inputs.iter()).any(|input| own(&model.objects[input.driver].id))
    };
    let loaded = |part: &ObjectPart| {
        own(&part.id) && (model.loads.iter()).any(|load| part.nodes.contains(&load.node))
    };
    let parts = model.objects.iter();
    parts
        .filter(|part| hangs(part) || loaded(part))
        .map(|part| part.id.as_str())
        .collect()
}

/// All that the user should know besides the figures.
fn warnings(args: &ForcesArgs, found: &ForceStudy, behind: &[&str]) -> Vec<String> {
    let mut warnings = found.warnings();
    if !behind.is_empty() && args.record.is_none() && !found.course.has_loads() {
        warnings.push(format!(
            "the forces of what the linkage drives ({}) are not among its loads; take them from a \
             run with --record",
            behind.join(", ")
        ));
    }
    warnings
}

fn talk(args: &ForcesArgs, found: &ForceStudy, warnings: &[String]) {
    if args.scene.quiet {
        return;
    }
    for warning in warnings {
        console::talk(&format!("warning: {warning}"));
    }
    if found.settings.output.is_none() {
        console::talk("no transmission ratio: name the loaded output with --load");
    }
}

fn files(report: &ForcesReport<'_>, document: Value) -> Result<Vec<ResultFile>, Failure> {
    let table = forces_csv(report.study).map_err(|error| error.to_string())?;
    let mut files = vec![
        ResultFile::new(FILES[0], table),
        ResultFile::new(FILES[1], format!("{document:#}\n")),
        ResultFile::new(FILES[2], drawing(report).svg(0)),
        ResultFile::new(FILES[3], page(report)),
    ];
    if let Some(chart) = massless_chart(report) {
        files.push(ResultFile::new(FILES[4], chart.svg(PICTURE.0, PICTURE.1)));
    }
    Ok(files)
}
