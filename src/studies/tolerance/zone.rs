//! Tolerance zones of dimensions, and how they are written.

use super::grade;
use crate::math::probability::normal_quantile;
use crate::units::{number_and_unit, with_common_unit};
use serde::Serialize;

/// What a tolerance looks like, for messages.
const FORM: &str = "write PATH=\"±0.02 mm\" (or +-), \"±0.02 mm uniform\", \"+0.01 -0.03 mm\", \
                    \"±1 %\", or the class of a length, \"h7\"";

/// Half of a tolerance zone in standard deviations, where the distribution is normal.
pub const SIGMAS: f64 = 3.0;

/// How often values occur within a tolerance zone.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Distribution {
    /// Normal: the limits are three standard deviations from the middle. Of 1000 values three
    /// lie outside.
    Normal,
    /// Every value between the limits is equally frequent.
    Uniform,
}

/// Tolerance zone: the limits of the deviation of a dimension from its nominal value.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Zone {
    /// Lower limit of the deviation.
    pub lower: f64,
    /// Upper limit.
    pub upper: f64,
    /// How often values occur in it.
    pub distribution: Distribution,
}

impl Zone {
    /// The deviation in the middle, which is the mean.
    pub fn middle(&self) -> f64 {
        0.5 * (self.lower + self.upper)
    }

    /// Half the width.
    pub fn half(&self) -> f64 {
        0.5 * (self.upper - self.lower)
    }

    /// Standard deviation.
    pub fn sigma(&self) -> f64 {
        match self.distribution {
            Distribution::Normal => self.half() / SIGMAS,
            Distribution::Uniform => self.half() / 3f64.sqrt(),
        }
    }

    /// The deviation that is not exceeded by a share in (0, 1) of all.
    pub fn quantile(&self, share: f64) -> f64 {
        match self.distribution {
            Distribution::Normal => self.middle() + self.sigma() * normal_quantile(share),
            Distribution::Uniform => self.lower + (self.upper - self.lower) * share,
        }
    }
}

/// A tolerance as it is written: of which numbers, and its limits in a unit.
#[derive(Clone, Debug, PartialEq)]
pub struct WrittenTolerance {
    /// Addresses of the numbers; several deviate by the same.
    pub paths: Vec<String>,
    /// The tolerance as written: `±0.02 mm`.
    pub text: String,
    /// Its limits.
    pub limits: WrittenLimits,
    /// How often values occur in it.
    pub distribution: Distribution,
}

/// Limits of a tolerance as they are written.
#[derive(Clone, Debug, PartialEq)]
pub enum WrittenLimits {
    /// Lower and upper deviation in a unit; empty: the SI unit.
    Deviations {
        /// Lower and upper one.
        limits: [f64; 2],
        /// Unit of both.
        unit: String,
    },
    /// Lower and upper deviation as shares of the nominal value.
    Shares([f64; 2]),
    /// A tolerance class of ISO 286: `h7`.
    Class(grade::Class),
}

impl WrittenTolerance {
    /// Reads `PATH=TOLERANCE` or `PATH,PATH=TOLERANCE`.
    ///
    /// # Errors
    /// What is wrong and what would be right, in one sentence.
    pub fn parse(text: &str) -> Result<Self, String> {
        let wrong = |what: &str| format!("`{text}`: {what}; {FORM}");
        let (paths, tolerance) = text.split_once('=').ok_or_else(|| wrong("no `=`"))?;
        let paths: Vec<String> = paths
            .split(',')
            .map(|path| path.trim().to_owned())
            .collect();
        if paths.iter().any(String::is_empty) {
            return Err(wrong("the address of a number is missing"));
        }
        let tolerance = tolerance.trim();
        let (limits, distribution) = match tolerance.rsplit_once(char::is_whitespace) {
            Some((limits, "uniform")) => (limits, Distribution::Uniform),
            Some((limits, "normal")) => (limits, Distribution::Normal),
            _ => (tolerance, Distribution::Normal),
        };
        let limits = WrittenLimits::parse(limits.trim()).map_err(|what| wrong(&what))?;
        Ok(Self {
            paths,
            text: tolerance.to_owned(),
            limits,
            distribution,
        })
    }

