//! Every option of every command either changes the answer or is refused with exit status 2.

use super::answers;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;
use std::process::{Command, Output};

const ROCKER: &str = "scenarios/rocker/one_mass.json";
const CLOSED: &str = "scenarios/rocker/ten_masses_closed.json";
const PUMP: &str = "scenarios/rigid/pump.json";
const CRANK: &str = "scenarios/kinetostatics/slider_crank.json";
const FIVE_BAR: &str = "scenarios/linkages/five_bar.json";
/// Its one output carries no load.
const SHAPER: &str = "scenarios/linkages/shaper.json";
const PUNCH: &str = "scenarios/linkages/toggle_press.json";
/// A machine in place of a scene.
const TABLE: &str = "tests/program/machine.csv";

/// Commands with what they need, on scenes of several kinds.
const BASES: &[(&str, &[&str])] = &[
    ("run", &[ROCKER, "--set", "run.duration=0.1"]),
    ("run", &[PUMP, "--set", "run.duration=0.1"]),
    ("run", &[CRANK, "--set", "run.duration=0.1"]),
    ("check", &[ROCKER]),
    ("check", &[PUMP]),
    ("show", &[ROCKER]),
    ("show", &[CRANK]),
    ("show", &[FIVE_BAR]),
    (
        "compare",
        &[
            ROCKER,
            "--set",
            "run.duration=0.1",
            "--over",
            "rocker.stiffness=2e6,3e6",
        ],
    ),
    ("compare", &[PUMP, "--over", "run.duration=0.05,0.1"]),
    (
        "map",
        &[
            ROCKER,
            "--set",
            "run.duration=0.1",
            "--x",
            "rocker.stiffness=1e6:2e6:2",
        ],
    ),
    ("steady", &["scenarios/steady/press_flywheel.json"]),
    ("steady", &["scenarios/steady/press_motor.json"]),
    ("steady", &["scenarios/steady/press_elastic.json"]),
    ("steady", &[ROCKER]),
    ("steady", &["scenarios/rocker/ten_masses_closed.json"]),
    ("steady", &["--table", TABLE, "--mean-speed", "10 rad/s"]),
    (
        "steady",
        &[
            "--inertia",
            "2 + cos(phi)",
            "--moment",
            "30*sin(phi)",
            "--mean-speed",
            "10 rad/s",
            "--fluctuation",
            "0.01",
        ],
    ),
    (
        "steady",
        &[
            "--inertia",
            "2",
            "--work",
            "30*sin(phi)",
            "--mean-speed",
            "10 rad/s",
        ],
    ),
    ("kinematics", &[CRANK]),
    ("kinematics", &["scenarios/linkages/eccentric_cam.json"]),
    ("kinematics", &[FIVE_BAR, "--input", "left=10 deg:20 deg"]),
    ("forces", &[CRANK]),
    ("forces", &["scenarios/linkages/eccentric_cam.json"]),
    ("forces", &[FIVE_BAR, "--input", "left=10 deg:20 deg"]),
    ("forces", &[SHAPER]),
    ("forces", &[PUNCH, "--range", "10 deg:20 deg"]),
    ("cam", &["scenarios/cams/flat_tappet.json"]),
    ("cam", &["scenarios/cams/yarn_traverse.json"]),
    ("cam", &["scenarios/cams/eccentric_jump.json"]),
    (
        "methods",
        &[
            ROCKER,
            "--set",
            "run.duration=0.02",
            "--methods",
            "exact,dop853",
            "--tolerances",
            "1e-4,1e-6",
        ],
    ),
    (
        "methods",
        &[
            ROCKER,
            "--set",
            "run.duration=0.02",
            "--methods",
            "exact,rk4",
            "--steps",
            "1e-5",
            "--repeats",
            "1",
        ],
    ),
    (
        "methods",
        &[
            CLOSED,
            "--set",
            "run.duration=0.05",
            "--methods",
            "exact,dop853",
            "--tolerances",
            "1e-4,1e-6",
            "--models",
            "--repeats",
            "1",
        ],
    ),
    (
        "find",
        &[
            ROCKER,
            "--set",
            "run.duration=0.1",
            "--vary",
            "rocker.stiffness=1e6:2e6:5",
            "--subject",
            "frequency.1 >= 600 Hz",
        ],
    ),
    (
        "optimize",
        &[
            "scenarios/rigid/rocker_in_order.json",
            "--vary",
            "rocker.inertia=0.05:0.2",
            "--subject",
            "rocker.pair.margin >= 0",
            "--maximize",
            "rocker.inertia",
        ],
    ),
    (
        "gradient",
        &[
            ROCKER,
            "--set",
            "run.duration=0.05",
            "--by",
            "rocker.inertia,rocker.stiffness",
        ],
    ),
    (
        "tolerance",
        &[
            ROCKER,
            "--set",
            "run.duration=0.05",
            "--tol",
            "rocker.inertia=±1 %",
            "--samples",
            "16",
        ],
    ),
    (
        "identify",
        &[
            "scenarios/shafts/free_vibration.json",
            "--record",
            "scenarios/shafts/released_wheel.csv",
            "--match",
            "deflection=wheel.delta",
            "--vary",
            "wheel.stiffness=5000:12000",
        ],
    ),
    ("verify", &[ROCKER]),
    ("reduce", &[CLOSED, "--set", "run.duration=0.1"]),
    (
        "reduce",
        &[
            CLOSED,
            "--set",
            "run.duration=0.1",
            "--figure",
            "rocker.delta_abs",
            "--accuracy",
            "2 %",
        ],
    ),
    (
        "law compare",
        &[
            "scenarios/valve_train/in_working_order.json",
            "--at",
            "valve.position.cam.law",
            "--law",
            "cycloidal",
            "--law",
            "4-5-6-7",
        ],
    ),
    (
        "law compare",
        &[
            "scenarios/cams/flat_tappet.json",
            "--at",
            "valve.position.cam.law",
            "--law",
            "cycloidal",
            "--law",
            "harmonic",
        ],
    ),
    (
        "law synthesize",
        &[
            "--run-up",
            "sine",
            "--stroke",
            "50 mm",
            "--span",
            "120 deg",
            "--uniform-stroke",
            "0.3",
        ],
    ),
    (
        "law synthesize",
        &[
            "--run-up",
            "sine",
            "--stroke",
            "50 mm",
            "--span",
            "120 deg",
            "--uniform-optimum",
        ],
    ),
    (
        "law synthesize",
        &[
            "--run-up",
            "sine",
            "--span",
            "120 deg",
            "--peak-speed",
            "34 mm/rad",
            "--uniform-span",
            "0.2",
        ],
    ),
    ("linearise", &["scenarios/rocker/two_masses.json"]),
    ("response", &["scenarios/rocker/two_masses.json"]),
    ("orders", &[ROCKER, "--points", "3"]),
    ("law show", &["cycloidal"]),
    (
        "law cycle",
        &["scenarios/cams/flat_tappet.json", "--of", "valve"],
    ),
];

