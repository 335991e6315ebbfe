//! Discrete state: pairs and tracks, what to watch, what a switch does.

use super::System;
use super::frozen::Frozen;
use crate::integrate::{Dynamics, Guard, Modes, PhysicalStop, Watch};
use crate::model::Coordinate;

impl Frozen {
    /// All switches to look for in the present modes.
    pub(super) fn watches(&self, modes: &[i64], out: &mut Vec<Watch>) {
        out.clear();
        for (component, &chain) in self.pairs.iter().enumerate() {
            let chain = &self.chains[chain];
            chain
                .contact
                .watches(modes[component], chain.first_coordinate, component, out);
        }
        for (index, track) in self.tracks.iter().enumerate() {
            let Some(signal) = track.signal else {
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
    }

    fn time_tracks(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.tracks.len()).filter(|&track| self.tracks[track].node.is_none())
    }
}

/// The watch on an edge of a segment: the distance to it falls through zero.
fn leaving(signal: usize, edge: f64, side: i64, component: usize, segment: i64) -> Watch {
    let guard = Guard {
        signal,
        offset: side as f64 * edge,
        displacement: -(side as f64),
        speed: 0.0,
    };
    Watch {
        guards: [guard, guard],
        rising: false,
        component,
        target: segment + side,
    }
}

impl System {
    /// Changes the modes for a switch located at (`time`, `y`).
    pub(super) fn pass_switch(
        &self,
        time: f64,
        y: &[f64],
        watch: &Watch,
        modes: &mut Modes,
    ) -> Result<(), PhysicalStop> {
        let pairs = self.frozen.pairs.len();
        if let Some(track) = watch.component.checked_sub(pairs) {
            if self.frozen.tracks[track].stops {
                return Err(self.dead_position(track, time, y, modes));
            }
            modes.0[watch.component] = watch.target;
            return Ok(());
        }
        let chain = &self.frozen.chains[self.frozen.pairs[watch.component]];
        let before = modes.0[watch.component];
        modes.0[watch.component] = if watch.target == super::pairs::OPEN {
            let (u, v) = self.frozen.deviations(chain, y);
            let scale = self.scales[chain.first_coordinate];
            chain.contact.mode_after_leaving(before, u[0], v[0], scale)
        } else {
            watch.target
        };
        Ok(())
    }

    fn dead_position(&self, track: usize, time: f64, y: &[f64], modes: &Modes) -> PhysicalStop {
        let track = &self.frozen.tracks[track];
        let part = &self.model.objects[track.object];
        let driver = part.driver.map(|driver| &self.model.objects[driver]);
        let place = track.node.map_or(time, |node| {
            let mut work = self.scratch().work;
            let extent = super::passes::Extent::Needed;
            self.frozen.motion(time, y, &modes.0, extent, &mut work);
            work.displacement[node]
        });
        let place = match driver.map(|driver| driver.coordinate) {
            Some(Coordinate::Sliding) => format!("{place:.9} m"),
            _ => format!("{:.6}°", place.to_degrees()),
        };
        let driver = driver.map_or("its driver", |driver| driver.id.as_str());
        PhysicalStop {
            name: "dead_position",
            object: part.id.clone(),
            message: format!(
                "{} cannot be assembled beyond {driver} at {place}, reached at t = {time:.9} s: \
                 a dead position",
                part.id
            ),
        }
    }
}
