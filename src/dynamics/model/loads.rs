//! Loads on nodes.

use super::{NodeIndex, Stop};
use crate::dynamics::load::LoadFunction;
use crate::math::expression::Expression;
use std::sync::Arc;

/// A load on a node. Positive forces act towards positive displacement.
#[derive(Clone, Debug)]
pub struct Load {
    /// Node that it acts on.
    pub node: NodeIndex,
    /// `object.loads.name`, for messages and equations.
    pub name: String,
    /// Law of the force.
    pub law: LoadLaw,
}

/// Force law of a load.
#[derive(Clone, Debug)]
pub enum LoadLaw {
    /// W.
    Constant(f64),
    /// Piecewise-linear in time or in a driver's displacement; the track
    /// selects the piece. Piece i is `value[i] + slope[i]·(x − start[i])`.
    Pieces {
        /// Index of the track whose piece counts.
        track: usize,
        /// Pieces, one for each of the track's.
        pieces: Vec<LinearPiece>,
    },
    /// −preload − rate·φ.
    Spring {
        /// Rate.
        rate: f64,
        /// Force at φ = 0, towards negative displacement.
        preload: f64,
    },
    /// −b·φ̇.
    Viscous(f64),
    /// −force·tanh(φ̇/width).
    Friction {
        /// Sliding friction.
        force: f64,
        /// Regularisation width (speed).
        width: f64,
    },
    /// T₀·(1 − ω/ω₀).
    LinearMotor {
        /// T₀.
        stall_torque: f64,
        /// ω₀.
        no_load_speed: f64,
    },
    /// Kloss: 2·T_b/(s/s_b + s_b/s), written without poles as 2·T_b·s·s_b/(s² + s_b²).
    Kloss {
        /// T_b.
        breakdown_torque: f64,
        /// s_b.
        breakdown_slip: f64,
        /// ω_s.
        synchronous_speed: f64,
    },
    /// Torque over speed, linear between the points, constant outside.
    SpeedTable(Vec<(f64, f64)>),
    /// A one-sided stop against the ground.
    Stop(Stop),
    /// An expression over time and motions.
    Written(WrittenLoad),
    /// `factor` times anything else over displacement and speed of the node.
    Custom {
        /// The force.
        function: Arc<dyn LoadFunction>,
        /// Factor on it.
        factor: f64,
    },
}

/// A force written as an expression.
#[derive(Clone, Debug, PartialEq)]
pub struct WrittenLoad {
    /// The expression.
    pub expression: Arc<Expression>,
    /// Factor on its value, which is then in N or N·m.
    pub factor: f64,
    /// What its variables are, in their order.
    pub variables: Vec<LoadVariable>,
}

/// A variable of a load by an expression.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LoadVariable {
    /// t (s).
    Time,
    /// φ of a node (rad or m).
    Displacement(NodeIndex),
    /// φ̇ of a node (rad/s or m/s).
    Speed(NodeIndex),
}

impl WrittenLoad {
    /// The nodes whose motion it looks at.
    pub fn nodes(&self) -> impl Iterator<Item = NodeIndex> + '_ {
        let read = |index: usize| self.expression.program().reads(index);
        let nodes = self.variables.iter().enumerate();
        nodes.filter_map(move |(index, variable)| match *variable {
            LoadVariable::Displacement(node) | LoadVariable::Speed(node) if read(index) => {
                Some(node)
            }
            _ => None,
        })
    }

    /// True where it looks at the time.
    pub fn needs_time(&self) -> bool {
        let mut variables = self.variables.iter().enumerate();
        variables.any(|(index, variable)| {
            *variable == LoadVariable::Time && self.expression.program().reads(index)
        })
    }

    /// True where it looks at a speed.
    pub fn needs_speed(&self) -> bool {
        let mut variables = self.variables.iter().enumerate();
        variables.any(|(index, variable)| {
            matches!(variable, LoadVariable::Speed(_)) && self.expression.program().reads(index)
        })
    }

    /// The force at a time, where `motion` gives φ and φ̇ of a node.
    pub fn force(&self, time: f64, motion: impl Fn(NodeIndex) -> (f64, f64)) -> f64 {
        let values: Vec<f64> = (self.variables.iter())
            .map(|variable| match *variable {
                LoadVariable::Time => time,
                LoadVariable::Displacement(node) => motion(node).0,
                LoadVariable::Speed(node) => motion(node).1,
            })
            .collect();
        self.factor * self.expression.at(&values)
    }
}

/// A straight piece of a table.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LinearPiece {
    /// Argument (of the first period) at which the force is `value`.
    pub start: f64,
    /// Force there.
    pub value: f64,
    /// Change of force per unit of the argument.
    pub slope: f64,
}
