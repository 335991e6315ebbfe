//! What an addition costs: in how many files of `src` each kind is named, and over how many
//! files the `impl` blocks of a type are spread. The figures may only fall.
//!
//! `DAM_BLESS=1 cargo test --test program prices` writes the lists anew, never with greater
//! figures.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// Kinds, by what names them in code: words within names of items and keys (sentences for readers
/// do not count); or paths and constants, or their keys as texts.
const KINDS: &[(&str, &[&str])] = &[
    (
        "joint",
        &["revolute", "guide", "weld", "gear", "belt", "rack"],
    ),
    (
        "load law",
        &[
            "LoadLaw::Linear",
            "LoadLaw::Function",
            "LoadLaw::Pieces",
            "LoadLaw::Stop",
            "LoadLaw::Written",
            "LoadLaw::Dry",
        ],
    ),
    (
        "contact law",
        &[
            "ELASTIC",
            "KELVIN_VOIGT",
            "HUNT_CROSSLEY",
            "HERTZ",
            "RESTITUTION",
        ],
    ),
    (
        "contact form",
        &[
            "ContactForm::Proportional",
            "ContactForm::Power",
            "ContactForm::Rigid",
        ],
    ),
    (
        "object",
        &[
            "crank",
            "rocker",
            "slider",
            "follower",
            "differential",
            "linkage",
        ],
    ),
    (
        "position function",
        &[
            "Position::Ratio",
            "Position::Sine",
            "Position::Polynomial",
            "Position::Table",
            "Position::SliderCrank",
            "Position::FourBar",
            "Position::SlottedLink",
            "Position::Cam",
            "Position::Plan",
            "Position::Linkage",
            "Position::Custom",
        ],
    ),
    (
        "study",
        &[
            "studies::steady",
            "studies::forces",
            "studies::kinematics",
            "studies::methods",
            "studies::reduce",
            "studies::map",
            "studies::compare",
            "studies::law",
            "studies::cam",
        ],
    ),
];

/// Words that name something else in some folders and files.
const FOREIGN: &[(&str, &[&str])] = &[
    // Planetary gears as objects of their own.
    ("gear", &["src/frontend/object/differential"]),
    // The folder of linkages itself.
    ("linkage", &["src/kinematics/linkage/"]),
    // Guides of the followers of disc cams.
    (
        "guide",
        &[
            "src/kinematics/cam/",
            "src/studies/cam/",
            "src/report/cam/",
            "src/report/machine/",
            "src/cli/cam/",
            "src/ask/cam.rs",
            "src/frontend/object/cam_geometry.rs",
        ],
    ),
];

/// Files over which the `impl` blocks of a type may be spread without being listed.
const SPREAD: usize = 3;

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// Code of every file of `src`, without tests and comments, by its path.
fn sources() -> BTreeMap<String, String> {
    let mut found = BTreeMap::new();
    collect(&root().join("src"), &mut found);
    found
}

fn collect(folder: &Path, found: &mut BTreeMap<String, String>) {
    for entry in std::fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("an entry").path();
        let stem = path
            .file_stem()
            .and_then(|stem| stem.to_str())
            .expect("a name");
        let of_tests = ["tests", "testing", "fixture"].contains(&stem)
            || stem.ends_with("_tests")
            || stem.starts_with("testing_");
        if of_tests {
            continue;
        }
        if path.is_dir() {
            collect(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            let text = std::fs::read_to_string(&path).expect("a source");
            let name = path.strip_prefix(root()).expect("below the root");
            found.insert(name.display().to_string(), code_of(&text));
        }
    }
}

/// A source up to its tests, without comments.
fn code_of(text: &str) -> String {
    let mut code = String::new();
    let mut lines = text.lines().peekable();
    while let Some(line) = lines.next() {
        let opens_tests = line == "#[cfg(test)]"
            && lines
                .peek()
                .is_some_and(|next| next.starts_with("mod ") && next.ends_with('{'));
        if opens_tests {
            break;
        }
        let bare = line.trim_start();
        // (Documents are named after what they are for.)
        if !bare.starts_with("//") && !bare.contains("include_str!") {
            code.push_str(line.split(" // ").next().unwrap_or(line));
            code.push('\n');
        }
    }
    code
}

