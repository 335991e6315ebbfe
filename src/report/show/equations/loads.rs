//! Loads in the equations of motion.

use super::contact_force::{Force, Letters, Motion};
use super::{Section, of_mass, of_object};
use crate::dynamics::builder::written::OVER;
use crate::dynamics::laws::{LawInstance, Measure};
use crate::dynamics::model::{
    Coordinate, DryFriction, LinearPiece, Load, LoadLaw, Model, NodeMotion, ObjectPart, Stop,
    TrackSource, WrittenLoad,
};
use crate::math::expression::Expression;
use crate::report::math::{Expr, Index, Relation, Symbol, of_program, symbol};
use crate::report::quantity::{significant, with_unit};
use crate::report::show::contact::summary_of as contact_summary;
use crate::report::show::{load_word, units};

/// Tables with more pieces than this are described instead of written out.
const MOST_PIECES: usize = 6;

/// The letters W of the loads on a mass, counted from 1.
pub(super) fn terms(model: &Model, part: &ObjectPart, mass: usize) -> Vec<Expr> {
    let node = part.nodes[mass - 1];
    let handed = model
        .loads
        .iter()
        .filter(|load| (model.rubbing_nodes(load.node)).is_some_and(|[_, other]| other == node));
    let own = on_mass(model, part, mass).map(|load| letter("W", model, part, mass, load).expr());
    // What another object rubs with acts back.
    let back = handed.map(|load| back_letter(load).expr().negative());
    own.chain(back).collect()
}

/// True when any load acts on a mass.
pub(super) fn has_load(model: &Model, part: &ObjectPart, mass: usize) -> bool {
    !terms(model, part, mass).is_empty()
}

fn on_mass<'a>(
    model: &'a Model,
    part: &'a ObjectPart,
    mass: usize,
) -> impl Iterator<Item = &'a Load> {
    let node = part.nodes[mass - 1];
    (model.loads.iter()).filter(move |load| model.owner_of_load(load) == node)
}

/// The letter of a friction on the object that another one rubs on.
fn back_letter(load: &Load) -> Symbol {
    symbol("W", Index::Word(load_word(&load.name).to_owned()))
}

/// A letter for a load: by its name, and by its mass where several carry it.
fn letter(
    letter: &'static str,
    model: &Model,
    part: &ObjectPart,
    mass: usize,
    load: &Load,
) -> Symbol {
    let same = |other: &&Load| other.name == load.name && part.nodes.contains(&other.node);
    let word = load_word(&load.name).to_owned();
    if model.loads.iter().filter(same).count() > 1 {
        symbol(letter, Index::WordMass(word, mass))
    } else {
        symbol(letter, Index::Word(word))
    }
}

/// Laws of an object's loads, with what their letters stand for. A load that
/// acts on many masses is written once.
pub(super) fn write(model: &Model, object: usize, section: &mut Section) {
    let part = &model.objects[object];
    let mut written: Vec<&str> = Vec::new();
    for mass in 1..=part.nodes.len() {
        for load in on_mass(model, part, mass) {
            let constant = load.law.as_constant().is_some();
            if written.contains(&load.name.as_str()) && !constant {
                continue;
            }
            let same = |other: &&Load| other.name == load.name;
            let remark = match model.loads.iter().filter(same).count() {
                1 => String::new(),
                many => format!("likewise on {} more", many - 1),
            };
            written.push(&load.name);
            let one = OneLoad {
                model,
                object,
                mass,
                load,
                remark,
            };
            one.write(section);
        }
    }
}

/// A load with its surroundings.
struct OneLoad<'a> {
    model: &'a Model,
    object: usize,
    mass: usize,
    load: &'a Load,
    remark: String,
}

