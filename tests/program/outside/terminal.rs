//! What reaches a terminal or a pipe.

use super::{COMMANDS, dam, output, scene, text};
use std::process::Stdio;

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_behind_standard_output_is_told_by_every_command() {
    for args in COMMANDS {
        let full = std::fs::File::options()
            .write(true)
            .open("/dev/full")
            .unwrap();
        let found = dam(args).stdout(full).output().unwrap();
        let said = text(&found.stderr);
        assert_eq!(found.status.code(), Some(1), "{args:?}: {said}");
        assert!(
            said.contains("cannot write to standard output"),
            "{args:?}: {said}"
        );
    }
}

#[test]
fn a_reader_that_goes_away_is_no_error() {
    for args in COMMANDS {
        let status = output(args).status.code();
        let mut child = dam(args)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        drop(child.stdout.take());
        let found = child.wait_with_output().unwrap();
        let said = text(&found.stderr);
        assert_eq!(found.status.code(), status, "{args:?}: {said}");
        assert!(
            !said.contains("cannot write") && !said.contains("panicked"),
            "{args:?}: {said}"
        );
    }
}

#[test]
fn no_escape_sequence_of_a_scene_reaches_the_terminal() {
    let folder = tempfile::tempdir().unwrap();
    let evil = "\u{1b}]0;owned\u{7}\u{1b}[2J\u{9b}31m\u{7f}\u{202e}";
    let document = serde_json::json!({
        "dam": 1, "name": format!("a{evil}b"),
        "objects": {
            "shaft": { "kind": "drive", "motion": { "speed": 10 } },
            "wheel": { "kind": "shaft", "input": "shaft", "inertia": 1, "stiffness": 1e5,
                       "masses": 1 }
        },
        "run": { "duration": 0.1 }
    });
    let path = scene(folder.path(), &document.to_string());
    let path = path.to_str().unwrap();
    let missing = format!("{}/{evil}.json", folder.path().display()).replace('\0', "");
    let wrong = scene(
        &folder.path().join(""),
        &document
            .to_string()
            .replace("\"kind\"", "\"knd\\u001b[0m\""),
    );
    std::fs::rename(wrong, folder.path().join("wrong.json")).unwrap();
    scene(folder.path(), &document.to_string());
    let wrong = folder.path().join("wrong.json");
    let commands: [&[&str]; 6] = [
        &["run", path],
        &["run", path, "--json"],
        &["check", path],
        &["show", path],
        &["check", &missing],
        &["check", wrong.to_str().unwrap()],
    ];
    for args in commands {
        let found = output(args);
        let control = |c: &char| (c.is_control() && *c != '\n') || *c == '\u{202e}';
        for shown in [text(&found.stdout), text(&found.stderr)] {
            assert_eq!(shown.chars().find(control), None, "{args:?}: {shown:?}");
        }
    }
    // In JSON the name is told in full.
    let found = output(&["check", path, "--json"]);
    let told: serde_json::Value = serde_json::from_slice(&found.stdout).unwrap();
    assert_eq!(told["scene"], document["name"]);
}

#[cfg(unix)]
#[test]
fn a_catalogue_folder_with_pipes_and_links_out_of_it_is_safe() {
    let folder = tempfile::tempdir().unwrap();
    let objects = folder.path().join("objects");
    std::fs::create_dir_all(objects.join("shaft")).unwrap();
    let pipe = objects.join("shaft/pipe.json");
    let made = std::process::Command::new("mkfifo")
        .arg(&pipe)
        .status()
        .unwrap();
    assert!(made.success());
    let secret = folder.path().join("secret.json");
    std::fs::write(&secret, r#"{ "kind": "shaft", "inertia": 1 }"#).unwrap();
    std::os::unix::fs::symlink(&secret, objects.join("shaft/link.json")).unwrap();
    std::os::unix::fs::symlink("/", objects.join("root")).unwrap();
    std::fs::write(
        objects.join("shaft/own.json"),
        r#"{ "kind": "shaft", "inertia": 1 }"#,
    )
    .unwrap();
    std::os::unix::fs::symlink("own.json", objects.join("shaft/inner.json")).unwrap();
    for (name, known) in [
        ("pipe", false),
        ("link", false),
        ("own", true),
        ("inner", true),
    ] {
        let document = serde_json::json!({
            "dam": 1, "name": "a",
            "objects": {
                "drive": { "kind": "drive", "motion": { "speed": 10 } },
                "wheel": { "from": format!("shaft/{name}"), "input": "drive", "masses": 0 }
            },
            "run": { "duration": 0.1 }
        });
        let path = scene(folder.path(), &document.to_string());
        let found = output(&["check", path.to_str().unwrap()]);
        let status = if known { 0 } else { 2 };
        assert_eq!(
            found.status.code(),
            Some(status),
            "{name}: {}",
            text(&found.stderr)
        );
    }
}

/// A mode that decays within less than the least number is no mode to be shown.
#[test]
fn a_mode_without_a_rate_is_told_in_words() {
    let shaft = "scenarios/shafts/free_vibration.json";
    let damped = "wheel.damping_capacity=2.5e+299";
    let found = output(&["show", shaft, "--view", "model", "--set", damped]);
    assert_eq!(found.status.code(), Some(0), "{}", text(&found.stderr));
    let told = text(&found.stdout);
    let reason = "wheel: a mode of it is faster than double precision can resolve";
    assert!(told.contains(reason), "{told}");
    assert!(!told.contains("not a number"), "{told}");
}
