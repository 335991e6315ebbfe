//! Joints between links, one file a kind: pins, guides, and couplings of one equation (gears, belts,
//! racks, cams).
//!
//! The file of a coupling holds all that is said of it: its numbers and how they are read, what can
//! be wrong with them, its closing error, the row of the closing equations, the forces on its links,
//! what is drawn, and its words. `kinds!` lists the kinds; nothing else asks for the kind.
//!
//! A row is a set of wrenches on the links ([`Wrench`]): the closing error grows by their power
//! over the velocities of the links. So the same row is the derivative in Newton's method, the
//! equation of the velocities behind several inputs, and, turned over, what the force of the joint
//! does to the links. On power series in time it has its own derivatives.
//!
//! Where links sit together on a third one, that is the carrier. Seen from it a second wheel turns
//! ρ times as far as the first, or a rack slides by ρ times the wheel's angle: θ₂ − θ = ρ·(θ₁ − θ) +
//! q₀, with θ the angle of the carrier. A cam and its roller need no carrier: in the cam's frame the
//! roller's centre lies on the pitch curve.
//!
//! Source: the rolling of two pitch circles on each other (Willis' equation for a moving carrier).

pub(super) mod belt;
pub(super) mod cam;
mod carrier;
mod constraint;
pub(super) mod gear;
mod guide;
mod outline;
pub(super) mod rack;
mod reader;
mod revolute;
#[cfg(test)]
mod tests;
mod wheels;

pub(super) use carrier::Mismatch;
pub(crate) use carrier::carriers;
pub(super) use constraint::{Act, Constraint, Frames, Shape, Turns, Wrench};
pub(crate) use outline::Outline;
pub(crate) use reader::{CarriedLinks, Domain, JointReader, MissingCarrier, Sizes};

use super::elements::elements;
use super::spec::pair::{PairSpec, PointOf};
use crate::fault::Faults;
use crate::math::number::Number;
use crate::math::series::Series;

/// What couplings are, for the schema.
pub(crate) const COUPLINGS: &str = "Gears, belts and racks by name, each between two links (or a link and the ground) that a third one carries; and cams, each between two links.";
/// What their `wheels` are.
pub(crate) const WHEELS: &str =
    "The two links, with the wheels or the gear and its rack; `ground` for what stands still.";
/// What their `offset` is.
pub(crate) const OFFSET: &str = "Angle of the second wheel (or displacement of the rack) seen from the carrier where that of the first is zero: how they were put together";

/// A coupling: one equation between links, such as that the angle of one follows that of another.
#[derive(Clone, Debug, PartialEq)]
pub struct CouplingSpec {
    /// Name of the coupling.
    pub name: String,
    /// The links with the wheels, with the wheel and the rack, or with the cam and the roller: indices into
    /// [`LinkageSpec::links`](super::spec::LinkageSpec::links); `None`: the ground.
    pub wheels: [Option<usize>; 2],
    /// The link that carries both; `None`: the ground. Of a cam its own link.
    pub carrier: Option<usize>,
    /// Gears, a belt, a rack, or a cam.
    pub kind: CouplingKind,
    /// Angle of the second wheel, or displacement of the rack, seen from the carrier, where the
    /// first wheel's angle is zero (rad or m). Of a cam 0.
    pub offset: f64,
}

impl CouplingSpec {
    /// The links that it ties.
    pub(super) fn links(&self) -> [Option<usize>; 3] {
        let [one, other] = self.wheels;
        [one, other, self.carrier]
    }

    /// The points at which it joins its links.
    pub(super) fn points(&self) -> Vec<PointOf> {
        self.kind.as_kind().points(self.wheels)
    }

    /// How its links follow each other, and what it is called.
    pub(crate) fn link_following(&self) -> (&'static str, Following) {
        self.kind.as_kind().link_following()
    }

    /// Made ready, having been checked.
    pub(super) fn to_joint(&self, pairs: &[PairSpec]) -> Option<Joint> {
        self.kind.as_kind().to_joint(self, pairs)
    }
}

/// How the second link of a coupling follows the first, seen from their carrier.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Following {
    /// It turns as far times this.
    Turns(f64),
    /// It slides by this for a radian (m).
    Slides(f64),
    /// By no such rule; in words.
    InWords(&'static str),
}

/// A kind of coupling, by its numbers.
pub(in crate::kinematics::linkage) trait Kind {
    /// Everything wrong with its numbers; `path`: address of the coupling.
    fn check(&self, path: &str, faults: &mut Faults);

    /// Whether the links are joined as it needs.
    fn check_links(&self, coupling: &CouplingSpec, pairs: &[PairSpec]) -> Result<(), Mismatch>;

    /// Made ready, having been checked.
    fn to_joint(&self, coupling: &CouplingSpec, pairs: &[PairSpec]) -> Option<Joint>;

    /// What it looks like, having been checked.
    fn outlines(&self, coupling: &CouplingSpec, pairs: &[PairSpec]) -> Vec<Outline>;

    /// Its words.
    fn words(&self) -> Words;

