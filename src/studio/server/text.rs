//! A scene's text with its edits: what all windows on a file share, byte for byte as it is in
//! the file.
//!
//! Windows count in units of their own ([`crate::studio::units`]). Lines that nobody touches keep their
//! bytes.

use super::history::{Edit, EditGroup, History};
use crate::studio::limits::BODY;
use crate::studio::server::limits::{LISTED, LISTED_SIZE};
use crate::studio::units::{UnitTraversal, length};
use serde_json::{Value, json};
use std::cmp::Ordering;
use std::ops::Range;

/// A text with its history.
#[derive(Clone, Debug)]
pub(super) struct Text {
    text: String,
    line_break: &'static str,
    /// Every change makes a new version.
    version: u64,
    history: History,
}

impl Text {
    /// A text as it stands in a file.
    ///
    /// # Errors
    /// Its line breaks cannot be kept.
    pub(super) fn new(text: String) -> Result<Self, String> {
        if text.replace("\r\n", "").contains('\r') {
            return Err("lines of this file end with CR alone, which cannot be kept".to_owned());
        }
        let first = text.find('\n');
        let is_long = first.is_some_and(|at| text[..at].ends_with('\r'));
        Ok(Self {
            line_break: if is_long { "\r\n" } else { "\n" },
            text,
            version: 0,
            history: History::default(),
        })
    }

    /// The text itself.
    pub(super) fn text(&self) -> &str {
        &self.text
    }

    /// The text as windows hold it.
    pub(super) fn with_unix_newlines(&self) -> String {
        self.text.replace("\r\n", "\n")
    }

    /// Number of changes so far.
    pub(super) fn version(&self) -> u64 {
        self.version
    }

    /// Whether there is something to undo and to redo.
    pub(super) fn history(&self) -> [bool; 2] {
        self.history.step_counts().map(|count| count > 0)
    }

    /// The steps of the history as changes for a window that has the text: those that take one step
    /// after the other back, and those that do what was taken back again. At most [`LISTED`] of
    /// each; `more`: older ones are left out.
    pub(super) fn steps(&self) -> Value {
        let mut size = 0;
        let mut listed = |mut text: Self, step: fn(&mut Self) -> Option<Vec<Value>>| {
            let mut steps = Vec::new();
            while steps.len() < LISTED && size < LISTED_SIZE {
                let Some(changes) = step(&mut text) else {
                    break;
                };
                let changes = json!(changes);
                size += changes.to_string().len();
                steps.push(changes);
            }
            (steps, text.history.step_counts())
        };
        let (done, [left, _]) = listed(self.clone(), Self::undo);
        let (undone, _) = listed(self.clone(), Self::redo);
        json!({
            "version": self.version,
            "count": self.history.step_counts()[0],
            "done": done,
            "undone": undone,
            "more": left > 0,
        })
    }

    /// Takes steps back, or does them again, until so many are done; the changes for the windows.
    pub(super) fn go_to(&mut self, count: usize) -> Vec<Value> {
        let mut all = Vec::new();
        loop {
            let [done, _] = self.history.step_counts();
            let changes = match done.cmp(&count) {
                Ordering::Greater => self.undo(),
                Ordering::Less => self.redo(),
                Ordering::Equal => None,
            };
            match changes {
                Some(changes) => all.extend(changes),
                None => return all,
            }
        }
    }

    /// Applies a window's changes: the list `[kept, [removed, line, line …], …]` of its editor.
    ///
    /// # Errors
    /// They do not fit the text; nothing is changed then.
    pub(super) fn apply(&mut self, changes: &Value, group: EditGroup) -> Result<(), String> {
        let pieces = self.pieces(changes)?;
        let removed: usize = pieces.iter().map(|(range, _)| range.len()).sum();
        let inserted: usize = pieces.iter().map(|(_, text)| text.len()).sum();
        if self.text.len() - removed + inserted > BODY {
            return Err("the scene would be larger than 1 MB".to_owned());
        }
        // From the end on, so that the places before stay right.
        let edits = pieces.into_iter().rev().map(|(range, inserted)| {
            let removed = self.text[range.clone()].to_owned();
            self.text.replace_range(range.clone(), &inserted);
            Edit {
                at: range.start,
                removed,
                inserted,
            }
        });
        let edits: Vec<Edit> = edits.collect();
        self.version += 1;
        self.history.remember(edits, group);
        Ok(())
    }

