//! What windows ask for besides the answers that follow the text.

use super::answer::is_judged;
use super::limits::{FIGURES, JUDGED, RUN};
use super::room::Room;
use super::served::Studio;
use crate::ask::{Mechanism, ModelAssessment};
use crate::budget::Budget;
use crate::frontend::object::{Inputs, Registry};
use crate::frontend::scene::{BuiltIn, Catalogue, Document, LayeredCatalogue, Overrides};
use crate::report::live;
use crate::studies::offer::offers;
use crate::studies::spread::spread;
use axum::Json;
use axum::extract::{FromRequestParts, Query};
use axum::http::StatusCode;
use axum::http::request::Parts;
use axum::response::{IntoResponse, Response};
use serde::Deserialize;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::sync::Arc;

/// A scene in the query.
#[derive(Deserialize)]
struct SceneQuery {
    scene: String,
}

/// The room of the scene in the query; what is asked of a scene that there is not is refused.
pub(super) struct Opened(pub(super) Arc<Room>);

impl FromRequestParts<Arc<Studio>> for Opened {
    type Rejection = Response;

    async fn from_request_parts(parts: &mut Parts, studio: &Arc<Studio>) -> Result<Self, Response> {
        let named = Query::<SceneQuery>::from_request_parts(parts, studio).await;
        let Query(named) = named.map_err(IntoResponse::into_response)?;
        let room = studio.room(&named.scene);
        room.map(Self)
            .map_err(|message| refused(StatusCode::NOT_FOUND, &message))
    }
}

pub(super) fn refused(status: StatusCode, message: &str) -> Response {
    (status, Json(json!({ "error": message }))).into_response()
}

/// What a scene may be made of: kinds, and objects of the catalogue.
pub(super) async fn parts(Opened(room): Opened) -> Response {
    let registry = Registry::standard();
    let kinds = registry.kinds().iter().map(|kind| {
        let inputs = match kind.inputs {
            Inputs::None => "none",
            Inputs::One | Inputs::OneOrSeveral => "one",
            Inputs::Several => "several",
        };
        json!({ "kind": kind.name, "meaning": kind.doc, "inputs": inputs })
    });
    let catalogue = LayeredCatalogue(room.catalogue(), &BuiltIn);
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

/// The dynamic model and the equations of a scene as it is edited at present; where the levels
/// of its objects are open, those of the levels that are chosen, with their error.
pub(super) async fn model(opened: Opened) -> Response {
    respond(opened, ModelAssessment::Asked, |mechanism| {
        let [model, equations] = live::model(&mechanism.system);
        let accuracy = mechanism.certificate.as_ref().map(live::accuracy);
        json!({ "model": accuracy.unwrap_or_default() + &model, "equations": equations })
    })
    .await
}

/// Where linkages of several inputs are drawn, in the query: values of the inputs by the object's
/// id, as JSON.
#[derive(Deserialize)]
pub(super) struct Place {
    at: Option<String>,
}

/// Its linkages, to be drawn.
pub(super) async fn linkages(opened: Opened, Query(place): Query<Place>) -> Response {
    // What cannot be read is of nothing: they are drawn where they are put together.
    let at = place.at.and_then(|at| serde_json::from_str(&at).ok());
    let at: BTreeMap<String, Vec<f64>> = at.unwrap_or_default();
    let tell = move |mechanism: &Mechanism| {
        let linkages = live::sketches(&mechanism.system, &at);
        json!({ "linkages": linkages })
    };
    respond(opened, ModelAssessment::Never, tell).await
}

/// The figures of its run that it may expect, with how closely.
pub(super) async fn figures(opened: Opened) -> Response {
    respond(opened, ModelAssessment::Asked, |mechanism| {
        let budget = Budget::FREE.within(FIGURES);
        let Ok(result) = mechanism.run_within(&budget) else {
            return json!({ "figures": [] });
        };
        if budget.is_spent() {
            return json!({ "figures": [], "refused": "the run takes too long to be repeated here" });
        }
        let moved = spread(&mechanism.system, &mechanism.settings, &result, &budget).ok();
        // What was not run to its end says nothing of errors.
        let moved = moved.filter(|_| !budget.is_spent());
        json!({ "figures": offers(&result, mechanism.certificate.as_ref(), moved.as_ref()) })
    })
    .await
}

async fn respond(
    Opened(room): Opened,
    judging: ModelAssessment,
    tell: impl FnOnce(&Mechanism) -> Value + Send + 'static,
) -> Response {
    let worked = tokio::task::spawn_blocking(move || answer_json(&room, judging, tell)).await;
    match worked {
        Ok(told) => Json(told).into_response(),
        Err(_) => refused(StatusCode::INTERNAL_SERVER_ERROR, "the computation failed"),
    }
}

/// `None`: the text is no scene, or none that can be run.
fn answer_json(
    room: &Room,
    judging: ModelAssessment,
    tell: impl FnOnce(&Mechanism) -> Value,
) -> Option<Value> {
    let (version, text) = room.newest();
    let document = Document::parse(room.name(), text.as_bytes()).ok()?;
    let catalogue = LayeredCatalogue(room.catalogue(), &BuiltIn);
    let read = || document.scene(&catalogue, &Overrides::none()).ok();
    let reading = read()?;
    let made = |reading, judging, time| {
        Mechanism::of_within(reading, judging, &Budget::FREE.within(time)).ok()
    };
    let judged = match judging {
        ModelAssessment::Never => None,
        _ if !is_judged(&reading.scene) => None,
        _ => made(read()?, judging, JUDGED),
    };
    // What takes too long to judge is told as it stands.
    let mechanism = match judged {
        Some(mechanism) => mechanism,
        None => made(reading, ModelAssessment::Never, RUN)?,
    };
    let mut told = tell(&mechanism);
    told["version"] = json!(version);
    Some(told)
}
