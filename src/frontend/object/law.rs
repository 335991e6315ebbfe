//! Laws of motion in scenes and in arguments of commands.

use crate::fault::Fault;
use crate::frontend::diagnostics::{Diagnostics, Place, Source, Sources};
use crate::frontend::read::{
    Bounds, Fields, Node, Reader, Slot, Value, parse_fragment, read_points,
};
use crate::kinematics::motion::law::{MOST_CONDITIONS, PolynomialSpec, SectionsSpec, TABLE_POINTS};
use crate::kinematics::motion::{Law, LawName, LawSpec, RunLawName, RunLawSpec};
use crate::units::quantities as q;
use serde_json::json;
use std::sync::Arc;

/// Reads the law of a full stroke: a name, or an object with its parameters.
pub(crate) fn read_law(slot: Slot<'_>) -> Option<LawSpec> {
    slot.defined("law", |mut slot| {
        let names = LawName::ALL.map(|name| (name.name(), LawSpec::Named(name)));
        let spec = slot
            .read_in_place(|slot| slot.object_or(read_composed_law, |slot| slot.choice(&names)))?;
        match Law::of_stroke(&spec) {
            Ok(_) => Some(spec),
            Err(faults) => refuse_law(slot, faults),
        }
    })
}

/// Reads the law of a run-up: a name, or an object with its parameters.
pub(crate) fn read_run_law(slot: Slot<'_>) -> Option<RunLawSpec> {
    slot.defined("run_law", |mut slot| {
        let names = RunLawName::ALL.map(|name| (name.name(), RunLawSpec::from(name)));
        let spec =
            slot.read_in_place(|slot| slot.object_or(read_run_up, |slot| slot.choice(&names)))?;
        match Law::of_run_up(&spec) {
            Ok(_) => Some(spec),
            Err(faults) => refuse_law(slot, faults),
        }
    })
}

fn refuse_law<T>(mut slot: Slot<'_>, faults: Vec<Fault>) -> Option<T> {
    for fault in faults {
        let message = match fault.path.as_str() {
            "" => fault.message,
            path => format!("`{path}`: {}", fault.message),
        };
        let refused = slot.refuse("out-of-range", message);
        if !fault.hint.is_empty() {
            refused.hints.push(fault.hint);
        }
    }
    None
}

fn read_share(fields: &mut Fields<'_>, name: &'static str, doc: &str) -> Option<f64> {
    fields.need(name, doc, |slot| slot.number(Bounds::between(0.0, 1.0)))
}

/// Reads a law given by its parameters.
pub(super) fn read_composed_law(slot: Slot<'_>) -> Option<LawSpec> {
    slot.record(|fields| {
        let mut kind = fields.one_of("its law");
        kind.case(
            "scca",
            "Sine, constant and cosine acceleration, symmetric.",
            |slot| {
                slot.record(|fields| {
                    let b = read_share(fields, "b", "Share of the sines at both ends together.");
                    let d = read_share(fields, "d", "Share of the cosine about the middle.");
                    Some(LawSpec::Scca { b: b?, d: d? })
                })
            },
        );
        kind.case("sections", "Run-up, uniform motion and run-out.", |slot| {
            read_sections(slot).map(LawSpec::Sections)
        });
        kind.case(
            "polynomial",
            "Polynomial from conditions at its ends; θ and θ′ are 0, 0 and 1, 0 there.",
            |slot| read_polynomial(slot).map(LawSpec::Polynomial),
        );
        kind.case(
            "table",
            "List of [τ, θ] from [0, 0] to [1, 1]: a smooth spline, at rest at both ends.",
            |slot| read_table(slot).map(LawSpec::Table),
        );
        kind.finish()
    })
}

fn read_sections(slot: Slot<'_>) -> Option<SectionsSpec> {
    slot.record(|fields| {
        let up = fields.need("run_up", "Law of the run-up.", read_run_law);
        let out = fields.need(
            "run_out",
            "Law of the run-out, run backwards.",
            read_run_law,
        );
        let skewness = fields.or(
            "skewness",
            "Duration of the run-out by that of the run-up.",
            json!(1.0),
            |slot| slot.number(Bounds::POSITIVE),
        );
        let uniform = fields.or(
            "uniform",
            "Share of the whole duration with uniform motion, below 1.",
            json!(0.0),
            |slot| slot.number(Bounds::between(0.0, 1.0)),
        );
        Some(SectionsSpec {
            run_up: up?,
            run_out: out?,
            skewness: skewness?,
            uniform: uniform?,
        })
    })
}