/// Plausible values; an option that lists its own is tried with each of them.
const VALUES: &[(&str, &[&str])] = &[
    ("--set", &["name=Another"]),
    ("--table", &["no_such_file.csv"]),
    ("--accuracy", &["5 %"]),
    ("--over", &["rocker.inertia=0.4,0.5"]),
    ("--figure", &["frequency.1", "rocker.delta_min"]),
    ("--figures", &["rocker.delta_min"]),
    ("--by", &["rocker.stiffness"]),
    ("--x", &["rocker.stiffness=1e6:3e6:2"]),
    ("--y", &["rocker.inertia=0.4:0.5:2"]),
    ("--panels", &["rocker.inertia=0.4,0.5"]),
    ("--abscissa", &["turns"]),
    ("--vary", &["rocker.stiffness=1e6:3e6:5"]),
    ("--subject", &["frequency.1 <= 700 Hz"]),
    ("--limit", &["frequency.1 <= 700 Hz"]),
    ("--tol", &["rocker.stiffness=±1 %"]),
    ("--seed", &["2"]),
    ("--maximize", &["rocker.stiffness"]),
    ("--minimize", &["rocker.delta_abs"]),
    ("--starts", &["2"]),
    ("--digits", &["9"]),
    ("--cells", &["0:1"]),
    ("--mean-speed", &["12 rad/s"]),
    ("--cycle", &["720 deg"]),
    ("--fluctuation", &["0.05"]),
    ("--periods", &["3"]),
    ("--inertia", &["3"]),
    ("--work", &["20*sin(phi)"]),
    ("--moment", &["20*cos(phi)"]),
    ("--object", &["no_such_object"]),
    ("--of", &["no_such_object"]),
    ("--range", &["10 deg:50 deg"]),
    ("--time", &["0.05"]),
    ("--input", &["q1=0.1", "rocker.load"]),
    ("--output", &["rocker.delta"]),
    ("--speeds", &["100:900 rpm"]),
    ("--highest", &["7"]),
    ("--points", &["4"]),
    ("--frequencies", &["10:4000 Hz:50"]),
    ("--speed", &["7 rad/s"]),
    ("--acceleration", &["3 rad/s^2"]),
    ("--positions", &["11"]),
    ("--svg", &["15 deg"]),
    ("--load", &["slide=100 N"]),
    ("--match", &["no_such_column=wheel.delta"]),
    ("--sigma", &["deflection=1 mrad"]),
    ("--record", &["no_such_file.csv"]),
    ("--compare-massless", &["1,10"]),
    ("--pressure-angle", &["10 deg"]),
    ("--return-pressure-angle", &["10 deg"]),
    ("--roller-factor", &["0.2"]),
    ("--least-radius", &["40 mm"]),
    ("--reserve", &["0.5"]),
    ("--tolerance", &["0.1 mm"]),
    ("--cutter", &["10 mm"]),
    ("--samples", &["11"]),
    ("--methods", &["exact,dopri5"]),
    ("--tolerances", &["1e-3"]),
    ("--steps", &["2e-5"]),
    ("--repeats", &["2"]),
    ("--point-limit", &["4"]),
    ("--law", &["modified_sine"]),
    ("--at", &["no_such_object.law"]),
    ("--run-up", &["cosine"]),
    ("--run-out", &["cosine"]),
    ("--stroke", &["40 mm"]),
    ("--span", &["100 deg"]),
    ("--peak-speed", &["40 mm/rad"]),
    ("--uniform-stroke", &["0.2"]),
    ("--uniform-span", &["0.2"]),
    ("--skewness", &["2"]),
    ("--acceleration-ratio", &["2"]),
    ("--least-acceleration", &["2"]),
    ("--least-torque", &["2"]),
];

