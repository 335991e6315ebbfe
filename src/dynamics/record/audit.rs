//! Works and energies of a step, from powers at places within it.

use super::peaks::WEIGHTS;
use crate::dynamics::energy::EnergyAudit;
use crate::dynamics::integrate::Impact;
use crate::dynamics::system::{Energy, Power};

/// Places of a step whose powers count in the balance.
pub(crate) const WEIGHTED: std::ops::RangeInclusive<usize> = 1..=5;

/// Collects the works of a step; knows the energies at its start.
#[derive(Clone, Debug, Default)]
pub(crate) struct Ledger {
    step: EnergyAudit,
    /// Kinetic and elastic energy at the end of the last step.
    energy: f64,
}

impl Ledger {
    /// The energy at the start.
    pub(crate) fn start_energy(&mut self, energy: Energy) {
        self.energy = energy.kinetic + energy.elastic;
        self.step.greatest = [energy.kinetic, energy.elastic];
    }

    /// The step ends with an energy: its works, and those of the start with the first.
    pub(crate) fn close_step(&mut self, energy: Energy) -> EnergyAudit {
        let total = energy.kinetic + energy.elastic;
        let mut step = std::mem::take(&mut self.step);
        step.change = total - self.energy;
        step.greatest[0] = step.greatest[0].max(energy.kinetic);
        step.greatest[1] = step.greatest[1].max(energy.elastic);
        self.energy = total;
        step
    }

    /// An impact at which the energy of the speeds before it becomes that of those after it.
    pub(crate) fn add_impact(&mut self, impact: &Impact, after: Energy) -> EnergyAudit {
        let step = &mut self.step;
        step.drives += impact.drives;
        step.put_in[0] += impact.drives.max(0.0);
        step.impacts += impact.lost;
        self.close_step(after)
    }

    /// Power at place `index` of [`super::peaks::PLACES`] in a step of `span` seconds.
    pub(crate) fn add(&mut self, index: usize, span: f64, power: Power) {
        let weight = WEIGHTS[index] * span;
        let step = &mut self.step;
        step.drives += weight * power.drives;
        step.loads += weight * power.loads;
        step.dissipated += weight * power.dissipated;
        step.friction += weight * power.friction;
        step.put_in[0] += weight * power.drives.max(0.0);
        step.put_in[1] += weight * power.loads.max(0.0);
    }
}

#[cfg(test)]
mod tests {
    use super::Ledger;
    use crate::dynamics::energy::EnergyAudit;
    use crate::dynamics::record::peaks::PLACES;
    use crate::dynamics::system::{Energy, Power};

    /// A unit mass on a unit spring with a damper, driven by cos t: x = sin(t)/b.
    fn audit_of(damping: f64, fault: f64) -> EnergyAudit {
        let (x, v) = (|t: f64| t.sin() / damping, |t: f64| t.cos() / damping);
        let energy = |t: f64| Energy {
            kinetic: 0.5 * v(t) * v(t),
            elastic: 0.5 * x(t) * x(t),
        };
        let (mut ledger, mut audit) = (Ledger::default(), EnergyAudit::default());
        ledger.start_energy(energy(0.0));
        let (steps, span) = (40, 0.25);
        for step in 0..steps {
            for (index, place) in PLACES.iter().enumerate().take(6).skip(1) {
                let t = span * (f64::from(step) + place);
                let power = Power {
                    drives: 0.0,
                    loads: t.cos() * v(t),
                    dissipated: (damping + fault) * v(t) * v(t),
                    friction: 0.0,
                };
                ledger.add(index, span, power);
            }
            audit.append(&ledger.close_step(energy(span * f64::from(step + 1))));
        }
        audit
    }

    #[test]
    fn a_true_motion_balances_to_rounding() {
        let audit = audit_of(0.4, 0.0);
        assert!(audit.error() < 1e-13, "{audit:?}");
        assert!(audit.dissipated > 1.0);
    }

    #[test]
    fn a_wrong_damper_is_noticed() {
        let audit = audit_of(0.4, 0.004);
        approx::assert_abs_diff_eq!(audit.error(), 0.01, epsilon = 1e-3);
    }
}
