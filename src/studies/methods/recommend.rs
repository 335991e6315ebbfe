//! Which method to take for the asked accuracy.

use super::line::MethodLine;
use crate::math::order::Total;
use crate::units::shown;
use serde::Serialize;

/// The fastest point with an error within the asked accuracy.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Recommendation {
    /// The method's name; null when no method reaches the accuracy.
    pub method: Option<String>,
    /// Tolerance to set, if the method has one.
    pub tolerance: Option<f64>,
    /// Step to set (s), if it is of fixed step.
    pub step: Option<f64>,
    /// Error of the method.
    pub error: Option<f64>,
    /// Median wall-clock time (s); varies from run to run.
    pub measured_seconds: Option<f64>,
    /// Recommendation as a sentence.
    pub text: String,
}

/// The fastest of all points that came to the end, all switches found, with an
/// error within `accuracy`, whether or not their own tolerance was finer still.
pub fn recommend(lines: &[MethodLine], accuracy: f64) -> Recommendation {
    let points = || {
        lines
            .iter()
            .flat_map(|line| line.points.iter().map(move |point| (line, point)))
            .filter(|(_, point)| point.verdict.has_an_error())
    };
    let fit = points().filter(|(_, p)| p.error.is_some_and(|error| error <= accuracy));
    let seconds = |point: &super::Point| point.measured_seconds.unwrap_or(f64::INFINITY);
    let mut ranked: Vec<_> = fit.collect();
    ranked.sort_by_cached_key(|(_, point)| Total(seconds(point)));
    let Some((line, point)) = ranked.first() else {
        // The error of the reference is how far the next one is from it: no distance
        // from the truth by which it could be the nearest.
        let others = points().filter(|(_, point)| !point.is_reference);
        return no_method_suffices(
            others.filter_map(|(line, p)| Some((line, p.error?))),
            accuracy,
        );
    };
    let setting = match (point.tolerance, point.step) {
        (Some(tolerance), _) => {
            format!(" at tolerance {tolerance}", tolerance = shown(tolerance, 1))
        }
        (_, Some(step)) => format!(" at a step of {step} s", step = shown(step, 3)),
        _ => String::new(),
    };
    let next = ranked.iter().find(|(other, _)| other.method != line.method);
    let ahead = next.map_or(String::new(), |(other, slower)| {
        let ratio = seconds(slower) / seconds(point);
        format!("; next {}, {ratio:.1} times as long", other.method)
    });
    Recommendation {
        method: Some(line.method.name().to_owned()),
        tolerance: point.tolerance,
        step: point.step,
        error: point.error,
        measured_seconds: point.measured_seconds,
        text: format!(
            "for an error of {accuracy}: {}{setting}, {}{ahead}",
            line.method,
            reached(point),
            accuracy = shown(accuracy, 1)
        ),
    }
}

fn reached(point: &super::Point) -> String {
    let seconds = point.measured_seconds.unwrap_or(0.0);
    let time = if seconds < 1.0 {
        format!("{:.3} ms", 1e3 * seconds)
    } else {
        format!("{seconds:.2} s")
    };
    match point.error {
        Some(error) => format!("error {error} in {time}", error = shown(error, 2)),
        None => time,
    }
}

/// No method reaches the accuracy: names the one that comes nearest.
fn no_method_suffices<'a>(
    points: impl Iterator<Item = (&'a MethodLine, f64)>,
    accuracy: f64,
) -> Recommendation {
    let nearest = points.min_by(|a, b| a.1.total_cmp(&b.1));
    let nearest = nearest.map_or("none can be judged".to_owned(), |(line, error)| {
        format!(
            "the nearest is {} with {error}",
            line.method,
            error = shown(error, 2)
        )
    });
    Recommendation {
        method: None,
        tolerance: None,
        step: None,
        error: None,
        measured_seconds: None,
        text: format!(
            "no method is known to have an error of {accuracy}; {nearest}",
            accuracy = shown(accuracy, 1)
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::super::limit::StabilityLimit;
    use super::super::{MethodLine, Point, Verdict};
    use super::recommend;
    use crate::dynamics::integrate::Method;

    fn line(method: Method, error: f64, is_reference: bool) -> MethodLine {
        let point = Point {
            tolerance: Some(1e-6),
            step: None,
            verdict: Verdict::Inaccurate,
            cause: String::new(),
            error: Some(error),
            is_reference,
            measured_seconds: Some(1e-3),
            repetitions: 1,
            evaluations: None,
            steps: None,
            rejected: None,
            switches: None,
            time: None,
            longest_step: None,
            rate_times_step: None,
            growth: None,
            energy_error: None,
            worst_figure: None,
            figures: Vec::new(),
        };
        MethodLine {
            method,
            fixed_step: false,
            stability: StabilityLimit::by_theory(None, None),
            points: vec![point],
        }
    }

    #[test]
    fn the_reference_is_never_the_nearest_to_itself() {
        // Interrupted: the one other method that was run is rough, and the
        // reference's own figure is the distance to it.
        let reference = line(Method::Exact, 2e-4, true);
        let text = |lines: &[MethodLine]| recommend(lines, 1e-9).text;
        let both = text(&[reference.clone(), line(Method::Rk4, 3e-4, false)]);
        assert!(both.ends_with("the nearest is rk4 with 3e-4"), "{both}");
        let alone = text(&[reference]);
        assert!(alone.ends_with("none can be judged"), "{alone}");
    }
}
