//! Tables of text with aligned columns.

/// Rows of cells under a head; columns named in `right` are aligned right.
pub(super) struct Table {
    head: Vec<&'static str>,
    right: &'static [usize],
    rows: Vec<Vec<String>>,
}

impl Table {
    pub(super) fn new(head: Vec<&'static str>, right: &'static [usize]) -> Self {
        Self {
            head,
            right,
            rows: Vec::new(),
        }
    }

    pub(super) fn push(&mut self, row: Vec<String>) {
        self.rows.push(row);
    }

    /// The table, every line indented by two spaces; empty without rows.
    pub(super) fn text(&self) -> String {
        if self.rows.is_empty() {
            return String::new();
        }
        let head: Vec<String> = self.head.iter().map(ToString::to_string).collect();
        let all = || std::iter::once(&head).chain(&self.rows);
        let widest = |column: usize| all().map(|row| width(&row[column])).max().unwrap_or(0);
        let widths: Vec<usize> = (0..head.len()).map(widest).collect();
        all().map(|row| self.line(row, &widths)).collect()
    }

    fn line(&self, row: &[String], widths: &[usize]) -> String {
        let mut line = String::new();
        for (column, cell) in row.iter().enumerate() {
            let pad = " ".repeat(widths[column] - width(cell));
            line.push_str("  ");
            if self.right.contains(&column) {
                line.push_str(&pad);
                line.push_str(cell);
            } else {
                line.push_str(cell);
                line.push_str(&pad);
            }
        }
        line.truncate(line.trim_end().len());
        line + "\n"
    }
}

/// Characters that take room: combining accents do not.
pub(super) fn width(text: &str) -> usize {
    let takes_room = |c: &char| !('\u{300}'..='\u{36f}').contains(c);
    text.chars().filter(takes_room).count()
}
