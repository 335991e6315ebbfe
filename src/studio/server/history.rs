//! What was done to a text, in steps that undo takes back.
//!
//! The history belongs to the document, so that undo goes through whatever made an edit:
//! typing, a slider, a form, the graph, a map, another window. Edits with the number of one
//! drag are one step.

use crate::studio::server::limits::HISTORY;
use std::time::{Duration, Instant};

/// A piece of text that stands in place of another.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Edit {
    /// The byte where it begins.
    pub(super) at: usize,
    pub(super) removed: String,
    pub(super) inserted: String,
}

impl Edit {
    fn reversed(&self) -> Self {
        Self {
            at: self.at,
            removed: self.inserted.clone(),
            inserted: self.removed.clone(),
        }
    }
}

/// Which edits belong to one step.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum EditGroup {
    /// Typing of a window: what follows at once at the same place is the same step.
    Typing(u64),
    /// A drag of a window, by its number there.
    Drag(u64, u64),
    /// By itself.
    Alone,
}

/// What one undo takes back.
#[derive(Clone, Debug)]
struct Step {
    /// In the order in which they were made.
    edits: Vec<Edit>,
    group: EditGroup,
    time: Instant,
}

/// Typing that stops for so long begins a new step.
const PAUSE: Duration = Duration::from_millis(600);

/// The steps of a text.
#[derive(Clone, Debug, Default)]
pub(super) struct History {
    done: Vec<Step>,
    undone: Vec<Step>,
}

impl History {
    /// How many steps can be taken back and done again.
    pub(super) fn step_counts(&self) -> [usize; 2] {
        [self.done.len(), self.undone.len()]
    }

    /// The edits that take the last step back.
    pub(super) fn undo(&mut self) -> Option<Vec<Edit>> {
        let step = self.done.pop()?;
        let edits = step.edits.iter().rev().map(Edit::reversed).collect();
        self.undone.push(step);
        Some(edits)
    }

    /// The edits of the last step that was taken back.
    pub(super) fn redo(&mut self) -> Option<Vec<Edit>> {
        let step = self.undone.pop()?;
        let edits = step.edits.clone();
        self.done.push(Step {
            group: EditGroup::Alone,
            ..step
        });
        Some(edits)
    }

    /// Edits that were made; nothing that was taken back can be done again.
    pub(super) fn remember(&mut self, mut edits: Vec<Edit>, group: EditGroup) {
        self.undone.clear();
        let time = Instant::now();
        if let Some(last) = self.done.last_mut()
            && last.continues_with(&edits, &group, time)
        {
            last.time = time;
            last.merge_drag_edits(&mut edits);
            return;
        }
        self.done.push(Step { edits, group, time });
        let mut kept: usize = self.done.iter().map(Step::count_of_characters).sum();
        while kept > HISTORY && self.done.len() > 1 {
            kept -= self.done.remove(0).count_of_characters();
        }
    }
}

impl Step {
    fn continues_with(&self, edits: &[Edit], group: &EditGroup, now: Instant) -> bool {
        match group {
            _ if self.group != *group => false,
            EditGroup::Alone => false,
            EditGroup::Drag(..) => true,
            EditGroup::Typing(_) => {
                let touch = self.edits.last().zip(edits.first());
                let touch = touch.is_some_and(|(last, next)| {
                    let end = last.at + last.inserted.len();
                    next.at == end || next.at + next.removed.len() == end || next.at == last.at
                });
                let alone = edits.len() == 1 && !edits[0].inserted.contains('\n');
                touch && alone && now - self.time < PAUSE
            }
        }
    }

    /// A drag writes the same number over and over: its ends are enough.
    fn merge_drag_edits(&mut self, edits: &mut Vec<Edit>) {
        let [old, new] = [self.edits.as_mut_slice(), edits.as_mut_slice()];
        if let ([old], [new]) = (old, new)
            && old.at == new.at
            && old.inserted == new.removed
        {
            old.inserted = std::mem::take(&mut new.inserted);
            return;
        }
        self.edits.append(edits);
    }

    /// Characters that it keeps, about.
    fn count_of_characters(&self) -> usize {
        let edits = self.edits.iter();
        edits
            .map(|edit| 64 + edit.removed.len() + edit.inserted.len())
            .sum()
    }
}
