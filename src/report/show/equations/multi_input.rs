//! The equations of a linkage of several inputs: one line an input.

use super::closure::ClosurePosition;
use super::linkage::{coordinate as coordinate_of, graph};
use super::{LONGEST_WRITTEN_OUT, Section};
use crate::dynamics::model::{Coordinate, Model, MultiLinkageBody};
use crate::kinematics::linkage::multi::MultiMotion;
use crate::kinematics::linkage::multi::spec::InputCoordinate;
use crate::math::jet::Jet;
use crate::report::math::{Expr, Index, Symbol, symbol};
use crate::report::show::units;

/// The linkage of several inputs that an object is.
pub(super) fn of(model: &Model, object: usize) -> Option<&MultiLinkageBody> {
    let mut bodies = model.multi_linkages.iter();
    bodies.find(|body| body.object == object)
}

/// True of an input or output of such a linkage.
pub(super) fn is_part(model: &Model, object: usize) -> bool {
    let part = &model.objects[object];
    let own = |node| part.nodes.contains(node);
    let mut bodies = model.multi_linkages.iter();
    bodies.any(|body| body.object != object && body.inputs.iter().chain(&body.outputs).any(own))
}

/// What drives each input: Σ M·q̈ − Q.
pub(super) fn section(model: &Model, object: usize, body: &MultiLinkageBody) -> Section {
    let part = &model.objects[object];
    let inputs = body.linkage.inputs();
    let mut section = Section {
        object: part.id.clone(),
        heading: format!("{} of {} inputs, rigid", part.kind, inputs.len()),
        ..Section::default()
    };
    let word = |letter, word: String| symbol(letter, Index::Word(word));
    let coordinate = |k: usize| word("q", inputs[k].name.clone());
    let mass = |k: usize, j: usize| word("M", format!("{},{}", inputs[k].name, inputs[j].name));
    let many = inputs.len() > LONGEST_WRITTEN_OUT;
    for k in 0..inputs.len() {
        let term = |j: usize| mass(k, j).expr().times(coordinate(j).rate().rate());
        let mut terms: Vec<Expr> = match many {
            false => (0..inputs.len()).map(term).collect(),
            true => vec![term(0), Expr::Words("…".to_owned()), term(inputs.len() - 1)],
        };
        terms.push(word("Q", inputs[k].name.clone()).expr().negative());
        let remark = match k {
            0 => {
                "what drives the input, with the loads on it; Q, all other forces and what the speeds make"
            }
            _ => "",
        };
        section.line(word("T", inputs[k].name.clone()), Expr::sum(terms), remark);
    }
    closing(body, &coordinate, &mut section);
    entries(body, &mass, &mut section);
    section
}

/// The closing equations: what each input is, and the vector loops of the links.
fn closing(body: &MultiLinkageBody, coordinate: &dyn Fn(usize) -> Symbol, section: &mut Section) {
    let linkage = &body.linkage;
    let spec = &linkage.spec().linkage;
    for (k, input) in linkage.inputs().iter().enumerate() {
        let of_link =
            |letter, link: usize| symbol(letter, Index::Word(spec.links[link].name.clone())).expr();
        let what = match input.coordinate {
            InputCoordinate::Pair(pair) => coordinate_of(spec, pair),
            InputCoordinate::X(link) => of_link("x", link),
            InputCoordinate::Y(link) => of_link("y", link),
            InputCoordinate::Angle(link) => of_link("θ", link),
        };
        section.line(coordinate(k), what, format!("the input {}", input.name));
    }
    let starts: Vec<Jet> = (linkage.inputs().iter())
        .map(|input| Jet {
            value: input.start,
            ..Jet::default()
        })
        .collect();
    let mut motion = MultiMotion::new(linkage);
    let solved = motion.set_inputs(&starts);
    let position = ClosurePosition {
        angle: &|link| motion.angle(link).value,
        pair: &|pair| motion.pair(pair).value,
    };
    graph(spec).write(section, solved.is_ok().then_some(&position));
}

/// M on its diagonal where the linkage is put together.
fn entries(body: &MultiLinkageBody, mass: &dyn Fn(usize, usize) -> Symbol, section: &mut Section) {
    let linkage = &body.linkage;
    let inputs = linkage.inputs();
    let starts: Vec<f64> = inputs.iter().map(|input| input.start).collect();
    let mut space = linkage.workspace::<f64>();
    if space.solve(&starts, &vec![0.0; starts.len()]).is_err() {
        return;
    }
    space.reduce(true);
    for (k, input) in inputs.iter().enumerate() {
        let slides = input.coordinate.slides(&linkage.spec().linkage);
        let coordinate = Coordinate::sliding(slides);
        let value = space.reduced.mass[k * inputs.len() + k];
        let meaning = "mass matrix, a function of all inputs; here where it is put together";
        section.add_entry(mass(k, k), value, units(coordinate).inertia, meaning);
    }
}
