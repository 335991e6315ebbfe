//! The moving drawing of a page as files: an SVG that runs by itself and an animated GIF. Positions
//! are compared with the closed form of the slider-crank, and the GIF is decoded here.
//!
//! Needs Chromium, as the tests of `page`.

use crate::browser::{browser, dom};
use serde_json::Value;
use std::process::Command;

const SCENE: &str = "scenarios/kinetostatics/slider_crank.json";
const CRANK: f64 = 0.06;
const ROD: f64 = 0.3;

/// Presses both buttons of the page's drawing, four times as fast as normal: the film is of one
/// second.
const PRESS: &str = r##"<pre id="answer"></pre><script>addEventListener("load", async () => {
    const saved = [];
    HTMLAnchorElement.prototype.click = function () { saved.push(this.download); };
    const blobs = [];
    URL.createObjectURL = (blob) => { blobs.push(blob); return "#"; };
    const figure = document.querySelector("figure.moving"), pace = figure.querySelector("select");
    pace.value = 4;
    const press = (name) => [...figure.querySelectorAll("button")].find((one) => one.textContent === name).click();
    press("SVG"); press("GIF");
    while (blobs.length < 2) await new Promise((done) => setTimeout(done, 5));
    const [svg, gif] = [await blobs[0].text(), new Uint8Array(await blobs[1].arrayBuffer())];
    const read = new DOMParser().parseFromString(svg, "image/svg+xml");
    const tracks = (name) => [...read.querySelectorAll("title")].filter((one) => one.textContent === name)
        .map((one) => [...one.parentElement.children].filter((node) => node.tagName === "animateTransform")
            .map((node) => ({ type: node.getAttribute("type"), values: node.getAttribute("values"), at: node.getAttribute("keyTimes"), dur: node.getAttribute("dur") })));
    document.getElementById("answer").textContent = JSON.stringify({
        saved, wrong: read.querySelector("parsererror") !== null, outside: /href|url\((?!#)|var\(|@import/.test(svg),
        root: [read.documentElement.tagName, read.documentElement.getAttribute("width"), read.documentElement.getAttribute("height")],
        tracks: { slide: tracks("slide"), rod: tracks("rod"), crank: tracks("crank") },
        scale: JSON.parse(document.getElementById(figure.id + "-data").textContent).scale, gif: [...gif],
    });
});</script></body>"##;

/// What the buttons of the page saved.
fn pressed(browser: &str) -> Value {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let status = Command::new(env!("CARGO_BIN_EXE_dam"))
        .args(["kinematics", SCENE, "--quiet", "--out"])
        .arg(&out)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    let page = std::fs::read_to_string(out.join("report.html"))
        .unwrap_or_else(|error| panic!("{error}: {status:?}"));
    let dom = dom(browser, &page.replace("</body>", PRESS), folder.path());
    let answer = dom.split("<pre id=\"answer\">").nth(1).expect("an answer");
    let answer = answer.split("</pre>").next().unwrap().replace("&amp;", "&");
    serde_json::from_str(&answer).unwrap_or_else(|error| panic!("{error}: {answer:.300}"))
}

#[test]
fn the_moving_drawing_is_saved_as_svg_that_runs_by_itself_and_as_gif() {
    let Some(browser) = browser() else { return };
    let answer = pressed(&browser);
    assert_eq!(
        answer["saved"],
        serde_json::json!(["mechanism.svg", "mechanism.gif"])
    );
    assert_eq!(
        (&answer["wrong"], &answer["outside"]),
        (&false.into(), &false.into())
    );
    assert_eq!(answer["root"][0], "svg");
    positions_are_those_of_the_closed_form(&answer);
    film_shows_the_slide_where_it_is(&answer);
}

/// Numbers of each key of a track.
fn keys(track: &Value) -> Vec<Vec<f64>> {
    let values = track["values"].as_str().unwrap().split(';');
    let numbers = |key: &str| key.split(' ').map(|one| one.parse().unwrap()).collect();
    values.map(numbers).collect()
}

