//! What grows without bound towards a place, told by its values ever nearer to it.

/// Part of a course by which it may end before a dead position that ends the reach.
pub(super) const ROOM: f64 = 2e-6;
/// Growth over a tenth of the distance that has no end: by 10 where it goes with the
/// distance, by 3 with its root; by 1 where it ends.
const GROWTH: f64 = 2.0;
/// Powers of ten of the distance over which growth is looked at.
const DECADES: [i32; 4] = [-3, -4, -5, -6];

/// Places ever nearer to an end, on the side of a free place.
pub(super) fn approach(end: f64, free: f64) -> [f64; 4] {
    DECADES.map(|decade| end + 10f64.powi(decade) * (free - end))
}

/// True where values taken at these places grow all the way.
pub(super) fn grow(values: &[f64]) -> bool {
    values.windows(2).all(|pair| pair[1] > GROWTH * pair[0])
}

/// True where values taken at these places grow without bound; the farthest may still have the
/// other sign.
pub(super) fn unbounded(values: &[f64; 4]) -> bool {
    values[1] > 0.0 && grow(&values[1..])
}

#[cfg(test)]
mod tests {
    use super::{approach, unbounded};

    #[test]
    fn growth_with_a_root_of_the_distance_has_no_bound_and_a_finite_end_has_one() {
        let of = |f: fn(f64) -> f64| unbounded(&approach(2.0, 3.0).map(|place| f(place - 2.0)));
        assert!(of(|d| d.powf(-0.5)) && of(|d| 1.0 / d) && of(|d| d.powf(-1.5)));
        // From the other side of zero.
        assert!(of(|d| d.powf(-0.5) - 50.0));
        assert!(!of(|d| -d.powf(-0.5)));
        assert!(!of(|d| 3.0 - d.sqrt()) && !of(|_| 0.0) && !of(|_| f64::NAN));
    }
}
