//! Numbers for reading: significant digits, SI prefixes, escaped text.

use super::display_units;
pub use super::display_units::Scale;
use crate::dynamics::record::{Figures, Units};
use crate::units::shown;

/// Significant digits of results on terminals and pages; files carry all of them.
pub(in crate::report) const DIGITS: usize = 7;

/// SI prefixes that engineers read at a glance, with their exponents.
const PREFIXES: [(i32, &str); 8] = [
    (-12, "p"),
    (-9, "n"),
    (-6, "µ"),
    (-3, "m"),
    (0, ""),
    (3, "k"),
    (6, "M"),
    (9, "G"),
];

/// Units that take every prefix, and those that take only the ones below themselves.
pub(in crate::report) const TAKE_ALL: [&str; 6] = ["N", "J", "W", "Pa", "Hz", "Nm"];
pub(in crate::report) const TAKE_SMALL: [&str; 3] = ["s", "m", "rad"];

/// Least power of ten that a scale is divided by.
const LEAST_POWER: i32 = -300;

/// Units of an object; SI turning units when the document names none.
pub(in crate::report) fn units(figures: &Figures, id: &str) -> Units {
    figures.units.get(id).copied().unwrap_or(Units {
        displacement: "rad",
        force: "N m",
    })
}

/// The scale in which numbers up to `magnitude` in `unit` (SI) read best:
/// 1 … 1000 of it. Beyond the prefixes powers of ten are used.
pub fn readable_scale(magnitude: f64, unit: &str) -> Scale {
    if let Some(chosen) = display_units::scale_of_thread(magnitude, unit) {
        return chosen;
    }
    let plain = Scale {
        factor: 1.0,
        unit: unit.to_owned(),
    };
    let bare = unit.is_empty() || unit == "%" || unit.starts_with('1');
    if !magnitude.is_finite() || magnitude == 0.0 || bare {
        return plain;
    }
    // A hair of slack keeps 999.9999… from being called 1000 of the lower prefix.
    let exponent = ((magnitude.abs().log10() + 1e-9) / 3.0).floor() as i32 * 3;
    // Smaller powers are no numbers of full precision, or none at all.
    if exponent < LEAST_POWER {
        return plain;
    }
    let prefixes = Prefixes::of(unit);
    let exponent = match prefixes {
        Prefixes::All => exponent,
        Prefixes::None if exponent == -3 => 0,
        _ if exponent == 3 => 0,
        _ => exponent,
    };
    Scale {
        factor: 10f64.powi(exponent),
        unit: prefixes
            .prefixed_unit(unit, exponent)
            .unwrap_or_else(|| format!("10{} {unit}", superscript(exponent))),
    }
}

/// The prefixes that a unit takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Prefixes {
    /// All of them.
    All,
    /// None above itself: a kilosecond or a kilometre says less than the plain
    /// number, and a plain `rad` keeps counting turns.
    Small,
    /// None above itself; those below stand before the gram, since a kilogram has
    /// a prefix already.
    OfGram,
    /// None: a prefix before a power would be raised with it (mm² are no thousandths of m²).
    None,
}

impl Prefixes {
    fn of(unit: &str) -> Self {
        let first = unit.split([' ', '/']).next().unwrap_or(unit);
        match first {
            // (Grams times square metres are no unit of the field.)
            "kg" if unit == first => Self::OfGram,
            first if TAKE_SMALL.contains(&first) => Self::Small,
            first if TAKE_ALL.contains(&first) => Self::All,
            _ => Self::None,
        }
    }

    /// The unit with the prefix of a power of ten; `None` where there is none.
    fn prefixed_unit(self, unit: &str, exponent: i32) -> Option<String> {
        if exponent == 0 {
            return Some(unit.to_owned());
        }
        let prefix = |exponent: i32| {
            let found = PREFIXES.iter().find(|(power, _)| *power == exponent);
            found.map(|(_, prefix)| *prefix)
        };
        match self {
            Self::All => prefix(exponent).map(|prefix| format!("{prefix}{unit}")),
            Self::Small if exponent < 0 => prefix(exponent).map(|prefix| format!("{prefix}{unit}")),
            Self::OfGram if exponent < 0 => {
                let prefix = prefix(exponent + 3)?;
                Some(format!("{prefix}{}", &unit[1..]))
            }
            _ => None,
        }
    }
}

/// A value with its unit, to `digits` significant digits: `7.50086 mrad`.
pub fn with_unit(value: f64, unit: &str, digits: usize) -> String {
    let scale = readable_scale(value, unit);
    let number = significant(value / scale.factor, display_units::shown_digits(digits));
    if scale.unit.is_empty() || scale.unit == "1" {
        number
    } else if scale.unit.starts_with("10") {
        format!("{number}·{}", scale.unit)
    } else {
        format!("{number} {}", scale.unit)
    }
}

