//! Exact propagation: against series, closed forms and integration.

mod support;

mod guarantees;
mod modes;
mod resonance;
mod scenes;
