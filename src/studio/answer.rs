//! From a text to its answer: faults with their places, the numbers that can be moved, and the
//! run as it is shown.
//!
//! Sliders and maps change the text in the window, at the numbers that `Document::numbers`
//! lists with unit and bounds, and nothing else. Both follow from the declarations that read
//! the scene; so do completion and help, by `schema_of`. The graph shows `Document::outline`:
//! the objects of a text, however faulty, with their ports. Faults are shown at objects and
//! fields by their addresses.

use super::limits::{MASSES, ROWS, RUN, SAMPLES};
use super::pins::Source;
use super::units::Counter;
use super::view::{SourcedRun, View};
use crate::ask::{Mechanism, ModelAssessment};
use crate::budget::Budget;
use crate::dynamics::integrate::Stop;
use crate::frontend::diagnostics::{Diagnostic, Diagnostics, Severity};
use crate::frontend::scene::{
    BuiltIn, Catalogue, Document, LayeredCatalogue, Overrides, Reading, TypedScene, edit,
};
use crate::report::live::{self, Charts, property_words};
use crate::report::sentence::Sentence;
use crate::report::verdict::Sort;
use crate::studies::cam::disc_cams;
use crate::studies::expectations::{check, of_run};
use crate::studies::plausible;
use serde_json::{Value, json};
use std::collections::BTreeSet;
use std::collections::hash_map::DefaultHasher;
use std::hash::{Hash, Hasher};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// What is known of a text before it is run.
#[derive(Debug)]
pub(super) struct Checked {
    document: Option<Document>,
    /// Faults, or warnings of a scene that is right.
    faults: Diagnostics,
    /// The scene, where it is right.
    pub(super) reading: Option<Reading>,
}

/// A text that is looked at.
#[derive(Clone, Copy, Debug)]
pub(super) struct TextRequest<'a, C> {
    /// Its version.
    pub(super) version: u64,
    /// Its name.
    pub(super) name: &'a str,
    /// The text.
    pub(super) text: &'a str,
    /// What it may copy from.
    pub(super) catalogue: &'a C,
}

impl<C: Catalogue + Sync> TextRequest<'_, C> {
    /// Reads it.
    pub(super) fn check(&self) -> Checked {
        match Document::parse(self.name, self.text.as_bytes()) {
            Err(faults) => Checked {
                document: None,
                faults,
                reading: None,
            },
            Ok(document) => {
                let catalogue = LayeredCatalogue(self.catalogue, &BuiltIn);
                let (faults, reading) = match document.scene(&catalogue, &Overrides::none()) {
                    Ok(reading) => (reading.warnings.clone(), Some(reading)),
                    Err(faults) => (faults, None),
                };
                Checked {
                    document: Some(document),
                    faults,
                    reading,
                }
            }
        }
    }

    /// The message to windows: faults and numbers.
    pub(super) fn checked_message(&self, checked: &Checked) -> String {
        self.message(checked.document.as_ref(), &checked.faults)
    }

    /// Faults and numbers for the windows. Of what is no JSON no numbers are known.
    pub(super) fn message(&self, document: Option<&Document>, faults: &Diagnostics) -> String {
        let mut counter = Counter::new(self.text);
        let numbers = document.map(|document| {
            let numbers = document.numbers(&LayeredCatalogue(self.catalogue, &BuiltIn));
            let one = |number| {
                let mut value = json!(number);
                let crate::frontend::scene::Number {
                    value_at,
                    number_at,
                    ..
                } = number;
                let ends = [value_at.start, number_at.start, number_at.end, value_at.end];
                let [a, b, c, d] = ends.map(|byte| counter.units(byte));
                value["value_at"] = json!([a, d]);
                value["number_at"] = json!([b, c]);
                value["label"] = json!(property_words(&number.address));
                value
            };
            numbers.into_iter().map(one).collect::<Vec<Value>>()
        });
        let objects =
            document.map(|document| document.outline(&LayeredCatalogue(self.catalogue, &BuiltIn)));
        let faults = faults
            .items
            .iter()
            .map(|fault| self.fault(document, faults, fault));
        json!({
            "type": "checked",
            "version": self.version,
            "numbers": numbers,
            "objects": objects,
            "faults": faults.collect::<Vec<_>>(),
        })
        .to_string()
    }

    fn fault(&self, document: Option<&Document>, all: &Diagnostics, fault: &Diagnostic) -> Value {
        let place = fault.place.as_ref().filter(|place| !place.is_nowhere());
        let own = place
            .filter(|place| place.source == 0)
            .map(|place| place.range.clone());
        // What stands in a catalogue shows at the object that copies it.
        let object = || {
            let id = fault.path.split(['.', '[']).next()?;
            let place = &edit::property(document?.root(), id)?.place;
            Some(place.range.start..place.range.start + 1)
        };
        let elsewhere = place.filter(|place| place.source != 0);
        let elsewhere = elsewhere.and_then(|place| {
            let (source, at) = (all.sources.get(place.source)?, all.sources.position(place)?);
            Some(format!("{}:{}:{}", source.name, at.line, at.column))
        });
        let range = own.or_else(object).unwrap_or(0..0);
        let mut counter = Counter::new(self.text);
        json!({
            "from": counter.units(range.start),
            "to": counter.units(range.end),
            "severity": if fault.severity == Severity::Error { "error" } else { "warning" },
            "message": fault.message,
            "label": fault.label,
            "hints": fault.hints,
            "path": fault.path,
            "elsewhere": elsewhere,
        })
    }

    /// Runs it, with its model judged or as it stands; `None`: it was ended.
    pub(super) fn run(
        &self,
        reading: Reading,
        judging: ModelAssessment,
        stop: &AtomicBool,
    ) -> Result<Option<Ran>, Diagnostics> {
        let budget = Budget::interrupted_by(stop).within(RUN);
        let wrong = |error: crate::Error| error.into_diagnostics();
        let source = Source {
            text: self.text.to_owned(),
            hash: reading.scene.hash.clone(),
            judged: matches!(judging, ModelAssessment::Asked),
        };
        let mut mechanism = Mechanism::of_within(reading, judging, &budget).map_err(wrong)?;
        let settings = &mut mechanism.settings;
        if !plausible::needs_samples(mechanism.system.model()) {
            settings.samples = settings.samples.min(SAMPLES);
        }
        let masses = mechanism
            .system
            .initial_state()
            .map_or(0, |start| start.y.len());
        settings.masses &= masses <= MASSES;
        settings.closeups = false;
        let mut result = mechanism.run_within(&budget).map_err(wrong)?;
        if result.record.times.len() > ROWS && mechanism.settings.switch_rows {
            // Two rows at every switch are more than anybody sees.
            mechanism.settings.switch_rows = false;
            result = mechanism.run_within(&budget).map_err(wrong)?;
        }
        if result.outcome.stop == Stop::Interrupted {
            return Ok(None);
        }
        let coarse = matches!(judging, ModelAssessment::Never) && is_judged(mechanism.scene());
        Ok(Some(Ran {
            version: self.version,
            mechanism,
            run: SourcedRun {
                source: Arc::new(source),
                result: Arc::new(result),
            },
            coarse,
        }))
    }
}

