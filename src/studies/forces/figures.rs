//! Figures of a study by name, as a scene's expectations address them.

use super::{Column, CycleForces, Extremes, ForceStudy, columns, columns_of_inputs};
use crate::kinematics::linkage::multi::spec::MultiSpec;
use crate::kinematics::linkage::spec::LinkageSpec;
use crate::studies::kinematics::ENDS;

/// Sums over the cycle.
const CYCLE: [&str; 8] = [
    "duration",
    "drive_work",
    "load_work",
    "applied_work",
    "loss",
    "efficiency",
    "mean_drive",
    "rms_drive",
];
/// What is told of the counterweight.
const COUNTERWEIGHT: [&str; 6] = [
    "mass_radius",
    "angle",
    "rms_without",
    "rms_with",
    "greatest_without",
    "greatest_with",
];

/// Names of all figures that a study of this linkage can have, but those of its
/// zones (`zones.0.from`), whose number is not known before.
pub fn figures(linkage: &LinkageSpec, output: Option<usize>) -> Vec<String> {
    let mut names = names(&columns(linkage, output), linkage, &CYCLE);
    names.extend(COUNTERWEIGHT.map(|name| format!("counterweight.{name}")));
    names
}

/// The same of a linkage of several inputs.
pub fn figures_of_inputs(spec: &MultiSpec) -> Vec<String> {
    // There is no one driving force whose mean could be told.
    names(
        &columns_of_inputs(spec),
        &spec.linkage,
        &CYCLE[..CYCLE.len() - 2],
    )
}

fn names(columns: &[Column], linkage: &LinkageSpec, cycle: &[&str]) -> Vec<String> {
    let columns = columns.iter().filter(|column| column.figure);
    let mut names: Vec<String> = columns
        .flat_map(|column| ENDS.map(|end| format!("{}.{end}", column.name)))
        .collect();
    names.extend(cycle.iter().map(|name| format!("cycle.{name}")));
    let pairs = linkage.pairs.iter();
    names.extend(pairs.map(|pair| format!("cycle.losses.{}", pair.name)));
    names.push("zones.count".to_owned());
    names
}

impl ForceStudy {
    /// A figure by its name: `drive.greatest`, `R12.force.greatest_at`,
    /// `cycle.efficiency`, `cycle.losses.R12`, `counterweight.angle`,
    /// `zones.0.from`; SI units. `None` where this study has none of that name,
    /// or any of its positions before the ends of the reach has no forces.
    pub fn figure(&self, name: &str) -> Option<f64> {
        if let Some(zone) = name.strip_prefix("zones.") {
            return self.of_zone(zone);
        }
        if self.missing() > 0 {
            return None;
        }
        if let Some(name) = name.strip_prefix("cycle.") {
            return self.of_cycle(self.cycle.as_ref()?, name);
        }
        if let Some(name) = name.strip_prefix("counterweight.") {
            let found = self.counterweight.as_ref()?;
            let values = [
                found.mass_radius,
                found.angle,
                found.rms[0],
                found.rms[1],
                found.greatest[0],
                found.greatest[1],
            ];
            let index = COUNTERWEIGHT.iter().position(|known| *known == name)?;
            return Some(values[index]);
        }
        let (column, what) = name.rsplit_once('.')?;
        let extremes = self.extremes.iter().find(|found| found.name == column)?;
        end(extremes, what)
    }

    fn of_zone(&self, name: &str) -> Option<f64> {
        if name == "count" {
            return Some(self.zones.len() as f64);
        }
        let (index, what) = name.split_once('.')?;
        let zone = self.zones.get(index.parse::<usize>().ok()?)?;
        match what {
            "from" => Some(zone.from),
            "to" => Some(zone.to),
            _ => None,
        }
    }

    fn of_cycle(&self, cycle: &CycleForces, name: &str) -> Option<f64> {
        if let Some(name) = name.strip_prefix("losses.") {
            let index = self
                .linkage
                .pairs
                .iter()
                .position(|pair| pair.name == name)?;
            return cycle.pair_losses.get(index).copied();
        }
        match name {
            "duration" => Some(cycle.duration),
            "drive_work" => Some(cycle.drive_work),
            "load_work" => Some(cycle.load_work),
            "applied_work" => Some(cycle.applied_work),
            "loss" => Some(cycle.loss),
            "efficiency" => cycle.efficiency,
            "mean_drive" if self.several.is_none() => Some(cycle.mean_drive),
            "rms_drive" if self.several.is_none() => Some(cycle.rms_drive),
            _ => None,
        }
    }
}

fn end(extremes: &Extremes, what: &str) -> Option<f64> {
    let finite = |value: f64| value.is_finite().then_some(value);
    match what {
        "least" => finite(extremes.least.value),
        "greatest" => finite(extremes.greatest.value),
        "least_at" => Some(extremes.least.at),
        "greatest_at" => Some(extremes.greatest.at),
        _ => None,
    }
}
