//! Loads that are written as expressions: their force along a motion, and which of
//! their smooth pieces is in force.
//!
//! A load by an expression has *guards*, functions whose sign or whole part says which smooth
//! piece is in force. Their modes are components behind all others. A guard is no polynomial:
//! it is evaluated on bounds of the signals over the step and of their rates
//! (`math::expression::crossing`), halved until the bounds exclude a zero or prove a single
//! one. With the mode `OPEN` the expression reads its operands; so it is evaluated outside a
//! run.
//!
//! Limits: if a jump drives the motion back from both sides, the run stops (`held_at_jump`).

mod missing;
mod switches;

pub(super) use switches::Along;

use super::frozen::Frozen;
use super::passes::Work;
use super::taylor::HIGHEST;
use crate::dynamics::model::{LoadVariable, NodeIndex, WrittenLoad};
use crate::math::expression::{Expression, OPEN, SeriesProgram, VARIABLES};
use crate::math::quantity::Quantity;
use std::sync::Arc;

/// The series of such a load along a motion.
pub(super) type WrittenSeries = SeriesProgram<{ HIGHEST + 1 }>;

/// A load by an expression, frozen.
#[derive(Clone, Debug)]
pub(super) struct FrozenExpression {
    pub(super) expression: Arc<Expression>,
    /// Factor on its value.
    pub(super) factor: f64,
    /// Source of each of its variables.
    pub(super) inputs: Vec<Input>,
    /// Component of the modes of its first guard; the others follow.
    pub(super) component: usize,
    /// It may change so briefly with displacements or speeds that a step passes over it.
    pub(super) hides: bool,
    /// What it pulls back with per displacement of its own node, where it is linear in it.
    pub(super) rate: f64,
}

/// Source of a variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Input {
    /// It does not count.
    Unused,
    Time,
    /// φ of a node, with the signal that it is where a guard or a pole is looked for.
    Displacement {
        node: usize,
        signal: usize,
    },
    /// φ̇ of a node, likewise.
    Speed {
        node: usize,
        signal: usize,
    },
}

impl Input {
    /// The node whose motion it is.
    pub(super) fn node(self) -> Option<usize> {
        match self {
            Self::Unused | Self::Time => None,
            Self::Displacement { node, .. } | Self::Speed { node, .. } => Some(node),
        }
    }
}

impl FrozenExpression {
    /// Puts a load into the layout; signals are given to what its guards look at.
    pub(super) fn new(load: &WrittenLoad, node: NodeIndex, frozen: &mut Frozen) -> Self {
        let program = load.expression.program().clone();
        let poles = missing::may_have_poles(&program);
        let steep = super::narrow::may_hide(&program);
        let watched = |variable| {
            let mut guards = program.guards.iter();
            poles || steep || guards.any(|guard| guard.code.reads(variable))
        };
        let mut inputs = Vec::new();
        for (variable, source) in load.variables.iter().enumerate() {
            let mut place = |node: usize| {
                let node = frozen.internal[node];
                let signal = match watched(variable) {
                    true => frozen.signal(node),
                    false => usize::MAX,
                };
                (node, signal)
            };
            inputs.push(match *source {
                _ if !program.reads(variable) => Input::Unused,
                LoadVariable::Time => Input::Time,
                LoadVariable::Displacement(node) => {
                    let (node, signal) = place(node);
                    Input::Displacement { node, signal }
                }
                LoadVariable::Speed(node) => {
                    let (node, signal) = place(node);
                    Input::Speed { node, signal }
                }
            });
        }
        let component = frozen.first_guard() + frozen.guards;
        frozen.guards += program.guards.len();
        let hides = steep && inputs.iter().any(|input: &Input| input.node().is_some());
        Self {
            expression: load.expression.clone(),
            factor: load.factor,
            inputs,
            component,
            hides,
            rate: rate(load, node),
        }
    }

    /// The force.
    #[inline]
    pub(super) fn force<N: Quantity>(&self, time: N, modes: &[i64], work: &Work<N>) -> N {
        let values = self.values(time, &work.displacement, &work.speed);
        let code = &self.expression.program().value;
        let own = |guard: u16| modes[self.component + usize::from(guard)];
        let mut value = code.evaluate(&values, &own);
        if !value.value().is_finite() {
            // Beyond its edge a piece may have no value: the next one has.
            value = code.evaluate(&values, &|_| OPEN);
        }
        value.scale(self.factor)
    }