/// The run of a version.
#[derive(Debug)]
pub(super) struct Ran {
    version: u64,
    mechanism: Mechanism,
    pub(super) run: SourcedRun,
    /// The model is still to be judged.
    coarse: bool,
}

impl Ran {
    /// The answer as a window sees it; charts `before` are taken where they differ in numbers
    /// alone.
    pub(super) fn answer(&self, view: &View, before: &Charts) -> (Answer, Charts) {
        let Self { mechanism, run, .. } = self;
        let result = &run.result;
        let model = mechanism.model();
        let cams = disc_cams(mechanism.scene(), model);
        let found = (&result.figures, &result.record);
        let shown = live::run(model, &cams, found, &view.run_extras(), before);
        let mut warnings = mechanism.warnings();
        let found = result.figures.warnings.iter();
        let new: Vec<String> = found
            .filter(|one| !warnings.contains(one))
            .cloned()
            .collect();
        warnings.extend(new);
        let expected = &mechanism.scene().expect;
        let verdicts = check(expected, result).into_iter().map(|verdict| {
            let mut told = json!(verdict);
            let is_time = verdict.what.starts_with("stops: ");
            let unit = match is_time {
                true => "s".to_owned(),
                false => result.figures.unit(&verdict.what),
            };
            told["unit"] = json!(unit);
            told
        });
        let verdicts: Vec<Value> = verdicts.collect();
        let others = expected.iter().filter(|one| !of_run(one)).count();
        let (columns, plots) = shown.charts.plots.columns_and_charts();
        let bytes = |column: &Vec<Option<f64>>| {
            let numbers = column.iter().map(|value| value.unwrap_or(f64::NAN));
            numbers.flat_map(f64::to_le_bytes).collect()
        };
        let drawn = |plot: &Value| ChartOutline {
            text: plot.to_string(),
            columns: live::columns_of(plot),
        };
        let verdict = &shown.verdict;
        let (charts, pictures) = (key(&shown.charts.likeness), key(&shown.pictures));
        let head = json!({
            "version": self.version,
            "verdict": {
                "sort": match verdict.sort {
                    Sort::Good | Sort::Recommended => "good",
                    Sort::Mechanism => "mechanism",
                    Sort::Numerical => "numerical",
                    Sort::Unfinished => "unfinished",
                },
                "headline": verdict.headline,
                "text": verdict.text,
            },
            "coarse": self.coarse,
            "title": mechanism.scene().name,
            "warnings": warnings.iter().map(|one| Sentence::read(one)).collect::<Vec<_>>(),
            "expect": verdicts,
            "expect_others": others,
            "tables": shown.tables,
            "compared": shown.compared,
            "figures": result.figures.objects,
            "moving": shown.moving,
            "signals": live::signal_names(&result.record),
            "pins": view.names(),
        });
        let answer = Answer {
            head: head.to_string(),
            charts,
            charts_html: shown.charts.html.clone(),
            pictures,
            pictures_html: shown.pictures,
            moves: shown.moves,
            plots: plots.iter().map(drawn).collect(),
            columns: columns.iter().map(bytes).collect(),
        };
        (answer, shown.charts)
    }
}

