//! What a designer reads is what is true: units of lists, warnings of what is
//! likely not meant, the machine on the page of a run, maps that answer.

mod lists;
mod maps;
mod moving;
mod unlikely;

use crate::browser::browser;
use crate::browser::dom;
use serde_json::Value;
use std::path::PathBuf;
use std::process::Command;
use std::process::Output;

const VALVE: &str = "scenarios/valve_train/lift_off.json";
const ROCKER: &str = "scenarios/rocker/two_masses.json";

fn dam(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_dam"))
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .args(arguments)
        .output()
        .unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

fn json_of(arguments: &[&str]) -> Value {
    let output = dam(arguments);
    serde_json::from_slice(&output.stdout)
        .unwrap_or_else(|error| panic!("{arguments:?}: {error}: {}", text(&output.stderr)))
}

/// A scene in a folder of its own.
struct Written {
    _folder: tempfile::TempDir,
    path: PathBuf,
}

impl Written {
    fn new(scene: &Value) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("scene.json");
        std::fs::write(&path, scene.to_string()).unwrap();
        Self {
            _folder: folder,
            path,
        }
    }

    fn path(&self) -> &str {
        self.path.to_str().unwrap()
    }
}

#[test]
fn a_contact_force_without_a_limit_is_called_so_wherever_it_is_asked() {
    let force = "rocker.pair.max_contact_force";
    let accuracy = format!(r#"run.accuracy={{"{force}":"1 %"}}"#);
    let asked: [&[&str]; 3] = [
        &["run", ROCKER, "--set", &accuracy],
        &["compare", ROCKER, "--over", "rocker.masses=1,2"],
        &[
            "map",
            ROCKER,
            "--x",
            "rocker.inertia=0.05:0.15:2",
            "--y",
            "rocker.stiffness=1e6:1e7:2",
            "--figure",
            force,
        ],
    ];
    for arguments in asked {
        let told = format!("{force} diverges with the number of masses");
        let said = dam(arguments);
        let shown = text(&said.stdout) + &text(&said.stderr);
        assert!(shown.contains(&told), "{arguments:?}: {shown}");
        assert!(shown.contains("With `rocker.pair.contact` it converges"));
        let json = json_of(&[arguments, &["--json"]].concat());
        let why = &json["accuracy"][force]["why"];
        let warnings = json["warnings"].as_array().into_iter().flatten();
        let mut all = warnings.chain([why]).filter_map(Value::as_str);
        assert!(all.any(|text| text.contains(&told)), "{arguments:?}");
    }
    // Of a contact element it has one.
    let contact = r#"rocker.pair.contact={"stiffness":1e8}"#;
    let said = dam(&[
        "compare",
        ROCKER,
        "--over",
        "rocker.masses=1,2",
        "--set",
        contact,
    ]);
    assert!(!text(&said.stderr).contains("no converged value"));
}

#[test]
fn the_greatest_deviation_is_a_figure_of_every_object_by_every_method() {
    for method in ["auto", "dop853", "radau"] {
        let setting = format!("run.method=\"{method}\"");
        let document = json_of(&[
            "run",
            ROCKER,
            "--set",
            &setting,
            "--set",
            "run.duration=0.05",
            "--json",
            "-q",
        ]);
        for (id, figures) in document["objects"].as_object().unwrap() {
            let of = |name: &str| figures[name].as_f64().unwrap();
            let wanted = of("delta_max").abs().max(of("delta_min").abs());
            assert_eq!(of("delta_abs"), wanted, "{method}: {id}");
        }
        let rocker = &document["objects"]["rocker"];
        assert!(rocker["delta_abs"].as_f64().unwrap() > 1e-5);
    }
}

/// The valve, preload over speed: of the signed δ the dark cell lies inside the zone
/// of lift-off, where the valve in fact strays least.
#[test]
fn a_map_shows_how_far_the_object_strays() {
    let axis = ["--x", "camshaft.motion.speed=1500:2300 rpm:3"];
    let map = json_of(&[&["map", VALVE], &axis[..], &["--json", "-q", "--unchecked"]].concat());
    assert_eq!(map["figure"], "valve.delta_abs");
    for index in 0..3 {
        let speed = ["1500 rpm", "1900 rpm", "2300 rpm"][index];
        let setting = format!("camshaft.motion.speed={speed}");
        let run = json_of(&["run", VALVE, "--set", &setting, "--json", "-q"]);
        let valve = &run["objects"]["valve"];
        let of = |name: &str| valve[name].as_f64().unwrap();
        let wanted = of("delta_max").abs().max(of("delta_min").abs());
        let shown = map["panels"][0]["values"][index].as_f64().unwrap();
        assert!(
            (shown - wanted).abs() <= 1e-9 * wanted,
            "{speed}: {shown} {wanted}"
        );
    }
}

/// The JSON within the element of this id.
fn element(page: &str, id: &str) -> Value {
    let start = page
        .find(&format!("id=\"{id}\""))
        .unwrap_or_else(|| panic!("no {id}"));
    let from = start + page[start..].find('>').unwrap() + 1;
    let to = from + page[from..].find("</script>").unwrap();
    serde_json::from_str(&page[from..to]).unwrap()
}

/// What a script finds in a page once its own scripts have run; `None` without a browser.
fn asked(page: &str, script: &str) -> Option<Value> {
    let browser = browser()?;
    let folder = tempfile::tempdir().unwrap();
    let ask = format!(
        "<pre id=\"answer\"></pre><script>document.getElementById('answer').textContent = \
         JSON.stringify((() => {{ {script} }})());</script></body>"
    );
    let dom = dom(&browser, &page.replace("</body>", &ask), folder.path());
    let from = dom.find("<pre id=\"answer\">").expect("an answer") + 17;
    let to = from + dom[from..].find("</pre>").unwrap();
    let plain = dom[from..to]
        .replace("&lt;", "<")
        .replace("&gt;", ">")
        .replace("&amp;", "&");
    Some(serde_json::from_str(&plain).unwrap_or_else(|error| panic!("{error}: {plain}")))
}
