//! Reading of a number with a unit.

use super::dimension::Dimension;
use super::table::{Scale, find};

/// A number with its dimension, in SI units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measure {
    /// Value in SI units.
    pub value: f64,
    /// Dimension of the unit.
    pub dimension: Dimension,
    /// True when no unit was written at all.
    pub bare: bool,
    /// True when the whole unit is `1/min` (or `min^-1`): a frequency, or by custom
    /// revolutions per minute.
    pub per_minute: bool,
    /// True of a product or quotient of quantities, in which a radian more or less means
    /// nothing: n·r is a speed.
    pub composed: bool,
}

impl Measure {
    /// A number without a unit.
    pub(crate) const fn unitless(value: f64) -> Self {
        Self {
            value,
            dimension: Dimension::NONE,
            bare: true,
            per_minute: false,
            composed: false,
        }
    }
}

/// Why a text is no number with a unit.
#[derive(Clone, Debug, PartialEq)]
pub enum UnitError {
    /// It does not begin with a number.
    NoNumber,
    /// The number has a decimal comma.
    DecimalComma {
        /// The same with a point.
        corrected: String,
    },
    /// The number is too large for a double.
    NotFinite,
    /// A unit that is not known.
    UnknownUnit {
        /// As written.
        symbol: String,
        /// Byte offset within the text.
        offset: usize,
    },
    /// A product after a quotient: `N/m s` may mean two things.
    Ambiguous {
        /// Byte offset of the unit after the quotient.
        offset: usize,
    },
    /// Something that is neither unit nor operator.
    Unexpected {
        /// The character.
        found: char,
        /// Byte offset within the text.
        offset: usize,
    },
    /// An operator without a unit after it, or an exponent out of 1 … 9.
    Incomplete {
        /// Byte offset within the text.
        offset: usize,
    },
}

/// Reads `number [unit]`: a decimal number, then a product or quotient of
/// units: `mm`, `N m/rad`, `kg·m²`, `m/s^2`, `N*s/m`. A product binds by
/// space, `*` or `·`; after a quotient only further quotients may follow. A
/// quotient may begin with 1: `1/min`.
///
/// # Errors
/// What is wrong, with its place in the text.
pub fn parse(text: &str) -> Result<Measure, UnitError> {
    let start = text.len() - text.trim_start().len();
    let length = number_length(&text[start..]);
    if length == 0 {
        return Err(UnitError::NoNumber);
    }
    let (number, rest) = text[start..].split_at(length);
    if let Some(corrected) = decimal_comma(number, rest) {
        return Err(UnitError::DecimalComma { corrected });
    }
    let mut units = Units {
        text,
        at: start + length,
        dimension: Dimension::NONE,
        scale: Scale::ONE,
        divided: false,
    };
    let unit = rest.trim();
    let bare = unit.is_empty();
    if !bare {
        units.product()?;
    }
    let value = units.scale.apply(number.trim_start_matches('+'));
    if !value.is_finite() {
        return Err(UnitError::NotFinite);
    }
    Ok(Measure {
        value,
        dimension: units.dimension,
        bare,
        per_minute: is_per_minute(unit),
        composed: false,
    })
}

/// `1/min`, with or without space, or a power −1 of the minute.
fn is_per_minute(unit: &str) -> bool {
    match unit.strip_prefix('1') {
        Some(rest) => {
            let divisor = rest.trim_start().strip_prefix('/');
            divisor.is_some_and(|divisor| divisor.trim_start() == "min")
        }
        None => ["min^-1", "min-1", "min⁻¹", "min^⁻¹"].contains(&unit),
    }
}

/// Length of the decimal number at the start of a text; 0 when there is none.
pub(super) fn number_length(text: &str) -> usize {
    let bytes = text.as_bytes();
    let digits = |mut at: usize| {
        let from = at;
        while bytes.get(at).is_some_and(u8::is_ascii_digit) {
            at += 1;
        }
        (at, at > from)
    };
    let sign = usize::from(matches!(bytes.first(), Some(b'+' | b'-')));
    let (mut end, mut some) = digits(sign);
    if bytes.get(end) == Some(&b'.') {
        let (fraction_end, fraction) = digits(end + 1);
        some |= fraction;
        end = fraction_end;
    }
    if !some {
        return 0;
    }
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
        if let (exponent_end, true) = digits(end + 1 + sign) {
            end = exponent_end;
        }
    }
    end
}

fn decimal_comma(number: &str, rest: &str) -> Option<String> {
    let after = rest.strip_prefix(',')?;
    after
        .starts_with(|c: char| c.is_ascii_digit())
        .then(|| format!("{number}.{after}"))
}

