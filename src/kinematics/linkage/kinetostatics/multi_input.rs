//! Joint friction of a linkage of several inputs that moves as a part of a greater mechanism.
//!
//! What it is coupled with is known by a few numbers. The accelerations a₀ that the inputs
//! would have without this friction, their mobility G = ∂q̈/∂T over the forces T on them
//! (symmetric; zero where motions are given), and a force and an inertia on every output.
//! Friction τ of pairs acts on the inputs as T = Aᵀτ, with the rates A = ∂w/∂q̇ of the pairs by
//! the inputs (its virtual work). So q̈ = a₀ + G·Aᵀτ, and the reactions, for which the
//! matrix W of the driven linkage serves, are linear in a₀ and in τ:
//!
//! F = W⁻¹·(B·a₀ + … − P) − W⁻¹·(wrenches − B·G·Aᵀ)·τ.
//!
//! A pair that friction holds has a multiplier λ in the place of its τ, such that it stays at
//! rest: α⁰ + A·G·Aᵀ·(τ, λ) = 0 for the accelerations α⁰ of the held pairs. It is eliminated from
//! the equations, which stay F = F₀ − K·τ, and is one more row of F. Of held pairs that others
//! hold already the multiplier is zero: which of them bears what is not determined.

use super::external::Input;
use super::friction::Law;
use super::held_pairs::dot;
use super::solve::{ForceFailure, Options};
use super::workspace::ForceWorkspace;
use super::{Kinetostatics, Unknown};
use crate::kinematics::linkage::multi::MultiMotion;
use crate::kinematics::linkage::spec::{OutputKind, PointOf};

/// What friction does in a pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Sliding {
    /// Nothing: there is none, or it rests in a given motion.
    Idle,
    /// It acts against a sliding in this direction: −1 or 1, or somewhat more for what is
    /// about to start.
    Slides(f64),
    /// It holds the pair.
    Held,
}

/// What hangs on the outputs.
#[derive(Clone, Copy, Debug)]
pub struct OutputLoads<'a> {
    /// Forces, without those of the inertias (N·m or N).
    pub loads: &'a [f64],
    /// Inertias (kg·m² or kg).
    pub inertias: &'a [f64],
}

impl Kinetostatics {
    /// Takes over a motion of the inputs with the accelerations a₀: all that does not depend on
    /// what friction does.
    ///
    /// # Errors
    /// The equations are singular, or not finite.
    pub fn set_motion(
        &self,
        motion: &MultiMotion,
        carried: OutputLoads<'_>,
        w: &mut ForceWorkspace,
    ) -> Result<(), ForceFailure> {
        w.speed = 1.0;
        w.direction = 1.0;
        self.place_sliding(motion, &[], 1.0, w);
        w.set_output_loads(carried.loads);
        w.output_inertias.fill(0.0);
        for (own, inertia) in w.output_inertias.iter_mut().zip(carried.inertias) {
            *own = *inertia;
        }
        let over_time = Input {
            coordinate: 0.0,
            speed: 1.0,
        };
        self.apply_forces(over_time, w);
        self.carry_outputs(w);
        let mut bare = std::mem::take(&mut w.several.bare);
        bare.clear();
        bare.extend((0..self.equations_count()).map(|row| self.bias_row(row, w) - w.applied[row]));
        // Other questions to the same memory know nothing of inertias on outputs.
        w.carried.iter_mut().for_each(Vec::clear);
        self.rates_by_inputs(motion, w);
        let inverted = self.invert(Unknown::Drive, w);
        if inverted.is_ok() {
            w.factors.solve(&mut bare, 1);
        }
        w.several.bare = bare;
        inverted.map(|_| ())
    }

