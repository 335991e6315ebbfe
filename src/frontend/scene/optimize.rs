//! The `optimize` block: what `dam optimize` is asked of a scene.

use crate::frontend::read::Slot;
use serde_json::json;

/// Most variables of the block.
const MOST_VARIABLES: usize = 20;

/// Most conditions of the block.
const MOST_CONDITIONS: usize = 1000;

/// Most starts.
const MOST_STARTS: u64 = 1000;

/// What `dam optimize` is asked. Ranges and conditions are read where the question is asked.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OptimizeSpec {
    /// Variables and their ranges, as `--vary` takes them.
    pub vary: Vec<String>,
    /// Conditions, as `--subject` takes them.
    pub subject: Vec<String>,
    /// What is to be greatest.
    pub maximize: Option<String>,
    /// What is to be least.
    pub minimize: Option<String>,
    /// Number of starts; `None`: the usual one.
    pub starts: Option<u64>,
}

/// Reads the block.
pub(super) fn read(slot: Slot<'_>) -> Option<OptimizeSpec> {
    slot.record(|fields| {
        let doc = "Variables and their ranges, PATH=LOW:HIGH, with :START and :log if wanted.";
        let vary = fields.need("vary", doc, |slot| {
            slot.list(1..=MOST_VARIABLES, |slot| slot.text())
        });
        let doc = "Conditions on results: \"valve.pair.margin >= 50 N\".";
        let subject = fields.or("subject", doc, json!([]), |slot| {
            slot.list(0..=MOST_CONDITIONS, |slot| slot.text())
        });
        let doc = "Result or variable to be greatest.";
        let maximize = fields.maybe("maximize", doc, |slot| slot.text());
        let doc = "Result or variable to be least.";
        let minimize = fields.maybe("minimize", doc, |slot| slot.text());
        let doc = "Number of starts (8).";
        let starts = fields.maybe("starts", doc, |slot| slot.count(1..=MOST_STARTS));
        Some(OptimizeSpec {
            vary: vary?,
            subject: subject?,
            maximize: maximize?,
            minimize: minimize?,
            starts: starts?,
        })
    })
}
