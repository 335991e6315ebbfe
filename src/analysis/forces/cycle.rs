//! Work, losses and efficiency over a course.

use super::Course;
use super::row::Row;
use crate::linkage::spec::LinkageSpec;

/// Sums over a course; none where the input rests or positions have no forces.
#[derive(Clone, Debug, PartialEq)]
pub struct CycleForces {
    /// True: a whole cycle, over which inertia and weights do no work.
    pub closed: bool,
    /// Duration (s).
    pub duration: f64,
    /// Work of the driver (J).
    pub drive_work: f64,
    /// Work of the load on the linkage (J), negative where it resists.
    pub load_work: f64,
    /// Work of weights, springs, dampers and forces (J), the load included.
    pub applied_work: f64,
    /// Work lost to friction (J).
    pub loss: f64,
    /// Work lost in each pair (J).
    pub pair_losses: Vec<f64>,
    /// 1 − loss over the work put in by the driver and the load, each if it
    /// puts in any over the whole course; `None` where nothing is put in or the
    /// course is no cycle.
    pub efficiency: Option<f64>,
    /// Mean driving force over time (N·m or N).
    pub mean_drive: f64,
    /// Root mean square of the driving force over time (N·m or N).
    pub rms_drive: f64,
}

/// Sums up a course.
pub(super) fn sum(course: &Course, rows: &[Row], linkage: &LinkageSpec) -> Option<CycleForces> {
    let durations = course.durations()?;
    let duration: f64 = durations.iter().sum();
    let mut sums = CycleForces {
        closed: course.is_closed(),
        duration,
        drive_work: 0.0,
        load_work: 0.0,
        applied_work: 0.0,
        loss: 0.0,
        pair_losses: vec![0.0; linkage.pairs.len()],
        efficiency: None,
        mean_drive: 0.0,
        rms_drive: 0.0,
    };
    let mut flowed = 0.0;
    for (row, dt) in rows.iter().zip(&durations) {
        let forces = row.forces.as_ref().ok()?;
        let balance = &forces.balance;
        sums.drive_work += balance.drive * dt;
        sums.applied_work += (balance.weights + balance.forces) * dt;
        sums.load_work += forces.transmission.map_or(0.0, |found| found.load_power) * dt;
        sums.loss += balance.loss * dt;
        flowed += (balance.drive.abs() + balance.forces.abs() + balance.weights.abs()) * dt;
        sums.mean_drive += forces.drive * dt / duration;
        sums.rms_drive += forces.drive * forces.drive * dt / duration;
        for (sum, pair) in sums.pair_losses.iter_mut().zip(&forces.pairs) {
            *sum += pair.loss * dt;
        }
    }
    sums.rms_drive = sums.rms_drive.sqrt();
    // What should be zero is rounding of what flowed to and fro.
    for work in [
        &mut sums.drive_work,
        &mut sums.load_work,
        &mut sums.applied_work,
    ] {
        if work.abs() <= 1e-12 * flowed {
            *work = 0.0;
        }
    }
    // Over a cycle the driver and the applied forces together cover the loss.
    let put_in = sums.drive_work.max(0.0) + sums.applied_work.max(0.0);
    let whole = sums.closed && put_in > 0.0;
    let efficiency = 1.0 - sums.loss / put_in;
    let clear = efficiency > 1e-12;
    sums.efficiency = whole.then_some(if clear { efficiency.min(1.0) } else { 0.0 });
    Some(sums)
}
