//! Rigid linkages: solved once an evaluation, for inertia, forces and outputs.
//!
//! On its input coordinate q a linkage is one rigid body with the inertia J(q)
//! and the force −½·J′·q̇² − V′ + Q − D·q̇. This is Lagrange's equation with T = ½·J·q̇²,
//! the potential V of weights and springs, all other forces Q and the damping
//! D, each reduced to q.
//!
//! Its outputs are rigid nodes without inertia, and each is an object of its own in the model,
//! the results and the reports, `press.ram`. If the input is a free coordinate, the right-hand
//! side takes J, the forces and the outputs that drive something from polynomials (`table`).
//! Everything else, and positions near dead-centre positions, is solved once an evaluation.

mod table;

use super::frozen::Frozen;
use super::passes::{Extent, Work};
use super::scales::EDGE;
use crate::kinematics::linkage::{Linkage, ReducedLinkage, Workspace};
use crate::kinematics::position::linkage_reach;
use crate::math::jet::Jet;
use crate::math::quantity::Quantity;
use std::cell::{Cell, RefCell};
use std::sync::Arc;
use table::{Lanes, Table};

pub(super) use table::Cursor;

/// Weights count as nothing below this share of the greatest that they could be.
const NO_WEIGHT: f64 = 1e-12;

/// A linkage of the frozen layout.
#[derive(Clone, Debug)]
pub(super) struct FrozenLinkage {
    /// Internal index of the input node, whose displacement is q.
    pub(super) node: usize,
    /// The linkage.
    pub(super) linkage: Arc<Linkage>,
    /// Tables of what the right-hand side asks for.
    table: Option<Arc<Table>>,
}

impl FrozenLinkage {
    pub(super) fn new(node: usize, linkage: &Arc<Linkage>) -> Self {
        Self {
            node,
            linkage: Arc::clone(linkage),
            table: None,
        }
    }

    /// Prepares it for equations of motion that ask for some of its outputs.
    pub(super) fn tabulate(&mut self, outputs: &[usize]) {
        self.table = Table::new(&self.linkage, outputs).map(Arc::new);
    }
}

/// The output of a linkage that a law is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct OutputPlace {
    /// Index into [`Frozen::linkages`].
    pub(super) linkage: usize,
    /// Index of the output.
    pub(super) output: usize,
}

/// A linkage as it was last solved.
#[derive(Clone, Debug)]
pub(super) struct LinkageState {
    linkage: Arc<Linkage>,
    workspace: Workspace,
    /// Input coordinate at which it is solved; not a number: nowhere yet.
    place: f64,
    /// Highest derivative that is solved for.
    order: usize,
    /// Whether it can be assembled there.
    assembled: bool,
    reduced: Option<ReducedLinkage>,
}

impl LinkageState {
    fn new(linkage: &Arc<Linkage>) -> Self {
        Self {
            linkage: Arc::clone(linkage),
            workspace: linkage.workspace(),
            place: f64::NAN,
            order: 0,
            assembled: false,
            reduced: None,
        }
    }

    /// Solves it at `q` unless that was done last.
    #[inline]
    fn solve_at(&mut self, q: f64, order: usize) {
        if q == self.place && order <= self.order {
            return;
        }
        self.assembled = self.linkage.solve(q, order, &mut self.workspace).is_ok();
        (self.place, self.order, self.reduced) = (q, order, None);
    }

    /// The linkage at `q`, its derivatives up to `order`; `None` where it cannot be
    /// assembled.
    pub(super) fn place_linkage(&mut self, q: f64, order: usize) -> Option<&Workspace> {
        self.solve_at(q, order);
        self.assembled.then_some(&self.workspace)
    }

    fn output(&mut self, output: usize, q: f64, order: usize) -> Jet {
        self.solve_at(q, order);
        match self.assembled {
            true => self.linkage.output(output, &self.workspace),
            false => Jet::UNKNOWN,
        }
    }

