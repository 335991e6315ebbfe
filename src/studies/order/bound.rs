//! A bound of what a reduction to modes leaves out, where the motion of the driven end is
//! prescribed: the deviation of a linear object is that of its modes, of which those that
//! are left out are bounded by the motion alone ([`LeftOut`]).

use crate::dynamics::builder::FREE_FALL;
use crate::dynamics::builder::left_out::{Excitation, LeftOut};
use crate::dynamics::builder::spec::{ChainSpec, Level, LoadLawSpec};
use crate::dynamics::model::{Closure, Model, NodeIndex, Start};
use crate::dynamics::trajectory::Trajectory;
use crate::frontend::scene::TypedScene;
use std::collections::BTreeMap;

/// Figures of an object that change by no more than its displacement does at any time.
const EVER: [&str; 3] = ["delta_abs", "delta_max", "delta_min"];
/// The one that does so at the end.
const AT_END: &str = "final.displacement";
/// Intervals of the first sampling of a motion, and most of them.
const INTERVALS: (usize, usize) = (500, 1 << 18);
/// A sampling is fine enough when twice as many intervals change the sum of the changes of
/// U‴ by no more than this share; so much is added to it.
const FINE: f64 = 0.02;

/// How far the displacement of an object may be off by what its level leaves out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::studies) struct LeftOutOf {
    /// At any time of the run.
    ever: f64,
    /// At its end.
    at_end: f64,
}

/// The motion of a driven end, sampled evenly: what is left out of it is bounded by its
/// third derivative.
#[derive(Clone, Debug)]
pub(super) struct BaseMotion {
    /// Interval between the samples (s).
    interval: f64,
    /// U‴.
    jerks: Vec<f64>,
    /// Ü at the start.
    acceleration: f64,
}

impl BaseMotion {
    /// The motion of a node from 0 to `end`; `None`: it is not prescribed, or too wild to be
    /// sampled.
    fn of(model: &Model, node: NodeIndex, end: f64) -> Option<Self> {
        let trajectory = Trajectory::of(model, node)?;
        let mut coarse: Option<Self> = None;
        let mut intervals = INTERVALS.0;
        while intervals <= INTERVALS.1 {
            let interval = end / intervals as f64;
            let jerk = |i| trajectory.at(interval * i as f64).third;
            let fine = Self {
                interval,
                jerks: (0..=intervals).map(jerk).collect(),
                acceleration: trajectory.at(0.0).second,
            };
            let [changes, _] = fine.changes(0.0);
            if !changes.is_finite() {
                return None;
            }
            let same = |coarse: &Self| changes - coarse.changes(0.0)[0] <= FINE * changes;
            if coarse.as_ref().is_some_and(same) && trajectory.resolved(interval, intervals) {
                return Some(fine);
            }
            (coarse, intervals) = (Some(fine), 2 * intervals);
        }
        None
    }

    /// The sum of the changes of U‴, those of the past faded by exp(−ρt): the greatest, and
    /// that at the end.
    fn changes(&self, fading: f64) -> [f64; 2] {
        let kept = (-fading * self.interval).exp();
        let mut sum = self.jerks[0].abs();
        let mut greatest = sum;
        for pair in self.jerks.windows(2) {
            sum = sum * kept + (pair[1] - pair[0]).abs();
            greatest = greatest.max(sum);
        }
        [greatest, sum]
    }

    /// What the motion and the loads do to the modes of an object that starts so: at its
    /// worst, and at the end.
    fn excites(
        &self,
        left_out: &LeftOut,
        chain: &ChainSpec,
        start: &Start,
    ) -> Option<[Excitation; 2]> {
        let (acceleration, force) = match start {
            Start::Kinetostatic => (0.0, 0.0),
            Start::Static => (self.acceleration.abs(), 0.0),
            Start::OnLaw => {
                let [gravity, force] = constant_loads(chain)?;
                (self.acceleration.abs() + gravity, force)
            }
            Start::Explicit(_) | Start::State(_) => return None,
        };
        let [greatest, last] = self.changes(left_out.fading);
        let worst = Excitation {
            jerk_changes: (1.0 + FINE) * greatest,
            jerk: self
                .jerks
                .iter()
                .fold(0.0, |most, jerk| jerk.abs().max(most)),
            acceleration,
            force,
        };
        let end = self.interval * (self.jerks.len() - 1) as f64;
        let left = left_out.remaining_start_share(end);
        let at_end = Excitation {
            jerk_changes: (1.0 + FINE) * last,
            jerk: self.jerks[self.jerks.len() - 1].abs(),
            acceleration: left * acceleration,
            force: left * force,
        };
        Some([worst, at_end])
    }
}

/// Acceleration by weight and force at the output of constant loads; `None`: there are
/// others.
fn constant_loads(chain: &ChainSpec) -> Option<[f64; 2]> {
    let mut sums = [0.0, 0.0];
    for load in &chain.loads {
        match load.law {
            LoadLawSpec::Weight { inclination } => sums[0] += FREE_FALL * inclination.sin().abs(),
            LoadLawSpec::Constant(constant) => sums[1] += f64::abs(constant),
            _ => return None,
        }
    }
    Some(sums)
}

/// How far the displacement of an object may be off by what its level leaves out, at any
/// time of a run and at its end; `None`: this is not known beforehand. `end`: of the run (s); `motion`: that of its driven end, once
/// sampled.
pub(super) fn truncation_bound(
    (scene, model): (&TypedScene, &Model),
    (id, level): (&str, Level),
    end: f64,
    motion: &mut Option<Option<BaseMotion>>,
) -> Option<LeftOutOf> {
    let Level::Modes { count } = level else {
        return None;
    };
    let object = model.objects.iter().position(|object| object.id == id)?;
    // Where a coordinate of its own stands for the rest, other objects have a say in it.
    if model.reduction_of(object)?.under_acceleration == 0.0 {
        return None;
    }
    let part = &model.objects[object];
    let pair = model.pair(part)?;
    if pair.closure != Closure::Bilateral {
        return None;
    }
    let node = part.driven_end?;
    let sampled = || BaseMotion::of(model, node, end);
    let motion = motion.get_or_insert_with(sampled).as_ref()?;
    let chain = scene.objects.get(id)?.object.chain()?;
    let left_out = LeftOut::of(&chain.body.uniform()?.0, count)?;
    let excitations = motion.excites(&left_out, chain, &model.start)?;
    let [ever, at_end] = excitations.map(|by| left_out.deviation(&by));
    (ever.is_finite() && at_end.is_finite()).then_some(LeftOutOf { ever, at_end })
}

/// The bound of a figure that changes by no more than the displacement of its object does.
pub(super) fn of_figure(bounds: &BTreeMap<String, LeftOutOf>, figure: &str) -> Option<f64> {
    let object = |name: &str| figure.strip_suffix(name)?.strip_suffix('.');
    let ever = EVER.iter().find_map(|name| object(name));
    let ever = ever.and_then(|id| Some(bounds.get(id)?.ever));
    ever.or_else(|| Some(bounds.get(object(AT_END)?)?.at_end))
}
