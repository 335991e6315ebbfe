//! What is checked before a text is parsed at all.

use crate::frontend::diagnostics::{Diagnostic, Place, SourceId};

/// Largest file that is read (bytes).
pub const MAX_SIZE: usize = 4 * 1024 * 1024;

/// Deepest nesting that is read.
pub const MAX_DEPTH: usize = 64;

/// Decodes a file: UTF-8, of reasonable size, without stray zero bytes. A
/// leading byte-order mark is dropped.
pub(super) fn decode(bytes: &[u8], source: SourceId) -> Result<&str, Vec<Diagnostic>> {
    if bytes.len() > MAX_SIZE {
        let message = format!(
            "the file has {} bytes; at most {MAX_SIZE} (4 MiB) are read",
            bytes.len()
        );
        return Err(vec![Diagnostic::error("too-large", message)]);
    }
    if bytes.starts_with(&[0xFF, 0xFE]) || bytes.starts_with(&[0xFE, 0xFF]) {
        let fault = Diagnostic::error("not-utf8", "the file is UTF-16 text");
        return Err(vec![fault.hint("save it as UTF-8")]);
    }
    let bytes = without_mark(bytes);
    std::str::from_utf8(bytes).map_err(|error| {
        let offset = error.valid_up_to();
        let line = bytes[..offset].iter().filter(|&&b| b == b'\n').count() + 1;
        let message = format!("the file is not UTF-8: byte {offset} (line {line}) is invalid");
        let fault = Diagnostic::error("not-utf8", message);
        let place = Place::new(source, offset..offset + 1);
        vec![fault.at(place).hint("save it as UTF-8")]
    })
}

/// The file without a leading UTF-8 byte-order mark.
pub(super) fn without_mark(bytes: &[u8]) -> &[u8] {
    bytes.strip_prefix(&[0xEF, 0xBB, 0xBF]).unwrap_or(bytes)
}

/// Checks that need no parser: emptiness, zero bytes, depth of nesting.
///
/// The text starts `offset` bytes into its source.
pub(super) fn check(text: &str, source: SourceId, offset: usize) -> Result<(), Vec<Diagnostic>> {
    let place = |at: usize| Place::new(source, at + offset..at + offset + 1);
    if let Some(at) = text.find('\0') {
        let fault = Diagnostic::error("zero-byte", "the text contains a zero byte");
        return Err(vec![
            fault.at(place(at)).hint("is this really a text file?"),
        ]);
    }
    if text.trim().is_empty() {
        let hint = r#"a scene is a JSON object: { "dam": 1, "name": …, "objects": …, "run": … }"#;
        return Err(vec![
            Diagnostic::error("empty", "the text is empty").hint(hint),
        ]);
    }
    match too_deep(text.as_bytes()) {
        None => Ok(()),
        Some(at) => {
            let message = format!("brackets are nested more than {MAX_DEPTH} deep");
            Err(vec![Diagnostic::error("too-deep", message).at(place(at))])
        }
    }
}

/// Byte at which the nesting first exceeds its bound, brackets in texts not counted.
fn too_deep(bytes: &[u8]) -> Option<usize> {
    let (mut depth, mut in_text, mut escaped) = (0usize, false, false);
    for (at, &byte) in bytes.iter().enumerate() {
        if in_text {
            match byte {
                _ if escaped => escaped = false,
                b'\\' => escaped = true,
                b'"' => in_text = false,
                _ => {}
            }
            continue;
        }
        match byte {
            b'"' => in_text = true,
            b'{' | b'[' => depth += 1,
            b'}' | b']' => depth = depth.saturating_sub(1),
            _ => {}
        }
        if depth > MAX_DEPTH {
            return Some(at);
        }
    }
    None
}
