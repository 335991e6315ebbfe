//! Figures by their address: `rocker.delta_max`, `rocker.pair.separations`, `run.switches`.

use super::Figures;
use crate::dynamics::model::owner_of;
use crate::math::order::Total;
use serde_json::Value;
use std::collections::BTreeMap;

/// How many similar addresses an error names.
const MOST_SUGGESTIONS: usize = 3;

/// Why an address gives no number.
#[derive(Clone, Debug, PartialEq)]
pub enum AddressError {
    /// There is no such figure.
    Unknown {
        /// Similar addresses, the closest first.
        close: Vec<String>,
    },
    /// The figure exists but has no value in this run (`null`).
    NoValue,
}

impl Figures {
    /// All addresses with their values, in alphabetical order: numbers as they
    /// are, booleans as 0 and 1, `None` for null. The members of a list are
    /// addressed by their index, counted from 0.
    pub fn addresses(&self) -> BTreeMap<String, Option<f64>> {
        let mut found = BTreeMap::new();
        for (id, figures) in &self.objects {
            // Plain data cannot fail to serialise; a failure would show as a missing address.
            let value = serde_json::to_value(figures).unwrap_or_default();
            collect_values(id, &value, &mut found);
        }
        let run = serde_json::to_value(&self.run).unwrap_or_default();
        collect_values("run", &run, &mut found);
        let studies = self.studies.iter();
        found.extend(studies.map(|(address, own)| (address.clone(), own.value)));
        found
    }

    /// The value of one figure.
    ///
    /// # Errors
    /// The address is unknown (similar ones are named), or the figure is null.
    pub fn value(&self, address: &str) -> Result<f64, AddressError> {
        match self.at(address) {
            Some(Some(value)) => Ok(value),
            Some(None) => Err(AddressError::NoValue),
            None => Err(AddressError::Unknown {
                close: closest(address, self.addresses().into_keys()),
            }),
        }
    }

    /// What stands at an address, without a list of all; `None`: nothing.
    fn at(&self, address: &str) -> Option<Option<f64>> {
        if let Some(found) = self.studies.get(address) {
            return Some(found.value);
        }
        let (id, name) = owner_of(address, |id| self.objects.contains_key(id));
        let owner = match self.objects.get(id) {
            Some(figures) => serde_json::to_value(figures).ok()?,
            None if id == "run" => serde_json::to_value(&self.run).ok()?,
            None => return None,
        };
        let mut here = &owner;
        for part in name.split('.') {
            here = match here {
                Value::Object(members) => members.get(part)?,
                Value::Array(members) => {
                    let index: usize = part.parse().ok()?;
                    // (As the list writes it: no leading zeros or signs.)
                    members.get(index).filter(|_| index.to_string() == part)?
                }
                Value::Number(_) | Value::Bool(_) | Value::Null | Value::String(_) => return None,
            };
        }
        number(here)
    }

    /// SI unit of a figure; empty for counts, answers and pure numbers, and for what
    /// is no figure.
    pub fn unit(&self, address: &str) -> String {
        if let Some(found) = self.studies.get(address) {
            return found.unit.clone();
        }
        let (id, name) = owner_of(address, |id| self.units.contains_key(id));
        let Some(units) = self.units.get(id) else {
            return match name {
                "time" if id == "run" => "s".to_owned(),
                name if id == "run" && name.starts_with("first_times.") => "s".to_owned(),
                _ => String::new(),
            };
        };
        let displacement = units.displacement;
        match name {
            "delta_abs"
            | "delta_max"
            | "delta_min"
            | "sigma"
            | "final.displacement"
            | "pair.max_lift"
            | "pair.max_indentation"
            | "stop.max_indentation" => displacement.to_owned(),
            "peak_speed"
            | "final.speed"
            | "creep.speed"
            | "pair.max_approach_speed"
            | "stop.max_approach_speed" => {
                format!("{displacement}/s")
            }
            "peak_acceleration" => format!("{displacement}/s²"),
            "peak_reaction"
            | "creep.force"
            | "creep.limit"
            | "pair.max_contact_force"
            | "pair.margin"
            | "stop.max_contact_force" => units.force.to_owned(),
            "pressing.max_pressure" => "Pa".to_owned(),
            "pair.separated_time"
            | "pair.longest_separation"
            | "pressing.time"
            | "time_at_rest"
            | "creep.from"
            | "creep.until"
            | "stop.contact_time" => "s".to_owned(),
            "friction_loss" | "pair.impacts.loss" | "stop.impacts.loss" => "J".to_owned(),
            "pair.impacts.max_impulse" | "stop.impacts.max_impulse" => {
                format!("{} s", units.force)
            }
            name if name.contains(".switch_times.") => "s".to_owned(),
            _ => String::new(),
        }
    }

