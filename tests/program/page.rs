//! Every kind of page draws itself in a browser, is zoomed and told of at the pointer, without a
//! network and without an error.
//!
//! Needs Chromium; where there is none the test says so and leaves it. With
//! `DAM_BROWSER` set (as `.ci/run` does) that browser must be there.

use crate::browser::{browser, dom};
use serde_json::Value;
use std::path::Path;
use std::process::Command;

/// What the page says of itself once its scripts and `PROBE` have run.
fn probed(browser: &str, page: &str, folder: &Path) -> Value {
    let probe = format!("<pre id=\"answer\"></pre><script>{PROBE}</script></body>");
    // Errors of the page's own scripts are told in the answer.
    let trap = "<head><script>window.failures = []; addEventListener('error', e => \
                failures.push(e.message));</script>";
    let page = page.replacen("<head>", trap, 1);
    let dom = dom(browser, &page.replace("</body>", &probe), folder);
    let drawing = dom.split("<script").next().unwrap_or_default();
    assert!(!drawing.contains("NaN"), "a coordinate is not a number");
    let answer = dom.split("<pre id=\"answer\">").nth(1).expect("an answer");
    let answer = answer.split("</pre>").next().unwrap_or_default();
    let plain = answer
        .replace("&lt;", "<")
        .replace("&gt;", ">")
        .replace("&amp;", "&");
    serde_json::from_str(&plain).unwrap_or_else(|error| panic!("{error}: {plain}"))
}

/// Points at every chart, drags over half of it, switches its first series off, goes back to
/// everything, and points at what moves.
const PROBE: &str = r##"
  const answer = { failures, plots: [], moving: null, answer: "" };
  const verdict = document.querySelector("header .verdict, main .verdict");
  answer.answer = verdict ? verdict.textContent.trim() : "";
  const tip = document.querySelector(".tip");
  for (const group of document.querySelectorAll("g.plot")) {
    const pad = group.querySelector(".pad"), box = pad.getBoundingClientRect();
    const at = (x, y) => ({ clientX: box.left + box.width * x, clientY: box.top + box.height * y, bubbles: true, button: 0, pointerId: 1, pointerType: "mouse" });
    const send = (kind, place) => pad.dispatchEvent(new PointerEvent(kind, place));
    const state = () => [".grid", ".inside", ".field", ".points"].map((name) => group.querySelector(name).innerHTML).join("");
    const data = page.plots[+group.dataset.plot];
    // Where values belong to points the pointer goes to the first of them.
    const spot = group.querySelector(".points .mark:not([visibility=hidden])");
    let told = "";
    for (let i = 0; i <= 20 && !told; i++) for (let j = 0; j <= 20 && !told; j++) {
      send("pointermove", at((i + 0.5) / 21, (j + 0.5) / 21));
      const cell = document.getElementById("cell");
      told = !tip.hidden ? tip.textContent : cell && cell.querySelector("b") ? cell.textContent : "";
    }
    const before = state();
    send("pointerdown", at(0.25, 0.25)); send("pointermove", at(0.7, 0.75)); send("pointerup", at(0.7, 0.75));
    const zoomed = state();
    pad.dispatchEvent(new MouseEvent("dblclick", at(0.5, 0.5)));
    const back = state();
    pad.dispatchEvent(new WheelEvent("wheel", { ...at(0.5, 0.5), deltaY: -1, ctrlKey: true, cancelable: true }));
    const wheeled = state();
    pad.dispatchEvent(new MouseEvent("dblclick", at(0.5, 0.5)));
    const entry = group.querySelector(".entry.switch");
    let switched = null;
    if (entry) {
      const index = entry.dataset.series, shown = () => (group.querySelector(`.inside [data-series="${index}"]`).getAttribute("d") || "") + group.querySelectorAll(`.points [data-series="${index}"] .mark:not([visibility=hidden])`).length;
      const full = shown();
      entry.dispatchEvent(new MouseEvent("click", { bubbles: true }));
      const off = shown();
      entry.dispatchEvent(new MouseEvent("click", { bubbles: true }));
      switched = off !== full && shown() === full;
    }
    // No label stands on another.
    const texts = [...group.querySelectorAll(".grid text, .legend text, .title")].filter((text) => text.textContent && getComputedStyle(text).visibility !== "hidden");
    const boxes = texts.map((text) => text.getBoundingClientRect());
    const clashes = [];
    for (let i = 0; i < boxes.length; i++) for (let j = 0; j < i; j++) {
      const [a, b] = [boxes[i], boxes[j]];
      if (a.left < b.right - 1 && b.left < a.right - 1 && a.top < b.bottom - 3 && b.top < a.bottom - 3) clashes.push(`${texts[i].textContent} | ${texts[j].textContent}`);
    }
    answer.plots.push({ title: data.title, told, zooms: before !== zoomed, resets: before === back, wheels: back !== wheeled, switched, clashes });
  }
  const moving = document.querySelector("svg.mechanism [data-link]");
  if (moving) {
    const box = moving.getBoundingClientRect();
    const middle = moving.querySelector("path, circle, line, rect") || moving;
    middle.dispatchEvent(new PointerEvent("pointermove", { clientX: box.left + box.width / 2, clientY: box.top + box.height / 2, bubbles: true }));
    answer.moving = tip.hidden ? "" : tip.textContent;
    const slider = document.querySelector("figure.moving input[type=range]");
    slider.value = slider.max / 3;
    slider.dispatchEvent(new Event("input"));
    answer.cursors = [...document.querySelectorAll(".pointer")].filter((line) => line.getAttribute("visibility") === "visible").length;
  }
  document.getElementById("answer").textContent = JSON.stringify(answer);
