//! Loads.

mod friction;
mod written_laws;

use super::Context;
use super::measures::Measures;
use super::spec::{LoadLawSpec, LoadSpec, MassChoice};
use super::{table_period, written};
use crate::dynamics::builder::written as builder;
use crate::dynamics::laws::{self, Domain, ForceLaw, LawInstance, Measure, Parameter};
use crate::dynamics::model::Coordinate;
use crate::frontend::read::{Bounds, Fields, QuantityChoice, Slot, read_points};
use crate::units::quantities as q;
use serde_json::json;
use std::f64::consts::TAU;

/// Owner of loads: where they act.
#[derive(Clone, Copy, Debug)]
pub(super) enum On {
    /// The masses of a chain, driven by something that turns or slides.
    Chain {
        own: Measures,
        driver: Measures,
        /// Number of masses; `None`: not known.
        masses: Option<usize>,
    },
    /// The rotor of a motor, or the slide of a linear one.
    Rotor(Measures),
    /// An output of a linkage, driven by its input coordinate.
    Output { own: Measures, driver: Measures },
}

impl On {
    fn own_measures(self) -> Measures {
        match self {
            Self::Chain { own, .. } => own,
            Self::Rotor(own) | Self::Output { own, .. } => own,
        }
    }
}

/// Reads `loads`, in the order of their names.
pub(super) fn read_all(
    fields: &mut Fields<'_>,
    on: On,
    context: &Context<'_>,
) -> Option<Vec<LoadSpec>> {
    let doc = "Loads by name. Positive forces act in the direction of positive displacement.";
    fields.or("loads", doc, json!({}), |slot| {
        slot.names(|name, slot| match on {
            On::Rotor(_) => slot.defined("rotor_load", |slot| read(slot, name, on, context)),
            On::Output { .. } => slot.defined("output_load", |slot| read(slot, name, on, context)),
            On::Chain { own, .. } => {
                let definition = match own.0 {
                    Some(Coordinate::Turning) => "turning_load",
                    Some(Coordinate::Sliding) => "sliding_load",
                    None => "load",
                };
                slot.defined(definition, |slot| read(slot, name, on, context))
            }
        })
    })
}

fn read(slot: Slot<'_>, name: &str, on: On, context: &Context<'_>) -> Option<LoadSpec> {
    slot.record(|fields| {
        let mass = match on {
            On::Rotor(_) | On::Output { .. } => Some(MassChoice::Last),
            On::Chain { masses, .. } => read_chosen_mass(fields, masses),
        };
        let law = read_law(fields, on, context);
        Some(LoadSpec {
            name: name.to_owned(),
            mass: mass?,
            law: law?,
        })
    })
}

/// `mass`: a weight acts on every mass unless said otherwise, all other loads
/// on the last.
fn read_chosen_mass(fields: &mut Fields<'_>, masses: Option<usize>) -> Option<MassChoice> {
    let doc = "Mass it acts on: `last`, `first`, `all`, or its number from 1; \
               default `all` for a weight, `last` for everything else.";
    let given = fields.maybe("mass", doc, |slot| read_mass(slot, masses))?;
    let (name, usual) = match fields.has("weight") {
        true => ("all", MassChoice::All),
        false => ("last", MassChoice::Last),
    };
    if given.is_none() {
        fields.fill_in("mass", json!(name));
    }
    Some(given.unwrap_or(usual))
}

fn read_mass(slot: Slot<'_>, masses: Option<usize>) -> Option<MassChoice> {
    let names = [
        ("last", MassChoice::Last),
        ("first", MassChoice::First),
        ("all", MassChoice::All),
    ];
    slot.choice_or(&names, |slot| {
        let most = masses.map_or(super::body::MOST_MASSES, |count| count as u64);
        if most == 0 {
            let mut slot = slot;
            slot.refuse("out-of-range", "a rigid object has no numbered masses")
                .hints
                .push("leave out `mass`".to_owned());
            return None;
        }
        Some(MassChoice::Number(slot.count(1..=most)? as usize))
    })
}

