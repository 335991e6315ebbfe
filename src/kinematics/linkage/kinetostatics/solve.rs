//! One position: from the motion to reactions and driving force.

use super::external::Input;
use super::iteration::TOO_GREAT;
use super::iteration::{Convergence, Method};
use super::positions::{InputMotion, Positions};
use super::workspace::ForceWorkspace;
use super::{Kinetostatics, Unknown};
use crate::units::shown;
use std::fmt;

/// Condition number from which a position is reported as badly conditioned.
pub const BAD_CONDITION: f64 = 1e12;
/// Condition number from which W counts as singular.
const SINGULAR: f64 = 1e15;
/// Ratio of pivots below which the condition number is looked at.
const SMALL_PIVOT: f64 = 1e-7;

/// Options of the solution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// False: all friction is left out.
    pub friction: bool,
    /// Direction of motion (its sign) where the speed is zero; `None`: that of
    /// the acceleration, and friction without either is a failure.
    pub direction: Option<f64>,
    /// Greatest change of an unknown in the last iteration, relative to the
    /// greatest unknown.
    pub tolerance: f64,
    /// Iterations at most.
    pub iterations: usize,
    /// Look for further solutions where uniqueness is not proved.
    pub search: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            friction: true,
            direction: None,
            tolerance: 1e-12,
            iterations: 200,
            search: true,
        }
    }
}

/// Qualities of a solution besides its numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolutionQuality {
    /// Course of the iteration.
    pub convergence: Convergence,
    /// True: proved to be the only solution.
    pub unique: bool,
    /// Number of solutions found, this one included.
    pub solutions: usize,
    /// Condition number of W where its pivots look bad, else `None`.
    pub condition: Option<f64>,
}

/// Why there are no forces at a position.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ForceFailure {
    /// W is singular: a dead-centre position of the whole mechanism.
    DeadPosition {
        /// Condition number of W (moments over the length scale).
        condition: f64,
    },
    /// The input rests and no direction was given.
    NoDirection,
    /// No reactions with their friction: self-locking, or not convergent.
    SelfLocking {
        /// Last relative change of the iteration.
        change: f64,
        /// Iterations of all methods tried.
        iterations: usize,
    },
    /// A position, force or inertia is not a finite number, or its square is not.
    NotFinite,
    /// Nothing has inertia, so that there is no equation of motion.
    NoInertia,
}

impl fmt::Display for ForceFailure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::DeadPosition { condition } => write!(
                f,
                "dead-centre position: the driver cannot balance the links (condition number \
                 {condition})",
                condition = shown(*condition, 2)
            ),
            Self::NoDirection => write!(
                f,
                "the input rests: kinetic friction needs a direction of motion; or omit the \
                 friction"
            ),
            Self::SelfLocking { change, iterations } => write!(
                f,
                "self-locking or not convergent: no reactions agree with their friction (last change {change} after {iterations} iterations)",
                change = shown(*change, 2)
            ),
            Self::NotFinite => write!(
                f,
                "a position, force or inertia is not a finite number, or too great to reckon with"
            ),
            Self::NoInertia => write!(f, "nothing has inertia: the acceleration is undefined"),
        }
    }
}

impl std::error::Error for ForceFailure {}

impl Kinetostatics {
    /// Reactions, driving force and friction at a position; they are then in
    /// `w` ([`ForceWorkspace::driver_force`], [`Kinetostatics::reaction`], …).
    ///
    /// Allocates nothing where friction is moderate (uniqueness proved).
    ///
    /// # Errors
    ///
    /// See [`ForceFailure`].
    pub fn solve<P: Positions>(
        &self,
        positions: &P,
        motion: InputMotion,
        options: &Options,
        w: &mut ForceWorkspace,
    ) -> Result<SolutionQuality, ForceFailure> {
        let direction = self.direction(motion, options)?;
        self.prepare(positions, motion, direction, options.friction, w);
        let condition = self.invert(Unknown::Drive, w)?;
        let (a, v2) = (motion.acceleration, motion.speed * motion.speed);
        let inertia = |row: usize, w: &ForceWorkspace| {
            self.inertia_row(row, w) * a + self.bias_row(row, w) * v2
        };
        self.solve_columns(|row, w| inertia(row, w) - w.applied[row], w);
        let mut solved = self.solve_with_friction(options, w)?;
        solved.condition = condition;
        w.acceleration = motion.acceleration;
        w.drive = w.unknowns[self.equations_count() - 1] * self.drive_unit();
        w.drives.clear();
        w.drives.push(w.drive);
        let unit = self.drive_unit();
        w.others.iter_mut().for_each(|other| *other *= unit);
        Ok(solved)
    }

    /// The same for a linkage of several inputs: derivatives of the positions are over time,
    /// `rates` those of the inputs. The drivers' forces are then in
    /// [`ForceWorkspace::driver_forces`], [`ForceWorkspace::driver_force`] is their power.
    ///
    /// # Errors
    ///
    /// See [`ForceFailure`]; [`ForceFailure::NoDirection`] where everything rests, nothing is
    /// about to move, and there is friction.
    pub fn solve_over_time<P: Positions>(
        &self,
        positions: &P,
        rates: &[f64],
        options: &Options,
        w: &mut ForceWorkspace,
    ) -> Result<SolutionQuality, ForceFailure> {
        if !rates.iter().all(|rate| rate.is_finite()) {
            return Err(ForceFailure::NotFinite);
        }
        let motion = InputMotion {
            coordinate: 0.0,
            speed: 1.0,
            acceleration: 0.0,
        };
        self.prepare(positions, motion, 1.0, options.friction, w);
        let rests = w.pairs.iter().all(|pair| pair.sense == 0.0);
        if rests && options.friction && self.has_friction() {
            return Err(ForceFailure::NoDirection);
        }
        let condition = self.invert(Unknown::Drive, w)?;
        self.solve_columns(|row, w| self.bias_row(row, w) - w.applied[row], w);
        let mut solved = self.solve_with_friction(options, w)?;
        solved.condition = condition;
        w.acceleration = 0.0;
        w.others.clear();
        w.drives.clear();
        (w.drive, w.pace) = (0.0, 0.0);
        let first = self.equations_count() - self.drivers.len();
        for (k, (&driver, rate)) in self.drivers.iter().zip(rates).enumerate() {
            let unit = self.unit_of(driver);
            let force = unit * w.unknowns[first + k];
            w.drives.push(force);
            w.drive += force * rate;
            w.pace += unit * rate.abs();
        }
        Ok(solved)
    }

