//! The kinematic pair of link 1: force, guards, stored and lost energy.
//!
//! A flank is written in its penetration p and ṗ. With s the side of the flank
//! (−1: lower, where x < 0 presses; +1: upper) p = s·x − η/2 and ṗ = s·v, and
//! the force of the link is F = s·N(p, ṗ). A pair is engaged on a flank while
//! both p > 0 and the flank presses, N > 0.

use crate::dynamics::integrate::{EventFunction, Guard};
use crate::dynamics::laws::contact::PowerForce;
use crate::dynamics::model::{Closure, Pair};
use crate::fault::Fault;
use crate::math::number::Number;
use crate::math::quantity::Quantity;

/// Mode of an open pair.
pub(super) const OPEN: i64 = 0;

/// A pair with its link's numbers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Contact {
    /// Closure: how the pair is kept together.
    pub(super) closure: Closure,
    /// Half the gap, η/2; 0 for force closure.
    pub(super) half_gap: f64,
    /// Side of the only flank of a force closure: −1 lower, +1 upper.
    side: f64,
    /// c of link 1.
    stiffness: f64,
    /// b of link 1.
    damping: f64,
    /// κ of a force with the factor 1 + κ·ṗ; `None`: that of a damper.
    pub(super) kappa: Option<f64>,
    /// The elastic force where it is no c·p.
    power: Option<PowerForce>,
    /// e of a rigid contact: its force is no function of p and ṗ, see [`super::impacts`].
    restitution: Option<f64>,
}

impl Contact {
    /// One that never presses, in the place of what is still to be found.
    pub(super) const NONE: Self = Self {
        closure: Closure::Bilateral,
        half_gap: 0.0,
        side: 1.0,
        stiffness: 0.0,
        damping: 0.0,
        kappa: None,
        power: None,
        restitution: None,
    };

    /// A pair on a link. A κ still to be found (from the static penetration)
    /// is 0 until [`Contact::kappa`] is set.
    pub(super) fn new(
        pair: &Pair,
        stiffness: f64,
        damping: f64,
        object: &str,
    ) -> Result<Self, Fault> {
        if !(pair.gap >= 0.0 && pair.gap.is_finite()) {
            return Err(Fault::new(
                format!("{object}.pair.gap"),
                format!("a gap of {} is not possible", pair.gap),
                "a finite gap ≥ 0",
            ));
        }
        if pair.opens != 1.0 && pair.opens != -1.0 {
            return Err(Fault::new(
                format!("{object}.pair.opens"),
                format!("{} is not a direction", pair.opens),
                "\"+\" or \"-\"",
            ));
        }
        let kappa = pair.form.factor();
        let power = PowerForce::of(&pair.form, stiffness);
        if kappa.is_some_and(|kappa| !(kappa >= 0.0 && kappa.is_finite())) {
            return Err(Fault::new(
                format!("{object}.pair.kappa"),
                "κ is not a finite number ≥ 0",
                "seconds per unit of penetration",
            ));
        }
        let restitution = pair.form.restitution();
        if restitution.is_some_and(|e| !(0.0..=1.0).contains(&e)) {
            return Err(Fault::new(
                format!("{object}.pair.contact.restitution"),
                "a coefficient of restitution lies between 0 and 1",
                "0: what comes together stays together; 1: nothing is lost",
            ));
        }
        let half_gap = match pair.closure {
            Closure::Form => 0.5 * pair.gap,
            Closure::Bilateral | Closure::Force => 0.0,
        };
        Ok(Self {
            closure: pair.closure,
            half_gap,
            side: -pair.opens,
            stiffness,
            damping,
            kappa,
            power,
            restitution,
        })
    }

    /// True when the pair can open, so that it has a mode.
    pub(super) fn can_open(&self) -> bool {
        self.closure != Closure::Bilateral
    }

