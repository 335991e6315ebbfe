//! Forces of contacts in the terms of the scene.

use crate::dynamics::model::{Closure, ContactForm, Loss, Pair};

/// Halvings in the search for an indentation.
const HALVINGS: usize = 200;

/// The contact of a pair or of a stop.
#[derive(Clone, Copy, Debug)]
pub(super) struct Contact {
    pair: Pair,
    stiffness: f64,
    damping: f64,
    /// The object part that it belongs to.
    object: usize,
    component: Option<usize>,
    /// κ of the pair, where the scene leaves it to the loads.
    kappa: f64,
}

/// A contact at a state.
#[derive(Clone, Copy, Debug)]
pub(super) struct ContactState {
    pub(super) object: usize,
    pub(super) component: Option<usize>,
    pub(super) mode: i64,
    /// F of the link: positive pulls its mass back.
    pub(super) force: f64,
    /// Force N ≥ 0 and depth p of the flank engaged.
    pub(super) normal: f64,
    pub(super) depth: f64,
    /// Of an open contact: the depths of its flanks that press, and the force that they
    /// would have; else 0.
    pub(super) held_off: [f64; 2],
    /// Magnitude of the deformation.
    pub(super) size: f64,
    /// True of a rigid contact that holds: its force is no function of the state.
    pub(super) holds: bool,
    /// e of a rigid contact.
    pub(super) restitution: Option<f64>,
    /// Speed ṗ of the lower and of the upper flank is ±this.
    pub(super) speed: f64,
}

impl Contact {
    /// The pair of a link of a stiffness and a damping.
    pub(super) fn of_link(
        pair: &Pair,
        [stiffness, damping]: [f64; 2],
        object: usize,
        (component, kappa): (Option<usize>, Option<f64>),
    ) -> Self {
        Self {
            pair: *pair,
            stiffness,
            damping,
            object,
            component,
            kappa: kappa.unwrap_or(0.0),
        }
    }

    /// Half the gap of a form closure.
    fn half_gap(&self) -> f64 {
        match self.pair.closure {
            Closure::Form => 0.5 * self.pair.gap,
            Closure::Bilateral | Closure::Force => 0.0,
        }
    }

    /// N at a depth and a rate, not cut off.
    fn normal(&self, depth: f64, rate: f64) -> f64 {
        let elastic = self.stiffness * depth;
        match self.pair.form {
            ContactForm::Proportional(Loss::Damper) => elastic + self.damping * rate,
            ContactForm::Proportional(Loss::Factor(chi)) => elastic * (1.0 + chi * rate),
            ContactForm::Proportional(Loss::FactorOfDamper) => elastic * (1.0 + self.kappa * rate),
            ContactForm::Power {
                exponent,
                factor,
                compliance,
            } => self.force_of_power(depth, exponent, compliance) * (1.0 + factor * rate),
            ContactForm::Rigid { .. } => 0.0,
        }
    }

    /// K·q^n, where depth = q + compliance·K·q^n is halved down to q.
    fn force_of_power(&self, depth: f64, exponent: f64, compliance: f64) -> f64 {
        let force = |q: f64| self.stiffness * q.max(0.0).powf(exponent);
        let mut q = depth;
        if compliance > 0.0 && depth > 0.0 {
            let [mut low, mut high] = [0.0, depth];
            for _ in 0..HALVINGS {
                q = 0.5 * (low + high);
                if q == low || q == high {
                    break;
                }
                match q + compliance * force(q) > depth {
                    true => high = q,
                    false => low = q,
                }
            }
        }
        force(q)
    }

    /// Force, depth and engaged flank at the deformation `x` of the link and its rate. The mode of
    /// its component gives the flank: 0 open, ±1 engaged; without a component it is always engaged.
    /// An open contact has no force; `held_off` notes a flank that should have closed.
    pub(super) fn state_at(&self, x: f64, rate: f64, modes: &[i64]) -> ContactState {
        let mode = self.component.map_or(1, |component| modes[component]);
        let restitution = self.pair.form.restitution();
        let mut state = ContactState {
            object: self.object,
            component: self.component,
            mode,
            force: 0.0,
            normal: 0.0,
            depth: 0.0,
            held_off: [0.0; 2],
            size: x.abs() + self.half_gap(),
            holds: restitution.is_some() && mode != 0,
            restitution,
            speed: rate,
        };
        if self.pair.closure == Closure::Bilateral {
            state.force = self.stiffness * x + self.damping * rate;
            (state.depth, state.normal) = (x, state.force);
            return state;
        }
        if mode == 0 {
            let sides: &[f64] = match self.pair.closure {
                Closure::Form => &[-1.0, 1.0],
                _ => &[-self.pair.opens],
            };
            for side in sides {
                let depth = side * x - self.half_gap();
                let normal = match restitution {
                    Some(_) => depth,
                    None => self.normal(depth, side * rate),
                };
                if depth > 0.0 && normal > 0.0 {
                    state.held_off = [depth, normal];
                }
            }
            return state;
        }
        let side = mode as f64;
        state.depth = side * x - self.half_gap();
        state.normal = self.normal(state.depth, side * rate);
        state.force = side * state.normal;
        state
    }
}
