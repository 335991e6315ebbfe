//! What a document is at an instant, and what its windows are told of it.

use super::disk::OnDisk;
use super::pin_files::PinRecord;
use super::text::Text;
use super::window::Window;
use crate::studio::answer::Answer;
use crate::studio::commands::Question;
use crate::studio::messages::{MapRequest, Since};
use crate::studio::server::limits::{LEFT, LOGGED, LOGGED_SIZE};
use crate::studio::view::{SourcedRun, View};
use serde_json::{Value, json};
use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{SystemTime, UNIX_EPOCH};

/// A document at an instant.
#[derive(Debug)]
pub(super) struct State {
    pub(super) text: Text,
    pub(super) disk: OnDisk,
    pub(super) windows: BTreeMap<u64, Arc<Window>>,
    /// The maps that windows ask for.
    pub(super) asked: BTreeMap<u64, MapRequest>,
    /// The questions that they ask.
    pub(super) questions: BTreeMap<u64, Question>,
    /// What was last told of faults, and of a run.
    pub(super) checked: Option<Arc<str>>,
    pub(super) answer: Option<Arc<Answer>>,
    /// The run that it tells of.
    pub(super) run: Option<SourcedRun>,
    /// What windows see besides, and the answers as they see them.
    pub(super) views: BTreeMap<u64, View>,
    pub(super) answers: BTreeMap<u64, Arc<Answer>>,
    /// What windows saw that are gone, by their tabs, the last one last.
    left: Vec<(String, View)>,
    /// What was pinned last, and stays when the program ends.
    pub(super) pins: PinRecord,
    status: String,
    /// Who made the last edits, and the version from which on all are theirs.
    stretch: (u64, u64),
    /// Tells the document from that of another program.
    epoch: String,
    /// The last edits, with their authors: for windows whose connection was lost.
    log: VecDeque<Logged>,
}

/// An edit, who made it, and how long it is.
type Logged = (Arc<str>, Value, usize);

impl State {
    pub(super) fn new(text: Text, disk: OnDisk, pins: PinRecord) -> Self {
        Self {
            text,
            disk,
            windows: BTreeMap::new(),
            asked: BTreeMap::new(),
            questions: BTreeMap::new(),
            checked: None,
            answer: None,
            run: None,
            views: BTreeMap::new(),
            answers: BTreeMap::new(),
            left: Vec::new(),
            pins,
            status: String::new(),
            stretch: (0, 0),
            epoch: epoch(),
            log: VecDeque::new(),
        }
    }

    /// What was edited since a window lost its connection; `None`: it must begin anew.
    pub(super) fn resumed(&self, name: &str, since: &Since) -> Option<String> {
        let behind = usize::try_from(self.text.version().checked_sub(since.version)?).ok()?;
        let first = self.log.len().checked_sub(behind)?;
        let log = self.log.iter().skip(first);
        let updates = log.map(|(by, changes, _)| json!({ "by": **by, "changes": changes }));
        let resumed = json!({
            "type": "resumed",
            "scene": name,
            "version": since.version,
            "updates": updates.collect::<Vec<_>>(),
        });
        (since.epoch == self.epoch).then(|| resumed.to_string())
    }

    fn log(&mut self, by: &str, changes: &[Value]) {
        let by: Arc<str> = by.into();
        for one in changes {
            let size = one.to_string().len();
            self.log.push_back((by.clone(), one.clone(), size));
        }
        let mut size: usize = self.log.iter().map(|(_, _, size)| size).sum();
        while self.log.len() > LOGGED || size > LOGGED_SIZE {
            let first = self.log.pop_front();
            size -= first.map_or(size, |(_, _, size)| size);
        }
    }

    /// A window goes; what it saw waits for its tab, which may only be loaded anew.
    pub(super) fn window_leaves(&mut self, window: &Window) {
        let id = window.id;
        self.windows.remove(&id);
        self.asked.remove(&id);
        self.questions.remove(&id);
        self.answers.remove(&id);
        let Some(view) = self.views.remove(&id) else {
            return;
        };
        if !window.tab.is_empty() {
            self.left.retain(|(tab, _)| *tab != window.tab);
            self.left.push((window.tab.clone(), view));
            let over = self.left.len().saturating_sub(LEFT);
            self.left.drain(..over);
        }
    }

