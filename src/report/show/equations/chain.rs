//! Equations of a chain of masses behind its driving pair.

use super::{
    LONGEST_WRITTEN_OUT, Section, contact, inertia_side, inputs, list, loads, of_mass, of_object,
    output, output_name, reflected,
};
use crate::dynamics::model::{Closure, LinkBase, Loss, Model, NodeMotion, ObjectPart, Pair};
use crate::report::math::{Expr, Index, Relation, Symbol, symbol};
use crate::report::show::{position, units};

/// Everything about one chain.
pub(super) fn section(model: &Model, object: usize) -> Section {
    let part = &model.objects[object];
    let count = part.nodes.len();
    let driver = part.driver().unwrap_or(object);
    let asked = inputs::input_formulas(model, object);
    let masses = if count == 1 {
        "1 mass".into()
    } else {
        format!("{count} masses")
    };
    let mut section = Section {
        object: part.id.clone(),
        heading: format!(
            "{}, {masses}, driven by {}",
            part.kind,
            match &asked {
                Some(asked) => &asked.drivers,
                None => &model.objects[driver].id,
            }
        ),
        ..Section::default()
    };
    match asked {
        Some(asked) => sum_lines(part, asked, &mut section),
        None => law_lines(model, part, driver, &mut section),
    }
    pair_line(model, part, &mut section);
    let mut numbers: Vec<usize> = (1..=count).collect();
    if count > LONGEST_WRITTEN_OUT {
        numbers = vec![1, count];
    }
    for mass in numbers {
        let (left, right) = equation(model, object, mass);
        section.line(left, right, "");
        if mass == 1 && count > LONGEST_WRITTEN_OUT {
            inner_mass_equation(model, object, &mut section);
        }
    }
    if !output::lines(model, object, &mut section) {
        output_name(model, object, &mut section, of_mass("φ", count));
    }
    inputs::legend(model, object, &mut section);
    legend(model, part, &mut section);
    output::legend(model, object, &mut section);
    loads::write(model, object, &mut section);
    section
}

/// x, ẋ and U.
fn law_lines(model: &Model, part: &ObjectPart, driver: usize, section: &mut Section) {
    let own = part.contact.as_ref();
    let (x, phi) = (symbol("x", Index::None), contact::far_end(own));
    let (law, input) = (symbol("U", Index::None), of_object("φ", model, driver));
    let asked = Expr::At(law.clone(), Box::new(input.clone().expr()));
    section.line(
        x.clone(),
        phi.clone().expr().minus(asked),
        contact::deformation(own),
    );
    let speed = law.clone().prime().expr().times(input.rate());
    section.line(x.rate(), phi.rate().expr().minus(speed), "");
    if let NodeMotion::Mass { law: asked } = &model.nodes[part.nodes[0]].motion {
        let argument = symbol("φ", Index::None).expr();
        let left = Expr::At(law, Box::new(argument.clone()));
        section.line(
            left,
            position::formula(asked, argument),
            "position function",
        );
    }
}

/// x and ẋ behind several inputs.
fn sum_lines(part: &ObjectPart, asked: inputs::InputFormulas, section: &mut Section) {
    let own = part.contact.as_ref();
    let (x, phi) = (symbol("x", Index::None), contact::far_end(own));
    let place = phi.clone().expr().minus(asked.place);
    section.line(x.clone(), place, contact::deformation(own));
    section.line(x.rate(), phi.rate().expr().minus(asked.rate), "");
}

