//! Constants of a law, by which designers compare laws.

use super::Law;
use crate::math::jet::Jet;
use crate::math::optimise::Peak;
use serde::Serialize;

/// A jump of a derivative; of the speed a hard shock, of the acceleration a soft one.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Jump {
    /// τ.
    pub at: f64,
    /// Order of the derivative: 1 speed, 2 acceleration, 3 jerk.
    pub order: usize,
    /// Value just before the joint.
    pub before: f64,
    /// Value just after the joint.
    pub after: f64,
}

/// Constants of a law in its normal form (stroke 1, duration 1).
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LawConstants {
    /// C_v: greatest θ′.
    pub speed: Peak,
    /// C_a: greatest θ″.
    pub acceleration: Peak,
    /// Least θ″ if below 0, the greatest deceleration; else 0.
    pub deceleration: Peak,
    /// C_j: greatest |θ‴|; jumps of θ″ are not in it.
    pub jerk: Peak,
    /// Greatest θ′θ″: torque that accelerates a mass.
    pub torque: Peak,
    /// Least θ′θ″ if below 0: torque that brakes it; else 0.
    pub braking_torque: Peak,
    /// C_m = max|θ′θ″|: torque factor.
    pub torque_factor: f64,
    /// Filling coefficient σ of the diagram of θ″ up to the greatest speed:
    /// its mean by its greatest value.
    pub filling: f64,
    /// Centre of gravity τ* of that part of the diagram.
    pub centre: f64,
    /// Filling coefficient of the part after the greatest speed; null for a run-up.
    pub filling_after: Option<f64>,
    /// Centre of gravity of that part; null for a run-up.
    pub centre_after: Option<f64>,
    /// Continuity class: the highest order up to which all derivatives are
    /// continuous, rest (or uniform motion after a run-up) before and after
    /// included; 3 stands for 3 or more.
    pub continuity: usize,
    /// Jumps of derivatives up to the third.
    pub jumps: Vec<Jump>,
}

impl Law {
    /// The law's constants.
    ///
    /// Extremes are exact to rounding; their places too, except of the jerk
    /// (about 1e-8).
    pub fn constants(&self) -> LawConstants {
        let speed = self.sharp_peak(&|j| j.first, &|j| j.second);
        let acceleration = self.sharp_peak(&|j| j.second, &|j| j.third);
        let deceleration = self
            .sharp_peak(&|j| -j.second, &|j| -j.third)
            .negated(acceleration.value);
        let product = |j: &Jet| j.first * j.second;
        let slope = |j: &Jet| j.second * j.second + j.first * j.third;
        let torque = self.sharp_peak(&product, &slope);
        let braking = self
            .sharp_peak(&|j| -product(j), &|j| -slope(j))
            .negated(torque.value);
        let last = self.last_at_speed(speed);
        let after = !self.run_up;
        let jumps = self.jumps();
        let lowest = jumps.iter().map(|jump| jump.order).min();
        LawConstants {
            torque_factor: torque.value.max(-braking.value),
            continuity: lowest.map_or(3, |order| order - 1),
            filling_after: after.then(|| speed.value / ((1.0 - last) * deceleration.value.abs())),
            centre_after: after.then(|| last + (1.0 - self.at(last).value) / speed.value),
            filling: speed.value / (speed.at * acceleration.value),
            centre: speed.at - self.at(speed.at).value / speed.value,
            jerk: self.peak_of(&|j| j.third.abs()),
            speed,
            acceleration,
            deceleration,
            torque,
            braking_torque: braking,
            jumps,
        }
    }

    /// The last τ with the greatest speed: the end of a uniform section, if there is one.
    fn last_at_speed(&self, speed: Peak) -> f64 {
        let slack = 1e-12 * speed.value;
        let ends = self.pieces().filter(|&(piece, from, to)| {
            let fast = |tau: f64| self.jet(piece, tau).first >= speed.value - slack;
            fast(from) && fast(to) && fast(0.5 * (from + to))
        });
        ends.map(|(_, _, to)| to).fold(speed.at, f64::max)
    }

    /// Jumps of the first three derivatives at the joints and both ends.
    fn jumps(&self) -> Vec<Jump> {
        let (before, after) = self.beyond();
        let last = self.pieces.len() - 1;
        let mut sides = vec![(0.0, before, self.jet(0, 0.0))];
        for (index, &joint) in self.joints.iter().enumerate() {
            sides.push((joint, self.jet(index, joint), self.jet(index + 1, joint)));
        }
        sides.push((1.0, self.jet(last, 1.0), after));
        let derivatives = |jet: &Jet| [jet.first, jet.second, jet.third];
        let mut scale = [0.0f64; 3];
        for (_, left, right) in &sides {
            for side in [left, right] {
                for (scale, value) in scale.iter_mut().zip(derivatives(side)) {
                    *scale = scale.max(value.abs());
                }
            }
        }
        let mut jumps = Vec::new();
        for (at, left, right) in &sides {
            let (left, right) = (derivatives(left), derivatives(right));
            for order in 1..=3 {
                let (before, after) = (left[order - 1], right[order - 1]);
                let rounding = 1e-9 * scale[order - 1].max(1.0);
                if (after - before).abs() > rounding {
                    jumps.push(Jump {
                        at: *at,
                        order,
                        before,
                        after,
                    });
                }
            }
        }
        jumps
    }
}

impl Peak {
    /// The same place, the value with the other sign; nothing (0) where that
    /// would be above zero, or is rounding of numbers of this `size`.
    fn negated(self, size: f64) -> Self {
        let value = if self.value > 1e-14 * size {
            -self.value
        } else {
            0.0
        };
        Self { value, ..self }
    }
}
