//! `dam` itself, by exact propagation.

use crate::chain::{AMPLITUDE, Chain, FREQUENCY};
use crate::solution::Solution;
use dam::exact::{
    ExactRun, ExactTree, Law, Request, Sine, TimeLoad, TreeMass, TreeObject, TreePair, TreeProblem,
};

/// The chain as `dam` has it.
pub(crate) fn tree(chain: &Chain) -> ExactTree {
    let last = chain.masses - 1;
    let mass = |m: usize| {
        TreeMass::new(
            chain.inertia[m],
            m.checked_sub(1),
            chain.stiffness[m],
            chain.damping[m],
        )
    };
    let mut masses: Vec<TreeMass> = (0..=last).map(mass).collect();
    masses[0].pair = TreePair::Force { opens: 1.0 };
    masses[last].loads.push(TimeLoad::Constant(-chain.load));
    let sine = Sine {
        amplitude: AMPLITUDE,
        frequency: FREQUENCY,
        phase: 0.0,
    };
    ExactTree::new(TreeProblem {
        displacement: vec![0.0; masses.len()],
        speed: vec![0.0; masses.len()],
        masses,
        law: Law::Harmonic {
            mean: 0.0,
            slope: 0.0,
            sines: vec![sine],
        },
        objects: vec![TreeObject {
            first: 0,
            output: vec![(last, 1.0)],
            driver: None,
        }],
    })
}

/// Runs it.
///
/// # Errors
/// Why it cannot be propagated exactly.
pub(crate) fn run(tree: &ExactTree, request: &Request) -> Result<ExactRun, String> {
    let run = tree.run(request).map_err(|refusal| refusal.reason)?;
    if !run.complete {
        return Err(format!("ended at {} s", run.time));
    }
    Ok(run)
}

/// Solves for `samples` samples.
///
/// # Errors
/// See [`run`].
pub(crate) fn solve(chain: &Chain, samples: usize) -> Result<Solution, String> {
    let run = run(&tree(chain), &Request::new(chain.duration, samples))?;
    Ok(Solution {
        samples: run.samples,
        switches: Some(run.switches.len()),
        steps: run.phases,
        ..Solution::default()
    })
}
