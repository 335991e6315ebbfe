//! Maps do not depend on the number of threads, nor on interruptions.

use dam::report::findings::Source;
use dam::report::map::{document, findings, map_rows, picture};
use dam::scene::{BuiltIn, Document};
use dam::studies::Control;
use dam::studies::axis::Axis;
use dam::studies::map::{Cell, Listener, MapResult, Panels, Question, Silent, Study, journal, map};
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Mutex;

fn load() -> Document {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios/rocker/two_masses.json");
    Document::parse("two_masses", &std::fs::read(path).unwrap()).unwrap()
}

/// A small map, in two panels.
fn small(document: &Document) -> Study<'_> {
    let axis = |text: &str| Axis::parse(text).unwrap();
    let question = Question {
        overrides: vec!["run.duration=0.3".to_owned()],
        x: axis("rocker.inertia=0.06:0.16:5"),
        y: Some(axis("rocker.stiffness=1e6:1e7:4:log")),
        panels: Panels::parse(&["rocker.loads.closing.constant=-600,-900".to_owned()]).unwrap(),
        figure: Some("rocker.delta_max".to_owned()),
        check_determined: true,
        digits: 7,
    };
    Study::new(document, &BuiltIn, question).unwrap()
}

fn run(
    study: &Study<'_>,
    known: BTreeMap<usize, Vec<Cell>>,
    threads: usize,
    listener: &dyn Listener,
) -> MapResult {
    map(study, known, Some(threads), &Control::default(), listener).unwrap()
}

fn everything(study: &Study<'_>, result: &MapResult) -> String {
    let document = document(study, result);
    let csv = map_rows(study, result).csv();
    let found = findings(study, result, &[], Vec::new(), Source::default());
    format!(
        "{document}{csv}{}{}",
        picture::svg(study, result),
        found.text(None) + &found.page()
    )
}

#[test]
fn the_same_bytes_for_any_number_of_threads() {
    let document = load();
    let study = small(&document);
    let one = everything(&study, &run(&study, BTreeMap::new(), 1, &Silent));
    for threads in [2, 5] {
        let other = everything(&study, &run(&study, BTreeMap::new(), threads, &Silent));
        assert!(one == other, "{threads} threads");
    }
    assert!(!one.contains("NaN") && !one.contains("inf"));
}

#[test]
fn panels_are_told_apart_everywhere() {
    let scene = load();
    let study = small(&scene);
    let result = run(&study, BTreeMap::new(), 2, &Silent);
    let command = ["dam", "run", "scene.json"].map(str::to_owned);
    let source = Source::scene(scene.text(), "");
    let found = findings(&study, &result, &command, Vec::new(), source);
    let (page, picture) = (found.page(), picture::svg(&study, &result));
    for (letter, load) in [("a", "-600"), ("b", "-900")] {
        let label = format!("{letter}  rocker.loads.closing.constant = {load}");
        assert!(picture.contains(&label), "{label}");
        let row = format!("<th class=\"left\">{letter}  load closing on rocker = {load}</th>");
        assert!(page.contains(&row), "{row}");
    }
    let places = page.split("<span class=\"sub\">at ").skip(1);
    let places: Vec<&str> = places.filter_map(|rest| rest.split('<').next()).collect();
    assert_eq!(places.len(), 4, "least and greatest of two panels");
    for place in places {
        assert!(place.contains("g m²; "), "{place}");
        assert!(place.contains("MN m/rad, "), "{place}");
    }
    let csv = map_rows(&study, &result).csv();
    let mut table = csv::Reader::from_reader(csv.as_bytes());
    let head: Vec<String> = table.headers().unwrap().iter().map(str::to_owned).collect();
    let wanted = [
        "panel",
        "settings",
        "rocker.inertia [kg m²]",
        "rocker.stiffness [N m/rad]",
        "rocker.delta_max [rad]",
    ];
    assert_eq!(head[..5], wanted);
    let rows: Vec<_> = table.records().map(Result::unwrap).collect();
    assert_eq!(rows.len(), 40);
    assert_eq!(&rows[39][1], "rocker.loads.closing.constant = -900");
    assert_eq!((&rows[39][2], &rows[39][3]), ("0.16", "1e7"));
    let json = document(&study, &result);
    assert_eq!(json["x"]["unit"], "kg m²");
    assert_eq!(json["y"]["unit"], "N m/rad");
}

