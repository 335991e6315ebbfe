//! An axis of a parameter study: `rocker.inertia=0.05:1:20`,
//! `shaft.motion.speed=100 rpm:900 rpm:50`, `rocker.stiffness=1e6:1e9:40:log`.

use crate::dynamics::model::{Coordinate, Model};
use crate::units;
use serde::Serialize;

/// Most values of one axis.
pub const MOST_VALUES: usize = 100_000;

/// What an axis looks like, for messages.
const FORM: &str = "write PATH=FROM:TO:COUNT or PATH=FROM:TO:COUNT:log, \
                    for example rocker.inertia=0.05:1:20 or shaft.motion.speed=100:900 rpm:50";

/// A parameter of a scene and the values it takes.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Axis {
    /// Address of the parameter, as `--set` takes it: `rocker.inertia`.
    pub path: String,
    /// Unit in which the values are written; empty: the parameter's SI unit.
    pub unit: String,
    /// First value, in that unit.
    pub from: f64,
    /// Last value; may lie below the first.
    pub to: f64,
    /// Number of values, both ends included; 2 … [`MOST_VALUES`].
    pub count: usize,
    /// True: equal ratios between neighbours; false: equal differences.
    pub log: bool,
}

impl Axis {
    /// Reads `PATH=FROM:TO:COUNT[:log]`. A unit may stand after both ends, or
    /// after the last one for both. Whether the parameter exists and takes
    /// this unit is seen when a scene is read with a value of the axis.
    ///
    /// # Errors
    /// What is wrong and what would be right, in one sentence.
    pub fn parse(text: &str) -> Result<Self, String> {
        let wrong = |what: &str| format!("`{text}`: {what}; {FORM}");
        let (path, range) = text.split_once('=').ok_or_else(|| wrong("no `=`"))?;
        let path = path.trim();
        if path.is_empty() {
            return Err(wrong("the address of the parameter is missing"));
        }
        let parts: Vec<&str> = range.split(':').map(str::trim).collect();
        let (from, to, count, log) = match parts[..] {
            [from, to, count] => (from, to, count, false),
            [from, to, count, "log"] => (from, to, count, true),
            [_, _, _, _] => return Err(wrong("the fourth part can only be `log`")),
            _ => return Err(wrong("three parts, separated by colons, are wanted")),
        };
        let ends = units::with_common_unit(&[from, to]).map_err(|what| wrong(&what))?;
        let (from, first_unit) = number_and_unit(&ends[0]).map_err(|what| wrong(&what))?;
        let (to, last_unit) = number_and_unit(&ends[1]).map_err(|what| wrong(&what))?;
        if first_unit != last_unit {
            return Err(wrong("both ends must be given in the same unit"));
        }
        let axis = Self {
            path: path.to_owned(),
            unit: last_unit.to_owned(),
            from,
            to,
            count: parse_count(count).map_err(|what| wrong(&what))?,
            log,
        };
        axis.check().map_err(|what| wrong(&what))?;
        Ok(axis)
    }

    /// Values with equal differences, from the first to the last.
    pub fn linear(path: &str, from: f64, to: f64, count: usize) -> Self {
        Self {
            path: path.to_owned(),
            unit: String::new(),
            from,
            to,
            count,
            log: false,
        }
    }

    /// Values with equal ratios.
    pub fn log(path: &str, from: f64, to: f64, count: usize) -> Self {
        Self {
            log: true,
            ..Self::linear(path, from, to, count)
        }
    }

    /// With the unit in which its values are written; without it they are in the
    /// parameter's SI unit.
    #[must_use]
    pub fn unit(mut self, unit: &str) -> Self {
        unit.clone_into(&mut self.unit);
        self
    }

    /// Whether its values are numbers that differ from each other.
    ///
    /// # Errors
    /// What is wrong, in words.
    pub fn check(&self) -> Result<(), String> {
        if !(2..=MOST_VALUES).contains(&self.count) {
            let count = self.count;
            return Err(format!(
                "{count} values are wanted, and an axis has 2 to {MOST_VALUES}"
            ));
        }
        if self.log && (self.from == 0.0 || self.from.signum() * self.to <= 0.0) {
            return Err("a log axis needs both ends on the same side of zero".to_owned());
        }
        let values = self.values();
        if values.iter().any(|value| !value.is_finite()) {
            return Err("the ends are too large".to_owned());
        }
        if values.windows(2).any(|pair| pair[0] == pair[1]) {
            return Err("the ends are too close for that many different values".to_owned());
        }
        Ok(())
    }

