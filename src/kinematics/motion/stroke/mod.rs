//! Strokes of run-up, uniform motion and run-out: synthesis from what a
//! designer is given.
//!
//! Source: I. Vulfson, *Dynamics of Cyclic Machines*, chapter 1, with its
//! misprints corrected; equation numbers are those of the text.
//!
//! ```text
//! Π′   ____________          run-up 0 … φ_I, uniform … φ_II, run-out … φ_III
//!     /            \__       strokes Π_I, Π_II, Π_III
//! ___/                \___   the run-out's law is counted backwards from φ_III
//!    0 φ_I      φ_II  φ_III
//! ```

mod criterion;
mod figures;
mod optimum;
mod section;
mod solve;
#[cfg(test)]
mod tests;

pub use criterion::Criterion;
pub use figures::optimum_uniform_stroke;
pub use figures::{Skewness, StrokeSpec};
pub use section::RunSection;

use crate::fault::Fault;
use crate::kinematics::motion::law::SectionsSpec;
use crate::math::jet::Jet;
use serde::Serialize;

/// A stroke of three sections.
#[derive(Clone, Debug, PartialEq)]
pub struct Stroke {
    run_up: RunSection,
    run_out: RunSection,
    figures: StrokeFigures,
}

/// Structure and criteria of a stroke. Angles are of the driver (rad; s if it
/// is driven by time), strokes of the output (m or rad).
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct StrokeFigures {
    /// Π_III: the whole stroke; negative in the other direction.
    pub stroke: f64,
    /// φ_III: the driver's angle for it.
    pub span: f64,
    /// Π_I: stroke of the run-up.
    pub stroke_run_up: f64,
    /// Π_II: stroke where the run-out begins.
    pub stroke_run_out: f64,
    /// φ_I: angle of the run-up.
    pub angle_run_up: f64,
    /// φ_II: angle where the run-out begins.
    pub angle_run_out: f64,
    /// ζ_Π: share of the stroke made in uniform motion, (1.12).
    pub uniform_stroke: f64,
    /// ζ_φ: share of the span with uniform motion, (1.12).
    pub uniform_span: f64,
    /// f: angle of the run-out by that of the run-up, (1.13).
    pub skewness: f64,
    /// ν1 = θ′_1max/θ′_3max.
    pub speed_ratio: f64,
    /// ν2 = θ″_1max/θ″_3max.
    pub law_acceleration_ratio: f64,
    /// U = (1 + f)/(1 + ν1·f).
    pub u: f64,
    /// λ: greatest acceleration of the run-up by that of the run-out, (1.19).
    pub acceleration_ratio: f64,
    /// Π′_max, (1.16).
    pub peak_speed: f64,
    /// Greatest |Π″| of the run-up, (1.17), with the sign of the stroke.
    pub acceleration_run_up: f64,
    /// Greatest |Π″| of the run-out, (1.18).
    pub acceleration_run_out: f64,
    /// Greatest Π′Π″ of the run-up, (1.17).
    pub product_run_up: f64,
    /// Greatest |Π′Π″| of the run-out, (1.18).
    pub product_run_out: f64,
}

impl Stroke {
    /// Works out a stroke: problems 1, 2 and 3 with all their inversions.
    ///
    /// # Errors
    /// What is missing, given twice, out of range, or has no solution, with
    /// the interval in which there is one; paths name the fields of `spec`.
    pub fn new(spec: &StrokeSpec) -> Result<Self, Vec<Fault>> {
        solve::solve(spec)
    }

    /// Structure and criteria.
    pub fn figures(&self) -> &StrokeFigures {
        &self.figures
    }

    /// As a dimensionless law, to be used by cams and drives.
    pub fn sections(&self) -> SectionsSpec {
        SectionsSpec {
            run_up: self.run_up.spec.clone(),
            run_out: self.run_out.spec.clone(),
            skewness: self.figures.skewness,
            uniform: self.figures.uniform_span,
        }
    }

    /// Π and its derivatives just before and just after `phi`. They differ
    /// where the acceleration or the jerk jumps. Outside 0 … φ_III: dwell.
    pub fn sides(&self, phi: f64) -> [Jet; 2] {
        let figures = &self.figures;
        let (first, second) = (figures.angle_run_up, figures.angle_run_out);
        let before = if phi <= 0.0 {
            Jet::default()
        } else if phi <= first {
            self.run_up(phi, false)
        } else if phi <= second {
            self.uniform(phi)
        } else if phi <= figures.span {
            self.run_out(phi, false)
        } else {
            self.end()
        };
        let after = if phi < 0.0 {
            Jet::default()
        } else if phi < first {
            self.run_up(phi, true)
        } else if phi < second {
            self.uniform(phi)
        } else if phi < figures.span {
            self.run_out(phi, true)
        } else {
            self.end()
        };
        [before, after]
    }

    fn run_up(&self, phi: f64, after: bool) -> Jet {
        let (stroke, span) = (self.figures.stroke_run_up, self.figures.angle_run_up);
        scaled(self.law_side(&self.run_up, phi / span, after), stroke, span)
    }

    fn run_out(&self, phi: f64, after: bool) -> Jet {
        let figures = &self.figures;
        let stroke = figures.stroke - figures.stroke_run_out;
        let span = figures.span - figures.angle_run_out;
        // Counted backwards, what comes after is what the law has before.
        let tau = (figures.span - phi) / span;
        let jet = scaled(self.law_side(&self.run_out, tau, !after), -stroke, -span);
        Jet {
            value: figures.stroke + jet.value,
            ..jet
        }
    }

    fn law_side(&self, section: &RunSection, tau: f64, after: bool) -> Jet {
        let joints = section.law.joints();
        let piece = joints.partition_point(|&joint| if after { joint <= tau } else { joint < tau });
        section.law.jet(piece, tau)
    }

    fn uniform(&self, phi: f64) -> Jet {
        let figures = &self.figures;
        Jet {
            value: figures.stroke_run_up + figures.peak_speed * (phi - figures.angle_run_up),
            first: figures.peak_speed,
            ..Jet::default()
        }
    }

    fn end(&self) -> Jet {
        Jet {
            value: self.figures.stroke,
            ..Jet::default()
        }
    }
}

/// A law over `span` with the stroke `stroke`.
fn scaled(jet: Jet, stroke: f64, span: f64) -> Jet {
    Jet {
        value: stroke * jet.value,
        first: stroke / span * jet.first,
        second: stroke / (span * span) * jet.second,
        third: stroke / (span * span * span) * jet.third,
    }
}
