//! Conditions on figures as a command line has them: `valve.delta_abs <= 0.2 mm`.
//!
//! The same grammar serves every command that takes conditions: the address of a figure, one of
//! `<=`, `>=` and `=`, and a value in any unit of what the figure measures. Strict comparisons
//! are refused: no computation can tell them from the others. Greatest and least values may be
//! those of a part of the motion: `valve.delta_abs <= 0.2 mm from 30 deg to 120 deg`.

use super::prepared::{check_figure, figure_unit};
use super::studied::quantity_of;
use crate::dynamics::model::Model;
use crate::units::{number_and_unit, parse};
use serde::Serialize;

/// What a condition looks like, for messages.
const FORM: &str = "write FIGURE >= VALUE UNIT, FIGURE <= VALUE UNIT or FIGURE = VALUE UNIT, for \
                    example \"valve.delta_abs <= 0.2 mm\"";

/// Figures that count or answer, by the last part of their addresses: they have no value between
/// two others.
const COUNTS: [&str; 11] = [
    "separations",
    "closures",
    "count",
    "in_working_order",
    "standstills",
    "complete",
    "switches",
    "steps",
    "rejected",
    "evaluations",
    "periods",
];

/// How a figure has to stand to a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Relation {
    /// No greater than the value.
    AtMost,
    /// No less than the value.
    AtLeast,
    /// The value itself.
    Equal,
}

impl Relation {
    /// As it is written.
    pub fn sign(self) -> &'static str {
        match self {
            Self::AtMost => "<=",
            Self::AtLeast => ">=",
            Self::Equal => "=",
        }
    }
}

/// A condition on a figure.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Condition {
    /// The condition as it was written.
    pub text: String,
    /// Address of the figure.
    pub figure: String,
    /// How it has to stand to the value.
    pub relation: Relation,
    /// The value in the SI unit.
    pub value: f64,
    /// SI unit of the figure; empty of a plain number, a count, or what is true (1) or false (0).
    pub unit: String,
    /// The unit in which the value was written.
    #[serde(skip)]
    pub written: WrittenUnit,
    /// True: the figure keeps a value over a range, as counts do.
    #[serde(skip)]
    pub kept: bool,
}

/// A unit as it was written.
#[derive(Clone, Debug, PartialEq)]
pub struct WrittenUnit {
    /// Its name; empty where none was written.
    pub name: String,
    /// Its size in the SI unit.
    pub size: f64,
}

impl Condition {
    /// Reads a condition on a figure of a model.
    ///
    /// # Errors
    /// What is wrong and what would be right, in one sentence.
    pub fn parse(text: &str, model: &Model) -> Result<Self, String> {
        Self::parse_with(text, &|figure| Self::unit_of(figure, model))
    }

    /// Reads a condition on a figure whose unit is known in another way.
    pub(crate) fn parse_with(
        text: &str,
        unit_of: &dyn Fn(&str) -> Result<String, String>,
    ) -> Result<Self, String> {
        let wrong = |what: String| format!("`{text}`: {what}");
        let (figure, relation, value) =
            split_condition(text).map_err(|what| wrong(format!("{what}; {FORM}")))?;
        // A span may stand at the end: FIGURE <= VALUE UNIT from ANGLE to ANGLE.
        let (value, figure) = match value.split_once(" from ") {
            Some((value, span)) => (value.trim(), format!("{figure} from {}", span.trim())),
            None => (value, figure.to_owned()),
        };
        let unit = unit_of(&figure).map_err(wrong)?;
        let written = WrittenUnit::of(value, &unit);
        let value = quantity(value, &unit).map_err(wrong)?;
        Ok(Self {
            text: text.trim().to_owned(),
            figure,
            relation,
            value,
            unit,
            written,
            kept: false,
        })
    }

    /// SI unit of a figure of a model; empty of a plain number, a count or an answer.
    ///
    /// # Errors
    /// There is no such figure, in words.
    pub fn unit_of(figure: &str, model: &Model) -> Result<String, String> {
        check_figure(figure, model).map_err(|fault| match fault.hint.as_str() {
            "" => fault.message,
            hint => format!("{}; {hint}", fault.message),
        })?;
        Ok(figure_unit(figure, model))
    }

