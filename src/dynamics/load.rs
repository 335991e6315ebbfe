//! Loads that this library does not know: forces over the motion of a node.

use std::fmt;
use std::sync::Arc;

/// A force on a node as a function of the node's own displacement and speed, supplied
/// by a user of the library.
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

    /// Description in a few words, for tables and equations.
    fn description(&self) -> String;
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