impl OneLoad<'_> {
    fn part(&self) -> &ObjectPart {
        &self.model.objects[self.object]
    }

    fn letter(&self, name: &'static str) -> Symbol {
        letter(name, self.model, self.part(), self.mass, self.load)
    }

    /// φ of the loaded mass, as its section calls it.
    fn displacement(&self) -> Symbol {
        match self.model.nodes[self.model.owner_of_load(self.load)].motion {
            NodeMotion::Mass { .. } => of_mass("φ", self.mass),
            NodeMotion::Rotor { .. } => symbol("φ", Index::None),
            NodeMotion::Prescribed { .. }
            | NodeMotion::Rigid { .. }
            | NodeMotion::Constrained { .. } => of_object("φ", self.model, self.object),
        }
    }

    fn write(&self, section: &mut Section) {
        let unit = units(self.part().coordinate);
        let (phi, rate) = (self.displacement(), self.displacement().rate());
        if let Some(value) = self.load.law.as_constant() {
            section.add_entry(self.letter("W"), value, unit.force, "load");
            return;
        }
        let law = match &self.load.law {
            LoadLaw::Pieces { track, pieces } => self.pieces(*track, pieces),
            LoadLaw::Linear(own) => self.declared([phi, rate], section).unwrap_or_else(|| {
                let [phi, rate] = [self.displacement(), self.displacement().rate()];
                let part = |factor: f64, symbol: Symbol| Expr::Number(-factor).times(symbol);
                let parts = [part(own.rate, phi), part(own.damping, rate)];
                Expr::sum([vec![Expr::Number(own.force)], parts.to_vec()].concat())
            }),
            LoadLaw::Stop(stop) => return self.add_stop(*stop, phi, section),
            LoadLaw::Dry {
                friction,
                engagement,
            } => {
                let speed = self.sliding_speed(rate, section);
                self.engagement(engagement.as_ref(), section);
                self.dry_friction(friction, speed, section)
            }
            LoadLaw::Function { function, .. } => self
                .declared([phi, rate], section)
                .unwrap_or_else(|| Expr::Words(function.description())),
            LoadLaw::Written(written) => self.expression_of_load(written, section),
        };
        let remark = match (self.track_period(), self.other_object()) {
            (Some(period), _) => format!("repeats every {}", significant(period, 6)),
            (None, Some(other)) => format!("over_phi: displacement of {other}"),
            (None, None) => self.remark.clone(),
        };
        section.line(self.letter("W"), law, remark);
    }

    /// An expression as it was written, with what its names stand for.
    fn expression_of_load(&self, written: &WrittenLoad, section: &mut Section) -> Expr {
        let text = written.expression.text();
        if written.factor == 1.0 {
            return Expr::Words(text.to_owned());
        }
        let text = Expr::Words(format!("({text})"));
        let unit = units(self.part().coordinate);
        let factor = self.letter("f");
        section.add_entry(
            factor.clone(),
            written.factor,
            unit.force,
            "unit of the expression",
        );
        factor.expr().times(text)
    }

    /// A stop: its indentation, and what it pushes with.
    fn add_stop(&self, stop: Stop, phi: Symbol, section: &mut Section) {
        let unit = units(self.part().coordinate);
        let (p, at) = (self.letter("p"), self.letter("a"));
        section.add_entry(at.clone(), stop.at, unit.displacement, "place of the stop");
        let depth = match stop.side > 0.0 {
            true => phi.expr().minus(at),
            false => at.expr().minus(phi),
        };
        section.line(p.clone(), depth, "indentation of the stop");
        let letters = Letters {
            stiffness: self.letter("k"),
            damping: self.letter("b"),
            factor: self.letter("χ"),
            restitution: self.letter("e"),
        };
        let motion = Motion {
            depth: p.clone().expr(),
            size: p.clone().expr(),
            rate: p.clone().rate().expr(),
            growth: p.clone().rate().expr(),
        };
        let force = match letters.force(&stop.law, motion) {
            Force::Plain(force) => force,
            Force::Dissipating(force, factor) => force.times(factor),
            Force::Reaction => {
                let speed = |word: &str| symbol("p", Index::Word(word.into())).rate();
                let rebound = letters.restitution.clone().expr().times(speed("before"));
                section.line(speed("after"), rebound.negative(), "at an impact");
                Expr::Words("what holds it on the stop".into())
            }
        };
        let own = (stop.law, stop.stiffness);
        letters.entries(own, ("stop", self.part().coordinate), section);
        let pushes = Expr::Greater(Box::new(Expr::Number(0.0)), Box::new(force));
        let pushes = match stop.side > 0.0 {
            true => pushes.negative(),
            false => pushes,
        };
        let touched = p.expr().compare(Relation::Greater, Expr::Number(0.0));
        let law = Expr::Cases(vec![
            (pushes, touched),
            (Expr::Number(0.0), Expr::Words("otherwise".into())),
        ]);
        section.line(self.letter("W"), law, self.remark.clone());
    }

    /// The speed against which dry friction acts: the own one, or that relative to what it rubs on.
    fn sliding_speed(&self, own: Symbol, section: &mut Section) -> Symbol {
        let Some([_, other]) = self.model.rubbing_nodes(self.load.node) else {
            return own;
        };
        let mut parts = self.model.objects.iter();
        let object = parts.position(|part| part.nodes.contains(&other));
        let other = of_object("φ", self.model, object.unwrap_or(self.object)).rate();
        let speed = self.letter("w");
        section.line(speed.clone(), own.expr().minus(other), "sliding speed");
        speed
    }

    /// What a friction is engaged by.
    fn engagement(&self, by: Option<&WrittenLoad>, section: &mut Section) {
        if let Some(written) = by {
            let text = Expr::Words(format!("max(0, {})", written.expression.text()));
            let meaning = "engagement, a factor on R and S";
            section.line(self.letter("u"), text, meaning.to_owned());
        }
    }

    /// Dry friction: against what slides, and whatever holds what rests.
    fn dry_friction(&self, friction: &DryFriction, rate: Symbol, section: &mut Section) -> Expr {
        let unit = units(self.part().coordinate);
        let (sliding, most) = (self.letter("R"), self.letter("S"));
        let mut symbols = vec![rate.clone(), sliding.clone(), most.clone()];
        section.add_entry(sliding, friction.sliding, unit.force, "sliding friction");
        let meaning = "greatest friction at rest";
        section.add_entry(most.clone(), friction.static_limit, unit.force, meaning);
        let formulas = match friction.stribeck_speed {
            None => ["-R", "R"],
            Some(speed) => {
                let width = self.letter("v");
                section.add_entry(
                    width.clone(),
                    speed,
                    unit.of(Measure::Speed),
                    "Stribeck speed",
                );
                symbols.push(width);
                ["-(R + (S - R)*exp(-w/v))", "R + (S - R)*exp(w/v)"]
            }
        };
        let names = ["w", "R", "S", "v"];
        let law = |text: &str| {
            let formula = Expression::new(text, &names[..symbols.len()]).ok()?;
            of_program(&formula.program().value, &|index| {
                symbols[index].clone().expr()
            })
        };
        let [forwards, backwards] =
            formulas.map(|text| law(text).unwrap_or_else(|| Expr::Words(text.to_owned())));
        let zero = || Expr::Number(0.0);
        let moves = |relation| rate.clone().expr().compare(relation, zero());
        let held = format!("what holds it, at most {}", most.expr().unicode());
        Expr::Cases(vec![
            (forwards, moves(Relation::Greater)),
            (backwards, moves(Relation::Less)),
            (Expr::Words(held), Expr::Words("at rest".into())),
        ])
    }

    /// A law as it is declared: its formula, its numbers as entries.
    fn declared(&self, motion: [Symbol; 2], section: &mut Section) -> Option<Expr> {
        let (declared, factor) = self.load.law.declared()?;
        let mut symbols = motion.to_vec();
        for (parameter, value) in declared.parameters() {
            let symbol = match parameter.letter {
                (letter, "") => self.letter(letter),
                (letter, "0") => symbol(letter, Index::Mass(0)),
                (letter, index) => symbol(letter, Index::Word(index.into())),
            };
            let unit = units(self.part().coordinate).of(parameter.measure);
            section.add_entry(symbol.clone(), value, unit, parameter.meaning);
            symbols.push(symbol);
        }
        let formula = declared.formula()?;
        let expr = of_program(&formula.program().value, &|index| {
            symbols[index].clone().expr()
        })?;
        Some(match factor == 1.0 {
            true => expr,
            false => Expr::Number(factor).times(expr),
        })
    }

    /// Id of the object to whose motion an expression refers besides.
    fn other_object(&self) -> Option<&str> {
        let written = self.load.law.expression_load()?;
        let program = written.expression.program();
        if !OVER.iter().any(|(_, index)| program.reads(*index)) {
            return None;
        }
        let node = written.node_of(OVER[0].1)?;
        let mut parts = self.model.objects.iter();
        let owner = parts.find(|part| part.nodes.contains(&node))?;
        Some(&owner.id)
    }

    /// Period of the axis that the load's pieces lie on.
    fn track_period(&self) -> Option<f64> {
        match self.load.law {
            LoadLaw::Pieces { track, .. } => self.model.tracks.get(track)?.breaks.period,
            _ => None,
        }
    }

    /// A piecewise linear load over time or over a displacement.
    fn pieces(&self, track: usize, pieces: &[LinearPiece]) -> Expr {
        let Some(track) = self.model.tracks.get(track) else {
            return Expr::Words("piecewise linear".into());
        };
        let axis = match track.source {
            TrackSource::Time => symbol("t", Index::None),
            TrackSource::Node(node) => {
                let owner = self
                    .model
                    .objects
                    .iter()
                    .position(|o| o.nodes.contains(&node));
                of_object("φ", self.model, owner.unwrap_or(self.object))
            }
        };
        if pieces.len() > MOST_PIECES {
            let count = pieces.len();
            return Expr::Words(format!(
                "piecewise linear over {}, {count} pieces",
                axis.expr().unicode()
            ));
        }
        let cases = pieces.iter().enumerate().map(|(index, piece)| {
            let (from, to) = track.breaks.edges(index as i64);
            (line(piece, &axis), range_condition(from, &axis, to))
        });
        Expr::Cases(cases.collect())
    }
}

