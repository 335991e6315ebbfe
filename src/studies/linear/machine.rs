//! A machine in steady turning: a motor, shafts and gears of constant ratios, differentials.
//!
//! The angle through which the motor has turned does not count, and is no state. The states are
//! the twists u, each the deviation of a mass from what its driver asks for, then the speeds of
//! all rotors and masses. In the state of the system [u, u̇] the Jacobian is exact, by dual
//! numbers. With the speeds w = T·u̇, where T adds the speed of the driver times the ratio,
//!
//! u̇ = T⁻¹·w,  ẇ = T·(∂a/∂u·u + ∂a/∂u̇·T⁻¹·w).
//!
//! The steady motion is found by Newton's method from the speed at which a motor runs without
//! load, on the twists and the speeds of the motors.
//!
//! Limits: constant ratios on all ways, no linkages, nothing that depends on the angle or the
//! time. Contacts are closed.

use super::model::LeftOut;
use super::signals::Signal;
use super::state_space::{Linearisation, OperatingPoint, StateSpace};
use crate::dynamics::integrate::{Dynamics, Modes};
use crate::dynamics::model::{Load, LoadLaw, Model, NodeIndex, NodeMotion, ObjectPart};
use crate::dynamics::system::System;
use crate::fault::Fault;
use crate::kinematics::constraint::Constraint;
use nalgebra::{DMatrix, DVector};

/// Steps of Newton's method, and the relative size of the last one.
const STEPS: usize = 60;
const FOUND: f64 = 1e-13;

/// Whether a motor turns something in a model.
pub(super) fn has_motor(model: &Model) -> bool {
    let rotor =
        |node: &crate::dynamics::model::Node| matches!(node.motion, NodeMotion::Rotor { .. });
    model.nodes.iter().any(rotor)
}

/// The linear equations of a machine in steady turning.
///
/// # Errors
/// What in the machine is against it, at its object; there is no steady motion.
pub(super) fn linearise_machine(system: &System) -> Result<Linearisation, Vec<Fault>> {
    refuse(system)?;
    let machine = SteadyMachine::of(system);
    let steady = machine.steady_state()?;
    machine.refuse_angles(&steady)?;
    Ok(Linearisation {
        case: "machine in steady turning",
        validity: "valid for small disturbances of the steady turning, contacts closed".to_owned(),
        operating_point: machine.operating_point(&steady),
        state_space: machine.state_space(&steady)?,
        modes: Vec::new(),
        eigenvalues: Vec::new(),
        left_out: Vec::<LeftOut>::new(),
    }
    .with_eigenvalues())
}

/// What has no linear equations here.
fn refuse(system: &System) -> Result<(), Vec<Fault>> {
    let model = system.model();
    let mut faults = Vec::new();
    let mut refuse = |object: &str, reason: &str| {
        let message = format!("`{object}` has no linear equations: {reason}");
        let hint = "machines of a motor, shafts, gears and differentials have them";
        faults.push(Fault::new(object, message, hint));
    };
    for part in model.objects.iter().filter(|part| !part.is_inner()) {
        let node = part.nodes.first().map(|&node| &model.nodes[node].motion);
        let varies = part
            .nodes
            .iter()
            .any(|&node| model.has_variable_inertia(node));
        match node {
            _ if varies => refuse(&part.id, "its reduced inertia changes as it moves"),
            Some(NodeMotion::Prescribed { .. }) => {
                refuse(&part.id, "its motion is prescribed beside a motor");
            }
            Some(NodeMotion::Mass { law } | NodeMotion::Rigid { law })
                if law.position.straight_line().is_none() =>
            {
                refuse(&part.id, "its ratio changes as it moves");
            }
            Some(NodeMotion::Constrained {
                constraint: Constraint::Custom(_),
                ..
            }) => refuse(&part.id, "its inputs are combined by no linear function"),
            _ if part.contact.is_some() => {
                refuse(&part.id, "it has a contact element beside a motor");
            }
            _ => {}
        }
    }
    match faults.is_empty() {
        true => Ok(()),
        false => Err(faults),
    }
}

/// A machine whose ratios are constant.
struct SteadyMachine<'s> {
    system: &'s System,
    /// Coordinates of the motors' rotors, and all others.
    rotors: Vec<usize>,
    twists: Vec<usize>,
    /// T: absolute speed of each coordinate for a unit speed of each.
    speeds: DMatrix<f64>,
    modes: Modes,
}