/// The words of all names in a text: `GearPair` and `gear_pairs` both have `gear`.
fn words(code: &str) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    let mut word = String::new();
    let mut before_is_small = false;
    for letter in code.chars().chain([' ']) {
        let begins = letter.is_uppercase() && before_is_small;
        if begins || !letter.is_alphabetic() {
            let own = std::mem::take(&mut word);
            found.insert(own.trim_end_matches('s').to_owned());
        }
        if letter.is_alphabetic() {
            word.extend(letter.to_lowercase());
        }
        before_is_small = letter.is_lowercase();
    }
    found
}

/// True when a code has a path, which ends there and may begin anywhere but in a name.
fn has_path(code: &str, path: &str) -> bool {
    let is_name = |c: char| c.is_alphanumeric() || c == '_';
    code.match_indices(path).any(|(at, _)| {
        let before = code[..at].chars().next_back();
        let after = code[at + path.len()..].chars().next();
        !before.is_some_and(is_name) && !after.is_some_and(is_name)
    })
}

/// A code without the sentences in it: texts that contain a space.
fn without_sentences(code: &str) -> String {
    let mut found = String::new();
    let mut rest = code;
    while let Some(at) = rest.find('"') {
        found.push_str(&rest[..at]);
        let text = &rest[at + 1..];
        let mut escaped = false;
        let end = text.find(|letter: char| {
            let ends = letter == '"' && !escaped;
            escaped = letter == '\\' && !escaped;
            ends
        });
        let end = end.unwrap_or(text.len());
        // (A quotation mark as a letter is no text.)
        let is_letter = rest[..at].ends_with('\'') && text.starts_with('\'');
        if is_letter {
            rest = text;
            continue;
        }
        if !text[..end].contains(' ') {
            found.push_str(&text[..end]);
        }
        found.push(' ');
        rest = text.get(end + 1..).unwrap_or("");
    }
    found + rest
}

/// Number of files that name a kind by a word.
fn named<'a>(kind: &str, files: impl Iterator<Item = (&'a String, &'a BTreeSet<String>)>) -> usize {
    let foreign = FOREIGN.iter().filter(|(word, _)| *word == kind);
    let foreign: Vec<&str> = foreign.flat_map(|(_, paths)| *paths).copied().collect();
    let own = |path: &str| !foreign.iter().any(|folder| path.starts_with(folder));
    files
        .filter(|(path, words)| words.contains(kind) && own(path))
        .count()
}

/// Files that name each kind.
fn kinds(sources: &BTreeMap<String, String>) -> BTreeMap<String, usize> {
    let words: Vec<BTreeSet<String>> = (sources.values())
        .map(|code| words(&without_sentences(code)))
        .collect();
    let mut found = BTreeMap::new();
    for (group, kinds) in KINDS {
        for kind in *kinds {
            let key = format!("\"{}\"", kind.to_lowercase());
            let names = |code: &&String| has_path(code, kind) || code.contains(&key);
            let files = match kind.contains("::") || kind.contains(char::is_uppercase) {
                true => sources.values().filter(names).count(),
                false => named(kind, sources.keys().zip(&words)),
            };
            found.insert(format!("{group}\t{kind}"), files);
        }
    }
    found
}

/// The type of an `impl` block, without its folder and its arguments.
fn type_of(line: &str) -> Option<String> {
    let rest = line.strip_prefix("impl")?;
    let rest = match rest.strip_prefix('<') {
        Some(arguments) => {
            let mut depth = 1;
            let end = arguments.char_indices().find(|(at, letter)| {
                let arrow = *letter == '>' && arguments[..*at].ends_with('-');
                depth += i32::from(*letter == '<') - i32::from(*letter == '>' && !arrow);
                depth == 0
            })?;
            &arguments[end.0 + 1..]
        }
        None => rest.strip_prefix(' ').map(|_| rest)?,
    };
    let own = match rest.split_once(" for ") {
        Some((_, own)) => own,
        None => rest,
    };
    let own = own.trim_start_matches([' ', '&']);
    let end = own.find(|c: char| !(c.is_alphanumeric() || c == '_' || c == ':'));
    let path = &own[..end.unwrap_or(own.len())];
    let name = path.rsplit("::").next().unwrap_or(path);
    name.starts_with(char::is_uppercase)
        .then(|| name.to_owned())
}