"##;

/// A five-bar whose rods are short enough that it has singular positions.
const FIVE_BAR: [&str; 6] = [
    "kinematics",
    "scenarios/linkages/five_bar.json",
    "--set",
    "bar.links.rod.points.C=[0.45, 0]",
    "--set",
    "bar.links.coupler.points.C=[0.45, 0]",
];

/// Commands that write a page: arguments, least number of charts, whether something moves.
const PAGES: [(&[&str], usize, bool); 19] = [
    (
        &[
            "identify",
            "scenarios/shafts/free_vibration.json",
            "--record",
            "scenarios/shafts/released_wheel.csv",
            "--match",
            "deflection=wheel.delta",
            "--vary",
            "wheel.stiffness=5000:12000",
            "--vary",
            "wheel.damping_capacity=0:1",
        ],
        2,
        false,
    ),
    (
        &[
            "optimize",
            "scenarios/rigid/rocker_in_order.json",
            "--vary",
            "rocker.inertia=0.05:0.2",
            "--vary",
            "rocker.loads.closing.constant=-900:-300",
            "--subject",
            "rocker.pair.margin >= 0",
            "--minimize",
            "rocker.peak_reaction",
            "--starts",
            "3",
        ],
        1,
        false,
    ),
    (
        &[
            "tolerance",
            "scenarios/rocker/one_mass.json",
            "--set",
            "run.duration=0.1",
            "--tol",
            "rocker.inertia=±1 %",
            "--tol",
            "rocker.stiffness=+2 -1 % uniform",
            "--figure",
            "rocker.delta_max",
            "--samples",
            "64",
        ],
        2,
        false,
    ),
    (&["run", "scenarios/valve_train/lift_off.json"], 6, true),
    (
        &[
            "compare",
            "scenarios/rocker/two_masses.json",
            "--over",
            "rocker.masses=1,2",
            "--set",
            "run.duration=0.1",
        ],
        4,
        false,
    ),
    (
        &[
            "map",
            "scenarios/rocker/two_masses.json",
            "--set",
            "run.duration=0.2",
            "--x",
            "rocker.inertia=0.05:1:5",
            "--y",
            "rocker.stiffness=0.25e7:5e7:4",
            "--panels",
            "rocker.masses=1,2",
            "--unchecked",
        ],
        2,
        false,
    ),
    (
        &[
            "map",
            "scenarios/valve_train/in_working_order.json",
            "--x",
            "camshaft.motion.speed=500:2500 rpm:5",
            "--unchecked",
        ],
        1,
        false,
    ),
    (
        &[
            "methods",
            "scenarios/rocker/one_mass.json",
            "--set",
            "run.duration=0.02",
            "--accuracy",
            "1e-6",
            "--repeats",
            "1",
            "--methods",
            "exact,rk4,taylor",
        ],
        2,
        false,
    ),
    (
        &[
            "methods",
            "scenarios/rocker/one_mass.json",
            "--set",
            "run.duration=0.02",
            "--x",
            "rocker.stiffness=1e6:1e8:3:log",
            "--repeats",
            "1",
            "--methods",
            "exact,rk4",
        ],
        2,
        false,
    ),
    (&["kinematics", "scenarios/linkages/shaper.json"], 6, true),
    (&FIVE_BAR, 6, true),
    (&["forces", "scenarios/linkages/five_bar.json"], 6, true),
    (
        &["forces", "scenarios/kinetostatics/slider_crank.json"],
        6,
        true,
    ),
    (&["steady", "scenarios/steady/engine.json"], 6, false),
    (&["cam", "scenarios/cams/indexing_dwells.json"], 5, true),
    (&["law", "show", "modified_sine"], 5, false),
    (
        &["linearise", "scenarios/rocker/ten_masses_closed.json"],
        1,
        false,
    ),
    (
        &["response", "scenarios/rocker/ten_masses_closed.json"],
        8,
        false,
    ),
    (
        &[
            "orders",
            "scenarios/valve_train/in_working_order.json",
            "--points",
            "20",
        ],
        2,
        false,
    ),
];

