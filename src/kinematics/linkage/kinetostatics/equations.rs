//! Equilibrium of the links: W·F = B − P − T, three rows a link.
//!
//! Unknowns F: two of every pair, one of every coupling, three of every weld, and the
//! driver's force. Rows: forces along x
//! and y, moment about the centre of mass. Moments are divided by the length
//! scale ℓ of the linkage, so that all entries are of the order of one and all
//! unknowns are forces.

use super::external::{Input, Wrench, wrenches};
use super::positions::{LinkPosition, PointPosition};
use super::workspace::{ForceWorkspace, PairPlace};
use super::{Kinetostatics, Unknown};
use crate::kinematics::linkage::joints::Act;
use crate::kinematics::linkage::multi::spec::InputCoordinate;

impl Kinetostatics {
    /// Writes W and factorises it; false if it is singular.
    pub(super) fn factorise(&self, unknown: Unknown, w: &mut ForceWorkspace) -> bool {
        let size = self.equations_count();
        w.factors.clear(size);
        for index in 0..self.spec.pairs.len() {
            for (which, wrench) in self
                .reactions(index, &w.pairs[index])
                .into_iter()
                .enumerate()
            {
                let column = 2 * index + which;
                self.each_row(index, &wrench, &w.centres, |row, value| {
                    w.factors.add(row, column, value);
                });
            }
        }
        for coupling in 0..self.spec.couplings.len() {
            let column = 2 * self.spec.pairs.len() + coupling;
            let places = (w.links.as_slice(), w.centres.as_slice());
            self.each_coupling_row(coupling, places, |row, value| {
                w.factors.add(row, column, value);
            });
        }
        for weld in 0..self.spec.welds.len() {
            let first = self.first_of_weld(weld);
            let places = (w.links.as_slice(), w.centres.as_slice());
            self.each_weld_entry(weld, places, |row, which, value| {
                w.factors.add(row, first + which, value);
            });
        }
        match unknown {
            Unknown::Drive => {
                let first = size - self.drivers.len();
                for (k, &driver) in self.drivers.iter().enumerate() {
                    let places = (w.pairs.as_slice(), w.links.as_slice(), w.centres.as_slice());
                    self.each_drive_row(driver, places, |row, value| {
                        w.factors.add(row, first + k, value);
                    });
                }
            }
            Unknown::Acceleration => {
                for row in 0..size {
                    let inertia = self.inertia_row(row, w);
                    w.factors.add(row, size - 1, -inertia / self.inertia_scale);
                }
            }
            Unknown::Resistance { mobility, share } => {
                for row in 0..size {
                    let inertia = self.inertia_row(row, w);
                    let column = -inertia * mobility - w.drive_rows[row] * share;
                    w.factors.add(row, size - 1, column);
                }
            }
        }
        self.set_spare_unknowns(&mut w.factors);
        w.factors.factorise()
    }

    /// What a unit of each of the pair's two unknowns does.
    fn reactions(&self, index: usize, place: &PairPlace) -> [Act; 2] {
        match self.spec.pairs[index].slides() {
            false => [[1.0, 0.0], [0.0, 1.0]].map(|force| Act::force(place.point, force)),
            true => self.corners[index].map(|corner| {
                let [tx, ty] = place.tangent;
                let at = [place.point[0] + corner * tx, place.point[1] + corner * ty];
                Act::force(at, [-ty, tx])
            }),
        }
    }

    /// Rows of a unit of a driver's force: a couple of ℓ or a force along the guide between
    /// both links of its pair; of a link that floats, from the ground on its origin.
    fn each_drive_row(
        &self,
        driver: InputCoordinate,
        (pairs, links, centres): (&[PairPlace], &[LinkPosition], &[PointPosition]),
        add: impl FnMut(usize, f64),
    ) {
        let (link, force, couple) = match driver {
            InputCoordinate::Pair(pair) => {
                let place = &pairs[pair];
                let (force, couple) = match self.spec.pairs[pair].slides() {
                    false => ([0.0; 2], self.length),
                    true => (place.tangent, 0.0),
                };
                let at = place.point;
                return self.each_row(pair, &Act { at, force, couple }, centres, add);
            }
            InputCoordinate::X(link) => (link, [1.0, 0.0], 0.0),
            InputCoordinate::Y(link) => (link, [0.0, 1.0], 0.0),
            InputCoordinate::Angle(link) => (link, [0.0; 2], self.length),
        };
        let at = links[link].origin;
        self.each_row_on(Some(link), &Act { at, force, couple }, centres, add);
    }

    /// What a unit of each of the pair's frictions does: see [`mod@super::friction`].
    pub(super) fn frictions(&self, index: usize, place: &PairPlace) -> [Act; 2] {
        let couple = Act {
            at: place.point,
            force: [0.0; 2],
            couple: self.length,
        };
        match self.spec.pairs[index].slides() {
            false => [couple; 2],
            true => [Act::force(place.point, place.tangent), couple],
        }
    }

    /// Rows of a wrench between the two links of a pair.
    #[inline]
    pub(super) fn each_row(
        &self,
        pair: usize,
        act: &Act,
        centres: &[PointPosition],
        mut add: impl FnMut(usize, f64),
    ) {
        let pair = &self.spec.pairs[pair];
        self.each_row_on(pair.link.link, act, centres, &mut add);
        self.each_row_on(pair.on.link, &act.times(-1.0), centres, add);
    }

