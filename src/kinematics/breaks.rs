//! Break points: the places of an axis where a piecewise function changes its formula.

/// Break points along an axis (a driver's displacement, or time), and the
/// segments between them.
///
/// Segment k lies between edge k and edge k + 1. Without a period, with m
/// points: segment 0 reaches down to −∞, segment m up to +∞. With a period P,
/// the points repeat for ever and segments are numbered through: edge k is
/// `points[k mod m] + P·⌊k/m⌋`, so the segment number also says which turn it
/// belongs to. Functions are evaluated with the segment given, never guessed
/// from the argument: just beside a break point rounding would choose wrongly.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Breaks {
    /// Ascending; within one period when there is one.
    pub points: Vec<f64>,
    /// Length of the period; `None` when the points do not repeat.
    pub period: Option<f64>,
}

impl Breaks {
    /// No break points: one segment, number 0.
    pub const NONE: Self = Self {
        points: Vec::new(),
        period: None,
    };

    /// True when the axis is one single segment.
    pub fn is_empty(&self) -> bool {
        self.points.is_empty()
    }

    /// Lower and upper edge of a segment (−∞, +∞ where there is none).
    pub fn edges(&self, segment: i64) -> (f64, f64) {
        match self.period {
            _ if self.points.is_empty() => (f64::NEG_INFINITY, f64::INFINITY),
            Some(_) => (self.edge(segment), self.edge(segment + 1)),
            None => (self.edge(segment - 1), self.edge(segment)),
        }
    }

    /// The segment holding `x` when moving in the direction of `sense`
    /// (≥ 0: upwards): on an edge, the segment that is about to be entered.
    pub fn segment_at(&self, x: f64, sense: f64) -> i64 {
        let count = self.points.len();
        if count == 0 {
            return 0;
        }
        let below = |edge: f64| if sense >= 0.0 { edge <= x } else { edge < x };
        match self.period {
            None => self.points.partition_point(|&edge| below(edge)) as i64,
            Some(period) => {
                // Beyond 10¹² turns an angle has no digits left for its place in
                // the turn: stay in range, and come to an end.
                let turns = ((x - self.points[0]) / period).floor();
                let turn = turns.clamp(-1e12, 1e12) as i64;
                let mut first = (turn - 1) * count as i64;
                let mut last = first + 3 * count as i64;
                while first < last {
                    let middle = first + (last - first) / 2;
                    match below(self.edge(middle + 1)) {
                        true => first = middle + 1,
                        false => last = middle,
                    }
                }
                first
            }
        }
    }

    /// Number of the piece (0 … m−1 with a period, 0 … m without) that a
    /// segment is a copy of, and the distance to subtract from the argument.
    pub fn piece(&self, segment: i64) -> (usize, f64) {
        match self.period {
            Some(period) if !self.points.is_empty() => {
                let count = self.points.len() as i64;
                let turn = segment.div_euclid(count);
                (segment.rem_euclid(count) as usize, turn as f64 * period)
            }
            _ => (segment.max(0) as usize, 0.0),
        }
    }

    fn edge(&self, index: i64) -> f64 {
        let count = self.points.len() as i64;
        match self.period {
            Some(period) => {
                let turn = index.div_euclid(count) as f64;
                self.points[index.rem_euclid(count) as usize] + turn * period
            }
            None if index < 0 => f64::NEG_INFINITY,
            None if index >= count => f64::INFINITY,
            None => self.points[index as usize],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Breaks;

    #[test]
    fn segments_of_a_periodic_axis_are_numbered_through() {
        let breaks = Breaks {
            points: vec![0.5, 2.0],
            period: Some(3.0),
        };
        assert_eq!(breaks.edges(0), (0.5, 2.0));
        assert_eq!(breaks.edges(-1), (-1.0, 0.5));
        assert_eq!(breaks.edges(3), (5.0, 6.5));
        for (x, up, down) in [(0.5, 0, -1), (1.0, 0, 0), (5.0, 3, 2), (-2.6, -3, -3)] {
            assert_eq!(
                (breaks.segment_at(x, 1.0), breaks.segment_at(x, -1.0)),
                (up, down)
            );
        }
        assert_eq!(breaks.piece(3), (1, 3.0));
        assert_eq!(breaks.piece(-1), (1, -3.0));
        for x in [1e30, -1e30, f64::MAX, f64::INFINITY, f64::NAN] {
            let _ = breaks.segment_at(x, 1.0);
        }
    }

    #[test]
    fn segments_of_a_plain_axis_reach_to_infinity() {
        let breaks = Breaks {
            points: vec![1.0, 2.0],
            period: None,
        };
        assert_eq!(breaks.edges(0), (f64::NEG_INFINITY, 1.0));
        assert_eq!(breaks.edges(2), (2.0, f64::INFINITY));
        assert_eq!(
            (breaks.segment_at(1.0, 1.0), breaks.segment_at(1.0, -1.0)),
            (1, 0)
        );
        assert_eq!(Breaks::NONE.edges(0).1, f64::INFINITY);
    }
}