/// Whether the model of a scene is judged before it answers, which takes longer.
pub(super) fn is_judged(scene: &TypedScene) -> bool {
    scene.elastic().open_levels().next().is_some() || scene.run.accuracy.is_some()
}

fn key(text: &str) -> u64 {
    let mut hasher = DefaultHasher::new();
    text.hash(&mut hasher);
    // Zero stands for nothing.
    hasher.finish() | 1
}

/// The answer to a text, as windows show it.
#[derive(Debug)]
pub(super) struct Answer {
    /// Sentence, tables, what moves, as JSON.
    head: String,
    /// Tell the charts, and the pictures, from others.
    pub(super) charts: u64,
    pub(super) pictures: u64,
    charts_html: String,
    pictures_html: String,
    /// Columns that what moves reads.
    moves: Vec<usize>,
    plots: Vec<ChartOutline>,
    /// Columns of the charts, as bytes.
    columns: Vec<Vec<u8>>,
}

/// A chart without its numbers.
#[derive(Debug)]
struct ChartOutline {
    text: String,
    /// The columns that it shows.
    columns: Vec<usize>,
}

/// What a window has of the answer before, and what it sees.
#[derive(Debug, Default)]
pub(super) struct Had {
    /// Tell the charts and pictures that it has; zero: none.
    pub(super) charts: u64,
    pub(super) pictures: u64,
    /// The charts in sight; `None`: it has not told.
    pub(super) sight: Option<BTreeSet<usize>>,
}

impl Had {
    /// The frame of an answer that a window is sent now.
    pub(super) fn next_frame(&mut self, answer: &Answer) -> Vec<u8> {
        let frame = answer.frame(self);
        if self.charts != answer.charts {
            // Others may be in sight.
            self.sight = None;
        }
        (self.charts, self.pictures) = (answer.charts, answer.pictures);
        frame
    }
}

impl Answer {
    /// One frame: the length of the head in four bytes, the head as JSON, filled up with blanks
    /// to a multiple of eight, the numbers. Charts and pictures that the window has are left
    /// out, and so are the numbers of charts that are not in its sight: null in their places.
    pub(super) fn frame(&self, had: &Had) -> Vec<u8> {
        let mut head = self.head.clone();
        head.pop();
        for (name, other, own, html) in [
            ("charts", had.charts, self.charts, &self.charts_html),
            ("pictures", had.pictures, self.pictures, &self.pictures_html),
        ] {
            if other != own {
                head.push_str(&format!(",\"{name}\":{}", json!(html)));
            }
        }
        let sight = had.sight.as_ref().filter(|_| had.charts == self.charts);
        let seen = |chart: usize| sight.is_none_or(|sight| sight.contains(&chart));
        let plots = self.plots.iter().enumerate();
        let plots: Vec<Option<&ChartOutline>> =
            plots.map(|(k, one)| seen(k).then_some(one)).collect();
        let texts = plots
            .iter()
            .map(|one| one.map_or("null", |one| one.text.as_str()));
        let columns = plots.iter().flatten().flat_map(|one| &one.columns);
        let wanted: BTreeSet<usize> = columns.chain(&self.moves).copied().collect();
        let columns = self.columns.iter().enumerate();
        let columns = columns.map(|(k, one)| wanted.contains(&k).then_some(one));
        let columns: Vec<Option<&Vec<u8>>> = columns.collect();
        let lengths = columns
            .iter()
            .map(|one| one.map_or("null".to_owned(), |one| (one.len() / 8).to_string()));
        head.push_str(&format!(
            ",\"lengths\":[{}],\"plots\":[{}]}}",
            lengths.collect::<Vec<_>>().join(","),
            texts.collect::<Vec<_>>().join(","),
        ));
        while !(head.len() + 4).is_multiple_of(8) {
            head.push(' ');
        }
        let length = u32::try_from(head.len()).unwrap_or(u32::MAX);
        let numbers: usize = columns.iter().flatten().map(|one| one.len()).sum();
        let mut frame = Vec::with_capacity(4 + head.len() + numbers);
        frame.extend_from_slice(&length.to_le_bytes());
        frame.extend_from_slice(head.as_bytes());
        for column in columns.into_iter().flatten() {
            frame.extend_from_slice(column);
        }
        frame
    }
}