impl<'s> SteadyMachine<'s> {
    fn of(system: &'s System) -> Self {
        let model = system.model();
        let n = system.coordinates();
        let rotor =
            |node: &NodeIndex| matches!(model.nodes[*node].motion, NodeMotion::Rotor { .. });
        let free = |node: &NodeIndex| system.coordinate_of(*node);
        let rotors: Vec<usize> = (0..model.nodes.len())
            .filter(rotor)
            .filter_map(|node| free(&node))
            .collect();
        let twists = (0..n).filter(|one| !rotors.contains(one)).collect();
        let rows = speed_rows(system);
        let mut speeds = DMatrix::identity(n, n);
        for (node, row) in rows.iter().enumerate() {
            if let Some(coordinate) = system.coordinate_of(node) {
                speeds.row_mut(coordinate).copy_from(&row.transpose());
            }
        }
        let modes = system.modes_at_start(&vec![0.0; 2 * n]);
        Self {
            system,
            rotors,
            twists,
            speeds,
            modes,
        }
    }

    fn coordinates(&self) -> usize {
        self.system.coordinates()
    }

    /// The accelerations at a state.
    fn accelerations(&self, system: &System, y: &[f64]) -> DVector<f64> {
        let n = self.coordinates();
        let mut rates = vec![0.0; 2 * n];
        system.derivatives(0.0, y, &self.modes, &mut system.scratch(), &mut rates);
        DVector::from_column_slice(&rates[n..])
    }

    /// Derivatives of the accelerations by the entries of the state, a column each.
    fn jacobian(&self, y: &[f64]) -> DMatrix<f64> {
        let n = self.coordinates();
        let mut scratch = self.system.scratch();
        let mut jacobian = DMatrix::zeros(n, 2 * n);
        let (mut direction, mut column) = (vec![0.0; 2 * n], vec![0.0; 2 * n]);
        for j in 0..2 * n {
            direction[j] = 1.0;
            self.system
                .tangent(0.0, y, &self.modes, &direction, &mut scratch, &mut column);
            direction[j] = 0.0;
            jacobian.column_mut(j).copy_from_slice(&column[n..]);
        }
        jacobian
    }

    /// Entries of the state that the steady motion decides: twists, and speeds of rotors.
    fn unknowns(&self) -> Vec<usize> {
        let n = self.coordinates();
        let rotors = self.rotors.iter().map(|rotor| n + rotor);
        self.twists.iter().copied().chain(rotors).collect()
    }

    /// The state of the steady motion, all twists at rest.
    fn steady_state(&self) -> Result<Vec<f64>, Vec<Fault>> {
        let n = self.coordinates();
        let unknowns = self.unknowns();
        let mut y = vec![0.0; 2 * n];
        self.start(&mut y);
        let none = |why: &str| {
            let message = format!("the machine has no steady turning: {why}");
            let hint = "the torque of its motor must fall with the speed, and exceed its loads";
            vec![Fault::new("", message, hint)]
        };
        for _ in 0..STEPS {
            let residual = self.accelerations(self.system, &y);
            let jacobian = self.jacobian(&y);
            let columns = DMatrix::from_fn(n, n, |i, j| jacobian[(i, unknowns[j])]);
            let step = columns.lu().solve(&residual);
            let step = step.filter(|step| step.iter().all(|own| own.is_finite()));
            let step = step.ok_or_else(|| none("no speed is distinguished from another"))?;
            let mut moved = 0.0f64;
            for (&place, own) in unknowns.iter().zip(step.iter()) {
                y[place] -= own;
                moved = moved.max(own.abs() / (y[place].abs() + own.abs() + f64::MIN_POSITIVE));
            }
            if moved <= FOUND {
                return Ok(y);
            }
        }
        // The last digits may go on changing: what is left of the accelerations decides.
        let left = self.accelerations(self.system, &y).amax();
        let size = (self.jacobian(&y) * DVector::from_column_slice(&y)).amax();
        match left <= 1e-9 * size.max(1e-300) {
            true => Ok(y),
            false => Err(none("Newton's method comes to none")),
        }
    }

    /// Motors at the speed at which they run without load, else at that of the start.
    fn start(&self, y: &mut [f64]) {
        let model = self.system.model();
        let n = self.coordinates();
        for (node, own) in model.nodes.iter().enumerate() {
            let NodeMotion::Rotor { speed, .. } = own.motion else {
                continue;
            };
            let loads = model.loads.iter().filter(|load| load.node == node);
            let free = loads.filter_map(|load| load.law.running_speed()).next();
            if let Some(coordinate) = self.system.coordinate_of(node) {
                y[n + coordinate] = free.unwrap_or(speed);
            }
        }
    }

