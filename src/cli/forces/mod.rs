//! `dam forces`: kinetostatics of a linkage.

mod question;

use crate::cli::answer::{Answer, AnswerForm, Content, PAGE, add_warning, ignores_until, picture};
use crate::cli::args::{ConventionName, ForcesArgs};
use crate::cli::asker::Asker;
use crate::cli::console;
use crate::cli::expected::Expectations;
use crate::cli::failure::Failure;
use crate::cli::input::Ready;
use crate::cli::output::OutputFolder;
use crate::cli::status::Status;
use crate::dynamics::model::{Model, MultiLinkageBody};
use crate::fault::{Fault, with_prefix};
use crate::kinematics::linkage::kinetostatics::{ForceFailure, Kinetostatics};
use crate::report::findings::Source;
use crate::report::forces::{ForcesReport, document, drawing, findings, massless_chart, rows};
use crate::studies::forces::{
    ActingLoads, Course, ForceStudy, LinkagePositions, MasslessComparison, Row, compare_massless,
    loads_left_out, multi_input_forces, study,
};
use crate::studies::kinematics::{linkage_of, several_of};
use crate::studies::rigid::Rigid;
use crate::studies::studied::{POSITIONS, check_forces};

const FILES: [&str; 5] = [
    "forces.csv",
    "forces.json",
    "mechanism.svg",
    PAGE,
    "massless.svg",
];

/// Runs the command.
pub(crate) fn command(args: &ForcesArgs, asker: &dyn Asker) -> Result<Status, Failure> {
    let input = asker.input(&args.scene)?;
    let ready = input.prepare_and_warn(args.scene.quiet)?;
    let model = ready.system.model();
    let ForceAnswer {
        folder,
        object,
        found,
        massless,
        motion,
    } = match several_of(model, args.course.object.as_deref()) {
        Some(body) => solve_multi_input(args, &ready, body)?,
        None => of_one(args, &ready)?,
    };
    let object = object.as_str();
    let warnings = warnings(args, &found, model, object);
    let report = ForcesReport {
        study: &found,
        warnings: &warnings,
        massless: massless.as_ref(),
        object,
        motion: &motion,
        name: &ready.scene().name,
        hash: &ready.scene().hash,
    };
    let expected = expectations(args, &ready, object, &found);
    let mut files = vec![
        (FILES[0].into(), Content::made(|| rows(&found).csv())),
        (FILES[1].into(), Content::Document),
        (FILES[2].into(), Content::made(|| drawing(&report).svg(0))),
        (FILES[3].into(), Content::Page),
    ];
    let chart = massless_chart(&report);
    if chart.is_some() {
        files.push((
            FILES[4].into(),
            Content::made(move || picture(chart.as_ref())),
        ));
    }
    // Loads over time, and those of a record, come from a run.
    let of_run = args.record.is_some() || found.course.has_loads();
    let label = Rigid::label(model, &["dam run"]).filter(|_| !of_run);
    let mut shown = findings(&report, Source::scene(input.text(), report.hash));
    shown.label(label.as_ref(), "the forces are");
    let mut written = document(&report);
    shown.judge(&mut written, label.as_ref());
    add_warning(&mut shown, &mut written, ignores_until(model));
    let answer = Answer {
        command: "forces",
        findings: &shown,
        document: expected.add_verdicts(written).into(),
        files,
        quiet: args.scene.quiet,
    };
    let form = if args.csv {
        AnswerForm::File(FILES[0])
    } else {
        AnswerForm::Text
    };
    let shown = AnswerForm::json_or(args.scene.json, form);
    asker.deliver(&answer, folder.as_ref(), shown)?;
    if !args.scene.quiet {
        if found.settings.output.is_none() && found.several.is_none() {
            console::print_message("no transmission ratio: name the loaded output with --load");
        }
        expected.print_verdicts();
    }
    let answered = found.missing() == 0 && found.solved().next().is_some();
    Ok(match answered && expected.all_hold() {
        true => answer.status(),
        false => Status::NotTrusted,
    })
}

/// A study with what belongs to it.
struct ForceAnswer {
    folder: Option<OutputFolder>,
    object: String,
    found: ForceStudy,
    massless: Option<MasslessComparison>,
    motion: String,
}

fn solve_multi_input(
    args: &ForcesArgs,
    ready: &Ready,
    body: &MultiLinkageBody,
) -> Result<ForceAnswer, Failure> {
    let pairs = &body.linkage.spec().linkage.pairs;
    if args.frictionless && pairs.iter().all(|pair| pair.friction == 0.0) {
        let why = "--frictionless has no effect: no pair has friction";
        return Err(Failure::Other(why.to_owned()));
    }
    let asked = question::multi_input_request(args, ready, body)?;
    let object = ready.system.model().objects[body.object].id.clone();
    let folder = OutputFolder::from_args(&args.out, &ready.scene().name, &FILES)?;
    let found = multi_input_forces(&asked, question::choice(args).options());
    let found = found.map_err(|faults| faults_of(ready, &object, faults))?;
    unused_convention(args, &found)?;
    let motion = found.several.as_ref().map(|several| several.motion.clone());
    Ok(ForceAnswer {
        folder,
        object,
        found,
        massless: None,
        motion: motion.unwrap_or_default(),
    })
}

