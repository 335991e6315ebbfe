//! The motion for which forces are asked.

use crate::kinematics::linkage::kinetostatics::{InputMotion, Positions};
use crate::studies::endless::DeadEnd;

/// Gives the positions of a linkage at an input coordinate.
pub trait PositionSource {
    /// Positions that the source gives.
    type At: Positions;
    /// Positions and transfer functions at `coordinate`.
    ///
    /// # Errors
    ///
    /// The linkage cannot be assembled there: why.
    fn at(&mut self, coordinate: f64) -> Result<&Self::At, String>;

    /// Input coordinates of singular positions that the linkage passes, and the period after
    /// which they come again, as far as they are known.
    fn singular(&self) -> (Vec<f64>, Option<f64>) {
        (Vec::new(), None)
    }

    /// Dead-centre positions at which the reach ends, by input coordinates, as far as they are known.
    fn limits(&self) -> Vec<DeadEnd> {
        Vec::new()
    }

    /// Forces on the outputs (N·m or N) that follow from a motion of the input, along each output;
    /// outputs beyond the list have none.
    fn loads(&self, _input: InputMotion) -> Vec<f64> {
        Vec::new()
    }

    /// Input coordinates between two of them on either side of a jump or a kink of these forces.
    fn load_places(&self, _between: [f64; 2], _speed: f64) -> Vec<f64> {
        Vec::new()
    }

    /// Names of the loads that they come from.
    fn load_names(&self) -> Vec<String> {
        Vec::new()
    }
}

/// Question about one position: motion of the input, loads, direction.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Instant {
    /// Motion of the input.
    pub motion: InputMotion,
    /// Forces of what hangs on the outputs, along each (N·m or N); none where
    /// the list is shorter.
    pub loads: Vec<f64>,
    /// Direction (its sign) in which a motion over time goes on from rest, or, at
    /// its end, came to rest; `None` where it moves, and in the midst of a dwell.
    pub direction: Option<f64>,
}

/// The positions of the input in question.
#[derive(Clone, Debug, PartialEq)]
pub enum Course {
    /// Equal steps of the input coordinate, all with the same speed and acceleration.
    Even {
        /// First input coordinate (rad or m).
        from: f64,
        /// Last; of a closed course one step after the last position.
        to: f64,
        /// Number of positions.
        count: usize,
        /// Speed of the input.
        speed: f64,
        /// Acceleration of the input.
        acceleration: f64,
        /// The course ends where it begins: a full turn.
        closed: bool,
    },
    /// A motion over time, at instants that come one after another.
    Instants {
        /// Times (s).
        times: Vec<f64>,
        /// Instants on the course.
        instants: Vec<Instant>,
        /// The motion repeats, and the last instant is the first of the next cycle.
        closed: bool,
    },
}

impl Course {
    /// Number of positions.
    pub fn len(&self) -> usize {
        match self {
            Self::Even { count, .. } => *count,
            Self::Instants { instants, .. } => instants.len(),
        }
    }

    /// True without positions.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// True where forces on the outputs belong to it.
    pub fn has_loads(&self) -> bool {
        match self {
            Self::Even { .. } => false,
            Self::Instants { instants, .. } => instants.iter().any(|one| !one.loads.is_empty()),
        }
    }

    /// True if it ends where it begins.
    pub fn is_closed(&self) -> bool {
        match self {
            Self::Even { closed, .. } | Self::Instants { closed, .. } => *closed,
        }
    }

    /// Parameter along the course: the input coordinate, or the time.
    pub fn parameter(&self, index: usize) -> f64 {
        match self {
            Self::Even { from, .. } => from + self.step() * index as f64,
            Self::Instants { times, .. } => times[index],
        }
    }

    /// The time of a position; `None` where the course is none over time.
    pub fn time(&self, index: usize) -> Option<f64> {
        match self {
            Self::Even { .. } => None,
            Self::Instants { times, .. } => times.get(index).copied(),
        }
    }

