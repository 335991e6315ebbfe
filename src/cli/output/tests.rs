//! Folders are replaced as a whole, and nothing of others is touched.

use super::{OutputFolder, ResultFile};
use crate::cli::failure::Failure;
use std::fs;

fn put(folder: &OutputFolder, files: &[ResultFile]) -> Result<(), String> {
    folder
        .write("run", "0", files)
        .map_err(|failure| match failure {
            Failure::Output(message) => message,
            other => panic!("{other:?}"),
        })
}

fn write(folder: &std::path::Path, scene: &str, force: bool) -> Result<(), String> {
    let folder = OutputFolder::prepare(folder, scene, &["summary.json"], force)?;
    put(&folder, &[ResultFile::new("summary.json", scene)])
}

#[test]
fn replaces_its_own_results_and_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    let place = folder.path().join("a/b");
    write(&place, "one", false).unwrap();
    write(&place, "one", false).unwrap();
    let message = write(&place, "two", false).unwrap_err();
    assert!(message.contains("summary.json") && message.contains("--force"));
    assert_eq!(
        fs::read_to_string(place.join("summary.json")).unwrap(),
        "one"
    );
    fs::write(place.join("summary.json"), "edited by hand").unwrap();
    assert!(write(&place, "one", false).is_err());
    write(&place, "two", true).unwrap();
    assert_eq!(
        fs::read_to_string(place.join("summary.json")).unwrap(),
        "two"
    );
    let left: Vec<_> = fs::read_dir(&place).unwrap().collect();
    assert_eq!(left.len(), 2, "no part files stay behind");
}

#[test]
fn files_of_a_run_that_ended_while_it_wrote_are_its_own() {
    let folder = tempfile::tempdir().unwrap();
    let names = ["summary.json", "report.html"];
    let prepare = || OutputFolder::prepare(folder.path(), "one", &names, false);
    let write = |names: [&str; 2], content: &str| {
        let files = names.map(|name| ResultFile::new(name, content));
        put(&prepare()?, &files)
    };
    // The second file cannot be written: what lay there stays whole, be it nothing.
    let broken = ["summary.json", "nowhere/report.html"];
    write(broken, "first").unwrap_err();
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    write(names, "second").unwrap();
    for content in ["third", "fourth"] {
        write(broken, content).unwrap_err();
        let found = fs::read_to_string(folder.path().join("summary.json")).unwrap();
        assert_eq!(found, "second");
    }
    // Ended between two files: one is new, the other old.
    let signed = fs::read_to_string(folder.path().join("provenance.json")).unwrap();
    let mut known: serde_json::Value = serde_json::from_str(&signed).unwrap();
    known["before"] = serde_json::json!({
        "summary.json": [known["files"]["summary.json"]],
        "report.html": [known["files"]["report.html"]],
    });
    known["files"]["summary.json"] = super::digest(b"between").into();
    known["files"]["report.html"] = super::digest(b"between").into();
    fs::write(folder.path().join("summary.json"), "between").unwrap();
    fs::write(folder.path().join("provenance.json"), known.to_string()).unwrap();
    write(names, "fifth").unwrap();
    for name in names {
        let found = fs::read_to_string(folder.path().join(name)).unwrap();
        assert_eq!(found, "fifth");
    }
    // Nothing is remembered longer than it may matter.
    let path = folder.path().join("provenance.json");
    assert!(!fs::read_to_string(path).unwrap().contains("before"));
    fs::write(folder.path().join("report.html"), "second").unwrap();
    assert!(prepare().is_err());
}

#[test]
fn parts_that_a_killed_program_left_are_cleared_away_and_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    // No process has this number: greater than the greatest that Linux gives.
    let left = [
        ".summary.json.4194999.part",
        ".provenance.json.4194999.part",
    ];
    let own = format!(".summary.json.{}.part", std::process::id());
    let foreign = [
        ".notes.txt.4194999.part",
        ".summary.json.part",
        ".summary.json.x7.part",
        ".summary.json.04194999.part",
        "summary.json.4194999.part",
    ];
    for name in left.iter().chain(&foreign).chain([&own.as_str()]) {
        fs::write(folder.path().join(name), "half").unwrap();
    }
    write(folder.path(), "one", false).unwrap();
    assert!(left.iter().all(|name| !folder.path().join(name).exists()));
    assert!(foreign.iter().all(|name| folder.path().join(name).exists()));
}

#[test]
fn results_are_replaced_as_a_whole() {
    let folder = tempfile::tempdir().unwrap();
    let write = |names: &[&str], force| {
        let out = OutputFolder::prepare(folder.path(), "one", names, force)?;
        let files = names.iter().map(|name| ResultFile::new(*name, *name));
        put(&out, &files.collect::<Vec<_>>())
    };
    let there = || {
        let entries = fs::read_dir(folder.path()).unwrap();
        let names = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
        let mut names: Vec<String> = names.collect();
        names.sort();
        names
    };
    write(&["record.csv", "report.html"], false).unwrap();
    fs::write(folder.path().join("notes.txt"), "mine").unwrap();
    write(&["methods.csv", "report.html"], false).unwrap();
    let second = ["methods.csv", "notes.txt", "provenance.json", "report.html"];
    assert_eq!(there(), second);
    // What was changed by hand would be lost: refused, and nothing is touched.
    fs::write(folder.path().join("methods.csv"), "mine").unwrap();
    let message = write(&["record.csv", "report.html"], false).unwrap_err();
    assert!(message.contains("methods.csv"), "{message}");
    assert_eq!(there(), second);
    // With --force, too, it stays: no file of these results.
    write(&["record.csv"], true).unwrap();
    let third = ["methods.csv", "notes.txt", "provenance.json", "record.csv"];
    assert_eq!(there(), third);
}

#[test]
fn a_folder_belongs_to_one_at_a_time() {
    let folder = tempfile::tempdir().unwrap();
    let take = || OutputFolder::prepare(folder.path(), "one", &["summary.json"], false);
    let first = take().unwrap();
    assert!(take().unwrap_err().contains("another dam"));
    drop(first);
    take().unwrap();
}

#[test]
fn a_file_in_the_way_is_refused_before_the_run() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("results");
    fs::write(&file, "x").unwrap();
    assert!(write(&file, "one", true).unwrap_err().contains("results"));
}
