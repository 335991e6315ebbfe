//! Parts of a motion in which greatest and least values are wanted: between two angles of the
//! machine, in every turn; between two displacements of an object; between two times.

use super::{Coordinate, Model};
use serde::Serialize;
use std::f64::consts::TAU;

/// What the ends of a span are places of.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum SpanAxis {
    /// Time (s).
    Time,
    /// Displacement of an object or output (rad or m); of what turns, in every turn.
    Displacement {
        /// Its id; `None`: the only drive that turns, or that slides.
        of: Option<String>,
        /// Whether that turns or slides.
        coordinate: Coordinate,
    },
}

/// A part of a motion.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Span {
    /// Axis of its ends.
    pub axis: SpanAxis,
    /// Start, which belongs to it.
    pub from: f64,
    /// End beyond the start, which belongs to it.
    pub to: f64,
}

/// A greatest or least value within a span.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct SpanFigure {
    /// Address of the value: that of the figure, and the span.
    pub address: String,
    /// Address of the figure: `rocker.delta_max`.
    pub figure: String,
    /// The span.
    pub span: Span,
}

impl Span {
    /// After so much of its axis it comes again.
    fn period(&self) -> Option<f64> {
        match self.axis {
            SpanAxis::Displacement {
                coordinate: Coordinate::Turning,
                ..
            } => Some(TAU),
            SpanAxis::Displacement { .. } | SpanAxis::Time => None,
        }
    }

    /// Whether a place of its axis belongs to it.
    pub fn contains(&self, place: f64) -> bool {
        let behind = place - self.from;
        let behind = self.period().map_or(behind, |turn| behind.rem_euclid(turn));
        (0.0..=self.to - self.from).contains(&behind)
    }

    /// Whether all of it lies between two places of its axis, ascending, once at least.
    pub fn is_within(&self, [low, high]: [f64; 2]) -> bool {
        let ends = [self.from, self.to, low, high].map(f64::abs);
        let rounding = ROUNDING * ends.into_iter().fold(0.0, f64::max);
        let shift = self.period().map_or(0.0, |turn| {
            ((high + rounding - self.to) / turn).floor() * turn
        });
        low - rounding <= self.from + shift && self.to + shift <= high + rounding
    }

    /// Where it begins or ends between two places of its axis, ascending.
    pub fn ends_between(&self, [low, high]: [f64; 2]) -> Vec<f64> {
        let between = |place: &f64| low < *place && *place < high;
        let mut found: Vec<f64> = match self.period() {
            None => [self.from, self.to].into_iter().filter(between).collect(),
            Some(turn) => {
                let first = ((low - self.to) / turn).floor();
                let last = ((high - self.from) / turn).ceil();
                let count = (last - first).clamp(0.0, MOST_TURNS) as u32;
                let turns = (0..=count).map(|k| (first + f64::from(k)) * turn);
                turns
                    .flat_map(|shift| [self.from + shift, self.to + shift])
                    .filter(between)
                    .collect()
            }
        };
        found.sort_by(f64::total_cmp);
        found
    }
}

/// Share of a place that is rounding of the way to it.
const ROUNDING: f64 = 1e-9;
/// Most turns between two instants that are looked at together.
const MOST_TURNS: f64 = 1e6;

impl Model {
    /// The object part whose displacement is the axis of a span; `None` of a span of time.
    ///
    /// # Errors
    /// There is none, or it is not clear which; in words, with what to write.
    pub fn axis_of(&self, span: &Span) -> Result<Option<usize>, (String, String)> {
        let SpanAxis::Displacement { of, coordinate } = &span.axis else {
            return Ok(None);
        };
        let (moves, unit) = match coordinate {
            Coordinate::Turning => ("turns", "an angle"),
            Coordinate::Sliding => ("slides", "a length"),
        };
        let parts = || self.objects.iter().enumerate();
        if let Some(id) = of {
            let found = parts().find(|(_, part)| part.id == *id && !part.is_inner());
            return match found {
                Some((at, part)) if part.coordinate == *coordinate => Ok(Some(at)),
                Some(_) => Err((
                    format!(
                        "`{id}` does not {}: it has no place at {unit}",
                        &moves[..moves.len() - 1]
                    ),
                    "give both ends in the unit of its displacement".to_owned(),
                )),
                None => Err((format!("there is no object `{id}`"), String::new())),
            };
        }
        let drives: Vec<(usize, &str)> = parts()
            .filter(|(_, part)| part.is_drive() && part.coordinate == *coordinate)
            .filter(|(_, part)| !part.is_inner())
            .map(|(at, part)| (at, part.id.as_str()))
            .collect();
        match drives.as_slice() {
            [(at, _)] => Ok(Some(*at)),
            [] => Err((
                format!("no drive {moves}"),
                "name the object whose displacement is meant: `from 10 mm to 20 mm of ram`"
                    .to_owned(),
            )),
            several => {
                let ids: Vec<&str> = several.iter().map(|(_, id)| *id).collect();
                Err((
                    format!(
                        "several drives {}: {}",
                        &moves[..moves.len() - 1],
                        ids.join(", ")
                    ),
                    format!("name the one that is meant: `from … to … of {}`", ids[0]),
                ))
            }
        }
    }

    /// The displacement of a node over that of another, r·x + s, where the other drives it by
    /// constant ratios: [r, s], r ≠ 0. `None`: it does not.
    pub fn constant_ratio(&self, node: usize, source: usize) -> Option<[f64; 2]> {
        let (mut at, mut line) = (node, [1.0, 0.0]);
        while at != source {
            let law = self.nodes[at].motion.law()?;
            let [ratio, offset] = law.position.constant_ratio()?;
            let [r, s] = line;
            line = [r * law.lever * ratio, s + r * law.lever * offset];
            at = law.driver;
        }
        Some(line).filter(|line| line[0] != 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::{Span, SpanAxis};
    use crate::dynamics::model::Coordinate;
    use std::f64::consts::TAU;

    #[test]
    fn a_span_of_angles_comes_in_every_turn_and_one_of_times_once() {
        let turning = SpanAxis::Displacement {
            of: None,
            coordinate: Coordinate::Turning,
        };
        let over_the_end = Span {
            axis: turning,
            from: 6.0,
            to: 6.5,
        };
        for turn in [-2.0, 0.0, 5.0] {
            let at = |x: f64| x + turn * TAU;
            for (place, inside) in [(6.1, true), (0.1, true), (0.3, false), (5.9, false)] {
                assert_eq!(over_the_end.contains(at(place)), inside, "{place} {turn}");
            }
            let ends = over_the_end.ends_between([at(0.0), at(TAU)]);
            assert_eq!(ends.len(), 2);
            approx::assert_abs_diff_eq!(ends[0], at(6.5 - TAU), epsilon = 1e-13);
            approx::assert_abs_diff_eq!(ends[1], at(6.0), epsilon = 1e-13);
        }
        let once = Span {
            axis: SpanAxis::Time,
            ..over_the_end
        };
        assert!(once.contains(6.2) && !once.contains(6.2 + TAU) && once.contains(6.5));
        assert_eq!(once.ends_between([0.0, 6.2]), [6.0]);
        assert!(once.ends_between([0.0, 6.0]).is_empty());
    }
}
