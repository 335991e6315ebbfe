//! `dam steady`: the steady motion of a machine.

pub(crate) mod args;
mod machine;

use super::console;
use super::expected;
use super::failure::Failure;
use super::input::{Input, Ready};
use super::output::{self, OutputFolder, ResultFile};
use super::run::doubts;
use super::status::Status;
use crate::dynamics::steady::{MOST_TURNS, Mean};
use crate::frontend::object::law::read_argument;
use crate::frontend::read::Bounds;
use crate::frontend::scene::SteadySpec;
use crate::report::steady::{
    Shown, SteadyReport, drive_csv, page, periodic_text, rigid_text, rows_csv, wittenbauer,
};
use crate::studies::expectations::Verdict;
use crate::studies::steady::{Answer, ROWS, check, steady_motion};
use crate::units::{Quantity, quantities as q};
use args::{Form, MeanChoice, QuestionArgs, SteadyArgs};
use serde::Serialize;
use serde_json::{Value, json};

const FILES: [&str; 3] = ["steady.json", "steady.csv", "report.html"];

/// Size of the diagram (pixels).
const PICTURE: (f64, f64) = (900.0, 560.0);

/// Answer that goes to the terminal and into files.
struct Answered<'a> {
    /// The scene's name, or what machine it is.
    title: &'a str,
    hash: &'a str,
    scene: Option<&'a str>,
    document: Value,
    rigid: Option<Shown<'a>>,
    periodic: Option<&'a crate::studies::steady::PeriodicAnswer>,
}

/// Runs the command.
pub(crate) fn command(args: &SteadyArgs) -> Result<Status, Failure> {
    let Some(scene) = args.scene() else {
        return machine::command(args);
    };
    let input = Input::load(&scene)?;
    let ready = input.prepare(&[])?;
    let folder = folder(args, &ready.scene().name)?;
    if !args.quiet && !ready.reading.warnings.is_empty() {
        console::diagnose(&ready.reading.warnings);
    }
    let mut spec = ready.scene().steady.clone().unwrap_or_default();
    asked(&args.question, &mut spec)?;
    let answer = steady_motion(&ready.system, &ready.settings, &spec)
        .map_err(|faults| Failure::from(ready.reading.places.diagnose(&faults)))?;
    let verdicts = verdicts(args, &ready, &answer);
    let rows = match &answer {
        Answer::Rigid(answer) => answer.motion.rows(ROWS),
        Answer::Periodic(_) => Vec::new(),
    };
    let name = &ready.scene().name;
    let (rigid, periodic) = match &answer {
        Answer::Rigid(answer) => (
            Some(Shown {
                title: name,
                cycle: answer.cycle,
                figures: &answer.figures,
                rows: &rows,
                regime: answer.regime.as_ref(),
                flywheel: answer.flywheel.as_ref(),
                agreement: Some(&answer.agreement),
                halving: None,
            }),
            None,
        ),
        Answer::Periodic(answer) => (None, Some(answer.as_ref())),
    };
    let answered = Answered {
        title: name,
        hash: &ready.scene().hash,
        scene: Some(input.text()),
        document: document(&ready, &answer, &verdicts)?,
        rigid,
        periodic,
    };
    tell(args, &answered, folder.as_ref())?;
    if !args.quiet {
        expected::talk(&verdicts);
    }
    match expected::hold(&verdicts) {
        true => Ok(Status::Answered),
        false => Ok(Status::NotTrusted),
    }
}

/// Puts what the command line asks in place of what the scene asks.
fn asked(args: &QuestionArgs, spec: &mut SteadySpec) -> Result<(), Failure> {
    let quantity = |name: &str, text: &Option<String>, wanted: Quantity, bounds: Bounds| {
        let read = |text: &String| read_argument(name, text, |slot| slot.quantity(wanted, bounds));
        text.as_ref().map(read).transpose()
    };
    let speed = quantity(
        "--mean-speed",
        &args.mean_speed,
        q::ANGULAR_SPEED,
        Bounds::POSITIVE,
    )?;
    spec.mean_speed = speed.or(spec.mean_speed);
    let cycle = quantity(
        "--cycle",
        &args.cycle,
        q::ANGLE,
        Bounds::up_to(MOST_TURNS * std::f64::consts::TAU),
    )?;
    spec.cycle = cycle.unwrap_or(spec.cycle);
    let bounds = Bounds::between(1e-6, 1.99);
    let fluctuation = quantity("--fluctuation", &args.fluctuation, q::NUMBER, bounds)?;
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

fn folder(args: &SteadyArgs, name: &str) -> Result<Option<OutputFolder>, Failure> {
    Ok(OutputFolder::asked(&args.out, name, &FILES)?)
}

/// Another machine than the scene's, or another question, has no expectations.
fn verdicts(args: &SteadyArgs, ready: &Ready, answer: &Answer) -> Vec<Verdict> {
    let asked = &args.question;
    let same = args.set.is_empty()
        && !asked.balance
        && asked.mean.is_none()
        && asked.periods.is_none()
        && [&asked.mean_speed, &asked.cycle, &asked.fluctuation]
            .iter()
            .all(|text| text.is_none());
    match same {
        true => check(&ready.scene().expect, answer),
        false => Vec::new(),
    }
}

/// The JSON document of a scene's steady motion.
fn document(ready: &Ready, answer: &Answer, verdicts: &[Verdict]) -> Result<Value, Failure> {
    #[derive(Serialize)]
    struct Document<'a> {
        dam: u32,
        scene: &'a str,
        hash: &'a str,
        #[serde(flatten)]
        answer: &'a Answer,
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
        expect: verdicts,
        diagnostics: doubts(ready),
    };
    Ok(serde_json::to_value(document).map_err(|error| error.to_string())?)
}