#[test]
fn every_page_draws_itself_zooms_and_tells_values_in_a_browser() {
    let Some(browser) = browser() else { return };
    for (arguments, least, moves) in PAGES {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("out");
        let status = Command::new(env!("CARGO_BIN_EXE_dam"))
            .args(arguments)
            .arg("--out")
            .arg(&out)
            .current_dir(env!("CARGO_MANIFEST_DIR"))
            .output()
            .unwrap();
        let name = format!("{} {}", arguments[0], arguments[1]);
        assert!(out.join("report.html").exists(), "{name}: {status:?}");
        let page = std::fs::read_to_string(out.join("report.html")).unwrap();
        let found = probed(&browser, &page, folder.path());
        assert_eq!(found["failures"], serde_json::json!([]), "{name}");
        assert!(
            found["answer"].as_str().unwrap().len() > 20,
            "{name}: {found}"
        );
        let plots = found["plots"].as_array().unwrap();
        assert!(plots.len() >= least, "{name}: only {} charts", plots.len());
        for plot in plots {
            let title = format!("{name}: {}", plot["title"]);
            assert!(
                !plot["told"].as_str().unwrap().is_empty(),
                "{title} tells nothing"
            );
            for does in ["zooms", "resets", "wheels"] {
                assert_eq!(plot[does], true, "{title} {does}");
            }
            assert_ne!(plot["switched"], false, "{title} switches");
            assert_eq!(plot["clashes"], serde_json::json!([]), "{title}");
        }
        if moves {
            assert!(
                found["moving"].as_str().unwrap().len() > 3,
                "{name}: {}",
                found["moving"]
            );
            assert!(
                found["cursors"].as_u64().unwrap() > 0,
                "{name}: no cursor goes along"
            );
        }
    }
}

/// The machine of several inputs has a slider for each: both move it, and where it cannot be
/// assembled that is said.
#[test]
fn every_input_has_a_slider_that_moves_the_machine() {
    let Some(browser) = browser() else { return };
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let status = Command::new(env!("CARGO_BIN_EXE_dam"))
        .args(FIVE_BAR)
        .arg("--out")
        .arg(&out)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    let page = std::fs::read_to_string(out.join("report.html"))
        .unwrap_or_else(|error| panic!("{error}: {status:?}"));
    let probe = r#"<script>addEventListener("load", () => {
        const figure = document.getElementById("inputs");
        const sliders = [...figure.querySelectorAll("input[type=range]")];
        const seen = () => [...figure.querySelectorAll("[data-link]")]
            .map((node) => node.getAttribute("visibility") + node.getAttribute("transform")).join();
        const moved = sliders.map((slider) => {
            const before = seen();
            slider.value = +slider.value + 2;
            slider.dispatchEvent(new Event("input"));
            return before !== seen();
        });
        let lost = false;
        const told = () => [...figure.querySelectorAll("output")].map((node) => node.textContent);
        for (let place = 0; place <= +sliders[0].max; place += 1) {
            sliders[0].value = place;
            sliders[0].dispatchEvent(new Event("input"));
            lost ||= told().includes("cannot be assembled") && seen().includes("hidden");
        }
        document.title = `moved ${moved} lost ${lost}`;
    });</script></body>"#;
    let dom = dom(&browser, &page.replace("</body>", probe), folder.path());
    assert!(dom.contains("<title>moved true,true lost true</title>"));
}

