//! Driving pairs, dimensions, disc cams.

use super::{builder, one_property};
use crate::frontend::read::Node;

builder! {
    /// The driving pair of an object: what holds it on its driver.
    Pair {
        /// Gap of a form-closed pair (rad or m).
        gap;
        /// Side towards which a force-closed pair opens: `"+"` (default) or `"-"`.
        opens;
        /// Law of the contact force: `"kelvin_voigt"` c·p + b·ṗ (default), `"hunt_crossley"`
        /// c·p·(1 + κ·ṗ). A contact element takes more of them.
        law;
        /// Contact element in front of link 1, with a law of its own.
        contact;
    }
}

builder! {
    /// A contact element between an object and its driver, independent of the number of
    /// masses.
    Contact {
        /// Stiffness k (N/m or N·m/rad), or K of Hertz (N/m^(3/2) or N·m/rad^(3/2)).
        stiffness;
        /// Law of the contact force over the indentation p: `"elastic"` k·p (default),
        /// `"kelvin_voigt"` k·p + b·ṗ, `"hunt_crossley"` k·p·(1 + χ·ṗ), `"hertz"`
        /// K·p^(3/2)·(1 + χ·ṗ), `"restitution"` rigid, with impacts. The schema lists all laws
        /// with their numbers, which are set by their names.
        law;
        /// Damping of Kelvin–Voigt (N·s/m or N·m·s/rad).
        damping;
        /// χ of Hunt–Crossley and Hertz, seconds per unit of indentation.
        dissipation;
        /// e of a rigid contact: the speed after an impact over that before it.
        restitution;
    }
}

builder! {
    /// A one-sided stop of the last mass of an object against the ground: a valve seat, an
    /// end stop.
    Stop {
        /// Displacement at which it is touched (rad or m).
        at;
        /// `"-"`: it holds the mass from going below that; `"+"`: from going above.
        side;
        /// Its contact.
        contact;
    }
}

impl Stop {
    /// Holds the mass from going below a displacement.
    pub fn below(at: impl Into<Node>, contact: impl Into<Node>) -> Self {
        Self(one_property("at", at)).side("-").contact(contact)
    }

    /// Holds the mass from going above a displacement.
    pub fn above(at: impl Into<Node>, contact: impl Into<Node>) -> Self {
        Self(one_property("at", at)).side("+").contact(contact)
    }
}

builder! {
    /// Geometry of a contact along a line, from which its stiffness follows. Lengths in m;
    /// radii are positive convex, negative hollow, absent: flat.
    LineContact {
        /// Radius of the object.
        radius;
        /// Depth below a flat or hollow surface of the object from which its approach counts.
        depth;
        /// Radius of the counter-body.
        counter_radius;
        /// Depth below a flat or hollow surface of the counter-body.
        counter_depth;
        /// Length of the line of contact.
        width;
        /// Contact force at which the stiffness is the secant (N).
        load;
        /// Young's modulus of the object (Pa).
        modulus;
        /// Poisson's ratio of the object; default 0.3.
        poisson_ratio;
        /// Young's modulus of the counter-body; default: that of the object.
        counter_modulus;
        /// Poisson's ratio of the counter-body; default: that of the object.
        counter_poisson_ratio;
        /// Arm on which the contact acts, of an object that turns.
        arm;
    }
}

impl LineContact {
    /// A line of a length (m), under a load (N), of bodies with this Young's modulus (Pa).
    pub fn new(width: impl Into<Node>, load: impl Into<Node>, modulus: impl Into<Node>) -> Self {
        Self(one_property("width", width))
            .load(load)
            .modulus(modulus)
    }
}

builder! {
    /// Geometry of a contact in a point, from which its stiffness follows by Hertz. Lengths in
    /// m; radii are positive convex, negative hollow, absent: flat.
    PointContact {
        /// Radius of the object.
        radius;
        /// Radius of the object across its motion; default: `radius`, a ball.
        crown_radius;
        /// Radius of the counter-body.
        counter_radius;
        /// Radius of the counter-body across the motion.
        counter_crown_radius;
        /// Young's modulus of the object (Pa).
        modulus;
        /// Poisson's ratio of the object; default 0.3.
        poisson_ratio;
        /// Young's modulus of the counter-body; default: that of the object.
        counter_modulus;
        /// Poisson's ratio of the counter-body; default: that of the object.
        counter_poisson_ratio;
        /// Arm on which the contact acts, of an object that turns.
        arm;
    }
}

impl PointContact {
    /// A ball of this radius (m) on a plate, both with this Young's modulus (Pa).
    pub fn ball(radius: impl Into<Node>, modulus: impl Into<Node>) -> Self {
        Self(one_property("radius", radius)).modulus(modulus)
    }
}

