//! A motion that the drive prescribes: its law over time, led through the
//! position functions of rigid objects.
//!
//! Where any derivative of it jumps (a *joint*: a break of a law, a point of a
//! table) a new formula begins. Which formula holds at an instant is decided
//! once, for the motion just after it; polynomials are then fitted to that
//! formula alone and end where the motion leaves it.

use super::hidden::{self, Target};
use crate::kinematics::breaks::Breaks;
use crate::kinematics::motion::DriveMotion;
use crate::kinematics::position::Position;
use std::f64::consts::TAU;

/// Rounding of a place on an axis, in units of the numbers that make it.
pub(crate) const PLACE_ROUNDING: f64 = 16.0 * f64::EPSILON;

/// A position function on the way, with its factor.
#[derive(Clone, Debug)]
pub(crate) struct Stage {
    pub(super) position: Position,
    pub(super) lever: f64,
    breaks: Breaks,
}

impl Stage {
    /// lever·U.
    pub(crate) fn new(position: &Position, lever: f64) -> Self {
        Self {
            position: position.clone(),
            lever,
            breaks: position.breaks(),
        }
    }
}

/// The prescribed motion of a node.
#[derive(Clone, Debug)]
pub(crate) struct PrescribedMotion {
    source: Source,
    pub(crate) stages: Vec<Stage>,
}

/// Source of a prescribed motion.
#[derive(Clone, Debug)]
enum Source {
    /// A drive.
    Drive {
        motion: DriveMotion,
        /// Breaks and joints of the motion over time.
        breaks: Breaks,
        joints: Breaks,
        /// What counts of an expression that repeats or is bounded: of its displacement
        /// and of its acceleration.
        least: [f64; 2],
    },
    /// Σ ratio·φ + offset of several prescribed motions.
    Sum {
        terms: Vec<(f64, PrescribedMotion)>,
        offset: f64,
    },
}

/// The formulas in force just after an instant.
#[derive(Clone, Debug)]
pub(crate) struct Formulas {
    /// Piece of the drive's motion.
    piece: i64,
    /// Formulas of the terms of a sum.
    pub(crate) terms: Vec<Formulas>,
    /// Time at which the motion's formula changes (s).
    pub(crate) until: f64,
    /// For each stage its segment, and the limits of its argument.
    segments: Vec<i64>,
    pub(crate) limits: Vec<(f64, f64)>,
}

/// A motion at an instant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Instant {
    pub(crate) value: f64,
    pub(crate) speed: f64,
    pub(crate) acceleration: f64,
    /// Magnitudes of the numbers whose rounding is in the displacement.
    pub(crate) span: f64,
    /// The same for the acceleration.
    pub(crate) size: f64,
}

impl PrescribedMotion {
    /// A drive's own motion.
    pub(crate) fn new(motion: &DriveMotion) -> Self {
        let breaks = motion.breaks();
        let least = match motion {
            DriveMotion::Written(written) => [Target::Displacement, Target::Acceleration]
                .map(|target| hidden::least_size(written, target)),
            _ => [0.0; 2],
        };
        Self {
            stages: Vec::new(),
            source: Source::Drive {
                least,
                motion: motion.clone(),
                joints: Breaks {
                    points: motion.joints(),
                    period: breaks.period,
                },
                breaks,
            },
        }
    }

    /// Σ ratio·φ + offset of prescribed motions; of uniform ones again a uniform one.
    pub(crate) fn sum(terms: Vec<(f64, Self)>, offset: f64) -> Self {
        let lines = terms.iter().map(|(ratio, term)| {
            let (speed, angle) = term.line()?;
            Some((ratio * speed, ratio * angle))
        });
        if let Some(lines) = lines.collect::<Option<Vec<(f64, f64)>>>() {
            return Self::new(&DriveMotion::Constant {
                speed: lines.iter().map(|line| line.0).sum(),
                angle: lines.iter().map(|line| line.1).sum::<f64>() + offset,
            });
        }
        Self {
            source: Source::Sum { terms, offset },
            stages: Vec::new(),
        }
    }

    /// Speed and displacement at t = 0 of a motion of constant speed.
    pub(crate) fn line(&self) -> Option<(f64, f64)> {
        let Some(&DriveMotion::Constant { speed, angle }) = self.drive_motion() else {
            return None;
        };
        let through = |(speed, angle): (f64, f64), stage: &Stage| {
            let [ratio, offset] = stage.position.straight_line()?;
            let slope = stage.lever * ratio;
            Some((slope * speed, slope * angle + stage.lever * offset))
        };
        self.stages.iter().try_fold((speed, angle), through)
    }

    /// The motion of the drive that it comes from; `None`: from several.
    pub(crate) fn drive_motion(&self) -> Option<&DriveMotion> {
        match &self.source {
            Source::Drive { motion, .. } => Some(motion),
            Source::Sum { .. } => None,
        }
    }

