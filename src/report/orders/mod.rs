//! Orders and resonances as findings, as a document and as rows.

mod charts;

use crate::report::csv::{Field, Rows};
use crate::report::findings::{Cell, Findings, Layout, Section, Source, Table, Value};
use crate::report::quantity::with_unit;
use crate::report::verdict::{Sort, Verdict};
use crate::studies::orders::{Crossing, Order, OrdersAnswer, TreeOrders};
use charts::{campbell, over_speed};
use serde_json::{Value as Json, json};
use std::f64::consts::TAU;

/// Digits of results.
const DIGITS: usize = 6;

/// Speed in rpm.
pub(super) fn rpm(speed: f64) -> f64 {
    speed * 60.0 / TAU
}

/// Crossings, orders and the deviation over the speed.
pub fn orders_findings<'a>(scene: &str, found: &OrdersAnswer, source: Source<'a>) -> Findings<'a> {
    let mut sections = Vec::new();
    for tree in &found.trees {
        let section = Section::new(format!("Crossings behind the law of {}", tree.law));
        let section = section.table(crossings_table(tree));
        sections.push(section.with_paragraph(crossings_words(tree)));
        let charts = vec![campbell(tree), over_speed(tree)];
        let diagram = Section::new("Campbell diagram").charts(Layout::Wide(420.0), "speed", charts);
        sections.push(diagram.legend(
            "Filled marks exceed the accuracy, open ones do not. The deviation below is that of the \
             periodic motion.",
        ));
        let orders = Section::new(format!("Orders of the law of {}", tree.law));
        sections.push(
            orders
                .table(orders_table(tree))
                .with_paragraph(law_words(tree)),
        );
    }
    let left_out = found.left_out.iter();
    let left_out = left_out.map(|one| vec![one.object.as_str(), one.reason.as_str()]);
    let table = Table::new(["object", "~reason"]).rows(left_out);
    sections.push(Section::new("Without orders").table(table));
    sections.retain(|section| !section.is_empty());
    Findings {
        title: scene.to_owned(),
        subtitle: "orders of the law and resonances over the speed".to_owned(),
        answer: Some(answer(found)),
        warnings: Vec::new(),
        sections,
        source,
    }
}

/// The greatest crossing, and the deviation at the speed of the scene.
fn answer(found: &OrdersAnswer) -> Verdict {
    let size = |crossing: &Crossing| crossing.amplitude.unwrap_or(f64::INFINITY);
    let all = found.trees.iter().flat_map(|tree| {
        let marked = tree.crossings.iter().filter(|crossing| crossing.marked);
        marked.map(move |crossing| (tree, crossing))
    });
    let greatest = all.max_by(|a, b| size(a.1).total_cmp(&size(b.1)));
    let headline = match greatest {
        Some((tree, crossing)) => format!(
            "The greatest resonance is order {} with mode {} at {}: {} of {}.",
            crossing.order,
            crossing.mode,
            with_unit(rpm(crossing.speed), "rpm", 5),
            amplitude_words(crossing, &tree.unit),
            tree.object
        ),
        None => "No crossing at these speeds exceeds the accuracy.".to_owned(),
    };
    let own = found.trees.first();
    let own = own.and_then(|tree| Some((tree, tree.deviation.as_ref()?)));
    let text = own.map_or(String::new(), |(tree, deviation)| {
        format!(
            "At the speed of the scene, {}, the greatest deviation is {} at {}.",
            with_unit(rpm(tree.speed), "rpm", 5),
            with_unit(deviation.greatest, &tree.unit, 5),
            with_unit(deviation.at.to_degrees(), "deg", 5)
        )
    });
    Verdict::answer(Sort::Recommended, headline, text)
}

fn amplitude_words(crossing: &Crossing, unit: &str) -> String {
    match crossing.amplitude {
        Some(amplitude) => with_unit(amplitude, unit, 4),
        None => "unbounded".to_owned(),
    }
}

/// The command that runs the scene at the speed of a crossing.
fn command(tree: &TreeOrders, crossing: &Crossing) -> String {
    let speed = rpm(crossing.speed).copysign(tree.speed);
    format!("--set {}.motion.speed=\"{speed:.6} rpm\"", tree.drive)
}

