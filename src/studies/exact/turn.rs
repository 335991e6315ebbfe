//! Bounds over the parts of a turn of what repeats itself.

/// Parts of a turn.
pub(super) const PARTS: u32 = 64;

/// Rounding of an instant, in parts.
const ROUNDING: f64 = 1e-6;

/// Bounds of several magnitudes that have one period.
#[derive(Clone, Debug)]
pub(super) struct Turn {
    /// The period (s); 0 where nothing changes.
    period: f64,
    /// By part, then by magnitude.
    of_parts: Vec<Vec<f64>>,
    /// By magnitude.
    of_all: Vec<f64>,
}

impl Turn {
    /// Nothing known of `count` magnitudes yet: they are at most 0.
    pub(super) fn new(period: f64, count: usize) -> Self {
        Self {
            period,
            of_parts: vec![vec![0.0; count]; PARTS as usize],
            of_all: vec![0.0; count],
        }
    }

    /// Start and end of a part of the first turn (s).
    pub(super) fn span(&self, part: u32) -> [f64; 2] {
        [part, part + 1].map(|k| self.period * f64::from(k) / f64::from(PARTS))
    }

    /// Sets the bounds in a part.
    pub(super) fn set(&mut self, part: u32, bounds: impl Iterator<Item = f64>) {
        let own = &mut self.of_parts[part as usize];
        for ((own, all), bound) in own.iter_mut().zip(&mut self.of_all).zip(bounds) {
            (*own, *all) = (bound, all.max(bound));
        }
    }

    /// What the greatest of a sum of the magnitudes with these weights is at most, between
    /// two instants of any turn.
    pub(super) fn greatest(
        &self,
        [from, to]: [f64; 2],
        weights: impl Iterator<Item = f64> + Clone,
    ) -> f64 {
        let sum = |bounds: &[f64]| -> f64 {
            let terms = bounds.iter().zip(weights.clone());
            terms.map(|(bound, weight)| bound * weight).sum()
        };
        let parts = f64::from(PARTS);
        let length = (to - from) / self.period * parts;
        // (Without a period that is no number.)
        if !(length < 0.5 * parts) {
            return sum(&self.of_all);
        }
        let start = (from / self.period).fract() * parts - ROUNDING;
        let last = (start + length + 2.0 * ROUNDING).floor();
        let (mut part, mut greatest) = (start.floor(), 0.0f64);
        while part <= last {
            let index = part.rem_euclid(parts) as usize;
            greatest = greatest.max(sum(&self.of_parts[index]));
            part += 1.0;
        }
        greatest
    }
}

#[cfg(test)]
mod tests {
    use super::{PARTS, Turn};

    /// Bounds k + 1 and 1 in the part k of a turn of 2 s.
    fn turn() -> Turn {
        let mut turn = Turn::new(2.0, 2);
        for part in 0..PARTS {
            turn.set(part, [f64::from(part + 1), 1.0].into_iter());
        }
        turn
    }

    #[test]
    fn a_stretch_is_bounded_by_the_parts_that_it_meets() {
        let (turn, part) = (turn(), 2.0 / f64::from(PARTS));
        let greatest = |from: f64, to: f64, weights: [f64; 2]| {
            turn.greatest([from * part, to * part], weights.into_iter())
        };
        assert_eq!(greatest(3.25, 3.5, [1.0, 0.0]), 4.0);
        assert_eq!(greatest(3.25, 5.5, [1.0, 10.0]), 16.0);
        // In a later turn, over the end of one, and where a part begins.
        assert_eq!(
            greatest(64.0 * 7.0 + 3.25, 64.0 * 7.0 + 4.5, [1.0, 0.0]),
            5.0
        );
        assert_eq!(greatest(63.5, 65.5, [1.0, 0.0]), 64.0);
        assert_eq!(greatest(3.0, 3.5, [1.0, 0.0]), 4.0);
        assert_eq!(greatest(128.0, 128.5, [1.0, 0.0]), 64.0);
        // Longer than half a turn: all of it.
        assert_eq!(greatest(1.0, 34.0, [1.0, 0.0]), 64.0);
    }

    #[test]
    fn what_never_changes_is_bounded_by_itself() {
        let mut turn = Turn::new(0.0, 1);
        (0..PARTS).for_each(|part| turn.set(part, [3.0].into_iter()));
        assert_eq!(turn.greatest([0.1, 0.2], [2.0].into_iter()), 6.0);
        assert_eq!(turn.greatest([0.1, 0.1], [2.0].into_iter()), 6.0);
    }
}
