//! Forces and couples in welds.
//!
//! Three unknowns a weld, behind those of the couplings: the force on the second link along x and y of
//! the ground, and the couple about the weld's point.

use super::Kinetostatics;
use super::couplings::add_on_frame;
use super::place::frame;
use super::positions::{LinkPosition, PointPosition};
use super::workspace::ForceWorkspace;
use crate::kinematics::linkage::joints::Act;

/// What a weld carries, on link j from link i.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WeldForce {
    /// The weld's point (m).
    pub point: [f64; 2],
    /// Force in the frame of the ground (N).
    pub force: [f64; 2],
    /// Couple about the point, counterclockwise (N·m).
    pub couple: f64,
}

impl Kinetostatics {
    /// What a weld carries at the position solved last.
    pub fn weld_force(&self, weld: usize, w: &ForceWorkspace) -> WeldForce {
        let first = self.first_of_weld(weld);
        WeldForce {
            point: self.weld_point(weld, &w.links),
            force: [w.unknowns[first], w.unknowns[first + 1]],
            couple: self.length * w.unknowns[first + 2],
        }
    }

    /// Place of a weld's first unknown.
    pub(super) fn first_of_weld(&self, weld: usize) -> usize {
        2 * self.spec.pairs.len() + self.spec.couplings.len() + 3 * weld
    }

    /// Rows of a unit of each unknown of a weld, counted 0 to 2.
    pub(super) fn each_weld_entry(
        &self,
        weld: usize,
        (links, centres): (&[LinkPosition], &[PointPosition]),
        mut add: impl FnMut(usize, usize, f64),
    ) {
        let spec = &self.spec.welds[weld];
        let at = self.weld_point(weld, links);
        let couple = Act {
            at,
            couple: self.length,
            ..Act::default()
        };
        let units = [
            Act::force(at, [1.0, 0.0]),
            Act::force(at, [0.0, 1.0]),
            couple,
        ];
        for (which, unit) in units.iter().enumerate() {
            for (link, sign) in [(spec.link.link, 1.0), (spec.on.link, -1.0)] {
                let entry = |row, value| add(row, which, value);
                self.each_row_on(link, &unit.times(sign), centres, entry);
            }
        }
    }

    /// Adds what welds exert on the ground: force (N) and moment about its origin (N·m).
    pub(super) fn add_welds_on_frame(&self, w: &ForceWorkspace, sum: &mut [f64; 3]) {
        for (index, weld) in self.spec.welds.iter().enumerate() {
            let sign = match (weld.on.link, weld.link.link) {
                (None, Some(_)) => -1.0,
                (Some(_), None) => 1.0,
                _ => continue,
            };
            let found = self.weld_force(index, w);
            let act = Act {
                at: found.point,
                force: found.force,
                couple: found.couple,
            };
            add_on_frame(&act, sign, sum);
        }
    }

    fn weld_point(&self, weld: usize, links: &[LinkPosition]) -> [f64; 2] {
        let end = self.spec.welds[weld].link;
        frame(links, end.link).point(end.at).place
    }
}