/// Refuses what changes nothing of the forces.
fn refuse_unused(args: &ForcesArgs, friction: bool, course: &Course) -> Result<(), Failure> {
    let moves = matches!(course, Course::Even { speed, .. } if *speed != 0.0);
    let why = match (args.frictionless, args.direction.is_some()) {
        (true, _) if !friction => "--frictionless has no effect: no pair has friction",
        (true, true) => "--direction has no effect beside --frictionless",
        (_, true) if !friction => "--direction has no effect: no pair has friction",
        (_, true) if moves => {
            "--direction has no effect: it is that of the speed; --speed 0 lets the input rest"
        }
        _ => return Ok(()),
    };
    Err(Failure::Other(why.to_owned()))
}

/// Refuses a sign for a transmission ratio that there is none of.
fn unused_convention(args: &ForcesArgs, found: &ForceStudy) -> Result<(), Failure> {
    let has_ratio = |row: &Row| row.forces.as_ref().is_ok_and(|forces| forces.chi.is_some());
    if args.convention.is_none() || found.rows.iter().any(has_ratio) {
        return Ok(());
    }
    let why = match (&found.several, found.settings.output) {
        (Some(_), _) => "a linkage of several inputs has no transmission ratio",
        (None, None) => "there is no transmission ratio; name the loaded output with --load",
        (None, Some(_)) => "there is no transmission ratio without a load on the output",
    };
    Err(Failure::Other(format!("--convention has no effect: {why}")))
}

fn of_one(args: &ForcesArgs, ready: &Ready) -> Result<ForceAnswer, Failure> {
    let model = ready.system.model();
    let body = linkage_of(model, args.course.object.as_deref())?;
    let object = model.objects[body.object].id.as_str();
    let told = |faults: Vec<Fault>| faults_of(ready, object, faults);
    let solver = Kinetostatics::new(body.linkage.spec()).map_err(told)?;
    let settings = question::choice(args).settings(&solver);
    let settings = settings.map_err(|what| format!("--{what}"))?;
    if let Some(value) = args
        .compare_massless
        .iter()
        .find(|x| !(x.is_finite() && **x > 0.0))
    {
        let message = format!("--compare-massless: {value} is not a number above zero");
        return Err(Failure::Other(message));
    }
    let (course, motion) = question::read_course(args, ready, body)?;
    refuse_unused(args, solver.has_friction(), &course)?;
    let rests = matches!(course, Course::Even { speed, acceleration, .. } if speed == 0.0 && acceleration == 0.0);
    if rests && solver.has_friction() && !args.frictionless && args.direction.is_none() {
        return Err(Failure::Other(format!(
            "{}: give --direction forwards or backwards, or --frictionless",
            ForceFailure::NoDirection
        )));
    }
    let folder = OutputFolder::from_args(&args.out, &ready.scene().name, &FILES)?;
    let acting = ActingLoads::loads_along_course(model, body, &course);
    let mut source = LinkagePositions::new(&body.linkage);
    let spec = body.linkage.spec();
    let massless = match args.compare_massless.as_slice() {
        [] => None,
        list => Some(compare_massless(spec, &mut source, &course, &settings, list).map_err(told)?),
    };
    let mut source = source.carrying(acting);
    let found = study(spec, &mut source, course, settings).map_err(told)?;
    unused_convention(args, &found)?;
    Ok(ForceAnswer {
        folder,
        object: object.to_owned(),
        found,
        massless,
        motion,
    })
}

/// Another mechanism than the scene's, or another question, has no expectations.
fn expectations<'r>(
    args: &ForcesArgs,
    ready: &'r Ready,
    object: &str,
    found: &ForceStudy,
) -> Expectations<'r> {
    let same_course = args.course.is_of_scene()
        && args.record.is_none()
        && args.at.is_none()
        && args.compare_massless.is_empty()
        && args.positions as usize == POSITIONS;
    let same_forces = args.scene.set.is_empty()
        && args.load.is_none()
        && args
            .convention
            .is_none_or(|one| one == ConventionName::Paper)
        && !args.frictionless
        && args.direction.is_none();
    let all = &ready.scene().expect;
    let whole = loads_left_out(found, ready.system.model(), object).is_none();
    Expectations::judge_scene("forces", all, same_course && same_forces && whole, |all| {
        check_forces(all, object, found)
    })
}

/// Faults with their place in the scene where they have one.
fn faults_of(ready: &Ready, object: &str, faults: Vec<Fault>) -> Failure {
    let faults = with_prefix(object, faults);
    ready.reading.places.diagnose(&faults).into()
}

/// All that the user should know besides the figures.
fn warnings(args: &ForcesArgs, found: &ForceStudy, model: &Model, object: &str) -> Vec<String> {
    let mut warnings = found.warnings();
    if args.record.is_none() {
        warnings.extend(loads_left_out(found, model, object));
    }
    warnings
}
