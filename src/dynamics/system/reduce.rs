//! A machine with rigid objects seen from its rotor: one moment of inertia and
//! one moment.

use super::frozen::Frozen;
use super::passes::{Extent, Work};
use super::{Scratch, System};
use crate::dynamics::integrate::Modes;
use crate::dynamics::model::TrackSource;
use crate::math::number::Dual;

/// A rotor with all that hangs rigidly on it, at a position and a speed: its
/// equation of motion is inertia·φ̈ + inertia_slope·φ̇²/2 = moment.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ReducedRotor {
    /// J(φ) (kg·m²).
    pub inertia: f64,
    /// dJ/dφ.
    pub inertia_slope: f64,
    /// M(φ, φ̇) of all loads (N·m), driving positive.
    pub moment: f64,
    /// ∂M/∂φ̇.
    pub moment_by_speed: f64,
    /// Sum of the magnitudes of the single moments (N·m): what M rounds by.
    pub gross_moment: f64,
}

impl System {
    /// The state with every rotor at `position` and `speed`, everything else on
    /// its law, and the modes in which it moves on.
    pub fn rotor_state(&self, rotor: usize, position: f64, speed: f64) -> (Vec<f64>, Modes) {
        let mut y = self.frozen.law_state();
        if let Some(coordinate) = self.last_coordinate(rotor) {
            y[coordinate] = position;
            y[self.frozen.coordinates + coordinate] = speed;
        }
        let mut modes = self.frozen.no_modes();
        self.frozen.locate_tracks(&y, &mut modes);
        (y, Modes(modes))
    }

    /// Reduces what hangs rigidly on the rotor of an object to it, in a state and
    /// its modes; zero for an object that has none. Allocates nothing.
    pub fn reduced_to_rotor(
        &self,
        rotor: usize,
        y: &[f64],
        modes: &Modes,
        scratch: &mut Scratch,
    ) -> ReducedRotor {
        let Some(coordinate) = self.last_coordinate(rotor) else {
            return ReducedRotor::default();
        };
        let node = self.places[rotor].node;
        let speed = y[self.frozen.coordinates + coordinate];
        let mut along = |entry: usize| {
            for (index, (state, &value)) in scratch.dual_state.iter_mut().zip(y).enumerate() {
                *state = Dual::new(value, f64::from(u8::from(index == entry)));
            }
            let work = &mut scratch.dual_work;
            let state = &scratch.dual_state;
            let still = Dual::from(0.0);
            self.frozen
                .motion(still, state, &modes.0, Extent::Full, work);
            self.frozen.apply_loads(still, &modes.0, Extent::Full, work);
            let gross = self.frozen.gross_moment(work);
            self.frozen.reduce_rigid(Extent::Full, work);
            (work.mass[node], work.force[node], gross)
        };
        let (inertia, force, gross) = along(coordinate);
        let (_, by_speed, _) = along(self.frozen.coordinates + coordinate);
        let slope = inertia.derivative;
        ReducedRotor {
            inertia: inertia.value,
            inertia_slope: slope,
            // The passes take the inertia's own moment off the force.
            moment: force.value + 0.5 * slope * speed * speed,
            moment_by_speed: by_speed.derivative + slope * speed,
            gross_moment: gross,
        }
    }

    /// Positions of the rotor of an object in [0, `end`], ascending, at which
    /// tables and laws over its own displacement change their formula.
    pub fn rotor_breaks(&self, rotor: usize, end: f64) -> Vec<f64> {
        let node = self.model.objects[rotor].nodes[0];
        let mut found = Vec::new();
        for track in &self.model.tracks {
            if track.source != TrackSource::Node(node) {
                continue;
            }
            let mut segment = track.breaks.segment_at(0.0, 1.0);
            loop {
                let edge = track.breaks.edges(segment).1;
                if !(edge < end) || found.len() > MOST_BREAKS {
                    break;
                }
                if edge > 0.0 {
                    found.push(edge);
                }
                segment += 1;
            }
        }
        found.sort_by(f64::total_cmp);
        found.dedup();
        found
    }

    /// True when a track over a displacement that ends a run is left in the
    /// given modes: a dead-centre position has been passed. The object concerned.
    pub fn beyond_reach(&self, first: &Modes, modes: &Modes) -> Option<usize> {
        let left = self.model.tracks.iter().enumerate().find(|(index, track)| {
            let component = self.frozen.track_component(*index);
            track.stops && first.0[component] != modes.0[component]
        });
        left.map(|(_, track)| track.object)
    }
}

/// Break points of a cycle at most.
const MOST_BREAKS: usize = 100_000;

impl Frozen {
    /// Sum of the magnitudes of the moments of the loads that were just applied, each at the
    /// coordinate along which the motion was differentiated.
    fn gross_moment(&self, work: &Work<Dual>) -> f64 {
        let at = |node: usize, force: f64| (force * work.displacement[node].derivative).abs();
        let loads = self.loads.iter().zip(&work.loads);
        let loads: f64 = loads.map(|(load, force)| at(load.node, force.value)).sum();
        let constant = self.constant_force.iter().enumerate();
        let constant: f64 = constant.map(|(node, &force)| at(node, force)).sum();
        let bodies = self.linkages.iter().map(|body| body.node);
        let bodies: f64 = bodies.map(|node| at(node, work.force[node].value)).sum();
        loads + constant + bodies
    }
}