/// Options that are meant to leave the answer as it is.
const EXEMPT: &[(&str, &str)] = &[
    ("--help", "prints the help"),
    ("--quiet", "what is said beside the answer"),
    ("--json", "every base is asked for in both forms"),
    ("--out", "every base is asked for with files"),
    ("--force", "whether files are replaced"),
    ("--time-limit", "when a computation ends"),
    ("--units", "how texts and pages show results"),
    ("--significant", "how texts and pages show results"),
    ("--threads", "results do not depend on it"),
    ("--resume", "goes on with a map that is not finished"),
    ("--merge", "has a test of its own, with the parts of a map"),
];

/// Values that state a default, and settings that may change nothing by their nature.
const MAY_CHANGE_NOTHING: &[(&str, &str, &str)] = &[
    ("--form", "text", "the default"),
    ("--view", "all", "the default"),
    ("--convention", "paper", "the default"),
    ("--mean", "time", "the default"),
    ("--turn", "", "the default of a linkage that turns fully"),
    ("--record", "objects", "the default"),
    ("--check", "", "the default with few parameters and events"),
    ("--periods", "3", "most cycles of a period that are tried"),
    ("--balance", "", "of a cycle whose work is balanced already"),
    (
        "--unchecked",
        "",
        "leaves out a check that may find nothing",
    ),
    ("--digits", "9", "a figure may be determined to all of them"),
    ("--by", "contact-force", "the default"),
    ("--point-limit", "4", "how long a point may take"),
];

fn dam(command: &str, more: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_dam"))
        .args(command.split(' '))
        .args(more)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap()
}

/// An option as the help shows it.
#[derive(Debug, Default)]
struct Declared {
    name: String,
    needs_value: bool,
    choices: Vec<String>,
}

/// The options of a command, from its declaration by way of the help.
fn declared(command: &str) -> Vec<Declared> {
    let help = dam(command, &["--help"]);
    let help = String::from_utf8(help.stdout).unwrap();
    let mut found: Vec<Declared> = Vec::new();
    for line in help.lines() {
        let words = line.trim_start();
        let indent = line.len() - words.len();
        let long = words.split(' ').find(|word| word.starts_with("--"));
        let begins =
            words.starts_with("--") || words.starts_with('-') && words[2..].starts_with(',');
        match long {
            Some(name) if begins && (2..=8).contains(&indent) => found.push(Declared {
                name: name.to_owned(),
                needs_value: words.contains('<'),
                choices: Vec::new(),
            }),
            _ => {
                if let (Some(last), Some(rest)) = (found.last_mut(), words.strip_prefix("- "))
                    && let Some((choice, _)) = rest.split_once(':')
                {
                    last.choices.push(choice.to_owned());
                }
            }
        }
    }
    assert!(found.iter().any(|one| one.name == "--help"), "{command}");
    found
}

/// What a command answers: text, document and files, without expectations, which only the
/// scene as it stands has.
#[derive(PartialEq)]
struct Answered {
    text: String,
    document: Option<Value>,
    files: BTreeMap<String, Vec<u8>>,
}

