//! What the charts and the record of a run are drawn over: time, or the angle of the machine.
//!
//! The machine angle is that of a drive that turns: the first one, unless another is named. It is
//! counted on over the whole run, or over each turn from 0 to 360 degrees, turns over each other.

use super::plot::{Axis, Band};
use crate::dynamics::model::{Coordinate, Model};
use crate::dynamics::record::{Quantity, Record};
use std::f64::consts::TAU;

/// What a run is drawn over.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum Abscissa {
    /// Time.
    #[default]
    Time,
    /// The angle of a drive.
    Angle {
        /// Id of the drive.
        drive: String,
        /// Arrangement of its turns.
        turns: Turns,
    },
}

/// Arrangement of the turns of a machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Turns {
    /// One behind the other.
    Behind,
    /// Over each other.
    Over,
    /// The last one alone.
    Last,
}

impl Abscissa {
    /// Reads `time`, `angle`, `turns` or `last-turn`, each but the first with the id of a drive
    /// behind a colon where it is not the first that turns.
    ///
    /// # Errors
    /// What is wrong, in words.
    pub fn parse(text: &str, model: &Model) -> Result<Self, String> {
        let (name, drive) = match text.split_once(':') {
            Some((name, drive)) => (name, Some(drive)),
            None => (text, None),
        };
        let turns = match name {
            "time" if drive.is_none() => return Ok(Self::Time),
            "angle" => Turns::Behind,
            "turns" => Turns::Over,
            "last-turn" => Turns::Last,
            _ => {
                return Err(format!(
                    "`{text}` is none of time, angle, turns, last-turn; the last three take the \
                     id of a drive: angle:shaft"
                ));
            }
        };
        let turning = || {
            let drives = model.objects.iter().filter(|part| part.is_drive());
            drives.filter(|part| part.coordinate == Coordinate::Turning)
        };
        let found = match drive {
            Some(id) => turning().find(|part| part.id == id),
            None => turning().next(),
        };
        let names: Vec<&str> = turning().map(|part| part.id.as_str()).collect();
        match (found, names.as_slice()) {
            (Some(part), _) => Ok(Self::Angle {
                drive: part.id.clone(),
                turns,
            }),
            (None, []) => Err("no drive of this scene turns: it has no machine angle".to_owned()),
            (None, names) => Err(format!(
                "`{}` is no drive that turns; there is {}",
                drive.unwrap_or_default(),
                names.join(", ")
            )),
        }
    }

    /// The axis of charts.
    pub fn axis(&self) -> Axis {
        match self {
            Self::Time => Axis::new("t", "s"),
            Self::Angle { drive, turns } => Axis {
                fixed: true,
                range: match turns {
                    Turns::Behind => None,
                    Turns::Over | Turns::Last => Some([0.0, 360.0]),
                },
                ..Axis::new(&format!("angle of {drive}"), "deg")
            },
        }
    }

    /// The angle at every sample (rad, counted on); `None`: the record is drawn over time.
    pub fn angles<'r>(&self, record: &'r Record) -> Option<&'r [f64]> {
        match self {
            Self::Time => None,
            Self::Angle { drive, .. } => {
                let column = record.column(drive, Quantity::Displacement)?;
                Some(&column.values)
            }
        }
    }

    /// Over angles: the same with the last turn alone where turns lie over each other, so that one
    /// value belongs to a place.
    pub fn one_turn(&self) -> Option<Self> {
        match self {
            Self::Time => None,
            Self::Angle { drive, turns } => Some(Self::Angle {
                drive: drive.clone(),
                turns: match turns {
                    Turns::Behind => Turns::Behind,
                    Turns::Over | Turns::Last => Turns::Last,
                },
            }),
        }
    }

    /// Values of a record as a curve. Where turns lie over each other, a place that is no number
    /// stands between them.
    pub fn curve(&self, record: &Record, values: &[f64]) -> Vec<(f64, f64)> {
        let (Some(angles), Self::Angle { turns, .. }) = (self.angles(record), self) else {
            let times = record.times.iter().copied();
            return times.zip(values.iter().copied()).collect();
        };
        let points = || angles.iter().copied().zip(values.iter().copied());
        match turns {
            Turns::Behind => points()
                .map(|(angle, value)| (angle.to_degrees(), value))
                .collect(),
            Turns::Over => folded_to_turn(points()),
            Turns::Last => {
                let [from, to] = last_turn(angles);
                folded_to_turn(points().filter(|(angle, _)| (from..=to).contains(angle)))
            }
        }
    }

    /// Intervals of time as intervals of the axis.
    pub fn spans(&self, record: &Record, spans: &[[f64; 2]]) -> Vec<[f64; 2]> {
        let (Some(angles), Self::Angle { turns, .. }) = (self.angles(record), self) else {
            return spans.to_vec();
        };
        let at = |time: f64| interpolated(&record.times, angles, time);
        let both = spans.iter().map(|span| span.map(at));
        let both = both.map(|[from, to]| [from.min(to), from.max(to)]);
        match turns {
            Turns::Behind => both.map(|span| span.map(f64::to_degrees)).collect(),
            // Shading of all turns over each other would hide what each of them does.
            Turns::Over | Turns::Last => {
                let [first, last] = last_turn(angles);
                let within = both.map(|[from, to]| [from.max(first), to.min(last)]);
                within
                    .filter(|[from, to]| from < to)
                    .flat_map(intervals_within_turn)
                    .collect()
            }
        }
    }

    /// A band of intervals of time as a band of the axis.
    pub(super) fn band(&self, record: &Record, band: Band) -> Band {
        Band {
            spans: self.spans(record, &band.spans),
            ..band
        }
    }
}

