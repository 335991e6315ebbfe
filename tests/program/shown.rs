//! The units, digits and axes in which results are shown.

use std::process::{Command, Output};

fn dam(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_dam"))
        .args(arguments)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap()
}

fn text(arguments: &[&str]) -> String {
    let output = dam(arguments);
    assert!(
        output.status.code() < Some(2),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    String::from_utf8(output.stdout).unwrap()
}

const ENGINE: &str = "scenarios/steady/engine.json";

#[test]
fn results_are_in_the_units_asked_for_and_documents_in_those_of_the_si() {
    let of = |more: &[&str]| text(&[&["steady", ENGINE], more].concat());
    // 211.6372829815 rad/s.
    assert!(of(&["--units", "rpm"]).contains("2021 rpm"));
    assert!(of(&["--units", "rpm", "--significant", "7"]).contains("2020.987 rpm"));
    assert!(of(&["--units", "si"]).contains("211.637283 rad/s"));
    let json = |more: &[&str]| of(&[&["--json"], more].concat());
    assert_eq!(json(&["--units", "rpm", "--significant", "2"]), json(&[]));
    for wrong in ["rpm,rad/s", "furlong", "rpm;mm"] {
        let output = dam(&["steady", ENGINE, "--units", wrong]);
        assert_eq!(output.status.code(), Some(2), "{wrong}");
    }
}

#[test]
fn results_are_in_the_units_of_the_scene() {
    let folder = tempfile::tempdir().unwrap();
    let cam = folder.path().join("cam.json").display().to_string();
    assert!(dam(&["new", "cam", &cam]).status.success());
    let out = folder.path().join("out").display().to_string();
    let shown = text(&["run", &cam, "--out", &out]);
    assert!(shown.contains(" mm"), "{shown}");
    let page = std::fs::read_to_string(format!("{out}/report.html")).unwrap();
    assert!(
        page.contains("\"units\":{"),
        "the page's script knows the units"
    );
    assert!(!page.contains("g m²</span>") || page.contains("kg m²"));
}

#[test]
fn records_and_charts_are_over_the_angle_of_the_machine() {
    let folder = tempfile::tempdir().unwrap();
    let out = |name: &str| folder.path().join(name).display().to_string();
    let scene = "scenarios/valve_train/in_working_order.json";
    let run = |name: &str, abscissa: &str| {
        let out = out(name);
        let output = dam(&["run", scene, "--abscissa", abscissa, "--out", &out]);
        assert!(
            output.status.success(),
            "{}",
            String::from_utf8_lossy(&output.stderr)
        );
        let read = |file: &str| std::fs::read_to_string(format!("{out}/{file}")).unwrap();
        (read("record.csv"), read("report.html"))
    };
    let (time, _) = run("time", "time");
    let (angle, page) = run("angle", "angle");
    let (_, turns) = run("turns", "turns");
    assert!(time.starts_with("time [s],") && angle.starts_with("machine_angle [rad],time [s],"));
    // The angle is that of the drive.
    let head: Vec<&str> = angle.lines().next().unwrap().split(',').collect();
    let drive = head
        .iter()
        .position(|name| *name == "camshaft.displacement [rad]")
        .unwrap();
    let row: Vec<&str> = angle.lines().nth(300).unwrap().split(',').collect();
    assert_eq!(row[0], row[drive]);
    assert_eq!(
        angle.lines().nth(300).unwrap().split_once(',').unwrap().1,
        time.lines().nth(300).unwrap()
    );
    for page in [&page, &turns] {
        assert!(page.contains("angle of camshaft"));
    }
    for (wrong, words) in [
        ("turn", "none of time"),
        ("angle:valve", "no drive that turns"),
    ] {
        let output = dam(&["run", scene, "--abscissa", wrong, "--out", &out("wrong")]);
        let told = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(
            output.status.code() == Some(2) && told.contains(words),
            "{told}"
        );
    }
    let output = dam(&["run", scene, "--abscissa", "angle"]);
    assert_eq!(output.status.code(), Some(2));
}
