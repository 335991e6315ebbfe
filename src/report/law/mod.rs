//! Laws of motion, strokes, cycles and comparisons of laws as findings and tables.

mod compare;
mod curve;
mod cycle;
mod stroke;
#[cfg(test)]
mod tests;

pub use compare::{comparison_findings, comparison_rows};
pub use cycle::{cycle_findings, cycle_rows};
pub use stroke::{StrokeExtras, stroke_findings, stroke_rows};

use super::csv::{Field, Rows};
use super::findings::{Figure, Findings, Item, Section, Source, Table, Value};
use super::quantity::{DIGITS, result, significant};
use super::verdict::{Sort, Verdict, capitalised};
use crate::frontend::object::law::AnyLaw;
use crate::kinematics::motion::LawName;
use crate::kinematics::motion::law::{Jump, Law, LawConstants, Peak};
use curve::Curve;
use serde_json::{Value as Json, json};

/// A law with its constants, for tables.
#[derive(Clone, Debug, PartialEq)]
pub struct LawRow {
    /// Name of the law.
    pub name: String,
    /// Description in a few words.
    pub words: String,
    /// Constants of the law.
    pub constants: LawConstants,
}

impl LawRow {
    /// The row of a law that was asked for by its name or its numbers.
    pub fn of(asked: &AnyLaw, law: &Law) -> Self {
        let name = asked.words();
        let words = LawName::ALL.into_iter().find(|known| known.name() == name);
        let kind = match asked {
            AnyLaw::Stroke(_) => "law of a full stroke",
            AnyLaw::RunUp(_) => "law of a run-up",
        };
        Self {
            words: words.map_or(kind, LawName::words).to_owned(),
            name,
            constants: law.constants(),
        }
    }

    /// The JSON document of the law.
    pub fn document(&self, law: &Law) -> Json {
        json!({
            "dam": 1, "law": self.name, "run_up": law.is_run_up(), "joints": law.joints(),
            "constants": self.constants
        })
    }
}

/// A constant shown in tables: heading, name in files and value.
type Constant = (&'static str, &'static str, fn(&LawConstants) -> f64);

const CONSTANTS: [Constant; 7] = [
    (">C_v", "speed", |law| law.speed.value),
    (">C_a", "acceleration", |law| law.acceleration.value),
    (">least θ″", "deceleration", |law| law.deceleration.value),
    (">C_j", "jerk", |law| law.jerk.value),
    (">C_m", "torque_factor", |law| law.torque_factor),
    (">σ", "filling", |law| law.filling),
    (">τ*", "centre", |law| law.centre),
];

/// Laws side by side: greatest speed, acceleration, deceleration, jerk, torque
/// factor, filling coefficient and centre of gravity, continuity class.
fn constants_table(rows: &[LawRow]) -> Table {
    let heads = CONSTANTS.map(|(head, ..)| head);
    let names = std::iter::once("law").chain(heads).chain(["class"]);
    let row = |row: &LawRow| {
        let values = CONSTANTS.map(|(.., read)| Value::new(read(&row.constants), "", 7));
        let name = std::iter::once(row.name.as_str().into());
        let class = class(row.constants.continuity).into();
        name.chain(values).chain([class]).collect::<Vec<Value>>()
    };
    Table::new(names).rows(rows.iter().map(row))
}

/// All named laws, and their names in the guideline VDI 2143.
pub fn list_findings(strokes: &[(LawRow, Option<&str>)], run_ups: &[LawRow]) -> Findings<'static> {
    let rows: Vec<LawRow> = strokes.iter().map(|(row, _)| row.clone()).collect();
    let names = strokes.iter().filter_map(|(row, vdi)| Some((row, (*vdi)?)));
    let names = names.map(|(row, vdi)| Figure::new(&row.name, vdi));
    Findings {
        title: "Laws of motion".to_owned(),
        subtitle: "stroke 1, duration 1".to_owned(),
        answer: None,
        warnings: Vec::new(),
        sections: vec![
            Section::new("Full strokes, from rest to rest").table(constants_table(&rows)),
            Section::new("Run-ups, from rest to uniform motion; run-outs are counted backwards")
                .table(constants_table(run_ups)),
            Section::new("Names in the guideline VDI 2143").figures(names.collect()),
        ],
        source: Source::default(),
    }
}

