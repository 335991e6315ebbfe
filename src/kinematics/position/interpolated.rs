//! A position function that is known by its values alone.

use super::PositionFunction;
use crate::fault::Fault;
use crate::kinematics::breaks::Breaks;
use crate::math::chebyshev::{Nodes, derivative, value};
use crate::math::jet::Jet;
use std::fmt;

/// Terms of a panel.
const TERMS: usize = 20;

/// Panels of a piece to begin with.
const BEGIN: usize = 8;

/// How often a panel is halved at most.
const HALVINGS: u32 = 14;

/// Last terms and differences between the nodes that count as rounding, as a share of the
/// greatest value of the piece.
const ROUNDING: f64 = 1e-13;

/// How far U, U′ and U″ may be apart where panels meet, as shares of their greatest.
const JOINED: [f64; 3] = [1e-11, 1e-8, 1e-5];

/// Places of a panel, besides the nodes, at which the interpolation is held against the
/// function.
const PROBES: [f64; 2] = [-0.77, 0.31];

/// A function U(φ) that is known by its values alone: interpolated to rounding by
/// Chebyshev polynomials on panels, each halved until it is, so that its derivatives follow
/// and nothing is asked of the function any more. U′ is good to about ten digits, U″ to
/// nine, U‴ to seven.
#[derive(Clone)]
pub struct ChebyshevInterpolation {
    /// What stands for it in texts.
    words: String,
    /// Pieces between breaks, from the first on.
    pieces: Vec<Vec<Panel>>,
    breaks: Breaks,
    /// Period and what U gains over it.
    period: Option<(f64, f64)>,
    reach: (f64, f64),
}

#[derive(Clone, Debug)]
struct Panel {
    middle: f64,
    half: f64,
    derivatives: [[f64; TERMS]; 4],
}

impl Panel {
    /// A derivative at a place in [−1, 1].
    fn at(&self, order: usize, place: f64) -> f64 {
        value(&self.derivatives[order], place)
    }
}

impl fmt::Debug for ChebyshevInterpolation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.words)
    }
}

impl ChebyshevInterpolation {
    /// A function that repeats after a `period` (rad or m), but for what it gains over it;
    /// `breaks` are the places in [0, period) where its formula changes. `words` stand for
    /// it in texts and hashes: another function should have others.
    ///
    /// # Errors
    /// A value is not finite; the function is not smooth between its breaks, with the place.
    pub fn periodic(
        words: &str,
        function: impl FnMut(f64) -> f64,
        period: f64,
        breaks: &[f64],
    ) -> Result<Self, Fault> {
        let mut function = function;
        if !(period.is_finite() && period > 0.0) {
            return Err(Fault::new("period", "a period is positive", ""));
        }
        let mut edges = sorted(breaks, 0.0, period)?;
        let points = edges.clone();
        let first = points.first().copied().unwrap_or(0.0);
        edges.push(first + period);
        if points.is_empty() {
            edges.insert(0, 0.0);
        }
        let gain = function(first + period) - function(first);
        let mut inside = |phi: f64| match phi >= period {
            true => function(phi - period) + gain,
            false => function(phi),
        };
        let pieces = pieces(&mut inside, &edges)?;
        if let (true, [only]) = (points.is_empty(), pieces.as_slice()) {
            let ends = (&only[only.len() - 1], &only[0]);
            joint_to_next_panel(ends, gain, &greatest(only)).map_err(|_| rough(0.0))?;
        }
        let period_of_breaks = (!points.is_empty()).then_some(period);
        Ok(Self {
            words: words.to_owned(),
            pieces,
            breaks: Breaks {
                points,
                period: period_of_breaks,
            },
            period: Some((period, gain)),
            reach: (first, first + period),
        })
    }

    /// A function between `from` and `to`, beyond which it does not exist.
    ///
    /// # Errors
    /// As of [`Self::periodic`].
    pub fn between(
        words: &str,
        function: impl FnMut(f64) -> f64,
        (from, to): (f64, f64),
        breaks: &[f64],
    ) -> Result<Self, Fault> {
        let mut function = function;
        if !(from.is_finite() && to.is_finite() && from < to) {
            return Err(Fault::new("reach", "a range has its ends in order", ""));
        }
        let points = sorted(breaks, from, to)?;
        let mut edges = points.clone();
        edges.insert(0, from);
        edges.push(to);
        edges.dedup();
        Ok(Self {
            words: words.to_owned(),
            pieces: pieces(&mut function, &edges)?,
            breaks: Breaks {
                points: points.into_iter().filter(|&at| at > from).collect(),
                period: None,
            },
            period: None,
            reach: (from, to),
        })
    }

    /// Number of values that it was made of.
    pub fn values(&self) -> usize {
        let panels: usize = self.pieces.iter().map(Vec::len).sum();
        panels * (TERMS + PROBES.len())
    }

