//! Planar linkages with several inputs: mobility two and more.
//!
//! A linkage is given in plain numbers ([`MultiSpec`]): those of a linkage of one input, and
//! its inputs, independent coordinates of pairs or of links that float. Links that the inputs
//! place from the ground outwards follow from these alone; the others form Assur groups, as
//! behind one input, and are solved by the same closed forms and the same iteration. What
//! moves with which input, and how fast, is linear: velocities by every input, accelerations,
//! and the equations of motion M(q)·q̈ = Q(q, q̇) on all inputs.
//!
//! Constraints that hold what is held already are left out as behind one input.
//!
//! On which side of its singular positions a group is stays as at the start: these
//! positions are where its determinant vanishes, surfaces in the space of the inputs, and
//! nothing is solved on them or beyond.
//!
//! SI units; angles in radians, counterclockwise.
//!
//! Two links whose pair is an input become one body of a group. On numbers with derivatives the
//! positions are lifted by the velocities, and the rest is the same code.

mod columns;
mod compile;
mod constraint;
mod dynamics;
mod forces;
mod joints;
mod larger;
mod margin;
mod misfit;
mod motion;
mod outputs;
mod place;
mod plan;
mod proposal;
mod rounding;
mod singular;
pub mod spec;
#[cfg(test)]
mod tests;
mod tied;
mod twist;
mod welded;
mod wrong;

pub use constraint::MultiOutput;
pub use dynamics::MultiReduced;
pub use forces::MultiPower;
pub use motion::MultiMotion;
pub use place::NotAssembled;
pub use proposal::{freedom, proposal};
pub use rounding::MultiRounding;
pub use singular::{SingularCurve, singular_curves};

use super::assemble;
use super::couplings;
use super::plan::Step;
use super::redundant;
use super::spec::OutputSpec;
use super::state::State;
use super::structure::{Group, GroupKind, Structure};
use super::workspace::Pose;
use crate::fault::Fault;
use crate::math::quantity::Quantity;
use columns::Columns;
use forces::Surroundings;
use place::StartPosition;
use plan::MultiPlan;
use spec::{InputCoordinate, InputSpec, MultiSpec};
use std::sync::Arc;
use welded::WeldedLinkage;

/// A planar linkage with several inputs, ready to be solved. Cheap to clone, immutable.
#[derive(Clone, Debug)]
pub struct MultiLinkage {
    core: Arc<Core>,
}

#[derive(Debug)]
struct Core {
    spec: MultiSpec,
    plan: MultiPlan,
    structure: Structure,
    /// Of every group the sign of its root, or of its determinant.
    signs: Vec<f64>,
    /// Of every group the determinant of its closing equations at the start.
    determinants: Vec<f64>,
    start: StartPosition,
}

impl MultiLinkage {
    /// Finds structure and assembly of a linkage.
    ///
    /// # Errors
    /// Everything wrong with its numbers; then inputs that are too few, too many or no free
    /// choice; then the first group that cannot be assembled at the start. Paths are
    /// relative to the linkage: `links.rod.mass`, `inputs.left`.
    pub fn new(spec: MultiSpec) -> Result<Self, Vec<Fault>> {
        wrong::check(&spec)?;
        let welded = WeldedLinkage::of(&spec);
        match compile::compile(&welded) {
            Ok(found) => Self::built(spec, welded, found),
            Err(faults) => redundant::find_movable(&spec, &welded.skeleton, &Self::with_known)
                .ok_or_else(|| proposal::hinted(&spec, faults)),
        }
    }

    /// Of a linkage whose redundant constraints are known, its numbers being right.
    fn with_known(spec: MultiSpec) -> Option<Self> {
        let welded = WeldedLinkage::of(&spec);
        let found = compile::compile(&welded).ok()?;
        Self::built(spec, welded, found).ok()
    }

