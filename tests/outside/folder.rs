//! Folders of results.

use super::{dam, output, text};
use std::path::Path;
use std::process::Stdio;
use std::time::Duration;

fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut names: Vec<String> = entries
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

const SCENE: &str = "scenarios/rocker/one_mass.json";

#[test]
fn results_of_two_commands_never_mix() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let out_text = out.to_str().unwrap();
    let ok = |args: &[&str]| {
        let found = output(&[args, &["--out", out_text]].concat());
        assert!(found.status.success(), "{args:?}: {}", text(&found.stderr));
    };
    ok(&["run", SCENE]);
    let of_run = [
        "provenance.json",
        "record.csv",
        "report.html",
        "summary.json",
        "timing.json",
    ];
    assert_eq!(names(&out), of_run);
    ok(&["map", SCENE, "--x", "rocker.inertia=0.05:0.1:2"]);
    let of_map = [
        "map.csv",
        "map.json",
        "map.svg",
        "provenance.json",
        "report.html",
        "timing.json",
    ];
    assert_eq!(names(&out), of_map);
    ok(&["run", SCENE]);
    assert_eq!(names(&out), of_run);
    // Of another scene, or changed by hand: refused.
    let other = output(&["run", "scenarios/limits/short_rod.json", "--out", out_text]);
    assert_eq!(other.status.code(), Some(2));
    std::fs::write(out.join("record.csv"), "mine").unwrap();
    let map = [
        "map",
        SCENE,
        "--x",
        "rocker.inertia=0.05:0.1:2",
        "--out",
        out_text,
    ];
    let found = output(&map);
    assert_eq!(found.status.code(), Some(2));
    assert!(
        text(&found.stderr).contains("record.csv"),
        "{}",
        text(&found.stderr)
    );
    assert_eq!(names(&out), of_run);
}

#[cfg(unix)]
#[test]
fn a_second_program_at_a_folder_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().to_str().unwrap();
    let long = "run={\"duration\": 100000, \"samples\": 100, \"method\": \"taylor\", \"max_switches\": 1000000000}";
    let first = [
        "run",
        "scenarios/rocker/two_masses_gap.json",
        "--set",
        long,
        "--out",
        out,
    ];
    let mut first = dam(&first)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    std::thread::sleep(Duration::from_secs(2));
    for command in [
        &["run", SCENE][..],
        &["kinematics", "scenarios/limits/short_rod.json"],
        &["map", SCENE, "--x", "rocker.inertia=0.05:0.1:2"],
    ] {
        let second = output(&[command, &["--out", out, "--force"]].concat());
        assert_eq!(second.status.code(), Some(2), "{command:?}");
        let said = text(&second.stderr);
        assert!(said.contains("another dam is at work"), "{said}");
    }
    // Killed outright: nothing keeps the folder, and nothing half written stays.
    first.kill().unwrap();
    first.wait().unwrap();
    let third = output(&["run", SCENE, "--out", out]);
    assert!(third.status.success(), "{}", text(&third.stderr));
    assert!(
        names(folder.path())
            .iter()
            .all(|name| !name.starts_with('.'))
    );
}

#[test]
fn the_journal_of_an_interrupted_map_is_not_lost_to_another_command() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().to_str().unwrap();
    let x = "rocker.inertia=0.05:1:100000";
    let y = "rocker.stiffness=1e6:1e7:2";
    let map = [
        "map",
        SCENE,
        "--x",
        x,
        "--y",
        y,
        "--out",
        out,
        "--time-limit",
        "5",
    ];
    assert_eq!(output(&map).status.code(), Some(1));
    assert_eq!(names(folder.path()), ["map.journal"]);
    let run = output(&["run", SCENE, "--out", out]);
    assert_eq!(run.status.code(), Some(2));
    assert!(
        text(&run.stderr).contains("--resume"),
        "{}",
        text(&run.stderr)
    );
    let run = output(&["run", SCENE, "--out", out, "--force"]);
    assert!(run.status.success());
    assert!(!names(folder.path()).contains(&"map.journal".to_owned()));
}
