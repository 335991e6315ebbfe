//! Findings on the terminal.

use super::{Cell, Column, Figure, Findings, Item, Section, Table, Value};
use std::fmt::Write as _;

impl Findings<'_> {
    /// The text: title, answer, warnings are told elsewhere; tables that are wider than `room`
    /// (characters a line; `None`: any) go on below, under their first column again.
    pub fn text(&self, room: Option<usize>) -> String {
        let mut text = match self.subtitle.is_empty() {
            true => format!("{}\n", self.title),
            false => format!("{}: {}\n", self.title, terminal_numbers(&self.subtitle)),
        };
        if let Some(answer) = &self.answer {
            let sentence = format!("{} {}", answer.headline, answer.following_sentence());
            let _ = writeln!(text, "{}", terminal_numbers(sentence.trim()));
        }
        for section in &self.sections {
            let body = section.text(room);
            if body.is_empty() {
                continue;
            }
            text.push('\n');
            if !section.heading.is_empty() {
                let _ = writeln!(text, "{}", section.heading);
            }
            text.push_str(&body);
        }
        text
    }
}

/// Sentences in the numbers of the terminal: −1.2·10⁻⁷ as -1.2e-7.
pub(super) fn terminal_numbers(text: &str) -> String {
    const ABOVE: &str = "⁰¹²³⁴⁵⁶⁷⁸⁹";
    let digit = |c: char| ABOVE.chars().position(|one| one == c);
    let is_power = |c: &char| *c == '⁻' || digit(*c).is_some();
    let characters: Vec<char> = text.chars().collect();
    let at = |place: usize| characters.get(place).copied().unwrap_or(' ');
    let mut out = String::with_capacity(text.len());
    let mut place = 0;
    while place < characters.len() {
        let before = place.checked_sub(1).map_or(' ', &at);
        let power = |from: usize| (at(from), at(from + 1)) == ('1', '0') && is_power(&at(from + 2));
        let (lead, from) = match at(place) {
            '·' if before.is_ascii_digit() && power(place + 1) => ("e", place + 3),
            '1' if !before.is_ascii_digit() && before != '.' && power(place) => ("1e", place + 2),
            '−' if at(place + 1).is_ascii_digit() => {
                out.push('-');
                place += 1;
                continue;
            }
            other => {
                out.push(other);
                place += 1;
                continue;
            }
        };
        out.push_str(lead);
        let digits = characters[from..].iter().take_while(|c| is_power(c));
        place = from;
        for &one in digits {
            out.push_str(&digit(one).map_or("-".to_owned(), |value| value.to_string()));
            place += 1;
        }
    }
    out
}

impl Section<'_> {
    /// What the terminal shows of the section, without its heading.
    fn text(&self, room: Option<usize>) -> String {
        let part = |item: &Item<'_>| match item {
            Item::Words(words) if !words.is_empty() => format!("  {}\n", terminal_numbers(words)),
            Item::Notes(notes) => notes
                .iter()
                .map(|note| format!("  {}\n", terminal_numbers(note)))
                .collect(),
            Item::Figures(figures) => lines(figures),
            Item::Table(table) | Item::Folded(_, table) => table.lines(room, terminal_numbers),
            _ => String::new(),
        };
        self.items.iter().map(part).collect()
    }
}

/// Figures, a line each; numbers end in one column.
fn lines(figures: &[Figure]) -> String {
    let name = |figure: &Figure| width(&figure.name);
    let names = figures.iter().map(name).max().unwrap_or(0);
    let numbers = figures.iter().filter(|one| is_number(&one.value));
    let numbers = numbers.map(|one| width(&one.value.terminal_text())).max();
    let line = |figure: &Figure| {
        let value = terminal_numbers(&figure.value.terminal_text());
        let value = match is_number(&figure.value) {
            true => padded(&value, numbers.unwrap_or(0), true),
            false => value,
        };
        let line = format!(
            "  {}  {value}  {}",
            padded(&figure.name, names, false),
            terminal_numbers(&figure.note)
        );
        line.trim_end().to_owned() + "\n"
    };
    figures.iter().map(line).collect()
}

fn is_number(value: &Value) -> bool {
    matches!(value, Value::Number { .. })
}

/// Columns of text: the head, then a cell a row; what is aligned right.
struct Lane {
    cells: Vec<String>,
    right: bool,
    width: usize,
}