fn read_law(fields: &mut Fields<'_>, on: On, context: &Context<'_>) -> Option<LoadLawSpec> {
    if let Some(load) = fields.own("A load given in code.") {
        return Some(LoadLawSpec::Custom(load));
    }
    let own = on.own_measures();
    let force = own.force();
    let axis = axis(fields, on, context);
    let any = |wanted: QuantityChoice| move |slot: Slot<'_>| slot.quantity(wanted, Bounds::ANY);
    let names = written_laws::names(on, axis);
    let mut law = fields.one_of("its law");
    law.case("constant", "Constant force W", |slot| {
        any(force)(slot).map(LoadLawSpec::Constant)
    });
    law.case(
        "time_table",
        "List of [time, force]: linear between the points, constant outside.",
        |slot| read_points(slot, q::TIME, force, 1).map(LoadLawSpec::TimeTable),
    );
    law.case(
        "position_table",
        "Force over the driver's displacement, or that of the object `over`.",
        |slot| read_position_table(slot, axis.measures, force),
    );
    law.case(
        "window",
        "Constant force while the driver, or the object `over`, is between two positions.",
        |slot| read_window(slot, axis.measures, force),
    );
    for own_law in laws::OF_LOADS {
        law.case(own_law.key, own_law.doc, |slot| {
            match own_law.key == laws::FRICTION.key {
                true => friction::read(slot, own, &names),
                false => declared(slot, own_law, own).map(LoadLawSpec::Declared),
            }
        });
    }
    // An output has no mass of its own.
    if own.0 != Some(Coordinate::Turning) && !matches!(on, On::Output { .. }) {
        law.case("weight", "Weight: W = −m·g·sin(inclination).", read_weight);
    }
    written_laws::add(&mut law, on, axis);
    let is_given = law.is_given();
    let law = law.finish();
    let factor = written::read_unit(fields, force);
    let doc = "Another object or output: `press`, `press.ram`; the name of the drive for the \
               machine angle. `window`, `position_table`, `harmonic` and `indicator` refer to its \
               displacement in place of the driver's. `expression` knows its motion as over_phi \
               and over_phi_dot. `friction` that sticks acts between both: a clutch, a belt.";
    let over = context.mention(fields, "over", doc);
    // (Beside a law that is missing or misspelt nothing is known to be out of place.)
    let judged = is_given && !fields.describing();
    if judged && (misplaced_unit(fields) | misplaced_over(fields)) {
        return None;
    }
    Some(written::in_unit(law?, factor?).over_another(over?))
}

/// The displacement to which tables and windows of a load refer.
#[derive(Clone, Copy, Debug)]
struct Axis {
    measures: Measures,
    /// False of the driver, true of the object that `over` names.
    of_another: bool,
}

/// The driver's displacement, the rotor's own where there is no driver, or that of the object
/// `over`.
fn axis(fields: &Fields<'_>, on: On, context: &Context<'_>) -> Axis {
    let over = fields.member("over");
    let measures = match (over, on) {
        (Some(over), _) => {
            let output = over.value.text().unwrap_or_default();
            Measures(context.coordinate_of(output))
        }
        (None, On::Chain { driver, .. } | On::Output { driver, .. }) => driver,
        (None, On::Rotor(own)) => own,
    };
    Axis {
        measures,
        of_another: over.is_some(),
    }
}

fn misplaced_unit(fields: &mut Fields<'_>) -> bool {
    !fields.has("expression") && written::forbid_unit(fields)
}

/// Notes that `over` stands beside a law that depends on no displacement but that of its mass.
fn misplaced_over(fields: &mut Fields<'_>) -> bool {
    const OVER: [&str; 4] = ["window", "position_table", "harmonic", "indicator"];
    let harmonic = fields.member("harmonic");
    let over_time = harmonic.is_some_and(|one| one.value.get("frequency").is_some());
    let rubs = fields.member("friction");
    let sticks = rubs.is_some_and(|one| one.value.get("sliding").is_some());
    let follows = !over_time && OVER.iter().any(|name| fields.has(name));
    if !fields.has("over") || follows || sticks {
        return false;
    }
    let message = "this load does not depend on the displacement of the object `over`";
    if let Some(expression) = fields.member("expression") {
        let uses = |text: &str| text.contains(builder::OVER[0].0);
        if !expression.value.text().is_none_or(uses) {
            let hint = "use over_phi or over_phi_dot in the expression, or remove `over`";
            let warning = fields.warn("over", "no-effect", message.to_owned());
            warning.hints.push(hint.to_owned());
        }
        return false;
    }
    let hint = match over_time {
        true => "give `harmonic` an `order` in place of its `frequency`, or remove `over`",
        false => {
            "`over` goes with `expression`, `window`, `position_table`, `harmonic`, `indicator` and \
             `friction` that has `sliding`: remove it"
        }
    };
    fields.forbid("over", message, hint)
}

fn read_period(fields: &mut Fields<'_>, driver: Measures, doc: &str) -> Option<Option<f64>> {
    fields.maybe("period", doc, |slot| {
        slot.quantity(driver.displacement(), Bounds::POSITIVE)
    })
}