/// value + slope·(z − start).
fn line(piece: &LinearPiece, axis: &Symbol) -> Expr {
    let value = Expr::Number(piece.value);
    if piece.slope == 0.0 {
        return value;
    }
    let distance = match piece.start {
        0.0 => axis.clone().expr(),
        start => axis.clone().expr().minus(Expr::Number(start)),
    };
    Expr::sum(vec![value, Expr::Number(piece.slope).times(distance)])
}

/// from ≤ z < to, open ends left out.
fn range_condition(from: f64, axis: &Symbol, to: f64) -> Expr {
    let mut conditions = Vec::new();
    if from.is_finite() {
        conditions.push(Expr::Number(from).compare(Relation::AtMost, axis.clone()));
    }
    if to.is_finite() {
        conditions.push(
            axis.clone()
                .expr()
                .compare(Relation::Less, Expr::Number(to)),
        );
    }
    if conditions.is_empty() {
        Expr::Words("always".into())
    } else {
        Expr::All(conditions)
    }
}

/// A load's law in a few words, for tables.
pub fn summary(law: &LoadLaw, coordinate: Coordinate) -> String {
    let unit = units(coordinate);
    let show = |value: f64, unit: &str| with_unit(value, unit, 6);
    if let Some(value) = law.as_constant() {
        return format!("constant {}", show(value, unit.force));
    }
    if let Some((declared, _)) = law.declared() {
        return describe_law(&declared, coordinate);
    }
    match law {
        LoadLaw::Pieces { pieces, .. } => format!("piecewise linear, {} pieces", pieces.len()),
        LoadLaw::Linear(own) => format!(
            "{} − {}·φ − {}·φ̇",
            show(own.force, unit.force),
            show(own.rate, unit.stiffness),
            show(own.damping, unit.damping)
        ),
        LoadLaw::Stop(stop) => format!(
            "stop, {}; {}",
            stop_words(stop, coordinate),
            contact_summary(stop.law, stop.stiffness, coordinate)
        ),
        LoadLaw::Dry {
            friction,
            engagement,
        } => {
            let mut words = dry_words(friction, coordinate);
            if let Some(written) = engagement {
                words += &format!(", engaged by {}", written.expression.text());
            }
            words
        }
        LoadLaw::Function { function, .. } => function.description(),
        LoadLaw::Written(written) => format!("expression: {}", written.expression.text()),
    }
}

