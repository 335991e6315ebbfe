//! Reading of numbers, with and without units.

use super::bounds::Bounds;
use super::bounds::number_text;
use super::formulas::FORMULA_PATTERN;
use super::slot::{Slot, last_name};
use super::suggest::did_you_mean;
use super::tree::Value;
use super::wanted::QuantityChoice;
use crate::frontend::diagnostics::Diagnostic;
use crate::units::quantities::{self, NUMBER};
use crate::units::{Measure, Mismatch, Quantity, UnitError, known_units, parse, shown};
use serde_json::{Map, json};
use std::ops::RangeInclusive;

/// Why a text with a unit is refused.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct UnitFault {
    /// Code of the fault.
    pub(crate) code: &'static str,
    /// What is wrong.
    pub(crate) message: String,
    /// What the text says instead; empty: nothing.
    pub(crate) label: String,
    /// What would be right.
    pub(crate) hint: String,
}

impl UnitFault {
    /// The message for a property whose unit does not fit. `path`, `text`: its address, and what is
    /// written there; `measure`, `mismatch`: what was read, and why it does not fit; `si`: the unit
    /// to propose; `words`: all accepted quantities in words, for the hint "it is …".
    pub(crate) fn new(
        (path, text): (&str, &str),
        (measure, mismatch): (Measure, Mismatch),
        (si, words): (&str, &str),
    ) -> Self {
        let (name, value) = (last_name(path), measure.value);
        let (code, message, hint) = match mismatch {
            Mismatch::Bare => (
                "missing-unit",
                format!("{name} is a text without a unit: \"{}\"", shorten(text)),
                format!(
                    "write {0} without quotes, or \"{0} {si}\"",
                    number_text(value)
                ),
            ),
            Mismatch::FrequencyForSpeed => (
                "wrong-unit",
                format!("{name} is an angular speed, not a frequency"),
                format!(
                    "\"{value} rev/s\" or \"{} rad/s\"",
                    shown(value * std::f64::consts::TAU, 3)
                ),
            ),
            Mismatch::SpeedForFrequency => (
                "wrong-unit",
                format!("{name} is a frequency, not an angular speed"),
                format!("\"{} Hz\"", shown(value / std::f64::consts::TAU, 3)),
            ),
            Mismatch::Dimension => (
                "wrong-unit",
                format!("{name} has the wrong unit: \"{}\"", shorten(text)),
                format!("it is {words}"),
            ),
        };
        let label = match mismatch {
            Mismatch::Bare => String::new(),
            _ => format!("this is in {}", measure.dimension),
        };
        Self {
            code,
            message,
            label,
            hint,
        }
    }
}

/// What machines have in SI units, and the unit in which people think of it.
const USUAL: [(Quantity, [f64; 2], &str); 3] = [
    (quantities::LENGTH, [0.0, 50.0], "mm"),
    (quantities::DENSITY, [100.0, 3e4], "g/cm^3"),
    (quantities::MODULUS, [1e5, 1e13], "GPa"),
];