    /// Takes the last step back; the changes for the windows. `None`: there is none.
    pub(super) fn undo(&mut self) -> Option<Vec<Value>> {
        let edits = self.history.undo()?;
        Some(self.apply_edits(edits))
    }

    /// Does the last step that was taken back again.
    pub(super) fn redo(&mut self) -> Option<Vec<Value>> {
        let edits = self.history.redo()?;
        Some(self.apply_edits(edits))
    }

    /// Puts another text in its place, as one step: only what differs is changed.
    pub(super) fn replace(&mut self, other: &str) -> Vec<Value> {
        let same = |pair: &(char, char)| pair.0 == pair.1;
        let (own, new) = (self.text.chars(), other.chars());
        let mut start: usize = own
            .zip(new)
            .take_while(same)
            .map(|(a, _)| a.len_utf8())
            .sum();
        // A line break is not taken apart.
        if self.text[..start].ends_with('\r') {
            start -= 1;
        }
        let (own, new) = (
            self.text[start..].chars().rev(),
            other[start..].chars().rev(),
        );
        let mut end: usize = own
            .zip(new)
            .take_while(same)
            .map(|(a, _)| a.len_utf8())
            .sum();
        let split = |text: &str, end: usize| {
            let at = text.len() - end;
            text[at..].starts_with('\n') && text[start..at].ends_with('\r')
        };
        if split(&self.text, end) || split(other, end) {
            end -= 1;
        }
        let edit = Edit {
            at: start,
            removed: self.text[start..self.text.len() - end].to_owned(),
            inserted: other[start..other.len() - end].to_owned(),
        };
        if edit.removed == edit.inserted {
            return Vec::new();
        }
        let changes = self.apply_edits(vec![edit.clone()]);
        self.history.remember(vec![edit], EditGroup::Alone);
        changes
    }

    fn apply_edits(&mut self, edits: Vec<Edit>) -> Vec<Value> {
        let change = |edit: Edit| {
            let range = edit.at..edit.at + edit.removed.len();
            let [before, removed, after] = [
                &self.text[..range.start],
                &self.text[range.clone()],
                &self.text[range.end..],
            ]
            .map(length);
            let shown = edit.inserted.replace("\r\n", "\n");
            let lines = shown.split('\n').map(|line| json!(line));
            let piece: Vec<Value> = match edit.inserted.is_empty() {
                true => vec![json!(removed)],
                false => std::iter::once(json!(removed)).chain(lines).collect(),
            };
            self.text.replace_range(range, &edit.inserted);
            self.version += 1;
            let mut list = Vec::new();
            list.extend((before > 0).then(|| json!(before)));
            list.push(json!(piece));
            list.extend((after > 0).then(|| json!(after)));
            json!(list)
        };
        edits.into_iter().map(change).collect()
    }