    /// The zone of a nominal value. `size`: of its unit in SI units.
    ///
    /// # Errors
    /// What is wrong, in words.
    pub fn zone(&self, nominal: f64, size: f64) -> Result<Zone, String> {
        let [lower, upper] = match &self.limits {
            WrittenLimits::Deviations { limits, .. } => limits.map(|limit| limit * size),
            WrittenLimits::Shares(_) if nominal == 0.0 => {
                return Err("a share of a value that is 0 is no tolerance".to_owned());
            }
            WrittenLimits::Shares(shares) => shares.map(|share| share * nominal.abs()),
            WrittenLimits::Class(class) => class.deviations(nominal)?,
        };
        let zone = Zone {
            lower,
            upper,
            distribution: self.distribution,
        };
        let ends = [nominal + lower, nominal + upper];
        match (ends[0] < ends[1], ends.iter().all(|end| end.is_finite())) {
            (_, false) => Err("the tolerance is too large".to_owned()),
            (true, true) => Ok(zone),
            (false, true) => Err(format!(
                "the tolerance is too small for a nominal value of {nominal}"
            )),
        }
    }

    /// The unit that is written; empty: none.
    pub fn unit(&self) -> &str {
        match &self.limits {
            WrittenLimits::Deviations { unit, .. } => unit,
            WrittenLimits::Shares(_) => "",
            WrittenLimits::Class(_) => "m",
        }
    }
}

impl WrittenLimits {
    fn parse(text: &str) -> Result<Self, String> {
        let text = text.replace('−', "-");
        let plus_minus = ["±", "+-", "+/-"];
        if let Some(half) = plus_minus.iter().find_map(|sign| text.strip_prefix(sign)) {
            let (half, unit) = number(half)?;
            if half <= 0.0 {
                return Err("a tolerance is greater than 0".to_owned());
            }
            return Self::of([-half, half], unit);
        }
        if text.starts_with(char::is_alphabetic) {
            return grade::Class::parse(&text).map(Self::Class);
        }
        let (first, second) = two_numbers(&text)?;
        let both = with_common_unit(&[first, second])?;
        let (one, unit) = number(&both[0])?;
        let (other, other_unit) = number(&both[1])?;
        if unit != other_unit {
            return Err("both limits must be given in the same unit".to_owned());
        }
        if one == other {
            return Err("both limits are the same".to_owned());
        }
        Self::of([one.min(other), one.max(other)], unit)
    }

    fn of(limits: [f64; 2], unit: &str) -> Result<Self, String> {
        if let Some(limit) = limits.iter().find(|limit| !limit.is_finite()) {
            return Err(format!("{limit} is no limit"));
        }
        Ok(match unit {
            "%" => Self::Shares(limits.map(|limit| limit / 100.0)),
            unit => Self::Deviations {
                limits,
                unit: unit.to_owned(),
            },
        })
    }
}

fn number(text: &str) -> Result<(f64, &str), String> {
    let no_number = || format!("`{}` is no number with or without a unit", text.trim());
    let (number, unit) = number_and_unit(text).ok_or_else(no_number)?;
    let number = number.parse().map_err(|_| no_number())?;
    Ok((number, unit))
}

/// `+0.01 -0.03 mm` in its two parts.
fn two_numbers(text: &str) -> Result<(&str, &str), String> {
    let (first, rest) = number_and_unit(text).ok_or("no number")?;
    let after = text.len() - text.trim_start().len() + first.len();
    let starts = |at: usize| {
        let before = text[..at].trim_end().chars().next_back();
        let begins = text[at..].starts_with(['+', '-']);
        begins && before != Some('^')
    };
    let second = (after..text.len()).find(|at| text.is_char_boundary(*at) && starts(*at));
    let Some(second) = second.filter(|_| !rest.is_empty()) else {
        return Err(format!(
            "`{text}` has one limit: a tolerance has two, each with its sign, or ±"
        ));
    };
    let first = text[..second].trim_end_matches([' ', '\t', '/', ',', ';']);
    Ok((first, &text[second..]))
}

#[cfg(test)]
mod tests {
    use super::{Distribution, WrittenTolerance, Zone};

