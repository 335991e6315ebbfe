//! The study on functions in closed form.

use super::{
    Dimension, Distribution, Figure, Outcome, SlopeSource, ToleranceTask, Tolerances, Zone,
    tolerances,
};
use crate::studies::condition::{Condition, Relation, WrittenUnit};
use crate::studies::prepared::Verdict;

fn limit(relation: Relation, value: f64) -> Condition {
    Condition {
        text: String::new(),
        figure: "stroke".to_owned(),
        relation,
        value,
        unit: "m".to_owned(),
        written: WrittenUnit {
            name: "m".to_owned(),
            size: 1.0,
        },
        kept: false,
    }
}

fn task(nominal: [f64; 3], halves: [f64; 3], (samples, seed): (usize, u32)) -> ToleranceTask {
    let each = nominal.into_iter().zip(halves).enumerate();
    let dimension = |(at, (nominal, half)): (usize, (f64, f64))| Dimension {
        paths: vec![["crank", "rod", "offset"][at].to_owned()],
        nominal: vec![nominal],
        unit: "m".to_owned(),
        tolerance: String::new(),
        zone: Zone {
            lower: -half,
            upper: half,
            distribution: Distribution::Normal,
        },
    };
    let stroke = stroke(nominal);
    ToleranceTask {
        dimensions: each.map(dimension).collect(),
        figures: vec![Figure {
            address: "stroke".to_owned(),
            unit: "m".to_owned(),
            counts: false,
            exact: vec![None; 3],
        }],
        limits: vec![
            limit(Relation::AtMost, stroke + 6e-5),
            limit(Relation::AtLeast, stroke - 6e-5),
        ],
        samples,
        seed,
    }
}

/// Stroke of a slider-crank: the rod and the crank in line, outstretched and folded.
fn stroke([crank, rod, offset]: [f64; 3]) -> f64 {
    let reach = |length: f64| (length * length - offset * offset).sqrt();
    reach(rod + crank) - reach(rod - crank)
}

fn answer(task: &ToleranceTask, assembled: impl Fn(&[f64; 3]) -> bool) -> Tolerances {
    let run = |row: &Vec<f64>| {
        let each = row.iter().zip(&task.dimensions);
        let values: Vec<f64> = each.map(|(own, one)| one.nominal[0] + own).collect();
        let values: [f64; 3] = values.try_into().unwrap();
        match assembled(&values) {
            true => Outcome {
                values: vec![Some(stroke(values))],
                verdict: Verdict::InWorkingOrder,
                cause: String::new(),
            },
            false => Outcome {
                values: vec![None],
                verdict: Verdict::Refused,
                cause: format!("cannot be assembled at {}", values[1]),
            },
        }
    };
    tolerances(task, &|rows| Some(rows.iter().map(run).collect())).unwrap()
}

const OFFSET: ([f64; 3], [f64; 3]) = ([0.05, 0.15, 0.02], [5e-5, 1e-4, 1e-4]);

fn assert_close(found: f64, wanted: f64, within: f64) {
    assert!(
        (found - wanted).abs() <= within * wanted.abs(),
        "{found} and {wanted}"
    );
}

/// `stroke_offset` of tests/reference/design-optimum-tolerance.json.
#[test]
fn an_offset_slider_crank_is_that_of_the_reference() {
    let found = answer(&task(OFFSET.0, OFFSET.1, (16384, 1)), |_| true);
    let figure = &found.figures[0];
    let stack = figure.first_order.as_ref().unwrap();
    let derivatives = [
        2.0256585414188697,
        -0.015582910900445465,
        0.1036203637060103,
    ];
    for (effect, wanted) in figure.effects.iter().zip(derivatives) {
        let off = (effect.derivative.unwrap() - wanted).abs();
        assert!(
            off < 1e-11 && off < effect.error.unwrap(),
            "{effect:?} {wanted}"
        );
        assert_eq!(effect.source, Some(SlopeSource::Differences));
        assert_eq!(effect.not_linear, None);
    }
    assert_close(
        stack.worst_case[1] - stack.mean,
        0.00011320325453158906,
        1e-10,
    );
    assert_close(stack.sigma, 0.000033941176868427704, 1e-11);
    assert_close(figure.mean_shift.unwrap(), 3.3464673741289452e-9, 1e-3);
    assert_close(figure.extremes[0].unwrap(), 0.10090475615989807, 1e-14);
    assert_close(figure.extremes[1].unwrap(), 0.10113116297017316, 1e-14);
    let spread = figure.spread.as_ref().unwrap();
    assert_close(spread.mean.value, 0.101017901056466, 1e-8);
    assert_close(spread.sigma, 3.394117897086e-5, 1e-3);
    let indices = figure.effects.iter().map(|effect| effect.indices.unwrap());
    let first = [0.98940971371, 0.00023420940779, 0.010356072159];
    let total = [0.98940971563, 0.00023421227649, 0.010356076826];
    for (at, own) in indices.enumerate() {
        assert!((own.first.value - first[at]).abs() < 3e-3, "{own:?}");
        assert_close(own.total.value, total[at], 5e-3);
    }
    let found = found.of_all.unwrap();
    assert_eq!(found.samples, 16384);
    let within = found.share.within;
    assert!(
        within[0] < 0.9228996609 && 0.9228996609 < within[1],
        "{found:?}"
    );
    assert!((found.share.value - 0.9228996609).abs() < 2e-3, "{found:?}");
}