impl Slot<'_> {
    /// Reads a number in SI units, or a text with a unit.
    pub fn quantity(mut self, wanted: impl Into<QuantityChoice>, bounds: Bounds) -> Option<f64> {
        let wanted = wanted.into();
        if self.describing() {
            let mut number = Map::new();
            number.insert("type".into(), json!("number"));
            bounds.describe(&mut number);
            *self.out = json!({
                "description": format!("({})", wanted.words()),
                "anyOf": [number, { "type": "string", "pattern": FORMULA_PATTERN }],
            });
            if wanted.first.units != NUMBER.units {
                self.out["examples"] = json!(wanted.examples());
            }
            return None;
        }
        self.declare(Some(wanted), bounds);
        let value = match &self.node?.value {
            Value::Number(value) => {
                self.warn_of_unit(*value, &wanted);
                *value
            }
            Value::Text(text) => self.measure(text, &wanted)?,
            _ => {
                let hint = wanted.words();
                self.wrong_type("a number").hints.push(hint);
                return None;
            }
        };
        self.check_bounds(value, bounds, wanted.first.si())
    }

    /// Reads a number without a unit.
    pub fn number(self, bounds: Bounds) -> Option<f64> {
        self.quantity(NUMBER, bounds)
    }

    /// Reads a whole number.
    pub fn count(mut self, range: RangeInclusive<u64>) -> Option<u64> {
        if self.describing() {
            *self.out = json!({ "anyOf": [
                { "type": "integer", "minimum": range.start(), "maximum": range.end() },
                { "type": "string", "pattern": FORMULA_PATTERN },
            ] });
            return None;
        }
        self.declare(
            None,
            Bounds::between(*range.start() as f64, *range.end() as f64),
        );
        let value = match &self.node?.value {
            Value::Number(value) => *value,
            Value::Text(text) if self.is_formula() => self.measure(text, &NUMBER.into())?,
            _ => {
                self.wrong_type("a whole number").code = "not-whole";
                return None;
            }
        };
        let whole = value.fract() == 0.0 && (0.0..=9e15).contains(&value);
        if !whole || !range.contains(&(value as u64)) {
            let name = last_name(&self.path);
            let (least, most) = (range.start(), range.end());
            let message = match least == most {
                true => format!("{name} must be {least}, found {value}"),
                false => {
                    format!("{name} must be a whole number from {least} to {most}, found {value}")
                }
            };
            let is_whole = value.fract() == 0.0;
            let code = if is_whole {
                "out-of-range"
            } else {
                "not-whole"
            };
            self.refuse(code, message);
            return None;
        }
        *self.out = json!(value as u64);
        Some(value as u64)
    }

    /// Reads a unit, without a number: the factor to SI units.
    pub fn unit(mut self, wanted: impl Into<QuantityChoice>) -> Option<f64> {
        let wanted = wanted.into();
        if self.describing() {
            let units: Vec<&str> = wanted
                .quantities()
                .flat_map(|one| one.units)
                .copied()
                .collect();
            *self.out = json!({
                "description": format!("({})", wanted.words()),
                "type": "string",
                "minLength": 1,
                "examples": units,
            });
            return None;
        }
        let text = self.read_in_place(|slot| slot.text())?;
        let named = |c: char| c.is_alphabetic() || c == '%' || c == '°';
        let begins = text.starts_with(named) || text.starts_with("1/");
        let measure = parse(&format!("1 {text}")).ok().filter(|_| begins);
        let value = measure.and_then(|measure| wanted.convert_measure(measure).ok());
        if value.is_none() {
            let message = format!("\"{}\" is no unit of what is wanted here", shorten(&text));
            let hint = wanted.words();
            self.refuse("unknown-unit", message).hints.push(hint);
        }
        value
    }

    /// Warns of a number without a unit that is likely meant in another one than SI.
    fn warn_of_unit(&mut self, value: f64, wanted: &QuantityChoice) {
        let usual = USUAL.iter().find(|one| one.0 == wanted.first);
        let Some((quantity, [least, most], unit)) = usual.filter(|_| wanted.second.is_none())
        else {
            return;
        };
        let size = value.abs();
        let listed = self.path.contains('[') || self.path.starts_with("expect");
        if size == 0.0 || (*least..=*most).contains(&size) || listed {
            return;
        }
        let (name, si, value) = (last_name(&self.path), quantity.si(), number_text(value));
        let message = format!("{name} is {value} {si}: a number without a unit is in SI units");
        let warning = Diagnostic::warning("implausible", message)
            .at(self.place())
            .path(self.path.clone())
            .hint(format!(
                "write \"{value} {unit}\", or \"{value} {si}\" if it is meant"
            ));
        self.reader.diagnostics.push(warning);
    }

    fn check_bounds(&mut self, value: f64, bounds: Bounds, unit: &str) -> Option<f64> {
        let name = last_name(&self.path);
        if !value.is_finite() {
            let (message, hint) = match value.is_nan() {
                true => (format!("{name} is not a number"), "it was computed as NaN"),
                false => (
                    format!("{name} is too large for a number"),
                    "numbers go up to about 1.8e308",
                ),
            };
            self.refuse("not-finite", message)
                .hints
                .push(hint.to_owned());
            return None;
        }
        if !bounds.hold(value) {
            let unit = if unit == "1" {
                String::new()
            } else {
                format!(" {unit}")
            };
            let (wanted, found) = (bounds.words(), number_text(value));
            let message = format!("{name} must be {wanted}, found {found}{unit}");
            self.refuse("out-of-range", message);
            return None;
        }
        // Adding zero turns −0 into 0: one number, one canonical form.
        *self.out = json!(value + 0.0);
        Some(value)
    }

    /// A text with a unit, as a value in SI units.
    fn measure(&mut self, text: &str, wanted: &QuantityChoice) -> Option<f64> {
        let measure = self.stated(text, wanted)?;
        // A named number without a unit is in the SI unit of whatever is wanted.
        if measure.bare && parse(text).is_err() {
            return Some(measure.value);
        }
        match wanted.convert_measure(measure) {
            Ok(value) => return Some(value),
            Err(mismatch) => self.report_mismatch(text, measure, mismatch, wanted),
        }
        None
    }

    pub(super) fn unit_fault(&mut self, text: &str, error: UnitError, wanted: &QuantityChoice) {
        let name = last_name(&self.path);
        let accepts = format!("write a number in SI units, or a text: {}", wanted.words());
        let (code, message, hint, offset) = match error {
            UnitError::NoNumber => (
                "not-a-number",
                format!("{name} does not begin with a number: \"{}\"", shorten(text)),
                None,
                None,
            ),
            UnitError::DecimalComma { corrected } => (
                "not-a-number",
                "a decimal comma".to_owned(),
                Some(format!("write a point: \"{}\"", shorten(&corrected))),
                None,
            ),
            UnitError::NotFinite => (
                "not-finite",
                format!("{name} is too large for a number"),
                None,
                None,
            ),
            UnitError::UnknownUnit { symbol, offset } => {
                let hint = near_unit(text, offset, &symbol, wanted);
                let message = format!("unknown unit `{}`", shorten(&symbol));
                ("unknown-unit", message, hint, Some(offset))
            }
            UnitError::Ambiguous { offset } => (
                "ambiguous-unit",
                "a product after a quotient can be read in two ways".to_owned(),
                Some(
                    "write products first, and a `/` before every divisor: \"N s/m\", \"N/m/s\""
                        .to_owned(),
                ),
                Some(offset),
            ),
            UnitError::Unexpected { found, offset } => (
                "unknown-unit",
                format!("`{found}` does not belong in a unit"),
                Some("units are written like \"mm\", \"N m/rad\", \"kg/m^3\"".to_owned()),
                Some(offset),
            ),
            UnitError::Incomplete { offset } => (
                "unknown-unit",
                "the unit is not complete".to_owned(),
                None,
                Some(offset),
            ),
        };
        // The text's own bytes follow its opening quote; on the command line it has none.
        let whole = self.place();
        let quote = usize::from(whole.range.len() > text.len());
        let place = match offset {
            Some(offset) => whole.within(offset + quote..text.len() + quote),
            None => whole,
        };
        let fault = self.refuse(code, message);
        fault.place = Some(place);
        fault.hints.extend(hint);
        fault.hints.push(accepts);
    }

    pub(super) fn report_mismatch(
        &mut self,
        text: &str,
        measure: Measure,
        mismatch: Mismatch,
        wanted: &QuantityChoice,
    ) {
        let refused = UnitFault::new(
            (&self.path, text),
            (measure, mismatch),
            (wanted.first.si(), &wanted.words()),
        );
        let fault = self.refuse(refused.code, refused.message);
        fault.label = refused.label;
        fault.hints.push(refused.hint);
    }
}

