//! The studio in a browser tab, without a server: the same answers, of texts that the page keeps.
//!
//! The page holds the text with its edits and asks for the answers to a version of it, in the
//! messages that a window of the server has. What takes too long the page ends with the worker
//! that computes it; so a [`Tab`] holds nothing that the page could not give it again.

#[cfg(test)]
mod tests;

use super::answer::{self, Had, Ran, TextRequest};
use super::asides::{Aside, beginnings};
use super::chart::{ChartProgress, Task};
use super::commands::{CommandScene, Commands, Question};
use super::gallery;
use super::limits::{CELLS, QUICK};
use super::messages::{Beginning, MapRequest};
use super::pins::{KeptPin, Source};
use super::preview;
use super::view::{View, with_closeups};
use crate::ask::ModelAssessment;
use crate::budget::Instant;
use crate::frontend::scene::{BuiltIn, Document};
use crate::report::live::{self, Charts};
use crate::studies::run::RunResult;
use serde::Deserialize;
use serde_json::{Value, json};
use std::cell::Cell;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

/// Something that the page is told.
#[derive(Debug)]
pub enum Told {
    /// A message, as JSON.
    Text(String),
    /// An answer with its numbers.
    Answer(Vec<u8>),
}

/// A version of a scene's text.
#[derive(Debug, Deserialize)]
struct Version {
    version: u64,
    name: String,
    text: String,
}

/// What the page asks.
#[derive(Debug, Deserialize)]
#[serde(tag = "ask", rename_all = "snake_case")]
enum Request {
    /// The answer to a version, beside runs that are pinned.
    Run {
        of: Version,
        #[serde(default)]
        pins: Vec<KeptPin>,
        #[serde(default)]
        over: Option<[String; 2]>,
    },
    /// The charts in sight: the answer comes again with the numbers of those that are new in it.
    Sight { charts: BTreeSet<usize> },
    /// A map of a level of cells: 0 is the coarse one.
    Map {
        of: Version,
        question: MapRequest,
        level: usize,
    },
    /// A question that a command answers.
    Question { of: Version, question: Question },
    /// What is asked besides, by its path.
    Get {
        number: u64,
        path: String,
        of: Version,
        #[serde(default)]
        query: BTreeMap<String, String>,
    },
    /// The text that a new scene begins with.
    Begin { number: u64, from: Beginning },
    /// Styles and scripts that the page stands on; asked when it is built.
    Look { number: u64 },
}

/// What one worker of a page keeps from one request to the next.
#[derive(Debug)]
pub struct Tab {
    commands: &'static dyn Commands,
    charts: Charts,
    ran: Option<Ran>,
    view: View,
    had: Had,
    /// The last answer came quickly: the next is told before faults and numbers are.
    quick: bool,
    /// Runs that are pinned.
    known: Vec<(Source, Arc<RunResult>)>,
}

/// Nobody ends a computation from within: the page ends the worker.
static GOES_ON: AtomicBool = AtomicBool::new(false);

impl Tab {
    /// One that knows nothing as yet; `commands` answer what is asked besides the run.
    pub(crate) fn new(commands: &'static dyn Commands) -> Self {
        Self {
            commands,
            charts: Charts::default(),
            ran: None,
            view: View::default(),
            had: Had::default(),
            quick: false,
            known: Vec::new(),
        }
    }

    /// Answers a request; `tell` is given what the page is to know, as it is found.
    ///
    /// # Errors
    /// This is no request.
    pub fn ask(&mut self, request: &str, tell: &(dyn Fn(Told) + Sync)) -> Result<(), String> {
        let request = serde_json::from_str(request).map_err(|error| error.to_string())?;
        match request {
            Request::Run { of, pins, over } => self.run(&of, &pins, over, tell),
            Request::Sight { charts } => self.sight(charts, tell),
            Request::Map {
                of,
                question,
                level,
            } => map(&of, (&question, level), tell),
            Request::Question { of, question } => self.question(&of, &question, tell),
            Request::Get {
                number,
                path,
                of,
                query,
            } => reply(number, self.get(&path, &of, &query), tell),
            Request::Look { number } => reply(number, Ok(page_styles_and_scripts()), tell),
            Request::Begin { number, from } => {
                reply(number, gallery::beginning(&from).map(Value::from), tell);
            }
        }
        Ok(())
    }

