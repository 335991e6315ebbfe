//! The first position of a larger group, from approximate positions of some of
//! its links or from a number of trials.

use super::choice::{
    Wrong, distance_from_choice, names, number_text, requested_branch, start_in_words,
};
use super::dyad::Margin;
use super::newton::{NewtonGroup, PreparedJoint};
use super::plan::Plan;
use super::spec::{AssemblyChoice, AssemblySpec, LinkageSpec};
use super::state::Scratch;
use super::state::State;
use super::vector::nearest_turn;
use crate::math::linear::dense::{factorise, solve};
use std::f64::consts::TAU;

/// Trials for the angles that are not given.
const TRIALS: usize = 200;
/// Different assemblies that are kept.
const MOST_FOUND: usize = 16;

/// A way to put the group together.
struct Assembly {
    unknowns: Vec<f64>,
    margin: Margin,
    mismatch: f64,
}

/// Puts a group together at the start and leaves its position in `state`.
pub(super) fn assemble(
    spec: &LinkageSpec,
    plan: &Plan,
    group: &NewtonGroup,
    choices: &[&AssemblySpec],
    state: &mut State,
) -> Result<Margin, Wrong> {
    let names = names(spec, &group.bodies);
    if requested_branch(choices)?.is_some() {
        return Err((
            format!("the group of {names} has no branches + and -"),
            "give the approximate angle of one or more of these links at the start".to_owned(),
        ));
    }
    let (found, closest) = find_assemblies(plan, group, choices, state);
    let start = start_in_words(spec);
    let chosen = choose(&names, choices, &found, closest * plan.size, &start)?;
    chosen.write_positions(group, state);
    Ok(chosen.margin)
}

/// All assemblies of a group that the trials find, and their margins.
pub(super) fn all_assemblies(
    plan: &Plan,
    group: &NewtonGroup,
    state: &State,
) -> Vec<(State, Margin)> {
    let (found, _) = find_assemblies(plan, group, &[], &mut state.clone());
    let put = |one: Assembly| {
        let mut state = state.clone();
        one.write_positions(group, &mut state);
        (state, one.margin)
    };
    found.into_iter().map(put).collect()
}

/// The assemblies that the trials find, and the least closing error that they left.
fn find_assemblies(
    plan: &Plan,
    group: &NewtonGroup,
    choices: &[&AssemblySpec],
    state: &mut State,
) -> (Vec<Assembly>, f64) {
    let mut scratch = Scratch::new(group.bodies.len());
    let mut found: Vec<Assembly> = Vec::new();
    let mut closest = f64::INFINITY;
    for trial in 0..TRIALS {
        guess_angles(plan, group, choices, &mut scratch, trial);
        let settled = refine_guess(group, state, &mut scratch, plan.size);
        let error = group.closing_error(state, &mut scratch, plan.size);
        if error.is_finite() {
            closest = closest.min(error);
        }
        let Ok(margin) = settled else { continue };
        if !group.proper(state, &scratch) {
            continue;
        }
        write_positions(group, &scratch, state);
        let mismatch = choices
            .iter()
            .map(|choice| distance_from_choice(choice, state, plan.size))
            .sum();
        let unknowns: Vec<f64> = scratch.unknowns.iter().map(|unknown| unknown[0]).collect();
        let known = found
            .iter()
            .any(|other| are_same_angles(&other.unknowns, &unknowns, plan.size));
        if !known && found.len() < MOST_FOUND {
            found.push(Assembly {
                unknowns,
                margin,
                mismatch,
            });
        }
        // A good approximate position leads where it was meant to.
        if trial == 0 && !choices.is_empty() && mismatch < 0.1 * choices.len() as f64 {
            break;
        }
    }
    (found, closest)
}

impl Assembly {
    /// Leaves its positions in a state.
    fn write_positions(&self, group: &NewtonGroup, state: &mut State) {
        let mut scratch = Scratch::new(group.bodies.len());
        for (unknown, value) in scratch.unknowns.iter_mut().zip(&self.unknowns) {
            unknown[0] = *value;
        }
        write_positions(group, &scratch, state);
    }
}

fn choose<'a>(
    names: &str,
    choices: &[&AssemblySpec],
    found: &'a [Assembly],
    closest: f64,
    start: &str,
) -> Result<&'a Assembly, Wrong> {
    if found.is_empty() {
        return Err((
            format!(
                "{names} cannot be joined at the start {}: the closest of {TRIALS} trials \
                 leaves a closing error of {} m",
                start,
                number_text(closest)
            ),
            "check the lengths, or give approximate positions of these links".to_owned(),
        ));
    }
    if choices.is_empty() && found.len() > 1 {
        let mut angles: Vec<f64> = found.iter().map(|way| principal(way.unknowns[2])).collect();
        angles.sort_by(f64::total_cmp);
        let angles: Vec<String> = angles
            .iter()
            .map(|angle| number_text(angle.to_degrees()))
            .collect();
        return Err((
            format!(
                "{names} can be joined in {} ways, the first of them at the angles {} deg",
                found.len(),
                angles.join(", ")
            ),
            "give the approximate angle of one or more of these links at the start".to_owned(),
        ));
    }
    let best = found
        .iter()
        .min_by(|one, other| one.mismatch.total_cmp(&other.mismatch));
    best.ok_or_else(|| ("nothing was found".to_owned(), String::new()))
}

