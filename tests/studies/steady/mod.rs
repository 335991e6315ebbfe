//! The steady motion of machines.

// The log of a run says how near the bounds are.
#![allow(clippy::print_stdout)]

mod machines;

mod elastic_motor;
mod elastic_wanted;
mod flywheel;
mod motor;
mod over_angle;
mod over_period;
mod over_time;
mod reference;
mod scenes;
