//! The pages of reference: made from the declarations, with every kind, property, result and code, and with examples
//! that the program finds right.

use super::words;
use dam::diagnostics::CODES;
use dam::object::Registry;
use dam::record::Figure;
use dam::scene::schema;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn dam(arguments: &[&str]) -> std::process::Output {
    Command::new(env!("CARGO_BIN_EXE_dam"))
        .args(arguments)
        .current_dir(root())
        .output()
        .unwrap()
}

fn described(what: &str) -> Value {
    let output = dam(&["schema", "--of", what]);
    assert_eq!(output.status.code(), Some(0));
    serde_json::from_slice(&output.stdout).unwrap()
}

/// Folder of the pages, made once by docs/reference.py, which checks the scenes of its examples.
fn folder() -> &'static Path {
    static MADE: OnceLock<tempfile::TempDir> = OnceLock::new();
    let made = MADE.get_or_init(|| {
        let folder = tempfile::tempdir().unwrap();
        let python = std::env::var("PYTHON").unwrap_or_else(|_| "python3".to_owned());
        let made = Command::new(python)
            .arg(root().join("docs/reference.py"))
            .args(["--dam", env!("CARGO_BIN_EXE_dam"), "--out"])
            .arg(folder.path())
            .output()
            .expect("Python 3.11 or later, as for the site");
        let error = String::from_utf8_lossy(&made.stderr);
        assert!(made.status.success(), "{error}");
        folder
    });
    made.path()
}

/// The pages by their names.
fn pages() -> BTreeMap<String, String> {
    let entries = std::fs::read_dir(folder()).unwrap();
    let page = |path: PathBuf| {
        let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
        (name, std::fs::read_to_string(path).unwrap())
    };
    entries.map(|entry| page(entry.unwrap().path())).collect()
}

/// The last parts of the names in the first column of a page's tables: `gap` of `pair.gap`.
fn properties(page: &str) -> BTreeSet<&str> {
    let rows = page.lines().filter_map(|line| line.strip_prefix("| `"));
    let names = rows.filter_map(|row| row.split('`').next());
    names
        .map(|name| name.rsplit('.').next().unwrap_or(name))
        .collect()
}

fn names(schema: &Value, found: &mut BTreeSet<String>) {
    match schema {
        Value::Object(map) => {
            if let Some(own) = map.get("properties").and_then(Value::as_object) {
                found.extend(own.keys().cloned());
            }
            map.values().for_each(|value| names(value, found));
        }
        Value::Array(items) => items.iter().for_each(|item| names(item, found)),
        _ => {}
    }
}

#[test]
fn every_property_of_every_kind_has_its_row() {
    let schema = schema(&Registry::standard());
    let pages = pages();
    let mut kinds = 0;
    for (name, definition) in schema["$defs"].as_object().unwrap() {
        let own = definition["properties"].as_object();
        if !own.is_some_and(|own| own.contains_key("kind")) {
            continue;
        }
        kinds += 1;
        let page = &pages[&name.replace('_', "-")];
        let shown = properties(page);
        for property in own.unwrap().keys() {
            assert!(shown.contains(property.as_str()), "{name}.{property}");
        }
    }
    assert!(kinds >= 8, "{kinds} kinds");
    let shown: BTreeSet<&str> = pages.values().flat_map(|page| properties(page)).collect();
    let mut all = BTreeSet::new();
    names(&schema["$defs"], &mut all);
    for part in ["run", "steady", "expect"] {
        names(&schema["properties"][part], &mut all);
    }
    assert!(all.len() > 200, "{} properties", all.len());
    for property in all {
        assert!(shown.contains(property.as_str()), "{property}");
    }
}

/// What stands at `objects.rocker.loads` of a scene.
fn at<'a>(scene: &'a Value, path: &str) -> Option<&'a Value> {
    let mut here = scene;
    for part in path.replace('[', ".[").split('.') {
        here = match part.strip_prefix('[').and_then(|own| own.strip_suffix(']')) {
            Some(index) => here.get(index.parse::<usize>().ok()?)?,
            None => here.get(part)?,
        };
    }
    Some(here)
}

