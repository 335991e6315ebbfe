//! The quantities of a position by name: what tables, files and plots show.

use super::Rests;
use super::row::{Forces, Row};
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
    fn new(
        name: impl Into<String>,
        unit: &str,
        figure: bool,
        read: impl Fn(&Row, &Forces) -> Option<f64> + 'static,
    ) -> Self {
        Self {
            name: name.into(),
            unit: unit.to_owned(),
            figure,
            indeterminate: false,
            rests: Vec::new(),
            read: Box::new(read),
        }
    }

    /// The same, reckoned from these forces.
    fn resting(mut self, rests: &[Rests]) -> Self {
        self.rests = rests.to_vec();
        self
    }

    /// Value at a position; `None` without forces, where it has none, or where it is
    /// statically indeterminate.
    pub fn value(&self, row: &Row) -> Option<f64> {
        let forces = row.forces.as_ref().ok().filter(|_| !self.indeterminate)?;
        (self.read)(row, forces)
    }
}

/// Units of a pair's coordinate and force.
pub(super) fn units(kind: &PairKind) -> [&'static str; 2] {
    match kind.slides() {
        true => ["m", "N"],
        false => ["rad", "N m"],
    }
}

/// All quantities of a linkage, in the order of tables.
pub fn columns(linkage: &LinkageSpec, output: Option<usize>) -> Vec<Column> {
    let [coordinate, force] = units(&linkage.pairs[linkage.driver].kind);
    let mut list = vec![
        Column::new("speed", &format!("{coordinate}/s"), false, |row, _| {
            Some(row.motion.speed)
        }),
        Column::new(
            "acceleration",
            &format!("{coordinate}/s²"),
            false,
            |row, _| Some(row.motion.acceleration),
        ),
        Column::new("drive", force, true, |_, forces| Some(forces.drive)).resting(&[Rests::Drive]),
    ];
    if let Some(output) = output {
        let kind = &linkage.outputs[output].kind;
        list.extend(of_output([coordinate, force], of_kind(kind, linkage)));
    }
    list.extend(of_joints(linkage));
    list.extend(of_power());
    list.extend(of_frame());
    list.extend(of_changes(linkage, force));
    if let Some(output) = output {
        let kind = &linkage.outputs[output].kind;
        let unit = over([force, of_kind(kind, linkage)[1]]);
        list.extend(of_ratio_changes(linkage, &unit));
    }
    list.push(solutions());
    list
}

/// All quantities of a linkage of several inputs, in the order of tables; `power.drive` is
/// that of all drivers together.
pub fn columns_of_inputs(spec: &MultiSpec) -> Vec<Column> {
    let linkage = &spec.linkage;
    let mut list = Vec::new();
    for (index, input) in spec.inputs.iter().enumerate() {
        let [coordinate, force] = match input.coordinate.slides(linkage) {
            true => ["m", "N"],
            false => ["rad", "N m"],
        };
        let mut add = |what: &str, unit: String, figure, read: fn(&Forces, usize) -> f64| {
            let name = match what {
                "drive" | "power" => format!("{what}.{}", input.name),
                _ => format!("{}.{what}", input.name),
            };
            list.push(Column::new(name, &unit, figure, move |_, f| {
                Some(read(f, index))
            }));
        };
        let unit = |per: &str| format!("{coordinate}{per}");
        add("displacement", unit(""), false, |f, k| {
            f.inputs[k].coordinate
        });
        add("speed", unit("/s"), false, |f, k| f.inputs[k].speed);
        add("acceleration", unit("/s²"), false, |f, k| {
            f.inputs[k].acceleration
        });
        add("drive", force.to_owned(), true, |f, k| f.drives[k]);
        add("power", "W".to_owned(), true, |f, k| {
            f.drives[k] * f.inputs[k].speed
        });
    }
    list.extend(of_joints(linkage));
    list.extend(of_power());
    list.extend(of_frame());
    list.push(solutions());
    list
}

fn solutions() -> Column {
    Column::new("solutions", "", false, |_, f| {
        Some(f.solved.solutions as f64)
    })
    .resting(&[Rests::Drive])
}