impl Lane {
    fn new(cells: Vec<String>, right: bool) -> Self {
        let width = cells.iter().map(|cell| width(cell)).max().unwrap_or(0);
        Self {
            cells,
            right,
            width,
        }
    }
}

impl Table {
    /// The table as it is, every line indented by two spaces; empty without rows.
    pub(in crate::report) fn text(&self) -> String {
        self.lines(None, str::to_owned)
    }

    /// The table in that room, its words as `said` has them. Sentences that find no room in their
    /// line stand below it.
    fn lines(&self, room: Option<usize>, said: impl Fn(&str) -> String) -> String {
        let rows: Vec<&[Cell]> = (self.rows.iter())
            .filter(|row| !row.minor)
            .map(|row| row.cells.as_slice())
            .collect();
        if rows.is_empty() {
            return String::new();
        }
        let of = |at: usize, part: &dyn Fn(&Cell) -> String| -> Vec<String> {
            let cell = |row: &&[Cell]| row.get(at).map_or(String::new(), part);
            rows.iter().map(cell).collect()
        };
        let under = |head: &str, cells: Vec<String>| [vec![head.to_owned()], cells].concat();
        // A column of additions stands behind that of the values.
        let column = |(at, column): (usize, &Column)| -> Vec<Lane> {
            let value = |cell: &Cell| said(&cell.value.terminal_text());
            let lanes = match column.prose {
                true => vec![Lane::new(under(&column.name, of(at, &prose)), false)],
                false => vec![
                    Lane::new(under(&column.name, of(at, &value)), column.right),
                    Lane::new(under("", of(at, &|cell| said(&cell.note))), false),
                ],
            };
            lanes.into_iter().filter(|lane| lane.width > 0).collect()
        };
        let shown = (self.columns.iter().enumerate()).filter(|(_, column)| !column.minor);
        // Sentences stand behind the last block, or below its lines.
        let (sentences, columns): (Vec<_>, Vec<_>) = shown.partition(|(_, column)| column.prose);
        let sentences: Vec<Lane> = sentences.into_iter().flat_map(column).collect();
        let columns: Vec<Vec<Lane>> = columns.into_iter().map(column).collect();
        let Some((first, rest)) = columns.split_first() else {
            return String::new();
        };
        let others: usize = columns.iter().map(|lanes| wide(lanes)).sum();
        let all = others + wide(&sentences);
        let beside = |room: usize| all <= room || (sentences.len() < 2 && others <= room / 2);
        let below = room.is_some_and(|room| !beside(room));
        let blocks = blocks(first, rest, room);
        let told = |row: usize| -> String {
            let lanes = sentences.iter().filter(|_| below && row > 0);
            let cells = lanes.map(|lane| lane.cells[row].as_str());
            let said = cells.filter(|cell| !cell.is_empty());
            said.map(|cell| format!("      {cell}\n")).collect()
        };
        let block = |(at, part): (usize, &&[Vec<Lane>])| -> String {
            let mut lanes: Vec<&Lane> = first.iter().chain(part.iter().flatten()).collect();
            let last = at + 1 == blocks.len();
            lanes.extend(sentences.iter().filter(|_| last && !below));
            let row = |row: usize| match last {
                true => line(&lanes, row) + &told(row),
                false => line(&lanes, row),
            };
            (0..=rows.len()).map(row).collect()
        };
        let blocks: Vec<String> = blocks.iter().enumerate().map(block).collect();
        blocks.join("\n")
    }
}

/// A cell as a sentence: bad news in capitals, what is to be added behind a colon.
fn prose(cell: &Cell) -> String {
    let value = match cell.good {
        Some(false) => cell.value.terminal_text().to_uppercase(),
        _ => cell.value.terminal_text(),
    };
    match (value.as_str(), cell.note.as_str()) {
        ("", other) | (other, "") => terminal_numbers(other),
        (value, note) => format!("{}: {}", terminal_numbers(value), terminal_numbers(note)),
    }
}

fn wide(lanes: &[Lane]) -> usize {
    lanes.iter().map(|lane| lane.width + 2).sum()
}

