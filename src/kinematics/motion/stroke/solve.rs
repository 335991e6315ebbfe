//! Problems 1, 2 and 3 of synthesis and their inversions.

use super::Stroke;
use super::figures::{Laws, Skewness, StrokeSpec, figures};
use super::optimum::optimum_skewness;
use super::section::RunSection;
use crate::fault::{Fault, Faults};
use crate::kinematics::motion::law::RunLawSpec;

pub(super) fn solve(spec: &StrokeSpec) -> Result<Stroke, Vec<Fault>> {
    let mut faults = Faults::default();
    check(spec, &mut faults);
    let up = section(&mut faults, "run_up", &spec.run_up);
    let out = section(&mut faults, "run_out", &spec.run_out);
    faults.check()?;
    let (Some(up), Some(out)) = (up, out) else {
        return Err(Vec::new());
    };
    let laws = Laws { up, out };
    let f = match spec.skewness {
        Skewness::Given(f) => f,
        Skewness::AccelerationRatio(lambda) => {
            lambda * laws.speed_ratio() / laws.acceleration_ratio()
        }
        Skewness::Optimum(criterion) => optimum_skewness(&laws, spec, criterion)?,
    };
    let figures = figures(&laws, spec, f)?;
    Ok(Stroke {
        run_up: laws.up,
        run_out: laws.out,
        figures,
    })
}

fn section(faults: &mut Faults, path: &str, spec: &RunLawSpec) -> Option<RunSection> {
    match RunSection::new(spec) {
        Ok(section) => Some(section),
        Err(found) => {
            faults.absorb(path, found);
            None
        }
    }
}

/// Ranges and number of what is given.
fn check(spec: &StrokeSpec, faults: &mut Faults) {
    if let Some(stroke) = spec.stroke {
        faults.not_zero("stroke", stroke);
    }
    if let Some(span) = spec.span {
        faults.positive("span", span);
    }
    if let Some(speed) = spec.peak_speed {
        faults.not_zero("peak_speed", speed);
    }
    for (path, share) in [
        ("uniform_stroke", spec.uniform_stroke),
        ("uniform_span", spec.uniform_span),
    ] {
        if let Some(share) = share.filter(|share| !(0.0..1.0).contains(share)) {
            let message = format!("{share} lies outside the solvable interval 0 ≤ ζ < 1");
            let hint = "towards 1 the accelerations at both ends grow without limit";
            faults.add(path, message, hint);
        }
    }
    let (path, value) = match spec.skewness {
        Skewness::Given(f) => ("skewness", f),
        Skewness::AccelerationRatio(lambda) => ("acceleration_ratio", lambda),
        Skewness::Optimum(criterion) => ("optimum", criterion.weight()),
    };
    let lower_included = path == "optimum";
    if !(value.is_finite() && (value > 0.0 || lower_included && value == 0.0)) {
        let message = format!("{value} lies outside the solvable interval 0 … ∞, ends excluded");
        faults.add(path, message, "give a number above zero");
    }
    check_count(spec, faults);
}

fn check_count(spec: &StrokeSpec, faults: &mut Faults) {
    let shares = [
        spec.uniform_stroke.is_some(),
        spec.uniform_span.is_some(),
        spec.uniform_optimum,
    ];
    let shares = shares.iter().filter(|given| **given).count();
    let hint = "give exactly three of: stroke, span, greatest speed, uniform section \
                (as share of the stroke, share of the span, or optimum)";
    if shares > 1 {
        faults.add("uniform_span", "the uniform section is given twice", hint);
    }
    let given = [
        spec.stroke.is_some(),
        spec.span.is_some(),
        spec.peak_speed.is_some(),
        shares > 0,
    ];
    let count = given.iter().filter(|given| **given).count();
    if count != 3 {
        let message = format!("{count} of the four quantities of a stroke are given");
        faults.add("", message, hint);
    }
    if let (Some(stroke), Some(speed)) = (spec.stroke, spec.peak_speed)
        && stroke * speed < 0.0
    {
        let message = format!("{speed} points against the stroke of {stroke}");
        faults.add("peak_speed", message, "give both the same sign");
    }
}
