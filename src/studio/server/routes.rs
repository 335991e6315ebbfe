//! What is served: the interface to everybody on this machine who asks rightly, scenes to the
//! windows of the user.

use super::connections;
use super::files::{self, FILE};
use super::first;
use super::guard::{Nonce, guard, refused};
use super::questions;
use super::served::{Studio, keep};
use super::socket;
use crate::report::live;
use crate::studio::limits::BODY;
use axum::extract::{DefaultBodyLimit, Extension, State, WebSocketUpgrade};
use axum::http::StatusCode;
use axum::http::header::CONTENT_TYPE;
use axum::response::{IntoResponse, Response};
use axum::routing::get;
use axum::{Json, Router, middleware};
use serde_json::json;
use std::net::Ipv4Addr;
use std::sync::Arc;
use tokio::net::TcpListener;

/// The interface as it was built.
pub(super) const PAGE: &str = include_str!("../../../studio/dist/index.html");
const SCRIPT: &str = include_str!("../../../studio/dist/studio.js");
const STYLE: &str = include_str!("../../../studio/dist/studio.css");

/// Stands in the page for the nonce of its styles.
const NONCE: &str = "NONCE";

/// A port of the loopback.
///
/// # Errors
/// It cannot be had.
pub(super) async fn listen(port: Option<u16>) -> Result<TcpListener, String> {
    let port = port.unwrap_or(0);
    TcpListener::bind((Ipv4Addr::LOCALHOST, port))
        .await
        .map_err(|error| format!("cannot serve on port {port} of 127.0.0.1: {error}"))
}

/// Serves until the program ends.
pub(super) async fn run(studio: Arc<Studio>, listener: TcpListener) {
    tokio::spawn(keep(studio.clone()));
    connections::serve(listener, router(studio)).await;
}

fn router(studio: Arc<Studio>) -> Router {
    Router::new()
        .route("/", get(index))
        .route("/studio.js", get(|| async { script(SCRIPT) }))
        .route("/plot.js", get(|| async { script(live::PLOT_SCRIPT) }))
        .route("/player.js", get(|| async { script(live::PLAYER_SCRIPT) }))
        .route("/studio.css", get(|| async { style(STYLE.to_owned()) }))
        .route("/look.css", get(|| async { style(live::style()) }))
        .route("/api/scenes", get(scenes))
        .route("/api/first", get(first::page))
        .route("/api/schema", get(questions::schema))
        .route("/api/parts", get(questions::parts))
        .route("/api/model", get(questions::model))
        .route("/api/figures", get(questions::figures))
        .route("/api/steps", get(questions::steps))
        .route("/api/linkages", get(questions::linkages))
        .route("/api/motion", get(questions::motion))
        .route("/api/preview", get(first::preview))
        .route("/api/questions", get(files::forms))
        .route(FILE, get(files::file))
        .route("/api/text", get(files::text))
        .route("/ws", get(upgrade))
        .fallback(|| async { refused(StatusCode::NOT_FOUND) })
        .layer(DefaultBodyLimit::max(BODY))
        .layer(middleware::from_fn_with_state(studio.clone(), guard))
        .with_state(studio)
}

async fn index(Extension(Nonce(nonce)): Extension<Nonce>) -> Response {
    let page = PAGE.replace(NONCE, &nonce);
    ([(CONTENT_TYPE, "text/html; charset=utf-8")], page).into_response()
}

fn script(text: &'static str) -> Response {
    ([(CONTENT_TYPE, "text/javascript; charset=utf-8")], text).into_response()
}

fn style(text: String) -> Response {
    ([(CONTENT_TYPE, "text/css; charset=utf-8")], text).into_response()
}

async fn scenes(State(studio): State<Arc<Studio>>) -> Response {
    Json(json!({ "folder": studio.folder.name(), "scenes": studio.folder.scenes() }))
        .into_response()
}

async fn upgrade(State(studio): State<Arc<Studio>>, upgrade: WebSocketUpgrade) -> Response {
    upgrade
        .max_message_size(BODY)
        .max_frame_size(BODY)
        .max_write_buffer_size(64 << 20)
        .on_upgrade(move |socket| socket::serve(socket, studio))
}