fn slide_at(angle: f64) -> f64 {
    CRANK * angle.cos() + (ROD * ROD - (CRANK * angle.sin()).powi(2)).sqrt()
}

fn positions_are_those_of_the_closed_form(answer: &Value) {
    let scale: Vec<f64> = serde_json::from_value(answer["scale"].clone()).unwrap();
    let [metres, x0, y0] = scale[..] else {
        panic!("{scale:?}")
    };
    let track = |name: &str, kind: &str| {
        let all = answer["tracks"][name][0].as_array().unwrap();
        let own = all.iter().find(|one| one["type"] == kind);
        own.unwrap_or_else(|| panic!("{name} {kind}: {all:?}"))
            .clone()
    };
    let (slide, rod, turn) = (
        keys(&track("slide", "translate")),
        keys(&track("rod", "translate")),
        keys(&track("rod", "rotate")),
    );
    let crank = keys(&track("crank", "rotate"));
    // Even keys need no times; one turn at 10 rad/s is played in a second here.
    assert!(track("slide", "translate")["at"].is_null());
    assert_eq!(track("slide", "translate")["dur"], "1s");
    assert!(slide.len() > 90 && rod.len() == slide.len() && turn.len() == slide.len());
    for key in 0..slide.len() {
        let angle = std::f64::consts::TAU * key as f64 / (slide.len() - 1) as f64;
        let near = |found: f64, expected: f64, what: &str| {
            assert!(
                (found - expected).abs() < 0.011,
                "{what} {key}: {found} {expected}"
            );
        };
        near(slide[key][0], x0 + slide_at(angle) / metres, "slide x");
        near(slide[key][1], y0, "slide y");
        near(rod[key][0], x0 + CRANK * angle.cos() / metres, "rod x");
        near(rod[key][1], y0 - CRANK * angle.sin() / metres, "rod y");
        // On the screen angles count clockwise.
        let tilt = (CRANK * angle.sin() / ROD).asin().to_degrees();
        near(turn[key][0], tilt, "rod angle");
        near(crank[key][0], -angle.to_degrees(), "crank angle");
    }
}

fn film_shows_the_slide_where_it_is(answer: &Value) {
    let bytes: Vec<u8> = serde_json::from_value(answer["gif"].clone()).unwrap();
    let film = Film::read(&bytes);
    let wide: usize = answer["root"][1].as_str().unwrap().parse().unwrap();
    let high: usize = answer["root"][2].as_str().unwrap().parse().unwrap();
    assert_eq!(film.size, [wide, high]);
    assert_eq!((film.frames.len(), film.hundredths), (25, 100));
    assert!(film.repeats);
    let scale: Vec<f64> = serde_json::from_value(answer["scale"].clone()).unwrap();
    // Above its pin the block has its colour where the slide is, and not where it is not.
    let seen = |frame: usize, x: f64| {
        let at =
            [scale[1] + x / scale[0], scale[2] - 0.02 / scale[0]].map(|one| one.round() as usize);
        film.frames[frame][at[1] * wide + at[0]]
    };
    let angle = |frame: usize| std::f64::consts::TAU * frame as f64 / 25.0;
    let block = seen(0, slide_at(0.0));
    for frame in 0..25 {
        let [here, there] = [0.0, std::f64::consts::PI].map(|more| slide_at(angle(frame) + more));
        assert_eq!(seen(frame, here), block, "frame {frame}");
        // Its block is 50 mm long.
        if (here - there).abs() > 0.06 {
            assert_ne!(seen(frame, there), block, "frame {frame}");
        }
    }
}

/// A GIF, decoded: colours of every frame as a whole picture.
struct Film {
    size: [usize; 2],
    repeats: bool,
    /// Time of all frames (1/100 s).
    hundredths: usize,
    frames: Vec<Vec<[u8; 3]>>,
}

