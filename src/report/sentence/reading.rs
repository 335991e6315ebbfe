//! Quantities in sentences that are only there as text: warnings, causes. Of their values is known
//! what they print.

use super::Sentence;

/// Units as sentences have them, the SI unit, and how many of it they are; the longest first where
/// one begins like another.
const UNITS: [(&str, &str, f64); 40] = [
    ("rad/s²", "rad/s²", 1.0),
    ("rad/s", "rad/s", 1.0),
    ("deg/s", "rad/s", std::f64::consts::PI / 180.0),
    ("mrad", "rad", 1e-3),
    ("µrad", "rad", 1e-6),
    ("nrad", "rad", 1e-9),
    ("rad", "rad", 1.0),
    ("deg", "rad", std::f64::consts::PI / 180.0),
    ("rpm", "rad/s", std::f64::consts::PI / 30.0),
    ("mm/s²", "m/s²", 1e-3),
    ("mm/s", "m/s", 1e-3),
    ("mm", "m", 1e-3),
    ("m/s²", "m/s²", 1.0),
    ("m/s", "m/s", 1.0),
    ("kN m", "N m", 1e3),
    ("mN m", "N m", 1e-3),
    ("N m", "N m", 1.0),
    ("Nm", "N m", 1.0),
    ("MN", "N", 1e6),
    ("kN", "N", 1e3),
    ("mN", "N", 1e-3),
    ("N", "N", 1.0),
    ("GPa", "Pa", 1e9),
    ("MPa", "Pa", 1e6),
    ("kPa", "Pa", 1e3),
    ("Pa", "Pa", 1.0),
    ("ms", "s", 1e-3),
    ("µs", "s", 1e-6),
    ("ns", "s", 1e-9),
    ("s", "s", 1.0),
    ("µm", "m", 1e-6),
    ("nm", "m", 1e-9),
    ("m", "m", 1.0),
    ("MJ", "J", 1e6),
    ("kJ", "J", 1e3),
    ("mJ", "J", 1e-3),
    ("µJ", "J", 1e-6),
    ("J", "J", 1.0),
    ("kW", "W", 1e3),
    ("W", "W", 1.0),
];

/// A quantity at the beginning of a text.
struct LeadingQuantity<'t> {
    words: &'t str,
    value: f64,
    unit: &'static str,
    digits: usize,
}

impl Sentence {
    /// A sentence that the program wrote: its numbers with units of the SI are quantities.
    pub fn read(text: &str) -> Self {
        let (mut sentence, mut said) = (Self::default(), 0);
        let mut at = 0;
        let mut before = ' ';
        while let Some(c) = text[at..].chars().next() {
            // Within a word there is no number.
            let begins = !before.is_alphanumeric() && !"_.-−·^".contains(before);
            match begins.then(|| quantity(&text[at..])).flatten() {
                Some(found) => {
                    let unit = (found.unit, found.digits);
                    sentence = sentence.words(&text[said..at]);
                    sentence = sentence.worded(found.value, unit, found.words.to_owned());
                    at += found.words.len();
                    said = at;
                    before = 'x';
                }
                None => {
                    at += c.len_utf8();
                    before = c;
                }
            }
        }
        sentence.words(&text[said..])
    }
}

fn quantity(text: &str) -> Option<LeadingQuantity<'_>> {
    let (number, length) = number(text)?;
    let rest = text[length..].strip_prefix(' ')?;
    let ends = |rest: &str| {
        let next = rest.chars().next().unwrap_or(' ');
        let more = rest.chars().nth(1).unwrap_or(' ');
        let goes_on = "/^_·²³⁻".contains(next) || (next == '.' && more.is_alphanumeric());
        !next.is_alphanumeric() && !goes_on
    };
    let fits = |(name, _, _): &&(&str, &str, f64)| rest.strip_prefix(*name).is_some_and(ends);
    let (name, unit, factor) = UNITS.iter().find(fits)?;
    let digits = text[..length].split(['e', '·']).next().unwrap_or("");
    let digits = digits.chars().skip_while(|c| !('1'..='9').contains(c));
    Some(LeadingQuantity {
        words: &text[..length + 1 + name.len()],
        value: number * factor,
        unit,
        // A round number is often exact.
        digits: digits.filter(char::is_ascii_digit).count().max(4),
    })
}

