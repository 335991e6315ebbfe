//! State space and second-order equations of a linear model.

use super::model::{LeftOut, LinearModel, NamedObject};
use super::modes::TreeModes;
use super::signals::{InputSignal, Signal};
use nalgebra::DMatrix;
use serde::Serialize;

/// The linear equations of a scene.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Linearisation {
    /// What was linearised: `chain behind a prescribed drive`, or `machine in steady turning`.
    pub case: &'static str,
    /// When the equations hold.
    pub validity: String,
    /// State space, and mass, damping and stiffness matrices.
    #[serde(flatten)]
    pub state_space: StateSpace,
    /// State about which a machine was linearised: speeds and deviations. Empty behind a
    /// prescribed drive, where the equations do not depend on it.
    pub operating_point: Vec<OperatingPoint>,
    /// Natural modes of each tree of masses; none of a machine behind a motor.
    pub modes: Vec<TreeModes>,
    /// Eigenvalues of A with an imaginary part ≥ 0 (1/s), least modulus first.
    pub eigenvalues: Vec<[f64; 2]>,
    /// Objects without linear equations, with the reason.
    pub left_out: Vec<LeftOut>,
}

/// A quantity at the operating point.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct OperatingPoint {
    /// Name: `motor.speed`.
    pub name: String,
    /// SI unit.
    pub unit: String,
    /// Value.
    pub value: f64,
}

impl OperatingPoint {
    pub(super) fn new(name: String, unit: &str, value: f64) -> Self {
        Self {
            name,
            unit: unit.to_owned(),
            value,
        }
    }
}

/// ẋ = A·x + B·u, y = C·x + D·u, with x = [q, q̇], in SI units.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StateSpace {
    /// States: the deviation of each mass from the rigid mechanism, then its speed.
    pub states: Vec<Signal>,
    /// Inputs: of each tree its law, the speed and the acceleration of the law; then loads.
    pub inputs: Vec<Signal>,
    /// Outputs.
    pub outputs: Vec<Signal>,
    /// A, states × states.
    #[serde(rename = "A", serialize_with = "as_rows")]
    pub a: DMatrix<f64>,
    /// B, states × inputs.
    #[serde(rename = "B", serialize_with = "as_rows")]
    pub b: DMatrix<f64>,
    /// C, outputs × states.
    #[serde(rename = "C", serialize_with = "as_rows")]
    pub c: DMatrix<f64>,
    /// D, outputs × inputs.
    #[serde(rename = "D", serialize_with = "as_rows")]
    pub d: DMatrix<f64>,
    /// Mass matrix of the deviations, diagonal; null of a machine.
    #[serde(serialize_with = "as_rows_if_known")]
    pub mass: Option<DMatrix<f64>>,
    /// Damping matrix of the deviations; null of a machine.
    #[serde(serialize_with = "as_rows_if_known")]
    pub damping: Option<DMatrix<f64>>,
    /// Stiffness matrix of the deviations; null of a machine.
    #[serde(serialize_with = "as_rows_if_known")]
    pub stiffness: Option<DMatrix<f64>>,
}

/// A matrix as a list of its rows.
fn as_rows<S: serde::Serializer>(matrix: &DMatrix<f64>, into: S) -> Result<S::Ok, S::Error> {
    let row = |i: usize| matrix.row(i).iter().copied().collect::<Vec<f64>>();
    into.collect_seq((0..matrix.nrows()).map(row))
}

/// A matrix as a list of its rows, where there is one.
fn as_rows_if_known<S: serde::Serializer>(
    matrix: &Option<DMatrix<f64>>,
    into: S,
) -> Result<S::Ok, S::Error> {
    match matrix {
        Some(matrix) => as_rows(matrix, into),
        None => into.serialize_none(),
    }
}

impl Linearisation {
    /// With the eigenvalues: the poles of the trees, else those of A.
    pub(super) fn with_eigenvalues(mut self) -> Self {
        let mut all: Vec<[f64; 2]> = match self.modes.is_empty() {
            false => self
                .modes
                .iter()
                .flat_map(|tree| tree.poles.clone())
                .collect(),
            true => {
                let values = self.state_space.a.complex_eigenvalues();
                let upper = values.iter().filter(|value| value.im >= 0.0);
                upper.map(|value| [value.re, value.im]).collect()
            }
        };
        all.sort_by(|a, b| a[0].hypot(a[1]).total_cmp(&b[0].hypot(b[1])));
        self.eigenvalues = all;
        self
    }
}

