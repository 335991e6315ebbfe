//! A displacement with its derivatives, as charts and as rows.

use crate::kinematics::motion::law::{Law, LawConstants};
use crate::math::jet::Jet;
use crate::report::course::samples;
use crate::report::csv::{Rows, column_heading};
use crate::report::findings::{Layout, Section};
use crate::report::plot::{Axis, MotionPhase, Plot, Series};
use crate::report::quantity::significant;
use crate::report::verdict::capitalised;

/// Points of each diagram.
pub(super) const DIAGRAM_POINTS: usize = 400;

/// Height of the diagrams over each other (pixels).
const HEIGHT: f64 = 440.0;

/// Value and derivatives over an argument, both sides of every joint.
pub(super) struct Curve<'a> {
    /// Argument and what belongs to it.
    pub(super) rows: Vec<(f64, Jet)>,
    /// Symbol of the value.
    pub(super) symbol: &'a str,
    /// The argument.
    pub(super) x: Axis,
    /// Unit of the value.
    pub(super) unit: &'a str,
    /// Greatest value, speed, acceleration and jerk; zero: not shown with the others.
    pub(super) sizes: [f64; 4],
}

const PRIMES: [&str; 4] = ["", "′", "″", "‴"];

/// What the value and its derivatives are, each before its symbol.
const NAMES: [&str; 4] = ["displacement", "speed", "acceleration", "jerk"];

fn derivatives_list(jet: &Jet) -> [f64; 4] {
    [jet.value, jet.first, jet.second, jet.third]
}

impl<'a> Curve<'a> {
    /// A law in its normal form.
    pub(super) fn of_law(law: &Law, constants: &LawConstants) -> Self {
        let acceleration = constants.acceleration.value;
        let acceleration = acceleration.max(-constants.deceleration.value);
        Self {
            rows: of_law(law, DIAGRAM_POINTS),
            symbol: "θ",
            x: Axis::new("share τ of the duration", ""),
            unit: "",
            sizes: [
                1.0,
                constants.speed.value,
                acceleration,
                constants.jerk.value,
            ],
        }
    }

    /// The section of the diagrams: over each other, then each by itself.
    pub(super) fn section<'f>(&self, title: &str) -> Section<'f> {
        Section::new("Diagrams")
            .charts(
                Layout::Wide(HEIGHT),
                "law",
                vec![self.over_each_other(title)],
            )
            .charts(Layout::Grid, "law", (0..4).map(|k| self.alone(k)).collect())
    }

    fn points(&self, order: usize, size: f64) -> Vec<(f64, f64)> {
        let rows = self.rows.iter();
        rows.map(|(x, jet)| (self.chart_argument(*x), derivatives_list(jet)[order] / size))
            .collect()
    }

    /// The argument as charts have it: angles in degrees.
    fn chart_argument(&self, x: f64) -> f64 {
        match self.x.unit.as_str() {
            "rad" => x.to_degrees(),
            _ => x,
        }
    }

    fn axis(&self) -> Axis {
        match self.x.unit.as_str() {
            "rad" => Axis::new(&self.x.name, "deg"),
            _ => self.x.clone(),
        }
    }

    /// All diagrams, each divided by its greatest value.
    fn over_each_other(&self, title: &str) -> Plot {
        let curve = |(order, &size): (usize, &f64)| {
            let name = format!("{} {}{}", NAMES[order], self.symbol, PRIMES[order]);
            let label = match size == 1.0 {
                true => name,
                false => format!("{name} / {}", significant(size, 5)),
            };
            Series::line(&label, self.points(order, size))
        };
        let shown = self.sizes.iter().enumerate();
        let curves = shown.filter(|(_, size)| **size != 0.0).map(curve);
        Plot {
            phases: MotionPhase::of(&self.points(0, 1.0)),
            ..Plot::new(title, self.axis(), "", curves.collect())
        }
    }

    /// One diagram in its own unit.
    fn alone(&self, order: usize) -> Plot {
        Plot {
            phases: MotionPhase::of(&self.points(0, 1.0)),
            ..Plot::new(
                format!(
                    "{} {}{}",
                    capitalised(NAMES[order]),
                    self.symbol,
                    PRIMES[order]
                ),
                self.axis(),
                &unit(order, self.unit, &self.x.unit, ["", "", "²", "³"]),
                vec![Series::line("", self.points(order, 1.0))],
            )
        }
    }
}

/// Unit of a derivative: `m`, `m/rad²`, `1/rad`; empty where nothing has one.
fn unit(order: usize, unit: &str, per: &str, powers: [&str; 4]) -> String {
    match (order, unit, per) {
        (0, unit, _) => unit.to_owned(),
        (_, "", "") => String::new(),
        (_, "", per) => format!("1/{per}{}", powers[order]),
        (_, unit, per) => format!("{unit}/{per}{}", powers[order]),
    }
}

/// Argument, value and derivatives as a table: their names and units.
pub(super) fn rows(
    [argument, value]: [&str; 2],
    [own, per]: [&str; 2],
    rows: &[(f64, Jet)],
) -> Rows {
    let derivative = |order: usize| {
        let name = match order {
            0 => value.to_owned(),
            order => format!("{value}{order}"),
        };
        column_heading(&name, &unit(order, own, per, ["", "", "^2", "^3"]))
    };
    let first = std::iter::once(column_heading(argument, per));
    let row = |(at, jet): &(f64, Jet)| std::iter::once(*at).chain(derivatives_list(jet));
    Rows::new(first.chain((0..4).map(derivative)), rows.iter().map(row))
}

/// Arguments of a law: `count` equal steps, and both sides of every joint.
pub(super) fn of_law(law: &Law, count: usize) -> Vec<(f64, Jet)> {
    let pieces = law.pieces().map(|(_, from, to)| [from, to]);
    samples(pieces, [0.0, 1.0], count, |piece, tau| {
        (tau, law.jet(piece, tau))
    })
}
