//! Looking back at the steps of a phase: what is bounded, and what happens in them.

use super::lanes_ahead::LanesAhead;
use super::refine::{Climb, Turns};
use super::walk::TrackWalk;
use super::{Scene, Track};
use crate::exact::hermite::{Loss, Point, enclose};
use crate::exact::lanes::{Arith, Task, V};

/// [`Track::process_noted_steps`], out of line.
pub(crate) struct LookBack<'a> {
    pub(crate) track: &'a mut Track,
    pub(crate) scene: Scene<'a>,
}

impl Task for LookBack<'_> {
    type Output = ();

    #[inline(always)]
    fn run<A: Arith>(self) {
        self.track.process_noted_steps::<A>(self.scene);
    }
}

impl Track {
    /// Takes the steps that were seen into the figures.
    #[inline(always)]
    fn process_noted_steps<A: Arith>(&mut self, scene: Scene) {
        for number in 0..self.steps.len() {
            let [a, b] = self.steps[number];
            self.process_step::<A>(scene, &a, &b);
        }
        self.steps.clear();
    }

    /// Takes a step into the figures.
    #[inline(always)]
    pub(super) fn process_step<A: Arith>(&mut self, scene: Scene, a: &Point, b: &Point) {
        if scene.followed_lanes(b.s - a.s) == scene.lanes() {
            self.span::<A>(scene, LanesAhead::Followed(a.fourth), a, b);
        } else if !self.nothing_happens_between::<A>(scene, a, b) {
            A::run_out_of_line(TrackWalk {
                track: self,
                scene,
                ends: (a, b),
            });
        }
    }

    /// True when nothing happens between two points, of lanes of their sizes at
    /// the first one, or at the start of the phase: the fast ones are most often
    /// small.
    #[inline(always)]
    fn nothing_happens_between<A: Arith>(&self, scene: Scene, a: &Point, b: &Point) -> bool {
        let start = (self.before.s == a.s).then_some(&self.before);
        let lanes = (start, scene.lanes());
        let loss = self
            .state
            .interpolation_error::<A>(scene.basis, scene.panel, lanes, b.s - a.s);
        let bounds = enclose::<A>(a, b, &loss);
        self.is_calm_within(&self.narrowed::<A>(bounds, a, b.s))
    }

    /// What Hermite's cubic may miss over a length h.
    #[inline(always)]
    fn interpolation_error<A: Arith>(&self, scene: Scene, ahead: LanesAhead, h: f64) -> Loss {
        match ahead {
            LanesAhead::Followed(fourth) => {
                let square = h * h;
                Loss {
                    middle: fourth * V::splat(square * square * (1.0 / 144.0)),
                    flat: V::ZERO,
                }
            }
            LanesAhead::Mixed(from) => {
                let lanes = (Some(from), scene.lanes());
                self.state
                    .interpolation_error::<A>(scene.basis, scene.panel, lanes, h)
            }
        }
    }

    /// The same for one functional: on the middle coefficient, and on all.
    #[inline(always)]
    pub(super) fn loss_of<A: Arith>(
        &self,
        scene: Scene,
        ahead: LanesAhead,
        h: f64,
        k: usize,
    ) -> (f64, f64) {
        match ahead {
            LanesAhead::Followed(fourth) => {
                let square = h * h;
                (fourth.0[k] * (square * square * (1.0 / 144.0)), 0.0)
            }
            LanesAhead::Mixed(from) => {
                let lanes = (from, scene.phase.active);
                self.state
                    .loss_of::<A>(scene.basis, scene.panel, lanes, h, k)
            }
        }
    }

    /// Takes the part between two points.
    #[inline(always)]
    pub(super) fn span<A: Arith>(&mut self, scene: Scene, ahead: LanesAhead, a: &Point, b: &Point) {
        let loss = self.interpolation_error::<A>(scene, ahead, b.s - a.s);
        let bounds = enclose::<A>(a, b, &loss);
        let beyond = (bounds.high - self.high).max(self.low - bounds.low);
        if beyond.greatest() <= 0.0 && !self.may_turn(&bounds) {
            return;
        }
        let bounds = self.narrowed::<A>(bounds, a, b.s);
        let over = bounds.high - self.high;
        let under = self.low - bounds.low;
        // Differences below rounding are not worth a climb.
        let margin = self.margin();
        let beyond = over.max(under) - margin;
        if beyond.greatest() > 0.0 {
            let noise = self.state.noise(b.s, self.whole);
            for k in 0..4 {
                let margin = margin.0[k].max(noise.0[k]);
                for (beyond, sign) in [(over.0[k], 1.0), (under.0[k], -1.0)] {
                    if beyond > margin {
                        A::run_out_of_line(Climb {
                            track: self,
                            scene,
                            ahead,
                            ends: (a, b),
                            figure: (k, sign),
                            margin,
                        });
                    }
                }
            }
        }
        if self.may_turn(&bounds) {
            A::run_out_of_line(Turns {
                track: self,
                scene,
                ahead,
                ends: (a, b),
            });
        }
    }
}
