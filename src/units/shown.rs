//! Numbers as people read them.

/// A number to `digits` significant digits: plain from a thousandth to a million, else
/// with a power of ten; zeros that say nothing are left out. What is no finite number
/// says so.
pub fn shown(value: f64, digits: usize) -> String {
    let digits = digits.max(1);
    if !value.is_finite() {
        return "not a number".to_owned();
    }
    if value == 0.0 {
        return "0".to_owned();
    }
    let text = format!("{value:.*e}", digits - 1);
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    // The exponent after rounding: 999 999.97 is a million.
    let leading: i32 = exponent.parse().unwrap_or(0);
    if (-3..6).contains(&leading) {
        let decimals = (digits as i32 - 1 - leading).max(0) as usize;
        return trimmed(&format!("{value:.decimals$}")).to_owned();
    }
    format!("{}e{leading}", trimmed(mantissa))
}

/// Without zeros at the end of the decimals.
fn trimmed(text: &str) -> &str {
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.'),
        false => text,
    }
}

#[cfg(test)]
mod tests {
    use super::shown;

    #[test]
    fn one_format_from_the_least_to_the_greatest() {
        for (value, text) in [
            (1e-7, "1e-7"),
            (-4.0932204e-16, "-4.09322e-16"),
            (0.001, "0.001"),
            (0.0009999999999, "0.001"),
            (100.0, "100"),
            (999_999.97, "1e6"),
            (1e308, "1e308"),
            (0.0, "0"),
            (f64::NAN, "not a number"),
        ] {
            assert_eq!(shown(value, 7), text);
        }
        assert_eq!(shown(123_456.789, 3), "123457");
    }
}
