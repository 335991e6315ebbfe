//! The numbers of a scene as it is meant: defaults filled in, in SI units.

use super::Reading;
use super::address::{Part, RESERVED, Step, split_address};
use crate::frontend::read::synonyms;
use serde_json::Value as Json;

/// What holds no parameter of the scene.
const UNSETTABLE: [&str; 4] = ["expect", "objects", "dam", "name"];

/// Most numbers whose addresses are listed.
const MOST: usize = 10_000;

impl Reading {
    /// The number at an address in SI units, given or by default.
    ///
    /// # Errors
    /// What is there instead: `a text`, `a list`; `None`: nothing.
    pub fn number(&self, address: &str) -> Result<f64, Option<&'static str>> {
        let parts = split_address(address).ok_or(None)?;
        let Step::Name(first) = &parts[0].step else {
            return Err(None);
        };
        let mut value = match first.as_str() {
            first if UNSETTABLE.contains(&first) => return Err(None),
            first if RESERVED.contains(&first) => &self.canonical,
            _ => self.canonical.get("objects").ok_or(None)?,
        };
        for part in &parts {
            value = child(value, &part.step).ok_or(None)?;
        }
        match value {
            Json::Number(number) => number.as_f64().ok_or(None),
            Json::Null => Err(None),
            Json::Bool(_) => Err(Some("true or false")),
            Json::String(_) => Err(Some("a text")),
            Json::Array(_) => Err(Some("a list")),
            Json::Object(_) => Err(Some("a group of properties")),
        }
    }

    /// True of two addresses of one property, by whichever of its names.
    pub fn is_same(&self, one: &str, other: &str) -> bool {
        let (one, other) = (split_address(one), split_address(other));
        let same = |(one, other): (&Part, &Part)| match (&one.step, &other.step) {
            (Step::Name(one), Step::Name(other)) if one == other => true,
            (Step::Name(one), Step::Name(other)) => synonyms(one).any(|name| name == other),
            (one, other) => one.list_index() == other.list_index(),
        };
        match (one, other) {
            (Some(one), Some(other)) => {
                one.len() == other.len() && one.iter().zip(&other).all(same)
            }
            _ => false,
        }
    }

    /// Addresses of its numbers, as [`Self::number`] takes them; of a very large scene the
    /// first.
    pub fn number_addresses(&self) -> Vec<String> {
        let mut found = Vec::new();
        for (name, value) in self.canonical.as_object().into_iter().flatten() {
            match name.as_str() {
                "objects" => gather(value, "", &mut found),
                name if UNSETTABLE.contains(&name) => {}
                name => gather(value, name, &mut found),
            }
        }
        found
    }
}

fn child<'v>(value: &'v Json, step: &Step) -> Option<&'v Json> {
    match (value, step) {
        (Json::Object(members), Step::Name(name)) => {
            let other = || synonyms(name).find_map(|other| members.get(other));
            members.get(name).or_else(other)
        }
        (Json::Array(items), step) => items.get(step.list_index()?),
        _ => None,
    }
}

fn gather(value: &Json, path: &str, found: &mut Vec<String>) {
    if found.len() >= MOST {
        return;
    }
    let below = |name: &str| match path {
        "" => name.to_owned(),
        _ => format!("{path}.{name}"),
    };
    match value {
        Json::Number(_) => found.push(path.to_owned()),
        Json::Object(members) => {
            for (name, value) in members {
                gather(value, &below(name), found);
            }
        }
        Json::Array(items) => {
            for (at, value) in items.iter().enumerate() {
                gather(value, &below(&at.to_string()), found);
            }
        }
        Json::Null | Json::Bool(_) | Json::String(_) => {}
    }
}

#[cfg(test)]
mod tests {
    use crate::frontend::scene::{BuiltIn, Document, Overrides, Reading};

    fn reading(text: &str) -> Reading {
        let document = Document::parse("scene.json", text.as_bytes()).unwrap();
        document.scene(&BuiltIn, &Overrides::none()).unwrap()
    }

    #[test]
    fn numbers_are_in_si_units_given_or_by_default() {
        let found = reading(
            r#"{ "dam": 1, "name": "two", "parameters": { "lift": "20 mm" }, "objects": {
                "cam": { "kind": "drive", "motion": { "speed": "60 rpm" } },
                "arm": { "kind": "slider", "input": "cam",
                  "position": { "sine": { "amplitude": "2*lift" } }, "mass": 0.5, "stiffness": 1e6,
                  "loads": { "closing": { "constant": "-2 kN" } } } },
                "run": { "duration": 2 } }"#,
        );
        for (address, value) in [
            ("cam.motion.speed", std::f64::consts::TAU),
            ("arm.inertia", 0.5),
            ("arm.mass", 0.5),
            ("arm.position.sine.amplitude", 0.04),
            ("arm.loads.closing.constant", -2000.0),
            ("run.duration", 2.0),
            ("run.tolerance", 1e-6),
        ] {
            let number = found.number(address).unwrap_or(f64::NAN);
            assert!(
                (number - value).abs() <= 1e-15 * value.abs(),
                "{address} {number}"
            );
        }
        for (address, instead) in [
            ("arm.kind", Some("a text")),
            ("arm.loads", Some("a group of properties")),
            ("arm.stifness", None),
            ("nobody.inertia", None),
            ("no..address", None),
        ] {
            assert_eq!(found.number(address), Err(instead), "{address}");
        }
        let all = found.number_addresses();
        assert!(all.iter().all(|one| found.number(one).is_ok()), "{all:?}");
        assert!(all.contains(&"arm.loads.closing.constant".to_owned()));
    }
}
