//! Loads that are expressions, or are made of one: harmonic loads, indicator diagrams.

use super::{Axis, On, read_period};
use crate::dynamics::builder::written as builder;
use crate::dynamics::model::Coordinate;
use crate::frontend::object::measures::Measures;
use crate::frontend::object::spec::{LoadLawSpec, WrittenSpec};
use crate::frontend::object::written;
use crate::frontend::read::{Bounds, OneOf, Slot, read_points};
use crate::math::expression::Expression;
use crate::units::quantities as q;
use serde_json::json;
use std::f64::consts::TAU;

/// Pressure of the atmosphere (Pa).
const AMBIENT: f64 = 101_325.0;

/// Laws that are expressions, or are made of one.
pub(super) fn add(law: &mut OneOf<'_, '_, LoadLawSpec>, on: On, axis: Axis) {
    let own = on.own_measures();
    let names = names(on, axis);
    let of = |expression| {
        LoadLawSpec::Written(WrittenSpec {
            expression,
            factor: 1.0,
            over: None,
        })
    };
    law.case(
        "expression",
        "Expression over t, phi and phi_dot of the mass, driver_phi and driver_phi_dot, in s, rad or m: \"120*sin(2*pi*5*t)\".",
        |slot| written::read_expression(slot, &names).map(of),
    );
    law.case(
        "harmonic",
        "Sine over time, or over the displacement of the driver or of the object `over`.",
        |slot| read_harmonic(slot, own, axis).map(of),
    );
    if own.0 != Some(Coordinate::Turning) {
        law.case(
            "indicator",
            "Pressure on a piston over the displacement of the driver or of the object `over`: the indicator diagram of an engine or a compressor.",
            |slot| read_indicator(slot, axis.measures),
        );
    }
}

/// The names that an expression of a load may use.
pub(super) fn names(on: On, axis: Axis) -> Vec<(&'static str, usize)> {
    let mut names = builder::OWN.to_vec();
    if !matches!(on, On::Rotor(_)) {
        names.extend(builder::DRIVER);
    }
    written::names_with_other_object(names, axis.of_another)
}

/// mean + amplitude·sin(2π·frequency·t + phase), or of order·φ of the axis.
fn read_harmonic(slot: Slot<'_>, own: Measures, axis: Axis) -> Option<Expression> {
    slot.record(|fields| {
        let amplitude = fields.need("amplitude", "Amplitude", |slot| {
            slot.quantity(own.force(), Bounds::ANY)
        });
        let mut rate = fields.one_of("what it follows");
        rate.case("frequency", "Periods per second", |slot| {
            let frequency = slot.quantity(q::FREQUENCY, Bounds::NOT_NEGATIVE)?;
            Some(format!("2*pi*{frequency:?}*t"))
        });
        let (phi, variable) = match axis.of_another {
            true => builder::OVER[0],
            false => builder::DRIVER[0],
        };
        if axis.measures.0 != Some(Coordinate::Sliding) {
            let doc = "Periods per turn of the driver, or of the object `over`";
            rate.case("order", doc, |slot| {
                let order = slot.number(Bounds::ANY)?;
                Some(format!("{order:?}*{phi}"))
            });
        }
        let rate = rate.finish();
        let phase = fields.or(
            "phase",
            "Angle of the sine at its start",
            json!(0.0),
            |slot| slot.quantity(q::ANGLE, Bounds::ANY),
        );
        let mean = fields.or("mean", "Constant part", json!(0.0), |slot| {
            slot.quantity(own.force(), Bounds::ANY)
        });
        let (amplitude, rate, phase, mean) = (amplitude?, rate?, phase?, mean?);
        let mut text = format!("{amplitude:?}*sin({rate}");
        if phase != 0.0 {
            text += &format!(" + {phase:?}");
        }
        text += ")";
        if mean != 0.0 {
            text = format!("{mean:?} + {text}");
        }
        let names = [("t", 0), (phi, variable)];
        Expression::parse_over_names(&text, &names).ok()
    })
}

/// Pressure over the driver's displacement, times the area of the piston.
fn read_indicator(slot: Slot<'_>, driver: Measures) -> Option<LoadLawSpec> {
    slot.record(|fields| {
        let points = fields.need(
            "points",
            "List of [displacement of the driver or of `over`, pressure]: linear between the points.",
            |slot| read_points(slot, driver.displacement(), q::PRESSURE, 2),
        );
        let doc = "Area of the piston; positive: the pressure pushes towards positive displacement";
        let area = fields.need("area", doc, |slot| slot.quantity(q::AREA, Bounds::NOT_ZERO));
        let doc = "Pressure on the other side of the piston";
        let ambient = fields.or("ambient", doc, json!(AMBIENT), |slot| {
            slot.quantity(q::PRESSURE, Bounds::ANY)
        });
        let doc = "Repeats after this much of that displacement: 360 deg of a two-stroke, 720 deg of a four-stroke engine; default one turn of what turns";
        let period = read_period(fields, driver, doc);
        let (mut points, area, ambient, period) = (points?, area?, ambient?, period?);
        let turn = (driver.0 == Some(Coordinate::Turning)).then_some(TAU);
        let period = period.or(turn);
        if let Some(period) = period {
            fields.fill_in("period", json!(period));
            let length = points[points.len() - 1].0 - points[0].0;
            let closes = points[0].1 == points[points.len() - 1].1;
            if length > period * (1.0 + 1e-12) || length >= period * (1.0 - 1e-12) && !closes {
                let message = format!("the points span {length}, the period is {period}");
                fields.refuse("points", "out-of-range", message).hints.push(
                    "all points must lie within one period, and end with the pressure that \
                     they begin with if they fill it"
                        .to_owned(),
                );
                return None;
            }
        }
        for (_, pressure) in &mut points {
            *pressure = (*pressure - ambient) * area;
        }
        Some(LoadLawSpec::PositionTable {
            points,
            period,
            over: None,
        })
    })
}