fn read_position_table(
    slot: Slot<'_>,
    driver: Measures,
    force: QuantityChoice,
) -> Option<LoadLawSpec> {
    slot.record(|fields| {
        let points = fields.need(
            "points",
            "List of [displacement of the driver or of `over`, force]: linear between the points.",
            |slot| read_points(slot, driver.displacement(), force, 1),
        );
        let doc = "Repeats after this much of that displacement; without it the force is constant outside the points";
        let period = read_period(fields, driver, doc);
        let (points, period) = (points?, period?);
        let length = points[points.len() - 1].0 - points[0].0;
        if let Some(period) = period
            && length >= period * (1.0 - 1e-12)
        {
            let closes = points[0].1 == points[points.len() - 1].1;
            if length > period * (1.0 + 1e-12) || !closes {
                let message = table_period::spans("points span", length, period, driver);
                fields
                    .refuse("period", "out-of-range", message)
                    .hints
                    .push("all points must lie within one period; the force goes on to the first point by itself".to_owned());
                return None;
            }
        }
        if period.is_none() {
            table_period::check_single_turn(fields, &points, driver);
        }
        Some(LoadLawSpec::PositionTable {
            points,
            period,
            over: None,
        })
    })
}

fn read_window(slot: Slot<'_>, driver: Measures, force: QuantityChoice) -> Option<LoadLawSpec> {
    slot.record(|fields| {
        let edge = |slot: Slot<'_>| slot.quantity(driver.displacement(), Bounds::ANY);
        let from = fields.need("from", "Start of the window", edge);
        let to = fields.need("to", "End of the window, beyond its start", edge);
        let force = fields.need("force", "Force inside the window", |slot| {
            slot.quantity(force, Bounds::ANY)
        });
        let doc = "Repeats after this much of that displacement; default one turn of what turns";
        let once = fields.or(
            "once",
            "True: the window comes once and does not repeat.",
            json!(false),
            |slot| slot.flag(),
        );
        let period = read_period(fields, driver, doc);
        let (from, to, force, once, period) = (from?, to?, force?, once?, period?);
        if to <= from {
            let message = "`to` must be greater than `from`";
            fields.refuse("to", "out-of-range", message).hints.push(
                "a window across the end of a turn goes on beyond it: from 350 deg to 370 deg"
                    .to_owned(),
            );
            return None;
        }
        if once && period.is_some() {
            fields.refuse(
                "period",
                "contradiction",
                "a window that comes `once` has no `period`",
            );
            return None;
        }
        let turn = (driver.0 == Some(Coordinate::Turning) && !once).then_some(TAU);
        let period = period.or(turn);
        if let Some(period) = period {
            fields.fill_in("period", json!(period));
            if to - from > period {
                let message = table_period::spans("window spans", to - from, period, driver);
                fields.refuse("to", "out-of-range", message);
                return None;
            }
        }
        Some(LoadLawSpec::Window {
            from,
            to,
            force,
            period,
            over: None,
        })
    })
}

fn read_weight(slot: Slot<'_>) -> Option<LoadLawSpec> {
    slot.record(|fields| {
        let inclination = fields.need(
            "inclination",
            "Angle of the positive direction above the horizontal",
            |slot| slot.quantity(q::ANGLE, Bounds::ANY),
        );
        Some(LoadLawSpec::Weight {
            inclination: inclination?,
        })
    })
}

/// Reads a number of a law that the library declares.
pub(super) fn read_number(slot: Slot<'_>, parameter: &Parameter, own: Measures) -> Option<f64> {
    let bounds = match parameter.domain {
        Domain::Any => Bounds::ANY,
        Domain::NotNegative => Bounds::NOT_NEGATIVE,
        Domain::Positive => Bounds::POSITIVE,
        Domain::NotZero => Bounds::NOT_ZERO,
        Domain::UpToOne => Bounds::up_to(1.0),
        Domain::Between(from, to) => Bounds::between(from, to),
    };
    let wanted = match parameter.measure {
        Measure::Force => own.force(),
        Measure::Stiffness => own.stiffness(),
        Measure::Damping => own.damping(),
        Measure::Speed => own.speed(),
        Measure::TimePerDisplacement => own.time_per_displacement(),
        Measure::Number => return slot.number(bounds),
    };
    slot.quantity(wanted, bounds)
}

/// Reads the numbers of a law that the library declares.
pub(super) fn declared(
    slot: Slot<'_>,
    law: &'static ForceLaw,
    own: Measures,
) -> Option<LawInstance> {
    let number = |slot: Slot<'_>, parameter: &Parameter| read_number(slot, parameter, own);
    let values = match law.parameters {
        [alone] if alone.key.is_empty() => vec![number(slot, alone)?],
        several => slot.record(|fields| {
            let read = several.iter().map(|own| match own.usual {
                Some(usual) => fields.or(own.key, own.doc, json!(usual), |slot| number(slot, own)),
                None => fields.need(own.key, own.doc, |slot| number(slot, own)),
            });
            // (All of them, so that all faults are told.)
            let read: Vec<Option<f64>> = read.collect();
            read.into_iter().collect::<Option<Vec<f64>>>()
        })?,
    };
    Some(LawInstance::new(law, values))
}
