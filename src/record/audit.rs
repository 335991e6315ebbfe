//! The energy audit: does what went in equal what is there and what was lost?

use super::peaks::WEIGHTS;
use crate::system::{Energy, Power};

/// Places of a step whose powers count in the balance.
pub(crate) const WEIGHTED: std::ops::RangeInclusive<usize> = 1..=5;

/// The part of the greatest elastic energy that the balance is never measured
/// against less than: a mechanism at rest under load has a balance of rounding
/// errors only.
const ELASTIC_SHARE: f64 = 1e-6;

/// The energies of a run (J).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EnergyAudit {
    /// Work of the prescribed drives on the mechanism.
    pub drives: f64,
    /// Work of all loads, motors and springs included.
    pub loads: f64,
    /// Energy lost in links and pairs.
    pub dissipated: f64,
    /// Energy lost to friction in the joints of linkages.
    pub friction: f64,
    /// Kinetic and elastic energy at the end less that at the start.
    pub change: f64,
    /// What the balance is measured against: the greatest of the work put in
    /// by drives, that put in by loads (positive powers only), the greatest
    /// kinetic energy, and a millionth of the greatest elastic energy.
    pub scale: f64,
}

impl EnergyAudit {
    /// |drives + loads − change − dissipated − friction| / scale; 0 when nothing moved.
    pub fn error(&self) -> f64 {
        let lost = self.dissipated + self.friction;
        let difference = (self.drives + self.loads - self.change - lost).abs();
        if difference == 0.0 {
            0.0
        } else {
            difference / self.scale
        }
    }

    /// The error above which a run with this tolerance is not to be trusted:
    /// 30 × tolerance + 1e-10, at most 1 %. Runs that are right stay below some
    /// 7 × tolerance, rounding and quadrature below 1e-10 (measured on the rocker
    /// with one and two masses, damped and not, with lift-off and gap).
    pub fn bound(tolerance: f64) -> f64 {
        (30.0 * tolerance + 1e-10).min(0.01)
    }
}

/// Collects the energies step by step.
#[derive(Clone, Debug, Default)]
pub(crate) struct Ledger {
    work: Power,
    /// Work put in by drives and by loads, positive powers only.
    put_in: [f64; 2],
    start: f64,
    end: f64,
    greatest: Energy,
}

impl Ledger {
    /// The energy at the start.
    pub(crate) fn open(&mut self, energy: Energy) {
        self.start = energy.kinetic + energy.elastic;
        self.see(energy);
    }

    /// The energy at the end of a step.
    pub(crate) fn see(&mut self, energy: Energy) {
        self.end = energy.kinetic + energy.elastic;
        self.greatest.kinetic = self.greatest.kinetic.max(energy.kinetic);
        self.greatest.elastic = self.greatest.elastic.max(energy.elastic);
    }

    /// Power at place `index` of [`super::peaks::PLACES`] in a step of `span` seconds.
    pub(crate) fn add(&mut self, index: usize, span: f64, power: Power) {
        let weight = WEIGHTS[index] * span;
        self.work.drives += weight * power.drives;
        self.work.loads += weight * power.loads;
        self.work.dissipated += weight * power.dissipated;
        self.work.friction += weight * power.friction;
        self.put_in[0] += weight * power.drives.max(0.0);
        self.put_in[1] += weight * power.loads.max(0.0);
    }

    /// The balance.
    pub(crate) fn close(&self) -> EnergyAudit {
        let scale = [
            self.put_in[0],
            self.put_in[1],
            self.greatest.kinetic,
            ELASTIC_SHARE * self.greatest.elastic,
        ];
        EnergyAudit {
            drives: self.work.drives,
            loads: self.work.loads,
            dissipated: self.work.dissipated,
            friction: self.work.friction,
            change: self.end - self.start,
            scale: scale.into_iter().fold(0.0, f64::max),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{EnergyAudit, Ledger};
    use crate::record::peaks::PLACES;
    use crate::system::{Energy, Power};

    /// A unit mass on a unit spring with a damper, driven by cos t: x = sin(t)/b.
    fn audit_of(damping: f64, fault: f64) -> EnergyAudit {
        let (x, v) = (|t: f64| t.sin() / damping, |t: f64| t.cos() / damping);
        let energy = |t: f64| Energy {
            kinetic: 0.5 * v(t) * v(t),
            elastic: 0.5 * x(t) * x(t),
        };
        let mut ledger = Ledger::default();
        ledger.open(energy(0.0));
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
            ledger.see(energy(span * f64::from(step + 1)));
        }
        ledger.close()
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

    #[test]
    fn nothing_moving_is_no_error() {
        assert_eq!(Ledger::default().close().error(), 0.0);
    }

    #[test]
    fn the_bound_follows_the_tolerance() {
        assert_eq!(EnergyAudit::bound(0.0), 1e-10);
        assert_eq!(EnergyAudit::bound(1e-2), 0.01);
    }
}
