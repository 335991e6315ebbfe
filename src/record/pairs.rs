//! What happens in a driving pair: openings, closings, lift, approach.

use super::subdivision::{maximum, minimum};
use super::{Interval, PairFigures, SwitchRow};
use crate::model::{Closure, Pair};
use crate::polynomial::{MAX_DEGREE, first_positive};
use crate::system::ObjectState;

/// Follows one pair that can open through a run.
#[derive(Clone, Debug)]
pub(crate) struct PairTracker {
    /// Index of the object.
    pub(crate) object: usize,
    /// Component of the modes: 0 open, −1 on the lower flank, +1 on the upper.
    pub(crate) component: usize,
    /// Coordinate x of link 1.
    coordinate: usize,
    pair: Pair,
    figures: PairFigures,
    open_since: Option<f64>,
}

impl PairTracker {
    /// A pair whose mode is `components[component]` and whose x is `coordinate`.
    pub(crate) fn new(object: usize, component: usize, coordinate: usize, pair: Pair) -> Self {
        Self {
            object,
            component,
            coordinate,
            pair,
            figures: PairFigures::default(),
            open_since: None,
        }
    }

    /// The state just after the start; taking it is no switch.
    pub(crate) fn start(&mut self, time: f64, mode: i64) {
        self.open_since = (mode == 0).then_some(time);
    }

    /// The coordinate whose polynomial [`Self::step`] wants.
    pub(crate) fn coordinate(&self) -> usize {
        self.coordinate
    }

    /// A step over which the pair had `mode`; `x` are the Bernstein
    /// coefficients of x, valid up to `end`.
    pub(crate) fn step(&mut self, mode: i64, x: &[f64], end: f64) {
        if mode == 0 {
            let lift = &mut self.figures.max_lift;
            *lift = greatest_clearance(&self.pair, x, end, *lift);
        }
    }

    /// Where in an open step x leaves the flank that it still penetrates: the
    /// power lost there has a kink. (A pair opens inside its flank when damping
    /// takes the force to zero first.)
    pub(crate) fn leaves_flank(&self, mode: i64, x: &[f64], end: f64) -> Option<f64> {
        if mode != 0 {
            return None;
        }
        // Clearance of a flank: sign·x + offset, negative inside.
        let flanks: &[(f64, f64)] = match self.pair.closure {
            Closure::Bilateral => &[],
            Closure::Force => &[(self.pair.opens, 0.0)],
            Closure::Form => &[(1.0, 0.5 * self.pair.gap), (-1.0, 0.5 * self.pair.gap)],
        };
        flanks.iter().find_map(|&(sign, offset)| {
            let mut clearance = [0.0; MAX_DEGREE + 1];
            for (value, x) in clearance.iter_mut().zip(x) {
                *value = sign * x + offset;
            }
            if clearance[0] >= 0.0 {
                return None;
            }
            first_positive(&clearance[..x.len()]).filter(|&s| 0.0 < s && s < end)
        })
    }

    /// A change of mode at `time`; `state` is the object's state then. Rows and
    /// closed intervals are added to the record.
    pub(crate) fn switch(
        &mut self,
        (id, time): (&str, f64),
        (before, after): (i64, i64),
        state: &ObjectState,
        rows: &mut Vec<SwitchRow>,
        intervals: &mut Vec<Interval>,
    ) {
        // Speed into the flank: −v on the lower, +v on the upper.
        let speed_into = |flank: i64| flank as f64 * state.deformation_speed;
        let mut row = |what, flank: i64, speed: f64| {
            rows.push(SwitchRow {
                time,
                object: id.to_owned(),
                what,
                flank: if flank < 0 { "lower" } else { "upper" },
                speed: speed.max(0.0),
            });
        };
        self.figures.switch_times.push(time);
        if before != 0 {
            self.figures.separations += 1;
            self.open_since = Some(time);
            row("opens", before, -speed_into(before));
        }
        if after != 0 {
            self.figures.closures += 1;
            row("closes", after, speed_into(after));
            let approach = &mut self.figures.max_approach_speed;
            *approach = approach.max(speed_into(after));
            self.close_interval(id, time, intervals);
        }
    }

    /// The end of the run.
    pub(crate) fn finish(
        mut self,
        id: &str,
        time: f64,
        intervals: &mut Vec<Interval>,
    ) -> PairFigures {
        self.close_interval(id, time, intervals);
        self.figures
    }

    fn close_interval(&mut self, id: &str, time: f64, intervals: &mut Vec<Interval>) {
        let Some(from) = self.open_since.take() else {
            return;
        };
        let open = time - from;
        self.figures.separated_time += open;
        self.figures.longest_separation = self.figures.longest_separation.max(open);
        if open > 0.0 {
            intervals.push(Interval {
                object: id.to_owned(),
                from,
                to: time,
            });
        }
    }
}

