//! Laws of motion as scenes and commands state them.

use super::names::{LawName, RunLawName};
use super::polynomial::{MOST_CONDITIONS, PolynomialSpec};
use crate::fault::{Fault, Faults};

/// A law of a full stroke, from rest to rest.
#[derive(Clone, Debug, PartialEq)]
pub enum LawSpec {
    /// A named law: `"cycloidal"`.
    Named(LawName),
    /// `{ "scca": { "b", "d" } }`: sine, constant and cosine acceleration;
    /// b + c + d = 1 are the shares of the sines at both ends together, of
    /// constant acceleration and of the cosine about the middle.
    Scca {
        /// Share of the sines.
        b: f64,
        /// Share of the cosine.
        d: f64,
    },
    /// `{ "sections": { "run_up", "run_out", "skewness" = 1, "uniform" = 0 } }`.
    Sections(SectionsSpec),
    /// `{ "polynomial": { "start", "end", "through" = [] } }`.
    Polynomial(PolynomialSpec),
    /// `{ "table": [[τ, θ], …] }`: a smooth spline, at rest at both ends.
    Table(Vec<(f64, f64)>),
}

/// A stroke of run-up, uniform motion and run-out.
#[derive(Clone, Debug, PartialEq)]
pub struct SectionsSpec {
    /// Law of the run-up.
    pub run_up: RunLawSpec,
    /// Law of the run-out, counted backwards from its end.
    pub run_out: RunLawSpec,
    /// Skewness f: duration of the run-out by that of the run-up, > 0.
    pub skewness: f64,
    /// Share of the duration with uniform motion, 0 ≤ ζ_φ < 1.
    pub uniform: f64,
}

impl SectionsSpec {
    /// The symmetric law of the SCCA family with the shares b (sines) and d (cosine).
    pub fn scca(b: f64, d: f64) -> Self {
        Self {
            run_up: RunLawSpec::Trapezoid { s1: b, s2: d },
            run_out: RunLawSpec::Trapezoid { s1: b, s2: d },
            skewness: 1.0,
            uniform: 0.0,
        }
    }
}

/// A law of a run-up from rest to uniform motion.
#[derive(Clone, Debug, PartialEq)]
pub enum RunLawSpec {
    /// The modified trapezoid of general form; its special points have names.
    Trapezoid {
        /// Share of the rise of the acceleration.
        s1: f64,
        /// Share of its fall.
        s2: f64,
    },
    /// A polynomial; it starts from rest, its greatest speed is at its end.
    Polynomial(PolynomialSpec),
    /// A smooth spline through points (τ, θ), from rest; the end is free.
    Table(Vec<(f64, f64)>),
}

impl LawSpec {
    /// Description in a few words: `cycloidal`, `SCCA b = 0.25, d = 0.75`.
    pub fn words(&self) -> String {
        match self {
            Self::Named(name) => name.name().to_owned(),
            Self::Scca { b, d } => format!("SCCA b = {b}, d = {d}"),
            Self::Sections(sections) => {
                let (up, out) = (sections.run_up.words(), sections.run_out.words());
                let (skewness, uniform) = (sections.skewness, sections.uniform);
                format!("sections ({up} up, {out} out, skewness {skewness}, uniform {uniform})")
            }
            Self::Polynomial(spec) => polynomial_words(spec),
            Self::Table(points) => format!("table of {} points", points.len()),
        }
    }
}

impl RunLawSpec {
    /// Description in a few words: `sine`, `trapezoid 0.2, 0.3`.
    pub fn words(&self) -> String {
        match self {
            Self::Trapezoid { s1, s2 } => {
                let mut all = RunLawName::ALL.into_iter();
                match all.find(|name| name.shares() == (*s1, *s2)) {
                    Some(name) => name.name().to_owned(),
                    None => format!("trapezoid {s1}, {s2}"),
                }
            }
            Self::Polynomial(spec) => polynomial_words(spec),
            Self::Table(points) => format!("table of {} points", points.len()),
        }
    }
}

fn polynomial_words(spec: &PolynomialSpec) -> String {
    let degree = spec.conditions().saturating_sub(1);
    format!("polynomial of degree {degree}")
}

/// Least and most points of a table of a law; every point becomes a joint.
pub(crate) const TABLE_POINTS: std::ops::RangeInclusive<usize> = 3..=500;

/// Checks a polynomial's conditions: numbers, their count, points between the ends.
pub(super) fn check_polynomial(spec: &PolynomialSpec) -> Result<(), Vec<Fault>> {
    let mut faults = Faults::default();
    let count = spec.conditions();
    if !(2..=MOST_CONDITIONS).contains(&count) {
        let message = format!("{count} conditions");
        let hint = format!("give between 2 and {MOST_CONDITIONS} in all");
        faults.add("polynomial", message, &hint);
    }
    for (name, values) in [("start", &spec.start), ("end", &spec.end)] {
        for (index, value) in values.iter().enumerate() {
            faults.finite(&format!("polynomial.{name}[{index}]"), *value);
        }
    }
    for (index, &(tau, theta)) in spec.through.iter().enumerate() {
        let path = format!("polynomial.through[{index}]");
        faults.finite(&format!("{path}[1]"), theta);
        let again = spec.through[..index].iter().any(|other| other.0 == tau);
        if !(tau > 0.0 && tau < 1.0) || again {
            let message = format!("a point at τ = {tau}");
            let hint = "points lie between 0 and 1, ends excluded, each τ once";
            faults.add(path, message, hint);
        }
    }
    faults.check()
}

/// Checks a table's points: from (0, 0) to (1, 1), ascending.
pub(super) fn check_table(points: &[(f64, f64)]) -> Result<(), Vec<Fault>> {
    let mut faults = Faults::default();
    faults.points("table", points, *TABLE_POINTS.start());
    if points.len() > *TABLE_POINTS.end() {
        let message = format!("{} points are too many", points.len());
        let hint = format!("give at most {}", TABLE_POINTS.end());
        faults.add("table", message, &hint);
    }
    faults.check()?;
    let ends = [points[0], points[points.len() - 1]];
    if ends != [(0.0, 0.0), (1.0, 1.0)] {
        let message = format!("the table runs from {:?} to {:?}", ends[0], ends[1]);
        faults.add("table", message, "begin with [0, 0] and end with [1, 1]");
    }
    faults.check()
}

impl LawName {
    /// As sections of a stroke, for the laws that are made of them.
    pub(super) fn sections(self) -> Option<SectionsSpec> {
        let (b, d, uniform) = match self {
            Self::Parabolic => (0.0, 0.0, 0.0),
            Self::ModifiedTrapezoid => (0.25, 0.25, 0.0),
            Self::ModifiedSine => (0.25, 0.75, 0.0),
            Self::ModifiedConstantVelocity => (0.25, 0.75, 0.5),
            _ => return None,
        };
        Some(SectionsSpec {
            uniform,
            ..SectionsSpec::scca(b, d)
        })
    }
}

impl From<LawName> for LawSpec {
    fn from(name: LawName) -> Self {
        Self::Named(name)
    }
}

impl From<RunLawName> for RunLawSpec {
    fn from(name: RunLawName) -> Self {
        let (s1, s2) = name.shares();
        Self::Trapezoid { s1, s2 }
    }
}
