//! The forces of contacts at rest within an evaluation.

use super::{DryContact, Source};
use crate::dynamics::system::frozen::Frozen;
use crate::dynamics::system::passes::{Extent, Work};
use crate::math::quantity::Quantity;

/// Share of the greatest diagonal that is added to it where several contacts are decided
/// together, and rounds of refinement, which leave no error of it. With weights of their limits
/// and ratios, contacts that hold the same motion share the force in the proportion of their limits.
const SHARED: f64 = 1e-8;
const REFINED: usize = 8;

/// Working arrays of dry contacts (m).
#[derive(Clone, Debug)]
pub(in crate::dynamics::system) struct DryWork<N> {
    /// Of every contact ∂w/∂(speed of each ancestor).
    pub(super) rates: Vec<Vec<N>>,
    /// Numbers of the contacts that are held.
    pub(super) held: Vec<usize>,
    /// D·A·D of these with D their weights, then its factors (m × m).
    matrix: Vec<N>,
    /// A·D of these, as it is (m × m).
    plain: Vec<N>,
    /// Accelerations that are left, and shares of the limits (m).
    pub(super) left: Vec<N>,
    rest: Vec<N>,
    turned: Vec<N>,
    /// True where forces of contacts at rest are in the present evaluation.
    exact: bool,
    /// Weights D of the contacts that are held (m).
    weights: Vec<f64>,
    pub(super) share: Vec<N>,
}

impl<N: Quantity> DryWork<N> {
    pub(in crate::dynamics::system) fn new(frozen: &Frozen) -> Self {
        let zero = N::from(0.0);
        let count = frozen.dry.len();
        let rates = |contact: &DryContact| vec![zero; contact.ancestors.len()];
        Self {
            rates: frozen.dry.iter().map(rates).collect(),
            held: Vec::with_capacity(count),
            matrix: vec![zero; count * count],
            plain: vec![zero; count * count],
            left: vec![zero; count],
            rest: vec![zero; count],
            turned: vec![zero; count],
            exact: false,
            weights: vec![0.0; count],
            share: vec![zero; count],
        }
    }
}

/// Adds the forces of contacts at rest, so that their nodes stay at rest.
pub(in crate::dynamics::system) fn hold_all<N: Quantity>(
    frozen: &Frozen,
    state: &[N],
    modes: &[i64],
    extent: Extent,
    work: &mut Work<N>,
    out: &mut [N],
) {
    work.dry.held.clear();
    for (index, contact) in frozen.dry.iter().enumerate() {
        if contact.is_stuck(modes) {
            work.dry.held.push(index);
        }
    }
    if work.dry.held.is_empty() {
        return;
    }
    frozen.accelerate(state, extent, work, out);
    solve_held(frozen, work);
    for k in 0..work.dry.held.len() {
        let index = work.dry.held[k];
        let force = work.dry.share[k].scale(frozen.dry[index].friction.static_limit);
        push(frozen, index, force, work);
    }
    work.dry.exact = true;
}

/// Takes the rounding of the accelerations away with which contacts hold their own coordinates: a
/// body at rest does not creep.
pub(in crate::dynamics::system) fn stand_still<N: Quantity>(
    frozen: &Frozen,
    work: &mut Work<N>,
    out: &mut [N],
) {
    if !std::mem::take(&mut work.dry.exact) {
        return;
    }
    for k in 0..work.dry.held.len() {
        let contact = &frozen.dry[work.dry.held[k]];
        let Some(coordinate) = frozen.coordinate[contact.node] else {
            continue;
        };
        out[coordinate] -= work.acceleration[contact.node];
        work.acceleration[contact.node] = N::from(0.0);
    }
}

/// Adds a force on the node of a contact, and on all that moves it; needs its rates.
pub(super) fn push<N: Quantity>(frozen: &Frozen, index: usize, force: N, work: &mut Work<N>) {
    let contact = &frozen.dry[index];
    work.loads[contact.load] += force;
    for (ancestor, &rate) in contact.ancestors.iter().zip(&work.dry.rates[index]) {
        work.force[ancestor.node] += rate * force;
    }
}

/// The shares of their limits with which the contacts in `held` hold their nodes, the
/// accelerations without them being known.
pub(super) fn solve_held<N: Quantity>(frozen: &Frozen, work: &mut Work<N>) {
    let count = work.dry.held.len();
    for k in 0..count {
        find_rates(frozen, work.dry.held[k], work);
    }
    for k in 0..count {
        let contact = work.dry.held[k];
        let limit = frozen.dry[contact].friction.static_limit;
        let own = mobility(frozen, [contact, contact], work).value();
        work.dry.weights[k] = weight(limit, own);
    }
    for row in 0..count {
        let one = work.dry.held[row];
        for column in 0..count {
            let other = work.dry.held[column];
            let weight = work.dry.weights[column];
            work.dry.plain[row * count + column] =
                mobility(frozen, [one, other], work).scale(weight);
        }
        work.dry.left[row] = -work.acceleration[frozen.dry[one].node];
        work.dry.share[row] = N::from(0.0);
    }
    let together = factorise_held(frozen, count, work);
    for _ in 0..if together { REFINED } else { 1 } {
        refine(count, together, work);
    }
    for k in 0..count {
        // As shares of the limits.
        let limit = frozen.dry[work.dry.held[k]].friction.static_limit;
        work.dry.share[k] = work.dry.share[k].scale(work.dry.weights[k] / limit);
    }
}