    /// Puts it together.
    fn built(
        spec: MultiSpec,
        welded: WeldedLinkage,
        (plan, mut groups): (MultiPlan, Vec<Group>),
    ) -> Result<Self, Vec<Fault>> {
        let mut state = plan.plan.state();
        let inputs: Vec<f64> = spec.inputs.iter().map(|input| input.start).collect();
        place::outwards(&plan, &inputs, &mut state);
        place::whole_turn_angles(&plan, &inputs, &mut state.near);
        plan.attach(&mut state);
        // (No one number is the start.)
        let mut linkage = welded.spec.linkage;
        linkage.start = f64::NAN;
        wrong::refuse_unneeded_guesses(&spec, &plan, &state)?;
        let branches = assemble::choose_branches(
            &linkage,
            &plan.plan,
            &groups,
            &mut state,
            &mut |at, state| {
                place::place_moved_link(&plan, at, &inputs, state);
            },
        )?;
        redundant::holds_at_start(&spec.linkage, &state, plan.plan.size)?;
        let mut signs = Vec::new();
        for (at, group) in groups[1..].iter_mut().enumerate() {
            let two_ways = matches!(group.kind, GroupKind::Rrr | GroupKind::Rrp | GroupKind::Rpr);
            group.branch = two_ways.then_some(branches[at].sign);
            signs.push(match &plan.plan.steps[at] {
                Step::Newton(_) => state.margins[at].value.signum(),
                Step::Dyad(_) => branches[at].sign,
            });
        }
        let mut start = StartPosition::new(state, inputs.clone(), plan.turning);
        if let Err(NotAssembled { group }) = start.solve_at(&plan, &signs, &inputs) {
            let names = super::choice::names(&linkage, plan.plan.steps[group - 1].bodies());
            return Err(vec![Fault::new(
                "inputs",
                format!("{names} are in a singular position at the start"),
                "give approximate positions for other values of the inputs",
            )]);
        }
        let mut columns = Columns::<f64>::new(&plan);
        columns.load(&plan, &start.state);
        columns.find(&plan);
        let count = plan.groups.len();
        let determinants = (0..count)
            .map(|at| columns.determinant_of(&plan, at))
            .collect();
        let structure = Structure::new(&spec.linkage, groups);
        let core = Core {
            spec,
            plan,
            structure,
            signs,
            determinants,
            start,
        };
        Ok(Self {
            core: Arc::new(core),
        })
    }

    /// The numbers it was made of.
    pub fn spec(&self) -> &MultiSpec {
        &self.core.spec
    }

    /// The inputs.
    pub fn inputs(&self) -> &[InputSpec] {
        &self.core.spec.inputs
    }

    /// Names of the inputs.
    pub fn input_names(&self) -> Vec<&str> {
        let inputs = self.inputs().iter();
        inputs.map(|input| input.name.as_str()).collect()
    }

    /// The outputs.
    pub fn outputs(&self) -> &[OutputSpec] {
        &self.core.spec.linkage.outputs
    }

    /// Meaning of an input in words: `pair O`, `x of frame`.
    pub fn describe(&self, input: &InputSpec) -> String {
        let linkage = &self.core.spec.linkage;
        let link = |link: usize| &linkage.links[link].name;
        match input.coordinate {
            InputCoordinate::Pair(pair) => format!("pair {}", linkage.pairs[pair].name),
            InputCoordinate::X(own) => format!("x of {}", link(own)),
            InputCoordinate::Y(own) => format!("y of {}", link(own)),
            InputCoordinate::Angle(own) => format!("angle of {}", link(own)),
        }
    }

    /// Mobility and groups.
    pub fn structure(&self) -> &Structure {
        &self.core.structure
    }

    /// Sentences about what is allowed and hardly meant: cams that are undercut.
    pub fn remarks(&self) -> Vec<String> {
        couplings::remarks_on_couplings(&self.core.spec.linkage)
    }

    /// A length typical of it (m).
    pub fn typical_length(&self) -> f64 {
        self.core.plan.plan.size
    }

    /// All memory that solving needs, at the start.
    pub(crate) fn workspace<N: Quantity>(&self) -> MultiWorkspace<N> {
        MultiWorkspace::new(Arc::clone(&self.core))
    }
}

/// All memory that solving needs, and what was solved last. Angles go on continuously
/// from one position to the next.
#[derive(Clone, Debug)]
pub(crate) struct MultiWorkspace<N> {
    core: Arc<Core>,
    known: StartPosition,
    /// Velocities of the values alone, from which positions get their derivatives.
    values: Option<Box<Columns<f64>>>,
    columns: Columns<N>,
    angles: Vec<N>,
    /// Values of the inputs.
    at: Vec<f64>,
    /// Room for the derivatives of the matrices of larger groups.
    memory: [Vec<f64>; 2],
    /// The equations of motion last asked for.
    pub(crate) reduced: MultiReduced<N>,
}

impl<N: Quantity> MultiWorkspace<N> {
    fn new(core: Arc<Core>) -> Self {
        let plan = &core.plan;
        Self {
            known: core.start.clone(),
            values: (N::DERIVATIVES > 2).then(|| Box::new(Columns::new(plan))),
            columns: Columns::new(plan),
            angles: vec![N::from(0.0); plan.bodies],
            at: vec![0.0; plan.inputs],
            memory: {
                let larger = plan.groups.iter().filter(|group| !group.dyad);
                let most = larger.map(|group| 3 * group.bases.len()).max().unwrap_or(0);
                [vec![0.0; most * most], vec![0.0; most * most]]
            },
            reduced: MultiReduced::new(plan),
            core,
        }
    }

