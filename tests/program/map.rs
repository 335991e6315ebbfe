//! `dam map` as a program: killed and taken up again, wrong arguments.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::{Duration, Instant};

const TWO: &str = "rocker/two_masses.json";

fn scene(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("scenarios")
        .join(name)
}

fn program() -> Command {
    Command::new(env!("CARGO_BIN_EXE_dam"))
}

#[test]
fn a_killed_map_goes_on_to_the_same_files() {
    let folder = tempfile::tempdir().unwrap();
    let (killed, whole) = (folder.path().join("killed"), folder.path().join("whole"));
    let command = |out: &Path| {
        let mut command = program();
        command.arg("map").arg(scene(TWO)).arg("--quiet");
        // A general method, slow enough to be killed in time.
        command.args(["--set", "run.method=dop853", "--set", "run.duration=0.3"]);
        command.args([
            "--x",
            "rocker.inertia=0.06:0.12:6",
            "--y",
            "rocker.stiffness=1e7:3e7:12",
        ]);
        command
            .args(["--threads", "1", "--unchecked", "--out"])
            .arg(out);
        command.stdout(std::process::Stdio::null());
        command
    };
    let mut child = command(&killed).spawn().unwrap();
    let journal = killed.join("map.journal");
    let begun = Instant::now();
    let rows = || std::fs::read_to_string(&journal).map_or(0, |text| text.lines().count());
    while rows() < 3 && begun.elapsed() < Duration::from_secs(120) {
        std::thread::sleep(Duration::from_millis(2));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(
        rows() >= 3 && !killed.join("map.csv").exists(),
        "killed in the middle"
    );
    // Without a word the finished rows are not thrown away.
    let refused = command(&killed).output().unwrap();
    assert_eq!(refused.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&refused.stderr).contains("--resume"));
    assert!(command(&killed).arg("--resume").status().unwrap().success());
    assert!(command(&whole).status().unwrap().success());
    for name in ["map.csv", "map.json", "map.svg", "report.html"] {
        let read = |folder: &Path| std::fs::read(folder.join(name)).unwrap();
        assert!(read(&killed) == read(&whole), "{name}");
    }
    assert!(!journal.exists(), "the journal of a complete map goes");
}

#[test]
fn a_map_that_is_shared_out_is_the_same() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    for axes in [
        vec![
            "--x",
            "rocker.inertia=0.05:1:5",
            "--y",
            "rocker.stiffness=1e6:1e8:3:log",
        ],
        vec![
            "--x",
            "rocker.inertia=0.05:1:19",
            "--panels",
            "rocker.masses=1,2",
        ],
    ] {
        let command = |more: &[&str]| {
            let mut command = program();
            command
                .arg("map")
                .arg(scene(TWO))
                .args(["--quiet", "--set", "run.duration=0.1"]);
            command.args(&axes).args(more);
            command.output().unwrap()
        };
        let whole = path("whole");
        let [whole, merged] = [
            whole.to_str().unwrap(),
            &format!("{}-merged", folder.path().display()),
        ];
        assert!(command(&["--force", "--out", whole]).status.success());
        let count = if axes.contains(&"--y") { 15 } else { 38 };
        // Ends of parts lie within rows; one cell is in two parts.
        let parts = [(0, 4), (4, 11), (10, count)].map(|(from, to)| {
            let part = command(&["--threads", "2", "--cells", &format!("{from}:{to}")]);
            assert_eq!(part.status.code(), Some(0));
            let name = path(&format!("cells-{from}"));
            std::fs::write(&name, part.stdout).unwrap();
            name.to_str().unwrap().to_owned()
        });
        let [first, second, third] = parts.each_ref().map(String::as_str);
        // In any order.
        let all = ["--merge", third, first, second, "--force", "--out", merged];
        assert_eq!(command(&all).status.code(), Some(0));
        for name in ["map.csv", "map.json", "map.svg", "report.html"] {
            let read = |folder: &str| std::fs::read(Path::new(folder).join(name)).unwrap();
            assert!(read(whole) == read(merged), "{name}");
        }
        let refused = |arguments: &[&str], word: &str| {
            let output = command(arguments);
            let said = String::from_utf8_lossy(&output.stderr);
            assert_eq!(output.status.code(), Some(2), "{arguments:?}: {said}");
            assert!(said.contains(word), "{arguments:?}: {said}");
        };
        refused(&["--merge", third, first], "the cells 4:10 are in no part");
        refused(
            &["--merge", third, first, second, "--digits", "5"],
            "another study",
        );
        let text = std::fs::read_to_string(first).unwrap();
        std::fs::write(first, &text[..text.len() - 9]).unwrap();
        refused(&["--merge", third, first, second], "torn");
        refused(&["--cells", "3:3"], "there are the cells 0:");
        refused(
            &["--cells", &format!("0:{}", count + 1)],
            "there are the cells 0:",
        );
        refused(&["--cells", "1-3"], "FROM:TO");
    }
}

