//! What windows ask for besides the answers that follow the text.

use super::limits::RUN;
use super::room::Room;
use super::served::Studio;
use crate::ask::{Judging, Mechanism};
use crate::budget::Budget;
use crate::frontend::object::{Inputs, Registry};
use crate::frontend::scene::{BuiltIn, Catalogue, Document, Layered, Overrides};
use crate::report::live;
use axum::Json;
use axum::extract::{Query, State};
use axum::http::StatusCode;
use axum::response::{IntoResponse, Response};
use serde::Deserialize;
use serde_json::{Value, json};
use std::sync::Arc;

/// A scene in the query.
#[derive(Deserialize)]
pub(super) struct Named {
    pub(super) scene: String,
}

fn refused(status: StatusCode, message: &str) -> Response {
    (status, Json(json!({ "error": message }))).into_response()
}

/// What a scene may be made of: kinds, and objects of the catalogue.
pub(super) async fn parts(
    State(studio): State<Arc<Studio>>,
    Query(named): Query<Named>,
) -> Response {
    let room = match studio.room(&named.scene) {
        Ok(room) => room,
        Err(message) => return refused(StatusCode::NOT_FOUND, &message),
    };
    let registry = Registry::standard();
    let kinds = registry.kinds().iter().map(|kind| {
        let inputs = match kind.inputs {
            Inputs::None => "none",
            Inputs::One | Inputs::OneOrSeveral => "one",
            Inputs::Several => "several",
        };
        json!({ "kind": kind.name, "meaning": kind.doc, "inputs": inputs })
    });
    let catalogue = Layered(room.catalogue(), &BuiltIn);
    let mut names = catalogue.names();
    names.sort_unstable();
    names.dedup();
    let objects = names.into_iter().filter_map(|name| {
        let (_, text) = catalogue.lookup(&name)?;
        let object: Value = serde_json::from_str(&text).ok()?;
        let word = |name: &str| object.get(name).and_then(Value::as_str).unwrap_or_default();
        let (kind, meaning) = (word("kind"), word("description"));
        Some(json!({ "from": name, "kind": kind, "meaning": meaning }))
    });
    Json(json!({ "kinds": kinds.collect::<Vec<_>>(), "objects": objects.collect::<Vec<_>>() }))
        .into_response()
}

/// The dynamic model and the equations of a scene as it is edited at present.
pub(super) async fn model(studio: State<Arc<Studio>>, named: Query<Named>) -> Response {
    told(studio, named, |mechanism| {
        let [model, equations] = live::model(&mechanism.system);
        json!({ "model": model, "equations": equations })
    })
    .await
}

/// Its linkages, to be drawn.
pub(super) async fn linkages(studio: State<Arc<Studio>>, named: Query<Named>) -> Response {
    told(
        studio,
        named,
        |mechanism| json!({ "linkages": live::sketches(&mechanism.system) }),
    )
    .await
}

async fn told(
    State(studio): State<Arc<Studio>>,
    Query(named): Query<Named>,
    tell: fn(&Mechanism) -> Value,
) -> Response {
    let room = match studio.room(&named.scene) {
        Ok(room) => room,
        Err(message) => return refused(StatusCode::NOT_FOUND, &message),
    };
    let worked = tokio::task::spawn_blocking(move || shown(&room, tell)).await;
    match worked {
        Ok(told) => Json(told).into_response(),
        Err(_) => refused(StatusCode::INTERNAL_SERVER_ERROR, "the computation failed"),
    }
}

/// `None`: the text is no scene, or none that can be run.
fn shown(room: &Room, tell: fn(&Mechanism) -> Value) -> Option<Value> {
    let (version, text) = room.newest();
    let document = Document::parse(room.name(), text.as_bytes()).ok()?;
    let catalogue = Layered(room.catalogue(), &BuiltIn);
    let reading = document.scene(&catalogue, &Overrides::none()).ok()?;
    let budget = Budget::FREE.within(RUN);
    let mechanism = Mechanism::of_within(reading, Judging::Never, &budget).ok()?;
    let mut told = tell(&mechanism);
    told["version"] = json!(version);
    Some(told)
}
