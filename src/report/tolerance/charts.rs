//! Tornado and histogram of a result.

use super::by_effect;
use crate::report::addresses::{parameter_words, result_words};
use crate::report::plot::{Axis, LineStyle, Plot, Rule, Series};
use crate::studies::tolerance::{FigureTolerance, SIGMAS, Tolerances};
use std::f64::consts::TAU;

/// Most dimensions of a tornado.
const MOST_ROWS: usize = 20;
/// Half of the height of a bar, in rows.
const HALF_BAR: f64 = 0.3;
/// Margin beside the bars, as a share of the widest.
const MARGIN: f64 = 0.05;
/// Points of a normal curve.
const POINTS: usize = 121;
/// Fewest and most columns of a histogram.
const COLUMNS: [usize; 2] = [8, 60];

/// The charts of a result.
pub(super) fn charts(found: &Tolerances, number: usize) -> Vec<Plot> {
    let tornado = tornado(found, number);
    tornado
        .into_iter()
        .chain(histogram(found, number))
        .collect()
}

/// Results with each dimension at its limits, the widest at the top.
fn tornado(found: &Tolerances, number: usize) -> Option<Plot> {
    let figure = &found.figures[number];
    let middle = figure.middle?;
    let order: Vec<usize> = by_effect(found, number)
        .into_iter()
        .take(MOST_ROWS)
        .collect();
    let bars = |ends: &dyn Fn(usize) -> Option<[f64; 2]>| -> Vec<(f64, f64)> {
        let each = order.iter().enumerate();
        each.filter_map(|(row, at)| Some(bar(row as f64 + 0.5, ends(*at)?)))
            .flatten()
            .collect()
    };
    let runs = |at: usize| {
        let limits = figure.effects[at].limits;
        Some([limits.lower?, limits.upper?])
    };
    let stack = |at: usize| {
        let reach = figure.effects[at].derivative? * found.dimensions[at].zone.half();
        Some([middle - reach, middle + reach])
    };
    let runs_and_stack = [bars(&runs), bars(&stack)];
    let names = order.iter().map(|at| {
        let paths = found.dimensions[*at].paths.iter();
        paths
            .map(|path| parameter_words(path))
            .collect::<Vec<_>>()
            .join(", ")
    });
    Some(Plot {
        id: format!("{}.tornado", figure.figure),
        title: "One number at its limits".to_owned(),
        x: Axis {
            range: with_margin(runs_and_stack.iter().flatten().map(|point| point.0)),
            ..Axis::new("", &figure.unit)
        },
        y: Axis {
            rows: names.collect(),
            ..Axis::default()
        },
        series: vec![
            Series::line("runs", runs_and_stack[0].clone()),
            Series::theory("first order", runs_and_stack[1].clone()),
        ],
        rules: vec![Rule::upright(middle)],
        ..Plot::default()
    })
}

/// The ends of values with a margin; `None`: they are all the same, or there are none.
fn with_margin(values: impl Iterator<Item = f64>) -> Option<[f64; 2]> {
    let known = values.filter(|value| value.is_finite());
    let [low, high] = known.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| {
        [low.min(value), high.max(value)]
    });
    let margin = MARGIN * (high - low);
    (low < high).then_some([low - margin, high + margin])
}

/// The outline of a bar, and a gap behind it.
fn bar(row: f64, [from, to]: [f64; 2]) -> Vec<(f64, f64)> {
    let [above, below] = [row - HALF_BAR, row + HALF_BAR];
    let outline = [
        (from, above),
        (to, above),
        (to, below),
        (from, below),
        (from, above),
    ];
    outline.into_iter().chain([(f64::NAN, f64::NAN)]).collect()
}

/// How often the samples have which result, with the normal curve of first order.
fn histogram(found: &Tolerances, number: usize) -> Option<Plot> {
    let figure = &found.figures[number];
    let spread = figure
        .spread
        .as_ref()
        .filter(|spread| spread.greatest > spread.least)?;
    let (columns, width) = columns(figure, spread.least, spread.greatest);
    let limits = found
        .limits
        .iter()
        .filter(|one| one.limit.figure == figure.figure);
    let rules = limits.map(|one| Rule {
        label: format!(
            "{} limit",
            if one.limit.relation.sign() == "<=" {
                "upper"
            } else {
                "lower"
            }
        ),
        ..Rule::upright(one.limit.value)
    });
    let expected = normal_curve(figure, spread.count as f64 * width);
    Some(Plot {
        id: format!("{}.histogram", figure.figure),
        title: format!("Samples over {}", result_words(&figure.figure)),
        x: Axis::new("", &figure.unit),
        y: Axis::new("samples", ""),
        series: std::iter::once(Series {
            look: LineStyle::Steps,
            ..Series::line("samples", columns)
        })
        .chain(expected)
        .collect(),
        rules: rules.collect(),
        ..Plot::default()
    })
}

/// The columns as steps, with their width: that of D. Freedman and P. Diaconis (1981).
fn columns(figure: &FigureTolerance, least: f64, greatest: f64) -> (Vec<(f64, f64)>, f64) {
    let mut sorted = figure.values.clone();
    sorted.sort_by(f64::total_cmp);
    let quarter = |share: usize| sorted[share * (sorted.len() - 1) / 4];
    let wanted = 2.0 * (quarter(3) - quarter(1)) / (sorted.len() as f64).cbrt();
    let count = ((greatest - least) / wanted).ceil();
    let count = (count as usize).clamp(COLUMNS[0], COLUMNS[1]);
    let width = (greatest - least) / count as f64;
    let mut counts = vec![0.0; count];
    for value in &figure.values {
        let place = ((value - least) / width) as usize;
        counts[place.min(count - 1)] += 1.0;
    }
    let starts = counts.iter().enumerate();
    let steps = starts.map(|(at, own)| (least + at as f64 * width, *own));
    let ends = [(greatest, 0.0)];
    let all = std::iter::once((least, 0.0)).chain(steps).chain(ends);
    (all.collect(), width)
}

/// The normal distribution of first order, as the samples would be in columns; `None`: nothing
/// varies by first order.
fn normal_curve(figure: &FigureTolerance, scale: f64) -> Option<Series> {
    let stack = figure
        .first_order
        .as_ref()
        .filter(|stack| stack.sigma > 0.0)?;
    let point = |at: usize| {
        let z = (SIGMAS + 1.0) * (2.0 * at as f64 / (POINTS - 1) as f64 - 1.0);
        let height = scale * (-0.5 * z * z).exp() / (stack.sigma * TAU.sqrt());
        (stack.mean + z * stack.sigma, height)
    };
    Some(Series::theory(
        "normal, by first order",
        (0..POINTS).map(point).collect(),
    ))
}
