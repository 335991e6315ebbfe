//! Position functions.

mod linkages;
mod table_roughness;

use super::cam;
use super::measures::Measures;
use super::measures::PositionMeasures;
use super::measures::read_quantity;
use super::{plan, table_period};
use crate::dynamics::model::Coordinate::{Sliding, Turning};
use crate::frontend::read::{Bounds, Fields, Slot, read_points};
use crate::kinematics::position::{CustomPosition, PositionSpec, SlottedDriver, SlottedOutput};
use crate::units::quantities as q;
use linkages::{read_four_bar, read_slider_crank, read_slotted_link};
use serde_json::json;

/// Most coefficients of a polynomial.
const MOST_COEFFICIENTS: usize = 64;

/// Names of all position functions.
pub(super) const ALL: &[&str] = &[
    "ratio",
    "sine",
    "polynomial",
    "table",
    "slider_crank",
    "four_bar",
    "slotted_link",
    "cam",
    "plan",
];

/// Reads `position`. Only the functions in `allowed` are described; any other
/// is read too, to say what is wrong with it.
pub(super) fn read(
    mut slot: Slot<'_>,
    ends: PositionMeasures,
    allowed: &[&str],
) -> Option<PositionSpec> {
    if let Some(function) = slot.own() {
        return read_from_code(slot, function, allowed);
    }
    slot.record(|fields| {
        let describing = fields.describing();
        let shown = |name: &str| !describing || allowed.contains(&name);
        let mut function = fields.one_of("the position function");
        if shown("ratio") {
            function.case("ratio", "Constant ratio: U = ratio·φ + offset.", |slot| {
                read_ratio(slot, ends)
            });
        }
        if shown("sine") {
            function.case(
                "sine",
                "U = amplitude·sin(harmonic·φ + phase) + offset.",
                |slot| read_sine(slot, ends),
            );
        }
        if shown("polynomial") {
            function.case(
                "polynomial",
                "U = a₀ + a₁·φ + a₂·φ² + …",
                |slot| read_polynomial(slot, ends),
            );
        }
        if shown("table") {
            function.case("table", "Smooth spline through given points.", |slot| {
                read_table(slot, ends)
            });
        }
        if shown("slider_crank") && ends.output.0 != Some(Turning) || !describing {
            function.case(
                "slider_crank",
                "Slider-crank: distance of the slide from the crank's axis.",
                read_slider_crank,
            );
        }
        if shown("four_bar") && ends.output.0 != Some(Sliding) || !describing {
            function.case(
                "four_bar",
                "Four-bar linkage: angle of the driven lever.",
                read_four_bar,
            );
        }
        if shown("slotted_link") {
            function.case(
                "slotted_link",
                "Slotted link: crank and slotted link on fixed pivots, a block on the crank's end in the slot; crank or block drives.",
                |slot| read_slotted_link(slot, ends.output),
            );
        }
        if shown("cam") {
            function.case("cam", "Cam with rise, dwell, return and rest.", |slot| {
                cam::read(slot, ends.output)
            });
        }
        if shown("plan") {
            function.case(
                "plan",
                "Plan of motion: any number of rises, dwells and returns.",
                |slot| plan::of_position(slot, ends).map(PositionSpec::Plan),
            );
        }
        let function = function.finish()?;
        check(fields, &function, ends, allowed).then_some(function)
    })
}

/// A function given in code: it fits where functions of any form do.
fn read_from_code(
    mut slot: Slot<'_>,
    function: CustomPosition,
    allowed: &[&str],
) -> Option<PositionSpec> {
    if allowed.contains(&"table") {
        return Some(PositionSpec::Custom(function));
    }
    let message = "an own position function does not fit this kind of object";
    let allowed = crate::frontend::read::quoted_list(allowed.iter().copied(), "or");
    let fault = slot.refuse("contradiction", message);
    fault.hints.push(format!("it takes {allowed}"));
    None
}

/// Whether the function fits the object and its driver.
fn check(
    fields: &mut Fields<'_>,
    function: &PositionSpec,
    ends: PositionMeasures,
    allowed: &[&str],
) -> bool {
    let (name, turning_driver, output) = match function {
        PositionSpec::Ratio { .. } => ("ratio", false, None),
        PositionSpec::Sine { .. } => ("sine", false, None),
        PositionSpec::Polynomial { .. } => ("polynomial", false, None),
        PositionSpec::Table { .. } => ("table", false, None),
        PositionSpec::SliderCrank { .. } => ("slider_crank", true, Some(Sliding)),
        PositionSpec::FourBar { .. } => ("four_bar", true, Some(Turning)),
        PositionSpec::SlottedLink(spec) => (
            "slotted_link",
            spec.driver == SlottedDriver::Crank,
            Some(match spec.output {
                SlottedOutput::Link | SlottedOutput::Crank => Turning,
                SlottedOutput::Block => Sliding,
            }),
        ),
        PositionSpec::Cam(_) => ("cam", true, None),
        PositionSpec::Plan(_) => ("plan", false, None),
        // It is read before, and fits wherever it is taken.
        PositionSpec::Custom(_) => return true,
    };
    let before = fields.faults();
    if !allowed.contains(&name) {
        let fault = fields.refuse(
            name,
            "contradiction",
            format!("`{name}` does not fit this kind of object"),
        );
        fault.hints.push(format!(
            "it takes {}",
            crate::frontend::read::quoted_list(allowed.iter().copied(), "or")
        ));
    }
    match (output, ends.output.0) {
        (Some(Sliding), Some(Turning)) => {
            let message = format!("`{name}` gives a length, but an angle is wanted here");
            let fault = fields.refuse(name, "contradiction", message);
            fault
                .hints
                .push("use it for a `slider` or a sliding `cam_follower`".to_owned());
        }
        (Some(Turning), Some(Sliding)) => {
            let message = format!("`{name}` gives an angle, but a length is wanted here");
            let fault = fields.refuse(name, "contradiction", message);
            fault
                .hints
                .push("add `lever_arm`, or use a turning object".to_owned());
        }
        _ => {}
    }
    if turning_driver && ends.driver.0 == Some(Sliding) {
        let message = format!("`{name}` needs a driver that turns, but this one slides");
        fields.refuse(name, "contradiction", message);
    }
    let by_block =
        matches!(function, PositionSpec::SlottedLink(spec) if spec.driver == SlottedDriver::Block);
    if by_block && ends.driver.0 == Some(Turning) {
        let message =
            "the block of a `slotted_link` needs a driver that slides, but this one turns";
        let fault = fields.refuse(name, "contradiction", message);
        let hint = "set its `driver` to \"crank\", or drive it by a cylinder: a `drive` with \"coordinate\": \"sliding\"";
        fault.hints.push(hint.to_owned());
    }
    fields.faults() == before
}

