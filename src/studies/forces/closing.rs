//! Cams that would have to pull: where a closing force is lacking.

use super::{ForceStudy, Row};
use crate::units::shown;

/// A force of this part of the greatest one is rounding.
const NOTHING: f64 = 1e-9;

impl ForceStudy {
    /// A sentence for each cam with one flank that does not press everywhere. A groove has two.
    pub(super) fn lacking_closing_forces(&self) -> impl Iterator<Item = String> {
        let couplings = self.linkage.couplings.iter().enumerate();
        couplings.filter_map(|(index, coupling)| {
            let one_sided = coupling.kind.is_one_sided();
            one_sided.then(|| self.lacking(index, &coupling.name))?
        })
    }

    fn lacking(&self, coupling: usize, name: &str) -> Option<String> {
        if self.indeterminate.couplings.get(coupling) == Some(&true) {
            return None;
        }
        let all = self
            .solved()
            .map(|(row, found)| (row, found.couplings[coupling].size));
        let all: Vec<(&Row, f64)> = all.collect();
        let greatest = all
            .iter()
            .fold(0.0f64, |most, (_, force)| most.max(force.abs()));
        let pulls = |force: f64| force < -NOTHING * greatest;
        let count = all.iter().filter(|(_, force)| pulls(*force)).count();
        let (row, least) = all.iter().min_by(|one, other| one.1.total_cmp(&other.1))?;
        if count == 0 {
            return None;
        }
        Some(format!(
            "the cam of `{name}` does not press at {count} of {} positions. Without a closing force of \
             up to {} N (at {}) the roller lifts off, and these results do not hold",
            all.len(),
            shown(-least, 4),
            self.where_in_words(row),
        ))
    }

    /// A position by its time, or by its input.
    fn where_in_words(&self, row: &Row) -> String {
        let input = row.motion.coordinate;
        match (row.time, self.coordinate_unit()) {
            (Some(time), _) => format!("{} s", shown(time, 6)),
            (None, "rad") => format!("{} deg", shown(input.to_degrees(), 6)),
            (None, unit) => format!("{} {unit}", shown(input, 6)),
        }
    }
}
