//! Does a steady motion have the figures that its scene expects?

use super::{Answer, PeriodicAnswer, RigidAnswer};
use crate::frontend::scene::{Expectation, Expected};
use crate::studies::expectations::{Verdict, verdict_on};

/// A figure of a steady motion by its address (`steady.period`); `None` where
/// this motion has none of that name.
pub fn figure(answer: &Answer, address: &str) -> Option<f64> {
    let name = address.strip_prefix("steady.")?;
    match answer {
        Answer::Rigid(answer) => of_rigid(answer, name),
        Answer::Periodic(answer) => of_periodic(answer, name),
    }
}

fn of_rigid(answer: &RigidAnswer, name: &str) -> Option<f64> {
    let f = &answer.figures;
    match name {
        "mean_time" => Some(f.means.time),
        "mean_angle" => Some(f.means.angle),
        "mean_midrange" => Some(f.means.midrange),
        "period" => Some(f.period),
        "least_speed" => Some(f.least_speed.value),
        "greatest_speed" => Some(f.greatest_speed.value),
        "speed_at_start" => Some(answer.motion.speed(0.0)),
        "fluctuation" => Some(f.fluctuation),
        "energy_at_start" => Some(f.energy_at_start),
        "reference_energy" => Some(f.reference_energy),
        "energy_fluctuation" => Some(f.energy_fluctuation),
        "cycle_work" => Some(f.cycle_work),
        "balance" => f.balance,
        "multiplier" => answer.regime.as_ref().map(|regime| regime.multiplier),
        "flywheel" => answer.flywheel.as_ref().map(|wheel| wheel.inertia),
        _ => None,
    }
}

fn of_periodic(answer: &PeriodicAnswer, name: &str) -> Option<f64> {
    let parts = answer.parts.iter();
    let drive = answer.drive.as_ref();
    match name {
        "mean_time" => drive.map(|drive| drive.means.time),
        "mean_angle" => drive.map(|drive| drive.means.angle),
        "mean_midrange" => drive.map(|drive| drive.means.midrange),
        "least_speed" => drive.map(|drive| drive.least_speed.value),
        "greatest_speed" => drive.map(|drive| drive.greatest_speed.value),
        "speed_at_start" => drive.map(|drive| drive.speed_at_start),
        "fluctuation" => drive.map(|drive| drive.fluctuation),
        "period" => parts.map(|part| part.period).reduce(f64::max),
        "periods" => parts.map(|part| part.periods as f64).reduce(f64::max),
        "multiplier" => parts
            .filter_map(|part| part.multipliers.first())
            .map(|multiplier| multiplier.modulus)
            .reduce(f64::max),
        _ => None,
    }
}

/// Judges the expectations of the steady motion, in their order.
pub fn check(expectations: &[Expectation], answer: &Answer) -> Vec<Verdict> {
    let judge = |expectation: &Expectation| match &expectation.what {
        Expected::Figure {
            figure: address,
            allowed,
        } if address.starts_with("steady.") => {
            let found = figure(answer, address);
            Some(Verdict {
                source: expectation.source.clone(),
                ..verdict_on(address, allowed, found)
            })
        }
        _ => None,
    };
    expectations.iter().filter_map(judge).collect()
}