    /// The piece of a segment, and the distance to subtract from φ, with what that adds to U.
    fn piece(&self, segment: i64, phi: f64) -> (&[Panel], f64, f64) {
        match self.period {
            None => {
                let (piece, _) = self.breaks.piece(segment);
                (&self.pieces[piece.min(self.pieces.len() - 1)], 0.0, 0.0)
            }
            Some((period, gain)) if self.breaks.is_empty() => {
                let turns = ((phi - self.reach.0) / period).floor();
                (&self.pieces[0], turns * period, turns * gain)
            }
            Some((period, gain)) => {
                let (piece, shift) = self.breaks.piece(segment);
                let turns = (shift / period).round();
                (&self.pieces[piece], shift, turns * gain)
            }
        }
    }
}

/// Breaks in ascending order, between two ends.
fn sorted(breaks: &[f64], from: f64, to: f64) -> Result<Vec<f64>, Fault> {
    let mut points = breaks.to_vec();
    points.sort_by(f64::total_cmp);
    points.dedup();
    match points.iter().all(|&at| from <= at && at < to) {
        true => Ok(points),
        false => {
            let message = format!("breaks lie from {from} to below {to}");
            Err(Fault::new("breaks", message, ""))
        }
    }
}

fn pieces(function: &mut dyn FnMut(f64) -> f64, edges: &[f64]) -> Result<Vec<Vec<Panel>>, Fault> {
    let nodes = Nodes::new();
    let ends = edges.windows(2);
    ends.map(|ends| piece(function, &nodes, (ends[0], ends[1])))
        .collect()
}

fn piece(
    function: &mut dyn FnMut(f64) -> f64,
    nodes: &Nodes<TERMS>,
    (from, to): (f64, f64),
) -> Result<Vec<Panel>, Fault> {
    let width = (to - from) / BEGIN as f64;
    let edge = |index: usize| from + width * index as f64;
    let mut scale: f64 = 0.0;
    for index in 0..BEGIN {
        let found = function(edge(index) + 0.5 * width);
        scale = scale.max(found.abs());
    }
    let mut panels = Vec::new();
    for index in 0..BEGIN {
        let ends = (edge(index), edge(index + 1));
        fit_or_halve(function, nodes, ends, (&mut scale, HALVINGS), &mut panels)?;
    }
    let greatest = greatest(&panels);
    for neighbours in panels.windows(2) {
        joint_to_next_panel((&neighbours[0], &neighbours[1]), 0.0, &greatest)?;
    }
    Ok(panels)
}

/// Greatest |U|, |U′| and |U″| at the ends of panels.
fn greatest(panels: &[Panel]) -> [f64; 3] {
    std::array::from_fn(|order| {
        let ends = panels
            .iter()
            .flat_map(|panel| [panel.at(order, -1.0), panel.at(order, 1.0)]);
        ends.fold(0.0, |most, value| f64::max(most, value.abs()))
    })
}

/// Holds a panel against the next one, of which U is `gain` greater.
fn joint_to_next_panel(
    (left, right): (&Panel, &Panel),
    gain: f64,
    greatest: &[f64; 3],
) -> Result<(), Fault> {
    for order in 0..JOINED.len() {
        let gain = if order == 0 { gain } else { 0.0 };
        let jump = left.at(order, 1.0) - right.at(order, -1.0) - gain;
        // What rounding of the values amounts to in a derivative of a polynomial of so many terms.
        let per_width = (TERMS * TERMS) as f64 / left.half.min(right.half);
        let rounding = 0.1 * ROUNDING * per_width.powi(order as i32) * greatest[0];
        let bound = JOINED[order] * greatest[order].max(gain.abs());
        if jump.abs() > bound.max(rounding) {
            return Err(rough(left.middle + left.half));
        }
    }
    Ok(())
}

fn rough(phi: f64) -> Fault {
    let message = format!("U is not smooth near φ = {phi}");
    let hint = "name the places where its formula changes: `breaks`";
    Fault::new("", message, hint)
}

/// Fits a panel, or its halves where that is not rounding.
fn fit_or_halve(
    function: &mut dyn FnMut(f64) -> f64,
    nodes: &Nodes<TERMS>,
    (from, to): (f64, f64),
    (scale, left): (&mut f64, u32),
    panels: &mut Vec<Panel>,
) -> Result<(), Fault> {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    let values = nodes.places.map(|place| function(middle + half * place));
    if let Some(at) = values.iter().position(|value| !value.is_finite()) {
        let phi = middle + half * nodes.places[at];
        return Err(Fault::new(
            "",
            format!("U({phi}) is not a finite number"),
            "",
        ));
    }
    *scale = values
        .iter()
        .fold(*scale, |most, value| most.max(value.abs()));
    let series = nodes.polynomial_through(&values);
    let bound = ROUNDING * *scale;
    let settled = series[TERMS - 3..].iter().all(|term| term.abs() <= bound);
    // Written so that a value that is not finite fails.
    let agrees = |place: &f64| {
        (value(&series, *place) - function(middle + half * place)).abs() <= 10.0 * bound
    };
    if settled && PROBES.iter().all(agrees) {
        panels.push(panel(middle, half, series));
        return Ok(());
    }
    if left == 0 {
        return Err(rough(middle));
    }
    fit_or_halve(function, nodes, (from, middle), (scale, left - 1), panels)?;
    fit_or_halve(function, nodes, (middle, to), (scale, left - 1), panels)
}

