//! Fractions of whole numbers: ratios of gears and cycles.

/// Greatest denominator that a ratio is looked for with.
const GREATEST: u64 = 1000;

/// How near a number must be to a fraction, relative.
const NEAR_FRACTION: f64 = 1e-12;

/// A positive fraction in lowest terms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Fraction {
    /// Numerator.
    pub(crate) numerator: u64,
    /// Denominator.
    pub(crate) denominator: u64,
}

fn greatest_common_divisor(mut a: u64, mut b: u64) -> u64 {
    while b != 0 {
        (a, b) = (b, a % b);
    }
    a
}

impl Fraction {
    /// The fraction with the least denominator, [`GREATEST`] at most, that a positive
    /// number is but for rounding; `None`: there is none.
    pub(crate) fn of(number: f64) -> Option<Self> {
        if !(number > 0.0 && number < 1e9) {
            return None;
        }
        // Convergents of the continued fraction.
        let (mut before, mut last) = ((0u64, 1u64), (1u64, 0u64));
        let mut rest = number;
        loop {
            let whole = rest.floor();
            let next = (
                (whole as u64).checked_mul(last.0)?.checked_add(before.0)?,
                (whole as u64).checked_mul(last.1)?.checked_add(before.1)?,
            );
            if next.1 > GREATEST {
                return None;
            }
            if (number - next.0 as f64 / next.1 as f64).abs() <= NEAR_FRACTION * number {
                return Some(Self {
                    numerator: next.0,
                    denominator: next.1,
                });
            }
            (before, last) = (last, next);
            rest = 1.0 / (rest - whole);
            if !(rest < 1e15) {
                return None;
            }
        }
    }

    /// The least number that is a whole multiple of both; `None` where it has too many
    /// digits.
    pub(crate) fn common_multiple(self, other: Self) -> Option<Self> {
        let shared = greatest_common_divisor(self.numerator, other.numerator);
        let numerator = (self.numerator / shared).checked_mul(other.numerator)?;
        let denominator = greatest_common_divisor(self.denominator, other.denominator);
        Some(Self {
            numerator,
            denominator,
        })
    }

    /// The number.
    pub(crate) fn value(self) -> f64 {
        self.numerator as f64 / self.denominator as f64
    }
}

#[cfg(test)]
mod tests {
    use super::Fraction;

    #[test]
    fn numbers_are_known_as_fractions_and_others_are_not() {
        for (numerator, denominator) in [(1, 1), (2, 1), (1, 2), (41, 20), (20, 41), (355, 113)] {
            let found = Fraction::of(numerator as f64 / denominator as f64).unwrap();
            assert_eq!(
                (found.numerator, found.denominator),
                (numerator, denominator)
            );
            assert_eq!(found.value(), numerator as f64 / denominator as f64);
        }
        for number in [
            std::f64::consts::SQRT_2,
            0.0,
            -1.0,
            f64::NAN,
            f64::INFINITY,
            1.0 / 1013.0,
        ] {
            assert_eq!(Fraction::of(number), None, "{number}");
        }
    }

    #[test]
    fn common_multiples_hold_both_whole_times() {
        for (a, b, both) in [
            (1.0, 2.0, 2.0),
            (1.0, 1.5, 3.0),
            (2.0 / 3.0, 0.5, 2.0),
            (1.0 / 3.0, 1.0, 1.0),
            (41.0 / 20.0, 1.0, 41.0),
        ] {
            let [a, b] = [a, b].map(|number| Fraction::of(number).unwrap());
            assert_eq!(a.common_multiple(b).unwrap().value(), both);
        }
    }
}