    fn run(
        &mut self,
        of: &Version,
        pins: &[KeptPin],
        over: Option<[String; 2]>,
        tell: &dyn Fn(Told),
    ) {
        let begun = Instant::now();
        let asked = of.request();
        let checked = asked.check();
        let message = asked.checked_message(&checked);
        let Some(scene) = checked.reading.as_ref().map(|reading| &reading.scene) else {
            return tell(Told::Text(message));
        };
        let is_judged = answer::is_judged(scene);
        let is_first = self.quick && !is_judged;
        if !is_first {
            tell(Told::Text(message.clone()));
        }
        self.set_page_view(pins, over);
        let judged = [ModelAssessment::Asked].into_iter().filter(|_| is_judged);
        for judging in [ModelAssessment::Never].into_iter().chain(judged) {
            match answer_request(&asked, judging) {
                Err(faults) => return tell(Told::Text(faults)),
                Ok(ran) => self.tell_run(ran, tell),
            }
        }
        self.quick = begun.elapsed() < QUICK;
        if is_first {
            tell(Told::Text(message));
        }
        self.work_out_pins(tell);
    }

    fn tell_run(&mut self, ran: Option<Ran>, tell: &dyn Fn(Told)) {
        let Some(ran) = ran else { return };
        // What a pin of this run is worked out from.
        let Source { hash, judged, .. } = &*ran.run.source;
        let source = json!({ "type": "source", "hash": hash, "judged": judged });
        tell(Told::Text(source.to_string()));
        self.ran = Some(ran);
        self.tell_answer(tell);
    }

    fn tell_answer(&mut self, tell: &dyn Fn(Told)) {
        let Some(ran) = &self.ran else { return };
        let (answer, charts) = ran.answer(&self.view, &self.charts);
        self.charts = charts;
        tell(Told::Answer(self.had.next_frame(&answer)));
    }

    /// The page sees these charts.
    fn sight(&mut self, charts: BTreeSet<usize>, tell: &dyn Fn(Told)) {
        let before = self.had.sight.replace(charts);
        let now = self.had.sight.as_ref();
        let has_more = now
            .zip(before)
            .is_some_and(|(now, before)| !now.is_subset(&before));
        if has_more {
            self.tell_answer(tell);
        }
    }

    /// What the page sees besides the run.
    fn set_page_view(&mut self, pins: &[KeptPin], over: Option<[String; 2]>) {
        let is_pinned = |source: &Source| pins.iter().any(|pin| pin.source == *source);
        if let Some(ran) = &self.ran
            && is_pinned(&ran.run.source)
        {
            self.store_result((*ran.run.source).clone(), with_closeups(&ran.run.result));
        }
        self.known.retain(|(source, _)| is_pinned(source));
        self.view = View::from_records(pins);
        self.view.over = over;
        for (source, result) in &self.known {
            self.view.worked_out(source, Some(result));
        }
    }

    fn store_result(&mut self, source: Source, result: Arc<RunResult>) {
        if self.known.iter().all(|(known, _)| *known != source) {
            self.known.push((source, result));
        }
    }

    /// Works out the pinned runs that another worker had.
    fn work_out_pins(&mut self, tell: &dyn Fn(Told)) {
        let mut any = false;
        while let Some(source) = self.view.waiting_run().cloned() {
            let result = run_again(&source);
            for name in self.view.worked_out(&source, result.as_ref()) {
                let message = format!(
                    "the pinned run `{name}` cannot be worked out again: the scene that it was made of is another now"
                );
                tell(Told::Text(
                    json!({ "type": "error", "message": message }).to_string(),
                ));
            }
            if let Some(result) = result {
                self.store_result((*source).clone(), result);
            }
            any = true;
        }
        if any {
            self.tell_answer(tell);
        }
    }

    fn question(&self, of: &Version, question: &Question, tell: &dyn Fn(Told)) {
        let last = Cell::new(None::<Instant>);
        let progress = |done: usize, of: usize, now: &str| {
            if last.get().is_some_and(|last| last.elapsed() < OFTEN) {
                return;
            }
            last.set(Some(Instant::now()));
            let message =
                json!({ "type": "question_progress", "done": done, "of": of, "now": now });
            tell(Told::Text(message.to_string()));
        };
        let asked = CommandScene {
            tell: &progress,
            ..CommandScene::new((&of.name, &of.text), &BuiltIn, &GOES_ON)
        };
        let found = self.commands.answer(question, &asked);
        let mut message = found.unwrap_or_else(|words| json!({ "refused": words }));
        message["type"] = "question".into();
        message["version"] = of.version.into();
        message["question"] = json!({ "command": question.command, "options": question.options });
        tell(Told::Text(message.to_string()));
    }

