//! Figures between samples: extremes and the mean deviation, exactly.
//!
//! On every step of the switch search the four functionals of an object are
//! bounded together ([`super::panel`]). Where one might pass the greatest value
//! met so far the interval is noted, and when the phase is complete the value
//! is climbed to: the first root of (best + margin − f) by the same guaranteed
//! search, then the first root of ḟ, and on. A value that nothing can beat
//! costs nothing but its bound.

use super::basis::Basis;
use super::lanes::{Arith, V};
use super::panel::{Panel, PanelPhase};
use super::phase::{Exponentials, Phase};
use super::search::{Search, Step};
use super::signal::Signal;

/// Figures of one object of a tree.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TreeFigures {
    /// Greatest δ.
    pub delta_max: f64,
    /// Least δ.
    pub delta_min: f64,
    /// Mean of |δ| over the run.
    pub sigma: f64,
    /// Greatest |φ̇| of the last mass.
    pub peak_speed: f64,
    /// Greatest |φ̈| of the last mass, both sides of a switch included.
    pub peak_acceleration: f64,
    /// Greatest |F| of link 1; with a pair also its greatest contact force.
    pub peak_reaction: f64,
    /// Greatest clearance from the nearest flank.
    pub max_lift: f64,
}

/// An interval still to be looked into.
type Interval = Option<(f64, f64)>;

/// One object's figures in the making.
#[derive(Clone, Debug)]
pub(crate) struct Track {
    pub(crate) figures: TreeFigures,
    /// ∫|δ|dt so far.
    pub(crate) area: f64,
    state: PanelPhase,
    engaged: bool,
    /// Cap on the clearance (half the gap).
    cap: f64,
    high: V,
    low: V,
    above: [Interval; 4],
    below: [Interval; 4],
    mixed: Interval,
    search: Search,
    signals: [Signal; 2],
    begin: Exponentials,
}

impl Track {
    pub(crate) fn new(blocks: usize, flights: usize, delta: f64, cap: f64) -> Self {
        let mut begin = Exponentials::new(blocks);
        begin.re.fill(V::splat(1.0));
        begin.size.fill(V::splat(1.0));
        let signal = Signal::new(blocks, flights);
        Self {
            figures: TreeFigures {
                delta_max: delta,
                delta_min: delta,
                ..TreeFigures::default()
            },
            area: 0.0,
            state: PanelPhase::new(blocks, flights),
            engaged: true,
            cap,
            high: V::ZERO,
            low: V::ZERO,
            above: [None; 4],
            below: [None; 4],
            mixed: None,
            search: Search::new(blocks),
            signals: [signal.clone(), signal],
            begin,
        }
    }

    /// Takes up a phase; `engaged`: the fourth functional is the link's force,
    /// otherwise the clearance.
    #[inline(always)]
    pub(crate) fn begin<A: Arith>(
        &mut self,
        basis: &Basis,
        panel: &Panel,
        phase: &Phase,
        engaged: bool,
    ) {
        self.state.take::<A>(basis, panel, phase);
        self.engaged = engaged;
        let f = &self.figures;
        let (force, floor) = if engaged {
            (f.peak_reaction, -f.peak_reaction)
        } else {
            (f.max_lift, f64::NEG_INFINITY)
        };
        self.high = V([f.delta_max, f.peak_speed, f.peak_acceleration, force]);
        self.low = V([f.delta_min, -f.peak_speed, -f.peak_acceleration, floor]);
        if !engaged && f.max_lift >= self.cap {
            self.high.0[3] = f64::INFINITY;
        }
        self.above = [None; 4];
        self.below = [None; 4];
        self.mixed = None;
    }

    /// Notes what may happen over [e.s, e.s + h].
    #[inline(always)]
    pub(crate) fn step<A: Arith>(
        &mut self,
        basis: &Basis,
        panel: &Panel,
        phase: &Phase,
        e: &Exponentials,
        h: f64,
    ) {
        let bounds = self.state.bounds::<A>(basis, panel, phase, e, h);
        let over = bounds.high - self.high;
        let under = self.low - bounds.low;
        let (from, to) = (e.s, e.s + h);
        let worst = over.max(under);
        // Differences below rounding are not worth a climb.
        let margin = self.margin();
        if (0..4).any(|k| worst.0[k] > margin.0[k]) {
            for k in 0..4 {
                if over.0[k] > margin.0[k] {
                    widen(&mut self.above[k], from, to);
                }
                if under.0[k] > margin.0[k] {
                    widen(&mut self.below[k], from, to);
                }
            }
        }
        if bounds.low.0[0] < 0.0 && bounds.high.0[0] > 0.0 {
            widen(&mut self.mixed, from, to);
        }
    }

    #[inline(always)]
    fn margin(&self) -> V {
        let size = self.high.map(f64::abs).max(self.low.map(f64::abs));
        size.map(|x| if x < f64::INFINITY { 1e-14 * x } else { 0.0 })
    }

