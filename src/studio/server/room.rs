//! The document of a file: its text, which all windows on it share, and what follows from it.
//!
//! Windows send edits of a version of the text, in the form that their editor has. Edits of the
//! newest version are taken and sent to all windows; the window that sent others makes them
//! anew. A window sends up to three messages ahead, each with the version that it knew. They
//! are taken if all that came since is its own.

mod desks;
mod pinned;

use super::disk::OnDisk;
use super::drafts::Drafts;
use super::folder::Shelf;
use super::history::EditGroup;
use super::inquiry::{Inquirer, Inquiry};
use super::pin_files::Pins;
use super::state::State;
use super::text::Text;
use super::window::Window;
use super::work::{Desk, Rank};
use crate::studio::commands::{Commands, Question};
use crate::studio::messages::{self, Update};
use desks::{AnswerCache, failed, failed_question};
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};

/// A document.
#[derive(Debug)]
pub(super) struct Room {
    name: String,
    path: PathBuf,
    shelf: Shelf,
    /// One at a time writes what is pinned.
    pins: Mutex<Pins>,
    state: Mutex<State>,
    runs: OnceLock<Arc<Desk<RunQuestion>>>,
    maps: OnceLock<Arc<Desk<MapQuestion>>>,
    questions: OnceLock<Arc<Desk<Inquiry>>>,
    /// Raised where memory ran out.
    exhausted: AtomicBool,
    exhausted_question: Arc<AtomicBool>,
}

/// A version that is to be answered.
#[derive(Debug)]
struct RunQuestion {
    version: u64,
    text: String,
    /// Windows see something else of the run.
    again: bool,
}

/// Maps of a version.
#[derive(Debug)]
struct MapQuestion {
    version: u64,
    text: String,
    asked: Vec<(Arc<Window>, messages::MapRequest)>,
}

impl Room {
    /// Opens a file of the folder.
    ///
    /// # Errors
    /// It cannot be read.
    pub(super) fn open(
        name: &str,
        path: &Path,
        shelf: Shelf,
        (drafts, pins): (Drafts, Pins),
        commands: &'static dyn Commands,
    ) -> Result<Arc<Self>, String> {
        let disk = OnDisk::open(path, drafts)?;
        let text = Text::new(disk.saved().to_owned())?;
        let room = Arc::new(Self {
            name: name.to_owned(),
            path: path.to_owned(),
            shelf,
            state: Mutex::new(State::new(text, disk, pins.find(path))),
            pins: Mutex::new(pins),
            runs: OnceLock::new(),
            maps: OnceLock::new(),
            questions: OnceLock::new(),
            exhausted: AtomicBool::new(false),
            exhausted_question: Arc::default(),
        });
        let (one, other) = (Arc::downgrade(&room), Arc::downgrade(&room));
        let mut kept = AnswerCache::default();
        let run = move |question, stop: &AtomicBool| {
            if let Some(room) = one.upgrade() {
                room.answer_version(&question, stop, &mut kept);
            }
        };
        let runs = Desk::new("run", Rank::Beside, run, move || failed(&other))?;
        let (one, other) = (Arc::downgrade(&room), Arc::downgrade(&room));
        let mut known = BTreeMap::new();
        let chart = move |question, stop: &AtomicBool| {
            if let Some(room) = one.upgrade() {
                room.chart(&question, stop, &mut known);
            }
        };
        let maps = Desk::new("map", Rank::Behind, chart, move || failed(&other))?;
        let (one, other) = (Arc::downgrade(&room), Arc::downgrade(&room));
        let (shelf, exhausted) = (room.shelf.clone(), room.exhausted_question.clone());
        let mut inquirer = Inquirer::new(commands, shelf, exhausted);
        let answer = move |inquiry: Inquiry, stop: &AtomicBool| {
            if let Some(room) = one.upgrade() {
                inquirer.answer_inquiry(&room.name, &inquiry, stop);
            }
        };
        let questions = Desk::new("question", Rank::Beside, answer, move || {
            failed_question(&other)
        })?;
        // They are set here alone.
        let _ = (room.runs.set(runs), room.maps.set(maps));
        let _ = room.questions.set(questions);
        room.request_run(&room.lock());
        Ok(room)
    }

