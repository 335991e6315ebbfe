//! What windows ask for besides the answers that follow the text.

use super::room::Room;
use super::served::Studio;
use crate::studio::asides::Aside;
use axum::Json;
use axum::extract::{FromRequestParts, Query};
use axum::http::StatusCode;
use axum::http::request::Parts;
use axum::response::{IntoResponse, Response};
use serde::Deserialize;
use serde_json::{Value, json};
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
        let room = studio.document_of_file(&named.scene);
        room.map(Self)
            .map_err(|message| refused(StatusCode::NOT_FOUND, &message))
    }
}

pub(super) fn refused(status: StatusCode, message: &str) -> Response {
    (status, Json(json!({ "error": message }))).into_response()
}

/// The schema of a scene as it is edited at present: what may be written where.
pub(super) async fn schema(Opened(room): Opened) -> Response {
    Json(of_newest(&room, |aside| aside.schema())).into_response()
}

/// What a scene may be made of: kinds, and objects of the catalogue.
pub(super) async fn parts(Opened(room): Opened) -> Response {
    Json(of_newest(&room, |aside| aside.available_parts())).into_response()
}

/// The dynamic model and the equations of a scene as it is edited at present.
pub(super) async fn model(opened: Opened) -> Response {
    respond(opened, |aside| aside.model()).await
}

/// Where linkages of several inputs are drawn, in the query: values of the inputs by the object's
/// id, as JSON.
#[derive(Deserialize)]
pub(super) struct Place {
    at: Option<String>,
}

/// Its linkages, to be drawn.
pub(super) async fn linkages(opened: Opened, Query(place): Query<Place>) -> Response {
    respond(opened, move |aside| aside.linkages(place.at.as_deref())).await
}

/// An object in the query.
#[derive(Deserialize)]
pub(super) struct ObjectQuery {
    object: String,
}

/// The motion of an object with its curves.
pub(super) async fn motion(opened: Opened, Query(of): Query<ObjectQuery>) -> Response {
    respond(opened, move |aside| Some(aside.motion(&of.object))).await
}

/// The steps of its text that undo takes back and redo does again.
pub(super) async fn steps(Opened(room): Opened) -> Response {
    let worked = tokio::task::spawn_blocking(move || room.steps()).await;
    match worked {
        Ok(steps) => Json(steps).into_response(),
        Err(_) => refused(StatusCode::INTERNAL_SERVER_ERROR, "the computation failed"),
    }
}

/// The figures of its run that it may expect, with how closely.
pub(super) async fn figures(opened: Opened) -> Response {
    respond(opened, |aside| aside.figures()).await
}

async fn respond(
    Opened(room): Opened,
    ask: impl FnOnce(&Aside<'_>) -> Option<Value> + Send + 'static,
) -> Response {
    let worked = tokio::task::spawn_blocking(move || of_newest(&room, ask)).await;
    match worked {
        Ok(told) => Json(told).into_response(),
        Err(_) => refused(StatusCode::INTERNAL_SERVER_ERROR, "the computation failed"),
    }
}

/// Asks the text as it is edited at present.
fn of_newest<T>(room: &Room, ask: impl FnOnce(&Aside<'_>) -> T) -> T {
    let (version, text) = room.newest();
    ask(&Aside {
        version,
        name: room.name(),
        text: &text,
        catalogue: room.catalogue(),
    })
}
