//! One position, solved and reduced to plain numbers.

use super::{ForceSettings, Instant, PositionSource};
use crate::kinematics::linkage::kinetostatics::{
    Balance, Convention, CouplingForce, ForceFailure, ForceWorkspace, Indeterminate, InputMotion,
    Kinetostatics, Positions, Reaction, Sensitivities, SolutionQuality, Transmission, WeldForce,
};
use crate::studies::endless::DeadEnd;
use std::fmt;

/// Row: a position of the course.
#[derive(Clone, Debug)]
pub struct Row {
    /// Time, where the course has one (s).
    pub time: Option<f64>,
    /// Motion of the input.
    pub motion: InputMotion,
    /// The forces, or why there are none.
    pub forces: Result<Forces, Trouble>,
}

impl Row {
    /// Greatest force of a pair (N); `None` without forces.
    pub(super) fn greatest_force(&self) -> Option<f64> {
        let forces = self.forces.as_ref().ok()?;
        let pairs = forces.pairs.iter().map(PairForces::greatest_force);
        Some(pairs.fold(0.0, f64::max))
    }
}

/// Why a position has no forces.
#[derive(Clone, Debug, PartialEq)]
pub enum Trouble {
    /// The linkage cannot be assembled.
    OutOfReach(String),
    /// Kinetostatics found none.
    Failure(ForceFailure),
    /// The reach ends there in a dead-centre position towards which forces grow without bound.
    EndOfReach,
}

impl fmt::Display for Trouble {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OutOfReach(reason) => write!(f, "outside the range of motion: {reason}"),
            Self::Failure(failure) => write!(f, "{failure}"),
            Self::EndOfReach => write!(
                f,
                "end of the range of motion: forces grow without bound towards the dead-centre \
                 position"
            ),
        }
    }
}

/// Forces at a position.
#[derive(Clone, Debug)]
pub struct Forces {
    /// The driving moment or force M₁ (N·m or N); of several inputs the power of all drivers
    /// (W).
    pub drive: f64,
    /// The driving force at every input (N·m or N): one, or those of several.
    pub drives: Vec<f64>,
    /// Motions of several inputs; none of one.
    pub inputs: Vec<InputMotion>,
    /// Qualities of the solution.
    pub solved: SolutionQuality,
    /// Driving forces of further solutions.
    pub others: Vec<f64>,
    /// The pairs, in the linkage's order.
    pub pairs: Vec<PairForces>,
    /// The welds, in the linkage's order.
    pub welds: Vec<WeldForce>,
    /// The couplings, in the linkage's order.
    pub couplings: Vec<CouplingForce>,
    /// Which of these rigid links leave open; nothing where only a few figures were asked for.
    pub indeterminate: Indeterminate,
    /// The power balance.
    pub balance: Balance,
    /// Ratio and load of the output asked for.
    pub transmission: Option<Transmission>,
    /// Dynamic transmission ratio χ.
    pub chi: Option<f64>,
    /// The sign it is given.
    pub convention: Convention,
    /// Force and moment about the ground's origin of the links' inertia on the
    /// frame (N, N, N·m).
    pub shaking: [f64; 3],
    /// Force and moment of all pairs on the frame (N, N, N·m).
    pub on_frame: [f64; 3],
    /// Derivatives of the driving force; `None` where it has none.
    pub sensitivities: Option<Sensitivities>,
    /// Deviation of influence coefficients from transfer functions.
    pub influence_error: f64,
    /// Places of the links.
    pub links: Vec<LinkPlace>,
}

/// Forces of a pair; on link j from link i.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PairForces {
    /// Point of the pair (m).
    pub point: [f64; 2],
    /// Total force, friction included (N).
    pub force: [f64; 2],
    /// Couple about the point (N·m).
    pub couple: f64,
    /// Normal forces at the corners of a block (N).
    pub corners: Option<[f64; 2]>,
    /// Friction: couple of a pin (N·m) or force along a guide (N).
    pub friction: f64,
    /// Power lost (W).
    pub loss: f64,
}

impl PairForces {
    /// Size of the total force (N).
    pub fn greatest_force(&self) -> f64 {
        self.force[0].hypot(self.force[1])
    }
}

/// Place of a link's frame: origin (m), cosine and sine.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LinkPlace {
    /// The origin (m).
    pub origin: [f64; 2],
    /// Cosine and sine of its angle.
    pub direction: [f64; 2],
}

/// Solves positions one after another.
pub(super) struct Solver<'a, S> {
    kinetostatics: &'a Kinetostatics,
    source: &'a mut S,
    settings: ForceSettings,
    loads: Vec<usize>,
    workspace: ForceWorkspace,
}