/// Examples of a page: scene, path, text.
fn examples(page: &str) -> Vec<(&str, &str, &str)> {
    let mut found = Vec::new();
    for part in page.split("From `").skip(1) {
        let (scene, rest) = part.split_once("`, `").unwrap();
        let (path, rest) = rest.split_once("`:").unwrap();
        let (_, rest) = rest.split_once("```json\n").unwrap();
        found.push((scene, path, rest.split_once("```").unwrap().0));
    }
    found
}

/// Only a scene of another test has all properties; it is read there and never run.
const ONLY_READ: &str = "tests/schema_scene.json";

#[test]
fn examples_are_parts_of_scenes_that_the_program_finds_right() {
    let mut scenes = BTreeSet::new();
    let (mut count, mut only_read) = (0, 0);
    let pages = pages();
    for (name, page) in &pages {
        for (scene, path, text) in examples(page) {
            let whole = std::fs::read_to_string(root().join(scene)).unwrap();
            let whole: Value = serde_json::from_str(&whole).unwrap();
            let shown: Value = serde_json::from_str(text).unwrap();
            let own = at(&whole, path).unwrap_or_else(|| panic!("{name}: {scene}: {path}"));
            // (A form is shown with its name.)
            let last = path.rsplit('.').next().unwrap();
            let inner = shown.get(last).filter(|_| shown != *own);
            assert_eq!(inner.unwrap_or(&shown), own, "{name}: {scene}: {path}");
            count += 1;
            match scene {
                ONLY_READ => only_read += 1,
                _ => _ = scenes.insert(scene.to_owned()),
            }
        }
    }
    assert!(count > 50 && only_read * 4 < count, "{count} {only_read}");
    for scene in scenes {
        let output = dam(&["check", &scene, "--quiet"]);
        let error = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(0), "{scene}: {error}");
    }
}

#[test]
fn pages_are_written_in_short_sentences() {
    for name in pages().keys() {
        let faults = words::faults_of_guide(&folder().join(format!("{name}.md")));
        assert!(faults.is_empty(), "{}", faults.join("\n"));
    }
}

/// Addresses of a list of results.
fn addresses(results: &Value, list: &str) -> Vec<String> {
    let rows = results[list].as_array().unwrap();
    let addresses: Vec<String> = rows
        .iter()
        .map(|row| {
            assert!(row["meaning"].as_str().unwrap().ends_with('.'), "{row}");
            assert!(!row["units"].as_array().unwrap().is_empty(), "{row}");
            row["address"].as_str().unwrap().to_owned()
        })
        .collect();
    let once: BTreeSet<&String> = addresses.iter().collect();
    assert_eq!(once.len(), addresses.len(), "{list}: an address twice");
    addresses
}

/// Whether an address is one of a declared form: words in capitals stand for any name.
fn is_of(address: &str, form: &str) -> bool {
    let (parts, forms): (Vec<&str>, Vec<&str>) =
        (address.split('.').collect(), form.split('.').collect());
    let fits = |(part, form): (&&str, &&str)| {
        let stands_for_any = form.chars().all(|own| own.is_ascii_uppercase());
        stands_for_any || part == form
    };
    parts.len() == forms.len() && parts.iter().zip(&forms).all(fits)
}

#[test]
fn every_result_of_objects_is_declared_once() {
    let results = described("results");
    let mut declared = addresses(&results, "object");
    declared.extend(addresses(&results, "stop"));
    for figure in Figure::ALL {
        let of_object = declared.contains(&format!("OBJECT.{figure}"));
        let of_stop = declared.contains(&format!("OBJECT.STOP.{figure}"));
        assert!(of_object || of_stop, "{figure}");
    }
}

