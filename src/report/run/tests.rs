use super::{RunReport, findings};
use crate::dynamics::record::SwitchRow;
use crate::report::abscissa::Abscissa;
use crate::report::diagram::Diagram;
use crate::report::findings::Source;
use crate::report::fixture;
use crate::report::machine::Machine;

const SCENE: &str = "{\n  \"name\": \"</pre><script>alert(1)</script>\"\n}\n";

fn rendered(
    change: impl FnOnce(&mut crate::dynamics::record::Figures, &mut crate::dynamics::record::Record),
) -> String {
    let (mut figures, mut record) = fixture::run(2, 0.05, 200);
    change(&mut figures, &mut record);
    let (diagram, model) = (Diagram::of(&fixture::rocker(2)), fixture::rocker(2));
    let report = RunReport {
        over: &Abscissa::Time,
        figures: &figures,
        record: &record,
        diagram: &diagram,
        certificate: None,
        machine: Some(Machine {
            model: &model,
            cams: &[],
        }),
        spread: None,
    };
    findings(&report, Source::scene(SCENE, "")).page()
}

/// The data block of a page.
fn data(page: &str) -> serde_json::Value {
    let start = "<script id=\"data\" type=\"application/json\">";
    let from = page.find(start).unwrap() + start.len();
    let to = from + page[from..].find("</script>").unwrap();
    serde_json::from_str(&page[from..to]).unwrap()
}

#[test]
fn a_page_needs_nothing_from_outside_and_lets_nothing_in() {
    let page = rendered(|_, _| {});
    let outside = page.replace("http://www.w3.org/2000/svg", "");
    for forbidden in ["http:", "https:", "url(\"", "@import", "<link", " src="] {
        assert!(!outside.contains(forbidden), "{forbidden}");
    }
    assert!(!page.contains("<script>alert"));
    assert!(page.contains("&lt;two masses&gt;"));
    // Data and script of the plots, data and script of the player.
    assert_eq!(page.matches("</script>").count(), 4);
}

#[test]
fn the_data_of_the_plots_are_the_samples_of_the_record() {
    let page = rendered(|_, record| record.columns[0].values[3] = f64::NAN);
    let data = data(&page);
    let (_, record) = fixture::run(2, 0.05, 200);
    let plots = data["plots"].as_array().unwrap();
    let plot = plots
        .iter()
        .find(|plot| plot["id"] == "rocker.displacement")
        .unwrap();
    assert_eq!(plot["y"]["unit"], "rad");
    let column = plot["series"][0]["y"].as_u64().unwrap() as usize;
    let values = data["columns"][column].as_array().unwrap();
    assert_eq!(values.len(), record.times.len());
    assert!(values[3].is_null());
    approx::assert_relative_eq!(
        values[100].as_f64().unwrap(),
        record.columns[0].values[100],
        max_relative = 1e-8
    );
    let open = plot["bands"][0].as_array().unwrap();
    assert_eq!(open.len(), record.separations.len());
    // The drive has no δ and no contact: said in words instead of drawn.
    assert!(page.contains("Zero throughout: Acceleration"));
}

#[test]
fn long_lists_of_switches_fold_away_and_short_ones_do_not() {
    let row = |time| SwitchRow {
        time,
        object: "rocker".into(),
        what: "opens",
        flank: "lower",
        speed: 1.0,
    };
    let none = rendered(|_, record| record.switches.clear());
    assert!(none.contains("No contact separates or closes"));
    let many =
        rendered(|_, record| record.switches = (0..5000).map(|i| row(f64::from(i))).collect());
    assert!(many.contains(
        "<summary>the first 1000 of 5000 events, between 0 s and 999 s; all of them are in switches.csv</summary>"
    ));
}