/// Dry friction in a few words.
fn dry_words(friction: &DryFriction, coordinate: Coordinate) -> String {
    let unit = units(coordinate);
    let force = |value: f64| with_unit(value, unit.force, 6);
    let mut words = format!("dry friction, sliding {}", force(friction.sliding));
    if friction.static_limit != friction.sliding {
        words += &format!(", at rest up to {}", force(friction.static_limit));
    }
    if let Some(speed) = friction.stribeck_speed {
        let speed = with_unit(speed, unit.of(Measure::Speed), 6);
        words += &format!(", falling over {speed}");
    }
    words
}

/// The words of a declared law, with its numbers.
fn describe_law(declared: &LawInstance, coordinate: Coordinate) -> String {
    let mut words = declared.law.words.to_owned();
    for (parameter, value) in declared.parameters() {
        let key = declared.law.name_of(parameter);
        let shown = match parameter.measure {
            Measure::Number => significant(value, 4),
            measure => with_unit(value, units(coordinate).of(measure), 6),
        };
        words = words.replace(&format!("{{{key}}}"), &shown);
    }
    words
}

/// What a stop holds: `φ ≥ 0 m`.
pub fn stop_words(stop: &Stop, coordinate: Coordinate) -> String {
    let relation = if stop.side > 0.0 { "≤" } else { "≥" };
    let place = with_unit(stop.at, units(coordinate).displacement, 6);
    format!("φ {relation} {place}")
}
