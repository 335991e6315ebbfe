//! Figures between samples: extremes and the mean deviation, exactly.
//!
//! The four functionals of an object are evaluated with their slopes at both
//! ends of every step of the switch search, unless envelopes tell that nothing
//! happens in it. The values met there are noted at once; once the phase has
//! been gone through (or so many steps), the functionals are bounded within the
//! steps ([`super::hermite`]). Where one might pass the greatest value met so
//! far, the step is cut at the summit of its cubic, the summit polished, and
//! what is left on either side bounded again, until nothing can pass. Roots of δ
//! are found the same way. A step in which nothing can happen costs its bound.

mod ahead;
mod back;
mod figures;
mod lanes_ahead;
mod refine;
#[cfg(test)]
mod tests;
mod walk;

pub(crate) use ahead::Ahead;
pub(crate) use back::LookBack;
pub use figures::{FigureTimes, TreeFigures};

use super::basis::Basis;
use super::hermite::{Bounds, End, Piece, Point};
use super::lanes::{Arith, V, WIDTH};
use super::panel::{Amplitudes, Panel, PanelPhase};
use super::phase::{Exponentials, Phase};
use super::requested_figures::RequestedFigures;

/// Most cuts of one step for one figure; what is left is then believed.
const CUTS: usize = 64;

/// Lanes are followed over up to this many radians of theirs.
const FOLLOW: f64 = 4.5;

/// Steps that are looked at together.
const TOGETHER: usize = 32;

/// Steps after which envelopes are asked again whether anything can still happen.
const PATIENCE: u32 = 4;

/// Basis, panel and phase that the figures are taken from.
#[derive(Clone, Copy)]
pub(crate) struct Scene<'a> {
    pub(crate) basis: &'a Basis,
    pub(crate) panel: &'a Panel,
    pub(crate) phase: &'a Phase,
}

impl Scene<'_> {
    /// Number of lanes in use.
    #[inline(always)]
    fn lanes(&self) -> usize {
        self.basis.lanes.len().min(self.phase.active * WIDTH)
    }

    /// Number of lanes, slowest first, that can be followed over a length h.
    #[inline(always)]
    fn followed_lanes(&self, h: f64) -> usize {
        let lanes = self.lanes();
        if lanes == 0 || self.basis.modulus[lanes - 1] * h <= FOLLOW {
            return lanes;
        }
        self.basis.modulus[..lanes].partition_point(|m| m * h <= FOLLOW)
    }
}

/// Track: the figures of an object in the making.
#[derive(Clone, Debug)]
pub(crate) struct Track {
    pub(crate) figures: TreeFigures,
    /// ∫|δ|dt so far.
    pub(crate) area: f64,
    state: PanelPhase,
    engaged: bool,
    asked: RequestedFigures,
    /// Cap on the clearance (half the gap).
    cap: f64,
    /// Start of the phase (s).
    start: f64,
    high: V,
    low: V,
    /// The end of the last step that was looked at.
    last: Point,
    /// Steps to be looked at.
    steps: Vec<[Point; 2]>,
    /// Steps seen in the phase.
    seen: u32,
    /// Mark that envelopes alone may tell that nothing happens in a step.
    quiet: bool,
    /// Mark that a lane is too fast to be followed through a step: its figures are not known.
    pub(crate) lost: bool,
    /// Lanes times parts of steps walked through so far.
    pub(crate) walked: u64,
    /// Bounds of all lanes: over the phase, and since they were last asked.
    whole: V,
    calm: V,
    /// Primitive of δ where it last changed its sign, or the phase began.
    turned: f64,
    /// Roots of δ in a step, with its primitive there.
    roots: Vec<(f64, f64)>,
    pieces: Vec<Piece>,
    /// Some instant within a step, and the lanes there.
    e: Exponentials,
    look: Amplitudes,
    /// The lanes at the start and the end of the step.
    before: Amplitudes,
    now: Amplitudes,
    /// Ends of the parts of a step that is walked through.
    from: Amplitudes,
    to: Amplitudes,
}

impl Track {
    pub(crate) fn new(
        (blocks, harmonics): (usize, usize),
        flights: usize,
        delta: f64,
        cap: f64,
        asked: RequestedFigures,
    ) -> Self {
        Self {
            figures: TreeFigures {
                delta_max: delta,
                delta_min: delta,
                ..TreeFigures::default()
            },
            area: 0.0,
            state: PanelPhase::new(blocks, flights),
            engaged: true,
            asked,
            cap,
            start: 0.0,
            high: V::ZERO,
            low: V::ZERO,
            last: Point::default(),
            steps: Vec::with_capacity(if asked.mean { 0 } else { TOGETHER }),
            seen: 0,
            quiet: false,
            lost: false,
            walked: 0,
            whole: V::ZERO,
            calm: V::ZERO,
            turned: 0.0,
            roots: Vec::with_capacity(if asked.mean { CUTS } else { 0 }),
            pieces: Vec::with_capacity(CUTS + 1),
            e: Exponentials::new(blocks, harmonics),
            look: Amplitudes::new(blocks),
            before: Amplitudes::new(blocks),
            now: Amplitudes::new(blocks),
            from: Amplitudes::new(blocks),
            to: Amplitudes::new(blocks),
        }
    }

