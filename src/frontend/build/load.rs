//! Loads.

use super::{at, one_property};
use crate::dynamics::load::{CustomLoad, LoadFunction};
use crate::frontend::read::{Node, OWN, Own};
use std::sync::Arc;

/// A force or moment on the masses of an object; positive towards positive displacement.
#[derive(Clone, Debug, PartialEq)]
#[must_use]
pub struct Load(Node);

/// What a load of any law may have.
const COMMON: [&str; 3] = ["mass", "unit", "over"];

impl Load {
    /// The laws, with the options that a method here sets.
    #[cfg(test)]
    pub(super) const LAWS: &[(&str, &[&str])] = &[
        ("constant", &[]),
        ("time_table", &[]),
        ("position_table", &["points", "period"]),
        ("window", &["from", "to", "force", "period", "once"]),
        ("spring", &["rate", "preload"]),
        ("viscous", &[]),
        ("weight", &["inclination"]),
        (
            "friction",
            &[
                "force",
                "width",
                "sliding",
                "static",
                "stribeck_speed",
                "engagement",
            ],
        ),
        ("expression", &[]),
        (
            "harmonic",
            &["amplitude", "frequency", "order", "phase", "mean"],
        ),
        ("indicator", &["points", "area", "ambient", "period"]),
    ];

    /// A load whose law is set by its name: `Load::new().set("viscous", 2)`.
    #[allow(clippy::new_without_default)]
    pub fn new() -> Self {
        Self(Node::object())
    }

    /// Sets any property by its name in a scene's text, or by its address within this value:
    /// `friction.force`.
    pub fn set(mut self, property: &str, value: impl Into<Node>) -> Self {
        *at(&mut self.0, property) = value.into();
        self
    }

    fn of(law: &'static str, value: impl Into<Node>) -> Self {
        Self(one_property(law, value))
    }

    /// A constant force or moment (N or N·m).
    pub fn constant(force: impl Into<Node>) -> Self {
        Self::of("constant", force)
    }

    /// Points [time, force]: linear between them, constant outside.
    pub fn time_table(points: impl Into<Node>) -> Self {
        Self::of("time_table", points)
    }

    /// Points [driver's displacement, force]; with [`Self::period`] it repeats.
    pub fn position_table(points: impl Into<Node>) -> Self {
        Self::of("position_table", one_property("points", points))
    }

    /// A constant force while the driver is between two displacements; repeats with
    /// every turn of a turning driver, with a [`Self::period`], or comes [`Self::once`].
    pub fn window(from: impl Into<Node>, to: impl Into<Node>, force: impl Into<Node>) -> Self {
        let mut window = one_property("from", from);
        window.set_property("to", to);
        window.set_property("force", force);
        Self::of("window", window)
    }

    /// A spring −rate·φ (N/m or N·m/rad), with a [`Self::preload`].
    pub fn spring(rate: impl Into<Node>) -> Self {
        Self::of("spring", one_property("rate", rate))
    }

    /// A damper −b·φ̇ (N·s/m or N·m·s/rad).
    pub fn viscous(damping: impl Into<Node>) -> Self {
        Self::of("viscous", damping)
    }

    /// Weight of what slides in a direction at this angle (rad) above the horizontal.
    pub fn weight(inclination: impl Into<Node>) -> Self {
        Self::of("weight", one_property("inclination", inclination))
    }

    /// Coulomb friction −force·tanh(φ̇/width).
    pub fn friction(force: impl Into<Node>, width: impl Into<Node>) -> Self {
        let mut friction = one_property("force", force);
        friction.set_property("width", width);
        Self::of("friction", friction)
    }

    /// Dry friction of sliding (N or N·m), which sticks; at rest up to a [`Self::static_limit`].
    /// With [`Self::over`] it acts between two objects.
    pub fn dry_friction(sliding: impl Into<Node>) -> Self {
        Self::of("friction", one_property("sliding", sliding))
    }

    /// Greatest dry friction at rest; default that of sliding.
    pub fn static_limit(self, force: impl Into<Node>) -> Self {
        self.option("static", force)
    }

    /// Speed over which dry friction falls from that at rest towards that of sliding.
    pub fn stribeck_speed(self, speed: impl Into<Node>) -> Self {
        self.option("stribeck_speed", speed)
    }