    /// All values in the axis's unit, from the first to the last. The ends are
    /// exactly those given, the others are rounded to 15 significant digits.
    pub fn values(&self) -> Vec<f64> {
        (0..self.count).map(|index| self.value(index)).collect()
    }

    /// The value at an index below `count`.
    fn value(&self, index: usize) -> f64 {
        let last = self.count - 1;
        if index == 0 {
            return self.from;
        }
        if index == last {
            return self.to;
        }
        let share = index as f64 / last as f64;
        rounded(if self.log {
            self.from * ((self.to / self.from).ln() * share).exp()
        } else {
            self.from + (self.to - self.from) * share
        })
    }

    /// The setting `PATH=VALUE` of a value, as [`crate::frontend::scene::Overrides`]
    /// takes it; every digit of the value is kept.
    pub fn setting(&self, value: f64) -> String {
        self.parameter().setting(value)
    }

    /// The value with its unit, every digit kept: `250 rpm`, `1e7`.
    pub fn value_with_unit(&self, value: f64) -> String {
        self.parameter().value_with_unit(value)
    }

    /// The unit to show the values with: the one they were given in, else the SI
    /// unit of the parameter in a model where it is known, else none.
    pub fn display_unit(&self, model: &Model) -> String {
        self.parameter().display_unit(model)
    }

    /// The parameter along the axis.
    pub fn parameter(&self) -> Parameter {
        Parameter {
            path: self.path.clone(),
            unit: self.unit.clone(),
        }
    }
}

/// A parameter of a scene: a number that takes several values.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Parameter {
    /// Address of the number, as `--set` takes it: `rocker.inertia`.
    pub path: String,
    /// Unit of its values; empty: the SI unit.
    pub unit: String,
}

impl Parameter {
    /// As [`Axis::setting`].
    pub fn setting(&self, value: f64) -> String {
        format!("{}={}", self.path, self.value_with_unit(value))
    }

    /// As [`Axis::value_with_unit`].
    pub fn value_with_unit(&self, value: f64) -> String {
        // A whole number may address a count, which takes no fraction.
        let number = if value.fract() == 0.0 && value.abs() < 1e15 {
            format!("{value:.0}")
        } else {
            format!("{value:?}")
        };
        match self.unit.as_str() {
            "" => number,
            unit => format!("{number} {unit}"),
        }
    }

    /// As [`Axis::display_unit`].
    pub fn display_unit(&self, model: &Model) -> String {
        match self.unit.as_str() {
            "" => parameter_unit(&self.path, model).to_owned(),
            unit => unit.to_owned(),
        }
    }
}

/// A value to 15 significant digits: 0.1 instead of 0.09999999999999999.
fn rounded(value: f64) -> f64 {
    format!("{value:.14e}").parse().unwrap_or(value)
}

fn parse_count(text: &str) -> Result<usize, String> {
    let count = text.parse::<usize>();
    count.map_err(|_| format!("`{text}` is no number of values"))
}

/// Splits `100 rpm` into its number and its unit, both checked.
fn number_and_unit(text: &str) -> Result<(f64, &str), String> {
    let no_number = || format!("`{text}` is no number with or without a unit");
    let (number, unit) = units::number_and_unit(text).ok_or_else(no_number)?;
    let number: f64 = number.parse().map_err(|_| no_number())?;
    if !number.is_finite() {
        return Err(format!("`{text}` is too large"));
    }
    if !unit.is_empty() && units::parse(&format!("1 {unit}")).is_err() {
        return Err(format!("`{unit}` is no unit"));
    }
    Ok((number, unit))
}

