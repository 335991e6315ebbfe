//! Diagnostics as text, with excerpts.

use super::{Diagnostic, Diagnostics, Place, Severity, Source, SourceId};
use annotate_snippets::{AnnotationKind, Group, Level, Origin, Renderer, Snippet};
use std::ops::Range;

/// Longest stretch of text shown on either side of a place: scenes written by
/// programs may be one line of megabytes.
const CONTEXT: usize = 400;

/// Places further apart than this are shown in excerpts of their own.
const ONE_EXCERPT: usize = 2000;

/// Longest stretch that is marked.
const LONGEST_MARK: usize = 1000;

/// Most related places shown.
const MOST_RELATED: usize = 8;

/// Most diagnostics shown in full.
const MOST: usize = 100;

pub(super) fn render(diagnostics: &Diagnostics, colour: bool) -> String {
    let renderer = if colour {
        Renderer::styled()
    } else {
        Renderer::plain()
    };
    let mut text = String::new();
    for item in diagnostics.items.iter().take(MOST) {
        text.push_str(&without_control_characters(
            &renderer.render(&[group(diagnostics, item)]),
            colour,
        ));
        text.push_str("\n\n");
    }
    text.push_str(&count(diagnostics));
    text
}

/// An excerpt may hold control characters that the renderer lets pass; its own
/// escape sequences are colours.
fn without_control_characters(rendered: &str, colour: bool) -> String {
    if !colour {
        return printable(rendered);
    }
    let colours = rendered.split('\u{1b}').map(printable);
    colours.collect::<Vec<_>>().join("\u{1b}")
}

fn group<'a>(diagnostics: &'a Diagnostics, item: &'a Diagnostic) -> Group<'a> {
    let level = match item.severity {
        Severity::Error => Level::ERROR,
        Severity::Warning => Level::WARNING,
    };
    let title = level
        .primary_title(in_one_line(&item.message))
        .id(item.code);
    let mut group = Group::with_title(title);
    let in_code = item.place.as_ref().is_none_or(Place::is_nowhere);
    if in_code && !item.path.is_empty() {
        group = group.element(Origin::path(in_one_line(&item.path)));
    }
    for excerpt in excerpts(item) {
        if let Some(source) = diagnostics.sources.get(excerpt.source) {
            group = show(group, source, &excerpt);
        }
    }
    for hint in &item.hints {
        group = group.element(Level::HELP.message(in_one_line(hint)));
    }
    group
}

/// A stretch of a source with its word.
struct Mark<'a> {
    range: Range<usize>,
    label: &'a str,
    kind: AnnotationKind,
}

/// Marks that are shown in one excerpt.
struct Excerpt<'a> {
    source: SourceId,
    marks: Vec<Mark<'a>>,
}

impl Excerpt<'_> {
    fn range(&self) -> Range<usize> {
        let start = self.marks.iter().map(|mark| mark.range.start).min();
        let end = self.marks.iter().map(|mark| mark.range.end).max();
        start.unwrap_or(0)..end.unwrap_or(0)
    }

    /// Whether a range is near enough to be shown together with the others.
    fn takes(&self, source: SourceId, range: &Range<usize>) -> bool {
        let own = self.range();
        self.source == source
            && range.start + ONE_EXCERPT >= own.start
            && range.end <= own.end.saturating_add(ONE_EXCERPT)
    }
}

/// The primary place first, then the related ones, those near it with it.
fn excerpts(item: &Diagnostic) -> Vec<Excerpt<'_>> {
    let primary = item.place.iter().map(|place| (place, item.label.as_str()));
    let related = item
        .related
        .iter()
        .take(MOST_RELATED)
        .map(|other| (&other.place, other.label.as_str()));
    let mut excerpts: Vec<Excerpt<'_>> = Vec::new();
    let shown = primary.chain(related).enumerate();
    for (number, (place, label)) in shown.filter(|(_, (place, _))| !place.is_nowhere()) {
        let kind = match number {
            0 => AnnotationKind::Primary,
            _ => AnnotationKind::Context,
        };
        let range = place.range.start..place.range.end.min(place.range.start + LONGEST_MARK);
        let near = excerpts.iter_mut().find(|e| e.takes(place.source, &range));
        let mark = Mark { range, label, kind };
        match near {
            Some(excerpt) => excerpt.marks.push(mark),
            None => excerpts.push(Excerpt {
                source: place.source,
                marks: vec![mark],
            }),
        }
    }
    excerpts
}