impl Film {
    fn read(bytes: &[u8]) -> Self {
        assert_eq!(&bytes[..6], b"GIF89a");
        let two = |at: usize| usize::from(bytes[at]) + 256 * usize::from(bytes[at + 1]);
        let size = [two(6), two(8)];
        assert_eq!(bytes[10] & 0x87, 0x87, "256 colours for all frames");
        let colour = |k: u8| {
            let at = 13 + 3 * usize::from(k);
            [bytes[at], bytes[at + 1], bytes[at + 2]]
        };
        let (mut at, mut film) = (
            13 + 768,
            Self {
                size,
                repeats: false,
                hundredths: 0,
                frames: Vec::new(),
            },
        );
        let (mut seen, mut nothing) = (vec![[0; 3]; size[0] * size[1]], None);
        loop {
            match bytes[at] {
                0x3b => break,
                0x21 => {
                    match bytes[at + 1] {
                        0xf9 => {
                            film.hundredths += two(at + 4);
                            nothing = (bytes[at + 3] & 1 == 1).then_some(bytes[at + 6]);
                        }
                        kind => {
                            film.repeats = kind == 0xff && &bytes[at + 3..at + 14] == b"NETSCAPE2.0"
                        }
                    }
                    at = blocks(bytes, at + 2).1;
                }
                0x2c => {
                    let [x, y, wide, high] = [1, 3, 5, 7].map(|more| two(at + more));
                    let depth = u32::from(bytes[at + 10]);
                    let (data, next) = blocks(bytes, at + 11);
                    let pixels = unpacked(&data, depth);
                    assert_eq!(pixels.len(), wide * high, "frame {}", film.frames.len());
                    for (k, &pixel) in pixels
                        .iter()
                        .enumerate()
                        .filter(|one| Some(*one.1) != nothing)
                    {
                        seen[(y + k / wide) * size[0] + x + k % wide] = colour(pixel);
                    }
                    film.frames.push(seen.clone());
                    at = next;
                }
                other => panic!("block {other:#x} at {at}"),
            }
        }
        assert_eq!(at + 1, bytes.len(), "nothing behind the end");
        film
    }
}

/// The data of blocks from a place on, and the place behind them.
fn blocks(bytes: &[u8], mut at: usize) -> (Vec<u8>, usize) {
    let mut data = Vec::new();
    while bytes[at] > 0 {
        let end = at + 1 + usize::from(bytes[at]);
        data.extend(&bytes[at + 1..end]);
        at = end;
    }
    (data, at + 1)
}

/// Lempel, Ziv and Welch backwards, by the words themselves.
fn unpacked(data: &[u8], depth: u32) -> Vec<u8> {
    let (clear, end) = (1usize << depth, (1usize << depth) + 1);
    let fresh = || -> Vec<Vec<u8>> {
        (0..=end)
            .map(|k| vec![u8::try_from(k).unwrap_or(0)])
            .collect()
    };
    let (mut words, mut size, mut last): (_, _, Option<Vec<u8>>) = (fresh(), depth + 1, None);
    let (mut out, mut bit) = (Vec::new(), 0);
    loop {
        let code = (0..size as usize).fold(0, |sum, k| {
            let place = bit + k;
            sum | usize::from(data[place / 8] >> (place % 8) & 1) << k
        });
        bit += size as usize;
        if code == end {
            break out;
        }
        if code == clear {
            (words, size, last) = (fresh(), depth + 1, None);
            continue;
        }
        let word = match (&last, words.get(code)) {
            (_, Some(word)) => word.clone(),
            (Some(last), None) => [&last[..], &last[..1]].concat(),
            (None, None) => panic!("code {code} at the beginning"),
        };
        if let Some(last) = last {
            words.push([&last[..], &word[..1]].concat());
            if words.len() == 1 << size && size < 12 {
                size += 1;
            }
        }
        out.extend(&word);
        last = Some(word);
    }
}