    /// A window comes: whether it sees again what its tab saw.
    pub(super) fn window_returns(&mut self, window: &Window) -> bool {
        let view = self.view_of(&window.tab).or_else(|| {
            let kept = self.pins.claim(&window.tab)?;
            Some(View::from_records(kept))
        });
        let again = view.is_some();
        if let Some(view) = view {
            self.views.insert(window.id, view);
        }
        again
    }

    /// What a tab saw.
    fn view_of(&mut self, tab: &str) -> Option<View> {
        if tab.is_empty() {
            return None;
        }
        let own = self.left.iter().position(|(other, _)| other == tab);
        match own {
            Some(place) => Some(self.left.remove(place).1),
            // The one that it replaces has not been missed yet.
            None => {
                let mut others = self.windows.values();
                let same = others.find(|other| other.tab == tab);
                same.and_then(|other| self.views.get(&other.id).cloned())
            }
        }
    }

    /// Changes what a window sees; what is pinned is to be kept then.
    pub(super) fn change_view<T>(&mut self, window: u64, change: impl FnOnce(&mut View) -> T) -> T {
        let view = self.views.entry(window).or_default();
        let before = view.pin_records();
        let told = change(view);
        let pins = view.pin_records();
        if pins != before {
            let tab = self.windows.get(&window).map_or("", |window| &window.tab);
            self.pins = PinRecord::of_window(tab, pins);
        }
        told
    }

    /// The answer as a window sees it.
    pub(super) fn answer_for(&self, window: u64) -> Option<&Arc<Answer>> {
        self.answers.get(&window).or(self.answer.as_ref())
    }

    pub(super) fn broadcast(&self, message: &Arc<str>) {
        for window in self.windows.values() {
            window.send(message.clone());
        }
    }

    /// Everything that a window begins with.
    pub(super) fn opened(&self, name: &str) -> String {
        json!({
            "type": "opened",
            "scene": name,
            "epoch": self.epoch,
            "version": self.text.version(),
            "text": self.text.with_unix_newlines(),
            "draft": self.disk.waiting_draft(),
        })
        .to_string()
    }

    /// Whether edits of a version are of the newest one, all that the window that makes them had
    /// not heard of being its own.
    pub(super) fn is_newest(&self, window: u64, version: u64, heard: u64) -> bool {
        let (by, from) = self.stretch;
        let own = heard == version || (by == window && from <= heard);
        version == self.text.version() && own
    }

    /// Tells all windows of changes from a version on, and who made them.
    pub(super) fn broadcast_changes(
        &mut self,
        version: u64,
        by: Option<&Window>,
        changes: &[Value],
    ) {
        let (number, author) = by.map_or((0, "0"), |window| (window.id, &window.author));
        if self.stretch.0 != number {
            self.stretch = (number, version);
        }
        self.log(author, changes);
        let message = json!({
            "type": "updates",
            "version": version,
            "updates": changes.iter()
                .map(|changes| json!({ "by": author, "changes": changes }))
                .collect::<Vec<_>>(),
        });
        self.broadcast(&message.to_string().into());
    }

    pub(super) fn status_message(&self) -> String {
        let [undo, redo] = self.text.history();
        json!({
            "type": "status",
            "saved": self.disk.has_text(self.text.text()),
            "base": self.disk.base(),
            "undo": undo,
            "redo": redo,
            "disk": self.disk.state_name(),
            "draft": self.disk.is_asking(),
        })
        .to_string()
    }

    /// Tells all windows how it stands with the document, where that is news.
    pub(super) fn broadcast_status(&mut self) {
        let status = self.status_message();
        if status != self.status {
            self.broadcast(&status.as_str().into());
            self.status = status;
        }
    }
}

/// A text that no other document has, of this program or of another one.
fn epoch() -> String {
    static COUNT: AtomicU64 = AtomicU64::new(0);
    let time = SystemTime::now().duration_since(UNIX_EPOCH);
    let time = time.map_or(0, |time| time.as_nanos());
    format!("{time}-{}", COUNT.fetch_add(1, Ordering::Relaxed))
}
