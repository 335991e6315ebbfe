//! The search on functions whose answers are known.

use super::{Aim, FindResult, Goal, Limit, Sample, Span, State, search};
use crate::studies::condition::{Condition, Relation, WrittenUnit};
use std::cell::Cell;

fn condition(relation: Relation, value: f64) -> Condition {
    Condition {
        text: String::new(),
        figure: "f".to_owned(),
        relation,
        value,
        unit: String::new(),
        written: WrittenUnit {
            name: String::new(),
            size: 1.0,
        },
        kept: false,
    }
}

fn goal(aim: Aim, is_parameter: bool) -> Goal {
    Goal {
        aim,
        of: String::new(),
        is_parameter,
        unit: String::new(),
    }
}

/// What is to be best; `None`: the parameter itself.
type Figure<'f> = Option<&'f dyn Fn(f64) -> f64>;

/// Searches 0 to 10 for `goal` (of the parameter: itself) where `figures` meet `conditions`.
fn find(
    conditions: &[Condition],
    aim: Option<(Aim, Figure<'_>)>,
    figures: &dyn Fn(f64) -> Result<Vec<f64>, State>,
) -> (FindResult, usize) {
    let span = Span::parse("a.b=0:10").unwrap();
    let looked = Cell::new(0);
    let at = |&share: &f64| {
        looked.set(looked.get() + 1);
        let value = span.value(share);
        let (figures, state) = match figures(value) {
            Ok(figures) => (figures.into_iter().map(Some).collect(), State::Computed),
            Err(state) => (vec![None; conditions.len()], state),
        };
        let goal = aim.map(|(_, of)| of.map_or(value, |of| of(value)));
        Sample {
            share,
            value,
            goal,
            figures,
            state,
        }
    };
    let wanted = aim.map(|(aim, of)| goal(aim, of.is_none()));
    let all = |shares: &[f64]| shares.iter().map(at).collect();
    let found = search(&span, conditions, wanted.as_ref(), &all);
    (found, looked.get())
}

#[test]
fn the_greatest_parameter_lies_at_its_condition() {
    // 50 − x² ≥ 0: x = √50, from the side on which it holds.
    let limit = [condition(Relation::AtLeast, 0.0)];
    let (found, looked) = find(&limit, Some((Aim::Maximize, None)), &|x| {
        Ok(vec![50.0 - x * x])
    });
    let best = found.best.unwrap();
    let root = 50f64.sqrt();
    assert!(
        best.sample.value <= root && root - best.sample.value <= 2e-6,
        "{best:?}"
    );
    assert_eq!(best.limit, Some(Limit::Conditions(vec![0])));
    assert!(best.beyond.unwrap().value > root);
    assert!(found.certain && found.complete);
    assert!(looked < 60, "{looked}");
}

#[test]
fn several_ranges_are_told_apart_and_the_least_place_is_that_of_the_first() {
    let limit = [condition(Relation::AtMost, 0.5)];
    let (found, _) = find(&limit, Some((Aim::Minimize, None)), &|x| Ok(vec![x.cos()]));
    // cos x ≤ 1/2 in [π/3, 5π/3] and [7π/3, 10].
    let third = std::f64::consts::FRAC_PI_3;
    let ends: Vec<[f64; 2]> = (found.ranges.iter())
        .map(|range| [range.from.sample.value, range.to.sample.value])
        .collect();
    let wanted = [[third, 5.0 * third], [7.0 * third, 10.0]];
    assert_eq!(ends.len(), 2);
    for (found, wanted) in ends.iter().flatten().zip(wanted.iter().flatten()) {
        assert!((found - wanted).abs() < 3e-6, "{ends:?}");
    }
    assert!((found.best.unwrap().sample.value - third).abs() < 3e-6);
    assert_eq!(found.ranges[1].to.limit, Limit::Range);
}

#[test]
fn a_narrow_gap_between_two_places_is_found_by_its_neighbours() {
    // Below zero between 4.9 and 5.1 alone; places are 0.3125 apart.
    let limit = [condition(Relation::AtLeast, 0.0)];
    let (found, _) = find(&limit, None, &|x| Ok(vec![(x - 5.05) * (x - 5.05) - 0.01]));
    assert_eq!(found.ranges.len(), 2);
    assert!((found.ranges[0].to.sample.value - 4.95).abs() < 1e-5);
    assert!((found.ranges[1].from.sample.value - 5.15).abs() < 1e-5);
}

#[test]
fn a_figure_is_least_at_its_own_minimum_or_at_a_condition() {
    let bowl = |x: f64| (x - 3.3).powi(2) + 1.0;
    let free = find(&[], Some((Aim::Minimize, Some(&bowl))), &|_| Ok(vec![]));
    let best = free.0.best.unwrap();
    assert!(
        (best.sample.value - 3.3).abs() < 1e-4 && best.limit.is_none(),
        "{best:?}"
    );
    let limit = [condition(Relation::AtLeast, 4.0)];
    let bound = find(&limit, Some((Aim::Minimize, Some(&bowl))), &|x| Ok(vec![x]));
    let best = bound.0.best.unwrap();
    assert!((best.sample.value - 4.0).abs() < 3e-6, "{best:?}");
    assert_eq!(best.limit, Some(Limit::Conditions(vec![0])));
}

#[test]
fn an_equality_is_met_at_roots_and_not_at_jumps() {
    let equal = [condition(Relation::Equal, 1.0)];
    let (found, _) = find(&equal, Some((Aim::Maximize, None)), &|x| {
        Ok(vec![if x < 8.0 { 0.25 * x } else { 0.0 }])
    });
    assert_eq!(found.ranges.len(), 1);
    let best = found.best.unwrap();
    assert!((best.sample.value - 4.0).abs() < 3e-6);
    assert_eq!(best.limit, Some(Limit::Equality(0)));
}

#[test]
fn stops_end_a_range_and_what_is_not_known_leaves_it_open() {
    let stops = |x: f64| match x > 7.7 {
        true => Err(State::Stopped("dead-centre position".to_owned())),
        false => Ok(vec![]),
    };
    let (found, _) = find(&[], Some((Aim::Maximize, None)), &stops);
    let best = found.best.unwrap();
    assert!((best.sample.value - 7.7).abs() < 3e-6 && found.certain);
    assert!(matches!(best.limit, Some(Limit::State(State::Stopped(_)))));
    let fails = |x: f64| match x > 7.7 {
        true => Err(State::NotTrusted("energies".to_owned())),
        false => Ok(vec![]),
    };
    let (found, _) = find(&[], Some((Aim::Maximize, None)), &fails);
    assert!(!found.certain);
    let (found, _) = find(&[], Some((Aim::Minimize, None)), &fails);
    assert!(found.certain && found.best.unwrap().sample.value == 0.0);
}

#[test]
fn nothing_is_found_where_nothing_holds() {
    let limit = [condition(Relation::AtLeast, 2.0)];
    let (found, _) = find(&limit, Some((Aim::Maximize, None)), &|x| Ok(vec![x.sin()]));
    assert!(found.best.is_none() && found.ranges.is_empty() && found.certain);
}

#[test]
fn an_end_from_outside_keeps_what_is_known() {
    let span = Span::parse("a.b=0:10").unwrap();
    let goal = goal(Aim::Maximize, true);
    let some = |shares: &[f64]| {
        let at = |&share: &f64| Sample {
            share,
            value: span.value(share),
            goal: Some(span.value(share)),
            figures: Vec::new(),
            state: State::Computed,
        };
        shares.iter().take(5).map(at).collect()
    };
    let found = search(&span, &[], Some(&goal), &some);
    assert!(!found.complete && found.samples.len() == 5);
    assert_eq!(found.best.unwrap().sample.value, 1.25);
    let found = search(&span, &[], Some(&goal), &|_| Vec::new());
    assert!(!found.complete && found.best.is_none());
}

#[test]
fn an_equality_that_holds_over_a_stretch_has_the_ends_of_the_stretch() {
    let equal = [condition(Relation::Equal, 0.0)];
    let flat = |x: f64| Ok(vec![(x - 6.3).max(0.0)]);
    let (found, _) = find(&equal, Some((Aim::Maximize, None)), &flat);
    let best = found.best.unwrap();
    assert!((best.sample.value - 6.3).abs() < 3e-6, "{best:?}");
    assert_eq!(found.ranges.len(), 1);
}

#[test]
fn a_pole_or_a_jump_is_no_extreme() {
    let pole = |x: f64| 1.0 / (x - 5.13);
    let jump = |x: f64| if x < 5.13 { x } else { x - 8.0 };
    let figures: [&dyn Fn(f64) -> f64; 2] = [&pole, &jump];
    for figure in figures {
        let (found, _) = find(&[], Some((Aim::Maximize, Some(figure))), &|_| Ok(vec![]));
        assert!(!found.certain, "{:?}", found.best);
        assert_eq!(found.best.unwrap().limit, Some(Limit::Abrupt));
    }
    // A kink is one.
    let kink = |x: f64| -(x - 5.13).abs();
    let (found, _) = find(&[], Some((Aim::Maximize, Some(&kink))), &|_| Ok(vec![]));
    assert!(found.certain && (found.best.unwrap().sample.value - 5.13).abs() < 1e-4);
}
