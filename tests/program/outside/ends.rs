//! How commands end: by a signal, by the time limit, by themselves.

use super::{dam, output, scene, text};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

fn kill(child: &Child, signal: &str) {
    let id = child.id().to_string();
    assert!(
        Command::new("kill")
            .args([signal, &id])
            .status()
            .unwrap()
            .success()
    );
}

/// Status and the two outputs of a command that is told to stop after a while, and the
/// time from then on.
fn told(args: &[&str], signal: &str, after: Duration) -> (Option<i32>, String, String, Duration) {
    let mut command = dam(args);
    let child = command
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    std::thread::sleep(after);
    kill(&child, signal);
    let told = Instant::now();
    let output = child.wait_with_output().unwrap();
    (
        output.status.code(),
        text(&output.stdout),
        text(&output.stderr),
        told.elapsed(),
    )
}

/// A run that takes hours.
const LONG: [&str; 4] = [
    "run",
    "scenarios/rocker/two_masses_gap.json",
    "--set",
    "run={\"duration\": 100000, \"samples\": 100, \"method\": \"taylor\", \"max_switches\": 1000000000}",
];

/// A lever that can be propagated exactly, and beside it one that must be integrated.
const MIXED: &str = r#"{ "dam": 1, "name": "Mixed", "objects": {
    "shaft": { "kind": "drive", "motion": { "speed": "10 rev/s" } },
    "lever": { "kind": "rocker", "input": "shaft", "masses": 2, "inertia": 0.1,
        "stiffness": 1e7, "damping_capacity": 0.4, "pair": { "closure": "force" },
        "position": { "sine": { "amplitude": "90 deg" } },
        "loads": { "closing": { "mass": "last", "constant": -600 } } },
    "brake": { "kind": "rocker", "input": "shaft", "masses": 1, "inertia": 0.2,
        "stiffness": 3e5, "damping_capacity": 0.3,
        "position": { "sine": { "amplitude": "20 deg" } },
        "loads": { "shoe": { "friction": { "force": 40, "width": 0.5 } } } } } }"#;

/// How a run is ended from outside.
#[derive(Clone, Copy, Debug)]
enum Ending {
    Limit,
    #[cfg(unix)]
    Signal(&'static str),
}

impl Ending {
    #[cfg(unix)]
    const ALL: [Self; 3] = [Self::Limit, Self::Signal("-INT"), Self::Signal("-TERM")];
    #[cfg(not(unix))]
    const ALL: [Self; 1] = [Self::Limit];

    /// Exit status, and what the result says of it.
    fn expected(self) -> (i32, &'static str) {
        match self {
            Self::Limit => (1, "wall_clock"),
            #[cfg(unix)]
            Self::Signal("-INT") => (130, "interrupted"),
            #[cfg(unix)]
            Self::Signal(_) => (143, "interrupted"),
        }
    }

