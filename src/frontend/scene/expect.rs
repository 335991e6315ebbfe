//! The `expect` block.

use super::figures::{
    CAM_FIGURES, OBJECT_FIGURES, RUN_FIGURES, STEADY_FIGURES, STOP_FIGURES, STOPS,
};
use super::objects::ObjectTable;
use super::span::{self, SpanAddress};
use super::study_address::StudyAddress;
use super::{AllowedValues, Expectation, Expected};
use crate::dynamics::model::owner_of;
use crate::frontend::object::Measures;
use crate::frontend::read::{
    Bounds, Fields, QuantityChoice, Slot, closest, did_you_mean, quoted_list,
};
use crate::units::quantities as q;

/// Subject of an expectation.
#[derive(Clone)]
enum About {
    Figure(String, QuantityChoice),
    Stop(&'static str),
}

/// Reads `expect`.
pub(super) fn read(slot: Slot<'_>, known: &ObjectTable) -> Option<Vec<Expectation>> {
    slot.list(0..=usize::MAX, |slot| {
        slot.record(|fields| read_expectation(fields, known))
    })
}

fn read_expectation(fields: &mut Fields<'_>, known: &ObjectTable) -> Option<Expectation> {
    let mut about = fields.one_of("what is expected");
    about.case(
        "figure",
        "Address of a result: `rocker.delta_max`, `run.switches`; `steady.period`; \
         `kinematics.press.ram.time_ratio`, `forces.press.drive.greatest`; \
         `cam.follower.least_radius`, `frequency.1`.",
        |slot| read_figure(slot, known),
    );
    about.case(
        "stops",
        "Reason for which the run is expected to stop.",
        |slot| {
            slot.choice(&STOPS.map(|(name, _)| (name, name)))
                .map(About::Stop)
        },
    );
    let about = about.finish();
    let wanted = match &about {
        Some(About::Figure(_, wanted)) => *wanted,
        Some(About::Stop(_)) => q::TIME.into(),
        None => QuantityChoice::anything(),
    };
    let figure = match &about {
        Some(About::Figure(figure, _)) if wanted == QuantityChoice::anything() => {
            Some(figure.clone())
        }
        _ => None,
    };
    let keep = |slot: &mut Slot<'_>| {
        if let Some(figure) = &figure {
            known.keep_measure(figure, slot);
        }
    };
    let number = |mut slot: Slot<'_>| {
        keep(&mut slot);
        slot.quantity(wanted, Bounds::ANY)
    };
    let value = fields.maybe(
        "value",
        "Expected value of the result, or true or false",
        |slot| slot.flag_or(|slot| slot.flag().map(f64::from), number),
    );
    let time = fields.maybe("time", "Expected time of the stop", |slot| {
        slot.quantity(q::TIME, Bounds::ANY)
    });
    let doc = "Greatest value that the result may have, in place of `value`; with `at_least` both \
               ends of a range";
    let most = fields.maybe("at_most", doc, number);
    let doc = "Least value that the result may have, in place of `value`";
    let least = fields.maybe("at_least", doc, number);
    let doc = "Least and greatest value that the result may have: both ends of a range in one";
    let between = fields.maybe("between", doc, |slot| slot.pair(number, number));
    let within = fields.maybe(
        "within",
        "Greatest difference to `value` or `time`, which need it: a number, or a text such as \"0.1 %\" of the value",
        |mut slot| match is_share(&slot) {
            true => slot.number(Bounds::NOT_NEGATIVE).map(Within::Share),
            false => {
                keep(&mut slot);
                let bound = slot.quantity(wanted, Bounds::NOT_NEGATIVE);
                bound.map(Within::Absolute)
            }
        },
    );
    let over = read_over(fields);
    let source = fields.maybe("source", "Source of the value.", |slot| slot.text());
    let about = read_within_span(fields, about, over?)?;
    let (about, value, time, within) = (about, value?, time?, within?);
    let (least, most, between) = (least?, most?, between?);
    let bounded = [
        ("at_least", least.is_some()),
        ("at_most", most.is_some()),
        ("between", between.is_some()),
    ];
    let bounded: Vec<&str> = (bounded.iter())
        .filter_map(|(name, given)| given.then_some(*name))
        .collect();
    if let (Some(_), [name, "between"] | ["at_least", name, "between"]) =
        (between, bounded.as_slice())
    {
        let message = format!("`between` says both ends: `{name}` says one again");
        fields.refuse("between", "contradiction", message);
        return None;
    }
    let bounded = bounded.first().copied();
    let (least, most) = match between {
        Some((least, most)) => (Some(least), Some(most)),
        None => (least, most),
    };
    let what = match about {
        About::Figure(figure, _) if bounded.is_some() => {
            let stray = [
                ("value", value.is_some()),
                ("within", within.is_some()),
                ("time", time.is_some()),
            ];
            for (name, _) in stray.into_iter().filter(|(_, given)| *given) {
                let message =
                    format!("`{name}` does not go with `at_most`, `at_least` and `between`");
                fields.refuse(name, "contradiction", message).hints.push(
                    "write `value` and `within`, or `at_least`, `at_most` or `between`".to_owned(),
                );
            }
            if stray.iter().any(|(_, given)| *given) {
                return None;
            }
            if let (Some(least), Some(most)) = (least, most)
                && least > most
            {
                let (name, message) = match between {
                    Some(_) => (
                        "between",
                        "the first value is greater than the second: nothing is between",
                    ),
                    None => (
                        "at_least",
                        "`at_least` is greater than `at_most`: no value is both",
                    ),
                };
                fields.refuse(name, "contradiction", message);
                return None;
            }
            Expected::Figure {
                figure,
                allowed: AllowedValues::Between { least, most },
            }
        }
        About::Figure(figure, _) => {
            let value =
                read_required_value(fields, value, "value", time.is_some().then_some("time"));
            let within = read_needed(fields, within);
            let (value, within) = (value?, within?);
            let within = read_absolute(fields, within, value)?;
            Expected::Figure {
                figure,
                allowed: AllowedValues::Near { value, within },
            }
        }
        About::Stop(reason) => {
            let stray = bounded.or(value.is_some().then_some("value"));
            let time = read_required_value(fields, time, "time", stray);
            let within = read_needed(fields, within);
            let (time, within) = (time?, within?);
            let within = read_absolute(fields, within, time)?;
            Expected::Stops {
                reason: reason.to_owned(),
                time,
                within,
            }
        }
    };
    Some(Expectation {
        what,
        source: source?,
    })
}