    /// A and B.
    fn rates_by_inputs(&self, motion: &MultiMotion, w: &mut ForceWorkspace) {
        let (inputs, size) = (self.drivers.len(), self.equations_count());
        let mut several = std::mem::take(&mut w.several);
        several.rates.resize(self.spec.pairs.len() * inputs, 0.0);
        for (pair, rates) in several.rates.chunks_exact_mut(inputs).enumerate() {
            motion.output_transfer(&OutputKind::Pair { pair }, rates);
        }
        several.inertia.clear();
        several.inertia.resize(inputs * size, 0.0);
        several.row.clear();
        several.row.resize(inputs, 0.0);
        for (input, rows) in several.inertia.chunks_exact_mut(size).enumerate() {
            for (link, body) in self.spec.links.iter().enumerate() {
                let centre = PointOf {
                    link: Some(link),
                    at: body.centre,
                };
                let [x, y] = motion.point_transfer(centre, input);
                rows[3 * link] = body.mass * x;
                rows[3 * link + 1] = body.mass * y;
                let turning = motion.angle_transfer(link, input);
                rows[3 * link + 2] = body.moment * turning / self.length;
            }
        }
        for (output, own) in self.spec.outputs.iter().enumerate() {
            let inertia = w.output_inertias[output];
            if inertia == 0.0 {
                continue;
            }
            motion.output_transfer(&own.kind, &mut several.row);
            let rows = several.inertia.chunks_exact_mut(size);
            for (rows, rate) in rows.zip(&several.row) {
                self.each_output_row(output, inertia * rate, w, |row, value| rows[row] += value);
            }
        }
        w.several = several;
    }

    /// The force of friction on the inputs with the accelerations that it leaves, at what
    /// [`Self::set_motion`] took over, where the pairs do what `sliding` says; the number of
    /// solutions.
    ///
    /// # Errors
    /// [`ForceFailure::SelfLocking`] where no accelerations agree with the friction that they
    /// cause.
    pub fn solve_friction(
        &self,
        mobility: &[f64],
        sliding: &[Sliding],
        options: &Options,
        w: &mut ForceWorkspace,
    ) -> Result<usize, ForceFailure> {
        w.several.mobility.clear();
        w.several.mobility.extend_from_slice(mobility);
        w.several.held.clear();
        w.several.factor.clear();
        w.terms.clear();
        w.columns = 0;
        for (pair, &sliding) in sliding.iter().enumerate() {
            let Some(law) = self.friction_factors[pair] else {
                continue;
            };
            match sliding {
                Sliding::Idle => {}
                Sliding::Slides(sense) => w.add_term(pair, law.sliding(sense)),
                Sliding::Held => self.add_multiplier(pair, law, w),
            }
        }
        self.holding_columns(w);
        self.friction_columns(w);
        let solved = self.solve_with_friction(options, w)?;
        self.sum_forces(w);
        Ok(solved.solutions)
    }

    /// Gives a held pair its multiplier, unless others hold it already.
    fn add_multiplier(&self, pair: usize, law: Law, w: &mut ForceWorkspace) {
        if !w.several.extend_factor(pair, self.drivers.len()) {
            return;
        }
        let holding = self.equations_count() + w.several.held.len() - 1;
        if let Law::Guide([along, couple]) = law {
            let couple = couple / along;
            w.add_term(pair, Law::HeldGuide { couple, holding });
        }
    }

    /// W⁻¹·(wrench − B·G·Aᵀ) of a unit of a pair's friction along its sliding, into `column`.
    fn response(&self, pair: usize, column: &mut [f64], w: &ForceWorkspace) {
        column.fill(0.0);
        let [wrench, _] = self.frictions(pair, &w.pairs[pair]);
        self.each_row(pair, &wrench, &w.centres, |row, value| column[row] += value);
        self.subtract_inertia(pair, column, w);
        w.factors.solve(column, 1);
    }

    /// Takes the inertia forces of what a unit of a pair's friction accelerates off rows.
    fn subtract_inertia(&self, pair: usize, rows: &mut [f64], w: &ForceWorkspace) {
        let (inputs, several) = (self.drivers.len(), &w.several);
        let rates = &several.rates[pair * inputs..(pair + 1) * inputs];
        for (input, inertia) in several.inertia.chunks_exact(rows.len()).enumerate() {
            let mobility = &several.mobility[input * inputs..(input + 1) * inputs];
            let pushed = self.units[pair] * dot(mobility, rates);
            if pushed != 0.0 {
                for (row, inertia) in rows.iter_mut().zip(inertia) {
                    *row -= inertia * pushed;
                }
            }
        }
    }

    /// What every multiplier does.
    fn holding_columns(&self, w: &mut ForceWorkspace) {
        let size = self.equations_count();
        let mut holding = std::mem::take(&mut w.several.holding);
        holding.resize(w.several.held.len() * size, 0.0);
        for (index, column) in holding.chunks_exact_mut(size).enumerate() {
            self.response(w.several.held[index], column, w);
        }
        w.several.holding = holding;
    }

