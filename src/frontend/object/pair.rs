//! The driving pair.

use super::contact;
use super::measures::Measures;
use super::spec::{ContactSpec, PairSpec};
use crate::dynamics::laws::contact::{CONTACT_LAWS, ContactForceLaw, keys, law_of_link};
use crate::dynamics::model::{Closure, ContactForm, Loss};
use crate::frontend::read::{Bounds, Fields, Slot};
use serde_json::json;

/// Names of the closures.
pub(super) const CLOSURES: [(&str, Closure); 3] = [
    ("bilateral", Closure::Bilateral),
    ("force", Closure::Force),
    ("form", Closure::Form),
];

pub(super) fn closure_name(closure: Closure) -> &'static str {
    match closure {
        Closure::Bilateral => "bilateral",
        Closure::Force => "force",
        Closure::Form => "form",
    }
}

/// Reads `pair`.
pub(super) fn read(slot: Slot<'_>, own: Measures, default: Closure) -> Option<PairSpec> {
    slot.record(|fields| {
        let closure = fields.or(
            "closure",
            "How the pair is kept together: always (`bilateral`), by a closing `force`, or by `form` with a gap.",
            json!(closure_name(default)),
            |slot| slot.choice(&CLOSURES),
        );
        let gap = fields.or("gap", "Gap η of a form-closed pair", json!(0.0), |slot| {
            slot.quantity(own.displacement(), Bounds::NOT_NEGATIVE)
        });
        let opens = fields.or(
            "opens",
            "Side to which a force-closed pair lifts off.",
            json!("+"),
            |slot| slot.choice(&[("+", 1.0), ("-", -1.0)]),
        );
        let law = fields.or("law", "Law of the contact force: `kelvin_voigt` c·p + b·ṗ, `hunt_crossley` c·p·(1 + κ·ṗ); c and b of link 1.", json!(law_of_link(Loss::Damper).key), |slot| {
            read_law(slot, own)
        });
        let contact = fields.maybe(
            "contact",
            "Contact between driver and object: an element of its own, in front of link 1.",
            |slot| contact::read(slot, own),
        );
        let clash = fields.clash("law", "contact", "a contact element has a law of its own");
        let (closure, law, contact) = (closure?, law?, contact?);
        if clash {
            return None;
        }
        let pair = PairSpec {
            closure,
            gap: gap?,
            opens: opens?,
            form: ContactForm::Proportional(law),
            contact,
        };
        check(fields, &pair)
    })
}

fn read_law(slot: Slot<'_>, own: Measures) -> Option<Loss> {
    let of_link = |law: &&ContactForceLaw| Some((law.key, law.pair_loss?));
    let names: Vec<_> = CONTACT_LAWS.iter().filter_map(of_link).collect();
    let with_factor = law_of_link(Loss::FactorOfDamper).key;
    slot.object_or(
        |slot| {
            slot.record(|fields| {
                fields.need(with_factor, "N = c·p·max(0, 1 + κ·ṗ)", |slot| {
                    slot.record(|fields| {
                        let kappa =
                            fields.need("kappa", "κ, seconds per unit of penetration", |slot| {
                                slot.quantity(own.time_per_displacement(), Bounds::NOT_NEGATIVE)
                            });
                        Some(Loss::Factor(kappa?))
                    })
                })
            })
        },
        |slot| slot.choice(&names),
    )
}

/// Each closure has only some of the properties.
fn check(fields: &mut Fields<'_>, pair: &PairSpec) -> Option<PairSpec> {
    let closure = closure_name(pair.closure);
    let mut sound = true;
    let mut refuse = |name: &str, needed: &str| {
        sound = false;
        let message = format!("`{name}` has no meaning for a pair with closure `{closure}`");
        let fault = fields.refuse(name, "contradiction", message);
        fault
            .hints
            .push(format!("set `closure` to {needed}, or remove `{name}`"));
    };
    if pair.gap > 0.0 && pair.closure != Closure::Form {
        refuse("gap", "\"form\"");
    }
    if pair.opens < 0.0 && pair.closure != Closure::Force {
        refuse("opens", "\"force\"");
    }
    if !pair.form.is_linear() && pair.closure == Closure::Bilateral {
        refuse("law", "\"force\" or \"form\"");
    }
    let nonlinear = |contact: &ContactSpec| !contact.law.declaration().is_linear();
    if pair.contact.as_ref().is_some_and(nonlinear) && pair.closure == Closure::Bilateral {
        sound = false;
        let laws = keys(|law| law.is_linear(), "`", "and");
        let message = format!("a bilateral pair takes the contact laws {laws} alone");
        let fault = fields.refuse("contact", "contradiction", message);
        let hint = "set `closure` to \"force\" or \"form\", or give another law";
        fault.hints.push(hint.to_owned());
    }
    let rigid = pair.contact.is_some_and(|contact| contact.law.is_rigid());
    if rigid && pair.closure == Closure::Form && pair.gap == 0.0 {
        sound = false;
        let message = "without a gap a rigid contact never separates, and there are no impacts";
        let fault = fields.refuse("contact", "contradiction", message);
        let hint = "give a `gap`, or the closure \"bilateral\" without a contact";
        fault.hints.push(hint.to_owned());
    }
    sound.then(|| pair.clone())
}
