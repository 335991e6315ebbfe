//! Texts that diagnostics point into.

use std::ops::Range;
use std::sync::Arc;

/// A text with a name: the scene's file, a catalogue file, a `--set` argument.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Source {
    /// Name shown before the line number.
    pub name: String,
    /// The text itself.
    pub text: String,
}

/// All texts that one reading touched; a [`Place`] counts into them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Sources(Vec<Arc<Source>>);

/// Number of a source among those of a document.
pub type SourceId = usize;

/// A stretch of a source, in bytes. The default is nowhere: of values made in code.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// The source.
    pub source: SourceId,
    /// Bytes of it.
    pub range: Range<usize>,
}

/// A place as people count: both from 1, columns in characters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Position {
    /// Line.
    pub line: usize,
    /// Column.
    pub column: usize,
}

impl Sources {
    /// Adds a source and tells its number.
    pub fn add(&mut self, source: Arc<Source>) -> SourceId {
        self.0.push(source);
        self.0.len() - 1
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.0.len()
    }

    /// A source by its number.
    pub fn get(&self, id: SourceId) -> Option<&Source> {
        self.0.get(id).map(Arc::as_ref)
    }

    /// Line and column of a place.
    pub fn position(&self, place: &Place) -> Option<Position> {
        Some(self.get(place.source)?.position(place.range.start))
    }
}

impl Source {
    /// Line and column of a byte offset.
    pub fn position(&self, offset: usize) -> Position {
        let mut end = offset.min(self.text.len());
        while !self.text.is_char_boundary(end) {
            end -= 1;
        }
        let before = &self.text[..end];
        let line_start = before.rfind('\n').map_or(0, |at| at + 1);
        Position {
            line: before.matches('\n').count() + 1,
            column: before[line_start..].chars().count() + 1,
        }
    }
}

/// Nowhere: in no source.
impl Default for Place {
    fn default() -> Self {
        Self {
            source: SourceId::MAX,
            range: 0..0,
        }
    }
}

impl Place {
    /// A stretch of a source.
    pub fn new(source: SourceId, range: Range<usize>) -> Self {
        Self { source, range }
    }

    /// True where there is no text: of values made in code.
    pub fn is_nowhere(&self) -> bool {
        self.source == SourceId::MAX
    }

    /// The place of `range` inside this place, cut off at its end.
    pub fn within(&self, range: Range<usize>) -> Self {
        let end = self.range.end;
        let start = (self.range.start + range.start).min(end);
        Self::new(
            self.source,
            start..(self.range.start + range.end).clamp(start, end),
        )
    }

    /// The first byte only: the opening bracket of an object or list.
    pub fn first(&self) -> Self {
        self.within(0..1)
    }
}
