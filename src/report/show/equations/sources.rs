//! Equations of drives and of rigid objects.

use super::{
    Section, inertia_side, inputs, is_unconnected_output, linkage, linkage_of, loads, of_object,
    output_name, reflected,
};
use crate::dynamics::model::{Closure, Law, Model, NodeMotion, OUTPUT, ObjectPart};
use crate::kinematics::motion::DriveMotion;
use crate::report::math::{Expr, Index, Relation, Symbol, symbol};
use crate::report::show::{motion, position, units};

/// A drive whose motion is prescribed, and the moment that this takes.
pub(super) fn section_of_prescribed(model: &Model, object: usize, motion: &DriveMotion) -> Section {
    let part = &model.objects[object];
    let mut section = Section {
        object: part.id.clone(),
        heading: format!("{}, prescribed motion", part.kind),
        ..Section::default()
    };
    let phi = of_object("φ", model, object);
    section.line(phi.clone(), motion::formula(motion, part.coordinate), "");
    let reflected = reflected(model, object);
    let own = own_inertia(model, part);
    let mut terms = Vec::new();
    if own != Expr::Number(0.0) || !reflected.inertia.is_empty() {
        terms.push(inertia_side(own, &phi, &reflected));
    }
    let mut pulls = reflected.force.clone();
    pulls.extend(loads::terms(model, part, 1));
    terms.extend(pulls.into_iter().map(Expr::negative));
    section.line(
        symbol("T", Index::None),
        Expr::sum(terms),
        "the moment that keeps up this motion",
    );
    inertia_entry(model, part, &mut section);
    loads::write(model, object, &mut section);
    section
}

/// A motor's rotor.
pub(super) fn rotor(model: &Model, object: usize) -> Section {
    let part = &model.objects[object];
    let mut section = Section {
        object: part.id.clone(),
        heading: format!("{}, motor", part.kind),
        ..Section::default()
    };
    let phi = symbol("φ", Index::None);
    let reflected = reflected(model, object);
    let mut right = loads::terms(model, part, 1);
    right.extend(reflected.force.iter().cloned());
    let left = inertia_side(own_inertia(model, part), &phi, &reflected);
    section.line(left, Expr::sum(right), "");
    output_name(model, object, &mut section, phi);
    inertia_entry(model, part, &mut section);
    loads::write(model, object, &mut section);
    section
}

/// A rigid object: no equation of its own, but a motion and a force.
pub(super) fn rigid(model: &Model, object: usize, law: &Law) -> Section {
    let part = &model.objects[object];
    let phi = of_object("φ", model, object);
    let mut section = match inputs::input_formulas(model, object) {
        Some(asked) => sum_lines(part, phi.clone(), asked),
        None => law_lines(model, object, phi.clone(), law),
    };
    let own = loads::terms(model, part, 1);
    let mut pull = Vec::new();
    if !own.is_empty() {
        section.line(of_object("W", model, object), Expr::sum(own), "loads");
        pull.push(of_object("W", model, object).expr());
    }
    pull.extend(direct_pulls(model, object));
    let body = linkage_of(model, part.nodes[0]);
    if let Some(body) = body {
        pull.extend(linkage::add_force_terms(model, object, body, &mut section));
    } else if model.nodes[part.nodes[0]].inertia > 0.0 {
        let inertia = of_object("J", model, object).expr();
        pull.push(inertia.times(phi.rate().rate()).negative());
    }
    section.line(
        of_object("F", model, object),
        Expr::sum(pull),
        match part.inputs.len() {
            0 | 1 => "force of the constraint; the driver receives F·U′",
            _ => "force of the constraint; each input receives F times its ratio",
        },
    );
    lift_off(part, of_object("F", model, object).expr(), &mut section);
    match body {
        Some(body) => {
            linkage::closing(model, object, body, &mut section);
            linkage::add_linkage_data(model, object, body, &mut section);
        }
        None if part.kind == OUTPUT => {}
        None => inertia_entry_of(model, object, &mut section),
    }
    inputs::legend(model, object, &mut section);
    loads::write(model, object, &mut section);
    section
}

