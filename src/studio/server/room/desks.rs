//! What a document asks of its desks, and what these tell its windows.

use super::{MapQuestion, Room, RunQuestion};
use crate::ask::ModelAssessment;
use crate::frontend::diagnostics::Diagnostics;
use crate::frontend::scene::{Document, Reading};
use crate::report::live::Charts;
use crate::studio::answer::{self, Ran, TextRequest};
use crate::studio::chart::{ChartProgress, Task};
use crate::studio::limits::QUICK;
use crate::studio::server::folder::Shelf;
use crate::studio::server::inquiry::Inquiry;
use crate::studio::server::limits::{PACE, REST};
use crate::studio::server::state::State;
use crate::studio::server::window::Window;
use crate::studio::server::work::Desk;
use crate::studio::view::View;
use serde_json::json;
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Weak};
use std::time::Instant;

/// What of an answer the next one can use.
#[derive(Debug, Default)]
pub(super) struct AnswerCache {
    charts: Charts,
    /// The charts of windows that see more.
    own: BTreeMap<u64, Charts>,
    /// The last run, and the version that was worked on to its end.
    ran: Option<Ran>,
    done: Option<u64>,
    /// It came quickly: the next is told before faults and numbers are.
    quick: bool,
}

impl Room {
    pub(super) fn request_run(&self, state: &State) {
        self.submit_run(state, false);
    }

    /// Somebody wants to see more of the run.
    pub(super) fn request_more_of_run(&self, state: &State) {
        self.submit_run(state, true);
    }

    pub(super) fn submit_run(&self, state: &State, again: bool) {
        if let Some(runs) = self.runs.get() {
            runs.submit(RunQuestion {
                version: state.text.version(),
                text: state.text.text().to_owned(),
                again,
            });
        }
    }

    pub(super) fn submit_map(&self, state: &State) {
        let windows = state.asked.iter();
        let asked =
            windows.filter_map(|(id, asked)| Some((state.windows.get(id)?.clone(), asked.clone())));
        if let Some(maps) = self.maps.get() {
            maps.submit(MapQuestion {
                version: state.text.version(),
                text: state.text.text().to_owned(),
                asked: asked.collect(),
            });
        }
    }

    pub(super) fn submit_questions(&self, state: &State) {
        let asked = state.questions.iter();
        let asked =
            asked.filter_map(|(id, asked)| Some((state.windows.get(id)?.clone(), asked.clone())));
        if let Some(questions) = self.questions.get() {
            questions.submit(Inquiry {
                version: state.text.version(),
                text: state.text.text().to_owned(),
                asked: asked.collect(),
            });
        }
    }

    /// Answers a version, on a thread of its own.
    pub(super) fn answer_version(
        &self,
        question: &RunQuestion,
        stop: &AtomicBool,
        kept: &mut AnswerCache,
    ) {
        let asked = TextRequest {
            version: question.version,
            name: &self.name,
            text: &question.text,
            catalogue: &self.shelf,
        };
        if question.again {
            self.send_views(kept);
        }
        if !question.again || kept.done != Some(question.version) {
            self.work_on(&asked, stop, kept);
            if !stop.load(Ordering::Relaxed) {
                kept.done = Some(question.version);
            }
        }
        self.work_out_pins(stop, kept);
    }

    fn work_on(&self, asked: &TextRequest<'_, Shelf>, stop: &AtomicBool, kept: &mut AnswerCache) {
        let begun = Instant::now();
        let mut checked = asked.check();
        let Some(reading) = checked.reading.take() else {
            self.broadcast_checked(asked.checked_message(&checked));
            return;
        };
        let judged = answer::is_judged(&reading.scene);
        let first = kept.quick && !judged;
        if !first {
            self.broadcast_checked(asked.checked_message(&checked));
        }
        {
            let state = self.lock();
            if !state.asked.is_empty() {
                self.submit_map(&state);
            }
            if !state.questions.is_empty() {
                self.submit_questions(&state);
            }
        }
        let right = self.run(asked, reading, judged, stop, kept);
        kept.quick = begun.elapsed() < QUICK;
        if first && right {
            self.broadcast_checked(asked.checked_message(&checked));
        }
    }

