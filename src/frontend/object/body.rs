//! Inertia, stiffness, damping and number of masses of a chain.

mod sound;
mod written;

pub(super) use sound::is_sound;

use super::geometry::Beam;
use super::level::Masses;
use super::measures::Measures;
use super::spec::{BodySpec, InertiaSplit, Level, Uniform};
use crate::frontend::read::Fields;
use serde_json::json;
use sound::check_overflow;
use std::f64::consts::TAU;
use written::{BodyFields, read_body_fields};

/// Most masses of one object.
pub(super) const MOST_MASSES: u64 = 10_000;

/// Pairs of properties that say the same thing.
const CLASHES: &[(&str, &str)] = &[
    ("inertia", "geometry"),
    ("inertia", "inertias"),
    ("inertias", "geometry"),
    ("stiffness", "geometry"),
    ("stiffness", "stiffnesses"),
    ("stiffnesses", "geometry"),
    ("damping_capacity", "damping"),
    ("damping_capacity", "dampings"),
    ("damping", "dampings"),
    ("split", "inertias"),
    ("modes", "inertias"),
    ("modes", "stiffnesses"),
    ("modes", "dampings"),
    ("modes", "lumping"),
    ("modes", "masses"),
    ("flexibility", "inertias"),
    ("flexibility", "stiffnesses"),
    ("flexibility", "dampings"),
    ("flexibility", "lumping"),
    ("flexibility", "masses"),
    ("flexibility", "modes"),
];

/// Reads the body of a chain.
pub(super) fn read(
    fields: &mut Fields<'_>,
    own: Measures,
    beam: Beam,
    default_split: InertiaSplit,
) -> Option<BodySpec> {
    let written = read_body_fields(fields, own, beam);
    let mut clash = false;
    for (one, other) in CLASHES {
        clash |= fields.clash(one, other, "they give the same parameter in two ways");
    }
    let written = written.filter(|_| !clash)?;
    if let Some(modes) = written.modes {
        return read_modal(fields, written, modes, default_split);
    }
    if written.masses == Some(Masses::Auto) {
        return read_body_of_open_level(fields, written, default_split);
    }
    let masses = read_number_of_masses(fields, &written)?;
    fields.fill_in("masses", json!(masses));
    if masses == 0 {
        return read_rigid(fields, &written);
    }
    read_elastic_body(fields, written, masses, default_split)
}

/// The number of masses, with which all lists must agree.
fn read_number_of_masses(fields: &mut Fields<'_>, written: &BodyFields) -> Option<usize> {
    let shares = match &written.split {
        Some(InertiaSplit::Shares(shares)) => Some(shares.len()),
        _ => None,
    };
    let lists = [
        ("inertias", written.inertias.as_ref().map(Vec::len)),
        ("stiffnesses", written.stiffnesses.as_ref().map(Vec::len)),
        ("dampings", written.dampings.as_ref().map(Vec::len)),
        ("split", shares),
    ];
    let first_list = lists
        .iter()
        .find_map(|(name, length)| Some((*name, (*length)?)));
    let (said_by, masses) = match (written.masses, first_list) {
        (Some(Masses::Count(masses)), _) => ("masses", masses),
        (_, Some(found)) => found,
        (_, None) => ("masses", 1),
    };
    let mut agree = true;
    for (name, length) in lists {
        let Some(length) = length.filter(|length| *length != masses) else {
            continue;
        };
        agree = false;
        let other = fields.value_place(said_by);
        let entries = if length == 1 { "entry" } else { "entries" };
        let fault = fields.refuse(
            name,
            "wrong-length",
            format!("`{name}` has {length} {entries} for {masses} masses"),
        );
        fault
            .related
            .push(crate::frontend::diagnostics::RelatedPlace {
                place: other,
                label: format!("{masses} masses here"),
            });
    }
    agree.then_some(masses)
}

