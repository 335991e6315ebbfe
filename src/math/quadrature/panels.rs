//! Integrals of several functions at once that may jump, such as forces where
//! friction changes its direction.
//!
//! Gauss's rule of three places, widened to seven by Kronrod: both ends of a
//! panel are left out, so that a jump there does no harm, and the difference of
//! the two rules tells of one within, which is then closed in by halving.

use super::kronrod::SEVEN;

/// Halvings of a panel at most: a jump is closed in to rounding.
const DEEPEST: u32 = 46;

/// Integrals over panels, summed up.
#[derive(Debug)]
pub(crate) struct Integrals {
    /// The integrals so far.
    pub(crate) sums: Vec<f64>,
    /// Error of each that a panel may have.
    bounds: Vec<f64>,
    /// Evaluations left; when they are used up nothing is halved any more.
    left: usize,
    values: Vec<f64>,
    fine: Vec<f64>,
    coarse: Vec<f64>,
}

impl Integrals {
    /// As many integrals as there are bounds, none summed up yet.
    pub(crate) fn new(bounds: Vec<f64>, evaluations: usize) -> Self {
        let zeros = vec![0.0; bounds.len()];
        Self {
            sums: zeros.clone(),
            values: zeros.clone(),
            fine: zeros.clone(),
            coarse: zeros,
            bounds,
            left: evaluations,
        }
    }

    /// Adds the integrals over a panel of `f`, which writes the values at a
    /// place; `None` where it has none.
    pub(crate) fn add(
        &mut self,
        [from, to]: [f64; 2],
        mut f: impl FnMut(f64, &mut [f64]) -> Option<()>,
    ) -> Option<()> {
        let mut panels = vec![([from, to], 0)];
        while let Some(([from, to], depth)) = panels.pop() {
            self.rule([from, to], &mut f)?;
            let middle = 0.5 * (from + to);
            if depth < DEEPEST && self.left > 0 && !self.is_fine() {
                panels.push(([middle, to], depth + 1));
                panels.push(([from, middle], depth + 1));
            } else {
                for (sum, part) in self.sums.iter_mut().zip(&self.fine) {
                    *sum += part;
                }
            }
        }
        Some(())
    }

    /// Both rules agree in all integrals.
    fn is_fine(&self) -> bool {
        let rules = self.fine.iter().zip(&self.coarse);
        let mut rules = rules.zip(&self.bounds);
        rules.all(|((fine, coarse), bound)| (fine - coarse).abs() <= *bound)
    }

    /// Both rules over a panel.
    fn rule(
        &mut self,
        [from, to]: [f64; 2],
        f: &mut impl FnMut(f64, &mut [f64]) -> Option<()>,
    ) -> Option<()> {
        let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
        self.fine.fill(0.0);
        self.coarse.fill(0.0);
        for (index, node) in SEVEN.iter().enumerate() {
            for side in if index == 0 { &[1.0][..] } else { &[-1.0, 1.0] } {
                f(middle + side * node.place * half, &mut self.values)?;
                self.left = self.left.saturating_sub(1);
                for (k, value) in self.values.iter().enumerate() {
                    self.fine[k] += half * node.kronrod * value;
                    self.coarse[k] += half * node.gauss * value;
                }
            }
        }
        Some(())
    }
}

#[cfg(test)]
mod tests {
    use super::Integrals;

    #[test]
    fn polynomials_and_jumps_have_their_closed_forms() {
        let mut smooth = Integrals::new(vec![1e-3; 2], 1000);
        let powers = |x: f64, out: &mut [f64]| {
            out.copy_from_slice(&[x.powi(11), x.powi(10)]);
            Some(())
        };
        smooth.add([0.0, 2.0], powers).unwrap();
        approx::assert_relative_eq!(smooth.sums[0], 2f64.powi(12) / 12.0, max_relative = 1e-14);
        approx::assert_relative_eq!(smooth.sums[1], 2f64.powi(11) / 11.0, max_relative = 1e-14);
        let mut jumping = Integrals::new(vec![1e-13], 10_000);
        let step = |x: f64, out: &mut [f64]| {
            out[0] = if x < 1.0 / 3.0 { 1.0 } else { -x };
            Some(())
        };
        jumping.add([0.0, 1.0], step).unwrap();
        approx::assert_relative_eq!(jumping.sums[0], 1.0 / 3.0 - 4.0 / 9.0, epsilon = 1e-12);
        let nowhere = |_: f64, _: &mut [f64]| None;
        assert!(jumping.add([0.0, 1.0], nowhere).is_none());
    }

    #[test]
    fn evaluations_are_limited() {
        let mut rough = Integrals::new(vec![0.0], 500);
        let mut count = 0;
        rough
            .add([0.0, 1.0], |x, out| {
                count += 1;
                out[0] = (1e9 * x).sin();
                Some(())
            })
            .unwrap();
        assert!(count < 1000, "{count}");
    }
}
