//! The quantities of a position by name: what tables, files and plots show.

use super::Rests;
use super::row::{Forces, Row};
use crate::dynamics::model::Coordinate;
use crate::kinematics::linkage::multi::spec::MultiSpec;
use crate::kinematics::linkage::spec::{LinkageSpec, OutputKind, PairKind};

/// Reads a quantity from a position; `None` where it has no value.
type Read = Box<dyn Fn(&Row, &Forces) -> Option<f64>>;

/// A quantity of every position.
pub struct Column {
    /// Name: `R12.force`, `drive`, `chi`.
    pub name: String,
    /// SI unit; empty for a plain number.
    pub unit: String,
    /// True: its extremes are figures of the course.
    pub figure: bool,
    /// True where rigid links leave it open: it then has no values.
    pub indeterminate: bool,
    /// Forces that it is reckoned from.
    pub(super) rests: Vec<Rests>,
    read: Read,
}

impl Column {
    /// Value at a position; `None` without forces, where it has none, or where it is
    /// statically indeterminate.
    pub fn value(&self, row: &Row) -> Option<f64> {
        let forces = row.forces.as_ref().ok().filter(|_| !self.indeterminate)?;
        (self.read)(row, forces)
    }
}

/// Columns under way, each after those before it.
#[derive(Default)]
struct ColumnList {
    all: Vec<Column>,
    /// What the names of the next ones begin with, and the forces that they are reckoned from.
    prefix: String,
    rests: Vec<Rests>,
}

impl ColumnList {
    /// The next columns have this before their names and are reckoned from these forces.
    fn of(&mut self, prefix: impl Into<String>, rests: &[Rests]) -> &mut Self {
        self.prefix = prefix.into();
        self.rests = rests.to_vec();
        self
    }

    fn add(
        &mut self,
        name: &str,
        unit: &str,
        figure: bool,
        read: impl Fn(&Row, &Forces) -> Option<f64> + 'static,
    ) {
        self.all.push(Column {
            name: format!("{}{name}", self.prefix),
            unit: unit.to_owned(),
            figure,
            indeterminate: false,
            rests: self.rests.clone(),
            read: Box::new(read),
        });
    }

    /// A quantity whose extremes are figures of the course.
    fn figure(&mut self, name: &str, unit: &str, read: impl Fn(&Forces) -> f64 + 'static) {
        self.add(name, unit, true, move |_, forces| Some(read(forces)));
    }

    /// Any other quantity.
    fn add_quantity(&mut self, name: &str, unit: &str, read: impl Fn(&Forces) -> f64 + 'static) {
        self.add(name, unit, false, move |_, forces| Some(read(forces)));
    }
}

/// Units of a pair's coordinate and force.
pub(super) fn units(kind: &PairKind) -> [&'static str; 2] {
    Coordinate::sliding(kind.slides()).units()
}

/// All quantities of a linkage, in the order of tables.
pub fn columns(linkage: &LinkageSpec, output: Option<usize>) -> Vec<Column> {
    let input = units(&linkage.pairs[linkage.driver].kind);
    let output = output.map(|output| output_units(&linkage.outputs[output].kind, linkage));
    let [coordinate, force] = input;
    let mut list = ColumnList::default();
    let speed = |row: &Row, _: &Forces| Some(row.motion.speed);
    list.add("speed", &format!("{coordinate}/s"), false, speed);
    let acceleration = |row: &Row, _: &Forces| Some(row.motion.acceleration);
    list.add(
        "acceleration",
        &format!("{coordinate}/s²"),
        false,
        acceleration,
    );
    list.of("", &[Rests::Drive])
        .figure("drive", force, |f| f.drive);
    if let Some(output) = output {
        of_output(&mut list, input, output);
    }
    of_joints(&mut list, linkage);
    of_power(&mut list);
    of_frame(&mut list);
    of_changes(&mut list, linkage, force);
    if let Some([_, load]) = output {
        of_ratio_changes(&mut list, linkage, &quotient_unit([force, load]));
    }
    solutions(list)
}

