//! Diagnostics as text, with excerpts.

use super::{Diagnostic, Diagnostics, Place, Severity, Source};
use annotate_snippets::{Annotation, AnnotationKind, Group, Level, Renderer, Snippet};
use std::ops::Range;

/// Longest stretch of text shown on either side of a place: scenes written by
/// programs may be one line of megabytes.
const CONTEXT: usize = 400;

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
        text.push_str(&renderer.render(&[group(diagnostics, item)]));
        text.push_str("\n\n");
    }
    text.push_str(&count(diagnostics));
    text
}

fn group<'a>(diagnostics: &'a Diagnostics, item: &'a Diagnostic) -> Group<'a> {
    let level = match item.severity {
        Severity::Error => Level::ERROR,
        Severity::Warning => Level::WARNING,
    };
    let title = level.primary_title(printable(&item.message)).id(item.code);
    let mut group = Group::with_title(title);
    for (source, marks) in marks_by_source(item) {
        if let Some(source) = diagnostics.sources.get(source) {
            group = group.element(snippet(source, &marks));
        }
    }
    for hint in &item.hints {
        group = group.element(Level::HELP.message(printable(hint)));
    }
    group
}

/// A place with its word; the first is the primary one.
type Mark<'a> = (&'a Place, &'a str, AnnotationKind);

fn marks_by_source(item: &Diagnostic) -> Vec<(usize, Vec<Mark<'_>>)> {
    let primary = item
        .place
        .iter()
        .map(|place| (place, item.label.as_str(), AnnotationKind::Primary));
    let related = item
        .related
        .iter()
        .map(|other| (&other.place, other.label.as_str(), AnnotationKind::Context));
    let mut groups: Vec<(usize, Vec<Mark<'_>>)> = Vec::new();
    for mark in primary.chain(related) {
        let source = mark.0.source;
        match groups.iter_mut().find(|group| group.0 == source) {
            Some(group) => group.1.push(mark),
            None => groups.push((source, vec![mark])),
        }
    }
    groups
}

fn snippet<'a>(source: &'a Source, marks: &[Mark<'_>]) -> Snippet<'a, Annotation<'a>> {
    let from = marks.iter().map(|mark| mark.0.range.start).min();
    let to = marks.iter().map(|mark| mark.0.range.end).max();
    let window = window(&source.text, from.unwrap_or(0)..to.unwrap_or(0));
    let excerpt = &source.text[window.clone()];
    let line = source.text[..window.start].matches('\n').count() + 1;
    let mut snippet = Snippet::source(excerpt)
        .line_start(line)
        .path(printable(&source.name));
    for (place, label, kind) in marks {
        let range = fit(excerpt, window.start, &place.range);
        let annotation = kind.span(range);
        snippet = snippet.annotation(match label.is_empty() {
            true => annotation,
            false => annotation.label(printable(label)),
        });
    }
    snippet
}

/// The lines around a stretch, cut where they are too long.
fn window(text: &str, range: Range<usize>) -> Range<usize> {
    let start = range.start.min(text.len());
    let end = range.end.clamp(start, text.len());
    let mut from = start.saturating_sub(CONTEXT);
    let mut to = (end + CONTEXT).min(text.len());
    while !text.is_char_boundary(from) {
        from -= 1;
    }
    while !text.is_char_boundary(to) {
        to += 1;
    }
    // Whole lines where they fit, so that columns come out right.
    if from > 0
        && let Some(newline) = text[from..start].find('\n')
    {
        from += newline + 1;
    }
    if to < text.len()
        && let Some(newline) = text[end.max(from)..to].rfind('\n')
    {
        to = end.max(from) + newline;
    }
    from..to
}

/// A stretch counted from the excerpt's start, on character boundaries.
fn fit(excerpt: &str, from: usize, range: &Range<usize>) -> Range<usize> {
    let mut start = range.start.saturating_sub(from).min(excerpt.len());
    let mut end = range.end.saturating_sub(from).clamp(start, excerpt.len());
    while !excerpt.is_char_boundary(start) {
        start -= 1;
    }
    while !excerpt.is_char_boundary(end) {
        end += 1;
    }
    start..end
}

/// Text from a file, safe to show in a terminal.
fn printable(text: &str) -> String {
    text.chars()
        .map(|c| match c {
            '\n' => ' ',
            c if c.is_control() => '\u{FFFD}',
            c => c,
        })
        .collect()
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
