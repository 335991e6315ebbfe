//! `dam law`: laws of motion.

pub(crate) mod args;
mod compare;
mod cycle;
mod files;
mod synthesize;

use super::console;
use super::failure::Failure;
use super::status::Status;
use crate::fault::Fault;
use crate::frontend::object::law::AnyLaw;
use crate::frontend::object::law::any_law;
use crate::frontend::object::law::run_up_law;
use crate::kinematics::motion::Law;
use crate::kinematics::motion::LawName;
use crate::kinematics::motion::RunLawName;
use crate::report::law::LawPage;
use crate::report::law::LawRow;
use crate::report::law::constants_csv;
use crate::report::law::constants_table;
use crate::report::law::law_chart;
use crate::report::law::law_csv;
use crate::report::law::law_parts;
use crate::report::law::law_text;
use crate::report::law::shocks_said;
use crate::report::quantity::significant;
use args::LawCommand;
use args::ListArgs;
use args::ShowArgs;
use files::Results;
use serde_json::{Value, json};

/// Size of pictures (pixels).
const PICTURE: (f64, f64) = (900.0, 480.0);

/// Runs the command.
pub(crate) fn command(command: &LawCommand) -> Result<Status, Failure> {
    match command {
        LawCommand::List(args) => list(args)?,
        LawCommand::Show(args) => show(args)?,
        LawCommand::Synthesize(args) => synthesize::command(args)?,
        LawCommand::Cycle(args) => cycle::command(args)?,
        LawCommand::Compare(args) => return compare::command(args),
    }
    Ok(Status::Answered)
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
        let strokes: Vec<Value> = strokes
            .iter()
            .map(|(row, vdi)| {
                let mut entry = entry(row);
                entry["vdi_2143"] = json!(vdi);
                entry
            })
            .collect();
        let run_ups: Vec<Value> = run_ups.iter().map(entry).collect();
        console::json(&json!({ "dam": 1, "strokes": strokes, "run_ups": run_ups }))?;
        return Ok(());
    }
    let rows: Vec<LawRow> = strokes.iter().map(|(row, _)| row.clone()).collect();
    if args.csv {
        let all: Vec<LawRow> = rows.into_iter().chain(run_ups).collect();
        console::data(&constants_csv(&all).map_err(|error| error.to_string())?)?;
        return Ok(());
    }
    console::data("Full strokes, from rest to rest; stroke 1, duration 1\n\n")?;
    console::text(&constants_table(&rows))?;
    console::data("\nRun-ups, from rest to uniform motion; run-outs are counted backwards\n\n")?;
    console::text(&constants_table(&run_ups))?;
    console::data("\nNames in the guideline VDI 2143\n\n")?;
    for (row, vdi) in strokes {
        if let Some(vdi) = vdi {
            console::data(&format!("{:<20} {vdi}\n", row.name))?;
        }
    }
    Ok(())
}

fn entry(row: &LawRow) -> Value {
    json!({ "name": row.name, "what": row.words, "constants": row.constants })
}

fn row(name: &str, words: &str, law: &AnyLaw) -> Result<LawRow, Failure> {
    Ok(LawRow {
        name: name.to_owned(),
        words: words.to_owned(),
        constants: law.law().map_err(|faults| told(&faults, ""))?.constants(),
    })
}

fn show(args: &ShowArgs) -> Result<(), Failure> {
    let spec = match args.run_up {
        true => AnyLaw::RunUp(run_up_law(&args.law)?),
        false => any_law(&args.law)?,
    };
    let law: Law = spec.law().map_err(|faults| told(&faults, ""))?;
    let name = spec.words();
    let words = LawName::ALL.into_iter().find(|known| known.name() == name);
    let kind = match spec {
        AnyLaw::Stroke(_) => "law of a full stroke",
        AnyLaw::RunUp(_) => "law of a run-up",
    };
    let row = LawRow {
        words: words.map_or(kind, LawName::words).to_owned(),
        name,
        constants: law.constants(),
    };
    let samples = args.form.samples as usize;
    let document = json!({
        "dam": 1, "law": row.name, "run_up": law.is_run_up(), "joints": law.joints(),
        "constants": row.constants
    });
    let (text, csv) = (law_text(&row, &law), law_csv(&law, samples));
    let csv = csv.map_err(|error| error.to_string())?;
    let mut charts = vec![law_chart(&row.name, &law, &row.constants)];
    charts.extend(law_parts(&law));
    let (sound, shocks) = shocks_said(&row.constants.jumps);
    let answer = format!(
        "Greatest acceleration C_a = {}, greatest speed C_v = {}. {shocks}",
        significant(row.constants.acceleration.value, 6),
        significant(row.constants.speed.value, 6)
    );
    let results = Results {
        document: &document,
        csv,
        page: LawPage {
            title: &row.name,
            subtitle: &row.words,
            answer: (sound, answer),
            text: &text,
            charts: &charts,
            scene: None,
            hash: "",
            version: env!("CARGO_PKG_VERSION"),
        },
    };
    let shown = (args.form.json, args.form.form);
    files::deliver(&args.form.out, false, &results, shown)
}

/// Faults of arguments; their paths are names of options after `prefix`.
pub(crate) fn told(faults: &[Fault], prefix: &str) -> Failure {
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
