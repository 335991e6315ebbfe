//! The published form of the answers of `--json`: `docs/site/reference/answers.schema.json`, written by
//! docs/answers.py. The test of options holds each of its answers to it.

use serde_json::{Map, Value, json};
use std::process::Command;
use std::sync::OnceLock;

fn published() -> &'static Value {
    static SCHEMA: OnceLock<Value> = OnceLock::new();
    SCHEMA.get_or_init(|| {
        let path = concat!(
            env!("CARGO_MANIFEST_DIR"),
            "/docs/site/reference/answers.schema.json"
        );
        let text = std::fs::read_to_string(path).unwrap();
        serde_json::from_str(&text).unwrap()
    })
}

/// What is wrong with the answer of a command: nothing where it has the published form.
pub(super) fn faults(command: &str, answer: &Value) -> Vec<String> {
    let is_failure =
        answer.as_object().is_some_and(|own| own.len() == 2) && answer["errors"].is_array();
    let name = match is_failure {
        true => "failure".to_owned(),
        false => format!("dam {command}"),
    };
    let form = published()["$defs"].get(&name);
    let form = form.unwrap_or_else(|| panic!("{name} has no published form"));
    let mut found = Vec::new();
    judge(form, answer, &name, &mut found);
    found
}

/// Keywords of the published schema; another would be passed over in silence.
const KEYWORDS: [&str; 6] = [
    "type",
    "properties",
    "required",
    "additionalProperties",
    "items",
    "description",
];

fn judge(form: &Value, value: &Value, path: &str, found: &mut Vec<String>) {
    let Some(form) = form.as_object() else {
        panic!("{path}: {form} is no form");
    };
    for keyword in form.keys() {
        assert!(KEYWORDS.contains(&keyword.as_str()), "{path}: {keyword}");
    }
    if let Some(types) = form.get("type") {
        let one = std::slice::from_ref(types);
        let types = types.as_array().map_or(one, Vec::as_slice);
        if !types.iter().any(|own| is_of(own.as_str().unwrap(), value)) {
            found.push(format!("{path}: {value} is none of {types:?}"));
        }
    }
    match value {
        Value::Object(members) => judge_members(form, members, path, found),
        Value::Array(items) => {
            if let Some(inner) = form.get("items") {
                for item in items {
                    judge(inner, item, &format!("{path}[]"), found);
                }
            }
        }
        _ => {}
    }
}

fn judge_members(
    form: &Map<String, Value>,
    members: &Map<String, Value>,
    path: &str,
    found: &mut Vec<String>,
) {
    for name in form
        .get("required")
        .and_then(Value::as_array)
        .into_iter()
        .flatten()
    {
        if !members.contains_key(name.as_str().unwrap()) {
            found.push(format!("{path}: {name} is missing"));
        }
    }
    for (name, value) in members {
        let here = format!("{path}/{name}");
        let known = form.get("properties").and_then(|known| known.get(name));
        match (known, form.get("additionalProperties")) {
            (Some(inner), _) => judge(inner, value, &here, found),
            (None, Some(Value::Bool(false))) => found.push(format!("{here} is not known")),
            (None, Some(inner @ Value::Object(_))) => judge(inner, value, &here, found),
            (None, _) => {}
        }
    }
}

fn is_of(name: &str, value: &Value) -> bool {
    match name {
        "object" => value.is_object(),
        "array" => value.is_array(),
        "string" => value.is_string(),
        "boolean" => value.is_boolean(),
        "null" => value.is_null(),
        "number" => value.is_number(),
        "integer" => value.is_i64() || value.is_u64(),
        other => panic!("no type: {other}"),
    }
}

fn dam(arguments: &[&str]) -> std::process::Output {
    Command::new(env!("CARGO_BIN_EXE_dam"))
        .args(arguments)
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap()
}

fn answer(arguments: &[&str]) -> Value {
    serde_json::from_slice(&dam(arguments).stdout).unwrap()
}