/// Declared forms that results of a linkage are found by, and results that it has.
fn of_study(command: &str, scene: &str) -> BTreeSet<String> {
    let output = dam(&[command, scene, "--json", "--quiet"]);
    let found: Value = serde_json::from_slice(&output.stdout).unwrap();
    let mut results = BTreeSet::new();
    let mut add = |name: &str| _ = results.insert(format!("{command}.it.{name}"));
    match command {
        "forces" => {
            for name in found["extremes"].as_object().unwrap().keys() {
                add(&format!("{name}.greatest"));
            }
            for name in found["cycle"].as_object().unwrap().keys() {
                if !["is_cycle", "losses", "closed", "whole"].contains(&name.as_str()) {
                    add(&format!("cycle.{name}"));
                }
            }
        }
        _ => {
            for name in found["columns"].as_object().unwrap().keys() {
                add(&format!("{name}.greatest"));
            }
        }
    }
    results
}

#[test]
fn every_result_of_a_linkage_has_a_declared_form() {
    let results = described("results");
    let (mut count, mut used) = (0, BTreeSet::new());
    for command in ["kinematics", "forces"] {
        let forms = addresses(&results, command);
        for scene in [
            "scenarios/kinetostatics/slider_crank.json",
            "scenarios/linkages/five_bar.json",
            "scenarios/linkages/eccentric_cam.json",
            "scenarios/linkages/shaper.json",
        ] {
            for address in of_study(command, scene) {
                let form = forms.iter().find(|form| is_of(&address, form));
                used.insert(form.unwrap_or_else(|| panic!("{scene}: {address}")).clone());
                count += 1;
            }
        }
    }
    assert!(count > 200 && used.len() > 40, "{count} {}", used.len());
}

/// Source files of the library and the program, without their tests.
fn sources(folder: &Path, found: &mut Vec<String>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap();
        if path.is_dir() {
            if name != "tests" {
                sources(&path, found);
            }
        } else if name.ends_with(".rs") && !name.ends_with("tests.rs") && name != "codes.rs" {
            let text = std::fs::read_to_string(&path).unwrap();
            found.push(text.split("#[cfg(test)]").next().unwrap().to_owned());
        }
    }
}

/// Arguments of a call whose opening bracket is before `text`.
fn arguments(text: &str) -> Vec<&str> {
    let (mut depth, mut within, mut start, mut found) = (0, false, 0, Vec::new());
    let bytes = text.as_bytes();
    let mut at = 0;
    while at < bytes.len() {
        match bytes[at] {
            b'\\' if within => at += 1,
            b'"' => within = !within,
            _ if within => {}
            b'(' | b'[' | b'{' => depth += 1,
            b')' | b']' | b'}' if depth > 0 => depth -= 1,
            b',' if depth == 0 => {
                found.push(text[start..at].trim());
                start = at + 1;
            }
            b')' => {
                found.push(text[start..at].trim());
                break;
            }
            _ => {}
        }
        at += 1;
    }
    found.retain(|own| !own.is_empty());
    found
}

/// A text that is a code: small letters and hyphens.
fn code(text: &str) -> Option<&str> {
    let inner = text.strip_prefix('"')?.strip_suffix('"')?;
    let is_code = inner
        .chars()
        .all(|own| own.is_ascii_lowercase() || "-8".contains(own));
    (is_code && !inner.is_empty()).then_some(inner)
}

/// Codes that the sources give to messages: the argument before the message.
fn used_codes(sources: &[String]) -> BTreeSet<String> {
    let calls = [
        ".refuse(",
        ".refuse_item(",
        ".warn(",
        "Diagnostic::error(",
        "Diagnostic::warning(",
        " => one(",
    ];
    let mut found = BTreeSet::new();
    for text in sources {
        for call in calls {
            for (at, _) in text.match_indices(call) {
                let all = arguments(&text[at + call.len()..]);
                // `one` is asked with its message last too.
                if let [.., own, _] = all[..] {
                    found.extend(code(own).map(str::to_owned));
                }
            }
        }
        // `fault("wrong-type", message)`, `code: "model"`, ("missing-unit", …).
        for mark in ["fault(", "code: ", "_TRUSTED: &str = "] {
            for (at, _) in text.match_indices(mark) {
                let rest = text[at + mark.len()..].trim_start();
                let end = rest.get(1..).and_then(|rest| rest.find('"'));
                let literal = end.and_then(|end| rest.get(..end + 2));
                let literal = literal.filter(|own| own.contains('-') || *own == "\"model\"");
                found.extend(literal.and_then(code).map(str::to_owned));
            }
        }
    }
    found
}

