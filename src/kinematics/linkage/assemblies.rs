//! All assemblies of a linkage at its start, whatever is said of them approximately.
//!
//! A linkage with redundant constraints may move in one of its assemblies alone, which nobody has
//! to describe well.

use super::assemble::{Assembly, angles_of, at_start};
use super::choice::{distance_from_choice, requested_branch};
use super::course::Branch;
use super::dyad::{Dyad, Form, Margin};
use super::examine::tolerance;
use super::guesses;
use super::plan::{Plan, Step};
use super::solve::surroundings_of_dyad;
use super::spec::{AssemblyChoice, AssemblySpec};
use super::state::State;

/// Most assemblies that are looked at.
const MOST: usize = 64;

/// The assemblies at the start that have the branches that were asked for, those first that are
/// nearest to all that is `said`; `solved` is what of it concerns what is solved.
pub(super) fn assemblies_at_start(
    plan: &Plan,
    start: f64,
    said: &[AssemblySpec],
    solved: &[AssemblySpec],
) -> Vec<Assembly> {
    let mut ways = vec![Assembly {
        state: at_start(plan, start),
        branches: Vec::new(),
    }];
    for (index, step) in plan.steps.iter().enumerate() {
        let choices: Vec<&AssemblySpec> = (solved.iter())
            .filter(|choice| step.bodies().iter().any(|body| body.has_link(choice.link)))
            .collect();
        let Ok(asked) = requested_branch(&choices) else {
            return Vec::new();
        };
        let on = ways.iter().flat_map(|way| match step {
            Step::Dyad(dyad) => of_dyad(plan, dyad, way, asked, index),
            Step::Newton(_) if asked.is_some() => Vec::new(),
            Step::Newton(group) => guesses::all_assemblies(plan, group, &way.state)
                .into_iter()
                .map(|(state, margin)| continued(way, state, step, index, (margin, 1.0)))
                .collect(),
        });
        ways = on.take(MOST).collect();
    }
    for way in &mut ways {
        plan.attach::<1>(&mut way.state);
    }
    let off = |way: &Assembly| -> f64 {
        let each = said.iter();
        each.map(|choice| distance_from_choice(choice, &way.state, plan.size))
            .sum()
    };
    ways.sort_by(|one, other| off(one).total_cmp(&off(other)));
    ways
}

/// True where a branch is asked for of a link that the driver alone places.
pub(super) fn asks_in_vain(plan: &Plan, solved: &[AssemblySpec]) -> bool {
    let placed = |link: usize| {
        let mut bodies = plan.steps.iter().flat_map(Step::bodies);
        bodies.any(|body| body.has_link(link))
    };
    let mut choices = solved.iter();
    choices.any(|one| matches!(one.choice, AssemblyChoice::Branch(_)) && !placed(one.link))
}

/// The assemblies of a dyad behind what is put together already.
fn of_dyad(
    plan: &Plan,
    dyad: &Dyad,
    way: &Assembly,
    asked: Option<f64>,
    index: usize,
) -> Vec<Assembly> {
    let around = surroundings_of_dyad::<1>(dyad, &way.state);
    let side = dyad.side_of_second_rail(&around);
    let margin = dyad.directions(&around, side, plan.size).margin;
    if !(margin.value > tolerance(&margin)) {
        return Vec::new();
    }
    let signs = match (dyad.form, asked) {
        (Form::Prp | Form::Rpp, None) => vec![side],
        (Form::Prp | Form::Rpp, Some(_)) => Vec::new(),
        (_, Some(sign)) => vec![sign],
        (_, None) => vec![1.0, -1.0],
    };
    let put = |sign: f64| {
        let mut state = way.state.clone();
        let of = dyad.directions(&around, sign, plan.size).of;
        for (body, frame) in dyad.bodies.iter().zip(dyad.frames_of_bodies(&around, of)) {
            state.place_body::<1>(body, &frame);
        }
        continued(way, state, &plan.steps[index], index, (margin, sign))
    };
    signs.into_iter().map(put).collect()
}

/// The assembly with one more group in its place.
fn continued(
    way: &Assembly,
    mut state: State,
    step: &Step,
    index: usize,
    (margin, sign): (Margin, f64),
) -> Assembly {
    state.margins[index] = margin;
    angles_of(step, &mut state);
    let mut branches = way.branches.clone();
    branches.push(Branch {
        sign,
        changes: Vec::new(),
    });
    Assembly { state, branches }
}