    /// True when it comes from several drives, or from one in several ways.
    pub(crate) fn is_sum(&self) -> bool {
        self.drive_motion().is_none()
    }

    /// The motions that it is the sum of; none where it comes from one drive.
    pub(crate) fn terms(&self) -> &[(f64, Self)] {
        match &self.source {
            Source::Drive { .. } => &[],
            Source::Sum { terms, .. } => terms,
        }
    }

    /// Time itself as a motion.
    pub(crate) fn time() -> Self {
        Self::new(&DriveMotion::Constant {
            speed: 1.0,
            angle: 0.0,
        })
    }

    /// This motion led through one more position function.
    pub(crate) fn through_position(&self, position: &Position, lever: f64) -> Self {
        let mut on = self.clone();
        on.stages.push(Stage::new(position, lever));
        on
    }

    /// Time from which on the drive turns uniformly, or goes on by one formula,
    /// or repeats itself (s).
    pub(crate) fn settling_time(&self) -> f64 {
        let joints = match &self.source {
            Source::Drive { joints, .. } => joints,
            Source::Sum { terms, .. } => {
                let settled = terms.iter().map(|(_, term)| term.settling_time());
                return settled.fold(0.0, f64::max);
            }
        };
        match (joints.period, joints.points.last()) {
            (None, Some(last)) => last.max(0.0),
            _ => 0.0,
        }
    }

    /// The first joint of the motion over time after `time`; +∞: there is none.
    fn joint_after(&self, time: f64) -> f64 {
        let Source::Drive { joints, .. } = &self.source else {
            let next = self.terms().iter().map(|(_, term)| term.joint_after(time));
            return next.fold(f64::INFINITY, f64::min);
        };
        let later = |joint: &f64| *joint > time + rounding_of_instants(time, *joint);
        let found = match joints.period {
            None => joints.points.iter().copied().find(later),
            Some(_) => {
                let now = joints.segment_at(time, 1.0);
                let ahead = now..=now + joints.points.len() as i64 + 1;
                let mut ends = ahead.map(|segment| joints.edges(segment).1);
                ends.find(later)
            }
        };
        found.unwrap_or(f64::INFINITY)
    }

    /// True where samples of an interval show all that the drives do in it. Motions by
    /// named laws do nothing that they do not show.
    pub(super) fn is_resolved_by_samples(
        &self,
        formulas: &Formulas,
        (time, length): (f64, f64),
        target: Target,
    ) -> bool {
        match &self.source {
            Source::Sum { terms, .. } => {
                let mut each = terms.iter().zip(&formulas.terms);
                each.all(|((_, term), own)| {
                    term.is_resolved_by_samples(own, (time, length), target)
                })
            }
            Source::Drive { motion, least, .. } => match motion {
                DriveMotion::Written(written) => {
                    let least = least[target as usize];
                    hidden::is_resolved_by_samples(
                        written,
                        formulas.piece,
                        (time, length),
                        target,
                        least,
                    )
                }
                DriveMotion::Constant { .. }
                | DriveMotion::Accelerated { .. }
                | DriveMotion::RunUp { .. }
                | DriveMotion::Plan(_)
                | DriveMotion::LawRunUp(_)
                | DriveMotion::Table(_) => true,
            },
        }
    }

    /// The size that an expression of the time which repeats or is bounded has everywhere;
    /// 0 for other motions.
    pub(super) fn least_size(&self, target: Target) -> f64 {
        match &self.source {
            Source::Drive { least, .. } if self.stages.is_empty() => least[target as usize],
            _ => 0.0,
        }
    }

    /// Rounding of an expression of the time that it comes from, or of its acceleration,
    /// in units of the number that would be rounded so in one operation.
    pub(super) fn noise(&self, formulas: &Formulas, time: f64, target: Target) -> f64 {
        match &self.source {
            Source::Drive {
                motion: DriveMotion::Written(written),
                ..
            } if self.stages.is_empty() => hidden::size_at(written, formulas.piece, time, target),
            _ => 0.0,
        }
    }

    /// True when an expression of the time is among what it comes from: its rounding is
    /// not known from its value and derivatives.
    pub(super) fn is_written(&self) -> bool {
        match &self.source {
            Source::Sum { terms, .. } => terms.iter().any(|(_, term)| term.is_written()),
            Source::Drive { motion, .. } => matches!(motion, DriveMotion::Written(_)),
        }
    }

    /// About the time that the drive takes for its next turn from `time` on
    /// (s); +∞ at rest.
    pub(crate) fn time_of_next_turn(&self, time: f64) -> f64 {
        if self.is_sum() {
            let turns = self
                .terms()
                .iter()
                .map(|(_, term)| term.time_of_next_turn(time));
            return turns.fold(f64::INFINITY, f64::min);
        }
        let now = self.at(&self.formulas(time), 0, time);
        TAU / (now.speed.abs() + (TAU * now.acceleration.abs()).sqrt())
    }