/// Reader of the unit part.
struct Units<'a> {
    text: &'a str,
    at: usize,
    dimension: Dimension,
    scale: Scale,
    divided: bool,
}

impl Units<'_> {
    fn product(&mut self) -> Result<(), UnitError> {
        self.skip_space();
        match self.begins_with_one() {
            true => self.at += 1,
            false => self.factor(1)?,
        }
        loop {
            let spaced = self.skip_space();
            let Some(next) = self.peek() else {
                return Ok(());
            };
            let times = matches!(next, '*' | '·' | '⋅' | '×');
            if times || next == '/' {
                self.at += next.len_utf8();
                self.skip_space();
            } else if !spaced {
                return Err(self.unexpected(next));
            }
            if next == '/' {
                self.divided = true;
                self.factor(-1)?;
            } else if self.divided {
                return Err(UnitError::Ambiguous { offset: self.at });
            } else {
                self.factor(1)?;
            }
        }
    }

    /// True for the 1 of `1/min`: a 1 with a quotient after it.
    fn begins_with_one(&self) -> bool {
        let rest = self.text[self.at..].strip_prefix('1');
        rest.is_some_and(|rest| rest.trim_start().starts_with('/'))
    }

    /// One unit with its exponent.
    fn factor(&mut self, sign: i32) -> Result<(), UnitError> {
        let offset = self.at;
        let length = self.text[offset..]
            .find(|c: char| !(c.is_alphabetic() || c == '°' || c == '%'))
            .unwrap_or(self.text.len() - offset);
        let symbol = &self.text[offset..offset + length];
        if symbol.is_empty() {
            return Err(match self.peek() {
                Some(found) => self.unexpected(found),
                None => UnitError::Incomplete { offset },
            });
        }
        let Some((dimension, scale)) = find(&symbol.replace('μ', "µ")) else {
            let symbol = symbol.to_owned();
            return Err(UnitError::UnknownUnit { symbol, offset });
        };
        self.at += length;
        let exponent = sign * self.exponent()?;
        let raised = dimension.power(exponent);
        self.dimension =
            self.dimension * raised.ok_or(UnitError::Incomplete { offset: self.at })?;
        self.scale = self.scale.times_power(scale, exponent);
        Ok(())
    }

    /// `^2`, `^-1`, `2`, `-1`, `²`, `⁻¹` or nothing: 1.
    fn exponent(&mut self) -> Result<i32, UnitError> {
        let offset = self.at;
        let caret = self.eat('^');
        let negative = self.eat('-') || self.eat('⁻');
        let digit = self.peek().and_then(|c| match c {
            '1' | '¹' => Some(1),
            '2' | '²' => Some(2),
            '3' | '³' => Some(3),
            '4'..='9' => c.to_digit(10).map(|digit| digit as i32),
            '⁴' => Some(4),
            _ => None,
        });
        match digit {
            Some(digit) => {
                self.at += self.peek().map_or(0, char::len_utf8);
                if self.peek().is_some_and(|c| c.is_ascii_digit()) {
                    return Err(UnitError::Incomplete { offset });
                }
                Ok(if negative { -digit } else { digit })
            }
            None if caret || negative => Err(UnitError::Incomplete { offset }),
            None => Ok(1),
        }
    }

    fn eat(&mut self, wanted: char) -> bool {
        let found = self.peek() == Some(wanted);
        if found {
            self.at += wanted.len_utf8();
        }
        found
    }

    fn peek(&self) -> Option<char> {
        self.text[self.at..].chars().next()
    }

    fn skip_space(&mut self) -> bool {
        let before = self.at;
        self.at = self.text.len() - self.text[self.at..].trim_start().len();
        self.at > before
    }

    fn unexpected(&self, found: char) -> UnitError {
        UnitError::Unexpected {
            found,
            offset: self.at,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn value(text: &str) -> f64 {
        parse(text)
            .unwrap_or_else(|e| panic!("{text}: {e:?}"))
            .value
    }

    #[test]
    fn numbers_with_units_become_si() {
        for (text, expected) in [
            ("600 rpm", 20.0 * PI),
            ("10 rev/s", 20.0 * PI),
            ("0.05 mm", 5e-5),
            ("90 deg", PI / 2.0),
            ("90°", PI / 2.0),
            ("10 kN m", 1e4),
            ("10 kNm", 1e4),
            ("1e7 N m/rad", 1e7),
            ("3 kW/rpm", 3000.0 * 30.0 / PI),
            ("7.85 g/cm^3", 7850.0),
            ("7.85 g/cm3", 7850.0),
            ("206 GPa", 206e9),
            ("206e3 N/mm²", 206e9),
            ("12 kg·m²", 12.0),
            ("2 m s^-2", 2.0),
            ("2 m s⁻²", 2.0),
            ("-3.5e-1 ms", -3.5e-4),
            ("+5 %", 0.05),
            (".5 m", 0.5),
            ("5. m", 5.0),
            ("1 h", 3600.0),
            ("2 N/m/s", 2.0),
            ("300 1/min", 5.0),
            ("300 1 / min", 5.0),
            ("3 1/m/s", 3.0),
            ("60 r/min", 2.0 * PI),
            ("60 U/min", 2.0 * PI),
        ] {
            approx::assert_relative_eq!(value(text), expected, max_relative = 4e-16);
        }
        assert!(parse("5").unwrap().bare);
    }

    /// Each against its definition, worked out in other steps than the table's.
    #[test]
    fn inch_and_pound_units_are_exact() {
        let (pound, foot, gravity) = (0.453_592_37, 0.3048, 9.806_65);
        for (text, expected) in [
            ("1 in", 0.0254),
            ("12 in", foot),
            ("1 ft", foot),
            ("1 lb", pound),
            ("1 lbm", pound),
            ("1 lbf", pound * gravity),
            ("1 kgf", gravity),
            ("1 slug", pound * gravity / foot),
            ("32 slug ft/s^2", 32.0 * pound * gravity),
            ("1 psi", pound * gravity / (0.0254 * 0.0254)),
            ("1 ksi", 1000.0 * pound * gravity / (0.0254 * 0.0254)),
            ("1 lbf/in^2", pound * gravity / (0.0254 * 0.0254)),
            ("1 hp", 550.0 * foot * pound * gravity),
            ("550 ft lbf/s", 745.699_871_582_270_2),
            ("123 lb ft^2", 123.0 * pound * foot * foot),
            ("15 lbf ft", 15.0 * pound * gravity * foot),
            ("15 lbf·in", 15.0 * pound * gravity * 0.0254),
            ("0.3 lb/in3", 0.3 * pound / (0.0254 * 0.0254 * 0.0254)),
        ] {
            approx::assert_relative_eq!(value(text), expected, max_relative = 6e-16);
        }
        assert_eq!(value("0.1 in"), 0.002_54);
        assert_eq!(value("100 lb"), 45.359_237);
        assert_eq!(value("1 lbf"), 4.448_221_615_260_5);
    }

    #[test]
    fn only_the_whole_unit_is_per_minute() {
        for text in ["5 1/min", "5 1 / min", "5 min^-1", "5 min⁻¹", "5min-1"] {
            assert!(parse(text).unwrap().per_minute, "{text}");
        }
        for text in ["5 1/s", "5 r/min", "5 1/min/s", "5 m/min", "5 min", "5"] {
            assert!(!parse(text).unwrap().per_minute, "{text}");
        }
        for text in ["5 1", "5 1 min", "5 11/min", "5 1/", "5 m 1/s"] {
            assert!(parse(text).is_err(), "{text}");
        }
    }

    #[test]
    fn dimensions_keep_the_angle_apart() {
        let dimension = |text| parse(text).unwrap().dimension;
        assert_eq!(dimension("1 rev/s"), dimension("1 rad/s"));
        assert_ne!(dimension("1 Hz"), dimension("1 rad/s"));
        assert_eq!(dimension("1 J"), dimension("1 N m"));
        assert_eq!(dimension("1 kW/rpm"), dimension("1 N m/rad"));
        assert_eq!(dimension("1 N m/rad").to_string(), "kg m^2/rad/s^2");
    }

    #[test]
    fn faults_say_what_and_where() {
        assert_eq!(parse("rpm"), Err(UnitError::NoNumber));
        assert_eq!(parse(""), Err(UnitError::NoNumber));
        assert_eq!(parse("-"), Err(UnitError::NoNumber));
        assert_eq!(
            parse("1,5 mm"),
            Err(UnitError::DecimalComma {
                corrected: "1.5 mm".into()
            })
        );
        assert_eq!(parse("1e999 m"), Err(UnitError::NotFinite));
        assert_eq!(
            parse("5 furlong"),
            Err(UnitError::UnknownUnit {
                symbol: "furlong".into(),
                offset: 2
            })
        );
        assert_eq!(parse("5 N/m s"), Err(UnitError::Ambiguous { offset: 6 }));
        assert_eq!(parse("5 N/"), Err(UnitError::Incomplete { offset: 4 }));
        assert_eq!(parse("5 m^"), Err(UnitError::Incomplete { offset: 3 }));
        assert_eq!(parse("5 m^22"), Err(UnitError::Incomplete { offset: 3 }));
        assert_eq!(
            parse("5 (m)"),
            Err(UnitError::Unexpected {
                found: '(',
                offset: 2
            })
        );
    }
}
