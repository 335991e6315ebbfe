//! Force laws of the library over the motion of the mass that they act on, one file each; those of contacts are
//! in [`contact`]. A law is declared
//! once: its properties, what it says in words and as a formula, and how it is calculated.
//! Reading, schema, checks, statements and printed equations follow from the declaration.
//!
//! The formula is a second form of the law, in the language of expressions: the check of a run
//! evaluates it instead of what the methods use.

pub mod contact;
mod friction;
mod kloss;
mod linear_motor;
mod parameter;
mod speed_table;
mod spring;
mod viscous;

pub use parameter::{Domain, Measure, Parameter};

pub(crate) use friction::FRICTION;
use linear_motor::{LINEAR_FORCE, LINEAR_TORQUE};
use speed_table::SpeedTable;
use spring::SPRING;

use super::model::LoadLaw;
use crate::fault::Faults;
use crate::math::expression::Expression;
use std::sync::Arc;

/// Laws of loads on masses, by their keys.
pub(crate) const OF_LOADS: [&ForceLaw; 3] = [&SPRING, &viscous::VISCOUS, &FRICTION];

/// Laws of the torque of a motor that turns.
pub(crate) const OF_TORQUES: [&ForceLaw; 2] = [&LINEAR_TORQUE, &kloss::KLOSS];

/// Laws of the force of a motor that slides.
pub(crate) const OF_FORCES: [&ForceLaw; 1] = [&LINEAR_FORCE];

/// The declaration of a law.
#[derive(Debug)]
pub struct ForceLaw {
    /// Its key in a scene.
    pub key: &'static str,
    /// What it is, for the schema.
    pub doc: &'static str,
    /// Its numbers, in their order.
    pub parameters: &'static [Parameter],
    /// The force over `phi`, `phi_dot` and the keys of the parameters, as an expression.
    pub formula: &'static str,
    /// A few words for tables, parameters by their keys in braces.
    pub words: &'static str,
    /// What it is calculated by, from the numbers.
    pub law: fn(&[f64]) -> LoadLaw,
}

impl ForceLaw {
    /// The name of a number in the formula and the words: its key, or that of a law that is this
    /// number alone.
    pub(crate) fn name_of(&self, parameter: &Parameter) -> &'static str {
        match parameter.key {
            "" => self.key,
            key => key,
        }
    }
}

/// A law with its numbers (SI units).
#[derive(Clone, Debug)]
pub struct LawInstance {
    /// The law.
    pub law: &'static ForceLaw,
    /// Its numbers, in their order.
    pub values: Vec<f64>,
}

/// A law is known by its key.
impl PartialEq for LawInstance {
    fn eq(&self, other: &Self) -> bool {
        self.law.key == other.law.key && self.values == other.values
    }
}

impl LawInstance {
    /// A law with its numbers.
    pub(crate) fn new(law: &'static ForceLaw, values: impl Into<Vec<f64>>) -> Self {
        let values = values.into();
        Self { law, values }
    }

    /// The numbers with what they are.
    pub(crate) fn parameters(&self) -> impl Iterator<Item = (&'static Parameter, f64)> + '_ {
        self.law.parameters.iter().zip(self.values.iter().copied())
    }

    /// Faults of the numbers, at their addresses below that of the load.
    pub(crate) fn check(&self, faults: &mut Faults) {
        for (parameter, value) in self.parameters() {
            let path = match parameter.key {
                "" => self.law.key.to_owned(),
                key => format!("{}.{key}", self.law.key),
            };
            parameter.check(faults, &path, value);
        }
    }

    /// True where its numbers are what they may be.
    pub(crate) fn is_possible(&self) -> bool {
        let mut faults = Faults::default();
        self.check(&mut faults);
        faults.check().is_ok()
    }

    /// What it is calculated by.
    pub fn law(&self) -> LoadLaw {
        (self.law.law)(&self.values)
    }

    /// The formula, over φ, φ̇ and the numbers; `None` for one that cannot be read, which the
    /// tests of all laws exclude.
    pub(crate) fn formula(&self) -> Option<Expression> {
        let own = ["phi", "phi_dot"].into_iter();
        let keys = (self.law.parameters.iter()).map(|own| self.law.name_of(own));
        let names: Vec<&str> = own.chain(keys).collect();
        Expression::new(self.law.formula, &names).ok()
    }
}

impl LawInstance {
    /// −preload − rate·φ.
    pub fn spring(rate: f64, preload: f64) -> Self {
        Self::new(&SPRING, [rate, preload])
    }

    /// −damping·φ̇.
    pub fn viscous(damping: f64) -> Self {
        Self::new(&viscous::VISCOUS, [damping])
    }

    /// −force·tanh(φ̇/width).
    pub fn friction(force: f64, width: f64) -> Self {
        Self::new(&FRICTION, [force, width])
    }

    /// The torque of a motor that falls with its speed: T₀·(1 − ω/ω₀).
    pub fn linear_motor(stall_torque: f64, no_load_speed: f64) -> Self {
        Self::new(&LINEAR_TORQUE, [stall_torque, no_load_speed])
    }

