//! The dynamic model as aligned tables: masses, links, loads, natural frequencies.

use super::linkages::{linkages, multi_linkages};
use super::{contact, equations, load_word, units};
use crate::dynamics::laws::contact::law_of_link;
use crate::dynamics::model::{
    Closure, LinkBase, Load, Loss, Model, NodeMotion, OUTPUT, ObjectPart, STOP,
};
use crate::report::diagram::pair;
use crate::report::findings::Table;
use crate::report::order::drivers_first;
use crate::report::quantity::{significant, with_unit};
use std::f64::consts::TAU;

/// Undamped natural frequencies of a model (rad/s), ascending.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frequencies {
    /// All pairs engaged.
    pub engaged: Vec<f64>,
    /// All pairs that can open are open; a free chain has a zero among them.
    pub open: Vec<f64>,
}

/// The dynamic model of a scene as text.
pub fn text(model: &Model, frequencies: &Frequencies) -> String {
    let mut out = String::new();
    section(&mut out, "Masses", &masses_table(model));
    section(&mut out, "Links", &links_table(model));
    section(&mut out, "Reduced to modes", &super::reduced::table(model));
    out.push_str(&linkages(model));
    out.push_str(&multi_linkages(model));
    section(&mut out, "Driving pairs", &pairs_table(model));
    section(&mut out, "Loads", &loads_table(model));
    section(
        &mut out,
        "Natural frequencies, undamped",
        &table_of(frequencies),
    );
    out
}

/// The same as tables of a page.
#[cfg(feature = "live")]
pub(in crate::report) fn html(model: &Model, frequencies: &Frequencies) -> String {
    use crate::report::quantity::escape;
    let tables = [
        ("Natural frequencies, undamped", table_of(frequencies)),
        ("Masses", masses_table(model)),
        ("Links", links_table(model)),
        ("Reduced to modes", super::reduced::table(model)),
        ("Driving pairs", pairs_table(model)),
        ("Loads", loads_table(model)),
    ];
    let tables = tables.iter().map(|(title, table)| match table.html() {
        none if none.is_empty() => none,
        table => format!("<h2>{title}</h2>\n{table}"),
    });
    let tables: String = tables.collect();
    match linkages(model).trim() {
        "" => tables,
        words => format!("{tables}<h2>Linkages</h2>\n<pre>{}</pre>\n", escape(words)),
    }
}

fn section(out: &mut String, title: &str, table: &Table) {
    let text = table.text();
    if text.is_empty() {
        return;
    }
    if !out.is_empty() {
        out.push('\n');
    }
    out.push_str(&format!("{title}\n{text}"));
}

fn objects(model: &Model) -> impl Iterator<Item = &ObjectPart> {
    let order = drivers_first(model);
    order.into_iter().map(|index| &model.objects[index])
}

fn masses_table(model: &Model) -> Table {
    let mut table = Table::new(["object", "kind", ">mass", ">inertia J", "", "motion"]);
    for object in objects(model).filter(|object| object.kind != OUTPUT && object.kind != STOP) {
        let drivers = object.inputs.iter();
        let drivers: Vec<&str> = drivers
            .map(|input| model.objects[input.driver].id.as_str())
            .collect();
        let drivers = drivers.join(" and ");
        for (place, &index) in object.nodes.iter().enumerate() {
            let node = &model.nodes[index];
            let mut several = model.multi_linkages.iter();
            let several = several.find(|body| body.node == index);
            let (mass, motion) = match &node.motion {
                NodeMotion::Prescribed { .. } => ("–".to_owned(), "prescribed".to_owned()),
                NodeMotion::Rotor { .. } => {
                    ("–".to_owned(), "free, turned by its torque".to_owned())
                }
                NodeMotion::Mass { .. } => ((place + 1).to_string(), "free".to_owned()),
                NodeMotion::Rigid { .. } | NodeMotion::Constrained { .. } => {
                    ("–".to_owned(), format!("rigid, follows {drivers}"))
                }
            };
            let motion = match several {
                None => motion,
                Some(body) => {
                    let inputs = body.linkage.input_names().join(", ");
                    format!("rigid, by its inputs {inputs}")
                }
            };
            let reduced = model.linkages.iter().any(|body| body.node == index);
            let inertia = match reduced {
                true => "J(φ)".to_owned(),
                false if several.is_some() => "M(q)".to_owned(),
                false => significant(node.inertia, 6),
            };
            table.push(vec![
                object.id.clone(),
                object.kind.to_owned(),
                mass,
                inertia,
                units(object.coordinate).inertia.to_owned(),
                motion,
            ]);
        }
    }
    table
}

