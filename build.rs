//! Writes the lists of files that are built in: the catalogue (`objects/*/*.json`), and for the
//! studio the scenarios (`scenarios/*/*.json`) with their tables (`scenarios/*/*.csv`).

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::{env, fs, io};

fn main() -> io::Result<()> {
    println!("cargo::rerun-if-changed=build.rs");
    write("objects", "json", "catalogue.rs", "BUILT_IN", "definition")?;
    if env::var_os("CARGO_FEATURE_LIVE").is_some() {
        write("scenarios", "json", "scenarios.rs", "SCENARIOS", "scenario")?;
        write("scenarios", "csv", "tables.rs", "TABLE_FILES", "table")?;
    }
    Ok(())
}

/// Writes the list of the files in the folders of a folder whose names end alike.
fn write(folder: &str, end: &str, list: &str, constant: &str, what: &str) -> io::Result<()> {
    let root = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default());
    let folder = root.join(folder);
    println!("cargo::rerun-if-changed={}", folder.display());
    let mut files = Vec::new();
    collect(&folder, end, &mut files)?;
    // What stands beside the folders is no file of theirs.
    files.retain(|path| path.parent() != Some(&folder));
    let mut names: Vec<(String, &PathBuf)> = files
        .iter()
        .map(|path| (name(&folder, path), path))
        .collect();
    names.sort();
    let mut text = format!(
        "/// Name and text of every built-in {what}, in the order of the names.\n\
         const {constant}: &[(&str, &str)] = &[\n"
    );
    for (name, path) in names {
        let path = path.display().to_string();
        writeln!(text, "    ({name:?}, include_str!({path:?})),").map_err(io::Error::other)?;
    }
    text.push_str("];\n");
    let out = PathBuf::from(env::var_os("OUT_DIR").unwrap_or_default());
    fs::write(out.join(list), text)
}

fn collect(folder: &Path, end: &str, files: &mut Vec<PathBuf>) -> io::Result<()> {
    if !folder.is_dir() {
        return Ok(());
    }
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            collect(&path, end, files)?;
        } else if path.extension().is_some_and(|extension| extension == end) {
            files.push(path);
        }
    }
    Ok(())
}

/// `rocker/steel-lever-205mm`, with `/` on every system.
fn name(folder: &Path, path: &Path) -> String {
    let relative = path.strip_prefix(folder).unwrap_or(path).with_extension("");
    let parts: Vec<_> = relative
        .components()
        .map(|part| part.as_os_str().to_string_lossy().into_owned())
        .collect();
    parts.join("/")
}
