//! How far do the figures move under a tiny change of what should not matter?

use super::run::{RunResult, run};
use super::settings::{Control, RunSettings};
use crate::dynamics::integrate::Method;
use crate::dynamics::model::{LinkBase, Model};
use crate::dynamics::system::System;
use crate::fault::Fault;
use serde::Serialize;

/// Relative change of all loads and gaps.
pub const CHANGE: f64 = 1e-10;

/// A figure that moves by more than this share of its scale is not determined
/// to the digits that are printed.
pub const DETERMINED: f64 = 1e-7;

/// The spread of all figures.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Spread {
    /// Relative change of loads and gaps in the first repetition.
    pub change: f64,
    /// Factor on the tolerance (on the step of a fixed-step method) in the second.
    pub tolerance_factor: f64,
    /// Figures by address, one entry each.
    pub figures: Vec<FigureSpread>,
}

/// The spread of one figure.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FigureSpread {
    /// Address.
    pub figure: String,
    /// Value in the run itself.
    pub value: f64,
    /// Scale that a difference is measured against (see
    /// [`crate::dynamics::record::Figures::common_scale`]).
    pub scale: f64,
    /// Difference when loads and gaps change; null: the figure is gone.
    pub by_loads: Option<f64>,
    /// Difference when the tolerance is halved.
    pub by_tolerance: Option<f64>,
    /// True when neither moves it by more than 1e-7 of its scale.
    pub determined: bool,
}

impl Spread {
    /// Figures that are not determined to the printed digits.
    pub fn undetermined(&self) -> impl Iterator<Item = &FigureSpread> {
        self.figures.iter().filter(|figure| !figure.determined)
    }
}

/// Repeats a run twice, with all loads and gaps changed by one part in 10¹⁰
/// and with the tolerance halved, by the same method, and reports how far each
/// figure moves.
///
/// # Errors
/// The changed system cannot be built or started.
pub fn repeat_with_changes(
    system: &System,
    settings: &RunSettings,
    base: &RunResult,
    control: &Control<'_>,
) -> Result<Spread, Vec<Fault>> {
    let finer;
    let base = match settings.of_accuracy {
        // What the integration of such a run leaves open is told by its accuracy.
        Some(_) if settings.method.is_none() => {
            let own = RunSettings {
                of_accuracy: None,
                ..settings.clone()
            };
            finer = run(system, &own, control, &mut [])?;
            &finer
        }
        _ => base,
    };
    let same_method = RunSettings {
        method: Some(base.method),
        tolerance: base.tolerance,
        ..settings.clone()
    };
    let mut closer = same_method.clone();
    if base.method == Method::Rk4 {
        closer.step = closer.step.map(|step| 0.5 * step);
    }
    closer.tolerance *= 0.5;
    let changed = System::new(with_scaled_loads(system.model().clone(), 1.0 + CHANGE))?;
    let by_loads = run(&changed, &same_method, control, &mut [])?;
    let by_tolerance = run(system, &closer, control, &mut [])?;
    Ok(Spread {
        change: CHANGE,
        tolerance_factor: 0.5,
        figures: differences(base, &by_loads, &by_tolerance),
    })
}

fn differences(base: &RunResult, loads: &RunResult, tolerance: &RunResult) -> Vec<FigureSpread> {
    let others = [loads.figures.addresses(), tolerance.figures.addresses()];
    base.figures
        .addresses()
        .into_iter()
        .filter(|(figure, _)| is_result(figure))
        .filter_map(|(figure, value)| {
            let value = value?;
            // Relative to a zero, or to rounding, nothing is known.
            let scale = [loads, tolerance]
                .map(|other| base.figures.common_scale(&other.figures, &figure))
                .into_iter()
                .fold(0.0, f64::max);
            let [by_loads, by_tolerance] = others
                .each_ref()
                .map(|other| Some((other.get(&figure).copied().flatten()? - value).abs()));
            let small = |moved: Option<f64>| moved.is_some_and(|moved| moved <= DETERMINED * scale);
            Some(FigureSpread {
                determined: small(by_loads) && small(by_tolerance),
                figure,
                value,
                scale,
                by_loads,
                by_tolerance,
            })
        })
        .collect()
}

/// Figures of the mechanism, not of the computation.
pub(super) fn is_result(figure: &str) -> bool {
    let of_run = figure.starts_with("run.");
    matches!(figure, "run.time" | "run.switches" | "run.complete")
        || !(of_run || figure.contains(".switch_times."))
}

/// The model with all loads, gaps and places of stops multiplied by `factor`.
pub(super) fn with_scaled_loads(mut model: Model, factor: f64) -> Model {
    for load in &mut model.loads {
        load.law.scale(factor);
    }
    for link in &mut model.links {
        if let LinkBase::Law { pair } = &mut link.base {
            pair.gap *= factor;
        }
    }
    model
}

#[cfg(test)]
mod tests {
    use super::{differences, with_scaled_loads};
    use crate::dynamics::model::{Load, LoadLaw, Model};
    use crate::studies::testing::result_with;

    #[test]
    fn a_figure_that_moves_too_far_either_way_is_marked() {
        let with = |delta_max: f64, sigma: f64| {
            result_with(|rocker| {
                (rocker.delta_max, rocker.delta_abs) = (delta_max, delta_max);
                rocker.sigma = sigma;
            })
        };
        let base = with(1.0, 0.5);
        let figures = differences(&base, &with(1.0 + 5e-8, 0.5), &with(1.0, 0.5 + 2e-7));
        let of = |name: &str| figures.iter().find(|entry| entry.figure == name).unwrap();
        assert!(of("rocker.delta_max").determined);
        assert!(!of("rocker.sigma").determined);
        approx::assert_relative_eq!(
            of("rocker.sigma").by_tolerance.unwrap(),
            2e-7,
            max_relative = 1e-8
        );
        assert!(figures.iter().all(|entry| entry.figure != "run.steps"));
    }

    #[test]
    fn every_load_is_changed_in_proportion() {
        let model = Model {
            loads: vec![
                Load {
                    node: 0,
                    name: "a".to_owned(),
                    law: LoadLaw::constant(-600.0),
                },
                Load {
                    node: 0,
                    name: "b".to_owned(),
                    law: LoadLaw::spring(4.0, 8.0),
                },
            ],
            ..Model::default()
        };
        let changed = with_scaled_loads(model, 1.5);
        let force = changed.loads[0].law.as_constant().expect("the law stays");
        let LoadLaw::Linear(spring) = changed.loads[1].law else {
            panic!("the law stays");
        };
        assert_eq!((force, spring.rate, spring.force), (-900.0, 6.0, -12.0));
    }
}
