//! Scenes from public reports and questions, each with its right values.
//!
//! The scenes, the values with their tolerances and what they are based on are in
//! `tests/reference/public`.

use serde::Deserialize;
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Scenes whose answers are known to be wrong. The test fails when one of them passes, so
/// that this list can only become shorter.
const STILL_WRONG: &[&str] = &[];

/// A scene and what its commands must answer.
#[derive(Deserialize)]
struct Row {
    scene: String,
    /// What the right values are based on.
    source: String,
    runs: Vec<Run>,
}

/// One call of the program on the scene.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Run {
    /// The subcommand, then the options that follow the scene.
    command: Vec<String>,
    /// Exit statuses that are right.
    status: Vec<i32>,
    values: Vec<Check>,
    /// What the answer on the terminal must contain.
    #[serde(default)]
    text: Vec<String>,
    /// What the message on standard error must contain.
    #[serde(default)]
    error: Vec<String>,
}

/// A check of one entry of the JSON document, found by its JSON pointer.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Check {
    at: String,
    /// The pointer of an entry that is subtracted first.
    minus: Option<String>,
    /// The unit of the right value, as a factor.
    scale: Option<f64>,
    value: Option<f64>,
    within: Option<f64>,
    at_most: Option<f64>,
    /// Every number of a list exceeds this; an absent list has none.
    all_above: Option<f64>,
    equals: Option<Value>,
}

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/reference/public")
}

fn rows() -> Vec<Row> {
    let text = std::fs::read_to_string(folder().join("values.json")).unwrap();
    serde_json::from_str(&text).unwrap()
}

fn call(row: &Row, run: &Run, json: bool) -> Output {
    Command::new(env!("CARGO_BIN_EXE_dam"))
        .arg(&run.command[0])
        .arg(&row.scene)
        .args(&run.command[1..])
        .args(json.then_some("--json"))
        .current_dir(folder())
        .output()
        .unwrap()
}

/// The number at a pointer of the document.
fn number(document: &Value, at: &str) -> Result<f64, String> {
    let found = document.pointer(at);
    found
        .and_then(Value::as_f64)
        .ok_or_else(|| format!("{at} is {found:?}, not a number"))
}

impl Check {
    fn judge(&self, document: &Value) -> Result<(), String> {
        let at = &self.at;
        if let Some(right) = &self.equals {
            let found = document.pointer(at);
            return match found == Some(right) {
                true => Ok(()),
                false => Err(format!("{at} is {found:?} instead of {right}")),
            };
        }
        if let Some(bound) = self.all_above {
            let list = document.pointer(at).and_then(Value::as_array);
            let mut low = list.into_iter().flatten();
            return match low.find(|entry| !entry.as_f64().is_some_and(|found| found > bound)) {
                None => Ok(()),
                Some(low) => Err(format!("{at} contains {low}, not above {bound}")),
            };
        }
        let mut found = number(document, at)?;
        if let Some(other) = &self.minus {
            found -= number(document, other)?;
        }
        found *= self.scale.unwrap_or(1.0);
        match (self.value, self.within, self.at_most) {
            (Some(right), Some(within), None) if (found - right).abs() <= within => Ok(()),
            (Some(right), Some(within), None) => {
                Err(format!("{at} is {found} instead of {right} ± {within}"))
            }
            (None, None, Some(bound)) if found <= bound => Ok(()),
            (None, None, Some(bound)) => Err(format!("{at} is {found}, above {bound}")),
            _ => Err(format!("{at} has no complete check")),
        }
    }
}

/// What is wrong with one call.
fn faults_of_run(row: &Row, run: &Run) -> Vec<String> {
    let json = run.text.is_empty() && run.error.is_empty();
    let output = call(row, run, json);
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    let errors = String::from_utf8_lossy(&output.stderr).into_owned();
    let mut faults = Vec::new();
    let status = output.status.code();
    if !status.is_some_and(|status| run.status.contains(&status)) {
        faults.push(format!("status {status:?}, not {:?}: {errors}", run.status));
    }
    let all = format!("{said}{errors}");
    let lacking = |text: &&String, within: &str| !within.contains(text.as_str());
    faults.extend(
        run.text
            .iter()
            .filter(|text| lacking(text, &all))
            .chain(run.error.iter().filter(|text| lacking(text, &errors)))
            .map(|text| format!("does not say `{text}`")),
    );
    if !run.values.is_empty() {
        match serde_json::from_str(&said) {
            Ok(document) => {
                let judged = run.values.iter().map(|check| check.judge(&document));
                faults.extend(judged.filter_map(Result::err));
            }
            Err(error) => faults.push(format!("no document: {error}")),
        }
    }
    let command = run.command.join(" ");
    faults
        .into_iter()
        .map(|fault| format!("{} {command}: {fault}", row.scene))
        .collect()
}

/// What is wrong with each row, in the order of the rows.
fn judge_all(rows: &[Row]) -> Vec<Vec<String>> {
    let next = AtomicUsize::new(0);
    let found = Mutex::new(vec![Vec::new(); rows.len()]);
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                loop {
                    let index = next.fetch_add(1, Ordering::Relaxed);
                    let Some(row) = rows.get(index) else { break };
                    let runs = row.runs.iter();
                    let faults = runs.flat_map(|run| faults_of_run(row, run)).collect();
                    found.lock().unwrap()[index] = faults;
                }
            });
        }
    });
    found.into_inner().unwrap()
}

#[test]
fn public_scenes_have_their_right_values() {
    let rows = rows();
    let mut faults = Vec::new();
    for (row, found) in rows.iter().zip(judge_all(&rows)) {
        let known = STILL_WRONG.contains(&row.scene.trim_end_matches(".json"));
        match (known, found.is_empty()) {
            (true, true) => faults.push(format!(
                "{} is right now: take it out of STILL_WRONG",
                row.scene
            )),
            (false, false) => faults.extend(found),
            (true, false) | (false, true) => {}
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn every_public_scene_has_values_and_a_source() {
    let rows = rows();
    let files = std::fs::read_dir(folder()).unwrap();
    let mut scenes: Vec<String> = files
        .map(|file| file.unwrap().file_name().into_string().unwrap())
        .filter(|name| name.ends_with(".json") && name != "values.json")
        .collect();
    let mut listed: Vec<String> = rows.iter().map(|row| row.scene.clone()).collect();
    scenes.sort();
    listed.sort();
    assert_eq!(scenes, listed);
    let table = std::fs::read_to_string(folder().join("README.md")).unwrap();
    for row in &rows {
        assert!(
            !row.source.is_empty() && !row.runs.is_empty(),
            "{}",
            row.scene
        );
        assert!(
            table.contains(&format!("`{}`", row.scene)),
            "README.md lacks {}",
            row.scene
        );
    }
    for name in STILL_WRONG {
        assert!(listed.contains(&format!("{name}.json")), "{name}");
    }
}
