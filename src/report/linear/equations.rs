//! Linear equations as findings and as a document.

use super::left_out_table;
use crate::report::findings::{Cell, Figure, Findings, Layout, Section, Source, Table, Value};
use crate::report::plot::{Axis, Plot, Series};
use crate::report::quantity::{counted, with_unit};
use crate::report::verdict::{Sort, Verdict, capitalised};
use crate::studies::linear::{Linearisation, Mode, Signal, TreeModes};
use serde_json::{Value as Json, json};

/// Most modes whose shapes are drawn.
const DRAWN: usize = 6;

/// Digits of results.
const DIGITS: usize = 7;

/// Natural modes, inputs and outputs, and objects that are left out.
pub fn equations_findings<'a>(
    scene: &str,
    found: &Linearisation,
    source: Source<'a>,
) -> Findings<'a> {
    let mut sections = Vec::new();
    for tree in &found.modes {
        let section = Section::new(format!("Natural modes behind the law of {}", tree.law));
        let section = section.table(modes_table(tree)).figures(figures(tree));
        let section = section.legend(
            "Effective inertia moves with a mode under the law. The share of compliance says how \
             much of the static deflection of the output a mode makes.",
        );
        sections.push(section);
        if tree.masses.len() > 1 {
            let shapes = Section::new("Mode shapes").table(shapes_table(tree));
            sections.push(shapes.charts(Layout::Wide(360.0), "", vec![shapes_chart(tree)]));
        }
    }
    let space = &found.state_space;
    sections.push(Section::new("Inputs").table(signals_table(&space.inputs)));
    sections.push(Section::new("Outputs").table(signals_table(&space.outputs)));
    let left_out = left_out_table(&found.left_out);
    sections.push(Section::new("Without linear equations").table(left_out));
    sections.retain(|section| !section.is_empty());
    Findings {
        title: scene.to_owned(),
        subtitle: format!("linear equations of a {}", found.case),
        answer: Some(answer(found)),
        warnings: Vec::new(),
        sections,
        source,
    }
}

fn answer(found: &Linearisation) -> Verdict {
    let lowest = found.modes.iter().flat_map(|tree| &tree.modes);
    let lowest = lowest
        .map(|mode| mode.frequency)
        .fold(f64::INFINITY, f64::min);
    let headline = format!(
        "The lowest natural frequency is {}.",
        with_unit(lowest, "Hz", 5)
    );
    let space = &found.state_space;
    let text = format!(
        "{}, {} and {}. {}.",
        counted(space.states.len(), "state"),
        counted(space.inputs.len(), "input"),
        counted(space.outputs.len(), "output"),
        capitalised(&found.validity)
    );
    Verdict::answer(Sort::Recommended, headline, text)
}

fn modes_table(tree: &TreeModes) -> Table {
    let unit = match tree.masses.first().map(|signal| signal.unit.as_str()) {
        Some("m") => "kg",
        _ => "kg m²",
    };
    let row = |(number, mode): (usize, &Mode)| {
        let damped = match mode.overdamped {
            true => Cell::from("overdamped"),
            false => Cell::known_number(mode.damped_frequency, "Hz", DIGITS),
        };
        vec![
            Value::new((number + 1) as f64, "", 4).into(),
            Value::new(mode.frequency, "Hz", DIGITS).into(),
            damped,
            Value::new(mode.damping_ratio, "", DIGITS).into(),
            Value::new(mode.effective_inertia, unit, 5).into(),
            Value::new(100.0 * mode.compliance_share, "%", 5).into(),
        ]
    };
    let heads = [
        ">mode",
        ">undamped",
        ">damped",
        ">ζ",
        ">effective inertia",
        ">compliance",
    ];
    Table::new(heads).rows(tree.modes.iter().enumerate().map(row))
}

fn figures(tree: &TreeModes) -> Vec<Figure> {
    let unit = match tree.masses.first().map(|signal| signal.unit.as_str()) {
        Some("m") => "m/N",
        _ => "rad/(N m)",
    };
    let note = match tree.uncoupled {
        true => "dampers do not couple the modes",
        false => "dampers couple the modes: ζ is of first order, the poles are exact",
    };
    let slowest = tree
        .poles
        .iter()
        .map(|pole| -pole[0])
        .fold(f64::INFINITY, f64::min);
    vec![
        Figure::number(
            &format!("static compliance of {}", tree.output),
            tree.static_compliance,
            unit,
            DIGITS,
        ),
        Figure::number("slowest decay", slowest, "1/s", 5).with_note(note),
    ]
}

fn shapes_table(tree: &TreeModes) -> Table {
    let heads = (1..=tree.modes.len().min(DRAWN)).map(|number| format!(">mode {number}"));
    let heads: Vec<String> = ["mass".to_owned()].into_iter().chain(heads).collect();
    let row = |(place, mass): (usize, &Signal)| {
        let values = tree.modes.iter().take(DRAWN);
        let values = values.map(|mode| Value::new(mode.shape[place], "", 5).into());
        [Cell::from(mass.name.as_str())]
            .into_iter()
            .chain(values)
            .collect::<Vec<Cell>>()
    };
    let rows = tree.masses.iter().enumerate().map(row);
    Table::new(heads.iter().map(String::as_str)).rows(rows)
}

/// Shapes over the number of the mass, from the law at 0.
fn shapes_chart(tree: &TreeModes) -> Plot {
    let curve = |(number, mode): (usize, &Mode)| {
        let points = mode.shape.iter().enumerate();
        let points = points.map(|(place, value)| ((place + 1) as f64, *value));
        Series::line(
            &format!("mode {}", number + 1),
            [(0.0, 0.0)].into_iter().chain(points).collect(),
        )
    };
    let curves = tree.modes.iter().take(DRAWN).enumerate().map(curve);
    Plot::new(
        format!(
            "Mode shapes behind the law of {}, 1 at {}",
            tree.law, tree.output
        ),
        Axis::new("mass", ""),
        "",
        curves.collect(),
    )
}

fn signals_table(signals: &[Signal]) -> Table {
    let rows = signals
        .iter()
        .map(|one| vec![one.name.as_str(), one.unit.as_str()]);
    Table::new(["name", "SI unit"]).rows(rows)
}

/// The document: matrices, names, modes.
///
/// # Errors
/// It cannot be written as JSON.
pub fn equations_document(
    scene: &str,
    hash: &str,
    found: &Linearisation,
) -> serde_json::Result<Json> {
    let mut document = serde_json::to_value(found)?;
    document["dam"] = json!(1);
    document["scene"] = json!(scene);
    document["hash"] = json!(hash);
    Ok(document)
}