#[test]
fn every_command_with_json_has_a_published_form() {
    let commands = |words: &[&str]| -> Vec<String> {
        let help = dam(&[words, &["--help"]].concat());
        let help = String::from_utf8(help.stdout).unwrap();
        let listed = help.split("Commands:").nth(1).unwrap_or("").to_owned();
        let listed = listed.split("Options:").next().unwrap().to_owned();
        let names = listed.lines().filter(|line| line.starts_with("  "));
        names
            .filter_map(|line| line.split_whitespace().next().map(str::to_owned))
            .filter(|name| name != "help")
            .collect()
    };
    let mut count = 0;
    for command in commands(&[]) {
        let inner = commands(&[&command]);
        let inner = if inner.is_empty() {
            vec![String::new()]
        } else {
            inner
        };
        for own in inner {
            let words: Vec<&str> = [command.as_str(), &own]
                .into_iter()
                .filter(|own| !own.is_empty())
                .collect();
            let help = dam(&[&words[..], &["--help"]].concat());
            if String::from_utf8(help.stdout).unwrap().contains("--json") {
                let name = format!("dam {}", words.join(" "));
                assert!(published()["$defs"].get(&name).is_some(), "{name}");
                count += 1;
            }
        }
    }
    assert_eq!(
        count + 1,
        published()["$defs"].as_object().unwrap().len(),
        "and that of failures"
    );
}

#[test]
fn every_member_of_an_answer_has_a_meaning() {
    for (name, form) in published()["$defs"].as_object().unwrap() {
        for (member, own) in form["properties"].as_object().unwrap() {
            let meaning = own["description"].as_str().unwrap_or("");
            assert!(meaning.ends_with('.'), "{name}/{member}: {meaning}");
        }
    }
}

#[test]
fn answers_of_another_form_are_found() {
    let right = answer(&["check", "scenarios/rocker/one_mass.json", "--json"]);
    assert_eq!(faults("check", &right), [""; 0]);
    let mut more = right.clone();
    more["surprise"] = json!(1);
    assert_eq!(faults("check", &more), ["dam check/surprise is not known"]);
    let mut less = right.clone();
    less.as_object_mut().unwrap().remove("hash");
    assert_eq!(faults("check", &less), ["dam check: \"hash\" is missing"]);
    let mut other = right;
    other["scene"] = json!(3);
    assert_eq!(faults("check", &other).len(), 1);
    let mut run = answer(&["run", "scenarios/rocker/one_mass.json", "--json", "--quiet"]);
    assert_eq!(faults("run", &run), [""; 0]);
    run["objects"]["rocker"]["final"]["jerk"] = json!(0);
    assert_eq!(
        faults("run", &run),
        ["dam run/objects/rocker/final/jerk is not known"]
    );
}

#[test]
fn refused_scenes_answer_in_the_form_of_failures() {
    let mut count = 0;
    for entry in
        std::fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/diagnostics")).unwrap()
    {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|own| own == "json") {
            let output = dam(&["check", path.to_str().unwrap(), "--json"]);
            let found: Value = serde_json::from_slice(&output.stdout).unwrap();
            assert_eq!(faults("check", &found), [""; 0], "{}", path.display());
            count += 1;
        }
    }
    assert!(count > 80, "{count} scenes");
}

#[test]
fn answers_on_all_scenarios_have_the_published_form() {
    let mut folders = vec![std::path::PathBuf::from(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/scenarios"
    ))];
    let mut count = 0;
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
                continue;
            }
            let scene = path.to_str().unwrap();
            if !scene.ends_with(".json") || scene.ends_with("scene.schema.json") {
                continue;
            }
            for command in ["check", "show", "kinematics"] {
                let found = answer(&[command, scene, "--json", "--quiet"]);
                assert_eq!(faults(command, &found), [""; 0], "{command} {scene}");
                count += 1;
            }
        }
    }
    assert!(count > 200, "{count} answers");
}