/// All quantities of a linkage of several inputs, in the order of tables; `power.drive` is
/// that of all drivers together.
pub fn columns_of_inputs(spec: &MultiSpec) -> Vec<Column> {
    let linkage = &spec.linkage;
    let mut list = ColumnList::default();
    for (k, input) in spec.inputs.iter().enumerate() {
        let [unit, force] = Coordinate::sliding(input.coordinate.slides(linkage)).units();
        let name = &input.name;
        let own = list.of(format!("{name}."), &[]);
        own.add_quantity("displacement", unit, move |f| f.inputs[k].coordinate);
        own.add_quantity("speed", &format!("{unit}/s"), move |f| f.inputs[k].speed);
        let rate = format!("{unit}/s²");
        own.add_quantity("acceleration", &rate, move |f| f.inputs[k].acceleration);
        list.of("drive.", &[])
            .figure(name, force, move |f| f.drives[k]);
        let power = move |f: &Forces| f.drives[k] * f.inputs[k].speed;
        list.of("power.", &[]).figure(name, "W", power);
    }
    of_joints(&mut list, linkage);
    of_power(&mut list);
    of_frame(&mut list);
    solutions(list)
}

/// The list with the number of solutions behind it.
fn solutions(mut list: ColumnList) -> Vec<Column> {
    let last = list.of("", &[Rests::Drive]);
    last.add_quantity("solutions", "", |f| f.solved.solutions as f64);
    list.all
}

/// Units of an output's displacement and load.
fn output_units(kind: &OutputKind, linkage: &LinkageSpec) -> [&'static str; 2] {
    match kind {
        OutputKind::Angle { .. } => Coordinate::Turning.units(),
        OutputKind::Point { .. } => Coordinate::Sliding.units(),
        OutputKind::Pair { pair } => units(&linkage.pairs[*pair].kind),
    }
}

/// Unit of a quotient of forces or displacements.
fn quotient_unit([above, below]: [&str; 2]) -> String {
    match [above, below] {
        ["N m", "N"] => "m".to_owned(),
        ["N", "N m"] => "1/m".to_owned(),
        _ if above == below => String::new(),
        _ => format!("{above}/{below}"),
    }
}

fn of_output(list: &mut ColumnList, input: [&str; 2], output: [&str; 2]) {
    list.of("", &[]);
    let ratio = |_: &Row, f: &Forces| f.transmission.map(|found| found.ratio);
    list.add("ratio", &quotient_unit([output[0], input[0]]), true, ratio);
    let load = |_: &Row, f: &Forces| f.transmission.and_then(|found| found.load);
    list.add("load", output[1], false, load);
    let chi = list.of("", &[Rests::Drive]);
    chi.add(
        "chi",
        &quotient_unit([input[1], output[1]]),
        true,
        |_, f| f.chi,
    );
}

/// What joins the links: pairs, welds, couplings with their forces, which are circumferential
/// of gears, belts and racks.
fn of_joints(list: &mut ColumnList, linkage: &LinkageSpec) {
    for (index, pair) in linkage.pairs.iter().enumerate() {
        of_pair(list, index, &pair.name, &pair.kind);
    }
    for (index, weld) in linkage.welds.iter().enumerate() {
        // On its second link.
        let own = list.of(format!("{}.", weld.name), &[Rests::Weld(index)]);
        own.figure("force", "N", move |f| {
            let [x, y] = f.welds[index].force;
            x.hypot(y)
        });
        own.add_quantity("x", "N", move |f| f.welds[index].force[0]);
        own.add_quantity("y", "N", move |f| f.welds[index].force[1]);
        own.add("direction", "rad", false, move |_, f| {
            direction(f.welds[index].force)
        });
        own.figure("couple", "N m", move |f| f.welds[index].couple);
    }
    for (index, coupling) in linkage.couplings.iter().enumerate() {
        let own = list.of(format!("{}.", coupling.name), &[Rests::Coupling(index)]);
        own.figure("force", "N", move |f| f.couplings[index].size);
    }
}

/// Direction of a force, counterclockwise from x (rad, −π to π); no force has none.
fn direction([x, y]: [f64; 2]) -> Option<f64> {
    (x != 0.0 || y != 0.0).then(|| y.atan2(x))
}