    /// The torque of an asynchronous motor: breakdown torque, breakdown slip, synchronous speed.
    pub fn kloss(numbers: [f64; 3]) -> Self {
        Self::new(&kloss::KLOSS, numbers)
    }
}

impl LoadLaw {
    /// A force over speed: straight between points, constant outside.
    pub fn speed_table(points: Vec<(f64, f64)>) -> Self {
        Self::of(Arc::new(SpeedTable(points)))
    }

    /// The declaration that it may be read by, and a factor on that; `None`: there is none.
    pub(crate) fn declared(&self) -> Option<(LawInstance, f64)> {
        match self {
            Self::Linear(own) => {
                let declared = match (own.running_speed(), own.rate == 0.0, own.damping == 0.0) {
                    (Some(_), ..) => LawInstance::linear_motor(own.force, own.force / own.damping),
                    (None, false, true) => LawInstance::spring(own.rate, -own.force),
                    (None, true, false) => LawInstance::viscous(own.damping),
                    _ => return None,
                };
                Some((declared, 1.0))
            }
            Self::Function { function, factor } => Some((function.declared()?, *factor)),
            Self::Pieces { .. } | Self::Stop(_) | Self::Written(_) | Self::Dry { .. } => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::number::Dual;

    /// Numbers at which a law is tried.
    fn tried(law: &'static ForceLaw) -> LawInstance {
        let value = |(at, own): (usize, &Parameter)| match own.domain {
            Domain::UpToOne => 0.2,
            _ => 3.0 + 2.0 * at as f64,
        };
        LawInstance::new(
            law,
            law.parameters
                .iter()
                .enumerate()
                .map(value)
                .collect::<Vec<f64>>(),
        )
    }

    fn all() -> Vec<LawInstance> {
        let laws = OF_LOADS.into_iter().chain(OF_TORQUES).chain(OF_FORCES);
        laws.map(tried).collect()
    }

    /// Force and slopes as the methods have them, at a motion.
    fn computed(law: &LoadLaw, [displacement, speed]: [f64; 2]) -> [f64; 3] {
        match law {
            LoadLaw::Linear(own) => [
                own.force - own.rate * displacement - own.damping * speed,
                -own.rate,
                -own.damping,
            ],
            LoadLaw::Function { function, factor } => {
                let force = function.force(displacement, speed);
                [force.value, force.by_displacement, force.by_speed].map(|own| own * factor)
            }
            LoadLaw::Pieces { .. }
            | LoadLaw::Stop(_)
            | LoadLaw::Written(_)
            | LoadLaw::Dry { .. } => {
                panic!("no law over the own motion")
            }
        }
    }

    #[test]
    fn the_formula_of_a_law_and_what_methods_use_agree_with_both_slopes() {
        for declared in all() {
            let formula = declared.formula().expect(declared.law.formula);
            let code = &formula.program().value;
            for motion in [[0.3, -2.0], [-1.5, 0.01], [0.0, 0.0], [2.0, 6.5]] {
                let of = |which: usize| {
                    let own = |k: usize| Dual::new(motion[k], f64::from(u8::from(k == which)));
                    let numbers = declared.values.iter().map(|value| Dual::from(*value));
                    let values: Vec<Dual> = [own(0), own(1)].into_iter().chain(numbers).collect();
                    code.evaluate(&values, &|_| crate::math::expression::OPEN)
                };
                let [value, by_displacement, by_speed] = computed(&declared.law(), motion);
                for (one, other) in [
                    (of(0).value, value),
                    (of(0).derivative, by_displacement),
                    (of(1).derivative, by_speed),
                ] {
                    let key = declared.law.key;
                    assert!(
                        (one - other).abs() <= 1e-12 * (1.0 + one.abs()),
                        "{key}: {one} {other}"
                    );
                }
            }
        }
    }

    #[test]
    fn the_series_of_a_law_is_that_of_its_force_along_a_motion() {
        let polynomial = |c: &[f64], s: f64| c.iter().rev().fold(0.0, |sum, c| sum * s + c);
        let (place, speed) = ([0.4, -0.3, 0.2, 0.1], [0.9, 0.5, -0.4, 0.3]);
        let mut padded = [[0.0; 25]; 2];
        padded[0][..4].copy_from_slice(&place);
        padded[1][..4].copy_from_slice(&speed);
        let mut seen = 0;
        for declared in all() {
            let LoadLaw::Function { function, .. } = declared.law() else {
                continue;
            };
            let mut series = function.series().expect("a series");
            series.begin(place[0], speed[0]);
            let mut force = vec![function.force(place[0], speed[0]).value];
            force.extend((1..=24).map(|order| series.advance(order, &padded[0], &padded[1])));
            for s in [0.05, 0.2] {
                let exact = function
                    .force(polynomial(&place, s), polynomial(&speed, s))
                    .value;
                assert!(
                    (polynomial(&force, s) - exact).abs() < 1e-10,
                    "{}",
                    declared.law.key
                );
            }
            seen += 1;
        }
        assert!(seen >= 2, "{seen} laws have a series");
    }
}
