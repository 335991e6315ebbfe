//! Drives: where motion comes from.

use super::{builder, one_property};
use crate::frontend::read::Node;

builder! {
    /// A drive: prescribed motion, or a motor.
    Drive {
        /// Remarks for people.
        description;
        /// `"turning"` (default) or `"sliding"`.
        coordinate;
    }
}

impl Drive {
    /// Prescribed constant speed (rad/s).
    pub fn speed(speed: impl Into<Node>) -> Self {
        Self::prescribed("speed", speed)
    }

    /// Held at a displacement (rad or m).
    pub fn fixed(displacement: impl Into<Node>) -> Self {
        Self::prescribed("fixed", displacement)
    }

    /// Prescribed constant acceleration (rad/s²).
    pub fn acceleration(acceleration: impl Into<Node>) -> Self {
        Self::prescribed("acceleration", acceleration)
    }

    /// A run-up from rest to a constant speed (rad/s) in a time (s).
    pub fn run_up(speed: impl Into<Node>, time: impl Into<Node>) -> Self {
        let mut run_up = one_property("speed", speed);
        run_up.set_property("time", time);
        Self::prescribed("run_up", run_up)
    }

    /// A smooth motion through points [time, displacement].
    pub fn table(points: impl Into<Node>) -> Self {
        Self::prescribed("table", points)
    }

    /// A displacement (rad or m) as an expression of `t` (s): `"0.1*sin(2*pi*t)"`.
    pub fn expression(text: impl Into<Node>) -> Self {
        Self::prescribed("expression", text)
    }

    /// A plan of motion over time: its stations, ascending.
    pub fn plan(stations: impl Into<Node>) -> Self {
        Self::prescribed("plan", one_property("stations", stations))
    }

    /// A motor: inertia of its rotor (kg·m²) and its torque over speed.
    pub fn motor(inertia: impl Into<Node>, torque: Torque) -> Self {
        let drive = Self(super::of_kind("drive")).set("motor.inertia", inertia);
        drive.set("motor.torque", torque)
    }

    /// A motor that slides: its mass (kg) and its force over speed.
    pub fn linear_motor(mass: impl Into<Node>, force: Force) -> Self {
        let drive = Self(super::of_kind("drive")).set("motor.inertia", mass);
        drive.set("motor.force", force).sliding()
    }

    /// Slides instead of turning: a cylinder.
    pub fn sliding(self) -> Self {
        self.coordinate("sliding")
    }

    /// Angle (rad) at t = 0, with a constant speed or acceleration, or of a motor.
    pub fn angle(self, angle: impl Into<Node>) -> Self {
        self.of_motion("angle", angle)
    }

    /// Displacement (m) at t = 0 of a drive that slides.
    pub fn displacement(self, displacement: impl Into<Node>) -> Self {
        self.of_motion("displacement", displacement)
    }

    /// Speed at t = 0, with a constant acceleration, or of a motor.
    pub fn start_speed(self, speed: impl Into<Node>) -> Self {
        match self.0.get("motor") {
            Some(_) => self.set("motor.speed", speed),
            None => self.set("motion.start_speed", speed),
        }
    }

    /// Unit of the value of a motion by an expression: `"deg"`.
    pub fn unit(self, unit: impl Into<Node>) -> Self {
        self.set("motion.unit", unit)
    }

    /// Law of a run-up.
    pub fn law(self, law: impl Into<Node>) -> Self {
        self.set("motion.run_up.law", law)
    }

    /// Adds a load on the rotor of a motor.
    pub fn load(mut self, name: &str, load: impl Into<Node>) -> Self {
        self.0.property("loads").set_property(name, load);
        self
    }

    fn prescribed(motion: &str, value: impl Into<Node>) -> Self {
        Self(super::of_kind("drive")).set("motion", one_property(motion, value))
    }

    fn of_motion(self, property: &str, value: impl Into<Node>) -> Self {
        let motion = self.0.get("motion");
        let group = match motion.map(|motion| motion.get("run_up").is_some()) {
            Some(true) => "motion.run_up",
            Some(false) => "motion",
            None => "motor",
        };
        self.set(&format!("{group}.{property}"), value)
    }
}

/// What characteristics by an expression say beside it.
macro_rules! characteristic {
    ($name:ident, $unit:literal) => {
        impl $name {
            #[doc = concat!("Unit of the value of an expression: `\"", $unit, "\"`.")]
            pub fn unit(mut self, unit: impl Into<Node>) -> Self {
                self.0.set_property("unit", unit);
                self
            }

            /// Another object, or an output, whose motion an expression looks at as `over_phi`
            /// and `over_phi_dot`.
            pub fn over(mut self, output: impl Into<Node>) -> Self {
                self.0.set_property("over", output);
                self
            }
        }

        impl From<$name> for Node {
            fn from(characteristic: $name) -> Self {
                characteristic.0
            }
        }
    };
}

/// The torque of a motor over its speed.
#[derive(Clone, Debug, PartialEq)]
pub struct Torque(Node);

impl Torque {
    /// Characteristic with the same torque (N·m) at every speed.
    pub fn constant(torque: impl Into<Node>) -> Self {
        Self(one_property("constant", torque))
    }

    /// Falling linearly from the stall torque (N·m) to nothing at the no-load speed
    /// (rad/s).
    pub fn linear(stall_torque: impl Into<Node>, no_load_speed: impl Into<Node>) -> Self {
        let mut linear = one_property("stall_torque", stall_torque);
        linear.set_property("no_load_speed", no_load_speed);
        Self(one_property("linear", linear))
    }

    /// An asynchronous motor by Kloss's formula: breakdown torque (N·m), breakdown slip
    /// and synchronous speed (rad/s).
    pub fn kloss(
        breakdown_torque: impl Into<Node>,
        breakdown_slip: impl Into<Node>,
        synchronous_speed: impl Into<Node>,
    ) -> Self {
        let mut kloss = one_property("breakdown_torque", breakdown_torque);
        kloss.set_property("breakdown_slip", breakdown_slip);
        kloss.set_property("synchronous_speed", synchronous_speed);
        Self(one_property("kloss", kloss))
    }

    /// Points [speed, torque], linear between them.
    pub fn table(points: impl Into<Node>) -> Self {
        Self(one_property("table", points))
    }

    /// An expression over `t`, `phi` and `phi_dot` of the rotor, in s and rad:
    /// `"30*(1 - phi_dot/150)"`.
    pub fn expression(text: impl Into<Node>) -> Self {
        Self(one_property("expression", text))
    }
}

characteristic!(Torque, "kN m");

/// The force of a motor that slides, over its speed.
#[derive(Clone, Debug, PartialEq)]
pub struct Force(Node);

impl Force {
    /// Characteristic with the same force (N) at every speed.
    pub fn constant(force: impl Into<Node>) -> Self {
        Self(one_property("constant", force))
    }

    /// Falling linearly from the stall force (N) to nothing at the no-load speed (m/s).
    pub fn linear(stall_force: impl Into<Node>, no_load_speed: impl Into<Node>) -> Self {
        let mut linear = one_property("stall_force", stall_force);
        linear.set_property("no_load_speed", no_load_speed);
        Self(one_property("linear", linear))
    }

    /// Points [speed, force], linear between them.
    pub fn table(points: impl Into<Node>) -> Self {
        Self(one_property("table", points))
    }

    /// An expression over `t`, `phi` and `phi_dot` of the slide, in s and m.
    pub fn expression(text: impl Into<Node>) -> Self {
        Self(one_property("expression", text))
    }
}

characteristic!(Force, "kN");
