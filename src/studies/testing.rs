//! Fabricated results for the tests of what is made of results.

use super::run::RunResult;
use crate::dynamics::integrate::{Method, Outcome, Statistics, Stop};
use crate::dynamics::record::{EnergyAudit, Figures, ObjectFigures, Record, RunSummary, Units};
use std::collections::BTreeMap;

/// A complete run of one object, `rocker`, with the figures that `set` sets.
pub(crate) fn result_with(set: impl FnOnce(&mut ObjectFigures)) -> RunResult {
    let mut rocker = ObjectFigures::default();
    set(&mut rocker);
    RunResult {
        record: Record::default(),
        figures: Figures {
            dam: 1,
            scene: "fabricated".to_owned(),
            hash: String::new(),
            units: BTreeMap::from([(
                "rocker".to_owned(),
                Units {
                    displacement: "rad",
                    force: "N m",
                },
            )]),
            objects: BTreeMap::from([("rocker".to_owned(), rocker)]),
            run: RunSummary::default(),
            studies: BTreeMap::new(),
            warnings: Vec::new(),
        },
        outcome: Outcome {
            time: 1.0,
            stop: Stop::Complete,
            statistics: Statistics::default(),
        },
        method: Method::Dop853,
        tolerance: 1e-8,
        equations: crate::dynamics::audit::EquationCheck::default(),
        audit: EnergyAudit::default(),
        warnings: Vec::new(),
    }
}