/// A part of the motion as it is written: its ends and, if given, the object whose displacement
/// they are.
struct WrittenSpan {
    from: String,
    to: String,
    of: Option<String>,
}

/// Reads `over`: `Some(None)` where the whole motion counts.
fn read_over(fields: &mut Fields<'_>) -> Option<Option<WrittenSpan>> {
    let doc = "Part of the motion that counts, of figures that are greatest or least values: \
               between two machine angles in every turn, or between two times.";
    fields.maybe("over", doc, |slot| {
        slot.record(|fields| {
            let doc = "Start: a machine angle, \"30 deg\", a time, \"0.2 s\", or a displacement of `of`; with its unit.";
            let from = fields.need("from", doc, read_end_of_span);
            let doc = "End, beyond its start: \"370 deg\" goes on over the end of a turn.";
            let to = fields.need("to", doc, read_end_of_span);
            let doc = "Object or output whose displacement the ends are; default the drive, whose angle is the machine angle.";
            let of = fields.maybe("of", doc, |slot| slot.text());
            Some(WrittenSpan {
                from: from?,
                to: to?,
                of: of?,
            })
        })
    })
}

fn read_end_of_span(mut slot: Slot<'_>) -> Option<String> {
    let text = slot.read_in_place(|slot| slot.text())?;
    let measure = slot.quantity_of(&text);
    let found = measure.and_then(|found| span::place_text(&text, found.value, found.dimension));
    if found.is_none() {
        let message = format!("`{text}` is no angle, time or length with its unit");
        let fault = slot.refuse("wrong-unit", message);
        fault
            .hints
            .push("for example \"30 deg\", \"0.2 s\"".to_owned());
    }
    found
}

/// What is expected, within a part of the motion; the faults of the part.
fn read_within_span(
    fields: &mut Fields<'_>,
    about: Option<About>,
    over: Option<WrittenSpan>,
) -> Option<About> {
    let about = about?;
    let Some(over) = over else {
        return Some(about);
    };
    let About::Figure(figure, wanted) = about else {
        let message = "`over` goes with `figure`: a run stops once";
        fields.refuse("over", "contradiction", message);
        return None;
    };
    let of = over
        .of
        .as_ref()
        .map_or_else(String::new, |of| format!(" of {of}"));
    let address = format!("{figure} from {} to {}{of}", over.from, over.to);
    let read = SpanAddress::of(&address).map(|found| found.span());
    if let Some(Err((message, hint))) = read {
        fields
            .refuse("over", "out-of-range", message)
            .hints
            .push(hint);
        return None;
    }
    Some(About::Figure(address, wanted))
}