    /// F₀ and K, the multipliers eliminated; their rows stand behind those of F.
    fn friction_columns(&self, w: &mut ForceWorkspace) {
        let (size, inputs, width) = (self.equations_count(), self.drivers.len(), w.width());
        let held = w.several.held.len();
        let mut right = std::mem::take(&mut w.right);
        right.clear();
        right.resize((size + held) * width, 0.0);
        let mut column = std::mem::take(&mut w.several.row);
        let mut shares = std::mem::take(&mut w.several.small);
        column.resize(size, 0.0);
        shares.resize(held, 0.0);
        // Without friction: what holds the pairs is opposite to their accelerations.
        for (share, &pair) in shares.iter_mut().zip(&w.several.held) {
            *share = w.pairs[pair].rates[1];
        }
        column.copy_from_slice(&w.several.bare);
        self.put_column(0, &mut column, &mut shares, &mut right, w);
        for index in 0..w.terms.len() {
            let term = w.terms[index];
            let pair = term.unknown / 2;
            if matches!(term.law, Law::HeldGuide { .. }) {
                shares.fill(0.0);
                self.couple_column(pair, &mut column, w);
                self.put_column(1 + term.column, &mut column, &mut shares, &mut right, w);
                continue;
            }
            self.response(pair, &mut column, w);
            for (share, &other) in shares.iter_mut().zip(&w.several.held) {
                *share = -self.units[pair] * w.several.compliance_between(other, pair, inputs);
            }
            self.put_column(1 + term.column, &mut column, &mut shares, &mut right, w);
            if term.width() > 1 {
                shares.fill(0.0);
                self.couple_column(pair, &mut column, w);
                self.put_column(2 + term.column, &mut column, &mut shares, &mut right, w);
            }
        }
        w.unknowns.resize(size + held, 0.0);
        (w.right, w.several.row, w.several.small) = (right, column, shares);
    }

    /// W⁻¹ of the couple on a block, which makes no acceleration.
    fn couple_column(&self, pair: usize, column: &mut [f64], w: &ForceWorkspace) {
        column.fill(0.0);
        let [_, wrench] = self.frictions(pair, &w.pairs[pair]);
        self.each_row(pair, &wrench, &w.centres, |row, value| column[row] += value);
        w.factors.solve(column, 1);
    }

    /// Puts a column into the right sides, with the multipliers that it brings along: those that
    /// take the accelerations `shares` of the held pairs off.
    fn put_column(
        &self,
        place: usize,
        column: &mut [f64],
        shares: &mut [f64],
        right: &mut [f64],
        w: &ForceWorkspace,
    ) {
        let (size, width) = (self.equations_count(), w.width());
        self.multipliers(shares, w);
        for (share, holding) in shares.iter().zip(w.several.holding.chunks_exact(size)) {
            for (value, holding) in column.iter_mut().zip(holding) {
                *value -= holding * share;
            }
        }
        let all = column.iter().chain(shares.iter());
        for (row, value) in right.chunks_exact_mut(width).zip(all) {
            row[place] = *value;
        }
    }

    /// Turns accelerations of the held pairs into the multipliers that take them off.
    pub(super) fn multipliers(&self, accelerations: &mut [f64], w: &ForceWorkspace) {
        w.several.solve(accelerations);
        for (value, &pair) in accelerations.iter_mut().zip(&w.several.held) {
            *value /= -self.units[pair];
        }
    }

    /// T of the friction found.
    fn sum_forces(&self, w: &mut ForceWorkspace) {
        let mut force = std::mem::take(&mut w.several.force);
        self.generalise(
            &w.friction,
            &w.unknowns[self.equations_count()..],
            w,
            &mut force,
        );
        w.several.force = force;
    }

    /// Aᵀ of frictions τ and multipliers λ.
    pub(super) fn generalise(
        &self,
        tau: &[f64],
        multipliers: &[f64],
        w: &ForceWorkspace,
        out: &mut Vec<f64>,
    ) {
        let inputs = self.drivers.len();
        out.clear();
        out.resize(inputs, 0.0);
        let slides = |term: &&super::friction::Term| !matches!(term.law, Law::HeldGuide { .. });
        let sliding = w.terms.iter().filter(slides);
        let sliding = sliding.map(|term| (term.unknown / 2, tau[term.column]));
        let held = w.several.held.iter().copied();
        for (pair, tau) in sliding.chain(held.zip(multipliers.iter().copied())) {
            let rates = &w.several.rates[pair * inputs..(pair + 1) * inputs];
            for (out, rate) in out.iter_mut().zip(rates) {
                *out += self.units[pair] * tau * rate;
            }
        }
    }
}