    /// Status and outputs of a command that is ended after a while.
    fn end(self, args: &[&str], after: Duration) -> (Option<i32>, String, String) {
        match self {
            Self::Limit => {
                let limit = after.as_secs_f64().to_string();
                let found = output(&[args, &["--time-limit", &limit]].concat());
                (
                    found.status.code(),
                    text(&found.stdout),
                    text(&found.stderr),
                )
            }
            #[cfg(unix)]
            Self::Signal(signal) => {
                let (code, out, err, _) = told(args, signal, after);
                (code, out, err)
            }
        }
    }
}

/// The result of a run that is ended from outside, which must be kept as far as it came. On a
/// machine that is busy a run may not have begun yet: it is then given more time.
fn kept(ending: Ending, args: &[&str], folder: Option<&std::path::Path>) -> serde_json::Value {
    let (status, stopped) = ending.expected();
    let mut after = Duration::from_millis(250);
    loop {
        let (code, out, err) = ending.end(args, after);
        let said = format!("{ending:?} {args:?} after {after:?}: {out}{err}");
        assert_eq!(code, Some(status), "{said}");
        let document = match folder {
            None => out.clone(),
            Some(folder) => {
                std::fs::read_to_string(folder.join("summary.json")).unwrap_or_default()
            }
        };
        if let Ok(document) = serde_json::from_str::<serde_json::Value>(&document)
            && document["errors"].is_null()
        {
            assert_eq!(document["run"]["stopped"], stopped, "{said}");
            if folder.is_some() {
                assert!(out.contains("Not judged"), "{said}");
            }
            return document;
        }
        assert!(after < Duration::from_secs(10), "nothing was kept: {said}");
        after *= 3;
    }
}

#[test]
fn every_ending_keeps_what_was_computed() {
    let folder = tempfile::tempdir().unwrap();
    let mixed = scene(folder.path(), MIXED);
    let rocker = "scenarios/rocker/one_mass.json";
    let scenes = ["auto", "exact", "taylor", "radau", "dop853"].map(|method| (rocker, method));
    let mixed = [(mixed.to_str().unwrap(), "auto")];
    for (path, method) in scenes.into_iter().chain(mixed) {
        let method = format!("run.method={method}");
        let run = [
            &["run", path, "--set", "run.duration=5000", "--set", &method][..],
            &["--set", "run.max_switches=1000000000"],
        ]
        .concat();
        for ending in Ending::ALL {
            let out = folder.path().join("out");
            let files = [&run[..], &["--out", out.to_str().unwrap(), "--force"]].concat();
            let json = [&run[..], &["--json"]].concat();
            for (args, folder) in [(json, None), (files, Some(&*out))] {
                let document = kept(ending, &args, folder);
                let run = &document["run"];
                let is_mixed = run["why"].to_string().contains("brake");
                assert_eq!(is_mixed, path != rocker, "{run}");
                assert_eq!(run["complete"], false, "{run}");
                assert_eq!(document["verdict"], "not_judged", "{run}");
                let time = run["time"].as_f64().unwrap();
                assert!(time > 0.0 && time < 5e3, "{run}");
                // It has gone through a turn at least: the figures are those of the motion.
                let objects = document["objects"].as_object().unwrap();
                let moving = objects
                    .values()
                    .filter(|own| own["peak_speed"].as_f64() > Some(1.0));
                assert_eq!(moving.count(), objects.len(), "{method}: {run}");
                if let Some(folder) = folder {
                    let page = std::fs::read_to_string(folder.join("report.html")).unwrap();
                    assert!(page.contains("Not judged"));
                    let rows = std::fs::read_to_string(folder.join("record.csv")).unwrap();
                    assert!(rows.lines().count() >= 2, "{rows}");
                }
            }
            let _ = std::fs::remove_dir_all(out);
        }
    }
}

#[cfg(unix)]
#[test]
fn a_signal_ends_at_once_what_has_nothing_to_keep() {
    // The scene never comes.
    for (signal, status) in [("-INT", 130), ("-TERM", 143)] {
        let mut command = dam(&["check", "-"]);
        command
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped());
        let mut child = command.spawn().unwrap();
        let _held = child.stdin.take();
        std::thread::sleep(Duration::from_secs(1));
        kill(&child, signal);
        assert_eq!(child.wait().unwrap().code(), Some(status));
    }
}

