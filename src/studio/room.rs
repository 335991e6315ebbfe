//! The document of a file: its text, which all windows on it share, and what follows from it.

use super::answer::{self, Answer, Asked};
use super::atomic;
use super::chart::{Task, Told};
use super::drafts::{Draft, Drafts};
use super::folder::{Folder, Shelf};
use super::messages::{self, Update};
use super::text::{Group, Text};
use super::window::Window;
use super::work::Desk;
use crate::ask::Judging;
use crate::frontend::diagnostics::Diagnostics;
use crate::frontend::scene::Document;
use crate::report::live::Charts;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError, Weak};
use std::time::SystemTime;

/// A document.
#[derive(Debug)]
pub(super) struct Room {
    name: String,
    path: PathBuf,
    shelf: Shelf,
    drafts: Drafts,
    state: Mutex<State>,
    runs: OnceLock<Arc<Desk<Question>>>,
    maps: OnceLock<Arc<Desk<MapQuestion>>>,
    /// Raised where memory ran out.
    exhausted: AtomicBool,
}

#[derive(Debug)]
struct State {
    text: Text,
    /// What the file held when it was last read or written.
    saved: String,
    disk: Disk,
    /// A draft that waits for a decision; the text is not to be changed before.
    offered: Option<Draft>,
    /// Version of the text in the draft on the disk; `None`: there is none.
    drafted: Option<u64>,
    windows: BTreeMap<u64, Arc<Window>>,
    asked: BTreeMap<u64, messages::Asked>,
    checked: Option<Arc<str>>,
    answer: Option<Arc<Answer>>,
    status: String,
}

/// The file beside the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Disk {
    /// As it was left.
    Same(Stamp),
    /// Changed by others, which the user has not decided on.
    Changed(Stamp),
    /// Gone.
    Gone,
}

/// Tells one state of a file from another without reading it.
type Stamp = Option<(SystemTime, u64)>;

/// A version that is to be answered.
#[derive(Debug)]
struct Question {
    version: u64,
    text: String,
}

/// Maps of a version.
#[derive(Debug)]
struct MapQuestion {
    version: u64,
    text: String,
    asked: Vec<(Arc<Window>, messages::Asked)>,
}