    /// Takes up a phase at the instant of `e`, its start; `engaged`: the fourth
    /// functional is the link's force, otherwise the clearance.
    #[inline(always)]
    pub(crate) fn begin_phase<A: Arith>(&mut self, scene: Scene, e: &Exponentials, engaged: bool) {
        let Scene {
            basis,
            panel,
            phase,
        } = scene;
        self.state.begin_phase::<A>(basis, panel, phase);
        self.engaged = engaged;
        self.start = phase.start;
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
        // What is not asked for can never pass.
        for (k, asked) in self.asked.functionals(engaged).into_iter().enumerate() {
            if !asked {
                (self.high.0[k], self.low.0[k]) = (f64::INFINITY, f64::NEG_INFINITY);
            }
        }
        self.whole = self.state.bounds_of_all_lanes::<A>(panel, phase);
        self.seen = 0;
        self.calm = self.whole;
        // What flies is at rest at the start alone.
        let flies = self.asked.mean && !phase.flights.is_empty();
        self.quiet = !flies && self.is_calm_between::<A>(0.0, 0.0);
        (self.before.s, self.now.s) = (f64::NEG_INFINITY, f64::NEG_INFINITY);
        (self.last.s, self.look.s) = (f64::NEG_INFINITY, f64::NEG_INFINITY);
        if !self.quiet || self.asked.mean {
            self.state.write_start_of_phase(phase, &mut self.now);
        }
        if !self.quiet {
            let point = self.state.point::<A>(panel, phase.active, &self.now, e);
            self.note_values(&point);
            self.last = point;
        }
        if self.asked.mean {
            self.turned = self
                .state
                .first_primitive::<A>(panel, phase.active, &self.now);
        }
    }

    /// Asks the envelope of all lanes from the local time s on whether anything
    /// can happen.
    #[inline(always)]
    fn set_envelope<A: Arith>(&mut self, s: f64, envelope: V) {
        self.calm = envelope;
        self.quiet = self.is_calm_between::<A>(s, s);
    }

    /// True when the envelopes tell that between two instants no figure can
    /// pass its greatest value and δ keeps its sign.
    #[inline(always)]
    fn is_calm_between<A: Arith>(&self, from: f64, to: f64) -> bool {
        self.rules_out::<A>(from, to, self.calm)
    }

    /// True when lanes within `envelope` together let nothing happen between two
    /// instants.
    #[inline(always)]
    fn rules_out<A: Arith>(&self, from: f64, to: f64, envelope: V) -> bool {
        let bounds = self.state.envelope::<A>(from, to, envelope);
        bounds.is_some_and(|bounds| self.is_calm_within(&bounds))
    }

    /// True when values within the bounds pass nothing, rounding apart, and δ
    /// keeps its sign.
    #[inline(always)]
    fn is_calm_within(&self, bounds: &Bounds) -> bool {
        let beyond = (bounds.high - self.high).max(self.low - bounds.low);
        (beyond - self.margin()).greatest() <= 0.0 && !self.may_turn(bounds)
    }

    /// Bounds between the point `a` and the instant `to`, which the envelope of
    /// all lanes may narrow.
    #[inline(always)]
    fn narrowed<A: Arith>(&self, bounds: Bounds, a: &Point, to: f64) -> Bounds {
        match self.state.envelope::<A>(a.s, to, a.envelope) {
            Some(other) => Bounds {
                low: bounds.low.max(other.low),
                high: bounds.high.min(other.high),
            },
            None => bounds,
        }
    }

    /// Evaluates at the instant of `e`, and notes what is greater than before.
    #[inline(always)]
    fn evaluate_at<A: Arith>(&mut self, scene: Scene, e: &Exponentials) -> Point {
        let Scene { panel, phase, .. } = scene;
        self.state.amplitudes::<A>(phase, e, &mut self.now);
        let point = self.state.point::<A>(panel, phase.active, &self.now, e);
        self.note_values(&point);
        point
    }