    /// A measure of what a difference in a figure means: the greatest |δ| of
    /// the object for its displacements, its peaks for the rates and forces, and
    /// the figure's own magnitude for everything else. Counts and 0/1 answers
    /// have the scale 1. Zero when nothing is known.
    pub fn scale(&self, address: &str) -> f64 {
        let (id, figure) = owner_of(address, |id| self.objects.contains_key(id));
        let own = self.value(address).map_or(0.0, f64::abs);
        let Some(object) = self.objects.get(id) else {
            return match figure {
                "steps" | "rejected" | "evaluations" | "switches" | "complete" => 1.0,
                "energy_error" => 0.0,
                _ => own,
            };
        };
        // A part of an object, as a stop, moves with it.
        let whole = || self.objects.get(id.rsplit_once('.')?.0);
        let delta = match object.delta_abs {
            own if own > 0.0 => own,
            _ => whole().map_or(0.0, |whole| whole.delta_abs),
        };
        match figure {
            "delta_abs" | "delta_max" | "delta_min" | "sigma" | "pair.max_lift" => object.delta_abs,
            "final.displacement" if delta > 0.0 => delta,
            "final.speed" => object.peak_speed,
            "pair.separations"
            | "pair.closures"
            | "pair.in_working_order"
            | "pair.impacts.count"
            | "stop.closures"
            | "stop.impacts.count" => 1.0,
            "pair.separated_time" | "pair.longest_separation" | "stop.contact_time" => {
                self.run.time
            }
            _ if figure.contains(".switch_times") => self.run.time,
            _ => own,
        }
    }
}

fn collect_values(prefix: &str, value: &Value, found: &mut BTreeMap<String, Option<f64>>) {
    match value {
        Value::Object(members) => {
            for (name, member) in members {
                collect_values(&format!("{prefix}.{name}"), member, found);
            }
        }
        Value::Array(members) => {
            for (index, member) in members.iter().enumerate() {
                collect_values(&format!("{prefix}.{index}"), member, found);
            }
        }
        Value::Number(_) | Value::Bool(_) | Value::Null | Value::String(_) => {
            if let Some(value) = number(value) {
                found.insert(prefix.to_owned(), value);
            }
        }
    }
}

/// What a figure is: its number, 0 or 1 of an answer, `Some(None)` of null; `None` of what is
/// no figure.
fn number(value: &Value) -> Option<Option<f64>> {
    match value {
        Value::Number(number) => Some(number.as_f64()),
        Value::Bool(flag) => Some(Some(f64::from(u8::from(*flag)))),
        Value::Null => Some(None),
        Value::String(_) | Value::Object(_) | Value::Array(_) => None,
    }
}

fn closest(wanted: &str, known: impl Iterator<Item = String>) -> Vec<String> {
    let mut ranked: Vec<(f64, String)> = known
        .map(|name| (strsim::normalized_damerau_levenshtein(wanted, &name), name))
        .filter(|(similarity, _)| *similarity > 0.5)
        .collect();
    ranked.sort_by_cached_key(|(similarity, name)| (Total(-similarity), name.clone()));
    ranked.truncate(MOST_SUGGESTIONS);
    ranked.into_iter().map(|(_, name)| name).collect()
}

