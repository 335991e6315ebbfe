//! Figures of a study by name, as a scene's expectations address them.

use super::{Column, Counterweight, CycleForces, ForceStudy, columns, columns_of_inputs};
use crate::kinematics::linkage::multi::spec::MultiSpec;
use crate::kinematics::linkage::spec::LinkageSpec;
use crate::studies::kinematics::{DescribedFigure, NamedFigure, end};

/// A figure of a sum over the course: name, unit (`None`: that of the driving force), meaning,
/// and how it is read.
type Sum<T> = (
    &'static str,
    Option<&'static str>,
    &'static str,
    fn(&T) -> Option<f64>,
);

/// Sums over the cycle.
#[rustfmt::skip]
const CYCLE: [Sum<CycleForces>; 8] = [
    ("duration", Some("s"), "Duration of the course, > 0.", |sums| Some(sums.duration)),
    ("drive_work", Some("N m"), "Work of the driver, positive where it puts energy in.", |sums| Some(sums.drive_work)),
    ("load_work", Some("N m"), "Work of the load on the linkage, negative where it resists.", |sums| Some(sums.load_work)),
    ("applied_work", Some("N m"), "Work of weights, springs, dampers and forces, the load included.", |sums| Some(sums.applied_work)),
    ("loss", Some("N m"), "Work lost to friction, ≥ 0.", |sums| Some(sums.loss)),
    ("efficiency", Some(""), "1 less the loss over the work put in; absent if the course is no cycle.", |sums| sums.efficiency),
    ("mean_drive", None, "Mean driving force over time; absent with several inputs.", |sums| Some(sums.mean_drive)),
    ("rms_drive", None, "Root mean square of the driving force over time, ≥ 0; absent with several inputs.", |sums| Some(sums.rms_drive)),
];
/// Results of the counterweight.
#[rustfmt::skip]
const COUNTERWEIGHT: [Sum<Counterweight>; 6] = [
    ("mass_radius", Some("kg m"), "Mass times distance from the pivot of the best counterweight, ≥ 0.", |found| Some(found.mass_radius)),
    ("angle", Some("rad"), "Direction of the counterweight from the pivot, in the frame of its link.", |found| Some(found.angle)),
    ("rms_without", Some("N"), "Root mean square of the shaking force without the counterweight, ≥ 0.", |found| Some(found.rms[0])),
    ("rms_with", Some("N"), "Root mean square of the shaking force with it, ≥ 0.", |found| Some(found.rms[1])),
    ("greatest_without", Some("N"), "Greatest shaking force without it, ≥ 0.", |found| Some(found.greatest[0])),
    ("greatest_with", Some("N"), "Greatest shaking force with it, ≥ 0.", |found| Some(found.greatest[1])),
];
/// SI units of driving forces.
const DRIVE: &[&str] = &["N m", "N"];
/// Extremes of the columns that are results, with their units and meaning.
#[rustfmt::skip]
const EXTREMES: [(&str, &[&str], &str); 17] = [
    ("drive", DRIVE, "Driving moment or force, positive in the direction of the input."),
    ("drive.INPUT", DRIVE, "The same of one of several inputs."),
    ("power.INPUT", &["W"], "Power of the driver of one of several inputs, positive where it puts energy in."),
    ("ratio", &["1", "m", "1/m"], "Kinematic ratio: displacement of the loaded output per unit of the input."),
    ("chi", &["1", "m", "1/m"], "Dynamic transmission ratio χ: driving force over load, with the sign of the convention."),
    ("PAIR.force", &["N"], "Size of the joint reaction, friction included, ≥ 0."),
    ("PAIR.n1", &["N"], "Normal force at the first corner of a block, positive to the left of its direction."),
    ("PAIR.n2", &["N"], "Normal force at the second corner of a block, positive to the left of its direction."),
    ("PAIR.couple", &["N m"], "Couple of a rigid joint on its second link, counterclockwise."),
    ("COUPLING.force", &["N"], "Circumferential force of a coupling of two links; of a cam the force on the roller, positive: it presses."),
    ("power.drive", &["W"], "Power of all drivers, positive where they put energy in."),
    ("power.loss", &["W"], "Power lost to friction, ≥ 0."),
    ("efficiency", &["1"], "Efficiency at an instant: 1 less the loss over the power that flows in."),
    ("shaking.force", &["N"], "Size of the shaking force: inertia of the links on the frame, ≥ 0."),
    ("shaking.moment", &["N m"], "Shaking moment about the origin of the ground, counterclockwise."),
    ("frame.force", &["N"], "Size of the force of all joints on the frame, ≥ 0."),
    ("frame.moment", &["N m"], "Moment of all joints on the frame about the origin of the ground, counterclockwise."),
];
/// Results beside extremes and sums.
#[rustfmt::skip]
const OTHERS: [(&str, &[&str], &str); 4] = [
    ("cycle.losses.PAIR", &["N m"], "Work lost in this joint, ≥ 0."),
    ("zones.count", &["1"], "Number of zones of the course without forces or with self-locking."),
    ("zones.N.from", &["rad", "m", "s"], "Start of zone N, counted from 0: input coordinate or time."),
    ("zones.N.to", &["rad", "m", "s"], "End of zone N."),
];

