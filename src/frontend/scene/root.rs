//! The top level of a scene.

use super::objects::{self, ObjectTable};
use super::{
    Expectation, IdentifySpec, MeasuredValue, OptimizeSpec, RunSpec, SceneObject, SteadySpec,
    ToleranceSpec, expect, identify, optimize, run, steady, tolerance,
};
use crate::frontend::read::Slot;
use serde_json::json;
use std::collections::BTreeMap;

/// A scene without its hash.
pub(super) struct Root {
    pub(super) name: String,
    pub(super) objects: BTreeMap<String, SceneObject>,
    pub(super) run: RunSpec,
    pub(super) steady: Option<SteadySpec>,
    pub(super) optimize: Option<OptimizeSpec>,
    pub(super) tolerance: Option<ToleranceSpec>,
    pub(super) identify: Option<IdentifySpec>,
    pub(super) expect: Vec<Expectation>,
    pub(super) measured: Vec<MeasuredValue>,
}

/// Reads (or describes) a whole scene.
pub(super) fn read(slot: Slot<'_>, mut known: ObjectTable) -> Option<Root> {
    slot.record(|fields| {
        fields.remark("$schema", "Where editors find the schema of this file.");
        let version = fields.need("dam", "Version of the format: 1.", |slot| slot.count(1..=1));
        let name = fields.need("name", "Name of the scene.", |slot| slot.text());
        fields.remark("description", "Remarks for people.");
        let doc = "Named parameters: numbers, texts with a unit, or formulas of other parameters. \
                   Every number and every expression of the scene may refer to them.";
        let parameters = fields.parameters(doc);
        let objects = fields.need("objects", "The objects of the mechanism by id.", |slot| {
            objects::read(slot, &mut known)
        });
        let run = fields.need("run", "How the scene is run.", |slot| {
            run::read(slot, &known)
        });
        let doc = "The wanted steady motion of the drive (`dam steady`).";
        let steady = fields.maybe("steady", doc, |slot| steady::read(slot, &known));
        let doc = "The wanted best values of several variables (`dam optimize`).";
        let optimize = fields.maybe("optimize", doc, optimize::read);
        let doc = "Tolerances of numbers, and limits of results (`dam tolerance`).";
        let tolerance = fields.maybe("tolerance", doc, tolerance::read);
        let doc = "Numbers that are sought from records of the motion (`dam identify`).";
        let identify = fields.maybe("identify", doc, identify::read);
        let expect = fields.or(
            "expect",
            "Values that results of the run must have.",
            json!([]),
            |slot| expect::read(slot, &known),
        );
        version?;
        parameters?;
        Some(Root {
            name: name?,
            objects: objects?,
            run: run?,
            steady: steady?,
            optimize: optimize?,
            tolerance: tolerance?,
            identify: identify?,
            expect: expect?,
            measured: known.measured.take(),
        })
    })
}
