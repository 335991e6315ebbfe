//! Motion with joint friction: the acceleration of the input when the driver's
//! force is given.
//!
//! Reactions depend on the acceleration and friction on the reactions: the
//! equations of equilibrium are solved with the acceleration in the place of
//! the driver's force. They may have no solution (self-locking in motion) or
//! several (Painlevé's paradox); both are reported, never resolved by choice.

use super::positions::InputMotion;
use super::positions::Positions;
use super::solve::{ForceFailure, Options, SolutionQuality};
use super::workspace::ForceWorkspace;
use super::{Kinetostatics, Unknown};

/// Outcome: what the linkage does next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Outcome {
    /// The linkage moves with this acceleration (rad/s² or m/s²).
    Moves {
        /// Acceleration of the input.
        acceleration: f64,
    },
    /// The linkage rests: friction holds it in both directions.
    Rests,
    /// From rest it may start in either direction: the motion is not determined.
    Undetermined {
        /// Acceleration of a start forwards.
        forwards: f64,
        /// Acceleration of a start backwards.
        backwards: f64,
    },
}

/// Acceleration of a linkage and how it was found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Acceleration {
    /// Outcome: what the linkage does next.
    pub outcome: Outcome,
    /// Course of the solution; `None` where the linkage rests.
    pub solved: Option<SolutionQuality>,
}

impl Kinetostatics {
    /// Acceleration of the input under a given driver's force (N·m or N along
    /// the input coordinate), weights, forces and joint friction.
    ///
    /// At zero speed the linkage starts in a direction only if it accelerates
    /// in that direction against the friction of a motion in that direction;
    /// otherwise it rests. Friction at rest is that of sliding at most.
    ///
    /// # Errors
    ///
    /// [`ForceFailure::SelfLocking`] where no acceleration agrees with the
    /// friction it causes, [`ForceFailure::NoInertia`] where nothing has inertia.
    /// Several solutions in motion: [`SolutionQuality::solutions`] counts them.
    pub fn accelerate<P: Positions>(
        &self,
        positions: &P,
        coordinate: f64,
        speed: f64,
        drive: f64,
        options: &Options,
        w: &mut ForceWorkspace,
    ) -> Result<Acceleration, ForceFailure> {
        let motion = InputMotion {
            coordinate,
            speed,
            acceleration: 0.0,
        };
        let rubs = options.friction && self.has_friction();
        if speed != 0.0 || !rubs {
            let direction = if speed < 0.0 { -1.0 } else { 1.0 };
            let solved =
                self.accelerate_in_direction(positions, motion, direction, drive, options, w)?;
            return Ok(moves(w.acceleration, solved));
        }
        let start = |direction: f64, w: &mut ForceWorkspace| match self
            .accelerate_in_direction(positions, motion, direction, drive, options, w)
        {
            Ok(solved) if w.acceleration * direction > 0.0 => Ok(Some((w.acceleration, solved))),
            Ok(_) | Err(ForceFailure::SelfLocking { .. }) => Ok(None),
            Err(failure) => Err(failure),
        };
        let backwards = start(-1.0, w)?;
        let forwards = start(1.0, w)?;
        Ok(match (forwards, backwards) {
            (Some((acceleration, solved)), None) => moves(acceleration, solved),
            (None, Some((acceleration, solved))) => {
                // The workspace is left as it belongs to the motion found.
                start(-1.0, w)?;
                moves(acceleration, solved)
            }
            (Some((forwards, _)), Some((backwards, _))) => Acceleration {
                outcome: Outcome::Undetermined {
                    forwards,
                    backwards,
                },
                solved: None,
            },
            (None, None) => Acceleration {
                outcome: Outcome::Rests,
                solved: None,
            },
        })
    }

    /// Solves for the acceleration if the input slides in `direction` (±1), into
    /// `w.acceleration`, and for those of other solutions into `w.others`. `motion.acceleration`
    /// must be 0. Returns the quality of the solution.
    fn accelerate_in_direction<P: Positions>(
        &self,
        positions: &P,
        motion: InputMotion,
        direction: f64,
        drive: f64,
        options: &Options,
        w: &mut ForceWorkspace,
    ) -> Result<SolutionQuality, ForceFailure> {
        self.prepare(positions, motion, direction, options.friction, w);
        self.drive_rows(w);
        let condition = self
            .invert(Unknown::Acceleration, w)
            .map_err(|failure| self.why_singular(failure, w))?;
        let v2 = motion.speed * motion.speed;
        let given = drive / self.drive_unit();
        self.solve_columns(
            |row, w| self.bias_row(row, w) * v2 - w.applied[row] - w.drive_rows[row] * given,
            w,
        );
        let mut solved = self.solve_with_friction(options, w)?;
        solved.condition = condition;
        let scale = self.inertia_scale;
        w.acceleration = w.unknowns[self.equations_count() - 1] / scale;
        w.others.iter_mut().for_each(|other| *other /= scale);
        w.drive = drive;
        Ok(solved)
    }

    /// A singular matrix without inertia is no dead-centre position.
    fn why_singular(&self, failure: ForceFailure, w: &ForceWorkspace) -> ForceFailure {
        let none = (0..self.equations_count()).all(|row| self.inertia_row(row, w) == 0.0);
        if none && failure != ForceFailure::NotFinite {
            ForceFailure::NoInertia
        } else {
            failure
        }
    }
}

/// The linkage moves.
fn moves(acceleration: f64, solved: SolutionQuality) -> Acceleration {
    Acceleration {
        outcome: Outcome::Moves { acceleration },
        solved: Some(solved),
    }
}
