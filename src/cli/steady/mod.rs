//! `dam steady`: the steady motion of a machine.

pub(crate) mod args;
mod machine;

use super::answer::{self, AnswerForm as Shape, Content, PAGE, add_warning, ignores_until};
use super::asker::Asker;
use super::expected::Expectations;
use super::failure::{Failure, refuse_option};
use super::input::Ready;
use super::output::OutputFolder;
use super::quantity::option;
use super::run::doubts;
use super::status::Status;
use crate::dynamics::steady::{MOST_TURNS, Mean};
use crate::frontend::read::Bounds;
use crate::frontend::scene::SteadySpec;
use crate::report::csv::Rows;
use crate::report::findings::{Findings, Source};
use crate::report::plot::Plot;
use crate::report::steady::{
    SteadyReport, periodic_findings, periodic_rows, rigid_findings, rigid_rows, wittenbauer,
};
use crate::studies::check::Check;
use crate::studies::expectations::Verdict;
use crate::studies::steady::{Answer, ROWS, check, steady_motion_within};
use crate::units::quantities as q;
use args::{MeanChoice, QuestionArgs, SteadyArgs, SteadyForm};
use serde::Serialize;
use serde_json::{Value, json};

const FILES: [&str; 3] = ["steady.json", "steady.csv", PAGE];

/// Why no number of cycles is asked for.
const RIGID_REPEATS: &str = "a machine with rigid objects repeats after one cycle";

/// Size of the diagram (pixels).
const PICTURE: (f64, f64) = (900.0, 560.0);

/// What goes to the terminal and into files.
struct SteadyOutput<'a> {
    findings: Findings<'a>,
    document: Value,
    rows: Rows,
    /// The energy-mass diagram of a machine with rigid objects.
    diagram: Option<Plot>,
}

impl<'a> SteadyOutput<'a> {
    fn rigid(shown: &SteadyReport<'_>, mut document: Value, source: Source<'a>) -> Self {
        let findings = rigid_findings(shown, source);
        findings.judge(&mut document, None);
        Self {
            findings,
            document,
            rows: rigid_rows(shown),
            diagram: Some(wittenbauer(shown)),
        }
    }
}

/// Runs the command.
pub(crate) fn command(args: &SteadyArgs, asker: &dyn Asker) -> Result<Status, Failure> {
    let Some(scene) = args.scene() else {
        return machine::command(args, asker);
    };
    let input = asker.input(&scene)?;
    let ready = input.prepare_and_warn(args.quiet)?;
    let folder = folder(args, &ready.scene().name)?;
    let mut spec = ready.scene().steady.clone().unwrap_or_default();
    apply_arguments(&args.question, &mut spec)?;
    let answer = steady_motion_within(&ready.system, &ready.settings, &spec, asker.budget())
        .map_err(|faults| Failure::from(ready.reading.places.diagnose(&faults)))?;
    refuse_unused(&args.question, &spec, &answer)?;
    let expected = expectations(args, &ready, &answer);
    let (name, hash) = (&ready.scene().name, &ready.scene().hash);
    let label = answer.label(ready.system.model());
    let document = document(&ready, &answer, (&answer.checks(), expected.verdicts()))?;
    let source = Source::scene(input.text(), hash);
    let mut found = match &answer {
        Answer::Rigid(answer) => {
            let shown = SteadyReport {
                title: name,
                cycle: answer.cycle,
                figures: &answer.figures,
                rows: &answer.motion.rows(ROWS),
                regime: answer.regime.as_ref(),
                flywheel: answer.flywheel.as_ref(),
                agreement: Some(&answer.agreement),
                halving: None,
            };
            SteadyOutput::rigid(&shown, document, source)
        }
        Answer::Periodic(answer) => SteadyOutput {
            findings: periodic_findings(name, answer, source),
            document,
            rows: periodic_rows(answer),
            diagram: None,
        },
    };
    found.findings.label(label.as_ref(), "the steady motion is");
    let unjudged = answer.unjudged(ready.system.model());
    found.findings.leave_open(unjudged);
    found.findings.judge(&mut found.document, label.as_ref());
    let until = ignores_until(ready.system.model());
    add_warning(&mut found.findings, &mut found.document, until);
    let status = print_answer((args, asker), found, folder.as_ref())?;
    if !args.quiet {
        expected.print_verdicts();
    }
    match expected.all_hold() {
        true => Ok(status),
        false => Ok(Status::NotTrusted),
    }
}