    /// How its links follow each other, and what it is called.
    fn link_following(&self) -> (&'static str, Following);

    /// The points at which it joins its links.
    fn points(&self, _wheels: [Option<usize>; 2]) -> Vec<PointOf> {
        Vec::new()
    }

    /// A length of its own that is typical of it (m); 0: none.
    fn typical_length(&self) -> f64 {
        0.0
    }

    /// True where it presses and cannot pull.
    fn is_one_sided(&self) -> bool {
        false
    }

    /// A sentence where it is allowed and hardly meant.
    fn remark(&self, _name: &str) -> Option<String> {
        None
    }
}

/// Words about a kind.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Words {
    /// What its force is called, before its name: `Circumferential force of`.
    pub(crate) force: &'static str,
    /// Where its force is drawn.
    pub(crate) drawn: &'static str,
    /// Whether it is one force that can be drawn.
    pub(crate) is_one_force: bool,
    /// What a single link is called that it holds.
    pub(crate) held_link: &'static str,
}

/// How a kind is written in a scene.
pub(crate) struct Declaration {
    /// Its key.
    pub(crate) key: &'static str,
    /// What it is, for the schema.
    pub(crate) doc: &'static str,
    /// Reads its properties; the name of the coupling is left open.
    pub(crate) read: fn(&mut dyn JointReader) -> Option<CouplingSpec>,
    /// Some of its kind, whose rows and rates are compared with differences.
    #[cfg(test)]
    pub(crate) samples: fn() -> Vec<tests::Sample>,
}

/// The kinds: name, file, numbers, mechanics.
macro_rules! kinds {
    ($($(#[$doc:meta])* $Kind:ident: $file:ident, $Numbers:ty, $Ready:ty;)*) => {
        /// Kind of a coupling, with its numbers.
        #[derive(Clone, Debug, PartialEq)]
        pub enum CouplingKind {
            $($(#[$doc])* $Kind($Numbers)),*
        }

        impl CouplingKind {
            /// Its numbers.
            pub(super) fn as_kind(&self) -> &dyn Kind {
                match self {
                    $(Self::$Kind(own) => own),*
                }
            }
        }

        /// How each kind is written in a scene.
        pub(crate) const DECLARATIONS: &[&Declaration] = &[$(&$file::DECLARATION),*];

        each_joint! {
            Revolute(revolute::PinInHole),
            Guide(guide::BlockOnGuide),
            $($Kind($Ready)),*
        }
    };
}

/// A joint made ready, and what is asked of it whatever its kind.
macro_rules! each_joint {
    ($($Kind:ident($Ready:ty)),*) => {
        /// A joint made ready.
        #[derive(Clone, Debug)]
        #[allow(missing_docs, reason = "the kinds say what they are")]
        pub(super) enum Joint {
            $($Kind($Ready)),*
        }

        impl Joint {
            /// What is fixed of its equations.
            #[inline(always)]
            pub(super) fn shape(&self) -> Shape {
                match self {
                    $(Self::$Kind(_) => <$Ready as Constraint>::SHAPE),*
                }
            }

            /// Its closing errors (rad or m).
            #[inline(always)]
            pub(super) fn errors<const K: usize>(
                &self,
                links: &impl Turns<K>,
                set: impl FnMut(usize, Series<K>),
            ) {
                match self {
                    $(Self::$Kind(own) => own.errors(links, set)),*
                }
            }

            /// Its rows: the power of these wrenches is the rate of the closing error.
            #[inline(always)]
            pub(super) fn rows<const K: usize, T: Number>(
                &self,
                links: &impl Frames<K, T>,
                add: impl FnMut(usize, usize, Wrench<K, T>),
            ) {
                match self {
                    $(Self::$Kind(own) => own.rows(links, add)),*
                }
            }

            /// Whether its links lie to each other as they are meant.
            pub(super) fn is_proper(&self, links: &impl Frames<1, f64>) -> bool {
                match self {
                    $(Self::$Kind(own) => own.is_proper(links)),*
                }
            }

            /// What a unit of its force does to the first and the second link.
            pub(super) fn acts(&self, links: &impl Frames<1, f64>) -> [Act; 2] {
                match self {
                    $(Self::$Kind(own) => own.unit_force_acts(links)),*
                }
            }
        }
    };
}

impl Joint {
    /// A pair made ready; its links are the one with the pin or guide, and the other.
    pub(super) fn of_pair(pair: &PairSpec) -> Self {
        let elements = elements(pair);
        match pair.slides() {
            true => Self::Guide(guide::BlockOnGuide(elements)),
            false => Self::Revolute(revolute::PinInHole(elements)),
        }
    }
}

impl CouplingKind {
    /// Its words.
    pub(crate) fn words(&self) -> Words {
        self.as_kind().words()
    }

    /// True where it presses and cannot pull.
    pub(crate) fn is_one_sided(&self) -> bool {
        self.as_kind().is_one_sided()
    }
}

kinds! {
    /// Two gears.
    Gear: gear, gear::Gear, wheels::TwoWheels;
    /// A belt or chain over two pulleys.
    Belt: belt, belt::Belt, wheels::TwoWheels;
    /// A gear and a rack on a guide of the carrier.
    Rack: rack, rack::Rack, rack::RackAndWheel;
    /// A cam on which a roller or a point of another link runs.
    Cam: cam, Box<cam::CamPairSpec>, cam::RollerOnCam;
}