fn read_run_up(slot: Slot<'_>) -> Option<RunLawSpec> {
    slot.record(|fields| {
        let mut kind = fields.one_of("its law");
        kind.case(
            "trapezoid",
            "Modified trapezoid of general form: shares of rise and fall of the acceleration, \
             together at most 1.",
            |slot| {
                slot.record(|fields| {
                    let s1 = read_share(fields, "s1", "Share of the rise, a quarter sine.");
                    let s2 = read_share(fields, "s2", "Share of the fall, a quarter cosine.");
                    Some(RunLawSpec::Trapezoid { s1: s1?, s2: s2? })
                })
            },
        );
        kind.case(
            "polynomial",
            "Polynomial from conditions at its ends; θ and θ′ are 0, 0 at the start, θ is 1 at the end.",
            |slot| read_polynomial(slot).map(RunLawSpec::Polynomial),
        );
        kind.case(
            "table",
            "List of [τ, θ] from [0, 0] to [1, 1]: a smooth spline, from rest.",
            |slot| read_table(slot).map(RunLawSpec::Table),
        );
        kind.finish()
    })
}

fn read_polynomial(slot: Slot<'_>) -> Option<PolynomialSpec> {
    slot.record(|fields| {
        let numbers =
            |slot: Slot<'_>| slot.list(1..=MOST_CONDITIONS, |slot| slot.number(Bounds::ANY));
        let start = fields.need("start", "θ, θ′, θ″, … at τ = 0.", numbers);
        let end = fields.need("end", "θ, θ′, θ″, … at τ = 1.", numbers);
        let through = fields.or(
            "through",
            "Points [τ, θ] between the ends.",
            json!([]),
            |slot| {
                slot.list(0..=MOST_CONDITIONS, |slot| {
                    slot.pair(
                        |slot| slot.number(Bounds::between(0.0, 1.0)),
                        |slot| slot.number(Bounds::ANY),
                    )
                })
            },
        );
        Some(PolynomialSpec {
            start: start?,
            end: end?,
            through: through?,
        })
    })
}

fn read_table(mut slot: Slot<'_>) -> Option<Vec<(f64, f64)>> {
    let least = *TABLE_POINTS.start();
    let found = slot.read_in_place(|slot| read_points(slot, q::NUMBER, q::NUMBER, least))?;
    if found.len() > *TABLE_POINTS.end() {
        let message = format!("a law takes at most {} points", TABLE_POINTS.end());
        slot.refuse("wrong-length", message);
        return None;
    }
    Some(found)
}

/// A law named or described outside a scene.
#[derive(Clone, Debug, PartialEq)]
pub enum AnyLaw {
    /// Of a full stroke, from rest to rest.
    Stroke(LawSpec),
    /// Of a run-up, from rest to uniform motion.
    RunUp(RunLawSpec),
}

impl AnyLaw {
    /// The law, laid out.
    ///
    /// # Errors
    /// Everything wrong with its numbers.
    pub fn read_law(&self) -> Result<Law, Vec<Fault>> {
        match self {
            Self::Stroke(spec) => Law::of_stroke(spec),
            Self::RunUp(spec) => Law::of_run_up(spec),
        }
    }

    /// The law in a few words.
    pub fn words(&self) -> String {
        match self {
            Self::Stroke(spec) => spec.words(),
            Self::RunUp(spec) => spec.words(),
        }
    }
}

/// The law of a full stroke as an argument gives it: a name, `scca:b,d`, or
/// JSON as in a scene.
///
/// # Errors
/// What a scene would be told of it.
pub fn stroke_law(text: &str) -> Result<LawSpec, Diagnostics> {
    let text = shorthand(text, "scca", ["b", "d"]);
    read_argument("law", &text, read_law)
}

/// The law of a run-up as an argument gives it: a name, `trapezoid:s1,s2`, or
/// JSON as in a scene.
///
/// # Errors
/// What a scene would be told of it.
pub fn run_up_law(text: &str) -> Result<RunLawSpec, Diagnostics> {
    let text = shorthand(text, "trapezoid", ["s1", "s2"]);
    read_argument("law", &text, read_run_law)
}

/// A law of either kind; of names that both have, the stroke's.
///
/// # Errors
/// What a scene would be told of it.
pub fn any_law(text: &str) -> Result<AnyLaw, Diagnostics> {
    let run_up = RunLawName::ALL.iter().any(|name| name.name() == text);
    let stroke = LawName::ALL.iter().any(|name| name.name() == text);
    let trapezoid = text.contains("trapezoid:") || text.contains("\"trapezoid\"");
    if !stroke && (run_up || trapezoid) && !text.contains("\"sections\"") {
        return run_up_law(text).map(AnyLaw::RunUp);
    }
    stroke_law(text).map(AnyLaw::Stroke)
}

