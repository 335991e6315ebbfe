//! Dry friction that sticks.

/// Dry friction with a static value: while its node moves, W = −F(|φ̇|)·sign φ̇ with
/// F(v) = F_k + (F_s − F_k)·exp(−v/v_s); at rest whatever holds the node, up to F_s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DryFriction {
    /// F_k ≥ 0: friction of sliding (N or N·m).
    pub sliding: f64,
    /// F_s ≥ F_k: the greatest force that holds the node at rest (N or N·m).
    pub static_limit: f64,
    /// v_s > 0: the speed over which friction falls from F_s towards F_k (rad/s or m/s); `None`:
    /// it is F_k at once.
    pub stribeck_speed: Option<f64>,
}

impl DryFriction {
    /// F at a speed v ≥ 0, and dF/dv.
    pub fn at_speed(&self, speed: f64) -> [f64; 2] {
        match self.stribeck_speed {
            None => [self.sliding, 0.0],
            Some(width) => {
                let rest = (self.static_limit - self.sliding) * (-speed / width).exp();
                [self.sliding + rest, -rest / width]
            }
        }
    }

    /// The force on a node that moves at a speed; 0 at rest, where it is not determined.
    pub fn opposing(&self, speed: f64) -> f64 {
        match speed {
            0.0 => 0.0,
            _ => -speed.signum() * self.at_speed(speed.abs())[0],
        }
    }

    /// True where its numbers are what they may be.
    pub(crate) fn is_possible(&self) -> bool {
        let speed = self.stribeck_speed.is_none_or(|v| v > 0.0 && v.is_finite());
        let ordered = 0.0 <= self.sliding && self.sliding <= self.static_limit;
        ordered && self.static_limit.is_finite() && speed
    }

    /// The same with forces multiplied by a factor; its sign does not matter.
    pub(crate) fn scaled(&self, by: f64) -> Self {
        Self {
            sliding: self.sliding * by.abs(),
            static_limit: self.static_limit * by.abs(),
            ..*self
        }
    }
}