    /// The bytes that changes replace, and by what.
    fn pieces(&self, changes: &Value) -> Result<Vec<(Range<usize>, String)>, String> {
        const WRONG: &str = "these changes do not fit the text";
        let mut pieces = Vec::new();
        let mut walk = UnitTraversal::new(&self.text);
        for part in changes.as_array().ok_or(WRONG)? {
            if let Some(kept) = part.as_u64() {
                walk.skip_units(kept).ok_or(WRONG)?;
                continue;
            }
            let (count, lines) = part
                .as_array()
                .and_then(|part| part.split_first())
                .ok_or(WRONG)?;
            let start = walk.at;
            walk.skip_units(count.as_u64().ok_or(WRONG)?).ok_or(WRONG)?;
            let lines: Option<Vec<&str>> = lines.iter().map(Value::as_str).collect();
            let lines = lines.ok_or(WRONG)?;
            if lines.iter().any(|line| line.contains(['\r', '\n'])) {
                return Err(WRONG.to_owned());
            }
            pieces.push((start..walk.at, lines.join(self.line_break)));
        }
        match walk.at == self.text.len() {
            true => Ok(pieces),
            false => Err(WRONG.to_owned()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::history::EditGroup;
    use super::{LISTED, Text};
    use crate::studio::units::length;
    use serde_json::{Value, json};

    /// Applies changes to a text as windows hold it.
    fn in_window(text: &str, changes: &Value) -> String {
        let units: Vec<u16> = text.encode_utf16().collect();
        let (mut at, mut out) = (0, Vec::new());
        for part in changes.as_array().unwrap() {
            match part.as_u64() {
                Some(kept) => {
                    out.extend_from_slice(&units[at..at + kept as usize]);
                    at += kept as usize;
                }
                None => {
                    let part = part.as_array().unwrap();
                    at += part[0].as_u64().unwrap() as usize;
                    let lines = part[1..].iter().map(|line| line.as_str().unwrap());
                    out.extend(lines.collect::<Vec<_>>().join("\n").encode_utf16());
                }
            }
        }
        assert_eq!(at, units.len());
        String::from_utf16(&out).unwrap()
    }

    struct Random(u64);

    impl Random {
        fn below(&mut self, most: usize) -> usize {
            self.0 = self
                .0
                .wrapping_mul(6364136223846793005)
                .wrapping_add(1442695040888963407);
            (self.0 >> 33) as usize % most
        }
    }

    #[test]
    fn random_edits_and_as_many_undos_give_the_bytes_back() {
        for seed in 0..40 {
            let mut random = Random(seed);
            let original =
                "{ \"a\": 1,\r\n\t\"µ😀\": [2, 3] }\n\r\nend".repeat(1 + random.below(3));
            let mut text = Text::new(original.clone()).unwrap();
            let mut window = text.with_unix_newlines();
            for step in 0..100 {
                // Anywhere but within a character.
                let places: Vec<usize> = std::iter::once(0)
                    .chain(
                        window
                            .char_indices()
                            .map(|(at, c)| length(&window[..at + c.len_utf8()])),
                    )
                    .collect();
                let mut ends = [0; 4].map(|_| places[random.below(places.len())]);
                ends.sort_unstable();
                let all = length(&window);
                let pieces = ["x", "", "7", "é\n", "\n\n", "😀"];
                let mut one = |from: usize, to: usize| {
                    let inserted = pieces[random.below(pieces.len())];
                    let mut list = vec![json!(to - from)];
                    if !inserted.is_empty() {
                        list.extend(inserted.split('\n').map(|line| json!(line)));
                    }
                    json!(list)
                };
                let end = ends[2].min(ends[1] + 4).max(ends[1]);
                let end = *places.iter().rev().find(|place| **place <= end).unwrap();
                let changes = json!([
                    ends[0],
                    one(ends[0], ends[0]),
                    ends[1] - ends[0],
                    one(ends[1], end),
                    all - end
                ]);
                window = in_window(&window, &changes);
                let group = match random.below(3) {
                    0 => EditGroup::Typing(1),
                    1 => EditGroup::Drag(1, step / 7),
                    _ => EditGroup::Alone,
                };
                text.apply(&changes, group).unwrap();
                assert_eq!(text.with_unix_newlines(), window, "seed {seed}");
            }
            let edited = text.text().to_owned();
            let mut steps = 0;
            while let Some(changes) = text.undo() {
                window = changes
                    .iter()
                    .fold(window, |window, one| in_window(&window, one));
                assert_eq!(text.with_unix_newlines(), window, "seed {seed}");
                steps += 1;
            }
            assert!(steps > 30 && steps <= 100);
            assert_eq!(text.text(), original, "seed {seed}");
            while text.redo().is_some() {}
            assert_eq!(text.text(), edited, "seed {seed}");
            listed_steps_lead_there(&text, steps, random.below(steps));
        }
    }

    /// A window that applies the listed changes has the texts between, and going to a step is the same.
    fn listed_steps_lead_there(text: &Text, count: usize, wanted: usize) {
        let steps = text.steps();
        assert_eq!(steps["count"], count);
        assert_eq!(
            (&steps["version"], &steps["more"]),
            (&json!(text.version()), &json!(false))
        );
        let applied = |from: &str, steps: &Value| {
            let changes = steps.as_array().unwrap().iter();
            let changes = changes.flat_map(|step| step.as_array().unwrap());
            changes.fold(from.to_owned(), |window, one| in_window(&window, one))
        };
        let mut back = text.clone();
        let window = text.with_unix_newlines();
        let changes = back.go_to(wanted);
        let done = steps["done"].as_array().unwrap();
        assert_eq!(done.len(), count);
        let some = json!(done[..count - wanted]);
        assert_eq!(applied(&window, &some), back.with_unix_newlines());
        let gone = changes
            .iter()
            .fold(window.clone(), |window, one| in_window(&window, one));
        assert_eq!(gone, back.with_unix_newlines());
        let undone = back.steps()["undone"].clone();
        assert_eq!(undone.as_array().unwrap().len(), count - wanted);
        assert_eq!(applied(&gone, &undone), window);
        back.go_to(usize::MAX);
        assert_eq!(back.text(), text.text());
    }

    #[test]
    fn a_list_of_steps_is_bounded() {
        let mut text = Text::new("1".to_owned()).unwrap();
        for _ in 0..LISTED + 3 {
            text.apply(&json!([[1, "2"]]), EditGroup::Alone).unwrap();
        }
        let steps = text.steps();
        assert_eq!(steps["done"].as_array().unwrap().len(), LISTED);
        assert_eq!(
            (&steps["count"], &steps["more"]),
            (&json!(LISTED + 3), &json!(true))
        );
    }

    #[test]
    fn a_drag_is_one_step() {
        let mut text = Text::new("{\"gap\": 0.1 }".to_owned()).unwrap();
        let mut length = 3;
        for number in ["0.2", "0.35", "12", "0.4"] {
            let rest = 13 - 8 - 3;
            text.apply(&json!([8, [length, number], rest]), EditGroup::Drag(3, 1))
                .unwrap();
            length = number.len();
        }
        text.apply(&json!([8, [length, "9"], 2]), EditGroup::Drag(3, 2))
            .unwrap();
        assert_eq!(text.text(), "{\"gap\": 9 }");
        text.undo();
        assert_eq!(text.text(), "{\"gap\": 0.4 }");
        text.undo();
        assert_eq!(text.text(), "{\"gap\": 0.1 }");
        assert_eq!(text.history(), [false, true]);
    }

    #[test]
    fn what_does_not_fit_changes_nothing() {
        let mut text = Text::new("a😀b".to_owned()).unwrap();
        let big = "x".repeat(1 << 20);
        for wrong in [
            json!(null),
            json!([5]),
            json!([3]),
            json!([2, [0, "x"], 2]),
            json!([4, [1]]),
            json!([4, [0, "a\nb"]]),
            json!([4, [0, 7]]),
            json!([4, []]),
            json!([4, "x"]),
            json!([[-1], 4]),
            json!([4, [0, big]]),
        ] {
            assert!(text.apply(&wrong, EditGroup::Alone).is_err());
            assert_eq!((text.text(), text.version()), ("a😀b", 0));
        }
        assert!(Text::new("a\rb".to_owned()).is_err());
    }

    #[test]
    fn another_text_is_one_step_and_touches_what_differs() {
        for (old, new) in [
            ("a\r\nb\r\nc", "a\r\nx\r\nc"),
            ("a\r\nb", "a\nb"),
            ("a\nb", "a\r\nb"),
            ("same", "same"),
            ("", "new"),
            ("aaa", "aa"),
        ] {
            let mut text = Text::new(old.to_owned()).unwrap();
            let window = text.with_unix_newlines();
            let changes = text.replace(new);
            let window = changes
                .iter()
                .fold(window, |window, one| in_window(&window, one));
            assert_eq!((text.text(), text.with_unix_newlines()), (new, window));
            text.undo();
            assert_eq!(text.text(), old);
        }
    }
}
