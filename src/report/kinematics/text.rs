//! The kinematics on the terminal.

use super::{angle_or, input, place};
use crate::report::quantity::{significant, with_unit};
use crate::studies::kinematics::{Column, Equilibrium, Extremes, Kinematics, Quantity};
use std::f64::consts::TAU;
use std::fmt::Write as _;

/// An error above this share of a quantity would be seen in its digits.
const SHOWN: f64 = 1e-8;

/// Structure, extremes, strokes, transmission angles, limits.
pub fn text(scene: &str, found: &Kinematics) -> String {
    let mut out = format!("{scene}\n{}\n", headline(found));
    if let Some(stop) = &found.stopped {
        let _ = writeln!(
            out,
            "STOPPED at {}, input {}: {}",
            place(found, stop.at),
            input(found, stop.input),
            stop.cause
        );
    }
    let _ = write!(out, "\n{}", found.linkage.structure());
    let _ = writeln!(out, "input: {}", reach(found));
    out.push_str("\nEXTREMES\n");
    for (column, extremes) in found.columns.iter().zip(&found.extremes) {
        if told(column.quantity) {
            row(&mut out, found, column, extremes);
        }
    }
    strokes(&mut out, found);
    transmission(&mut out, found);
    equilibria(&mut out, found);
    out
}

fn headline(found: &Kinematics) -> String {
    let (from, to) = (found.axis.values.first(), found.axis.values.last());
    let end = |at: Option<&f64>| at.map_or("–".to_owned(), |&at| place(found, at));
    format!(
        "{}: {} positions, {} {} to {}, {}",
        found.object,
        found.axis.values.len(),
        found.axis.name,
        end(from),
        end(to),
        found.motion
    )
}

/// Transfer functions of points and components are in the files.
fn told(quantity: Quantity) -> bool {
    use Quantity as Q;
    matches!(
        quantity,
        Q::Displacement
            | Q::Speed
            | Q::Acceleration
            | Q::First
            | Q::Second
            | Q::Angle
            | Q::AngularSpeed
            | Q::AngularAcceleration
            | Q::X
            | Q::Y
            | Q::SpeedSize
            | Q::AccelerationSize
            | Q::RelativeSpeed
            | Q::RelativeAcceleration
            | Q::TransportAccelerationAlong
            | Q::TransportAccelerationAcross
            | Q::CoriolisAcceleration
    )
}

fn row(out: &mut String, found: &Kinematics, column: &Column, extremes: &Extremes) {
    let end = |(at, value): (f64, f64)| (angle_or(value, &column.unit), place(found, at));
    let ((least, at_least), (greatest, at_greatest)) =
        (end(extremes.least), end(extremes.greatest));
    let name = column.name();
    let size = extremes.least.1.abs().max(extremes.greatest.1.abs());
    let doubt = match (column.undetermined, column.error > SHOWN * size.max(1.0)) {
        (0, false) => String::new(),
        (0, true) => format!("  ± {}", angle_or(column.error, &column.unit)),
        (count, _) => format!("  not determined at {count} positions"),
    };
    let _ = writeln!(
        out,
        "  {name:<34} {least:>22} at {at_least:<16} {greatest:>22} at {at_greatest}{doubt}"
    );
}

pub(super) fn reach(found: &Kinematics) -> String {
    let turning = found.input == crate::dynamics::model::Coordinate::Turning;
    let range = found.linkage.range();
    range.describe(found.linkage.structure(), turning)
}

fn strokes(out: &mut String, found: &Kinematics) {
    if found.strokes.is_empty() {
        return;
    }
    out.push_str("\nSTROKES\n");
    for stroke in &found.strokes {
        let [low, high] = stroke.ends;
        let [rise, fall] = stroke.rise_and_return;
        let value = |value: f64| match stroke.unit {
            "rad" => angle_or(value, "rad"),
            unit => with_unit(value, unit, 8),
        };
        let _ = writeln!(
            out,
            "  {}: {} to {}, stroke {}; rises over {}, falls over {} of the input, time ratio {}",
            stroke.owner,
            value(low.1),
            value(high.1),
            value(high.1 - low.1),
            input(found, rise),
            input(found, fall),
            significant(stroke.time_ratio, 6)
        );
    }
}

fn transmission(out: &mut String, found: &Kinematics) {
    if found.transmission.is_empty() {
        return;
    }
    out.push_str("\nTRANSMISSION ANGLES (90 deg is best)\n");
    for angle in &found.transmission {
        let _ = writeln!(
            out,
            "  {}: {} at {} to {} at {}",
            angle.owner,
            angle_or(angle.least.1, "rad"),
            place(found, angle.least.0),
            angle_or(angle.greatest.1, "rad"),
            place(found, angle.greatest.0)
        );
    }
}

fn equilibria(out: &mut String, found: &Kinematics) {
    if found.equilibria.is_empty() {
        return;
    }
    out.push_str("\nEQUILIBRIA (the linkage alone, its input free)\n");
    for rest in &found.equilibria {
        let _ = writeln!(out, "  {}: {}", input(found, rest.at), behaviour(rest));
    }
}

/// What becomes of a small push, in words.
pub(super) fn behaviour(rest: &Equilibrium) -> String {
    if let (Some(frequency), Some(ratio)) = (rest.frequency(), rest.damping_ratio()) {
        let damped = match ratio > 0.0 {
            true => format!(", damping ratio {}", significant(ratio, 6)),
            false => String::new(),
        };
        return format!(
            "stable, natural frequency {}{damped}",
            with_unit(frequency / TAU, "Hz", 8)
        );
    }
    match rest.growth() {
        Some(growth) if growth > 0.0 => {
            format!(
                "unstable, a push grows by e in {}",
                with_unit(growth.recip(), "s", 8)
            )
        }
        _ if rest.stiffness == 0.0 => "neither stable nor unstable to first order".to_owned(),
        _ if rest.is_stable() => "stable, nothing has inertia".to_owned(),
        _ => "unstable, nothing has inertia".to_owned(),
    }
}