fn panel(middle: f64, half: f64, series: [f64; TERMS]) -> Panel {
    let by = |series: &[f64; TERMS]| derivative(series).map(|term| term / half);
    let first = by(&series);
    let second = by(&first);
    Panel {
        middle,
        half,
        derivatives: [series, first, second, by(&second)],
    }
}

impl PositionFunction for ChebyshevInterpolation {
    fn jet(&self, segment: i64, phi: f64) -> Jet {
        let (panels, shift, gain) = self.piece(segment, phi);
        let phi = phi - shift;
        let after = panels.partition_point(|panel| panel.middle + panel.half <= phi);
        let panel = &panels[after.min(panels.len() - 1)];
        let place = (phi - panel.middle) / panel.half;
        let at = |order: usize| panel.at(order, place);
        Jet {
            value: at(0) + gain,
            first: at(1),
            second: at(2),
            third: at(3),
        }
    }

    fn breaks(&self) -> Breaks {
        self.breaks.clone()
    }

    fn reach(&self) -> Option<(f64, f64)> {
        self.period.is_none().then_some(self.reach)
    }
}

#[cfg(test)]
mod tests {
    use super::ChebyshevInterpolation;
    use crate::kinematics::position::PositionFunction;
    use std::f64::consts::TAU;

    /// U = 0.1·φ + 0.02·e^{cos φ}, with its derivatives in closed form.
    fn exact(phi: f64) -> [f64; 4] {
        let (s, c) = phi.sin_cos();
        let e = 0.02 * c.exp();
        [
            0.1 * phi + e,
            0.1 - s * e,
            (s * s - c) * e,
            (s + 3.0 * s * c - s * s * s) * e,
        ]
    }

    #[test]
    fn derivatives_follow_from_values() {
        let found = ChebyshevInterpolation::periodic("u", |phi| exact(phi)[0], TAU, &[]).unwrap();
        for index in 0..500 {
            let phi = -20.0 + 0.0813 * f64::from(index);
            let (jet, exact) = (found.jet(0, phi), exact(phi));
            let found = [jet.value, jet.first, jet.second, jet.third];
            for (order, bound) in [1e-13, 1e-11, 1e-9, 1e-6].into_iter().enumerate() {
                let error = (found[order] - exact[order]).abs();
                assert!(
                    error < bound * (1.0 + phi.abs()),
                    "{phi}: U^({order}) {error}"
                );
            }
        }
        assert!(found.reach().is_none());
        assert!(found.values() < 400, "{}", found.values());
    }

    #[test]
    fn each_side_of_a_break_has_its_own_formula() {
        // |sin φ| has corners at 0 and π.
        let corners = [0.0, 0.5 * TAU];
        let found =
            ChebyshevInterpolation::periodic("v", |phi| phi.sin().abs(), TAU, &corners).unwrap();
        let breaks = found.breaks();
        for phi in [-7.0, -0.1, 0.1, 3.0, 3.2, 40.0] {
            let segment = breaks.segment_at(phi, 1.0);
            let jet = found.jet(segment, phi);
            assert!((jet.value - phi.sin().abs()).abs() < 1e-13, "{phi}");
            let slope = phi.cos() * phi.sin().signum();
            assert!((jet.first - slope).abs() < 1e-10, "{phi}");
        }
        // Just beyond a corner the formula of the segment goes on.
        let segment = breaks.segment_at(-1e-3, 1.0);
        assert!((found.jet(segment, 1e-6).value + 1e-6).abs() < 1e-12);
        let wrong = ChebyshevInterpolation::periodic("v", |phi| phi.sin().abs(), TAU, &[0.0]);
        assert!(
            wrong
                .unwrap_err()
                .message
                .contains("not smooth near φ = 3.14")
        );
    }

    #[test]
    fn a_period_that_is_none_is_told() {
        let wrong = ChebyshevInterpolation::periodic("v", |phi| (0.5 * phi).sin(), TAU, &[]);
        assert!(wrong.unwrap_err().message.contains("near φ = 0"));
        let constant = ChebyshevInterpolation::periodic("v", |_| 0.3, TAU, &[]).unwrap();
        assert!(constant.jet(0, 100.0).first.abs() < 1e-12);
    }

    #[test]
    fn a_reach_ends_where_it_is_said() {
        let found =
            ChebyshevInterpolation::between("w", |phi| phi.sqrt(), (0.5, 2.0), &[]).unwrap();
        assert_eq!(found.reach(), Some((0.5, 2.0)));
        assert!((found.jet(0, 1.7).second + 0.25 * 1.7f64.powf(-1.5)).abs() < 1e-8);
        assert!(ChebyshevInterpolation::between("w", |phi| phi.sqrt(), (-1.0, 2.0), &[]).is_err());
        assert!(ChebyshevInterpolation::between("w", |_| 1.0, (2.0, 1.0), &[]).is_err());
    }
}
