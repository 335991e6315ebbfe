//! Something that changes slowly, as a polynomial over a short stretch.

/// Nodes of a stretch.
pub(super) const NODES: usize = 5;

/// A polynomial through the values at equally spaced nodes of [0, 1], ends included.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Smooth {
    /// Newton's divided differences.
    differences: [f64; NODES],
    least: f64,
    most: f64,
    /// Fourth power of a rate r, by the stretch, with |f⁽ᵏ⁾| ≤ rᵏ·[`Self::magnitude_bound`] for all k.
    rate4: f64,
}

/// The nodes.
pub(super) const fn node(k: usize) -> f64 {
    k as f64 / (NODES - 1) as f64
}

impl Smooth {
    pub(super) fn new(values: [f64; NODES]) -> Self {
        let mut differences = values;
        for order in 1..NODES {
            for k in (order..NODES).rev() {
                let width = node(k) - node(k - order);
                differences[k] = (differences[k] - differences[k - 1]) / width;
            }
        }
        let mut own = Self {
            differences,
            least: values.into_iter().fold(f64::INFINITY, f64::min),
            most: values.into_iter().fold(f64::NEG_INFINITY, f64::max),
            rate4: 0.0,
        };
        own.rate4 = own.find_rate4();
        own
    }

    /// Value and slope.
    pub(super) fn at(&self, share: f64) -> [f64; 2] {
        let (mut value, mut slope) = (self.differences[NODES - 1], 0.0);
        for k in (0..NODES - 1).rev() {
            slope = slope * (share - node(k)) + value;
            value = value * (share - node(k)) + self.differences[k];
        }
        [value, slope]
    }

    /// Coefficients of its powers, the constant first.
    fn coefficients(&self) -> [f64; NODES] {
        let mut found = [0.0; NODES];
        for k in (0..NODES).rev() {
            for j in (1..NODES).rev() {
                found[j] = found[j - 1] - node(k) * found[j];
            }
            found[0] = self.differences[k] - node(k) * found[0];
        }
        found
    }

    /// Magnitude of its fourth derivative, by the stretch.
    pub(super) fn greatest_fourth_derivative(&self) -> f64 {
        24.0 * self.differences[NODES - 1].abs()
    }

    /// Fourth power of a rate r, by the stretch, with |f⁽ᵏ⁾| ≤ rᵏ·[`Self::magnitude_bound`] for all k.
    pub(super) fn rate4(&self) -> f64 {
        self.rate4
    }

    fn find_rate4(&self) -> f64 {
        let most = self.magnitude_bound();
        if most == 0.0 {
            return 0.0;
        }
        let [_, c1, c2, c3, c4] = self.coefficients().map(f64::abs);
        let first = (c1 + 2.0 * c2 + 3.0 * c3 + 4.0 * c4) / most;
        let second = (2.0 * c2 + 6.0 * c3 + 12.0 * c4) / most;
        let third = (6.0 * c3 + 24.0 * c4) / most;
        let fourth = 24.0 * c4 / most;
        (first.powi(4).max(second.powi(2))).max(third.powf(4.0 / 3.0).max(fourth))
    }

    /// A bound on its magnitude: between five nodes it rises by no more than its range
    /// there (a parabola by an eighth of it).
    pub(super) fn magnitude_bound(&self) -> f64 {
        self.most.max(-self.least) + (self.most - self.least)
    }
}

#[cfg(test)]
mod tests {
    use super::{NODES, Smooth, node};

    #[test]
    fn a_quartic_is_followed_with_its_slope() {
        let f = |s: f64| 2.0 - s + 3.0 * s.powi(2) - s.powi(4);
        let smooth = Smooth::new(std::array::from_fn(|k| f(node(k))));
        for k in 0..=20 {
            let s = f64::from(k) / 20.0;
            let [value, slope] = smooth.at(s);
            approx::assert_abs_diff_eq!(value, f(s), epsilon = 1e-14);
            let expected = -1.0 + 6.0 * s - 4.0 * s.powi(3);
            approx::assert_abs_diff_eq!(slope, expected, epsilon = 1e-13);
            assert!(value.abs() <= smooth.magnitude_bound());
            let rate = smooth.rate4().powf(0.25);
            let higher = [slope, -12.0 * s * s, -24.0 * s, -24.0];
            for (k, derivative) in (1..).zip(higher) {
                let bound = rate.powi(k) * smooth.magnitude_bound();
                assert!(f64::abs(derivative) <= bound * (1.0 + 1e-12));
            }
        }
        approx::assert_abs_diff_eq!(smooth.greatest_fourth_derivative(), 24.0, epsilon = 1e-11);
        assert_eq!(Smooth::new([0.0; NODES]).magnitude_bound(), 0.0);
    }
}