    /// The sides of its flanks.
    pub(super) fn sides(&self) -> &'static [i64] {
        match self.closure {
            Closure::Bilateral => &[],
            Closure::Force if self.side > 0.0 => &[1],
            Closure::Force => &[-1],
            Closure::Form => &[-1, 1],
        }
    }

    /// e of a rigid contact.
    pub(super) fn restitution(&self) -> Option<f64> {
        self.restitution
    }

    /// True in a mode in which a rigid contact holds.
    #[inline(always)]
    pub(super) fn contact_holds(&self, mode: i64) -> bool {
        self.restitution.is_some() && mode != OPEN
    }

    /// Penetration p of the flank on a side and its rate, negative when clear of it.
    #[inline(always)]
    pub(super) fn penetration<N: Number>(&self, side: i64, x: N, v: N) -> (N, N) {
        let side = side as f64;
        (x.scale(side) - N::from(self.half_gap), v.scale(side))
    }

    /// The elastic part of N at a penetration, and its derivative.
    #[inline(always)]
    pub(super) fn elastic_force<N: Quantity>(&self, p: N) -> [N; 2] {
        match self.power {
            None => [p.scale(self.stiffness), N::from(self.stiffness)],
            Some(power) => {
                let [force, slope, _] = p.lift(|p| power.jet(p));
                [force, slope]
            }
        }
    }

    /// Penetration of a flank at rest under a force N ≥ 0.
    pub(super) fn depth_under(&self, force: f64) -> f64 {
        if self.restitution.is_some() {
            return 0.0;
        }
        match self.power {
            None => force / self.stiffness,
            Some(power) => power.penetration(force),
        }
    }

    /// The elastic force where it is no c·p.
    pub(super) fn power(&self) -> Option<PowerForce> {
        self.power
    }

    /// c of the link, or K of a power of the indentation.
    pub(super) fn stiffness(&self) -> f64 {
        self.stiffness
    }

    /// b of the contact, and κ in force on a flank.
    pub(super) fn losses(&self) -> (f64, Option<f64>) {
        (self.damping, self.kappa)
    }

    /// F of link 1: smooth in x and v while the mode does not change, also
    /// beyond the place where it should have changed. Of a rigid contact, which has no
    /// force by itself, 0.
    #[inline(always)]
    pub(super) fn force<N: Quantity>(&self, mode: i64, x: N, v: N) -> N {
        if self.closure == Closure::Bilateral {
            return x.scale(self.stiffness) + v.scale(self.damping);
        }
        if mode == OPEN || self.restitution.is_some() {
            return N::from(0.0);
        }
        let (p, rate) = self.penetration(mode, x, v);
        let pressed = match (self.kappa, self.power) {
            (None, _) => p.scale(self.stiffness) + rate.scale(self.damping),
            (Some(kappa), None) => p.scale(self.stiffness) * (N::from(1.0) + rate.scale(kappa)),
            (Some(kappa), Some(_)) => self.elastic_force(p)[0] * (N::from(1.0) + rate.scale(kappa)),
        };
        pressed.scale(mode as f64)
    }

    /// The two quantities that are both positive exactly while a flank is
    /// engaged: p, and N in units that keep it of the size of p (N/c), or
    /// 1 + κ·ṗ of a force with that factor.
    pub(super) fn engagement_conditions<N: Number>(&self, side: i64, x: N, v: N) -> [N; 2] {
        let (p, rate) = self.penetration(side, x, v);
        match self.kappa {
            None if self.restitution.is_some() => [p, p],
            None => [p, p + rate.scale(self.damping / self.stiffness)],
            Some(kappa) => [p, N::from(1.0) + rate.scale(kappa)],
        }
    }

    /// Guards over a signal, x = signal − `zero`, of the two quantities of [`Self::engagement_conditions`].
    fn guards(&self, side: i64, (signal, zero): (usize, f64)) -> [Guard; 2] {
        let side = side as f64;
        let depth = Guard {
            signal,
            offset: -self.half_gap - side * zero,
            displacement: side,
            speed: 0.0,
        };
        let pressing = match self.kappa {
            None if self.restitution.is_some() => depth,
            None => Guard {
                speed: side * self.damping / self.stiffness,
                ..depth
            },
            Some(kappa) => Guard {
                signal,
                offset: 1.0,
                displacement: 0.0,
                speed: side * kappa,
            },
        };
        [depth, pressing]
    }

    /// The switches to look for in a mode; the deformation x is a signal less `zero`.
    pub(super) fn event_functions(
        &self,
        mode: i64,
        (signal, zero): (usize, f64),
        component: usize,
        out: &mut Vec<EventFunction>,
    ) {
        if self.contact_holds(mode) {
            // Whether it comes apart only its force tells.
            return;
        }
        if mode != OPEN {
            out.push(EventFunction {
                guards: self.guards(mode, (signal, zero)),
                rising: false,
                component,
                target: OPEN,
            });
            return;
        }
        for &side in self.sides() {
            out.push(EventFunction {
                guards: self.guards(side, (signal, zero)),
                rising: true,
                component,
                target: side,
            });
        }
    }

    /// The mode after leaving a flank at (x, v). Without a gap a pair that
    /// leaves one flank by x reaching 0, rather than by its force falling to
    /// zero, is on the other flank at once: it never opens.
    pub(super) fn mode_after_leaving(&self, side: i64, x: f64, v: f64, scale: f64) -> i64 {
        if self.closure != Closure::Form || self.half_gap > 0.0 {
            return OPEN;
        }
        let [depth, pressing] = self.engagement_conditions(side, x, v);
        let passes = match self.kappa {
            None => self.damping == 0.0,
            Some(_) => depth.abs() < pressing.abs() * scale,
        };
        if passes { -side } else { OPEN }
    }

    /// Elastic energy stored: c·p²/2 of the flank that is penetrated, engaged
    /// or open; c·x²/2 of a bilateral pair.
    pub(super) fn stored<N: Quantity>(&self, x: N) -> N {
        let depth = if self.closure == Closure::Bilateral {
            x
        } else {
            self.sides()
                .iter()
                .map(|&side| self.penetration(side, x, x).0)
                .find(|depth| depth.value() > 0.0)
                .unwrap_or(N::from(0.0))
        };
        match self.power {
            None => (depth * depth).scale(0.5 * self.stiffness),
            Some(power) => depth.lift(|p| power.energy(p))[0],
        }
    }

    /// Power lost: F·v less the rate of the stored energy, in a form that does
    /// not cancel. Never negative where the mode belongs to the state.
    pub(super) fn dissipated(&self, mode: i64, x: f64, v: f64) -> f64 {
        if self.closure == Closure::Bilateral {
            return self.damping * v * v;
        }
        if mode == OPEN {
            return -self.stored_rate(x, v);
        }
        let (p, rate) = self.penetration(mode, x, v);
        let damped = match self.kappa {
            None => self.damping * rate * rate,
            Some(kappa) => match self.power {
                None => self.stiffness * p * kappa * rate * rate,
                Some(_) => self.elastic_force(p)[0] * kappa * rate * rate,
            },
        };
        // Zero unless a method has gone beyond the switch: the smooth law then
        // works against an energy that is stored no more.
        damped + self.elastic_force(p)[0] * rate - self.stored_rate(x, v)
    }

    /// Clearance to the nearest flank, 0 when touching one.
    pub(super) fn clearance(&self, x: f64) -> f64 {
        self.sides()
            .iter()
            .map(|&side| -self.penetration(side, x, 0.0).0)
            .fold(f64::INFINITY, f64::min)
            .max(0.0)
    }

    /// Rate of the stored energy, c·p·ṗ of the penetrated flank.
    fn stored_rate(&self, x: f64, v: f64) -> f64 {
        self.sides()
            .iter()
            .map(|&side| {
                let (p, rate) = self.penetration(side, x, v);
                self.elastic_force(p.max(0.0))[0] * rate
            })
            .sum()
    }
}
