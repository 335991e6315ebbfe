//! Every scene under `scenarios/` keeps what it expects of itself.

use dam::prelude::*;
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
    let scene = Scene::read(path).map_err(|error| error.to_string())?;
    let requirements = scene.verify().map_err(|error| error.to_string())?;
    if requirements.is_empty() {
        return Err("expects nothing of itself".to_owned());
    }
    if requirements.iter().any(|one| one.verdict.source.is_none()) {
        return Err("a figure has no source".to_owned());
    }
    let failed: Vec<String> = requirements
        .into_iter()
        .filter(|one| !one.holds())
        .map(|one| one.verdict.message)
        .collect();
    match failed.is_empty() {
        true => Ok(()),
        false => Err(failed.join("\n")),
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