/// Puts what the command line asks in place of what the scene asks.
fn apply_arguments(args: &QuestionArgs, spec: &mut SteadySpec) -> Result<(), Failure> {
    let speed = option(
        "--mean-speed",
        &args.mean_speed,
        q::ANGULAR_SPEED,
        Bounds::POSITIVE,
    )?;
    spec.mean_speed = speed.or(spec.mean_speed);
    let cycle = option(
        "--cycle",
        &args.cycle,
        q::ANGLE,
        Bounds::up_to(MOST_TURNS * std::f64::consts::TAU),
    )?;
    spec.cycle = cycle.unwrap_or(spec.cycle);
    let bounds = Bounds::between(1e-6, 1.99);
    let fluctuation = option("--fluctuation", &args.fluctuation, q::NUMBER, bounds)?;
    spec.fluctuation = fluctuation.or(spec.fluctuation);
    spec.balance |= args.balance;
    spec.periods = args.periods.map_or(spec.periods, usize::from);
    spec.mean = match args.mean {
        Some(MeanChoice::Time) => Mean::Time,
        Some(MeanChoice::Angle) => Mean::Angle,
        Some(MeanChoice::Midrange) => Mean::Midrange,
        None => spec.mean,
    };
    Ok(())
}

/// Refuses what changes nothing of this answer.
fn refuse_unused(args: &QuestionArgs, spec: &SteadySpec, answer: &Answer) -> Result<(), Failure> {
    let refuse = |given: bool, option: &str, why: &str| {
        refuse_option(given, &format!("{option} has no effect: {why}"))
    };
    let [mean, periods] = [args.mean.is_some(), args.periods.is_some()];
    let decided = "no mean speed is given, the scene decides it";
    match answer {
        Answer::Rigid(answer) => {
            refuse(periods, "--periods", RIGID_REPEATS)?;
            refuse(mean && answer.regime.is_some(), "--mean", decided)
        }
        Answer::Periodic(_) => refuse(mean && spec.mean_speed.is_none(), "--mean", decided),
    }
}

fn folder(args: &SteadyArgs, name: &str) -> Result<Option<OutputFolder>, Failure> {
    Ok(OutputFolder::from_args(&args.out, name, &FILES)?)
}

/// Another machine than the scene's, or another question, has no expectations.
fn expectations<'r>(args: &SteadyArgs, ready: &'r Ready, answer: &Answer) -> Expectations<'r> {
    let asked = &args.question;
    let same = args.set.is_empty()
        && !asked.balance
        && asked.mean.is_none()
        && asked.periods.is_none()
        && [&asked.mean_speed, &asked.cycle, &asked.fluctuation]
            .iter()
            .all(|text| text.is_none());
    let all = &ready.scene().expect;
    Expectations::judge_scene("steady", all, same, |all| check(all, answer))
}

/// The JSON document of a scene's steady motion.
fn document(
    ready: &Ready,
    answer: &Answer,
    (checks, verdicts): (&[Check], &[Verdict]),
) -> Result<Value, Failure> {
    #[derive(Serialize)]
    struct Document<'a> {
        dam: u32,
        scene: &'a str,
        hash: &'a str,
        #[serde(flatten)]
        answer: &'a Answer,
        checks: &'a [Check],
        #[serde(skip_serializing_if = "Vec::is_empty")]
        warnings: Vec<String>,
        #[serde(skip_serializing_if = "<[Verdict]>::is_empty")]
        expect: &'a [Verdict],
        #[serde(skip_serializing_if = "Option::is_none")]
        diagnostics: Option<Value>,
    }
    let document = Document {
        dam: 1,
        scene: &ready.scene().name,
        hash: &ready.scene().hash,
        answer,
        warnings: checks.iter().filter_map(Check::failure).collect(),
        checks,
        expect: verdicts,
        diagnostics: doubts(ready),
    };
    Ok(serde_json::to_value(document).map_err(|error| error.to_string())?)
}

/// Prints the answer and writes its files: the status by its checks.
fn print_answer(
    (args, asker): (&SteadyArgs, &dyn Asker),
    found: SteadyOutput<'_>,
    folder: Option<&OutputFolder>,
) -> Result<Status, Failure> {
    let shown = match (args.form, &found.diagram) {
        (SteadyForm::Text, _) => Shape::Text,
        (SteadyForm::Csv, _) => Shape::File(FILES[1]),
        (SteadyForm::Svg, Some(diagram)) => Shape::Made(diagram.svg(PICTURE.0, PICTURE.1)),
        (SteadyForm::Svg, None) => {
            let why = "only machines with rigid objects have an energy-mass diagram";
            return Err(Failure::Other(why.to_owned()));
        }
    };
    let answer = answer::Answer {
        command: "steady",
        findings: &found.findings,
        document: found.document.into(),
        files: vec![
            (FILES[0].into(), Content::Document),
            (FILES[1].into(), Content::made(|| found.rows.csv())),
            (FILES[2].into(), Content::Page),
        ],
        quiet: args.quiet,
    };
    asker.deliver(&answer, folder, Shape::json_or(args.json, shown))?;
    Ok(answer.status())
}

/// The source of a machine that is no scene.
fn machine_source<'a>(title: &str) -> Source<'a> {
    Source {
        more: vec![("Machine".to_owned(), title.to_owned())],
        ..Source::default()
    }
}

/// The JSON document of a machine that is no scene.
fn machine_document(title: &str, answer: &impl Serialize, checks: &[Check]) -> Value {
    json!({ "dam": 1, "machine": title, "rigid_motion": answer, "checks": checks })
}