/// The page of a run of a scene.
fn page_of_run(scene: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let status = Command::new(env!("CARGO_BIN_EXE_dam"))
        .args(["run", scene, "--out"])
        .arg(&out)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    std::fs::read_to_string(out.join("report.html"))
        .unwrap_or_else(|error| panic!("{error}: {status:?}"))
}

/// What the player of the machine of a page moves.
fn machine_of(page: &str) -> Value {
    let data = page
        .split("id=\"machine-data\">")
        .nth(1)
        .expect("a machine");
    serde_json::from_str(data.split("</script>").next().unwrap()).expect("data")
}

/// Numbers of a text.
fn numbers_of(text: &str) -> Vec<f64> {
    let parts = text.split(|c: char| !(c.is_ascii_digit() || matches!(c, '.' | '-')));
    parts.filter_map(|part| part.parse().ok()).collect()
}

/// The toggle press drives its tool by the ram, which is its lowest part and not the rightmost pin
/// of its frame.
#[test]
fn the_line_to_what_an_output_drives_begins_at_the_output() {
    let page = page_of_run("scenarios/linkages/toggle_press.json");
    let line = page.split("class=\"join\" d=\"").nth(1).expect("a line");
    let line = numbers_of(line.split('"').next().unwrap());
    let station = page.split("<g data-first=\"").nth(1).unwrap();
    let station = station.split("transform=\"").nth(1).unwrap();
    let at = numbers_of(station.split('"').next().unwrap());
    let ram = page
        .split("class=\"link l")
        .find(|part| part.contains("<title>ram</title>"))
        .expect("the ram");
    let matrix = ram.split("matrix(").nth(1).expect("its place");
    let place = numbers_of(matrix.split(')').next().unwrap());
    let expected = [at[0] + place[4], at[1] + place[5]];
    for (found, expected) in line.iter().zip(expected) {
        assert!((found - expected).abs() < 2.5, "{line:?} {expected}");
    }
}

/// Loads on outputs of a linkage, and on a motor whose crank the linkage shows, are arrows on its
/// links; a displacement along x is loaded along x, however the link turns.
#[test]
fn loads_on_outputs_are_drawn_on_the_linkage() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let text = root.join("scenarios/linkages/slider_crank_spring.json");
    let text = std::fs::read_to_string(text).unwrap();
    let output = r#""slide": { "point": "slide.origin" }"#;
    let loaded =
        r#""slide": { "point": "slide.origin", "loads": { "work": { "constant": -50 } } }"#;
    assert!(text.contains(output));
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("scene.json");
    std::fs::write(&scene, text.replace(output, loaded)).unwrap();
    let machine = machine_of(&page_of_run(scene.to_str().unwrap()));
    let set = &machine["sets"][0];
    assert_eq!(set["caption"], "loads, longest mechanism.slide 50 N");
    let arrow = &set["on"][0];
    assert_eq!(arrow["fixed"], true);
    let by: [f64; 2] = serde_json::from_value(arrow["by"].clone()).unwrap();
    assert!(by[0] > 0.0 && by[1].abs() < 1e-9 * by[0], "{by:?}");
    let machine = machine_of(&page_of_run("scenarios/linkages/cam_on_a_coupler.json"));
    let caption = machine["sets"][0]["caption"].as_str().unwrap();
    assert_eq!(caption, "loads, longest motor 2 N m");
}

