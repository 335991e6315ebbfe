//! Reading of scenes: any bytes end with a scene or with diagnostics.
//!
//! `cargo +nightly fuzz run scene` from the project's root. A first line
//! beginning with `--set ` is taken as an override of the rest.
#![no_main]

use dam::scene::{BuiltIn, Document, Overrides};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|data: &[u8]| {
    let (overrides, bytes) = split(data);
    let found = match Document::parse("fuzz.json", bytes) {
        Ok(document) => match document.scene(&BuiltIn, &overrides) {
            Ok(reading) => reading.warnings,
            Err(diagnostics) => diagnostics,
        },
        Err(diagnostics) => diagnostics,
    };
    assert!(found.is_empty() || !found.render(false).is_empty());
});

fn split(data: &[u8]) -> (Overrides, &[u8]) {
    let override_line = || {
        let rest = data.strip_prefix(b"--set ")?;
        let end = rest.iter().position(|&byte| byte == b'\n')?;
        let argument = std::str::from_utf8(&rest[..end]).ok()?;
        Some((Overrides::new([argument]), &rest[end + 1..]))
    };
    override_line().unwrap_or((Overrides::none(), data))
}
