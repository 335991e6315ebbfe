//! Inertia and stiffness from dimensions and material.

use crate::frontend::read::{Bounds, Fields, QuantityChoice, Slot};
use crate::units::quantities as q;
use std::f64::consts::PI;

/// Body of an elastic object, from which inertia and stiffness follow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Beam {
    /// A uniform lever of rectangular section, turning about its end and bent
    /// by a force at its tip.
    Lever,
    /// A uniform round shaft in torsion.
    Shaft,
    /// A uniform rod, pulled and pressed along its axis.
    Rod,
}

/// Inertia J and stiffness c.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Elastic {
    pub(super) inertia: f64,
    pub(super) stiffness: f64,
}

/// Reads `geometry`.
pub(super) fn read(slot: Slot<'_>, beam: Beam) -> Option<Elastic> {
    let path = slot.path().to_owned();
    slot.record(|fields| {
        let elastic = match beam {
            Beam::Lever => read_lever(fields),
            Beam::Shaft => read_shaft(fields),
            Beam::Rod => read_rod(fields),
        }?;
        let sound = |value: f64| value.is_finite() && value > 0.0;
        if sound(elastic.inertia) && sound(elastic.stiffness) {
            return Some(elastic);
        }
        let message = format!(
            "`{path}` gives an inertia of {} and a stiffness of {}",
            elastic.inertia, elastic.stiffness
        );
        fields.refuse("", "out-of-range", message);
        None
    })
}

fn read_positive(
    fields: &mut Fields<'_>,
    name: &'static str,
    doc: &str,
    wanted: impl Into<QuantityChoice>,
) -> Option<f64> {
    fields.need(name, doc, |slot| slot.quantity(wanted, Bounds::POSITIVE))
}

fn read_density(fields: &mut Fields<'_>) -> Option<f64> {
    read_positive(fields, "density", "Density of the material", q::DENSITY)
}

fn read_youngs_modulus(fields: &mut Fields<'_>) -> Option<f64> {
    let doc = "Young's modulus of the material";
    read_positive(fields, "modulus", doc, q::MODULUS)
}

/// J = ρ·w·h·L³/3, c = 3·E·I/L, I = w·h³/12: a force F at the tip bends the
/// lever by F·L³/(3EI), a turn of F·L²/(3EI) for the moment F·L.
fn read_lever(fields: &mut Fields<'_>) -> Option<Elastic> {
    let length = read_positive(
        fields,
        "length",
        "Length from the axis to the tip",
        q::LENGTH,
    );
    let width = read_positive(
        fields,
        "width",
        "Width of the section, along the axis",
        q::LENGTH,
    );
    let height = read_positive(
        fields,
        "height",
        "Height of the section, in the plane of motion",
        q::LENGTH,
    );
    let density = read_density(fields);
    let modulus = read_youngs_modulus(fields);
    let (length, width, height) = (length?, width?, height?);
    Some(Elastic {
        inertia: density? * width * height * length.powi(3) / 3.0,
        stiffness: 3.0 * modulus? * width * height.powi(3) / 12.0 / length,
    })
}

/// J = ρ·π·(D⁴ − d⁴)·L/32, c = G·π·(D⁴ − d⁴)/(32·L).
fn read_shaft(fields: &mut Fields<'_>) -> Option<Elastic> {
    let length = read_positive(
        fields,
        "length",
        "Length between driver and follower",
        q::LENGTH,
    );
    let outer = read_positive(fields, "diameter", "Outer diameter", q::LENGTH);
    let inner = fields.or(
        "bore",
        "Diameter of the bore, less than `diameter`",
        0.0.into(),
        |slot| slot.quantity(q::LENGTH, Bounds::NOT_NEGATIVE),
    );
    let density = read_density(fields);
    let modulus = read_positive(
        fields,
        "shear_modulus",
        "Shear modulus of the material",
        q::MODULUS,
    );
    let (length, outer, inner) = (length?, outer?, inner?);
    if inner >= outer {
        let message = format!("`bore` ({inner} m) must be less than `diameter` ({outer} m)");
        fields.refuse("bore", "out-of-range", message);
        return None;
    }
    let section = PI * (outer.powi(4) - inner.powi(4)) / 32.0;
    Some(Elastic {
        inertia: density? * section * length,
        stiffness: modulus? * section / length,
    })
}

/// m = ρ·A·L, c = E·A/L.
fn read_rod(fields: &mut Fields<'_>) -> Option<Elastic> {
    let length = read_positive(fields, "length", "Length", q::LENGTH);
    let mut section = fields.one_of("its section");
    section.case("area", "Area of the section", |slot| {
        slot.quantity(q::AREA, Bounds::POSITIVE)
    });
    section.case("diameter", "Diameter of a round section", |slot| {
        let diameter = slot.quantity(q::LENGTH, Bounds::POSITIVE)?;
        Some(PI * diameter * diameter / 4.0)
    });
    section.case(
        "section",
        "Width and height of a rectangular section",
        |slot| {
            let side = |slot: Slot<'_>| slot.quantity(q::LENGTH, Bounds::POSITIVE);
            let (width, height) = slot.pair(side, side)?;
            Some(width * height)
        },
    );
    let area = section.finish();
    let density = read_density(fields);
    let modulus = read_youngs_modulus(fields);
    let (length, area) = (length?, area?);
    Some(Elastic {
        inertia: density? * area * length,
        stiffness: modulus? * area / length,
    })
}