/// The property that belongs to what is expected, without the other one.
fn read_required_value(
    fields: &mut Fields<'_>,
    value: Option<f64>,
    name: &str,
    stray: Option<&str>,
) -> Option<f64> {
    if let Some(stray) = stray {
        let message = format!("`{stray}` does not belong here");
        fields.refuse(stray, "contradiction", message).hints.push(
            "`value`, `at_most`, `at_least` and `between` go with `figure`, `time` with `stops`"
                .to_owned(),
        );
        return None;
    }
    if value.is_none() {
        fields
            .refuse(
                name,
                "missing-property",
                format!("this expectation has no `{name}`"),
            )
            .label = format!("`{name}` is missing");
    }
    value
}

/// The bound that a value needs.
fn read_needed(fields: &mut Fields<'_>, within: Option<Within>) -> Option<Within> {
    if within.is_none() {
        let message = "this expectation has no `within`";
        let fault = fields.refuse("within", "missing-property", message);
        fault.label = "`within` is missing".to_owned();
        fault.hints.push(
            "say by how much it may differ; or write `at_most`, `at_least` or `between` in place of `value`"
                .to_owned(),
        );
    }
    within
}

/// True for a text such as "0.1 %".
pub(super) fn is_share(slot: &Slot<'_>) -> bool {
    let text = slot.node().and_then(|node| node.text());
    text.is_some_and(|text| text.trim_end().ends_with('%'))
}

/// A bound as written.
#[derive(Clone, Copy)]
enum Within {
    Absolute(f64),
    Share(f64),
}

fn read_absolute(fields: &mut Fields<'_>, within: Within, value: f64) -> Option<f64> {
    match within {
        Within::Absolute(bound) => Some(bound),
        Within::Share(share) if value != 0.0 => Some(share * value.abs()),
        Within::Share(_) => {
            fields.refuse(
                "within",
                "contradiction",
                "a share of 0 allows no difference at all",
            );
            None
        }
    }
}

/// The address of a figure, with what it measures.
fn read_figure(mut slot: Slot<'_>, known: &ObjectTable) -> Option<About> {
    let address = slot.read_in_place(|slot| slot.text())?;
    read_subject(&mut slot, address, known)
}

/// What a figure of a run or of a study measures, whose address is the name of a property.
pub(super) fn read_figure_of_run(
    slot: &mut Slot<'_>,
    address: &str,
    known: &ObjectTable,
) -> Option<QuantityChoice> {
    match read_subject(slot, address.to_owned(), known)? {
        About::Figure(_, wanted) => Some(wanted),
        About::Stop(_) => None,
    }
}

fn read_subject(slot: &mut Slot<'_>, address: String, known: &ObjectTable) -> Option<About> {
    if let Some(within) = SpanAddress::of(&address) {
        if let Err((message, hint)) = within.span() {
            slot.refuse("out-of-range", message).hints.push(hint);
            return None;
        }
        return match read_subject(slot, within.figure.to_owned(), known)? {
            About::Figure(_, wanted) => Some(About::Figure(address, wanted)),
            About::Stop(_) => None,
        };
    }
    match StudyAddress::of(&address) {
        Some(StudyAddress::Frequency { number: 1.., .. }) => {
            return Some(About::Figure(address, q::FREQUENCY.into()));
        }
        Some(StudyAddress::Frequency { .. }) => {
            let fault = slot.refuse("unknown-figure", format!("there is no result `{address}`"));
            let hint = "frequencies are counted from 1, the lowest: `frequency.1`";
            fault.hints.push(hint.to_owned());
            return None;
        }
        Some(StudyAddress::Cam { object, name }) if known.objects.contains_key(object) => {
            let found = CAM_FIGURES.iter().find(|figure| figure.name == name);
            let own = Measures(known.objects[object].coordinate);
            let quantity = found.map_or(q::NUMBER.into(), |figure| (figure.measure)(own));
            return Some(About::Figure(address, quantity));
        }
        _ => {}
    }
    let (owner, name) = owner_of(&address, |id| {
        known.objects.contains_key(id) || known.stops.contains_key(id)
    });
    if !known.objects.contains_key(owner) {
        match owner {
            "cam" => {
                no_cam_figure(slot, known, name);
                return None;
            }
            "frequency" => {
                let fault =
                    slot.refuse("unknown-figure", format!("there is no result `{address}`"));
                let hint = "write `frequency.1` for the lowest natural frequency with all pairs \
                            closed, `frequency.open.1` with all open";
                fault.hints.push(hint.to_owned());
                return None;
            }
            _ => {}
        }
    }
    if owner == "run" {
        if name.starts_with("first_times.") {
            return Some(About::Figure(address, q::TIME.into()));
        }
        if let Some(found) = RUN_FIGURES.iter().find(|figure| figure.name == name) {
            return Some(About::Figure(address, found.measure.into()));
        }
        let names = RUN_FIGURES.iter().map(|figure| figure.name);
        unknown(slot, "run", name, names);
        return None;
    }
    if owner == "steady" {
        if let Some(found) = STEADY_FIGURES.iter().find(|figure| figure.name == name) {
            return Some(About::Figure(address, found.measure.into()));
        }
        let names = STEADY_FIGURES.iter().map(|figure| figure.name);
        unknown(slot, "steady", name, names);
        return None;
    }
    if owner == "kinematics" || owner == "forces" {
        return read_study_figure(slot, known, address);
    }
    let object = known.objects.get(owner).map(|object| object.coordinate);
    let (coordinate, figures, pair) = match (object, known.stops.get(owner)) {
        (Some(coordinate), _) => (coordinate, OBJECT_FIGURES, "pair"),
        (None, Some(&coordinate)) => (coordinate, STOP_FIGURES, "stop"),
        (None, None) => {
            let ids = known.objects.keys().map(String::as_str).chain(["run"]);
            let guess = closest(owner, ids);
            let fault = slot.refuse("unknown-object", format!("unknown object `{owner}`"));
            fault.hints.push(match guess {
                Some(guess) => format!("did you mean `{guess}`?"),
                None => "results are addressed as `object.result` or `run.result`".to_owned(),
            });
            return None;
        }
    };
    let index = name.strip_prefix(pair);
    let index = index.and_then(|rest| rest.strip_prefix(".switch_times."));
    if index.is_some_and(|index| index.parse::<usize>().is_ok()) {
        return Some(About::Figure(address, q::TIME.into()));
    }
    let found = figures.iter().find(|figure| figure.name == name);
    match found {
        Some(figure) => {
            let wanted = (figure.measure)(Measures(coordinate));
            Some(About::Figure(address, wanted))
        }
        None => {
            unknown(slot, owner, name, figures.iter().map(|figure| figure.name));
            None
        }
    }
}

