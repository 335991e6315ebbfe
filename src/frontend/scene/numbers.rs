//! The numbers of a scene's text: where each stands, what it measures, how far it may go.

use super::{Catalogue, Document};
use crate::frontend::read::{Bounds, DeclaredNumber, QuantityChoice};
use crate::units::{UnitError, number_and_unit, parse};
use serde::Serialize;
use std::collections::BTreeMap;
use std::ops::Range;

/// A number that stands in a scene's text, as it is written there.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Number {
    /// Address: `rocker.pair.gap`.
    pub address: String,
    /// Bytes of the whole value, quotes included.
    pub value_at: Range<usize>,
    /// Bytes of the number alone.
    pub number_at: Range<usize>,
    /// The number, in the unit written.
    pub value: f64,
    /// The unit written behind it; empty: none, and the number is in SI units.
    pub unit: String,
    /// What it measures: `angular speed`; empty: a whole number.
    pub quantity: &'static str,
    /// The SI unit, which it is in where none is written; empty of pure numbers.
    pub si: &'static str,
    /// Units in which it may be given.
    pub units: Vec<&'static str>,
    /// Bounds of the value in SI units.
    pub bounds: [Option<f64>; 2],
    /// Whether the bounds themselves are allowed.
    pub included: [bool; 2],
    /// SI units in one of the unit written; `None` where the unit is unknown.
    pub factor: Option<f64>,
    /// True: a whole number.
    pub whole: bool,
}

impl Document {
    /// The numbers that stand in its text and that are parameters: all but those that it
    /// expects of a run. Numbers copied from a catalogue stand elsewhere; formulas are none. In the order of the text; of a faulty scene as far as it can be read.
    pub fn numbers(&self, catalogue: &dyn Catalogue) -> Vec<Number> {
        let text = self.text();
        let own = self.declared(catalogue).into_iter();
        let own = own.filter(|one| one.place.source == 0 && is_parameter(&one.path));
        // What is read twice stands there once.
        let found: BTreeMap<usize, Number> = own
            .filter_map(|one| Some((one.place.range.start, number(&one, text)?)))
            .collect();
        found.into_values().collect()
    }
}

fn is_parameter(path: &str) -> bool {
    let top = path.split(['.', '[']).next().unwrap_or("");
    !["expect", "dam", "name"].contains(&top)
}

fn number(declared: &DeclaredNumber, text: &str) -> Option<Number> {
    let whole = declared.place.range.clone();
    let raw = text.get(whole.clone())?;
    let (number, unit, offset) = match raw.strip_prefix('"') {
        None => (raw, "", 0),
        Some(inner) => {
            let inner = inner.strip_suffix('"').filter(|one| !one.contains('\\'))?;
            // What is calculated is no number that could be moved.
            let known = parse(inner).map(drop);
            if !matches!(known, Ok(()) | Err(UnitError::UnknownUnit { .. })) {
                return None;
            }
            let (number, unit) = number_and_unit(inner)?;
            (number, unit, 1 + inner.len() - inner.trim_start().len())
        }
    };
    let value = number
        .parse()
        .ok()
        .filter(|value: &f64| value.is_finite())?;
    let factor = match unit {
        "" => Some(1.0),
        unit => factor(unit, declared.wanted),
    };
    let start = whole.start + offset;
    let quantities = declared
        .wanted
        .map_or(Vec::new(), |wanted| wanted.quantities().collect::<Vec<_>>());
    let units = quantities.iter().flat_map(|one| one.units.iter().copied());
    let (bounds, included) = ends(&declared.bounds);
    let path = &declared.path;
    Some(Number {
        address: path.strip_prefix("objects.").unwrap_or(path).to_owned(),
        value_at: whole,
        number_at: start..start + number.len(),
        value,
        unit: unit.to_owned(),
        quantity: quantities.first().map_or("", |one| one.name),
        si: quantities.first().map_or("", |one| match one.si() {
            "1" => "",
            unit => unit,
        }),
        units: units.filter(|unit| *unit != "1").collect(),
        bounds,
        included,
        factor,
        whole: declared.wanted.is_none(),
    })
}

/// SI units in one of `unit`, in the sense in which a quantity that is wanted takes it.
fn factor(unit: &str, wanted: Option<QuantityChoice>) -> Option<f64> {
    let one = parse(&format!("1 {unit}")).ok()?;
    let meant = wanted.and_then(|wanted| wanted.convert_measure(one).ok());
    Some(meant.unwrap_or(one.value))
}

fn ends(bounds: &Bounds) -> ([Option<f64>; 2], [bool; 2]) {
    let ends = [bounds.lower, bounds.upper];
    (
        ends.map(|end| end.map(|(at, _)| at)),
        ends.map(|end| end.is_none_or(|(_, included)| included)),
    )
}

#[cfg(test)]
mod tests {
    use super::super::{BuiltIn, Document};

    #[test]
    fn numbers_know_their_place_unit_and_bounds() {
        let text = std::fs::read_to_string("scenarios/rocker/two_masses.json").unwrap();
        let numbers = Document::parse("scene", text.as_bytes())
            .unwrap()
            .numbers(&BuiltIn);
        let of = |address: &str| numbers.iter().find(|one| one.address == address).unwrap();
        let speed = of("shaft.motion.speed");
        assert_eq!(&text[speed.value_at.clone()], "\"10 rev/s\"");
        assert_eq!(&text[speed.number_at.clone()], "10");
        assert_eq!((speed.value, speed.unit.as_str()), (10.0, "rev/s"));
        assert!((speed.factor.unwrap() - std::f64::consts::TAU).abs() < 1e-15);
        assert!(speed.units.contains(&"rpm"));
        let stiffness = of("rocker.stiffness");
        assert_eq!(&text[stiffness.number_at.clone()], "1e7");
        assert_eq!(
            (stiffness.bounds[0], stiffness.included[0]),
            (Some(0.0), false)
        );
        assert_eq!(
            (stiffness.si, of("rocker.damping_capacity").si),
            ("N m/rad", "")
        );
        assert!(of("rocker.masses").whole);
        assert_eq!(of("rocker.loads.closing.constant").value, -600.0);
        assert!(numbers.iter().all(|one| !one.address.starts_with("expect")));
        let starts: Vec<usize> = numbers.iter().map(|one| one.number_at.start).collect();
        assert!(starts.windows(2).all(|pair| pair[0] < pair[1]));
    }

    #[test]
    fn faulty_scenes_have_numbers_too() {
        let text = r#"{"dam":1,"name":"x","objects":{"a":{"kind":"drive","motion":{"speed":"3 furlong"}},
            "b":{"kind":"rocker","input":"nobody","inertia":-1}},"run":{"duration":" 2.5 ms "}}"#;
        let numbers = Document::parse("scene", text.as_bytes())
            .unwrap()
            .numbers(&BuiltIn);
        let told: Vec<(&str, f64, Option<f64>)> = numbers
            .iter()
            .map(|one| (one.address.as_str(), one.value, one.factor))
            .collect();
        assert!(told.contains(&("a.motion.speed", 3.0, None)), "{told:?}");
        assert!(told.contains(&("b.inertia", -1.0, Some(1.0))));
        let duration = numbers.last().unwrap();
        assert_eq!(&text[duration.number_at.clone()], "2.5");
    }
}
