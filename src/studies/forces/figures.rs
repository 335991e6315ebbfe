//! Figures of a study by name, as a scene's expectations address them.

use super::{Column, Counterweight, CycleForces, Extremes, ForceStudy, columns, columns_of_inputs};
use crate::kinematics::linkage::multi::spec::MultiSpec;
use crate::kinematics::linkage::spec::LinkageSpec;
use crate::studies::kinematics::{DescribedFigure, NamedFigure};

/// A sum with its unit (`None`: that of the driving force) and its meaning.
type Sum = (&'static str, Option<&'static str>, &'static str);

/// Sums over the cycle.
#[rustfmt::skip]
const CYCLE: [Sum; 8] = [
    ("duration", Some("s"), "Duration of the course, > 0."),
    ("drive_work", Some("N m"), "Work of the driver, positive where it puts energy in."),
    ("load_work", Some("N m"), "Work of the load on the linkage, negative where it resists."),
    ("applied_work", Some("N m"), "Work of weights, springs, dampers and forces, the load included."),
    ("loss", Some("N m"), "Work lost to friction, ≥ 0."),
    ("efficiency", Some(""), "1 less the loss over the work put in; absent if the course is no cycle."),
    ("mean_drive", None, "Mean driving force over time; absent with several inputs."),
    ("rms_drive", None, "Root mean square of the driving force over time, ≥ 0; absent with several inputs."),
];
/// Results of the counterweight.
#[rustfmt::skip]
const COUNTERWEIGHT: [Sum; 6] = [
    ("mass_radius", Some("kg m"), "Mass times distance from the pivot of the best counterweight, ≥ 0."),
    ("angle", Some("rad"), "Direction of the counterweight from the pivot, in the frame of its link."),
    ("rms_without", Some("N"), "Root mean square of the shaking force without the counterweight, ≥ 0."),
    ("rms_with", Some("N"), "Root mean square of the shaking force with it, ≥ 0."),
    ("greatest_without", Some("N"), "Greatest shaking force without it, ≥ 0."),
    ("greatest_with", Some("N"), "Greatest shaking force with it, ≥ 0."),
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
pub fn described() -> Vec<DescribedFigure> {
    let mut all = Vec::new();
    for (name, units, meaning) in EXTREMES {
        all.push(DescribedFigure::new(&format!("{name}.END"), units, meaning));
    }
    for (owner, sums) in [("cycle", &CYCLE[..]), ("counterweight", &COUNTERWEIGHT[..])] {
        for (name, unit, meaning) in sums {
            let units: &[&str] = match unit {
                Some("") => &["1"],
                Some(unit) => &[*unit],
                None => DRIVE,
            };
            let address = format!("{owner}.{name}");
            all.push(DescribedFigure::new(&address, units, meaning));
        }
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
    let sum = |(name, unit, _): Sum, of: &str| {
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
    let sums = CYCLE.into_iter().filter_map(|(name, unit, _)| {
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

impl Counterweight {
    /// The figures with their names.
    pub fn figures(&self) -> [(&'static str, f64); 6] {
        let ([rms, rms_with], [greatest, greatest_with]) = (self.rms, self.greatest);
        let values = [
            self.mass_radius,
            self.angle,
            rms,
            rms_with,
            greatest,
            greatest_with,
        ];
        std::array::from_fn(|index| (COUNTERWEIGHT[index].0, values[index]))
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