    /// Lets angles go on over whole turns, also where nothing in the linkage asks for them.
    pub(crate) fn follow_angles(&mut self) {
        self.known.turning = true;
    }

    /// Finds positions and velocities at given inputs and rates. Allocates nothing.
    ///
    /// # Errors
    /// The inputs cannot be reached.
    pub(crate) fn solve(&mut self, inputs: &[N], rates: &[N]) -> Result<(), NotAssembled> {
        let Core { plan, signs, .. } = &*self.core;
        for (at, input) in self.at.iter_mut().zip(inputs) {
            *at = input.value();
        }
        self.known.solve_at(plan, signs, &self.at)?;
        let state = &self.known.state;
        match &mut self.values {
            None => self.columns.load(plan, state),
            Some(values) => {
                values.load(plan, state);
                values.find(plan);
                self.columns.lift(plan, values, inputs);
            }
        }
        let turning = self.angles.iter_mut().enumerate();
        for (body, angle) in turning.filter(|_| self.known.turning) {
            *angle = N::from(self.known.angles[body]);
            if let Some(values) = &self.values {
                for (input, &q) in inputs.iter().enumerate() {
                    let turning = values.column(plan, body, input)[0];
                    *angle += (q - N::from(q.value())).scale(turning);
                }
            }
        }
        self.columns.find(plan);
        self.columns.set_rates(plan, rates);
        Ok(())
    }

    /// The equations of motion at what was solved last, into [`Self::reduced`]; dampers only
    /// where they are asked for.
    pub(crate) fn reduce(&mut self, dampers: bool) {
        let Core { plan, spec, .. } = &*self.core;
        let linkage = &spec.linkage;
        self.reduced.inertia(plan, linkage.gravity, &self.columns);
        if !linkage.forces.is_empty() {
            let around = Surroundings {
                plan,
                spec: linkage,
                columns: &self.columns,
                angles: &self.angles,
            };
            self.reduced.load(&around, dampers);
        }
        self.reduced.generalise(plan, &self.columns);
    }

    /// How far the nearest group is from a singular position, less what rounding leaves
    /// open, as [`Group`] and number: for a dyad of three pins sin² of the
    /// angle between its links. `None`: there is no group.
    pub(crate) fn margin(&self) -> Option<(usize, f64)> {
        self.known.margin()
    }
}

impl<N: Quantity> MultiWorkspace<N> {
    /// Kinetic energy and potential energy (J) at what was solved last.
    pub(crate) fn energies(&self) -> [N; 2] {
        self.surroundings().energies()
    }

    /// Whether what was left out as redundant holds at what was solved last.
    ///
    /// # Errors
    /// It does not: the group that has it.
    fn holds_redundant(&self) -> Result<(), NotAssembled> {
        let Core {
            spec, structure, ..
        } = &*self.core;
        let Some(first) = spec.linkage.redundant.first() else {
            return Ok(());
        };
        let size = self.core.plan.plan.size;
        if redundant::holds_at_start(&spec.linkage, self.state(), size).is_ok() {
            return Ok(());
        }
        let mut groups = structure.groups.iter();
        let group = groups.position(|group| group.pairs.contains(&first.pair));
        Err(NotAssembled {
            group: group.unwrap_or(1),
        })
    }

    /// Where everything is at what was solved last.
    pub(super) fn state(&self) -> &State {
        &self.known.state
    }

    fn surroundings(&self) -> Surroundings<'_, N> {
        Surroundings {
            plan: &self.core.plan,
            spec: &self.core.spec.linkage,
            columns: &self.columns,
            angles: &self.angles,
        }
    }
}

impl MultiWorkspace<f64> {
    /// How far a group (counted after the driver's) is from a singular position at what was
    /// solved last: 1 as at the start, 0 there, a smooth function of the inputs. Its
    /// derivatives by these go into `first`; rate, and second derivative in time while the
    /// accelerations of the inputs are zero.
    pub(crate) fn distance_from_singular(&mut self, group: usize, first: &mut [f64]) -> [f64; 3] {
        let Core {
            plan, determinants, ..
        } = &*self.core;
        let start = determinants[group];
        self.columns
            .margin(plan, group, start, &mut self.memory, first)
    }

    /// What dampers and forces take and give at what was solved last.
    pub(crate) fn power(&self) -> MultiPower {
        self.surroundings().power()
    }

    /// The frame of a link at what was solved last.
    pub(crate) fn pose(&self, link: usize) -> Pose {
        let motion = &self.known.state.links[link];
        Pose {
            x: motion.at[0][0],
            y: motion.at[1][0],
            cos: motion.direction[0][0],
            sin: motion.direction[1][0],
        }
    }
}
