//! The units and digits in which texts and pages show results.
//!
//! A scene states angles in degrees or radians, lengths in millimetres or metres, speeds in turns a
//! minute: results are shown alike. What it states no unit for keeps the SI unit with the prefix
//! that reads best, and so does a value that would be too large or too small to read.
//!
//! The choice holds for the thread that makes the texts. Only the program makes one, when it has
//! read its arguments and its scene. Documents and tables for other programs are in SI units in
//! any case.

use crate::units::{Dimension, number_and_unit, parse};
use serde_json::Value;
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::sync::OnceLock;

/// Significant digits of results, if nothing else is said.
pub const SIGNIFICANT: usize = 4;
/// Values of less digits than this are errors and bounds, and keep theirs.
const RESULT: usize = 4;
/// SI units that are shown in the unit of the scene.
const SHOWN: [&str; 12] = [
    "rad", "m", "rad/s", "m/s", "rad/s²", "m/s²", "N", "N m", "kg", "kg m²", "N/m", "N m/rad",
];
/// Sizes of numbers that are still read at a glance.
const READABLE: [f64; 2] = [1e-3, 1e5];
/// Least number that is shown in a unit of thousands: 6.6 N, and not 0.0066 kN.
const OF_THOUSANDS: f64 = 1e-2;

/// A scale for showing values of one unit: shown = value / `factor`.
#[derive(Clone, Debug, PartialEq)]
pub struct Scale {
    /// Divisor that leads from the SI unit to the one shown.
    pub factor: f64,
    /// Unit of the result: `mrad`, `10⁻¹⁵ rad`, `kN m`.
    pub unit: String,
}

thread_local! {
    static CHOICE: RefCell<DisplayUnits> = const { RefCell::new(DisplayUnits::NONE) };
}

/// A choice of units and digits.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct DisplayUnits {
    /// SI units, the names of the units shown in their place, and the sizes of these.
    units: Vec<(&'static str, String, f64)>,
    digits: Option<usize>,
}

impl DisplayUnits {
    /// SI units with prefixes, digits as they come.
    pub const NONE: Self = Self {
        units: Vec::new(),
        digits: None,
    };

    /// The units that a scene's text uses, of each quantity the one that it uses most.
    pub fn of_scene(text: &str) -> Self {
        let Ok(scene) = serde_json::from_str::<Value>(text) else {
            return Self::NONE;
        };
        let mut chosen = Self::NONE;
        chosen.add_most_used(&scene);
        // What is expected may come from elsewhere, and counts where nothing else does.
        chosen.add_most_used(&scene["expect"]);
        chosen
    }

    /// Adds the units of a text, those that it uses most first.
    fn add_most_used(&mut self, text: &Value) {
        let mut counts: BTreeMap<String, usize> = BTreeMap::new();
        count(text, &mut counts);
        let mut names: Vec<(String, usize)> = counts.into_iter().collect();
        // (Of equals the first by name.)
        names.sort_by_key(|name| std::cmp::Reverse(name.1));
        for (name, _) in names {
            self.add(&name);
        }
    }

    /// The units of a list: `mm,deg,rpm,kN`.
    ///
    /// # Errors
    /// What is no unit of a quantity that results are shown in.
    pub fn listed(list: &str) -> Result<Self, String> {
        let mut chosen = Self::NONE;
        for name in list
            .split(',')
            .map(str::trim)
            .filter(|name| !name.is_empty())
        {
            if name == "si" {
                continue;
            }
            if !chosen.add(name) {
                return Err(format!(
                    "`{name}` is no unit of a quantity that is not chosen yet: write units with \
                     commas, one for a quantity, such as mm,deg,rpm,kN; or si"
                ));
            }
        }
        Ok(chosen)
    }

    /// With that many significant digits.
    #[must_use]
    pub fn with_digits(self, digits: usize) -> Self {
        Self {
            digits: Some(digits),
            ..self
        }
    }

    /// Takes a unit for the quantities that it measures; false where it measures none, or one that
    /// has its unit already.
    fn add(&mut self, name: &str) -> bool {
        let Ok(measure) = parse(&format!("1 {name}")) else {
            return false;
        };
        let mut added = false;
        for &(si, wanted) in shown_units() {
            let size = match measure.dimension == wanted {
                true => measure.value,
                // By custom 1/min is a speed of turning too.
                false if measure.per_minute && si == "rad/s" => {
                    measure.value * std::f64::consts::TAU
                }
                false => continue,
            };
            if self.units.iter().all(|(known, ..)| *known != si) {
                let name = name.replace("^2", "²").replace("^3", "³");
                self.units.push((si, name, size));
                added = true;
            }
        }
        added
    }

    /// From now on, the choice of this thread.
    pub fn choose(self) {
        CHOICE.with_borrow_mut(|choice| *choice = self);
    }