impl StateSpace {
    /// The state space of a linear model.
    pub fn of(model: &LinearModel) -> Self {
        let n = model.masses();
        let (mut stiffness, mut damping) = (DMatrix::zeros(n, n), DMatrix::zeros(n, n));
        let mut mass = DMatrix::zeros(n, n);
        let mut first_of_tree = Vec::new();
        let mut first = 0;
        for tree in &model.trees {
            let own = tree.equations.masses();
            let [k, b] = tree.equations.stiffness_and_damping();
            stiffness.view_mut((first, first), (own, own)).copy_from(&k);
            damping.view_mut((first, first), (own, own)).copy_from(&b);
            for (i, inertia) in tree.equations.inertias().into_iter().enumerate() {
                mass[(first + i, first + i)] = inertia;
            }
            first_of_tree.push(first);
            first += own;
        }
        let mut a = DMatrix::zeros(2 * n, 2 * n);
        for i in 0..n {
            a[(i, n + i)] = 1.0;
            for j in 0..n {
                a[(n + i, j)] = -stiffness[(i, j)] / mass[(i, i)];
                a[(n + i, n + j)] = -damping[(i, j)] / mass[(i, i)];
            }
        }
        let mut inputs = Vec::new();
        let mut columns: Vec<InputColumn> = Vec::new();
        for input in model.inputs() {
            let first = first_of_tree[input.tree];
            columns.extend(InputColumn::all_of(&input, model, first, &mut inputs));
        }
        let outputs = model.outputs();
        let mut b = DMatrix::zeros(2 * n, columns.len());
        let mut c = DMatrix::zeros(outputs.len(), 2 * n);
        let mut d = DMatrix::zeros(outputs.len(), columns.len());
        for (j, column) in columns.iter().enumerate() {
            for &(mass, acceleration) in &column.accelerations {
                b[(n + mass, j)] = acceleration;
            }
        }
        for (i, output) in outputs.iter().enumerate() {
            let first = first_of_tree[output.tree];
            for &(mass, [place, speed]) in &output.row.terms {
                c[(i, first + mass)] += place;
                c[(i, n + first + mass)] += speed;
            }
            for (j, column) in columns.iter().enumerate() {
                if let Some(order) = column.law.filter(|_| column.tree == output.tree) {
                    d[(i, j)] = output.row.law[order];
                }
            }
        }
        Self {
            states: states(model),
            inputs,
            outputs: outputs.into_iter().map(|output| output.signal).collect(),
            a,
            b,
            c,
            d,
            mass: Some(mass),
            damping: Some(damping),
            stiffness: Some(stiffness),
        }
    }
}

/// An input column: the accelerations of masses that a unit of it gives.
struct InputColumn {
    tree: usize,
    /// Order of the derivative of the law; `None`: a load.
    law: Option<usize>,
    accelerations: Vec<(usize, f64)>,
}

impl InputColumn {
    /// The columns of an input, whose names go into `names`: of a law three, of a load one.
    fn all_of(
        input: &InputSignal,
        model: &LinearModel,
        first: usize,
        names: &mut Vec<Signal>,
    ) -> Vec<Self> {
        let tree = &model.trees[input.tree].equations;
        let inertias = tree.inertias();
        if let Some(mass) = input.mass {
            names.push(input.signal.clone());
            return vec![Self {
                tree: input.tree,
                law: None,
                accelerations: vec![(first + mass, 1.0 / inertias[mass])],
            }];
        }
        let derivative = |order: usize| {
            let acceleration = |(mass, ratio): (usize, &f64)| {
                let [spring, damper] = tree.ground(mass);
                let factor = [spring, damper, inertias[mass]][order] / inertias[mass];
                (first + mass, -factor * ratio)
            };
            let masses = tree.ratios().iter().enumerate();
            Self {
                tree: input.tree,
                law: Some(order),
                accelerations: masses.map(acceleration).collect(),
            }
        };
        let Signal { name, unit } = &input.signal;
        names.push(input.signal.clone());
        names.push(Signal::new(format!("{name}_speed"), &format!("{unit}/s")));
        names.push(Signal::new(
            format!("{name}_acceleration"),
            &format!("{unit}/s^2"),
        ));
        (0..3).map(derivative).collect()
    }
}

/// Names of the states: deviations, then their speeds.
fn states(model: &LinearModel) -> Vec<Signal> {
    let objects = || model.trees.iter().flat_map(|tree| &tree.objects);
    let all = |what: &str, per: &str| -> Vec<Signal> {
        let of_object = |object: &NamedObject| {
            let unit = format!("{}{per}", object.units[0]);
            let masses = object.mass_names().into_iter();
            let signals = masses.map(|name| Signal::new(format!("{name}.{what}"), &unit));
            signals.collect::<Vec<_>>()
        };
        objects().flat_map(of_object).collect()
    };
    let mut states = all("deviation", "");
    states.extend(all("deviation_speed", "/s"));
    states
}

impl NamedObject {
    /// Names of its masses: `rocker` of one, `rocker.mass_1` and so on of several.
    pub(super) fn mass_names(&self) -> Vec<String> {
        match self.masses.len() {
            1 => vec![self.id.clone()],
            count => (1..=count)
                .map(|m| format!("{}.mass_{m}", self.id))
                .collect(),
        }
    }
}