#[test]
fn the_time_limit_holds_for_every_phase() {
    let mut command = dam(&["check", "-", "--time-limit", "0.2", "--json"]);
    command
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped());
    let mut child = command.spawn().unwrap();
    let _held = child.stdin.take();
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(1));
    let document: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let message = document["errors"][0]["message"].as_str().unwrap();
    let whole =
        "the time limit of 0.2 s was over before there was a result, while the scene was read";
    assert!(message.contains(whole), "{message}");
    // A motion whose pieces are very many before a table's next point is followed while they
    // are found.
    let folder = tempfile::tempdir().unwrap();
    let slow = r#"{ "dam": 1, "name": "slow", "objects": {
        "drive": { "kind": "drive", "motion": { "expression": "0.3*sin(20*t) + 1e-6*sin(1e7*t)" } },
        "lever": { "kind": "rocker", "input": "drive", "inertia": 0.02, "stiffness": 800,
            "damping_capacity": 0.3, "masses": 2, "position": { "table": { "periodic": true,
                "points": [[0, 0], [2, 0.3], [4, 0.1], ["360 deg", 0]] } } } },
        "run": { "duration": 100 } }"#;
    let path = scene(folder.path(), slow).display().to_string();
    let run = output_within(&["run", &path, "--time-limit", "4"]);
    assert!(
        run.contains("INCOMPLETE") && run.contains("peak speed"),
        "{run}"
    );
    // Of a run and a map something is kept.
    let run = output_within(&[&LONG[..], &["--time-limit", "1"]].concat());
    assert!(
        run.contains("INCOMPLETE") && run.contains("peak speed"),
        "{run}"
    );
    let x = "rocker.inertia=0.05:1:100000";
    let map = [
        "map",
        "scenarios/rocker/ten_masses.json",
        "--x",
        x,
        "--time-limit",
        "5",
    ];
    assert!(!output_within(&map).is_empty());
}

/// Standard output of a command that ends by its time limit.
fn output_within(args: &[&str]) -> String {
    let begun = Instant::now();
    let found = output(args);
    assert_eq!(found.status.code(), Some(1), "{}", text(&found.stderr));
    assert!(begun.elapsed() < Duration::from_secs(60));
    text(&found.stdout)
}

#[test]
fn what_once_had_no_end_ends_with_a_reason() {
    let cases: [(&[&str], i32, &str); 6] = [
        (
            &[
                "run",
                "scenarios/rocker/one_mass_undamped.json",
                "--set",
                "rocker.inertia=1e-31",
                "--set",
                "run.method=exact",
            ],
            1,
            "a natural frequency is too high to be followed",
        ),
        (
            &[
                "cam",
                "scenarios/cams/yarn_traverse.json",
                "--tolerance=1e-300",
            ],
            2,
            "takes more than 200000 points",
        ),
        (
            &[
                "steady",
                "scenarios/shafts/free_vibration.json",
                "--set",
                "wheel.stiffness=1e33",
            ],
            2,
            "t =",
        ),
        (
            &[
                "run",
                "scenarios/limits/short_rod.json",
                "--set",
                "run.duration=1e308",
            ],
            2,
            "in 1e308 s `shaft` turns more than 10¹² times",
        ),
        (
            &[
                "run",
                "scenarios/limits/short_rod.json",
                "--set",
                "run.step=1e-20",
            ],
            2,
            "below what a clock of 16 digits resolves after 1 s",
        ),
        (
            &[
                "run",
                "scenarios/slotted_link/block_accelerated.json",
                "--set",
                "drive.motion.acceleration=\"1e30 m/s^2\"",
                "--set",
                "run.duration=1.5",
            ],
            1,
            "dead-centre position",
        ),
    ];
    for (args, status, reason) in cases {
        let found = output(args);
        let said = text(&found.stdout) + &text(&found.stderr);
        assert_eq!(found.status.code(), Some(status), "{args:?}: {said}");
        assert!(said.contains(reason), "{args:?}: {said}");
    }
}

#[test]
fn a_search_for_the_lift_off_that_was_ended_says_so() {
    let args = [
        "cam",
        "scenarios/cams/indexing_dwells.json",
        "--lift-off",
        "--time-limit",
        "0.03",
    ];
    let found = output(&args);
    let said = text(&found.stderr);
    assert_eq!(found.status.code(), Some(1), "{said}");
    // Before there is anything to keep, and after.
    assert!(said.contains("the time limit of 0.03 s"), "{said}");
}

#[test]
fn no_number_that_is_none_with_status_0() {
    let args = [
        "steady",
        "--inertia=1",
        "--work=cos(phi)",
        "--mean-speed",
        "1e308",
        "--balance",
        "--json",
    ];
    let found = output(&args);
    assert_eq!(found.status.code(), Some(2), "{}", text(&found.stdout));
    assert!(
        text(&found.stdout).contains("mean-speed"),
        "{}",
        text(&found.stdout)
    );
}

