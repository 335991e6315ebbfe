//! A sweep over a parameter: from which speed on does the rocker lift off?
//!
//! `cargo run --release --example sweep`

#![allow(clippy::print_stdout)] // an example says what it found

use dam::prelude::*;

/// Speed (rev/s), separations, greatest δ (rad).
pub(crate) type Row = (f64, f64, f64);

/// Runs a scene at several speeds of its shaft.
pub(crate) fn sweep(scene: &Scene, speeds: &[f64]) -> Result<Vec<Row>, Error> {
    let at = |&speed: &f64| {
        let scene = scene
            .clone()
            .set("shaft.motion.speed", format!("{speed} rev/s"));
        let run = scene.run()?;
        let separations = run.figure("rocker", Figure::Separations)?;
        Ok((speed, separations, run.figures("rocker")?.delta_max))
    };
    speeds.iter().map(at).collect()
}

pub(crate) fn main() -> Result<(), Error> {
    let scene = Scene::read(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/scenarios/rocker/two_masses.json"
    ))?;
    println!("speed [rev/s], separations, greatest δ [rad]");
    for (speed, separations, delta) in sweep(&scene, &[2.0, 4.0, 6.0, 8.0, 10.0])? {
        println!("{speed}, {separations}, {delta:.6e}");
    }

    // Or, side by side with the figures' differences from the last:
    let comparison = scene.compare("rocker.masses", [1, 2, 10])?;
    let rows = &comparison.table.rows;
    for row in rows.iter().filter(|row| row.figure == "rocker.delta_max") {
        println!(
            "{}: {:?} of {:?} masses",
            row.figure, row.values, comparison.table.labels
        );
    }
    Ok(())
}
