//! Joint friction as a force on the input: how much of the input's force the
//! pairs take while the linkage moves as a part of a greater mechanism.
//!
//! What it is coupled with is known by a few numbers. They are the acceleration a₀ that the
//! input would have without this friction, the mobility s = ∂q̈/∂T (one over the
//! inertia of all that moves with the input, reduced to it). It is 0 if the
//! motion is given. Besides there is a force f and an inertia m on every output. Then q̈ = a₀ + s·T,
//! and T follows from the reactions, which depend on q̈: the small implicit
//! equation is solved with z = T in the place of the driver's force,
//!
//! W·F = B·(a₀ + s·z) + … − P − (D − z·(1 − s·J))·d − friction,
//!
//! D being the driver's force of the motion without friction, which the power of
//! all other forces gives, and d its rows.

use super::external::Input;
use super::positions::Positions;
use super::sides::press;
use super::solve::{ForceFailure, Options, SolutionQuality};
use super::workspace::ForceWorkspace;
use super::{Kinetostatics, Unknown};

/// A linkage as a part of a mechanism that moves.
#[derive(Clone, Copy, Debug)]
pub struct ResistanceModel<'a> {
    /// Input coordinate q (rad or m).
    pub coordinate: f64,
    /// Speed of the input (rad/s or m/s).
    pub speed: f64,
    /// Acceleration a₀ of the input without friction of this linkage.
    pub free_acceleration: f64,
    /// s = ∂q̈/∂T ≥ 0 (1/(kg·m²) or 1/kg): 0 where the motion is given.
    pub mobility: f64,
    /// Forces on the outputs, without those of the inertias below (N·m or N).
    pub loads: &'a [f64],
    /// Inertias that move with the outputs (kg·m² or kg).
    pub inertias: &'a [f64],
    /// Direction of the input, −1 or 1 (also where its speed is zero) …
    pub direction: f64,
    /// … and in which direction each pair slides when it is 1: −1, 0 or 1. Both
    /// are taken as given, so that everything is smooth also just beyond a
    /// change of direction.
    pub senses: &'a [f64],
    /// The sides on which pairs press ([`Kinetostatics::pressed_sides`]), those of blocks
    /// taken as given likewise; `None`: as they turn out.
    pub pressed: Option<u64>,
}

/// Resistance: what friction does at the input.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Resistance {
    /// Generalised force T of all friction on the input (N·m or N): T·q̇ ≤ 0.
    pub force: f64,
    /// The input's acceleration a₀ + s·T.
    pub acceleration: f64,
    /// Number of solutions found: where it is not 1 the motion is not determined.
    pub solutions: usize,
    /// True: proved to be the only solution.
    pub unique: bool,
}

impl Kinetostatics {
    /// The force of the pairs' friction on the input, found together with the
    /// acceleration that it leaves.
    ///
    /// Allocates nothing where friction is moderate (uniqueness proved).
    ///
    /// # Errors
    ///
    /// [`ForceFailure::SelfLocking`] where no acceleration agrees with the
    /// friction that it causes, [`ForceFailure::DeadPosition`] where the equations
    /// are singular.
    pub fn resist<P: Positions>(
        &self,
        positions: &P,
        motion: &ResistanceModel<'_>,
        options: &Options,
        w: &mut ForceWorkspace,
    ) -> Result<Resistance, ForceFailure> {
        w.speed = motion.speed;
        w.direction = motion.direction;
        self.place_sliding(positions, motion.senses, motion.direction, w);
        w.set_output_loads(motion.loads);
        w.output_inertias.fill(0.0);
        for (own, inertia) in w.output_inertias.iter_mut().zip(motion.inertias) {
            *own = *inertia;
        }
        let input = Input {
            coordinate: motion.coordinate,
            speed: motion.speed,
        };
        self.apply_forces(input, w);
        self.carry_outputs(w);
        self.friction_terms(options.friction, w);
        if let Some(pressed) = motion.pressed {
            press(pressed, &mut w.terms);
        }
        self.drive_rows(w);
        let solved = self.balance_resistance(motion, options, w);
        // Other questions to the same memory know nothing of inertias on outputs.
        w.carried.iter_mut().for_each(Vec::clear);
        let solved = solved?;
        let force = self.friction_on_input(w);
        Ok(Resistance {
            force,
            acceleration: w.acceleration,
            solutions: solved.solutions,
            unique: solved.unique,
        })
    }

