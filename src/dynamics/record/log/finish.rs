//! The end of a record: figures, pairs and switches of what was heard.

use super::super::failure::Failure;
use super::super::joints::JointTracker;
use super::super::rows::SystemView;
use super::super::tally::Tally;
use super::super::{ObjectFigures, PairFigures, Record, RunRecord, StopFigures};
use super::Log;
use crate::dynamics::energy::EnergyAudit;
use crate::dynamics::system::ObjectState;

impl Log<'_> {
    /// Ends the recording of a run that got to `time`: closes open intervals and works
    /// out the figures of what was gathered, a tally an object.
    pub(crate) fn finish(
        mut self,
        time: f64,
        tallies: &[Tally],
        joints: Vec<JointTracker>,
        audit: EnergyAudit,
    ) -> RunRecord {
        self.time = time;
        let last: Vec<ObjectState> = tallies.iter().map(|tally| *tally.last()).collect();
        let seen = SystemView {
            states: &last,
            masses: &self.masses,
        };
        self.rows.finish(time, seen);
        let duration = time - self.start;
        let figures = tallies.iter().map(|tally| tally.figures(duration));
        let mut figures: Vec<ObjectFigures> = figures.collect();
        for tracker in std::mem::take(&mut self.pairs) {
            let object = tracker.object;
            let model = self.observer.system().model();
            let id = &model.objects[object].id;
            if model.stop(object).is_some() {
                let pair = tracker.finish(id, time, &mut Vec::new());
                figures[object].stop = Some(StopFigures {
                    closures: pair.closures,
                    contact_time: (duration - pair.separated_time).max(0.0),
                    max_approach_speed: pair.max_approach_speed,
                    max_contact_force: tallies[object].contact_force(),
                    max_indentation: tallies[object].indentation().unwrap_or(0.0),
                    impacts: pair.impacts,
                    switch_times: pair.switch_times,
                });
                continue;
            }
            let mut pair = tracker.finish(id, time, &mut self.separations);
            pair.max_lift = tallies[object].lift();
            pair.max_contact_force = tallies[object].contact_force();
            pair.max_indentation = tallies[object].indentation();
            pair.in_working_order = self.window().map(|[from, to]| {
                !self
                    .separations
                    .iter()
                    .any(|open| open.object == *id && open.from < to && open.to > from)
            });
            figures[object].pair = Some(pair);
        }
        for joints in joints {
            let object = joints.object;
            let own = joints.finish(time);
            let before = figures[object].joints.take();
            figures[object].joints = Some(before.map_or(own, |before| before.followed_by(own)));
        }
        for (time, values) in std::mem::take(&mut self.peaks) {
            if tallies
                .iter()
                .any(|tally| tally.times().any(|own| own == time))
            {
                self.rows.push_closeup(time, &values);
            }
        }
        let confirmed = self.confirmed(tallies);
        let margins = self.margins(tallies, &mut figures);
        self.separations.sort_by(|a, b| {
            a.from
                .total_cmp(&b.from)
                .then_with(|| a.object.cmp(&b.object))
        });
        if !audit.error().is_finite() {
            let model = self.observer.system().model();
            let found = || Failure::of(model, time, None);
            self.failure.get_or_insert_with(found);
        }
        let (times, columns, closeups) = self.rows.into_columns();
        let first_times = self.watch.finish();
        let spans = self.spans.finish();
        RunRecord {
            record: Record {
                times,
                columns,
                switches: self.switches,
                separations: self.separations,
                closeups,
            },
            figures,
            audit,
            margins,
            confirmed,
            failure: self.failure,
            looks: self.looker.finish(),
            first_times: first_times.times,
            undetermined_times: first_times.undetermined,
            spans,
        }
    }

    fn margins(&self, tallies: &[Tally], figures: &mut [ObjectFigures]) -> Vec<(usize, f64, f64)> {
        let mut margins = Vec::new();
        for (object, tally) in tallies.iter().enumerate() {
            let Some([(margin, time), (in_window, _)]) = tally.margins() else {
                continue;
            };
            figures[object].pair = Some(PairFigures {
                max_contact_force: tally.contact_force(),
                margin: Some(margin),
                in_working_order: self.window().map(|_| in_window >= 0.0),
                ..PairFigures::default()
            });
            margins.push((object, margin, time));
        }
        margins
    }
}