/// Weight of a contact among those that hold the same motion, by the acceleration that a unit
/// force gives it: with it all have the same share of their limits, whatever their ratios.
pub(super) fn weight(limit: f64, mobility: f64) -> f64 {
    match mobility > 0.0 {
        true => (limit / mobility.sqrt()).sqrt(),
        false => limit.sqrt(),
    }
}

/// Factors of the matrix of the contacts that are held; whether several are decided together.
fn factorise_held<N: Quantity>(frozen: &Frozen, count: usize, work: &mut Work<N>) -> bool {
    let DryWork {
        held,
        matrix,
        plain,
        weights,
        ..
    } = &mut work.dry;
    let mut together = false;
    for row in 0..count {
        // The greatest diagonal among those that are decided together with it.
        let (mut greatest, mut alone) = (0.0f64, true);
        for other in 0..count {
            if frozen.dry[held[other]].set == frozen.dry[held[row]].set {
                let diagonal = weights[other] * plain[other * count + other].value();
                greatest = greatest.max(diagonal);
                alone &= other == row;
            }
        }
        for column in 0..count {
            matrix[row * count + column] = plain[row * count + column].scale(weights[row]);
        }
        if !alone {
            matrix[row * count + row] += N::from(SHARED * greatest);
            together = true;
        }
    }
    eliminate(matrix, count);
    together
}

/// One round of refinement of the shares. Of contacts that hold the same motion the equations
/// leave it open how they share the force: K·(K + ε)⁻² in place of (K + ε)⁻¹ keeps the rounding of
/// what is left open from growing by 1/ε.
fn refine<N: Quantity>(count: usize, together: bool, work: &mut Work<N>) {
    let DryWork {
        matrix,
        plain,
        weights,
        left,
        rest,
        turned,
        share,
        ..
    } = &mut work.dry;
    for row in 0..count {
        // What is left of the acceleration, weighted.
        let mut sum = left[row];
        for column in 0..count {
            sum += -(plain[row * count + column] * share[column]);
        }
        rest[row] = sum.scale(weights[row]);
    }
    substitute(matrix, &mut rest[..count]);
    if together {
        substitute(matrix, &mut rest[..count]);
        for row in 0..count {
            let mut sum = N::from(0.0);
            for column in 0..count {
                sum += plain[row * count + column] * rest[column];
            }
            turned[row] = sum.scale(weights[row]);
        }
        rest[..count].copy_from_slice(&turned[..count]);
    }
    for (share, &change) in share.iter_mut().zip(&rest[..count]) {
        *share += change;
    }
}

/// ∂w/∂(speed of each ancestor) of a contact, at the motion that is in `work`.
pub(super) fn find_rates<N: Quantity>(frozen: &Frozen, index: usize, work: &mut Work<N>) {
    let contact = &frozen.dry[index];
    let mut rates = std::mem::take(&mut work.dry.rates[index]);
    rates.fill(N::from(0.0));
    rates[0] = N::from(1.0);
    for (place, ancestor) in contact.ancestors.iter().enumerate() {
        let own = rates[place];
        match &ancestor.source {
            Source::Root { .. } => {}
            Source::Law { law, driver } => rates[*driver] += work.laws[*law].first * own,
            Source::Constraint { index, drivers } => {
                let first = &work.constraints[*index].first;
                for (&driver, &first) in drivers.iter().zip(first) {
                    rates[driver] += first * own;
                }
            }
        }
    }
    work.dry.rates[index] = rates;
}

/// Acceleration of the node of one contact by a unit force on that of another.
pub(super) fn mobility<N: Quantity>(
    frozen: &Frozen,
    [one, other]: [usize; 2],
    work: &Work<N>,
) -> N {
    let mut sum = N::from(0.0);
    if frozen.dry[one].set != frozen.dry[other].set {
        return sum;
    }
    for own in frozen.dry[one].free_roots() {
        let root = frozen.dry[one].ancestors[own].node;
        for its in frozen.dry[other].free_roots() {
            if frozen.dry[other].ancestors[its].node == root {
                let rates = work.dry.rates[one][own] * work.dry.rates[other][its];
                sum += rates / root_mass(frozen, root, work);
            }
        }
    }
    sum
}

/// Inertia of a free node with all that follows it rigidly.
pub(super) fn root_mass<N: Quantity>(frozen: &Frozen, root: usize, work: &Work<N>) -> N {
    match frozen.rigids.is_empty() && frozen.constraints.is_empty() {
        true => N::from(frozen.inertia[root]),
        false => work.mass[root],
    }
}

/// L·D·Lᵀ of a symmetric positive matrix, in its lower half.
fn eliminate<N: Quantity>(matrix: &mut [N], count: usize) {
    for pivot in 0..count {
        for row in pivot + 1..count {
            let factor = matrix[row * count + pivot] / matrix[pivot * count + pivot];
            for column in pivot + 1..=row {
                let entry = matrix[column * count + pivot];
                matrix[row * count + column] += -(factor * entry);
            }
        }
        for row in pivot + 1..count {
            let factor = matrix[row * count + pivot] / matrix[pivot * count + pivot];
            matrix[row * count + pivot] = factor;
        }
    }
}

/// Solves with the factors of [`eliminate`].
fn substitute<N: Quantity>(factors: &[N], right: &mut [N]) {
    let count = right.len();
    for row in 0..count {
        for column in 0..row {
            right[row] -= factors[row * count + column] * right[column];
        }
    }
    for row in (0..count).rev() {
        right[row] = right[row] / factors[row * count + row];
        for below in row + 1..count {
            right[row] -= factors[below * count + row] * right[below];
        }
    }
}
