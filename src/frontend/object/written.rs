//! Expressions in scenes: the text, its unit, and mistakes with their place in it.

use super::Context;
use super::spec::LoadLawSpec;
use crate::dynamics::builder::written::{Names, OVER};
use crate::frontend::read::{Fields, QuantityChoice, Slot};
use crate::math::expression::{Expression, Mistake};

/// Reads an expression whose kinks and jumps can be located.
pub(super) fn read_expression(mut slot: Slot<'_>, names: &Names) -> Option<Expression> {
    let text = slot.read_in_place(|slot| slot.text())?;
    let read = slot.expression(&text, names);
    let located = |found: Option<Expression>| match &found {
        Some(expression) => expression.switches().map(|()| found),
        None => Ok(None),
    };
    match read.and_then(located) {
        Ok(expression) => expression,
        Err(mistake) => {
            refuse_expression(&mut slot, mistake);
            None
        }
    }
}

/// Reads a condition: an expression that compares, so that it is either true or false.
pub(in crate::frontend) fn read_condition(mut slot: Slot<'_>, names: &Names) -> Option<Expression> {
    let read = slot.read_in_place(|slot| read_expression(slot, names))?;
    // What is no comparison changes without a jump, and says so where it has to decide.
    let deciding = slot.expression(&format!("({}) ? 1 : 0", read.text()), names);
    if deciding.is_ok_and(|deciding| deciding.is_some_and(|one| one.switches().is_ok())) {
        return Some(read);
    }
    let message = format!("\"{}\" compares nothing: it is no condition", read.text());
    let fault = slot.refuse("bad-expression", message);
    fault
        .hints
        .push("for example \"phi > 0.3\", \"phi_dot < 0 && t > 1\"".to_owned());
    None
}

fn refuse_expression(slot: &mut Slot<'_>, mistake: Mistake) {
    // The text's own bytes follow its opening quote.
    let (start, end) = (
        mistake.place.start + 1,
        mistake.place.end.max(mistake.place.start + 1) + 1,
    );
    let place = slot.place().within(start..end);
    let fault = slot.refuse("bad-expression", mistake.message);
    fault.place = Some(place);
    fault.hints.push(match mistake.hint.is_empty() {
        true => "for example \"120*sin(2*pi*5*t)\", \"t < 2 ? 3*t : 6\"".to_owned(),
        false => mistake.hint,
    });
}

/// Reads `unit`, what the value of an expression is in: the factor to SI units.
pub(super) fn read_unit(fields: &mut Fields<'_>, wanted: QuantityChoice) -> Option<Option<f64>> {
    let doc = "Unit of the value of `expression`; default SI";
    let factor = fields.maybe("unit", doc, |slot| slot.unit(wanted));
    let name = fields.quantity_in("expression").map(str::to_owned);
    if let (Some(Some(factor)), Some(name)) = (factor, name)
        && factor != 1.0
    {
        let message =
            format!("the parameter `{name}` is in SI units in the expression, its value is not");
        let warning = fields.warn("unit", "implausible", message);
        let hint = "leave `unit` out, or give the parameter without a unit";
        warning.hints.push(hint.to_owned());
    }
    factor
}

/// Reads `over`, the object to whose motion an expression refers besides.
pub(super) fn read_over(fields: &mut Fields<'_>, context: &Context<'_>) -> Option<Option<String>> {
    let doc = "Another object or output: `press`, `press.ram`. `expression` knows its motion as \
               over_phi and over_phi_dot.";
    context.mention(fields, "over", doc)
}

/// A law, of which an expression has this unit.
pub(super) fn in_unit(mut law: LoadLawSpec, factor: Option<f64>) -> LoadLawSpec {
    if let (LoadLawSpec::Written(written), Some(factor)) = (&mut law, factor) {
        written.factor = factor;
    }
    law
}

/// The names that an expression may use, with those of another object where one is given.
pub(super) fn names_with_other_object(
    mut names: Vec<(&'static str, usize)>,
    over: bool,
) -> Vec<(&'static str, usize)> {
    if over {
        names.extend(OVER);
    }
    names
}

/// Notes that `unit` and `over` stand beside an expression only.
pub(super) fn require_expression(fields: &mut Fields<'_>, expressions: &[&str]) -> bool {
    if fields.describing() || expressions.iter().any(|name| fields.has(name)) {
        return false;
    }
    let unit = forbid_unit(fields);
    let message = "`over` goes with `expression` only";
    let over = fields.has("over") && fields.forbid("over", message, "remove `over`");
    unit || over
}

/// Notes that `unit` stands beside an expression only.
pub(super) fn forbid_unit(fields: &mut Fields<'_>) -> bool {
    let message = "`unit` goes with `expression` only";
    let hint = "write the unit with the number: \"3 kN\"";
    fields.has("unit") && fields.forbid("unit", message, hint)
}