    /// What is asked besides, as the server answers it at the same path.
    fn get(
        &self,
        path: &str,
        of: &Version,
        query: &BTreeMap<String, String>,
    ) -> Result<Value, String> {
        let aside = Aside {
            version: of.version,
            name: &of.name,
            text: &of.text,
            catalogue: &BuiltIn,
        };
        let asked = CommandScene::new((&of.name, &of.text), &BuiltIn, &GOES_ON);
        Ok(match path {
            "/api/first" => beginnings(),
            "/api/schema" => aside.schema(),
            "/api/parts" => aside.available_parts(),
            "/api/model" => json!(aside.model()),
            "/api/linkages" => json!(aside.linkages(query.get("at").map(String::as_str))),
            "/api/motion" => aside.motion(query.get("object").map_or("", String::as_str)),
            "/api/preview" => {
                let from = query.get("from");
                let from = from.and_then(|text| serde_json::from_str::<Beginning>(text).ok());
                preview::preview(&from.ok_or("this is no scene to begin with")?)?
            }
            "/api/figures" => json!(aside.figures()),
            "/api/text" => of.text.clone().into(),
            "/api/questions" => {
                let mut forms = self.commands.forms(&asked);
                forms["version"] = of.version.into();
                forms
            }
            "/api/file" => {
                let [question, name] = ["question", "name"].map(|key| query.get(key));
                let question =
                    question.and_then(|text| serde_json::from_str::<Question>(text).ok());
                let (Some(question), Some(name)) = (question, name) else {
                    return Err("this is no question".to_owned());
                };
                let file = self.commands.file(&question, &asked, name)?;
                file.ok_or("there is no such file")?.into()
            }
            _ => return Err("there is no such page".to_owned()),
        })
    }
}

impl Version {
    fn request(&self) -> TextRequest<'_, BuiltIn> {
        TextRequest {
            version: self.version,
            name: &self.name,
            text: &self.text,
            catalogue: &BuiltIn,
        }
    }
}

/// Runs a scene; the message with its faults where it cannot be.
fn answer_request(
    asked: &TextRequest<'_, BuiltIn>,
    judging: ModelAssessment,
) -> Result<Option<Ran>, String> {
    let Some(reading) = asked.check().reading else {
        return Ok(None);
    };
    asked.run(reading, judging, &GOES_ON).map_err(|faults| {
        let document = Document::parse(asked.name, asked.text.as_bytes()).ok();
        asked.message(document.as_ref(), &faults)
    })
}

fn run_again(source: &Source) -> Option<Arc<RunResult>> {
    let asked = TextRequest {
        version: 0,
        name: "pinned",
        text: &source.text,
        catalogue: &BuiltIn,
    };
    let reading = asked.check().reading?;
    let judging = match source.judged {
        true => ModelAssessment::Asked,
        false => ModelAssessment::Never,
    };
    let is_same = reading.scene.hash == source.hash;
    let ran = asked
        .run(reading, judging, &GOES_ON)
        .ok()
        .filter(|_| is_same)?;
    Some(with_closeups(&ran?.run.result))
}

/// Tells the page of its map.
struct MapTeller<'a>(&'a (dyn Fn(Told) + Sync));

impl ChartProgress for MapTeller<'_> {
    fn map(&self, message: String) -> bool {
        (self.0)(Told::Text(message));
        true
    }

    fn progress(&self, done: usize, of: usize) {
        let message = json!({ "type": "map_progress", "done": done, "of": of });
        (self.0)(Told::Text(message.to_string()));
    }
}

fn map(of: &Version, (question, level): (&MapRequest, usize), tell: &(dyn Fn(Told) + Sync)) {
    let task = Task {
        version: of.version,
        name: &of.name,
        text: &of.text,
        catalogue: &BuiltIn,
        asked: question,
    };
    let levels = CELLS.get(level..=level).unwrap_or_default();
    task.make_levels(levels, &GOES_ON, &MapTeller(tell));
}

/// How often progress is told.
const OFTEN: Duration = Duration::from_millis(100);

fn reply(number: u64, found: Result<Value, String>, tell: &dyn Fn(Told)) {
    let message = match found {
        Ok(value) => json!({ "type": "reply", "number": number, "value": value }),
        Err(words) => json!({ "type": "reply", "number": number, "error": words }),
    };
    tell(Told::Text(message.to_string()));
}

/// Styles and scripts of the pages, which the studio's interface stands on.
fn page_styles_and_scripts() -> Value {
    json!({
        "look.css": live::style(),
        "plot.js": live::PLOT_SCRIPT,
        "player.js": live::PLAYER_SCRIPT,
    })
}