    /// The values of the variables.
    #[inline]
    fn values<N: Quantity>(&self, time: N, displacement: &[N], speed: &[N]) -> [N; VARIABLES] {
        let mut values = [N::from(0.0); VARIABLES];
        for (value, input) in values.iter_mut().zip(&self.inputs) {
            match *input {
                Input::Unused => {}
                Input::Time => *value = time,
                Input::Displacement { node, .. } => *value = displacement[node],
                Input::Speed { node, .. } => *value = speed[node],
            }
        }
        values
    }

    /// Room for its series.
    pub(super) fn series(&self) -> WrittenSeries {
        SeriesProgram::new(self.expression.program())
    }

    /// The force where its variables have these values.
    pub(super) fn at(&self, values: &[f64], modes: &[i64]) -> f64 {
        let modes = |guard: u16| modes[self.component + usize::from(guard)];
        self.factor * self.expression.program().value.evaluate(values, &modes)
    }

    /// What the rounding of its variables may change in the force.
    pub(super) fn rounding(&self, values: &[f64; VARIABLES], modes: &[i64]) -> f64 {
        let force = self.at(values, modes);
        let changes = (0..self.inputs.len()).map(|variable| {
            let mut moved = *values;
            moved[variable] *= 1.0 + ROUNDINGS * f64::EPSILON;
            (self.at(&moved, modes) - force).abs()
        });
        changes.sum()
    }

    /// True where it depends on time.
    pub(super) fn needs_time(&self) -> bool {
        self.inputs.contains(&Input::Time)
    }

    /// The nodes whose motion it looks at.
    pub(super) fn nodes(&self) -> impl Iterator<Item = usize> + '_ {
        self.inputs.iter().filter_map(|input| input.node())
    }

    /// About the greatest magnitude of the force while the motion of a node stays
    /// within ranges, tried at places spread over them.
    pub(super) fn magnitude(&self, ranges: impl Fn(usize) -> [f64; 2]) -> f64 {
        let mut greatest = 0.0f64;
        for place in 0..TRIED {
            let mut values = [0.0; VARIABLES];
            for (k, (value, input)) in values.iter_mut().zip(&self.inputs).enumerate() {
                // Shares without a common period.
                let share = (place as f64 * RATIOS[k]).fract();
                *value = match *input {
                    Input::Unused => 0.0,
                    Input::Time => LONG * share,
                    Input::Displacement { node, .. } => ranges(node)[0] * (2.0 * share - 1.0),
                    Input::Speed { node, .. } => ranges(node)[1] * (2.0 * share - 1.0),
                };
            }
            let force = self.factor * self.expression.at(&values);
            if force.is_finite() {
                greatest = greatest.max(force.abs());
            }
        }
        greatest
    }

    /// The force at order `order` of a series, from the motion up to it.
    pub(super) fn extend(
        &self,
        order: usize,
        modes: &[i64],
        of_input: impl Fn(Input) -> f64,
        series: &mut WrittenSeries,
    ) -> f64 {
        let modes = |guard: u16| modes[self.component + usize::from(guard)];
        let value = |variable: usize| of_input(self.inputs[variable]);
        self.factor * series.extend(order, value, &modes)
    }
}

/// What a load pulls back with per displacement of a node, where it is linear in it.
fn rate(load: &WrittenLoad, node: NodeIndex) -> f64 {
    let variables = load.variables.iter().enumerate();
    let own = variables.filter(|(index, variable)| {
        **variable == LoadVariable::Displacement(node) && load.expression.program().reads(*index)
    });
    let own: Vec<usize> = own.map(|(index, _)| index).collect();
    let linear = load.expression.affine_in(&own);
    linear.map_or(0.0, |linear| {
        -load.factor * linear.factors.iter().sum::<f64>()
    })
}

/// So many roundings a variable may be off by, a sum of the terms of a series.
const ROUNDINGS: f64 = 8.0;

/// Places at which the magnitude is tried.
const TRIED: usize = 64;

/// Time over which it is tried (s).
const LONG: f64 = 10.0;

/// Fractional parts of the square roots of primes.
const RATIOS: [f64; VARIABLES] = [
    0.414_213_562_373_095_1,
    0.732_050_807_568_877_2,
    0.236_067_977_499_789_7,
    0.645_751_311_064_590_6,
    0.316_624_790_355_399_8,
    0.605_551_275_463_989_3,
    0.123_105_625_617_660_5,
    0.358_898_943_540_673_5,
];
