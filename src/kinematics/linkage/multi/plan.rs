//! A linkage of several inputs made ready to be solved.

use super::tied::TiedBodies;
use crate::kinematics::linkage::elements::{Element, elements, slides};
use crate::kinematics::linkage::plan::{Driver, Plan};
use crate::kinematics::linkage::spec::{LinkageSpec, PairSpec};

/// An input whose pair leads from what is placed to a further body.
#[derive(Clone, Debug)]
pub(super) struct TreeJoint {
    /// The body that it places: a link, or a massless one between the coordinates of a
    /// floating link.
    pub(super) body: usize,
    /// The body that it starts from; the number of all bodies: the ground.
    pub(super) parent: usize,
    /// Index of the input.
    pub(super) input: usize,
    /// The pair.
    pub(super) driver: Driver,
    /// True: the pair's second link is the parent.
    pub(super) reversed: bool,
    /// Angle between the bodies less the input where the pair's links are welded to them (rad).
    pub(super) shift: f64,
}

/// An input whose pair joins two links that a group places as one body.
#[derive(Clone, Debug)]
pub(super) struct InnerJoint {
    /// The link that carries the body's frame.
    pub(super) base: usize,
    /// The other link.
    pub(super) driven: usize,
    /// Index of the input.
    pub(super) input: usize,
    /// The pair, `base` its first link.
    pub(super) driver: Driver,
    /// Angle between both less the input where the pair's links are welded to them (rad).
    pub(super) shift: f64,
}

/// A pair as a screw: the axis of a pin, or the direction of a guide.
#[derive(Clone, Copy, Debug)]
pub(super) struct Screw {
    /// True for a guide.
    pub(super) slides: bool,
    /// Body of the pin's point, or of the guide.
    pub(super) owner: usize,
    /// The pin's point, or one of the guide's axis, in the frame of the owner (m).
    pub(super) point: [f64; 2],
    /// Direction of the guide in the frame of the owner.
    pub(super) along: [f64; 2],
    /// The bodies of both sides.
    pub(super) sides: [usize; 2],
}

/// How the velocities of a group follow.
#[derive(Clone, Debug)]
pub(super) struct Group {
    /// Links that carry the frames of its bodies.
    pub(super) bases: Vec<usize>,
    /// The input inside one of its bodies.
    pub(super) inner: Option<InnerJoint>,
    /// Pairs of a dyad: from what is placed to the first body, from the first body to the
    /// second, from what is placed to the second.
    pub(super) screws: Vec<Screw>,
    /// Joints of a larger group: pairs, then couplings.
    pub(super) ties: Vec<TiedBodies>,
    /// True for a dyad.
    pub(super) dyad: bool,
    /// True for a dyad of one assembly, singular where its guides are parallel.
    pub(super) parallel: bool,
    /// Inputs that move it, ascending.
    pub(super) active: Vec<usize>,
    /// All its links: those of `bases`, and the one that an input moves inside.
    pub(super) links: Vec<usize>,
    /// Of a dyad for each active input the velocities of what it hangs on.
    pub(super) known: Vec<[Source; 2]>,
    /// Place of its matrix among those of all larger groups.
    pub(super) matrix: usize,
    /// Place of its row exchanges.
    pub(super) exchanged: usize,
}

/// Where the velocity of a body by an input stands.
#[derive(Clone, Copy, Debug)]
pub(super) enum Source {
    /// It does not move the body.
    Rest,
    /// Of a body that inputs alone place: the screw of the input's pair.
    Screw(usize),
    /// Of a body that a group places: index among the columns.
    Column(usize),
}

/// A link with inertia.
#[derive(Clone, Debug)]
pub(super) struct Massive {
    pub(super) body: usize,
    /// Mass (kg), its centre in the link's frame (m), moment of inertia about it (kg·m²).
    pub(super) mass: f64,
    pub(super) centre: [f64; 2],
    pub(super) moment: f64,
    /// Whether inputs alone place it.
    pub(super) placed: bool,
    /// Inputs that move it, ascending.
    pub(super) moved: Vec<usize>,
}