/// A motor whose cam the follower's picture shows has the arrow of its moment on that cam, square to
/// the radius and in the sense in which the cam turns.
#[test]
fn the_moment_of_a_motor_is_drawn_on_its_cam() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let text = root.join("scenarios/cams/flat_tappet.json");
    let text = std::fs::read_to_string(text).unwrap();
    let moved = r#""motion": { "speed": "3000 rpm" }"#;
    let motor = r#""motor": { "inertia": "0.02 kg m^2", "speed": "3000 rpm",
                              "torque": { "constant": "2 N m" } }"#;
    assert!(text.contains(moved));
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("scene.json");
    std::fs::write(&scene, text.replace(moved, motor)).unwrap();
    let machine = machine_of(&page_of_run(scene.to_str().unwrap()));
    let set = &machine["sets"][0];
    let caption = set["caption"].as_str().unwrap();
    assert!(caption.contains("camshaft 2 N m"), "{caption}");
    let all = set["on"].as_array().unwrap();
    let named = caption.strip_prefix("loads, longest ").unwrap();
    let place = named
        .split(", ")
        .position(|one| one.starts_with("camshaft"));
    let arrow = &all[place.unwrap()];
    let vector = |key: &str| -> [f64; 2] { serde_json::from_value(arrow[key].clone()).unwrap() };
    let ([x, y], [dx, dy]) = (vector("at"), vector("by"));
    assert!(x.hypot(y) > 10.0 && dx.hypot(dy) > 10.0, "{arrow}");
    assert!(
        (x * dx + y * dy).abs() < 1e-9,
        "square to the radius: {arrow}"
    );
    // Counterclockwise, as the cam turns, with y downwards.
    assert!(x * dy - y * dx < 0.0, "{arrow}");
}

/// Charts are saved as they look, as SVG and as PNG, under the name of what they show, without
/// anything from outside; on paper there are no buttons.
#[test]
fn charts_are_saved_as_pictures() {
    let Some(browser) = browser() else { return };
    let folder = tempfile::tempdir().unwrap();
    let page = page_of_run("scenarios/valve_train/in_working_order.json");
    let probe = r##"<pre id="answer"></pre><script>addEventListener("load", async () => {
        const saved = [], blobs = [];
        HTMLAnchorElement.prototype.click = function () { saved.push(this.download); };
        URL.createObjectURL = (blob) => { blobs.push(blob); return "#"; };
        // What a file is made of is known at once: reading it takes time.
        window.Blob = class extends Blob { constructor(parts, kind) { super(parts, kind); this.parts = parts; } };
        const charts = [...document.querySelectorAll(".chart")];
        const chart = charts.find((one) => one.querySelector("svg").getAttribute("aria-label").startsWith("Contact force"));
        chart.querySelectorAll(".saves button").forEach((button) => button.click());
        // Messages take none of the browser's virtual time, which would be over before a picture is drawn.
        const turn = () => new Promise((done) => { const { port1, port2 } = new MessageChannel(); port1.onmessage = done; port2.postMessage(0); });
        for (let left = 3e6; blobs.length < 2 && left > 0; left--) await turn();
        const named = (type) => blobs.find((blob) => blob.type === type);
        const svg = named("image/svg+xml").parts[0];
        const png = named("image/png").parts[0];
        const read = new DOMParser().parseFromString(svg, "image/svg+xml"), root = read.documentElement;
        const curve = read.querySelector(".curve"), size = (at) => new DataView(png.buffer).getUint32(at);
        document.getElementById("answer").textContent = JSON.stringify({
            all: charts.every((one) => one.querySelectorAll(".saves button").length === 2),
            saved: saved.sort(), wrong: read.querySelector("parsererror") !== null,
            outside: /href|url\((?!&quot;#|#)|var\(|@import/.test(svg),
            curve: curve.getAttribute("d").length, colour: curve.getAttribute("stroke"),
            wide: [2 * root.getAttribute("width"), size(16)], high: [2 * root.getAttribute("height"), size(20)],
            begins: String.fromCharCode(...png.slice(1, 4)),
        });
    });</script></body>"##;
    let dom = dom(&browser, &page.replace("</body>", probe), folder.path());
    let answer = dom.split("<pre id=\"answer\">").nth(1).unwrap();
    let answer: Value = serde_json::from_str(answer.split("</pre>").next().unwrap()).unwrap();
    assert_eq!(answer["all"], true);
    let names = ["valve.contact-force.png", "valve.contact-force.svg"];
    assert_eq!(answer["saved"], serde_json::json!(names));
    assert_eq!(
        [&answer["wrong"], &answer["outside"]],
        [false; 2],
        "{answer}"
    );
    assert!(answer["curve"].as_u64().unwrap() > 200, "{answer}");
    assert!(
        answer["colour"].as_str().unwrap().starts_with("rgb"),
        "{answer}"
    );
    assert_eq!(answer["begins"], "PNG");
    for side in ["wide", "high"] {
        let [of_svg, of_png] = [0, 1].map(|at| answer[side][at].as_f64().unwrap());
        assert!((of_svg - of_png).abs() <= 1.0, "{answer}");
    }
    let printed = page
        .split("@media print {")
        .find(|part| part.contains(".chart .saves,"));
    assert!(printed.is_some(), "buttons are printed");
}