builder! {
    /// The contact of a follower on its own cam, from which its stiffness follows: radii,
    /// width and moduli are those of the cam and its material.
    CamContact {
        /// Angle of the cam (rad); default: where its profile is most sharply convex.
        at;
        /// Depth below a flat face from which its approach counts (m).
        depth;
        /// Depth below the cam's surface, where that is flat or hollow (m).
        cam_depth;
    }
}

impl CamContact {
    /// Under a load along the normal (N), at which the stiffness is the secant.
    pub fn new(load: impl Into<Node>) -> Self {
        Self(one_property("load", load))
    }
}

impl Contact {
    /// N = k·p, k from the object's own cam.
    pub fn on_cam(cam: impl Into<Node>) -> Self {
        Self(one_property("from", one_property("cam", cam)))
    }

    /// N = k·p, k from the geometry of a contact along a line.
    pub fn line(line: impl Into<Node>) -> Self {
        Self(one_property("from", one_property("line", line)))
    }

    /// N = K·p^(3/2), K from the geometry of a contact in a point.
    pub fn point(point: impl Into<Node>) -> Self {
        Self(one_property("from", one_property("point", point))).law("hertz")
    }

    /// N = k·p.
    pub fn elastic(stiffness: impl Into<Node>) -> Self {
        Self(one_property("stiffness", stiffness))
    }

    /// N = k·p + b·ṗ.
    pub fn kelvin_voigt(stiffness: impl Into<Node>, damping: impl Into<Node>) -> Self {
        Self::elastic(stiffness)
            .law("kelvin_voigt")
            .damping(damping)
    }

    /// N = k·p·(1 + χ·ṗ).
    pub fn hunt_crossley(stiffness: impl Into<Node>, dissipation: impl Into<Node>) -> Self {
        Self::elastic(stiffness)
            .law("hunt_crossley")
            .dissipation(dissipation)
    }

    /// Rigid, with a coefficient of restitution between 0 and 1.
    pub fn rigid(restitution: impl Into<Node>) -> Self {
        Self(one_property("restitution", restitution))
    }

    /// N = K·p^(3/2), contact in a point.
    pub fn hertz(stiffness: impl Into<Node>) -> Self {
        Self::elastic(stiffness).law("hertz")
    }
}

impl Pair {
    /// A bilateral pair: it holds both ways, without a gap.
    pub fn bilateral() -> Self {
        Self(one_property("closure", "bilateral"))
    }

    /// A force holds it closed: it may lift off.
    pub fn force_closed() -> Self {
        Self(one_property("closure", "force"))
    }

    /// Form-closed with a gap (rad or m).
    pub fn form(gap: impl Into<Node>) -> Self {
        Self(one_property("closure", "form")).gap(gap)
    }

    /// Contact force by Hunt and Crossley with κ, seconds per unit of penetration.
    pub fn hunt_crossley(self, kappa: impl Into<Node>) -> Self {
        self.set("law.hunt_crossley.kappa", kappa)
    }
}

builder! {
    /// Dimensions (m) and material of an object, from which inertia and stiffness follow.
    Geometry {
        /// Length.
        length;
        /// Width of a lever's section.
        width;
        /// Height of a lever's section.
        height;
        /// Diameter of a shaft or round rod.
        diameter;
        /// Bore of a hollow shaft.
        bore;
        /// Width and height of a rod's section.
        section;
        /// Area of a rod's section (m²).
        area;
        /// Density (kg/m³).
        density;
        /// Young's modulus (Pa).
        modulus;
        /// Shear modulus of a shaft (Pa).
        shear_modulus;
    }
}

impl Geometry {
    /// Dimensions, none given yet; the material is steel unless said otherwise.
    #[allow(clippy::new_without_default)]
    pub fn new() -> Self {
        Self(Node::object())
    }
}

builder! {
    /// The disc cam that moves an object, as the study of cams needs it. Lengths in m.
    DiscCam {
        /// Radius of the base circle.
        base_radius;
        /// Offset of a sliding follower's axis from the cam's.
        offset;
        /// Distance between the axes of cam and turning follower.
        centre_distance;
        /// Length of a turning follower's arm.
        arm;
        /// `"knife_edge"`, or what describes a roller or a flat face.
        contact;
        /// Sense in which the cam turns: `"counterclockwise"`, `"clockwise"`.
        sense;
        /// Sense in which the follower swings: `"with"` or `"against"` the cam.
        swing;
        /// Sense of positive displacement: `"outward"` or `"inward"`.
        positive;
        /// `"disc"`, `"hollow"` or `"groove"`.
        surface;
        /// Direction of the follower's motion (rad).
        direction;
        /// Part of the turn that is cut: [from, to].
        range;
        /// What describes the material of cam and follower: `thickness`, `modulus`, ….
        material;
    }
}

impl DiscCam {
    /// A disc cam with a base circle.
    pub fn new(base_radius: impl Into<Node>) -> Self {
        Self(one_property("base_radius", base_radius))
    }
}
