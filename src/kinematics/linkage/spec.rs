//! A planar linkage in plain numbers: links, pairs, couplings, driver, outputs, forces.
//!
//! SI units; x to the right, y up, angles counterclockwise. Lists stand in the
//! order of their names, so that nothing depends on the order in a file.

pub(super) mod pair;

pub(crate) use super::joints::Following;
pub use super::joints::cam::CamPairSpec;
pub use super::joints::{CouplingKind, CouplingSpec};
pub(crate) use pair::Tie;
pub use pair::{PairKind, PairSpec, PointOf};

/// A planar linkage of rigid links, lower pairs, gears, belts, racks and cams with one degree of freedom.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LinkageSpec {
    /// The moving links.
    pub links: Vec<LinkSpec>,
    /// Named points of the ground (m).
    pub ground: Vec<NamedPoint>,
    /// The kinematic pairs.
    pub pairs: Vec<PairSpec>,
    /// Gears, belts, racks and cams between links.
    pub couplings: Vec<CouplingSpec>,
    /// Links that are welded together.
    pub welds: Vec<WeldSpec>,
    /// Constraints that hold what is held already, and are left out where positions are solved for.
    /// [`Linkage::new`](super::Linkage::new) and [`MultiLinkage::new`](super::multi::MultiLinkage::new)
    /// find them where none is given.
    pub redundant: Vec<Redundant>,
    /// The pair whose relative motion is the input coordinate, index into
    /// [`Self::pairs`].
    pub driver: usize,
    /// Assemblies of the groups that are not left to the default.
    pub assembly: Vec<AssemblySpec>,
    /// Input coordinate at which the approximate positions of
    /// [`Self::assembly`] hold (rad or m).
    pub start: f64,
    /// Limits of the input coordinate (rad or m), such as the stroke of a
    /// cylinder; `None`: as far as the links allow.
    pub travel: Option<[f64; 2]>,
    /// Acceleration of free fall as a vector (m/s²); `[0, 0]`: no gravity.
    pub gravity: [f64; 2],
    /// Springs, dampers and forces.
    pub forces: Vec<ForceSpec>,
    /// Outputs, which other objects or the user may look at.
    pub outputs: Vec<OutputSpec>,
}

impl LinkageSpec {
    /// The points of links at which pairs and couplings join them.
    pub(crate) fn joints(&self) -> impl Iterator<Item = PointOf> {
        let pairs = self.pairs.iter().flat_map(|pair| [pair.on, pair.link]);
        pairs.chain(self.couplings.iter().flat_map(CouplingSpec::points))
    }

    /// The pairs and welds as ties between two links.
    pub(crate) fn ties(&self) -> impl Iterator<Item = Tie<'_>> {
        let pairs = self.pairs.iter().enumerate();
        let pairs = pairs.map(|(index, pair)| pair.tie(index));
        let welds = self.welds.iter().map(|weld| Tie {
            name: &weld.name,
            ends: [weld.on, weld.link],
            slides: None,
            turned: Some(weld.angle),
            direction: 0.0,
        });
        pairs.chain(welds)
    }

    /// The greatest length of a coupling itself, such as the prime radius of a cam (m).
    pub(crate) fn greatest_coupling(&self) -> f64 {
        let lengths = self
            .couplings
            .iter()
            .map(|one| one.kind.as_kind().typical_length());
        lengths.fold(0.0, f64::max)
    }
}

/// A point with a name, in the frame of its link or of the ground.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedPoint {
    /// Name of the point.
    pub name: String,
    /// Coordinates (m).
    pub at: [f64; 2],
}

/// A rigid link. Its frame is its own; its named points say where things are.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LinkSpec {
    /// Name of the link.
    pub name: String,
    /// Points in its frame (m).
    pub points: Vec<NamedPoint>,
    /// Mass m ≥ 0 (kg).
    pub mass: f64,
    /// Centre of mass in its frame (m).
    pub centre: [f64; 2],
    /// Moment of inertia about the centre of mass, ≥ 0 (kg·m²).
    pub moment: f64,
}

/// A weld that joins link i (`on`) to link j (`link`), or one of them to the ground.
#[derive(Clone, Debug, PartialEq)]
pub struct WeldSpec {
    /// Its name; none of the pairs has it.
    pub name: String,
    /// Point on link i, where j's point lies; its force and couple refer to it.
    pub on: PointOf,
    /// Point on link j.
    pub link: PointOf,
    /// Angle of j's frame less that of i's (rad).
    pub angle: f64,
}

/// A constraint that is left out, because it follows from the others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Redundant {
    /// The pair, index into [`LinkageSpec::pairs`].
    pub pair: usize,
    /// The part of it that is left out.
    pub part: RedundantPart,
}

