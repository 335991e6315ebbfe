//! What a run resolves of a figure: no difference is taken relative to less.

use super::{Figures, ObjectFigures};

/// Share of the greatest displacement, speed or force of a scene that its runs resolve.
const RESOLVED: f64 = 1e-12;

impl Figures {
    /// What a run of this scene resolves of a figure: a share of the greatest value of its
    /// kind over all objects of the same unit. Zero of counts, times and works, and where
    /// nothing moves.
    pub fn resolution(&self, address: &str) -> f64 {
        if self.studies.contains_key(address) {
            return 0.0;
        }
        let unit = self.unit(address);
        let displacement = unit.split('/').next().unwrap_or("");
        let time = self.run.time;
        let over_time = |value: f64| if time > 0.0 { value / time } else { 0.0 };
        let greatest = |of: fn(&ObjectFigures) -> f64| {
            let objects = self.objects.iter();
            let same = objects.filter(|(id, _)| {
                let units = self.units.get(*id);
                units.is_some_and(|own| own.displacement == displacement || own.force == unit)
            });
            same.map(|(_, own)| of(own).abs()).fold(0.0, f64::max)
        };
        let size = match unit.as_str() {
            "rad" | "m" => greatest(|own| own.end.displacement.abs().max(own.delta_abs)),
            "rad/s" | "m/s" => greatest(|own| own.peak_speed),
            "rad/s²" | "m/s²" => {
                let least = over_time(greatest(|own| own.peak_speed));
                greatest(|own| own.peak_acceleration).max(least)
            }
            "N" | "N m" => greatest(|own| own.peak_reaction),
            _ => 0.0,
        };
        RESOLVED * size
    }

    /// What a difference of a figure between two runs is taken relative to: its scale, but
    /// no less than what they resolve. Of a figure that is zero in this run it is the scale
    /// in the other one. Zero: it has none in either.
    pub fn common_scale(&self, other: &Self, address: &str) -> f64 {
        let resolution = self.resolution(address).max(other.resolution(address));
        match self.scale(address) {
            own if own > resolution => own,
            _ => other.scale(address).max(resolution),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Figures, ObjectFigures};
    use crate::dynamics::record::{RunSummary, Units};
    use std::collections::BTreeMap;

    fn figures(change: impl FnOnce(&mut ObjectFigures)) -> Figures {
        let mut rocker = ObjectFigures::default();
        change(&mut rocker);
        let units = Units {
            displacement: "rad",
            force: "N m",
        };
        Figures {
            dam: 1,
            scene: "s".to_owned(),
            hash: String::new(),
            units: BTreeMap::from([("rocker".to_owned(), units)]),
            objects: BTreeMap::from([("rocker".to_owned(), rocker)]),
            run: RunSummary::default(),
            studies: BTreeMap::new(),
            warnings: Vec::new(),
        }
    }

    #[test]
    fn a_figure_that_is_zero_is_measured_by_the_other_run() {
        let none = figures(|rocker| rocker.peak_reaction = 0.0);
        let some = figures(|rocker| rocker.peak_reaction = 15.4);
        let scale = |a: &Figures, b: &Figures| a.common_scale(b, "rocker.peak_reaction");
        assert_eq!(scale(&none, &some), 15.4);
        assert_eq!(scale(&some, &none), 15.4);
        assert_eq!(scale(&none, &none), 0.0);
    }

    #[test]
    fn rounding_beside_a_motion_has_no_size_of_its_own() {
        let with = |delta: f64| {
            figures(|rocker| {
                rocker.delta_abs = delta;
                rocker.end.displacement = 3.0;
            })
        };
        let (none, rounding) = (with(0.0), with(1e-17));
        let scale = none.common_scale(&rounding, "rocker.delta_abs");
        assert_eq!(scale, 3e-12);
        // A deflection that is resolved keeps its own.
        assert_eq!(with(1e-9).common_scale(&none, "rocker.delta_abs"), 1e-9);
    }
}
