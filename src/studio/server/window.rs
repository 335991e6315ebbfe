//! What a window is sent: every message in order, of answers and maps the newest alone, and the
//! next only once the one before was taken up.
//!
//! A window states which charts are in its sight. It gets the columns of those and of what
//! moves; a chart that comes into sight comes with its numbers. Charts out of sight get their
//! numbers after a second without a change, so that a print shows the scene as it is. A window
//! gets the next answer once it has taken up the one before. It draws that as it comes, the
//! first since a frame, so that the frame finds it done. A quick answer is sent before faults
//! and numbers.

use crate::studio::answer::{Answer, Had};
use crate::studio::limits::NAME;
use crate::studio::server::limits::WAITING;
use std::collections::{BTreeSet, VecDeque};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use tokio::sync::Notify;

/// A window of the browser.
#[derive(Debug)]
pub(super) struct Window {
    /// Its number among all.
    pub(super) id: u64,
    /// The tab that it is in; empty: it says nothing of it.
    pub(super) tab: String,
    /// Who makes its edits.
    pub(super) author: String,
    queue: Mutex<Queue>,
    pub(super) wake: Notify,
}

#[derive(Debug, Default)]
struct Queue {
    messages: VecDeque<Arc<str>>,
    answer: Option<Arc<Answer>>,
    /// An answer was sent that was not taken up yet.
    showing: bool,
    map: Slot,
    question: Slot,
    had: Had,
    lost: bool,
}

/// A place for the newest message of a sort.
#[derive(Debug, Default)]
struct Slot {
    waiting: Option<Arc<str>>,
    /// One was sent that was not taken up yet.
    showing: bool,
}

impl Slot {
    fn take(&mut self) -> Option<Arc<str>> {
        if self.showing {
            return None;
        }
        let message = self.waiting.take();
        self.showing = message.is_some();
        message
    }
}

/// What a window takes up.
#[derive(Clone, Copy, Debug)]
pub(super) enum WindowInput {
    Answer,
    Map,
    Question,
}

/// Something to be sent.
#[derive(Debug)]
pub(super) enum Sent {
    /// A text.
    Text(Arc<str>),
    /// Bytes.
    Binary(Vec<u8>),
}

impl Window {
    pub(super) fn new(id: u64, tab: &str) -> Self {
        Self {
            id,
            tab: tab.chars().take(NAME).collect(),
            author: id.to_string(),
            queue: Mutex::default(),
            wake: Notify::new(),
        }
    }

    /// Its edits are those of an author, who may have had another connection before.
    pub(super) fn of_author(self, author: &str) -> Self {
        let author: String = author.chars().take(NAME).collect();
        // The number 0 is nobody.
        match author.as_str() {
            "" | "0" => self,
            _ => Self { author, ..self },
        }
    }

    fn lock(&self) -> MutexGuard<'_, Queue> {
        self.queue.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Sends a message.
    pub(super) fn send(&self, message: Arc<str>) {
        let mut queue = self.lock();
        queue.lost |= queue.messages.len() >= WAITING;
        if !queue.lost {
            queue.messages.push_back(message);
        }
        drop(queue);
        self.wake.notify_one();
    }

    /// Sends an answer, in place of one that still waits.
    pub(super) fn answer(&self, answer: Arc<Answer>) {
        self.lock().answer = Some(answer);
        self.wake.notify_one();
    }

    /// Sends an answer that it had, unless a newer one waits.
    pub(super) fn answer_again(&self, answer: Arc<Answer>) {
        self.lock().answer.get_or_insert(answer);
        self.wake.notify_one();
    }

    /// Sends a map, in place of one that still waits.
    pub(super) fn map(&self, map: Arc<str>) {
        self.lock().map.waiting = Some(map);
        self.wake.notify_one();
    }

    /// Sends the answer to a question, in place of one that still waits.
    pub(super) fn question(&self, answer: Arc<str>) {
        self.lock().question.waiting = Some(answer);
        self.wake.notify_one();
    }

    /// What was sent last was taken up.
    pub(super) fn acknowledge(&self, taken: WindowInput) {
        let mut queue = self.lock();
        match taken {
            WindowInput::Answer => queue.showing = false,
            WindowInput::Map => queue.map.showing = false,
            WindowInput::Question => queue.question.showing = false,
        }
        drop(queue);
        self.wake.notify_one();
    }

    /// It sees these charts; true: some of them it did not see before.
    pub(super) fn set_visible_charts(&self, charts: BTreeSet<usize>) -> bool {
        let sight = &mut self.lock().had.sight;
        let new = sight
            .as_ref()
            .is_some_and(|before| !charts.is_subset(before));
        *sight = Some(charts);
        new
    }

    /// Another document: nothing of the one before is there.
    pub(super) fn forget_document(&self) {
        let mut queue = self.lock();
        *queue = Queue {
            messages: std::mem::take(&mut queue.messages),
            ..Queue::default()
        };
    }

    /// What is to be sent now; `Err`: the window does not listen any more.
    pub(super) fn next_message(&self) -> Result<Option<Sent>, ()> {
        let mut queue = self.lock();
        if queue.lost {
            return Err(());
        }
        if let Some(message) = queue.messages.pop_front() {
            return Ok(Some(Sent::Text(message)));
        }
        if !queue.showing
            && let Some(answer) = queue.answer.take()
        {
            let frame = queue.had.next_frame(&answer);
            queue.showing = true;
            return Ok(Some(Sent::Binary(frame)));
        }
        let text = queue.map.take().or_else(|| queue.question.take());
        Ok(text.map(Sent::Text))
    }
}
