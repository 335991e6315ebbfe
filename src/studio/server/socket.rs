//! A window's WebSocket: what it says, and what it is sent.

use super::atomic;
use super::room::Room;
use super::served::Studio;
use super::token::random;
use super::window::{Sent, Window, WindowInput};
use crate::studio::gallery;
use crate::studio::messages::{Since, WindowMessage};
use crate::studio::server::limits::{HELLO, WINDOWS};
use axum::extract::ws::{Message, WebSocket};
use serde_json::json;
use std::io::Write;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};

/// Numbers of windows; 0 is nobody.
static NEXT: AtomicU64 = AtomicU64::new(1);

/// One of the windows at present.
struct Place(Arc<AtomicUsize>);

impl Place {
    fn take(studio: &Studio) -> Option<Self> {
        let place = Self(studio.windows.clone());
        // One too many is given back as this is dropped.
        (place.0.fetch_add(1, Ordering::Relaxed) < WINDOWS).then_some(place)
    }
}

impl Drop for Place {
    fn drop(&mut self) {
        self.0.fetch_sub(1, Ordering::Relaxed);
    }
}

/// Serves a window until it goes.
pub(super) async fn serve(mut socket: WebSocket, studio: Arc<Studio>) {
    let Some((tab, author)) = greeted(&mut socket, &studio).await else {
        return;
    };
    let Some(_place) = Place::take(&studio) else {
        return;
    };
    let window = Window::new(NEXT.fetch_add(1, Ordering::Relaxed), &tab).of_author(&author);
    let window = Arc::new(window);
    let welcome = json!({
        "type": "welcome",
        "window": window.author,
        "token": studio.token().text(),
        "folder": studio.folder.name(),
        "scene": studio.scene,
        "settings": studio.settings.all_settings(),
        "program": env!("CARGO_PKG_VERSION"),
    });
    window.send(welcome.to_string().into());
    let mut visit = Visit {
        studio,
        window,
        room: None,
    };
    // What goes wrong with the connection ends the visit.
    let _ = visit.last(&mut socket).await;
    if let Some(room) = visit.room.take() {
        room.remove_window(&visit.window);
    }
}

/// The next message, where it comes in time.
async fn said(socket: &mut WebSocket) -> Option<WindowMessage> {
    let message = tokio::time::timeout(HELLO, socket.recv()).await;
    match message {
        Ok(Some(Ok(Message::Text(text)))) => serde_json::from_str(&text).ok(),
        _ => None,
    }
}

/// Tab and author of a window that has the token, or proves that it has one of an earlier program.
async fn greeted(socket: &mut WebSocket, studio: &Studio) -> Option<(String, String)> {
    let (name, number, tab, author) = match said(socket).await? {
        WindowMessage::Hello { token, tab, author } => {
            return studio.token().is(&token).then_some((tab, author));
        }
        WindowMessage::Back {
            name,
            number,
            tab,
            author,
        } => (name, number, tab, author),
        _ => return None,
    };
    let token = studio.earlier.named(&name)?;
    let own = random().ok()?;
    let challenge = json!({
        "type": "challenge",
        "number": own,
        "proof": token.proof("program", &number).text(),
    });
    let challenge = Message::Text(challenge.to_string().into());
    socket.send(challenge).await.ok()?;
    match said(socket).await? {
        WindowMessage::Proof { proof } => {
            let is_right = token.proof("window", &own).is(&proof);
            is_right.then_some((tab, author))
        }
        _ => None,
    }
}

struct Visit {
    studio: Arc<Studio>,
    window: Arc<Window>,
    room: Option<Arc<Room>>,
}

impl Visit {
    async fn last(&mut self, socket: &mut WebSocket) -> Option<()> {
        loop {
            while let Some(sent) = self.window.next_message().ok()? {
                let message = match sent {
                    Sent::Text(text) => Message::Text((&*text).into()),
                    Sent::Binary(bytes) => Message::Binary(bytes.into()),
                };
                socket.send(message).await.ok()?;
            }
            let window = self.window.clone();
            tokio::select! {
                () = window.wake.notified() => {}
                said = socket.recv() => match said?.ok()? {
                    Message::Text(text) => self.handle_message(&text)?,
                    Message::Ping(_) | Message::Pong(_) => {}
                    Message::Binary(_) | Message::Close(_) => return None,
                },
            }
        }
    }

    /// `None`: it says what no window says, and is not listened to any more.
    fn handle_message(&mut self, text: &str) -> Option<()> {
        let said = serde_json::from_str(text).ok()?;
        if let Err(message) = self.obey(said) {
            let told = json!({ "type": "error", "message": message });
            self.window.send(told.to_string().into());
        }
        Some(())
    }

