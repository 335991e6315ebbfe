//! What the kinematics of a linkage comes to.

use super::{drawing, input, input_sentence, multi_input, place_text, plots};
use crate::dynamics::model::Coordinate;
use crate::report::csv::Rows;
use crate::report::findings::{Cell, Figure, Findings, Item, Row, Section, Source, Table, Value};
use crate::report::quantity::{DIGITS, counted, significant, with_unit};
use crate::report::sentence::{Sentence, in_shown_units};
use crate::report::verdict::Verdict;
use crate::studies::kinematics::{
    AnyLinkage, Column, Equilibrium, Extremes, Kinematics, Quantity, Stroke,
};
use std::f64::consts::TAU;

/// An error above this share of a quantity would be seen in its digits.
const SHOWN: f64 = 1e-8;

/// Structure, drawing, strokes, transmission angles, charts, equilibria, extremes.
pub fn findings<'a>(scene: &str, found: &'a Kinematics, source: Source<'a>) -> Findings<'a> {
    let ends = [found.axis.values.first(), found.axis.values.last()];
    let [from, to] = ends.map(|end| end.map_or("–".to_owned(), |&at| place_text(found, at)));
    let mut sections = vec![
        Section::new("The mechanism moving").drawing(move |_| drawing(found).section("mechanism")),
        multi_input::machine_section(found),
        structure_section(found),
        multi_input::singular_section(found),
        Section::new("Strokes").table(strokes_table(found)),
        transmission_section(found),
    ];
    sections.extend(plots::plot_sections(found));
    sections.push(equilibria_section(found));
    sections.push(
        Section::new("Extremes").item(Item::Folded("all quantities".into(), extremes_table(found))),
    );
    sections.retain(|section| !section.is_empty());
    Findings {
        title: scene.to_owned(),
        subtitle: format!(
            "kinematics of {}, {}, {} {from} to {to}, {}",
            found.object,
            counted(found.axis.values.len(), "position"),
            found.axis.name,
            in_shown_units(&found.motion)
        ),
        answer: Some(answer(found)),
        warnings: found.warnings.clone(),
        sections,
        source,
    }
}

/// Where it stops, or how far its outputs and links go.
fn answer(found: &Kinematics) -> Verdict {
    if let Some(stop) = &found.stopped {
        let headline = Sentence::from("The mechanism stops at ")
            .angle_or(stop.at, found.axis.unit, 6)
            .words(".");
        let text = Sentence::from("Input ")
            .sentence(input_sentence(found, stop.input))
            .words(format!(": {}", stop.cause));
        return Verdict::of_judgement(found.judgement(), headline, text);
    }
    let stroke = |stroke: &Stroke| {
        let size = stroke.ends[1].1 - stroke.ends[0].1;
        Sentence::from(format!("{} ", slide(&stroke.owner))).angle_or(size, stroke.unit, DIGITS)
    };
    // What a block on the guide of an output does is the stroke of the output once more.
    let size = |stroke: &Stroke| stroke.ends[1].1 - stroke.ends[0].1;
    let twin = |at: usize| {
        let own = &found.strokes[at];
        let before = found.strokes[..at].iter();
        own.owner.starts_with("pairs.")
            && (before.filter(|other| other.unit == own.unit))
                .any(|other| (size(other) - size(own)).abs() <= 1e-9 * size(own).abs())
    };
    let strokes = (0..found.strokes.len()).filter(|at| !twin(*at));
    let strokes: Vec<Sentence> = strokes
        .map(|at| stroke(&found.strokes[at]))
        .take(3)
        .collect();
    let text = match strokes.is_empty() {
        true => Sentence::default(),
        false => Sentence::from("Strokes: ")
            .sentence(Sentence::joined(strokes, ", "))
            .words("."),
    };
    let through = match found.axis.values.len() {
        1 => "It can be put together at this position.".to_owned(),
        count => format!("It goes through all {count} positions."),
    };
    let (headline, text) = match (text.is_empty(), least_transmission(found)) {
        (false, _) => (text, through.into()),
        (true, Some(least)) => (least, through.into()),
        (true, None) => (Sentence::from(through), text),
    };
    Verdict::of_judgement(found.judgement(), headline, text)
}

/// What makes a stroke, in words: an output by its name, a block as that of its joint.
fn slide(owner: &str) -> String {
    let joint = owner.strip_prefix("pairs.");
    joint.map_or(owner.to_owned(), |joint| format!("block in {joint}"))
}

/// The least transmission angle of all dyads, and where it is.
fn least_transmission(found: &Kinematics) -> Option<Sentence> {
    let least = found.transmission.iter().map(|angle| angle.least);
    let (at, angle) = least.min_by(|a, b| a.1.total_cmp(&b.1))?;
    let least = Sentence::from("Least transmission angle ").angle_or(angle, "rad", DIGITS);
    Some(least.words(format!(" at {}.", place_text(found, at))))
}

fn structure_section<'a>(found: &Kinematics) -> Section<'a> {
    let structure = found.linkage.structure();
    let groups = (0..structure.groups.len()).map(|group| structure.describe(group));
    let reach = match &found.linkage {
        AnyLinkage::One(linkage) => {
            let turning = found.input == Coordinate::Turning;
            format!("Input: {}.", linkage.range().describe(structure, turning))
        }
        AnyLinkage::Several(linkage) => multi_input::inputs(found, linkage),
    };
    Section::new("Structure")
        .with_paragraph(structure.explanation.clone())
        .item(Item::Notes(groups.collect()))
        .with_paragraph(reach)
}

