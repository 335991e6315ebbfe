//! Several quantities in one list: a unit after the last one is the unit of all.

use super::parse::number_length;

/// A text's number and what stands after it as its unit; `None` where it does not
/// begin with a number.
pub fn number_and_unit(text: &str) -> Option<(&str, &str)> {
    let text = text.trim();
    match number_length(text) {
        0 => None,
        length => Some((&text[..length], text[length..].trim())),
    }
}

/// The values of a list with the unit that each one is meant in. Where the last
/// number has a unit and no other has one, it is the unit of all: `5`, `10`,
/// `20 kN/mm` are three values in kN/mm. What is no number is left as it is.
///
/// # Errors
/// Some numbers have a unit and some have none in another way: what is meant is
/// not known.
pub fn with_common_unit<S: AsRef<str>>(values: &[S]) -> Result<Vec<String>, String> {
    let read = |value: &S| number_and_unit(value.as_ref()).map(|(_, unit)| unit.to_owned());
    let units: Vec<Option<String>> = values.iter().map(read).collect();
    let numbers = || units.iter().flatten();
    let last = numbers().next_back().cloned().unwrap_or_default();
    let with_unit = numbers().filter(|unit| !unit.is_empty()).count();
    let bare = numbers().count() - with_unit;
    let carried = bare > 0 && with_unit == 1 && !last.is_empty();
    if bare > 0 && with_unit > 0 && !carried {
        let without = units.iter().position(|unit| unit.as_deref() == Some(""));
        let without = values[without.unwrap_or(0)].as_ref().trim();
        return Err(format!(
            "`{without}` has no unit and others have one: give every value its unit, or only the \
             last one, which is then the unit of all"
        ));
    }
    let complete = |(value, unit): (&S, &Option<String>)| {
        let value = value.as_ref().trim();
        match unit.as_deref() {
            Some("") if carried => format!("{value} {last}"),
            Some(unit) if carried && unit.starts_with(char::is_alphabetic) => {
                let number = value.strip_suffix(unit).unwrap_or(value).trim_end();
                format!("{number} {unit}")
            }
            _ => value.to_owned(),
        }
    };
    Ok(values.iter().zip(&units).map(complete).collect())
}

#[cfg(test)]
mod tests {
    use super::{number_and_unit, with_common_unit};

    #[test]
    fn a_unit_after_the_last_value_is_that_of_all() {
        for (given, meant) in [
            (["5", "10", "20 kN/mm"], ["5 kN/mm", "10 kN/mm", "20 kN/mm"]),
            (["-1e-3", " 0 ", "+2.5mm"], ["-1e-3 mm", "0 mm", "+2.5 mm"]),
            (["10", "20", "90°"], ["10 °", "20 °", "90°"]),
            (["1", "2", "10"], ["1", "2", "10"]),
            (["1 rpm", "2 rpm", "3 rad/s"], ["1 rpm", "2 rpm", "3 rad/s"]),
            (["none", "1", "2 mm"], ["none", "1 mm", "2 mm"]),
            (
                ["true", "exact", "{\"a\": 1}"],
                ["true", "exact", "{\"a\": 1}"],
            ),
        ] {
            assert_eq!(with_common_unit(&given).unwrap(), meant);
        }
    }

    #[test]
    fn a_unit_that_may_mean_two_things_is_refused() {
        for given in [
            ["5 mm", "10", "20"],
            ["5 mm", "10", "20 mm"],
            ["5", "10 mm", "20"],
        ] {
            let message = with_common_unit(&given).unwrap_err();
            assert!(message.contains("has no unit"), "{message}");
        }
        assert!(
            with_common_unit(&["5 mm", "0"])
                .unwrap_err()
                .contains("`0`")
        );
    }

    #[test]
    fn number_and_unit_are_told_apart() {
        assert_eq!(number_and_unit(" 1e3 e "), Some(("1e3", "e")));
        assert_eq!(number_and_unit("1 e"), Some(("1", "e")));
        assert_eq!(number_and_unit("1.5e mm"), Some(("1.5", "e mm")));
        assert_eq!(number_and_unit("rpm"), None);
        assert_eq!(number_and_unit(""), None);
    }
}