/// The part of a pair that is left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RedundantPart {
    /// All of it: both equations.
    Whole,
    /// Of a pin of this link, which has one other pair: along the line to its other pin (the link's
    /// length), or across its guide.
    Along(usize),
    /// Of a guide: that its block does not turn.
    Couple,
}

impl Redundant {
    /// Number of equations that are left out.
    pub fn equations(&self) -> usize {
        match self.part {
            RedundantPart::Whole => 2,
            RedundantPart::Along(_) | RedundantPart::Couple => 1,
        }
    }
}

/// Assembly of one Assur group: the group that contains `link`.
#[derive(Clone, Debug, PartialEq)]
pub struct AssemblySpec {
    /// Index into [`LinkageSpec::links`].
    pub link: usize,
    /// The choice.
    pub choice: AssemblyChoice,
}

/// The choice between the ways to put a group together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AssemblyChoice {
    /// +1 or −1: the branch of a dyad as [`Group`](super::Group) says it.
    Branch(f64),
    /// The frame of the link is near this angle at the start (rad).
    Angle(f64),
    /// A point of the link (in its frame) is near this place at the start (m).
    Near {
        /// The point, in the frame of the link.
        point: [f64; 2],
        /// The place, in the frame of the ground.
        place: [f64; 2],
    },
}

/// A spring, damper or force.
#[derive(Clone, Debug, PartialEq)]
pub struct ForceSpec {
    /// Name of the force.
    pub name: String,
    /// Law of the force.
    pub law: ForceLaw,
}

/// Laws of force of a linkage.
#[derive(Clone, Debug, PartialEq)]
pub enum ForceLaw {
    /// A spring, a damper and a constant force in parallel between two points:
    /// tension N = rate·(l − free_length) + damping·l̇ + force, which pulls the
    /// ends together. Where the ends meet it has no direction and is taken as zero.
    Strut {
        /// One end.
        from: PointOf,
        /// The other end.
        to: PointOf,
        /// Rate ≥ 0 (N/m).
        rate: f64,
        /// Length without force ≥ 0 (m).
        free_length: f64,
        /// Damping ≥ 0 (N·s/m).
        damping: f64,
        /// Constant part of the tension (N): positive pulls the ends together,
        /// negative presses them apart, as a gas spring does.
        force: f64,
    },
    /// A constant force on a point.
    Force {
        /// Point that it acts on.
        point: PointOf,
        /// The force (N).
        force: [f64; 2],
        /// True: the vector turns with the link; false: fixed directions.
        follows: bool,
    },
    /// A constant couple on a link (N·m).
    Couple {
        /// Index into [`LinkageSpec::links`].
        link: usize,
        /// The couple, counterclockwise (N·m).
        couple: f64,
    },
    /// A torsion spring and damper in a revolute pair, on j from i:
    /// −rate·(θ − free_angle) − damping·θ̇ with the pair's coordinate θ.
    Torsion {
        /// Index into [`LinkageSpec::pairs`].
        pair: usize,
        /// Rate ≥ 0 (N·m/rad).
        rate: f64,
        /// Angle without couple (rad).
        free_angle: f64,
        /// Damping ≥ 0 (N·m·s/rad).
        damping: f64,
    },
    /// A couple on a link, a function of the input coordinate: linear between the
    /// points, constant outside or periodic.
    CoupleTable {
        /// Index into [`LinkageSpec::links`].
        link: usize,
        /// (input coordinate, couple in N·m counterclockwise), ascending.
        points: Vec<(f64, f64)>,
        /// Repeats after this much of the input coordinate.
        period: Option<f64>,
    },
    /// A force on a point along a direction, a function of the input
    /// coordinate: linear between the points, constant outside or periodic.
    Table {
        /// Point that it acts on.
        point: PointOf,
        /// Direction in the frame of the ground (rad).
        direction: f64,
        /// (input coordinate, force in N), ascending.
        points: Vec<(f64, f64)>,
        /// Repeats after this much of the input coordinate.
        period: Option<f64>,
    },
}

/// An output: its displacement is a position function of the input coordinate.
#[derive(Clone, Debug, PartialEq)]
pub struct OutputSpec {
    /// Name of the output.
    pub name: String,
    /// Quantity that it is.
    pub kind: OutputKind,
}

/// Quantity that an output is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum OutputKind {
    /// The angle of a link's frame, continuous over the turns (rad).
    Angle {
        /// Index into [`LinkageSpec::links`].
        link: usize,
    },
    /// The displacement of a point along a direction (m), from the origin of
    /// the ground's frame.
    Point {
        /// The point.
        point: PointOf,
        /// The direction in the frame of the ground (rad).
        direction: f64,
    },
    /// The relative coordinate of a pair (rad or m).
    Pair {
        /// Index into [`LinkageSpec::pairs`].
        pair: usize,
    },
}
