//! Symbols with indices: C_v and ω_max with their index below the line.

/// How an index is set.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::report) enum Setting {
    /// As an element of a page.
    Page,
    /// As an element of a picture.
    Picture,
    /// As letters below the line, where there are such: in attributes.
    Letters,
}

/// Letters of an index at most.
const LONGEST: usize = 3;

/// A text that was made safe, with the indices of its symbols below the line. A symbol is one
/// Greek letter, or the C of a constant of a law; names of objects have longer ones.
pub(in crate::report) fn symbols(text: &str, setting: Setting) -> String {
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(at) = rest.find('_') {
        let (before, after) = (&rest[..at], &rest[at + 1..]);
        let length = after.find(|c: char| !c.is_alphanumeric());
        let (index, next) = after.split_at(length.unwrap_or(after.len()));
        out.push_str(before);
        match is_symbol(before, index, next) {
            true => out.push_str(&symbol_with_index(index, next.is_empty(), setting)),
            false => {
                out.push('_');
                out.push_str(index);
            }
        }
        rest = next;
    }
    out + rest
}

/// Whether what stands before and behind an underscore makes a symbol of it.
fn is_symbol(before: &str, index: &str, next: &str) -> bool {
    let mut letters = before.chars().rev();
    let Some(letter) = letters.next() else {
        return false;
    };
    let alone = letters
        .next()
        .is_none_or(|c| !c.is_alphanumeric() && !matches!(c, '_' | '.' | '-'));
    let known = match letter {
        'C' => ["v", "a", "j", "m"].contains(&index),
        _ => letter.is_alphabetic() && !letter.is_ascii(),
    };
    let ends = next.chars().next().is_none_or(|c| !matches!(c, '_' | '-'));
    alone && known && ends && (1..=LONGEST).contains(&index.chars().count())
}

fn symbol_with_index(index: &str, last: bool, setting: Setting) -> String {
    // (What follows in a picture goes back to the line.)
    let back = if last {
        ""
    } else {
        "<tspan dy=\"-3\">\u{200b}</tspan>"
    };
    match setting {
        Setting::Page => format!("<sub>{index}</sub>"),
        Setting::Picture => {
            format!("<tspan class=\"index\" dy=\"3\">{index}</tspan>{back}")
        }
        Setting::Letters => match index {
            "v" => "ᵥ".to_owned(),
            "a" => "ₐ".to_owned(),
            "j" => "ⱼ".to_owned(),
            "m" => "ₘ".to_owned(),
            other => format!("_{other}"),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::{Setting, symbols};

    #[test]
    fn indices_of_symbols_stand_below_the_line_and_names_stay() {
        let page = |text| symbols(text, Setting::Page);
        assert_eq!(
            page("greatest speed C_v, ω_max; C_a = 2"),
            "greatest speed C<sub>v</sub>, ω<sub>max</sub>; C<sub>a</sub> = 2"
        );
        assert_eq!(page("O₂, ζ_Π"), "O₂, ζ<sub>Π</sub>");
        for name in [
            "take_up",
            "C_arm",
            "rocker.delta_max",
            "a_1",
            "arm_C_v",
            "φ_left_rocker",
            "ends_",
            "_",
        ] {
            assert_eq!(page(name), name);
        }
        assert_eq!(
            symbols("O₂, ω_max", Setting::Picture),
            "O₂, ω<tspan class=\"index\" dy=\"3\">max</tspan>"
        );
        assert_eq!(symbols("C_m", Setting::Letters), "Cₘ");
    }
}
