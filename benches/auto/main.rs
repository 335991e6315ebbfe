//! Does `method: auto` choose well? On every scenario that has something to
//! integrate, at tolerances 1e-4, 1e-7 and 1e-10: the time of `auto` over that
//! of the fastest method that converges by `dam methods`: given that tolerance it comes to
//! the end with all switches and an error of δ within it. The same is asked of `auto`,
//! which gives its method a finer tolerance; an error that exceeds the one asked for is
//! marked `!`. Where no method keeps the tolerance when given it, there is no ratio.
//!
//! `cargo bench -p dam-benches --bench auto [-- PART_OF_NAME] [--own] [--chart] [--markdown]`: a
//! line a scenario and tolerance, and in the end the greatest ratios. With `--features diffsol` the
//! methods of diffsol are among them, unless `--own` leaves them out; `--chart` prints every method and the reason of the choice as well.
//!
//! Two times are told, both from the checked scene on (reading one is the same for all):
//!
//! - *run*: what a user waits for, [`run`]: the choice of the method, the start,
//!   the motion, samples, figures and energy audit. `auto` is run as `auto`.
//! - *motion*: from the start to all samples and switch times, without figures, as
//!   `dam methods` times it. Preparing exact propagation counts.
//!
//! Where nothing else fits, `auto` may combine exact propagation of some branches
//! with a method for the rest; no other method can be asked for that, and only its run is timed.
//!
//! The machine may be busy: the methods take turns, and the least of many times
//! counts.

#![allow(clippy::print_stdout)] // the table is what it is run for

mod judge;

use dam::lower::lower;
use dam::scene::{BuiltIn, Document, Overrides};
use dam::studies::RunSettings;
use dam::system::System;
use judge::{Line, Worst};
use std::path::{Path, PathBuf};

/// A scenario made ready.
pub(crate) struct Case {
    pub(crate) name: String,
    pub(crate) system: System,
    pub(crate) settings: RunSettings,
}

impl Case {
    /// `None`: nothing in it is run, or not by a choice of the program's.
    fn load(path: &Path, root: &Path) -> Option<Self> {
        let bytes = std::fs::read(path).ok()?;
        let document = Document::parse(&path.display().to_string(), &bytes).ok()?;
        let scene = document.scene(&BuiltIn, &Overrides::none()).ok()?.scene;
        let system = System::new(lower(&scene).ok()?).ok()?;
        let settings = RunSettings::of(&scene).ok()?;
        let name = path.strip_prefix(root).ok()?.with_extension("");
        Some(Self {
            name: name.display().to_string(),
            system,
            settings: RunSettings {
                method: None,
                step: None,
                ..settings
            },
        })
    }
}

fn scenarios(folder: &Path, out: &mut Vec<PathBuf>) {
    let Ok(entries) = std::fs::read_dir(folder) else {
        return;
    };
    for entry in entries.flatten() {
        let path = entry.path();
        if path.is_dir() {
            scenarios(&path, out);
        } else if path.extension().is_some_and(|kind| kind == "json") {
            out.push(path);
        }
    }
    out.sort();
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let has = |flag: &str| arguments.iter().any(|argument| argument == flag);
    let part = arguments.iter().find(|text| !text.starts_with("--"));
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenarios");
    let mut paths = Vec::new();
    scenarios(&root, &mut paths);
    let mut worst = Worst::default();
    let markdown = has("--markdown");
    println!("{}", Line::head(markdown));
    for path in paths {
        let Some(case) = Case::load(&path, &root) else {
            continue;
        };
        if part.is_some_and(|part| !case.name.contains(part.as_str())) {
            continue;
        }
        for line in judge::judge(&case, has("--chart"), has("--own")) {
            worst.add(&line);
            println!("{}", line.text(markdown));
        }
    }
    println!("{worst}");
}
