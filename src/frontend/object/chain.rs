//! What most driven objects are underneath: a chain of masses behind a pair.
//!
//! ```text
//! driver ──U(φ), pair──○─/\/\─○─/\/\─○ ◄── loads
//! ```
//!
//! A kind states what differs in its [`Rules`]; [`object`] reads the rest.

use super::body;
use super::cam_geometry;
use super::geometry::Beam;
use super::level;
use super::load::{self, On};
use super::measures::Measures;
use super::measures::PositionMeasures;
use super::pair;
use super::position;
use super::spec::{BodySpec, ChainSpec, InertiaSplit, LoadLawSpec, LoadSpec, PairSpec};
use super::{Context, INPUT, Inputs, Kind, ModelBuilder, Object, Place, Ports};
use super::{cam_contact, stop};
use crate::dynamics::model::{Closure, ContactForm, Coordinate};
use crate::frontend::read::{Bounds, Fields};
use crate::kinematics::cam::CamGeometry;
use crate::kinematics::position::PositionSpec;
use crate::units::quantities as q;
use serde_json::json;

/// An object behind one driver that is a chain of masses, or rigid.
#[derive(Debug)]
pub struct ChainObject {
    kind: &'static str,
    chain: ChainSpec,
    cam: Option<CamGeometry>,
}

impl ChainObject {
    /// An object of a kind, from plain numbers.
    pub fn new(kind: &'static str, chain: ChainSpec) -> Self {
        Self {
            kind,
            chain,
            cam: None,
        }
    }
}

impl Object for ChainObject {
    fn kind(&self) -> &'static str {
        self.kind
    }

    fn ports(&self) -> Ports {
        Ports::with_one_driver(self.chain.coordinate)
    }

    fn lower(&self, at: &Place, into: &mut ModelBuilder) {
        into.chain(at, at.input(INPUT), &self.chain);
        if let Some(cam) = self.cam.as_ref().filter(|cam| cam.material.is_some()) {
            into.pressing(at, &self.chain, cam);
        }
    }

    fn chain(&self) -> Option<&ChainSpec> {
        Some(&self.chain)
    }

    fn chain_mut(&mut self) -> Option<&mut ChainSpec> {
        Some(&mut self.chain)
    }

    fn cam(&self) -> Option<&CamGeometry> {
        self.cam.as_ref()
    }
}

/// Rules of a kind of chain: defaults, and what its text may say.
#[derive(Clone, Debug)]
pub struct Rules {
    /// Turning or sliding; `None`: the text says so.
    pub coordinate: Option<Coordinate>,
    /// Split of the inertia unless said otherwise.
    pub split: InertiaSplit,
    /// The pair's closure unless said otherwise.
    pub closure: Closure,
    /// Shape of the body that `geometry` describes.
    pub beam: Beam,
    /// Position functions that the property `position` may have.
    pub positions: &'static [&'static str],
    /// Whether the position defaults to the ratio 1, and `backlash` is taken.
    pub geared: bool,
    /// Whether the property `cam` describes a disc cam that moves it.
    pub cam: bool,
}

impl Rules {
    /// Rules of an object that turns or slides: inertia split evenly over a rod, a
    /// bilateral pair, any position function.
    pub const fn of(coordinate: Coordinate) -> Self {
        Self {
            coordinate: Some(coordinate),
            split: InertiaSplit::Equal,
            closure: Closure::Bilateral,
            beam: Beam::Rod,
            positions: position::ALL,
            geared: false,
            cam: false,
        }
    }
}

/// A kind of turning chains; it cannot be read yet.
pub(super) const fn turning(name: &'static str, doc: &'static str) -> Kind {
    Kind {
        name,
        doc,
        inputs: Inputs::One,
        outputs: Kind::no_outputs,
        coordinate: |_| Some(Coordinate::Turning),
        read: |_, _| None,
    }
}

/// Reads an object of a kind that is a chain behind one driver.
pub fn object(
    kind: &'static str,
    fields: &mut Fields<'_>,
    context: &Context<'_>,
    rules: &Rules,
) -> Option<Box<dyn Object>> {
    let chain = read(fields, context, rules);
    let cam = match rules.cam {
        true => cam_geometry::read(fields, rules.coordinate, context),
        false => Some(None),
    };
    let (mut chain, cam) = (chain?, cam?);
    cam_contact::find_contact_stiffness(fields, &mut chain, cam.as_ref())?;
    Some(Box::new(ChainObject { kind, chain, cam }))
}

/// Reads a chain with the property `position`.
pub fn read(fields: &mut Fields<'_>, context: &Context<'_>, rules: &Rules) -> Option<ChainSpec> {
    let own = Measures(rules.coordinate);
    let driver = Measures(context.driver);
    let lever = read_lever(fields, own);
    let position = read_position(fields, own, driver, rules);
    let chain = read_behind(fields, context, context.driver, rules, position);
    Some(ChainSpec {
        lever: lever?,
        ..chain?
    })
}

