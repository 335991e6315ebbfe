//! The terms of a linkage, reduced to its input coordinate.

use super::closure::{Closure, ClosurePosition, Coupled, Edge, End, Rule};
use super::{Section, of_object};
use crate::dynamics::model::{LinkageBody, Model};
use crate::kinematics::linkage::spec::{Following, ForceLaw, LinkageSpec};
use crate::report::math::{Expr, Index, symbol};
use crate::report::show::units;

/// Forces that a linkage has.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Parts {
    /// Weights or springs.
    potential: bool,
    /// Forces and couples.
    applied: bool,
    /// Dampers.
    damping: bool,
    /// Friction of the pairs.
    friction: bool,
}

impl Parts {
    pub(super) fn of(body: &LinkageBody) -> Self {
        let spec = body.linkage.spec();
        let heavy = spec.links.iter().any(|link| link.mass > 0.0);
        let mut parts = Self {
            potential: heavy && spec.gravity != [0.0; 2],
            friction: body.friction.is_some(),
            ..Self::default()
        };
        for force in &spec.forces {
            match &force.law {
                ForceLaw::Strut {
                    rate,
                    damping,
                    force,
                    ..
                } => {
                    parts.potential |= *rate > 0.0 || *force != 0.0;
                    parts.damping |= *damping > 0.0;
                }
                ForceLaw::Torsion { rate, damping, .. } => {
                    parts.potential |= *rate > 0.0;
                    parts.damping |= *damping > 0.0;
                }
                ForceLaw::Force { .. }
                | ForceLaw::Couple { .. }
                | ForceLaw::CoupleTable { .. }
                | ForceLaw::Table { .. } => {
                    parts.applied = true;
                }
            }
        }
        parts
    }

    /// Whether there is any force at all.
    pub(super) fn has_force(self) -> bool {
        self.potential || self.applied || self.damping || self.friction
    }
}

/// Terms of a linkage in the force of its constraint: −J·φ̈ − ½·J′·φ̇² + W.
pub(super) fn add_force_terms(
    model: &Model,
    object: usize,
    body: &LinkageBody,
    section: &mut Section,
) -> Vec<Expr> {
    let phi = of_object("φ", model, object);
    let inertia = of_object("J", model, object);
    let rate = phi.clone().rate();
    let half_slope = Expr::Number(0.5).times(inertia.clone().prime());
    let mut terms = vec![
        inertia.expr().times(rate.clone().rate()).negative(),
        half_slope.times(rate.clone().expr().squared()).negative(),
    ];
    let parts = Parts::of(body);
    let mut reduced = Vec::new();
    if parts.applied {
        reduced.push(of_object("Q", model, object).expr());
    }
    if parts.potential {
        let slope = of_object("V", model, object).prime();
        reduced.push(slope.expr().negative());
    }
    if parts.damping {
        let damping = of_object("D", model, object).expr();
        reduced.push(damping.times(rate).negative());
    }
    if parts.friction {
        reduced.push(of_object("R", model, object).expr());
    }
    if parts.has_force() {
        let letter = of_object("W", model, object);
        let remark = match parts.friction {
            false => "forces, weights and springs, dampers, reduced to the input: functions of φ",
            true => {
                "forces, weights and springs, dampers, reduced to the input: functions of φ; \
                 R, friction of the pairs, follows from their reactions: of φ, φ̇, φ̈ and of the loads"
            }
        };
        section.line(letter.clone(), Expr::sum(reduced), remark);
        terms.push(letter.expr());
    }
    terms
}

/// The closing equations: the vector loops of the links, and what the input is.
pub(super) fn closing(model: &Model, object: usize, body: &LinkageBody, section: &mut Section) {
    let spec = body.linkage.spec();
    let input = coordinate(spec, spec.driver);
    section.line(of_object("φ", model, object), input, "the input");
    let mut workspace = body.linkage.workspace();
    let solved = body.linkage.solve(spec.start, 0, &mut workspace);
    let position = ClosurePosition {
        angle: &|link| workspace.angle(link),
        pair: &|pair| workspace.pair(pair).value,
    };
    graph(spec).write(section, solved.is_ok().then_some(&position));
}

/// What the coordinate of a pair is, by the angles of links and the displacements on them.
pub(super) fn coordinate(spec: &LinkageSpec, pair: usize) -> Expr {
    let pair = &spec.pairs[pair];
    if pair.slides() {
        return symbol("s", Index::Word(pair.name.clone())).expr();
    }
    let angle = |link: usize| symbol("θ", Index::Word(spec.links[link].name.clone())).expr();
    let mut terms: Vec<Expr> = pair.link.link.map(angle).into_iter().collect();
    terms.extend(pair.on.link.map(angle).map(Expr::negative));
    Expr::sum(terms)
}

/// Links and joints as a graph.
pub(super) fn graph(spec: &LinkageSpec) -> Closure<'_> {
    let links = spec.links.iter().map(|link| link.name.as_str());
    let edges = spec.ties().map(|tie| Edge {
        name: tie.name,
        ends: tie.ends.map(|end| End {
            link: end.link,
            at: end.at,
        }),
        slides: tie.slides,
        turned: tie.turned,
        direction: tie.direction,
    });
    let couplings = spec.couplings.iter().map(|coupling| {
        let (noun, following) = coupling.link_following();
        Coupled {
            name: &coupling.name,
            noun,
            links: coupling.wheels,
            carrier: coupling.carrier,
            rule: match following {
                Following::Turns(ratio) => Rule::Turns(ratio),
                Following::Slides(radius) => Rule::Slides(radius),
                Following::InWords(words) => Rule::InWords(words),
            },
            offset: coupling.offset,
        }
    });
    Closure::new(links.collect(), edges.collect(), couplings.collect())
}

/// J where the linkage is put together.
pub(super) fn add_linkage_data(
    model: &Model,
    object: usize,
    body: &LinkageBody,
    section: &mut Section,
) {
    let unit = units(model.objects[object].coordinate).inertia;
    let mut workspace = body.linkage.workspace();
    let start = body.linkage.spec().start;
    if body.linkage.solve(start, 2, &mut workspace).is_ok() {
        let inertia = body.linkage.reduced_linkage(&workspace).inertia[0];
        let meaning =
            "inertia reduced to the input, a function of φ; here where it is put together";
        section.add_entry(of_object("J", model, object), inertia, unit, meaning);
    }
}
