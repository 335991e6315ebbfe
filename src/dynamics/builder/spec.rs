//! What a scene says of each object, in plain numbers and SI units.
//!
//! The kinds' files read these from the scene; the builder turns them into the
//! model. Angles in radians; for sliding objects read m for rad, kg for kg·m²,
//! N for N·m.

pub use super::level::{InertiaSplit, Level, Lumping, Uniform};
pub use super::written::WrittenSpec;
pub use crate::dynamics::laws::LawInstance;
use crate::dynamics::load::CustomLoad;
use crate::dynamics::model::{Closure, ContactForm, ContactLaw, Coordinate, DryFriction};
pub use crate::kinematics::hertzian::ContactPressure;
use crate::kinematics::linkage::multi::spec::MultiSpec;
use crate::kinematics::linkage::spec::LinkageSpec;
pub use crate::kinematics::motion::DriveMotionSpec;
use crate::kinematics::position::PositionSpec;
use crate::math::expression::Expression;

/// A drive: the source of motion.
#[derive(Clone, Debug, PartialEq)]
pub enum DriveSpec {
    /// Motion prescribed over time.
    Prescribed(DriveMotionSpec),
    /// A motor: its angle is a coordinate of the system.
    Motor(MotorSpec),
}

/// A motor: rotor inertia and torque characteristic.
#[derive(Clone, Debug, PartialEq)]
pub struct MotorSpec {
    /// Rotor inertia (kg·m²), ≥ 0.
    pub inertia: f64,
    /// Angle at t = 0 (rad).
    pub angle: f64,
    /// Speed at t = 0 (rad/s).
    pub speed: f64,
    /// Driving torque as a function of speed.
    pub torque: LoadLawSpec,
    /// Further loads on the rotor.
    pub loads: Vec<LoadSpec>,
}

/// A planar linkage of rigid links, and how it is driven.
#[derive(Clone, Debug, PartialEq)]
pub struct DrivenLinkage {
    /// Whether the driven pair turns or slides.
    pub coordinate: Coordinate,
    /// Input coordinate over the driver's displacement, a constant ratio.
    pub position: PositionSpec,
    /// Whether the friction of its pairs acts on its motion.
    pub joint_friction: bool,
    /// The linkage itself.
    pub linkage: LinkageSpec,
    /// Loads on each of its outputs, along it.
    pub loads: Vec<Vec<LoadSpec>>,
}

/// A planar linkage of several inputs, and what moves each of them.
#[derive(Clone, Debug, PartialEq)]
pub struct DrivenMultiLinkage {
    /// Whether its first input turns or slides.
    pub coordinate: Coordinate,
    /// The linkage itself; the start of an input whose motion another object gives is
    /// where that stands at t = 0, unless [`InputDrive::Object`] says another.
    pub linkage: MultiSpec,
    /// Whether the friction of the pairs acts on the motion.
    pub joint_friction: bool,
    /// What moves each input, and the loads on it.
    pub inputs: Vec<(InputDrive, Vec<LoadSpec>)>,
    /// Loads on each of its outputs, along it.
    pub loads: Vec<Vec<LoadSpec>>,
}

/// What moves an input of a linkage of several.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum InputDrive {
    /// Nothing: it is a free coordinate, from its start on at this speed (rad/s or m/s).
    Free {
        /// Speed at t = 0.
        speed: f64,
    },
    /// An object that the port of its name hangs on: q = ratio·φ + offset.
    Object {
        /// ∂q/∂φ.
        ratio: f64,
        /// q where the object is at zero.
        offset: f64,
        /// Value of q at which the assembly holds; `None`: that at t = 0.
        start: Option<f64>,
    },
}

/// Any driven object: masses, links, pair, loads.
#[derive(Clone, Debug, PartialEq)]
pub struct ChainSpec {
    /// Turning or sliding.
    pub coordinate: Coordinate,
    /// Position function from the driver.
    pub position: PositionSpec,
    /// Factor on U: a lever ratio, or a lever arm in metres where the motion
    /// changes from turning to sliding. 1 when absent.
    pub lever: f64,
    /// Inertia, stiffness, damping and number of masses.
    pub body: BodySpec,
    /// The driving pair of link 1.
    pub pair: PairSpec,
    /// Loads in the order of their names.
    pub loads: Vec<LoadSpec>,
    /// One-sided stops of the last mass against the ground, in the order of their names.
    pub stops: Vec<StopSpec>,
}

