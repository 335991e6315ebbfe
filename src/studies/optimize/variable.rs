//! A variable: a number of the scene with its range.

use crate::studies::axis::{Axis, Parameter};
use crate::units;
use serde::Serialize;

/// What a variable looks like, for messages.
const FORM: &str = "write PATH=LOW:HIGH, PATH=LOW:HIGH:START or either with `:log`, for example \
                    rocker.loads.closing.constant=-900:-100 N m";

/// A number of the scene that is chosen from a range.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Variable {
    /// Address, as `--set` takes it: `rocker.inertia`.
    pub path: String,
    /// Unit of its values; empty where none is known.
    pub unit: String,
    /// Least value, in that unit.
    pub low: f64,
    /// Greatest value.
    pub high: f64,
    /// Value of the first start; `None`: that of the scene, or the middle if that lies outside.
    pub start: Option<f64>,
    /// True: the range is divided in equal ratios.
    pub log: bool,
    /// Its unit as it is written; empty: the SI unit.
    #[serde(skip)]
    pub written: String,
    /// Its unit in SI units.
    #[serde(skip)]
    pub size: f64,
}

impl Variable {
    /// Reads `PATH=LOW:HIGH[:START][:log]`. A unit may follow each value, or the last one for all.
    ///
    /// # Errors
    /// What is wrong and what would be right, in one sentence.
    pub fn parse(text: &str) -> Result<Self, String> {
        let wrong = |what: &str| format!("`{text}`: {what}; {FORM}");
        let (path, range) = text.split_once('=').ok_or_else(|| wrong("no `=`"))?;
        let (range, log) = match range.trim_end().strip_suffix(":log") {
            Some(range) => (range, true),
            None => (range, false),
        };
        let parts: Vec<&str> = range.split(':').map(str::trim).collect();
        if !(2..=3).contains(&parts.len()) {
            return Err(wrong(
                "two or three values, separated by colons, are needed",
            ));
        }
        let values = units::with_common_unit(&parts).map_err(|what| wrong(&what))?;
        let [low, high] = [&values[0], &values[1]];
        let number = |text: &str| units::number_and_unit(text)?.0.parse::<f64>().ok();
        if number(low).is_some() && number(low) == number(high) {
            return Err(wrong(
                "both ends are the same, and a variable needs a range",
            ));
        }
        let suffix = if log { ":log" } else { "" };
        let axis = Axis::parse(&format!("{path}={low}:{high}:2{suffix}"))
            .map_err(|what| wrong(own_words(&what)))?;
        let start = match values.get(2) {
            None => None,
            Some(start) => {
                let single = Axis::parse(&format!("{path}={low}:{start}:2"));
                let same = low == start;
                match single {
                    Ok(found) => Some(found.to),
                    Err(_) if same => Some(axis.from),
                    Err(what) => return Err(wrong(own_words(&what))),
                }
            }
        };
        if !(axis.from < axis.to) {
            return Err(wrong("the first value is not the lesser one"));
        }
        if start.is_some_and(|start| !(axis.from..=axis.to).contains(&start)) {
            return Err(wrong("the start lies outside the range"));
        }
        let size = match axis.unit.as_str() {
            "" => 1.0,
            unit => units::parse(&format!("1 {unit}")).map_or(1.0, |found| found.value),
        };
        Ok(Self {
            path: axis.path,
            unit: axis.unit.clone(),
            written: axis.unit,
            low: axis.from,
            high: axis.to,
            start,
            log,
            size,
        })
    }

    /// The parameter of the scene.
    pub fn parameter(&self) -> Parameter {
        Parameter {
            path: self.path.clone(),
            unit: self.written.clone(),
        }
    }

    /// The value at a share of the range.
    pub(crate) fn value(&self, share: f64) -> f64 {
        match (share, self.log) {
            (0.0, _) => self.low,
            (1.0, _) => self.high,
            (share, true) => self.low * ((self.high / self.low).ln() * share).exp(),
            (share, false) => self.low + (self.high - self.low) * share,
        }
    }

    /// The share of the range of a value; `None`: it lies outside.
    pub(crate) fn share(&self, value: f64) -> Option<f64> {
        let share = match self.log {
            true => (value / self.low).ln() / (self.high / self.low).ln(),
            false => (value - self.low) / (self.high - self.low),
        };
        (-1e-12..=1.0 + 1e-12)
            .contains(&share)
            .then(|| share.clamp(0.0, 1.0))
    }

    /// Slope of the value over the share.
    pub(crate) fn slope(&self, share: f64) -> f64 {
        match self.log {
            true => self.value(share) * (self.high / self.low).ln(),
            false => self.high - self.low,
        }
    }
}

/// What is wrong with an axis, without what an axis looks like.
fn own_words(what: &str) -> &str {
    let what = what.split("; write PATH").next().unwrap_or(what);
    what.split_once("`: ").map_or(what, |(_, what)| what)
}

#[cfg(test)]
mod tests {
    use super::Variable;

    #[test]
    fn ends_start_and_unit_are_read() {
        let found = Variable::parse("shaft.motion.speed=100:900:250 rpm").unwrap();
        assert_eq!(
            (found.low, found.high, found.start),
            (100.0, 900.0, Some(250.0))
        );
        assert_eq!(found.unit, "rpm");
        assert!((found.size - std::f64::consts::TAU / 60.0).abs() < 1e-15);
        let found = Variable::parse("rocker.stiffness=1e6:1e8:log").unwrap();
        assert!(found.log && (found.value(0.5) - 1e7).abs() < 1e-6 && found.start.is_none());
        assert!((found.share(1e7).unwrap() - 0.5).abs() < 1e-15);
        // Slopes agree with differences.
        for variable in [found, Variable::parse("a.b=-3:5").unwrap()] {
            let difference = (variable.value(0.3 + 1e-6) - variable.value(0.3 - 1e-6)) / 2e-6;
            assert!((variable.slope(0.3) / difference - 1.0).abs() < 1e-8);
        }
    }

    #[test]
    fn what_is_wrong_is_said() {
        for (text, word) in [
            ("rocker.inertia", "no `=`"),
            ("rocker.inertia=1", "two or three"),
            ("rocker.inertia=2:1", "lesser"),
            ("rocker.inertia=5:5", "both ends are the same"),
            ("rocker.inertia=5:5.0 kg m^2", "both ends are the same"),
            ("rocker.inertia=1:2:3", "outside"),
            ("rocker.inertia=1:x", "`x` is no number"),
            ("rocker.inertia=-1:2:log", "same side of zero"),
            ("=1:2", "address"),
        ] {
            let message = Variable::parse(text).unwrap_err();
            assert!(
                message.contains(word) && message.contains("LOW:HIGH"),
                "{message}"
            );
        }
    }
}
