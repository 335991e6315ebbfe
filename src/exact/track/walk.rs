//! Parts of a step with lanes that turn far.

use super::lanes_ahead::LanesAhead;
use super::{FOLLOW, Scene, Track};
use crate::exact::hermite::{Point, enclose};
use crate::exact::lanes::{Arith, Task};
use crate::exact::panel::Amplitudes;

/// Parts over which every lane is followed before a longer one is tried again.
const PATIENCE: i32 = 4;

/// A longer part is so many times as long.
const GROWTH: f64 = 4.0;

/// Most parts of a step, times the lanes that are followed in each: a tenth of a second, in
/// which nobody asks whether the run goes on.
const MOST: usize = 1 << 24;

/// [`Track::walk_through_step`], out of line.
pub(super) struct TrackWalk<'a> {
    pub(super) track: &'a mut Track,
    pub(super) scene: Scene<'a>,
    pub(super) ends: (&'a Point, &'a Point),
}

impl Task for TrackWalk<'_> {
    type Output = ();

    #[inline(always)]
    fn run<A: Arith>(self) {
        let Self { track, scene, ends } = self;
        let mut from = std::mem::take(&mut track.from);
        let mut to = std::mem::take(&mut track.to);
        track.walk_through_step::<A>(scene, (&mut from, &mut to), ends);
        (track.from, track.to) = (from, to);
    }
}

impl Track {
    /// Walks through a step over which some lanes turn far: parts on which
    /// their envelopes rule everything out, and parts short enough to follow
    /// every lane that matters.
    #[inline(always)]
    fn walk_through_step<A: Arith>(
        &mut self,
        scene: Scene,
        (from, to): (&mut Amplitudes, &mut Amplitudes),
        (a, b): (&Point, &Point),
    ) {
        if self.lost {
            return;
        }
        let mut parts = MOST / scene.lanes().max(1);
        if self.before.s == a.s {
            from.copy_from(&self.before);
        } else {
            self.evaluate::<A>(scene, a.s, from);
        }
        let mut last = *a;
        let mut length = b.s - from.s;
        // Parts as short as the last before a longer one is tried again.
        let mut patience = 0;
        loop {
            let next = (from.s + length).min(b.s);
            parts = parts.saturating_sub(1);
            self.walked += scene.lanes() as u64;
            // (Parts may be too short for the clock to go on.)
            if parts == 0 || next <= from.s && from.s < b.s {
                self.lost = true;
                return;
            }
            let end = if next == self.now.s {
                to.copy_from(&self.now);
                *b
            } else {
                self.evaluate::<A>(scene, next, to);
                self.state
                    .point::<A>(scene.panel, scene.phase.active, to, &self.e)
            };
            let h = to.s - from.s;
            let follow = scene.followed_lanes(h);
            if follow == scene.lanes() {
                let ahead = LanesAhead::Followed(last.fourth);
                self.span::<A>(scene, ahead, &last, &end);
            } else if !self.ruled_out::<A>(scene, (from, to), &[last, end], follow) {
                let short = self.fastest_lane_length(scene, from);
                // Where the lanes that matter would bear a longer part (none is
                // left, in the end) only the slow motion sets new records.
                patience = if short > GROWTH * h { 0 } else { PATIENCE };
                if h > 1.01 * short {
                    length = short.max(0.25 * h);
                    continue;
                }
                self.span::<A>(scene, LanesAhead::Mixed(from), &last, &end);
            }
            // Most often the rest of a long step has nothing more to show.
            if end.s >= b.s || self.rules_out::<A>(end.s, b.s, end.envelope) {
                return;
            }
            last = end;
            std::mem::swap(from, to);
            let growth = if patience > 0 { 1.0 } else { GROWTH };
            patience = i32::max(patience - 1, 0);
            length = (growth * h).min(b.s - from.s);
        }
    }

    /// The lanes at a local time, at which the exponentials then stand.
    #[inline(always)]
    fn evaluate<A: Arith>(&mut self, scene: Scene, s: f64, out: &mut Amplitudes) {
        scene.phase.exponentials::<A>(scene.basis, s, &mut self.e);
        self.state.amplitudes::<A>(scene.phase, &self.e, out);
    }

    /// Length over which the fastest lane that matters can be followed.
    #[inline(always)]
    fn fastest_lane_length(&self, scene: Scene, from: &Amplitudes) -> f64 {
        let level = self.high.map(f64::abs).max(self.low.map(f64::abs));
        let live = (0..scene.lanes()).rev().find(|&k| {
            let size = self.state.lane_size(scene.panel, from, k);
            (0..4).any(|f| size.0[f] > 1e-9 * level.0[f] && size.0[f] > 0.0)
        });
        live.map_or(f64::INFINITY, |k| 0.7 * FOLLOW / scene.basis.modulus[k])
    }

    /// True when between `from` and `to` nothing can pass the greatest values
    /// and δ keeps its sign, whatever the lanes from `follow` on do within
    /// their envelopes.
    #[inline(always)]
    fn ruled_out<A: Arith>(
        &self,
        scene: Scene,
        (from, to): (&Amplitudes, &Amplitudes),
        ends: &[Point; 2],
        follow: usize,
    ) -> bool {
        let Scene { basis, panel, .. } = scene;
        let [mut a, mut b] = *ends;
        let mut loss =
            self.state
                .interpolation_error::<A>(basis, panel, (Some(from), follow), b.s - a.s);
        for k in follow..scene.lanes() {
            loss.flat = loss.flat + self.state.lane_size(panel, from, k);
            for (point, lanes) in [(&mut a, from), (&mut b, to)] {
                let [value, slope] = self.state.value_and_slope_of_lane::<A>(panel, lanes, k);
                point.value = point.value - value;
                point.slope = point.slope - slope;
            }
        }
        self.is_calm_within(&enclose::<A>(&a, &b, &loss))
    }
}
