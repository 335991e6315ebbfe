//! The law that a course prescribes: in closed form where it is a straight
//! line or a pure harmonic, in polynomial spans otherwise.

use super::fit::{Fit, Target, fit};
use super::prescribed::{PrescribedMotion, straight};
use super::rhythm::Rhythm;
use crate::dynamics::model::Law as ModelLaw;
use crate::exact::law::product;
use crate::exact::{LAW_DEGREE, Law, PolynomialSpan, Sine, SpanSource};
use crate::kinematics::motion::DriveMotion;
use crate::kinematics::position::Position;
use std::sync::{Arc, OnceLock};

/// Most spans kept of a cycle; a law that needs more is made as it is reached.
const MOST_SPANS: usize = 4096;

/// A straight line through which further straight position functions go.
#[derive(Clone, Copy, Debug)]
struct Line {
    angle: f64,
    speed: f64,
}

/// The law of a course through the given position functions, drive first.
pub(super) fn law(course: &PrescribedMotion, laws: &[&ModelLaw]) -> Law {
    (course.drive().and_then(|motion| closed_form(motion, laws)))
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
        if let Some((ratio, offset)) = straight(&law.position) {
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
                    sine = Some(turned(amplitude, frequency, phase));
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
fn turned(amplitude: f64, frequency: f64, phase: f64) -> Sine {
    let sign = frequency.signum();
    Sine {
        amplitude: sign * amplitude,
        frequency: sign * frequency,
        phase: sign * phase,
    }
}

/// A cycle that repeats for ever.
#[derive(Clone, Copy, Debug)]
struct Cycle {
    /// Time at which the first cycle begins (s).
    from: f64,
    /// Length of a cycle (s).
    period: f64,
    /// L gained in it.
    advance: f64,
}

/// A law in spans fitted to a course; the spans of a cycle are made once.
#[derive(Debug)]
pub(super) struct CourseLaw {
    course: PrescribedMotion,
    cycle: Option<Cycle>,
    /// Speed for ever after the drive has settled, when it is constant.
    uniform: Option<f64>,
    /// Spans of the first cycle, from its beginning; empty: too many to keep.
    spans: OnceLock<Vec<PolynomialSpan>>,
}

impl CourseLaw {
    pub(super) fn new(course: PrescribedMotion) -> Self {
        let from = course.settled();
        let (mut cycle, mut uniform) = (None, None);
        match course.rhythm() {
            Rhythm::Periodic(period, advance) => {
                cycle = Some(Cycle {
                    from,
                    period,
                    advance,
                });
            }
            Rhythm::Uniform(speed) => uniform = Some(speed),
            Rhythm::None => {}
        }
        Self {
            course,
            cycle,
            uniform,
            spans: OnceLock::new(),
        }
    }

    /// A span fitted from `time` on.
    fn fresh(&self, time: f64, longest: f64) -> PolynomialSpan {
        match fit(&self.course, time, longest, Target::Acceleration, None) {
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
    fn longest(&self, time: f64) -> f64 {
        match self.cycle {
            Some(cycle) => 0.5 * cycle.period,
            None => {
                let rest = self.course.formulas(time).until - time;
                if rest.is_finite() {
                    rest
                } else {
                    self.course.turn(time).min(1e9)
                }
            }
        }
    }

    fn cycle_spans(&self, cycle: &Cycle) -> &[PolynomialSpan] {
        self.spans.get_or_init(|| {
            let end = cycle.from + cycle.period;
            let mut spans: Vec<PolynomialSpan> = Vec::new();
            let (mut time, mut last) = (cycle.from, f64::INFINITY);
            while time < end {
                let rest = end - time;
                let made = self.fresh(time, rest.min(self.longest(time)).min(4.0 * last));
                if spans.len() >= MOST_SPANS || !made.value.is_finite() {
                    return Vec::new();
                }
                last = made.end - time;
                // A remainder below the clock's resolution is no span.
                let done = end - made.end <= 64.0 * f64::EPSILON * end.abs();
                time = if done { end } else { made.end };
                spans.push(PolynomialSpan { end: time, ..made });
            }
            spans
        })
    }
}

impl SpanSource for CourseLaw {
    fn span(&self, time: f64) -> PolynomialSpan {
        if let Some(speed) = self.uniform.filter(|_| time >= self.course.settled()) {
            return self.straight(time, speed);
        }
        let fresh = || self.fresh(time, self.longest(time));
        let Some(cycle) = self.cycle.filter(|cycle| time >= cycle.from) else {
            return fresh();
        };
        let spans = self.cycle_spans(&cycle);
        if spans.is_empty() {
            return fresh();
        }
        let turn = ((time - cycle.from) / cycle.period).floor();
        // Rounding may put an instant into the cycle beside it.
        for turn in [turn - 1.0, turn, turn + 1.0] {
            let starts = |span: &PolynomialSpan| shifted(span.start, turn, cycle.period).0 <= time;
            let count = spans.partition_point(starts);
            let Some(span) = count.checked_sub(1).map(|k| &spans[k]) else {
                continue;
            };
            let end = shifted(span.end, turn, cycle.period).0;
            if time < end {
                let (start, low) = shifted(span.start, turn, cycle.period);
                return PolynomialSpan {
                    start,
                    low,
                    end,
                    value: span.value + turn * cycle.advance,
                    ..*span
                };
            }
        }
        fresh()
    }
}

/// time + turn·period in double-double: (sum, rounding error).
fn shifted(time: f64, turn: f64, period: f64) -> (f64, f64) {
    let (whole, rest) = product(turn, period);
    let sum = whole + time;
    let part = sum - whole;
    let error = (whole - (sum - part)) + (time - part);
    (sum, error + rest)
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
