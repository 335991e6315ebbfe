//! Golden texts of diagnostics: every scene in `tests/diagnostics/` is wrong,
//! and must be refused (or warned of) in exactly the words beside it.
//!
//! `DAM_BLESS=1 cargo test --test program diagnostics` writes the texts anew; read them
//! before they are committed. `NAME.set` beside `NAME.json` holds overrides,
//! one a line.

use dam::diagnostics::{Diagnostic, Diagnostics};
use dam::scene::{BuiltIn, Catalogue, Document, NamedBytes, Overrides};
use std::borrow::Cow;
use std::path::{Path, PathBuf};
use std::{env, fs};

/// A small catalogue, sound and otherwise.
struct TestCatalogue;

const CATALOGUE: &[(&str, &str)] = &[
    (
        "rocker/lever",
        r#"{
  "description": "a steel lever",
  "source": "dimensions and material",
  "kind": "rocker",
  "geometry": { "length": "205 mm", "width": "47 mm", "height": "94 mm", "density": "7.85 g/cm^3", "modulus": "206 GPa" },
  "damping_capacity": 0.4
}
"#,
    ),
    (
        "rocker/faulty",
        "{\n  \"kind\": \"rocker\",\n  \"inertia\": \"0.1 kg\",\n  \"stifness\": 1e7\n}\n",
    ),
    ("rocker/nested", "{ \"from\": \"rocker/lever\" }\n"),
    ("rocker/broken", "{ \"kind\": \"rocker\", }\n"),
];

/// Tables beside the scenes.
const TABLES: &[(&str, &[u8])] = &[
    ("empty.csv", b"\n\n"),
    ("headless.csv", b"0,1\n1,2\n"),
    ("ragged.csv", b"angle [deg],lift [mm]\n0,0\n10\n20,2,5\n"),
    (
        "words.csv",
        b"angle [deg],lift [mm]\n0,zero\n10,NaN\n20,\n30,1e999\n40,1 mm\n",
    ),
    ("commas.csv", b"angle [deg];lift [mm]\n0;0,5\n10;1.000,5\n"),
    ("quoted.csv", b"angle [deg],lift [mm]\n0,\"0,5\"\n"),
    ("units.csv", b"angle [deg],lift [kg]\n0,0\n"),
    ("strange.csv", b"angle [deg],lift [furlong]\n0,0\n"),
    ("open.csv", b"angle [deg,lift\n0,0\n"),
    (
        "three.csv",
        b"angle [deg]\tlift [mm]\tforce [N]\n0\t0\t1\n1\t0\t2\n2\t1\t1\n",
    ),
    ("twice.csv", b"lift [mm],angle [deg],lift [mm]\n0,0,0\n"),
    ("short.csv", b"angle [deg],lift [mm]\n0,0\n1,1\n"),
    (
        "descending.csv",
        b"# measured\nangle [deg],lift [mm]\n0,0\n2,1\n1,2\n",
    ),
    (
        "rough_table.csv",
        include_bytes!("../diagnostics/rough_table.csv"),
    ),
    ("latin.csv", b"angle [\xb0],lift [mm]\n0,0\n"),
];

impl Catalogue for TestCatalogue {
    fn lookup(&self, name: &str) -> Option<(String, Cow<'_, str>)> {
        let found = CATALOGUE.iter().find(|entry| entry.0 == name)?;
        Some((format!("objects/{name}.json"), Cow::Borrowed(found.1)))
    }

    fn names(&self) -> Vec<String> {
        CATALOGUE.iter().map(|entry| entry.0.to_owned()).collect()
    }

    fn table(&self, name: &str) -> Result<NamedBytes, Box<Diagnostic>> {
        match TABLES.iter().find(|table| table.0 == name) {
            Some((name, text)) => Ok(((*name).to_owned(), text.to_vec())),
            None => BuiltIn.table(name),
        }
    }
}

fn diagnose(name: &str, bytes: &[u8], overrides: &Overrides) -> Diagnostics {
    let document = match Document::parse(name, bytes) {
        Ok(document) => document,
        Err(diagnostics) => return diagnostics,
    };
    match document.scene(&TestCatalogue, overrides) {
        Ok(reading) => reading.warnings,
        Err(diagnostics) => diagnostics,
    }
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/diagnostics")
}

fn scenes() -> Vec<PathBuf> {
    let entries = fs::read_dir(folder()).expect("the folder of scenes");
    let mut scenes: Vec<PathBuf> = entries
        .map(|entry| entry.expect("an entry").path())
        .filter(|path| {
            path.extension()
                .is_some_and(|extension| extension == "json")
        })
        .collect();
    scenes.sort();
    scenes
}

#[test]
fn every_fault_is_said_in_the_agreed_words() {
    let bless = env::var_os("DAM_BLESS").is_some();
    let (mut wrong, mut count) = (Vec::new(), 0);
    for path in scenes() {
        let name = path.file_name().expect("a name").to_string_lossy();
        let bytes = fs::read(&path).expect("a scene");
        let set = fs::read_to_string(path.with_extension("set")).unwrap_or_default();
        let found = diagnose(&name, &bytes, &Overrides::new(set.lines()));
        assert!(!found.is_empty(), "{name}: nothing is wrong with it");
        let text = found.render(false);
        let golden = path.with_extension("txt");
        if bless {
            fs::write(&golden, &text).expect("writing");
        }
        let expected = fs::read_to_string(&golden).unwrap_or_default();
        if text != expected {
            wrong.push(format!("{name}: expected\n{expected}\nfound\n{text}"));
        }
        count += 1;
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(count >= 40, "only {count} faults are tested");
}

#[test]
fn faults_from_later_stages_find_their_place() {
    let text = include_str!("../rocker_scene.json");
    let document = Document::parse("scene.json", text.as_bytes()).expect("JSON");
    let reading = document
        .scene(&TestCatalogue, &Overrides::none())
        .expect("a sound scene");
    let at = |path: &str| {
        let place = reading.places.locate(path);
        &text[place.range]
    };
    assert_eq!(at("rocker.inertia"), "0.1");
    assert_eq!(at("rocker.pair.gap"), "\"pair\"");
    assert_eq!(at("rocker.nothing.at.all"), "\"rocker\"");
    assert_eq!(at("rocker.loads.closing.constant"), "-600");
    assert_eq!(at("run.tolerance"), "1e-8");
    assert_eq!(at("expect[0].value"), "0.00750086");
    assert_eq!(at("?"), "\"objects\"");
    let fault = dam::fault::Fault::new("rocker.loads.closing", "too weak", "more");
    let found = reading.places.diagnose(&[fault]);
    assert!(found.has_errors());
    assert_eq!(found.lines(), ["scene.json:16:18: too weak (more)"]);
}

#[test]
fn colour_and_json_are_offered() {
    let found = diagnose("x.json", b"{ \"dam\": 2 }", &Overrides::none());
    assert!(found.render(true).contains('\u{1b}'));
    assert!(!found.render(false).contains('\u{1b}'));
    let json = found.json();
    assert_eq!(json[0]["line"], 1);
    assert!(
        json.as_array()
            .is_some_and(|all| all.len() == found.items.len())
    );
}