fn links_table(model: &Model) -> Table {
    let mut table = Table::new([
        "object",
        ">link",
        "between",
        ">stiffness c",
        "",
        ">damping b",
        "",
    ]);
    for object in objects(model) {
        let unit = units(object.coordinate);
        for (place, &link) in object.links.iter().enumerate() {
            let link = &model.links[link];
            let between = match link.base {
                LinkBase::Law { .. } => contact::first_link(object).to_owned(),
                LinkBase::Mass(_) if place == 0 => "contact and mass 1".to_owned(),
                LinkBase::Mass(_) => format!("mass {place} and mass {}", place + 1),
            };
            table.push(vec![
                object.id.clone(),
                (place + 1).to_string(),
                between,
                significant(link.stiffness, 6),
                unit.stiffness.to_owned(),
                significant(link.damping, 6),
                unit.damping.to_owned(),
            ]);
        }
    }
    table
}

fn pairs_table(model: &Model) -> Table {
    let mut table = Table::new(["object", "closure", ">gap", "opens", "contact law"]);
    let linkage = |object: &ObjectPart| {
        let mut bodies = model.linkages.iter();
        let mut several = model.multi_linkages.iter();
        object.kind == OUTPUT
            || bodies.any(|body| object.nodes.contains(&body.node))
            || several.any(|body| object.nodes.contains(&body.node))
    };
    for object in objects(model).filter(|one| !one.is_drive() && one.kind != STOP && !linkage(one))
    {
        let pair = pair(model, object).copied().unwrap_or_default();
        let unit = units(object.coordinate).displacement;
        let (closure, gap, opens) = match pair.closure {
            Closure::Bilateral => ("bilateral", "–".to_owned(), "never"),
            Closure::Force => (
                "force",
                "–".to_owned(),
                if pair.opens >= 0.0 {
                    "towards +"
                } else {
                    "towards −"
                },
            ),
            Closure::Form => ("form", with_unit(pair.gap, unit, 6), "in the gap"),
        };
        let law = match pair.form.loss() {
            _ if object.contact.is_some() => contact::summary(object),
            Some(loss) if !object.links.is_empty() => {
                format!("{}{}", law_of_link(loss).name, factor(loss, unit))
            }
            _ => "rigid".to_owned(),
        };
        table.push(vec![
            object.id.clone(),
            closure.to_owned(),
            gap,
            opens.to_owned(),
            law,
        ]);
    }
    table
}

/// κ of a pair.
fn factor(loss: Loss, unit: &str) -> String {
    match loss {
        Loss::Damper => String::new(),
        Loss::Factor(kappa) => format!(", κ = {} s/{unit}", significant(kappa, 6)),
        Loss::FactorOfDamper => ", κ from b and the static load".to_owned(),
    }
}

fn loads_table(model: &Model) -> Table {
    let mut table = Table::new(["object", "load", ">mass", "law"]);
    for object in objects(model).filter(|object| object.kind != STOP) {
        for (place, node) in object.nodes.iter().enumerate() {
            let own = |load: &&Load| model.owner_of_load(load) == *node;
            for load in model.loads.iter().filter(own) {
                table.push(vec![
                    object.id.clone(),
                    load_word(&load.name).to_owned(),
                    (place + 1).to_string(),
                    equations::load_summary(&load.law, object.coordinate),
                ]);
            }
        }
    }
    table
}

fn table_of(frequencies: &Frequencies) -> Table {
    let mut table = Table::new([">no.", ">engaged, rad/s", ">Hz", ">open, rad/s", ">Hz"]);
    let number = |list: &[f64], row: usize, factor: f64| {
        list.get(row)
            .map_or(String::new(), |omega| significant(omega * factor, 6))
    };
    for row in 0..frequencies.engaged.len().max(frequencies.open.len()) {
        table.push(vec![
            (row + 1).to_string(),
            number(&frequencies.engaged, row, 1.0),
            number(&frequencies.engaged, row, 1.0 / TAU),
            number(&frequencies.open, row, 1.0),
            number(&frequencies.open, row, 1.0 / TAU),
        ]);
    }
    table
}

#[cfg(test)]
mod tests {
    use super::{Frequencies, text};
    use crate::report::fixture;

    #[test]
    fn the_two_mass_rocker_in_tables() {
        let frequencies = Frequencies {
            engaged: vec![1e4, 4e4],
            open: vec![0.0, 42761.8],
        };
        let expected = "\
Masses
  object  kind    mass  inertia J         motion
  shaft   drive      –          0  kg m²  prescribed
  rocker  rocker     1     0.0125  kg m²  free
  rocker  rocker     2     0.0875  kg m²  free

Links
  object  link  between            stiffness c           damping b
  rocker     1  law U and mass 1         2·10⁷  N m/rad    127.324  N m s/rad
  rocker     2  mass 1 and mass 2        2·10⁷  N m/rad    127.324  N m s/rad

Driving pairs
  object  closure  gap  opens      contact law
  rocker  force      –  towards +  Kelvin–Voigt

Loads
  object  load     mass  law
  rocker  closing     2  constant −600 N m

Natural frequencies, undamped
  no.  engaged, rad/s       Hz  open, rad/s       Hz
    1           10000  1591.55            0        0
    2           40000   6366.2      42761.8  6805.75
";
        assert_eq!(text(&fixture::rocker(2), &frequencies), expected);
    }
}