fn read_ratio(slot: Slot<'_>, ends: PositionMeasures) -> Option<PositionSpec> {
    let factor =
        move |slot: Slot<'_>| slot.quantity(ends.output.per(ends.driver), Bounds::NOT_ZERO);
    slot.object_or(
        |slot| {
            slot.record(|fields| {
                let ratio = fields.need("ratio", "U′", factor);
                let offset = fields.or(
                    "offset",
                    "U at φ = 0",
                    json!(0.0),
                    read_quantity(ends.output.displacement()),
                );
                Some(PositionSpec::Ratio {
                    ratio: ratio?,
                    offset: offset?,
                })
            })
        },
        |slot| {
            let ratio = factor(slot)?;
            Some(PositionSpec::Ratio { ratio, offset: 0.0 })
        },
    )
}

fn read_sine(slot: Slot<'_>, ends: PositionMeasures) -> Option<PositionSpec> {
    slot.record(|fields| {
        let amplitude = fields.need(
            "amplitude",
            "Half the stroke",
            read_quantity(ends.output.displacement()),
        );
        let turning = Measures(Some(Turning));
        let harmonic = fields.or(
            "harmonic",
            "Oscillations per turn of the driver",
            json!(1.0),
            |slot| slot.quantity(turning.per(ends.driver), Bounds::NOT_ZERO),
        );
        let phase = fields.or(
            "phase",
            "Phase at φ = 0",
            json!(0.0),
            read_quantity(q::ANGLE),
        );
        let offset = fields.or(
            "offset",
            "Middle of the stroke",
            json!(0.0),
            read_quantity(ends.output.displacement()),
        );
        Some(PositionSpec::Sine {
            amplitude: amplitude?,
            harmonic: harmonic?,
            phase: phase?,
            offset: offset?,
        })
    })
}

fn read_polynomial(slot: Slot<'_>, ends: PositionMeasures) -> Option<PositionSpec> {
    slot.record(|fields| {
        let coefficients = fields.need(
            "coefficients",
            "a₀, a₁, a₂, … in SI units (or texts with units), lowest power first.",
            |slot| {
                let mut power = 0;
                slot.list(1..=MOST_COEFFICIENTS, |slot| {
                    let wanted = ends.output.coefficient(ends.driver, power);
                    power += 1;
                    slot.quantity(wanted, Bounds::ANY)
                })
            },
        );
        Some(PositionSpec::Polynomial {
            coefficients: coefficients?,
        })
    })
}

fn read_table(slot: Slot<'_>, ends: PositionMeasures) -> Option<PositionSpec> {
    slot.record(|fields| {
        let points = fields.need(
            "points",
            "List of [driver's displacement, displacement], at least three, the first values ascending.",
            |slot| read_points(slot, ends.driver.displacement(), ends.output.displacement(), 3),
        );
        let has_period = fields.has("period");
        let periodic = fields.or(
            "periodic",
            "True: the table repeats. Without `period` the last point closes the period; it has the displacement of the first. Default true with `period`.",
            json!(has_period),
            |slot| slot.flag(),
        );
        let doc = "Repeats after this much of the driver's displacement; the curve goes on to the first point by itself";
        let period = fields.maybe("period", doc, |slot| {
            slot.quantity(ends.driver.displacement(), Bounds::POSITIVE)
        });
        let slope = read_quantity(ends.output.per(ends.driver));
        let slopes = fields.or("end_slopes", "Slopes U′ at both ends of a table that is not periodic", json!([0.0, 0.0]), |slot| {
            slot.pair(&slope, &slope)
        });
        let (points, periodic, period, end_slopes) = (points?, periodic?, period?, slopes?);
        if !periodic && period.is_some() {
            fields.refuse("period", "contradiction", "a table that does not repeat has no `period`");
            return None;
        }
        if periodic && fields.has("end_slopes") {
            fields.refuse("end_slopes", "contradiction", "a periodic table has no ends");
            return None;
        }
        let points = match (periodic, period) {
            (true, Some(period)) => table_period::read_closed(fields, points, period, ends.driver)?,
            (true, None) => {
                table_period::check(fields, &points, ends.driver)?;
                points
            }
            (false, _) => points,
        };
        table_roughness::warn_of_scatter(fields, &points);
        Some(PositionSpec::Table {
            points,
            periodic,
            end_slopes,
        })
    })
}
