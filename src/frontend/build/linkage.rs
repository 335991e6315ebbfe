//! Linkages: links with named points, pairs that say which points coincide.

use super::{Coupling, Load, builder, one_property};
use crate::frontend::read::Node;

builder! {
    /// A planar linkage of rigid links, with one degree of freedom or several. Points are
    /// named `link.point`, `ground.O`, `rod.origin`.
    Linkage {
        /// Remarks for people.
        description;
        /// The pair whose coordinate the input moves.
        driver;
        /// Input coordinate over the driver's displacement: a constant ratio.
        position;
        /// Input coordinate at which the assembly holds (rad or m).
        start;
        /// Least and greatest input coordinate: the stroke of a cylinder.
        travel;
        /// Weights of the links: false (default), true, or acceleration and direction.
        gravity;
        /// Whether the friction of the pairs acts on the motion.
        joint_friction;
    }
}

impl Linkage {
    /// A linkage driven by an object, or by an output of one.
    pub fn on(input: &str) -> Self {
        Self(super::of_kind("linkage")).set("input", input)
    }

    /// A linkage of several inputs, which are still to be added.
    pub fn of_inputs() -> Self {
        Self(super::of_kind("linkage"))
    }

    /// Adds an input to a linkage of several: one of its independent coordinates.
    pub fn input(self, name: &str, input: LinkageInput) -> Self {
        self.with_entry("inputs", name, input)
    }

    /// Copies a linkage of the catalogue, `linkage/toggle-press`.
    pub fn copy_of(self, catalogued: &str) -> Self {
        self.set("from", catalogued)
    }

    /// Gives a number a name; wherever a number is wanted, the name may stand.
    pub fn dimension(self, name: &str, value: impl Into<Node>) -> Self {
        self.with_entry("dimensions", name, value)
    }

    /// Adds a point of the ground (m, m).
    pub fn ground(self, name: &str, x: impl Into<Node>, y: impl Into<Node>) -> Self {
        self.with_entry("ground", name, (x, y))
    }

    /// Adds a link.
    pub fn link(self, name: &str, link: Link) -> Self {
        self.with_entry("links", name, link)
    }

    /// Adds a pair.
    pub fn pair(self, name: &str, joint: Joint) -> Self {
        self.with_entry("pairs", name, joint)
    }

    /// Adds a coupling of two links: gears, a belt, a rack, a cam.
    pub fn coupling(self, name: &str, coupling: Coupling) -> Self {
        self.with_entry("couplings", name, coupling)
    }

    /// Says on which side a link, or a group, is put together.
    pub fn assembly(self, link: &str, assembly: Assembly) -> Self {
        self.with_entry("assembly", link, assembly)
    }

    /// Adds a force, a spring or a damper.
    pub fn force(self, name: &str, force: LinkageForce) -> Self {
        self.with_entry("forces", name, force)
    }

    /// Adds an output: others hang on it as `linkage.output`.
    pub fn output(self, name: &str, output: Output) -> Self {
        self.with_entry("outputs", name, output)
    }

    fn with_entry(mut self, group: &str, name: &str, value: impl Into<Node>) -> Self {
        self.0.property(group).set_property(name, value);
        self
    }
}

builder! {
    /// An input of a linkage of several. It is free unless an object moves it.
    LinkageInput {
        /// Id of the object that moves it, or one of its outputs.
        object;
        /// With an object: input coordinate over the displacement of that; default 1.
        ratio;
        /// With an object: input coordinate where that is at zero; default 0.
        offset;
        /// Value at which the assembly holds; a free input starts there (rad or m).
        start;
        /// Speed at the start of a free input (rad/s or m/s).
        speed;
    }
}

impl LinkageInput {
    /// The coordinate of a pair.
    pub fn pair(pair: &str) -> Self {
        Self(one_property("pair", pair))
    }

    /// x of the origin of a link that floats.
    pub fn x(link: &str) -> Self {
        Self(one_property("x", link))
    }

    /// y of the origin of a link that floats.
    pub fn y(link: &str) -> Self {
        Self(one_property("y", link))
    }

    /// The angle of a link that floats.
    pub fn angle(link: &str) -> Self {
        Self(one_property("angle", link))
    }

    /// Adds a load on the input.
    pub fn load(mut self, name: &str, load: Load) -> Self {
        self.0.property("loads").set_property(name, load);
        self
    }
}

builder! {
    /// A link. Lengths in m, in the link's own frame.
    Link {
        /// Mass (kg).
        mass;
        /// Centre of mass: [x, y], or x.
        centre;
        /// Moment of inertia about the centre of mass (kg·m²).
        moment;
    }
}

impl Link {
    /// A link without mass whose frame has its origin only.
    #[allow(clippy::new_without_default)]
    pub fn new() -> Self {
        Self(Node::object())
    }

    /// Adds a point.
    pub fn point(mut self, name: &str, x: impl Into<Node>, y: impl Into<Node>) -> Self {
        self.0.property("points").set_property(name, (x, y));
        self
    }

    /// A uniform bar of a mass (kg) between its origin and its only other point.
    pub fn bar(self, mass: impl Into<Node>) -> Self {
        self.set("geometry.mass", mass)
    }
}