/// Stiffness and damping of a rigid object are left unused, so that the number
/// of masses can be varied down to 0.
fn read_rigid(fields: &mut Fields<'_>, written: &BodyFields) -> Option<BodySpec> {
    match written.inertia() {
        Some(inertia) => Some(BodySpec::Rigid { inertia }),
        None => {
            fields.note_missing(
                "inertia",
                Some("give `inertia` (0 for a massless object) or `geometry`".to_owned()),
            );
            None
        }
    }
}

/// An object that is reduced to its lowest modes; without any, to static flexibility.
fn read_modal(
    fields: &mut Fields<'_>,
    written: BodyFields,
    modes: usize,
    default_split: InertiaSplit,
) -> Option<BodySpec> {
    let level = match modes {
        0 => Level::Static,
        count => Level::Modes { count },
    };
    let uniform = read_continuum(fields, &written, default_split)?;
    check_overflow(fields, uniform.at(level))
}

/// An object of which the run chooses how much is modelled.
fn read_body_of_open_level(
    fields: &mut Fields<'_>,
    written: BodyFields,
    default_split: InertiaSplit,
) -> Option<BodySpec> {
    if let Some(list) = missing_for_continuum(&written, written.split.as_ref()) {
        let message =
            format!("`{list}` says of each mass or link what it is: nothing is left to be chosen");
        let fault = fields.refuse("masses", "contradiction", message);
        let hint = format!("give totals in place of `{list}`, or leave `masses` out");
        fault.hints.push(hint);
        return None;
    }
    if written.lumping.is_requested() {
        let message = "`masses`: \"auto\" chooses the lumping too";
        let fault = fields.refuse("lumping", "contradiction", message);
        fault
            .hints
            .push("leave `lumping` out, or give a number of masses".to_owned());
        return None;
    }
    let uniform = read_continuum(fields, &written, default_split)?;
    check_overflow(fields, BodySpec::Open(uniform))
}

/// The uniform object that totals describe.
fn read_continuum(
    fields: &mut Fields<'_>,
    written: &BodyFields,
    default_split: InertiaSplit,
) -> Option<Uniform> {
    let (inertia, stiffness) = (written.inertia(), written.stiffness());
    check_elastic(fields, written, inertia, stiffness)?;
    let split = written.split.clone().unwrap_or(default_split);
    if matches!(split, InertiaSplit::Shares(_)) {
        let message = "shares of one's own are no uniform object that has modes";
        let fault = fields.refuse("split", "contradiction", message);
        let hint = "give `equal` or `cubes`, or `masses` in place of `modes`";
        fault.hints.push(hint.to_owned());
        return None;
    }
    fields.fill_in("split", split_json(&split));
    if written.damping.is_none() {
        fields.fill_in("damping_capacity", json!(written.capacity.unwrap_or(0.0)));
    }
    let (inertia, stiffness) = (inertia?, stiffness?);
    Some(Uniform {
        inertia,
        stiffness,
        damping_capacity: written.capacity(inertia, stiffness),
        split,
    })
}

fn read_elastic_body(
    fields: &mut Fields<'_>,
    written: BodyFields,
    masses: usize,
    default_split: InertiaSplit,
) -> Option<BodySpec> {
    let (inertia, stiffness) = (written.inertia(), written.stiffness());
    check_elastic(fields, &written, inertia, stiffness)?;
    let split = written.split.clone().unwrap_or(default_split);
    let lumping = match missing_for_continuum(&written, Some(&split)) {
        None => written.lumping.or_default(),
        Some(why) => written.lumping.without_continuum(fields, why)?,
    };
    if written.inertias.is_none() {
        fields.fill_in("split", split_json(&split));
    }
    if written.dampings.is_none() && written.damping.is_none() {
        fields.fill_in("damping_capacity", json!(written.capacity.unwrap_or(0.0)));
    }
    if let (Some(inertia), Some(stiffness), None) = (inertia, stiffness, &written.dampings) {
        let body = BodySpec::Uniform {
            inertia,
            stiffness,
            damping_capacity: written.capacity(inertia, stiffness),
            masses,
            split,
            lumping,
        };
        return check_overflow(fields, body);
    }
    let split_up = |inertia: f64| {
        shares(&split, masses)
            .iter()
            .map(|share| share * inertia)
            .collect()
    };
    let inertias: Vec<f64> = written.inertias.or(inertia.map(split_up))?;
    let in_series = |stiffness: f64| vec![stiffness * masses as f64; masses];
    let stiffnesses = written.stiffnesses.or(stiffness.map(in_series))?;
    let dampings = written.dampings.unwrap_or_else(|| {
        spread_damping(&inertias, &stiffnesses, written.capacity, written.damping)
    });
    let body = BodySpec::Lists {
        inertias,
        stiffnesses,
        dampings,
    };
    check_overflow(fields, body)
}

