//! Two functions over a cycle as polynomials on panels.

use super::given::FunctionKind;
use super::panel::FittedPanel;
use super::panel::{COUNT, NODES, Series};
use super::refusal::Refusal;

/// Panels in a turn, and in a cycle, at least: nothing slips through between
/// their nodes.
const LEAST_PANELS: f64 = 16.0;
/// Halvings of a panel at most: a kink or a jump at a place that nobody named.
const MOST_HALVINGS: u32 = 44;
/// Panels at most.
const MOST_PANELS: usize = 20_000;
/// Highest terms of a series that has converged, relative to the function.
const CONVERGED: f64 = 1e-15;
/// Below this, terms that halving a panel does not make smaller are the
/// rounding of the function itself.
const NOISE: f64 = 1e-10;

/// J and the moment or the work at φ; the piece number tells which formula.
pub(super) type At<'a> = &'a mut dyn FnMut(usize, f64) -> [f64; 2];

/// A panel still to be looked at.
struct Open {
    piece: usize,
    from: f64,
    to: f64,
    halvings: u32,
    /// Size of the highest terms in the panel it was cut from.
    before: [f64; 2],
}

/// Fits panels to a cycle that the `breaks` (ascending, inside) cut into pieces.
pub(super) fn fit_panels(
    cycle: f64,
    breaks: &[f64],
    given: FunctionKind,
    at: At<'_>,
) -> Result<Vec<FittedPanel>, Refusal> {
    let mut open = first_panels(cycle, breaks);
    let mut sizes = [0.0f64; 2];
    for panel in &open {
        for (sum, value) in sizes.iter_mut().zip(sample_panel(panel, at)?) {
            *sum = value.iter().fold(*sum, |size, v| size.max(v.abs()));
        }
    }
    let mut done = Vec::new();
    while let Some(panel) = open.pop() {
        let values = sample_panel(&panel, at)?;
        let series = values.map(|values| NODES.polynomial_through(&values));
        let tails = [
            size_of_highest_terms(&series[0]),
            size_of_highest_terms(&series[1]),
        ];
        let settled = (0..2).all(|i| {
            let (tail, before) = (tails[i] / sizes[i], panel.before[i] / sizes[i]);
            sizes[i] == 0.0 || tail <= CONVERGED || before <= NOISE && tail > 0.1 * before
        });
        if !settled && panel.halvings < MOST_HALVINGS {
            if done.len() + open.len() > MOST_PANELS {
                return Err(Refusal::Rough {
                    position: panel.from,
                });
            }
            halve_panel(&panel, tails, &mut open);
            continue;
        }
        if !settled && given == FunctionKind::Work && tails[1] > 1e-9 * sizes[1] {
            return Err(Refusal::Rough {
                position: panel.from,
            });
        }
        done.push(FittedPanel {
            from: panel.from,
            to: panel.to,
            inertia: series[0],
            other: series[1],
        });
    }
    Ok(done)
}

/// Every piece in equal panels, the last first: a stack.
fn first_panels(cycle: f64, breaks: &[f64]) -> Vec<Open> {
    let ends: Vec<f64> = (std::iter::once(0.0))
        .chain(breaks.iter().copied())
        .chain([cycle])
        .collect();
    let longest = cycle.min(std::f64::consts::TAU) / LEAST_PANELS;
    let mut open = Vec::new();
    for (piece, ends) in ends.windows(2).enumerate() {
        let (from, length) = (ends[0], ends[1] - ends[0]);
        let count = (length / longest).ceil().max(1.0) as usize;
        let place = |i: usize| match i {
            i if i == count => ends[1],
            i => from + length * i as f64 / count as f64,
        };
        open.extend((0..count).map(|i| Open {
            piece,
            from: place(i),
            to: place(i + 1),
            halvings: 0,
            before: [f64::INFINITY; 2],
        }));
    }
    open.reverse();
    open
}

fn halve_panel(panel: &Open, tails: [f64; 2], open: &mut Vec<Open>) {
    let middle = 0.5 * (panel.from + panel.to);
    for (from, to) in [(middle, panel.to), (panel.from, middle)] {
        open.push(Open {
            piece: panel.piece,
            from,
            to,
            halvings: panel.halvings + 1,
            before: tails,
        });
    }
}

/// Both functions at the nodes of a panel; refused where they are no numbers.
fn sample_panel(panel: &Open, at: At<'_>) -> Result<[[f64; COUNT]; 2], Refusal> {
    let (centre, half) = (0.5 * (panel.from + panel.to), 0.5 * (panel.to - panel.from));
    let mut values = [[0.0; COUNT]; 2];
    for (k, x) in NODES.places.into_iter().enumerate() {
        let position = centre + half * x;
        let [inertia, other] = at(panel.piece, position);
        if !(inertia.is_finite() && inertia > 0.0) {
            return Err(Refusal::Inertia { position, inertia });
        }
        if !other.is_finite() {
            return Err(Refusal::Moment { position });
        }
        (values[0][k], values[1][k]) = (inertia, other);
    }
    Ok(values)
}

/// Size of the highest terms.
fn size_of_highest_terms(series: &Series) -> f64 {
    series[COUNT - 3..]
        .iter()
        .fold(0.0, |size, c| size.max(c.abs()))
}
