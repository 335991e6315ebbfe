//! What a scene expects, shown beside what was found, and which command judges the rest.

use super::console;
use crate::frontend::scene::{Expectation, Expected, StudyAddress};
use crate::studies::expectations::Verdict;
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// Expectations named one by one; of more only the number is shown.
const NAMED: usize = 3;

/// The expectations of a scene with the verdicts of one command.
pub(super) struct Expectations<'a> {
    /// The command: `kinematics`.
    pub(super) command: &'static str,
    /// All that the scene expects.
    pub(super) all: &'a [Expectation],
    /// Verdicts on those that the command judges; `None`: the options ask for something else
    /// than the scene.
    pub(super) verdicts: Option<Vec<Verdict>>,
}

impl<'a> Expectations<'a> {
    /// Those of a scene, judged by a command where it answers what the scene asks.
    pub(super) fn judge_scene(
        command: &'static str,
        all: &'a [Expectation],
        as_scene: bool,
        judge: impl FnOnce(&[Expectation]) -> Vec<Verdict>,
    ) -> Self {
        Self {
            command,
            all,
            verdicts: as_scene.then(|| judge(all)),
        }
    }

    /// The verdicts; none where nothing was judged.
    pub(super) fn verdicts(&self) -> &[Verdict] {
        self.verdicts.as_deref().unwrap_or_default()
    }

    /// Adds the verdicts to a document, where there are any.
    pub(super) fn add_verdicts(&self, mut document: Value) -> Value {
        if !self.verdicts().is_empty() {
            document["expect"] = json!(self.verdicts());
        }
        document
    }

    /// True when every expectation holds that was judged.
    pub(super) fn all_hold(&self) -> bool {
        self.verdicts().iter().all(|verdict| verdict.holds)
    }

    /// Says how many hold, which do not, and which another command judges.
    pub(super) fn print_verdicts(&self) {
        for verdict in self.verdicts().iter().filter(|verdict| !verdict.holds) {
            console::print_message(&format!("expectation failed: {}", verdict.message));
        }
        let judged = self.verdicts().len();
        if judged > 0 {
            let held = self.verdicts().iter().filter(|verdict| verdict.holds);
            console::print_message(&format!("expectations: {} of {judged} hold", held.count()));
        }
        for line in self.unjudged_requirements() {
            console::print_message(&line);
        }
    }

    /// What was not judged, and which command does.
    fn unjudged_requirements(&self) -> Vec<String> {
        if self.verdicts.is_none() {
            let own = (self.all.iter()).any(|one| judges(one).contains(&self.command));
            let line = "expectations: not judged, the options change the scene's data";
            return own.then(|| line.to_owned()).into_iter().collect();
        }
        let mut others: BTreeMap<String, Vec<&str>> = BTreeMap::new();
        for one in self.all {
            let what = subject(one);
            if self.verdicts().iter().all(|verdict| verdict.what != what) {
                let command = self.judging_command(one);
                let list = others.entry(command).or_default();
                list.push(match &one.what {
                    Expected::Figure { figure, .. } => figure,
                    Expected::Stops { .. } => "stops",
                });
            }
        }
        let line = |(command, figures): (String, Vec<&str>)| {
            let named = figures[..figures.len().min(NAMED)].join(", ");
            let more = match figures.len().saturating_sub(NAMED) {
                0 => String::new(),
                more => format!(" and {more} more"),
            };
            format!("expectations not judged here: {named}{more}; `{command}` judges them")
        };
        others.into_iter().map(line).collect()
    }

    /// The command that judges an expectation in place of this one.
    fn judging_command(&self, expectation: &Expectation) -> String {
        let command = judges(expectation)[0];
        match object(expectation) {
            Some(object) if command == self.command => format!("dam {command} --object {object}"),
            _ => format!("dam {command}"),
        }
    }
}

/// Subject of an expectation, as verdicts name it.
fn subject(expectation: &Expectation) -> String {
    match &expectation.what {
        Expected::Figure { figure, .. } => figure.clone(),
        Expected::Stops { reason, .. } => format!("stops: {reason}"),
    }
}

fn address(expectation: &Expectation) -> Option<StudyAddress<'_>> {
    match &expectation.what {
        Expected::Figure { figure, .. } => StudyAddress::of(figure),
        Expected::Stops { .. } => None,
    }
}

/// The commands that judge an expectation.
fn judges(expectation: &Expectation) -> &'static [&'static str] {
    address(expectation).map_or(&["run"], StudyAddress::judged_by)
}

/// The object whose study an expectation is of.
fn object(expectation: &Expectation) -> Option<&str> {
    address(expectation)?.object()
}