/// Why what is written is no continuum, cut into cells.
fn missing_for_continuum(
    written: &BodyFields,
    split: Option<&InertiaSplit>,
) -> Option<&'static str> {
    let lists = [
        (written.inertias.is_some(), "inertias"),
        (written.stiffnesses.is_some(), "stiffnesses"),
        (written.dampings.is_some(), "dampings"),
        (matches!(split, Some(InertiaSplit::Shares(_))), "split"),
    ];
    lists
        .into_iter()
        .find_map(|(given, name)| given.then_some(name))
}

/// An elastic object needs an inertia and a stiffness, both greater than 0.
fn check_elastic(
    fields: &mut Fields<'_>,
    written: &BodyFields,
    inertia: Option<f64>,
    stiffness: Option<f64>,
) -> Option<()> {
    let no_inertia = inertia.is_none() && written.inertias.is_none();
    let no_stiffness = stiffness.is_none() && written.stiffnesses.is_none();
    if no_inertia {
        fields.note_missing(
            "inertia",
            Some("give `inertia`, `inertias` or `geometry`".to_owned()),
        );
    }
    if no_stiffness {
        let hint =
            "give `stiffness`, `stiffnesses` or `geometry`, or `masses`: 0 for a rigid object";
        fields.note_missing("stiffness", Some(hint.to_owned()));
    }
    if inertia == Some(0.0) {
        let message = "`inertia` must be greater than 0 for an elastic object";
        let fault = fields.refuse("inertia", "out-of-range", message);
        fault
            .hints
            .push("a massless object is rigid: `masses`: 0".to_owned());
        return None;
    }
    (!no_inertia && !no_stiffness).then_some(())
}

/// b_m = ψ·c_m/(2π·ω₀) with ω₀ = √(c/J) of the whole, or b·c_m/c.
fn spread_damping(
    inertias: &[f64],
    stiffnesses: &[f64],
    capacity: Option<f64>,
    damping: Option<f64>,
) -> Vec<f64> {
    let whole = 1.0 / stiffnesses.iter().map(|c| 1.0 / c).sum::<f64>();
    let inertia: f64 = inertias.iter().sum();
    let per_stiffness = match damping {
        Some(damping) => damping / whole,
        None => capacity.unwrap_or(0.0) / (TAU * (whole / inertia).sqrt()),
    };
    stiffnesses.iter().map(|c| c * per_stiffness).collect()
}

/// Share of the inertia that each mass has; they add up to 1.
fn shares(split: &InertiaSplit, masses: usize) -> Vec<f64> {
    let n = masses as f64;
    match split {
        InertiaSplit::Equal => vec![1.0 / n; masses],
        // m³ − (m−1)³ = 3m(m−1) + 1, without cancellation.
        InertiaSplit::Cubes => (1..=masses)
            .map(|m| (3.0 * m as f64 * (m as f64 - 1.0) + 1.0) / n.powi(3))
            .collect(),
        InertiaSplit::Shares(shares) => shares.clone(),
    }
}

fn split_json(split: &InertiaSplit) -> serde_json::Value {
    match split {
        InertiaSplit::Cubes => json!("cubes"),
        InertiaSplit::Equal => json!("equal"),
        InertiaSplit::Shares(shares) => json!(shares),
    }
}