/// A number to at most `digits` significant digits as [`shown`] has it, with a real minus sign
/// and powers of ten above the line: −1.2·10⁻⁷.
pub fn significant(value: f64, digits: usize) -> String {
    if value.is_infinite() {
        return if value > 0.0 { "∞" } else { "−∞" }.into();
    }
    let text = shown(value, digits.min(17));
    let text = match text.strip_prefix('-') {
        Some(size) => format!("−{size}"),
        None => text,
    };
    let Some((mantissa, exponent)) = text.split_once('e').filter(|_| value.is_finite()) else {
        return text;
    };
    let power = superscript(exponent.parse().unwrap_or(0));
    match mantissa {
        "1" => format!("10{power}"),
        "−1" => format!("−10{power}"),
        mantissa => format!("{mantissa}·10{power}"),
    }
}

/// A text whose numbers have their powers of ten above the line: 5.2e-7 as 5.2·10⁻⁷.
pub fn with_raised_powers(text: &str) -> String {
    let part_of_word = |c: char| c.is_alphanumeric() || matches!(c, '_' | '.' | '-' | '+');
    let mut out = String::with_capacity(text.len());
    for piece in text.split_inclusive(|c| !part_of_word(c)) {
        let end = piece
            .trim_end_matches(|c| !part_of_word(c) || c == '.')
            .len();
        let (word, rest) = piece.split_at(end);
        let number = word.parse::<f64>().ok().filter(|value| value.is_finite());
        match number.zip(word.split_once('e')) {
            Some((value, (digits, _))) => out.push_str(&significant(value, digits.len().max(1))),
            None => out.push_str(word),
        }
        out.push_str(rest);
    }
    out
}

/// A result in a unit of its own, to as many digits as are shown of it.
pub(in crate::report) fn result(value: f64, digits: usize) -> String {
    significant(value, display_units::shown_digits(digits))
}

/// An integer in superscript digits: −6 → ⁻⁶.
pub fn superscript(number: i32) -> String {
    translate(
        number,
        ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'],
        '⁻',
    )
}

/// An integer in subscript digits: 12 → ₁₂.
pub fn subscript(number: usize) -> String {
    translate(
        number,
        ['₀', '₁', '₂', '₃', '₄', '₅', '₆', '₇', '₈', '₉'],
        '₋',
    )
}

fn translate(number: impl ToString, digits: [char; 10], minus: char) -> String {
    let digit = |c: char| c.to_digit(10).map_or(minus, |value| digits[value as usize]);
    number.to_string().chars().map(digit).collect()
}

/// Text made safe for HTML and SVG, in elements and in quoted attributes.
pub fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            // Control characters are not allowed in XML at all.
            c if c.is_control() && !matches!(c, '\n' | '\t') => out.push('\u{fffd}'),
            c => out.push(c),
        }
    }
    out
}

/// What stands between backticks in a text that was made safe, as code.
pub(in crate::report) fn coded(text: &str) -> String {
    let parts: Vec<&str> = text.split('`').collect();
    // One alone is a character as any other.
    if parts.len().is_multiple_of(2) {
        return text.to_owned();
    }
    let part = |(at, part): (usize, &&str)| match at % 2 {
        0 => (*part).to_owned(),
        _ => format!("<code>{part}</code>"),
    };
    parts.iter().enumerate().map(part).collect()
}

/// The text shortened to `length` characters, an ellipsis in the middle so that
/// both ends of an id stay readable.
pub fn shortened(text: &str, length: usize) -> String {
    let characters: Vec<char> = text.chars().collect();
    if characters.len() <= length.max(3) {
        return text.to_owned();
    }
    let tail = (length.max(3) - 1) / 3;
    let head = length.max(3) - 1 - tail;
    let (start, end) = (&characters[..head], &characters[characters.len() - tail..]);
    start.iter().chain(['…'].iter()).chain(end).collect()
}

/// `1 position`, `3 positions`.
pub(crate) fn counted(count: usize, what: &str) -> String {
    match count {
        1 => format!("1 {what}"),
        _ => format!("{count} {what}s"),
    }
}

/// A text that begins with a capital.
pub(in crate::report) fn capitalised(text: &str) -> String {
    let mut rest = text.chars();
    let first = rest.next().into_iter().flat_map(char::to_uppercase);
    first.chain(rest).collect()
}

#[cfg(test)]
mod tests {
    use super::{
        escape, readable_scale, shortened, significant, subscript, with_raised_powers, with_unit,
    };