/// The address of a figure of a linkage's kinematics or forces,
/// `forces.press.drive.greatest`. Which figures there are is known only when the
/// linkage is, and what each measures; until then any unit will do.
fn read_study_figure(slot: &mut Slot<'_>, known: &ObjectTable, address: String) -> Option<About> {
    let mut parts = address.splitn(3, '.');
    let (study, object, name) = (parts.next()?, parts.next(), parts.next());
    let (Some(object), Some(_)) = (object, name) else {
        let message = format!("`{address}` names no result");
        let fault = slot.refuse("unknown-figure", message);
        let hint = format!(
            "write {study}.object.result, as in `{study}.press.{}`",
            match study {
                "forces" => "drive.greatest",
                _ => "ram.speed.greatest",
            }
        );
        fault.hints.push(hint);
        return None;
    };
    if known.objects.contains_key(object) {
        return Some(About::Figure(address, QuantityChoice::anything()));
    }
    let hint = did_you_mean(object, known.objects.keys().map(String::as_str));
    let fault = slot.refuse("unknown-object", format!("unknown object `{object}`"));
    fault.hints.extend(hint);
    None
}

/// Refuses `cam.NAME`, which is no figure of a cam.
fn no_cam_figure(slot: &mut Slot<'_>, known: &ObjectTable, name: &str) {
    let named = name.rsplit_once('.');
    let objects = || known.objects.keys().map(String::as_str);
    let Some((object, figure)) = named.filter(|(object, _)| known.objects.contains_key(*object))
    else {
        let object = named.map_or(name, |(object, _)| object);
        let hint = match known.objects.contains_key(object) {
            true => Some(format!(
                "write cam.object.result, as in `cam.{object}.least_radius`"
            )),
            false => did_you_mean(object, objects()),
        };
        let message = match known.objects.contains_key(object) {
            true => format!("`cam.{name}` names no result"),
            false => format!("unknown object `{object}`"),
        };
        slot.refuse("unknown-figure", message).hints.extend(hint);
        return;
    };
    let names = CAM_FIGURES.iter().map(|figure| figure.name);
    unknown(slot, &format!("cam.{object}"), figure, names);
}

fn unknown<'a>(
    slot: &mut Slot<'_>,
    owner: &str,
    name: &str,
    names: impl Iterator<Item = &'a str> + Clone,
) {
    let message = match name {
        "" => format!("`{owner}` names no result"),
        name => format!("`{owner}` has no result `{name}`"),
    };
    let fault = slot.refuse("unknown-figure", message);
    fault.hints.push(match closest(name, names.clone()) {
        Some(guess) => format!("did you mean `{owner}.{guess}`?"),
        None if name.is_empty() => {
            format!("write `{owner}.` and one of {}", quoted_list(names, "or"))
        }
        None => format!("its figures are {}", quoted_list(names, "and")),
    });
}