fn stamp(path: &Path) -> Stamp {
    let known = path.metadata().ok()?;
    Some((known.modified().ok()?, known.len()))
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
        drafts: Drafts,
    ) -> Result<Arc<Self>, String> {
        let disk = Disk::Same(stamp(path));
        let saved = Folder::read(path)?;
        let offered = drafts.find(path).filter(|draft| draft.text != saved);
        if offered.is_none() {
            // One of what was saved in the end.
            drafts.forget(path);
        }
        let room = Arc::new(Self {
            name: name.to_owned(),
            path: path.to_owned(),
            shelf,
            drafts,
            state: Mutex::new(State {
                text: Text::new(saved.clone())?,
                saved,
                disk,
                drafted: offered.as_ref().map(|_| 0),
                offered,
                windows: BTreeMap::new(),
                asked: BTreeMap::new(),
                checked: None,
                answer: None,
                status: String::new(),
            }),
            runs: OnceLock::new(),
            maps: OnceLock::new(),
            exhausted: AtomicBool::new(false),
        });
        let (one, other) = (Arc::downgrade(&room), Arc::downgrade(&room));
        let mut kept = Charts::default();
        let run = move |question, stop: &AtomicBool| {
            if let Some(room) = one.upgrade() {
                room.work(&question, stop, &mut kept);
            }
        };
        let runs = Desk::new("run", run, move || failed(&other))?;
        let (one, other) = (Arc::downgrade(&room), Arc::downgrade(&room));
        let mut known = BTreeMap::new();
        let chart = move |question, stop: &AtomicBool| {
            if let Some(room) = one.upgrade() {
                room.chart(&question, stop, &mut known);
            }
        };
        let maps = Desk::new("map", chart, move || failed(&other))?;
        // Both are set here alone.
        let _ = (room.runs.set(runs), room.maps.set(maps));
        room.ask(&room.lock());
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

    /// What the scene may copy from.
    pub(super) fn catalogue(&self) -> &Shelf {
        &self.shelf
    }

    /// Whether nobody looks at it, and nothing of it would be lost.
    pub(super) fn is_idle(&self) -> bool {
        let state = self.lock();
        state.windows.is_empty()
            && (!state.is_dirty() || state.drafted == Some(state.text.version()))
    }

    /// A window looks at it.
    pub(super) fn join(&self, window: &Arc<Window>) {
        let mut state = self.lock();
        window.forget();
        window.send(state.opened(&self.name).into());
        state.windows.insert(window.id, window.clone());
        window.send(state.told_status().into());
        if let Some(checked) = &state.checked {
            window.send(checked.clone());
        }
        if let Some(answer) = &state.answer {
            window.answer(answer.clone());
        }
    }

    /// A window is gone, or looks at another.
    pub(super) fn leave(&self, window: u64) {
        let mut state = self.lock();
        state.windows.remove(&window);
        state.asked.remove(&window);
    }

    /// Edits of a window: those of the newest version are taken; others must be made anew on
    /// what the window has not seen, which it is sent anyway.
    pub(super) fn push(
        &self,
        window: &Window,
        version: u64,
        updates: &[Update],
    ) -> Result<(), String> {
        let mut state = self.lock();
        if state.offered.is_some() {
            return Err("decide about the draft first".to_owned());
        }
        if version != state.text.version() {
            window.send(
                json!({ "type": "late", "version": state.text.version() })
                    .to_string()
                    .into(),
            );
            return Ok(());
        }
        for update in updates {
            let group = match update.drag {
                Some(drag) => Group::Drag(window.id, drag),
                None => Group::Typing(window.id),
            };
            let before = state.text.version();
            if let Err(fault) = state.text.apply(&update.changes, group) {
                // The window has what the others have not: it begins anew.
                window.send(state.opened(&self.name).into());
                return Err(fault);
            }
            state.tell_changes(before, window.id, std::slice::from_ref(&update.changes));
        }
        self.changed(state);
        Ok(())
    }

    /// Takes a step back, or does it again.
    pub(super) fn step(&self, back: bool) {
        let mut state = self.lock();
        if state.offered.is_some() {
            return;
        }
        let before = state.text.version();
        let changes = match back {
            true => state.text.undo(),
            false => state.text.redo(),
        };
        if let Some(changes) = changes {
            state.tell_changes(before, 0, &changes);
            self.changed(state);
        }
    }

    /// Writes the text to its file, unless others have changed that.
    pub(super) fn save(&self) -> Result<(), String> {
        let mut state = self.lock();
        // The last look before it is written over.
        self.look_at(&mut state);
        if let Disk::Changed(_) = state.disk {
            state.tell_status();
            return Err("the file was changed by another program; decide first".to_owned());
        }
        self.is_itself()?;
        let written = atomic::write(&self.path, state.text.text().as_bytes(), false);
        written.map_err(|error| format!("the file cannot be written: {}", error.kind()))?;
        state.saved = state.text.text().to_owned();
        state.disk = Disk::Same(stamp(&self.path));
        self.drafts.forget(&self.path);
        state.drafted = None;
        state.tell_status();
        Ok(())
    }

    /// The file was changed by others: takes it, or stays with the text.
    pub(super) fn decide(&self, reload: bool) -> Result<(), String> {
        let mut state = self.lock();
        let stamp = stamp(&self.path);
        self.is_itself()?;
        let found = Folder::read(&self.path)?;
        if reload {
            if found.replace("\r\n", "").contains('\r') {
                return Err("lines of the file end with CR alone, which cannot be kept".to_owned());
            }
            let before = state.text.version();
            let changes = state.text.replace(&found);
            state.tell_changes(before, 0, &changes);
        }
        state.saved = found;
        state.disk = Disk::Same(stamp);
        self.changed(state);
        Ok(())
    }

    /// Takes the draft that was offered, or forgets it.
    pub(super) fn draft(&self, restore: bool) {
        let mut state = self.lock();
        let Some(draft) = state.offered.take() else {
            return;
        };
        if restore {
            let before = state.text.version();
            let changes = state.text.replace(&draft.text);
            state.tell_changes(before, 0, &changes);
        } else {
            self.drafts.forget(&self.path);
            state.drafted = None;
        }
        self.changed(state);
    }

    /// Asks for a map that follows the text.
    pub(super) fn map(&self, window: u64, question: Option<messages::Asked>) {
        let mut state = self.lock();
        match question {
            Some(question) => state.asked.insert(window, question),
            None => state.asked.remove(&window),
        };
        self.ask_map(&state);
    }

    /// The text is another.
    fn changed(&self, mut state: MutexGuard<'_, State>) {
        state.tell_status();
        self.ask(&state);
    }

    fn ask(&self, state: &State) {
        if let Some(runs) = self.runs.get() {
            runs.ask(Question {
                version: state.text.version(),
                text: state.text.text().to_owned(),
            });
        }
    }

    fn ask_map(&self, state: &State) {
        let windows = state.asked.iter();
        let asked =
            windows.filter_map(|(id, asked)| Some((state.windows.get(id)?.clone(), asked.clone())));
        if let Some(maps) = self.maps.get() {
            maps.ask(MapQuestion {
                version: state.text.version(),
                text: state.text.text().to_owned(),
                asked: asked.collect(),
            });
        }
    }

    /// Answers a version, on a thread of its own.
    fn work(&self, question: &Question, stop: &AtomicBool, kept: &mut Charts) {
        let asked = Asked {
            version: question.version,
            name: &self.name,
            text: &question.text,
            catalogue: &self.shelf,
        };
        let mut checked = asked.check();
        let Some(mut reading) = checked.reading.take() else {
            self.tell_checked(checked.message);
            return;
        };
        self.tell_checked(checked.message);
        {
            let state = self.lock();
            if !state.asked.is_empty() {
                self.ask_map(&state);
            }
        }
        let judged = answer::is_judged(&reading.scene);
        for judging in [Judging::Never, Judging::Asked] {
            let last = !judged || matches!(judging, Judging::Asked);
            match asked.run(reading, judging, stop, kept) {
                Err(faults) => {
                    self.told_faults(&asked, &faults);
                    return;
                }
                Ok(_) if self.exhausted.swap(false, Ordering::Relaxed) => {
                    self.tell_failure(
                        question.version,
                        "the run took too much memory and was ended",
                    );
                    return;
                }
                // Something newer has come.
                Ok(None) => return,
                Ok(Some((answer, charts))) => {
                    *kept = charts;
                    self.tell_answer(Arc::new(answer));
                }
            }
            if last {
                return;
            }
            match asked.check().reading {
                Some(again) => reading = again,
                None => return,
            }
        }
    }

    fn told_faults(&self, asked: &Asked<'_, Shelf>, faults: &Diagnostics) {
        let document = Document::parse(asked.name, asked.text.as_bytes()).ok();
        self.tell_checked(asked.message(document.as_ref(), faults));
    }

    fn tell_checked(&self, message: String) {
        let message: Arc<str> = message.into();
        let mut state = self.lock();
        state.tell(&message);
        state.checked = Some(message);
    }

    fn tell_answer(&self, answer: Arc<Answer>) {
        let mut state = self.lock();
        for window in state.windows.values() {
            window.answer(answer.clone());
        }
        state.answer = Some(answer);
    }

    fn tell_failure(&self, version: u64, words: &str) {
        let message = json!({ "type": "failed", "version": version, "message": words });
        self.lock().tell(&message.to_string().into());
    }

    /// Makes the maps of a version, on a thread of its own; those that are the same are left.
    fn chart(&self, question: &MapQuestion, stop: &AtomicBool, known: &mut BTreeMap<u64, String>) {
        known.retain(|id, _| question.asked.iter().any(|(window, _)| window.id == *id));
        for (window, asked) in &question.asked {
            let task = Task {
                version: question.version,
                name: &self.name,
                text: &question.text,
                catalogue: &self.shelf,
                asked,
            };
            let key = task.key().unwrap_or_default();
            if !key.is_empty() && known.get(&window.id) == Some(&key) {
                continue;
            }
            known.remove(&window.id);
            let Some(desk) = self.maps.get() else {
                return;
            };
            if task.make(stop, &Teller { window, desk }) {
                known.insert(window.id, key);
            }
        }
    }

    /// Whether no link has come in the way of the file since it was opened.
    fn is_itself(&self) -> Result<(), String> {
        let folder = self.path.parent();
        let folder_is = folder.is_some_and(|own| own.canonicalize().is_ok_and(|real| real == own));
        let file_is = match self.path.symlink_metadata() {
            Ok(known) => known.is_file(),
            // It is gone, and may be made anew.
            Err(_) => true,
        };
        match folder_is && file_is {
            true => Ok(()),
            false => Err("the file leads out of its folder now".to_owned()),
        }
    }

    /// Looks at the file: whether others have changed it.
    fn look_at(&self, state: &mut State) {
        let now = stamp(&self.path);
        let was = match state.disk {
            Disk::Same(was) | Disk::Changed(was) => was,
            Disk::Gone => None,
        };
        if now == was && now.is_some() {
            return;
        }
        let found = self.is_itself().and_then(|()| Folder::read(&self.path));
        state.disk = match (now, found) {
            (None, _) => Disk::Gone,
            (_, Ok(found)) if found == state.saved => Disk::Same(now),
            (_, Ok(found)) if found == state.text.text() => {
                state.saved = found;
                Disk::Same(now)
            }
            _ => Disk::Changed(now),
        };
    }

    /// What is looked at from time to time: work that has gone on too long; the file; the draft.
    pub(super) fn look(&self, memory: u64, round: u64) -> Option<impl FnOnce() + Send + 'static> {
        for desk in self.runs.get().into_iter() {
            if desk.look(memory) {
                self.exhausted.store(true, Ordering::Relaxed);
            }
        }
        if let Some(desk) = self.maps.get() {
            desk.look(memory);
        }
        if !round.is_multiple_of(10) {
            return None;
        }
        let mut state = self.lock();
        self.look_at(&mut state);
        state.tell_status();
        if !round.is_multiple_of(20) || state.offered.is_some() {
            return None;
        }
        let version = state.text.version();
        if !state.is_dirty() {
            if state.drafted.take().is_some() {
                self.drafts.forget(&self.path);
            }
            return None;
        }
        if state.drafted == Some(version) {
            return None;
        }
        state.drafted = Some(version);
        let (drafts, path) = (self.drafts.clone(), self.path.clone());
        let (saved, text) = (state.saved.clone(), state.text.text().to_owned());
        Some(move || {
            // Where drafts cannot be kept, the next second tries again.
            let _ = drafts.keep(&path, &saved, &text);
        })
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
    }
}