/// Units of an output's displacement and load.
fn of_kind(kind: &OutputKind, linkage: &LinkageSpec) -> [&'static str; 2] {
    match kind {
        OutputKind::Angle { .. } => ["rad", "N m"],
        OutputKind::Point { .. } => ["m", "N"],
        OutputKind::Pair { pair } => units(&linkage.pairs[*pair].kind),
    }
}

/// Unit of a quotient of forces or displacements.
fn over([above, below]: [&str; 2]) -> String {
    match [above, below] {
        ["N m", "N"] => "m".to_owned(),
        ["N", "N m"] => "1/m".to_owned(),
        _ if above == below => String::new(),
        _ => format!("{above}/{below}"),
    }
}

fn of_output(input: [&str; 2], output: [&str; 2]) -> [Column; 3] {
    let ratio = over([output[0], input[0]]);
    let chi = over([input[1], output[1]]);
    [
        Column::new("ratio", &ratio, true, |_, forces| {
            forces.transmission.map(|found| found.ratio)
        }),
        Column::new("load", output[1], false, |_, forces| {
            forces.transmission.and_then(|found| found.load)
        }),
        Column::new("chi", &chi, true, |_, forces| forces.chi).resting(&[Rests::Drive]),
    ]
}

/// What joins the links: pairs, welds, couplings.
fn of_joints(linkage: &LinkageSpec) -> Vec<Column> {
    let mut list = Vec::new();
    for (index, pair) in linkage.pairs.iter().enumerate() {
        list.extend(of_pair(index, &pair.name, &pair.kind));
    }
    for (index, weld) in linkage.welds.iter().enumerate() {
        list.extend(of_weld(index, &weld.name));
    }
    list.extend(of_couplings(linkage));
    list
}

fn of_pair(index: usize, name: &str, kind: &PairKind) -> Vec<Column> {
    let part = |what: &str| format!("{name}.{what}");
    let mut list = vec![
        Column::new(part("force"), "N", true, move |_, f| {
            Some(f.pairs[index].size())
        }),
        Column::new(part("x"), "N", false, move |_, f| {
            Some(f.pairs[index].force[0])
        }),
        Column::new(part("y"), "N", false, move |_, f| {
            Some(f.pairs[index].force[1])
        }),
    ];
    let friction = match kind {
        PairKind::Sliding { corners, .. } => {
            let given = corners[0] > corners[1];
            for corner in 0..if given { 2 } else { 0 } {
                let name = part(&format!("n{}", corner + 1));
                list.push(Column::new(name, "N", true, move |_, f| {
                    f.pairs[index].corners.map(|corners| corners[corner])
                }));
            }
            list.push(Column::new(part("couple"), "N m", false, move |_, f| {
                Some(f.pairs[index].couple)
            }));
            "N"
        }
        _ => "N m",
    };
    list.push(Column::new(
        part("friction"),
        friction,
        false,
        move |_, f| Some(f.pairs[index].friction),
    ));
    list.push(Column::new(part("loss"), "W", false, move |_, f| {
        Some(f.pairs[index].loss)
    }));
    let resting = |column: Column| column.resting(&[Rests::Pair(index)]);
    list.into_iter().map(resting).collect()
}

/// Force and couple of a weld, on its second link.
fn of_weld(index: usize, name: &str) -> [Column; 4] {
    let part = |what: &str| format!("{name}.{what}");
    let size = move |_: &Row, f: &Forces| {
        let [x, y] = f.welds[index].force;
        Some(x.hypot(y))
    };
    [
        Column::new(part("force"), "N", true, size),
        Column::new(part("x"), "N", false, move |_, f| {
            Some(f.welds[index].force[0])
        }),
        Column::new(part("y"), "N", false, move |_, f| {
            Some(f.welds[index].force[1])
        }),
        Column::new(part("couple"), "N m", true, move |_, f| {
            Some(f.welds[index].couple)
        }),
    ]
    .map(|column| column.resting(&[Rests::Weld(index)]))
}

/// Circumferential forces of gears, belts and racks, forces of cams.
fn of_couplings(linkage: &LinkageSpec) -> impl Iterator<Item = Column> {
    linkage
        .couplings
        .iter()
        .enumerate()
        .map(|(index, coupling)| {
            let name = format!("{}.force", coupling.name);
            let read = move |_: &Row, f: &Forces| Some(f.couplings[index].size);
            Column::new(name, "N", true, read).resting(&[Rests::Coupling(index)])
        })
}

