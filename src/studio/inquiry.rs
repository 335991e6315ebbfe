//! The questions of windows, answered anew as the text changes: the newest version wins.

use super::commands::{Asked, Commands, Question};
use super::folder::Shelf;
use super::limits::ANSWER;
use super::window::Window;
use crate::frontend::scene::{BuiltIn, Document, Layered, Overrides};
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
    /// What windows were told last: of which scene, and of which question.
    known: BTreeMap<u64, (String, Question)>,
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

    /// Answers all of them; those that were answered of the same scene are left.
    pub(super) fn work(&mut self, name: &str, inquiry: &Inquiry, stop: &AtomicBool) {
        let Inquiry {
            version,
            text,
            asked,
        } = inquiry;
        self.known
            .retain(|id, _| asked.iter().any(|(window, _)| window.id == *id));
        for (window, question) in asked {
            let key = self.hash(name, text).map(|hash| (hash, question.clone()));
            let told = |mut message: Value| {
                message["type"] = json!("question");
                message["version"] = json!(version);
                message["question"] =
                    json!({ "command": question.command, "options": question.options });
                message.to_string()
            };
            if key.is_some() && self.known.get(&window.id) == key.as_ref() {
                window.question(told(json!({ "same": true })).into());
                continue;
            }
            self.known.remove(&window.id);
            let found = self.answer((name, text), window, question, stop);
            let large = self.exhausted.swap(false, Ordering::Relaxed);
            if stop.load(Ordering::Relaxed) && !large {
                // Something newer has come.
                return;
            }
            let refused = |words: &str| told(json!({ "refused": words }));
            let message = match found {
                _ if large => refused("it took too much memory and was ended"),
                Err(words) => refused(&words),
                Ok(found) => {
                    let message = told(found);
                    match message.len() > ANSWER {
                        true => refused("the answer is too large to be shown: ask for less of it"),
                        false => message,
                    }
                }
            };
            window.question(message.into());
            if let Some(key) = key {
                self.known.insert(window.id, key);
            }
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
        let asked = Asked {
            tell: &tell,
            ..Asked::new(scene, &self.shelf, stop)
        };
        self.commands.answer(question, &asked)
    }

    /// Tells scenes apart, whatever their texts look like; `None`: it is none.
    fn hash(&self, name: &str, text: &str) -> Option<String> {
        let document = Document::parse(name, text.as_bytes()).ok()?;
        let catalogue = Layered(&self.shelf, &BuiltIn);
        let reading = document.scene(&catalogue, &Overrides::none()).ok()?;
        Some(reading.scene.hash)
    }
}