/// Everything that is fixed of a linkage of several inputs.
#[derive(Debug)]
pub(super) struct MultiPlan {
    /// Groups and size; its driver is that of the first input.
    pub(super) plan: Plan,
    /// Number of inputs.
    pub(super) inputs: usize,
    /// Number of bodies: the links, then massless ones.
    pub(super) bodies: usize,
    /// The inputs that lead from the ground outwards, in that order.
    pub(super) tree: Vec<TreeJoint>,
    /// The groups, one for each step of the plan.
    pub(super) groups: Vec<Group>,
    /// Of every body (and of the ground, the last) and input: whether that moves it.
    pub(super) moves: Vec<bool>,
    /// Of every body whether inputs alone place it.
    pub(super) placed: Vec<bool>,
    /// The links that have inertia.
    pub(super) massive: Vec<Massive>,
    /// Of every body whether it, or what inputs hang on it, has inertia.
    pub(super) heavy: Vec<bool>,
    /// Of every body of the tree its place there.
    pub(super) joint_of: Vec<usize>,
    /// Whether a force or an output asks for continuous angles.
    pub(super) turning: bool,
    /// Whether couplings do, or cams tell one assembly from another by what lies between: positions
    /// are found on the way from one to the next.
    pub(super) geared: bool,
    /// Numbers of all matrices of larger groups, and of their rows.
    pub(super) matrices: [usize; 2],
}

impl MultiPlan {
    /// Whether an input moves a body.
    #[inline(always)]
    pub(super) fn is_moved(&self, body: usize, input: usize) -> bool {
        self.moves[body * self.inputs + input]
    }

    /// Where the velocity of a body, or of the ground, by an input stands.
    pub(super) fn source(&self, body: usize, input: usize) -> Source {
        match self.is_moved(body, input) {
            false => Source::Rest,
            true if self.placed[body] => Source::Screw(input),
            true => Source::Column(body * self.inputs + input),
        }
    }

    /// True of an input that is the coordinate of a guide.
    pub(super) fn slides(&self, input: usize) -> bool {
        let tree = self.tree.iter().map(|joint| (joint.input, &joint.driver));
        let inner = self.groups.iter().filter_map(|group| group.inner.as_ref());
        let mut all = tree.chain(inner.map(|joint| (joint.input, &joint.driver)));
        all.any(|(own, driver)| own == input && driver.sliding.is_some())
    }

    /// The body of a link, or the ground.
    #[inline(always)]
    pub(super) fn body_of_link(&self, link: Option<usize>) -> usize {
        link.unwrap_or(self.bodies)
    }
}

impl TreeJoint {
    /// The body that carries the pin's point or the guide.
    #[inline(always)]
    pub(super) fn owner(&self) -> usize {
        if self.reversed {
            self.body
        } else {
            self.parent
        }
    }
}

impl Group {
    /// Number of the body, among those of the group, that a link belongs to.
    pub(super) fn body_of(&self, link: usize) -> Option<usize> {
        let base = match &self.inner {
            Some(inner) if inner.driven == link => inner.base,
            _ => link,
        };
        self.bases.iter().position(|&own| own == base)
    }

    /// Whether its determinant is a smooth function of the inputs where it vanishes.
    pub(super) fn is_linear(&self) -> bool {
        self.parallel
    }

    /// True of the link that an input moves against the one that carries its body's frame.
    pub(super) fn is_driven(&self, link: usize) -> bool {
        self.inner
            .as_ref()
            .is_some_and(|inner| inner.driven == link)
    }
}

impl Screw {
    /// A pair, with the link at its near side first; `ground`: index of the ground.
    pub(super) fn new(pair: &PairSpec, near: Option<usize>, ground: usize) -> Self {
        let [on, link] = elements(pair);
        let body = |element: &Element| element.link.unwrap_or(ground);
        let sides = match on.link == near {
            true => [body(&on), body(&link)],
            false => [body(&link), body(&on)],
        };
        Self {
            slides: slides(pair),
            owner: body(&on),
            point: on.point,
            along: on.along,
            sides,
        }
    }
}

impl TreeJoint {
    /// The coordinate of the pair between the bodies themselves.
    #[inline(always)]
    pub(super) fn coordinate_between_bodies(&self, inputs: &[f64]) -> f64 {
        inputs[self.input] + self.shift
    }
}

impl InnerJoint {
    /// The coordinate of the pair between the bodies themselves.
    #[inline(always)]
    pub(super) fn coordinate_between_bodies(&self, inputs: &[f64]) -> f64 {
        inputs[self.input] + self.shift
    }
}

/// The pair of an input, as a driver.
pub(super) fn driver_of(spec: &LinkageSpec, pair: usize) -> Driver {
    Driver::new(&spec.pairs[pair])
}
