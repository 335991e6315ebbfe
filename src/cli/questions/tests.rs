//! What a window may ask, and that it is told what the command line tells.

use super::{Program, TABS, arguments, fields};
use crate::budget::Budget;
use crate::frontend::scene::{BuiltIn, Folder};
use crate::studio::commands::{CommandScene, Commands, Question};
use serde_json::{Value, json};
use std::path::Path;
use std::sync::atomic::AtomicBool;

fn question(value: Value) -> Question {
    serde_json::from_value(value).unwrap()
}

fn text(scene: &str) -> String {
    std::fs::read_to_string(format!("scenarios/{scene}.json")).unwrap()
}

/// Asks of a scene's text.
fn with<T>(text: &str, ask: impl FnOnce(&CommandScene<'_>) -> T) -> T {
    ask(&CommandScene {
        name: "scene.json",
        text,
        catalogue: &BuiltIn,
        budget: Budget::FREE,
        tell: &|_, _, _| {},
    })
}

#[test]
fn forms_are_the_options_of_the_commands_and_none_names_a_file() {
    for tab in TABS {
        assert!(
            !fields::command_purpose(tab.command).is_empty(),
            "{}",
            tab.command
        );
        let all = fields::of(tab.command);
        // All that linear equations are asked of is in the scene.
        assert!(!all.is_empty() || tab.command == "linearise");
        for field in all {
            assert!(!field.help.is_empty(), "{}", field.name);
            let files = [
                "out",
                "force",
                "record",
                "table",
                "scene",
                "set",
                "time-limit",
            ];
            assert!(!files.contains(&field.name.as_str()), "{}", field.name);
        }
    }
    let of = |command, name: &str| {
        let all = fields::of(command);
        all.into_iter().find(|field| field.name == name).unwrap()
    };
    assert_eq!(of("kinematics", "positions").default, "360");
    assert_eq!(of("kinematics", "time").sort, fields::Sort::Optional);
    assert_eq!(of("kinematics", "speed").sort, fields::Sort::Lines);
    assert_eq!(of("forces", "compare-massless").sort, fields::Sort::Text);
    assert_eq!(of("steady", "balance").sort, fields::Sort::Flag);
    assert_eq!(of("steady", "mean").choices[2][0], "midrange");
    assert!(of("law show", "law").required && of("law cycle", "of").required);
}

#[test]
fn a_value_is_one_argument_and_options_of_terminals_are_none() {
    let sly = json!({ "command": "cam", "options": { "speed": ["1 rpm --out=/tmp/x"] } });
    let all = arguments(&question(sly)).unwrap();
    assert_eq!(all[2], "--speed=1 rpm --out=/tmp/x");
    let sly = json!({ "command": "law show", "options": { "law": ["--out=/tmp/x"] } });
    let all = arguments(&question(sly)).unwrap();
    assert_eq!(&all[all.len() - 2..], ["--", "--out=/tmp/x"]);
    for (command, option) in [
        ("kinematics", "out"),
        ("forces", "record"),
        ("steady", "table"),
        ("run", "out"),
        ("run", "set"),
    ] {
        let asked = json!({ "command": command, "options": { option: ["x"] } });
        let refused = arguments(&question(asked)).unwrap_err();
        assert_eq!(refused, format!("`{command}` has no option `{option}`"));
    }
    for command in ["studio", "compare", "kinematics --out", ""] {
        let refused = arguments(&question(json!({ "command": command }))).unwrap_err();
        assert_eq!(refused, format!("`{command}` is no question"));
    }
}

#[test]
fn scenes_say_which_questions_they_fit() {
    let fits = |scene: &str| {
        let forms = with(&text(scene), |asked| Program.forms(asked));
        assert_eq!(forms["fits"], true, "{scene}");
        let all = forms["questions"].as_array().unwrap().iter();
        let fit = all.filter(|one| one["why"].is_null());
        fit.map(|one| one["command"].as_str().unwrap().to_owned())
            .collect::<Vec<_>>()
    };
    let any = ["find", "law show", "law synthesize", "methods", "reduce"];
    let fitting = |own: &[&str]| -> Vec<String> {
        let all = TABS.iter().map(|tab| tab.command);
        all.filter(|one| own.contains(one) || any.contains(one))
            .map(str::to_owned)
            .collect()
    };
    assert_eq!(
        fits("linkages/shaper"),
        fitting(&["kinematics", "forces", "steady"])
    );
    assert_eq!(
        fits("cams/flat_tappet"),
        fitting(&["cam", "law cycle", "law compare", "steady"])
    );
    // One of several inputs has no steady motion.
    assert_eq!(
        fits("linkages/five_bar"),
        fitting(&["kinematics", "forces"])
    );
    let broken = text("linkages/shaper").replace("\"drive\"", "\"driv\"");
    let forms = with(&broken, |asked| Program.forms(asked));
    assert_eq!(forms["fits"], false);
    assert!(forms["questions"][0]["why"].is_null());
}

#[test]
fn every_question_is_answered_with_sentence_tables_charts_and_files() {
    let few = json!({ "methods": ["exact,dop853"], "tolerances": ["1e-6"], "repeats": ["1"] });
    for (scene, command, options, file) in [
        (
            "linkages/shaper",
            "kinematics",
            json!({ "speed": ["20 rpm"] }),
            "kinematics.json",
        ),
        (
            "linkages/five_bar",
            "kinematics",
            json!({}),
            "kinematics.json",
        ),
        (
            "kinetostatics/slider_crank",
            "forces",
            json!({}),
            "forces.json",
        ),
        ("steady/engine", "steady", json!({}), "steady.json"),
        ("cams/indexing_dwells", "cam", json!({}), "cam.json"),
        (
            "cams/flat_tappet",
            "law cycle",
            json!({ "of": ["valve"] }),
            "law.json",
        ),
        (
            "cams/flat_tappet",
            "law show",
            json!({ "law": ["3-4-5"] }),
            "law.json",
        ),
        ("rocker/two_masses", "methods", few, "methods.json"),
    ] {
        let text = text(scene);
        let asked = question(json!({ "command": command, "options": options }));
        let found = with(&text, |scene| Program.answer(&asked, scene)).unwrap();
        let html = found["html"].as_str().unwrap();
        assert!(html.contains("<h2>") || html.contains("<dl"), "{command}");
        assert!(html.contains("<svg class=\"dam-plot\""), "{command}");
        // The content security policy of the studio would drop it.
        assert!(
            !html.contains(" style=") && !html.contains("<style"),
            "{command}"
        );
        assert!(!found["columns"].as_array().unwrap().is_empty());
        let files = found["files"].as_array().unwrap();
        assert!(files.contains(&json!(file)) && files.contains(&json!("report.html")));
        let written = with(&text, |scene| Program.file(&asked, scene, file)).unwrap();
        let document: Value = serde_json::from_str(&written.unwrap()).unwrap();
        assert!(document.is_object(), "{command}");
        let none = with(&text, |scene| {
            Program.file(&asked, scene, "../../etc/passwd")
        });
        assert_eq!(none.unwrap(), None);
    }
}

#[test]
fn the_report_of_the_run_is_a_page_with_its_record() {
    let text = text("rocker/two_masses");
    let run = question(json!({ "command": "run" }));
    let page = with(&text, |asked| Program.file(&run, asked, "report.html")).unwrap();
    let page = page.unwrap();
    assert!(page.starts_with("<!DOCTYPE html>") && page.contains("Provenance"));
    let record = with(&text, |asked| Program.file(&run, asked, "record.csv")).unwrap();
    assert!(record.unwrap().lines().count() > 100);
}

#[test]
fn what_is_wrong_is_told_in_words() {
    let shaper = text("linkages/shaper");
    let ask = |text: &str, value: Value| {
        with(text, |asked| Program.answer(&question(value), asked)).unwrap_err()
    };
    let wrong = json!({ "command": "kinematics", "options": { "speed": ["20 kg"] } });
    assert!(ask(&shaper, wrong).starts_with("--speed"));
    let wrong = json!({ "command": "kinematics", "options": { "positions": ["none"] } });
    let words = ask(&shaper, wrong);
    assert!(
        words.contains("--positions") && !words.contains("Usage"),
        "{words}"
    );
    let many = json!({ "command": "kinematics", "options": { "positions": ["1000000"] } });
    assert!(ask(&shaper, many).starts_with("--positions 1000000: at most 10000"));
    let words = ask(&shaper, json!({ "command": "cam" }));
    assert!(words.starts_with("no object of the scene describes its cam"));
    let broken = shaper.replace("\"drive\"", "\"driv\"");
    assert!(ask(&broken, json!({ "command": "kinematics" })).contains("did you mean"));
}

#[test]
fn an_ended_question_is_not_answered() {
    let (stop, text) = (AtomicBool::new(true), text("valve_train/lift_off"));
    let folder = Folder::beside_scene(Path::new("scenarios/valve_train/lift_off.json"));
    let asked = CommandScene {
        name: "scene.json",
        text: &text,
        catalogue: &folder,
        budget: Budget::interrupted_by(&stop),
        tell: &|_, _, _| {},
    };
    let words = Program.answer(&question(json!({ "command": "steady" })), &asked);
    assert!(words.unwrap_err().contains("interrupted"));
}
