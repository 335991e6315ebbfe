//! Texts in the width of a terminal.
//!
//! Texts, warnings and help keep to that width. A number is not separated from its unit.

/// The text with no line longer than `width` characters, as far as its words allow: a line that
/// is too long goes on below, under the column in which its last part begins where there is
/// room, else a little further in than it began.
pub fn fitted(text: &str, width: usize) -> String {
    let mut out = String::with_capacity(text.len());
    for line in text.split_inclusive('\n') {
        let (line, end) = match line.strip_suffix('\n') {
            Some(line) => (line, "\n"),
            None => (line, ""),
        };
        match line.chars().count() > width {
            true => out.push_str(&wrapped_line(line, width)),
            false => out.push_str(line),
        }
        out.push_str(end);
    }
    out
}

fn wrapped_line(line: &str, width: usize) -> String {
    let characters: Vec<char> = line.chars().collect();
    let indent = indent(&characters, width);
    let mut out = String::new();
    let (mut from, mut room, mut first) = (0, width, true);
    while characters.len() - from > room {
        // The last space that leaves something on this line; a word that is too long is cut
        // by nobody.
        let least = if first { leading(&characters) } else { 0 };
        let space = (from + least + 1..=from + room)
            .rev()
            .find(|&at| characters[at] == ' ' && !is_inside_quantity(&characters, at));
        let space =
            space.or_else(|| (from + room..characters.len()).find(|&at| characters[at] == ' '));
        let Some(space) = space else { break };
        let part: String = characters[from..space].iter().collect();
        out.push_str(part.trim_end());
        out.push('\n');
        out.push_str(&" ".repeat(indent));
        from = (space..characters.len())
            .find(|&at| characters[at] != ' ')
            .unwrap_or(characters.len());
        (room, first) = (width - indent, false);
    }
    out.extend(&characters[from..]);
    out
}

/// Whether the space there parts a number from its unit, or the parts of that unit.
fn is_inside_quantity(characters: &[char], at: usize) -> bool {
    let word = |end: usize| -> &[char] {
        let start = characters[..end].iter().rposition(|c| *c == ' ');
        &characters[start.map_or(0, |space| space + 1)..end]
    };
    let is_number = |word: &[char]| {
        let digits = word.strip_prefix(&['-']).unwrap_or(word);
        digits.first().is_some_and(char::is_ascii_digit)
            && digits.last().is_some_and(char::is_ascii_digit)
    };
    let before = word(at);
    if is_number(before) {
        return true;
    }
    let is_symbol = before.len() <= 2 && before.iter().all(|c| c.is_alphabetic());
    is_symbol && at > before.len() && is_number(word(at - before.len() - 1))
}

fn leading(characters: &[char]) -> usize {
    characters.iter().take_while(|c| **c == ' ').count()
}

/// Where a line goes on: under the last of its columns (that two spaces part from the one
/// before) that leaves it at least half of the width.
fn indent(characters: &[char], width: usize) -> usize {
    let starts = (2..characters.len().min(width / 2 + 1)).filter(|&at| {
        characters[at] != ' ' && characters[at - 1] == ' ' && characters[at - 2] == ' '
    });
    let own = leading(characters);
    let column = starts.rev().find(|&at| at > own);
    column.unwrap_or(own + 4).min(width / 2)
}

#[cfg(test)]
mod tests {
    use super::fitted;

    #[test]
    fn no_line_is_longer_than_the_width_and_no_word_is_lost() {
        let table = "  simulation of the scene in time  5 cycles from the steady motion: ω -1.8e-12 off at the end\n";
        let prose = "determined: loads changed by one part in 10¹⁰ move δ by 1.0e-10; errors are \
                     shown down to 1.0e-15";
        for width in [30, 40, 60, 80] {
            for text in [table, prose, "short\n", ""] {
                let out = fitted(text, width);
                assert!(
                    out.lines().all(|line| line.chars().count() <= width),
                    "{out}"
                );
                let words = |text: &str| {
                    text.split_whitespace()
                        .map(str::to_owned)
                        .collect::<Vec<_>>()
                };
                assert_eq!(words(&out), words(text));
                assert_eq!(out.ends_with('\n'), text.ends_with('\n'));
            }
        }
        let lines = fitted(table, 80);
        assert!(
            lines.lines().nth(1).unwrap().starts_with(&" ".repeat(35)),
            "{lines}"
        );
        assert_eq!(fitted(table, 200), table);
    }

    #[test]
    fn a_number_keeps_its_unit() {
        let text = "an inertia of 13.26071713 kg m² to add";
        for width in 20..36 {
            assert!(fitted(text, width).contains("13.26071713 kg m²"), "{width}");
        }
    }

    #[test]
    fn a_word_wider_than_the_terminal_stays_whole() {
        let path = "a_very_long_path_of_a_property.that.nobody.can.break and more";
        assert!(
            fitted(path, 20).starts_with("a_very_long_path_of_a_property.that.nobody.can.break\n")
        );
    }
}
