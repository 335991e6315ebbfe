//! The first place of a stretch of a motion at which a guard leaves its mode.

use super::interval::Interval;
use super::moving::RateBounds;
use super::program::{Code, Guard, GuardKind, OPEN};
use crate::math::number::Dual;
use crate::math::roots::{BISECTIONS, bisect};

/// A stretch of a motion over s ∈ [0, 1]: the variables of an expression.
pub(crate) trait Stretch {
    /// The variables at a place.
    fn at(&self, s: f64, out: &mut [f64]);

    /// Bounds of the variables and of their rates by s from one place to another.
    fn over(&self, from: f64, to: f64, out: &mut [RateBounds]);
}

/// Most variables of an expression.
pub(crate) const VARIABLES: usize = 8;

/// A stretch is halved down to this length.
const SHORTEST: f64 = 1e-12;

/// Most evaluations over stretches; then what has not been shown to hold is looked at
/// at the ends of the stretches.
const MOST: usize = 4000;

/// Where a guard that has just changed its mode stands, in units of its bounds over the
/// step, it is zero up to rounding.
const AT_EDGE: f64 = 1e-6;

/// Room for stretches that wait: each halving leaves one.
const DEPTH: usize = 64;

/// A bound that a guard must not fall below: `sense`·(g − `edge`) ≥ 0.
#[derive(Clone, Copy, Debug)]
struct Side {
    sense: f64,
    edge: f64,
    target: i64,
}

/// A change of a guard's mode.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Crossing {
    /// Place of the stretch.
    pub(crate) s: f64,
    /// Mode behind it.
    pub(crate) target: i64,
}

impl Guard {
    /// The bounds that hold in a mode.
    fn sides(&self, mode: i64) -> ([Side; 2], usize) {
        let side = |sense: f64, edge: f64, target: i64| Side {
            sense,
            edge,
            target,
        };
        match self.kind {
            GuardKind::Sign { .. } => {
                let one = side(mode as f64, 0.0, -mode);
                ([one, one], 1)
            }
            GuardKind::Whole => {
                let below = side(1.0, mode as f64, mode - 1);
                let above = side(-1.0, (mode + 1) as f64, mode + 1);
                ([below, above], 2)
            }
        }
    }

    /// The mode at a value; [`OPEN`] where there is none. What lies on an edge goes the
    /// way of `rate`.
    pub(crate) fn mode_at(&self, value: f64, rate: f64) -> i64 {
        if value.is_nan() {
            return OPEN;
        }
        match self.kind {
            GuardKind::Sign { at_rest } if value == 0.0 => match rate {
                rate if rate < 0.0 => -1,
                rate if rate > 0.0 => 1,
                _ => at_rest,
            },
            GuardKind::Sign { .. } if value < 0.0 => -1,
            GuardKind::Sign { .. } => 1,
            GuardKind::Whole => {
                // Beyond 10¹⁵ a number has no part that is not whole.
                let floor = value.clamp(-1e15, 1e15).floor();
                let falls = floor == value && rate < 0.0;
                floor as i64 - i64::from(falls)
            }
        }
    }

    /// The first place up to `end` at which the guard leaves its mode by more than
    /// `floor`; `fresh`: it may have entered it just now.
    pub(crate) fn first_crossing(
        &self,
        mode: i64,
        modes: &impl Fn(u16) -> i64,
        stretch: &impl Stretch,
        end: f64,
        (fresh, floor): (bool, f64),
    ) -> Option<Crossing> {
        let (sides, count) = self.sides(mode);
        let mut first: Option<Crossing> = None;
        for side in &sides[..count] {
            let search = Search {
                code: &self.code,
                side: *side,
                modes,
                stretch,
                shift: std::cell::Cell::new(-floor),
            };
            let end = first.map_or(end, |first| first.s);
            if let Some(s) = search.first_change(end, fresh && floor == 0.0) {
                first = Some(Crossing {
                    s,
                    target: side.target,
                });
            }
        }
        first
    }
}

/// A guard whose value changes by more than this share of it jumps.
const JUMPS: f64 = 1e-9;

/// Changes the mode of a guard, and puts those that jump with it or come to stand still,
/// and those that had no value, into the modes in which they go on. `at`: value and rate
/// of a guard in given modes. Returns those of the guard before and behind the change.
pub(crate) fn change_mode(
    guards: &[Guard],
    changed: usize,
    target: i64,
    modes: &mut [i64],
    mut at: impl FnMut(usize, &[i64]) -> Dual,
) -> [Dual; 2] {
    let before: Vec<Dual> = (0..guards.len()).map(|guard| at(guard, modes)).collect();
    modes[changed] = target;
    let goes = at(changed, modes);
    for other in (0..guards.len()).filter(|&other| other != changed) {
        let (one, two) = (before[other], at(other, modes));
        let size = one.value.abs().max(two.value.abs());
        let jumps = (one.value - two.value).abs() > JUMPS * size;
        let stands = two.value == 0.0 && one.derivative != two.derivative;
        if jumps || stands || modes[other] == OPEN {
            modes[other] = guards[other].mode_at(two.value, two.derivative);
        }
    }
    [before[changed], goes]
}

struct Search<'a, M, S> {
    code: &'a Code,
    side: Side,
    modes: &'a M,
    stretch: &'a S,
    /// What is taken off: the rounding of a guard that is just zero, or a floor, negative.
    shift: std::cell::Cell<f64>,
}

