//! Linear equations as findings and as a document.

use super::left_out_table;
use crate::report::findings::{Cell, Figure, Findings, Layout, Section, Source, Table, Value};
use crate::report::plot::{Axis, Mark, Plot, Rule, Series, Shape};
use crate::report::quantity::{counted, significant, with_unit};
use crate::report::verdict::{Sort, Verdict, capitalised};
use crate::studies::linear::{Linearisation, Mode, OperatingPoint, Signal, TreeModes};
use serde_json::{Value as Json, json};
use std::f64::consts::TAU;

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
    if found.modes.is_empty() {
        let steady = Section::new("Steady turning").table(operating_table(found));
        sections.push(steady);
        let eigenvalues = Section::new("Eigenvalues").table(eigenvalues_table(found));
        sections.push(eigenvalues.charts(Layout::Wide(360.0), "", vec![eigenvalues_chart(found)]));
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
    let unstable = found.eigenvalues.iter().any(|own| own[0] > 0.0);
    let headline = match (found.modes.is_empty(), unstable) {
        (false, _) => format!(
            "The lowest natural frequency is {}.",
            with_unit(lowest, "Hz", 5)
        ),
        (true, true) => "The steady turning is unstable: a disturbance grows.".to_owned(),
        (true, false) => {
            let slowest = found.eigenvalues.iter().map(|own| -own[0]);
            let slowest = slowest.fold(f64::INFINITY, f64::min);
            let time = with_unit(1.0 / slowest, "s", 4);
            format!("The steady turning is stable: the slowest disturbance decays in {time}.")
        }
    };
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

fn operating_table(found: &Linearisation) -> Table {
    let row = |own: &OperatingPoint| {
        let value = Value::new(own.value, &own.unit, DIGITS);
        vec![Cell::from(own.name.as_str()), value.into()]
    };
    Table::new(["quantity", ">value"]).rows(found.operating_point.iter().map(row))
}

/// Each eigenvalue with the frequency and the damping ratio of its oscillation.
fn eigenvalues_table(found: &Linearisation) -> Table {
    let row = |&[re, im]: &[f64; 2]| {
        let size = re.hypot(im);
        let (frequency, ratio) = match im > 0.0 {
            true => (Some(im / TAU), Some(-re / size)),
            false => (None, None),
        };
        vec![
            Cell::from(Value::new(re, "1/s", DIGITS)),
            Value::new(im, "1/s", DIGITS).into(),
            Cell::known_number(frequency, "Hz", DIGITS),
            Cell::known_number(ratio, "", DIGITS),
        ]
    };
    let heads = [">real part", ">imaginary part", ">frequency", ">ζ"];
    Table::new(heads).rows(found.eigenvalues.iter().map(row))
}

/// The eigenvalues in the plane, with their conjugates.
fn eigenvalues_chart(found: &Linearisation) -> Plot {
    let both = found
        .eigenvalues
        .iter()
        .flat_map(|&[re, im]| [(re, im), (re, -im)]);
    let points: Vec<(f64, f64)> = both.collect();
    let marks = points.iter().map(|&(re, im)| {
        let [re, im] = [re, im].map(|part| significant(part, 6));
        Mark::new(Shape::Good, format!("{re} + {im}i"))
    });
    let marks = marks.collect();
    Plot {
        rules: vec![Rule::upright(0.0)],
        ..Plot::new(
            "Eigenvalues",
            Axis::new("real part", "1/s"),
            "1/s",
            vec![Series::marked("eigenvalues", points, marks)],
        )
    }
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