#[cfg(test)]
mod tests {
    use super::AddressError;
    use crate::dynamics::record::{Figures, ObjectFigures, PairFigures, RunSummary, StudyFigure};
    use std::collections::BTreeMap;

    fn figures() -> Figures {
        let rocker = ObjectFigures {
            delta_abs: 5e-3,
            delta_max: 2e-3,
            delta_min: -5e-3,
            pair: Some(PairFigures {
                separations: 3,
                switch_times: vec![0.25, 0.5],
                in_working_order: Some(true),
                ..PairFigures::default()
            }),
            ..ObjectFigures::default()
        };
        Figures {
            dam: 1,
            scene: "s".to_owned(),
            hash: String::new(),
            units: BTreeMap::new(),
            objects: BTreeMap::from([
                ("rocker".to_owned(), rocker),
                ("shaft".to_owned(), ObjectFigures::default()),
            ]),
            run: RunSummary {
                switches: 6,
                ..RunSummary::default()
            },
            studies: BTreeMap::from([(
                "frequency.1".to_owned(),
                StudyFigure {
                    value: Some(12.0),
                    unit: "Hz".to_owned(),
                },
            )]),
            warnings: Vec::new(),
        }
    }

    /// Looking one up and listing all are two ways to the same.
    #[test]
    fn every_address_that_is_listed_is_found_and_no_other() {
        let figures = figures();
        let same = |one: f64, other: f64| one == other || (one.is_nan() && other.is_nan());
        for (address, value) in figures.addresses() {
            match (figures.value(&address), value) {
                (Ok(found), Some(value)) => assert!(same(found, value), "{address}"),
                (Err(AddressError::NoValue), None) => {}
                other => panic!("{address}: {other:?}"),
            }
            for wrong in [
                format!("{address}.0"),
                format!("{address}."),
                format!(".{address}"),
            ] {
                let found = figures.value(&wrong);
                assert!(
                    matches!(found, Err(AddressError::Unknown { .. })),
                    "{wrong}"
                );
            }
        }
        let padded = figures.value("rocker.pair.switch_times.01");
        assert!(matches!(padded, Err(AddressError::Unknown { .. })));
    }

    #[test]
    fn every_number_of_the_document_has_an_address() {
        let figures = figures();
        for (address, value) in [
            ("rocker.delta_max", 2e-3),
            ("rocker.final.speed", 0.0),
            ("rocker.pair.separations", 3.0),
            ("rocker.pair.in_working_order", 1.0),
            ("rocker.pair.switch_times.1", 0.5),
            ("run.switches", 6.0),
            ("run.complete", 0.0),
        ] {
            assert_eq!(figures.value(address), Ok(value), "{address}");
        }
        assert_eq!(figures.value("shaft.pair"), Err(AddressError::NoValue));
    }

    #[test]
    fn a_wrong_address_is_told_the_right_one() {
        let AddressError::Unknown { close } = figures().value("rocker.delta_maks").unwrap_err()
        else {
            panic!("an unknown address");
        };
        assert!(close.contains(&"rocker.delta_max".to_owned()), "{close:?}");
        let Err(AddressError::Unknown { close }) = figures().value("xyz") else {
            panic!("an unknown address");
        };
        assert!(close.is_empty());
    }

    #[test]
    fn differences_are_measured_against_the_deviation() {
        let figures = figures();
        assert_eq!(figures.scale("rocker.delta_max"), 5e-3);
        assert_eq!(figures.scale("rocker.final.displacement"), 5e-3);
        assert_eq!(figures.scale("rocker.pair.separations"), 1.0);
        assert_eq!(figures.scale("nobody.delta_max"), 0.0);
    }
}
