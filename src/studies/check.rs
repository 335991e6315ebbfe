//! Checks of a result against a bound.

use crate::units::shown;
use serde::ser::{Serialize, SerializeStruct, Serializer};

/// A check of a result: how far it is off, and how far it may be.
#[derive(Clone, Debug, PartialEq)]
pub struct Check {
    /// What is checked.
    pub name: &'static str,
    /// How far it is off.
    pub value: f64,
    /// Greatest magnitude of the value that is allowed.
    pub bound: f64,
}

impl Check {
    /// True when the value is within the bound; a value that is not a number is not.
    pub fn passed(&self) -> bool {
        self.value.abs() <= self.bound
    }

    /// What is wrong, for a check that did not pass.
    pub fn failure(&self) -> Option<String> {
        (!self.passed()).then(|| {
            format!(
                "not to be trusted: {} is off by {}, more than {}",
                self.name,
                shown(self.value, 2),
                shown(self.bound, 2)
            )
        })
    }
}

/// The greatest of some errors; one that is not a number is greater than all.
pub fn worst(errors: impl Iterator<Item = f64>) -> f64 {
    errors.fold(0.0, |worst, error| {
        if error > worst || error.is_nan() {
            error
        } else {
            worst
        }
    })
}

impl Serialize for Check {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut fields = serializer.serialize_struct("Check", 4)?;
        fields.serialize_field("name", self.name)?;
        fields.serialize_field("value", &self.value)?;
        fields.serialize_field("bound", &self.bound)?;
        fields.serialize_field("passed", &self.passed())?;
        fields.end()
    }
}

#[cfg(test)]
mod tests {
    use super::{Check, worst};

    #[test]
    fn a_value_beyond_its_bound_or_none_at_all_fails() {
        let passed = |value| {
            let name = "energy balance";
            let check = Check {
                name,
                value,
                bound: 1e-6,
            };
            assert_eq!(check.passed(), check.failure().is_none());
            check.passed()
        };
        assert!(passed(0.0) && passed(1e-6) && passed(-1e-6));
        assert!(worst([1.0, f64::NAN, 2.0].into_iter()).is_nan());
        assert_eq!(worst([1.0, 3.0, 2.0].into_iter()), 3.0);
        assert!(!passed(2e-6) && !passed(-2e-6) && !passed(f64::NAN) && !passed(f64::INFINITY));
    }
}
