//! Planar linkages of rigid links and lower pairs with one degree of freedom.
//!
//! A linkage is given in plain numbers ([`spec::LinkageSpec`]). [`Linkage::new`]
//! finds its structure (mobility, Assur groups), puts it together at the start,
//! and walks along the input coordinate to find how far it can go ([`Range`]).
//! [`Linkage::solve`] then gives, at any input within reach, the position of
//! every link with its transfer functions: the derivatives by the input
//! coordinate. What follows from them is linear algebra: velocity is x′q̇,
//! acceleration x′q̈ + x″q̇².
//!
//! Dyads are solved in closed form on directions, evaluated on power series of
//! the input, so that one formula gives the position and all its derivatives to
//! rounding; larger groups by Newton's method, their derivatives from the same
//! matrix. Which assembly a dyad is in is a sign, and stays with it: it changes
//! only at change points, where all its links are in line, and these are found
//! beforehand.
//!
//! SI units; angles in radians, counterclockwise.
//!
//! The assembly mode of a dyad is the sign of its one square root. If many loops come into line
//! at once, each depends on those before it. What is interpolated there has length one again
//! (`Vector::nearly_unit`): an error of length would grow by the reciprocal distance from the
//! point with every loop, an error of direction does not.

mod assemble;
mod assemblies;
mod change;
mod check;
mod choice;
pub(crate) mod closure;
mod compile;
mod continuation;
pub(crate) mod couplings;
mod course;
mod decompose;
mod dyad;
mod elements;
mod endless;
mod examine;
mod forces;
mod guesses;
pub(crate) mod joints;
pub mod kinetostatics;
pub mod multi;
mod newton;
mod plan;
mod range;
mod reduced;
mod redundant;
mod remarks;
mod rounding;
mod skeleton;
mod solve;
pub mod spec;
mod state;
mod structure;
#[cfg(test)]
mod tests;
pub(crate) mod vector;
mod welds;
mod workspace;

pub use forces::ForcePart;
pub use range::{Cause, ChangePoint, OutOfReach, Period, Range, RangeEnd, Reach};
pub use reduced::ReducedLinkage;
pub use rounding::Rounding;
pub use structure::{Group, GroupKind, Structure};
pub use workspace::{Pose, Workspace};

use crate::fault::Fault;
use crate::math::order::Total;
use assemble::Assembly;
use continuation::{Walker, WayEnd};
use course::Course;
use plan::Plan;
use range::Cause::DeadPosition;
use skeleton::Skeleton;
use solve::{Guess, Stuck};
use spec::LinkageSpec;
use state::State;
use std::f64::consts::TAU;
use std::sync::Arc;

/// A planar linkage, ready to be solved. Cheap to clone, immutable.
#[derive(Clone, Debug)]
pub struct Linkage {
    core: Arc<Core>,
}

/// Everything that is known of a linkage.
#[derive(Debug)]
struct Core {
    spec: LinkageSpec,
    plan: Plan,
    course: Course,
    structure: Structure,
    range: Range,
}

impl Linkage {
    /// Finds structure, assembly and range of a linkage.
    ///
    /// # Errors
    /// Everything wrong with its numbers; then what is wrong with its structure
    /// (not one degree of freedom, parts held more than once or not at all);
    /// then the first group that cannot be assembled at the start. Paths are
    /// relative to the linkage: `links.rod.mass`, `pairs.A`, `driver`.
    pub fn new(spec: LinkageSpec) -> Result<Self, Vec<Fault>> {
        Self::with_closed_forms(spec, true)
    }

    /// [`Self::new`], its dyads in closed form or by iteration.
    fn with_closed_forms(spec: LinkageSpec, closed_forms: bool) -> Result<Self, Vec<Fault>> {
        check::check(&spec)?;
        Self::built(spec.clone(), closed_forms).or_else(|faults| {
            redundant::find_movable_linkage(&spec, closed_forms).unwrap_or(Err(faults))
        })
    }

    /// Of a linkage whose numbers are right and whose redundant constraints are known.
    fn built(spec: LinkageSpec, closed_forms: bool) -> Result<Self, Vec<Fault>> {
        let skeleton = Skeleton::of(&spec);
        let (plan, groups) = compile::compile(&skeleton, closed_forms)?;
        let assembly = assemble::assemble(&skeleton.spec, &plan, &groups)?;
        redundant::holds_at_start(&spec, &assembly.state, plan.size)?;
        Self::explored(spec, &skeleton.spec, (plan, groups), assembly)
    }

