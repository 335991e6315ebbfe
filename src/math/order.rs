//! Orders to sort by.
//!
//! A sort is compiled anew for every comparison and every type that it moves. What is
//! sorted seldom is sorted by a key of its own (`sort_by_cached_key`, which is stable):
//! there is then one sort for each type of key, whatever it is the key of.

use std::cmp::Ordering;

/// A number as a key, ordered by [`f64::total_cmp`]; `Total(-x)` orders the other way.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Total(pub(crate) f64);

impl Ord for Total {
    fn cmp(&self, other: &Self) -> Ordering {
        self.0.total_cmp(&other.0)
    }
}

impl PartialOrd for Total {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Total {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Total {}

/// Sorts pairs by their first number, without allocating for a few; equal ones keep their order.
pub(crate) fn by_first(pairs: &mut [(f64, f64)]) {
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
}

#[cfg(test)]
mod tests {
    use super::{Total, by_first};

    #[test]
    fn keys_order_as_numbers_do_and_negated_ones_the_other_way() {
        let numbers = [f64::NAN, 2.0, -0.0, f64::NEG_INFINITY, 0.0, -1.5];
        let (mut rising, mut falling) = (numbers, numbers);
        rising.sort_by_cached_key(|&x| Total(x));
        falling.sort_by_cached_key(|&x| Total(-x));
        let mut expected = numbers;
        expected.sort_by(f64::total_cmp);
        let bits = |list: [f64; 6]| list.map(f64::to_bits);
        assert_eq!(bits(rising), bits(expected));
        expected.reverse();
        assert_eq!(bits(falling), bits(expected));
    }

    #[test]
    fn pairs_with_equal_first_numbers_keep_their_order() {
        let mut pairs = [(2.0, 0.0), (1.0, 1.0), (2.0, -1.0), (1.0, 0.0)];
        by_first(&mut pairs);
        assert_eq!(pairs, [(1.0, 1.0), (1.0, 0.0), (2.0, 0.0), (2.0, -1.0)]);
    }
}
