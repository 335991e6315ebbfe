//! Discrete state: pairs and tracks, what to watch, what a switch does.

use super::System;
use super::frozen::{Frozen, FrozenTrack};
use super::passes::Work;
use crate::dynamics::integrate::{EventFunction, Guard, Impact, Modes, PhysicalStop, Singularity};
use crate::dynamics::model::{Coordinate, NodeMotion};
use crate::kinematics::linkage::{Cause, Reach};
use crate::units::shown;

/// Span of a range that has one end only (rad or m).
const ONE_SIDED_SPAN: f64 = 1.0;

impl Frozen {
    /// All switches to look for in the present modes.
    pub(super) fn event_functions(&self, modes: &[i64], out: &mut Vec<EventFunction>) {
        out.clear();
        for (component, &chain) in self.pairs.iter().enumerate() {
            let chain = &self.chains[chain];
            let x = (chain.first_coordinate, 0.0);
            chain
                .contact
                .event_functions(modes[component], x, component, out);
        }
        for stop in &self.stops {
            stop.event_functions(modes[stop.component], out);
        }
        for (index, track) in self.tracks.iter().enumerate() {
            let Some(signal) = track.signal.filter(|_| !track.stops) else {
                continue;
            };
            let component = self.track_component(index);
            let segment = modes[component];
            let (low, high) = track.breaks.edges(segment);
            for (edge, side) in [(low, -1), (high, 1)] {
                if edge.is_finite() {
                    out.push(leaving(signal, edge, side, component, segment));
                }
            }
        }
        self.watch_directions(modes, out);
    }

    /// The places that the drivers of linkages cannot pass.
    pub(super) fn singularities(&self, modes: &[i64], out: &mut Vec<Singularity>) {
        out.clear();
        for (index, track) in self.tracks.iter().enumerate() {
            let Some(signal) = track.signal.filter(|_| track.stops) else {
                continue;
            };
            let component = self.track_component(index);
            let (low, high) = track.breaks.edges(modes[component]);
            let span = if (high - low).is_finite() {
                high - low
            } else {
                ONE_SIDED_SPAN
            };
            for (place, side) in [(low, -1.0), (high, 1.0)] {
                if place.is_finite() {
                    out.push(Singularity {
                        signal,
                        place,
                        side,
                        span,
                        component,
                    });
                }
            }
        }
    }

    /// The next edge in time of any track over time.
    pub(super) fn next_break(&self, time: f64, modes: &[i64]) -> f64 {
        self.time_tracks()
            .map(|track| {
                let component = self.track_component(track);
                let (_, high) = self.tracks[track].breaks.edges(modes[component]);
                // An edge already behind is passed at once.
                high.max(time)
            })
            .fold(f64::INFINITY, f64::min)
    }

    /// Moves every track over time into the segment that begins at or before `time`.
    pub(super) fn pass_break(&self, time: f64, modes: &mut [i64]) {
        // The integrator lands on an edge up to rounding of its clock.
        let reached = time + 4.0 * f64::EPSILON * time.abs();
        for track in self.time_tracks() {
            let component = self.track_component(track);
            let breaks = &self.tracks[track].breaks;
            while breaks.edges(modes[component]).1 <= reached {
                modes[component] += 1;
            }
        }
        // Loads may have changed at once.
        self.open_sides(modes);
    }

    fn time_tracks(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.tracks.len()).filter(|&track| self.tracks[track].node.is_none())
    }
}

/// The watch on an edge of a segment: the distance to it falls through zero.
fn leaving(signal: usize, edge: f64, side: i64, component: usize, segment: i64) -> EventFunction {
    let guard = Guard {
        signal,
        offset: side as f64 * edge,
        displacement: -(side as f64),
        speed: 0.0,
    };
    EventFunction {
        guards: [guard, guard],
        rising: false,
        component,
        target: segment + side,
    }
}

impl System {
    /// Changes the modes for a switch located at a state.
    ///
    /// # Errors
    /// The friction of joints leaves no motion, or several.
    pub(super) fn pass_switch(
        &self,
        time: f64,
        y: &mut [f64],
        watch: &EventFunction,
        modes: &mut Modes,
    ) -> Result<Option<Impact>, PhysicalStop> {
        let frozen = &self.frozen;
        if watch.component >= frozen.first_guard() {
            let passed = self.pass_guard(time, y, watch, &mut modes.0);
            return passed.map(|()| None);
        }
        if watch.component >= frozen.contacts() + frozen.tracks.len() {
            let passed = self.pass_direction(time, y, watch.component, watch.target, modes);
            return passed.map(|()| None);
        }
        if frozen.is_rigid(watch.component) {
            let impact = self.pass_rigid(time, y, watch, modes)?;
            frozen.settle_points(y, &modes.0);
            frozen.settle_sides(time, y, &mut modes.0);
            return Ok(impact);
        }
        // (A stop has one flank and no gap: it opens where it is left.)
        if watch.component >= frozen.pairs.len() {
            modes.0[watch.component] = watch.target;
        } else {
            self.pass_flank(y, watch, modes);
            frozen.settle_points(y, &modes.0);
        }
        frozen.settle_sides(time, y, &mut modes.0);
        Ok(None)
    }