/// `Err`: refused with exit status 2.
fn answered(command: &str, arguments: &[&str], with_files: bool) -> Result<Answered, String> {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let mut all = arguments.to_vec();
    if with_files {
        all.extend(["--out", out.to_str().unwrap()]);
    }
    let output = dam(command, &all);
    if output.status.code() == Some(2) {
        let said = String::from_utf8(output.stderr).unwrap();
        assert!(said.contains("error"), "{command} {arguments:?}: {said}");
        return Err(said);
    }
    // A form and JSON exclude each other.
    let json = dam(command, &[arguments, &["--json"]].concat());
    let document = serde_json::from_slice(&json.stdout).ok();
    let faults = document
        .as_ref()
        .map(|found| answers::faults(command, found));
    let faults = faults.unwrap_or_default();
    assert!(
        faults.is_empty(),
        "{command} {arguments:?}: {}",
        faults.join("\n")
    );
    if MEASURED.contains(&command) {
        return Ok(Answered {
            text: String::new(),
            document: document.map(without_times),
            files: BTreeMap::new(),
        });
    }
    Ok(Answered {
        text: String::from_utf8(output.stdout).unwrap(),
        document: document.map(without_expectations),
        files: files(&out),
    })
}

/// Commands that measure times: these, and what is read off them, differ from run to run.
const MEASURED: [&str; 2] = ["methods", "reduce"];
const OF_TIMES: [&str; 4] = ["cost", "answer", "offered", "recommendation"];

fn without_times(value: Value) -> Value {
    match value {
        Value::Object(entries) => {
            let of_times = |name: &str| OF_TIMES.contains(&name) || name.ends_with("seconds");
            let rest = entries.into_iter().filter(|(name, _)| !of_times(name));
            rest.map(|(name, value)| (name, without_times(value)))
                .collect()
        }
        Value::Array(values) => values.into_iter().map(without_times).collect(),
        plain => plain,
    }
}

fn without_expectations(mut document: Value) -> Value {
    if let Some(entries) = document.as_object_mut() {
        entries.remove("expect");
    }
    document
}

fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = std::fs::read_dir(folder).into_iter().flatten();
    let files = entries.map(|entry| {
        let entry = entry.unwrap();
        let name = entry.file_name().into_string().unwrap();
        (name, std::fs::read(entry.path()).unwrap())
    });
    // Times are of the clock; pages and documents repeat what text and JSON say.
    let same =
        |name: &str| name.ends_with(".csv") || name.ends_with(".svg") || name.ends_with(".dxf");
    files.filter(|(name, _)| same(name)).collect()
}

/// The options with values to try on a command, in both orders of trust: none where exempt.
fn tries(command: &str) -> Vec<Vec<String>> {
    let mut all = Vec::new();
    for option in declared(command) {
        if EXEMPT.iter().any(|(name, _)| *name == option.name) {
            continue;
        }
        let known = VALUES.iter().find(|(name, _)| *name == option.name);
        match (option.needs_value, option.choices.is_empty(), known) {
            (false, ..) => all.push(vec![option.name]),
            (true, false, _) => {
                let choices = option.choices.into_iter();
                all.extend(choices.map(|choice| vec![option.name.clone(), choice]));
            }
            (true, true, Some((_, values))) => {
                let values = values.iter();
                all.extend(values.map(|value| vec![option.name.clone(), (*value).to_owned()]));
            }
            (true, true, None) => panic!("no value is known for {command} {}", option.name),
        }
    }
    all
}

#[test]
fn every_option_changes_the_answer_or_is_refused() {
    let (mut changed, mut refused, mut silent) = (0, 0, Vec::new());
    for (command, base) in BASES {
        let with_files = declared(command).iter().any(|one| one.name == "--out");
        let plain = answered(command, base, with_files);
        let plain = plain.unwrap_or_else(|why| panic!("{command} {base:?}: {why}"));
        for more in tries(command) {
            if base.contains(&more[0].as_str()) {
                continue;
            }
            let own: Vec<&str> = more.iter().map(String::as_str).collect();
            match answered(command, &[base, &own[..]].concat(), with_files) {
                Err(_) => refused += 1,
                Ok(found) if found != plain => changed += 1,
                Ok(_) => {
                    let value = own.get(1).copied().unwrap_or("");
                    let allowed = (MAY_CHANGE_NOTHING.iter())
                        .any(|(name, of, _)| *name == own[0] && *of == value);
                    if !allowed {
                        silent.push(format!("{command} {} {}", base.join(" "), own.join(" ")));
                    }
                }
            }
        }
    }
    assert!(
        silent.is_empty(),
        "accepted without effect:\n{}",
        silent.join("\n")
    );
    assert!(changed > 120 && refused > 60, "{changed} {refused}");
}