/// A value and where it is.
fn end((at, value): (f64, f64), unit: &str, place: impl Fn(f64) -> String) -> Cell {
    if value.is_infinite() {
        return Cell::with_note("unbounded", format!("→ {}", place(at)));
    }
    let value = Value::angle_or(value, unit, DIGITS);
    Cell::with_note(value, format!("at {}", place(at)))
}

fn strokes_table(found: &Kinematics) -> Table {
    let rows = found.strokes.iter().map(|stroke| {
        let [low, high] = stroke.ends;
        let cell = |at: (f64, f64)| end(at, stroke.unit, |at| input(found, at));
        let [rise, fall] = stroke.rise_and_return.map(|over| input(found, over));
        let size = Value::angle_or(high.1 - low.1, stroke.unit, DIGITS);
        vec![
            Cell::address(&stroke.owner, slide(&stroke.owner)),
            cell(low),
            cell(high),
            size.into(),
            rise.into(),
            fall.into(),
            Value::new(stroke.time_ratio, "", 6).into(),
        ]
    });
    Table::new([
        "of",
        ">least",
        ">greatest",
        ">stroke",
        ">input while rising",
        ">input while falling",
        ">time ratio",
    ])
    .rows(rows)
}

fn transmission_section<'a>(found: &Kinematics) -> Section<'a> {
    let rows = found.transmission.iter().map(|angle| {
        let cell = |at: (f64, f64)| end(at, "rad", |at| place_text(found, at));
        vec![
            angle.owner.as_str().into(),
            cell(angle.least),
            cell(angle.greatest),
        ]
    });
    let table = Table::new(["dyad", ">least", ">greatest"]).rows(rows);
    let section = Section::new("Transmission angles");
    match table.rows.is_empty() {
        true => section,
        false => section
            .table(table)
            .with_paragraph("90 deg is best; at 0 the pushed link is in a dead-centre position."),
    }
}

fn equilibria_section<'a>(found: &Kinematics) -> Section<'a> {
    let rests = found.equilibria.iter();
    let rests = rests.map(|rest| Figure::new(&input(found, rest.at), behaviour(rest)));
    let figures: Vec<Figure> = rests.collect();
    let section = Section::new("Equilibria");
    match figures.is_empty() {
        true => section,
        false => section
            .figures(figures)
            .with_paragraph("The linkage alone, its input free and nothing on its outputs."),
    }
}

/// What becomes of a small push, in words.
fn behaviour(rest: &Equilibrium) -> String {
    if let (Some(frequency), Some(ratio)) = (rest.frequency(), rest.damping_ratio()) {
        let damped = match ratio > 0.0 {
            true => format!(", damping ratio {}", significant(ratio, 6)),
            false => String::new(),
        };
        return format!(
            "stable, natural frequency {}{damped}",
            with_unit(frequency / TAU, "Hz", DIGITS)
        );
    }
    match rest.growth() {
        Some(growth) if growth > 0.0 => format!(
            "unstable, a push grows by e in {}",
            with_unit(growth.recip(), "s", DIGITS)
        ),
        _ if rest.stiffness == 0.0 => "neither stable nor unstable to first order".to_owned(),
        _ if rest.is_stable() => "stable, nothing has inertia".to_owned(),
        _ => "unstable, nothing has inertia".to_owned(),
    }
}

fn extremes_table(found: &Kinematics) -> Table {
    let row = |(column, extremes): (&Column, &Extremes)| {
        let cell = |at: (f64, f64)| end(at, &column.unit, |at| place_text(found, at));
        let size = extremes.least.1.abs().max(extremes.greatest.1.abs());
        let doubt = match (column.undetermined, column.error > SHOWN * size.max(1.0)) {
            (0, false) => String::new(),
            (0, true) => {
                let error = Value::angle_or(column.error, &column.unit, 2);
                format!("± {}", error.words())
            }
            (count, _) => format!("not determined at {count} positions"),
        };
        Row {
            cells: vec![
                column.name().into(),
                cell(extremes.least),
                cell(extremes.greatest),
                doubt.into(),
            ],
            minor: !is_in_terminal(column.quantity),
        }
    };
    Table {
        rows: found.columns.iter().zip(&found.extremes).map(row).collect(),
        ..Table::new(["quantity", ">least", ">greatest", ""])
    }
}

/// Transfer functions of points and components are too much for the terminal.
fn is_in_terminal(quantity: Quantity) -> bool {
    use Quantity as Q;
    matches!(
        quantity,
        Q::Displacement
            | Q::Speed
            | Q::Acceleration
            | Q::First
            | Q::Second
            | Q::Angle
            | Q::AngularSpeed
            | Q::AngularAcceleration
            | Q::X
            | Q::Y
            | Q::SpeedSize
            | Q::AccelerationSize
            | Q::RelativeSpeed
            | Q::RelativeAcceleration
            | Q::TransportAccelerationAlong
            | Q::TransportAccelerationAcross
            | Q::CoriolisAcceleration
    )
}

/// A row a position; angles continuous and in radians, everything in SI; empty where
/// a quantity grows beyond all numbers.
pub fn rows(found: &Kinematics) -> Rows {
    let axis = format!("{} [{}]", found.axis.name, found.axis.unit);
    let names = found.columns.iter();
    let names = names.map(|column| format!("{} [{}]", column.name(), column.unit));
    let rows = found.axis.values.iter().enumerate().map(|(row, place)| {
        let values = found.columns.iter().map(move |column| column.values[row]);
        std::iter::once(*place).chain(values)
    });
    Rows::new(std::iter::once(axis).chain(names), rows)
}