    /// Sign of the motion just after the position: that of the speed, at rest
    /// the one asked for, or that of the acceleration.
    pub(super) fn direction(
        &self,
        motion: InputMotion,
        options: &Options,
    ) -> Result<f64, ForceFailure> {
        let InputMotion {
            speed,
            acceleration,
            ..
        } = motion;
        if !(speed.is_finite() && acceleration.is_finite()) {
            return Err(ForceFailure::NotFinite);
        }
        match options.direction {
            _ if speed != 0.0 => Ok(speed.signum()),
            Some(direction) if direction != 0.0 => Ok(direction.signum()),
            _ if acceleration != 0.0 => Ok(acceleration.signum()),
            _ if options.friction && self.has_friction() => Err(ForceFailure::NoDirection),
            _ => Ok(1.0),
        }
    }

    /// Positions, forces and terms of friction.
    pub(super) fn prepare<P: Positions>(
        &self,
        positions: &P,
        motion: InputMotion,
        direction: f64,
        friction: bool,
        w: &mut ForceWorkspace,
    ) {
        w.speed = motion.speed;
        w.direction = direction;
        self.read_positions(positions, direction, w);
        let input = Input {
            coordinate: motion.coordinate,
            speed: motion.speed,
        };
        self.apply_forces(input, w);
        self.friction_terms(friction, w);
    }

    /// Factorises W; its condition number where pivots are small.
    pub(super) fn invert(
        &self,
        unknown: Unknown,
        w: &mut ForceWorkspace,
    ) -> Result<Option<f64>, ForceFailure> {
        let singular = ForceFailure::DeadPosition {
            condition: f64::INFINITY,
        };
        if !self.factorise(unknown, w) {
            let finite = w
                .centres
                .iter()
                .all(|c| (c.place[0] + c.place[1]).is_finite());
            return Err(if finite {
                singular
            } else {
                ForceFailure::NotFinite
            });
        }
        if w.factors.pivots() > SMALL_PIVOT {
            return Ok(None);
        }
        let condition = self.condition(w);
        if condition < SINGULAR {
            Ok(Some(condition))
        } else {
            Err(ForceFailure::DeadPosition { condition })
        }
    }

    /// Condition number of W at the last position (moments over the length
    /// scale), as Hager's method estimates it.
    pub fn condition(&self, w: &mut ForceWorkspace) -> f64 {
        let [x, y] = &mut w.scratch;
        w.factors.condition(x, y)
    }

    /// Friction and reactions; whether they are the only ones.
    pub(super) fn solve_with_friction(
        &self,
        options: &Options,
        w: &mut ForceWorkspace,
    ) -> Result<SolutionQuality, ForceFailure> {
        w.others.clear();
        let (mut convergence, found) = w.solve_friction(options.tolerance, options.iterations);
        let finite = w.right.iter().all(|value| value.is_finite());
        if !finite {
            return Err(ForceFailure::NotFinite);
        }
        let mut unique = convergence.method == Method::None || (found && w.is_contraction());
        let mut solutions = usize::from(found);
        if !unique && (options.search || !found) {
            let injective = w.is_injective();
            let mut complete = false;
            if !(found && injective) {
                (solutions, complete) = self.search_others(found, &mut convergence, w);
            }
            unique = solutions == 1 && (injective || complete);
        }
        if solutions == 0 {
            w.without_friction();
            if !(w.greatest_magnitude() < TOO_GREAT) {
                return Err(ForceFailure::NotFinite);
            }
            return Err(ForceFailure::SelfLocking {
                change: convergence.change,
                iterations: convergence.iterations,
            });
        }
        Ok(SolutionQuality {
            convergence,
            unique,
            solutions,
            condition: None,
        })
    }

    /// All solutions; the one found first stays, or the one with the least
    /// friction is taken. Returns their number, and whether there can be no others.
    fn search_others(
        &self,
        found: bool,
        convergence: &mut Convergence,
        w: &mut ForceWorkspace,
    ) -> (usize, bool) {
        let mut kept = found.then(|| w.friction.clone());
        let mut course = *convergence;
        let (all, complete) = w.search(&mut course);
        convergence.iterations = course.iterations;
        if kept.is_none() && !all.is_empty() {
            convergence.method = Method::Search;
            kept = all.first().cloned();
        }
        let Some(kept) = kept else {
            return (0, complete);
        };
        let mut count = 1;
        for other in &all {
            w.friction.copy_from_slice(other);
            w.react();
            let near = 1e-6 * w.greatest_magnitude();
            let same = other.iter().zip(&kept).all(|(a, b)| (a - b).abs() <= near);
            if !same {
                count += 1;
                let drive = w.unknowns.last().copied().unwrap_or(f64::NAN);
                w.others.push(drive);
            }
        }
        w.friction.copy_from_slice(&kept);
        w.react();
        (count, complete)
    }
}
