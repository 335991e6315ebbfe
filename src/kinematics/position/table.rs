//! A position function given by points.

use crate::fault::{Fault, Faults};
use crate::kinematics::breaks::Breaks;
use crate::kinematics::motion::Spline;
use crate::math::fourier::{Terms, TermsOnInterval};
use crate::math::jet::Jet;

/// A smooth curve through points (φ, U): a cubic spline whose U, U′ and U″ are
/// continuous; U‴ jumps at the points, which are break points: a step over one is off by the
/// cube of the distance, which no method of high order foresees.
///
/// A periodic table repeats for ever. A clamped one goes on straight, with its
/// end slopes, beyond its ends.
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    spline: Spline,
    breaks: Breaks,
}

impl Table {
    /// A table through at least three points.
    ///
    /// # Errors
    /// Too few points, points not ascending or not finite, a period that does
    /// not close; paths relative to `position`.
    pub fn new(
        points: &[(f64, f64)],
        periodic: bool,
        end_slopes: (f64, f64),
    ) -> Result<Self, Vec<Fault>> {
        let mut faults = Faults::default();
        faults.points("table.points", points, 3);
        faults.finite("table.end_slopes[0]", end_slopes.0);
        faults.finite("table.end_slopes[1]", end_slopes.1);
        faults.check()?;
        let (first, last) = (points[0].1, points[points.len() - 1].1);
        let size = points.iter().map(|point| point.1.abs()).fold(0.0, f64::max);
        if periodic && (last - first).abs() > 1e-9 * size {
            let message = format!("a periodic table ends at {last}, not at {first} as it begins");
            let at = format!("table.points[{}]", points.len() - 1);
            faults.add(at, message, "repeat the first value one period later");
            faults.check()?;
        }
        let spline = if periodic {
            Spline::periodic(points)
        } else {
            Spline::clamped(points, end_slopes)
        };
        if !spline.is_finite() {
            let message = "the curve through these points has slopes too great for numbers";
            faults.add("table.points", message, "space the points more regularly");
        }
        faults.check()?;
        let knots = spline.knots();
        let breaks = match spline.is_periodic() {
            true => Breaks {
                points: knots[..knots.len() - 1].to_vec(),
                period: Some(knots[knots.len() - 1] - knots[0]),
            },
            false => Breaks {
                points: knots.to_vec(),
                period: None,
            },
        };
        Ok(Self { spline, breaks })
    }

    /// U and its derivatives at `phi` by the formula of `segment`.
    pub fn jet(&self, segment: i64, phi: f64) -> Jet {
        let (piece, shift) = self.breaks.piece(segment);
        if self.spline.is_periodic() {
            return self.spline.jet_of(piece, phi - shift);
        }
        let (first, last) = self.spline.ends();
        match piece.checked_sub(1) {
            None => straight(self.spline.jet(first), phi - first),
            Some(interval) if interval + 1 < self.spline.knots().len() => {
                self.spline.jet_of(interval, phi)
            }
            Some(_) => straight(self.spline.jet(last), phi - last),
        }
    }

    /// U over one period in closed form, a cubic between every two points; `None`: it does not
    /// repeat.
    pub(crate) fn closed_form(&self) -> Option<Vec<TermsOnInterval>> {
        self.breaks.period?;
        let piece = |index: usize| {
            let (from, to) = self.breaks.edges(index as i64);
            let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
            let jet = self.spline.jet_of(index, middle);
            let cubic = vec![
                jet.value,
                half * jet.first,
                half * half * jet.second / 2.0,
                half * half * half * jet.third / 6.0,
            ];
            TermsOnInterval {
                middle,
                half,
                terms: Terms::of_polynomial(cubic),
            }
        };
        Some((0..self.breaks.points.len()).map(piece).collect())
    }

    /// The points.
    pub fn breaks(&self) -> &Breaks {
        &self.breaks
    }

    /// First and last φ of the points.
    pub fn ends(&self) -> (f64, f64) {
        self.spline.ends()
    }

    /// φ of all points: U‴ jumps there.
    pub fn knots(&self) -> &[f64] {
        self.spline.knots()
    }

    /// True when the table repeats.
    pub fn is_periodic(&self) -> bool {
        self.spline.is_periodic()
    }
}

fn straight(end: Jet, beyond: f64) -> Jet {
    Jet {
        value: end.value + end.first * beyond,
        first: end.first,
        ..Jet::default()
    }
}

#[cfg(test)]
mod tests {
    use super::Table;

    #[test]
    fn a_clamped_table_goes_on_straight() {
        let points = [(0.0, 0.0), (1.0, 1.0), (2.0, 1.5)];
        let table = Table::new(&points, false, (0.5, -2.0)).unwrap();
        let breaks = table.breaks();
        assert_eq!(breaks.points, [0.0, 1.0, 2.0]);
        for (phi, value, slope) in [(-1.0, -0.5, 0.5), (3.0, -0.5, -2.0)] {
            let jet = table.jet(breaks.segment_at(phi, 1.0), phi);
            approx::assert_abs_diff_eq!(jet.value, value, epsilon = 1e-13);
            approx::assert_abs_diff_eq!(jet.first, slope, epsilon = 1e-13);
            assert_eq!((jet.second, jet.third), (0.0, 0.0));
        }
    }

    #[test]
    fn a_period_that_does_not_close_is_refused() {
        let points = [(0.0, 0.0), (1.0, 1.0), (2.0, 0.5)];
        let faults = Table::new(&points, true, (0.0, 0.0)).unwrap_err();
        assert_eq!(faults[0].path, "table.points[2]");
        assert!(Table::new(&points[..2], false, (0.0, 0.0)).is_err());
    }
}
