//! A torque over speed: straight between points, constant outside.

use crate::dynamics::load::{Force, LoadFunction};

/// Points (speed, torque), the speeds ascending.
#[derive(Clone, Debug)]
pub(crate) struct SpeedTable(pub(crate) Vec<(f64, f64)>);

impl LoadFunction for SpeedTable {
    fn force(&self, _: f64, speed: f64) -> Force {
        let points = &self.0;
        let above = points.partition_point(|point| point.0 <= speed);
        let (value, by_speed) = match (above.checked_sub(1).map(|i| points[i]), points.get(above)) {
            (Some((low, from)), Some(&(high, to))) => {
                let slope = (to - from) / (high - low);
                (from + slope * (speed - low), slope)
            }
            (Some((_, torque)), None) | (None, Some(&(_, torque))) => (torque, 0.0),
            (None, None) => (0.0, 0.0),
        };
        Force {
            value,
            by_displacement: 0.0,
            by_speed,
        }
    }

    fn magnitude(&self) -> f64 {
        self.0.iter().map(|point| point.1.abs()).fold(0.0, f64::max)
    }

    fn needs_displacement(&self) -> bool {
        false
    }

    fn description(&self) -> String {
        format!("table over speed, {} points", self.0.len())
    }

    fn running_speed(&self) -> Option<f64> {
        Some(self.0.iter().map(|point| point.0.abs()).fold(0.0, f64::max))
    }

    fn corners(&self) -> &[(f64, f64)] {
        &self.0
    }

    fn why_not_linear(&self) -> &'static str {
        "is a motor's torque over its speed"
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slopes_agree_with_differences() {
        let table = SpeedTable(vec![(0.5, 10.0), (50.0, 8.0), (104.0001, 0.0)]);
        let step = 1e-5;
        for speed in [-12.0, -0.3, 0.0, 2.2, 90.0, 104.0, 130.0] {
            let ends = [speed + step, speed - step].map(|speed| table.force(0.0, speed).value);
            let difference = (ends[0] - ends[1]) / (2.0 * step);
            approx::assert_abs_diff_eq!(
                table.force(0.0, speed).by_speed,
                difference,
                epsilon = 1e-6
            );
        }
    }
}