/// Greatest distance of x from the nearest flank on [0, `end`], or `floor` if
/// that is greater.
fn greatest_clearance(pair: &Pair, x: &[f64], end: f64, floor: f64) -> f64 {
    match pair.closure {
        Closure::Bilateral => floor,
        Closure::Force if pair.opens >= 0.0 => maximum(x, end, floor),
        Closure::Force => -minimum(x, end, -floor),
        // η/2 − |x| is greatest where |x| is least.
        Closure::Form => {
            let (least, most) = (minimum(x, end, f64::MAX), maximum(x, end, f64::MIN));
            let nearest = least.max(-most).max(0.0);
            floor.max(0.5 * pair.gap - nearest)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{PairTracker, greatest_clearance};
    use crate::model::{Closure, DampingLaw, Pair};
    use crate::system::ObjectState;

    fn pair(closure: Closure, gap: f64, opens: f64) -> Pair {
        Pair {
            closure,
            gap,
            opens,
            law: DampingLaw::KelvinVoigt,
        }
    }

    fn moving(deformation_speed: f64) -> ObjectState {
        ObjectState {
            deformation_speed,
            ..ObjectState::default()
        }
    }

    #[test]
    fn clearance_is_the_distance_to_the_nearest_flank() {
        let up = [0.0, 0.5, 1.0]; // x = s
        let force = |opens| greatest_clearance(&pair(Closure::Force, 0.0, opens), &up, 1.0, 0.0);
        assert_eq!((force(1.0), force(-1.0)), (1.0, 0.0));
        let form = pair(Closure::Form, 3.0, 1.0);
        assert_eq!(greatest_clearance(&form, &up, 1.0, 0.0), 1.5);
        assert_eq!(
            greatest_clearance(&form, &[-1.0, -0.75, -0.5], 1.0, 0.0),
            1.0
        );
        assert_eq!(greatest_clearance(&form, &[0.5, 0.75, 1.0], 1.0, 0.0), 1.0);
        assert_eq!(greatest_clearance(&form, &[-1.0, 0.0, 1.0], 1.0, 0.0), 1.5);
    }

    #[test]
    fn an_open_pair_leaves_its_flank_where_x_crosses_it() {
        let tracker = |pair| PairTracker::new(0, 0, 0, pair);
        let up = [-0.25, 0.25, 0.75]; // x = s − 1/4
        let force = tracker(pair(Closure::Force, 0.0, 1.0));
        assert_eq!(force.leaves_flank(0, &up, 1.0), Some(0.25));
        assert_eq!(force.leaves_flank(0, &up, 0.2), None);
        assert_eq!(force.leaves_flank(-1, &up, 1.0), None);
        let turned = tracker(pair(Closure::Force, 0.0, -1.0));
        assert_eq!(turned.leaves_flank(0, &up, 1.0), None);
        let down = [1.25, 0.75, 0.25]; // x = 5/4 − s, upper flank at 1
        let form = tracker(pair(Closure::Form, 2.0, 1.0));
        assert_eq!(form.leaves_flank(0, &down, 1.0), Some(0.25));
    }

    #[test]
    fn openings_and_closings_are_counted_and_timed() {
        let mut tracker = PairTracker::new(0, 0, 0, pair(Closure::Force, 0.0, 1.0));
        let (mut rows, mut intervals) = (Vec::new(), Vec::new());
        tracker.start(0.0, 0);
        let mut at = |time, modes, speed| {
            tracker.switch(
                ("rocker", time),
                modes,
                &moving(speed),
                &mut rows,
                &mut intervals,
            );
        };
        at(0.25, (0, -1), -2.0);
        at(0.5, (-1, 0), 3.0);
        at(0.75, (0, -1), 0.5); // presses again while still receding: no approach
        at(1.5, (-1, 0), 1.0);
        let figures = tracker.finish("rocker", 2.0, &mut intervals);
        assert_eq!((figures.separations, figures.closures), (2, 2));
        assert_eq!(figures.switch_times, [0.25, 0.5, 0.75, 1.5]);
        assert_eq!(
            (figures.separated_time, figures.longest_separation),
            (1.0, 0.5)
        );
        assert_eq!(figures.max_approach_speed, 2.0);
        let speeds: Vec<f64> = rows.iter().map(|row| row.speed).collect();
        assert_eq!(speeds, [2.0, 3.0, 0.0, 1.0]);
        let open: Vec<_> = intervals.iter().map(|i| (i.from, i.to)).collect();
        assert_eq!(open, [(0.0, 0.25), (0.5, 0.75), (1.5, 2.0)]);
    }

    #[test]
    fn the_upper_flank_is_approached_upwards() {
        let mut tracker = PairTracker::new(0, 0, 0, pair(Closure::Form, 0.1, 1.0));
        let (mut rows, mut intervals) = (Vec::new(), Vec::new());
        tracker.start(0.0, 0);
        tracker.switch(("p", 1.0), (0, 1), &moving(4.0), &mut rows, &mut intervals);
        // Straight over to the other flank (no gap): an opening and a closing at once.
        tracker.switch(
            ("p", 2.0),
            (1, -1),
            &moving(-5.0),
            &mut rows,
            &mut intervals,
        );
        let figures = tracker.finish("p", 3.0, &mut intervals);
        assert_eq!((figures.separations, figures.closures), (1, 2));
        assert_eq!(figures.max_approach_speed, 5.0);
        assert_eq!(figures.separated_time, 1.0);
        assert_eq!(rows[0].flank, "upper");
        assert_eq!(intervals.len(), 1);
    }
}