    fn obey(&mut self, said: WindowMessage) -> Result<(), String> {
        let id = self.window.id;
        match said {
            WindowMessage::Open { scene, since } => return self.open_scene(&scene, since.as_ref()),
            WindowMessage::Ping { number } => {
                let told = json!({ "type": "pong", "number": number });
                self.window.send(told.to_string().into());
                return Ok(());
            }
            WindowMessage::Keep { name, value } => {
                return self.studio.settings.write_setting(&name, &value);
            }
            WindowMessage::Shown => self.window.acknowledge(WindowInput::Answer),
            WindowMessage::MapShown => self.window.acknowledge(WindowInput::Map),
            WindowMessage::QuestionShown => self.window.acknowledge(WindowInput::Question),
            WindowMessage::Hello { .. }
            | WindowMessage::Back { .. }
            | WindowMessage::Proof { .. } => return Err("it is known who you are".to_owned()),
            WindowMessage::New { scene, from } => {
                let text = match from {
                    None => empty(&scene),
                    Some(of) => gallery::beginning(&of)?,
                };
                self.write(&scene, &text)?;
                return self.open_scene(&scene, None);
            }
            _ => {}
        }
        let room = self.room.clone().ok_or("no scene is open")?;
        match said {
            WindowMessage::Push {
                version,
                heard,
                updates,
            } => room.push(&self.window, version, heard.unwrap_or(version), &updates),
            WindowMessage::GoTo { count, version } => room.go_to(count, version),
            WindowMessage::Save => room.save(),
            WindowMessage::Pin { name } => {
                room.keep_run(id, &name)?;
                keep_pins(room);
                Ok(())
            }
            WindowMessage::Unpin { pin } => {
                room.change_view(id, |view| view.unpin(pin));
                keep_pins(room);
                Ok(())
            }
            WindowMessage::Rename { pin, name } => {
                room.change_view(id, |view| view.rename(pin, &name));
                keep_pins(room);
                Ok(())
            }
            WindowMessage::SaveAs { scene } => {
                self.write(&scene, &room.text())?;
                self.open_scene(&scene, None)
            }
            WindowMessage::Reload => room.decide_on_reload(true),
            WindowMessage::KeepMine => room.decide_on_reload(false),
            other => {
                match other {
                    WindowMessage::Undo => room.step(true),
                    WindowMessage::Redo => room.step(false),
                    WindowMessage::Draft { restore } => room.draft(restore),
                    WindowMessage::Map { question } => room.map(id, question),
                    WindowMessage::Question { question } => room.question(id, question),
                    WindowMessage::Over { signals } => {
                        room.change_view(id, |view| view.over = signals)
                    }
                    WindowMessage::Sight { charts } => {
                        room.set_visible_charts(&self.window, charts)
                    }
                    // Heard above.
                    _ => {}
                }
                Ok(())
            }
        }
    }

    fn open_scene(&mut self, scene: &str, since: Option<&Since>) -> Result<(), String> {
        let room = self.studio.document_of_file(scene)?;
        if let Ok(path) = self.studio.folder.file(scene) {
            let recent = self.studio.recent.clone();
            // Nobody waits for the disk.
            tokio::task::spawn_blocking(move || recent.remember(&path));
        }
        if let Some(before) = self.room.replace(room.clone()) {
            before.remove_window(&self.window);
        }
        room.add_window(&self.window, since);
        Ok(())
    }

    /// Makes a new file.
    fn write(&self, scene: &str, text: &str) -> Result<(), String> {
        let place = self.studio.folder.path_of_new_file(scene)?;
        atomic::new(&place, false)
            .and_then(|mut file| {
                file.write_all(text.as_bytes())
                    .and_then(|()| file.sync_all())
            })
            .map_err(|error| format!("the file cannot be written: {}", error.kind()))
    }
}

/// Keeps what is pinned; nobody waits for the disk.
fn keep_pins(room: Arc<Room>) {
    tokio::task::spawn_blocking(move || room.keep_pins());
}

/// An empty scene.
fn empty(file: &str) -> String {
    let name = file.rsplit('/').next().unwrap_or(file);
    let name = json!(name.trim_end_matches(".json").replace(['_', '-'], " "));
    format!(
        "{{\n  \"dam\": 1,\n  \"name\": {name},\n  \"objects\": {{\n  }},\n  \"run\": {{ \"duration\": \"1 s\", \"start\": \"static\" }}\n}}\n"
    )
}