#[test]
fn a_scene_comes_from_standard_input() {
    let path = format!(
        "{}/scenarios/limits/short_rod.json",
        env!("CARGO_MANIFEST_DIR")
    );
    let mut command = dam(&["run", "-", "--json"]);
    let found = command
        .stdin(std::fs::File::open(&path).unwrap())
        .output()
        .unwrap();
    assert_eq!(found.status.code(), Some(0), "{}", text(&found.stderr));
    let piped: serde_json::Value = serde_json::from_slice(&found.stdout).unwrap();
    let file: serde_json::Value =
        serde_json::from_slice(&output(&["run", &path, "--json"]).stdout).unwrap();
    assert_eq!(piped["objects"], file["objects"]);
    // Faults have their place in it.
    let mut command = dam(&["check", "-"]);
    let folder = tempfile::tempdir().unwrap();
    let broken = scene(folder.path(), "{ \"dam\": 1, \"nam\": \"x\" }");
    let found = command
        .stdin(std::fs::File::open(broken).unwrap())
        .output()
        .unwrap();
    assert_eq!(found.status.code(), Some(2));
    assert!(
        text(&found.stderr).contains("standard input:1:"),
        "{}",
        text(&found.stderr)
    );
}

#[test]
fn every_template_is_a_scene_that_runs() {
    let folder = tempfile::tempdir().unwrap();
    for template in ["lever", "cam", "linkage", "press", "shaft"] {
        let path = folder.path().join(format!("{template}.json"));
        let path = path.to_str().unwrap();
        let made = output(&["new", template, path]);
        assert!(made.status.success(), "{template}: {}", text(&made.stderr));
        // Shown, it is the same.
        assert_eq!(
            output(&["new", template]).stdout,
            std::fs::read(path).unwrap()
        );
        let run = output(&["run", path]);
        assert!(run.status.success(), "{template}: {}", text(&run.stderr));
        assert!(
            !text(&run.stderr).contains("warning"),
            "{}",
            text(&run.stderr)
        );
        // What is there stays.
        let again = output(&["new", template, path]);
        assert_eq!(again.status.code(), Some(2));
    }
    for (command, template) in [
        ("cam", "cam"),
        ("kinematics", "linkage"),
        ("steady", "press"),
    ] {
        let path = folder.path().join(format!("{template}.json"));
        assert!(
            output(&[command, path.to_str().unwrap()]).status.success(),
            "{command}"
        );
    }
}

#[test]
fn completions_and_manual_pages_know_the_commands() {
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let script = text(&output(&["completions", shell]).stdout);
        assert!(
            script.contains("kinematics") && script.contains("time-limit"),
            "{shell}"
        );
    }
    let page = text(&output(&["manual", "run"]).stdout);
    assert!(page.contains(".TH") && page.contains("spread"), "{page}");
    let none = output(&["manual", "walk"]);
    assert!(
        text(&none.stderr).contains("one of run, check"),
        "{}",
        text(&none.stderr)
    );
}

#[test]
fn a_flywheel_is_sized_for_a_table() {
    let folder = tempfile::tempdir().unwrap();
    let count = 720;
    let mut rows = "phi [deg],J [kg m^2],A [N m]\n".to_owned();
    for k in 0..=count {
        let degrees = 360.0 * f64::from(k) / f64::from(count);
        let phi = degrees.to_radians();
        rows += &format!(
            "{degrees:?},{:?},{:?}\n",
            1.5 + 0.2 * phi.cos(),
            12.0 * phi.sin()
        );
    }
    let path = folder.path().join("table.csv");
    std::fs::write(&path, rows).unwrap();
    let question = [
        "--mean-speed",
        "30",
        "--mean",
        "midrange",
        "--fluctuation",
        "0.01",
        "--json",
    ];
    let table = output(
        &[
            &["steady", "--table", path.to_str().unwrap()],
            &question[..],
        ]
        .concat(),
    );
    assert!(table.status.success(), "{}", text(&table.stderr));
    let of = |found: &[u8], pointer: &str| {
        let document: serde_json::Value = serde_json::from_slice(found).unwrap();
        document
            .pointer(pointer)
            .and_then(|value| value.as_f64())
            .unwrap()
    };
    let functions = ["steady", "--inertia=1.5+0.2*cos(phi)", "--work=12*sin(phi)"];
    let functions = output(&[&functions[..], &question].concat());
    for figure in [
        "inertia",
        "fluctuation_with",
        "approximations/0/inertia",
        "approximations/2/inertia",
    ] {
        let pointer = format!("/rigid_motion/flywheel/{figure}");
        let [one, other] = [&table.stdout, &functions.stdout].map(|found| of(found, &pointer));
        approx::assert_relative_eq!(one, other, max_relative = 1e-4);
    }
    approx::assert_relative_eq!(
        of(&table.stdout, "/rigid_motion/flywheel/fluctuation_with"),
        0.01,
        max_relative = 1e-9
    );
}