    /// A pair comes into contact or leaves it.
    fn pass_flank(&self, y: &[f64], watch: &EventFunction, modes: &mut Modes) {
        let chain = &self.frozen.chains[self.frozen.pairs[watch.component]];
        let before = modes.0[watch.component];
        modes.0[watch.component] = if watch.target == super::pairs::OPEN {
            let (u, v) = self.frozen.deviations(chain, y);
            let scale = self.scales_of_state()[chain.first_coordinate];
            chain.contact.mode_after_leaving(before, u[0], v[0], scale)
        } else {
            watch.target
        };
    }

    /// The end of a run at an edge: a dead-centre position, or the end of a travel.
    pub(super) fn end_of_reach(&self, time: f64, edge: &Singularity) -> PhysicalStop {
        let track = &self.frozen.tracks[edge.component - self.frozen.contacts()];
        if let Some(stop) = self.end_at_distance(time, track) {
            return stop;
        }
        let part = &self.model.objects[track.object];
        let driver = part.driver().map(|driver| &self.model.objects[driver]);
        let place = match driver.map(|driver| driver.coordinate) {
            Some(Coordinate::Sliding) => format!("{} m", shown(edge.place, 9)),
            _ => format!("{}°", shown(edge.place.to_degrees(), 9)),
        };
        let driver = driver.map_or("its driver", |driver| driver.id.as_str());
        let at = format!("{driver} at {place}, reached at t = {} s", shown(time, 9));
        let id = &part.id;
        // In a dead-centre position speeds and forces grow beyond bounds; at the end of
        // a travel nothing happens but that it is not given to go further.
        let (name, message) = match self.cause_of_end(track.object, edge.place) {
            Some((Cause::Travel, _)) => (
                "end_of_travel",
                format!("{id} has no travel beyond {at}: the end of its travel"),
            ),
            Some((Cause::Unexplored, _)) => (
                "not_explored",
                format!(
                    "{id} was not examined beyond {at}: it was not followed further before the run"
                ),
            ),
            Some((Cause::DeadPosition { .. }, group)) => (
                "dead_position",
                format!("{id} cannot be assembled beyond {at}: a dead-centre position of {group}"),
            ),
            None => (
                "dead_position",
                format!("{id} cannot be assembled beyond {at}: a dead-centre position"),
            ),
        };
        PhysicalStop {
            name,
            object: id.clone(),
            message,
        }
    }

    /// The end of a run in a singular position of a linkage of several inputs.
    fn end_at_distance(&self, time: f64, track: &FrozenTrack) -> Option<PhysicalStop> {
        let (linkage, group) = self.frozen.distance_of(track.node?)?;
        let linkage = &self.frozen.multi[linkage].linkage;
        let id = &self.model.objects[track.object].id;
        let group = linkage.structure().describe(group);
        Some(PhysicalStop {
            name: "dead_position",
            object: id.clone(),
            message: format!(
                "{id} comes to a singular position of {group}, reached at t = {} s: its inputs do \
                 not determine how it goes on",
                shown(time, 9)
            ),
        })
    }

    /// What a linkage of several inputs that could not be assembled at the last evaluation
    /// has come to.
    pub(super) fn singular_obstacle(&self, work: &Work<f64>) -> Option<PhysicalStop> {
        let (object, group) = self.frozen.unassembled(work)?;
        let id = &self.model.objects[object].id;
        let mut bodies = self.model.multi_linkages.iter();
        let body = bodies.find(|body| body.object == object)?;
        let group = body.linkage.structure().describe(group);
        Some(PhysicalStop {
            name: "dead_position",
            object: id.clone(),
            message: format!(
                "{id} cannot be assembled beyond: a singular position of {group}, where its \
                 inputs do not determine how it goes on"
            ),
        })
    }

    /// Why a linkage goes no further than where its driver has a displacement,
    /// and the group that is in a dead-centre position there.
    fn cause_of_end(&self, object: usize, driver: f64) -> Option<(Cause, String)> {
        let mut linkages = self.model.linkages.iter();
        let body = linkages.find(|body| body.object == object)?;
        let NodeMotion::Rigid { law } = &self.model.nodes[body.node].motion else {
            return None;
        };
        let q = law.lever * law.position.jet(0, driver).value;
        let Reach::Interval { lower, upper } = body.linkage.range().reach else {
            return None;
        };
        let near = (q - lower.at).abs() < (q - upper.at).abs();
        let end = if near { lower } else { upper };
        let group = match end.cause {
            Cause::DeadPosition { group } => body.linkage.structure().describe(group),
            Cause::Travel | Cause::Unexplored => String::new(),
        };
        Some((end.cause, group))
    }
}
