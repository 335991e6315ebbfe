//! Hash of the canonical form.

use sha2::{Digest, Sha256};
use std::fmt::Write;

/// SHA-256 of the canonical scene, in hexadecimal.
pub(super) fn hash(canonical: &serde_json::Value) -> String {
    let mut text = String::new();
    write_sorted(canonical, &mut text);
    let mut hash = String::new();
    for byte in Sha256::digest(text.as_bytes()) {
        // Writing to a string cannot fail.
        let _ = write!(hash, "{byte:02x}");
    }
    hash
}

/// JSON with sorted names, whatever order the map type keeps.
fn write_sorted(value: &serde_json::Value, out: &mut String) {
    use serde_json::Value as Json;
    match value {
        Json::Object(map) => {
            let mut names: Vec<&String> = map.keys().collect();
            names.sort();
            out.push('{');
            for name in names {
                out.push_str(&Json::String(name.clone()).to_string());
                out.push(':');
                write_sorted(&map[name], out);
                out.push(',');
            }
            out.push('}');
        }
        Json::Array(items) => {
            out.push('[');
            for item in items {
                write_sorted(item, out);
                out.push(',');
            }
            out.push(']');
        }
        other => out.push_str(&other.to_string()),
    }
}