#[test]
fn what_the_terminal_warns_of_is_in_json_too() {
    // Something hangs on the linkage: its forces are not among the loads.
    let folder = tempfile::tempdir().unwrap();
    let made = text(&output(&["new", "linkage"]).stdout);
    let mut document: serde_json::Value = serde_json::from_str(&made).unwrap();
    document["objects"]["table"] = serde_json::json!({
        "kind": "slider", "input": "mechanism.slide", "position": { "ratio": 1 },
        "inertia": "1 kg", "masses": 0
    });
    // Left out by the reader, with a warning of the text.
    document["objects"]["table"]["description"] = "hangs on it".into();
    let path = scene(folder.path(), &document.to_string());
    let path = path.to_str().unwrap();
    let shown = output(&["forces", path]);
    let warned = text(&shown.stderr);
    assert!(
        warned.contains("(table) are not among its loads"),
        "{warned}"
    );
    let found = output(&["forces", path, "--json"]);
    let told: serde_json::Value = serde_json::from_slice(&found.stdout).unwrap();
    let warnings = told["warnings"].to_string();
    assert!(
        warnings.contains("(table) are not among its loads"),
        "{warnings}"
    );
}

#[test]
fn every_scene_is_shown() {
    // Masses that hang on nothing while their pair is open, and scenes without one.
    let mut shown = 0;
    for group in std::fs::read_dir("scenarios").unwrap() {
        let group = group.unwrap().path();
        let files = group.is_dir().then(|| std::fs::read_dir(group).unwrap());
        for file in files.into_iter().flatten() {
            let path = file.unwrap().path();
            let path = path.to_str().unwrap();
            if path.ends_with(".json") {
                let ended = output(&["show", path, "--time-limit", "10"]);
                assert_eq!(
                    ended.status.code(),
                    Some(0),
                    "{path}: {}",
                    text(&ended.stderr)
                );
                shown += 1;
            }
        }
    }
    assert!(shown > 50, "{shown}");
}

#[test]
fn times_in_reasons_are_in_the_one_format_of_numbers() {
    let run = [
        "run",
        "scenarios/shafts/free_vibration.json",
        "--set",
        "run.duration=1e-7",
    ];
    let told = text(&output(&run).stdout);
    let reason =
        "the run of 1e-7 s has fewer than three whole cycles of the drive (0.2094395 s each)";
    assert!(told.contains(reason), "{told}");
}

#[test]
fn who_writes_if_in_an_expression_is_told_how_conditions_are_written() {
    let steady = |work: &str| {
        let work = format!("--work={work}");
        output(&["steady", "--inertia=1", &work, "--mean-speed", "10"])
    };
    for work in ["if(phi < pi, sin(phi), 0)", "cos(phi)*if(phi < pi)"] {
        let told = text(&steady(work).stderr);
        assert!(told.contains("phi < pi ? sin(phi) : 0"), "{work}: {told}");
    }
    let right = steady("phi < pi ? sin(phi) : 0");
    assert_eq!(right.status.code(), Some(0), "{}", text(&right.stderr));
}