    /// Refuses what depends on the angle of a motor, or on the time.
    fn refuse_angles(&self, y: &[f64]) -> Result<(), Vec<Fault>> {
        let jacobian = self.jacobian(y);
        let depends = |rotor: &&usize| jacobian.column(**rotor).amax() != 0.0;
        if let Some(&rotor) = self.rotors.iter().find(depends) {
            let name = self.system.state_name(rotor);
            let message =
                format!("the machine depends on an angle ({name}), so it does not turn steadily");
            let hint = "springs and weights on what turns, and loads over an angle, are against it";
            return Err(vec![Fault::new("", message, hint)]);
        }
        let n = self.coordinates();
        let mut rates = vec![0.0; 2 * n];
        let (system, modes) = (self.system, &self.modes);
        system.derivative_by_time(0.0, y, modes, &mut system.scratch(), &mut rates);
        match rates.iter().all(|rate| *rate == 0.0) {
            true => Ok(()),
            false => {
                let message = "the machine depends on the time, so it does not turn steadily";
                Err(vec![Fault::new(
                    "",
                    message,
                    "leave out loads over the time",
                )])
            }
        }
    }

    fn operating_point(&self, y: &[f64]) -> Vec<OperatingPoint> {
        let n = self.coordinates();
        let model = self.system.model();
        let speeds = &self.speeds * DVector::from_column_slice(&y[n..]);
        let mut all = Vec::new();
        for (object, part) in self.objects() {
            let Some(coordinate) = self.system.last_coordinate(object) else {
                continue;
            };
            let unit = model.objects[object].coordinate.unit();
            if self.twists.contains(&coordinate) {
                all.push(OperatingPoint::new(
                    format!("{}.delta", part.id),
                    unit,
                    y[coordinate],
                ));
            }
            let name = format!("{}.speed", part.id);
            all.push(OperatingPoint::new(
                name,
                &format!("{unit}/s"),
                speeds[coordinate],
            ));
        }
        all
    }

    /// The objects that loads act on: all that are named and move.
    fn objects(&self) -> impl Iterator<Item = (usize, &'s ObjectPart)> {
        let objects = self.system.model().objects.iter().enumerate();
        objects.filter(|(_, part)| !part.is_inner())
    }

    fn state_space(&self, y: &[f64]) -> Result<StateSpace, Vec<Fault>> {
        let n = self.coordinates();
        let m = self.twists.len();
        let jacobian = self.jacobian(y);
        let inverse = self.speeds.clone().try_inverse();
        let inverse =
            inverse.ok_or_else(|| vec![Fault::new("", "its ratios have no inverse", "")])?;
        let by_twist = DMatrix::from_fn(n, m, |i, j| jacobian[(i, self.twists[j])]);
        let by_speed = jacobian.columns(n, n) * &inverse;
        let mut a = DMatrix::zeros(m + n, m + n);
        for (row, &twist) in self.twists.iter().enumerate() {
            a.view_mut((row, m), (1, n)).copy_from(&inverse.row(twist));
        }
        a.view_mut((m, 0), (n, m))
            .copy_from(&(&self.speeds * by_twist));
        a.view_mut((m, m), (n, n))
            .copy_from(&(&self.speeds * by_speed));
        let (inputs, b) = self.inputs(y)?;
        let (outputs, c) = self.outputs(&inverse);
        Ok(StateSpace {
            states: self.states(),
            d: DMatrix::zeros(outputs.len(), inputs.len()),
            inputs,
            outputs,
            a,
            b,
            c,
            mass: None,
            damping: None,
            stiffness: None,
        })
    }

    fn states(&self) -> Vec<Signal> {
        let signal = |coordinate: usize, what: &str, per: &str| {
            let name = self.system.state_name(coordinate);
            let name = name
                .replace(": displacement", "")
                .replace(", mass ", ".mass_");
            let sliding = self.sliding(coordinate);
            let unit = if sliding { "m" } else { "rad" };
            Signal::new(format!("{name}.{what}"), &format!("{unit}{per}"))
        };
        let twists = self.twists.iter().map(|&own| signal(own, "deviation", ""));
        let speeds = (0..self.coordinates()).map(|own| signal(own, "speed", "/s"));
        twists.chain(speeds).collect()
    }

