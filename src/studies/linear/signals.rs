//! Inputs and outputs of linear equations, by name.

use super::model::{LinearModel, NamedTree};
use crate::exact::LinearTree;
use nalgebra::Complex;
use serde::Serialize;

type C = Complex<f64>;

/// A named quantity.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Signal {
    /// Name: `rocker.delta`.
    pub name: String,
    /// SI unit.
    pub unit: String,
}

impl Signal {
    pub(super) fn new(name: String, unit: &str) -> Self {
        Self {
            name,
            unit: unit.to_owned(),
        }
    }
}

/// An input of the linear equations: the law of a tree or the load on an object.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct InputSignal {
    /// Name and unit.
    pub signal: Signal,
    pub(super) tree: usize,
    /// Mass on which a load acts; `None`: the law.
    pub(super) mass: Option<usize>,
}

/// An output of the linear equations: a quantity of an object.
#[derive(Clone, Debug, PartialEq)]
pub struct OutputSignal {
    /// Name and unit.
    pub signal: Signal,
    pub(super) tree: usize,
    pub(super) row: OutputRow,
}

/// An output as a sum: factors of q and q̇ of masses, and of L, L̇, L̈.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct OutputRow {
    pub(super) terms: Vec<(usize, [f64; 2])>,
    pub(super) law: [f64; 3],
}

impl OutputRow {
    /// The amplitude of the output where the masses deviate by q and the law has the amplitude
    /// `law`.
    pub(super) fn amplitude(&self, s: C, q: &[C], law: f64) -> C {
        let terms = self.terms.iter();
        let own: C = terms
            .map(|&(mass, [place, speed])| q[mass] * (s * speed + place))
            .sum();
        let [place, speed, acceleration] = self.law;
        own + (s * s * acceleration + s * speed + place) * law
    }
}

impl InputSignal {
    /// Whether it is the law.
    pub fn is_law(&self) -> bool {
        self.mass.is_none()
    }

    /// Whether it moves the tree of this number.
    pub(in crate::studies) fn is_of(&self, tree: usize) -> bool {
        self.tree == tree
    }

    /// Amplitude of the law for an input of amplitude 1.
    pub(super) fn law(&self) -> f64 {
        f64::from(u8::from(self.is_law()))
    }

    /// Deviations of the masses of its tree for an input of amplitude 1; `None` at a pole.
    pub(super) fn deviations(&self, tree: &LinearTree, s: C) -> Option<Vec<C>> {
        let force = match self.mass {
            None => tree.force_of_law(s),
            Some(mass) => {
                let mut force = vec![C::new(0.0, 0.0); tree.masses()];
                force[mass] = C::new(1.0, 0.0);
                force
            }
        };
        tree.respond(s, &force)
    }
}

impl LinearModel {
    /// H at a frequency (Hz); `None` at a pole.
    pub(in crate::studies) fn transfer(
        &self,
        input: &InputSignal,
        output: &OutputSignal,
        at: f64,
    ) -> Option<C> {
        let s = C::new(0.0, std::f64::consts::TAU * at);
        let q = input.deviations(&self.trees[input.tree].equations, s)?;
        Some(output.row.amplitude(s, &q, input.law()))
    }

    /// All inputs: of each tree its law, then the load at the output of each object.
    pub fn inputs(&self) -> Vec<InputSignal> {
        let of_tree = |(tree, own): (usize, &NamedTree)| {
            let law = own.law();
            let first = InputSignal {
                signal: Signal::new(format!("{}.law", law.id), law.units[0]),
                tree,
                mass: None,
            };
            let loads = own.objects.iter().map(|object| InputSignal {
                signal: Signal::new(format!("{}.load", object.id), object.units[1]),
                tree,
                mass: Some(object.output()),
            });
            [first].into_iter().chain(loads).collect::<Vec<_>>()
        };
        self.trees.iter().enumerate().flat_map(of_tree).collect()
    }

    /// All outputs: of each object deviation δ, displacement φ, speed, reaction, and the contact
    /// force where a closing force keeps its contact.
    pub fn outputs(&self) -> Vec<OutputSignal> {
        let of_tree = |(tree, own): (usize, &NamedTree)| {
            let outputs = (0..own.objects.len()).flat_map(move |object| {
                own.output_rows(object)
                    .into_iter()
                    .map(move |(signal, row)| OutputSignal { signal, tree, row })
            });
            outputs.collect::<Vec<_>>()
        };
        self.trees.iter().enumerate().flat_map(of_tree).collect()
    }
}

impl NamedTree {
    fn output_rows(&self, object: usize) -> Vec<(Signal, OutputRow)> {
        let own = &self.objects[object];
        let [displacement, force] = own.units;
        let output = own.output();
        let ratio = self.equations.ratios()[output];
        let mut delta = OutputRow {
            terms: vec![(output, [1.0, 0.0])],
            ..OutputRow::default()
        };
        let (place, speed) = (
            OutputRow {
                law: [ratio, 0.0, 0.0],
                ..delta.clone()
            },
            OutputRow {
                terms: vec![(output, [0.0, 1.0])],
                law: [0.0, ratio, 0.0],
            },
        );
        if let Some((driver, ratio)) = own.driver {
            delta.terms.push((driver, [-ratio, 0.0]));
        }
        let named = |what: &str, unit: &str| Signal::new(format!("{}.{what}", own.id), unit);
        let mut rows = vec![
            (named("delta", displacement), delta),
            (named("displacement", displacement), place),
            (named("speed", &format!("{displacement}/s")), speed),
        ];
        if let Some(reaction) = self.reaction(object) {
            let contact = own.opens.map(|opens| reaction.clone().scaled(-opens));
            rows.push((named("reaction", force), reaction));
            rows.extend(contact.map(|row| (named("contact_force", force), row)));
        }
        rows
    }

    /// Force with which an object pulls at its law: of its first link, and of the inertia at its
    /// driven end. `None` where that inertia moves with a mass, whose acceleration is no state.
    fn reaction(&self, object: usize) -> Option<OutputRow> {
        let own = &self.objects[object];
        if own.driver.is_some() && own.driven_end != 0.0 {
            return None;
        }
        let first = own.masses.start;
        let (link, parent) = self.equations.link(first);
        let mut terms = vec![(first, link)];
        if let Some((parent, lever)) = parent {
            terms.push((parent, link.map(|factor| -lever * factor)));
        }
        let law = [0.0, 0.0, -own.driven_end];
        Some(OutputRow { terms, law })
    }
}

impl OutputRow {
    fn scaled(mut self, factor: f64) -> Self {
        for (_, own) in &mut self.terms {
            *own = own.map(|one| factor * one);
        }
        self.law = self.law.map(|one| factor * one);
        self
    }
}
