//! Documents: edits of several windows, files that others change, drafts.

use super::drafts::Drafts;
use super::folder::Folder;
use super::pin_files::Pins;
use super::room::Room;
use super::window::{Sent, Window, WindowInput};
use crate::cli::questions::Program;
use crate::studio::commands::Question;
use crate::studio::messages::{Since, Update};
use serde_json::{Value, json};
use std::path::PathBuf;
use std::sync::Arc;
use std::time::{Duration, Instant};

pub(super) struct Opened {
    pub(super) base: tempfile::TempDir,
    pub(super) room: Arc<Room>,
    pub(super) window: Arc<Window>,
}

pub(super) fn room(base: &std::path::Path) -> Arc<Room> {
    let folder = base.join("open");
    let (folder, _) = Folder::open(Some(&folder)).unwrap();
    let path = folder.file("scene.json").unwrap();
    let drafts = Drafts::in_folder(&base.join("drafts"));
    let pins = Pins::in_folder(&base.join("pins"));
    Room::open(
        "scene.json",
        &path,
        folder.catalogue(&path),
        (drafts, pins),
        &Program,
    )
    .unwrap()
}

impl Opened {
    pub(super) fn new() -> Self {
        let base = tempfile::tempdir().unwrap();
        std::fs::create_dir(base.path().join("open")).unwrap();
        std::fs::copy(
            "scenarios/rocker/two_masses.json",
            base.path().join("open/scene.json"),
        )
        .unwrap();
        let (room, window) = (room(base.path()), Arc::new(Window::new(7, "one")));
        room.add_window(&window, None);
        Self { base, room, window }
    }

    fn path(&self) -> PathBuf {
        self.base.path().join("open/scene.json")
    }

    /// Puts something in place of a piece of the text.
    pub(super) fn replace(&self, version: u64, old: &str, new: &str, drag: Option<u64>) {
        let text = self.room.text();
        let at = text.find(old).unwrap();
        let [before, removed, rest] =
            [&text[..at], old, &text[at + old.len()..]].map(crate::studio::units::length);
        let changes = json!([before, [removed, new], rest]);
        self.room
            .push(&self.window, version, version, &[Update { changes, drag }])
            .unwrap();
    }

    /// Waits for a message of a kind.
    pub(super) fn told(&self, kind: &str, fits: impl Fn(&Value) -> bool) -> Value {
        let begun = Instant::now();
        loop {
            while let Some(sent) = self.window.next_message().unwrap() {
                let message: Value = match sent {
                    Sent::Text(text) => serde_json::from_str(&text).unwrap(),
                    Sent::Binary(bytes) => {
                        self.window.acknowledge(WindowInput::Answer);
                        let length = u32::from_le_bytes(bytes[..4].try_into().unwrap()) as usize;
                        assert_eq!((4 + length) % 8, 0);
                        let mut head: Value =
                            serde_json::from_slice(&bytes[4..4 + length]).unwrap();
                        let lengths = head["lengths"].as_array().unwrap().iter();
                        let values: u64 = lengths.map(|one| one.as_u64().unwrap_or(0)).sum();
                        assert_eq!(bytes.len() as u64, 4 + length as u64 + 8 * values);
                        head["type"] = json!("answer");
                        head
                    }
                };
                if message["type"] == kind && fits(&message) {
                    return message;
                }
            }
            assert!(begun.elapsed() < Duration::from_secs(60), "no {kind}");
            std::thread::yield_now();
        }
    }
}

#[test]
fn answers_follow_the_text_and_are_those_of_a_run() {
    let opened = Opened::new();
    let first = opened.told("answer", |one| one["version"] == 0);
    assert!(
        first["charts"].as_str().unwrap().contains("<svg")
            && !first["charts"].as_str().unwrap().contains("style=")
    );
    assert!(!first["pictures"].as_str().unwrap().contains("style="));
    opened.replace(0, "\"inertia\": 0.1", "\"inertia\": 0.13", None);
    let second = opened.told("answer", |one| one["version"] == 1);
    // The charts are the same but for their numbers.
    assert!(second["charts"].is_null());
    let scene = crate::Scene::from_json(&opened.room.text()).unwrap();
    let run = scene.run().unwrap();
    let wanted = serde_json::to_value(&run.figures.objects).unwrap();
    assert_eq!(second["figures"], wanted);
    assert_ne!(first["figures"], wanted);
}