    fn sliding(&self, coordinate: usize) -> bool {
        let model = self.system.model();
        let mut parts = model.objects.iter();
        let own = parts.find(|part| {
            let mut nodes = part.nodes.iter();
            nodes.any(|&node| self.system.coordinate_of(node) == Some(coordinate))
        });
        own.is_some_and(|part| part.coordinate.unit() == "m")
    }

    /// Loads on the objects. Accelerations are linear in loads, so that the difference of two
    /// evaluations is exact to rounding.
    fn inputs(&self, y: &[f64]) -> Result<(Vec<Signal>, DMatrix<f64>), Vec<Fault>> {
        let (n, m) = (self.coordinates(), self.twists.len());
        let model = self.system.model();
        let without = self.accelerations(self.system, y);
        let (mut names, mut columns) = (Vec::new(), Vec::new());
        for (_, part) in self.objects() {
            let Some(&node) = part.nodes.last() else {
                continue;
            };
            let mut loaded = model.clone();
            loaded.loads.push(Load {
                node,
                name: "unit".to_owned(),
                law: LoadLaw::constant(1.0),
            });
            let with = self.accelerations(&System::new(loaded)?, y);
            names.push(Signal::new(
                format!("{}.load", part.id),
                part.coordinate.units()[1],
            ));
            columns.push(&self.speeds * (with - &without));
        }
        let mut b = DMatrix::zeros(m + n, columns.len());
        for (j, column) in columns.iter().enumerate() {
            b.view_mut((m, j), (n, 1)).copy_from(column);
        }
        Ok((names, b))
    }

    fn outputs(&self, inverse: &DMatrix<f64>) -> (Vec<Signal>, DMatrix<f64>) {
        let (n, m) = (self.coordinates(), self.twists.len());
        let model = self.system.model();
        let rows = speed_rows(self.system);
        let place = |coordinate: usize| self.twists.iter().position(|&own| own == coordinate);
        let (mut names, mut all) = (Vec::new(), Vec::new());
        for (object, part) in self.objects() {
            let [displacement, force] = part.coordinate.units();
            let mut add = |what: &str, unit: &str, row: DVector<f64>| {
                names.push(Signal::new(format!("{}.{what}", part.id), unit));
                all.push(row);
            };
            if let Some(twist) = self.system.last_coordinate(object).and_then(place) {
                let mut row = DVector::zeros(m + n);
                row[twist] = 1.0;
                add("delta", displacement, row);
            }
            if let Some(&node) = part.nodes.last() {
                let mut row = DVector::zeros(m + n);
                row.rows_mut(m, n)
                    .copy_from(&(inverse.transpose() * &rows[node]));
                add("speed", &format!("{displacement}/s"), row);
            }
            let link = part.links.first().map(|&link| &model.links[link]);
            let first = self.system.first_coordinate(object);
            if let (Some(link), Some(first), true) = (link, first, part.driven_end.is_none())
                && let Some(twist) = place(first)
            {
                let mut row = DVector::zeros(m + n);
                row[twist] = link.stiffness;
                let speeds = link.damping * inverse.row(first).transpose();
                row.rows_mut(m, n).copy_from(&speeds);
                add("reaction", force, row);
            }
        }
        let c = DMatrix::from_fn(all.len(), m + n, |i, j| all[i][j]);
        (names, c)
    }
}

/// The absolute speed of each node for a unit speed of each coordinate.
fn speed_rows(system: &System) -> Vec<DVector<f64>> {
    let model = system.model();
    let n = system.coordinates();
    let mut rows: Vec<DVector<f64>> = Vec::with_capacity(model.nodes.len());
    // Drivers stand before what they drive.
    for (node, own) in model.nodes.iter().enumerate() {
        let mut row = DVector::zeros(n);
        match &own.motion {
            NodeMotion::Prescribed { .. } | NodeMotion::Rotor { .. } => {}
            NodeMotion::Mass { law } | NodeMotion::Rigid { law } => {
                let slope = law.position.straight_line().map_or(0.0, |line| line[0]);
                row += &rows[law.driver] * (law.lever * slope);
            }
            NodeMotion::Constrained {
                drivers,
                constraint,
            } => {
                if let Constraint::Linear { ratios, .. } = constraint {
                    for (&driver, ratio) in drivers.iter().zip(ratios) {
                        row += &rows[driver] * *ratio;
                    }
                }
            }
        }
        if let Some(coordinate) = system.coordinate_of(node) {
            row[coordinate] += 1.0;
        }
        rows.push(row);
    }
    rows
}
