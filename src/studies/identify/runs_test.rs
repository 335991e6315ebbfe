//! Whether residuals are random.

use crate::math::probability::normal_share_below;
use serde::Serialize;

/// Probability below which residuals do not count as random.
pub const RANDOM: f64 = 0.01;

/// Test of the runs of equal signs (A. Wald and J. Wolfowitz, Annals of Mathematical Statistics
/// 11, 1940).
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct RunsTest {
    /// Runs that were counted.
    pub runs: usize,
    /// Runs that are expected of random residuals.
    pub expected: f64,
    /// Probability of a number of runs as far from that, or farther.
    pub probability: f64,
}

impl RunsTest {
    /// Of residuals in the order of time; `None`: all have one sign.
    pub fn of(residuals: &[f64]) -> Option<Self> {
        let signs: Vec<bool> = residuals
            .iter()
            .filter(|own| **own != 0.0)
            .map(|own| *own > 0.0)
            .collect();
        let above = signs.iter().filter(|own| **own).count() as f64;
        let below = signs.len() as f64 - above;
        if above == 0.0 || below == 0.0 {
            return None;
        }
        let runs = 1 + signs.windows(2).filter(|pair| pair[0] != pair[1]).count();
        let (all, product) = (above + below, 2.0 * above * below);
        let expected = 1.0 + product / all;
        let variance = product * (product - all) / (all * all * (all - 1.0));
        let probability = match variance > 0.0 {
            true => {
                let off = (runs as f64 - expected).abs() / variance.sqrt();
                2.0 * normal_share_below(-off)
            }
            false => 1.0,
        };
        Some(Self {
            runs,
            expected,
            probability,
        })
    }

    /// Whether the residuals are random as far as this test sees.
    pub fn is_random(&self) -> bool {
        self.probability >= RANDOM
    }
}