    /// Rows of what acts on a link.
    #[inline]
    pub(super) fn each_row_on(
        &self,
        link: Option<usize>,
        act: &Act,
        centres: &[PointPosition],
        mut add: impl FnMut(usize, f64),
    ) {
        let Some(link) = link else { return };
        let [x, y, moment] = act.moment_and_force_about(centres[link].place);
        add(3 * link, x);
        add(3 * link + 1, y);
        add(3 * link + 2, moment / self.length);
    }

    /// B per unit of the input's acceleration: m·s, J·s/ℓ.
    #[inline]
    pub(super) fn inertia_row(&self, row: usize, w: &ForceWorkspace) -> f64 {
        let (link, axis) = (row / 3, row % 3);
        let Some(body) = self.spec.links.get(link) else {
            return 0.0;
        };
        let own = match axis {
            2 => body.moment * w.links[link].first[2] / self.length,
            axis => body.mass * w.centres[link].first[axis],
        };
        own + w.carried[0].get(row).unwrap_or(&0.0)
    }

    /// B at constant speed of the input, per its square.
    #[inline]
    pub(super) fn bias_row(&self, row: usize, w: &ForceWorkspace) -> f64 {
        let (link, axis) = (row / 3, row % 3);
        let Some(body) = self.spec.links.get(link) else {
            return 0.0;
        };
        let own = match axis {
            2 => body.moment * w.links[link].second[2] / self.length,
            axis => body.mass * w.centres[link].second[axis],
        };
        own + w.carried[1].get(row).unwrap_or(&0.0)
    }

    /// Writes −P, from weights and forces, and the generalised force of each.
    pub(super) fn apply_forces(&self, input: Input, w: &mut ForceWorkspace) {
        w.applied.fill(0.0);
        for index in 0..self.spec.links.len() {
            let weight = self.spec.gravity.map(|g| self.spec.links[index].mass * g);
            let centre = &w.centres[index].first;
            w.weights[index] = weight[0] * centre[0] + weight[1] * centre[1];
            w.applied[3 * index] += weight[0];
            w.applied[3 * index + 1] += weight[1];
        }
        for index in 0..self.spec.forces.len() {
            let law = &self.spec.forces[index].law;
            let pairs = &w.pairs;
            let found = wrenches(
                law,
                &w.links,
                input,
                |pair| [pairs[pair].coordinate, pairs[pair].rates[0]],
                |pair| {
                    let pair = &self.spec.pairs[pair];
                    [pair.on.link, pair.link.link]
                },
            );
            w.forces[index] = 0.0;
            for wrench in found.into_iter().flatten() {
                w.forces[index] += wrench.generalised(&w.links);
                self.add_wrench(&wrench, w);
            }
        }
        self.apply_output_loads(w);
    }

    /// Adds a wrench to P.
    pub(super) fn add_wrench(&self, wrench: &Wrench, w: &mut ForceWorkspace) {
        let applied = &mut w.applied;
        self.each_row_of(wrench, &w.centres, |row, value| applied[row] += value);
    }

    /// Rows of a wrench on one link.
    pub(super) fn each_row_of(
        &self,
        wrench: &Wrench,
        centres: &[PointPosition],
        add: impl FnMut(usize, f64),
    ) {
        let act = Act {
            at: wrench.point.place,
            force: wrench.force,
            couple: wrench.couple,
        };
        self.each_row_on(wrench.link, &act, centres, add);
    }

    /// The terms of friction at this position; `without` leaves them all out.
    pub(super) fn friction_terms(&self, with: bool, w: &mut ForceWorkspace) {
        w.terms.clear();
        w.columns = 0;
        if !with {
            return;
        }
        for index in 0..self.spec.pairs.len() {
            let sense = w.pairs[index].sense;
            if let Some(law) = self.friction_factors[index].filter(|_| sense != 0.0) {
                w.add_term(index, law.sliding(sense));
            }
        }
    }

    /// Solves for F₀ (first column of the right sides) and K (the others).
    pub(super) fn solve_columns(
        &self,
        right_side: impl Fn(usize, &ForceWorkspace) -> f64,
        w: &mut ForceWorkspace,
    ) {
        let (size, width) = (self.equations_count(), 1 + w.columns);
        w.right.clear();
        w.right.resize(size * width, 0.0);
        for row in 0..size {
            w.right[row * width] = right_side(row, w);
        }
        for term in &w.terms {
            let index = term.unknown / 2;
            let wrenches = self.frictions(index, &w.pairs[index]);
            for (which, wrench) in wrenches.iter().take(term.width()).enumerate() {
                let column = 1 + term.column + which;
                let right = &mut w.right;
                self.each_row(index, wrench, &w.centres, |row, value| {
                    right[row * width + column] += value;
                });
            }
        }
        w.factors.solve(&mut w.right, width);
    }

    /// Work of a row vector (dual to the rows of W) on a unit of each of a pair's frictions.
    pub(super) fn on_frictions(&self, index: usize, dual: &[f64], w: &ForceWorkspace) -> [f64; 2] {
        self.frictions(index, &w.pairs[index]).map(|wrench| {
            let mut sum = 0.0;
            self.each_row(index, &wrench, &w.centres, |row, value| {
                sum += dual[row] * value
            });
            sum
        })
    }

    /// Right side of the driver's force given: its rows per unit.
    pub(super) fn drive_rows(&self, w: &mut ForceWorkspace) {
        w.drive_rows.fill(0.0);
        let rows = &mut w.drive_rows;
        let places = (w.pairs.as_slice(), w.links.as_slice(), w.centres.as_slice());
        self.each_drive_row(self.drivers[0], places, |row, value| rows[row] += value);
    }
}
