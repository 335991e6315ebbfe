//! Machines that are no scene: tables and expressions.

use super::args::SteadyArgs;
use super::{
    RIGID_REPEATS, SteadyOutput, apply_arguments, folder, machine_document, machine_source,
    print_answer,
};
use crate::cli::asker::Asker;
use crate::cli::failure::Failure;
use crate::cli::status::Status;
use crate::dynamics::steady::flywheel::{Flywheel, size_of_table};
use crate::dynamics::steady::{
    Formula, FunctionKind, Profile, Question, Refusal, TableFigures, least_cycle,
};
use crate::frontend::scene::SteadySpec;
use crate::report::steady::SteadyReport;
use crate::studies::steady::{ROWS, by_energy, csv, rigid_checks};
use serde::Serialize;
use std::io::Read;
use std::path::Path;

/// Largest file that is read at all.
const LARGEST: u64 = 65 << 20;

pub(super) fn command(args: &SteadyArgs, asker: &dyn Asker) -> Result<Status, Failure> {
    if args.question.periods.is_some() {
        let why = format!("--periods has no effect: {RIGID_REPEATS}");
        return Err(Failure::Other(why));
    }
    let mut spec = SteadySpec::default();
    apply_arguments(&args.question, &mut spec)?;
    let Some(mean_speed) = spec.mean_speed else {
        return Err(Failure::Other(
            "no mean speed is given; for example --mean-speed \"300 rpm\"".to_owned(),
        ));
    };
    let question = Question {
        mean: spec.mean,
        tolerance: spec.tolerance,
        balance: spec.balance,
        ..Question::new(mean_speed)
    };
    match &args.machine.table {
        Some(path) => run_table((args, asker), path, &spec, &question),
        None => formulas((args, asker), &spec, &question),
    }
}

/// A refusal in terms of the options.
fn refused(refusal: &Refusal) -> Failure {
    let line = |message: &str, hint: &str| match hint {
        "" => message.to_owned(),
        hint => format!("{message}; {hint}"),
    };
    Failure::Other(match refusal {
        Refusal::Input { faults } => {
            let one = |f: &crate::dynamics::steady::Field| {
                let name = f.field.replace('_', "-");
                line(&format!("--{name}: {}", f.message), &f.hint)
            };
            faults.iter().map(one).collect::<Vec<_>>().join("\nerror: ")
        }
        refusal => line(
            &refusal.message(),
            &refusal.hint().replace("`balance`", "--balance"),
        ),
    })
}

/// The steady motion on a table, as JSON tells it.
#[derive(Serialize)]
struct TableAnswer<'a> {
    #[serde(flatten)]
    figures: &'a TableFigures,
    #[serde(skip_serializing_if = "Option::is_none")]
    flywheel: Option<&'a Flywheel>,
}

fn run_table(
    (args, asker): (&SteadyArgs, &dyn Asker),
    path: &Path,
    spec: &SteadySpec,
    question: &Question,
) -> Result<Status, Failure> {
    let shown = path.display().to_string();
    let mut text = String::new();
    std::fs::File::open(path)
        .and_then(|file| file.take(LARGEST).read_to_string(&mut text))
        .map_err(|error| format!("cannot read the table `{shown}`: {error}"))?;
    let table = csv::table(&text, spec.cycle).map_err(|refusal| refused(&refusal))?;
    let (flywheel, motion) = match spec.fluctuation {
        None => table
            .find_steady_motion(question)
            .map(|motion| (None, motion)),
        Some(wanted) => size_of_table(&table, question, wanted)
            .map(|(flywheel, motion)| (Some(flywheel), motion)),
    }
    .map_err(|refusal| refused(&refusal))?;
    let folder = folder(args, &shown)?;
    let rows = motion.rows();
    let document = machine_document(
        &shown,
        &TableAnswer {
            figures: &motion.figures,
            flywheel: flywheel.as_ref(),
        },
        &rigid_checks(&motion.figures.steady, None),
    );
    let motion = SteadyReport {
        title: &shown,
        cycle: table.cycle(),
        figures: &motion.figures.steady,
        rows: &rows,
        regime: None,
        flywheel: flywheel.as_ref(),
        agreement: None,
        halving: motion.figures.halving.as_ref(),
    };
    let found = SteadyOutput::rigid(&motion, document, machine_source(&shown));
    print_answer((args, asker), found, folder.as_ref())
}

fn formulas(
    (args, asker): (&SteadyArgs, &dyn Asker),
    spec: &SteadySpec,
    question: &Question,
) -> Result<Status, Failure> {
    let read =
        |name: &str, text: &str| Formula::new(name, text).map_err(|refusal| refused(&refusal));
    let machine = &args.machine;
    let inertia = read("inertia", machine.inertia.as_deref().unwrap_or_default())?;
    let (given, other, symbol) = match (&machine.work, &machine.moment) {
        (Some(work), None) => (FunctionKind::Work, read("work", work)?, "A"),
        (None, Some(moment)) => (FunctionKind::Moment, read("moment", moment)?, "M"),
        _ => {
            let why = "--inertia needs --work or --moment beside it";
            return Err(Failure::Other(why.to_owned()));
        }
    };
    let title = format!("J = {}, {symbol} = {}", inertia.text(), other.text());
    let mut at = |_: usize, position: f64| [inertia.at(position), other.at(position)];
    // What is wrong within the cycle asked for is said first.
    let answer = Profile::new(spec.cycle, &[], given, &mut at)
        .and_then(|profile| {
            let cycle = least_cycle(spec.cycle, &inertia, (given, &other))?;
            match cycle == spec.cycle {
                true => Ok(profile),
                false => Profile::new(cycle, &[], given, &mut at),
            }
        })
        .and_then(|profile| by_energy(&profile, question, spec.fluctuation))
        .map_err(|refusal| refused(&refusal))?
        .with_check_warnings();
    let folder = folder(args, &title)?;
    let rows = answer.motion.rows(ROWS);
    let document = machine_document(&title, &answer, &answer.checks());
    let motion = SteadyReport {
        title: &title,
        cycle: answer.cycle,
        figures: &answer.figures,
        rows: &rows,
        regime: None,
        flywheel: answer.flywheel.as_ref(),
        agreement: Some(&answer.agreement),
        halving: None,
    };
    let found = SteadyOutput::rigid(&motion, document, machine_source(&title));
    print_answer((args, asker), found, folder.as_ref())
}