impl ChainSpec {
    /// Number of masses that move by themselves: a rigid body on a contact element is one.
    pub fn masses(&self) -> usize {
        let on_contact = usize::from(self.pair.contact.is_some());
        self.body.masses().max(on_contact)
    }
}

/// Inertia, stiffness and damping of a chain.
#[derive(Clone, Debug, PartialEq)]
pub enum BodySpec {
    /// `masses: 0`.
    Rigid {
        /// J (kg·m² or kg), ≥ 0.
        inertia: f64,
    },
    /// From few data: J, c, ψ (or b) and n.
    Uniform {
        /// Total inertia J.
        inertia: f64,
        /// Stiffness c seen at the last mass.
        stiffness: f64,
        /// Specific damping capacity ψ.
        damping_capacity: f64,
        /// n ≥ 1.
        masses: usize,
        /// Split of J over the masses.
        split: InertiaSplit,
        /// Place of the inertia of each cell.
        lumping: Lumping,
    },
    /// The lowest vibration modes of the uniform object, held at its driven end; the
    /// others as far as they give way under slow forces. Without modes: `flexibility:
    /// "static"`.
    Modes {
        /// Total inertia J.
        inertia: f64,
        /// Stiffness c seen at the output.
        stiffness: f64,
        /// Specific damping capacity ψ.
        damping_capacity: f64,
        /// Number of modes; 0: static flexibility.
        modes: usize,
        /// Distribution of J along the object: `Equal`, a rod; `Cubes`, a lever.
        split: InertiaSplit,
    },
    /// `masses: "auto"`: the uniform object, its level to be chosen. Until it is chosen it
    /// stands for one mass.
    Open(Uniform),
    /// Explicit lists, all of the same length n ≥ 1.
    Lists {
        /// J_m.
        inertias: Vec<f64>,
        /// c_m.
        stiffnesses: Vec<f64>,
        /// b_m.
        dampings: Vec<f64>,
    },
}

impl BodySpec {
    /// Number of masses; 0 of a rigid object, 1 of one that is reduced to modes, its
    /// output, and of one whose level is open.
    pub fn masses(&self) -> usize {
        match self {
            Self::Rigid { .. } => 0,
            Self::Uniform { masses, .. } => *masses,
            Self::Modes { modes, .. } => usize::from(*modes > 0),
            Self::Open(_) => 1,
            Self::Lists { inertias, .. } => inertias.len(),
        }
    }
}

/// The kinematic pair of link 1 (or of a rigid object).
#[derive(Clone, Debug, PartialEq)]
pub struct PairSpec {
    /// Closure: how the pair is kept together.
    pub closure: Closure,
    /// Gap η ≥ 0 of a form-closed pair.
    pub gap: f64,
    /// +1: a force-closed pair lifts off towards x > 0; −1: turned round.
    pub opens: f64,
    /// Form of the force of link 1, where there is no contact element.
    pub form: ContactForm,
    /// The contact element.
    pub contact: Option<ContactSpec>,
}

/// A contact element: stiffness and law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactSpec {
    /// k_c > 0 (N/m or N·m/rad), or K of a power of the indentation; of a rigid contact 0.
    pub stiffness: f64,
    /// Law of the contact force.
    pub law: ContactLaw,
    /// Where the stiffness is to follow from the object's own cam, which whoever reads that
    /// has to work out: then it is no number yet. `None` of a contact that is ready.
    pub on_cam: Option<OnCamSpec>,
    /// The pressure over its force, where its geometry is known.
    pub pressure: Option<ContactPressure>,
}

/// The contact of a follower on its own cam, as the stiffness needs it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OnCamSpec {
    /// Force along the normal at which the stiffness is the secant (N), > 0.
    pub load: f64,
    /// Angle of the cam (rad); `None`: where its profile is most sharply convex.
    pub angle: Option<f64>,
    /// Depths from which the approach is counted where follower and cam are flat or hollow
    /// (m), > 0.
    pub depths: [Option<f64>; 2],
}

/// A named stop of the last mass against the ground.
#[derive(Clone, Debug, PartialEq)]
pub struct StopSpec {
    /// Its name in the scene.
    pub name: String,
    /// Displacement at which it is touched (rad or m).
    pub at: f64,
    /// −1: it holds the mass from going below `at`; +1: from going above.
    pub side: f64,
    /// Its contact.
    pub contact: ContactSpec,
}