/// Adds an excerpt to the report of one diagnostic.
fn show<'a>(group: Group<'a>, source: &'a Source, excerpt: &Excerpt<'_>) -> Group<'a> {
    let range = excerpt.range();
    let window = window(&source.text, range.clone());
    let text = &source.text[window.clone()];
    let line = source.text[..window.start].matches('\n').count() + 1;
    let mut snippet = Snippet::source(text).line_start(line);
    for mark in &excerpt.marks {
        let annotation = mark
            .kind
            .span(range_in_excerpt(text, window.start, &mark.range));
        snippet = snippet.annotation(match mark.label.is_empty() {
            true => annotation,
            false => annotation.label(in_one_line(mark.label)),
        });
    }
    let cut = window.start > 0 && source.text.as_bytes()[window.start - 1] != b'\n';
    if !cut {
        return group.element(snippet.path(in_one_line(&source.name)));
    }
    // The excerpt begins inside a line: its columns are not the file's.
    let at = source.position(excerpt.marks.first().map_or(range.start, |m| m.range.start));
    let origin = Origin::path(in_one_line(&source.name))
        .line(at.line)
        .char_column(at.column);
    group.element(origin).element(snippet)
}

/// The lines around a stretch, cut where they are too long.
fn window(text: &str, range: Range<usize>) -> Range<usize> {
    let start = boundary_below(text, range.start);
    let end = boundary_above(text, range.end.max(start));
    let mut from = boundary_below(text, start.saturating_sub(CONTEXT));
    let mut to = boundary_above(text, end + CONTEXT);
    // Whole lines where they fit, so that columns come out right.
    if from > 0
        && let Some(newline) = text[from..start].find('\n')
    {
        from += newline + 1;
    }
    if to < text.len()
        && let Some(newline) = text[end..to].rfind('\n')
    {
        to = end + newline;
    }
    from..to
}

fn boundary_below(text: &str, at: usize) -> usize {
    let mut at = at.min(text.len());
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}

fn boundary_above(text: &str, at: usize) -> usize {
    let mut at = at.min(text.len());
    while !text.is_char_boundary(at) {
        at += 1;
    }
    at
}

/// A stretch counted from the excerpt's start, on character boundaries.
fn range_in_excerpt(excerpt: &str, from: usize, range: &Range<usize>) -> Range<usize> {
    let start = boundary_below(excerpt, range.start.saturating_sub(from));
    let end = boundary_above(excerpt, range.end.saturating_sub(from).max(start));
    start..end
}

/// Text from a file in one line, safe to show in a terminal.
fn in_one_line(text: &str) -> String {
    printable(&text.replace('\n', " "))
}

/// True for what a terminal obeys in place of showing: control characters, the ends of
/// lines among them, and those that turn the direction of writing.
pub fn is_harmful(c: char) -> bool {
    c.is_control() || matches!(c, '\u{202A}'..='\u{202E}' | '\u{2066}'..='\u{2069}')
}

/// Text that is safe to show in a terminal: control characters, and those that turn
/// the direction of writing, are replaced; ends of lines and tabs stay.
pub fn printable(text: &str) -> String {
    let mut chars = text.chars().peekable();
    let mut safe = String::with_capacity(text.len());
    while let Some(c) = chars.next() {
        safe.push(match c {
            '\n' | '\t' => c,
            '\r' if chars.peek() == Some(&'\n') => c,
            c if is_harmful(c) => '\u{FFFD}',
            c => c,
        });
    }
    safe
}

fn count(diagnostics: &Diagnostics) -> String {
    let number = |severity| {
        let of = |item: &&Diagnostic| item.severity == severity;
        diagnostics.items.iter().filter(of).count()
    };
    let plural = |count: usize, word: &str| match count {
        0 => None,
        1 => Some(format!("1 {word}")),
        _ => Some(format!("{count} {word}s")),
    };
    let parts: Vec<String> = [
        plural(number(Severity::Error), "error"),
        plural(number(Severity::Warning), "warning"),
    ]
    .into_iter()
    .flatten()
    .collect();
    let mut text = parts.join(", ");
    if diagnostics.items.len() > MOST {
        text.push_str(&format!(" (the first {MOST} shown)"));
    }
    text.push('\n');
    text
}
