//! Exact propagation of piecewise-linear trees of masses.
//!
//! Between two switches of its pairs such a system is linear with constant
//! coefficients, and its motion is known in closed form: a sum of modes, of
//! the answers to the law's harmonics, and of a polynomial. A run goes from
//! switch to switch; nothing is stepped in time and no tolerance is set.
//! Errors are those of rounding, of the modes and of the switch instants.
//!
//! # What it takes
//!
//! A [`TreeProblem`]: elastic links in a tree behind one prescribed [`Law`]
//! (harmonics, or polynomial spans made when they are reached), joined with
//! constant levers, with any viscous damping in each link. A link holds a
//! bilateral, force-closed or form-closed pair ([`TreePair`]); a pair never
//! pulls. Masses may have springs and viscous dampers to the ground and loads
//! that are constant, piecewise linear in time, or tables over a displacement
//! that is prescribed ([`TimeLoad`]). A single mass under constant loads may have a rigid
//! pair, with impacts.
//!
//! [`Parts`] makes the trees from a system and says what of it does not qualify.
//! A run is made at once ([`ExactTree::run`]) or phase by phase ([`Cursor`]);
//! scenes are played to the recorder from the latter.
//!
//! If some branches behind a prescribed drive qualify and others do not, the others are a
//! system of their own ([`Rest`]), which is integrated. After each of its steps the branches
//! are followed to its end.
//!
//! # What is guaranteed
//!
//! The next switch is searched for by bounds, not by sampling: every step of
//! the search is a length over which no watched pair function can vanish, or
//! ends in a bracket with exactly one root. A crossing is not lost for being
//! short. The bounds are evaluated in ordinary arithmetic, without directed
//! rounding; where a pair function cannot be told from its own rounding the
//! step is counted in [`ExactRun::grazing`] and the guarantee does not hold
//! there. Extremes in [`TreeFigures`] are found with bounds of Hermite's cubic
//! between the ends of the steps.
//!
//! With [`Request::audit`] the energy balance is closed ([`crate::dynamics::energy::EnergyAudit`]): work of
//! the law and of the loads, dissipation and change of energy are integrals of
//! products of modes, harmonics and polynomials, in closed form over each phase.
//!
//! # Limits
//!
//! - Modes that coincide or nearly do (critical damping, equal branches) are
//!   taken together and lose no digits to speak of: the motion is right to
//!   10⁻¹² through critical damping. Hardly damped modes that coincide without
//!   independent eigenvectors are refused. See [`Refusal`].
//! - A hardly damped mode driven within 10⁻³ of its own frequency, or at it, costs
//!   no digits but time: its phases last a tenth of the harmonic's period.
//! - The motion of a floating part that only a light damper to the ground drags, with
//!   the decay ε, is right to some 10⁻¹³/ε of itself (ε in 1/s).
//! - At most 256 combinations of engaged pairs are kept, fewer of many masses: as
//!   many as take some 256 MB. At one more all are forgotten and made again when met.
//! - Position functions that vary with the state, dry friction and anything
//!   else that is not linear between switches cannot be stated.
//! - A problem is not checked: inertias and stiffnesses must be positive,
//!   parents stand before children.
//!
//! # What the tests cover
//!
//! Single chains on one sine, force- or form-closed at the first link, under a
//! constant load: against reference trajectories, figures and switch counts
//! computed elsewhere, with fused and with plain arithmetic.
//!
//! Against an integration of the equations of motion that shares nothing but the
//! problem (fourth order, small fixed steps, agreement to 10⁻⁷):
//! - a branched tree with levers of either sign, two pairs at once, a gap;
//! - springs and dampers to the ground, overdamped modes, a floating part that
//!   dampers drag;
//! - two sines with a linear part, loads in a time table, polynomial spans of the law;
//! - equal branches that change together, bounces that end in lasting contact.
//!
//! A graze is distinguished from a miss at 10⁻¹⁰ of the load; refusals are named.
//! Pair conditions hold on dense samples of random scenes. Switches allocate
//! nothing. Random scenes with branched trees, levers, several pairs, springs,
//! dampers, tables and laws in spans: against Dormand–Prince's method of order 8 at
//! a tight tolerance (trajectories, switch counts), figures against those of the
//! recorder. Fitted laws and loads: against the motions that they follow.
//!
//! Against Taylor's series of the motion in short steps, with and without switches:
//! - critical, nearly critical and repeated modes to 5·10⁻¹² on either side of the
//!   coincidence, parts that float side by side;
//! - undamped and hardly damped modes driven at their own frequency and from 10⁻¹⁵
//!   to 10⁻² beside it, to 10⁻¹²;
//! - grazes by 10⁻¹⁰ from either side, a loss of contact over 3·10⁻⁴ of a radian of
//!   the law, switches at the start, more combinations of pairs than are kept.
//!
//! After the transient a cycle takes as many evaluations as that of one mass, of
//! one vector of lanes.
//!
//! Of the figures, the extremes and mean of δ and the lift of one case are
//! compared with values computed elsewhere; the bounds they are found with are
//! tested as such. The energy audit closes to 10⁻¹⁰ of its scale in all these
//! runs, to 10⁻¹² on the rocker; work of loads and dissipation of the random
//! scenes agree to 10⁻⁹ with the recorder's, which integrates powers, and all
//! parts do on the rocker.
//!
//! # Sources of the method
//!
//! Modes of a damped system in their unconjugated norm, and impedances
//! (dynamic stiffnesses) eliminated along a branch as in Holzer's and the
//! transfer-matrix methods. Simultaneous iteration on all eigenvalues after
//! Ehrlich and Aberth. Eigenvectors by twisted elimination. Taylor's remainder
//! and Bernstein coefficients as bounds of a polynomial on an interval.
//! Products and sums of two numbers after Dekker.