impl<M: Fn(u16) -> i64, S: Stretch> Search<'_, M, S> {
    /// sense·(g − edge) at a place.
    fn value(&self, s: f64) -> f64 {
        let mut values = [0.0; VARIABLES];
        self.stretch.at(s, &mut values);
        let g = self.code.evaluate(&values, self.modes);
        self.side.sense * (g - self.side.edge) - self.shift.get()
    }

    /// Its bounds and those of its rate over a stretch.
    fn over(&self, from: f64, to: f64) -> [Interval; 2] {
        let mut values = [RateBounds {
            value: Interval::of(0.0),
            rate: Interval::of(0.0),
        }; VARIABLES];
        self.stretch.over(from, to, &mut values);
        let g = self.code.evaluate(&values, self.modes);
        let (value, rate) = match self.side.sense > 0.0 {
            true => (g.value, g.rate),
            false => (-g.value, -g.rate),
        };
        let shift = Interval::of(self.side.sense * self.side.edge + self.shift.get());
        [value - shift, rate]
    }

    fn first_change(&self, end: f64, fresh: bool) -> Option<f64> {
        let start = self.value(0.0);
        let [value, _] = self.over(0.0, end);
        if value.low > 0.0 {
            return None;
        }
        if fresh && start <= 0.0 {
            let size = value.low.abs().max(value.high.abs());
            let at_edge = !size.is_finite() || start.abs() <= AT_EDGE * size;
            let [_, near] = self.over(0.0, end * SHORTEST);
            match at_edge && !(near.high < 0.0) {
                true => self.shift.set(start),
                false => return Some(0.0),
            }
        } else if start < 0.0 {
            return Some(0.0);
        }
        if start.is_nan() && self.value(end).is_nan() && value.is_nothing() {
            return None;
        }
        self.search(end)
    }

    /// Halves what may hold a zero, from the left.
    fn search(&self, end: f64) -> Option<f64> {
        let mut waiting = [(0.0, end); DEPTH];
        let mut count = 1;
        let mut evaluations = 0;
        while count > 0 {
            count -= 1;
            let (from, to) = waiting[count];
            let [value, rate] = self.over(from, to);
            evaluations += 1;
            let middle = from + 0.5 * (to - from);
            // The mean value theorem: closer than the expression itself where it is short.
            let reach = Interval::between(-0.5 * (to - from), 0.5 * (to - from));
            let tight = value.intersection(Interval::of(self.value(middle)) + rate * reach);
            if tight.low > 0.0 || value.low >= 0.0 {
                continue;
            }
            let ends = |this: &Self| (this.value(to) < 0.0).then(|| this.root(from, to));
            let monotone = rate.low >= 0.0 || rate.high <= 0.0;
            let short = to - from <= SHORTEST * end || evaluations > MOST;
            if monotone || short || count + 2 > DEPTH {
                // (Rising, it was not negative at its start.)
                if let Some(s) = ends(self) {
                    return Some(s);
                }
                continue;
            }
            waiting[count] = (middle, to);
            waiting[count + 1] = (from, middle);
            count += 2;
        }
        None
    }

    /// Where it falls below zero.
    fn root(&self, from: f64, to: f64) -> f64 {
        let [_, high] = bisect([from, to], BISECTIONS, |s| !(self.value(s) < 0.0));
        high
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::expression::Expression;

    /// Variables t = s and x = a polynomial of s.
    struct Along(fn(f64) -> f64, fn(f64) -> f64);

    impl Stretch for Along {
        fn at(&self, s: f64, out: &mut [f64]) {
            out[0] = s;
            out[1] = (self.0)(s);
        }

        fn over(&self, from: f64, to: f64, out: &mut [RateBounds]) {
            out[0] = RateBounds {
                value: Interval::between(from, to),
                rate: Interval::of(1.0),
            };
            // Monotone here.
            out[1] = RateBounds {
                value: Interval::between((self.0)(from), (self.0)(to)),
                rate: Interval::between((self.1)(from), (self.1)(to)),
            };
        }
    }

    fn first_change(text: &str, mode: i64) -> Option<Crossing> {
        let expression = Expression::new(text, &["t", "x"]).unwrap();
        let program = expression.program();
        assert_eq!(program.guards.len(), 1, "{text}");
        let along = Along(|s| 3.0 * s * s, |s| 6.0 * s);
        program.guards[0].first_crossing(mode, &|_| OPEN, &along, 1.0, (false, 0.0))
    }

    #[test]
    fn crossings_are_where_the_guard_changes() {
        for (text, mode, wanted) in [
            ("abs(x - 1)", -1, Some((1f64 / 3.0).sqrt())),
            ("abs(0.4 - t)", 1, Some(0.4)),
            (
                "abs(sin(40*x) - 0.99)",
                -1,
                Some((0.99f64.asin() / 120.0).sqrt()),
            ),
            ("floor(10*x)", 0, Some((0.1f64 / 3.0).sqrt())),
            ("t < 0.25 ? 1 : 2", 1, Some(0.25)),
            ("max(t, x)", -1, Some(1.0 / 3.0)),
            ("abs((t - 0.5)^2 + 1e-9)", 1, None),
            ("abs((t - 0.5)^2 - 1e-12)", 1, Some(0.5 - 1e-6)),
            ("abs(2 + sin(7*x)*t)", 1, None),
            ("abs(sqrt(x - 9))", 1, None),
        ] {
            let found = first_change(text, mode);
            match wanted {
                None => assert_eq!(found, None, "{text}"),
                Some(place) => {
                    let s = found.unwrap_or_else(|| panic!("{text}")).s;
                    assert!((s - place).abs() < 1e-9, "{text}: {s} {place}");
                }
            }
        }
    }

    #[test]
    fn two_crossings_close_together_are_not_stepped_over() {
        // Down through zero and up again within a hundred thousandth of the stretch.
        let found = first_change("abs((t - 0.7)^2 - 2.5e-11)", 1).unwrap();
        approx::assert_abs_diff_eq!(found.s, 0.7 - 5e-6, epsilon = 1e-9);
    }
}
