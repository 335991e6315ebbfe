//! What a scene expects of its linkages, told beside what was found.

use super::console;
use crate::studies::expectations::Verdict;
use serde_json::{Value, json};

/// Adds the verdicts to a document, where there are any.
pub(super) fn beside(mut document: Value, verdicts: &[Verdict]) -> Value {
    if !verdicts.is_empty() {
        document["expect"] = json!(verdicts);
    }
    document
}

/// True when every expectation holds.
pub(super) fn hold(verdicts: &[Verdict]) -> bool {
    verdicts.iter().all(|verdict| verdict.holds)
}

/// Tells how many hold, and which do not.
pub(super) fn talk(verdicts: &[Verdict]) {
    for verdict in verdicts.iter().filter(|verdict| !verdict.holds) {
        console::talk(&format!("expectation failed: {}", verdict.message));
    }
    if !verdicts.is_empty() {
        let held = verdicts.iter().filter(|verdict| verdict.holds).count();
        console::talk(&format!("expectations: {held} of {} hold", verdicts.len()));
    }
}