/// The last turn that was begun and ended within these angles, as far as there is one.
fn last_turn(angles: &[f64]) -> [f64; 2] {
    let last = angles.last().copied().unwrap_or(0.0);
    let first = angles.first().copied().unwrap_or(0.0);
    match last >= first {
        true => [(last - TAU).max(first), last],
        false => [last, (last + TAU).min(first)],
    }
}

/// An interval of angles (rad) within each turn (degrees).
fn intervals_within_turn([from, to]: [f64; 2]) -> Vec<[f64; 2]> {
    let first = (from / TAU).floor();
    let turns = (to / TAU).ceil() - first;
    let part = |turn: f64| {
        let start = (first + turn) * TAU;
        let ends = [from.max(start), to.min(start + TAU)];
        ends.map(|end| (end - start).to_degrees())
    };
    let parts = (0..turns.max(0.0) as usize).map(|turn| part(turn as f64));
    parts.filter(|[from, to]| from < to).collect()
}

/// Points over angles (rad), each turn from 0 to 360 degrees. A straight line over the end of a
/// turn ends there, and goes on at the other side.
fn folded_to_turn(points: impl Iterator<Item = (f64, f64)>) -> Vec<(f64, f64)> {
    let mut curve = Vec::new();
    let mut before: Option<(f64, f64)> = None;
    for (angle, value) in points {
        if let Some((last, old)) = before
            && (last / TAU).floor() != (angle / TAU).floor()
            && angle != last
        {
            let rising = angle > last;
            let end = match rising {
                true => (last / TAU).floor() + 1.0,
                false => (last / TAU).floor(),
            };
            let share = (end * TAU - last) / (angle - last);
            let middle = old + share * (value - old);
            let sides = if rising { [360.0, 0.0] } else { [0.0, 360.0] };
            curve.extend([(sides[0], middle), (f64::NAN, f64::NAN), (sides[1], middle)]);
        }
        curve.push((angle.rem_euclid(TAU).to_degrees(), value));
        before = Some((angle, value));
    }
    curve
}

/// The value at a time between samples.
fn interpolated(times: &[f64], values: &[f64], time: f64) -> f64 {
    let after = times
        .partition_point(|&one| one < time)
        .clamp(1, times.len().max(2) - 1);
    let (Some(&[from, to]), Some(&[low, high])) = (
        times
            .get(after - 1..=after)
            .and_then(|pair| pair.first_chunk()),
        values
            .get(after - 1..=after)
            .and_then(|pair| pair.first_chunk()),
    ) else {
        return values.first().copied().unwrap_or(0.0);
    };
    match to > from {
        true => low + (high - low) * ((time - from) / (to - from)).clamp(0.0, 1.0),
        false => low,
    }
}

#[cfg(test)]
mod tests {
    use super::{Abscissa, Turns};
    use crate::dynamics::record::{Column, Quantity, Record};
    use std::f64::consts::TAU;

    /// A drive of one turn a second over 2.5 s.
    fn record() -> Record {
        let times: Vec<f64> = (0..=25).map(|k| 0.1 * f64::from(k)).collect();
        let column = Column {
            object: "shaft".to_owned(),
            quantity: Quantity::Displacement,
            unit: "rad",
            values: times.iter().map(|time| TAU * time).collect(),
        };
        Record {
            times,
            columns: vec![column],
            ..Record::default()
        }
    }

    fn over(turns: Turns) -> Abscissa {
        Abscissa::Angle {
            drive: "shaft".to_owned(),
            turns,
        }
    }

    #[test]
    fn turns_lie_over_each_other_and_meet_at_their_ends() {
        let record = record();
        let curve = over(Turns::Over).curve(&record, &record.times);
        let finite: Vec<(f64, f64)> = curve
            .iter()
            .copied()
            .filter(|one| one.0.is_finite())
            .collect();
        assert!(
            finite
                .iter()
                .all(|&(angle, _)| (0.0..=360.0).contains(&angle))
        );
        // The time at a place is that of its angle, in one of the turns.
        for (angle, time) in &finite {
            let turns = time - angle / 360.0;
            assert!(
                (turns - turns.round()).abs() < 1e-9,
                "{angle} deg at {time} s"
            );
        }
        assert_eq!(curve.iter().filter(|one| one.0.is_nan()).count(), 2);
        let last = over(Turns::Last).curve(&record, &record.times);
        let first = last.iter().map(|one| one.1).fold(f64::INFINITY, f64::min);
        assert!((first - 1.5).abs() < 1e-9, "{first}");
    }

    #[test]
    fn intervals_are_cut_at_the_ends_of_turns() {
        let record = record();
        let spans = [[0.25, 0.5], [1.75, 2.25]];
        let behind = over(Turns::Behind).spans(&record, &spans);
        for (found, wanted) in behind.iter().flatten().zip([90.0, 180.0, 630.0, 810.0]) {
            assert!((found - wanted).abs() < 1e-6, "{behind:?}");
        }
        let last = over(Turns::Last).spans(&record, &spans);
        assert_eq!(last.len(), 2, "{last:?}");
        for (found, wanted) in last.iter().flatten().zip([270.0, 360.0, 0.0, 90.0]) {
            assert!((found - wanted).abs() < 1e-6, "{last:?}");
        }
        assert_eq!(Abscissa::Time.spans(&record, &spans), spans);
    }
}