#[test]
fn wrong_arguments_end_with_status_2_and_say_what_is_right() {
    for (arguments, word) in [
        (vec!["--x", "rocker.inertia"], "FROM:TO:COUNT"),
        (vec!["--x", "rocker.inertia=1:2:1"], "2 to 100000"),
        (vec!["--x", "rocker.inertia=1:2:3:lin"], "`log`"),
        (vec!["--x", "rocker.inertja=1:2:3"], "inertia"),
        (
            vec!["--x", "rocker.inertia=1:2:3", "--figure", "rocker.delta"],
            "no result",
        ),
        (
            vec!["--x", "rocker.inertia=1:2:3", "--panels", "a=1,,2"],
            "missing",
        ),
        (
            vec!["--x", "rocker.inertia=1:2:3", "--threads", "0"],
            "--threads",
        ),
        (vec!["--x", "rocker.inertia=1:2:3", "--resume"], "--out"),
        (vec![], "--x"),
    ] {
        let output = program()
            .arg("map")
            .arg(scene(TWO))
            .args(&arguments)
            .output()
            .unwrap();
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {said}");
        assert!(said.contains(word), "{arguments:?}: {said}");
        assert!(output.stdout.is_empty(), "{arguments:?}");
    }
}

#[test]
fn all_of_the_picture_lies_on_its_sheet() {
    for y in [None, Some("rocker.stiffness=1e7:3e7:3")] {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("out");
        let mut command = program();
        command
            .arg("map")
            .arg(scene(TWO))
            .args(["--quiet", "--unchecked"]);
        command.args([
            "--set",
            "run.duration=0.1",
            "--x",
            "rocker.inertia=0.06:0.12:3",
        ]);
        command.args(["--panels", "rocker.masses=1,2,3"]);
        command.args(y.map(|y| ["--y", y]).into_iter().flatten());
        assert!(
            command
                .arg("--out")
                .arg(&out)
                .output()
                .unwrap()
                .status
                .success()
        );
        let picture = std::fs::read_to_string(out.join("map.svg")).unwrap();
        let number = |text: &str| {
            text.split(['"', ' ', ',', ')'])
                .next()
                .unwrap()
                .parse::<f64>()
        };
        let size = picture.split("viewBox=\"0 0 ").nth(1).unwrap();
        let height = number(size.split(' ').nth(1).unwrap()).unwrap();
        let places: Vec<f64> = (picture.split(" y=\"").skip(1))
            .filter_map(|rest| number(rest).ok())
            .collect();
        let lowest = places.iter().copied().fold(0.0, f64::max);
        assert!(
            places.len() > 20 && lowest > 200.0,
            "{}: {lowest}",
            places.len()
        );
        assert!(
            lowest < height,
            "something at {lowest} on a sheet of {height}"
        );
    }
}
