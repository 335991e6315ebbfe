//! What is served: a folder, its documents, the token of those who may see them.

use super::drafts::Drafts;
use super::earlier::Earlier;
use super::folder::Folder;
use super::pin_files::Pins;
use super::recent::Recent;
use super::room::Room;
use super::settings::Settings;
use super::token::Token;
use super::work::{LOOK, memory};
use crate::studio::commands::Commands;
use crate::studio::server::limits::ROOMS;
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::atomic::AtomicUsize;
use std::sync::{Arc, Mutex, PoisonError};

/// Everything that is served.
#[derive(Debug)]
pub(super) struct Studio {
    pub(super) folder: Folder,
    /// The scene that a window opens first.
    pub(super) scene: Option<String>,
    pub(super) drafts: Drafts,
    /// Runs that were pinned.
    pub(super) pins: Pins,
    /// What was opened last.
    pub(super) recent: Recent,
    pub(super) settings: Settings,
    /// Windows at present.
    pub(super) windows: Arc<AtomicUsize>,
    /// The commands that answer questions.
    pub(super) commands: &'static dyn Commands,
    /// Files that are made one after the other.
    pub(super) making: tokio::sync::Mutex<()>,
    /// Moving pictures of the first page too.
    pub(super) previewing: tokio::sync::Mutex<()>,
    /// Tokens that windows come back with.
    pub(super) earlier: Earlier,
    token: Token,
    host: String,
    rooms: Mutex<BTreeMap<PathBuf, Arc<Room>>>,
}

impl Studio {
    /// A folder, served on a port.
    ///
    /// # Errors
    /// The system gives no random numbers.
    pub(super) fn new(
        (folder, scene): (Folder, Option<String>),
        port: u16,
        commands: &'static dyn Commands,
    ) -> Result<Self, String> {
        let token = Token::new()?;
        Ok(Self {
            folder,
            scene,
            drafts: Drafts::of_user(),
            pins: Pins::of_user(),
            recent: Recent::of_user(),
            settings: Settings::of_user(),
            windows: Arc::default(),
            commands,
            making: tokio::sync::Mutex::default(),
            previewing: tokio::sync::Mutex::default(),
            earlier: Earlier::own_token_only(&token),
            token,
            host: format!("127.0.0.1:{port}"),
            rooms: Mutex::default(),
        })
    }

    /// Windows of the user's earlier programs come back, and those of this one to later ones.
    #[must_use]
    pub(super) fn with_earlier(mut self, port: u16) -> Self {
        self.earlier = Earlier::of_user(&self.token, port, self.folder.path());
        self
    }

    /// What `Host` must be.
    pub(super) fn host(&self) -> &str {
        &self.host
    }

    /// What `Origin` must be.
    pub(super) fn origin(&self) -> String {
        format!("http://{}", self.host)
    }

    /// The token.
    pub(super) fn token(&self) -> &Token {
        &self.token
    }

    /// The address that lets a window in: the token stands where no server is sent it.
    pub(super) fn address(&self) -> String {
        format!("{}/#{}", self.origin(), self.token.text())
    }

    /// The document of a file, which all its windows share.
    ///
    /// # Errors
    /// There is no such scene, or it cannot be read; too many are open.
    pub(super) fn document_of_file(&self, name: &str) -> Result<Arc<Room>, String> {
        let path = self.folder.file(name)?;
        let mut rooms = self.rooms.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(room) = rooms.get(&path) {
            return Ok(room.clone());
        }
        if rooms.len() >= ROOMS {
            let empty = rooms.iter().find(|(_, room)| room.is_idle());
            let empty = empty.map(|(path, _)| path.clone());
            let empty = empty.ok_or("too many scenes are open; close some windows")?;
            rooms.remove(&empty);
        }
        let room = Room::open(
            name,
            &path,
            self.folder.catalogue(&path),
            (self.drafts.clone(), self.pins.clone()),
            self.commands,
        )?;
        rooms.insert(path, room.clone());
        Ok(room)
    }

    /// All documents that are open.
    pub(super) fn open_documents(&self) -> Vec<Arc<Room>> {
        let rooms = self.rooms.lock().unwrap_or_else(PoisonError::into_inner);
        rooms.values().cloned().collect()
    }
}

/// Looks after all documents until the program ends.
pub(super) async fn keep(studio: Arc<Studio>) {
    let mut interval = tokio::time::interval(LOOK);
    let start = memory();
    for round in 0.. {
        interval.tick().await;
        let used = memory().saturating_sub(start);
        for room in studio.open_documents() {
            if let Some(write) = room.supervise(used, round) {
                tokio::task::spawn_blocking(write);
            }
        }
    }
}
