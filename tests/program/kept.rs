//! Results of all scenarios as they were: nothing that is put in order may change them.
//!
//! `DAM_KEPT=strict` compares to 1e-12 of the scale of each figure, and counts exactly: on the
//! machine that the list was written on. Else rounding, which differs between processors, may
//! move a motion within the tolerance of its run, and by more where impacts magnify it.
//! `DAM_BLESS=1` writes the list anew.

use dam::lower::lower;
use dam::record::Figures;
use dam::scene::{BuiltIn, Document, Folder, LayeredCatalogue, Overrides};
use dam::studies::run::run;
use dam::studies::{Control, RunSettings};
use dam::system::System;
use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// Differences allowed on the machine of the list, and on others.
const STRICT: f64 = 1e-12;
const LOOSE: f64 = 1e-4;

/// Share by which counts of steps and evaluations may differ on other machines, and by how
/// much at least.
const COUNTS: f64 = 0.1;
const FEW: f64 = 4.0;

fn list() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/reference/kept.tsv")
}

fn figures(path: &Path) -> Figures {
    let bytes = std::fs::read(path).expect("a scene");
    let document = Document::parse(&path.display().to_string(), &bytes).expect("a document");
    let reading = document
        .scene(
            &LayeredCatalogue(&Folder::beside_scene(path), &BuiltIn),
            &Overrides::none(),
        )
        .expect("a scene");
    let system = System::new(lower(&reading.scene).expect("a model")).expect("a system");
    let settings = RunSettings::of(&reading.scene).expect("settings");
    run(&system, &settings, &Control::default(), &mut [])
        .expect("a run")
        .figures
}

/// False of what is a measure of rounding, and of long lists.
fn is_kept(address: &str) -> bool {
    let left_out = [
        "energy_error",
        "equations.",
        "switch_times.",
        "run.tolerance",
    ];
    !left_out.iter().any(|part| address.contains(part))
}

fn is_count(address: &str) -> bool {
    let counts = [
        "run.steps",
        "run.rejected",
        "run.evaluations",
        "run.switches",
    ];
    counts.contains(&address) || address.ends_with(".separations") || address.ends_with(".closures")
}

/// What differs from the list, in a scene.
fn differences(
    name: &str,
    now: &Figures,
    kept: &BTreeMap<String, Option<f64>>,
    is_strict: bool,
) -> String {
    let mut found = String::new();
    let addresses = now.addresses();
    for (address, before) in kept {
        let Some(value) = addresses.get(address) else {
            let _ = writeln!(found, "{name}: {address} is gone");
            continue;
        };
        let scale = now.scale(address).max(1e3 * now.resolution(address));
        let allowed = match (is_strict, is_count(address)) {
            (true, true) => 0.0,
            (true, false) => STRICT * scale,
            (false, true) => (COUNTS * before.unwrap_or(0.0)).max(FEW),
            (false, false) => LOOSE * scale,
        };
        let same = match (value, before) {
            (Some(value), Some(before)) => (value - before).abs() <= allowed,
            (None, None) => true,
            _ => false,
        };
        if !same {
            let _ = writeln!(found, "{name}: {address} is {value:?}, was {before:?}");
        }
    }
    found
}

fn read() -> BTreeMap<String, BTreeMap<String, Option<f64>>> {
    let mut found: BTreeMap<String, BTreeMap<String, Option<f64>>> = BTreeMap::new();
    let text = std::fs::read_to_string(list()).unwrap_or_default();
    for line in text.lines() {
        let mut parts = line.split('\t');
        let (Some(name), Some(address), Some(value)) = (parts.next(), parts.next(), parts.next())
        else {
            panic!("a line of the list: {line}");
        };
        let own = found.entry(name.to_owned()).or_default();
        own.insert(address.to_owned(), value.parse().ok());
    }
    found
}

fn write(all: &BTreeMap<String, Figures>) {
    let mut text = String::new();
    for (name, figures) in all {
        for (address, value) in figures.addresses() {
            if is_kept(&address) {
                let value = value.map_or_else(|| "-".to_owned(), |value| format!("{value:?}"));
                let _ = writeln!(text, "{name}\t{address}\t{value}");
            }
        }
    }
    std::fs::write(list(), text).expect("the list is written");
}

#[test]
fn every_scenario_gives_what_it_gave() {
    let scenes = super::scenarios::scenes();
    let next = std::sync::atomic::AtomicUsize::new(0);
    let found = std::sync::Mutex::new(BTreeMap::new());
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                while let Some(path) =
                    scenes.get(next.fetch_add(1, std::sync::atomic::Ordering::Relaxed))
                {
                    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios");
                    let name = path.strip_prefix(root).expect("below scenarios");
                    let name = name.with_extension("").display().to_string();
                    let own = figures(path);
                    found.lock().expect("no panic").insert(name, own);
                }
            });
        }
    });
    let found = found.into_inner().expect("no panic");
    if std::env::var_os("DAM_BLESS").is_some() {
        return write(&found);
    }
    let is_strict = std::env::var("DAM_KEPT").is_ok_and(|own| own == "strict");
    let kept = read();
    let mut differ = String::new();
    for (name, figures) in &found {
        match kept.get(name) {
            Some(own) => differ.push_str(&differences(name, figures, own, is_strict)),
            None => {
                let _ = writeln!(
                    differ,
                    "{name} is not in the list: write it with DAM_BLESS=1"
                );
            }
        }
    }
    for name in kept.keys().filter(|name| !found.contains_key(*name)) {
        let _ = writeln!(differ, "{name} is gone");
    }
    assert!(differ.is_empty(), "{differ}");
}