fn of_power() -> Vec<Column> {
    vec![
        Column::new("power.drive", "W", true, |_, f| Some(f.balance.drive))
            .resting(&[Rests::Drive]),
        Column::new("power.weights", "W", false, |_, f| Some(f.balance.weights)),
        Column::new("power.forces", "W", false, |_, f| Some(f.balance.forces)),
        Column::new("power.inertia", "W", false, |_, f| Some(f.balance.inertia)),
        Column::new("power.loss", "W", true, |_, f| Some(f.balance.loss)).resting(&[Rests::Drive]),
        Column::new("power.residual", "", false, |_, f| Some(f.balance.residual))
            .resting(&[Rests::Drive]),
        Column::new("efficiency", "", true, |_, f| f.balance.efficiency).resting(&[Rests::Drive]),
    ]
}

fn of_frame() -> Vec<Column> {
    let mut list = Vec::new();
    for (name, read) in [
        ("shaking", (|f| f.shaking) as fn(&Forces) -> [f64; 3]),
        ("frame", |f| f.on_frame),
    ] {
        let part = |what: &str| format!("{name}.{what}");
        list.push(Column::new(part("force"), "N", true, move |_, f| {
            Some(read(f)[0].hypot(read(f)[1]))
        }));
        list.push(Column::new(part("x"), "N", false, move |_, f| {
            Some(read(f)[0])
        }));
        list.push(Column::new(part("y"), "N", false, move |_, f| {
            Some(read(f)[1])
        }));
        list.push(Column::new(part("moment"), "N m", true, move |_, f| {
            Some(read(f)[2])
        }));
    }
    list
}

/// Derivatives of the driving force.
fn of_changes(linkage: &LinkageSpec, force: &str) -> Vec<Column> {
    let mut list = Vec::new();
    for (index, pair) in linkage.pairs.iter().enumerate() {
        let name = format!("drive_by.{}.friction", pair.name);
        let change = Column::new(name, force, false, move |_, f| {
            f.sensitivities.as_ref().map(|found| found.friction[index])
        });
        list.push(change.resting(&[Rests::Drive, Rests::Pair(index)]));
    }
    for (index, link) in linkage.links.iter().enumerate() {
        let name = format!("drive_by.{}.mass", link.name);
        list.push(
            Column::new(name, &format!("{force}/kg"), false, move |_, f| {
                f.sensitivities.as_ref().map(|found| found.mass[index])
            })
            .resting(&[Rests::Drive]),
        );
        let name = format!("drive_by.{}.moment", link.name);
        list.push(
            Column::new(name, &format!("{force}/(kg m²)"), false, move |_, f| {
                f.sensitivities.as_ref().map(|found| found.moment[index])
            })
            .resting(&[Rests::Drive]),
        );
    }
    list
}

/// Derivatives of the dynamic transmission ratio: those of the driving force
/// over the load.
fn of_ratio_changes(linkage: &LinkageSpec, unit: &str) -> Vec<Column> {
    let per_mass = match unit {
        "" => "1/kg".to_owned(),
        unit => format!("{unit}/kg"),
    };
    let per_drive = |f: &Forces| {
        let found = f.transmission?;
        // χ is proportional to the driving force.
        found.dynamic_ratio(1.0, f.convention)
    };
    let mut list = Vec::new();
    for (index, pair) in linkage.pairs.iter().enumerate() {
        let name = format!("chi_by.{}.friction", pair.name);
        list.push(
            Column::new(name, unit, false, move |_, f| {
                Some(per_drive(f)? * f.sensitivities.as_ref()?.friction[index])
            })
            .resting(&[Rests::Drive, Rests::Pair(index)]),
        );
    }
    for (index, link) in linkage.links.iter().enumerate() {
        let name = format!("chi_by.{}.mass", link.name);
        list.push(
            Column::new(name, &per_mass, false, move |_, f| {
                Some(per_drive(f)? * f.sensitivities.as_ref()?.mass[index])
            })
            .resting(&[Rests::Drive]),
        );
    }
    list
}
