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
        "switches.csv",
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

#[test]
fn a_page_of_very_many_switches_is_bounded_and_says_what_it_leaves_out() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let args = [
        "run",
        "scenarios/rocker/two_masses.json",
        "--set",
        "run.duration=120",
        "--out",
        out.to_str().unwrap(),
    ];
    let found = output(&args);
    assert!(out.join("report.html").exists(), "{}", text(&found.stderr));
    let read = |name: &str| std::fs::read_to_string(out.join(name)).unwrap();
    let summary: serde_json::Value = serde_json::from_str(&read("summary.json")).unwrap();
    let count = summary["run"]["switches"].as_u64().unwrap();
    let pair = &summary["objects"]["rocker"]["pair"];
    let separations = pair["separations"].as_u64().unwrap();
    assert!(count > 20_000, "{count}");
    // The files are complete.
    let times = pair["switch_times"].as_array().unwrap();
    assert_eq!(times.len() as u64, count);
    let rows = read("switches.csv");
    let rows: Vec<Vec<&str>> = rows.lines().map(|row| row.split(',').collect()).collect();
    assert_eq!(
        rows[0],
        ["time [s]", "object", "switch", "flank", "speed", "unit"]
    );
    assert_eq!(rows.len() as u64, count + 1);
    for (row, time) in rows[1..].iter().zip(times) {
        assert_eq!(row[0].parse::<f64>().ok(), time.as_f64());
        assert_eq!((row[1], row[5]), ("rocker", "rad/s"));
    }
    let opens = rows.iter().filter(|row| row[2] == "opens").count() as u64;
    assert_eq!(opens, separations);
    // The page is not, and says so.
    let page = read("report.html");
    assert!(page.len() < 5_000_000, "{}", page.len());
    for words in [
        format!("the first 1000 of {count} events"),
        format!("the first 5000 of {separations} separations are shaded, up to"),
        "in detail after one switch in".to_owned(),
    ] {
        assert!(page.contains(&words), "{words}");
    }
}
