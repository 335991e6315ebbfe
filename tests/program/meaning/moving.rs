//! The machine moving on the page of a run.

use super::{ROCKER, asked, dam, element, text};
use serde_json::Value;

/// The page of a run, and the data of its player.
fn page(scene: &str, settings: &[&str]) -> (String, Value) {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let mut arguments = vec!["run", scene, "-q", "--out", out.to_str().unwrap()];
    for setting in settings {
        arguments.extend(["--set", setting]);
    }
    let output = dam(&arguments);
    let page = std::fs::read_to_string(out.join("report.html"))
        .unwrap_or_else(|_| panic!("{}", text(&output.stderr)));
    let data = element(&page, "machine-data");
    (page, data)
}

/// The first series of a chart of a page.
fn plotted<'a>(page: &'a Value, id: &str) -> &'a Value {
    let plots = page["plots"].as_array().unwrap();
    &plots.iter().find(|plot| plot["id"] == id).unwrap()["series"][0]
}

#[test]
fn every_object_is_drawn_moving_and_its_deflection_is_seen() {
    let (page, player) = page(ROCKER, &["run.duration=0.1"]);
    let bodies = player["bodies"].as_array().unwrap();
    let parts = page.matches("data-link=\"").count();
    assert_eq!(bodies.len(), parts);
    // The shaft once, the rocker on its law and magnified.
    let shown: Vec<&str> = bodies
        .iter()
        .map(|body| body["shown"].as_str().unwrap())
        .collect();
    assert_eq!(shown, ["true", "law", "magnified"]);
    assert!(bodies.iter().all(|body| body["kind"] == "turn"));
    let factor = player["magnify"]["factor"].as_f64().unwrap();
    let plots = element(&page, "data");
    let column = player["columns"][1]["deviation"].as_u64().unwrap();
    assert_eq!(
        column,
        plotted(&plots, "rocker.delta")["y"].as_u64().unwrap()
    );
    let values = plots["columns"][column as usize].as_array().unwrap();
    let most = values
        .iter()
        .map(|v| v.as_f64().unwrap().abs())
        .fold(0.0, f64::max);
    // The lever has 76 pixels: its tip goes some pixels, and not out of the picture.
    let pixels = 76.0 * most * factor;
    assert!((4.0..=15.0).contains(&pixels), "{pixels} at {factor}");
}

/// The links of the drawing stand where an independent closure puts them.
#[test]
fn a_linkage_is_drawn_to_scale_where_it_is() {
    let (page, player) = page("scenarios/kinetostatics/slider_crank.json", &[]);
    let body = &player["bodies"]
        .as_array()
        .unwrap()
        .iter()
        .find(|body| body["kind"] == "over")
        .expect("a linkage")
        .clone();
    let table: Vec<f64> = body["table"]
        .as_array()
        .unwrap()
        .iter()
        .map(|v| v.as_f64().unwrap())
        .collect();
    let count = table.len() / 4;
    // The crank turns about its pivot by its input coordinate, from first to last.
    let [from, to] = ["from", "to"].map(|name| body[name].as_f64().unwrap());
    let angle = |place: usize| table[4 * place + 3].atan2(table[4 * place + 2]);
    for place in 0..count {
        let input = from + (to - from) * place as f64 / (count - 1) as f64;
        let off = angle(place) - angle(0) - (input - from);
        let off =
            (off + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU) - std::f64::consts::PI;
        assert!(off.abs() < 1e-5, "{place}: {off}");
        assert!((table[4 * place] - table[0]).abs() < 0.02);
    }
    // The drive is shown where it turns the crank: the linkage is the only station, to scale.
    assert_eq!(page.matches("data-first=").count(), 1);
    assert!(page.contains("class=\"dim scale\""));
}