    /// The units of this thread, for scripts of pages: SI unit, unit, size.
    pub(in crate::report) fn units_of_thread() -> Vec<(&'static str, String, f64)> {
        CHOICE.with_borrow(|choice| choice.units.clone())
    }
}

/// The SI units that are shown in others, with their dimensions.
fn shown_units() -> &'static [(&'static str, Dimension)] {
    static ALL: OnceLock<Vec<(&str, Dimension)>> = OnceLock::new();
    ALL.get_or_init(|| {
        let one = |si: &'static str| Some((si, parse(&format!("1 {si}")).ok()?.dimension));
        SHOWN.into_iter().filter_map(one).collect()
    })
}

/// Counts the units of all texts that are quantities.
fn count(value: &Value, counts: &mut BTreeMap<String, usize>) {
    match value {
        Value::String(text) => {
            if let Some((_, unit)) = number_and_unit(text).filter(|(_, unit)| !unit.is_empty())
                && parse(text).is_ok()
            {
                *counts.entry(unit.to_owned()).or_default() += 1;
            }
        }
        Value::Array(values) => values.iter().for_each(|value| count(value, counts)),
        Value::Object(entries) => {
            let own = entries.iter().filter(|(name, _)| *name != "expect");
            own.for_each(|(_, value)| count(value, counts));
        }
        Value::Null | Value::Bool(_) | Value::Number(_) => {}
    }
}

/// The scale that this thread has chosen for a unit; `None`: the one that reads best.
pub(super) fn scale_of_thread(magnitude: f64, unit: &str) -> Option<Scale> {
    CHOICE.with_borrow(|choice| {
        let (_, name, size) = choice.units.iter().find(|(si, ..)| *si == unit)?;
        let shown = (magnitude / size).abs();
        let least = match *size >= 1e3 {
            true => OF_THOUSANDS,
            false => READABLE[0],
        };
        let readable = shown == 0.0 || (least..READABLE[1]).contains(&shown);
        readable.then(|| Scale {
            factor: *size,
            unit: name.clone(),
        })
    })
}

/// The digits that this thread shows of a number that has so many.
pub(super) fn shown_digits(own: usize) -> usize {
    CHOICE.with_borrow(|choice| match choice.digits {
        Some(digits) if own >= RESULT => digits,
        Some(digits) => own.min(digits),
        None => own,
    })
}

#[cfg(test)]
mod tests {
    use super::{DisplayUnits, scale_of_thread, shown_digits};

    const SCENE: &str = r#"{ "objects": {
        "a": { "motion": { "speed": "600 rpm" }, "position": { "rise": "90 deg", "lift": "12 mm" } },
        "b": { "stiffness": "3 kN/mm", "length": "1 m", "width": "20 mm", "name": "5 apples", "inertia": "2 kg m^2" } },
        "expect": [{ "value": "3 rad/s" }, { "value": "4 rad/s" }] }"#;

    #[test]
    fn results_are_shown_in_the_units_of_the_scene() {
        let chosen = DisplayUnits::of_scene(SCENE);
        std::thread::spawn(move || {
            chosen.with_digits(5).choose();
            let of = |value: f64, unit: &str| {
                scale_of_thread(value, unit).map(|scale| (value / scale.factor, scale.unit))
            };
            let near = |found: Option<(f64, String)>, value: f64, unit: &str| {
                let (number, name) = found.unwrap();
                assert!(
                    (number - value).abs() < 1e-9 * value && name == unit,
                    "{number} {name}"
                );
            };
            near(of(0.0125, "m"), 12.5, "mm");
            near(of(std::f64::consts::PI, "rad"), 180.0, "deg");
            near(of(10.0 * std::f64::consts::PI, "rad/s"), 300.0, "rpm");
            near(of(5e6, "N/m"), 5.0, "kN/mm");
            near(of(0.5, "kg m²"), 0.5, "kg m²");
            // Not stated, or too small to be read.
            assert!(of(3e3, "N/m").is_none() && of(2e4, "N/m").is_some());
            assert!(of(3.0, "N").is_none() && of(3.0, "s").is_none() && of(1e-9, "m").is_none());
            assert_eq!(
                (shown_digits(7), shown_digits(4), shown_digits(2)),
                (5, 5, 2)
            );
        })
        .join()
        .unwrap();
        // Other threads have their own.
        assert!(scale_of_thread(0.0125, "m").is_none());
        assert_eq!(shown_digits(7), 7);
    }

    #[test]
    fn a_list_names_one_unit_for_a_quantity() {
        assert!(DisplayUnits::listed("mm,deg,rpm,kN").is_ok());
        assert_eq!(DisplayUnits::listed("si").unwrap(), DisplayUnits::NONE);
        for wrong in ["mm,cm", "furlong", "ms"] {
            assert!(
                DisplayUnits::listed(wrong).unwrap_err().contains("mm,deg"),
                "{wrong}"
            );
        }
    }
}