/// Files over which the `impl` blocks of a type are spread, where these are many.
fn spreads(sources: &BTreeMap<String, String>) -> BTreeMap<String, usize> {
    let mut files: BTreeMap<String, BTreeSet<&str>> = BTreeMap::new();
    for (path, code) in sources {
        for own in code.lines().filter_map(type_of) {
            files.entry(own).or_default().insert(path);
        }
    }
    let counts = files.into_iter().map(|(own, files)| (own, files.len()));
    counts.filter(|(_, count)| *count > SPREAD).collect()
}

fn read(path: &Path) -> BTreeMap<String, usize> {
    let text = std::fs::read_to_string(path).expect("a list");
    let rows = text.lines().filter_map(|line| line.rsplit_once('\t'));
    rows.map(|(name, count)| (name.to_owned(), count.parse().expect("a count")))
        .collect()
}

/// What has become dearer than a list has it; `least`: what is not listed may be.
fn dearer(now: &BTreeMap<String, usize>, listed: &BTreeMap<String, usize>, least: usize) -> String {
    let mut found = String::new();
    for (name, count) in now {
        let allowed = listed.get(name).copied().unwrap_or(least);
        if *count > allowed {
            let _ = writeln!(found, "{name}: {count} files, {allowed} are allowed");
        }
    }
    found
}

fn check(now: &BTreeMap<String, usize>, list: &str, least: usize) {
    let path = root().join("tests/prices").join(list);
    let found = dearer(now, &read(&path), least);
    assert!(found.is_empty(), "dearer than {list} has it:\n{found}");
    if std::env::var_os("DAM_BLESS").is_some() {
        let rows = now.iter().map(|(name, count)| format!("{name}\t{count}\n"));
        std::fs::write(path, rows.collect::<String>()).expect("the list is written");
    }
}

#[test]
fn kinds_are_named_in_no_more_files() {
    check(&kinds(&sources()), "kinds.tsv", usize::MAX);
}

#[test]
fn types_are_spread_over_no_more_files() {
    check(&spreads(&sources()), "types.tsv", SPREAD);
}

#[test]
fn names_and_types_are_read_off_code() {
    let code =
        code_of("use a; // gear\n/// weld\nstruct BeltDrive;\n#[cfg(test)]\nmod tests {\nrack");
    let words = words(&code);
    assert!(words.contains("belt") && words.contains("drive"));
    assert!(!words.contains("gear") && !words.contains("weld") && !words.contains("rack"));
    let said = without_sentences(r#"key("rack", "A gear and a \"belt\"", '"') + weld"#);
    assert_eq!(said, "key(rack ,  , '') + weld");
    let file = (
        "src/kinematics/cam/spec.rs".to_owned(),
        BTreeSet::from(["guide".to_owned()]),
    );
    assert_eq!(named("guide", std::iter::once((&file.0, &file.1))), 0);
    assert!(has_path("a(LoadLaw::Spring { x })", "LoadLaw::Spring"));
    assert!(!has_path("a(LoadLaw::Springs)", "LoadLaw::Spring"));
    assert!(!has_path("a(OwnLoadLaw::Spring)", "LoadLaw::Spring"));
    for (line, own) in [
        ("impl Frozen {", Some("Frozen")),
        ("impl<'a, T: Fn(f64) -> f64> Run<'a, T> {", Some("Run")),
        ("impl<D: Dynamics> super::Run<'_, D> {", Some("Run")),
        ("impl From<Fault> for Error {", Some("Error")),
        ("implement(x)", None),
    ] {
        assert_eq!(type_of(line).as_deref(), own, "{line}");
    }
    let now = BTreeMap::from([("a".to_owned(), 4)]);
    let listed = BTreeMap::from([("a".to_owned(), 3)]);
    assert!(!dearer(&now, &listed, 3).is_empty());
    assert!(dearer(&listed, &now, 3).is_empty());
}
