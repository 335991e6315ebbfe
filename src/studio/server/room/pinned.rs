//! What windows see besides the run: pinned runs, kept from the end of the program; those of an
//! earlier one are worked out again.

use super::Room;
use super::desks::AnswerCache;
use crate::ask::ModelAssessment;
use crate::studies::run::RunResult;
use crate::studio::answer::TextRequest;
use crate::studio::pins::Source;
use crate::studio::view::{View, with_closeups};
use serde_json::json;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, PoisonError};

/// What became of a run that is worked out again.
enum Again {
    /// It is there.
    Run(Arc<RunResult>),
    /// It was ended, since something newer waits.
    Ended,
    /// It cannot be, or would be another: the scene's objects are others, or the program is.
    Other,
}

impl Room {
    /// A window keeps the present run beside those that come.
    pub(in crate::studio::server) fn keep_run(
        &self,
        window: u64,
        name: &str,
    ) -> Result<(), String> {
        let mut state = self.lock();
        let run = state.run.clone().ok_or("there is no run to be pinned")?;
        state.change_view(window, |view| view.keep_run(name, &run))?;
        self.request_more_of_run(&state);
        Ok(())
    }

    /// Writes what was pinned last: kept from the end of the program.
    pub(in crate::studio::server) fn keep_pins(&self) {
        let pins = self.pins.lock().unwrap_or_else(PoisonError::into_inner);
        let kept = self.lock().pins.clone();
        // Where nothing can be kept the runs are pinned as long as the program lasts.
        let _ = pins.write_pins(&self.path, &kept);
    }

    /// A window wants to see something else.
    pub(in crate::studio::server) fn change_view(
        &self,
        window: u64,
        change: impl FnOnce(&mut View),
    ) {
        let mut state = self.lock();
        let plain = state.change_view(window, |view| {
            change(view);
            view.is_plain()
        });
        if plain {
            state.views.remove(&window);
            state.answers.remove(&window);
            if let (Some(window), Some(answer)) = (state.windows.get(&window), &state.answer) {
                window.answer(answer.clone());
            }
            return;
        }
        self.request_more_of_run(&state);
    }

    /// Works out all that windows wait for, as long as nothing newer comes.
    pub(super) fn work_out_pins(&self, stop: &AtomicBool, kept: &mut AnswerCache) {
        let mut any = false;
        while let Some(source) = self.waiting_pin() {
            if let Some(runs) = self.runs.get() {
                runs.interrupt_for_newer();
            }
            match self.run_again(&source, stop) {
                Again::Run(result) => self.worked_out(&source, Some(&result)),
                Again::Other => self.worked_out(&source, None),
                Again::Ended => break,
            }
            any = true;
        }
        if any {
            self.send_views(kept);
        }
    }

    fn waiting_pin(&self) -> Option<Arc<Source>> {
        let state = self.lock();
        state.views.values().find_map(View::waiting_run).cloned()
    }

    fn run_again(&self, source: &Source, stop: &AtomicBool) -> Again {
        let asked = TextRequest {
            version: 0,
            name: &self.name,
            text: &source.text,
            catalogue: &self.shelf,
        };
        let reading = asked.check().reading;
        let Some(reading) = reading.filter(|reading| reading.scene.hash == source.hash) else {
            return Again::Other;
        };
        let judging = match source.judged {
            true => ModelAssessment::Asked,
            false => ModelAssessment::Never,
        };
        match asked.run(reading, judging, stop) {
            Ok(Some(ran)) => Again::Run(with_closeups(&ran.run.result)),
            Ok(None) if !self.exhausted.swap(false, Ordering::Relaxed) => Again::Ended,
            _ => Again::Other,
        }
    }

    fn worked_out(&self, source: &Source, result: Option<&Arc<RunResult>>) {
        let mut state = self.lock();
        let state = &mut *state;
        for (id, view) in &mut state.views {
            let gone = view.worked_out(source, result);
            let Some(window) = state.windows.get(id) else {
                continue;
            };
            for name in gone {
                let words = format!(
                    "the pinned run `{name}` cannot be worked out again: the scene that it was made of is another now"
                );
                let told = json!({ "type": "error", "message": words });
                window.send(told.to_string().into());
            }
        }
    }
}
