//! Figures within a part of the motion, by their addresses: `rocker.delta_max from 30 deg to 120
//! deg`, `ram.peak_speed from 0.1 s to 0.2 s`, `ram.delta_abs from 10 mm to 20 mm of ram`.

use crate::dynamics::model::{Coordinate, Span, SpanAxis};
use crate::units::{Quantity, parse, quantities as q};
use std::f64::consts::TAU;

/// What a span looks like, for messages.
const FORM: &str = "write FIGURE from ANGLE to ANGLE, or from TIME to TIME, for example \
                    \"rocker.delta_max from 30 deg to 120 deg\"";

/// The address of a figure within a span, not read yet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct SpanAddress<'a> {
    /// Address of the figure: `rocker.delta_max`.
    pub(crate) figure: &'a str,
    /// Where the span begins, as it is written.
    from: &'a str,
    /// Where it ends.
    to: &'a str,
    /// Object whose displacement is meant.
    of: Option<&'a str>,
}

impl<'a> SpanAddress<'a> {
    /// Splits an address; `None`: it has no span.
    pub(crate) fn of(address: &'a str) -> Option<Self> {
        let (figure, ends) = address.split_once(" from ")?;
        let (from, to) = ends.split_once(" to ").unwrap_or((ends, ""));
        let (to, of) = match to.split_once(" of ") {
            Some((to, of)) => (to, Some(of.trim())),
            None => (to, None),
        };
        Some(Self {
            figure: figure.trim(),
            from: from.trim(),
            to: to.trim(),
            of,
        })
    }

    /// The span, as far as it does not depend on the model.
    ///
    /// # Errors
    /// What is wrong, and what to write; in words.
    pub(crate) fn span(&self) -> Result<Span, (String, String)> {
        let form = || FORM.to_owned();
        if self.to.is_empty() {
            return Err((format!("`from {}` has no end", self.from), form()));
        }
        let mut ends = [0.0; 2];
        let mut kind = None;
        for (end, text) in ends.iter_mut().zip([self.from, self.to]) {
            let (value, own) = parse_place(text).ok_or_else(|| {
                (
                    format!("`{text}` is no angle, time or length with its unit"),
                    form(),
                )
            })?;
            *end = value;
            if kind.is_some_and(|kind| kind != own) {
                let message = format!("`{}` and `{}` have different units", self.from, self.to);
                return Err((message, form()));
            }
            kind = Some(own);
        }
        let [from, to] = ends;
        if to <= from {
            let message = format!(
                "the span ends at `{}`, not behind its start `{}`",
                self.to, self.from
            );
            let hint = "across the end of a turn go on beyond it: from 350 deg to 370 deg";
            return Err((message, hint.to_owned()));
        }
        let coordinate = match kind {
            Some(Kind::Time) if self.of.is_some() => {
                let message = "a span of times belongs to no object".to_owned();
                return Err((
                    message,
                    "leave `of` out, or give angles or lengths".to_owned(),
                ));
            }
            Some(Kind::Time) | None => {
                return Ok(Span {
                    axis: SpanAxis::Time,
                    from,
                    to,
                });
            }
            Some(Kind::Angle) => Coordinate::Turning,
            Some(Kind::Length) => Coordinate::Sliding,
        };
        if coordinate == Coordinate::Turning && to - from > TAU {
            let message = "the span is longer than a turn".to_owned();
            return Err((message, "without a span the whole motion counts".to_owned()));
        }
        Ok(Span {
            axis: SpanAxis::Displacement {
                of: self.of.map(str::to_owned),
                coordinate,
            },
            from,
            to,
        })
    }
}

#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Time,
    Angle,
    Length,
}

/// A place with its unit, in SI units.
fn parse_place(text: &str) -> Option<(f64, Kind)> {
    let measure = parse(text).ok().filter(|found| !found.bare)?;
    let kinds: [(Quantity, Kind); 3] = [
        (q::TIME, Kind::Time),
        (q::ANGLE, Kind::Angle),
        (q::LENGTH, Kind::Length),
    ];
    let found = kinds.into_iter().find_map(|(quantity, kind)| {
        let same = measure.dimension == quantity.dimension;
        same.then_some((measure.value, kind))
    })?;
    found.0.is_finite().then_some(found)
}

/// The text of a place for an address: as written, or in SI units.
pub(super) fn place_text(
    text: &str,
    value: f64,
    dimension: crate::units::Dimension,
) -> Option<String> {
    if parse_place(text).is_some() {
        return Some(text.trim().to_owned());
    }
    let units = [(q::TIME, "s"), (q::ANGLE, "rad"), (q::LENGTH, "m")];
    let unit = units
        .iter()
        .find(|(quantity, _)| quantity.dimension == dimension)?;
    Some(format!("{value:?} {}", unit.1))
}
