//! The map of a tree that is propagated exactly.

use super::{Map, Orbit, derivative_by_differences};
use crate::budget::Budget;
use crate::exact::{Cursor, ExactRun, ExactTree, Halt, PairState, Part, Request, TreeProblem};
use crate::units::shown;
use nalgebra::DMatrix;

/// A tree that is propagated exactly; its state is q, then q̇ of every mass.
#[derive(Debug)]
pub(in crate::studies::steady) struct TreeMap<'a> {
    part: &'a Part,
    budget: Budget<'a>,
    scales: Vec<f64>,
}

impl<'a> TreeMap<'a> {
    /// The map of a tree; sizes are those met in a period from a state.
    pub(in crate::studies::steady) fn new(
        part: &'a Part,
        state: &[f64],
        period: f64,
        budget: Budget<'a>,
    ) -> Result<Self, String> {
        let n = part.problem().masses.len();
        let tree = part.tree_at(&state[..n], &state[n..]);
        let request = Request {
            all_masses: true,
            ..request(period, 256)
        };
        let run = run_to_end(&tree, &request, &budget)?;
        let mut scales: Vec<f64> = state.iter().map(|entry| entry.abs()).collect();
        for row in run.samples.chunks_exact(2 * n) {
            for (scale, value) in scales.iter_mut().zip(row) {
                *scale = scale.max(value.abs());
            }
        }
        scales
            .iter_mut()
            .for_each(|scale| *scale = scale.max(1e-12));
        Ok(Self {
            part,
            budget,
            scales,
        })
    }

    fn masses(&self) -> usize {
        self.part.problem().masses.len()
    }
}

impl Map for TreeMap<'_> {
    fn apply(&self, state: &[f64], time: f64) -> Result<Vec<f64>, String> {
        let n = self.masses();
        let tree = self.part.tree_at(&state[..n], &state[n..]);
        let run = run_to_end(&tree, &request(time, 0), &self.budget)?;
        Ok(run.displacement.into_iter().chain(run.speed).collect())
    }

    fn monodromy(&self, state: &[f64], time: f64) -> Result<DMatrix<f64>, String> {
        let n = self.masses();
        let tree = self.part.tree_at(&state[..n], &state[n..]);
        let problem = tree.problem();
        let goes_on = || !self.budget.is_spent();
        let mut cursor = Cursor::of(&tree, &Request::new(time, 0), &goes_on)
            .map_err(|refusal| refusal.reason)?;
        let mut product = DMatrix::identity(2 * n, 2 * n);
        while cursor.next_phase().map_err(|refusal| refusal.reason)? {
            if cursor.counts().0 > MOST_STEPS {
                return Err(crawling(cursor.time()));
            }
            let phase = (rates(problem, cursor.states()) * cursor.length()).exp();
            product = phase * product;
            if let Some(switch) = cursor.switch()
                && (switch.before, switch.after.engaged()) == (PairState::Free, true)
            {
                impact(problem, switch.mass, &mut product);
            }
        }
        if let Some(spent) = self.budget.spent() {
            return Err(spent.to_string());
        }
        match product.iter().all(|entry| entry.is_finite()) {
            true => Ok(product),
            false => Err("the derivative of the motion is no finite number".to_owned()),
        }
    }

    fn orbit(&self, state: &[f64], time: f64, count: usize) -> Result<Orbit, String> {
        let n = self.masses();
        let tree = self.part.tree_at(&state[..n], &state[n..]);
        let request = Request {
            all_masses: true,
            ..request(time, count)
        };
        let run = run_to_end(&tree, &request, &self.budget)?;
        let column = |mass: usize| {
            run.samples
                .iter()
                .skip(mass)
                .step_by(2 * n)
                .copied()
                .collect()
        };
        Ok(Orbit::with_equal_steps(
            time,
            count,
            (0..n).map(column).collect(),
        ))
    }

    fn scales(&self) -> &[f64] {
        &self.scales
    }

    fn derivative_method(&self) -> &'static str {
        "exact propagation of the variations through every event"
    }

    fn check(&self, state: &[f64], time: f64) -> Result<DMatrix<f64>, String> {
        derivative_by_differences(self, state, time)
    }

    fn derivative_check(&self) -> &'static str {
        "central differences of the motion, extrapolated from two steps"
    }
}

/// Most phases, and most steps of the search for switches, of a map: a mode that
/// vibrates so often in a turn would be followed for hours.
const MOST_STEPS: u64 = 1_000_000;

fn request(end: f64, samples: usize) -> Request {
    Request {
        all_steps: MOST_STEPS,
        ..Request::new(end, samples)
    }
}

/// A run to its end.
fn run_to_end(
    tree: &ExactTree,
    request: &Request,
    budget: &Budget<'_>,
) -> Result<ExactRun, String> {
    let run = tree
        .run_while(request, &|| !budget.is_spent())
        .map_err(|refusal| refusal.reason)?;
    if let Some(spent) = budget.spent() {
        return Err(spent.to_string());
    }
    match run.halt {
        None => Ok(run),
        Some(Halt::Switches) => Err(format!("too many events before t = {} s", run.time)),
        Some(Halt::Steps | Halt::Cancelled) => Err(crawling(run.time)),
    }
}

fn crawling(time: f64) -> String {
    format!(
        "its fastest mode makes exact propagation slow: after {MOST_STEPS} steps it is at t = {} s",
        shown(time, 7)
    )
}

/// The matrix of the variations between switches: (δq, δq̇)′ = A·(δq, δq̇).
fn rates(problem: &TreeProblem, states: &[PairState]) -> DMatrix<f64> {
    let n = problem.masses.len();
    let mut rates = DMatrix::zeros(2 * n, 2 * n);
    for (i, mass) in problem.masses.iter().enumerate() {
        rates[(i, n + i)] = 1.0;
        rates[(n + i, i)] -= mass.ground_stiffness / mass.inertia;
        rates[(n + i, n + i)] -= mass.ground_damping / mass.inertia;
        let bilateral = mass.pair.flanks().1 == 0;
        if bilateral || states[i].engaged() {
            link(problem, i, [mass.stiffness, mass.damping], n, &mut rates);
        }
    }
    rates
}

/// Adds the force of a link, c·x + b·ẋ with x = q − lever·q_parent.
fn link(
    problem: &TreeProblem,
    i: usize,
    [stiffness, damping]: [f64; 2],
    n: usize,
    rates: &mut DMatrix<f64>,
) {
    let mass = &problem.masses[i];
    let ends: [Option<(usize, f64)>; 2] = [
        Some((i, 1.0)),
        mass.parent.map(|parent| (parent, -mass.lever)),
    ];
    for (row, weight) in ends.into_iter().flatten() {
        let factor = weight / problem.masses[row].inertia;
        for (column, share) in ends.into_iter().flatten() {
            rates[(n + row, column)] -= factor * stiffness * share;
            rates[(n + row, n + column)] -= factor * damping * share;
        }
    }
}

/// A free mass meets a flank: its damper's force sets in at once, so that a
/// variation that arrives earlier by δt feels it for δt longer. (All other
/// switches happen at zero force and leave variations as they are.) The speed
/// of approach cancels: δq̇ changes by −(b/J)·δx.
fn impact(problem: &TreeProblem, i: usize, product: &mut DMatrix<f64>) {
    let n = problem.masses.len();
    let mass = &problem.masses[i];
    let mut jump = DMatrix::zeros(2 * n, 2 * n);
    link(problem, i, [mass.damping, 0.0], n, &mut jump);
    *product += &jump * &*product;
}
