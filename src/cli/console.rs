//! Standard output is data, standard error is talk.

use std::io::{IsTerminal, Write};

/// Writes data to standard output. A reader that has gone away (`dam … | head`)
/// is no error of ours.
pub(crate) fn data(text: &str) {
    let _ = std::io::stdout().lock().write_all(text.as_bytes());
}

/// Writes one JSON document to standard output.
pub(crate) fn json(document: &impl serde::Serialize) -> Result<(), String> {
    let mut text = serde_json::to_string_pretty(document).map_err(|error| error.to_string())?;
    text.push('\n');
    data(&text);
    Ok(())
}

/// Says something on standard error.
pub(crate) fn talk(text: &str) {
    let _ = writeln!(std::io::stderr().lock(), "{}", text.trim_end());
}

/// True when standard error understands colours.
pub(crate) fn colour() -> bool {
    std::io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none()
}