/// A number at the beginning, `−1.2·10⁻⁷` or `-1.2e-7`, and its length.
fn number(text: &str) -> Option<(f64, usize)> {
    let sign = text.chars().next().filter(|c| ['-', '−'].contains(c));
    let from = sign.map_or(0, char::len_utf8);
    let digits = |at: usize| {
        let all = text[at..].bytes();
        all.take_while(u8::is_ascii_digit).count()
    };
    let mut end = from + digits(from);
    if end == from {
        return None;
    }
    if text[end..].starts_with('.') && digits(end + 1) > 0 {
        end += 1 + digits(end + 1);
    }
    let mantissa = &text[from..end];
    let power = |rest: &str| -> Option<(i32, usize)> {
        if let Some(rest) = rest.strip_prefix('e') {
            let length = rest.find(|c: char| !c.is_ascii_digit() && c != '-');
            let length = length.unwrap_or(rest.len());
            return Some((rest[..length].parse().ok()?, 1 + length));
        }
        let above = rest.strip_prefix("·10")?;
        let typed = |c: char| match c {
            '⁻' => Some('-'),
            c => "⁰¹²³⁴⁵⁶⁷⁸⁹"
                .chars()
                .zip('0'..)
                .find_map(|(own, digit)| (own == c).then_some(digit)),
        };
        let all: String = above.chars().map_while(typed).collect();
        let length: usize = above
            .chars()
            .take(all.chars().count())
            .map(char::len_utf8)
            .sum();
        Some((all.parse().ok()?, "·10".len() + length))
    };
    let (exponent, length) = power(&text[end..]).unwrap_or((0, 0));
    let value: f64 = format!("{mantissa}e{exponent}").parse().ok()?;
    let value = if sign.is_some() { -value } else { value };
    Some((value, end + length))
}

#[cfg(test)]
mod tests {
    use super::super::{Part, Sentence};

    fn found(text: &str) -> Vec<(f64, String)> {
        let sentence = Sentence::read(text);
        assert_eq!(sentence.to_string(), text);
        let parts = sentence.parts().iter();
        let quantity = |part: &Part| match part {
            Part::Quantity(one) => Some((one.value, one.unit.clone())),
            Part::Words(_) => None,
        };
        parts.filter_map(quantity).collect()
    }

    #[test]
    fn quantities_of_a_text_are_found_with_their_units() {
        let of = |value: f64, unit: &str| (value, unit.to_owned());
        assert_eq!(
            found("the drive turns at −12.5 rad/s, 3 mm off (at 1.2·10⁻⁷ m), up to 4e-3 N."),
            [
                of(-12.5, "rad/s"),
                of(0.003, "m"),
                of(1.2e-7, "m"),
                of(0.004, "N")
            ]
        );
        let [(angle, unit)] = &found("stops at 90 deg")[..] else {
            panic!("one");
        };
        assert!((angle - std::f64::consts::FRAC_PI_2).abs() < 1e-15 && unit == "rad");
        assert_eq!(found("5 kN m"), [of(5000.0, "N m")]);
    }

    #[test]
    fn what_is_no_quantity_stays_words() {
        for text in [
            "3 masses of link_2 m",
            "block5 mm",
            "1.5 m/x",
            "2 m³",
            "10 ⁻³ N",
            "mass 3",
            "the unit N",
            "rocker.3 m",
            "12 of 40 cells",
            "−",
            "",
        ] {
            assert_eq!(found(text), [], "{text}");
        }
    }
}
