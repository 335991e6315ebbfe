//! A map as an array: where does the rocker stay on its cam?
//!
//! `cargo run --release --example map`

#![allow(clippy::print_stdout)] // an example says what it found

use dam::prelude::*;

/// δ_max over inertia and stiffness, with a verdict for every point.
pub(crate) fn map() -> Result<Map, Error> {
    let scene = Scene::read(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/scenarios/rocker/two_masses.json"
    ))?;
    scene
        .map(Axis::linear("rocker.inertia", 0.002, 0.05, 7))
        .up(Axis::log("rocker.stiffness", 1e6, 1e8, 3))
        .figure("rocker", Figure::DeltaMax)
        .ask()
}

pub(crate) fn main() -> Result<(), Error> {
    let map = map()?;
    println!("{} [{}], a row a stiffness:", map.figure, map.unit);
    // What has no value has a verdict that says why; here it is shown as NaN.
    println!("{:.3e}", map.values(f64::NAN));
    for (stiffness, row) in map.y.iter().zip(map.rows()) {
        let verdicts: Vec<&str> = row.iter().map(|cell| cell.verdict.words()).collect();
        println!("{stiffness:.0e} N m/rad: {}", verdicts.join(", "));
    }
    let verdicts = map.cells.iter().map(|cell| cell.verdict);
    let good = verdicts.filter(|&verdict| verdict == Verdict::InWorkingOrder);
    let good = good.count();
    println!("{good} of {} points in working order", map.cells.len());
    Ok(())
}