#[test]
fn a_question_is_answered_anew_as_the_text_changes_and_no_longer_than_it_is_asked() {
    let opened = Opened::new();
    let asked: Question = serde_json::from_value(json!({
        "command": "methods",
        "options": { "methods": ["dop853"], "repeats": ["1"], "tolerances": ["1e-4"] },
    }))
    .unwrap();
    opened.room.question(7, Some(asked.clone()));
    let told = |version: u64| {
        let answer = opened.told("question", |one| one["version"] == version);
        opened.window.acknowledge(WindowInput::Question);
        answer
    };
    let first = told(0);
    assert_eq!(first["question"]["command"], "methods");
    assert!(first["html"].is_string(), "{}", first["refused"]);
    opened.replace(0, "\"inertia\": 0.1", "\"inertia\": 0.13", None);
    let second = told(1);
    assert_ne!(second["html"], first["html"]);
    // The same scene in other words is not worked out anew: times would be others.
    opened.replace(1, "\"inertia\": 0.13", "\"inertia\":  0.13", None);
    assert_eq!(told(2)["html"], second["html"]);
    let wrong = Question {
        command: "studio".to_owned(),
        ..asked
    };
    opened.room.question(7, Some(wrong));
    assert_eq!(told(2)["refused"], "`studio` is no question");
    opened.room.question(7, None);
    opened.replace(2, "\"inertia\":  0.13", "\"inertia\": 0.2", None);
    opened.told("answer", |one| one["version"] == 3);
    std::thread::sleep(Duration::from_millis(300));
    while let Some(sent) = opened.window.next_message().unwrap() {
        assert!(!matches!(sent, Sent::Text(text) if text.contains("\"question\"")));
    }
}

#[test]
fn a_signal_over_another_is_a_chart_of_the_columns() {
    let opened = Opened::new();
    let first = opened.told("answer", |one| one["version"] == 0);
    let signals = first["signals"].as_array().unwrap();
    assert!(
        signals.contains(&json!(["t", "s"])) && signals.contains(&json!(["rocker.speed", "rad/s"]))
    );
    let over = ["rocker.displacement", "rocker.speed"].map(str::to_owned);
    opened.room.change_view(7, |view| view.over = Some(over));
    let drawn = opened.told("answer", |one| one["plots"][0]["id"] == "over");
    let plot = &drawn["plots"][0];
    assert_eq!(
        (&plot["x"]["unit"], &plot["y"]["unit"]),
        (&json!("rad"), &json!("rad/s"))
    );
    assert_eq!(
        drawn["plots"].as_array().unwrap().len(),
        first["plots"].as_array().unwrap().len() + 1
    );
    // What no record has is no chart.
    let over = ["t", "nobody.speed"].map(str::to_owned);
    opened.room.change_view(7, |view| view.over = Some(over));
    opened.told("answer", |one| {
        one["plots"][0]["id"] != "over" && one["charts"].is_string()
    });
}

#[test]
fn charts_out_of_sight_come_without_numbers_until_they_are_seen() {
    let opened = Opened::new();
    let first = opened.told("answer", |one| one["version"] == 0);
    let all = first["plots"].as_array().unwrap().len();
    assert!(all > 3 && !first["lengths"].as_array().unwrap().contains(&Value::Null));
    let seen = |answer: &Value| -> Vec<usize> {
        let plots = answer["plots"].as_array().unwrap();
        (0..plots.len()).filter(|&k| !plots[k].is_null()).collect()
    };
    opened.room.set_visible_charts(&opened.window, [2].into());
    opened.replace(0, "\"inertia\": 0.1", "\"inertia\": 0.13", None);
    let second = opened.told("answer", |one| one["version"] == 1);
    assert_eq!(seen(&second), [2]);
    // The columns of that chart are there, and those of what moves; of the rest none.
    let lengths = second["lengths"].as_array().unwrap();
    let series = second["plots"][2]["series"].as_array().unwrap();
    let index = |of: &Value| usize::try_from(of.as_u64().unwrap()).unwrap();
    let own = series
        .iter()
        .flat_map(|one| [index(&one["x"]), index(&one["y"])]);
    let moved = second["moving"]["columns"].as_array().unwrap().iter();
    let moved = moved.flat_map(|one| [&one["values"], &one["deviation"]]);
    // (The constant load of the rocker is an arrow.)
    let loads = second["moving"]["sets"][0]["on"].as_array().unwrap().iter();
    let moved = moved.chain(loads.map(|one| &one["column"]));
    let moved = moved.filter(|one| !one.is_null()).map(index);
    let mut wanted: Vec<usize> = own.chain(moved).collect();
    wanted.push(index(&second["moving"]["times"]));
    assert!(lengths.iter().any(Value::is_null));
    for (k, length) in lengths.iter().enumerate() {
        assert_eq!(length.is_null(), !wanted.contains(&k), "column {k}");
    }
    // What comes into sight is sent at once; what goes out of it is no reason to send anything.
    opened
        .room
        .set_visible_charts(&opened.window, [2, 0].into());
    let third = opened.told("answer", |one| one["version"] == 1);
    assert_eq!(seen(&third), [0, 2]);
    opened.room.set_visible_charts(&opened.window, [0].into());
    assert!(
        opened
            .window
            .next_message()
            .is_ok_and(|sent| sent.is_none_or(|one| matches!(one, Sent::Text(_))))
    );
}