    /// Force magnitudes that it takes at its input for a motion q, q̇, q̈; 0
    /// where it cannot be assembled, and near there, where they grow beyond all
    /// bounds.
    pub(super) fn magnitude(&mut self, [q, rate, acceleration]: [f64; 3]) -> f64 {
        if let Some((low, high)) = linkage_reach(&self.linkage) {
            let margin = EDGE * (high - low);
            if !(low + margin <= q && q <= high - margin) {
                return 0.0;
            }
        }
        let Some(reduced) = self.reduced_linkage(q, 2).filter(|_| q.is_finite()) else {
            return 0.0;
        };
        let [inertia, slope, _] = reduced.inertia;
        // Weights across the motion leave rounding, which is no force.
        let weight = reduced.potential[1];
        let rounding = NO_WEIGHT * self.greatest_weight();
        let parts = [
            inertia * acceleration + 0.5 * slope * rate * rate,
            if weight.abs() <= rounding {
                0.0
            } else {
                weight
            },
            reduced.force[0],
            reduced.damping[0] * rate,
        ];
        let sum: f64 = parts.iter().map(|part| part.abs()).sum();
        if sum.is_finite() { sum } else { 0.0 }
    }

    /// Moment (or force) of the weights at the input if all of them acted along the
    /// motion.
    fn greatest_weight(&self) -> f64 {
        let spec = self.linkage.spec();
        let [gx, gy] = spec.gravity;
        let links = spec.links.iter().enumerate().map(|(index, link)| {
            let [x, y, turning] = self.workspace.transfer(index, 1);
            let arm = link.centre[0].hypot(link.centre[1]);
            link.mass * (x.hypot(y) + arm * turning.abs())
        });
        links.sum::<f64>() * gx.hypot(gy)
    }

    /// `None` where it cannot be assembled.
    fn reduced_linkage(&mut self, q: f64, order: usize) -> Option<ReducedLinkage> {
        self.solve_at(q, order);
        if self.assembled && self.reduced.is_none() {
            self.reduced = Some(self.linkage.reduced_linkage(&self.workspace));
        }
        self.reduced
    }
}

/// J, J′, W and D at a place, and, where the numbers ask for them, their slopes.
#[inline(always)]
fn lanes<N: Quantity>(table: &Table, q: f64, cursor: &Cell<Cursor>) -> Option<[Lanes; 2]> {
    let place = table.place_of_input(q, cursor)?;
    let slopes = match N::DERIVATIVES > 2 {
        true => table.slopes(place),
        false => [0.0; 4],
    };
    Some([table.values(place), slopes])
}

#[inline(always)]
fn jet_of([value, first, second]: [f64; 3]) -> Jet {
    Jet {
        value,
        first,
        second,
        third: 0.0,
    }
}

fn with_slope([value, slope]: [f64; 2]) -> [f64; 3] {
    [value, slope, 0.0]
}

/// One of the four with its slope, as far as the numbers ask for it.
#[inline(always)]
fn value_with_slope<N: Quantity>(q: N, at: &impl Fn(f64) -> [Lanes; 2], index: usize) -> N {
    let [number, ..] = q.lift(|place| {
        let [values, slopes] = at(place);
        jet_of([values[index], slopes[index], 0.0])
    });
    number
}

/// A linkage reduced to its input coordinate, at an instant.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reduction<N> {
    /// J.
    pub(super) inertia: N,
    /// ½·J′·q̇².
    pub(super) bias: N,
    /// V.
    pub(super) potential: N,
    /// −V′, what weights and springs do.
    pub(super) conservative: N,
    /// Q, what all other forces do.
    pub(super) applied: N,
    /// −D·q̇.
    pub(super) damping: N,
}

impl<N: Quantity> Reduction<N> {
    /// All forces on the input coordinate but those of accelerations.
    pub(super) fn force(&self) -> N {
        self.resting_force() + self.damping - self.bias
    }

    /// The forces that a linkage at rest feels.
    pub(super) fn resting_force(&self) -> N {
        self.conservative + self.applied
    }
}

impl Frozen {
    /// Memory for all linkages.
    pub(super) fn linkage_memory(&self) -> Vec<RefCell<LinkageState>> {
        let linkages = self.linkages.iter();
        linkages
            .map(|linkage| RefCell::new(LinkageState::new(&linkage.linkage)))
            .collect()
    }

    /// A linkage at the displacement and speed that its node has in `work`.
    pub(super) fn linkage<N: Quantity>(&self, index: usize, work: &Work<N>) -> Reduction<N> {
        let node = self.linkages[index].node;
        let (q, rate) = (work.displacement[node], work.speed[node]);
        let cell = &work.linkages[index];
        let of = |pick: fn(&ReducedLinkage) -> [f64; 3]| {
            q.lift(|q| {
                let reduced = cell.borrow_mut().reduced_linkage(q, N::DERIVATIVES);
                let [value, first, second] = reduced.as_ref().map_or([f64::NAN; 3], pick);
                Jet {
                    value,
                    first,
                    second,
                    third: 0.0,
                }
            })
        };
        let [inertia, slope, _] = of(|reduced| reduced.inertia);
        let [potential, gradient, _] = of(|reduced| reduced.potential);
        let [applied, ..] = of(|reduced| with_slope(reduced.force));
        let [damping, ..] = of(|reduced| with_slope(reduced.damping));
        Reduction {
            inertia,
            bias: (slope * rate * rate).scale(0.5),
            potential,
            conservative: -gradient,
            applied,
            damping: -(damping * rate),
        }
    }