    /// How far a value of the figure is on the right side: negative where the condition does
    /// not hold. Of an [equality](Self::is_equality) how far it is above the value.
    pub fn margin(&self, found: f64) -> f64 {
        match self.relation {
            Relation::Equal if self.is_count() => -(found - self.value).abs(),
            Relation::AtMost => self.value - found,
            Relation::AtLeast | Relation::Equal => found - self.value,
        }
    }

    /// Whether the figure has to have a value that it passes from one place to the next: what
    /// counts or answers keeps it over a range.
    pub fn is_equality(&self) -> bool {
        self.relation == Relation::Equal && !self.is_count()
    }

    /// Whether the figure changes smoothly at all: it neither counts nor answers.
    pub fn has_slopes(&self) -> bool {
        !self.is_count()
    }

    fn is_count(&self) -> bool {
        if self.kept {
            return true;
        }
        counts(&self.figure)
    }

    /// Whether a value of the figure is right; false of one that is none. An equality is met at
    /// the value alone.
    pub fn holds(&self, found: f64) -> bool {
        match self.relation {
            Relation::AtMost => found <= self.value,
            Relation::AtLeast => found >= self.value,
            Relation::Equal => found == self.value,
        }
    }
}

/// Whether a figure counts or answers, so that it has no value between two others.
pub fn counts(figure: &str) -> bool {
    let name = figure.rsplit('.').next().unwrap_or_default();
    COUNTS.contains(&name)
}

impl WrittenUnit {
    /// The unit behind a value; the SI unit where there is none.
    fn of(text: &str, unit: &str) -> Self {
        let name = number_and_unit(text).map_or("", |(_, name)| name);
        let size = match name {
            "" => None,
            name => quantity(&format!("1 {name}"), unit).ok(),
        };
        match size {
            Some(size) => Self {
                name: name.to_owned(),
                size,
            },
            None => Self {
                name: unit.to_owned(),
                size: 1.0,
            },
        }
    }
}

/// The figure, the relation and the value of a condition, none of them read yet.
fn split_condition(text: &str) -> Result<(&str, Relation, &str), &'static str> {
    let at = text
        .find(['<', '>', '=', '≤', '≥'])
        .ok_or("no `<=`, `>=` or `=`")?;
    let (figure, rest) = text.split_at(at);
    let signs = [
        ("<=", Relation::AtMost),
        ("≤", Relation::AtMost),
        (">=", Relation::AtLeast),
        ("≥", Relation::AtLeast),
        ("==", Relation::Equal),
        ("=", Relation::Equal),
    ];
    let found = signs
        .iter()
        .find_map(|(sign, relation)| Some((*relation, rest.strip_prefix(sign)?)));
    let (relation, value) =
        found.ok_or("a strict comparison cannot be judged: `<=` and `>=` can")?;
    match (figure.trim(), value.trim()) {
        ("", _) => Err("the result is missing"),
        (_, "") => Err("the value is missing"),
        (figure, value) => Ok((figure, relation, value)),
    }
}

/// A value in a unit of what has this SI unit.
fn quantity(text: &str, unit: &str) -> Result<f64, String> {
    match text {
        "true" if unit.is_empty() => return Ok(1.0),
        "false" if unit.is_empty() => return Ok(0.0),
        _ => {}
    }
    let unread = |_| format!("`{text}` is no number with or without a known unit");
    let found = parse(text).map_err(unread)?;
    let quantity = quantity_of(unit);
    let measured = match unit {
        "" => "a plain number".to_owned(),
        unit => format!("measured in {unit}"),
    };
    let value = match quantity.accept(found) {
        Ok(value) => value,
        // A number alone is in the SI unit, as in scenes.
        Err(_) if found.bare => found.value,
        Err(_) => {
            return Err(format!(
                "`{text}` has another unit than the result, which is {measured}"
            ));
        }
    };
    match value.is_finite() {
        true => Ok(value),
        false => Err(format!("`{text}` is too large")),
    }
}
