//! The studies, each with what it asks of the library and what it shows of the answer.

pub(crate) mod cam;
pub(crate) mod compare;
pub(crate) mod find;
pub(crate) mod gradient;
pub(crate) mod identify;
pub(crate) mod law;
pub(crate) mod linear;
pub(crate) mod linkages;
pub(crate) mod map;
pub(crate) mod methods;
pub(crate) mod optimize;
pub(crate) mod reduce;
pub(crate) mod run;
pub(crate) mod show;
pub(crate) mod steady;
pub(crate) mod tolerance;

use crate::answer::{Columns, Figure};
use crate::work::Watch;
use dam::Error;
use dam::record::Figures;
use dam::report::csv::Rows;
use dam::report::findings::Source;
use dam::studies::order::{Certainty, Certificate};
use dam::{Mechanism, Scene};
use serde_json::Value;
use std::sync::Arc;

/// A scene with the mechanism made of it: what a page shows of them.
#[derive(Debug)]
pub(crate) struct Asked {
    pub(crate) scene: Arc<Scene>,
    pub(crate) ready: Mechanism,
}

impl Asked {
    pub(crate) fn name(&self) -> &str {
        &self.ready.scene().name
    }

    pub(crate) fn hash(&self) -> &str {
        &self.ready.scene().hash
    }

    pub(crate) fn source(&self) -> Source<'_> {
        Source::scene(self.scene.json(), self.hash())
    }
}

/// What a budget that is spent ends in.
pub(crate) fn interrupted(what: &str) -> Error {
    vec![dam::fault::Fault::new(
        "",
        format!("{what} was interrupted"),
        "",
    )]
    .into()
}

/// What was found, if there was time for all of it.
///
/// # Errors
/// There was not.
pub(crate) fn in_time<T>(found: T, what: &str, watch: &Watch) -> Result<T, Error> {
    match watch.budget().is_spent() {
        true => Err(interrupted(what)),
        false => Ok(found),
    }
}

/// Columns of a table for other programs, as far as they are numbers: `phi [rad]` is `phi`
/// in rad.
pub(crate) fn columns(rows: &Rows) -> Columns {
    let column = |(index, head): (usize, &String)| {
        let (name, unit) = match head
            .strip_suffix(']')
            .and_then(|head| head.split_once(" ["))
        {
            Some((name, unit)) => (name, unit),
            None => (head.as_str(), ""),
        };
        Some((
            name.to_owned(),
            unit.to_owned(),
            rows.numbers_of_column(index)?,
        ))
    };
    Columns(
        rows.column_names()
            .iter()
            .enumerate()
            .filter_map(column)
            .collect(),
    )
}

/// The figures of a run, with what was judged of their errors.
pub(crate) fn figures(figures: &Figures, certificate: Option<&Certificate>) -> Vec<Figure> {
    let judged = |address: &str| certificate?.accuracy.get(address);
    let known = figures.addresses().into_iter();
    let told = known.filter_map(|(address, value)| {
        let unit = figures.unit(&address);
        let (error, kind) = match judged(&address) {
            None => (None, "value"),
            Some(found) => (
                found.error,
                match found.kind {
                    Certainty::Bound => "bound",
                    Certainty::Estimate => "estimate",
                    Certainty::NoLimit => "no_limit",
                    Certainty::NotDetermined => "not_determined",
                },
            ),
        };
        Some((address, value?, unit, error, kind))
    });
    told.collect()
}

/// Plain data as a document.
pub(crate) fn plain(value: &impl serde::Serialize) -> Result<Value, Error> {
    serde_json::to_value(value)
        .map_err(|error| vec![dam::fault::Fault::new("", error.to_string(), "")].into())
}
