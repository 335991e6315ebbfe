//! Tables in files beside a scene: the same as in the scene, and nothing from outside.

use dam::Scene;
use dam::scene::{BuiltIn, Document, Folder, LayeredCatalogue, Overrides};
use proptest::prelude::*;
use std::path::Path;
use std::process::{Command, Output, Stdio};

const SCENE: &str = r#"{ "dam": 1, "name": "table",
  "objects": {
    "shaft": { "kind": "drive", "motion": { "speed": "300 rpm" } },
    "follower": {
      "kind": "slider", "input": "shaft", "mass": 1, "masses": 0,
      "position": { "table": { "points": POINTS } }
    }
  },
  "run": { "duration": 0.1 }
}"#;

fn scene(folder: &Path, points: &str) -> String {
    let path = folder.join("scene.json");
    std::fs::write(&path, SCENE.replace("POINTS", points)).unwrap();
    path.display().to_string()
}

fn dam(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_dam"))
        .args(arguments)
        .output()
        .unwrap()
}

fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

fn canonical(folder: &Path, points: &str) -> (serde_json::Value, String) {
    let text = SCENE.replace("POINTS", points);
    let document = Document::parse("scene.json", text.as_bytes()).unwrap();
    let beside = Folder::beside_scene(&folder.join("scene.json"));
    let reading = document.scene(&LayeredCatalogue(&beside, &BuiltIn), &Overrides::none());
    let reading = reading.unwrap_or_else(|faults| panic!("{faults}"));
    (reading.canonical, reading.scene.hash)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    /// A table in a file is the table in the scene, however it is separated.
    #[test]
    fn a_file_is_the_list_that_it_holds(
        steps in proptest::collection::vec(0.1..30.0f64, 3..40),
        lifts in proptest::collection::vec(-50.0..50.0f64, 40),
        form in 0..4usize,
        further in any::<bool>(),
    ) {
        let folder = tempfile::tempdir().unwrap();
        let mut angle = 0.0;
        let (mut rows, mut list) = (String::new(), Vec::new());
        let (separator, comma, [open, close]) = [
            (",", false, ["[", "]"]), (";", true, ["(", ")"]), ("\t", true, ["[", "]"]), ("; ", false, ["[", "]"]),
        ][form];
        let number = |value: f64| match comma {
            true => format!("{value:?}").replace('.', ","),
            false => format!("{value:?}"),
        };
        for (step, lift) in steps.iter().zip(&lifts) {
            angle += step;
            list.push(format!("[\"{angle:?} deg\", \"{lift:?} mm\"]"));
            let note = if further { format!("{separator}note") } else { String::new() };
            rows += &format!("{}{separator}{}{note}\r\n", number(angle), number(*lift));
        }
        let note = if further { format!("{separator}remark") } else { String::new() };
        let head = format!("angle {open}deg{close}{separator}lift {open}mm{close}{note}\r\n");
        std::fs::write(folder.path().join("lift.csv"), format!("\u{feff}# measured\r\n{head}{rows}\r\n")).unwrap();
        let named = match further {
            true => r#"{ "file": "lift.csv", "columns": ["angle", "lift"] }"#,
            false => r#"{ "file": "lift.csv" }"#,
        };
        let file = canonical(folder.path(), named);
        prop_assert_eq!(file, canonical(folder.path(), &format!("[{}]", list.join(", "))));
    }

    /// No bytes make the reading fail otherwise than with a message.
    #[test]
    fn any_bytes_are_read_or_refused(bytes in proptest::collection::vec(any::<u8>(), 0..200)) {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("lift.csv"), &bytes).unwrap();
        let path = scene(folder.path(), r#"{ "file": "lift.csv" }"#);
        let _ = Scene::read(&path).unwrap().decode();
    }

    #[test]
    fn any_text_is_read_or_refused(text in "[a-z0-9;,\t\n\" .\\[\\]()-]{0,80}") {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("lift.csv"), format!("angle [deg];lift [mm]\n{text}")).unwrap();
        let path = scene(folder.path(), r#"{ "file": "lift.csv" }"#);
        let _ = Scene::read(&path).unwrap().decode();
    }
}

