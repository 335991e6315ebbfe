//! `dam law`: laws of motion.

pub(crate) mod args;
mod compare;
mod cycle;
mod synthesize;

use super::answer::{Answer, AnswerForm, Content, PAGE, files, picture};
use super::args::scene::OutArgs;
use super::asker::Asker;
use super::console;
use super::failure::Failure;
use super::output::OutputFolder;
use super::status::Status;
use crate::fault::Fault;
use crate::frontend::object::law::{AnyLaw, any_law, run_up_law};
use crate::kinematics::motion::{Law, LawName, RunLawName};
use crate::report::csv::Rows;
use crate::report::findings::Findings;
use crate::report::law::{LawRow, constants_rows, law_findings, law_rows, list_findings};
use args::{LawCommand, LawForm, ListArgs, ShowArgs};
use serde_json::{Value, json};

const FILES: [&str; 4] = ["law.json", "law.csv", "law.svg", PAGE];

/// Runs the command.
pub(crate) fn command(command: &LawCommand, asker: &dyn Asker) -> Result<Status, Failure> {
    match command {
        LawCommand::List(args) => list(args)?,
        LawCommand::Show(args) => show(args, asker)?,
        LawCommand::Synthesize(args) => synthesize::command(args, asker)?,
        LawCommand::Cycle(args) => cycle::command(args, asker)?,
        LawCommand::Compare(args) => return compare::command(args, asker),
    }
    Ok(Status::Answered)
}

/// Writes the files, if a folder was asked for, and shows the answer: as JSON (`true`) or
/// in a form.
fn deliver(
    asker: &dyn Asker,
    (args, quiet): (&OutArgs, bool),
    (findings, document): (&Findings<'_>, Value),
    rows: &Rows,
    (json, form): (bool, LawForm),
) -> Result<(), Failure> {
    let folder = OutputFolder::from_args(args, &findings.title, &FILES)?;
    let answer = Answer {
        command: "law",
        findings,
        document: document.into(),
        files: files(
            FILES,
            [
                Content::Document,
                Content::made(|| rows.csv()),
                Content::made(|| picture(findings.first_chart())),
                Content::Page,
            ],
        ),
        quiet,
    };
    let form = match form {
        LawForm::Text => AnswerForm::Text,
        LawForm::Csv => AnswerForm::File(FILES[1]),
        LawForm::Svg => AnswerForm::File(FILES[2]),
    };
    asker.deliver(&answer, folder.as_ref(), AnswerForm::json_or(json, form))
}

fn list(args: &ListArgs) -> Result<(), Failure> {
    let mut strokes = Vec::new();
    for name in LawName::ALL {
        let law = AnyLaw::Stroke(name.into());
        strokes.push((row(name.name(), name.words(), &law)?, name.vdi_name()));
    }
    let mut run_ups = Vec::new();
    for name in RunLawName::ALL {
        let (s1, s2) = name.shares();
        let words = format!("modified trapezoid s1 = {s1}, s2 = {s2}");
        run_ups.push(row(name.name(), &words, &AnyLaw::RunUp(name.into()))?);
    }
    if args.json {
        let strokes = strokes.iter().map(|(row, vdi)| {
            let mut entry = law_entry(row);
            entry["vdi_2143"] = json!(vdi);
            entry
        });
        let strokes: Vec<Value> = strokes.collect();
        let run_ups: Vec<Value> = run_ups.iter().map(law_entry).collect();
        return console::json(&json!({ "dam": 1, "strokes": strokes, "run_ups": run_ups }));
    }
    if args.csv {
        let all = strokes.iter().map(|(row, _)| row).chain(&run_ups);
        return console::data(&constants_rows(all).csv());
    }
    console::findings(&list_findings(&strokes, &run_ups))
}

fn law_entry(row: &LawRow) -> Value {
    json!({ "name": row.name, "what": row.words, "constants": row.constants })
}

fn row(name: &str, words: &str, law: &AnyLaw) -> Result<LawRow, Failure> {
    Ok(LawRow {
        name: name.to_owned(),
        words: words.to_owned(),
        constants: law
            .read_law()
            .map_err(|faults| argument_failure(&faults, ""))?
            .constants(),
    })
}

fn show(args: &ShowArgs, asker: &dyn Asker) -> Result<(), Failure> {
    let spec = match args.run_up {
        true => AnyLaw::RunUp(run_up_law(&args.law)?),
        false => any_law(&args.law)?,
    };
    let law: Law = spec
        .read_law()
        .map_err(|faults| argument_failure(&faults, ""))?;
    let row = LawRow::of(&spec, &law);
    let document = row.document(&law);
    let rows = law_rows(&law, args.form.samples as usize);
    let found = (&law_findings(&row, &law), document);
    let shown = (args.form.json, args.form.form);
    deliver(asker, (&args.form.out, false), found, &rows, shown)
}

/// Faults of arguments; their paths are names of options after `prefix`.
pub(crate) fn argument_failure(faults: &[Fault], prefix: &str) -> Failure {
    let lines = faults.iter().map(|fault| {
        let place = match fault.path.as_str() {
            "" => String::new(),
            path => format!("{prefix}{}: ", path.replace('_', "-")),
        };
        match fault.hint.as_str() {
            "" => format!("{place}{}", fault.message),
            hint => format!("{place}{}; {hint}", fault.message),
        }
    });
    Failure::Other(lines.collect::<Vec<_>>().join("\nerror: "))
}
