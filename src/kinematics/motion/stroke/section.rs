//! Run-up and run-out laws with the constants that synthesis needs.

use crate::fault::Fault;
use crate::kinematics::motion::law::{Law, RunLawSpec, Trapezoid};

/// The law of a run-up or, counted backwards, of a run-out.
#[derive(Clone, Debug, PartialEq)]
pub struct RunSection {
    /// Numbers that were asked for.
    pub spec: RunLawSpec,
    /// The law θ(τ).
    pub law: Law,
    /// θ′_max = θ′(1).
    pub speed: f64,
    /// θ″_max.
    pub acceleration: f64,
    /// (θ′θ″)_max.
    pub product: f64,
}

impl RunSection {
    /// A law with its constants: closed formulas for the modified trapezoid,
    /// found on the law otherwise.
    ///
    /// # Errors
    /// Everything wrong with the law, also a speed that turns back or is not
    /// greatest at its end.
    pub fn new(spec: &RunLawSpec) -> Result<Self, Vec<Fault>> {
        let law = Law::of_run_up(spec)?;
        let (speed, acceleration, product) = match spec {
            RunLawSpec::Trapezoid { s1, s2 } => {
                let closed = Trapezoid::new(*s1, *s2)
                    .map_err(|message| vec![Fault::new("", message, "")])?;
                let product = closed.greatest_product().0;
                (
                    closed.greatest_speed(),
                    closed.greatest_acceleration(),
                    product,
                )
            }
            _ => {
                let found = law.constants();
                (
                    law.at(1.0).first,
                    found.acceleration.value,
                    found.torque.value,
                )
            }
        };
        Ok(Self {
            spec: spec.clone(),
            law,
            speed,
            acceleration,
            product,
        })
    }
}
