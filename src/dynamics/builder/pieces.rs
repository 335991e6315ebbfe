//! Piecewise-linear laws: tables and windows.

use crate::dynamics::model::LinearPiece;
use crate::fault::{Fault, Faults};
use crate::kinematics::breaks::Breaks;

/// A piecewise-linear function of an axis.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Pieces {
    pub(super) breaks: Breaks,
    /// Pieces, one for each of the breaks.
    pub(super) pieces: Vec<LinearPiece>,
}

/// Straight lines between points, constant outside.
///
/// # Errors
/// No points, or not ascending; paths relative to the points.
pub(super) fn table(points: &[(f64, f64)]) -> Result<Pieces, Vec<Fault>> {
    let mut faults = Faults::default();
    faults.points("", points, 1);
    faults.check()?;
    let mut pieces = vec![flat(points[0])];
    pieces.extend(points.windows(2).map(|ends| line(ends[0], ends[1])));
    pieces.push(flat(points[points.len() - 1]));
    Ok(Pieces {
        breaks: breaks(points, None),
        pieces,
    })
}

/// Straight lines between the points of one period, and on to the first point
/// of the next. A last point one period after the first must repeat its value.
///
/// # Errors
/// As [`table`]; points that reach over more than a period or do not close;
/// paths relative to the position table.
pub(super) fn repeating_table(points: &[(f64, f64)], period: f64) -> Result<Pieces, Vec<Fault>> {
    let mut faults = Faults::default();
    faults.points("points", points, 1);
    faults.positive("period", period);
    faults.check()?;
    let (first, last) = (points[0], points[points.len() - 1]);
    let span = last.0 - first.0;
    let closed = (period - span).abs() <= 1e-12 * period;
    if span > period && !closed {
        let message = format!("the points extend over {span}, more than the period");
        faults.add("period", message, "give the points of one period");
    }
    if closed && last.1 != first.1 {
        let (before, after) = (first.1, last.1);
        let message = format!(
            "one period after {} the load is not {before} but {after}",
            first.0
        );
        let hint = "repeat the first value there, or leave that point out";
        faults.add(format!("points[{}]", points.len() - 1), message, hint);
    }
    faults.check()?;
    let own = points.len() - usize::from(closed);
    let points = &points[..own];
    let next = (first.0 + period, first.1);
    let ends = points.iter().skip(1).chain([&next]);
    let pieces = points.iter().zip(ends).map(|(from, to)| line(*from, *to));
    Ok(Pieces {
        breaks: breaks(points, Some(period)),
        pieces: pieces.collect(),
    })
}

/// A force within a window, nothing outside.
///
/// # Errors
/// Numbers that are not finite, an empty window or one longer than its period;
/// paths relative to the window.
pub(super) fn window(
    [from, to]: [f64; 2],
    force: f64,
    period: Option<f64>,
) -> Result<Pieces, Vec<Fault>> {
    let mut faults = Faults::default();
    faults.finite("from", from);
    faults.finite("to", to);
    faults.finite("force", force);
    if to <= from {
        let message = format!("the window ends at {to}, not after its start {from}");
        faults.add("to", message, "give an end after the start");
    }
    if let Some(period) = period {
        faults.positive("period", period);
        if to - from > period * (1.0 + 1e-12) {
            let message = format!("the window is longer than its period {period}");
            faults.add("to", message, "end it within one period");
        }
    }
    faults.check()?;
    let ends = [(from, force), (to, 0.0)];
    let (inside, outside) = (flat(ends[0]), flat(ends[1]));
    let (breaks, pieces) = match period {
        None => (breaks(&ends, None), vec![outside, inside, outside]),
        Some(period) if to - from >= period * (1.0 - 1e-12) => (Breaks::NONE, vec![inside]),
        Some(_) => (breaks(&ends, period), vec![inside, outside]),
    };
    Ok(Pieces { breaks, pieces })
}

fn breaks(points: &[(f64, f64)], period: Option<f64>) -> Breaks {
    Breaks {
        points: points.iter().map(|point| point.0).collect(),
        period,
    }
}

fn flat((start, value): (f64, f64)) -> LinearPiece {
    LinearPiece {
        start,
        value,
        slope: 0.0,
    }
}

fn line(from: (f64, f64), to: (f64, f64)) -> LinearPiece {
    LinearPiece {
        start: from.0,
        value: from.1,
        slope: (to.1 - from.1) / (to.0 - from.0),
    }
}

#[cfg(test)]
mod tests {
    use super::{Pieces, repeating_table, table, window};

    fn force(law: &Pieces, x: f64) -> f64 {
        let (piece, turned) = law.breaks.piece(law.breaks.segment_at(x, 1.0));
        let piece = law.pieces[piece];
        piece.value + piece.slope * (x - turned - piece.start)
    }

    #[test]
    fn a_table_is_linear_inside_and_constant_outside() {
        let law = table(&[(1.0, 2.0), (3.0, 6.0), (4.0, 0.0)]).unwrap();
        for (x, value) in [(0.0, 2.0), (1.0, 2.0), (2.0, 4.0), (3.5, 3.0), (9.0, 0.0)] {
            assert_eq!(force(&law, x), value);
        }
        let constant = table(&[(1.0, 2.0)]).unwrap();
        assert_eq!((force(&constant, 0.0), force(&constant, 5.0)), (2.0, 2.0));
        assert_eq!(table(&[]).unwrap_err()[0].path, "");
    }

    #[test]
    fn a_repeating_table_closes_whether_its_end_is_given_or_not() {
        let open = repeating_table(&[(1.0, 0.0), (2.0, 4.0)], 5.0).unwrap();
        let closed = repeating_table(&[(1.0, 0.0), (2.0, 4.0), (6.0, 0.0)], 5.0).unwrap();
        assert_eq!(open, closed);
        for (x, value) in [(1.5, 2.0), (4.0, 2.0), (5.5, 0.5), (6.5, 2.0), (-1.0, 2.0)] {
            assert_eq!(force(&open, x), value);
        }
        let constant = repeating_table(&[(1.0, 2.0)], 5.0).unwrap();
        assert_eq!((force(&constant, -7.0), force(&constant, 5.0)), (2.0, 2.0));
        let jump = repeating_table(&[(1.0, 0.0), (6.0, 1.0)], 5.0).unwrap_err();
        assert_eq!(jump[0].path, "points[1]");
        let long = repeating_table(&[(1.0, 0.0), (7.0, 1.0)], 5.0).unwrap_err();
        assert_eq!(long[0].path, "period");
    }

    #[test]
    fn a_window_acts_between_its_ends() {
        let once = window([1.0, 2.0], 7.0, None).unwrap();
        let again = window([1.0, 2.0], 7.0, Some(3.0)).unwrap();
        for (x, single, repeated) in [
            (0.5, 0.0, 0.0),
            (1.0, 7.0, 7.0),
            (2.0, 0.0, 0.0),
            (4.5, 0.0, 7.0),
        ] {
            assert_eq!((force(&once, x), force(&again, x)), (single, repeated));
        }
        assert_eq!(
            window([1.0, 5.0], 7.0, Some(3.0)).unwrap_err()[0].path,
            "to"
        );
        assert_eq!(window([1.0, 1.0], f64::NAN, None).unwrap_err().len(), 2);
    }
}
