//! What happens in a driving pair: openings, closings, approach.

use super::{ImpactFigures, Interval, PairFigures, SwitchRow};
use crate::dynamics::integrate::Impact;

/// Follows one pair that can open through a run.
#[derive(Clone, Debug)]
pub(crate) struct PairTracker {
    /// Index of the object.
    pub(crate) object: usize,
    /// Component of the modes: 0 open, −1 on the lower flank, +1 on the upper.
    pub(crate) component: usize,
    /// True of a stop: that it is open is no separation.
    pub(crate) is_stop: bool,
    /// True: its switches are listed, not only counted.
    pub(crate) is_listed: bool,
    /// Components of the modes of the object's stops.
    stops: Vec<usize>,
    figures: PairFigures,
    open_since: Option<f64>,
    start: f64,
}

/// Greatest speed of approach (m/s, rad/s) of what begins at rest on its flank: rounding.
const LAID: f64 = 1e-9;

impl PairTracker {
    /// A pair of an object whose mode is `components[component]`; `stops`: components of
    /// the modes of the object's stops.
    pub(crate) fn new(object: usize, component: usize, stops: Vec<usize>) -> Self {
        Self {
            object,
            component,
            is_stop: false,
            is_listed: true,
            stops,
            figures: PairFigures::default(),
            open_since: None,
            start: 0.0,
        }
    }

    /// The same of a rigid contact, which is struck.
    pub(crate) fn rigid(mut self) -> Self {
        self.figures.impacts = Some(ImpactFigures::default());
        self
    }

    /// The state just after the start; taking it is no switch.
    pub(crate) fn start(&mut self, time: f64, modes: &[i64]) {
        let open = modes[self.component] == 0 && !self.is_held(modes);
        self.open_since = open.then_some(time);
        self.start = time;
    }

    /// True when one of the object's stops holds it: what rests on a seat has not lost
    /// its driver.
    pub(crate) fn is_held(&self, modes: &[i64]) -> bool {
        self.stops.iter().any(|&stop| modes[stop] != 0)
    }

    /// The object comes to one of its stops: from there on its pair is not lost.
    pub(crate) fn reach_stop(&mut self, id: &str, time: f64, intervals: &mut Vec<Interval>) {
        self.close_interval(id, time, intervals);
    }

    /// An impact of a rigid contact at `time`, after which it is open or rests.
    pub(crate) fn add_impact(
        &mut self,
        (id, time): (&str, f64),
        impact: &Impact,
        rows: &mut Vec<SwitchRow>,
        intervals: &mut Vec<Interval>,
    ) {
        // What is laid on its flank at the start is not struck.
        if time > self.start || impact.approach > LAID {
            self.figures.impacts.get_or_insert_default().add(impact);
        }
        let approach = &mut self.figures.max_approach_speed;
        *approach = approach.max(impact.approach);
        if self.is_listed {
            rows.push(SwitchRow {
                time,
                object: id.to_owned(),
                what: "impact",
                flank: if impact.side < 0 { "lower" } else { "upper" },
                speed: impact.approach,
            });
        }
        if self.open_since.is_some() && impact.rests.is_none() {
            self.close_interval(id, time, intervals);
            self.open_since = Some(time);
        }
    }

    /// A change of mode at `time`, `held` by a stop of the object or not; `speed` is that of the
    /// deformation then. Rows and closed intervals are added to the record.
    pub(crate) fn switch(
        &mut self,
        (id, time): (&str, f64),
        (before, after, held): (i64, i64, bool),
        speed: f64,
        rows: &mut Vec<SwitchRow>,
        intervals: &mut Vec<Interval>,
    ) {
        // Speed into the flank: −v on the lower, +v on the upper.
        let speed_into = |flank: i64| flank as f64 * speed;
        let listed = self.is_listed;
        let mut row = |what, flank: i64, speed: f64| {
            if !listed {
                return;
            }
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
            if !held {
                self.figures.separations += 1;
                self.open_since = Some(time);
            }
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

    #[test]
    fn openings_and_closings_are_counted_and_timed() {
        let mut tracker = PairTracker::new(0, 0, Vec::new());
        let (mut rows, mut intervals) = (Vec::new(), Vec::new());
        tracker.start(0.0, &[0]);
        let mut at = |time, (before, after), speed| {
            tracker.switch(
                ("rocker", time),
                (before, after, false),
                speed,
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
    fn what_a_stop_holds_is_not_separated() {
        let mut tracker = PairTracker::new(0, 0, vec![1]);
        let (mut rows, mut intervals) = (Vec::new(), Vec::new());
        tracker.start(0.0, &[0, -1]);
        let mut at = |time, modes| {
            tracker.switch(("v", time), modes, 1.0, &mut rows, &mut intervals);
        };
        at(0.25, (0, -1, true));
        at(0.5, (-1, 0, true));
        at(0.75, (0, -1, false));
        at(1.0, (-1, 0, false));
        tracker.reach_stop("v", 1.5, &mut intervals);
        let figures = tracker.finish("v", 2.0, &mut intervals);
        assert_eq!((figures.separations, figures.closures), (1, 2));
        assert_eq!(figures.separated_time, 0.5);
        assert_eq!((intervals.len(), intervals[0].to), (1, 1.5));
    }

    #[test]
    fn the_upper_flank_is_approached_upwards() {
        let mut tracker = PairTracker::new(0, 0, Vec::new());
        let (mut rows, mut intervals) = (Vec::new(), Vec::new());
        tracker.start(0.0, &[0]);
        tracker.switch(("p", 1.0), (0, 1, false), 4.0, &mut rows, &mut intervals);
        // Straight over to the other flank (no gap): an opening and a closing at once.
        tracker.switch(("p", 2.0), (1, -1, false), -5.0, &mut rows, &mut intervals);
        let figures = tracker.finish("p", 3.0, &mut intervals);
        assert_eq!((figures.separations, figures.closures), (1, 2));
        assert_eq!(figures.max_approach_speed, 5.0);
        assert_eq!(figures.separated_time, 1.0);
        assert_eq!(rows[0].flank, "upper");
        assert_eq!(intervals.len(), 1);
    }
}