    #[test]
    fn values_read_with_si_prefixes() {
        assert_eq!(with_unit(0.007500861, "rad", 5), "7.5009 mrad");
        assert_eq!(with_unit(-6e-5, "rad", 6), "−60 µrad");
        assert_eq!(with_unit(12345.0, "N m", 4), "12.35 kN m");
        assert_eq!(with_unit(98.69, "rad/s", 6), "98.69 rad/s");
        assert_eq!(with_unit(4e6, "rad/s²", 3), "4·10⁶ rad/s²");
        assert_eq!(with_unit(4e3, "rad/s²", 3), "4000 rad/s²");
        assert_eq!(with_unit(0.05, "kg", 3), "50 g");
        assert_eq!(with_unit(0.05, "kg m²", 3), "0.05 kg m²");
        assert_eq!(with_unit(2e-6, "kg m²", 3), "2·10⁻⁶ kg m²");
        assert_eq!(with_unit(0.05, "kg", 3), "50 g");
        assert_eq!(with_unit(2500.0, "kg m²", 3), "2500 kg m²");
        assert_eq!(with_unit(2e-3, "m²", 3), "0.002 m²");
        assert_eq!(with_unit(2e-6, "m²", 3), "2·10⁻⁶ m²");
        assert_eq!(with_unit(0.5, "deg", 3), "0.5 deg");
        assert_eq!(with_unit(1e4, "m/s³", 3), "10000 m/s³");
        assert_eq!(with_unit(1234.5, "s", 6), "1234.5 s");
        assert_eq!(with_unit(-2.5e7, "rad", 6), "−25·10⁶ rad");
        assert_eq!(with_unit(3e-17, "m", 2), "30·10⁻¹⁸ m");
        assert_eq!(with_unit(0.0, "m", 3), "0 m");
        assert_eq!(readable_scale(1000.0, "N").unit, "kN");
        assert_eq!(readable_scale(999.0, "N").unit, "N");
    }

    #[test]
    fn no_unit_gets_a_prefix_that_it_does_not_take() {
        let units = [
            "kg", "kg m²", "kg m²/s", "rad", "rad/s", "rad/s²", "rad/s³", "m", "m/s²",
        ];
        let units = units
            .into_iter()
            .chain(["s", "m²", "m³", "1/m", "deg", "%", "N m/rad"]);
        for unit in units {
            for power in -15..=15 {
                let shown = readable_scale(10f64.powi(power), unit);
                let first = shown.unit.split([' ', '/']).next().unwrap();
                let wrong = [
                    "mkg", "kkg", "µkg", "krad", "Mrad", "km", "ks", "mdeg", "m%",
                ];
                assert!(!wrong.contains(&first), "{unit}: {shown:?}");
                // A prefix before a power would be raised with it.
                assert!(
                    !["m²", "m³"].contains(&unit) || shown.unit.ends_with(unit),
                    "{shown:?}"
                );
                assert!(
                    shown.unit.starts_with("10")
                        || (0.9..2000.0).contains(&(10f64.powi(power) / shown.factor))
                        || shown.factor == 1.0,
                    "{unit}: {shown:?}"
                );
            }
        }
    }

    #[test]
    fn numbers_keep_their_significant_digits() {
        assert_eq!(significant(1e7, 6), "10⁷");
        assert_eq!(significant(-1.5e-9, 6), "−1.5·10⁻⁹");
        assert_eq!(significant(123456.7, 6), "123457");
        assert_eq!(significant(0.1, 6), "0.1");
        assert_eq!(significant(9.9999999, 3), "10");
        assert_eq!(with_unit(5e-324, "s", 3), "4.94·10⁻³²⁴ s");
        assert_eq!(significant(f64::NAN, 3), "not a number");
        assert_eq!(significant(f64::NEG_INFINITY, 3), "−∞");
        assert_eq!(subscript(10), "₁₀");
    }

    #[test]
    fn numbers_of_a_sentence_are_raised_and_words_are_not() {
        for (plain, set) in [
            (
                "an error of 1e-9: exact, 5.2e-7 %.",
                "an error of 10⁻⁹: exact, 5.2·10⁻⁷ %.",
            ),
            ("-3e-17 m (2.5e6)", "−3·10⁻¹⁷ m (2.5·10⁶)"),
            (
                "rk4 at 0.001, wheel_1e5.max, e, 12.5",
                "rk4 at 0.001, wheel_1e5.max, e, 12.5",
            ),
            ("ends at 1e-9.", "ends at 10⁻⁹."),
            ("", ""),
        ] {
            assert_eq!(with_raised_powers(plain), set);
        }
    }

    #[test]
    fn text_from_scenes_cannot_break_out() {
        assert_eq!(
            escape("<b a=\"'&'\">\u{1}"),
            "&lt;b a=&quot;&#39;&amp;&#39;&quot;&gt;\u{fffd}"
        );
        assert_eq!(shortened("abcdefghijkl", 7), "abcd…kl");
        assert_eq!(shortened("short", 7), "short");
    }
}