#[test]
fn a_follower_rides_on_its_cam() {
    let (_, player) = page("scenarios/cams/flat_tappet.json", &[]);
    let bodies = player["bodies"].as_array().unwrap();
    let columns = player["columns"].as_array().unwrap().len();
    assert!(columns >= 2);
    let kinds: Vec<&str> = bodies
        .iter()
        .map(|body| body["kind"].as_str().unwrap())
        .collect();
    assert!(
        kinds.contains(&"slide") && kinds.contains(&"turn"),
        "{kinds:?}"
    );
    // The cam turns as its shaft does, counterclockwise or the other way, by the same angle.
    for body in bodies.iter().filter(|body| body["kind"] == "turn") {
        assert_eq!(body["sense"].as_f64().unwrap().abs(), 1.0);
    }
}

#[test]
fn scripts_of_the_page_know_the_units_that_take_prefixes() {
    let (page, _) = page(ROCKER, &["run.duration=0.02"]);
    assert!(page.contains(
        r#"const TAKE_ALL = ["N", "J", "W", "Pa", "Hz", "Nm"], TAKE_SMALL = ["s", "m", "rad"];"#
    ));
}

#[test]
fn machine_and_cursors_go_together() {
    let (page, player) = page(ROCKER, &["run.duration=0.1"]);
    let script = r##"
        const instant = (time) => document.dispatchEvent(new CustomEvent("instant", { detail: { axis: "t s", value: time, by: "plots" } }));
        const poses = () => [...document.querySelectorAll("#machine [data-link]")].map((node) => node.getAttribute("transform").match(/-?[\d.]+(e-?\d+)?/g).map(Number));
        const cursors = () => [...document.querySelectorAll(".pointer")].filter((line) => line.getAttribute("visibility") === "visible").length;
        const before = cursors();
        instant(0.013);
        const at = poses(), shown = cursors();
        const choice = [...document.querySelectorAll("#machine select")].pop();
        choice.value = "1"; choice.dispatchEvent(new Event("change"));
        const plain = poses();
        // The slider of the player leads the cursors.
        const slider = document.querySelector("#machine input[type=range]");
        slider.value = slider.max / 2; slider.dispatchEvent(new Event("input"));
        const pointer = document.querySelector(".pointer");
        return { before, shown, at, plain, x: +pointer.getAttribute("x1"), reading: document.querySelector("#machine output").textContent };
    "##;
    let Some(found) = asked(&page, script) else {
        return;
    };
    assert_eq!(found["before"], 0);
    assert!(found["shown"].as_u64().unwrap() >= 4, "{found}");
    let pose = |list: &Value, part: usize| -> Vec<f64> {
        list[part]
            .as_array()
            .unwrap()
            .iter()
            .map(|v| v.as_f64().unwrap())
            .collect()
    };
    let angle = |pose: &[f64]| pose[2].atan2(pose[0]);
    // The shaft turns at 10 rev/s.
    let shaft = angle(&pose(&found["at"], 0)) - std::f64::consts::TAU * 0.13;
    assert!(shaft.abs() < 1e-6, "{shaft}");
    // The lever: its law, and its law with the deflection magnified.
    let plots = element(&page, "data");
    let values = |id: &str, quantity: &str| {
        let series = plotted(&plots, &format!("{id}.{quantity}"));
        let column = |name: &str| &plots["columns"][series[name].as_u64().unwrap() as usize];
        let times = column("x").as_array().unwrap();
        let row = times
            .iter()
            .position(|t| t.as_f64().unwrap() >= 0.013 - 1e-12)
            .unwrap();
        column("y")[row].as_f64().unwrap()
    };
    let offset = player["bodies"][1]["offset"].as_f64().unwrap();
    let (phi, delta) = (values("rocker", "displacement"), values("rocker", "delta"));
    let factor = player["magnify"]["factor"].as_f64().unwrap();
    for (part, list, wanted) in [
        (1, &found["at"], phi - delta),
        (2, &found["at"], phi - delta + factor * delta),
        (2, &found["plain"], phi),
    ] {
        let off = angle(&pose(list, part)) - offset - wanted;
        assert!(off.abs() < 1e-5, "part {part}: {off}");
    }
    assert!(factor > 1.0 && delta.abs() > 1e-6);
    assert!(
        found["reading"].as_str().unwrap().contains("0.05 s"),
        "{found}"
    );
}