/// SI unit of a scene's parameter, by the name it ends with; empty when it has
/// none or is not among the common ones.
fn parameter_unit(path: &str, model: &Model) -> &'static str {
    let (id, rest) = path.split_once('.').unwrap_or((path, ""));
    let part = model.objects.iter().find(|part| part.id == id);
    let turning = part.is_none_or(|part| part.coordinate == Coordinate::Turning);
    let either = |turned, slid| if turning { turned } else { slid };
    let parts: Vec<&str> = rest.split('.').collect();
    // (What is nested deeper may measure anything.)
    match parts.as_slice() {
        ["ground", ..] | ["links", _, "points", ..] => "m",
        ["inertia"] | ["motor", "inertia"] => either("kg m²", "kg"),
        ["mass"] | ["links", _, "mass"] => "kg",
        ["moment"] | ["links", _, "moment"] => "kg m²",
        ["stiffness"] => either("N m/rad", "N/m"),
        ["damping"] => either("N m s/rad", "N s/m"),
        ["loads", _, "constant"] => either("N m", "N"),
        ["pair", "gap"] => either("rad", "m"),
        ["position", "cam", "lift"] => either("rad", "m"),
        ["motion" | "motor", "speed"] => either("rad/s", "m/s"),
        ["duration"] => "s",
        _ => "",
    }
}

#[cfg(test)]
mod tests {
    use super::Axis;

    #[test]
    fn ends_are_exact_and_neighbours_even() {
        let axis = Axis::parse("rocker.inertia=0.05:1:20").unwrap();
        let values = axis.values();
        assert_eq!((values[0], values[19], values.len()), (0.05, 1.0, 20));
        assert_eq!(values[1], 0.1);
        let axis = Axis::parse("rocker.stiffness = 1e6 : 1e9 : 4 : log").unwrap();
        assert_eq!(axis.path, "rocker.stiffness");
        for (value, wanted) in axis.values().iter().zip([1e6, 1e7, 1e8, 1e9]) {
            assert_eq!(*value, wanted);
        }
        let down = Axis::parse("a.b=-1:-100:3:log").unwrap().values();
        assert_eq!(down, [-1.0, -10.0, -100.0]);
    }

    #[test]
    fn units_stand_at_both_ends_or_the_last() {
        for text in ["a.b=100 rpm:900 rpm:3", "a.b=100:900rpm:3"] {
            let axis = Axis::parse(text).unwrap();
            assert_eq!(axis.unit, "rpm");
            assert_eq!(axis.setting(500.0), "a.b=500 rpm");
        }
        let axis = Axis::parse("a.b=1e-3:0.5:3").unwrap();
        assert_eq!(axis.setting(1e-3), "a.b=0.001");
        assert_eq!(axis.setting(2.0), "a.b=2");
        assert_eq!(axis.value_with_unit(1e22), "1e22");
    }

    #[test]
    fn what_is_wrong_is_said() {
        for (text, word) in [
            ("rocker.inertia", "no `=`"),
            ("=1:2:3", "address"),
            ("a.b=1:2", "three parts"),
            ("a.b=1:2:3:4:5", "three parts"),
            ("a.b=1:2:3:lin", "`log`"),
            ("a.b=1:2:1", "2 to 100000"),
            ("a.b=1:2:999999999", "2 to 100000"),
            ("a.b=1:2:x", "`x` is no number of values"),
            ("a.b=x:2:3", "`x` is no number"),
            ("a.b=:2:3", "`` is no number"),
            ("a.b=nan:2:3", "`nan` is no number"),
            ("a.b=1e999:2:3", "too large"),
            ("a.b=-1e308:1e308:1000", "too large"),
            ("a.b=1 rpm:2 rad/s:3", "same unit"),
            ("a.b=1 rpm:2:3", "`2` has no unit"),
            ("a.b=1 furlong:2 furlong:3", "`furlong` is no unit"),
            ("a.b=0:2:3:log", "same side of zero"),
            ("a.b=-1:2:3:log", "same side of zero"),
            ("a.b=1:1:3", "too close"),
            ("a.b=1:1.0000000000000002:9", "too close"),
            ("a.b=1é:2é:3", "is no unit"),
        ] {
            let message = Axis::parse(text).unwrap_err();
            assert!(message.contains(word), "{text}: {message}");
            assert!(message.contains("FROM:TO:COUNT"), "{message}");
        }
    }
}
