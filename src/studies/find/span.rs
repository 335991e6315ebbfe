//! The range of the parameter.

use crate::studies::axis::Axis;
use serde::Serialize;

/// Places that are looked at first, if nothing else is said.
pub const PLACES: usize = 33;
/// Most values of a parameter that counts: all of them are looked at.
pub const MOST_WHOLE: usize = 1000;

/// The range of a parameter.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Span {
    /// Address, unit, ends, number of places, spacing.
    #[serde(flatten)]
    pub axis: Axis,
    /// True: it counts, and takes whole numbers only.
    pub whole: bool,
}

impl Span {
    /// Reads `PATH=FROM:TO[:PLACES][:log]`.
    ///
    /// # Errors
    /// What is wrong and what would be right, in one sentence.
    pub fn parse(text: &str) -> Result<Self, String> {
        let colons = text.matches(':').count();
        let counted = match (colons, text.strip_suffix(":log")) {
            (1, _) => format!("{text}:{PLACES}"),
            (2, Some(ends)) => format!("{ends}:{PLACES}:log"),
            _ => text.to_owned(),
        };
        let form = "write PATH=FROM:TO, PATH=FROM:TO:PLACES or either with `:log`, for example \
                    shaft.motion.speed=100:900 rpm";
        let axis = Axis::parse(&counted).map_err(|what| {
            let what = what.replacen(&counted, text, 1);
            let what = what
                .split("; write PATH")
                .next()
                .unwrap_or(&what)
                .to_owned();
            format!("{what}; {form}")
        })?;
        Ok(Self::of(axis))
    }

    /// The range of an axis, whose values are the places that are looked at first.
    pub fn of(axis: Axis) -> Self {
        Self { axis, whole: false }
    }

    /// The range of a parameter that counts: every whole number of it is looked at.
    ///
    /// # Errors
    /// There are too many, or fewer than two.
    pub fn counting(mut self) -> Result<Self, String> {
        let Axis { from, to, .. } = self.axis;
        let ends = [from.min(to).ceil(), from.max(to).floor()];
        let [from, to] = if from <= to { ends } else { [ends[1], ends[0]] };
        let count = (ends[1] - ends[0] + 1.0).max(0.0);
        if !(2.0..=MOST_WHOLE as f64).contains(&count) {
            return Err(format!(
                "`{}` takes whole numbers, of which 2 to {MOST_WHOLE} can be examined: there are \
                 {count} in the range",
                self.axis.path
            ));
        }
        self.axis = Axis {
            from,
            to,
            count: count as usize,
            log: false,
            ..self.axis
        };
        self.whole = true;
        Ok(self)
    }

    /// The places that are looked at first, as shares of the range.
    pub(super) fn shares(&self) -> Vec<f64> {
        let last = self.axis.count - 1;
        (0..=last).map(|index| index as f64 / last as f64).collect()
    }

    /// The value at a share of the range, in the unit of the axis.
    pub fn value(&self, share: f64) -> f64 {
        let Axis { from, to, .. } = self.axis;
        let value = match (share, self.axis.log) {
            (0.0, _) => from,
            (1.0, _) => to,
            (share, true) => from * ((to / from).ln() * share).exp(),
            (share, false) => from + (to - from) * share,
        };
        if self.whole { value.round() } else { value }
    }

    /// The distance of two neighbouring places at a share of the range, in the unit of the axis.
    pub fn spacing(&self, share: f64) -> f64 {
        let half = 0.5 / (self.axis.count - 1) as f64;
        let [before, after] = [share - half, share + half].map(|at| self.value(at.clamp(0.0, 1.0)));
        (after - before).abs()
    }
}

#[cfg(test)]
mod tests {
    use super::{PLACES, Span};

    #[test]
    fn the_number_of_places_may_be_left_out() {
        let plain = Span::parse("shaft.motion.speed=100:900 rpm").unwrap();
        assert_eq!((plain.axis.count, plain.axis.log), (PLACES, false));
        assert_eq!(
            (plain.value(0.0), plain.value(0.5), plain.value(1.0)),
            (100.0, 500.0, 900.0)
        );
        let log = Span::parse("a.b=1:100:log").unwrap();
        assert_eq!((log.axis.count, log.axis.log), (PLACES, true));
        assert!((log.value(0.5) - 10.0).abs() < 1e-12);
        assert_eq!(Span::parse("a.b=1:100:5:log").unwrap().axis.count, 5);
        for wrong in [
            "a.b",
            "a.b=1",
            "a.b=1:x",
            "=1:2",
            "a.b=1:1",
            "a.b=1:2:3:4:5",
        ] {
            let message = Span::parse(wrong).unwrap_err();
            assert!(
                message.contains("PATH=FROM:TO") && message.contains(wrong),
                "{message}"
            );
        }
    }

    #[test]
    fn what_counts_takes_whole_numbers() {
        let span = Span::parse("rocker.masses=0.5:4.2")
            .unwrap()
            .counting()
            .unwrap();
        let values: Vec<f64> = span
            .shares()
            .iter()
            .map(|&share| span.value(share))
            .collect();
        assert_eq!(values, [1.0, 2.0, 3.0, 4.0]);
        assert!(Span::parse("a.b=0.1:0.9").unwrap().counting().is_err());
        assert!(Span::parse("a.b=1:5000").unwrap().counting().is_err());
    }
}
