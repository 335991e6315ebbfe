//! What can be told of a motion beforehand, for the choice of a method.

use super::System;
use crate::breaks::Breaks;
use crate::position::Position;
use std::f64::consts::TAU;

/// Changes of the sides of a block in a turn: each of both corners is pressed one way
/// by the acceleration and the other way by the deceleration.
const SIDES: f64 = 4.0;

impl System {
    /// True when a law of position that is no constant ratio, or a linkage, is
    /// part of the mechanism.
    pub fn bends(&self) -> bool {
        let bent = |law: &super::frozen::FrozenLaw| !matches!(law.position, Position::Ratio { .. });
        !self.frozen.linkages.is_empty() || self.frozen.laws.iter().any(bent)
    }

    /// About how many breaks of laws and loads are passed in a time (s): those over
    /// time, and those over the displacement of rotors that turn at their nominal
    /// speed; among them the changes of the sides on which blocks with friction press.
    pub fn breaks_passed(&self, duration: f64) -> f64 {
        let frozen = &self.frozen;
        let passed = |breaks: &Breaks, way: f64| {
            let count = breaks.points.len() as f64;
            match breaks.period {
                Some(period) => count * way / period,
                None => count,
            }
        };
        let tracks = frozen.tracks.iter().map(|track| match track.node {
            None => passed(&track.breaks, duration),
            Some(node) => match frozen.coordinate[node] {
                // Only rotors have no link.
                Some(rotor) if frozen.stiffness[rotor] == 0.0 => {
                    let speed = self.scales_of_state()[frozen.coordinates + rotor];
                    passed(&track.breaks, speed * duration)
                }
                _ => 0.0,
            },
        });
        let sides = frozen.groups.iter().map(|group| match group.coordinate {
            Some(rotor) if frozen.stiffness[rotor] == 0.0 => {
                let speed = self.scales_of_state()[frozen.coordinates + rotor];
                SIDES * group.rubbing_guides() * speed * duration / TAU
            }
            _ => 0.0,
        });
        tracks.sum::<f64>() + sides.sum::<f64>()
    }
}
