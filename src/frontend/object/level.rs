//! How much of an elastic object is modelled.

use super::spec::{BodySpec, ChainSpec, ContactSpec, LoadLawSpec, Lumping, MassChoice};
use crate::dynamics::builder::{
    BALANCED_BEHIND_AN_OPENING_PAIR, INSTEAD_OF_BALANCED, STATIC_BEHIND_A_CURVE, instead_of_static,
};
use crate::dynamics::model::Closure;
use crate::frontend::read::Fields;
use crate::frontend::read::Slot;

/// What `masses` says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Masses {
    /// So many.
    Count(usize),
    /// As the accuracy of the run needs.
    Auto,
}

/// Reads `masses`.
pub(super) fn read_masses(mut slot: Slot<'_>, most: u64) -> Option<Masses> {
    let text = slot.node().and_then(|node| node.text());
    if let Some(text) = text.filter(|text| *text != "auto" && !slot.is_formula()) {
        let message = format!("`masses` must be a whole number or \"auto\", found {text:?}");
        slot.refuse("not-whole", message).label = "expected a whole number, or \"auto\"".to_owned();
        return None;
    }
    slot.choice_or(&[("auto", Masses::Auto)], |slot| {
        slot.count(0..=most)
            .map(|count| Masses::Count(count as usize))
    })
}

/// Most modes of one object.
const MOST_MODES: u64 = 100;

/// Reads `modes` or `flexibility`, in place of `masses`: the number of modes, 0 of a static
/// flexibility; `None`: faulty.
pub(super) fn read_modes(fields: &mut Fields<'_>) -> Option<Option<usize>> {
    let doc = "Number of vibration modes that the uniform object is reduced to, in place of \
               `masses`: the lowest, of the object held at its driven end. The residual \
               flexibility of the others is kept. Needs a pair that stays closed, or a contact \
               element, behind which they are the modes of the free object.";
    let modes = fields.maybe("modes", doc, |slot| slot.count(1..=MOST_MODES));
    let doc = "`static`, in place of `masses`: the uniform object has its static deflection, \
               without vibrations, and with it a contact element in series. Its speed follows. \
               Its acceleration is that of its driven end. Needs a pair that stays closed and a \
               motion that is known beforehand.";
    let rest = fields.maybe("flexibility", doc, |slot| slot.choice(&[("static", 0)]));
    let (modes, rest) = (modes?, rest?);
    Some(modes.map(|modes| modes as usize).or(rest))
}

/// The lumping that is asked for; `None`: that of far ends, unless said otherwise.
#[derive(Clone, Copy, Debug)]
pub(super) struct LumpingChoice(Option<Lumping>);

/// Reads `lumping`; `None`: faulty.
pub(super) fn read_lumping(fields: &mut Fields<'_>) -> Option<LumpingChoice> {
    let doc = "Where the inertia of each cell of the object is put. `ends`: at the far end of the \
               cell. `balanced`: at both ends, so that the first moment of compliance is kept. It \
               needs a contact that cannot separate, or a contact element. Behind that the first \
               cell is of the former kind. Default `ends`.";
    let names = [("ends", Lumping::Ends), ("balanced", Lumping::Balanced)];
    let asked = fields.maybe("lumping", doc, |slot| slot.choice(&names));
    asked.map(LumpingChoice)
}

impl LumpingChoice {
    /// True when the scene asks for one.
    pub(super) fn is_requested(self) -> bool {
        self.0.is_some()
    }

    /// The lumping of a continuum cut into cells.
    pub(super) fn or_default(self) -> Lumping {
        self.0.unwrap_or_default()
    }

    /// The lumping where a list says what each mass or link is: there is no cell to
    /// balance. `None`: refused.
    pub(super) fn without_continuum(self, fields: &mut Fields<'_>, list: &str) -> Option<Lumping> {
        if self.or_default() == Lumping::Balanced {
            let message = format!(
                "`{list}` says of each mass or link what it is: there are no cells of a uniform \
                 object to balance"
            );
            let fault = fields.refuse("lumping", "contradiction", message);
            let hint = format!("give totals in place of `{list}`, or leave `lumping` out");
            fault.hints.push(hint);
            return None;
        }
        Some(Lumping::Ends)
    }
}

/// Refuses what does not go with the driving pair. `None`: refused.
pub(super) fn check(fields: &mut Fields<'_>, chain: &ChainSpec) -> Option<()> {
    let curved =
        |contact: ContactSpec| !contact.law.is_rigid() && !contact.law.declaration().is_linear();
    if matches!(chain.body, BodySpec::Modes { modes: 0, .. })
        && chain.pair.contact.is_some_and(curved)
    {
        let fault = fields.refuse("flexibility", "contradiction", STATIC_BEHIND_A_CURVE);
        fault.hints.push(instead_of_static());
        return None;
    }
    let rigid = chain
        .pair
        .contact
        .is_some_and(|contact| contact.law.is_rigid());
    if rigid && !matches!(chain.body, BodySpec::Rigid { .. }) {
        let message = "before an elastic object a rigid contact would set a single fragment going, \
                       the more lightly the more masses there are";
        let fault = fields.refuse("pair", "contradiction", message);
        let hint = "give `masses: 0`, or the contact a `stiffness`";
        fault.hints.push(hint.to_owned());
        return None;
    }
    if chain.has_driven_end() && chain.pair.closure != Closure::Bilateral {
        let closure = match chain.pair.closure {
            Closure::Force => "force",
            _ => "form",
        };
        let message = format!(
            "`balanced` needs a contact that cannot separate, this one is {closure}-closed: \
             {BALANCED_BEHIND_AN_OPENING_PAIR}"
        );
        let fault = fields.refuse("lumping", "contradiction", message);
        fault.hints.push(INSTEAD_OF_BALANCED.to_owned());
        return None;
    }
    let before = fields.faults();
    let property = match chain.body {
        BodySpec::Modes { modes: 0, .. } => "flexibility",
        BodySpec::Modes { .. } => "modes",
        BodySpec::Open(_) => "masses",
        _ => return Some(()),
    };
    check_held(fields, chain, property);
    for load in &chain.loads {
        let wanted = match load.law {
            LoadLawSpec::Weight { .. } => MassChoice::All,
            _ => MassChoice::Last,
        };
        if load.mass != wanted {
            let message = format!(
                "load `{}` acts on single masses, and an object without a number of masses has \
                 none: weights act on all of it, other loads on its output",
                load.name
            );
            let fault = fields.refuse("loads", "contradiction", message);
            let hint = "leave `mass` out, or give a number of `masses`";
            fault.hints.push(hint.to_owned());
        }
    }
    (fields.faults() == before).then_some(())
}

/// Refuses what is held at its driven end behind a pair that does not stay closed.
fn check_held(fields: &mut Fields<'_>, chain: &ChainSpec, property: &str) {
    let held = match chain.body {
        BodySpec::Modes { modes, .. } => modes == 0 || chain.pair.contact.is_none(),
        _ => false,
    };
    if !held || chain.pair.closure != Closure::Form {
        return;
    }
    let (message, hint) = match property {
        "modes" => (
            "modes without a contact element are those of the object held at its driven end: \
             they need a pair that stays closed",
            "give `masses`, or the pair a `contact`, or closure `bilateral` or `force`",
        ),
        _ => (
            "static flexibility needs a pair that stays closed",
            "give `modes` or `masses`, or closure `bilateral` or `force`",
        ),
    };
    let fault = fields.refuse(property, "contradiction", message);
    fault.hints.push(hint.to_owned());
}