/// The columns behind the first in blocks that fit the room.
fn blocks<'t>(first: &[Lane], rest: &'t [Vec<Lane>], room: Option<usize>) -> Vec<&'t [Vec<Lane>]> {
    let (Some(room), false) = (room, rest.is_empty()) else {
        return vec![rest];
    };
    let room = room.saturating_sub(wide(first));
    let (mut blocks, mut from, mut used) = (Vec::new(), 0, 0);
    for (at, lanes) in rest.iter().enumerate() {
        if at > from && used + wide(lanes) > room {
            blocks.push(&rest[from..at]);
            (from, used) = (at, 0);
        }
        used += wide(lanes);
    }
    blocks.push(&rest[from..]);
    blocks
}

fn line(lanes: &[&Lane], row: usize) -> String {
    let cell = |lane: &&Lane| format!("  {}", padded(&lane.cells[row], lane.width, lane.right));
    let line: String = lanes.iter().map(cell).collect();
    line.trim_end().to_owned() + "\n"
}

fn padded(text: &str, to: usize, right: bool) -> String {
    let pad = " ".repeat(to.saturating_sub(width(text)));
    match right {
        true => pad + text,
        false => text.to_owned() + &pad,
    }
}

/// Characters that take room: combining accents do not.
pub(in crate::report) fn width(text: &str) -> usize {
    let takes_room = |c: &char| !('\u{300}'..='\u{36f}').contains(c);
    text.chars().filter(takes_room).count()
}

#[cfg(test)]
mod tests {
    use super::terminal_numbers;
    use crate::report::findings::{Cell, Figure, Findings, Section, Source, Table, Value};
    use crate::report::quantity::{significant, with_unit};

    #[test]
    fn numbers_of_sentences_are_those_of_the_terminal() {
        for value in [-1.2e-7, 1e-9, -4e12, 3.25, -0.5, 7.0, 1e7, -1e-12] {
            let said = format!("it is {} off", significant(value, 3));
            let plain = format!("it is {} off", crate::units::shown(value, 3));
            assert_eq!(terminal_numbers(&said), plain);
        }
        assert_eq!(terminal_numbers(&with_unit(3e-17, "m", 2)), "30e-18 m");
        assert_eq!(
            terminal_numbers("J in kg·m², one part in 10¹⁰ − x"),
            "J in kg·m², one part in 1e10 − x"
        );
    }

    fn found() -> Findings<'static> {
        let rows = ["first", "second one"].map(|name| {
            let value = |by: f64| Cell::with_note(Value::new(by, "m", 7), "at 12.5 deg");
            vec![
                name.into(),
                value(0.0123),
                value(-4.5),
                value(1e-12),
                value(f64::NAN),
            ]
        });
        let heads = ["name", ">least", ">greatest", ">mean", ">last"];
        let section = Section::new("Sizes").table(Table::new(heads).rows(rows));
        let figures = vec![
            Figure::number("speed", 400.0, "rad/s", 6).with_note("= 3819.72 rpm"),
            Figure::new("state", "rests"),
        ];
        Findings {
            title: "scene".to_owned(),
            subtitle: "sizes".to_owned(),
            answer: None,
            warnings: Vec::new(),
            sections: vec![
                section,
                Section::new("Empty"),
                Section::default().figures(figures),
            ],
            source: Source::default(),
        }
    }

    #[test]
    fn tables_that_are_too_wide_go_on_below_under_their_first_column() {
        let wide = found().text(None);
        assert_eq!(wide.matches("second one").count(), 1, "{wide}");
        let narrow = found().text(Some(60));
        assert_eq!(narrow.matches("second one").count(), 2, "{narrow}");
        assert!(
            narrow.lines().all(|line| line.chars().count() <= 60),
            "{narrow}"
        );
        for text in [&wide, &narrow] {
            for value in ["12.3 mm  at 12.5 deg", "-4.5 m", "1 pm", "–"] {
                assert_eq!(text.matches(value).count(), 2, "{text}");
            }
            assert!(!text.contains("Empty"), "{text}");
            assert!(
                text.contains("  speed  400 rad/s  = 3819.72 rpm\n  state  rests\n"),
                "{text}"
            );
        }
    }

    #[test]
    fn the_page_has_what_the_text_has() {
        let page = found().page();
        assert_eq!(
            page.matches("12.3 <span class=\"unit\">mm</span>").count(),
            2,
            "{page}"
        );
        assert_eq!(
            page.matches("<span class=\"sub\">at 12.5 deg</span>")
                .count(),
            8
        );
        assert!(page.contains("<dt>state</dt><dd>rests</dd>") && !page.contains("Empty"));
    }
}