/// A unit of what is wanted that `symbol` at `offset` of `text` may be a slip of: the same in
/// other case first.
fn near_unit(text: &str, offset: usize, symbol: &str, wanted: &QuantityChoice) -> Option<String> {
    let (before, after) = (&text[..offset], &text[offset + symbol.len()..]);
    // A text with two slips tells of neither what it measures: then any unit may be meant.
    let fits = |unit: &str| match parse(&format!("{before}{unit}{after}")) {
        Ok(measure) => wanted.convert_measure(measure).is_ok(),
        Err(_) => true,
    };
    let units: Vec<String> = known_units();
    let mut units: Vec<&str> = units.iter().map(String::as_str).collect();
    units.retain(|unit| fits(unit));
    let lower = symbol.to_lowercase();
    let same = units.iter().find(|unit| unit.to_lowercase() == lower);
    let spelled = || spelled_out(&lower).filter(|unit| fits(unit));
    match same.copied().or_else(spelled) {
        Some(unit) => Some(format!("did you mean `{unit}`?")),
        None => did_you_mean(symbol, units.iter().copied()),
    }
}

/// The unit that a word means.
fn spelled_out(word: &str) -> Option<&'static str> {
    Some(match word {
        "degree" | "degrees" => "deg",
        "radian" | "radians" => "rad",
        "sec" | "second" | "seconds" => "s",
        "meter" | "metre" | "meters" | "metres" => "m",
        "inch" | "inches" => "in",
        "foot" | "feet" => "ft",
        "pound" | "pounds" | "lbs" => "lb",
        "newton" | "newtons" => "N",
        "kilogram" | "kilograms" => "kg",
        "kilopond" | "kp" => "kgf",
        "horsepower" => "hp",
        "micron" | "microns" => "µm",
        "hour" | "hours" | "hr" => "h",
        "minute" | "minutes" => "min",
        "revolution" | "revolutions" | "revs" | "turns" => "rev",
        _ => return None,
    })
}

pub(super) fn shorten(text: &str) -> String {
    match text.char_indices().nth(60) {
        None => text.to_owned(),
        Some((at, _)) => format!("{}…", &text[..at]),
    }
}