#[test]
fn edits_upon_edits_on_the_way_are_taken_where_no_other_window_came_between() {
    let opened = Opened::new();
    let other = Arc::new(Window::new(8, ""));
    opened.room.add_window(&other, None);
    // A blank more at the end of the text; true: it was taken.
    let push = |window: &Window, version: u64, heard: u64| {
        let before = opened.room.newest().0;
        let length = crate::studio::units::length(&opened.room.text());
        let blank = json!([length, [0, " "]]);
        let update = Update {
            changes: blank,
            drag: None,
        };
        let taken = opened.room.push(window, version, heard, &[update]);
        taken.is_ok() && opened.room.newest().0 == before + 1
    };
    assert!(push(&opened.window, 0, 0));
    assert!(push(&opened.window, 1, 0));
    assert!(push(&other, 2, 2));
    // What it had not heard of is another's, though the number is right.
    assert!(!push(&opened.window, 3, 2));
    opened.told("late", |one| one["version"] == 3);
    assert!(push(&opened.window, 3, 3));
    assert!(push(&opened.window, 4, 3));
    // What is undone is nobody's.
    opened.room.step(true);
    let now = opened.room.newest().0;
    assert!(now > 5 && !push(&opened.window, now, 4) && push(&opened.window, now, now));
}

#[test]
fn faults_and_numbers_have_their_places_as_windows_count() {
    let opened = Opened::new();
    opened.replace(0, "two masses\"", "µ😀\"", None);
    opened.replace(1, "\"input\": \"shaft\"", "\"input\": \"shafd\"", None);
    let checked = opened.told("checked", |one| one["version"] == 2);
    let fault = &checked["faults"][0];
    assert!(
        fault["hints"][0].as_str().unwrap().contains("shaft"),
        "{fault}"
    );
    let units: Vec<u16> = opened.room.text().encode_utf16().collect();
    let piece = |place: &Value, from: &str, to: &str| {
        let end = |name: &str| match place[name].as_u64() {
            Some(at) => at as usize,
            None => panic!("{place}"),
        };
        String::from_utf16(&units[end(from)..end(to)]).unwrap()
    };
    assert_eq!(piece(fault, "from", "to"), "\"shafd\"");
    let numbers = checked["numbers"].as_array().unwrap();
    let inertia = numbers
        .iter()
        .find(|one| one["address"] == "rocker.inertia")
        .unwrap();
    let at = |k: usize| inertia["number_at"][k].as_u64().unwrap() as usize;
    assert_eq!(String::from_utf16(&units[at(0)..at(1)]).unwrap(), "0.1");
    // What is no JSON has a fault, and nothing is known of its numbers.
    opened.replace(2, "\"dam\": 1,", "\"dam\": 1,,", None);
    let checked = opened.told("checked", |one| one["version"] == 3);
    assert!(checked["numbers"].is_null() && checked["faults"][0]["severity"] == "error");
}

#[test]
fn a_step_of_the_list_is_gone_to_where_the_text_is_that_of_the_list() {
    let opened = Opened::new();
    let before = opened.room.text();
    opened.replace(0, "\"inertia\": 0.1", "\"inertia\": 0.2", Some(1));
    opened.replace(1, "\"inertia\": 0.2", "\"inertia\": 0.3", Some(2));
    let edited = opened.room.text();
    assert!(opened.room.go_to(0, 1).unwrap_err().contains("meanwhile"));
    assert_eq!(opened.room.text(), edited);
    opened.room.go_to(0, 2).unwrap();
    assert_eq!(opened.room.text(), before);
    let steps = opened.room.steps();
    assert_eq!(
        (
            steps["count"].as_u64(),
            steps["undone"].as_array().unwrap().len()
        ),
        (Some(0), 2)
    );
    let version = opened.room.newest().0;
    opened.told("status", |one| one["redo"] == true && one["undo"] == false);
    opened.room.go_to(2, version).unwrap();
    assert_eq!(opened.room.text(), edited);
}