    /// The same at the local time s, which was passed by.
    #[inline(always)]
    fn evaluate_passed<A: Arith>(&mut self, scene: Scene, s: f64) {
        let mut e = std::mem::take(&mut self.e);
        if s == 0.0 {
            e.start(scene.phase.active);
        } else {
            scene.phase.exponentials::<A>(scene.basis, s, &mut e);
        }
        self.last = self.evaluate_at::<A>(scene, &e);
        self.e = e;
    }

    #[inline(always)]
    fn note_values(&mut self, point: &Point) {
        let value = point.value;
        let (over, under) = (value - self.high, self.low - value);
        if over.max(under).greatest() > 0.0 {
            for k in 0..4 {
                for (beyond, sign) in [(over.0[k], 1.0), (under.0[k], -1.0)] {
                    if beyond > 0.0 {
                        self.note_greatest((k, sign), sign * value.0[k], point.s);
                    }
                }
            }
        }
    }

    /// Notes the step from the local time `from` to the instant of `now`.
    #[inline(always)]
    pub(crate) fn note_step<A: Arith>(&mut self, scene: Scene, from: f64, now: &Exponentials) {
        if self.quiet && self.is_calm_between::<A>(from, now.s) {
            return;
        }
        if self.last.s != from {
            self.evaluate_passed::<A>(scene, from);
        }
        std::mem::swap(&mut self.before, &mut self.now);
        let before = self.last;
        self.last = self.evaluate_at::<A>(scene, now);
        if self.asked.mean {
            // Most steps have to be looked into anyway, in their order.
            let after = self.last;
            self.process_step::<A>(scene, &before, &after);
        } else {
            self.steps.push([before, self.last]);
            if self.steps.len() == TOGETHER {
                A::run_out_of_line(LookBack { track: self, scene });
            }
        }
        self.seen += 1;
        if self.seen.is_multiple_of(PATIENCE) {
            self.set_envelope::<A>(now.s, self.last.envelope);
        }
    }

    /// True when there are steps to be looked at.
    #[inline(always)]
    pub(crate) fn has_steps(&self) -> bool {
        !self.steps.is_empty()
    }

    /// True when δ may change its sign, and that matters.
    #[inline(always)]
    pub(super) fn may_turn(&self, bounds: &Bounds) -> bool {
        self.asked.mean && mixed(bounds.low.0[0], bounds.high.0[0])
    }

    #[inline(always)]
    fn margin(&self) -> V {
        let size = self.high.map(f64::abs).max(self.low.map(f64::abs));
        size.map(|x| if x < f64::INFINITY { 1e-14 * x } else { 0.0 })
    }

    /// Ends the phase at the instant of `e`.
    #[inline(always)]
    pub(crate) fn end<A: Arith>(&mut self, scene: Scene, e: &Exponentials) {
        if !self.asked.mean {
            return;
        }
        let Scene { panel, phase, .. } = scene;
        self.state.amplitudes::<A>(phase, e, &mut self.look);
        let last = self.state.primitive::<A>(panel, phase, &self.look, e);
        self.area += (last - self.turned).abs();
    }

    /// Notes a new greatest value of sign·(functional k), met at the local time s.
    #[inline(always)]
    fn note_greatest(&mut self, (k, sign): (usize, f64), best: f64, s: f64) {
        let time = self.start + s;
        let f = &mut self.figures;
        let (figure, value, when) = match (k, sign > 0.0, self.engaged) {
            (0, true, _) => (&mut f.delta_max, best, &mut f.times.delta_max),
            (0, false, _) => (&mut f.delta_min, -best, &mut f.times.delta_min),
            (1, ..) => (&mut f.peak_speed, best, &mut f.times.peak_speed),
            (2, ..) => (
                &mut f.peak_acceleration,
                best,
                &mut f.times.peak_acceleration,
            ),
            (_, _, true) => (&mut f.peak_reaction, best, &mut f.times.peak_reaction),
            _ => (&mut f.max_lift, best.min(self.cap), &mut f.times.max_lift),
        };
        (*figure, *when) = (value, time);
        if k > 0 || sign > 0.0 {
            self.high.0[k] = best;
        }
        if (k > 0 && (k < 3 || self.engaged)) || sign < 0.0 {
            self.low.0[k] = -best;
        }
    }
}

/// True when a value in the range may be of either sign, beyond rounding.
#[inline(always)]
fn mixed(low: f64, high: f64) -> bool {
    low < -1e-13 * high && high > -1e-13 * low
}

/// Functional k between two points, turned by `sign`.
#[inline(always)]
fn piece(a: &Point, b: &Point, k: usize, sign: f64) -> Piece {
    let end = |p: &Point| End {
        s: p.s,
        f: p.value.0[k] * sign,
        g: p.slope.0[k] * sign,
    };
    Piece {
        a: end(a),
        b: end(b),
    }
}
