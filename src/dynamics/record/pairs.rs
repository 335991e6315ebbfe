//! What happens in a driving pair: openings, closings, approach.

use super::{Interval, PairFigures, SwitchRow};
use crate::dynamics::system::ObjectState;

/// Follows one pair that can open through a run.
#[derive(Clone, Debug)]
pub(crate) struct PairTracker {
    /// Index of the object.
    pub(crate) object: usize,
    /// Component of the modes: 0 open, −1 on the lower flank, +1 on the upper.
    pub(crate) component: usize,
    figures: PairFigures,
    open_since: Option<f64>,
}

impl PairTracker {
    /// A pair of an object whose mode is `components[component]`.
    pub(crate) fn new(object: usize, component: usize) -> Self {
        Self {
            object,
            component,
            figures: PairFigures::default(),
            open_since: None,
        }
    }

    /// The state just after the start; taking it is no switch.
    pub(crate) fn start(&mut self, time: f64, mode: i64) {
        self.open_since = (mode == 0).then_some(time);
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

#[cfg(test)]
mod tests {
    use super::PairTracker;
    use crate::dynamics::system::ObjectState;

    fn moving(deformation_speed: f64) -> ObjectState {
        ObjectState {
            deformation_speed,
            ..ObjectState::default()
        }
    }

    #[test]
    fn openings_and_closings_are_counted_and_timed() {
        let mut tracker = PairTracker::new(0, 0);
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
        let mut tracker = PairTracker::new(0, 0);
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
