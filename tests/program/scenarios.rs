//! Every scene under `scenarios/` keeps what it expects of itself.

use dam::lower::lower;
use dam::scene::{BuiltIn, Document, Folder, Layered, Overrides};
use dam::studies::expectations::check;
use dam::studies::lookup::unknown_figures;
use dam::studies::run::run;
use dam::studies::steady;
use dam::studies::studied::check_all;
use dam::studies::{Control, RunSettings};
use dam::system::System;
use std::path::{Path, PathBuf};

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// All scenes, `group/name.json`, ascending.
pub(crate) fn scenes() -> Vec<PathBuf> {
    let mut found = Vec::new();
    for group in std::fs::read_dir(root().join("scenarios")).unwrap() {
        let group = group.unwrap().path();
        if group.is_dir() {
            let files = std::fs::read_dir(group).unwrap();
            found.extend(files.map(|file| file.unwrap().path()));
        }
    }
    found.retain(|path| {
        path.extension()
            .is_some_and(|extension| extension == "json")
    });
    found.sort();
    found
}

/// What is wrong with a scene; nothing when it keeps its word.
fn judge(path: &Path) -> Result<(), String> {
    let bytes = std::fs::read(path).map_err(|error| error.to_string())?;
    let document = Document::parse(&path.display().to_string(), &bytes)
        .map_err(|diagnostics| diagnostics.to_string())?;
    let reading = document
        .scene(
            &Layered(&Folder::beside(path), &BuiltIn),
            &Overrides::none(),
        )
        .map_err(|diagnostics| diagnostics.to_string())?;
    let model = lower(&reading.scene).map_err(|faults| format!("{faults:?}"))?;
    let system = System::new(model).map_err(|faults| format!("{faults:?}"))?;
    let settings = RunSettings::of(&reading.scene).map_err(|fault| format!("{fault:?}"))?;
    let result = run(&system, &settings, &Control::default(), &mut [])
        .map_err(|faults| format!("{faults:?}"))?;
    let expect = &reading.scene.expect;
    if expect.is_empty() {
        return Err("expects nothing of itself".to_owned());
    }
    let sourced = |expectation: &dam::scene::Expectation| expectation.source.is_some();
    if !expect.iter().all(sourced) {
        return Err("a figure has no source".to_owned());
    }
    if !result.is_trusted() {
        return Err(format!("not to be trusted: {:?}", result.figures.warnings));
    }
    let mut verdicts = check(expect, &result);
    let model = system.model();
    let unknown = unknown_figures(expect, model);
    if !unknown.is_empty() {
        return Err(format!("{unknown:?}"));
    }
    verdicts.extend(check_all(expect, model, settings.duration)?);
    if verdicts.len() < expect.len() {
        let spec = reading.scene.steady.clone().unwrap_or_default();
        let answer = steady::steady_motion(&system, &settings, &spec)
            .map_err(|faults| format!("{faults:?}"))?;
        verdicts.extend(steady::check(expect, &answer));
    }
    if verdicts.len() < expect.len() {
        return Err("an expectation is judged by nobody".to_owned());
    }
    let failed: Vec<String> = verdicts
        .into_iter()
        .filter(|verdict| !verdict.holds)
        .map(|verdict| verdict.message)
        .collect();
    if failed.is_empty() {
        Ok(())
    } else {
        Err(failed.join("\n"))
    }
}

#[test]
fn every_scene_keeps_what_it_expects() {
    let scenes = scenes();
    assert!(scenes.len() >= 15, "only {} scenes found", scenes.len());
    let next = std::sync::atomic::AtomicUsize::new(0);
    let failures = std::sync::Mutex::new(Vec::new());
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                loop {
                    let index = next.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
                    let Some(path) = scenes.get(index) else { break };
                    if let Err(failure) = judge(path) {
                        let text = format!("{}:\n{failure}", path.display());
                        failures.lock().unwrap().push(text);
                    }
                }
            });
        }
    });
    let failures = failures.into_inner().unwrap();
    assert!(failures.is_empty(), "{}", failures.join("\n\n"));
}

#[test]
fn every_scene_is_named_in_the_table_of_scenarios() {
    let table = std::fs::read_to_string(root().join("scenarios/README.md")).unwrap();
    for path in scenes() {
        let path = path.strip_prefix(root().join("scenarios")).unwrap();
        let name = path.display().to_string();
        let stem = name.trim_end_matches(".json");
        assert!(table.contains(stem), "scenarios/README.md lacks {name}");
    }
}