    /// Solves for reactions, friction and z.
    fn balance_resistance(
        &self,
        motion: &ResistanceModel<'_>,
        options: &Options,
        w: &mut ForceWorkspace,
    ) -> Result<SolutionQuality, ForceFailure> {
        let (a, s) = (motion.free_acceleration, motion.mobility);
        let unit = self.drive_unit();
        let v2 = motion.speed * motion.speed;
        let [inertia, bias] = self.reduced_inertia(w);
        let others: f64 = [&w.weights, &w.forces, &w.output_forces]
            .iter()
            .map(|list| list.iter().sum::<f64>())
            .sum();
        let drive = inertia * a + bias * v2 - others;
        if !(drive.is_finite() && s >= 0.0) {
            return Err(ForceFailure::NotFinite);
        }
        let unknown = Unknown::Resistance {
            mobility: s * unit,
            share: 1.0 - s * inertia,
        };
        self.invert(unknown, w)?;
        let given = drive / unit;
        self.solve_columns(
            |row, w| {
                let moving = self.inertia_row(row, w) * a + self.bias_row(row, w) * v2;
                moving - w.applied[row] - w.drive_rows[row] * given
            },
            w,
        );
        let solved = self.solve_with_friction(options, w)?;
        let force = self.friction_on_input(w);
        w.acceleration = a + s * force;
        w.drive = inertia * w.acceleration + bias * v2 - others - force;
        Ok(solved)
    }

    /// Inertia reduced to the input, and what it asks for at constant speed of
    /// the input, per its square; with that of the outputs.
    fn reduced_inertia(&self, w: &ForceWorkspace) -> [f64; 2] {
        let mut sum = [0.0; 2];
        for (index, body) in self.spec.links.iter().enumerate() {
            let (centre, link) = (&w.centres[index], &w.links[index]);
            let ([x, y], turning) = (centre.first, link.first[2]);
            let along =
                |[a, b]: [f64; 2], c: f64| body.mass * (x * a + y * b) + body.moment * turning * c;
            sum[0] += along(centre.first, turning);
            sum[1] += along(centre.second, link.second[2]);
        }
        for (output, &inertia) in w.output_inertias.iter().enumerate() {
            if inertia != 0.0 {
                let [first, second] = self.output_rates(output, w);
                sum[0] += inertia * first * first;
                sum[1] += inertia * first * second;
            }
        }
        sum
    }

    /// Generalised force of all friction on the input: its virtual work.
    fn friction_on_input(&self, w: &ForceWorkspace) -> f64 {
        self.work_of(&w.friction, w)
    }

    /// Virtual work of frictions τ per unit of the input.
    fn work_of(&self, tau: &[f64], w: &ForceWorkspace) -> f64 {
        let work = w.terms.iter().map(|term| {
            let pair = term.unknown / 2;
            self.units[pair] * tau[term.column] * w.pairs[pair].rates[0]
        });
        work.sum()
    }

    /// Derivatives of the force found by [`Self::resist`] just before: by a₀, and
    /// by the force on each output (into `by_loads`).
    ///
    /// By the rest they follow: ∂T/∂s = T·∂T/∂a₀, and an inertia m on an output is
    /// a force −m·φ̈ on it, ∂T/∂m = −φ̈·∂T/∂f, with φ̈ of the motion found.
    pub fn resistance_slopes(&self, w: &mut ForceWorkspace, by_loads: &mut [f64]) -> f64 {
        let unit = self.drive_unit();
        self.carry_outputs(w);
        let [inertia, _] = self.reduced_inertia(w);
        w.write_slopes();
        if !w.small.factorise() {
            by_loads.fill(f64::NAN);
            return f64::NAN;
        }
        let mut rows = std::mem::take(&mut w.scratch[1]);
        rows.clear();
        rows.extend((0..self.equations_count()).map(|row| {
            let drive = w.drive_rows[row] * inertia / unit;
            self.inertia_row(row, w) - drive
        }));
        w.carried.iter_mut().for_each(Vec::clear);
        let by_acceleration = self.answer(&mut rows, w);
        for (output, by_load) in by_loads.iter_mut().enumerate() {
            let [first, _] = self.output_rates(output, w);
            rows.clear();
            rows.extend(w.drive_rows.iter().map(|row| row * first / unit));
            self.each_output_row(output, 1.0, w, |row, value| rows[row] -= value);
            *by_load = self.answer(&mut rows, w);
        }
        w.scratch[1] = rows;
        by_acceleration
    }

    /// Change of T when the right sides change by `rows`, the friction's signs
    /// as they are.
    fn answer(&self, rows: &mut [f64], w: &mut ForceWorkspace) -> f64 {
        w.factors.solve(rows, 1);
        w.change_of_friction(|row| rows[row]);
        self.work_of(&w.next, w)
    }

    /// Angular or sliding acceleration of an output in the motion found by
    /// [`Self::resist`].
    pub fn output_acceleration(&self, output: usize, w: &ForceWorkspace) -> f64 {
        let [first, second] = self.output_rates(output, w);
        first * w.acceleration + second * w.speed * w.speed
    }

    /// Size of the input coordinate that changes the position as a whole: 1 rad, or
    /// the length scale of a driver that slides (m).
    pub fn coordinate_scale(&self) -> f64 {
        self.length / self.units[self.spec.driver]
    }

    /// Greatest magnitude of the reactions found last (N, couples over the
    /// length scale).
    pub fn greatest_reaction(&self, w: &ForceWorkspace) -> f64 {
        w.greatest_magnitude()
    }
}
