//! What can be told of a motion beforehand, for the choice of a method.

use super::System;
use super::frozen::{Frozen, FrozenLaw, Step};
use super::taylor::way_of_law;
use crate::kinematics::breaks::Breaks;
use crate::kinematics::constraint::Constraint;
use std::f64::consts::TAU;

/// Changes of the sides of a block in a turn: each of both corners is pressed one way
/// by the acceleration and the other way by the deceleration.
const SIDES: f64 = 4.0;

/// Places at which a law is looked at, spread over the way of its driver by the golden ratio.
const PLACES: usize = 64;
const GOLDEN: f64 = 0.618_033_988_749_894_9;
/// Radius around each, and the longest way told, in radians of the drive.
const RADIUS: f64 = 0.1;
const LONGEST: f64 = 1.0;

impl System {
    /// True when a law of position that is no constant ratio, or a linkage, is
    /// part of the mechanism.
    pub fn has_variable_ratio(&self) -> bool {
        let linkages = !self.frozen.linkages.is_empty() || !self.frozen.multi.is_empty();
        linkages || self.frozen.laws.iter().any(FrozenLaw::has_variable_ratio)
    }

    /// Part of the mechanism that has no power series because it is not known to the
    /// library, or couples coordinates; `None`: nothing of that sort.
    pub(crate) fn without_series(&self) -> Option<&'static str> {
        self.frozen.without_series()
    }

    /// True when a motor's torque is a table over its speed, whose corners are passed
    /// without a switch.
    pub fn has_corners(&self) -> bool {
        let mut loads = self.frozen.loads.iter();
        loads.any(|load| {
            load.law
                .function()
                .is_some_and(|own| !own.corners().is_empty())
        })
    }

    /// True when joints of a linkage of several inputs have friction.
    pub fn has_multi_input_friction(&self) -> bool {
        self.frozen.several.is_some()
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
                Some(rotor) if frozen.is_rotor(rotor) => {
                    let speed = self.scales_of_state()[frozen.coordinates + rotor];
                    passed(&track.breaks, speed * duration)
                }
                _ => 0.0,
            },
        });
        let sides = frozen.groups.iter().map(|group| match group.coordinate {
            Some(rotor) if frozen.is_rotor(rotor) => {
                let speed = self.scales_of_state()[frozen.coordinates + rotor];
                SIDES * group.rubbing_guides() * speed * duration / TAU
            }
            _ => 0.0,
        });
        tracks.sum::<f64>() + sides.sum::<f64>()
    }

    /// Way of the fastest drive (rad) over which a power series knows the laws of
    /// position at tolerances of 1e-7, on the average over the way `reach` (rad) that the
    /// drive goes; infinite where no law bends.
    pub fn series_range_of_laws(&self, reach: f64) -> f64 {
        let frozen = &self.frozen;
        if !frozen.expands() {
            return f64::INFINITY;
        }
        // What a node moves while a drive turns by a radian, at most.
        let mut slopes = vec![1.0; frozen.inertia.len()];
        let mut shortest = f64::INFINITY;
        for step in &frozen.steps {
            let (index, first, count) = match step {
                Step::Prescribed(_) | Step::Rotor(_) => continue,
                Step::Rigid(rigid) => {
                    let rigid = frozen.rigids[*rigid];
                    (rigid.law, rigid.node, 1)
                }
                Step::Chain(chain) => {
                    let chain = &frozen.chains[*chain];
                    (chain.law, chain.nodes().start, chain.nodes().len())
                }
                Step::Constrained(index) => {
                    let own = &frozen.constraints[*index];
                    let Constraint::Linear { ratios, .. } = &own.constraint else {
                        continue; // such a system does not expand
                    };
                    let terms = own.drivers.iter().zip(ratios);
                    slopes[own.node] = terms.map(|(&d, ratio)| slopes[d] * ratio.abs()).sum();
                    continue;
                }
            };
            let law = &frozen.laws[index];
            let driver = slopes[law.driver];
            let [way, slope] = frozen.follow_law(law, driver, reach);
            shortest = shortest.min(way);
            slopes[first..first + count].fill(driver * slope);
        }
        shortest
    }
}

impl Frozen {
    /// Of a law whose driver moves by `driver` a radian: the mean way of the drive (rad) over
    /// which it is known, and the greatest |U′|.
    fn follow_law(&self, law: &FrozenLaw, driver: f64, reach: f64) -> [f64; 2] {
        let piece = |phi: f64| {
            let track = law.component.map(|c| &self.tracks[c - self.contacts()]);
            track.map_or(0, |track| track.breaks.segment_at(phi, 1.0))
        };
        let jet = |piece: i64, phi: f64| law.position.jet(piece, phi).scaled(law.lever);
        if !law.has_variable_ratio() {
            return [f64::INFINITY, jet(0, 0.0).first.abs()];
        }
        let (mut inverse, mut slope) = (0.0, 0.0f64);
        for place in 0..PLACES {
            let phi = driver * reach * (place as f64 * GOLDEN).fract();
            let piece = piece(phi);
            let way = way_of_law(phi, driver * RADIUS, driver * LONGEST, |phi| {
                jet(piece, phi)
            });
            inverse += driver / way;
            slope = slope.max(jet(piece, phi).first.abs());
        }
        [PLACES as f64 / inverse, slope]
    }
}