    /// Instant at a position.
    pub fn instant(&self, index: usize) -> Instant {
        match self {
            Self::Even { .. } => self.instant_at(self.parameter(index)),
            Self::Instants { instants, .. } => {
                let moves = |index: Option<usize>| instants.get(index?).and_then(sign);
                let next = moves(index.checked_add(1));
                Instant {
                    direction: next.or_else(|| moves(index.checked_sub(1))),
                    ..instants[index].clone()
                }
            }
        }
    }

    /// Instant anywhere on the course: between instants the coordinate is cubic,
    /// accelerations and loads are linear.
    pub fn instant_at(&self, parameter: f64) -> Instant {
        match self {
            Self::Even {
                speed,
                acceleration,
                ..
            } => Instant {
                motion: InputMotion {
                    coordinate: parameter,
                    speed: *speed,
                    acceleration: *acceleration,
                },
                ..Instant::default()
            },
            Self::Instants {
                times, instants, ..
            } => {
                let above = times.partition_point(|time| *time <= parameter);
                let index = above.clamp(1, times.len().max(2) - 1);
                match (instants.get(index - 1), instants.get(index)) {
                    (Some(a), Some(b)) => {
                        cubic_between([times[index - 1], times[index]], [a, b], parameter)
                    }
                    (Some(only), _) => only.clone(),
                    _ => Instant::default(),
                }
            }
        }
    }

    /// Distance of two positions of an even course.
    fn step(&self) -> f64 {
        match self {
            Self::Even {
                from,
                to,
                count,
                closed,
                ..
            } => {
                let intervals = if *closed {
                    *count
                } else {
                    count.saturating_sub(1)
                };
                (to - from) / intervals.max(1) as f64
            }
            Self::Instants { .. } => 0.0,
        }
    }

    /// The lesser end of the course and the greater, in its parameter; `None` where it has no
    /// length.
    pub(super) fn ends(&self) -> Option<[f64; 2]> {
        let [from, to] = match self {
            Self::Even { from, to, .. } => [*from, *to],
            Self::Instants { times, .. } => [*times.first()?, *times.last()?],
        };
        (from != to && (to - from).is_finite()).then(|| [from.min(to), from.max(to)])
    }

    /// Parameter of a position at a dead-centre position: of an even course that of the dead-centre position
    /// itself.
    pub(super) fn place_of(&self, index: usize, end: &DeadEnd) -> f64 {
        match self {
            Self::Even { .. } => end.at,
            Self::Instants { times, .. } => times[index],
        }
    }

    /// Number of rows that are shown: the positions, and of a turn its end, at which
    /// everything is again as at first.
    pub fn rows(&self) -> usize {
        match self {
            Self::Even { closed, .. } => self.len() + usize::from(*closed),
            Self::Instants { .. } => self.len(),
        }
    }

    /// Length of a closed course in its parameter.
    pub fn period(&self) -> Option<f64> {
        match self {
            Self::Even {
                from, to, closed, ..
            } => closed.then_some(to - from),
            Self::Instants { times, closed, .. } => {
                let ends = times.first().zip(times.last()).filter(|_| *closed);
                ends.map(|(first, last)| last - first)
            }
        }
    }

    /// The intervals between the positions in the course's parameter, and the
    /// time that goes by with a unit of it; `None` where the input rests.
    pub(super) fn panels(&self) -> Option<(Vec<[f64; 2]>, f64)> {
        let (count, pace) = match self {
            Self::Even {
                speed,
                count,
                closed,
                ..
            } => (
                count.saturating_sub(usize::from(!closed)),
                speed.abs().recip(),
            ),
            Self::Instants { times, .. } => (times.len().saturating_sub(1), 1.0),
        };
        let panel = |index: usize| [self.parameter(index), self.parameter(index + 1)];
        let panels: Vec<_> = (0..count).map(panel).collect();
        let length: f64 = panels.iter().map(|[from, to]| (to - from).abs()).sum();
        let duration = length * pace;
        (duration.is_finite() && duration > 0.0).then_some((panels, pace))
    }
}

/// The sense of the motion at an instant; `None` at rest.
fn sign(instant: &Instant) -> Option<f64> {
    let speed = instant.motion.speed;
    (speed != 0.0).then(|| speed.signum())
}