/// Constants of laws, a row each.
pub fn constants_rows<'r>(rows: impl IntoIterator<Item = &'r LawRow>) -> Rows {
    let names = CONSTANTS.map(|(_, name, _)| name);
    let header = std::iter::once("law").chain(names).chain(["continuity"]);
    let rows = rows.into_iter().map(|row| {
        let mut cells = vec![Field::from(row.name.as_str())];
        cells.extend(CONSTANTS.map(|(.., read)| read(&row.constants).into()));
        cells.push(row.constants.continuity.to_string().into());
        cells
    });
    Rows::new(header, rows)
}

fn class(continuity: usize) -> String {
    match continuity {
        0 => "C0, hard shock".to_owned(),
        1 => "C1, soft shock".to_owned(),
        3 => "C3 or more".to_owned(),
        order => format!("C{order}"),
    }
}

/// All that is known of one law.
pub fn law_findings(row: &LawRow, law: &Law) -> Findings<'static> {
    let found = &row.constants;
    let kind = match law.is_run_up() {
        true => "run-up, from rest to uniform motion",
        false => "full stroke, from rest to rest",
    };
    let peak = |name: &str, peak: Peak| {
        let at = result(peak.at, 8);
        Figure::number(name, peak.value, "", 10).with_note(format!("at τ = {at}"))
    };
    let plain = |name: &str, value: f64| Figure::number(name, value, "", 10);
    let mut figures = vec![
        peak("greatest speed C_v", found.speed),
        peak("greatest acceleration C_a", found.acceleration),
        peak("greatest deceleration", found.deceleration),
        peak("greatest jerk C_j", found.jerk),
        peak("greatest driving torque θ′θ″", found.torque),
        peak("greatest braking torque θ′θ″", found.braking_torque),
        plain("torque factor C_m", found.torque_factor),
        plain("filling coefficient σ", found.filling),
        plain("centre of gravity τ*", found.centre),
    ];
    if let (Some(filling), Some(centre)) = (found.filling_after, found.centre_after) {
        figures.push(plain("filling coefficient, slowing down", filling));
        figures.push(plain("centre of gravity, slowing down", centre));
    }
    figures.push(Figure::new("continuity", class(found.continuity)));
    let joints: Vec<String> = law.joints().iter().map(|t| significant(*t, 8)).collect();
    if !joints.is_empty() {
        figures.push(Figure::new("joints", format!("τ = {}", joints.join(", "))));
    }
    let (sort, said) = shock_verdict(&found.jumps);
    let headline = format!(
        "Greatest acceleration C_a = {}, greatest speed C_v = {}.",
        result(found.acceleration.value, DIGITS),
        result(found.speed.value, DIGITS)
    );
    let heading = format!("Results: {kind}; normal form: stroke 1, duration 1");
    Findings {
        title: capitalised(&row.name.replace('_', " ")),
        subtitle: row.words.clone(),
        answer: Some(Verdict::answer(sort, headline, said.to_owned())),
        warnings: Vec::new(),
        sections: vec![
            Curve::of_law(law, found).section(&row.name.replace('_', " ")),
            Section::new(heading)
                .figures(figures)
                .item(shocks(&found.jumps, ["τ", ""])),
        ],
        source: Source::default(),
    }
}

/// θ and its derivatives: `count` equal steps, and both sides of every joint.
pub fn law_rows(law: &Law, count: usize) -> Rows {
    curve::rows(["tau", "theta"], ["", ""], &curve::of_law(law, count))
}

/// Hard and soft shocks, one a line.
fn shocks(jumps: &[Jump], [symbol, unit]: [&str; 2]) -> Item<'static> {
    let line = |jump: &Jump| {
        let (kind, what) = match jump.order {
            1 => ("hard shock", "speed"),
            _ => ("soft shock", "acceleration"),
        };
        let (before, after) = (significant(jump.before, 6), significant(jump.after, 6));
        let at = Value::angle_or(jump.at, unit, 8).words();
        format!("{kind} at {symbol} = {at}: {what} jumps from {before} to {after}")
    };
    let jumps = jumps.iter().filter(|jump| jump.order < 3);
    Item::Notes(jumps.map(line).collect())
}

/// What is to be said of a law's shocks: nothing good or bad but that there are none.
fn shock_verdict(jumps: &[Jump]) -> (Sort, &'static str) {
    match jumps.iter().map(|jump| jump.order).min() {
        Some(1) => (
            Sort::Mechanism,
            "Its speed jumps: a hard shock, that no mechanism bears.",
        ),
        Some(2) => (
            Sort::Good,
            "Its acceleration jumps: a soft shock, that excites vibrations.",
        ),
        _ => (
            Sort::Good,
            "Speed and acceleration are continuous: there is no shock.",
        ),
    }
}