#[test]
fn a_curve_of_which_half_would_lie_on_the_axis_is_logarithmic() {
    let document = load();
    let picture = |axis: &str| {
        let question = Question {
            overrides: vec!["run.duration=0.3".to_owned()],
            x: Axis::parse(axis).unwrap(),
            y: None,
            panels: Panels::parse(&[]).unwrap(),
            figure: Some("rocker.delta_max".to_owned()),
            check_determined: false,
            digits: 7,
        };
        let study = Study::new(&document, &BuiltIn, question).unwrap();
        let result = run(&study, BTreeMap::new(), 2, &Silent);
        let values: Vec<f64> = result.panels[0]
            .iter()
            .map(|cell| cell.as_ref().unwrap().value.unwrap())
            .collect();
        (values, picture::svg(&study, &result))
    };
    // From tens of µrad, with a sign, to being thrown off by radians.
    let (values, wide) = picture("shaft.motion.speed=100:900 rpm:9");
    assert!(values[0] < 0.0 && values[0] > -1e-3 && values[8] > 1.0);
    assert!(wide.contains("|greatest δ of rocker|, rad"));
    assert!(!wide.contains("NaN") && !wide.contains("inf"));
    // The first point stands near the floor, the last near the ceiling.
    let heights: Vec<f64> = (wide.split("class=\"mark ").skip(1))
        .filter_map(|mark| {
            mark.split("translate(")
                .nth(1)?
                .split(')')
                .next()?
                .split(' ')
                .nth(1)?
                .parse()
                .ok()
        })
        .collect();
    assert_eq!(heights.len(), 9);
    let share = |value: f64| (value.abs() / values[0].abs()).ln();
    let slope = (heights[8] - heights[0]) / share(values[8]);
    for (height, value) in heights.iter().zip(&values) {
        approx::assert_abs_diff_eq!(*height, heights[0] + slope * share(*value), epsilon = 0.2);
    }
    // Of one size, signs are read from the axis.
    let (values, plain) = picture("shaft.motion.speed=100:300 rpm:9");
    assert!(values.iter().all(|value| *value < 0.0));
    assert!(plain.contains("greatest δ of rocker, µrad") && !plain.contains("|greatest"));
}

/// Keeps the lines of a journal.
struct Lines(Mutex<String>);

impl Listener for Lines {
    fn row(&self, row: usize, cells: &[Cell]) -> Result<(), String> {
        self.0.lock().unwrap().push_str(&journal::row(row, cells));
        Ok(())
    }
}

#[test]
fn a_journal_torn_anywhere_gives_the_same_map() {
    let scene = load();
    let study = small(&scene);
    let lines = Lines(Mutex::new(journal::first_line(&study)));
    let whole = run(&study, BTreeMap::new(), 2, &lines);
    let wanted = everything(&study, &whole);
    let journal_text = lines.0.into_inner().unwrap();
    let bytes = journal_text.as_bytes();
    let head = journal::first_line(&study).len();
    for length in 0..=bytes.len() {
        let read = journal::read(&study, &bytes[..length]).unwrap();
        assert!(read.whole <= length);
        let ends = bytes[head.min(length)..length]
            .iter()
            .filter(|&&byte| byte == b'\n');
        assert_eq!(read.rows.len(), ends.count(), "cut at {length}");
        for (row, cells) in &read.rows {
            let (panel, range) = study.row(*row);
            let own = whole.panels[panel][range].iter().flatten();
            assert!(own.eq(cells), "row {row}, cut at {length}");
        }
    }
    // The rows that are missing are worked out again.
    for length in [head, bytes.len() / 2, bytes.len() - 1] {
        let known = journal::read(&study, &bytes[..length]).unwrap().rows;
        assert_eq!(everything(&study, &run(&study, known, 1, &Silent)), wanted);
    }
    // A byte changed in the middle: that line and all after it are not believed.
    let mut changed = bytes.to_vec();
    changed[head + 40] ^= 1;
    assert_eq!(journal::read(&study, &changed).unwrap().rows.len(), 0);
    // Another study's journal is refused.
    let shorter = Question {
        overrides: vec!["run.duration=0.2".to_owned()],
        x: study.x.clone(),
        y: study.y.clone(),
        panels: Panels::default(),
        figure: Some("rocker.delta_max".to_owned()),
        check_determined: true,
        digits: 7,
    };
    let other = Study::new(&scene, &BuiltIn, shorter).unwrap();
    assert!(
        journal::read(&other, bytes)
            .unwrap_err()
            .contains("another study")
    );
    assert!(
        journal::read(&study, b"something else\n")
            .unwrap_err()
            .contains("no journal")
    );
}
