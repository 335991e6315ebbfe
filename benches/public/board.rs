//! Cases that others published: what they stored, what is true, and what `dam` finds.

use dam::prelude::*;
use serde::Deserialize;
use std::path::Path;
use std::time::Instant;

/// A mechanism that others published.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Case {
    /// What it is.
    pub(crate) name: String,
    /// Program that the stored figures are of.
    pub(crate) program: String,
    /// Where they stand.
    pub(crate) source: String,
    /// How the true figures were found.
    pub(crate) truth: String,
    /// Whether something touches, strikes or rubs in it.
    pub(crate) contact_or_friction: bool,
    /// What was learnt of the stored figures; empty: nothing.
    #[serde(default)]
    pub(crate) remark: String,
    /// Its figures.
    pub(crate) figures: Vec<Figure>,
    /// The scene.
    #[serde(skip)]
    pub(crate) scene: String,
}

/// A figure of a case.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Figure {
    /// Time (s).
    pub(crate) at: f64,
    /// Address of the figure in a run of that time.
    pub(crate) figure: String,
    /// The figure as it is stored; none: there is none.
    pub(crate) stored: Option<f64>,
    /// True: it was published as a reference, computed as finely as its authors could.
    #[serde(default)]
    pub(crate) reference: bool,
    /// A unit of the last digit that is stored.
    pub(crate) last_digit: f64,
    /// The true figure.
    pub(crate) truth: f64,
    /// How far that may be off.
    pub(crate) truth_error: f64,
}

/// What a run finds.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Found {
    /// The figure.
    pub(crate) value: f64,
    /// Steps of the integration.
    pub(crate) steps: u64,
    /// Time of the whole run (s).
    pub(crate) seconds: f64,
}

/// All cases, in the order of their folders' names.
pub(crate) fn cases(folder: &Path) -> Vec<Case> {
    let entries = std::fs::read_dir(folder).expect("the folder of the cases");
    let mut folders: Vec<_> = (entries.flatten())
        .map(|entry| entry.path())
        .filter(|path| path.join("case.json").is_file())
        .collect();
    folders.sort();
    let case = |folder: &std::path::PathBuf| {
        let text = |name: &str| std::fs::read_to_string(folder.join(name)).expect(name);
        let case: Case = serde_json::from_str(&text("case.json"))
            .unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
        Case {
            scene: text("scene.json"),
            ..case
        }
    };
    folders.iter().map(case).collect()
}

impl Case {
    /// Runs the scene to the time of a figure; with a tolerance in place of the scene's.
    pub(crate) fn run(&self, figure: &Figure, tolerance: Option<f64>) -> Found {
        let mut scene: serde_json::Value = serde_json::from_str(&self.scene).expect("JSON");
        scene["run"]["duration"] = figure.at.into();
        if let Some(tolerance) = tolerance {
            scene["run"]["tolerance"] = tolerance.into();
        }
        let begun = Instant::now();
        let run = Scene::from_json(&scene.to_string()).and_then(|scene| scene.run());
        let run = run.unwrap_or_else(|error| panic!("{}: {error}", self.name));
        let seconds = begun.elapsed().as_secs_f64();
        let value = run.figures.value(&figure.figure);
        Found {
            value: value.unwrap_or_else(|error| panic!("{}: {error:?}", self.name)),
            steps: run.outcome.statistics.steps,
            seconds,
        }
    }
}