    fn zone(text: &str, nominal: f64) -> Zone {
        let written = WrittenTolerance::parse(text).unwrap();
        let size = match written.unit() {
            "mm" => 1e-3,
            "" | "m" => 1.0,
            other => panic!("{other}"),
        };
        written.zone(nominal, size).unwrap()
    }

    #[test]
    fn tolerances_are_read_in_all_their_forms() {
        for (text, lower, upper) in [
            ("a.b=±0.02 mm", -2e-5, 2e-5),
            ("a.b=+-0.02 mm", -2e-5, 2e-5),
            ("a.b = +/- 0.02mm normal", -2e-5, 2e-5),
            ("a.b=±2e-5", -2e-5, 2e-5),
            ("a.b=+0.01 -0.03 mm", -3e-5, 1e-5),
            ("a.b=+0.01/-0.03 mm", -3e-5, 1e-5),
            ("a.b=+0.01 mm, -0.03 mm", -3e-5, 1e-5),
            ("a.b=−0.03 +0.01 mm", -3e-5, 1e-5),
            ("a.b=-0.01 -0.03 mm", -3e-5, -1e-5),
            ("a.b=0 -0.03 mm", -3e-5, 0.0),
            ("a.b=+1e-5 -3e-5", -3e-5, 1e-5),
            ("a.b=±1 %", -5e-4, 5e-4),
            ("a.b=+2 -1 %", -5e-4, 1e-3),
            ("a.b=h7", -25e-6, 0.0),
        ] {
            let found = zone(text, 0.05);
            assert!((found.lower - lower).abs() < 1e-18, "{text}: {found:?}");
            assert!((found.upper - upper).abs() < 1e-18, "{text}: {found:?}");
            assert_eq!(found.distribution, Distribution::Normal);
        }
        let uniform = zone("a.b=±0.03 mm uniform", 0.05);
        assert_eq!(uniform.distribution, Distribution::Uniform);
        assert!((uniform.sigma() - 3e-5 / 3f64.sqrt()).abs() < 1e-20);
        assert!((uniform.quantile(0.25) + 1.5e-5).abs() < 1e-20);
        let several = WrittenTolerance::parse("a.b, c.d=±0.02 mm").unwrap();
        assert_eq!(several.paths, ["a.b", "c.d"]);
        assert_eq!(several.text, "±0.02 mm");
    }

    #[test]
    fn limits_are_three_standard_deviations_from_the_middle() {
        let zone = zone("a.b=+0.01 -0.05 mm", 0.05);
        assert!((zone.middle() + 2e-5).abs() < 1e-19);
        assert!((zone.sigma() - 1e-5).abs() < 1e-19);
        assert!((zone.quantile(0.99865) - zone.upper).abs() < 1e-9);
    }

    #[test]
    fn what_is_wrong_is_said() {
        for (text, word) in [
            ("a.b", "no `=`"),
            ("=±1 mm", "address"),
            ("a.b,=±1 mm", "address"),
            ("a.b=±", "no number"),
            ("a.b=±0 mm", "greater than 0"),
            ("a.b=±-1 mm", "greater than 0"),
            ("a.b=0.02 mm", "one limit"),
            ("a.b=+0.02 mm", "one limit"),
            ("a.b=+0.02 +0.02 mm", "the same"),
            ("a.b=+0.02 mm -0.01 m", "same unit"),
            ("a.b=+0.02 mm -0.01", "has no unit"),
            ("a.b=±1e999 mm", "no limit"),
            ("a.b=k6", "h, js or H"),
            ("a.b=h19", "grade"),
            ("a.b=", "no number"),
        ] {
            let message = WrittenTolerance::parse(text).unwrap_err();
            assert!(message.contains(word), "{text}: {message}");
            assert!(message.contains("±0.02 mm"), "{message}");
        }
        let written = WrittenTolerance::parse("a.b=±1e-30").unwrap();
        assert!(written.zone(1.0, 1.0).unwrap_err().contains("too small"));
        let share = WrittenTolerance::parse("a.b=±1 %").unwrap();
        assert!(share.zone(0.0, 1.0).unwrap_err().contains("is 0"));
    }
}
