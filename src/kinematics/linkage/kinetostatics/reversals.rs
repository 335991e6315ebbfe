//! Where pairs change the direction in which they slide while the input goes on
//! in one direction: the roots of their first transfer functions, found
//! beforehand.
//!
//! They are a track of modes in a run.

use super::Kinetostatics;
use super::friction::sign as sign_of;
use super::place::AT_REST;
use super::positions::Positions;
use crate::kinematics::breaks::Breaks;
use crate::kinematics::linkage::{Linkage, Reach, Workspace};
use crate::math::roots::{middle, try_bisect};
use std::f64::consts::PI;

/// Positions looked at in a turn, or over the whole of a limited reach.
const POSITIONS: usize = 720;
/// Share of a limited reach at its ends that is not looked at.
const EDGE: f64 = 1e-9;
/// Agreement of a cubic with the rate, relative, and the most halvings.
const AGREES: f64 = 1e-3;
const DEEPEST: u32 = 24;
/// Halvings between two neighbouring places at most: towards a dead-centre position all of
/// them go one way, and where a rate is rounding no number of them is enough.
const HALVINGS: u32 = 512;
/// Bisections, down to rounding.
const BISECTIONS: u32 = 80;
/// Two changes closer than this share of the whole are one.
const SAME_CHANGE: f64 = 1e-12;

/// The course of an input in pieces within which no pair that has friction
/// changes the direction in which it slides.
#[derive(Clone, Debug, PartialEq)]
pub struct Reversals {
    /// Ends of the pieces along the input coordinate.
    pub breaks: Breaks,
    /// For every piece the sign of every pair's first transfer function; 0 for
    /// pairs without friction and for those that stand still.
    pub senses: Vec<Vec<f64>>,
}

impl Reversals {
    /// Looks along the whole reach of a linkage.
    pub fn of(linkage: &Linkage, kinetostatics: &Kinetostatics) -> Self {
        let range = linkage.range();
        let (start, span, period) = match (&range.period, &range.reach) {
            (Some(period), _) => (range.start, period.length, Some(period.length)),
            (None, Reach::Interval { lower, upper }) => (lower.at, upper.at - lower.at, None),
            // Nothing hangs on the driver: its own pair slides as it does.
            (None, Reach::Everywhere) => (range.start, 0.0, None),
        };
        let mut course = Course {
            linkage,
            workspace: linkage.workspace(),
            start,
            span,
            periodic: period.is_some(),
            halvings: 0,
        };
        let rubbing: Vec<usize> = (0..kinetostatics.spec.pairs.len())
            .filter(|&pair| kinetostatics.friction_factors[pair].is_some())
            .collect();
        let mut points = course.roots(&rubbing);
        points.sort_by(f64::total_cmp);
        points.dedup_by(|a, b| (*a - *b).abs() <= SAME_CHANGE * span);
        let breaks = Breaks { points, period };
        let senses = course.senses(&breaks, &rubbing);
        Self { breaks, senses }
    }

    /// The senses in a segment of [`Self::breaks`].
    pub fn at(&self, segment: i64) -> &[f64] {
        let (piece, _) = self.breaks.piece(segment);
        &self.senses[piece.min(self.senses.len() - 1)]
    }
}

struct Course<'a> {
    linkage: &'a Linkage,
    workspace: Workspace,
    start: f64,
    span: f64,
    periodic: bool,
    /// Halvings left between the present places.
    halvings: u32,
}