/// Between two instants.
fn cubic_between([t0, t1]: [f64; 2], [from, to]: [&Instant; 2], t: f64) -> Instant {
    let h = t1 - t0;
    if h.is_nan() || h <= 0.0 {
        return from.clone();
    }
    let s = ((t - t0) / h).clamp(0.0, 1.0);
    let (a, b) = (&from.motion, &to.motion);
    let (d0, d1) = (a.speed * h, b.speed * h);
    let rise = b.coordinate - a.coordinate;
    let (c2, c3) = (3.0 * rise - 2.0 * d0 - d1, d0 + d1 - 2.0 * rise);
    let loads = from.loads.iter().zip(&to.loads);
    Instant {
        motion: InputMotion {
            coordinate: a.coordinate + s * (d0 + s * (c2 + s * c3)),
            speed: (d0 + s * (2.0 * c2 + s * 3.0 * c3)) / h,
            acceleration: a.acceleration + s * (b.acceleration - a.acceleration),
        },
        loads: loads.map(|(a, b)| a + s * (b - a)).collect(),
        direction: sign(to).or_else(|| sign(from)),
    }
}

#[cfg(test)]
mod tests {
    use super::{Course, Instant};
    use crate::kinematics::linkage::kinetostatics::InputMotion;

    #[test]
    fn instants_are_joined_smoothly_and_durations_add_up() {
        let motion = |t: f64| InputMotion {
            coordinate: t * t * t - t,
            speed: 3.0 * t * t - 1.0,
            acceleration: 6.0 * t,
        };
        let times = vec![0.0, 0.5, 2.0];
        let course = Course::Instants {
            instants: times
                .iter()
                .map(|t| Instant {
                    motion: motion(*t),
                    loads: vec![1.0 + 2.0 * t],
                    ..Instant::default()
                })
                .collect(),
            times,
            closed: false,
        };
        for t in [0.0, 0.2, 0.5, 1.3, 2.0] {
            assert!((course.instant_at(t).loads[0] - (1.0 + 2.0 * t)).abs() < 1e-14);
            let (found, wanted) = (course.instant_at(t).motion, motion(t));
            assert!((found.coordinate - wanted.coordinate).abs() < 1e-14, "{t}");
            assert!((found.speed - wanted.speed).abs() < 1e-13);
            assert!((found.acceleration - wanted.acceleration).abs() < 1e-13);
        }
        let (panels, pace) = course.panels().unwrap();
        assert_eq!((panels, pace), (vec![[0.0, 0.5], [0.5, 2.0]], 1.0));
    }

    #[test]
    fn rest_goes_on_where_the_motion_does_and_a_dwell_nowhere() {
        let speeds = [0.0, 2.0, 0.0, 0.0, 0.0, -1.0, 0.0];
        let instant = |speed: &f64| Instant {
            motion: InputMotion {
                speed: *speed,
                ..InputMotion::default()
            },
            ..Instant::default()
        };
        let course = Course::Instants {
            times: (0..speeds.len()).map(|k| k as f64).collect(),
            instants: speeds.iter().map(instant).collect(),
            closed: false,
        };
        let at = |index: usize| course.instant(index).direction;
        assert_eq!(
            [0, 2, 3, 4, 6].map(at),
            [1.0, 1.0, 0.0, -1.0, -1.0]
                .map(|direction: f64| (direction != 0.0).then_some(direction))
        );
    }

    #[test]
    fn a_closed_course_does_not_repeat_its_first_position() {
        let course = Course::Even {
            from: 1.0,
            to: 5.0,
            count: 4,
            speed: -2.0,
            acceleration: 0.0,
            closed: true,
        };
        let places: Vec<f64> = (0..course.len()).map(|k| course.parameter(k)).collect();
        assert_eq!(places, [1.0, 2.0, 3.0, 4.0]);
        assert_eq!(course.period(), Some(4.0));
        let (panels, pace) = course.panels().unwrap();
        assert_eq!((panels.len(), panels[3], pace), (4, [4.0, 5.0], 0.5));
    }
}
