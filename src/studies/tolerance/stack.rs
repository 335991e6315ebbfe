//! The stack of tolerances: first order from derivatives, second order from one tolerance each.

use super::zone::Zone;
use serde::Serialize;

/// Share of the first-order effect of a dimension beyond which the rest counts as not linear.
const LINEAR: f64 = 0.1;

/// Share of all effects below which what is not linear does not count.
const NEGLIGIBLE: f64 = 1e-3;

/// Stack of first order about the middle of all tolerance zones.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FirstOrder {
    /// Result at the middle: its mean.
    pub mean: f64,
    /// Least and greatest result if all dimensions are at their limits: mean ± Σ|f_i|·t_i.
    pub worst_case: [f64; 2],
    /// Standard deviation: √Σ(f_i·σ_i)².
    pub sigma: f64,
    /// Share of each dimension in the variance: f_i²σ_i²/σ²; 0 where nothing varies.
    #[serde(skip)]
    pub contributions: Vec<f64>,
}

impl FirstOrder {
    /// The stack of a result: its value at the middle, its derivatives, the zones.
    pub fn of(middle: f64, derivatives: &[f64], zones: &[Zone]) -> Self {
        let each = || derivatives.iter().zip(zones);
        let reach: f64 = each().map(|(slope, zone)| slope.abs() * zone.half()).sum();
        let variances: Vec<f64> = each()
            .map(|(slope, zone)| (slope * zone.sigma()).powi(2))
            .collect();
        let variance: f64 = variances.iter().sum();
        let share = |own: &f64| if variance > 0.0 { own / variance } else { 0.0 };
        Self {
            mean: middle,
            worst_case: [middle - reach, middle + reach],
            sigma: variance.sqrt(),
            contributions: variances.iter().map(share).collect(),
        }
    }
}

/// Results with one dimension at its limits and all others in the middle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct AtLimits {
    /// At the lower limit; `None`: there is none.
    pub lower: Option<f64>,
    /// At the upper limit.
    pub upper: Option<f64>,
}

impl AtLimits {
    /// Second derivative by the dimension, from the result in the middle.
    pub fn curvature(&self, middle: f64, zone: &Zone) -> Option<f64> {
        Some((self.upper? - 2.0 * middle + self.lower?) / zone.half().powi(2))
    }

    /// Change of the result from the middle to a limit, the one that is farther from first
    /// order, with that of first order; `None`: there is no result.
    fn departure(&self, middle: f64, slope: f64, zone: &Zone) -> Option<NotLinear> {
        let step = slope * zone.half();
        let at = |value: Option<f64>, first_order: f64| {
            let change = value? - middle;
            Some(NotLinear {
                first_order,
                change,
            })
        };
        let both = [at(self.lower, -step)?, at(self.upper, step)?];
        let [lower, upper] = both;
        Some(if lower.rest() > upper.rest() {
            lower
        } else {
            upper
        })
    }
}

/// A dimension of which first order does not tell the effect.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct NotLinear {
    /// Change of the result from the middle to a limit, by the derivative.
    pub first_order: f64,
    /// The change itself.
    pub change: f64,
}

impl NotLinear {
    fn rest(&self) -> f64 {
        (self.change - self.first_order).abs()
    }
}

/// The dimensions of which first order does not tell the effect: the rest is more than a tenth
/// of it, and not negligible beside the effects of all.
pub(super) fn not_linear(
    middle: f64,
    derivatives: &[f64],
    limits: &[AtLimits],
    zones: &[Zone],
) -> Vec<Option<NotLinear>> {
    let each = derivatives.iter().zip(limits).zip(zones);
    let found: Vec<Option<NotLinear>> = each
        .map(|((slope, own), zone)| own.departure(middle, *slope, zone))
        .collect();
    let effect = |one: &NotLinear| one.change.abs().max(one.first_order.abs());
    let all: f64 = found.iter().flatten().map(effect).sum();
    let counts = |one: &NotLinear| {
        one.rest() > LINEAR * one.first_order.abs() && one.rest() > NEGLIGIBLE * all
    };
    found.into_iter().map(|one| one.filter(counts)).collect()
}

/// Mean shift of second order: ½Σf_ii·σ_i²; `None`: a second derivative is not known.
pub(super) fn mean_shift(middle: f64, limits: &[AtLimits], zones: &[Zone]) -> Option<f64> {
    let each = limits.iter().zip(zones);
    each.map(|(own, zone)| Some(0.5 * own.curvature(middle, zone)? * zone.sigma().powi(2)))
        .sum()
}

/// Where every dimension is for the least and for the greatest result, if each acts by itself:
/// −1 at the lower limit, 0 in the middle, 1 at the upper limit.
pub(super) fn corners(middle: f64, limits: &[AtLimits]) -> [Vec<f64>; 2] {
    let places = |own: &AtLimits| [(-1.0, own.lower), (0.0, Some(middle)), (1.0, own.upper)];
    let best = |sign: f64| {
        let at = |own: &AtLimits| {
            let known = places(own).into_iter();
            let known = known.filter_map(|(place, value)| Some((place, sign * value?)));
            known
                .max_by(|a, b| a.1.total_cmp(&b.1))
                .map_or(0.0, |best| best.0)
        };
        limits.iter().map(at).collect()
    };
    [best(-1.0), best(1.0)]
}

