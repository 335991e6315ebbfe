//! The first page: what may be opened, and what a new scene may begin with.
//!
//! Templates are those of `dam new` (`frontend::scene::template`). Scenarios are built in by
//! `build.rs`; their questions are the tables of `scenarios/README.md` (`gallery`). A new file
//! is made by `Folder::place`, which replaces none.

use super::folder::Folder;
use super::questions::refused;
use super::served::Studio;
use crate::studio::messages::Beginning;
use crate::studio::{asides, preview};
use axum::Json;
use axum::extract::{Query, State};
use axum::http::StatusCode;
use axum::response::{IntoResponse, Response};
use serde::Deserialize;
use serde::de::{Deserializer, IgnoredAny, MapAccess, Visitor};
use serde_json::{Value, json};
use std::cell::RefCell;
use std::fmt;
use std::io::{BufReader, Read};
use std::path::Path;
use std::sync::Arc;

/// How far into a scene its name is looked for (bytes).
const HEAD: u64 = 64 << 10;

/// Recent scenes, those of the folder with their names, templates, scenarios.
pub(super) async fn page(State(studio): State<Arc<Studio>>) -> Response {
    match tokio::task::spawn_blocking(move || opening_message(&studio)).await {
        Ok(told) => Json(told).into_response(),
        Err(_) => StatusCode::INTERNAL_SERVER_ERROR.into_response(),
    }
}

/// A scene to begin with in the query: as JSON.
#[derive(Deserialize)]
pub(super) struct From {
    from: String,
}

/// The machine of a template or a scenario, moving. One is worked out at a time.
pub(super) async fn preview(State(studio): State<Arc<Studio>>, Query(of): Query<From>) -> Response {
    let Ok(from) = serde_json::from_str::<Beginning>(&of.from) else {
        return refused(StatusCode::BAD_REQUEST, "this is no scene to begin with");
    };
    let _one = studio.previewing.lock().await;
    match tokio::task::spawn_blocking(move || preview::preview(&from)).await {
        Ok(Ok(found)) => Json(found).into_response(),
        Ok(Err(words)) => refused(StatusCode::NOT_FOUND, &words),
        Err(_) => StatusCode::INTERNAL_SERVER_ERROR.into_response(),
    }
}

fn opening_message(studio: &Studio) -> Value {
    let folder: &Folder = &studio.folder;
    let scenes = folder.scenes().into_iter().map(|name| {
        let title = folder.file(&name).ok().and_then(|path| title(&path));
        json!({ "name": name, "title": title })
    });
    let mut told = asides::beginnings();
    told["recent"] = json!(studio.recent.scenes_below(folder));
    told["scenes"] = json!(scenes.collect::<Vec<_>>());
    told
}

/// The name that a scene gives itself; `None`: it has none near its beginning.
fn title(path: &Path) -> Option<String> {
    let file = std::fs::File::open(path).ok()?;
    let found = Name::default();
    let mut reader = serde_json::Deserializer::from_reader(BufReader::new(file.take(HEAD)));
    // It ends as soon as the name is known, which shows as an error.
    let _ = reader.deserialize_map(&found);
    found.0.into_inner()
}

/// Reads an object until its `name` is known.
#[derive(Debug, Default)]
struct Name(RefCell<Option<String>>);

impl<'de> Visitor<'de> for &Name {
    type Value = ();

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("a scene")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<(), A::Error> {
        while let Some(key) = map.next_key::<String>()? {
            if key == "name" {
                *self.0.borrow_mut() = Some(map.next_value()?);
                return Ok(());
            }
            map.next_value::<IgnoredAny>()?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::title;

    #[test]
    fn the_name_of_a_scene_is_found_without_reading_on() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("scene.json");
        let long = "x".repeat(super::HEAD as usize);
        for (text, wanted) in [
            (
                r#"{ "dam": 1, "name": "A lever", "objects": {"#.to_owned(),
                Some("A lever"),
            ),
            (
                r#"{ "objects": { "name": 3 }, "name": "B" }"#.to_owned(),
                Some("B"),
            ),
            (
                format!(r#"{{ "description": "{long}", "name": "far" }}"#),
                None,
            ),
            (r#"{ "dam": 1, "objects": {} }"#.to_owned(), None),
            (r#"{ "name": 7 }"#.to_owned(), None),
            (r#"["name", "no"]"#.to_owned(), None),
        ] {
            std::fs::write(&path, text).unwrap();
            assert_eq!(title(&path).as_deref(), wanted);
        }
        assert_eq!(title(&folder.path().join("none.json")), None);
    }
}