/// `stroke_in_line` of the same.
#[test]
fn an_in_line_slider_crank_is_not_linear_in_its_offset() {
    let found = answer(
        &task([0.05, 0.15, 0.0], [5e-5, 1e-4, 3e-3], (16384, 1)),
        |_| true,
    );
    let figure = &found.figures[0];
    let rest = figure.effects[2].not_linear.unwrap();
    assert!(
        (rest.change - 22.5e-6).abs() < 0.1e-6 && rest.first_order.abs() < 1e-12,
        "{rest:?}"
    );
    assert_eq!([0, 1].map(|at| figure.effects[at].not_linear), [None, None]);
    assert_close(figure.extremes[0].unwrap(), 0.0999, 1e-14);
    assert_close(figure.extremes[1].unwrap(), 0.10012257088357092, 1e-14);
    let spread = figure.spread.as_ref().unwrap();
    assert_close(spread.mean.value, 0.100002500328824, 1e-7);
    assert_close(spread.sigma, 3.352144312639e-5, 1e-3);
    let share = found.of_all.unwrap().share;
    assert!(
        share.within[0] < 0.9257262644 && 0.9257262644 < share.within[1],
        "{share:?}"
    );
    let rod = figure.effects[1].indices.unwrap();
    assert!(
        rod.first.bound().is_some_and(|bound| bound < 1e-3),
        "{rod:?}"
    );
}

#[test]
fn the_yield_is_within_its_interval_for_95_of_100_seeds() {
    let mut held = [0; 2];
    for seed in 0..100 {
        let found = answer(&task(OFFSET.0, OFFSET.1, (512, seed)), |_| true);
        let within = found.of_all.unwrap().share.within;
        held[0] += u32::from(within[0] <= 0.9228996609 && 0.9228996609 <= within[1]);
        let mean = found.figures[0].spread.as_ref().unwrap().mean.within;
        held[1] += u32::from(mean[0] <= 0.101017901056466 && 0.101017901056466 <= mean[1]);
    }
    assert!(held.iter().all(|count| *count >= 95), "{held:?}");
}

#[test]
fn samples_that_cannot_be_assembled_are_failures_with_their_cause() {
    let found = answer(&task(OFFSET.0, OFFSET.1, (1000, 1)), |values| {
        values[1] < 0.15006
    });
    // 1 − Φ(1.8) of a rod of σ = 1/30 mm.
    assert_eq!(found.failures.len(), 1);
    let failure = &found.failures[0];
    assert!(
        (failure.count as f64 / 1000.0 - 0.0359).abs() < 5e-3,
        "{failure:?}"
    );
    assert_eq!(failure.verdict, Verdict::Refused);
    assert!(
        failure.cause.starts_with("cannot be assembled at 0.1500"),
        "{failure:?}"
    );
    let (all, run) = (found.of_all.unwrap(), found.of_run.unwrap());
    assert_eq!((all.samples, run.samples), (1000, 1000 - failure.count));
    assert_eq!(all.good, run.good);
    let spread = found.figures[0].spread.as_ref().unwrap();
    assert_eq!(spread.count, run.samples);
    // At the upper limit of the rod there is no result, and nothing of second order.
    assert_eq!(found.figures[0].effects[1].limits.upper, None);
    assert_eq!(found.figures[0].mean_shift, None);
    assert!(found.figures[0].first_order.is_some());
}

#[test]
fn zones_that_are_not_about_the_nominal_value_have_their_mean_in_the_middle() {
    let mut task = task(OFFSET.0, OFFSET.1, (2048, 1));
    task.dimensions[0].zone.upper = 0.0;
    let found = answer(&task, |_| true);
    let figure = &found.figures[0];
    assert_close(figure.nominal.unwrap(), stroke(OFFSET.0), 1e-15);
    assert_close(
        figure.middle.unwrap(),
        stroke([0.05 - 2.5e-5, 0.15, 0.02]),
        1e-15,
    );
    let mean = figure.spread.as_ref().unwrap().mean;
    assert!(
        (mean.value - figure.middle.unwrap()).abs() < 2e-8,
        "{mean:?}"
    );
    assert_eq!(figure.effects[0].limits.upper, figure.nominal);
}

#[test]
fn a_study_that_is_ended_keeps_its_samples() {
    let task = task(OFFSET.0, OFFSET.1, (4096, 1));
    let whole = answer(&task, |_| true);
    let batches = std::cell::Cell::new(0);
    let ended = |rows: &[Vec<f64>]| {
        batches.set(batches.get() + 1);
        let run = |row: &Vec<f64>| Outcome {
            values: vec![Some(stroke([0, 1, 2].map(|at| OFFSET.0[at] + row[at])))],
            verdict: Verdict::InWorkingOrder,
            cause: String::new(),
        };
        (batches.get() <= 4).then(|| rows.iter().map(run).collect())
    };
    let found = tolerances(&task, &ended).unwrap();
    assert!(!found.complete && !found.is_answered());
    assert!(!found.samples.is_empty() && found.samples.len() < 4096);
    assert_eq!(found.samples[..], whole.samples[..found.samples.len()]);
    assert_eq!(found.deviations.len(), found.samples.len());
    assert!(tolerances(&task, &|_| None).is_err());
}
