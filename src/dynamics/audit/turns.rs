//! Both sides of a switch.

use super::judge::Judge;
use super::look::Turn;

/// Puts a switch to the test.
pub(super) fn judge(judge: &mut Judge<'_>, turn: &Turn) {
    continuity(judge, turn);
}

/// Nothing jumps: displacements nowhere, speeds but in an impact.
fn continuity(judge: &mut Judge<'_>, turn: &Turn) {
    let count = turn.before.len() / 2;
    let bound = judge.bound();
    let sides = [(&turn.last, &turn.before), (&turn.next, &turn.after)];
    for (near, there) in sides {
        let Some(near) = near else {
            continue;
        };
        for node in 0..judge.names.len() {
            let Some(own) = judge.mechanics.coordinate[node] else {
                continue;
            };
            // (A massless point has no speed of its own: it follows from the balance.)
            let massless = judge.system.model().nodes[node].inertia == 0.0;
            let entries = [(own, "displacement at a switch"), (count + own, "speed at a switch")];
            for (entry, what) in entries.into_iter().take(if massless { 1 } else { 2 }) {
                let scale = judge.scales.entries[entry];
                if scale > 0.0 {
                    let defect = (near[entry] - there[entry]).abs() / scale;
                    judge.found.see(defect, bound, (turn.time, &judge.names[node]), what);
                }
            }
        }
    }
    for node in 0..judge.names.len() {
        let Some(own) = judge.mechanics.coordinate[node] else {
            continue;
        };
        let scale = judge.scales.entries[own];
        if scale > 0.0 {
            let defect = (turn.before[own] - turn.after[own]).abs() / scale;
            let place = (turn.time, &*judge.names[node]);
            judge.found.see(defect, bound, place, "displacement at a switch");
        }
    }
}
