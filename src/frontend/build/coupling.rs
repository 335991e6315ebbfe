//! Couplings of links: gears, belts, racks, cams with their rollers.

use super::{at, one_property};
use crate::frontend::read::Node;

/// A coupling of two links by gears, a belt, a gear and a rack, or a cam and a roller.
#[derive(Clone, Debug, PartialEq)]
#[must_use]
pub struct Coupling(Node);

impl Coupling {
    /// A coupling whose kind is set by its name: `Coupling::new().set("rack.radius", 0.03)`.
    #[allow(clippy::new_without_default)]
    pub fn new() -> Self {
        Self(Node::object())
    }

    /// Sets any property by its name in a scene's text, or by its address within this value:
    /// `rack.radius`.
    pub fn set(mut self, property: &str, value: impl Into<Node>) -> Self {
        *at(&mut self.0, property) = value.into();
        self
    }

    /// Two gears with external teeth, by their numbers of teeth.
    pub fn gears(wheels: [&str; 2], teeth: [u32; 2]) -> Self {
        Self::of("gear", wheels, "teeth", teeth)
    }

    /// Two gears of which one has internal teeth: both turn the same way.
    pub fn internal_gears(wheels: [&str; 2], teeth: [u32; 2]) -> Self {
        Self::gears(wheels, teeth).with_property("internal", true)
    }

    /// A toothed belt or a chain between two wheels, by their diameters (m).
    pub fn belt(wheels: [&str; 2], diameters: [f64; 2]) -> Self {
        Self::of("belt", wheels, "diameters", diameters)
    }

    /// A crossed belt: the wheels turn against each other.
    pub fn crossed_belt(wheels: [&str; 2], diameters: [f64; 2]) -> Self {
        Self::belt(wheels, diameters).with_property("crossed", true)
    }

    /// A gear and a rack, by the radius of the gear's pitch circle (m): positive where the rack lies to
    /// the right of the gear, seen along its guide.
    pub fn rack(gear: &str, rack: &str, radius: f64) -> Self {
        Self::of("rack", [gear, rack], "radius", radius)
    }

    /// The link that carries both, or `ground`; needed where there is more than one that could.
    pub fn carrier(self, link: &str) -> Self {
        self.with_property("carrier", link)
    }

    /// Angle of the second wheel (rad), or displacement of the rack (m), where that of the first wheel is
    /// zero, both seen from the carrier.
    pub fn offset(self, offset: impl Into<Node>) -> Self {
        self.with_property("offset", offset)
    }

    /// A cam about a point of one link, `crank.C`, and a roller (or a point) of another one, `lever.R`;
    /// the radius of the cam where the lift is zero (m). Without a lift it is a circle.
    pub fn cam(centre: &str, roller: &str, base_radius: impl Into<Node>) -> Self {
        let cam = Self(one_property("cam", one_property("centre", centre)));
        cam.with_property("roller", roller)
            .with_property("base_radius", base_radius)
    }

    /// Radius of a cam's roller (m); without it a point.
    pub fn roller_radius(self, radius: impl Into<Node>) -> Self {
        self.with_property("roller_radius", radius)
    }

    /// Lift of a cam: a sine, a table, a cam or a plan that repeats after a turn.
    pub fn lift(self, lift: impl Into<Node>) -> Self {
        self.with_property("lift", lift)
    }

    /// Direction in the cam's link from which the angle of the lift is counted (rad).
    pub fn direction(self, direction: impl Into<Node>) -> Self {
        self.with_property("direction", direction)
    }

    /// The sense in which the angle of the lift is counted: `"counterclockwise"` or `"clockwise"`.
    pub fn sense(self, sense: &str) -> Self {
        self.with_property("sense", sense)
    }

    /// The side of a cam that is touched: `"disc"`, `"hollow"` or `"groove"`.
    pub fn surface(self, surface: &str) -> Self {
        self.with_property("surface", surface)
    }

    fn of(kind: &'static str, wheels: [&str; 2], size: &str, value: impl Into<Node>) -> Self {
        Self(one_property(kind, one_property("wheels", wheels))).with_property(size, value)
    }

    /// Sets a property of the kind.
    fn with_property(self, property: &str, value: impl Into<Node>) -> Self {
        let kind = self.0.members().first().map(|own| own.name.as_str());
        let address = format!("{}.{property}", kind.unwrap_or_default());
        self.set(&address, value)
    }
}

impl From<Coupling> for Node {
    fn from(coupling: Coupling) -> Self {
        coupling.0
    }
}
