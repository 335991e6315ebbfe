//! Positions at dead positions that end the reach: they have no forces.

use super::Course;
use super::row::{Row, Trouble};
use super::zones::{Zone, ZoneKind};
use crate::studies::endless::ROOM;

/// Takes the forces off the positions of a course at a dead position at its end towards which
/// they grow without bound: how great they are there tells how near to it the course ends.
pub(super) fn leave_out(rows: &mut [Row], course: &Course, zones: &[Zone]) {
    let Some([first, last]) = course.ends() else {
        return;
    };
    let near = ROOM * (last - first);
    let endless = |zone: &&Zone| zone.kind == ZoneKind::Dead && zone.unbounded != [false; 2];
    let ends = zones.iter().filter(endless).map(|zone| zone.from);
    let ends = ends.filter(|at| (at - first).abs() <= near || (at - last).abs() <= near);
    for at in ends {
        for (index, row) in rows.iter_mut().enumerate() {
            if (course.parameter(index) - at).abs() <= near {
                row.forces = Err(Trouble::EndOfReach);
            }
        }
    }
}
