//! An output of a linkage of several inputs as a constraint on them.

use super::{MultiLinkage, MultiWorkspace};
use crate::kinematics::constraint::{ConstraintFunction, ConstraintJet};
use crate::math::number::{Dual, Number};
use std::fmt;
use std::sync::{Mutex, PoisonError};

/// An output of a linkage over its inputs. Angles go on continuously from one evaluation to
/// the next.
pub struct MultiOutput {
    linkage: MultiLinkage,
    output: usize,
    memory: Mutex<Memory>,
}

struct Memory {
    space: MultiWorkspace<Dual>,
    inputs: Vec<Dual>,
    rates: Vec<Dual>,
    first: Vec<Dual>,
}

impl fmt::Debug for MultiOutput {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = &self.linkage.outputs()[self.output].name;
        f.debug_struct("MultiOutput").field("name", name).finish()
    }
}

impl MultiOutput {
    /// The output of that index.
    pub fn new(linkage: &MultiLinkage, output: usize) -> Self {
        let zero = vec![Dual::default(); linkage.inputs().len()];
        let memory = Memory {
            space: linkage.workspace(),
            inputs: zero.clone(),
            rates: zero.clone(),
            first: zero,
        };
        Self {
            linkage: linkage.clone(),
            output,
            memory: Mutex::new(memory),
        }
    }
}

impl ConstraintFunction for MultiOutput {
    fn drivers(&self) -> usize {
        self.linkage.inputs().len()
    }

    fn jet(&self, displacements: &[f64], jet: &mut ConstraintJet) {
        let count = displacements.len();
        let kind = &self.linkage.outputs()[self.output].kind;
        let mut memory = self.memory.lock().unwrap_or_else(PoisonError::into_inner);
        let Memory {
            space,
            inputs,
            rates,
            first,
        } = &mut *memory;
        // With its derivative along input l the second derivative along rates v, vᵀHv: from
        // those along two inputs, and along each of them, the mixed ones follow.
        for l in 0..count {
            for (input, &value) in inputs.iter_mut().zip(displacements) {
                *input = Dual::from(value);
            }
            inputs[l].derivative = 1.0;
            let mut along = |i: usize, j: usize| -> Option<[Dual; 2]> {
                rates.fill(Dual::from(0.0));
                rates[i] = Dual::from(1.0);
                rates[j] = Dual::from(1.0);
                space.solve(inputs, rates).ok()?;
                Some(space.output(kind, first))
            };
            let unknown = [Dual::new(f64::NAN, f64::NAN); 2];
            for i in 0..count {
                let [value, own] = along(i, i).unwrap_or(unknown);
                jet.value = value.value;
                set(jet, [i, i, l], count, own);
                for j in 0..i {
                    let [_, other] = along(j, j).unwrap_or(unknown);
                    let [_, both] = along(i, j).unwrap_or(unknown);
                    let mixed = (both - own - other).scale(0.5);
                    set(jet, [i, j, l], count, mixed);
                    set(jet, [j, i, l], count, mixed);
                }
            }
            if along(l, l).is_none() {
                first.fill(Dual::new(f64::NAN, f64::NAN));
            }
            for (slot, first) in jet.first.iter_mut().zip(first.iter()) {
                *slot = first.value;
            }
        }
    }

    fn formula(&self, drivers: &[String]) -> String {
        let name = &self.linkage.outputs()[self.output].name;
        format!("{name}({})", drivers.join(", "))
    }
}

/// Notes a second derivative with its own by input l.
fn set(jet: &mut ConstraintJet, [i, j, l]: [usize; 3], count: usize, second: Dual) {
    jet.second[i * count + j] = second.value;
    jet.third[(i * count + j) * count + l] = second.derivative;
}
