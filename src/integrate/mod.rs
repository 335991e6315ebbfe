//! Integration of switching systems: one contract, several methods, one way of finding switches.

mod dynamics;
mod outcome;

pub use dynamics::{Dynamics, Guard, Modes, PhysicalStop, Watch};
pub use outcome::{Limits, Method, Outcome, Settings, Sink, Statistics, Stop, SwitchEvent};
