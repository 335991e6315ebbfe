//! The questions that there are, and the files that their commands write.
//!
//! A file is made when it is requested, by the same command once more.

use super::questions::{Opened, refused};
use super::served::Studio;
use super::work::{LOOK, memory};
use crate::studio::commands::{CommandScene, Question};
use crate::studio::limits::ANSWER;
use crate::studio::server::limits::MEMORY;
use axum::Json;
use axum::extract::{Query, State};
use axum::http::StatusCode;
use axum::http::header::CONTENT_TYPE;
use axum::response::{IntoResponse, Response};
use serde::Deserialize;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// The path at which files are asked for, which may take as long as a run.
pub(super) const FILE: &str = "/api/file";

/// Ends the work of whoever does not wait for it any more.
struct CancelOnDrop(Arc<AtomicBool>);

impl Drop for CancelOnDrop {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
}

/// The questions with their forms, for a scene as it is edited at present.
pub(super) async fn forms(State(studio): State<Arc<Studio>>, Opened(room): Opened) -> Response {
    let ends = CancelOnDrop(Arc::default());
    let (stop, commands) = (ends.0.clone(), studio.commands);
    let work = move || {
        let (version, text) = room.newest();
        let asked = CommandScene::new((room.name(), &text), room.catalogue(), &stop);
        let mut forms = commands.forms(&asked);
        forms["version"] = version.into();
        forms
    };
    match tokio::task::spawn_blocking(work).await {
        Ok(forms) => Json(forms).into_response(),
        Err(_) => refused(StatusCode::INTERNAL_SERVER_ERROR, "the computation failed"),
    }
}

/// The text at present, byte for byte.
pub(super) async fn text(Opened(room): Opened) -> Response {
    plain(room.text())
}

/// What it is stands in its name: nothing shows it here.
fn plain(text: String) -> Response {
    ([(CONTENT_TYPE, "text/plain; charset=utf-8")], text).into_response()
}

/// A file of a command.
#[derive(Deserialize)]
pub(super) struct FileRequest {
    /// The question, as JSON.
    question: String,
    name: String,
}

/// A file that a command writes: of the scene as it is edited at present.
pub(super) async fn file(
    State(studio): State<Arc<Studio>>,
    Opened(room): Opened,
    Query(wanted): Query<FileRequest>,
) -> Response {
    let question: Question = match serde_json::from_str(&wanted.question) {
        Ok(question) => question,
        Err(_) => return refused(StatusCode::BAD_REQUEST, "this is no question"),
    };
    // One at a time: what a file takes of memory and time is its own.
    let _turn = studio.making.lock().await;
    let ends = CancelOnDrop(Arc::default());
    let (stop, commands) = (ends.0.clone(), studio.commands);
    let work = tokio::task::spawn_blocking(move || {
        let (_, text) = room.newest();
        let asked = CommandScene::new((room.name(), &text), room.catalogue(), &stop);
        commands.file(&question, &asked, &wanted.name)
    });
    let done = tokio::select! {
        done = work => done,
        () = too_large() => {
            let words = "it took too much memory and was ended";
            return refused(StatusCode::PAYLOAD_TOO_LARGE, words);
        }
    };
    match done {
        Err(_) => refused(StatusCode::INTERNAL_SERVER_ERROR, "the computation failed"),
        Ok(Err(words)) => refused(StatusCode::UNPROCESSABLE_ENTITY, &words),
        Ok(Ok(None)) => refused(StatusCode::NOT_FOUND, "there is no such file"),
        Ok(Ok(Some(text))) if text.len() > ANSWER => {
            let words = "the file is too large for the studio: let the program write it";
            refused(StatusCode::PAYLOAD_TOO_LARGE, words)
        }
        Ok(Ok(Some(text))) => plain(text),
    }
}

/// Comes to its end when memory runs out.
async fn too_large() {
    let start = memory();
    let mut interval = tokio::time::interval(LOOK);
    while memory().saturating_sub(start) <= MEMORY {
        interval.tick().await;
    }
}