fn of_pair(list: &mut ColumnList, index: usize, name: &str, kind: &PairKind) {
    let own = list.of(format!("{name}."), &[Rests::Pair(index)]);
    own.figure("force", "N", move |f| f.pairs[index].greatest_force());
    own.add_quantity("x", "N", move |f| f.pairs[index].force[0]);
    own.add_quantity("y", "N", move |f| f.pairs[index].force[1]);
    own.add("direction", "rad", false, move |_, f| {
        direction(f.pairs[index].force)
    });
    let mut friction = "N m";
    if let PairKind::Sliding { corners, .. } = kind {
        let given = corners[0] > corners[1];
        for corner in 0..if given { 2 } else { 0 } {
            let force = move |_: &Row, f: &Forces| f.pairs[index].corners.map(|two| two[corner]);
            own.add(&format!("n{}", corner + 1), "N", true, force);
        }
        own.add_quantity("couple", "N m", move |f| f.pairs[index].couple);
        friction = "N";
    }
    own.add_quantity("friction", friction, move |f| f.pairs[index].friction);
    own.add_quantity("loss", "W", move |f| f.pairs[index].loss);
}

fn of_power(list: &mut ColumnList) {
    let drive = &[Rests::Drive];
    list.of("power.", drive)
        .figure("drive", "W", |f| f.balance.drive);
    let given = list.of("power.", &[]);
    given.add_quantity("weights", "W", |f| f.balance.weights);
    given.add_quantity("forces", "W", |f| f.balance.forces);
    given.add_quantity("inertia", "W", |f| f.balance.inertia);
    let rest = list.of("power.", drive);
    rest.figure("loss", "W", |f| f.balance.loss);
    rest.add_quantity("residual", "", |f| f.balance.residual);
    list.of("", drive)
        .add("efficiency", "", true, |_, f| f.balance.efficiency);
}

fn of_frame(list: &mut ColumnList) {
    for (name, read) in [
        ("shaking", (|f| f.shaking) as fn(&Forces) -> [f64; 3]),
        ("frame", |f| f.on_frame),
    ] {
        let own = list.of(format!("{name}."), &[]);
        own.figure("force", "N", move |f| read(f)[0].hypot(read(f)[1]));
        own.add_quantity("x", "N", move |f| read(f)[0]);
        own.add_quantity("y", "N", move |f| read(f)[1]);
        own.figure("moment", "N m", move |f| read(f)[2]);
    }
}

/// Derivatives of the driving force.
fn of_changes(list: &mut ColumnList, linkage: &LinkageSpec, force: &str) {
    for (k, pair) in linkage.pairs.iter().enumerate() {
        let own = list.of(
            format!("drive_by.{}.", pair.name),
            &[Rests::Drive, Rests::Pair(k)],
        );
        let change = move |_: &Row, f: &Forces| Some(f.sensitivities.as_ref()?.friction[k]);
        own.add("friction", force, false, change);
    }
    for (k, link) in linkage.links.iter().enumerate() {
        let own = list.of(format!("drive_by.{}.", link.name), &[Rests::Drive]);
        let change = move |_: &Row, f: &Forces| Some(f.sensitivities.as_ref()?.mass[k]);
        own.add("mass", &format!("{force}/kg"), false, change);
        let change = move |_: &Row, f: &Forces| Some(f.sensitivities.as_ref()?.moment[k]);
        own.add("moment", &format!("{force}/(kg m²)"), false, change);
    }
}

/// Derivatives of the dynamic transmission ratio: those of the driving force
/// over the load.
fn of_ratio_changes(list: &mut ColumnList, linkage: &LinkageSpec, unit: &str) {
    let per_mass = match unit {
        "" => "1/kg".to_owned(),
        unit => format!("{unit}/kg"),
    };
    // χ is proportional to the driving force.
    let per_drive = |f: &Forces| f.transmission?.dynamic_ratio(1.0, f.convention);
    for (k, pair) in linkage.pairs.iter().enumerate() {
        let own = list.of(
            format!("chi_by.{}.", pair.name),
            &[Rests::Drive, Rests::Pair(k)],
        );
        let change =
            move |_: &Row, f: &Forces| Some(per_drive(f)? * f.sensitivities.as_ref()?.friction[k]);
        own.add("friction", unit, false, change);
    }
    for (k, link) in linkage.links.iter().enumerate() {
        let own = list.of(format!("chi_by.{}.", link.name), &[Rests::Drive]);
        let change =
            move |_: &Row, f: &Forces| Some(per_drive(f)? * f.sensitivities.as_ref()?.mass[k]);
        own.add("mass", &per_mass, false, change);
    }
}