/// On paper charts beside each other are drawn for half of it: their letters keep their size; long
/// titles have smaller ones.
#[test]
fn printed_charts_are_drawn_for_the_room_on_paper() {
    let Some(browser) = browser() else { return };
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    Command::new(env!("CARGO_BIN_EXE_dam"))
        .args(["kinematics", "scenarios/linkages/shaper.json", "--out"])
        .arg(&out)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    let page = std::fs::read_to_string(out.join("report.html")).unwrap();
    let probe = r##"<pre id="answer"></pre><script>addEventListener("load", () => {
        const charts = [...document.querySelectorAll(".plots:not(.single) svg.dam-plot")];
        const widths = () => charts.map((svg) => svg.viewBox.baseVal.width);
        const cut = () => charts.filter((svg) => { const title = svg.querySelector(".title"); return title.getBBox().x + title.getBBox().width > svg.viewBox.baseVal.width; }).length;
        const before = widths();
        dispatchEvent(new Event("beforeprint"));
        const printed = widths(), lost = cut();
        dispatchEvent(new Event("afterprint"));
        document.getElementById("answer").textContent = JSON.stringify({ before, printed, lost, after: widths() });
    });</script></body>"##;
    let dom = dom(&browser, &page.replace("</body>", probe), folder.path());
    let answer = dom.split("<pre id=\"answer\">").nth(1).unwrap();
    let answer: Value = serde_json::from_str(answer.split("</pre>").next().unwrap()).unwrap();
    let printed = answer["printed"].as_array().unwrap();
    assert!(
        printed.len() > 6 && printed.iter().all(|one| *one == 338),
        "{answer}"
    );
    assert_eq!(answer["lost"], 0, "{answer}");
    assert_eq!(answer["before"], answer["after"]);
}

