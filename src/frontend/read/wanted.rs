//! What a number is to measure.

use crate::units::{Measure, Mismatch, Quantity, parse};

/// Quantities that a number may measure: one, or either of two while it is not known
/// whether the object turns or slides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct QuantityChoice {
    /// The quantity.
    pub first: Quantity,
    /// The other one.
    pub second: Option<Quantity>,
}

impl From<Quantity> for QuantityChoice {
    fn from(first: Quantity) -> Self {
        Self {
            first,
            second: None,
        }
    }
}

impl QuantityChoice {
    /// Either of two quantities.
    pub fn either(first: Quantity, second: Quantity) -> Self {
        Self {
            first,
            second: (first != second).then_some(second),
        }
    }

    /// Any unit at all: for a value of which it is not known what it measures,
    /// because that is faulty itself.
    pub fn anything() -> Self {
        use crate::units::quantities::ANYTHING;
        ANYTHING.into()
    }

    /// The one, or both.
    pub fn quantities(&self) -> impl Iterator<Item = Quantity> {
        [Some(self.first), self.second].into_iter().flatten()
    }

    /// The value in SI units.
    ///
    /// # Errors
    /// How it does not fit.
    pub(crate) fn convert_measure(&self, measure: Measure) -> Result<f64, Mismatch> {
        let first = self.first.accept(measure);
        match (first, self.second) {
            (Err(_), Some(second)) => second.accept(measure).or(first),
            _ => first,
        }
    }

    /// `angular speed in rad/s, rev/s, rpm or deg/s`.
    pub(crate) fn words(&self) -> String {
        let words = |quantity: Quantity| match quantity.units {
            ["1", ..] => "a pure number".to_owned(),
            units => {
                let (last, others) = units.split_last().unwrap_or((&"1", &[]));
                let list = match others.is_empty() {
                    true => (*last).to_owned(),
                    false => format!("{} or {last}", others.join(", ")),
                };
                format!("{} in {list}", quantity.name)
            }
        };
        let all: Vec<String> = self.quantities().map(words).collect();
        all.join("; or ")
    }

    /// Texts that editors offer: one of each unit.
    pub(super) fn examples(&self) -> Vec<String> {
        let units = self.quantities().flat_map(|quantity| quantity.units);
        let texts = units.map(|unit| format!("1 {unit}"));
        texts.filter(|text| parse(text).is_ok()).collect()
    }
}
