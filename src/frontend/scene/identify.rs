//! The `identify` block: what `dam identify` is asked of a scene.

use crate::frontend::read::Slot;
use serde_json::json;

/// Most numbers that are sought.
const MOST_NUMBERS: usize = 20;

/// Most records, and most columns of them.
const MOST_RECORDS: usize = 1000;

/// Most starts.
const MOST_STARTS: u64 = 1000;

/// What `dam identify` is asked. Records, ranges and columns are read where the question is asked.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct IdentifySpec {
    /// Files of records beside the scene, with settings behind them, as `--record` takes them.
    pub record: Vec<String>,
    /// Columns and the signals that they measure, as `--match` takes them.
    pub matched: Vec<String>,
    /// Numbers and their ranges, as `--vary` takes them.
    pub vary: Vec<String>,
    /// Standard deviations of columns, as `--sigma` takes them.
    pub sigma: Vec<String>,
    /// Number of starts; `None`: the usual one.
    pub starts: Option<u64>,
    /// Whether rows from the first separation on are left out.
    pub until_first_separation: bool,
}

/// Reads the block.
pub(super) fn read(slot: Slot<'_>) -> Option<IdentifySpec> {
    slot.record(|fields| {
        let doc = "Records of the motion, CSV files in the folder of the scene, with settings for \
                   one of them behind semicolons: \"test.csv; shaft.motion.speed=300 rpm\".";
        let record = fields.or("record", doc, json!([]), |slot| {
            slot.list(0..=MOST_RECORDS, |slot| slot.text())
        });
        let doc = "Columns of the records and the signals that they measure: \"x=rocker.delta\".";
        let matched = fields.need("match", doc, |slot| {
            slot.list(1..=MOST_RECORDS, |slot| slot.text())
        });
        let doc = "Numbers that are sought, and their ranges: PATH=LOW:HIGH, with :START and :log \
                   if wanted.";
        let vary = fields.need("vary", doc, |slot| {
            slot.list(1..=MOST_NUMBERS, |slot| slot.text())
        });
        let doc = "Standard deviations of columns: \"x=1 µrad\".";
        let sigma = fields.or("sigma", doc, json!([]), |slot| {
            slot.list(0..=MOST_RECORDS, |slot| slot.text())
        });
        let doc = "Number of starts (8).";
        let starts = fields.maybe("starts", doc, |slot| slot.count(1..=MOST_STARTS));
        let doc = "Up to where records are used; to their end if not given.";
        let until = fields.maybe("until", doc, |slot| {
            slot.choice(&[("first_separation", ())])
        });
        Some(IdentifySpec {
            record: record?,
            matched: matched?,
            vary: vary?,
            sigma: sigma?,
            starts: starts?,
            until_first_separation: until?.is_some(),
        })
    })
}