fn crossings_table(tree: &TreeOrders) -> Table {
    let row = |crossing: &Crossing| {
        let amplitude = match crossing.amplitude {
            Some(amplitude) if crossing.present => Value::new(amplitude, &tree.unit, DIGITS),
            Some(_) => "not in the law".into(),
            None => "unbounded".into(),
        };
        let contact = match (crossing.separates, crossing.least_contact_force) {
            (true, _) => "separates".into(),
            (false, Some(force)) => Value::new(force, &tree.force_unit, 4),
            (false, None) if crossing.greatest.is_none() => "no periodic motion".into(),
            (false, None) => "".into(),
        };
        vec![
            Value::new(crossing.order, "", 6).into(),
            Value::new(crossing.mode as f64, "", 4).into(),
            Value::new(rpm(crossing.speed), "rpm", DIGITS).into(),
            Cell::from(amplitude).with_outcome((!crossing.marked).then_some(true)),
            Cell::known_number(crossing.greatest, &tree.unit, 4),
            contact.into(),
            command(tree, crossing).into(),
        ]
    };
    let heads = [
        ">order",
        ">mode",
        ">speed",
        ">amplitude",
        ">greatest δ",
        ">contact force",
        "?run it",
    ];
    let marked = tree.crossings.iter().filter(|crossing| crossing.marked);
    Table::new(heads).rows(marked.map(row))
}

fn crossings_words(tree: &TreeOrders) -> String {
    let faint = tree.crossings.iter().filter(|crossing| !crossing.marked);
    let absent = faint.clone().filter(|crossing| !crossing.present).count();
    let small = faint.count() - absent;
    let [low, high] = tree.speeds.map(|speed| with_unit(rpm(speed), "rpm", 5));
    let highest = tree.orders.last().map_or(0.0, |order| order.order);
    format!(
        "Speeds from {low} to {high}, orders up to {highest}. Crossings below {}: {small}. Crossings \
         with orders that the law does not have: {absent}.",
        with_unit(tree.accuracy, &tree.unit, 3)
    )
}

fn law_words(tree: &TreeOrders) -> String {
    match tree.closed_form {
        true => "Amplitudes follow in closed form from the pieces of the law.".to_owned(),
        false => "Amplitudes are integrals over the law, by quadrature.".to_owned(),
    }
}

fn orders_table(tree: &TreeOrders) -> Table {
    let row = |order: &Order| {
        let amplitude = match order.present {
            true => Value::new(order.amplitude, &tree.unit, DIGITS),
            false => "none".into(),
        };
        let deviation = match order.deviation {
            _ if !order.present => Value::new(f64::NAN, "", 4),
            Some(deviation) => Value::new(deviation, &tree.unit, 4),
            None => "unbounded".into(),
        };
        let first = order.resonances.first().copied().map(rpm);
        vec![
            Value::new(order.order, "", 6).into(),
            amplitude.into(),
            deviation.into(),
            Cell::known_number(first, "rpm", DIGITS),
        ]
    };
    let heads = [">order", ">amplitude", ">deviation", ">meets mode 1 at"];
    Table::new(heads).rows(tree.orders.iter().map(row))
}

/// The document.
///
/// # Errors
/// It cannot be written as JSON.
pub fn orders_document(scene: &str, hash: &str, found: &OrdersAnswer) -> serde_json::Result<Json> {
    let mut document = serde_json::to_value(found)?;
    document["dam"] = json!(1);
    document["scene"] = json!(scene);
    document["hash"] = json!(hash);
    Ok(document)
}

/// A row for each order.
pub fn orders_rows(found: &OrdersAnswer) -> Rows {
    let head = [
        "law",
        "object",
        "unit",
        "order",
        "amplitude",
        "phase [rad]",
        "deviation",
    ];
    let rows = found.trees.iter().flat_map(|tree| {
        tree.orders.iter().map(move |order| {
            [
                Field::from(tree.law.as_str()),
                tree.object.as_str().into(),
                tree.unit.as_str().into(),
                order.order.into(),
                order.amplitude.into(),
                order.phase.into(),
                order.deviation.into(),
            ]
        })
    });
    Rows::new(head, rows)
}

/// A row for each crossing.
pub fn crossing_rows(found: &OrdersAnswer) -> Rows {
    let head = [
        "law",
        "object",
        "unit",
        "order",
        "mode",
        "speed [rad/s]",
        "frequency [Hz]",
        "amplitude",
        "greatest deviation",
        "least contact force",
        "counts",
        "separates",
    ];
    let rows = found.trees.iter().flat_map(|tree| {
        tree.crossings.iter().map(move |crossing| {
            let truth = |value: bool| Field::from(if value { "yes" } else { "no" });
            [
                Field::from(tree.law.as_str()),
                tree.object.as_str().into(),
                tree.unit.as_str().into(),
                crossing.order.into(),
                (crossing.mode as f64).into(),
                crossing.speed.into(),
                crossing.frequency.into(),
                crossing.amplitude.into(),
                crossing.greatest.into(),
                crossing.least_contact_force.into(),
                truth(crossing.marked),
                truth(crossing.separates),
            ]
        })
    });
    Rows::new(head, rows)
}