/// A named load.
#[derive(Clone, Debug, PartialEq)]
pub struct LoadSpec {
    /// Name of the load in the scene.
    pub name: String,
    /// Masses that it acts on.
    pub mass: MassChoice,
    /// Law of the force.
    pub law: LoadLawSpec,
}

/// Masses of an object that a load acts on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MassChoice {
    /// The last mass (default, except for a weight).
    Last,
    /// The first mass.
    First,
    /// Mass m, counted from 1.
    Number(usize),
    /// Every mass (default of a weight).
    All,
}

/// A load's law. Positive forces act in the direction of positive displacement.
#[derive(Clone, Debug, PartialEq)]
pub enum LoadLawSpec {
    /// `{ "constant": W }`.
    Constant(f64),
    /// `{ "time_table": [[t, W], …] }`: linear between the points, constant outside.
    TimeTable(Vec<(f64, f64)>),
    /// `{ "position_table": { "points": [[φ, W], …], "period": P or absent } }` over the
    /// driver's displacement, or that of another object: linear between the points; constant
    /// outside without a period.
    PositionTable {
        /// (φ, W), φ strictly ascending; with a period within one of it.
        points: Vec<(f64, f64)>,
        /// Repeats after this much of φ.
        period: Option<f64>,
        /// The object or output whose displacement φ is; `None`: the driver.
        over: Option<String>,
    },
    /// `{ "window": { "from", "to", "force", "period" = 360 deg for a turning driver } }`:
    /// `force` while the driver, or another object, is between the two positions, else 0.
    Window {
        /// Start of the window (displacement φ of the driver).
        from: f64,
        /// End of the window, > from.
        to: f64,
        /// W inside.
        force: f64,
        /// Repeats after this much of φ; `None`: once.
        period: Option<f64>,
        /// The object or output whose displacement φ is; `None`: the driver.
        over: Option<String>,
    },
    /// `{ "friction": { "sliding", "static" = sliding, "stribeck_speed" or absent } }`: dry
    /// friction that sticks, against the ground or against another object.
    Dry {
        /// Its numbers.
        friction: DryFriction,
        /// Factor on its forces over time and motions, 0 where it is below; `None`: always 1.
        engagement: Option<Expression>,
        /// The object or output that it rubs on; `None`: the ground.
        over: Option<String>,
    },
    /// A law over the own motion that the library declares: `{ "spring": { "rate", "preload" } }`.
    Declared(LawInstance),
    /// `{ "weight": { "inclination" } }` (sliders): W = −m·g·sin(inclination) with
    /// the mass m that it acts on (each its own where there are several), the
    /// inclination of the positive direction above the horizontal.
    Weight {
        /// Angle above the horizontal (rad).
        inclination: f64,
    },
    /// `{ "table": [[φ̇, W], …] }` of a motor: linear between the points, constant outside.
    SpeedTable(Vec<(f64, f64)>),
    /// `{ "expression": "120*sin(2*pi*5*t)", "unit": "kN" }` over time and motions, and
    /// `{ "harmonic": … }`.
    Written(WrittenSpec),
    /// Anything else over displacement and speed of the mass: no text describes it.
    Custom(CustomLoad),
}

impl LoadLawSpec {
    /// The object or output, other than the driver, to whose motion the law refers.
    pub fn over(&self) -> Option<&String> {
        match self {
            Self::PositionTable { over, .. }
            | Self::Window { over, .. }
            | Self::Dry { over, .. } => over.as_ref(),
            Self::Written(written) => written.over.as_ref(),
            Self::Constant(_)
            | Self::TimeTable(_)
            | Self::Declared(_)
            | Self::Weight { .. }
            | Self::SpeedTable(_)
            | Self::Custom(_) => None,
        }
    }

    /// The same law over the motion of another object or output.
    #[must_use]
    pub fn over_another(mut self, other: Option<String>) -> Self {
        match &mut self {
            Self::PositionTable { over, .. }
            | Self::Window { over, .. }
            | Self::Dry { over, .. } => *over = other,
            Self::Written(written) => written.over = other,
            Self::Constant(_)
            | Self::TimeTable(_)
            | Self::Declared(_)
            | Self::Weight { .. }
            | Self::SpeedTable(_)
            | Self::Custom(_) => {}
        }
        self
    }
}