/// The motion of a rigid object behind one driver.
fn law_lines(model: &Model, object: usize, phi: Symbol, law: &Law) -> Section {
    let part = &model.objects[object];
    let driver = part.driver().unwrap_or(object);
    let mut section = Section {
        object: part.id.clone(),
        heading: format!(
            "{}, rigid, driven by {}",
            part.kind, model.objects[driver].id
        ),
        ..Section::default()
    };
    let function = symbol("U", Index::None);
    let input = of_object("φ", model, driver);
    let prime = function.clone().prime();
    let asked = Expr::At(function.clone(), Box::new(input.clone().expr()));
    section.line(phi.clone(), asked, "");
    let speed = prime.clone().expr().times(input.clone().rate());
    section.line(phi.clone().rate(), speed, "");
    let acceleration = Expr::sum(vec![
        prime.clone().expr().times(input.clone().rate().rate()),
        prime.prime().expr().times(input.rate().expr().squared()),
    ]);
    section.line(phi.rate().rate(), acceleration, "");
    let argument = symbol("φ", Index::None).expr();
    let left = Expr::At(function, Box::new(argument.clone()));
    section.line(left, position::formula(law, argument), "position function");
    section
}

/// The motion of a rigid object behind several drivers.
fn sum_lines(part: &ObjectPart, phi: Symbol, asked: inputs::InputFormulas) -> Section {
    let mut section = Section {
        object: part.id.clone(),
        heading: format!("{}, rigid, driven by {}", part.kind, asked.drivers),
        ..Section::default()
    };
    section.line(phi.clone(), asked.place, "");
    section.line(phi.clone().rate(), asked.rate, "");
    section.line(phi.rate().rate(), asked.acceleration, "");
    section
}

/// F·U′ of every follower, rigid ones with the force of their constraint.
fn direct_pulls(model: &Model, object: usize) -> Vec<Expr> {
    (0..model.objects.len())
        .filter(|&other| model.objects[other].is_driven_by(object))
        .filter(|&other| !is_unconnected_output(model, other))
        .flat_map(|other| match model.objects[other].inputs.len() {
            0 | 1 => {
                let prime = of_object("U", model, other).prime();
                vec![of_object("F", model, other).expr().times(prime)]
            }
            _ => inputs::pulls(model, other, object),
        })
        .collect()
}

/// The contact force of a rigid force-closed pair.
fn lift_off(part: &ObjectPart, force: Expr, section: &mut Section) {
    let Some(pair) = part
        .rigid_pair
        .filter(|pair| pair.closure == Closure::Force)
    else {
        return;
    };
    let contact = if pair.opens >= 0.0 {
        force.negative()
    } else {
        force
    };
    let letter = symbol("N", Index::None).expr();
    section.line(letter.clone(), contact, "contact force");
    let lifts = letter.compare(Relation::Less, Expr::Number(0.0));
    section.line(
        Expr::Words("would lift off".into()),
        Expr::Words(format!("where {}", lifts.unicode())),
        "",
    );
}

/// J of a drive, or 0 when it has none.
fn own_inertia(model: &Model, part: &ObjectPart) -> Expr {
    let node = &model.nodes[part.nodes[0]];
    if node.inertia > 0.0 || matches!(node.motion, NodeMotion::Rotor { .. }) {
        symbol("J", Index::None).expr()
    } else {
        Expr::Number(0.0)
    }
}

fn inertia_entry(model: &Model, part: &ObjectPart, section: &mut Section) {
    let inertia = model.nodes[part.nodes[0]].inertia;
    if inertia > 0.0 {
        let unit = units(part.coordinate).inertia;
        section.add_entry(symbol("J", Index::None), inertia, unit, "inertia");
    }
}

fn inertia_entry_of(model: &Model, object: usize, section: &mut Section) {
    let part = &model.objects[object];
    let inertia = model.nodes[part.nodes[0]].inertia;
    let unit = units(part.coordinate).inertia;
    section.add_entry(of_object("J", model, object), inertia, unit, "inertia");
}