mod audit;
mod basis;
mod bound;
mod cluster;
mod cursor;
mod dense;
mod eigenvalues;
mod event_function;
pub(crate) mod event_loop;
mod fading;
mod from_model;
mod functional;
mod hermite;
mod impacts;
#[cfg(test)]
mod independent_tests;
mod lanes;
mod law;
mod linear;
mod observe;
mod panel;
mod pencil;
mod phase;
mod polynomial;
mod problem;
mod regime;
mod request;
mod requested_figures;
mod resonance;
mod run;
mod sample;
mod search;
pub(crate) mod sensitivity;
mod signal;
mod start;
#[cfg(test)]
mod tests;
mod track;
mod workspace;

pub use cursor::Cursor;
pub use from_model::{KeptLaws, Part, Parts, Rest};
pub(crate) use from_model::{PrescribedMotion, Rhythm};
pub(crate) use hermite::{End, Piece};
pub use law::{LAW_DEGREE, Law, PolynomialSpan, Sine, SpanSource};
pub use linear::{LinearTree, TreeMode};
pub use problem::{
    Flank, ForcePiece, ForceSource, PairState, Refusal, TimeLoad, TreeMass, TreeObject, TreePair,
    TreeProblem,
};
pub use request::{ExactRun, ExactSwitch, Halt, Request};
pub use requested_figures::RequestedFigures;
use std::sync::Arc;
pub(crate) use track::Ahead;
pub use track::{FigureTimes, TreeFigures};
use workspace::Workspace;

/// Most combinations of engaged pairs that [`ExactTree::check`] tries.
const MOST_CHECKED: usize = 27;

/// The modes of combinations of engaged pairs.
pub(crate) type Modes = Vec<(Vec<PairState>, basis::Basis)>;

/// A problem ready to be run.
#[derive(Clone, Debug)]
pub struct ExactTree {
    problem: TreeProblem,
    functionals: Vec<functional::Functional>,
    first: Vec<usize>,
    /// Modes that are known beforehand; a run finds the others when it meets them.
    modes: Arc<Modes>,
}

impl ExactTree {
    /// Prepares a problem.
    pub fn new(problem: TreeProblem) -> Self {
        let (functionals, first) = regime::pair_functionals(&problem);
        Self {
            problem,
            functionals,
            first,
            modes: Arc::default(),
        }
    }

    /// The tree, of which some modes are known.
    pub(crate) fn with_modes(mut self, modes: &Arc<Modes>) -> Self {
        self.modes = Arc::clone(modes);
        self
    }

    /// Problem that it was made from.
    pub fn problem(&self) -> &TreeProblem {
        &self.problem
    }

    /// The law it follows.
    pub fn law(&self) -> &Law {
        &self.problem.law
    }

    /// Tries the modes of the combinations of engaged pairs that a run may meet:
    /// of all where they are few, otherwise with all pairs open and all engaged.
    ///
    /// # Errors
    /// The modes of a combination cannot be separated.
    pub fn check(&self) -> Result<(), Refusal> {
        self.try_modes().map(drop)
    }

    /// The modes of those combinations.
    ///
    /// # Errors
    /// As [`Self::check`].
    pub(crate) fn try_modes(&self) -> Result<Modes, Refusal> {
        let masses = &self.problem.masses;
        let options = |mass: &TreeMass| 1 + mass.pair.flanks().1;
        let state = |option: usize| match option {
            0 => PairState::Free,
            flank => PairState::Engaged((flank - 1) as u8),
        };
        let count = masses.iter().fold(1usize, |product, mass| {
            product.saturating_mul(options(mass))
        });
        let combinations = if count <= MOST_CHECKED {
            (0..count).collect()
        } else {
            vec![0, usize::MAX]
        };
        let mut modes = Modes::with_capacity(2);
        for mut number in combinations {
            let mut states = Vec::with_capacity(masses.len());
            for mass in masses {
                let last = options(mass) - 1;
                states.push(state(if number == usize::MAX {
                    last.min(1)
                } else {
                    number % (last + 1)
                }));
                if number != usize::MAX {
                    number /= last + 1;
                }
            }
            let basis = basis::Basis::new(&self.problem, &states);
            modes.push((states, basis.map_err(|e| Refusal::new("", e.0))?));
        }
        Ok(modes)
    }

    /// Runs it.
    ///
    /// # Errors
    /// The modes of a regime cannot be separated, or numbers stop being finite.
    pub fn run(&self, request: &Request) -> Result<ExactRun, Refusal> {
        self.run_while(request, &workspace::never_stop)
    }

    /// Runs it for as long as `goes_on` says so; asked every thousand steps of
    /// the search.
    ///
    /// # Errors
    /// As [`Self::run`].
    pub fn run_while(
        &self,
        request: &Request,
        goes_on: &dyn Fn() -> bool,
    ) -> Result<ExactRun, Refusal> {
        let mut work = Workspace::new(self, request)?;
        work.goes_on = goes_on;
        work.run(request)
    }
}
