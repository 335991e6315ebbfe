//! A cam with one rise and one return per turn.

use super::spec::CamSpec;
use crate::fault::{Fault, Faults};
use crate::kinematics::breaks::Breaks;
use crate::kinematics::motion::{Law, LawSpec};
use crate::math::fourier::{Terms, TermsOnInterval};
use crate::math::jet::Jet;
use crate::units::shown;
use std::f64::consts::TAU;

/// A cam: θ = φ + phase runs through rise, upper dwell, return and rest, once
/// a turn (see [`CamSpec`]).
///
/// Break points lie at every joint of these and at the joints inside a law
/// (modified trapezoid). U and U′ are continuous everywhere; U″ too, except at
/// the soft shocks of its laws ([`crate::kinematics::motion::law::LawConstants`]).
#[derive(Clone, Debug, PartialEq)]
pub struct Cam {
    spec: CamSpec,
    /// The laws of rise and return.
    laws: [Law; 2],
    breaks: Breaks,
    /// Pieces, one for each break point: what holds after it.
    pieces: Vec<Piece>,
}

#[derive(Clone, Debug, PartialEq)]
enum Piece {
    Dwell(f64),
    /// τ = (φ − origin)/span, within the first turn; a return has span < 0 and
    /// is measured from its end, so that U goes to zero without rounding.
    Motion {
        /// 0: rise, 1: return.
        law: usize,
        part: usize,
        origin: f64,
        span: f64,
    },
}

/// Angles below this are nothing (rad): 360 deg given in parts must add up.
const NO_ANGLE: f64 = 1e-9;

impl Cam {
    /// A cam as described.
    ///
    /// # Errors
    /// Angles that are not positive or exceed a turn, faulty laws; paths
    /// relative to `position`.
    pub fn new(spec: &CamSpec) -> Result<Self, Vec<Fault>> {
        let mut faults = Faults::default();
        faults.finite("cam.lift", spec.lift);
        faults.positive("cam.rise", spec.rise);
        faults.not_negative("cam.dwell", spec.dwell);
        faults.positive("cam.return", spec.return_angle);
        faults.finite("cam.phase", spec.phase);
        let mut law = |path: &str, law: &LawSpec| match Law::of_stroke(law) {
            Ok(law) => Some(law),
            Err(found) => {
                faults.absorb(path, found);
                None
            }
        };
        let rise = law("cam.law.rise", &spec.rise_law);
        let back = law("cam.law.return", &spec.return_law);
        faults.check()?;
        for (path, angle) in [("cam.rise", spec.rise), ("cam.return", spec.return_angle)] {
            if angle < NO_ANGLE {
                let message = format!("{angle} rad is too short for a motion");
                faults.add(path, message, "give an angle of some degrees");
            }
        }
        faults.check()?;
        let total = spec.rise + spec.dwell + spec.return_angle;
        if total > TAU + NO_ANGLE {
            let message = format!(
                "rise, dwell and return make {} deg, more than a turn",
                shown(total.to_degrees(), 7)
            );
            let hint = "make rise + dwell + return at most 360 deg; what is left is the rest";
            faults.add("cam", message, hint);
            faults.check()?;
        }
        let (Some(rise), Some(back)) = (rise, back) else {
            return Err(Vec::new());
        };
        let mut cam = Self {
            spec: spec.clone(),
            laws: [rise, back],
            breaks: Breaks {
                points: Vec::new(),
                period: Some(TAU),
            },
            pieces: Vec::new(),
        };
        cam.lay_out();
        Ok(cam)
    }

    /// Fills break points and pieces from the description.
    fn lay_out(&mut self) {
        let start = -self.spec.phase;
        let top = start + self.spec.rise;
        let fall = top + self.spec.dwell;
        let end = (fall + self.spec.return_angle).min(start + TAU);
        self.add_law(0, start, top);
        if self.spec.dwell > NO_ANGLE {
            self.add(top, Piece::Dwell(self.spec.lift));
        }
        self.add_law(1, fall, end);
        if start + TAU - end > NO_ANGLE {
            self.add(end, Piece::Dwell(0.0));
        }
    }

    /// The pieces of a law; the return's is run backwards.
    fn add_law(&mut self, law: usize, from: f64, to: f64) {
        let backwards = law == 1;
        let joints = self.laws[law].joints().to_vec();
        let parts = joints.len() + 1;
        let (origin, span) = if backwards {
            (to, from - to)
        } else {
            (from, to - from)
        };
        for step in 0..parts {
            let part = if backwards { parts - 1 - step } else { step };
            let begins = match step {
                0 => from,
                _ if backwards => origin + span * joints[part],
                _ => origin + span * joints[part - 1],
            };
            let piece = Piece::Motion {
                law,
                part,
                origin,
                span,
            };
            self.add(begins, piece);
        }
    }