    /// Inertia of a linkage, and all forces on its input but those of
    /// accelerations.
    #[inline(always)]
    pub(super) fn inertia_and_force<N: Quantity>(
        &self,
        index: usize,
        extent: Extent,
        work: &Work<N>,
    ) -> [N; 2] {
        let linkage = &self.linkages[index];
        let (q, rate) = (work.displacement[linkage.node], work.speed[linkage.node]);
        let cursor = &work.cursors[index];
        let Some(table) = linkage.table.as_ref().filter(|_| extent == Extent::Needed) else {
            return self.solved_inertia_and_force(index, work);
        };
        let Some(known) = lanes::<N>(table, q.value(), cursor) else {
            return self.solved_inertia_and_force(index, work);
        };
        let at = |place: f64| match place == q.value() {
            true => known,
            false => lanes::<N>(table, place, cursor).unwrap_or([[f64::NAN; 4]; 2]),
        };
        let [inertia, slope, _] = q.lift(|place| {
            let [values, slopes] = at(place);
            jet_of([values[0], values[1], slopes[1]])
        });
        let (force, damping) = (value_with_slope(q, &at, 2), value_with_slope(q, &at, 3));
        let moving = damping * rate + (slope * rate * rate).scale(0.5);
        [inertia, force - moving]
    }

    /// The same where no table knows it.
    #[cold]
    fn solved_inertia_and_force<N: Quantity>(&self, index: usize, work: &Work<N>) -> [N; 2] {
        let reduction = self.linkage(index, work);
        [reduction.inertia, reduction.force()]
    }

    /// V″ of a linkage.
    pub(super) fn potential_stiffness(&self, index: usize, work: &Work<f64>) -> f64 {
        let q = work.displacement[self.linkages[index].node];
        let reduced = work.linkages[index].borrow_mut().reduced_linkage(q, 2);
        reduced.map_or(0.0, |reduced| reduced.potential[2])
    }

    /// U, U′ and U″ of an output at the displacement of its linkage's node.
    #[inline]
    pub(super) fn output<N: Quantity>(
        &self,
        place: OutputPlace,
        extent: Extent,
        work: &Work<N>,
    ) -> [N; 3] {
        let OutputPlace { linkage, output } = place;
        let q = work.displacement[self.linkages[linkage].node];
        let (cell, cursor) = (&work.linkages[linkage], &work.cursors[linkage]);
        let solved = |q: f64| cell.borrow_mut().output(output, q, N::DERIVATIVES);
        let table = self.linkages[linkage].table.as_ref();
        match table.filter(|table| extent == Extent::Needed && table.knows(output)) {
            Some(table) => q.lift(|q| {
                let place = table.place_of_input(q, cursor);
                let known = place.and_then(|place| table.output(output, place));
                known.unwrap_or_else(|| solved(q))
            }),
            None => q.lift(solved),
        }
    }

    /// Inertia of every node by itself: its own, or that of its linkage.
    pub(super) fn own_masses<N: Quantity>(&self, extent: Extent, work: &mut Work<N>) {
        for (mass, &inertia) in work.mass.iter_mut().zip(&self.inertia) {
            *mass = N::from(inertia);
        }
        for index in 0..self.linkages.len() {
            // The right-hand side has just asked for both.
            let inertia = match extent {
                Extent::Needed => work.reduced_inertia[index],
                Extent::Full => self.inertia_and_force(index, extent, work)[0],
            };
            work.mass[self.linkages[index].node] += inertia;
        }
    }

    /// Adds what the linkages do on their input coordinates.
    pub(super) fn apply_linkages<N: Quantity>(&self, extent: Extent, work: &mut Work<N>) {
        for index in 0..self.linkages.len() {
            let [inertia, force] = self.inertia_and_force(index, extent, work);
            work.reduced_inertia[index] = inertia;
            work.force[self.linkages[index].node] += force;
        }
    }
}
