//! A scene at values of its parameters: its trees, its end.

use crate::dynamics::model::UNTIL;
use crate::dynamics::system::System;
use crate::exact::sensitivity::{LawTable, flat_numbers, have_one_form};
use crate::exact::{ExactRun, Law, Request, TreeProblem};
use crate::fault::Fault;
use crate::studies::exact::exact_parts;
use crate::studies::{Control, RunSettings};

/// A scene made ready at values of its parameters.
#[derive(Debug)]
pub struct Place {
    /// Its equations of motion.
    pub system: System,
    /// Settings of its run.
    pub settings: RunSettings,
}

/// The trees of a scene.
#[derive(Clone, Debug)]
pub(super) struct Lowered {
    pub(super) trees: Vec<Tree>,
    /// End of the run (s).
    pub(super) end: f64,
}

#[derive(Clone, Debug)]
pub(super) struct Tree {
    pub(super) problem: TreeProblem,
    /// Its law, where that is known in pieces alone.
    pub(super) table: Option<LawTable>,
    /// Ids of its objects.
    pub(super) objects: Vec<String>,
    /// Its numbers with their sizes, and where they begin among those of all trees.
    pub(super) numbers: Vec<[f64; 2]>,
    pub(super) first: usize,
}

fn refused(object: &str, why: &str) -> Vec<Fault> {
    let what = match object {
        "" => format!("there are no derivatives of this scene: {why}"),
        id => format!("there are no derivatives of this scene: `{id}`: {why}"),
    };
    vec![Fault::new(object, what, "compare runs with `dam compare`")]
}

impl Lowered {
    /// The trees of a scene; laws in pieces are cut as those of another.
    ///
    /// # Errors
    /// What of the scene is of a kind that has no derivatives here.
    pub(super) fn of(place: &Place, like: Option<&Self>) -> Result<Self, Vec<Fault>> {
        let system = &place.system;
        let model = system.model();
        if model.conditions.iter().any(|one| one.name == UNTIL) {
            return Err(refused("", "`run.until` ends its run at a time of its own"));
        }
        let parts = exact_parts(system).map_err(|faults| {
            let told = |fault: Fault| {
                let message = fault.message.replace("`exact` cannot be used: ", "");
                Fault::new(
                    "",
                    format!("there are no derivatives of this scene: {message}"),
                    "compare runs with `dam compare`",
                )
            };
            faults.into_iter().map(told).collect::<Vec<_>>()
        })?;
        let initial = system.initial_place()?;
        let (mut trees, mut first): (Vec<Tree>, usize) = (Vec::new(), 0);
        for part in &parts.trees {
            let problem = part.tree(&initial.y).problem().clone();
            let ids = part
                .objects
                .iter()
                .map(|&object| model.objects[object].id.clone());
            let objects: Vec<String> = ids.collect();
            let law = &part.problem().law;
            let known = like.map(|like| like.trees.get(trees.len()));
            let known = known.map(|tree| tree.and_then(|tree| tree.table.as_ref()));
            let table = match (law, known) {
                (Law::Harmonic { .. }, _) => None,
                (Law::Spans(_), Some(None)) => return Err(refused(&objects[0], "its law differs")),
                (Law::Spans(_), known) => {
                    let motion = parts.motion_behind(system, part.objects[0]);
                    let made = motion.ok_or_else(|| "its motion law is not known".to_owned());
                    let end = place.settings.duration;
                    let made = made.and_then(|motion| LawTable::of(&motion, end, known.flatten()));
                    Some(made.map_err(|why| refused(&objects[0], &why))?)
                }
            };
            let numbers = flat_numbers(&problem, table.as_ref())
                .map_err(|why| refused(&objects[0], &why.reason))?;
            let length = numbers.len();
            trees.push(Tree {
                problem,
                table,
                objects,
                numbers,
                first,
            });
            first += length;
        }
        Ok(Self {
            trees,
            end: place.settings.duration,
        })
    }

    /// All numbers with the sizes by which they are rounded, the end of the run last.
    pub(super) fn numbers(&self) -> Vec<[f64; 2]> {
        let trees = self.trees.iter().flat_map(|tree| &tree.numbers);
        trees.copied().chain([[self.end; 2]]).collect()
    }

    /// True when another differs in numbers alone.
    pub(super) fn is_like(&self, other: &Self) -> bool {
        let alike = |(a, b): (&Tree, &Tree)| have_one_form(&a.problem, &b.problem);
        self.trees.len() == other.trees.len() && self.trees.iter().zip(&other.trees).all(alike)
    }
}

impl Tree {
    /// Its motion.
    ///
    /// # Errors
    /// Why it was not found to its end.
    pub(super) fn run(
        &self,
        end: f64,
        settings: &RunSettings,
        control: &Control<'_>,
    ) -> Result<ExactRun, String> {
        let request = Request {
            switches: settings.max_switches,
            ..Request::new(end, 0)
        };
        let tree = crate::exact::ExactTree::new(self.problem.clone());
        let run = tree.run_while(&request, &|| !control.is_spent());
        let run = run.map_err(|refusal| refusal.reason)?;
        match run.complete {
            true => Ok(run),
            false => Err("the run does not come to its end".to_owned()),
        }
    }
}