    /// Factor on a dry friction over `t` and motions, by which a clutch or brake is pressed; 0
    /// where it is below.
    pub fn engagement(self, expression: impl Into<Node>) -> Self {
        self.option("engagement", expression)
    }

    /// An expression over `t`, `phi` and `phi_dot` of the mass, `driver_phi` and
    /// `driver_phi_dot`, in s, rad or m: `"120*sin(2*pi*5*t)"`; with a [`Self::unit`], and
    /// [`Self::over`] another object.
    pub fn expression(text: impl Into<Node>) -> Self {
        Self::of("expression", text)
    }

    /// amplitude·sin(2π·frequency·t + phase) + mean (N or N·m, Hz).
    pub fn harmonic(amplitude: impl Into<Node>, frequency: impl Into<Node>) -> Self {
        let mut harmonic = one_property("amplitude", amplitude);
        harmonic.set_property("frequency", frequency);
        Self::of("harmonic", harmonic)
    }

    /// amplitude·sin(order·φ + phase) + mean, φ of the driver (N or N·m).
    pub fn harmonic_of_order(amplitude: impl Into<Node>, order: impl Into<Node>) -> Self {
        let mut harmonic = one_property("amplitude", amplitude);
        harmonic.set_property("order", order);
        Self::of("harmonic", harmonic)
    }

    /// Points [driver's displacement, pressure (Pa)] on a piston of an area (m²), positive
    /// where it is pushed towards positive displacement; repeats with every turn, or with
    /// a [`Self::period`].
    pub fn indicator(points: impl Into<Node>, area: impl Into<Node>) -> Self {
        let mut indicator = one_property("points", points);
        indicator.set_property("area", area);
        Self::of("indicator", indicator)
    }

    /// A force of your own over displacement and speed of the mass.
    pub fn own(function: impl LoadFunction + 'static) -> Self {
        Self::of(OWN, Own::new(CustomLoad(Arc::new(function))))
    }

    /// The mass it acts on: `"last"`, `"first"`, `"all"`, or its number from 1. Default
    /// `"all"` for a weight, `"last"` for everything else.
    pub fn mass(self, mass: impl Into<Node>) -> Self {
        self.set("mass", mass)
    }

    /// Unit of the value of an expression: `"kN"`.
    pub fn unit(self, unit: impl Into<Node>) -> Self {
        self.set("unit", unit)
    }

    /// Another object, or an output, to whose displacement a window, a table, a harmonic load of an
    /// order or an indicator diagram refers in place of the driver's; an expression knows its motion
    /// as `over_phi` and `over_phi_dot`. The id of the drive: the machine angle.
    pub fn over(self, output: impl Into<Node>) -> Self {
        self.set("over", output)
    }

    /// Angle (rad) of a harmonic load at its start.
    pub fn phase(self, angle: impl Into<Node>) -> Self {
        self.option("phase", angle)
    }

    /// Constant part of a harmonic load.
    pub fn mean(self, force: impl Into<Node>) -> Self {
        self.option("mean", force)
    }

    /// Pressure (Pa) on the other side of a piston; default that of the atmosphere.
    pub fn ambient(self, pressure: impl Into<Node>) -> Self {
        self.option("ambient", pressure)
    }

    /// Force of a spring at φ = 0, positive towards negative displacement.
    pub fn preload(self, force: impl Into<Node>) -> Self {
        self.option("preload", force)
    }

    /// A position table, window or indicator diagram repeats after this much of the driver's displacement.
    pub fn period(self, period: impl Into<Node>) -> Self {
        self.option("period", period)
    }

    /// A window comes once and does not repeat.
    pub fn once(self) -> Self {
        self.option("once", true)
    }

    /// Sets a property of the law.
    fn option(self, name: &str, value: impl Into<Node>) -> Self {
        let mut names = self.0.members().iter().map(|own| own.name.as_str());
        let law = names.find(|name| !COMMON.contains(name));
        let address = format!("{}.{name}", law.unwrap_or_default());
        self.set(&address, value)
    }
}

impl From<Load> for Node {
    fn from(load: Load) -> Self {
        load.0
    }
}