impl<'a, S: PositionSource> Solver<'a, S> {
    pub(super) fn new(
        kinetostatics: &'a Kinetostatics,
        source: &'a mut S,
        settings: &ForceSettings,
    ) -> Self {
        let of_output = || settings.output.map(|output| kinetostatics.loads_of(output));
        Self {
            kinetostatics,
            source,
            settings: settings.clone(),
            loads: settings
                .loads
                .clone()
                .or_else(of_output)
                .unwrap_or_default(),
            workspace: kinetostatics.workspace(),
        }
    }

    /// The linkage.
    pub(super) fn kinetostatics(&self) -> &Kinetostatics {
        self.kinetostatics
    }

    /// Singular positions that the linkage passes, with their period.
    pub(super) fn singular(&self) -> (Vec<f64>, Option<f64>) {
        self.source.singular()
    }

    /// Input coordinates beside which loads on the outputs jump or have a kink.
    pub(super) fn load_places(&self, between: [f64; 2], speed: f64) -> Vec<f64> {
        self.source.load_places(between, speed)
    }

    /// Names of the loads on the outputs that follow from the motion of the input.
    pub(super) fn load_names(&self) -> Vec<String> {
        self.source.load_names()
    }

    /// Dead-centre positions at which the reach ends.
    pub(super) fn limits(&self) -> Vec<DeadEnd> {
        self.source.limits()
    }

    /// Solves a position; sensitivities and checks only in `full`.
    pub(super) fn row(&mut self, instant: &Instant, full: bool) -> Row {
        Row {
            time: None,
            motion: instant.motion,
            forces: self.solve_forces(instant, full),
        }
    }

    fn solve_forces(&mut self, instant: &Instant, full: bool) -> Result<Forces, Trouble> {
        let (solver, w) = (self.kinetostatics, &mut self.workspace);
        let motion = instant.motion;
        let acting = match instant.loads.is_empty() {
            true => self.source.loads(motion),
            false => Vec::new(),
        };
        let positions = self
            .source
            .at(motion.coordinate)
            .map_err(Trouble::OutOfReach)?;
        w.set_output_loads(match instant.loads.is_empty() {
            true => &acting,
            false => &instant.loads,
        });
        let mut options = self.settings.options;
        options.search &= full;
        if motion.acceleration == 0.0 {
            options.direction = options.direction.or(instant.direction);
        }
        let inputs = positions.inputs();
        let solved = match solver.is_over_time() {
            true => {
                let rates: Vec<f64> = inputs.iter().map(|input| input.speed).collect();
                solver.solve_over_time(positions, &rates, &options, w)
            }
            false => solver.solve(positions, motion, &options, w),
        };
        let solved = solved.map_err(Trouble::Failure)?;
        let all = full;
        // Of several inputs there is no one force that changes, and no one ratio.
        let full = full && !solver.is_over_time();
        let output = self.settings.output;
        let transmission =
            output.map(|output| solver.transmission(output, &self.loads, motion.coordinate, w));
        let ratio =
            |found: Transmission| found.dynamic_ratio(w.driver_force(), self.settings.convention);
        let links = solver.spec().links.iter().enumerate().map(|(index, _)| {
            let link = positions.link(index);
            LinkPlace {
                origin: link.origin,
                direction: [link.cos, link.sin],
            }
        });
        Ok(Forces {
            drive: w.driver_force(),
            drives: w.driver_forces().to_vec(),
            inputs,
            solved,
            others: w.other_drives().to_vec(),
            pairs: (0..solver.spec().pairs.len())
                .map(|pair| of_pair(solver, pair, w))
                .collect(),
            welds: (0..solver.spec().welds.len())
                .map(|weld| solver.weld_force(weld, w))
                .collect(),
            couplings: (0..solver.spec().couplings.len())
                .map(|coupling| solver.coupling_force(coupling, w))
                .collect(),
            indeterminate: match all {
                true => solver.indeterminate(w),
                false => Indeterminate::default(),
            },
            balance: solver.balance(w),
            chi: transmission.and_then(ratio),
            convention: self.settings.convention,
            transmission,
            shaking: solver.shaking(w),
            on_frame: solver.on_frame(w),
            links: links.collect(),
            sensitivities: if full { solver.sensitivities(w) } else { None },
            influence_error: if full { solver.influence_error(w) } else { 0.0 },
        })
    }
}

fn of_pair(solver: &Kinetostatics, pair: usize, w: &ForceWorkspace) -> PairForces {
    let friction = solver.friction(pair, w);
    PairForces {
        point: w.pair_point(pair),
        force: solver.force(pair, w),
        couple: solver.couple(pair, w),
        corners: match solver.reaction(pair, w) {
            Reaction::Pin(_) => None,
            Reaction::Guide(corners) => Some(corners),
        },
        friction: friction.size,
        loss: friction.loss,
    }
}