    fn add(&mut self, begins: f64, piece: Piece) {
        self.breaks.points.push(begins);
        self.pieces.push(piece);
    }

    /// U over one turn in closed form, piece by piece.
    pub(crate) fn closed_form(&self) -> Vec<TermsOnInterval> {
        let piece = |(index, own): (usize, &Piece)| {
            let (from, to) = self.breaks.edges(index as i64);
            let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
            let terms = match own {
                Piece::Dwell(value) => Terms::constant(*value),
                Piece::Motion {
                    law,
                    part,
                    origin,
                    span,
                } => {
                    let place = [(middle - origin) / span, half / span];
                    self.laws[*law]
                        .terms(*part, place)
                        .scaled(0.0, self.spec.lift)
                }
            };
            TermsOnInterval {
                middle,
                half,
                terms,
            }
        };
        self.pieces.iter().enumerate().map(piece).collect()
    }

    /// U and its derivatives at `phi` by the formula of `segment`.
    pub fn jet(&self, segment: i64, phi: f64) -> Jet {
        let (piece, turned) = self.breaks.piece(segment);
        match self.pieces[piece] {
            Piece::Dwell(value) => Jet {
                value,
                ..Jet::default()
            },
            Piece::Motion {
                law,
                part,
                origin,
                span,
            } => {
                let jet = self.laws[law].jet(part, (phi - turned - origin) / span);
                let lift = self.spec.lift;
                Jet {
                    value: lift * jet.value,
                    first: lift / span * jet.first,
                    second: lift / (span * span) * jet.second,
                    third: lift / (span * span * span) * jet.third,
                }
            }
        }
    }

    /// Breaks: where the formula changes.
    pub fn breaks(&self) -> &Breaks {
        &self.breaks
    }

    /// Numbers that it was made from.
    pub fn spec(&self) -> &CamSpec {
        &self.spec
    }
}

#[cfg(test)]
mod tests {
    use super::Cam;
    use crate::kinematics::motion::{Law, LawName};
    use crate::kinematics::position::CamSpec;
    use std::f64::consts::TAU;

    fn spec(law: LawName) -> CamSpec {
        CamSpec {
            lift: 0.02,
            rise: 120f64.to_radians(),
            dwell: 40f64.to_radians(),
            return_angle: 100f64.to_radians(),
            rise_law: law.into(),
            return_law: LawName::ModifiedTrapezoid.into(),
            phase: 0.7,
        }
    }

    #[test]
    fn stations_of_a_turn_and_continuity_at_every_joint() {
        for law in LawName::ALL {
            let cam = Cam::new(&spec(law)).unwrap();
            let breaks = cam.breaks();
            let joints = Law::of_stroke(&law.into()).unwrap().joints().len();
            assert_eq!(breaks.points.len(), 1 + joints + 1 + 5 + 1);
            for segment in -30..30 {
                let edge = breaks.edges(segment).0;
                let (left, right) = (cam.jet(segment - 1, edge), cam.jet(segment, edge));
                assert!((left.value - right.value).abs() < 1e-15, "{law:?} {edge}");
                assert!((left.first - right.first).abs() < 1e-13, "{law:?} {edge}");
                if ![LawName::Harmonic, LawName::Parabolic].contains(&law) {
                    assert!((left.second - right.second).abs() < 1e-12, "{law:?} {edge}");
                }
            }
            for turn in [-2.0, 0.0, 5.0] {
                for (degrees, value) in [
                    (0.0, 0.0),
                    (60.0, 0.01),
                    (140.0, 0.02),
                    (210.0, 0.01),
                    (300.0, 0.0),
                ] {
                    let phi = f64::to_radians(degrees) - 0.7 + turn * TAU;
                    let jet = cam.jet(breaks.segment_at(phi, 1.0), phi);
                    approx::assert_abs_diff_eq!(jet.value, value, epsilon = 1e-15);
                }
            }
        }
    }

    #[test]
    fn parts_that_fill_the_turn_leave_no_sliver_of_rest() {
        let third = 120f64.to_radians();
        let full = CamSpec {
            rise: third,
            dwell: third,
            return_angle: third * (1.0 + 1e-15),
            ..spec(LawName::Cycloidal)
        };
        let cam = Cam::new(&full).unwrap();
        assert_eq!(cam.breaks().points.len(), 1 + 1 + 5);
        let too_much = CamSpec {
            dwell: third + 0.001,
            ..full.clone()
        };
        assert_eq!(Cam::new(&too_much).unwrap_err()[0].path, "cam");
        let no_dwell = CamSpec { dwell: 0.0, ..full };
        assert_eq!(
            Cam::new(&no_dwell).unwrap().breaks().points.len(),
            1 + 5 + 1
        );
    }
}
