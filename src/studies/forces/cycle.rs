//! Work, losses and efficiency over a course.

use super::row::{Forces, Row, Solver};
use super::scan::table_places;
use super::{Course, PositionSource};
use crate::math::quadrature::Integrals;
use serde::Serialize;

/// Error of a sum that a panel may have, as a share of what flows to and fro.
const AGREES: f64 = 1e-13;
/// What should be zero is rounding below this share of what flows to and fro.
const NO_FLOW: f64 = 1e-10;
/// Evaluations for each interval of the course, all in all: some hundreds are
/// needed for a place where friction changes its direction.
const EVALUATIONS: usize = 100;
/// Evaluations that short courses may use as well.
const AT_LEAST: usize = 20_000;

/// Sums over a course.
#[derive(Clone, Debug, PartialEq, Serialize)]
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
    #[serde(skip)]
    pub pair_losses: Vec<f64>,
    /// 1 − loss over the work put in by the driver and by all that is applied
    /// ([`Self::applied_work`]), each if it puts in any over the whole course;
    /// `None` where nothing is put in or the
    /// course is no cycle.
    pub efficiency: Option<f64>,
    /// Mean driving force over time (N·m or N).
    pub mean_drive: f64,
    /// Root mean square of the driving force over time (N·m or N).
    pub rms_drive: f64,
}

/// Integrands before those of the pairs' losses.
const COMMON: usize = 6;

/// Integrands at a position: powers, driving force and its square, then the power lost in
/// each pair.
fn integrands(forces: &Forces, out: &mut [f64]) {
    let balance = &forces.balance;
    out[..COMMON].copy_from_slice(&[
        balance.drive,
        balance.weights + balance.forces,
        forces.transmission.map_or(0.0, |found| found.load_power),
        balance.loss,
        forces.drive,
        forces.drive * forces.drive,
    ]);
    for (loss, pair) in out[COMMON..].iter_mut().zip(&forces.pairs) {
        *loss = pair.loss;
    }
}

/// Power that flows to and fro at a position, and the size of the driving force.
fn sizes(forces: &Forces) -> [f64; 2] {
    let balance = &forces.balance;
    let flow = balance.drive.abs() + balance.forces.abs() + balance.weights.abs() + balance.loss;
    [flow, forces.drive.abs()]
}

/// Panels that end at the points of tables of forces, which may be narrower.
fn cut_at_tables<S: PositionSource>(
    solver: &Solver<'_, S>,
    course: &Course,
    panels: Vec<[f64; 2]>,
) -> Vec<[f64; 2]> {
    let cut = |[from, to]: [f64; 2]| {
        let mut ends = table_places(solver, course, &[from.min(to), from.max(to)]);
        ends.extend([from, to]);
        ends.sort_by(f64::total_cmp);
        ends.dedup();
        let parts: Vec<[f64; 2]> = ends.windows(2).map(|pair| [pair[0], pair[1]]).collect();
        parts
    };
    panels.into_iter().flat_map(cut).collect()
}

/// Sums up a course: integrals over time, between the positions too, so that
/// what jumps on the way is taken on either side as it is there.
pub(super) fn sum<S: PositionSource>(
    solver: &mut Solver<'_, S>,
    course: &Course,
    rows: &[Row],
) -> Option<CycleForces> {
    let (panels, pace) = course.panels()?;
    let panels = cut_at_tables(solver, course, panels);
    let duration = panels
        .iter()
        .map(|[from, to]| (to - from).abs())
        .sum::<f64>()
        * pace;
    let mut greatest = [0.0f64; 2];
    for row in rows {
        let here = sizes(row.forces.as_ref().ok()?);
        greatest = [0, 1].map(|k| greatest[k].max(here[k]));
    }
    let [flow, drive] = greatest;
    // Over the parameter of the course, which is not always the time.
    let bound = |size: f64| AGREES * size * duration / pace;
    let mut bounds = vec![bound(flow); COMMON + solver.kinetostatics().spec().pairs.len()];
    (bounds[4], bounds[5]) = (bound(drive), bound(drive * drive));
    let mut integrals = Integrals::new(bounds, AT_LEAST + EVALUATIONS * panels.len());
    for [from, to] in panels {
        integrals.add([from.min(to), from.max(to)], |place, out| {
            let row = solver.row(&course.instant_at(place), false);
            integrands(row.forces.as_ref().ok()?, out);
            Some(())
        })?;
    }
    let sums: Vec<f64> = integrals.sums.iter().map(|sum| sum * pace).collect();
    let clean = |sum: f64, size: f64| {
        if sum.abs() <= NO_FLOW * size {
            0.0
        } else {
            sum
        }
    };
    let [drive_work, applied_work, load_work] = [0, 1, 2].map(|k| clean(sums[k], flow * duration));
    let (loss, closed) = (sums[3], course.is_closed());
    // Over a cycle the driver and the applied forces together cover the loss.
    let put_in = drive_work.max(0.0) + applied_work.max(0.0);
    let efficiency = (closed && put_in > 0.0).then(|| clean(1.0 - loss / put_in, 1.0));
    Some(CycleForces {
        closed,
        duration,
        drive_work,
        load_work,
        applied_work,
        loss,
        pair_losses: sums[COMMON..].to_vec(),
        efficiency: efficiency.map(|share| share.clamp(0.0, 1.0)),
        mean_drive: clean(sums[4] / duration, drive),
        rms_drive: (sums[5] / duration).sqrt(),
    })
}