#[cfg(test)]
mod tests {
    use super::super::zone::{Distribution, Zone};
    use super::{AtLimits, FirstOrder, corners, mean_shift, not_linear};

    fn zones(halves: &[f64]) -> Vec<Zone> {
        let zone = |half: &f64| Zone {
            lower: -half,
            upper: *half,
            distribution: Distribution::Normal,
        };
        halves.iter().map(zone).collect()
    }

    /// Stroke of a slider-crank: the rod and the crank in line, outstretched and folded.
    fn stroke([crank, rod, offset]: [f64; 3]) -> f64 {
        let reach = |length: f64| (length * length - offset * offset).sqrt();
        reach(rod + crank) - reach(rod - crank)
    }

    fn at_limits(nominal: [f64; 3], halves: [f64; 3]) -> Vec<AtLimits> {
        let at = |index: usize, sign: f64| {
            let mut values = nominal;
            values[index] += sign * halves[index];
            Some(stroke(values))
        };
        let both = |index| AtLimits {
            lower: at(index, -1.0),
            upper: at(index, 1.0),
        };
        (0..3).map(both).collect()
    }

    fn assert_close(found: f64, wanted: f64, within: f64) {
        assert!(
            (found - wanted).abs() <= within * wanted.abs(),
            "{found} and {wanted}"
        );
    }

    /// `stroke_offset` of tests/reference/design-optimum-tolerance.json.
    #[test]
    fn the_stack_of_an_offset_slider_crank_is_that_of_the_reference() {
        let (nominal, halves) = ([0.05, 0.15, 0.02], [5e-5, 1e-4, 1e-4]);
        let derivatives = [
            2.0256585414188697,
            -0.015582910900445465,
            0.1036203637060103,
        ];
        let (middle, zones) = (stroke(nominal), zones(&halves));
        assert_close(middle, 0.10101789770999686, 1e-15);
        let found = FirstOrder::of(middle, &derivatives, &zones);
        let reach = found.worst_case[1] - found.mean;
        assert_close(reach, 0.00011320325453158906, 1e-12);
        assert_close(found.mean - found.worst_case[0], reach, 1e-12);
        assert_close(found.sigma, 0.000033941176868427704, 1e-12);
        assert_close(found.contributions.iter().sum(), 1.0, 1e-15);
        let own = (derivatives[0] * halves[0] / 3.0).powi(2) / found.sigma.powi(2);
        assert_close(found.contributions[0], own, 1e-13);
        let limits = at_limits(nominal, halves);
        let second = [0.37449915028071, 0.37449915028071, 5.5555173355812];
        for ((own, zone), wanted) in limits.iter().zip(&zones).zip(second) {
            // (Rounding: 10⁻¹⁷ of the stroke over the square of the tolerance.)
            assert_close(own.curvature(middle, zone).unwrap(), wanted, 1e-3 / wanted);
        }
        let shift = mean_shift(middle, &limits, &zones).unwrap();
        assert_close(shift, 3.3464673741289452e-9, 1e-4);
        assert_eq!(
            not_linear(middle, &derivatives, &limits, &zones),
            [None, None, None]
        );
        let extremes = corners(middle, &limits).map(|place| {
            stroke([0, 1, 2].map(|index| nominal[index] + place[index] * halves[index]))
        });
        assert_close(extremes[0], 0.10090475615989807, 1e-14);
        assert_close(extremes[1], 0.10113116297017316, 1e-14);
    }

    /// `stroke_in_line` of the same: the offset has no derivative, and adds 22.6 µm.
    #[test]
    fn an_offset_about_zero_is_not_linear() {
        let (nominal, halves) = ([0.05, 0.15, 0.0], [5e-5, 1e-4, 3e-3]);
        let (middle, zones) = (stroke(nominal), zones(&halves));
        let derivatives = [2.0, 0.0, 0.0];
        let found = FirstOrder::of(middle, &derivatives, &zones);
        assert_close(found.worst_case[1] - middle, 1e-4, 1e-12);
        assert_close(found.sigma, 3.3333333333333335e-5, 1e-12);
        let limits = at_limits(nominal, halves);
        let rest = not_linear(middle, &derivatives, &limits, &zones);
        assert_eq!(rest[..2], [None, None]);
        let offset = rest[2].unwrap();
        assert_eq!(offset.first_order, 0.0);
        assert!((offset.change - 22.5e-6).abs() < 0.1e-6, "{offset:?}");
        let shift = mean_shift(middle, &limits, &zones).unwrap();
        assert_close(shift, 2.5e-6, 1e-3);
        let places = corners(middle, &limits);
        assert_eq!([places[0][0], places[1][0], places[0][2]], [-1.0, 1.0, 0.0]);
        assert_eq!(places[1][2].abs(), 1.0);
    }

    #[test]
    fn a_dimension_without_a_result_at_a_limit_has_no_second_order() {
        let limits = [AtLimits {
            lower: None,
            upper: Some(2.0),
        }];
        assert_eq!(mean_shift(1.0, &limits, &zones(&[0.1])), None);
        assert_eq!(corners(1.0, &limits), [vec![0.0], vec![1.0]]);
        assert_eq!(not_linear(1.0, &[1.0], &limits, &zones(&[0.1])), [None]);
    }
}