    /// Of a linkage whose redundant constraints are known, in the assembly nearest to what is said
    /// approximately in which these hold.
    fn assemble_redundant(spec: &LinkageSpec, closed_forms: bool) -> Option<Self> {
        let skeleton = Skeleton::of(spec);
        let (plan, groups) = compile::compile(&skeleton, closed_forms).ok()?;
        let solved = &skeleton.spec.assembly;
        if assemblies::asks_in_vain(&plan, solved) {
            return None;
        }
        let ways =
            assemblies::assemblies_at_start(&plan, spec.start, &spec.assembly, solved).into_iter();
        let mut ways =
            ways.filter(|way| redundant::holds_at_start(spec, &way.state, plan.size).is_ok());
        let made = (&plan, &groups);
        ways.find_map(|way| {
            let made = (made.0.clone(), made.1.clone());
            Self::explored(spec.clone(), &skeleton.spec, made, way).ok()
        })
    }

    /// A linkage that is put together, with its range.
    fn explored(
        spec: LinkageSpec,
        solved: &LinkageSpec,
        (plan, mut groups): (Plan, Vec<Group>),
        Assembly {
            mut state,
            branches,
        }: Assembly,
    ) -> Result<Self, Vec<Fault>> {
        for (group, branch) in groups[1..].iter_mut().zip(&branches) {
            let two_ways = matches!(group.kind, GroupKind::Rrr | GroupKind::Rrp | GroupKind::Rpr);
            group.branch = two_ways.then_some(branch.sign);
        }
        let mut course = assemble::start_of_course(&spec, branches);
        let ends = explore(solved, &plan, &mut course, &mut state)?;
        let range = ranged(&course, ends);
        let structure = Structure::new(&spec, groups);
        let core = Core {
            spec,
            plan,
            course,
            structure,
            range,
        };
        let linkage = Self {
            core: Arc::new(core),
        };
        redundant::holds_everywhere(&linkage)?;
        Ok(linkage)
    }

    /// The numbers it was made of.
    pub fn spec(&self) -> &LinkageSpec {
        &self.core.spec
    }

    /// A length typical of it: the greatest distance between points of its pairs that
    /// belong to one link (m).
    pub fn typical_length(&self) -> f64 {
        self.core.plan.size
    }

    /// Mobility and groups.
    pub fn structure(&self) -> &Structure {
        &self.core.structure
    }

    /// Range of the input: how far it can go.
    pub fn range(&self) -> &Range {
        &self.core.range
    }

    /// All memory that solving needs.
    pub fn workspace(&self) -> Workspace {
        Workspace::new(Arc::clone(&self.core))
    }

    /// Finds the position of every link at the input `q` (rad or m) and its
    /// transfer functions up to `order` (0 to 3; more is taken as 3). Allocates
    /// nothing.
    ///
    /// # Errors
    /// The input lies outside the reach; the workspace is then as it was or
    /// holds a position that means nothing.
    pub fn solve(&self, q: f64, order: usize, workspace: &mut Workspace) -> Result<(), OutOfReach> {
        match order {
            0 => self.place_all::<1>(q, workspace),
            1 => self.place_all::<2>(q, workspace),
            2 => self.place_all::<3>(q, workspace),
            _ => self.place_all::<4>(q, workspace),
        }
    }

    fn place_all<const N: usize>(
        &self,
        q: f64,
        workspace: &mut Workspace,
    ) -> Result<(), OutOfReach> {
        let Core { plan, course, .. } = &*self.core;
        if !(course.ends[0] < q && q < course.ends[1] && q.is_finite()) {
            return Err(self.out_of_reach(q));
        }
        let (reduced, turns) = course.reduce(q);
        workspace.at(q, reduced, turns, N - 1);
        let guess = Guess::Table(&course.table);
        let groups = plan.steps.len();
        solve::solve::<N>(
            plan,
            course,
            guess,
            &mut workspace.state,
            (q, reduced),
            groups,
        )
        .map_err(|Stuck(_)| self.out_of_reach(q))
    }

