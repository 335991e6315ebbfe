//! What a study of tolerances found, as data.

use super::indices::Indices;
use super::stack::{AtLimits, FirstOrder, NotLinear};
use super::statistics::{QUANTILES, Spread, Yield};
use super::task::{Dimension, Outcome};
use crate::studies::condition::Condition;
use crate::studies::gradient::unit_of;
use crate::studies::prepared::Verdict;
use serde::Serialize;
use serde_json::{Map, Value, json};

/// The tolerance of results.
#[derive(Clone, Debug, PartialEq)]
pub struct Tolerances {
    /// The dimensions.
    pub dimensions: Vec<Dimension>,
    /// The results.
    pub figures: Vec<FigureTolerance>,
    /// The limits, each by itself.
    pub limits: Vec<LimitYield>,
    /// Samples that meet all limits among all samples; `None`: there are none.
    pub of_all: Option<Yield>,
    /// The same among those that did not fail.
    pub of_run: Option<Yield>,
    /// Samples that failed, by their causes.
    pub failures: Vec<Failure>,
    /// The samples.
    pub samples: Vec<Outcome>,
    /// Their deviations from the nominal values, a row a sample.
    pub deviations: Vec<Vec<f64>>,
    /// Number of samples that were asked for.
    pub asked: usize,
    /// Seed of the samples.
    pub seed: u32,
    /// False: ended before the last sample.
    pub complete: bool,
    /// What is to be known of all results, a line each.
    pub remarks: Vec<String>,
}

/// The tolerance of a result.
#[derive(Clone, Debug, PartialEq)]
pub struct FigureTolerance {
    /// Address.
    pub figure: String,
    /// SI unit.
    pub unit: String,
    /// At the nominal values; `None`: there is none.
    pub nominal: Option<f64>,
    /// In the middle of all zones.
    pub middle: Option<f64>,
    /// The stack; `None`: a derivative is not known.
    pub first_order: Option<FirstOrder>,
    /// Mean shift of second order.
    pub mean_shift: Option<f64>,
    /// Results of runs with every dimension where it makes the result least and greatest.
    pub extremes: [Option<f64>; 2],
    /// Distribution over the samples.
    pub spread: Option<Spread>,
    /// The results of the samples that have it.
    pub values: Vec<f64>,
    /// Effects of the dimensions, in their order.
    pub effects: Vec<Effect>,
}

/// Effect of a dimension on a result.
#[derive(Clone, Debug, PartialEq)]
pub struct Effect {
    /// The derivative in the middle of the zones (SI).
    pub derivative: Option<f64>,
    /// Where it comes from.
    pub source: Option<SlopeSource>,
    /// Its estimated error; `None`: not known.
    pub error: Option<f64>,
    /// Share in the variance of first order.
    pub contribution: Option<f64>,
    /// Results at the limits of its zone.
    pub limits: AtLimits,
    /// What first order does not tell.
    pub not_linear: Option<NotLinear>,
    /// Sobol indices.
    pub indices: Option<Indices>,
}

/// Source of a derivative.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum SlopeSource {
    /// Carried with the motion: `dam gradient`.
    Exact,
    /// Differences of runs.
    Differences,
}

/// Samples that meet a limit.
#[derive(Clone, Debug, PartialEq)]
pub struct LimitYield {
    /// The limit.
    pub limit: Condition,
    /// The share that meets it by the stack of first order, if the result is normal.
    pub by_first_order: Option<f64>,
    /// The samples that meet it.
    pub found: Option<Yield>,
}

/// Samples that failed for one cause.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Failure {
    /// What became of them.
    pub verdict: Verdict,
    /// Why, of the first of them.
    pub cause: String,
    /// Number of samples.
    pub count: usize,
}

impl Tolerances {
    /// Whether all that was asked is known.
    pub fn is_answered(&self) -> bool {
        let known = |figure: &FigureTolerance| {
            figure.middle.is_some() && (self.asked == 0 || !figure.values.is_empty())
        };
        self.complete && self.figures.iter().all(known)
    }

    /// The JSON document. `scene`: its name.
    pub fn document(&self, scene: &str) -> Value {
        let figures = self.figures.iter();
        let figures: Map<String, Value> = figures
            .map(|figure| (figure.figure.clone(), self.of_figure(figure)))
            .collect();
        let limits = self.limits.iter().map(|one| {
            json!({
                "text": one.limit.text, "figure": one.limit.figure, "relation": one.limit.relation,
                "value": one.limit.value, "unit": one.limit.unit,
                "by_first_order": one.by_first_order, "yield": one.found,
            })
        });
        json!({
            "dam": 1, "scene": scene,
            "tolerances": self.dimensions.iter().map(dimension).collect::<Vec<_>>(),
            "figures": figures,
            "limits": limits.collect::<Vec<_>>(),
            "yield": self.of_all, "yield_without_failures": self.of_run,
            "failures": self.failures,
            "samples": self.samples.len(), "samples_requested": self.asked, "seed": self.seed,
            "complete": self.complete, "remarks": self.remarks,
        })
    }

    fn of_figure(&self, figure: &FigureTolerance) -> Value {
        let by = figure.effects.iter().zip(&self.dimensions);
        let by: Map<String, Value> = by
            .map(|(effect, dimension)| (dimension.name(), of_effect(figure, effect, dimension)))
            .collect();
        let quantiles = figure.spread.as_ref().map(|spread| {
            let each = QUANTILES.iter().zip(spread.quantiles);
            let one = |(share, value): (&f64, f64)| json!({ "share": share, "value": value });
            each.map(one).collect::<Vec<_>>()
        });
        let samples = figure.spread.as_ref().map(|spread| {
            json!({
                "count": spread.count, "mean": spread.mean, "sigma": spread.sigma,
                "skewness": spread.skewness, "least": spread.least, "greatest": spread.greatest,
                "quantiles": quantiles,
            })
        });
        json!({
            "unit": figure.unit, "nominal": figure.nominal, "middle": figure.middle,
            "first_order": figure.first_order, "mean_shift": figure.mean_shift,
            "worst_case_of_runs": figure.extremes, "distribution": samples, "by": by,
        })
    }
}

fn dimension(one: &Dimension) -> Value {
    json!({
        "paths": one.paths, "nominal": one.nominal, "unit": one.unit, "tolerance": one.tolerance,
        "lower": one.zone.lower, "upper": one.zone.upper, "distribution": one.zone.distribution,
        "sigma": one.zone.sigma(),
    })
}

fn of_effect(figure: &FigureTolerance, effect: &Effect, dimension: &Dimension) -> Value {
    let bound = |pick: fn(&Indices) -> Option<f64>| effect.indices.as_ref().and_then(pick);
    json!({
        "derivative": effect.derivative, "unit": unit_of(&figure.unit, &dimension.unit),
        "source": effect.source, "error": effect.error, "contribution": effect.contribution,
        "at_limits": effect.limits, "not_linear": effect.not_linear,
        "first_index": effect.indices.map(|own| own.first),
        "first_at_most": bound(|own| own.first.bound()),
        "total_index": effect.indices.map(|own| own.total),
        "total_at_most": bound(|own| own.total.bound()),
    })
}
