//! Requests of a page and their answers.

use super::{Tab, Told};
use serde_json::{Value, json};
use std::sync::Mutex;

const SCENE: &str = include_str!("../../../scenarios/rocker/two_masses.json");

/// The messages that answer a request, and the heads of the answers with numbers.
fn asked(tab: &mut Tab, request: &Value) -> (Vec<Value>, Vec<Value>) {
    let told = Mutex::new(Vec::new());
    tab.ask(&request.to_string(), &|one| told.lock().unwrap().push(one))
        .unwrap();
    let (mut messages, mut answers) = (Vec::new(), Vec::new());
    for one in told.into_inner().unwrap() {
        match one {
            Told::Text(text) => messages.push(serde_json::from_str(&text).unwrap()),
            Told::Answer(bytes) => {
                let length = u32::from_le_bytes(bytes[..4].try_into().unwrap()) as usize;
                answers.push(serde_json::from_slice(&bytes[4..4 + length]).unwrap());
            }
        }
    }
    (messages, answers)
}

fn run(version: u64, text: &str, more: &Value) -> Value {
    let mut request =
        json!({ "ask": "run", "of": { "version": version, "name": "a.json", "text": text } });
    for (key, value) in more.as_object().unwrap() {
        request[key] = value.clone();
    }
    request
}

#[test]
fn a_run_is_answered_and_a_pinned_one_stays_beside_it_in_another_worker_too() {
    let none = json!({});
    let mut tab = crate::cli::tab();
    let (messages, answers) = asked(&mut tab, &run(1, SCENE, &none));
    let source = messages.iter().find(|one| one["type"] == "source").unwrap();
    assert!(messages.iter().any(|one| one["type"] == "checked"));
    let wanted = crate::ask::Scene::from_json(SCENE).unwrap().run().unwrap();
    let wanted = wanted.figures("rocker").unwrap().delta_max;
    assert_eq!(answers[0]["figures"]["rocker"]["delta_max"], wanted);
    let pin = json!({ "name": "before", "text": SCENE, "hash": source["hash"], "judged": source["judged"] });
    let other = SCENE.replace("1e7", "2e7");
    for tab in [&mut tab, &mut crate::cli::tab()] {
        let (_, answers) = asked(tab, &run(2, &other, &json!({ "pins": [pin] })));
        let last = answers.last().unwrap();
        assert_eq!(last["pins"], json!(["before"]));
        assert!(last["compared"].to_string().contains("before"));
    }
    // Another scene under the same hash is none.
    let mut wrong = pin;
    wrong["text"] = other.as_str().into();
    let (messages, answers) = asked(&mut tab, &run(3, SCENE, &json!({ "pins": [wrong] })));
    assert!(messages.iter().any(|one| one["type"] == "error"));
    assert_eq!(answers.last().unwrap()["pins"], json!([]));
}

#[test]
fn faults_maps_questions_and_pages_are_answered_and_no_request_is_told() {
    let mut tab = crate::cli::tab();
    let (messages, answers) = asked(&mut tab, &run(1, "{", &json!({})));
    assert_eq!(messages[0]["faults"].as_array().unwrap().len(), 1);
    assert!(answers.is_empty());
    let of = json!({ "version": 4, "name": "a.json", "text": SCENE });
    let range = json!({ "address": "rocker.stiffness", "unit": "", "ends": [1e6, 1e8], "log": true, "whole": false });
    let map = json!({ "ask": "map", "of": of, "question": { "x": range, "y": null, "figure": null }, "level": 0 });
    let (messages, _) = asked(&mut tab, &map);
    assert_eq!(
        (&messages[0]["type"], &messages[0]["cells"]),
        (&json!("map"), &json!(5))
    );
    let question = json!({ "ask": "question", "of": of, "question": { "command": "methods" } });
    let (messages, _) = asked(&mut tab, &question);
    let last = messages.last().unwrap();
    assert_eq!(
        (&last["version"], &last["refused"]),
        (&json!(4), &json!(null))
    );
    for path in [
        "first",
        "schema",
        "parts",
        "model",
        "linkages",
        "motion",
        "figures",
        "text",
        "questions",
    ] {
        let request =
            json!({ "ask": "get", "number": 9, "path": format!("/api/{path}"), "of": of });
        let (messages, _) = asked(&mut tab, &request);
        assert!(messages[0]["value"].is_object() || path == "text", "{path}");
        assert_eq!(messages[0]["number"], 9);
    }
    let mut query = |path: &str, query: Value| {
        let request = json!({ "ask": "get", "number": 9, "path": path, "of": of, "query": query });
        asked(&mut tab, &request).0.remove(0)
    };
    let found = query("/api/motion", json!({ "object": "rocker" }));
    let expected = json!({ "version": 4, "faulty": false, "motion": null });
    assert_eq!(found["value"], expected);
    let from = json!({ "scenario": "rocker/two_masses" }).to_string();
    let found = query("/api/preview", json!({ "from": from }));
    assert!(found["value"]["pictures"].is_string());
    assert!(query("/api/preview", json!({ "from": "{}" }))["error"].is_string());
    for wrong in ["", "{}", r#"{ "ask": "end" }"#] {
        assert!(tab.ask(wrong, &|_| panic!("an answer")).is_err());
    }
}
