//! Charts of records with their fit.

use crate::report::plot::{Axis, Mark, Plot, Series, Shape};
use crate::studies::identify::FittedSignal;

/// Most rows of which each is marked; more are a line.
const MOST_MARKS: usize = 400;

/// The record with the fit, and the residuals.
pub(super) fn charts(signal: &FittedSignal) -> Vec<Plot> {
    let over = |values: Vec<f64>| -> Vec<(f64, f64)> {
        signal.times.iter().copied().zip(values).collect()
    };
    let residuals: Vec<f64> = (signal.residuals.iter())
        .map(|own| signal.weight() * own)
        .collect();
    let fit = signal.measured.iter().zip(&residuals);
    let fit = Series::line("fit", over(fit.map(|(own, rest)| own + rest).collect()));
    let record = record(over(signal.measured.clone()));
    let chart = |name: &str, title: String, series: Vec<Series>| Plot {
        id: format!("{}.{}.{name}", signal.record, signal.address),
        ..Plot::new(title, Axis::new("t", "s"), &signal.unit, series)
    };
    let both = format!("{}, {}", signal.address, signal.record);
    let rest = Series::line("", over(residuals));
    vec![
        chart("fit", both, vec![fit, record]),
        chart(
            "residuals",
            "Residuals: fit less record".to_owned(),
            vec![rest],
        ),
    ]
}

fn record(points: Vec<(f64, f64)>) -> Series {
    match points.len() <= MOST_MARKS {
        true => {
            let marks = points.iter().map(|_| Mark::new(Shape::Good, "")).collect();
            Series::marked("record", points, marks)
        }
        false => Series::theory("record", points),
    }
}
