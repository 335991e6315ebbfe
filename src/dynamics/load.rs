//! Forces over the motion of a node: what a law answers, whether it is one of the library's
//! (`laws`, a file each) or supplied by its user.

use super::laws::LawInstance;
use std::fmt;
use std::sync::Arc;

/// A force on a node as a function of the node's own displacement and speed.
pub trait LoadFunction: fmt::Debug + Send + Sync {
    /// The force (N or N·m, positive towards positive displacement) and its slopes at a
    /// displacement and a speed. It is to be continuous; smooth, where the accuracy of a
    /// step is to be kept. Must not allocate.
    fn force(&self, displacement: f64, speed: f64) -> Force;

    /// Greatest magnitude of the force in ordinary running (N or N·m), finite and ≥ 0:
    /// errors are measured by it.
    fn magnitude(&self) -> f64;

    /// False for a force over displacement alone, which acts on a body at rest too and
    /// takes part in a static start. Default: true.
    fn needs_speed(&self) -> bool {
        true
    }

    /// False for a force over speed alone. Default: true.
    fn needs_displacement(&self) -> bool {
        true
    }

    /// Description in a few words, for tables and equations.
    fn description(&self) -> String;

    /// The declaration that it was read by, with its numbers; `None`: no text states it.
    fn declared(&self) -> Option<LawInstance> {
        None
    }

    /// Its power series along a motion, made once and used for every step; `None`: it has
    /// none, and methods that need one are not offered.
    fn series(&self) -> Option<Box<dyn LoadSeries>> {
        None
    }

    /// Of a motor's torque the speed (rad/s or m/s) that it runs at without load.
    fn running_speed(&self) -> Option<f64> {
        None
    }

    /// Of regularised friction the greatest force, and the width (a speed) of it.
    fn regularised_friction(&self) -> Option<[f64; 2]> {
        None
    }

    /// Speeds at which its slope jumps.
    fn corners(&self) -> &[(f64, f64)] {
        &[]
    }

    /// Why it is not linear, after the name of the load.
    fn why_not_linear(&self) -> &'static str {
        "is not known to be linear"
    }
}

/// The power series of a force along a motion: coefficients in s, the share of a step.
pub trait LoadSeries: fmt::Debug + Send + Sync {
    /// Begins anew at a displacement and a speed.
    fn begin(&mut self, displacement: f64, speed: f64);

    /// Coefficient `order` ≥ 1 of the force, from those of displacement and speed up to it;
    /// asked for in ascending order.
    fn advance(&mut self, order: usize, displacement: &[f64], speed: &[f64]) -> f64;

    /// Share of the step, at most 1, over which the series can be relied on.
    fn reliable(&self, speed: &[f64], degree: usize) -> f64 {
        let _ = (speed, degree);
        1.0
    }

    /// A copy in a box.
    fn copy(&self) -> Box<dyn LoadSeries>;
}

impl Clone for Box<dyn LoadSeries> {
    fn clone(&self) -> Self {
        self.copy()
    }
}

/// A force that this library does not know. Two are equal that are the same one.
#[derive(Clone, Debug)]
pub struct CustomLoad(pub Arc<dyn LoadFunction>);

impl PartialEq for CustomLoad {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

/// A force with its slopes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Force {
    /// The force (N or N·m).
    pub value: f64,
    /// ∂/∂φ (N/m or N·m/rad).
    pub by_displacement: f64,
    /// ∂/∂φ̇ (N·s/m or N·m·s/rad).
    pub by_speed: f64,
}