impl Course<'_> {
    /// First three derivatives of a pair's coordinate.
    fn rates(&mut self, pair: usize, q: f64) -> Option<[f64; 3]> {
        self.linkage.solve(q, 3, &mut self.workspace).ok()?;
        let rates = self.workspace.pair_rates(pair);
        rates.iter().all(|rate| rate.is_finite()).then_some(rates)
    }

    /// Places to look at, denser towards the ends of a limited reach.
    fn places(&self) -> Vec<f64> {
        let turns = (self.span / (2.0 * PI)).ceil().clamp(1.0, 64.0) as usize;
        let count = if self.periodic {
            POSITIONS * turns
        } else {
            POSITIONS
        };
        let share = |k: usize| {
            let k = k as f64 / count as f64;
            match self.periodic {
                true => k,
                false => (0.5 - 0.5 * (PI * k).cos()).clamp(EDGE, 1.0 - EDGE),
            }
        };
        (0..=count)
            .map(|k| self.start + self.span * share(k))
            .collect()
    }

    /// Where the rates of pairs change their sign.
    fn roots(&mut self, pairs: &[usize]) -> Vec<f64> {
        let mut found = Vec::new();
        if self.span == 0.0 {
            return found;
        }
        let places = self.places();
        for &pair in pairs {
            let rates: Vec<_> = places.iter().map(|&q| self.rates(pair, q)).collect();
            let sizes = rates.iter().flatten().map(|rates| rates[0].abs());
            let size = sizes.fold(0.0, f64::max);
            // What never moves has rounding for a rate, which no cubic agrees with.
            if size <= AT_REST {
                continue;
            }
            for (ends, rates) in places.windows(2).zip(rates.windows(2)) {
                if let (&[low, high], &[Some(a), Some(b)]) = (ends, rates) {
                    self.halvings = HALVINGS;
                    let noise = noise([low, high], [a, b]);
                    self.divide(pair, [low, high], [a, b], (noise, DEEPEST), &mut found);
                }
            }
        }
        // The end of a period is the beginning of the next.
        let end = self.start + self.span * (1.0 - SAME_CHANGE);
        if self.periodic {
            let span = self.span;
            for root in &mut found {
                if *root >= end {
                    *root -= span;
                }
            }
        }
        found
    }

    /// Halves what is between two places until a cubic through both ends tells the
    /// rate in the middle.
    fn divide(
        &mut self,
        pair: usize,
        [low, high]: [f64; 2],
        [a, b]: [[f64; 3]; 2],
        (noise, depth): (f64, u32),
        found: &mut Vec<f64>,
    ) {
        let middle = 0.5 * (low + high);
        let cubic = 0.5 * (a[0] + b[0]) + 0.125 * (high - low) * (a[1] - b[1]);
        let size = a[0].abs().max(b[0].abs());
        match self.rates(pair, middle) {
            Some(c)
                if depth > 0
                    && self.halvings > 0
                    && (c[0] - cubic).abs() > AGREES * size + noise =>
            {
                self.halvings -= 1;
                self.divide(pair, [low, middle], [a, c], (noise, depth - 1), found);
                self.divide(pair, [middle, high], [c, b], (noise, depth - 1), found);
            }
            _ => self.roots_between(pair, [low, high], [a, b], noise, found),
        }
    }

    /// Roots between two neighbouring places: one where the signs differ, two
    /// where the rate turns back beyond zero.
    fn roots_between(
        &mut self,
        pair: usize,
        [low, high]: [f64; 2],
        [a, b]: [[f64; 3]; 2],
        noise: f64,
        found: &mut Vec<f64>,
    ) {
        let sign = |rate: f64| {
            if rate.abs() <= noise {
                0.0
            } else {
                rate.signum()
            }
        };
        let (before, after) = (sign(a[0]), sign(b[0]));
        if before == 0.0 {
            // A root at the place itself counts where the rate changes its sign.
            let previous = self.rates(pair, low - (high - low));
            let previous = previous.map_or(0.0, |rates| sign(rates[0]));
            if previous * after < 0.0 {
                found.push(low);
            }
        } else if before * after < 0.0 {
            found.push(self.bisect(pair, 0, [low, high], before));
        } else if after == before && sign_of(a[1]) * sign_of(b[1]) < 0.0 && a[1] * before < 0.0 {
            let turn = self.bisect(pair, 1, [low, high], sign_of(a[1]));
            let there = self.rates(pair, turn).map_or(0.0, |rates| sign(rates[0]));
            if there * before < 0.0 {
                found.push(self.bisect(pair, 0, [low, turn], before));
                found.push(self.bisect(pair, 0, [turn, high], there));
            }
        }
    }

    /// The root of a derivative between two places, `sign` its sign at the first.
    fn bisect(&mut self, pair: usize, order: usize, ends: [f64; 2], sign: f64) -> f64 {
        let found = try_bisect(ends, BISECTIONS, 0.0, |q| {
            Some(self.rates(pair, q)?[order] * sign > 0.0)
        });
        let (Ok(ends) | Err(ends)) = found;
        middle(ends)
    }

    /// Signs of all rates in the midst of every piece.
    fn senses(&mut self, breaks: &Breaks, rubbing: &[usize]) -> Vec<Vec<f64>> {
        let pieces = match breaks.period {
            Some(_) => breaks.points.len().max(1),
            None => breaks.points.len() + 1,
        };
        let (first, last) = (self.start, self.start + self.span);
        (0..pieces)
            .map(|piece| {
                let (low, high) = breaks.edges(piece as i64);
                let low = if low.is_finite() { low } else { first };
                let high = if high.is_finite() { high } else { last };
                self.senses_at(0.5 * (low + high), rubbing)
            })
            .collect()
    }

    fn senses_at(&mut self, q: f64, rubbing: &[usize]) -> Vec<f64> {
        let count = self.linkage.spec().pairs.len();
        let mut senses = vec![0.0; count];
        let rates: Vec<f64> = (0..count)
            .map(|pair| self.rates(pair, q).map_or(0.0, |rates| rates[0]))
            .collect();
        for &pair in rubbing {
            // A pair that never moves has a rate of rounding at most.
            let moving = rates[pair].abs() > AT_REST;
            senses[pair] = if moving { rates[pair].signum() } else { 0.0 };
        }
        senses
    }
}

/// Rounding of the rates between two places: a part of what they are there. Elsewhere
/// they may be greater without bounds, towards a dead-centre position.
fn noise([low, high]: [f64; 2], [a, b]: [[f64; 3]; 2]) -> f64 {
    let change = (high - low) * a[1].abs().max(b[1].abs());
    AT_REST * a[0].abs().max(b[0].abs()).max(change).max(AT_REST)
}
