//! Position functions, plans and laws of motion.

use super::{builder, one_property};
use crate::frontend::read::{Node, Own};
use crate::kinematics::position::{CustomPosition, PositionFunction};
use std::sync::Arc;

/// A position function U(φ): where the driver asks an object to be.
///
/// The options are those of the function at hand: what it does not take is told as a
/// fault when the scene is read.
#[derive(Clone, Debug, PartialEq)]
#[must_use]
pub struct Position {
    function: &'static str,
    node: Node,
}

/// Declares the options of position functions.
macro_rules! options {
    ($($(#[$doc:meta])* $method:ident;)*) => {
        impl Position {
            /// The options that have a method.
            #[cfg(test)]
            pub(super) const OPTIONS: &[&str] = &[$(stringify!($method)),*];

            $(
                $(#[$doc])*
                pub fn $method(self, value: impl Into<Node>) -> Self {
                    self.option(stringify!($method), value)
                }
            )*
        }
    };
}

options! {
    /// Constant part of `ratio` and `sine` (rad or m); offset of a slider-crank's guide.
    offset;
    /// Oscillations of `sine` per turn of the driver; default 1.
    harmonic;
    /// Added to the driver's displacement.
    phase;
    /// Whether the last point of `table` closes the period.
    periodic;
    /// Slopes U′ at both ends of a `table` that is not periodic.
    end_slopes;
    /// Branch of a linkage: `"+"` or `"-"`.
    branch;
    /// Driver of a slotted link: `"crank"` or `"block"`.
    driver;
    /// Output of a slotted link: `"link"`, `"crank"` or `"block"`.
    output;
    /// Upper dwell of a cam (rad).
    dwell;
    /// Lower rest of a cam (rad); what is left of the turn.
    rest;
    /// Displacement that a plan gains in every cycle.
    advance;
    /// Length of a plan's cycle; period of a `table`, whose last row may then be left out.
    period;
}

impl Position {
    /// The functions, with the properties that they are made with.
    #[cfg(test)]
    pub(super) const FUNCTIONS: &[(&str, &[&str])] = &[
        ("ratio", &["ratio"]),
        ("sine", &["amplitude"]),
        ("polynomial", &["coefficients"]),
        ("table", &["points"]),
        ("slider_crank", &["crank", "rod"]),
        ("four_bar", &["crank", "coupler", "rocker", "frame"]),
        ("slotted_link", &["crank", "frame"]),
        ("cam", &["lift", "rise", "return", "law"]),
        ("plan", &["stations"]),
    ];

    fn of(function: &'static str, properties: Node) -> Self {
        let node = one_property(function, properties);
        Self { function, node }
    }

    /// U = ratio·φ (+ offset).
    pub fn ratio(ratio: impl Into<Node>) -> Self {
        Self::of("ratio", one_property("ratio", ratio))
    }

    /// U = amplitude·sin(harmonic·φ + phase) (+ offset).
    pub fn sine(amplitude: impl Into<Node>) -> Self {
        Self::of("sine", one_property("amplitude", amplitude))
    }

    /// U = a₀ + a₁·φ + a₂·φ² + …, lowest power first.
    pub fn polynomial(coefficients: impl Into<Node>) -> Self {
        Self::of("polynomial", one_property("coefficients", coefficients))
    }

    /// A smooth spline through points [driver's displacement, displacement].
    pub fn table(points: impl Into<Node>) -> Self {
        Self::of("table", one_property("points", points))
    }

    /// A slider-crank by the lengths (m) of crank and connecting rod.
    pub fn slider_crank(crank: impl Into<Node>, rod: impl Into<Node>) -> Self {
        let mut links = one_property("crank", crank);
        links.set_property("rod", rod);
        Self::of("slider_crank", links)
    }

    /// A four-bar linkage by the lengths (m) of its links.
    pub fn four_bar(
        crank: impl Into<Node>,
        coupler: impl Into<Node>,
        rocker: impl Into<Node>,
        frame: impl Into<Node>,
    ) -> Self {
        let mut links = one_property("crank", crank);
        links.set_property("coupler", coupler);
        links.set_property("rocker", rocker);
        links.set_property("frame", frame);
        Self::of("four_bar", links)
    }

    /// A slotted link by the lengths (m) of crank and frame.
    pub fn slotted_link(crank: impl Into<Node>, frame: impl Into<Node>) -> Self {
        let mut links = one_property("crank", crank);
        links.set_property("frame", frame);
        Self::of("slotted_link", links)
    }

    /// A cam: its full stroke (rad or m), the angles (rad) of rise and return, and the
    /// law of both: a name, as `"modified_sine"`, or a [`Law`].
    pub fn cam(
        lift: impl Into<Node>,
        rise: impl Into<Node>,
        return_angle: impl Into<Node>,
        law: impl Into<Node>,
    ) -> Self {
        let mut cam = one_property("lift", lift);
        cam.set_property("rise", rise);
        cam.set_property("return", return_angle);
        cam.set_property("law", law);
        Self::of("cam", cam)
    }

    /// A plan of motion: its [stations](Station), ascending.
    pub fn plan(stations: impl Into<Node>) -> Self {
        Self::of("plan", one_property("stations", stations))
    }

    /// A position function of your own.
    pub fn own(function: impl PositionFunction + 'static) -> Self {
        Self {
            function: "own",
            node: Own::new(CustomPosition(Arc::new(function))).into(),
        }
    }

    fn option(mut self, name: &str, value: impl Into<Node>) -> Self {
        self.node.property(self.function).set_property(name, value);
        self
    }
}

impl From<Position> for Node {
    fn from(position: Position) -> Self {
        position.node
    }
}

builder! {
    /// A station of a plan of motion.
    Station {
        /// Motion from here to the next station: `"dwell"` (default), `"uniform"`,
        /// `"smooth"`, or a law.
        motion;
        /// First derivative there.
        speed;
        /// Second derivative there.
        acceleration;
        /// Order of derivatives up to which smooth motions match their neighbour here.
        matching = "match";
    }
}

impl Station {
    /// At a displacement of the driver, or a time, the object is at a displacement.
    pub fn at(at: impl Into<Node>, displacement: impl Into<Node>) -> Self {
        let mut station = one_property("at", at);
        station.set_property("displacement", displacement);
        Self(station)
    }
}

/// A law of motion that has parameters; others are given by their names.
#[derive(Clone, Debug, PartialEq)]
pub struct Law(Node);

impl Law {
    /// The SCCA family with the shares `b` and `d`.
    pub fn scca(b: impl Into<Node>, d: impl Into<Node>) -> Self {
        let mut scca = one_property("b", b);
        scca.set_property("d", d);
        Self(one_property("scca", scca))
    }

    /// The general trapezoid of a run-up with the shares `s1` and `s2`.
    pub fn trapezoid(s1: impl Into<Node>, s2: impl Into<Node>) -> Self {
        let mut trapezoid = one_property("s1", s1);
        trapezoid.set_property("s2", s2);
        Self(one_property("trapezoid", trapezoid))
    }

    /// Points of a table.
    pub fn table(points: impl Into<Node>) -> Self {
        Self(one_property("table", points))
    }

    /// The polynomial with the derivatives given at its start and its end.
    pub fn polynomial(start: impl Into<Node>, end: impl Into<Node>) -> Self {
        let mut polynomial = one_property("start", start);
        polynomial.set_property("end", end);
        Self(one_property("polynomial", polynomial))
    }
}

impl From<Law> for Node {
    fn from(law: Law) -> Self {
        law.0
    }
}
