//! The questions of windows, answered anew as the text changes: the newest version wins.
//!
//! They have a desk of their own, under the limits of runs.

use super::folder::Shelf;
use super::window::Window;
use crate::frontend::scene::{BuiltIn, Document, LayeredCatalogue, Overrides};
use crate::studio::commands::{CommandScene, Commands, Question};
use crate::studio::limits::ANSWER;
use serde_json::{Value, json};
use std::cell::Cell;
use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// Questions about a version.
#[derive(Debug)]
pub(super) struct Inquiry {
    pub(super) version: u64,
    pub(super) text: String,
    pub(super) asked: Vec<(Arc<Window>, Question)>,
}

/// Who answers them, on a thread of its own.
#[derive(Debug)]
pub(super) struct Inquirer {
    commands: &'static dyn Commands,
    shelf: Shelf,
    /// Raised where memory ran out.
    exhausted: Arc<AtomicBool>,
    /// What windows were told last.
    known: BTreeMap<u64, WindowState>,
}

/// What a window was told.
#[derive(Debug)]
struct WindowState {
    /// Of which scene; `None`: of a text that was none.
    hash: Option<String>,
    question: Question,
    version: u64,
    /// As it was written.
    found: String,
}

/// What was found of a version, as a message; `found`: members of a JSON object, written.
fn message(version: u64, question: &Question, found: &str) -> String {
    let asked = json!({ "command": question.command, "options": question.options });
    let members = found.trim_start_matches('{');
    format!("{{\"type\":\"question\",\"version\":{version},\"question\":{asked},{members}")
}

/// How often progress is told.
const OFTEN: Duration = Duration::from_millis(100);

impl Inquirer {
    pub(super) fn new(
        commands: &'static dyn Commands,
        shelf: Shelf,
        exhausted: Arc<AtomicBool>,
    ) -> Self {
        Self {
            commands,
            shelf,
            exhausted,
            known: BTreeMap::new(),
        }
    }

    /// Answers all of them; what was found of the same scene is told again.
    pub(super) fn answer_inquiry(&mut self, name: &str, inquiry: &Inquiry, stop: &AtomicBool) {
        let Inquiry {
            version,
            text,
            asked,
        } = inquiry;
        self.known
            .retain(|id, _| asked.iter().any(|(window, _)| window.id == *id));
        let hash = self.hash(name, text);
        for (window, question) in asked {
            let known = self.known.get_mut(&window.id);
            let known = known.filter(|known| known.hash == hash && known.question == *question);
            if let Some(known) = known.filter(|_| hash.is_some()) {
                // It was told of this version, and may be on its way still.
                if known.version != *version {
                    known.version = *version;
                    window.question(message(*version, question, &known.found).into());
                }
                continue;
            }
            self.known.remove(&window.id);
            let found = self.answer((name, text), window, question, stop);
            let large = self.exhausted.swap(false, Ordering::Relaxed);
            if stop.load(Ordering::Relaxed) && !large {
                // Something newer has come.
                return;
            }
            let refused = |words: &str| json!({ "refused": words }).to_string();
            let found = match found {
                _ if large => refused("it took too much memory and was ended"),
                Err(words) => refused(&words),
                Ok(found) => found.to_string(),
            };
            let told = message(*version, question, &found);
            if told.len() > ANSWER {
                let words = "the answer is too large to be shown: ask for less of it";
                window.question(message(*version, question, &refused(words)).into());
                continue;
            }
            window.question(told.into());
            self.known.insert(
                window.id,
                WindowState {
                    hash: hash.clone(),
                    question: question.clone(),
                    version: *version,
                    found,
                },
            );
        }
    }

    fn answer(
        &self,
        scene: (&str, &str),
        window: &Window,
        question: &Question,
        stop: &AtomicBool,
    ) -> Result<Value, String> {
        let last = Cell::new(None::<Instant>);
        let tell = |done: usize, of: usize, now: &str| {
            if last.get().is_some_and(|last| last.elapsed() < OFTEN) {
                return;
            }
            last.set(Some(Instant::now()));
            let message =
                json!({ "type": "question_progress", "done": done, "of": of, "now": now });
            window.send(message.to_string().into());
        };
        let asked = CommandScene {
            tell: &tell,
            ..CommandScene::new(scene, &self.shelf, stop)
        };
        self.commands.answer(question, &asked)
    }

    /// Tells scenes apart, whatever their texts look like; `None`: it is none.
    fn hash(&self, name: &str, text: &str) -> Option<String> {
        let document = Document::parse(name, text.as_bytes()).ok()?;
        let catalogue = LayeredCatalogue(&self.shelf, &BuiltIn);
        let reading = document.scene(&catalogue, &Overrides::none()).ok()?;
        Some(reading.scene.hash)
    }
}