/// Codes that are chosen before the call: `src/frontend/read/number.rs`.
const CHOSEN: [&str; 6] = [
    "ambiguous-unit",
    "missing-unit",
    "not-a-number",
    "not-finite",
    "unknown-unit",
    "wrong-unit",
];

#[test]
fn every_code_of_a_message_has_one_row_with_cause_and_remedy() {
    let mut texts = Vec::new();
    sources(&root().join("src"), &mut texts);
    let number = std::fs::read_to_string(root().join("src/frontend/read/number.rs")).unwrap();
    let mut used = used_codes(&texts);
    for chosen in CHOSEN {
        assert!(number.contains(&format!("\"{chosen}\"")), "{chosen}");
        used.insert(chosen.to_owned());
    }
    // No other is chosen there.
    for literal in number
        .split('"')
        .filter(|own| own.contains('-') && !own.contains(' '))
    {
        let quoted = format!("\"{literal}\"");
        if let Some(code) = code(&quoted) {
            assert!(used.contains(code), "{code}");
        }
    }
    // What messages of wrong scenes show.
    for entry in std::fs::read_dir(root().join("tests/diagnostics")).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|own| own == "txt") {
            let text = std::fs::read_to_string(path).unwrap();
            for mark in ["error[", "warning["] {
                let codes = text.split(mark).skip(1);
                let codes = codes.filter_map(|rest| rest.split(']').next());
                used.extend(codes.map(str::to_owned));
            }
        }
    }
    let declared: Vec<&str> = CODES.iter().map(|code| code.name).collect();
    let sorted: BTreeSet<&str> = declared.iter().copied().collect();
    assert_eq!(
        sorted.iter().copied().collect::<Vec<_>>(),
        declared,
        "in order, each once"
    );
    let used: BTreeSet<&str> = used.iter().map(String::as_str).collect();
    let without: Vec<_> = used.difference(&sorted).collect();
    let unused: Vec<_> = sorted.difference(&used).collect();
    assert!(
        without.is_empty() && unused.is_empty(),
        "{without:?} {unused:?}"
    );
    let page = &pages()["codes"];
    for code in CODES {
        assert!(code.cause.ends_with('.') && code.remedy.ends_with('.'));
        let row = format!("| `{}` | {} |", code.name, code.cause);
        assert_eq!(page.matches(&row).count(), 1, "{}", code.name);
    }
}

#[test]
fn the_argument_before_the_message_is_the_code() {
    let text = r#"slot.refuse("bad-id", format!("`{}`, not", name)); fields.refuse("inputs", "two-ways", "a, b");
        return fault("wrong-type", message); code: "model", x.refuse(object, reason)"#;
    let found: Vec<String> = used_codes(&[text.to_owned()]).into_iter().collect();
    assert_eq!(found, ["bad-id", "model", "two-ways", "wrong-type"]);
}

#[test]
fn the_glossary_has_each_term_in_three_languages() {
    let path = root().join("docs/site/reference/glossary.md");
    let text = std::fs::read_to_string(&path).unwrap();
    let rows: Vec<Vec<&str>> = text
        .lines()
        .filter(|line| line.starts_with("| "))
        .skip(2)
        .map(|line| line.trim_matches('|').split('|').map(str::trim).collect())
        .collect();
    assert!((40..=60).contains(&rows.len()), "{} rows", rows.len());
    let terms: Vec<&str> = rows.iter().map(|row| row[0]).collect();
    let sorted: BTreeSet<&str> = terms.iter().copied().collect();
    assert_eq!(sorted.len(), rows.len(), "each once");
    for row in &rows {
        let [_, _, meaning, german, russian] = row[..] else {
            panic!("{row:?}");
        };
        assert!(!meaning.is_empty() && !german.is_empty(), "{row:?}");
        let is_russian = |own: char| ('а'..='я').contains(&own) || own == 'ё';
        assert!(russian.chars().any(is_russian), "{row:?}");
    }
    assert!(words::faults_of_guide(&path).is_empty());
}