/// F of link 1 by the pair's closure and law.
fn pair_line(model: &Model, part: &ObjectPart, section: &mut Section) {
    let Some(pair) = &model.elastic_pair(part) else {
        return;
    };
    let x = symbol("x", Index::None);
    let own = part
        .contact
        .map(|own| (own, contact::shape(model, &own, pair)));
    let pull = |deformation: Expr| match &own {
        Some((own, shape)) => contact::pull(own, shape, deformation, &x),
        None => contact_force(pair, deformation, &x),
    };
    let zero = || (Expr::Number(0.0), Expr::Words("else".into()));
    let pressing = |beyond: Expr, side: Relation| {
        let force = symbol("F", Index::None).expr();
        Expr::All(vec![beyond, force.compare(side, Expr::Number(0.0))])
    };
    let force = match pair.closure {
        Closure::Bilateral => pull(x.clone().expr()),
        Closure::Force => {
            let side = contact::pressing_side(pair);
            let beyond = x.clone().expr().compare(side, Expr::Number(0.0));
            Expr::Cases(vec![
                (pull(x.clone().expr()), pressing(beyond, side)),
                zero(),
            ])
        }
        Closure::Form => {
            let half = || symbol("η", Index::None).expr().over(Expr::Number(2.0));
            let flank = |side: Relation, edge: Expr| {
                let beyond = x.clone().expr().compare(side, edge.clone());
                (
                    pull(Expr::sum(vec![x.clone().expr(), edge.negative()])),
                    pressing(beyond, side),
                )
            };
            Expr::Cases(vec![
                flank(Relation::Greater, half()),
                flank(Relation::Less, half().negative()),
                zero(),
            ])
        }
    };
    if let Some((own, shape)) = &own {
        section.line(symbol("F", Index::None), force, "pull of the contact");
        contact::impact(own, section);
        if let contact::Shape::Point = shape {
            contact::balance(own, section);
        }
        return;
    }
    section.line(symbol("F", Index::None), force, "pull of link 1");
    if pair.form.loss() == Some(Loss::FactorOfDamper) {
        let static_penetration = symbol("p", Index::Word("static".into()));
        let ratio = of_mass("b", 1).expr();
        let ratio = ratio.over(of_mass("c", 1).expr().times(static_penetration));
        section.line(symbol("κ", Index::None), ratio, "by the static penetration");
    }
}

/// Contact force as a pull at the deformation: c·x + b·ẋ, or Hunt–Crossley.
fn contact_force(pair: &Pair, deformation: Expr, x: &Symbol) -> Expr {
    let stiffness = of_mass("c", 1).expr();
    let rate = x.clone().rate();
    match pair.form.factor() {
        Some(_) if pair.closure != Closure::Bilateral => {
            // On either flank the penetration grows as |x|: its rate is ẋ·sgn x.
            let kappa = symbol("κ", Index::None).expr();
            let growth = Expr::Number(1.0).plus(kappa.times(rate_of_absolute(x)));
            let factor = Expr::Greater(Box::new(Expr::Number(0.0)), Box::new(growth));
            stiffness.times(deformation).times(factor)
        }
        _ => Expr::sum(vec![
            stiffness.times(deformation),
            of_mass("b", 1).expr().times(rate),
        ]),
    }
}

/// d|x|/dt, written as a derivative.
fn rate_of_absolute(x: &Symbol) -> Expr {
    let size = Expr::Absolute(Box::new(x.clone().expr()));
    let change = symbol("d", Index::None).expr().times(size);
    change.over(symbol("dt", Index::None))
}

/// The equation of one mass, counted from 1.
fn equation(model: &Model, object: usize, mass: usize) -> (Expr, Expr) {
    let part = &model.objects[object];
    let count = part.nodes.len();
    let mut right = vec![if mass == 1 {
        symbol("F", Index::None).expr().negative()
    } else {
        opposite(link_force(|letter, back| of_mass(letter, mass - back)))
    }];
    if mass < count {
        right.push(link_force(|letter, back| of_mass(letter, mass + 1 - back)));
    }
    right.extend(loads::terms(model, part, mass));
    let (inertia, displacement) = (of_mass("J", mass).expr(), of_mass("φ", mass));
    right.extend(output::share_of_reaction(model, object, mass));
    if mass < count || output::of(model, object).is_some() {
        let left = inertia.times(displacement.rate().rate());
        return (left, Expr::sum(right));
    }
    let reflected = reflected(model, object);
    right.extend(reflected.force.iter().cloned());
    (
        inertia_side(inertia, &displacement, &reflected),
        Expr::sum(right),
    )
}

