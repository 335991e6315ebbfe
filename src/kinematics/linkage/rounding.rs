//! How far rounding reaches: the same linkage with its numbers moved in the last digits.
//!
//! Near a singular position a small error of a length moves a link by much more, and a
//! derivative by more still. By how much follows from no bound that holds for every
//! structure; it is tried out. A [`Rounding`] holds a few copies of a linkage, each with all
//! points of its pairs moved by some units of rounding, on the same course. They have
//! the same branches, and their change points are interpolated anew. What a quantity differs by
//! from copy to copy is what the numbers given, being rounded themselves, leave open.

use super::change::Change;
use super::compile::compile;
use super::course::Course;
use super::dyad::Form;
use super::plan::{Plan, Step};
use super::skeleton::Skeleton;
use super::solve::{Guess, Stuck, solve, surroundings_of_dyad};
use super::spec::{LinkageSpec, PairKind};
use super::state::State;
use super::{Core, Linkage, Workspace};
use std::mem::discriminant;
use std::sync::Arc;

/// Number of copies.
pub(super) const COPIES: u64 = 6;
/// Most that a coordinate is moved, in units of rounding of its size.
const MOVED: f64 = 1.0;
/// An error of a quantity over the greatest difference of a copy.
pub(super) const SAFETY: f64 = 3.0;

/// Copies of a linkage that differ from it by rounding.
#[derive(Clone, Debug)]
pub struct Rounding {
    copies: Vec<(Linkage, Workspace)>,
    values: Vec<f64>,
}

impl Rounding {
    /// Of a linkage; without copies, and so without any error, where it cannot be told.
    pub fn of(linkage: &Linkage) -> Self {
        let copies = (1..=COPIES).filter_map(|seed| disturbed(linkage, seed));
        let with_workspace = copies.map(|copy| {
            let workspace = copy.workspace();
            (copy, workspace)
        });
        Self {
            copies: with_workspace.collect(),
            values: Vec::new(),
        }
    }

    /// Estimated errors of `values`, which `evaluate` finds at the input `q` of a linkage that is
    /// solved there to the order 3; infinite where a copy cannot be assembled.
    ///
    /// The estimate is that of the values' rounding. It is no bound: a few copies stand for
    /// all roundings.
    pub fn errors(
        &mut self,
        q: f64,
        values: &[f64],
        mut evaluate: impl FnMut(&Linkage, &Workspace, &mut Vec<f64>),
        errors: &mut Vec<f64>,
    ) {
        errors.clear();
        errors.resize(values.len(), 0.0);
        for (copy, workspace) in &mut self.copies {
            if copy.solve(q, 3, workspace).is_err() {
                errors.fill(f64::INFINITY);
                return;
            }
            evaluate(copy, workspace, &mut self.values);
            for (error, (value, moved)) in errors.iter_mut().zip(values.iter().zip(&self.values)) {
                let off = SAFETY * (moved - value).abs();
                // Not a number is no small error.
                *error = if off.is_nan() {
                    f64::INFINITY
                } else {
                    error.max(off)
                };
            }
        }
    }
}

/// The linkage with all points of its pairs moved.
fn disturbed(linkage: &Linkage, seed: u64) -> Option<Linkage> {
    let core = &*linkage.core;
    let spec = perturbed(&core.spec, core.plan.size, seed);
    let (plan, _) = compile(&Skeleton::of(&spec), true).ok()?;
    let alike = |(one, other): (&Step, &Step)| discriminant(one) == discriminant(other);
    if plan.steps.len() != core.plan.steps.len()
        || !plan.steps.iter().zip(&core.plan.steps).all(alike)
    {
        return None;
    }
    let mut course = core.course.clone();
    let mut state = plan.state();
    for group in 0..plan.steps.len() {
        for index in 0..course.branches[group].changes.len() {
            let again = interpolated(&plan, &course, &mut state, group, index)?;
            course.branches[group].changes[index] = again;
        }
    }
    let core = Core {
        spec,
        plan,
        course,
        structure: core.structure.clone(),
        range: core.range.clone(),
    };
    Some(Linkage {
        core: Arc::new(core),
    })
}

/// A change point of a group interpolated through the positions of another plan.
fn interpolated(
    plan: &Plan,
    course: &Course,
    state: &mut State,
    group: usize,
    index: usize,
) -> Option<Change> {
    let change = &course.branches[group].changes[index];
    change.in_directions(|input, sign| {
        let (reduced, _) = course.reduce(input);
        directions(
            plan,
            course,
            Guess::Table(&course.table),
            state,
            (group, sign),
            reduced,
        )
    })
}

/// cos θ and sin θ of both bodies of a dyad whose root has the sign given, the groups before it
/// being solved; `None` where one of them cannot be assembled, and for a group that has no two
/// assemblies that could meet.
pub(super) fn directions(
    plan: &Plan,
    course: &Course,
    guess: Guess<'_>,
    state: &mut State,
    (group, sign): (usize, f64),
    input: f64,
) -> Option<[f64; 4]> {
    let Step::Dyad(dyad) = &plan.steps[group] else {
        return None;
    };
    if matches!(dyad.form, Form::Prp | Form::Rpp) {
        // Two guides become parallel: their crossing goes to infinity.
        return None;
    }
    match solve::<1>(plan, course, guess, state, (input, input), group) {
        Ok(()) => {}
        Err(Stuck(_)) => return None,
    }
    let found = dyad.directions(&surroundings_of_dyad::<1>(dyad, state), sign, plan.size);
    let [one, other] = found.of.map(|direction| direction.value());
    Some([one[0], one[1], other[0], other[1]])
}

/// The numbers of a linkage with every coordinate of a pair moved by up to [`MOVED`] roundings.
pub(super) fn perturbed(spec: &LinkageSpec, size: f64, seed: u64) -> LinkageSpec {
    let mut spec = spec.clone();
    let mut random = Random(seed);
    for pair in &mut spec.pairs {
        for at in [&mut pair.on.at, &mut pair.link.at] {
            let scale = at.iter().fold(size, |most, x| most.max(x.abs()));
            for x in at {
                *x += random.next_random() * MOVED * f64::EPSILON * scale;
            }
        }
        if let PairKind::Sliding {
            direction, angle, ..
        } = &mut pair.kind
        {
            for turned in [direction, angle] {
                *turned += random.next_random() * MOVED * f64::EPSILON;
            }
        }
    }
    spec
}

/// Numbers without order (SplitMix64), the same ones for every linkage.
struct Random(u64);

impl Random {
    /// The next one, in −1 … 1.
    fn next_random(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut mixed = self.0;
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        mixed ^= mixed >> 31;
        (mixed >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}