    /// Runs a scene and tells the answer; false: it has faults, which were told.
    fn run(
        &self,
        asked: &TextRequest<'_, Shelf>,
        mut reading: Reading,
        judged: bool,
        stop: &AtomicBool,
        kept: &mut AnswerCache,
    ) -> bool {
        for judging in [ModelAssessment::Never, ModelAssessment::Asked] {
            let last = !judged || matches!(judging, ModelAssessment::Asked);
            match asked.run(reading, judging, stop) {
                Err(faults) => {
                    self.faults_message(asked, &faults);
                    return false;
                }
                Ok(_) if self.exhausted.swap(false, Ordering::Relaxed) => {
                    self.broadcast_failure(
                        asked.version,
                        "the run took too much memory and was ended",
                    );
                    return true;
                }
                // Something newer has come.
                Ok(None) => return true,
                Ok(Some(ran)) => self.broadcast_run(ran, kept),
            }
            if last {
                return true;
            }
            match asked.check().reading {
                Some(again) => reading = again,
                None => return true,
            }
        }
        true
    }

    fn faults_message(&self, asked: &TextRequest<'_, Shelf>, faults: &Diagnostics) {
        let document = Document::parse(asked.name, asked.text.as_bytes()).ok();
        self.broadcast_checked(asked.message(document.as_ref(), faults));
    }

    fn broadcast_checked(&self, message: String) {
        let message: Arc<str> = message.into();
        let mut state = self.lock();
        state.broadcast(&message);
        state.checked = Some(message);
    }

    fn broadcast_run(&self, ran: Ran, kept: &mut AnswerCache) {
        let (answer, charts) = ran.answer(&View::default(), &kept.charts);
        let answer = Arc::new(answer);
        kept.charts = charts;
        {
            let mut state = self.lock();
            let all = state.windows.iter();
            for (_, window) in all.filter(|(id, _)| !state.views.contains_key(id)) {
                window.answer(answer.clone());
            }
            state.answer = Some(answer);
            state.run = Some(ran.run.clone());
        }
        kept.ran = Some(ran);
        self.send_views(kept);
    }

    /// Tells the windows that see more than the run.
    pub(super) fn send_views(&self, kept: &mut AnswerCache) {
        let views = self.lock().views.clone();
        kept.own.retain(|window, _| views.contains_key(window));
        let Some(ran) = &kept.ran else {
            return;
        };
        for (id, view) in views {
            let before = kept.own.entry(id).or_default();
            let (answer, charts) = ran.answer(&view, before);
            let answer = Arc::new(answer);
            *before = charts;
            let mut state = self.lock();
            // It may have gone, or want nothing of it any more.
            if state.views.contains_key(&id)
                && let Some(window) = state.windows.get(&id)
            {
                window.answer(answer.clone());
                state.answers.insert(id, answer);
            }
        }
    }

    fn broadcast_failure(&self, version: u64, words: &str) {
        let message = json!({ "type": "failed", "version": version, "message": words });
        self.lock().broadcast(&message.to_string().into());
    }

    /// Makes the maps of a version, on a thread of its own; those that are the same are left.
    pub(super) fn chart(
        &self,
        question: &MapQuestion,
        stop: &AtomicBool,
        known: &mut BTreeMap<u64, String>,
    ) {
        let begun = Instant::now();
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
            } else {
                // Something newer waits.
                std::thread::sleep(PACE.saturating_sub(begun.elapsed()));
            }
        }
    }
}

const FAILED: &str = "the computation failed; this is an error of the program, not of the scene";

pub(super) fn failed_question(room: &Weak<Room>) {
    if let Some(room) = room.upgrade() {
        let state = room.lock();
        let message = json!({
            "type": "question",
            "version": state.text.version(),
            "refused": FAILED,
        });
        let message: Arc<str> = message.to_string().into();
        let asking = state.questions.keys();
        for window in asking.filter_map(|id| state.windows.get(id)) {
            window.question(message.clone());
        }
    }
}

pub(super) fn failed(room: &Weak<Room>) {
    if let Some(room) = room.upgrade() {
        let version = room.lock().text.version();
        room.broadcast_failure(version, FAILED);
    }
}

/// Tells a window of its map.
struct Teller<'a> {
    window: &'a Arc<Window>,
    desk: &'a Desk<MapQuestion>,
}

impl ChartProgress for Teller<'_> {
    fn map(&self, message: String) -> bool {
        self.window.map(message.into());
        // From the coarse one on nothing keeps a newer one waiting.
        self.desk.interrupt_for_newer();
        // While a number moves the coarse map is all that is seen of it, and the rest of the
        // processor is the browser's.
        !self.desk.rest(REST)
    }

    fn progress(&self, done: usize, of: usize) {
        let message = json!({ "type": "map_progress", "done": done, "of": of });
        self.window.send(message.to_string().into());
    }
}
