//! The Campbell diagram, and the deviation below it.

use super::{amplitude_words, command, rpm};
use crate::report::plot::{Axis, Band, Mark, Plot, Rule, Series, Shape};
use crate::studies::orders::{Crossing, TreeOrders};
use std::f64::consts::TAU;

/// Natural frequencies and orders over the speed of the drive.
pub(super) fn campbell(tree: &TreeOrders) -> Plot {
    let [low, high] = tree.speeds;
    let ceiling = ceiling(tree);
    let modes = tree.frequencies.iter().enumerate();
    let modes = modes.filter(|(_, frequency)| **frequency <= ceiling);
    let modes = modes.map(|(number, &frequency)| {
        let ends = [low, high].map(|speed| (rpm(speed), frequency));
        Series::line(&format!("mode {}", number + 1), ends.to_vec())
    });
    let orders = tree.orders.iter().filter(|order| order.present);
    let orders = orders.map(|order| {
        let end = high.min(TAU * ceiling / order.order);
        let ends = [low.min(end), end].map(|speed| (rpm(speed), order.order * speed / TAU));
        Series::theory(&format!("order {}", order.order), ends.to_vec())
    });
    let mut series: Vec<Series> = modes.chain(orders).collect();
    for (label, marked, shape) in [
        ("resonances", true, Shape::Good),
        ("below the accuracy", false, Shape::Open),
    ] {
        let own = tree
            .crossings
            .iter()
            .filter(|crossing| crossing.marked == marked);
        let (points, marks): (Vec<_>, Vec<_>) = own
            .map(|crossing| {
                let point = (rpm(crossing.speed), crossing.frequency);
                (point, Mark::new(shape, note(tree, crossing)))
            })
            .unzip();
        if !points.is_empty() {
            series.push(Series::marked(label, points, marks));
        }
    }
    Plot {
        rules: vec![Rule::upright(rpm(tree.speed))],
        y: Axis {
            range: Some([0.0, ceiling]),
            ..Axis::new("frequency", "Hz")
        },
        ..Plot::new(
            format!(
                "Orders of {} and natural frequencies over the speed",
                tree.law
            ),
            Axis::new("speed of the drive", "rpm"),
            "Hz",
            series,
        )
    }
}

/// The greatest frequency that is shown.
fn ceiling(tree: &TreeOrders) -> f64 {
    let crossings = tree.crossings.iter().map(|crossing| crossing.frequency);
    let highest = crossings.fold(tree.frequencies.first().copied().unwrap_or(1.0), f64::max);
    1.1 * highest
}

fn note(tree: &TreeOrders, crossing: &Crossing) -> String {
    let (order, mode) = (crossing.order, crossing.mode);
    match crossing.present {
        true => format!(
            "order {order}, mode {mode}: {}; {}",
            amplitude_words(crossing, &tree.unit),
            command(tree, crossing)
        ),
        false => format!("order {order}, mode {mode}: the law does not have this order"),
    }
}

/// The greatest deviation of the periodic motion over the speed.
pub(super) fn over_speed(tree: &TreeOrders) -> Plot {
    let points = tree.over_speed.iter();
    let points = points.map(|point| (rpm(point.speed), point.greatest.unwrap_or(f64::NAN)));
    let resonances = tree
        .crossings
        .iter()
        .filter_map(|crossing| Some((rpm(crossing.speed), crossing.greatest?)));
    let mut points: Vec<(f64, f64)> = points.chain(resonances).collect();
    points.sort_by(|a, b| a.0.total_cmp(&b.0));
    let step = (tree.speeds[1] - tree.speeds[0]) / tree.over_speed.len().max(1) as f64;
    let open = tree.over_speed.iter().filter(|point| point.separates);
    let open = open.map(|point| [rpm(point.speed - 0.5 * step), rpm(point.speed + 0.5 * step)]);
    let bands = open.collect::<Vec<_>>();
    Plot {
        bands: match bands.is_empty() {
            true => Vec::new(),
            false => vec![Band {
                label: "contact separates".to_owned(),
                spans: bands,
                series: None,
            }],
        },
        rules: vec![Rule::upright(rpm(tree.speed))],
        ..Plot::new(
            format!("Greatest deviation of {} over the speed", tree.object),
            Axis::new("speed of the drive", "rpm"),
            &tree.unit,
            vec![Series::line("greatest |δ|", points)],
        )
    }
}