/// `kind:1,2` as JSON; anything else as it stands.
fn shorthand(text: &str, kind: &str, names: [&str; 2]) -> String {
    let numbers = text
        .strip_prefix(kind)
        .and_then(|rest| rest.strip_prefix(':'))
        .and_then(|rest| rest.split_once(','));
    match numbers {
        Some((one, other)) => {
            let (one, other) = (one.trim(), other.trim());
            let [a, b] = names;
            format!("{{\"{kind}\": {{\"{a}\": {one}, \"{b}\": {other}}}}}")
        }
        None => text.to_owned(),
    }
}

/// A number as it is typed at a prompt, where JSON has another form: `.7`, `7.`, `+7`.
fn bare_number(text: &str) -> Option<f64> {
    let text = text.trim();
    let unsigned = text.trim_start_matches(['+', '-']);
    let digits = unsigned.trim_start_matches('.');
    let plain = |c: char| c.is_ascii_digit() || matches!(c, '.' | 'e' | 'E' | '+' | '-');
    let two_zeros =
        digits.starts_with('0') && digits[1..].starts_with(|c: char| c.is_ascii_digit());
    let number = digits.starts_with(|c: char| c.is_ascii_digit()) && text.chars().all(plain);
    if !number || (two_zeros && unsigned == digits) {
        return None;
    }
    text.parse().ok().filter(|number: &f64| number.is_finite())
}

/// Reads an argument of a command by the declarations of scenes; a text that
/// is not JSON stands for itself.
///
/// # Errors
/// What a scene would be told of it.
pub fn read_argument<T>(
    name: &str,
    text: &str,
    read: impl FnOnce(Slot<'_>) -> Option<T>,
) -> Result<T, Diagnostics> {
    let mut sources = Sources::default();
    let source = sources.add(Arc::new(Source {
        name: name.to_owned(),
        text: text.to_owned(),
    }));
    let node = match parse_fragment(text, source, 0) {
        Ok(node) => node,
        // `.7` and `7.` are numbers at a prompt, though not in JSON.
        Err(_) if bare_number(text).is_some() => Node {
            place: Place::new(source, 0..text.len()),
            value: Value::Number(bare_number(text).unwrap_or(f64::NAN)),
        },
        Err(faults) if faults.iter().all(|fault| fault.code == "not-json") => Node {
            place: Place::new(source, 0..text.len()),
            value: Value::Text(text.to_owned()),
        },
        Err(faults) => return Err(Diagnostics::new(sources, faults)),
    };
    let mut reader = Reader::new();
    let (value, _) = reader.read(Some(&node), name, read);
    match value.filter(|_| reader.diagnostics.is_empty()) {
        Some(value) => Ok(value),
        None => Err(Diagnostics::new(sources, reader.diagnostics)),
    }
}

#[cfg(test)]
mod tests {
    use super::{AnyLaw, any_law, run_up_law, stroke_law};
    use crate::kinematics::motion::{LawName, LawSpec, RunLawSpec};

    #[test]
    fn arguments_name_or_describe_laws() {
        let named = any_law("modified_sine").unwrap();
        assert_eq!(named, AnyLaw::Stroke(LawName::ModifiedSine.into()));
        let cosine = RunLawSpec::Trapezoid { s1: 0.0, s2: 1.0 };
        assert_eq!(any_law("cosine").unwrap(), AnyLaw::RunUp(cosine));
        let general = RunLawSpec::Trapezoid { s1: 0.2, s2: 0.3 };
        assert_eq!(run_up_law("trapezoid:0.2, 0.3").unwrap(), general);
        assert_eq!(
            any_law("trapezoid:0.2,0.3").unwrap(),
            AnyLaw::RunUp(general)
        );
        let scca = LawSpec::Scca { b: 0.2, d: 0.5 };
        assert_eq!(stroke_law("scca:0.2,0.5").unwrap(), scca);
        let table = any_law("{\"table\": [[0, 0], [0.5, 0.5], [1, 1]]}").unwrap();
        assert!(matches!(table, AnyLaw::Stroke(LawSpec::Table(_))));
        let sections =
            r#"{"sections": {"run_up": {"trapezoid": {"s1": 0, "s2": 1}}, "run_out": "sine"}}"#;
        let law = any_law(sections).unwrap();
        assert!(matches!(law, AnyLaw::Stroke(LawSpec::Sections(_))));
    }

    #[test]
    fn slips_are_told_as_in_a_scene() {
        let fault = |text: &str| any_law(text).unwrap_err().lines().join("\n");
        assert!(
            fault("cycloid").contains("did you mean `cycloidal`"),
            "{}",
            fault("cycloid")
        );
        assert!(fault("trapezoid:0.7,0.7").contains("together at most 1"));
        assert!(fault("scca:0.7").contains("unknown law"));
        assert!(fault("{\"scca\": {\"b\": 0.1}}").contains("no `d`"));
    }
}
