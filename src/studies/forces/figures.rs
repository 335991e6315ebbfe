//! Figures of a study by name, as a scene's expectations address them.

use super::{Column, CycleForces, Extremes, ForceStudy, columns, columns_of_inputs};
use crate::kinematics::linkage::multi::spec::MultiSpec;
use crate::kinematics::linkage::spec::LinkageSpec;
use crate::studies::kinematics::NamedFigure;

/// Sums over the cycle with their units; `None`: that of the driving force.
const CYCLE: [(&str, Option<&str>); 8] = [
    ("duration", Some("s")),
    ("drive_work", Some("N m")),
    ("load_work", Some("N m")),
    ("applied_work", Some("N m")),
    ("loss", Some("N m")),
    ("efficiency", Some("")),
    ("mean_drive", None),
    ("rms_drive", None),
];
/// Results of the counterweight, likewise.
const COUNTERWEIGHT: [(&str, Option<&str>); 6] = [
    ("mass_radius", Some("kg m")),
    ("angle", Some("rad")),
    ("rms_without", Some("N")),
    ("rms_with", Some("N")),
    ("greatest_without", Some("N")),
    ("greatest_with", Some("N")),
];

/// All figures that a study of this linkage can have, but those of its zones
/// (`zones.0.from`), whose number is not known before; `place`: the unit of places on the
/// course.
pub fn figures(linkage: &LinkageSpec, output: Option<usize>, place: &str) -> Vec<NamedFigure> {
    let columns = columns(linkage, output);
    let drive = columns.iter().find(|column| column.name == "drive");
    let drive = drive.map_or("", |column| column.unit.as_str());
    let sum = |(name, unit): (&str, Option<&str>), of: &str| {
        NamedFigure::new(format!("{of}.{name}"), unit.unwrap_or(drive))
    };
    let mut all = of_columns(&columns, linkage, place);
    all.extend(CYCLE.map(|one| sum(one, "cycle")));
    all.extend(COUNTERWEIGHT.map(|one| sum(one, "counterweight")));
    all
}

/// The same of a linkage of several inputs.
pub fn figures_of_inputs(spec: &MultiSpec, place: &str) -> Vec<NamedFigure> {
    let mut all = of_columns(&columns_of_inputs(spec), &spec.linkage, place);
    // There is no one driving force that has a mean.
    let sums = CYCLE.into_iter().filter_map(|(name, unit)| {
        let unit = unit?;
        Some(NamedFigure::new(format!("cycle.{name}"), unit))
    });
    all.extend(sums);
    all
}

fn of_columns(columns: &[Column], linkage: &LinkageSpec, place: &str) -> Vec<NamedFigure> {
    let mut all = Vec::new();
    for column in columns.iter().filter(|column| column.figure) {
        all.extend(NamedFigure::ends(&column.name, &column.unit, place));
    }
    let pairs = linkage.pairs.iter();
    all.extend(pairs.map(|pair| NamedFigure::new(format!("cycle.losses.{}", pair.name), "N m")));
    all.push(NamedFigure::new("zones.count", ""));
    all
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
            let index = COUNTERWEIGHT.iter().position(|known| known.0 == name)?;
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