/// Reads a chain behind a position function that the kind itself has read (`None`: it
/// is faulty): inertia, stiffness, damping and number of masses, pair, loads.
/// `driver`: whether that turns or slides over whose displacement loads may run.
pub fn read_behind(
    fields: &mut Fields<'_>,
    context: &Context<'_>,
    driver: Option<Coordinate>,
    rules: &Rules,
    position: Option<PositionSpec>,
) -> Option<ChainSpec> {
    let own = Measures(rules.coordinate);
    let driver = Measures(driver);
    let body = body::read(fields, own, rules.beam, rules.split.clone());
    let masses = body.as_ref().map(BodySpec::masses);
    let pair = read_pair(fields, own, rules, body.as_ref());
    let loads = load::read_all(
        fields,
        On::Chain {
            own,
            driver,
            masses,
        },
        context,
    );
    let stops = stop::read_all(fields, own);
    let chain = ChainSpec {
        coordinate: rules.coordinate?,
        position: position?,
        lever: 1.0,
        body: body?,
        pair: pair?,
        loads: loads?,
        stops: stops?,
    };
    warn_never_closed(fields, &chain);
    stop::check(fields, &chain)?;
    level::check(fields, &chain)?;
    Some(chain)
}

/// `lever_ratio`, or `lever_arm` where turning becomes sliding.
fn read_lever(fields: &mut Fields<'_>, own: Measures) -> Option<f64> {
    let ratio = fields.maybe("lever_ratio", "Factor on the position function.", |slot| {
        slot.number(Bounds::NOT_ZERO)
    });
    if own.0 == Some(Coordinate::Turning) {
        return Some(ratio?.unwrap_or(1.0));
    }
    let arm = fields.maybe(
        "lever_arm",
        "Arm on which an angle given by the position function becomes a length",
        |slot| slot.quantity(q::LENGTH, Bounds::NOT_ZERO),
    );
    let clash = fields.clash("lever_ratio", "lever_arm", "an object has one lever");
    let (ratio, arm) = (ratio?, arm?);
    (!clash).then(|| ratio.or(arm).unwrap_or(1.0))
}

fn read_position(
    fields: &mut Fields<'_>,
    own: Measures,
    driver: Measures,
    rules: &Rules,
) -> Option<PositionSpec> {
    let arm = own.0 != Some(Coordinate::Turning) && fields.has("lever_arm");
    let output = match arm {
        true => Measures(Some(Coordinate::Turning)),
        // The schema of a sliding object does not know of its arm.
        false if fields.describing() && own.0 == Some(Coordinate::Sliding) => Measures(None),
        false => own,
    };
    let definition = match (rules.geared, output.0) {
        (true, _) => "geared_position",
        (false, Some(Coordinate::Turning)) => "turning_position",
        (false, _) => "position",
    };
    let ends = PositionMeasures { output, driver };
    let doc = "Position function U(φ): the prescribed position of this object.";
    let read = |slot: crate::frontend::read::Slot<'_>| {
        slot.defined(definition, |slot| {
            position::read(slot, ends, rules.positions)
        })
    };
    match rules.geared {
        true => fields.or("position", doc, json!({ "ratio": 1.0 }), read),
        false => fields.need("position", doc, read),
    }
}

/// `pair`, or `backlash` for a form-closed pair with that gap.
fn read_pair(
    fields: &mut Fields<'_>,
    own: Measures,
    rules: &Rules,
    body: Option<&BodySpec>,
) -> Option<PairSpec> {
    let backlash = match rules.geared {
        true => fields.maybe("backlash", "Backlash: gap of a form-closed pair", |slot| {
            slot.quantity(own.displacement(), Bounds::NOT_NEGATIVE)
        }),
        false => Some(None),
    };
    let clash = fields.clash(
        "backlash",
        "pair",
        "backlash is the gap of a form-closed pair",
    );
    let pair = fields.or("pair", "The driving pair.", json!({}), |slot| {
        pair::read(slot, own, rules.closure)
    });
    let (backlash, mut pair) = (backlash?, pair?);
    let mut gap_name = "pair";
    if let Some(gap) = backlash {
        gap_name = "backlash";
        pair = PairSpec {
            closure: Closure::Form,
            gap,
            opens: 1.0,
            form: ContactForm::default(),
            contact: None,
        };
    }
    let massless = body.filter(|body| body.masses() == 0);
    if let Some(body) = massless
        && pair.closure == Closure::Form
        && pair.contact.is_none()
    {
        let message = match body {
            BodySpec::Modes { .. } => {
                "an object without vibrations needs a pair that stays closed, this one has a gap"
            }
            _ => "a rigid object cannot have a pair with a gap",
        };
        let fault = fields.refuse(gap_name, "contradiction", message);
        fault.hints.push(
            "give the object at least one mass, or its pair a `contact`, or closure `bilateral` or `force`".to_owned(),
        );
        return None;
    }
    (!clash).then_some(pair)
}

/// A force closure whose only loads are constant and pull it open.
fn warn_never_closed(fields: &mut Fields<'_>, chain: &ChainSpec) {
    let constant = |load: &LoadSpec| match load.law {
        LoadLawSpec::Constant(force) => Some(force),
        _ => None,
    };
    let forces: Option<Vec<f64>> = chain.loads.iter().map(constant).collect();
    let Some(forces) = forces.filter(|forces| !forces.is_empty()) else {
        return;
    };
    let opening = forces.iter().sum::<f64>() * chain.pair.opens;
    if chain.pair.closure == Closure::Force && opening > 0.0 {
        let message = "these loads separate the force-closed contact and can never close it";
        let towards = if chain.pair.opens > 0.0 {
            "negative"
        } else {
            "positive"
        };
        let warning = fields.warn("loads", "never-closes", message);
        warning.hints.push(format!(
            "a closing load is {towards} here; or turn the pair round with `opens`"
        ));
    }
}