/// Pages name results and parameters in words: in heads of tables, on axes, in legends and titles.
/// The address of a result stands small below its words.
#[test]
fn pages_name_results_and_parameters_in_words() {
    let page = |arguments: &[&str]| {
        let folder = tempfile::tempdir().unwrap();
        let out = folder.path().join("out");
        let status = Command::new(env!("CARGO_BIN_EXE_dam"))
            .args(arguments)
            .arg("--out")
            .arg(&out)
            .current_dir(env!("CARGO_MANIFEST_DIR"))
            .output()
            .unwrap();
        let page = std::fs::read_to_string(out.join("report.html"));
        page.unwrap_or_else(|error| panic!("{error}: {status:?}"))
    };
    let rocker = "scenarios/rocker/two_masses.json";
    let delta = "greatest <span class=\"nobr\">|δ|</span> of rocker<span class=\"sub\">rocker.delta_abs</span>";
    let short = ["--set", "run.duration=0.05"];
    let spread = page(&[&["run", rocker, "--spread"][..], &short[..]].concat());
    assert!(spread.contains(delta));
    let accuracy = ["run", rocker, "--accuracy", "rocker.delta_abs=1 %"];
    let accuracy = page(&[&accuracy[..], &short[..]].concat());
    assert!(accuracy.contains(delta));
    assert!(
        accuracy.contains(r#""label":"greatest |δ| of rocker""#),
        "the chart"
    );
    let vary = [
        "--vary",
        "crank.motor.inertia=0.1:1:4",
        "--subject",
        "steady.fluctuation <= 10 %",
    ];
    let found = [
        "find",
        "scenarios/steady/engine.json",
        "--minimize",
        "crank.motor.inertia",
    ];
    let found = page(&[&found[..], &vary[..]].concat());
    assert!(
        found.contains("The least motor inertia of crank is"),
        "the answer"
    );
    assert!(
        found.contains(r#""name":"motor inertia of crank","#),
        "the axis"
    );
    assert!(
        found.contains(r#""title":"Coefficient of speed fluctuation""#),
        "the title"
    );
    let map = [
        "map",
        rocker,
        "--x",
        "rocker.inertia=0.05:0.5:2",
        "--unchecked",
    ];
    let panels = ["--panels", "rocker.masses=1,2"];
    let map = page(&[&map[..], &panels[..], &short[..]].concat());
    assert!(map.contains(r#""name":"inertia of rocker","#), "the axis");
    assert!(map.contains("masses of rocker = 2"), "a panel");
}

/// What drives an input that turns is a moment: in the answer, in titles and in tables.
#[test]
fn forces_of_an_input_that_turns_are_moments() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    Command::new(env!("CARGO_BIN_EXE_dam"))
        .args([
            "forces",
            "scenarios/kinetostatics/slider_crank.json",
            "--out",
        ])
        .arg(&out)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    let page = std::fs::read_to_string(out.join("report.html")).unwrap();
    for words in [
        "<b>Driving moment from ",
        ">Driving moment, power, efficiency</h2>",
        ">Sensitivity of the driving moment</h2>",
        "<dt>mean driving moment</dt>",
        ">of the driving moment</th>",
        "driving moment<span class=\"sub\">drive</span>",
        "force at corner 2 of P03<span class=\"sub\">P03.n2</span>",
        r#""title":"Driving moment""#,
    ] {
        assert!(page.contains(words), "{words}");
    }
    let before_scene = page.split(">Scene</h2>").next().unwrap();
    assert!(!before_scene.to_lowercase().contains("driving force"));
}

/// Forces of one position may be far smaller than the greatest of all: arrows have a scale for
/// each position, and tell then what the longest is.
#[test]
fn arrows_have_a_scale_for_each_position() {
    let Some(browser) = browser() else { return };
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    Command::new(env!("CARGO_BIN_EXE_dam"))
        .args(["forces", "scenarios/linkages/toggle_press.json", "--out"])
        .arg(&out)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    let page = std::fs::read_to_string(out.join("report.html")).unwrap();
    let probe = r##"<script>addEventListener("load", () => {
        const figure = document.getElementById("mechanism");
        const longest = () => Math.max(...[...figure.querySelectorAll("[data-set='0'] line")]
            .filter((line) => line.getAttribute("visibility") !== "hidden")
            .map((line) => Math.hypot(...["x", "y"].map((k) => line.getAttribute(k + 2) - line.getAttribute(k + 1)))));
        const choice = [...figure.querySelectorAll("select")].find((one) => one.options[0].text === "one scale");
        const set = (value) => { choice.value = value; choice.dispatchEvent(new Event("change")); return longest(); };
        const [one, tenfold, each] = [set(1), set(10), set(0)];
        const slider = figure.querySelector("input[type=range]");
        slider.value = slider.max / 3;
        slider.dispatchEvent(new Event("input"));
        const other = longest(), caption = figure.querySelector("label input[type=checkbox]").parentElement.textContent;
        document.title = `tenfold ${Math.abs(tenfold - 10 * one) < 1e-6 * tenfold} larger ${each > 2 * one} `
            + `same ${Math.abs(each - other) < 0.1} told ${caption.includes("longest here")}`;
    });</script></body>"##;
    let dom = dom(&browser, &page.replace("</body>", probe), folder.path());
    let title = dom
        .split("<title>")
        .nth(1)
        .unwrap()
        .split("</title>")
        .next();
    assert_eq!(title, Some("tenfold true larger true same true told true"));
}
