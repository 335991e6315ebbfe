//! The energy audit: does what went in equal what is there and what was lost?
//!
//! Balance, error and bound are defined here alone. The works come from two sources: in closed
//! form over a phase (`exact::audit`), and from powers at places of a step (`record::audit`).

/// The energies of a run, or of a stretch of it (J).
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
    /// Energy lost in impacts of rigid contacts.
    pub impacts: f64,
    /// Kinetic and elastic energy at the end less that at the start.
    pub change: f64,
    /// Work put in by drives and by loads where it is positive: of powers that are
    /// sampled, or of phases between switches where the works are known in closed
    /// form.
    pub put_in: [f64; 2],
    /// Greatest kinetic and greatest elastic energy: at the ends of steps, or of
    /// phases; sums over parts of a mechanism that are known each by itself.
    pub greatest: [f64; 2],
}

impl EnergyAudit {
    /// |drives + loads − change − dissipated − friction − impacts| / scale; 0 when nothing moved.
    pub fn error(&self) -> f64 {
        let lost = self.dissipated + self.friction + self.impacts;
        let difference = (self.drives + self.loads - self.change - lost).abs();
        if difference == 0.0 {
            0.0
        } else {
            difference / self.balance_scale()
        }
    }

    /// Reference of the balance's error: the greatest of the work put in by drives, that
    /// put in by loads, the greatest kinetic and the greatest elastic energy (J).
    ///
    /// The elastic energy counts in full, though none of it be exchanged: of a mechanism at
    /// rest under load a method with the tolerance ε knows the deflections to some ε of
    /// themselves, and with them ½·c·x² to some 2·ε. Steps of explicit methods, which
    /// stability alone limits there, leave as much of it open as noise.
    pub fn balance_scale(&self) -> f64 {
        let [[drives, loads], [kinetic, elastic]] = [self.put_in, self.greatest];
        let all = [drives, loads, kinetic, elastic];
        all.into_iter().fold(0.0, f64::max)
    }

    /// The error above which a run with this tolerance is not to be trusted:
    /// 30 × tolerance + 1e-10, at most 1 %. Runs that are right stay below some
    /// 7 × tolerance, rounding and quadrature below 1e-10 (measured on the rocker
    /// with one and two masses, damped and not, with lift-off and gap).
    pub fn bound(tolerance: f64) -> f64 {
        (30.0 * tolerance + 1e-10).min(0.01)
    }

    /// What has been added since an earlier look at the same sums; the greatest
    /// energies are those of all the time.
    pub(crate) fn difference_from(&self, before: &Self) -> Self {
        let both = [0, 1];
        Self {
            drives: self.drives - before.drives,
            loads: self.loads - before.loads,
            dissipated: self.dissipated - before.dissipated,
            friction: self.friction - before.friction,
            impacts: self.impacts - before.impacts,
            change: self.change - before.change,
            put_in: both.map(|k| self.put_in[k] - before.put_in[k]),
            greatest: self.greatest,
        }
    }

    /// Goes on with what comes next.
    pub(crate) fn append(&mut self, next: &Self) {
        self.sum(next);
        for (own, next) in self.greatest.iter_mut().zip(next.greatest) {
            *own = own.max(next);
        }
    }

    /// Adds another part of the mechanism over the same time.
    pub(crate) fn add(&mut self, other: &Self) {
        self.sum(other);
        for (own, other) in self.greatest.iter_mut().zip(other.greatest) {
            *own += other;
        }
    }

    fn sum(&mut self, other: &Self) {
        self.drives += other.drives;
        self.loads += other.loads;
        self.dissipated += other.dissipated;
        self.friction += other.friction;
        self.impacts += other.impacts;
        self.change += other.change;
        for (own, other) in self.put_in.iter_mut().zip(other.put_in) {
            *own += other;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::EnergyAudit;

    #[test]
    fn nothing_moving_is_no_error() {
        assert_eq!(EnergyAudit::default().error(), 0.0);
    }

    #[test]
    fn the_bound_follows_the_tolerance() {
        assert_eq!(EnergyAudit::bound(0.0), 1e-10);
        assert_eq!(EnergyAudit::bound(1e-2), 0.01);
    }

    #[test]
    fn of_a_mechanism_at_rest_the_error_is_one_of_its_deflections() {
        // Each found a share of 1e-9 too great: ½·c·x² is, by two of it.
        let (c, x, off) = (3e5, 2e-3, 1e-9);
        let energy = |x: f64| 0.5 * c * x * x;
        let audit = EnergyAudit {
            change: energy(x * (1.0 + off)) - energy(x),
            greatest: [1e-12, energy(x)],
            ..EnergyAudit::default()
        };
        approx::assert_relative_eq!(audit.error(), 2.0 * off, max_relative = 1e-6);
        assert!(audit.error() < EnergyAudit::bound(off));
        assert!(audit.error() > EnergyAudit::bound(0.01 * off));
    }

    #[test]
    fn parts_side_by_side_and_one_after_the_other() {
        let part = EnergyAudit {
            drives: 3.0,
            dissipated: 1.0,
            change: 2.0,
            put_in: [4.0, 0.0],
            greatest: [5.0, 1.0],
            ..EnergyAudit::default()
        };
        let (mut beside, mut after) = (part, part);
        beside.add(&part);
        after.append(&part);
        assert_eq!((beside.drives, after.drives), (6.0, 6.0));
        assert_eq!((beside.greatest, after.greatest), ([10.0, 2.0], [5.0, 1.0]));
        assert_eq!((beside.balance_scale(), beside.error()), (10.0, 0.0));
    }
}
