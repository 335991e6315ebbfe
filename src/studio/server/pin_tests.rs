//! Pinned runs: in a window, in a tab that is loaded anew, in a later program.

use super::room_tests::{Opened, room};
use super::window::{Sent, Window, WindowInput};
use serde_json::{Value, json};
use std::sync::Arc;

#[test]
fn pinned_runs_stay_beside_those_that_come_of_their_window_alone() {
    let opened = Opened::new();
    opened.told("answer", |one| one["version"] == 0);
    let other = Arc::new(Window::new(8, ""));
    opened.room.add_window(&other, None);
    opened.room.keep_run(7, "first").unwrap();
    let both = opened.told("answer", |one| one["pins"] == json!(["first"]));
    opened.replace(0, "\"inertia\": 0.1", "\"inertia\": 0.13", None);
    let moved = opened.told("answer", |one| one["version"] == 1);
    assert_eq!(moved["pins"], json!(["first"]));
    // The same charts with other numbers; of the first two curves the pinned one has stayed.
    assert!(moved["charts"].is_null());
    let labels = |answer: &Value| {
        let series = answer["plots"][0]["series"].as_array().unwrap().iter();
        series
            .map(|one| one["label"].as_str().unwrap().to_owned())
            .collect::<Vec<_>>()
    };
    assert_eq!(
        (labels(&both), labels(&moved)),
        (labels(&moved), vec!["now".to_owned(), "first".to_owned()])
    );
    let tables = moved["compared"].as_str().unwrap();
    assert!(tables.contains("Results of rocker over pinned runs") && tables.contains('%'));
    // The other window sees nothing of it.
    let mut seen = 0;
    while let Some(sent) = other.next_message().unwrap() {
        other.acknowledge(WindowInput::Answer);
        if let Sent::Binary(bytes) = sent {
            assert!(!String::from_utf8_lossy(&bytes).contains("pinned runs"));
            seen += 1;
        }
    }
    assert!(seen > 0);
    for name in [
        "first",
        "",
        "a name that is much longer than a legend bears",
    ] {
        let _ = opened.room.keep_run(7, name);
    }
    let full = opened.told("answer", |one| one["pins"].as_array().unwrap().len() == 3);
    assert_eq!(full["pins"], json!(["first", "first (2)", "run 3"]));
    assert!(opened.room.keep_run(7, "one too many").is_err());
    opened.room.change_view(7, |view| view.rename(1, "now"));
    opened.told("answer", |one| one["pins"][1] == "now (2)");
    for _ in 0..3 {
        opened.room.change_view(7, |view| view.unpin(0));
    }
    let alone = opened.told("answer", |one| one["pins"] == json!([]));
    assert_eq!(alone["compared"], "");
}

#[test]
fn a_tab_that_is_loaded_anew_has_its_pinned_runs() {
    let mut opened = Opened::new();
    opened.told("answer", |one| one["version"] == 0);
    opened.room.keep_run(7, "first").unwrap();
    opened.told("answer", |one| one["pins"] == json!(["first"]));
    let window = |id: u64, tab: &str| Arc::new(Window::new(id, tab));
    let joined = |opened: &mut Opened, new: Arc<Window>| {
        opened.room.add_window(&new, None);
        std::mem::replace(&mut opened.window, new)
    };
    // Before the old window was missed, and after.
    let old = joined(&mut opened, window(9, "one"));
    opened.told("answer", |one| one["pins"] == json!(["first"]));
    opened.room.remove_window(&old);
    opened.room.remove_window(&opened.window);
    joined(&mut opened, window(10, "one"));
    opened.told("answer", |one| one["pins"] == json!(["first"]));
    // Another tab, and one that says nothing, see the run alone.
    for tab in ["two", ""] {
        joined(&mut opened, window(11, tab));
        let alone = opened.told("answer", |_| true);
        assert_eq!(alone["pins"], json!([]), "{tab}");
    }
}

/// A program that starts again, with a window of another tab.
fn started_again(opened: Opened) -> Opened {
    let Opened {
        base, room: old, ..
    } = opened;
    drop(old);
    let (room, window) = (room(base.path()), Arc::new(Window::new(1, "another")));
    room.add_window(&window, None);
    Opened { base, room, window }
}

#[test]
fn pinned_runs_are_worked_out_again_after_a_restart() {
    let opened = Opened::new();
    opened.told("answer", |one| one["version"] == 0);
    opened.room.keep_run(7, "first").unwrap();
    opened.replace(0, "\"inertia\": 0.1", "\"inertia\": 0.13", None);
    let moved = opened.told("answer", |one| one["version"] == 1);
    opened.room.keep_run(7, "").unwrap();
    opened.room.change_view(7, |view| view.rename(1, "second"));
    let named = opened.told("answer", |one| one["pins"] == json!(["first", "second"]));
    opened.room.keep_pins();
    let again = started_again(opened);
    let pinned = again.told("answer", |one| {
        one["compared"]
            .as_str()
            .is_some_and(|text| text.contains("second"))
    });
    assert_eq!(pinned["pins"], json!(["first", "second"]));
    // The text is that of the file once more, the pinned figures are those of before.
    assert_ne!(pinned["figures"], moved["figures"]);
    let of_pins = |answer: &Value| {
        let html = answer["compared"].as_str().unwrap().to_owned();
        let values = html.split("title=\"").skip(1);
        let values: Vec<String> = values
            .map(|one| one[..one.find('"').unwrap()].into())
            .collect();
        values
    };
    let (before, after) = (of_pins(&named), of_pins(&pinned));
    assert!(before.len() > 6, "{before:?}");
    // Of every row the columns of the two pins; those of the run itself are another text's.
    let kept = before
        .iter()
        .zip(&after)
        .filter(|(one, other)| one == other)
        .count();
    assert!(kept * 3 >= before.len() * 2, "{before:?} {after:?}");
    // A second window begins with the run alone.
    let other = Arc::new(Window::new(2, "third"));
    again.room.add_window(&other, None);
    let again = Opened {
        window: other,
        ..again
    };
    assert_eq!(again.told("answer", |_| true)["pins"], json!([]));
    // Unpinned, they are gone for good.
    for _ in 0..2 {
        again.room.change_view(1, |view| view.unpin(0));
    }
    again.room.keep_pins();
    let last = started_again(again);
    assert_eq!(last.told("answer", |_| true)["pins"], json!([]));
}

#[test]
fn a_pinned_run_whose_scene_is_another_now_is_not_shown() {
    let opened = Opened::new();
    opened.told("answer", |one| one["version"] == 0);
    opened.room.keep_run(7, "first").unwrap();
    opened.room.keep_pins();
    let folder = opened.base.path().join("pins");
    let file = std::fs::read_dir(folder)
        .unwrap()
        .next()
        .unwrap()
        .unwrap()
        .path();
    let mut record: Value = serde_json::from_slice(&std::fs::read(&file).unwrap()).unwrap();
    record["pins"][0]["hash"] = json!("0");
    std::fs::write(&file, record.to_string()).unwrap();
    let again = started_again(opened);
    let told = again.told("error", |_| true);
    assert!(
        told["message"].as_str().unwrap().contains("`first`"),
        "{told}"
    );
    again.told("answer", |one| one["pins"] == json!([]));
}
