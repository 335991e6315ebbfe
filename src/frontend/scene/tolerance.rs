//! The `tolerance` block: what `dam tolerance` is asked of a scene.

use crate::frontend::read::Slot;
use serde_json::json;

/// Most tolerances of the block.
const MOST_TOLERANCES: usize = 1000;

/// Most results and most limits of the block.
const MOST_RESULTS: usize = 1000;

/// Most samples.
const MOST_SAMPLES: u64 = 1 << 17;

/// What `dam tolerance` is asked. Tolerances and limits are read where the question is asked.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ToleranceSpec {
    /// Numbers with their tolerances, as `--tol` takes them.
    pub tol: Vec<String>,
    /// Results, as `--figures` takes them.
    pub figures: Vec<String>,
    /// Limits, as `--limit` takes them.
    pub limit: Vec<String>,
    /// Number of samples; `None`: the usual one.
    pub samples: Option<u64>,
    /// Seed of the samples; `None`: the usual one.
    pub seed: Option<u64>,
}

/// Reads the block.
pub(super) fn read(slot: Slot<'_>) -> Option<ToleranceSpec> {
    slot.record(|fields| {
        let doc = "Numbers of the scene with their tolerances: \"rocker.pair.gap=±0.02 mm\".";
        let tol = fields.need("tol", doc, |slot| {
            slot.list(1..=MOST_TOLERANCES, |slot| slot.text())
        });
        let doc = "Results that are looked at; those of the limits if none.";
        let figures = fields.or("figures", doc, json!([]), |slot| {
            slot.list(0..=MOST_RESULTS, |slot| slot.text())
        });
        let doc = "Limits that samples are to meet: \"rocker.delta_max <= 0.2 mrad\".";
        let limit = fields.or("limit", doc, json!([]), |slot| {
            slot.list(0..=MOST_RESULTS, |slot| slot.text())
        });
        let doc = "Number of samples (4096); 0 for the stack alone.";
        let samples = fields.maybe("samples", doc, |slot| slot.count(0..=MOST_SAMPLES));
        let doc = "Seed of the samples (1).";
        let seed = fields.maybe("seed", doc, |slot| slot.count(0..=u64::from(u32::MAX)));
        Some(ToleranceSpec {
            tol: tol?,
            figures: figures?,
            limit: limit?,
            samples: samples?,
            seed: seed?,
        })
    })
}