    fn lock(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Name of the file below the folder.
    pub(super) fn name(&self) -> &str {
        &self.name
    }

    /// The text at present.
    pub(super) fn text(&self) -> String {
        self.lock().text.text().to_owned()
    }

    /// The text at present, with its version.
    pub(super) fn newest(&self) -> (u64, String) {
        let state = self.lock();
        (state.text.version(), state.text.text().to_owned())
    }

    /// What the scene may copy from.
    pub(super) fn catalogue(&self) -> &Shelf {
        &self.shelf
    }

    /// Whether nobody looks at it, and nothing of it would be lost.
    pub(super) fn is_idle(&self) -> bool {
        let state = self.lock();
        let (text, version) = (state.text.text(), state.text.version());
        state.windows.is_empty() && state.disk.is_safe(text, version)
    }

    /// A window looks at it, or does so again.
    pub(super) fn add_window(&self, window: &Arc<Window>, since: Option<&messages::Since>) {
        let mut state = self.lock();
        window.forget_document();
        let resumed = since.and_then(|since| state.resumed(&self.name, since));
        let message = resumed.unwrap_or_else(|| state.opened(&self.name));
        window.send(message.into());
        let again = state.window_returns(window);
        state.windows.insert(window.id, window.clone());
        window.send(state.status_message().into());
        if let Some(checked) = &state.checked {
            window.send(checked.clone());
        }
        if let Some(answer) = &state.answer {
            window.answer(answer.clone());
        }
        if again {
            self.request_more_of_run(&state);
        }
    }

    /// A window is gone, or looks at another.
    pub(super) fn remove_window(&self, window: &Window) {
        self.lock().window_leaves(window);
    }

    /// A window sees these charts: those that come into its sight it is sent with their numbers.
    pub(super) fn set_visible_charts(&self, window: &Window, charts: BTreeSet<usize>) {
        let state = self.lock();
        if window.set_visible_charts(charts)
            && let Some(answer) = state.answer_for(window.id)
        {
            window.answer_again(answer.clone());
        }
    }

    /// Edits of a window: those of the newest version are taken; others must be made anew on
    /// what the window has not seen, which it is sent anyway.
    pub(super) fn push(
        &self,
        window: &Window,
        version: u64,
        heard: u64,
        updates: &[Update],
    ) -> Result<(), String> {
        let mut state = self.lock();
        if state.disk.is_asking() {
            return Err("decide about the draft first".to_owned());
        }
        if !state.is_newest(window.id, version, heard) {
            window.send(
                json!({ "type": "late", "version": state.text.version() })
                    .to_string()
                    .into(),
            );
            return Ok(());
        }
        let before = state.text.version();
        let mut taken = Vec::new();
        let mut fault = None;
        for update in updates {
            let group = match update.drag {
                Some(drag) => EditGroup::Drag(window.id, drag),
                None => EditGroup::Typing(window.id),
            };
            fault = state.text.apply(&update.changes, group).err();
            if fault.is_some() {
                break;
            }
            taken.push(update.changes.clone());
        }
        // At once: a window that hears of a part would send the rest again.
        state.broadcast_changes(before, Some(window), &taken);
        if fault.is_some() {
            // The window has what the others have not: it begins anew.
            window.send(state.opened(&self.name).into());
        }
        self.changed(state);
        fault.map_or(Ok(()), Err)
    }

    /// Takes a step back, or does it again.
    pub(super) fn step(&self, back: bool) {
        let mut state = self.lock();
        if state.disk.is_asking() {
            return;
        }
        let before = state.text.version();
        let changes = match back {
            true => state.text.undo(),
            false => state.text.redo(),
        };
        if let Some(changes) = changes {
            state.broadcast_changes(before, None, &changes);
            self.changed(state);
        }
    }

    /// Takes steps back, or does them again, until so many of a version are done.
    pub(super) fn go_to(&self, count: usize, version: u64) -> Result<(), String> {
        let mut state = self.lock();
        if state.disk.is_asking() {
            return Err("decide about the draft first".to_owned());
        }
        if state.text.version() != version {
            return Err("the text was changed meanwhile: choose the step again".to_owned());
        }
        let changes = state.text.go_to(count);
        if !changes.is_empty() {
            state.broadcast_changes(version, None, &changes);
            self.changed(state);
        }
        Ok(())
    }

    /// The steps that undo takes back and redo does again.
    pub(super) fn steps(&self) -> Value {
        // Listed from a copy: edits do not wait for it.
        let text = self.lock().text.clone();
        text.steps()
    }

    /// Writes the text to its file, unless others have changed that.
    pub(super) fn save(&self) -> Result<(), String> {
        let mut state = self.lock();
        let State { text, disk, .. } = &mut *state;
        let saved = disk.save(text.text());
        state.broadcast_status();
        saved
    }

    /// The file was changed by others: takes it, or stays with the text.
    pub(super) fn decide_on_reload(&self, reload: bool) -> Result<(), String> {
        let mut state = self.lock();
        let found = state.disk.decide_on_change(reload)?;
        if reload {
            let before = state.text.version();
            let changes = state.text.replace(&found);
            state.broadcast_changes(before, None, &changes);
        }
        self.changed(state);
        Ok(())
    }

    /// Takes the draft that was offered, or forgets it.
    pub(super) fn draft(&self, restore: bool) {
        let mut state = self.lock();
        let Some(draft) = state.disk.decide_on_draft(restore) else {
            return;
        };
        if let Some(draft) = draft {
            let before = state.text.version();
            let changes = state.text.replace(&draft);
            state.broadcast_changes(before, None, &changes);
        }
        self.changed(state);
    }

    /// Asks for a map that follows the text.
    pub(super) fn map(&self, window: u64, question: Option<messages::MapRequest>) {
        let mut state = self.lock();
        match question {
            Some(question) => state.asked.insert(window, question),
            None => state.asked.remove(&window),
        };
        self.submit_map(&state);
    }

    /// Asks a question that follows the text.
    pub(super) fn question(&self, window: u64, question: Option<Question>) {
        let mut state = self.lock();
        match question {
            Some(question) => state.questions.insert(window, question),
            None => state.questions.remove(&window),
        };
        self.submit_questions(&state);
    }

    /// The text is another.
    fn changed(&self, mut state: MutexGuard<'_, State>) {
        state.broadcast_status();
        self.request_run(&state);
    }

    /// What is looked at from time to time: work that has gone on too long; the file; the draft.
    pub(super) fn supervise(
        &self,
        memory: u64,
        round: u64,
    ) -> Option<impl FnOnce() + Send + use<>> {
        for desk in self.runs.get().into_iter() {
            if desk.end_overdue(memory) {
                self.exhausted.store(true, Ordering::Relaxed);
            }
        }
        if let Some(desk) = self.maps.get() {
            desk.end_overdue(memory);
        }
        for desk in self.questions.get().into_iter() {
            if desk.end_overdue(memory) {
                self.exhausted_question.store(true, Ordering::Relaxed);
            }
        }
        if !round.is_multiple_of(10) {
            return None;
        }
        let mut state = self.lock();
        let State { text, disk, .. } = &mut *state;
        disk.check_for_changes(text.text());
        let kept = match round.is_multiple_of(20) {
            true => disk.save_as_draft(text.text(), text.version()),
            false => None,
        };
        state.broadcast_status();
        kept
    }
}

impl Drop for Room {
    fn drop(&mut self) {
        if let Some(desk) = self.runs.get() {
            desk.close();
        }
        if let Some(desk) = self.maps.get() {
            desk.close();
        }
        if let Some(desk) = self.questions.get() {
            desk.close();
        }
    }
}
