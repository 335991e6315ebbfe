//! Rise, dwell and return of a displacement, shown behind charts over the same axis.

use super::frame::Frame;
use super::{coordinate, width_of};
use std::fmt::Write as _;

/// What a displacement does over a stretch of the horizontal axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PhaseKind {
    /// It grows.
    Rise,
    /// It stays.
    Dwell,
    /// It falls.
    Return,
}

impl PhaseKind {
    /// Its name: `rise`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rise => "rise",
            Self::Dwell => "dwell",
            Self::Return => "return",
        }
    }
}

/// A stretch of the horizontal axis, and what a displacement does there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MotionPhase {
    /// What it does.
    pub kind: PhaseKind,
    /// First place.
    pub from: f64,
    /// Last place.
    pub to: f64,
}

/// A step of less than this share of the stroke is none.
const STILL: f64 = 1e-9;
/// With more phases none can be distinguished.
const MOST: usize = 24;
/// A phase of less than this share of the axis does not make a motion one of phases.
const SHORT: f64 = 0.02;

impl MotionPhase {
    /// The phases of a displacement over ascending places; none where it does one thing alone, or
    /// too many.
    pub fn of(points: &[(f64, f64)]) -> Vec<Self> {
        let finite = points
            .iter()
            .filter(|(x, s)| x.is_finite() && s.is_finite());
        let points: Vec<(f64, f64)> = finite.copied().collect();
        let values = || points.iter().map(|(_, s)| *s);
        let stroke =
            values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min);
        let mut phases: Vec<Self> = Vec::new();
        for pair in points.windows(2).filter(|pair| pair[1].0 > pair[0].0) {
            let step = pair[1].1 - pair[0].1;
            let kind = match step {
                _ if step.abs() <= STILL * stroke => PhaseKind::Dwell,
                _ if step > 0.0 => PhaseKind::Rise,
                _ => PhaseKind::Return,
            };
            match phases.last_mut() {
                Some(last) if last.kind == kind => last.to = pair[1].0,
                _ => phases.push(Self {
                    kind,
                    from: pair[0].0,
                    to: pair[1].0,
                }),
            }
        }
        // (What turns on, and only begins from rest, has no phases.)
        let ends = points.last().map_or(0.0, |last| last.0 - points[0].0);
        let long = |phase: &Self| phase.to - phase.from > SHORT * ends;
        let kind = |phase: &Self| phase.kind;
        let kinds: Vec<PhaseKind> = phases.iter().filter(|one| long(one)).map(kind).collect();
        match phases.len() {
            2..=MOST if kinds.windows(2).any(|pair| pair[0] != pair[1]) => phases,
            _ => Vec::new(),
        }
    }
}

/// Distance of a phase's name from the top of the frame (pixels), as the script has it.
const NAME: f64 = 11.0;

/// The phases in a frame, with their names at its top where there is room.
pub(super) fn draw_phases(phases: &[MotionPhase], frame: &Frame) -> String {
    let mut out = String::new();
    let right = frame.left + frame.width;
    for phase in phases {
        let [from, to] = [phase.from, phase.to].map(|at| frame.x(at).clamp(frame.left, right));
        let name = phase.kind.name();
        let hidden = match to - from > width_of(name) + 4.0 {
            true => "",
            false => " visibility=\"hidden\"",
        };
        let _ = writeln!(
            out,
            "<g class=\"phase {name}\"><rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/><text \
             x=\"{}\" y=\"{}\" text-anchor=\"middle\"{hidden}>{name}</text></g>",
            coordinate(from),
            coordinate(frame.top),
            coordinate(to - from),
            coordinate(frame.height),
            coordinate(0.5 * (from + to)),
            coordinate(frame.top + NAME),
        );
    }
    out
}

#[cfg(test)]
mod tests {
    use super::{MotionPhase, PhaseKind};
    use std::f64::consts::TAU;

    /// Cycloidal rise from 0 to 90, dwell to 150, return to 270, dwell to 360.
    fn displacement(angle: f64) -> f64 {
        let cycloid = |t: f64| t - (TAU * t).sin() / TAU;
        match angle {
            _ if angle < 90.0 => cycloid(angle / 90.0),
            _ if angle < 150.0 => 1.0,
            _ if angle < 270.0 => 1.0 - cycloid((angle - 150.0) / 120.0),
            _ => 0.0,
        }
    }

    #[test]
    fn a_cam_rises_dwells_and_returns_where_its_law_does() {
        let points: Vec<(f64, f64)> = (0..=720)
            .map(|k| 0.5 * f64::from(k))
            .map(|angle| (angle, 12e-3 * displacement(angle)))
            .collect();
        let phases = MotionPhase::of(&points);
        let kinds: Vec<PhaseKind> = phases.iter().map(|phase| phase.kind).collect();
        use PhaseKind::{Dwell, Return, Rise};
        assert_eq!(kinds, [Rise, Dwell, Return, Dwell]);
        for (phase, [from, to]) in
            phases
                .iter()
                .zip([[0.0, 90.0], [90.0, 150.0], [150.0, 270.0], [270.0, 360.0]])
        {
            assert!(
                (phase.from - from).abs() <= 0.5 && (phase.to - to).abs() <= 0.5,
                "{phase:?}"
            );
        }
    }

    #[test]
    fn what_does_one_thing_or_trembles_has_no_phases() {
        let line: Vec<(f64, f64)> = (0..9).map(|k| (f64::from(k), f64::from(k))).collect();
        assert!(MotionPhase::of(&line).is_empty());
        let trembling: Vec<(f64, f64)> =
            (0..99).map(|k| (f64::from(k), f64::from(k % 2))).collect();
        assert!(MotionPhase::of(&trembling).is_empty());
        assert!(MotionPhase::of(&[(0.0, 1.0), (1.0, 1.0)]).is_empty());
        // A motor that begins from rest and turns on.
        let motor: Vec<(f64, f64)> = (0..200)
            .map(|k| (f64::from(k), f64::from(k).max(2.0)))
            .collect();
        assert!(MotionPhase::of(&motor).is_empty());
    }
}
