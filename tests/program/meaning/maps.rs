//! Pages of maps answer with every cell.

use super::{ROCKER, VALVE, asked, dam, element, json_of, text};
use serde_json::Value;
use serde_json::json;

const FIELD: [&str; 6] = [
    "map",
    ROCKER,
    "--x",
    "rocker.inertia=0.4:0.5:3",
    "--y",
    "rocker.stiffness=1e7:2e7:3",
];

fn map_of(more: &[&str]) -> Value {
    let all = [
        &FIELD[..],
        &["--set", "run.duration=1", "--json", "-q"],
        more,
    ]
    .concat();
    json_of(&all)
}

#[test]
fn the_verdict_on_the_mechanism_stays_where_digits_are_lost() {
    let (fine, coarse) = (map_of(&["--digits", "9"]), map_of(&[]));
    let unchecked = map_of(&["--unchecked"]);
    let panel = |map: &Value| map["panels"][0].clone();
    assert_eq!(panel(&fine)["verdicts"], panel(&coarse)["verdicts"]);
    assert_eq!(panel(&unchecked)["verdicts"], panel(&coarse)["verdicts"]);
    let lost = |map: &Value| {
        let cells = panel(map)["determined"].as_array().unwrap().clone();
        cells.iter().filter(|cell| **cell == json!(false)).count()
    };
    assert!(
        lost(&fine) > lost(&coarse),
        "{} {}",
        lost(&fine),
        lost(&coarse)
    );
    assert_eq!(panel(&fine)["summary"]["undetermined"], json!(lost(&fine)));
    // What is said of each follows from how far it moves.
    for map in [&fine, &coarse] {
        let bound = 10f64.powi(-(map["thresholds"]["digits"].as_i64().unwrap() as i32));
        let panel = panel(map);
        for (moved, known) in panel["moved"]
            .as_array()
            .unwrap()
            .iter()
            .zip(panel["determined"].as_array().unwrap())
        {
            if let (Some(moved), Some(known)) = (moved.as_f64(), known.as_bool()) {
                assert_eq!(known, moved <= bound, "{moved}");
            }
        }
    }
}

#[test]
fn the_page_of_a_map_answers_with_every_cell() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let more = [
        "--set",
        "run.duration=0.2",
        "-q",
        "--out",
        out.to_str().unwrap(),
    ];
    let output = dam(&[&FIELD[..], &more].concat());
    assert!(output.status.success(), "{}", text(&output.stderr));
    let page = std::fs::read_to_string(out.join("report.html")).unwrap();
    let data = element(&page, "map-data");
    let map: Value = serde_json::from_slice(&std::fs::read(out.join("map.json")).unwrap()).unwrap();
    assert_eq!(
        data["command"],
        json!(["dam", "run", ROCKER, "--set", "run.duration=0.2"])
    );
    assert_eq!(data["x"]["values"], json!(["0.4", "0.45", "0.5"]));
    let (cells, panel) = (&data["panels"][0], &map["panels"][0]);
    for index in 0..9 {
        let cause = &data["causes"][cells["causes"][index].as_u64().unwrap() as usize];
        assert_eq!(*cause, panel["causes"][index]);
        let verdict = data["verdicts"][cells["verdicts"][index].as_u64().unwrap() as usize].clone();
        let name = panel["verdicts"][index].as_str().unwrap().replace('_', " ");
        assert!(
            (verdict.as_str().unwrap().replace('-', " ")).starts_with(&name[..7]),
            "{verdict} {name}"
        );
    }
    assert_eq!(page.matches("class=\"plot\" data-plot=\"0\"").count(), 1);
}

#[test]
fn a_cell_that_is_clicked_gives_its_command() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let status = dam(&[
        "map",
        VALVE,
        "--x",
        "camshaft.motion.speed=1500:2300 rpm:3",
        "--y",
        "valve.loads.spring.spring.preload=200:400 N:2",
        "--set",
        "run.duration=0.08",
        "-q",
        "--unchecked",
        "--out",
        out.to_str().unwrap(),
    ]);
    assert!(status.status.success(), "{}", text(&status.stderr));
    let page = std::fs::read_to_string(out.join("report.html")).unwrap();
    let script = r##"
        const panel = document.querySelector(".panels .pad"), box = panel.getBoundingClientRect();
        const at = { clientX: box.left + box.width * 0.9, clientY: box.top + box.height * 0.9, bubbles: true };
        panel.dispatchEvent(new PointerEvent("pointermove", at));
        const told = document.getElementById("cell").textContent;
        panel.dispatchEvent(new MouseEvent("click", at));
        return { told, command: document.getElementById("cell-command").textContent };
    "##;
    let Some(found) = asked(&page, script) else {
        return;
    };
    // The right column of the lower row.
    assert_eq!(
        found["command"],
        format!(
            "dam run {VALVE} --set run.duration=0.08 --set 'camshaft.motion.speed=2300 rpm' \
                 --set 'valve.loads.spring.spring.preload=200 N'"
        )
    );
    let map: Value = serde_json::from_slice(&std::fs::read(out.join("map.json")).unwrap()).unwrap();
    let told = found["told"].as_str().unwrap();
    let cause = map["panels"][0]["causes"][2].as_str().unwrap();
    assert!(
        told.contains(cause) && told.contains("valve.delta_abs = "),
        "{told}"
    );
}
