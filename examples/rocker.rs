//! A scene built in code, run, and read as arrays.
//!
//! `cargo run --release --example rocker`

#![allow(clippy::print_stdout)] // an example says what it found

use dam::prelude::*;

/// A rocker of two masses, swung by a shaft, that may lift off its cam.
pub(crate) fn scene() -> Scene {
    let rocker = Rocker::on("shaft")
        .position(Position::sine("90 deg"))
        .inertia(0.1)
        .stiffness(1e7)
        .damping_capacity(0.4)
        .masses(2)
        .pair(Pair::force_closed())
        .load("closing", Load::constant("-600 N m"));
    Scene::new("Rocker of a cam mechanism, two masses")
        .add("shaft", Drive::speed("10 rev/s"))
        .add("rocker", rocker)
        .duration("0.5 s")
        .start("static")
        .tolerance(1e-9)
}

pub(crate) fn main() -> Result<(), Error> {
    let run = scene().run()?;
    let figures = run.figures("rocker")?;
    println!("greatest deviation   {:.6e} rad", figures.delta_max);
    println!(
        "separations          {}",
        run.figure("rocker", Figure::Separations)?
    );
    println!(
        "trusted              {} ({})",
        run.is_trusted(),
        run.figures.run.method
    );

    // The samples are plain arrays.
    let (times, delta) = (run.times(), run.delta("rocker")?);
    let (at, greatest) = (times.iter().zip(delta))
        .max_by(|one, other| one.1.total_cmp(other.1))
        .expect("a run has samples");
    println!("greatest sample of δ {greatest:.6e} rad at {at:.4} s");
    let force = run.contact_force("rocker")?;
    let open = force.iter().filter(|&&force| force == 0.0).count();
    println!("samples without contact: {open} of {}", force.len());
    Ok(())
}
