//! Where everything is after solving: poses, transfer functions, points, pairs.

use super::elements::{elements, slides};
use super::spec::{OutputKind, PairSpec, PointOf};
use super::state::State;
use super::vector::Vector;
use super::vector::nearest_turn;
use super::{Core, Linkage};
use crate::math::jet::Jet;
use crate::math::series::Series;
use std::sync::Arc;

/// All memory that solving needs, and what was solved last.
#[derive(Clone, Debug)]
pub struct Workspace {
    core: Arc<Core>,
    pub(super) state: State,
    input: f64,
    reduced: f64,
    turns: f64,
    order: usize,
}

/// The frame of a link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// x of its origin (m).
    pub x: f64,
    /// y of its origin (m).
    pub y: f64,
    /// cos θ.
    pub cos: f64,
    /// sin θ.
    pub sin: f64,
}

impl Pose {
    /// A point given in this frame (m).
    pub fn to_ground(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [
            self.x + self.cos * x - self.sin * y,
            self.y + self.sin * x + self.cos * y,
        ]
    }
}

impl Workspace {
    pub(super) fn new(core: Arc<Core>) -> Self {
        Self {
            state: core.plan.state(),
            input: f64::NAN,
            reduced: f64::NAN,
            turns: 0.0,
            order: 0,
            core,
        }
    }

    #[inline]
    pub(super) fn at(&mut self, input: f64, reduced: f64, turns: f64, order: usize) {
        (self.input, self.reduced, self.turns, self.order) = (input, reduced, turns, order);
    }

    /// The input solved for last (rad or m); not a number before the first time.
    pub fn input(&self) -> f64 {
        self.input
    }

    /// The order solved to last; derivatives above it are zero or old.
    pub fn order(&self) -> usize {
        self.order
    }

    /// The frame of a link.
    #[inline]
    pub fn pose(&self, link: usize) -> Pose {
        let motion = &self.state.links[link];
        Pose {
            x: motion.at[0][0],
            y: motion.at[1][0],
            cos: motion.direction[0][0],
            sin: motion.direction[1][0],
        }
    }

    /// The `k`-th derivative of (x, y, θ) of a link's frame by the input
    /// coordinate, k = 1, 2, 3; zeros above the order solved to.
    ///
    /// # Panics
    /// `k` is not 1, 2 or 3.
    #[inline]
    pub fn transfer(&self, link: usize, k: usize) -> [f64; 3] {
        const FACTORIAL: [f64; 4] = [1.0, 1.0, 2.0, 6.0];
        assert!(
            (1..=3).contains(&k),
            "transfer functions are of order 1 to 3"
        );
        if k > self.order {
            return [0.0; 3];
        }
        let motion = &self.state.links[link];
        let [x, y] = [motion.at[0][k], motion.at[1][k]].map(|c| c * FACTORIAL[k]);
        [x, y, motion.turning()[k - 1]]
    }

    /// The angle of a link's frame (rad), continuous over any number of turns.
    ///
    /// At the start it lies in (−π, π], that of a link driven from the ground
    /// and the angle of the driver's pair being equal to the input there.
    pub fn angle(&self, link: usize) -> f64 {
        let course = &self.core.course;
        let place = course.table.index_before(self.reduced);
        let near = course.table.pose_near(place, link, self.reduced)[2];
        let gain = course.table.gains.get(link).copied().unwrap_or(0.0);
        nearest_turn(self.state.links[link].angle(), near + self.turns * gain)
    }

    /// The angle of a link with its derivatives.
    pub fn turning(&self, link: usize) -> Jet {
        let turning = |k: usize| self.transfer(link, k)[2];
        Jet {
            value: self.angle(link),
            first: turning(1),
            second: turning(2),
            third: turning(3),
        }
    }

    /// A point, seen from the ground (m), with its derivatives.
    #[inline]
    pub fn point(&self, point: PointOf) -> [Jet; 2] {
        let place = self.state.frame::<4>(point.link).place(point.at);
        [self.jet(place.x), self.jet(place.y)]
    }

    /// The relative coordinate of a pair (rad or m) with its derivatives.
    pub fn pair(&self, pair: usize) -> Jet {
        let pair = &self.core.spec.pairs[pair];
        if slides(pair) {
            let [i, j] = elements(pair);
            let frame = self.state.frame::<4>(i.link);
            let apart = self.state.frame::<4>(j.link).place(j.point) - frame.place(i.point);
            return self.jet(frame.direction.turn_constant(i.along).dot(apart));
        }
        let [i, j] = [pair.on.link, pair.link.link]
            .map(|link| link.map_or(Jet::default(), |link| self.turning(link)));
        Jet {
            value: j.value - i.value,
            first: j.first - i.first,
            second: j.second - i.second,
            third: j.third - i.third,
        }
    }

    /// Value and derivatives up to the order solved to.
    #[inline]
    pub(super) fn jet(&self, series: Series<4>) -> Jet {
        let mut known = series;
        known.0[self.order + 1..].fill(0.0);
        known.jet()
    }

    /// A vector with its derivatives up to the order solved to.
    #[inline]
    pub(super) fn frame(&self, link: Option<usize>) -> (Vector<4>, Vector<4>) {
        let frame = self.state.frame::<4>(link);
        (frame.at, frame.direction)
    }

    /// A pair as it was given.
    #[inline]
    pub(super) fn pair_spec(&self, pair: usize) -> &PairSpec {
        &self.core.spec.pairs[pair]
    }

    #[cfg(test)]
    pub(super) fn core(&self) -> &Core {
        &self.core
    }
}

impl Linkage {
    /// An output at the position solved for, with its derivatives: the
    /// position function U, U′, U″, U‴ of what hangs behind it.
    pub fn output(&self, index: usize, workspace: &Workspace) -> Jet {
        match self.spec().outputs[index].kind {
            OutputKind::Angle { link } => workspace.turning(link),
            OutputKind::Pair { pair } => workspace.pair(pair),
            OutputKind::Point { point, direction } => {
                let (sin, cos) = direction.sin_cos();
                let [x, y] = workspace.point(point);
                Jet {
                    value: cos * x.value + sin * y.value,
                    first: cos * x.first + sin * y.first,
                    second: cos * x.second + sin * y.second,
                    third: cos * x.third + sin * y.third,
                }
            }
        }
    }
}
