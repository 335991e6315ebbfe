//! What follows prescribed drives rigidly, and how quick its usual motion is.
//!
//! The error of a step is that of coordinates alone. They may be at rest, or belong to another
//! machine: then nothing but this tells how long a step may be.

use super::frozen::{Frozen, Step};

/// Share of the moving samples of a node that are slower than its usual motion. (The greatest
/// of all may be those of a moment.)
const USUAL: f64 = 0.75;

impl Frozen {
    /// The nodes that follow prescribed drives by laws alone, in order.
    pub(super) fn find_rigid_given(&self) -> Vec<usize> {
        let mut given = vec![false; self.inertia.len()];
        let mut found = Vec::new();
        for step in &self.steps {
            let (node, follows) = match step {
                Step::Prescribed(drive) => {
                    given[drive.node] = true;
                    continue;
                }
                Step::Rotor(_) | Step::Chain(_) => continue,
                Step::Rigid(index) => {
                    let rigid = self.rigids[*index];
                    (rigid.node, given[self.laws[rigid.law].driver])
                }
                Step::Constrained(index) => {
                    let own = &self.constraints[*index];
                    (own.node, own.drivers.iter().all(|&driver| given[driver]))
                }
            };
            given[node] = follows;
            if follows {
                found.push(node);
            }
        }
        found
    }
}

/// Speeds and accelerations of a node that were sampled.
#[derive(Default)]
pub(super) struct Motion {
    speeds: Vec<f64>,
    accelerations: Vec<f64>,
}

impl Motion {
    /// Takes a sample in: φ, φ̇ and φ̈. What is at rest, or beyond the reach of a law, tells
    /// nothing.
    pub(super) fn include(&mut self, at: &[f64; 3]) {
        let moving = |value: f64| value != 0.0 && value.is_finite();
        self.speeds
            .extend(Some(at[1].abs()).filter(|_| moving(at[1])));
        self.accelerations
            .extend(Some(at[2].abs()).filter(|_| moving(at[2])));
    }

    /// The time (s) in which its usual motion turns by a radian; infinite where it is not
    /// accelerated.
    pub(super) fn time(mut self) -> f64 {
        match (
            typical_value(&mut self.speeds),
            typical_value(&mut self.accelerations),
        ) {
            (Some(speed), Some(acceleration)) => speed / acceleration,
            _ => f64::INFINITY,
        }
    }
}

fn typical_value(values: &mut [f64]) -> Option<f64> {
    let last = values.len().checked_sub(1)?;
    let place = (USUAL * last as f64) as usize;
    Some(*values.select_nth_unstable_by(place, f64::total_cmp).1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_usual_motion_is_that_of_the_most_part() {
        let mut steady = Motion::default();
        let mut steep = Motion::default();
        for k in 1..=1000 {
            let (sin, cos) = (40.0 * f64::from(k) / 1000.0).sin_cos();
            steady.include(&[sin, 5.0 * cos, -25.0 * sin]);
            let t = f64::from(k) / 1000.0;
            steep.include(&[t.sqrt(), 0.5 / t.sqrt(), -0.25 * t.powf(-1.5)]);
        }
        steep.include(&[0.0, 1e6, 1e18]);
        let time = steady.time();
        assert!((0.19..0.21).contains(&time), "{time}");
        let time = steep.time();
        assert!((0.4..0.6).contains(&time), "{time}");
        let mut uniform = Motion::default();
        uniform.include(&[1.0, 3.0, 0.0]);
        assert_eq!(uniform.time(), f64::INFINITY);
    }
}
