//! The units that are known, and the prefixes each takes.

use super::dimension::Dimension;

/// Factor to SI, kept as (numerator/denominator)·π^pi·10^ten so that `600 rpm`
/// and `10 rev/s` come out as the same number, and `0.05 mm` as the number
/// nearest to 5e-5.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Scale {
    pub(crate) numerator: f64,
    pub(crate) denominator: f64,
    pub(crate) pi: i32,
    pub(crate) ten: i32,
}

impl Scale {
    pub(crate) const ONE: Self = Self::ratio(1.0, 1.0, 0);

    const fn ratio(numerator: f64, denominator: f64, pi: i32) -> Self {
        Self {
            numerator,
            denominator,
            pi,
            ten: 0,
        }
    }

    /// This factor times `other` to a power.
    pub(crate) fn times_power(self, other: Self, exponent: i32) -> Self {
        let (up, down) = if exponent >= 0 {
            (other.numerator, other.denominator)
        } else {
            (other.denominator, other.numerator)
        };
        let size = exponent.abs();
        Self {
            numerator: self.numerator * up.powi(size),
            denominator: self.denominator * down.powi(size),
            pi: self.pi + other.pi * exponent,
            ten: self.ten + other.ten * exponent,
        }
    }

    /// A decimal number (as text) times this factor, rounded as little as can be.
    pub(crate) fn apply(self, number: &str) -> f64 {
        let (mantissa, exponent) = match number.split_once(['e', 'E']) {
            Some((mantissa, exponent)) => (mantissa, exponent.parse::<i32>()),
            None => (number, Ok(0)),
        };
        // An exponent too long for an i32 is 0 or infinity anyway.
        let value = match exponent {
            Ok(exponent) => {
                let ten = exponent.saturating_add(self.ten);
                product(mantissa, self.numerator, ten)
                    .unwrap_or_else(|| parsed(&format!("{mantissa}e{ten}")) * self.numerator)
            }
            Err(_) => parsed(number) * self.numerator,
        };
        let value = value / self.denominator;
        if self.pi == 0 {
            value
        } else {
            value * std::f64::consts::PI.powi(self.pi)
        }
    }
}

fn parsed(number: &str) -> f64 {
    number.parse().unwrap_or(f64::NAN)
}

/// mantissa·numerator·10^ten, rounded once; `None` where digits or numerator are too long.
fn product(mantissa: &str, numerator: f64, ten: i32) -> Option<f64> {
    /// All whole numbers up to here are numbers of their own.
    const LARGEST: f64 = 9_007_199_254_740_992.0;
    if numerator.fract() != 0.0 || numerator > LARGEST {
        return None;
    }
    let (sign, digits) = match mantissa.strip_prefix('-') {
        Some(digits) => ("-", digits),
        None => ("", mantissa),
    };
    let (whole, decimals) = digits.split_once('.').unwrap_or((digits, ""));
    let digits: u128 = format!("{whole}{decimals}").parse().ok()?;
    let product = digits.checked_mul(numerator as u128)?;
    let ten = ten.checked_sub(i32::try_from(decimals.len()).ok()?)?;
    Some(parsed(&format!("{sign}{product}e{ten}")))
}

/// A unit: symbol, dimension, factor to SI, prefixes it takes.
pub(crate) struct Unit {
    pub(crate) symbol: &'static str,
    pub(crate) dimension: Dimension,
    pub(crate) scale: Scale,
    prefixes: &'static str,
}

const fn unit(
    symbol: &'static str,
    dimension: Dimension,
    scale: Scale,
    prefixes: &'static str,
) -> Unit {
    Unit {
        symbol,
        dimension,
        scale,
        prefixes,
    }
}

const ONE: Scale = Scale::ONE;
const SPEED_OF_TURNING: Dimension = Dimension::new(0, 0, -1, 1);
const MOMENT: Dimension = Dimension::new(1, 2, -2, 0);
const PRESSURE: Dimension = Dimension::new(1, -1, -2, 0);
const POWER: Dimension = Dimension::new(1, 2, -3, 0);
const GRAM: Scale = Scale {
    ten: -3,
    ..Scale::ONE
};
const HUNDRED_THOUSAND: Scale = Scale {
    ten: 5,
    ..Scale::ONE
};
const PERCENT: Scale = Scale {
    ten: -2,
    ..Scale::ONE
};
/// 0.0254 m.
const INCH: Scale = decimal(254.0, -4);
/// 0.45359237 kg.
const POUND: Scale = decimal(45_359_237.0, -8);
/// 0.45359237 kg at 9.80665 m/s².
const POUND_FORCE: Scale = decimal(44_482_216_152_605.0, -13);
/// A pound-force on a square inch.
const PSI: Scale = Scale {
    denominator: 64_516.0,
    ..decimal(44_482_216_152_605.0, -5)
};
/// The mass that a pound-force accelerates by a foot per second squared.
const SLUG: Scale = Scale {
    denominator: 3048.0,
    ..decimal(44_482_216_152_605.0, -9)
};
/// 550 foot pounds-force per second; the exact decimal number has 17 digits.
const HORSEPOWER: Scale = Scale::ratio(745.699_871_582_270_2, 1.0, 0);

const fn decimal(numerator: f64, ten: i32) -> Scale {
    Scale {
        ten,
        ..Scale::ratio(numerator, 1.0, 0)
    }
}

