//! What is written of a body, each in one of its ways.

use super::MOST_MASSES;
use crate::frontend::object::geometry::{self, Beam, Elastic};
use crate::frontend::object::level::{self, LumpingChoice, Masses};
use crate::frontend::object::measures::Measures;
use crate::frontend::object::spec::InertiaSplit;
use crate::frontend::read::{Bounds, Fields, Slot, Value};
use crate::units::shown;
use std::f64::consts::{PI, TAU};

/// Everything that is written, each in one of its ways; `None`: absent.
pub(super) struct BodyFields {
    pub(super) masses: Option<Masses>,
    pub(super) inertia: Option<f64>,
    pub(super) inertias: Option<Vec<f64>>,
    pub(super) stiffness: Option<f64>,
    pub(super) stiffnesses: Option<Vec<f64>>,
    pub(super) capacity: Option<f64>,
    pub(super) damping: Option<f64>,
    pub(super) dampings: Option<Vec<f64>>,
    pub(super) split: Option<InertiaSplit>,
    pub(super) lumping: LumpingChoice,
    pub(super) modes: Option<usize>,
    pub(super) geometry: Option<Elastic>,
}

impl BodyFields {
    /// Total inertia, as written or of the geometry.
    pub(super) fn inertia(&self) -> Option<f64> {
        let geometry = self.geometry.map(|elastic| elastic.inertia);
        self.inertia.or(geometry)
    }

    /// Stiffness seen at the last mass, as written or of the geometry.
    pub(super) fn stiffness(&self) -> Option<f64> {
        let geometry = self.geometry.map(|elastic| elastic.stiffness);
        self.stiffness.or(geometry)
    }

    /// Damping capacity, as written or of the damping: ψ = 2π·b/√(c·J); 0 of neither.
    pub(super) fn capacity(&self, inertia: f64, stiffness: f64) -> f64 {
        let of = |damping: f64| damping * TAU / (stiffness * inertia).sqrt();
        self.capacity.or(self.damping.map(of)).unwrap_or(0.0)
    }
}

/// Reads what is written.
pub(super) fn read_body_fields(
    fields: &mut Fields<'_>,
    own: Measures,
    beam: Beam,
) -> Option<BodyFields> {
    let masses = fields.maybe(
        "masses",
        "Number of masses; 0: rigid; \"auto\": as many masses or modes as the accuracy of the \
         run needs. Default: 1, or the length of the lists.",
        |slot| level::read_masses(slot, MOST_MASSES),
    );
    own.name_inertia(fields);
    let inertia = fields.maybe("inertia", "Total inertia J", |slot| {
        slot.quantity(own.inertia(), Bounds::NOT_NEGATIVE)
    });
    let stiffness = fields.maybe("stiffness", "Stiffness c seen at the last mass", |slot| {
        slot.quantity(own.stiffness(), Bounds::POSITIVE)
    });
    let capacity = fields.maybe(
        "damping_capacity",
        "Specific damping capacity ψ: share of the elastic energy lost in one cycle. Default 0.",
        |slot| slot.number(Bounds::NOT_NEGATIVE),
    );
    let damping = fields.maybe("damping", "Damping b seen at the last mass", |slot| {
        slot.quantity(own.damping(), Bounds::NOT_NEGATIVE)
    });
    let split = fields.maybe(
        "split",
        "How the inertia is split: `cubes` (uniform lever), `equal`, or a list of shares.",
        read_inertia_split,
    );
    let lumping = level::read_lumping(fields);
    let modes = level::read_modes(fields);
    let list = |wanted, bounds| {
        move |slot: Slot<'_>| {
            slot.list(1..=MOST_MASSES as usize, |slot| {
                slot.quantity(wanted, bounds)
            })
        }
    };
    let inertias = fields.maybe(
        "inertias",
        "Inertia of each mass",
        list(own.inertia(), Bounds::POSITIVE),
    );
    let stiffnesses = fields.maybe(
        "stiffnesses",
        "Stiffness of each link",
        list(own.stiffness(), Bounds::POSITIVE),
    );
    let dampings = fields.maybe(
        "dampings",
        "Damping of each link",
        list(own.damping(), Bounds::NOT_NEGATIVE),
    );
    let geometry = fields.maybe(
        "geometry",
        "Dimensions and material, in place of inertia and stiffness",
        |slot| geometry::read(slot, beam),
    );
    if let (Some(Some(damping)), Some(Some(inertia)), Some(Some(stiffness))) =
        (damping, inertia, stiffness)
    {
        doubt_damping(fields, damping, 2.0 * (inertia * stiffness).sqrt(), own);
    }
    Some(BodyFields {
        masses: masses?,
        inertia: inertia?,
        inertias: inertias?,
        stiffness: stiffness?,
        stiffnesses: stiffnesses?,
        capacity: capacity?,
        damping: damping?,
        dampings: dampings?,
        split: split?,
        lumping: lumping?,
        modes: modes?,
        geometry: geometry?,
    })
}

/// Share of the critical damping below which a damping without a unit is likely a damping
/// ratio: steel alone has more.
const NO_DAMPING: f64 = 1e-3;

/// Warns of a damping that is likely meant as a ratio: `"damping": 0.2`.
fn doubt_damping(fields: &mut Fields<'_>, damping: f64, critical: f64, own: Measures) {
    let node = fields.member("damping").map(|member| &member.value.value);
    let bare = matches!(node, Some(Value::Number(_)));
    if !bare || damping <= 0.0 || damping > 1.0 || damping >= NO_DAMPING * critical {
        return;
    }
    let unit = own.damping().first.si();
    let message = format!(
        "`damping` is {damping} {unit}, and the critical damping is {} {unit}",
        shown(critical, 3)
    );
    let capacity = shown(4.0 * PI * damping, 3);
    let warning = fields.warn("damping", "implausible", message);
    warning.hints.push(format!(
        "for the damping ratio {damping} write \"damping_capacity\": {capacity}; \"{damping} {unit}\" \
         if the damping is meant"
    ));
}

fn read_inertia_split(mut slot: Slot<'_>) -> Option<InertiaSplit> {
    let names = [
        ("cubes", InertiaSplit::Cubes),
        ("equal", InertiaSplit::Equal),
    ];
    let shares = |slot: Slot<'_>| {
        slot.list(1..=MOST_MASSES as usize, |slot| {
            slot.number(Bounds::up_to(1.0))
        })
    };
    let shares = match slot.list_or(shares, |slot| slot.choice(&names))? {
        Ok(shares) => shares,
        Err(named) => return Some(named),
    };
    let sum: f64 = shares.iter().sum();
    if (sum - 1.0).abs() > 1e-6 {
        slot.refuse(
            "out-of-range",
            format!("the shares of `split` must add up to 1, found {sum}"),
        );
        return None;
    }
    Some(InertiaSplit::Shares(
        shares.iter().map(|share| share / sum).collect(),
    ))
}