/// All results that forces can have, with units and meaning.
pub fn described_results() -> Vec<DescribedFigure> {
    let mut all = Vec::new();
    for (name, units, meaning) in EXTREMES {
        all.push(DescribedFigure::new(&format!("{name}.END"), units, meaning));
    }
    let cycle = CYCLE.map(|(name, unit, meaning, _)| (format!("cycle.{name}"), unit, meaning));
    let counterweight = COUNTERWEIGHT
        .map(|(name, unit, meaning, _)| (format!("counterweight.{name}"), unit, meaning));
    for (address, unit, meaning) in cycle.into_iter().chain(counterweight) {
        let units: &[&str] = match &unit {
            Some("") => &["1"],
            Some(unit) => &[*unit],
            None => DRIVE,
        };
        all.push(DescribedFigure::new(&address, units, meaning));
    }
    let others = OTHERS.map(|(name, units, meaning)| DescribedFigure::new(name, units, meaning));
    all.extend(others);
    all
}

/// All figures that a study of this linkage can have, but those of its zones
/// (`zones.0.from`), whose number is not known before; `place`: the unit of places on the
/// course.
pub fn figures(linkage: &LinkageSpec, output: Option<usize>, place: &str) -> Vec<NamedFigure> {
    let columns = columns(linkage, output);
    let drive = columns.iter().find(|column| column.name == "drive");
    let drive = drive.map_or("", |column| column.unit.as_str());
    let mut all = of_columns(&columns, linkage, place);
    let cycle = CYCLE.map(|(name, unit, ..)| (format!("cycle.{name}"), unit));
    let counterweight =
        COUNTERWEIGHT.map(|(name, unit, ..)| (format!("counterweight.{name}"), unit));
    let sums = cycle.into_iter().chain(counterweight);
    all.extend(sums.map(|(name, unit)| NamedFigure::new(name, unit.unwrap_or(drive))));
    all
}

/// The same of a linkage of several inputs.
pub fn figures_of_inputs(spec: &MultiSpec, place: &str) -> Vec<NamedFigure> {
    let mut all = of_columns(&columns_of_inputs(spec), &spec.linkage, place);
    // There is no one driving force that has a mean.
    let sums = CYCLE
        .into_iter()
        .filter_map(|(name, unit, ..)| Some(NamedFigure::new(format!("cycle.{name}"), unit?)));
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

impl Counterweight {
    /// The figures with their names.
    pub fn figures(&self) -> [(&'static str, f64); 6] {
        COUNTERWEIGHT.map(|(name, .., read)| (name, read(self).unwrap_or(f64::NAN)))
    }
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
            let mut figures = self.counterweight.as_ref()?.figures().into_iter();
            return figures.find(|known| known.0 == name).map(|known| known.1);
        }
        let (column, what) = name.rsplit_once('.')?;
        let extremes = self.extremes.iter().find(|found| found.name == column)?;
        let ends = [extremes.least, extremes.greatest];
        end(ends.map(|end| (end.at, end.value)), what)
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
        let (_, unit, _, read) = CYCLE.iter().find(|known| known.0 == name)?;
        // Of several inputs there is no one driving force.
        read(cycle).filter(|_| unit.is_some() || self.several.is_none())
    }
}