/// The angle in (−π, π].
fn principal(angle: f64) -> f64 {
    nearest_turn(angle, 0.0)
}

fn are_same_angles(one: &[f64], other: &[f64], size: f64) -> bool {
    one.iter().zip(other).enumerate().all(|(row, (a, b))| {
        if row % 3 == 2 {
            let turned = (a - b) / TAU;
            (turned - turned.round()).abs() < 1e-6
        } else {
            (a - b).abs() < 1e-6 * size
        }
    })
}

/// Angles as given or, one after the other, all over the circle; places as
/// given or near the middle.
fn guess_angles(
    plan: &Plan,
    group: &NewtonGroup,
    choices: &[&AssemblySpec],
    scratch: &mut Scratch,
    trial: usize,
) {
    for (index, body) in group.bodies.iter().enumerate() {
        // Multiples of an irrational number spread evenly.
        let spread = |k: usize| {
            (trial as f64 * [0.754_877, 0.569_840, 0.618_034][k] * (1.0 + 0.37 * index as f64))
                .fract()
        };
        let mut angle = TAU * spread(2);
        let mut at = [plan.size * (spread(0) - 0.5), plan.size * (spread(1) - 0.5)];
        for choice in choices.iter().filter(|choice| choice.link == body.base) {
            if let AssemblyChoice::Angle(given) = choice.choice {
                angle = given;
            }
        }
        for choice in choices.iter().filter(|choice| choice.link == body.base) {
            if let AssemblyChoice::Near { point, place } = choice.choice {
                let (sin, cos) = angle.sin_cos();
                at = [
                    place[0] - cos * point[0] + sin * point[1],
                    place[1] - sin * point[0] - cos * point[1],
                ];
            }
        }
        for (unknown, value) in scratch.unknowns[3 * index..]
            .iter_mut()
            .zip([at[0], at[1], angle])
        {
            *unknown = [value, 0.0, 0.0, 0.0];
        }
    }
}

/// Newton's method after a first guess of the positions that suits the angles.
fn refine_guess(
    group: &NewtonGroup,
    state: &State,
    scratch: &mut Scratch,
    size: f64,
) -> Result<Margin, super::newton::NotConverged> {
    // Positions first, with the angles as guessed: their equations are linear.
    group.relax(state, scratch, size);
    group.place_by_newton::<1>(state, scratch, size)
}

fn write_positions(group: &NewtonGroup, scratch: &Scratch, state: &mut State) {
    for (index, body) in group.bodies.iter().enumerate() {
        state.place_body(body, &NewtonGroup::frame::<1>(scratch, index));
        // Where nothing counts the turns it is the angle in (−π, π].
        let angle = scratch.unknowns[3 * index + 2][0];
        state.near[body.base] = match group.ties.iter().any(PreparedJoint::counts_whole_turns) {
            false => state.links[body.base].angle(),
            true => angle,
        };
    }
}

impl NewtonGroup {
    /// Moves the bodies, without turning them, to where the least squares of
    /// the closing errors are.
    pub(super) fn relax(&self, state: &State, scratch: &mut Scratch, size: f64) {
        let n = 3 * self.bodies.len();
        self.equations::<1>(state, scratch, size);
        self.matrix(state, scratch, size);
        // Normal equations of the columns of x and y alone; the angles stay.
        let mut normal = vec![0.0; n * n];
        let mut right = vec![0.0; n];
        let moves = |column: usize| column % 3 != 2;
        for a in 0..n {
            if !moves(a) {
                normal[a * n + a] = 1.0;
                continue;
            }
            for row in 0..n {
                let entry = scratch.matrix[row * n + a];
                right[a] -= entry * scratch.equations[row][0];
                for b in (0..n).filter(|&b| moves(b)) {
                    normal[a * n + b] += entry * scratch.matrix[row * n + b];
                }
            }
            normal[a * n + a] += 1e-9;
        }
        if factorise(&mut normal, &mut scratch.pivots[..n]).determinant != 0.0 {
            solve(&normal, &scratch.pivots[..n], &mut right, 1);
            for (row, change) in right.iter().enumerate() {
                if change.is_finite() {
                    scratch.unknowns[row][0] += change * size;
                }
            }
        }
    }

    /// Blocks point along their guides, not against them.
    pub(super) fn proper(&self, state: &State, scratch: &Scratch) -> bool {
        self.ties.iter().all(|tie| tie.is_proper(state, scratch))
    }
}