/// Prints the answer and writes its files.
fn tell(
    args: &SteadyArgs,
    answered: &Answered<'_>,
    folder: Option<&OutputFolder>,
) -> Result<(), Failure> {
    let csv = match &answered.rigid {
        Some(shown) => rows_csv(shown).map_err(|error| error.to_string())?,
        None => answered
            .periodic
            .map(orbit_csv)
            .transpose()?
            .unwrap_or_default(),
    };
    let files = || files(answered, &csv);
    let show = || show(args, answered, &csv);
    output::deliver(folder, "steady", answered.hash, files, show)?;
    if args.quiet {
        return Ok(());
    }
    if let Some(shown) = &answered.rigid {
        for warning in &shown.figures.warnings {
            console::talk(&format!("warning: {warning}"));
        }
    }
    if let Some(folder) = folder {
        folder.tell_report();
    }
    Ok(())
}

fn show(args: &SteadyArgs, answered: &Answered<'_>, csv: &str) -> Result<(), Failure> {
    if args.json {
        return console::json(&answered.document);
    }
    match (args.form, &answered.rigid, answered.periodic) {
        (Form::Csv, ..) => console::data(csv),
        (Form::Svg, Some(shown), _) => console::data(&wittenbauer(shown).svg(PICTURE.0, PICTURE.1)),
        (Form::Svg, None, _) => {
            let why = "only machines with rigid objects have an energy-mass diagram";
            Err(Failure::Other(why.to_owned()))
        }
        (Form::Text, Some(shown), _) => console::text(&rigid_text(shown)),
        (Form::Text, None, Some(answer)) => console::text(&periodic_text(answered.title, answer)),
        (Form::Text, None, None) => Ok(()),
    }
}

fn files(answered: &Answered<'_>, csv: &str) -> Result<Vec<ResultFile>, Failure> {
    let report = page(&SteadyReport {
        title: answered.title,
        rigid: answered.rigid,
        periodic: answered.periodic,
        scene: answered.scene,
        hash: answered.hash,
        version: env!("CARGO_PKG_VERSION"),
    });
    Ok(vec![
        ResultFile::new(FILES[0], format!("{:#}\n", answered.document)),
        ResultFile::new(FILES[1], csv),
        ResultFile::new(FILES[2], report),
    ])
}

/// Deviations over a period; parts have periods of their own, so that each row
/// is one value.
fn orbit_csv(answer: &crate::studies::steady::PeriodicAnswer) -> Result<String, Failure> {
    if let Some(drive) = &answer.drive {
        return Ok(drive_csv(answer, drive).map_err(|error| error.to_string())?);
    }
    let mut writer = csv::Writer::from_writer(Vec::new());
    let failed = |error: csv::Error| error.to_string();
    writer
        .write_record(["coordinate", "t [s]", "deviation"])
        .map_err(failed)?;
    for (name, points) in answer.parts.iter().flat_map(|part| &part.orbit) {
        for (time, value) in points {
            let row = [name.clone(), format!("{time:?}"), format!("{value:?}")];
            writer.write_record(row).map_err(failed)?;
        }
    }
    let bytes = writer.into_inner().map_err(|error| error.to_string())?;
    Ok(String::from_utf8(bytes).map_err(|error| error.to_string())?)
}

/// The JSON document of a machine that is no scene.
fn machine_document(title: &str, answer: &impl Serialize) -> Value {
    json!({ "dam": 1, "machine": title, "rigid": answer })
}
