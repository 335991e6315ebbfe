//! What the page's script shows of an axis is what was drawn: both follow one rule.
//!
//! Needs Chromium; where there is none the test says so and leaves it. With `DAM_BROWSER` set
//! (as `.ci/run` does) that browser must be there.

use super::Axis;
use super::page::NUMBERS;
use super::scale::{Scale, Tick};
use crate::report::quantity::{significant, with_unit};
use serde_json::{Value, json};

#[path = "../../../tests/program/browser.rs"]
mod page_in;

use page_in::{browser, dom};

/// What an expression over `cases` comes to behind the numbers of the script.
fn told(browser: &str, cases: &Value, expression: &str) -> Value {
    let folder = tempfile::tempdir().unwrap();
    let page = format!(
        "<!DOCTYPE html><meta charset=\"utf-8\"><pre id=\"answer\"></pre>\
         <script id=\"data\" type=\"application/json\">{cases}</script>\n<script>{NUMBERS}\n\
         const page = JSON.parse(document.getElementById(\"data\").textContent);\n\
         document.getElementById(\"answer\").textContent = JSON.stringify({expression});</script>"
    );
    let dom = dom(browser, &page, folder.path());
    let answer = dom.split("<pre id=\"answer\">").nth(1).expect("an answer");
    serde_json::from_str(answer.split("</pre>").next().unwrap()).expect(answer)
}

const ENDS: [[f64; 2]; 16] = [
    [0.0, 1.0],
    [-0.34, 7.6],
    [1e-3, 1.0],
    [0.9, 1.1],
    [1e-9, 1e4],
    [2e-7, 3e-5],
    [123456.7, 123457.9],
    [-2e-6, 5e-6],
    [4.0, 4.5e3],
    [1e-12, 9e-12],
    [-1e9, 2e9],
    [0.02, 0.3],
    [0.0, 360.0],
    [93.0, 142.0],
    [0.0, 13279.0],
    [-4.3, 4.3],
];

#[test]
fn ticks_of_the_script_are_those_that_were_drawn() {
    let Some(browser) = browser() else { return };
    let (mut cases, mut drawn) = (Vec::new(), Vec::new());
    for ends in ENDS {
        for (log, unit) in [
            (false, "m"),
            (false, "N m"),
            (true, "s"),
            (true, ""),
            (false, "kg m²"),
            (false, "deg"),
        ] {
            for pixels in [60.0, 240.0, 579.0, 1184.0] {
                if log && ends[0] <= 0.0 {
                    continue;
                }
                let axis = Axis {
                    log,
                    ..Axis::new("x", unit)
                };
                let scale = Scale::new(&axis, ends);
                let tick = |tick: &Tick| json!([tick.share, tick.label]);
                let ticks = scale.ticks(pixels, 78.0);
                drawn.push(json!({
                    "unit": scale.unit,
                    "ticks": ticks.iter().map(tick).collect::<Vec<_>>(),
                }));
                cases.push(json!({
                    "axis": { "log": log, "unit": unit, "rows": [], "fixed": false },
                    "ends": scale.ends, "pixels": pixels,
                }));
            }
        }
    }
    let found = told(
        &browser,
        &json!(cases),
        "page.map(({ axis, ends, pixels }) => ({ unit: numbers.shown(axis, ends).unit, \
         ticks: numbers.marksOf(axis, ends, pixels, 78)\
         .map(([at, label]) => [(at - ends[0]) / (ends[1] - ends[0]), label]) }))",
    );
    for ((case, drawn), found) in cases.iter().zip(&drawn).zip(found.as_array().unwrap()) {
        assert_eq!(drawn["unit"], found["unit"], "{case}");
        let [drawn, found] = [drawn, found].map(|one| one["ticks"].as_array().unwrap());
        assert_eq!(drawn.len(), found.len(), "{case}: {drawn:?} {found:?}");
        for (one, other) in drawn.iter().zip(found) {
            assert_eq!(one[1], other[1], "{case}");
            let [one, other] = [one, other].map(|tick| tick[0].as_f64().unwrap());
            assert!((one - other).abs() < 1e-9, "{case}: {one} {other}");
        }
    }
}

#[test]
fn numbers_of_the_script_are_those_of_the_page() {
    let Some(browser) = browser() else { return };
    let sizes = [
        1.0, 9.9999999, 123456.7, 2.5e-4, 1.5e-9, 3e-17, 7.25e7, 999.9, 0.05,
    ];
    let units = [
        "m", "N", "N m", "rad/s", "kg", "kg m²", "m²", "s", "deg", "1/rad", "",
    ];
    let mut cases = Vec::new();
    for size in sizes
        .into_iter()
        .flat_map(|size| [size, -size])
        .chain([0.0])
    {
        for unit in units {
            for digits in [3, 6] {
                cases.push((size, unit, digits));
            }
        }
    }
    let found = told(
        &browser,
        &json!(cases),
        "page.map(([value, unit, digits]) => \
         [numbers.significant(value, digits), numbers.withUnit(value, unit, digits)])",
    );
    for (&(value, unit, digits), found) in cases.iter().zip(found.as_array().unwrap()) {
        let own = [significant(value, digits), with_unit(value, unit, digits)];
        assert_eq!(json!(own), *found, "{value} {unit} {digits}");
    }
}