/// c(φ − φ₋) + b(φ̇ − φ̇₋) of a link; `at(letter, k)` gives the letter of the
/// k-th mass before the link's own.
fn link_force(at: impl Fn(&'static str, usize) -> Symbol) -> Expr {
    let stretch = at("φ", 0).expr().minus(at("φ", 1));
    let rate = at("φ", 0).rate().expr().minus(at("φ", 1).rate());
    Expr::Sum(vec![
        at("c", 0).expr().times(stretch),
        at("b", 0).expr().times(rate),
    ])
}

/// The opposite of a sum, term by term.
fn opposite(sum: Expr) -> Expr {
    match sum {
        Expr::Sum(terms) => Expr::Sum(terms.into_iter().map(Expr::negative).collect()),
        other => other.negative(),
    }
}

/// The equation of an inner mass m of a long chain.
fn inner_mass_equation(model: &Model, object: usize, section: &mut Section) {
    let part = &model.objects[object];
    let any = |letter: &'static str, offset: i8| symbol(letter, Index::Any(offset));
    let before = |letter, back: usize| any(letter, if back == 0 { 0 } else { -1 });
    let after = |letter, back: usize| any(letter, if back == 0 { 1 } else { 0 });
    let mut right = vec![opposite(link_force(before)), link_force(after)];
    let count = part.nodes.len();
    let loaded: Vec<usize> = (2..count)
        .filter(|&m| loads::has_load(model, part, m))
        .collect();
    if !loaded.is_empty() {
        right.push(any("W", 0).expr());
    }
    right.extend(output::share_of_mass(model, object, any("w", 0)));
    let left = any("J", 0).expr().times(any("φ", 0).rate().rate());
    section.line(left, Expr::sum(right), format!("m = 2 … {}", count - 1));
    if let Some(&first) = loaded.first() {
        let sum = Expr::sum(loads::terms(model, part, first));
        let remark = match (loaded.len(), loaded.last()) {
            (1, _) | (_, None) => "the other inner masses carry no load".to_owned(),
            (many, Some(last)) if many == count - 2 => format!("and so on to mass {last}"),
            (many, Some(last)) => format!("likewise {} more masses up to {last}", many - 1),
        };
        section.line(of_mass("W", first), sum, remark);
    }
}

/// Values of J, c, b, η, κ.
fn legend(model: &Model, part: &ObjectPart, section: &mut Section) {
    let unit = units(part.coordinate);
    let inertias = part.nodes.iter().map(|&node| model.nodes[node].inertia);
    let link = |link: &usize| &model.links[*link];
    let mut stiffnesses: Vec<f64> = part.links.iter().map(|l| link(l).stiffness).collect();
    let dampings = part.links.iter().map(|l| link(l).damping);
    list(section, "J", inertias.collect(), unit.inertia, "inertia");
    if let Some((own, pair)) = part.contact.zip(model.elastic_pair(part)) {
        match contact::shape(model, &own, &pair) {
            contact::Shape::Alone => return contact::legend(part, &pair, section),
            contact::Shape::Series(first) => stiffnesses[0] = first,
            contact::Shape::Point => {}
        }
    }
    list(section, "c", stiffnesses, unit.stiffness, "stiffness");
    list(section, "b", dampings.collect(), unit.damping, "damping");
    if let Some(pair) = model.elastic_pair(part).filter(|_| part.contact.is_some()) {
        contact::legend(part, &pair, section);
    } else if let LinkBase::Law { pair } = &link(&part.links[0]).base {
        if pair.closure == Closure::Form {
            section.add_entry(symbol("η", Index::None), pair.gap, unit.displacement, "gap");
        }
        if let Some(Loss::Factor(kappa)) = pair.form.loss() {
            let unit = unit.time_per_displacement;
            section.add_entry(symbol("κ", Index::None), kappa, unit, "contact damping");
        }
    }
}