fn failed(room: &Weak<Room>) {
    if let Some(room) = room.upgrade() {
        let version = room.lock().text.version();
        let words = "the computation failed; this is an error of the program, not of the scene";
        room.tell_failure(version, words);
    }
}

/// Tells a window of its map.
struct Teller<'a> {
    window: &'a Arc<Window>,
    desk: &'a Desk<MapQuestion>,
}

impl Told for Teller<'_> {
    fn map(&self, message: String) -> bool {
        self.window.map(message.into());
        // From the coarse one on nothing keeps a newer one waiting.
        self.desk.hurry();
        !self.desk.has_next()
    }

    fn progress(&self, done: usize, of: usize) {
        let message = json!({ "type": "map_progress", "done": done, "of": of });
        self.window.send(message.to_string().into());
    }
}

impl State {
    fn is_dirty(&self) -> bool {
        self.text.text() != self.saved
    }

    fn tell(&self, message: &Arc<str>) {
        for window in self.windows.values() {
            window.send(message.clone());
        }
    }

    /// Everything that a window begins with.
    fn opened(&self, name: &str) -> String {
        let draft = self.offered.as_ref().map(
            |draft| json!({ "time": draft.time, "other_base": draft.is_of_another(&self.saved) }),
        );
        json!({
            "type": "opened",
            "scene": name,
            "version": self.text.version(),
            "text": self.text.shown(),
            "draft": draft,
        })
        .to_string()
    }

    /// Tells all windows of changes from a version on, and who made them.
    fn tell_changes(&self, version: u64, by: u64, changes: &[Value]) {
        let message = json!({
            "type": "updates",
            "version": version,
            "updates": changes.iter()
                .map(|changes| json!({ "by": by.to_string(), "changes": changes }))
                .collect::<Vec<_>>(),
        });
        self.tell(&message.to_string().into());
    }

    fn told_status(&self) -> String {
        let [undo, redo] = self.text.history();
        let disk = match self.disk {
            Disk::Same(_) => "same",
            Disk::Changed(_) => "changed",
            Disk::Gone => "gone",
        };
        json!({
            "type": "status",
            "saved": !self.is_dirty() && !matches!(self.disk, Disk::Gone),
            "undo": undo,
            "redo": redo,
            "disk": disk,
            "draft": self.offered.is_some(),
        })
        .to_string()
    }

    /// Tells all windows how it stands with the document, where that is news.
    fn tell_status(&mut self) {
        let status = self.told_status();
        if status != self.status {
            self.tell(&status.as_str().into());
            self.status = status;
        }
    }
}