builder! {
    /// A pair of a linkage.
    Joint {
        /// Coefficient of Coulomb friction.
        friction;
        /// Diameter of the pin (m), for friction.
        diameter;
    }
}

impl Joint {
    /// A pin that joins two points.
    pub fn revolute(one: &str, other: &str) -> Self {
        Self(one_property("revolute", [one, other]))
    }

    /// A block that slides along a guide: a point of the guide's axis, the direction of
    /// the guide in the frame of its link (rad), the block's point.
    pub fn sliding(guide: &str, direction: impl Into<Node>, block: &str) -> Self {
        let mut sliding = one_property("guide", guide);
        sliding.set_property("direction", direction);
        sliding.set_property("block", block);
        Self(one_property("sliding", sliding))
    }

    /// A sliding pair whose guide is directed towards another point of its axis.
    pub fn sliding_through(guide: &str, through: &str, block: &str) -> Self {
        let mut sliding = one_property("guide", guide);
        sliding.set_property("through", through);
        sliding.set_property("block", block);
        Self(one_property("sliding", sliding))
    }

    /// A weld: the same point on both links, and the angle of the second link's frame less that of
    /// the first (rad). Both are one body.
    pub fn weld(on: &str, link: &str, angle: impl Into<Node>) -> Self {
        let mut weld = one_property("on", on);
        weld.set_property("link", link);
        weld.set_property("angle", angle);
        Self(one_property("weld", weld))
    }
}

/// Assembly of a group of links.
#[derive(Clone, Debug, PartialEq)]
pub struct Assembly(Node);

impl Assembly {
    /// The origin of the link's frame is near this place (m, m).
    pub fn near(x: impl Into<Node>, y: impl Into<Node>) -> Self {
        Self(one_property("near", (x, y)))
    }

    /// The link's angle is near this one (rad).
    pub fn angle(angle: impl Into<Node>) -> Self {
        Self(one_property("angle", angle))
    }

    /// The side on which a group of two links lies: `"+"` or `"-"`.
    pub fn branch(branch: &str) -> Self {
        Self(one_property("branch", branch))
    }
}

impl From<Assembly> for Node {
    fn from(assembly: Assembly) -> Self {
        assembly.0
    }
}

builder! {
    /// A force on a linkage. What has no method is set by its address, as
    /// `strut.force`.
    LinkageForce {}
}

impl LinkageForce {
    /// A constant force [x, y] (N) on a point, of fixed direction.
    pub fn constant(point: &str, x: impl Into<Node>, y: impl Into<Node>) -> Self {
        let mut force = one_property("point", point);
        force.set_property("force", (x, y));
        Self(one_property("force", force))
    }

    /// A couple (N·m) on a link.
    pub fn couple(link: &str, moment: impl Into<Node>) -> Self {
        let mut couple = one_property("link", link);
        couple.set_property("moment", moment);
        Self(one_property("couple", couple))
    }

    /// A spring between two points: rate (N/m) and free length (m).
    pub fn spring(
        from: &str,
        to: &str,
        rate: impl Into<Node>,
        free_length: impl Into<Node>,
    ) -> Self {
        Self::strut(from, to)
            .set("strut.rate", rate)
            .set("strut.free_length", free_length)
    }

    /// A damper between two points (N·s/m).
    pub fn damper(from: &str, to: &str, damping: impl Into<Node>) -> Self {
        Self::strut(from, to).set("strut.damping", damping)
    }

    /// A strut between two points, its rate, damping or force still to be set.
    pub fn strut(from: &str, to: &str) -> Self {
        let mut strut = one_property("from", from);
        strut.set_property("to", to);
        Self(one_property("strut", strut))
    }

    /// A torsion spring in a pair: rate (N·m/rad) and free angle (rad).
    pub fn torsion(pair: &str, rate: impl Into<Node>, free_angle: impl Into<Node>) -> Self {
        let mut torsion = one_property("pair", pair);
        torsion.set_property("rate", rate);
        torsion.set_property("free_angle", free_angle);
        Self(one_property("torsion", torsion))
    }

    /// A force on a point over the input coordinate: points [coordinate, force].
    pub fn table(point: &str, points: impl Into<Node>) -> Self {
        let mut table = one_property("point", point);
        table.set_property("points", points);
        Self(one_property("table", table))
    }
}

/// An output of a linkage.
#[derive(Clone, Debug, PartialEq)]
pub struct Output(Node);

impl Output {
    /// The displacement of a point along a direction in the frame of the ground (rad).
    pub fn point(point: &str, direction: impl Into<Node>) -> Self {
        let mut output = one_property("point", point);
        output.set_property("direction", direction);
        Self(output)
    }

    /// The angle of a link.
    pub fn angle(link: &str) -> Self {
        Self(one_property("angle", link))
    }

    /// The coordinate of a pair.
    pub fn pair(pair: &str) -> Self {
        Self(one_property("pair", pair))
    }
}

impl From<Output> for Node {
    fn from(output: Output) -> Self {
        output.0
    }
}