#[test]
fn late_edits_wait_and_foreign_ones_are_refused() {
    let opened = Opened::new();
    let before = opened.room.text();
    opened.replace(0, "0.1", "0.2", Some(1));
    let changed = opened.room.text();
    opened.replace(0, "0.2", "0.3", Some(1));
    assert_eq!(opened.room.text(), changed);
    assert_eq!(opened.told("late", |_| true)["version"], 1);
    let wrong = [Update {
        changes: json!([1, [5, "x"]]),
        drag: None,
    }];
    assert!(opened.room.push(&opened.window, 1, 1, &wrong).is_err());
    assert_eq!(
        opened.told("opened", |one| one["version"] == 1)["text"],
        json!(changed)
    );
    opened.room.step(true);
    assert_eq!(opened.room.text(), before);
    opened.room.step(false);
    assert_eq!(opened.room.text(), changed);
}

#[test]
fn a_file_that_others_changed_is_not_written_over() {
    let opened = Opened::new();
    opened.replace(0, "0.1", "0.2", None);
    opened.room.save().unwrap();
    assert_eq!(
        std::fs::read_to_string(opened.path()).unwrap(),
        opened.room.text()
    );
    opened.replace(1, "0.2", "0.25", None);
    let theirs = "{ \"dam\": 1, \"theirs\": true }";
    std::fs::write(opened.path(), theirs).unwrap();
    assert!(opened.room.save().is_err());
    assert_eq!(std::fs::read_to_string(opened.path()).unwrap(), theirs);
    assert_eq!(
        opened.told("status", |one| one["disk"] == "changed")["saved"],
        false
    );
    opened.room.decide_on_reload(false).unwrap();
    opened.room.save().unwrap();
    assert!(
        std::fs::read_to_string(opened.path())
            .unwrap()
            .contains("0.25")
    );
    std::fs::write(opened.path(), theirs).unwrap();
    opened.room.decide_on_reload(true).unwrap();
    assert_eq!(opened.room.text(), theirs);
    opened.room.step(true);
    assert!(opened.room.text().contains("0.25"));
}

#[test]
fn a_draft_is_offered_and_the_text_waits_for_the_decision() {
    let opened = Opened::new();
    let (saved, draft) = (opened.room.text(), opened.room.text().replace("0.1", "0.4"));
    let drafts = Drafts::in_folder(&opened.base.path().join("drafts"));
    let path = opened.path().canonicalize().unwrap();
    for restore in [true, false] {
        drafts.write_draft(&path, &saved, &draft).unwrap();
        let again = Opened {
            room: room(opened.base.path()),
            window: Arc::new(Window::new(8, "")),
            base: tempfile::tempdir().unwrap(),
        };
        again.room.add_window(&again.window, None);
        assert_eq!(again.told("opened", |_| true)["draft"]["other_base"], false);
        let edit = [Update {
            changes: json!([[0, " "], saved.len()]),
            drag: None,
        }];
        assert!(again.room.push(&again.window, 0, 0, &edit).is_err());
        again.room.draft(restore);
        assert_eq!(again.room.text(), if restore { &*draft } else { &*saved });
        assert_eq!(drafts.find(&path).is_some(), restore);
        drafts.forget_draft(&path);
    }
}

#[test]
fn a_window_that_lost_its_connection_gets_what_it_missed() {
    let opened = Opened::new();
    let first = opened.told("opened", |_| true);
    let since = |epoch: &Value, version| Since {
        epoch: epoch.as_str().unwrap().to_owned(),
        version,
    };
    opened.replace(0, "\"inertia\": 0.1", "\"inertia\": 0.2", None);
    opened.replace(1, "\"inertia\": 0.2", "\"inertia\": 0.3", None);
    let returned = |since: &Since| {
        opened.room.remove_window(&opened.window);
        opened.room.add_window(&opened.window, Some(since));
        loop {
            if let Some(Sent::Text(text)) = opened.window.next_message().unwrap() {
                let message: Value = serde_json::from_str(&text).unwrap();
                if ["opened", "resumed"].contains(&message["type"].as_str().unwrap()) {
                    return message;
                }
            }
        }
    };
    let resumed = returned(&since(&first["epoch"], 1));
    assert_eq!(resumed["type"], "resumed");
    assert_eq!(resumed["version"], 1);
    let updates = resumed["updates"].as_array().unwrap();
    assert_eq!(updates.len(), 1);
    assert_eq!(updates[0]["by"], "7");
    assert!(updates[0]["changes"].to_string().contains("0.3"));
    // Of another document, or one of the future, nothing is known.
    assert_eq!(returned(&since(&json!("other"), 1))["type"], "opened");
    assert_eq!(returned(&since(&first["epoch"], 3))["type"], "opened");
}