/// All units without their prefixed forms. Where a prefixed form of one unit
/// reads like another unit (`min`), the table's own symbol wins.
pub(crate) const UNITS: &[Unit] = &[
    unit("m", Dimension::LENGTH, ONE, "nµumcdk"),
    unit("g", Dimension::MASS, GRAM, "mk"),
    unit(
        "t",
        Dimension::MASS,
        Scale {
            ten: 3,
            ..Scale::ONE
        },
        "",
    ),
    unit("s", Dimension::TIME, ONE, "nµum"),
    unit("min", Dimension::TIME, Scale::ratio(60.0, 1.0, 0), ""),
    unit("h", Dimension::TIME, Scale::ratio(3600.0, 1.0, 0), ""),
    unit("rad", Dimension::ANGLE, ONE, "µum"),
    unit("deg", Dimension::ANGLE, Scale::ratio(1.0, 180.0, 1), ""),
    unit("°", Dimension::ANGLE, Scale::ratio(1.0, 180.0, 1), ""),
    unit(
        "arcmin",
        Dimension::ANGLE,
        Scale::ratio(1.0, 10800.0, 1),
        "",
    ),
    unit(
        "arcsec",
        Dimension::ANGLE,
        Scale::ratio(1.0, 648000.0, 1),
        "",
    ),
    unit("rev", Dimension::ANGLE, Scale::ratio(2.0, 1.0, 1), ""),
    unit("turn", Dimension::ANGLE, Scale::ratio(2.0, 1.0, 1), ""),
    unit("rpm", SPEED_OF_TURNING, Scale::ratio(2.0, 60.0, 1), ""),
    unit("Hz", Dimension::new(0, 0, -1, 0), ONE, "mkM"),
    unit("N", Dimension::FORCE, ONE, "mkMG"),
    unit("Nm", MOMENT, ONE, "mkMG"),
    unit("J", MOMENT, ONE, "mkM"),
    unit("W", POWER, ONE, "mkM"),
    unit("Pa", PRESSURE, ONE, "kMG"),
    unit("bar", PRESSURE, HUNDRED_THOUSAND, "m"),
    unit("%", Dimension::NONE, PERCENT, ""),
    unit("in", Dimension::LENGTH, INCH, ""),
    unit("ft", Dimension::LENGTH, decimal(3048.0, -4), ""),
    unit("lb", Dimension::MASS, POUND, ""),
    unit("lbm", Dimension::MASS, POUND, ""),
    unit("slug", Dimension::MASS, SLUG, ""),
    unit("lbf", Dimension::FORCE, POUND_FORCE, ""),
    unit("kgf", Dimension::FORCE, decimal(980_665.0, -5), ""),
    unit("hp", POWER, HORSEPOWER, ""),
    unit("psi", PRESSURE, PSI, ""),
    unit(
        "ksi",
        PRESSURE,
        Scale {
            ten: PSI.ten + 3,
            ..PSI
        },
        "",
    ),
    unit("r", Dimension::ANGLE, Scale::ratio(2.0, 1.0, 1), ""),
    unit("U", Dimension::ANGLE, Scale::ratio(2.0, 1.0, 1), ""),
];

/// Finds a unit, with its prefix if it has one.
pub(crate) fn find(symbol: &str) -> Option<(Dimension, Scale)> {
    if let Some(unit) = UNITS.iter().find(|unit| unit.symbol == symbol) {
        return Some((unit.dimension, unit.scale));
    }
    let prefix = symbol.chars().next()?;
    let rest = &symbol[prefix.len_utf8()..];
    let unit = UNITS
        .iter()
        .find(|unit| unit.symbol == rest && unit.prefixes.contains(prefix))?;
    let mut scale = unit.scale;
    scale.ten += ten_of(prefix)?;
    Some((unit.dimension, scale))
}

fn ten_of(prefix: char) -> Option<i32> {
    Some(match prefix {
        'n' => -9,
        'µ' | 'u' => -6,
        'm' => -3,
        'c' => -2,
        'd' => -1,
        'k' => 3,
        'M' => 6,
        'G' => 9,
        _ => return None,
    })
}

/// Every unit symbol that is known, prefixed forms included, in a fixed order.
pub fn known_units() -> Vec<String> {
    let mut all = Vec::new();
    for unit in UNITS {
        all.push(unit.symbol.to_owned());
        all.extend(
            unit.prefixes
                .chars()
                .map(|prefix| format!("{prefix}{}", unit.symbol)),
        );
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_symbol_is_found_and_none_hides_another() {
        let mut seen = std::collections::BTreeMap::new();
        for symbol in known_units() {
            assert!(find(&symbol).is_some(), "{symbol}");
            *seen.entry(symbol).or_insert(0) += 1;
        }
        // `min` is the minute and never the milli-inch: no duplicates at all.
        assert!(seen.values().all(|&count| count == 1), "{seen:?}");
        assert_eq!(find("kg").unwrap().1.ten, 0);
        assert!(find("km").is_some() && find("Mm").is_none() && find("").is_none());
    }

    #[test]
    fn factors_lose_no_digits() {
        let (_, millimetre) = find("mm").unwrap();
        assert_eq!(millimetre.apply("0.05"), 5e-5);
        assert_eq!(millimetre.apply("0.1e1"), 1e-3);
        let (_, rpm) = find("rpm").unwrap();
        let (_, turn) = find("rev").unwrap();
        assert_eq!(rpm.apply("600"), turn.apply("10"));
        let (_, degree) = find("deg").unwrap();
        assert_eq!(degree.apply("90"), std::f64::consts::FRAC_PI_2);
        assert_eq!(degree.apply("360"), std::f64::consts::TAU);
        assert_eq!(millimetre.apply("1e99999999999"), f64::INFINITY);
        let (_, inch) = find("in").unwrap();
        assert_eq!(inch.apply("-0.3"), -0.007_62);
        assert_eq!(inch.apply("1.e3"), 25.4);
        assert_eq!(inch.apply("1e400"), f64::INFINITY);
        let long = format!("0.{}", "3".repeat(60));
        assert!((inch.apply(&long) / (0.0254 / 3.0) - 1.0).abs() < 1e-15);
    }
}
