//! Standard output is data, standard error is talk.

use super::failure::Failure;
use super::interrupt;
use crate::frontend::diagnostics::{Diagnostics, is_harmful, printable};
use crate::report::findings::Findings;
use crate::report::fitted::fitted;
use std::io::{ErrorKind, IsTerminal, Write};

/// Writes data to standard output, all of it. A reader that has gone away
/// (`dam … | head`) is no error of ours. Control characters, which only names and
/// texts of a scene can bring in, are made harmless.
///
/// # Errors
/// What the system says: no space left, …
pub(crate) fn data(text: &str) -> Result<(), Failure> {
    interrupt::answering();
    let mut out = std::io::stdout().lock();
    let written = out
        .write_all(printable(text).as_bytes())
        .and_then(|()| out.flush());
    checked(written)
}

/// Writes a text for people to standard output: no line is longer than the terminal is wide.
/// What goes into a file or another program stays as it is.
///
/// # Errors
/// Those of [`data`].
pub(crate) fn print_text(text: &str) -> Result<(), Failure> {
    match width(Stream::Output) {
        Some(width) => data(&fitted(text, width)),
        None => data(text),
    }
}

/// Writes findings to standard output, tables in the width of the terminal.
///
/// # Errors
/// Those of [`data`].
pub(crate) fn findings(found: &Findings<'_>) -> Result<(), Failure> {
    print_text(&found.text(width(Stream::Output)))
}

/// Standard output or standard error.
#[derive(Clone, Copy)]
enum Stream {
    Output,
    Error,
}

/// Characters a line of a stream has room for: what `COLUMNS` says, else the terminal; `None`
/// where it is neither said nor a terminal.
fn width(stream: Stream) -> Option<usize> {
    let said = std::env::var("COLUMNS").ok();
    let said = said.and_then(|said| said.parse().ok());
    said.or_else(|| terminal_width(stream))
        .filter(|width| *width >= 20)
}

#[cfg(not(target_family = "wasm"))]
fn terminal_width(stream: Stream) -> Option<usize> {
    let (terminal, shown) = match stream {
        Stream::Output => (::console::Term::stdout(), std::io::stdout().is_terminal()),
        Stream::Error => (::console::Term::stderr(), std::io::stderr().is_terminal()),
    };
    let size = terminal.size_checked().filter(|_| shown);
    size.map(|(_, columns)| usize::from(columns))
}

/// A browser tab has no terminal.
#[cfg(target_family = "wasm")]
fn terminal_width(_: Stream) -> Option<usize> {
    None
}

/// Result of a write to standard output.
fn checked(written: std::io::Result<()>) -> Result<(), Failure> {
    match written {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => Err(Failure::Output(format!(
            "cannot write to standard output: {error}"
        ))),
        _ => Ok(()),
    }
}

/// Writes one JSON document to standard output.
///
/// # Errors
/// Those of [`data`].
pub(crate) fn json(document: &impl serde::Serialize) -> Result<(), Failure> {
    let text = serde_json::to_string_pretty(document).map_err(|error| error.to_string())?;
    json_text(&(text + "\n"))
}

/// Writes the text of a JSON document to standard output.
///
/// # Errors
/// Those of [`data`].
pub(crate) fn json_text(text: &str) -> Result<(), Failure> {
    data(&escaped_for_terminal(text))
}

/// JSON in which what a terminal would obey, as far as JSON lets it stand in a string, is
/// escaped.
fn escaped_for_terminal(json: &str) -> String {
    let mut text = String::with_capacity(json.len());
    for c in json.chars() {
        match c {
            c if is_harmful(c) && c != '\n' => text.push_str(&format!("\\u{:04x}", u32::from(c))),
            c => text.push(c),
        }
    }
    text
}

/// Says something on standard error, in the width of the terminal.
pub(crate) fn print_message(text: &str) {
    let text = printable(text);
    match width(Stream::Error) {
        Some(width) => rendered(&fitted(&text, width)),
        None => rendered(&text),
    }
}

impl Failure {
    /// Tells people.
    pub(crate) fn print_message(&self) {
        match self {
            Self::Scene(diagnostics) => diagnose(diagnostics),
            Self::Other(message) | Self::Output(message) => {
                print_message(&format!("error: {message}\n"));
            }
        }
    }
}

/// Says on standard error what is wrong or doubtful in a scene.
pub(crate) fn diagnose(diagnostics: &Diagnostics) {
    rendered(&diagnostics.render(colour()));
}

fn rendered(text: &str) {
    // Where there is nobody to talk to there is nothing to do about it.
    let _ = writeln!(std::io::stderr().lock(), "{}", text.trim_end());
}

/// True when standard error understands colours.
fn colour() -> bool {
    std::io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none()
}

#[cfg(test)]
mod tests {
    use super::escaped_for_terminal;

    #[test]
    fn json_keeps_its_meaning_without_control_characters() {
        let name = "a\u{1b}[31m\u{9b}31m\u{7f}é\n\"";
        let text = serde_json::to_string_pretty(&serde_json::json!({ "name": name })).unwrap();
        let safe = escaped_for_terminal(&text);
        assert!(!safe.chars().any(|c| c.is_control() && c != '\n'));
        let back: serde_json::Value = serde_json::from_str(&safe).unwrap();
        assert_eq!(back["name"], name);
    }
}