    /// Ends the phase at the instant of `e`.
    #[inline(always)]
    pub(crate) fn end<A: Arith>(
        &mut self,
        basis: &Basis,
        panel: &Panel,
        phase: &Phase,
        e: &Exponentials,
    ) {
        for k in 0..4 {
            if self.above[k].is_some() || self.below[k].is_some() {
                self.improve::<A>(basis, panel, phase, k, e.s);
            }
        }
        let first = self.state.primitive::<A>(basis, panel, phase, &self.begin);
        let last = self.state.primitive::<A>(basis, panel, phase, e);
        self.area += match self.mixed {
            None => (last - first).abs(),
            Some((from, to)) => {
                self.area_between::<A>(basis, panel, phase, (from, to.min(e.s)), (first, last))
            }
        };
    }

    #[inline(always)]
    fn improve<A: Arith>(
        &mut self,
        basis: &Basis,
        panel: &Panel,
        phase: &Phase,
        k: usize,
        end: f64,
    ) {
        for (interval, sign) in [(self.above[k], 1.0), (self.below[k], -1.0)] {
            let Some((from, to)) = interval else { continue };
            let best = if sign > 0.0 {
                self.high.0[k]
            } else {
                -self.low.0[k]
            };
            let range = (from.min(end), to.min(end));
            let best = self.climb::<A>(basis, panel, phase, (k, sign), range, best);
            let f = &mut self.figures;
            match (k, sign > 0.0, self.engaged) {
                (0, true, _) => f.delta_max = best,
                (0, false, _) => f.delta_min = -best,
                (1, ..) => f.peak_speed = best,
                (2, ..) => f.peak_acceleration = best,
                (_, _, true) => f.peak_reaction = best,
                _ => f.max_lift = best.min(self.cap),
            }
            if k > 0 {
                self.high.0[k] = best;
                self.low.0[k] = if k < 3 || self.engaged {
                    -best
                } else {
                    f64::NEG_INFINITY
                };
            }
        }
    }

    /// Greatest value of sign·f over the range, at least `best`.
    #[inline(always)]
    fn climb<A: Arith>(
        &mut self,
        basis: &Basis,
        panel: &Panel,
        phase: &Phase,
        (k, sign): (usize, f64),
        (from, to): (f64, f64),
        mut best: f64,
    ) -> f64 {
        let (functional, weights) = (&panel.functionals[k], &panel.single[k]);
        self.search.evaluate::<A>(basis, phase, from);
        let [value, slope] = &mut self.signals;
        value.take::<A>(basis, phase, functional, weights, sign);
        best = best.max(value.value::<A>(basis, phase.active, &self.search.e));
        slope.take::<A>(basis, phase, functional, weights, sign);
        slope.differentiate(basis, phase.reach);
        for _ in 0..10_000 {
            value.take::<A>(basis, phase, functional, weights, -sign);
            let noise = value.noise_until(to);
            let margin = (1e-14 * best.abs()).max(4.0 * noise);
            value.add(best + margin);
            // At the summit itself the signal is its margin, give or take its rounding.
            value.noise = noise;
            value.leaving = true;
            let rises = loop {
                match self
                    .search
                    .step::<A>(basis, phase, std::slice::from_mut(value), &[0], to)
                {
                    Step::Free => {}
                    Step::Root(_) => break true,
                    _ => break false,
                }
            };
            if rises {
                // On to the summit.
                while self
                    .search
                    .step::<A>(basis, phase, std::slice::from_mut(slope), &[0], to)
                    == Step::Free
                {}
            }
            value.take::<A>(basis, phase, functional, weights, sign);
            let now = value.value::<A>(basis, phase.active, &self.search.e);
            best = best.max(now);
            if !rises || self.search.e.s >= to {
                break;
            }
        }
        best
    }

    /// ∫|δ| over a phase in which δ may change its sign within `range`.
    #[inline(always)]
    fn area_between<A: Arith>(
        &mut self,
        basis: &Basis,
        panel: &Panel,
        phase: &Phase,
        (from, to): (f64, f64),
        (first, last): (f64, f64),
    ) -> f64 {
        let (functional, weights) = (&panel.functionals[0], &panel.single[0]);
        let (mut area, mut before) = (0.0, first);
        self.search.evaluate::<A>(basis, phase, from);
        let signal = &mut self.signals[0];
        signal.take::<A>(basis, phase, functional, weights, 1.0);
        let (jet, _) = self.search.jet::<A>(basis, phase, signal);
        let mut sign = if jet[0].abs() > signal.noise {
            jet[0]
        } else {
            jet[1]
        }
        .signum();
        for _ in 0..100_000 {
            signal.take::<A>(basis, phase, functional, weights, sign);
            signal.leaving = true;
            let root = loop {
                match self
                    .search
                    .step::<A>(basis, phase, std::slice::from_mut(signal), &[0], to)
                {
                    Step::Free => {}
                    Step::Root(_) => break true,
                    _ => break false,
                }
            };
            if !root {
                break;
            }
            let now = self
                .state
                .primitive::<A>(basis, panel, phase, &self.search.e);
            area += (now - before).abs();
            before = now;
            sign = -sign;
        }
        area + (last - before).abs()
    }
}

fn widen(interval: &mut Interval, from: f64, to: f64) {
    *interval = Some(match *interval {
        None => (from, to),
        Some((a, b)) => (a.min(from), b.max(to)),
    });
}