    /// Longest interval from `time` on that is worth looking at (s). Of an expression, which
    /// is looked at for what samples do not show, it grows with the time.
    pub(super) fn farthest(&self, time: f64) -> f64 {
        match self.is_written() {
            true => (64.0 * (1.0 + time.abs())).min(1e9),
            false => 1e9,
        }
    }

    /// The formulas in force just after `time`.
    pub(crate) fn formulas(&self, time: f64) -> Formulas {
        let piece = match &self.source {
            Source::Drive { breaks, .. } => {
                breaks.segment_at(time + rounding_of_instants(time, 0.0), 1.0)
            }
            Source::Sum { .. } => 0,
        };
        let terms = self.terms().iter().map(|(_, term)| term.formulas(time));
        let mut formulas = Formulas {
            piece,
            terms: terms.collect(),
            until: self.joint_after(time),
            segments: Vec::with_capacity(self.stages.len()),
            limits: Vec::with_capacity(self.stages.len()),
        };
        for stage in &self.stages {
            let limits = self.interval_around(&stage.breaks, &formulas, time);
            // Any place between two breaks tells the segment.
            let inside = place_inside(limits);
            formulas.segments.push(stage.breaks.segment_at(inside, 1.0));
            formulas.limits.push(limits);
        }
        formulas
    }

    /// The interval between two points of `axis` in which the motion, through
    /// as many stages as have their formulas, goes on just after `time`.
    pub(crate) fn interval_around(
        &self,
        axis: &Breaks,
        formulas: &Formulas,
        time: f64,
    ) -> (f64, f64) {
        if axis.is_empty() {
            return (f64::NEG_INFINITY, f64::INFINITY);
        }
        let depth = formulas.segments.len();
        let now = self.at(formulas, depth, time);
        let mut sense = now.speed;
        if sense.abs() <= PLACE_ROUNDING * now.span {
            // At rest: look where it goes.
            let ahead = (formulas.until - time).min(1.0) * 1e-4;
            sense = self.at(formulas, depth, time + ahead).value - now.value;
        }
        let nudge = PLACE_ROUNDING * now.span;
        let place = now.value + nudge * if sense < 0.0 { -1.0 } else { 1.0 };
        axis.edges(axis.segment_at(place, sense))
    }

    /// The motion after its first `depth` stages at `time`.
    pub(crate) fn at(&self, formulas: &Formulas, depth: usize, time: f64) -> Instant {
        let mut now = self.source.at(formulas, time);
        for (stage, &segment) in self.stages.iter().zip(&formulas.segments).take(depth) {
            let jet = stage.position.jet(segment, now.value).scaled(stage.lever);
            let square = now.speed * now.speed;
            now = Instant {
                value: jet.value,
                speed: jet.first * now.speed,
                acceleration: jet.first * now.acceleration + jet.second * square,
                span: jet.value.abs() + jet.first.abs() * now.span,
                // U″ is rounded as its argument is.
                size: jet.first.abs() * now.size
                    + (jet.second.abs() + jet.third.abs() * now.span) * square,
            };
        }
        now
    }
}

impl Source {
    /// The motion at `time`.
    fn at(&self, formulas: &Formulas, time: f64) -> Instant {
        match self {
            Self::Drive { motion, .. } => {
                let jet = motion.jet(formulas.piece, time);
                Instant {
                    value: jet.value,
                    speed: jet.first,
                    acceleration: jet.second,
                    span: jet.value.abs() + (jet.first * time).abs(),
                    size: jet.second.abs() + (jet.third * time).abs(),
                }
            }
            Self::Sum { terms, offset } => {
                let mut sum = Instant {
                    value: *offset,
                    span: offset.abs(),
                    ..Instant::default()
                };
                for ((ratio, term), formulas) in terms.iter().zip(&formulas.terms) {
                    let now = term.at(formulas, term.stages.len(), time);
                    sum.value += ratio * now.value;
                    sum.speed += ratio * now.speed;
                    sum.acceleration += ratio * now.acceleration;
                    sum.span += ratio.abs() * now.span;
                    sum.size += ratio.abs() * now.size;
                }
                sum
            }
        }
    }
}

/// Rounding of two instants.
fn rounding_of_instants(a: f64, b: f64) -> f64 {
    PLACE_ROUNDING * a.abs().max(b.abs())
}

/// A place well inside an interval that may be open to one side or both.
pub(crate) fn place_inside((low, high): (f64, f64)) -> f64 {
    match (low.is_finite(), high.is_finite()) {
        (true, true) => 0.5 * (low + high),
        (true, false) => low + low.abs().max(1.0),
        (false, true) => high - high.abs().max(1.0),
        (false, false) => 0.0,
    }
}
