//! The law that a course prescribes: in closed form where it is a straight
//! line or a pure harmonic, in polynomial spans otherwise.

use super::cycle::{Cycle, Piece};
use super::fit::{Fit, fit_course};
use super::hidden::Target;
use super::prescribed::PrescribedMotion;
use super::rhythm::Rhythm;
use crate::dynamics::model::Law as ModelLaw;
use crate::exact::{LAW_DEGREE, Law, PolynomialSpan, Sine, SpanSource};
use crate::kinematics::motion::DriveMotion;
use crate::kinematics::position::Position;
use std::sync::Arc;

/// A straight line through which further straight position functions go.
#[derive(Clone, Copy, Debug)]
struct Line {
    angle: f64,
    speed: f64,
}

/// The law of a course through the given position functions, drive first.
pub(super) fn law(course: &PrescribedMotion, laws: &[&ModelLaw]) -> Law {
    (course
        .drive_motion()
        .and_then(|motion| closed_form(motion, laws)))
    .unwrap_or_else(|| Law::Spans(Arc::new(CourseLaw::new(course.clone()))))
}

/// A drive of constant speed through straight position functions, at most one
/// sine among them.
fn closed_form(motion: &DriveMotion, laws: &[&ModelLaw]) -> Option<Law> {
    let DriveMotion::Constant { speed, angle } = *motion else {
        return None;
    };
    let mut line = Line { angle, speed };
    let mut sine: Option<Sine> = None;
    for law in laws {
        if let Some([ratio, offset]) = law.position.straight_line() {
            let slope = law.lever * ratio;
            line.angle = slope * line.angle + law.lever * offset;
            line.speed *= slope;
            if let Some(sine) = &mut sine {
                sine.amplitude *= slope;
            }
            continue;
        }
        match &law.position {
            Position::Sine {
                amplitude,
                harmonic,
                phase,
                offset,
            } if sine.is_none() => {
                let frequency = harmonic * line.speed;
                let phase = harmonic * line.angle + phase;
                let amplitude = law.lever * amplitude;
                let place = law.lever * offset;
                (line.angle, line.speed) = (place, 0.0);
                if frequency == 0.0 {
                    line.angle += amplitude * phase.sin();
                } else {
                    sine = Some(with_positive_frequency(amplitude, frequency, phase));
                }
            }
            _ => return None,
        }
    }
    Some(Law::Harmonic {
        mean: line.angle,
        slope: line.speed,
        sines: sine.into_iter().collect(),
    })
}

/// A sine with a positive frequency.
fn with_positive_frequency(amplitude: f64, frequency: f64, phase: f64) -> Sine {
    let sign = frequency.signum();
    Sine {
        amplitude: sign * amplitude,
        frequency: sign * frequency,
        phase: sign * phase,
    }
}

/// A law in spans fitted to a course; the spans of a cycle are made once.
#[derive(Debug)]
pub(super) struct CourseLaw {
    course: PrescribedMotion,
    cycle: Option<Cycle<PolynomialSpan>>,
    /// Speed for ever after the drive has settled, when it is constant.
    uniform: Option<f64>,
}

impl CourseLaw {
    pub(super) fn new(course: PrescribedMotion) -> Self {
        let uniform = match course.rhythm() {
            Rhythm::Uniform(speed) => Some(speed),
            Rhythm::Periodic(..) | Rhythm::None => None,
        };
        Self {
            cycle: Cycle::of(&course),
            course,
            uniform,
        }
    }

    /// A span fitted from `time` on.
    fn fit_span(&self, time: f64, longest: f64) -> PolynomialSpan {
        match fit_course(&self.course, time, longest, Target::Acceleration, None) {
            Some(fit) => span(time, &fit),
            None => PolynomialSpan {
                start: time,
                low: 0.0,
                end: f64::INFINITY,
                value: f64::NAN,
                speed: f64::NAN,
                acceleration: [f64::NAN; LAW_DEGREE + 1],
            },
        }
    }

    /// The motion after the drive has settled, when it is uniform.
    fn straight(&self, time: f64, speed: f64) -> PolynomialSpan {
        let formulas = self.course.formulas(time);
        let now = self.course.at(&formulas, self.course.stages.len(), time);
        PolynomialSpan {
            start: time,
            low: 0.0,
            end: f64::INFINITY,
            value: now.value,
            speed,
            acceleration: [0.0; LAW_DEGREE + 1],
        }
    }

    /// Longest span worth trying from `time` on.
    fn longest_span(&self, time: f64) -> f64 {
        match &self.cycle {
            Some(cycle) => cycle.longest_piece(),
            None => {
                let rest = self.course.formulas(time).until - time;
                if rest.is_finite() {
                    rest
                } else {
                    self.course
                        .time_of_next_turn(time)
                        .min(self.course.farthest(time))
                }
            }
        }
    }
}

impl SpanSource for CourseLaw {
    fn span(&self, time: f64) -> PolynomialSpan {
        if let Some(speed) = self.uniform.filter(|_| time >= self.course.settling_time()) {
            return self.straight(time, speed);
        }
        let fresh = |time: f64, longest: f64| self.fit_span(time, longest);
        let cycle = self.cycle.as_ref();
        match cycle.and_then(|cycle| cycle.at(time, fresh)) {
            Some(place) => PolynomialSpan {
                start: place.start.0,
                low: place.start.1,
                end: place.end,
                value: place.piece.value + place.gained,
                ..place.piece
            },
            None => self.fit_span(time, self.longest_span(time)),
        }
    }
}

impl Piece for PolynomialSpan {
    fn interval(&self) -> (f64, f64) {
        (self.start, self.end)
    }

    fn ending(self, end: f64) -> Self {
        Self { end, ..self }
    }

    fn is_made(&self) -> bool {
        self.value.is_finite()
    }
}

fn span(time: f64, fit: &Fit) -> PolynomialSpan {
    PolynomialSpan {
        start: time,
        low: 0.0,
        end: fit.end,
        value: fit.value,
        speed: fit.speed,
        acceleration: fit.coefficients,
    }
}