#[test]
fn files_outside_the_folder_are_refused() {
    let outer = tempfile::tempdir().unwrap();
    let folder = outer.path().join("scenes");
    std::fs::create_dir_all(folder.join("tables")).unwrap();
    let table = "angle [deg],lift [mm]\n0,0\n10,1\n20,3\n";
    std::fs::write(outer.path().join("secret.csv"), table).unwrap();
    std::fs::write(folder.join("tables/lift.csv"), table).unwrap();
    let absolute = outer.path().join("secret.csv").display().to_string();
    let mut outside = vec![
        absolute,
        "../secret.csv".to_owned(),
        "tables/../../secret.csv".to_owned(),
    ];
    #[cfg(unix)]
    {
        let link =
            |from: &Path, to: &str| std::os::unix::fs::symlink(from, folder.join(to)).unwrap();
        link(&outer.path().join("secret.csv"), "link.csv");
        link(outer.path(), "out");
        outside.extend(["link.csv".to_owned(), "out/secret.csv".to_owned()]);
    }
    for name in &outside {
        let path = scene(&folder, &format!("{{ \"file\": {name:?} }}"));
        let output = dam(&["check", &path]);
        assert_eq!(output.status.code(), Some(2), "{name}");
        let text = stderr(&output);
        assert!(
            text.contains("outside-folder") && !text.contains("0,0"),
            "{name}: {text}"
        );
    }
    let path = scene(&folder, r#"{ "file": "tables/lift.csv" }"#);
    assert_eq!(dam(&["check", &path]).status.code(), Some(0));
    let path = scene(&folder, r#"{ "file": "tables/lif.csv" }"#);
    let text = stderr(&dam(&["check", &path]));
    assert!(
        text.contains("missing-file") && text.contains("did you mean `lift.csv`?"),
        "{text}"
    );
    let path = scene(&folder, r#"{ "file": "tables" }"#);
    assert!(stderr(&dam(&["check", &path])).contains("no plain file"));
}

#[test]
fn a_scene_without_a_folder_has_no_files() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(
        folder.path().join("lift.csv"),
        "angle [deg],lift [mm]\n0,0\n10,1\n20,3\n",
    )
    .unwrap();
    let text = SCENE.replace("POINTS", r#"{ "file": "lift.csv" }"#);
    let mut child = Command::new(env!("CARGO_BIN_EXE_dam"))
        .args(["check", "-"])
        .current_dir(folder.path())
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    std::io::Write::write_all(&mut child.stdin.take().unwrap(), text.as_bytes()).unwrap();
    let output = child.wait_with_output().unwrap();
    assert!(stderr(&output).contains("no-folder"), "{}", stderr(&output));
    let faults = Scene::from_json(&text)
        .unwrap()
        .decode()
        .unwrap_err()
        .to_string();
    assert!(faults.contains("no folder"), "{faults}");
    // From its file it has one, in whichever folder the program runs.
    let path = scene(folder.path(), r#"{ "file": "lift.csv" }"#);
    assert!(Scene::read(&path).unwrap().decode().is_ok());
}

#[test]
fn faults_are_shown_in_the_file() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(
        folder.path().join("lift.csv"),
        "angle [deg],lift [mm]\n0,0\n10,one\n20,3\n",
    )
    .unwrap();
    let path = scene(folder.path(), r#"{ "file": "lift.csv" }"#);
    let text = stderr(&dam(&["check", &path]));
    for part in [
        "lift.csv:3:4",
        "3 | 10,one",
        "`one` is not a number",
        "named here",
    ] {
        assert!(text.contains(part), "{part}: {text}");
    }
}

#[test]
fn tables_that_are_too_large_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("lift.csv");
    let path = scene(folder.path(), r#"{ "file": "lift.csv" }"#);
    let mut text = "angle [deg],lift [mm]\n".to_owned();
    for at in 0..1_000_001 {
        text += &format!("{at},1\n");
    }
    std::fs::write(&file, &text).unwrap();
    assert!(stderr(&dam(&["check", &path])).contains("more than 1000000 rows"));
    std::fs::File::create(&file)
        .unwrap()
        .set_len(50_000_001)
        .unwrap();
    assert!(stderr(&dam(&["check", &path])).contains("larger than 50 MB"));
    let many: Vec<String> = (0..200)
        .map(|at| format!("{{ \"file\": \"{at}.csv\" }}"))
        .collect();
    let path = scene(folder.path(), &format!("[{}]", many.join(",")));
    assert!(!stderr(&dam(&["check", &path])).is_empty());
}

#[test]
fn a_reduced_scene_holds_its_tables() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(
        folder.path().join("lift.csv"),
        "angle [deg];lift [mm]\n0;0\n90;1,5\n180;3\n270;1,5\n360;0\n",
    )
    .unwrap();
    let text = SCENE
        .replace("POINTS", r#"{ "file": "lift.csv" }, "periodic": true"#)
        .replace(
            "\"masses\": 0",
            "\"stiffness\": 1e6, \"damping_capacity\": 0.5, \"masses\": 3",
        );
    let path = folder.path().join("scene.json");
    std::fs::write(&path, text).unwrap();
    let out = folder.path().join("out");
    let arguments = [
        "reduce",
        path.to_str().unwrap(),
        "--out",
        out.to_str().unwrap(),
    ];
    let output = dam(&arguments);
    let files: Vec<_> = std::fs::read_dir(&out)
        .unwrap_or_else(|_| panic!("{}", stderr(&output)))
        .collect();
    let scene = files.into_iter().map(|file| file.unwrap().path());
    let mut scenes = scene.filter(|file| {
        std::fs::read_to_string(file)
            .is_ok_and(|text| text.contains("\"objects\"") && text.contains("\"points\""))
    });
    let reduced = scenes.next().expect("a reduced scene");
    let text = std::fs::read_to_string(&reduced).unwrap();
    assert!(
        text.contains("\"1.5 mm\"") && !text.contains("lift.csv"),
        "{text}"
    );
}

#[test]
fn every_command_warns_of_a_doubtful_table() {
    // The row of 360 deg is missing; the lifts are rounded to 1 µm and make U″ rough.
    let folder = tempfile::tempdir().unwrap();
    std::fs::copy(
        "tests/diagnostics/rough_table.csv",
        folder.path().join("lift.csv"),
    )
    .unwrap();
    let path = folder.path().join("cam.json");
    let scene = r#"{ "dam": 1, "name": "cam", "objects": {
        "shaft": { "kind": "drive", "motion": { "speed": "300 rpm" } },
        "valve": { "kind": "cam_follower", "input": "shaft", "motion": "sliding", "mass": "0.1 kg", "masses": 0,
            "position": { "table": { "points": { "file": "lift.csv" }, "periodic": true } },
            "cam": { "base_radius": "20 mm", "contact": { "roller": "8 mm" } },
            "loads": { "spring": { "spring": { "rate": "20 N/mm", "preload": "200 N" } } } } },
        "run": { "duration": "0.2 s" },
        "expect": [{ "figure": "valve.pair.margin", "at_least": "1 N" }] }"#;
    std::fs::write(&path, scene).unwrap();
    let path = path.to_str().unwrap();
    let vary = [
        "find",
        path,
        "--vary",
        "shaft.motion.speed=200:300 rpm:3",
        "--subject",
        "valve.pair.margin >= 0",
    ];
    for call in [
        &["check", path][..],
        &["run", path],
        &["cam", path],
        &["verify", path],
        &["show", path],
        &["compare", path, "--over", "shaft.motion.speed=20,30"],
        &[
            "map",
            path,
            "--x",
            "shaft.motion.speed=20:30:2",
            "--figure",
            "valve.peak_speed",
        ],
        &["law", "cycle", path, "--of", "valve"],
        &["methods", path, "--repeats", "1", "--tolerances", "1e-3"],
        &["reduce", path],
        &vary,
    ] {
        let output = std::process::Command::new(env!("CARGO_BIN_EXE_dam"))
            .args(call)
            .output()
            .unwrap();
        let errors = String::from_utf8_lossy(&output.stderr);
        for code in ["open-period", "rough-table"] {
            assert!(errors.contains(code), "{call:?}: {errors}");
        }
        let quiet = std::process::Command::new(env!("CARGO_BIN_EXE_dam"))
            .args(call)
            .arg("--quiet")
            .output()
            .unwrap();
        let errors = String::from_utf8_lossy(&quiet.stderr);
        assert!(!errors.contains("open-period"), "{call:?}: {errors}");
    }
}