    /// What there is to say of an input outside the reach.
    fn out_of_reach(&self, q: f64) -> OutOfReach {
        let reach = self.core.range.ends();
        let end = match &self.core.range.reach {
            Reach::Interval { lower, upper } => {
                if (q - lower.at).abs() < (q - upper.at).abs() {
                    *lower
                } else {
                    *upper
                }
            }
            Reach::Everywhere => RangeEnd {
                at: q,
                cause: Cause::Unexplored,
            },
        };
        OutOfReach {
            input: q,
            end,
            reach,
        }
    }
}

/// Walks both ways from the start.
fn explore(
    spec: &LinkageSpec,
    plan: &Plan,
    course: &mut Course,
    state: &mut State,
) -> Result<[WayEnd; 2], Vec<Fault>> {
    let start = spec.start;
    // The first position of a larger group is known to rounding already: it is
    // solved again, with derivatives, from itself.
    let here = solve::Anchor::new(start, state, |link| state.near[link]);
    let at = (start, start);
    let groups = plan.steps.len();
    if let Err(Stuck(group)) =
        solve::solve::<4>(plan, course, Guess::Near(&here), state, at, groups)
    {
        let links = plan.steps[group].bodies();
        let names = choice::names(spec, links);
        return Err(vec![Fault::new(
            "links",
            format!(
                "{names} are in a dead-centre position at the start {}",
                choice::start_in_words(spec)
            ),
            "give approximate positions for another input",
        )]);
    }
    course.table.push(start, state);
    course.below.push(start, state);
    if groups == 0 && plan.driver.sliding.is_some() && spec.travel.is_none() {
        // A sliding link alone goes wherever it is sent.
        course.finish(&plan.driver);
        return Ok([WayEnd::Everywhere; 2]);
    }
    let limits = spec
        .travel
        .map_or([None, None], |[from, to]| [Some(from), Some(to)]);
    let up = Walker::new(plan, course, state, true).continue_until_end(limits[1]);
    if let WayEnd::Repeats(turns) = up {
        course.period = Some(TAU * turns as f64);
        course.finish(&plan.driver);
        return Ok([up; 2]);
    }
    let down = Walker::new(plan, course, state, false).continue_until_end(limits[0]);
    for (end, way) in [down, up].into_iter().enumerate() {
        if let WayEnd::Ends(at, cause) = way {
            // The ends of the travel belong to it, dead-centre positions do not.
            course.ends[end] = match (cause, end) {
                (DeadPosition { .. }, _) => at,
                (_, 0) => at.next_down(),
                _ => at.next_up(),
            };
        }
    }
    course.finish(&plan.driver);
    let unexplored = |way: WayEnd| matches!(way, WayEnd::Ends(_, Cause::Unexplored));
    if !spec.couplings.is_empty()
        && unexplored(down)
        && unexplored(up)
        && endless::assembles_everywhere(plan, course, state)
    {
        course.ends = [f64::NEG_INFINITY, f64::INFINITY];
        course.table.goes_on = true;
        return Ok([WayEnd::Everywhere; 2]);
    }
    Ok([down, up])
}

fn ranged(course: &Course, ways: [WayEnd; 2]) -> Range {
    let end = |way: WayEnd| match way {
        WayEnd::Ends(at, DeadPosition { group }) => RangeEnd {
            at,
            cause: DeadPosition { group: group + 1 },
        },
        WayEnd::Ends(at, cause) => RangeEnd { at, cause },
        WayEnd::Repeats(_) | WayEnd::Everywhere => RangeEnd {
            at: f64::INFINITY,
            cause: Cause::Unexplored,
        },
    };
    let (reach, period) = match ways[1] {
        WayEnd::Repeats(turns) => (Reach::Everywhere, Some(Period::of_turns(turns))),
        WayEnd::Everywhere => (Reach::Everywhere, None),
        WayEnd::Ends(..) => {
            let [lower, upper] = ways.map(end);
            (Reach::Interval { lower, upper }, None)
        }
    };
    let mut changes: Vec<ChangePoint> = Vec::new();
    for (group, branch) in course.branches.iter().enumerate() {
        changes.extend(branch.changes.iter().map(|change| ChangePoint {
            at: change.at,
            group: group + 1,
        }));
    }
    changes.sort_by_cached_key(|change| Total(change.at));
    Range {
        start: course.start,
        reach,
        period,
        changes,
    }
}
