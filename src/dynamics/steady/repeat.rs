//! After which angle functions of the position repeat.

use super::formula::Formula;
use super::given::FunctionKind;
use super::profile::MOST_TURNS;
use super::refusal::Refusal;
use crate::math::expression::Repetition;
use crate::math::fraction::Fraction;
use std::f64::consts::TAU;

/// Most cycles that are tried where nothing proves that a function repeats.
const MOST_TRIED: u32 = 12;
/// Places of a cycle at which it is tried.
const PLACES: u32 = 512;
/// Differences that are rounding, of the greatest value.
const ROUNDING: f64 = 1e-9;

/// The least whole multiple of the angle `least` (rad) after which J repeats, and the moment
/// too, or the work but for what a cycle leaves over. What is written in pieces that end
/// once, `phi < pi ? 12 : -12`, describes one cycle: it is the angle `least` long.
///
/// # Errors
/// One of them does not repeat.
pub fn least_cycle(
    least: f64,
    inertia: &Formula,
    (given, other): (FunctionKind, &Formula),
) -> Result<f64, Refusal> {
    let (name, may_grow) = match given {
        FunctionKind::Work => ("work", true),
        FunctionKind::Moment => ("moment", false),
    };
    let one = cycles("inertia", inertia, false, least)?;
    let other = cycles(name, other, may_grow, least)?;
    let common = one.common_multiple(other).map(Fraction::value);
    let angle = common.map(|cycles| cycles * least);
    angle
        .filter(|&angle| angle <= MOST_TURNS * TAU * (1.0 + 1e-12))
        .ok_or_else(|| {
            never(
                "inertia",
                &format!("J and the {name} do not repeat together"),
            )
        })
}

fn never(name: &str, what: &str) -> Refusal {
    let message = format!("{what} after whole cycles, up to {MOST_TURNS} turns");
    let hint = "what repeats: cos(phi), cos(phi/2), or pieces over phi % (2*pi)";
    Refusal::field(name, message, hint)
}

/// Cycles after which a function repeats: proved by its operations, else tried.
fn cycles(name: &str, formula: &Formula, may_grow: bool, least: f64) -> Result<Fraction, Refusal> {
    let whole = |period: f64| {
        let ratio = Fraction::of(period / least)?;
        Fraction::of(1.0)?.common_multiple(ratio)
    };
    let found = match formula.repetition() {
        Some(Repetition::Line(slope)) if may_grow || slope == 0.0 => whole(least),
        Some(Repetition::Cycles { period, advance }) if may_grow || advance == 0.0 => whole(period),
        Some(_) => None,
        None => least_repetition(formula, may_grow, least)
            .or_else(|| (formula.is_in_pieces() && closes(name, formula, least)).then_some(1.0))
            .and_then(Fraction::of),
    };
    found.ok_or_else(|| never(name, &format!("{} does not repeat", formula.text())))
}

/// Whether a function in pieces is one cycle: J is at its end what it was at its start; forces
/// may jump there.
fn closes(name: &str, formula: &Formula, least: f64) -> bool {
    let [start, end] = [0.0, least].map(|place| formula.at(place));
    name != "inertia" || (end - start).abs() <= ROUNDING * start.abs()
}

/// The least number of cycles after which a function repeats at all places that are tried.
fn least_repetition(formula: &Formula, may_grow: bool, least: f64) -> Option<f64> {
    let repeats = |count: &u32| {
        let angle = f64::from(*count) * least;
        let places =
            (0..PLACES * count).map(|i| least * (f64::from(i) + 0.381_966) / f64::from(PLACES));
        let pairs: Vec<[f64; 2]> = places
            .map(|place| [formula.at(place), formula.at(place + angle)])
            .collect();
        let gain = match may_grow {
            true => pairs[0][1] - pairs[0][0],
            false => 0.0,
        };
        let size = pairs
            .iter()
            .flatten()
            .fold(0.0, |size: f64, one| size.max(one.abs()));
        let same = |pair: &[f64; 2]| (pair[1] - pair[0] - gain).abs() <= ROUNDING * size;
        pairs.iter().all(same)
    };
    (1..=MOST_TRIED).find(repeats).map(f64::from)
}

#[cfg(test)]
mod tests {
    use super::least_cycle;
    use crate::dynamics::steady::{Formula, FunctionKind};
    use std::f64::consts::TAU;

    fn turns(inertia: &str, given: FunctionKind, other: &str, least: f64) -> Option<f64> {
        let of = |text: &str| Formula::new("inertia", text).unwrap();
        let found = least_cycle(least * TAU, &of(inertia), (given, &of(other)));
        found.ok().map(|angle| angle / TAU)
    }

    #[test]
    fn the_cycle_is_as_long_as_both_functions_need() {
        use FunctionKind::{Moment, Work};
        for (inertia, given, other, least, wanted) in [
            ("1.5", Moment, "12*cos(phi)", 1.0, 1.0),
            ("1.5", Moment, "12*cos(phi/2)", 1.0, 2.0),
            ("1.5 + 0.5*cos(φ/2)", Moment, "0", 1.0, 2.0),
            ("1.5 + 0.5*cos(phi/2)", Moment, "cos(phi/3)", 1.0, 6.0),
            ("1.5 + 0.5*cos(phi/2)", Moment, "cos(phi/3)", 2.0, 6.0),
            ("2 + cos(3*phi)", Work, "sin(1.5*phi) - 4*phi", 1.0, 2.0),
            ("2", Moment, "(phi % (4*pi)) < 0.01 ? 100 : 0", 1.0, 2.0),
            // Not proved, but so.
            (
                "2 + cos(phi)*cos(atan2(sin(phi/4), cos(phi/4)))",
                Moment,
                "0",
                1.0,
                4.0,
            ),
            (
                "2",
                Work,
                "exp(ln(2)*sin(phi/2)) + (phi + 1)*(phi + 1) - phi*phi",
                1.0,
                2.0,
            ),
            // Pieces of one cycle.
            ("1.5", Moment, "phi < pi ? 12 : -12", 1.0, 1.0),
            (
                "2 + abs(phi - pi)",
                Work,
                "phi < pi ? sin(phi) : 0",
                1.0,
                1.0,
            ),
            // Less than a turn.
            ("2 + cos(8*phi)", Moment, "0", 0.125, 0.125),
        ] {
            let found = turns(inertia, given, other, least).unwrap();
            approx::assert_relative_eq!(found, wanted, max_relative = 1e-12);
        }
    }

    #[test]
    fn what_does_not_repeat_is_refused() {
        use FunctionKind::{Moment, Work};
        for (inertia, given, other) in [
            ("1.5", Moment, "12*phi"),
            ("1.5 + 0.1*phi", Work, "0"),
            ("1.5", Work, "phi^2"),
            ("1.5", Moment, "max(0, cos(sqrt(2)*phi))"),
            ("phi < pi ? 2 : 3", Moment, "0"),
            ("1.5", Moment, "cos(sqrt(2)*phi)"),
            ("1.5 + cos(phi/11)", Moment, "cos(phi/13)"),
        ] {
            assert_eq!(
                turns(inertia, given, other, 1.0),
                None,
                "{inertia}, {other}"
            );
        }
    }
}
