//! What grows without bound towards a place, told by its values ever nearer to it.

/// Part of the reach by which a position may lie before a dead-centre position at its end, and still
/// counts as there: twice that by which ranges over the whole reach keep off it.
const ROOM: f64 = 2e-6;
/// Growth over a tenth of the distance that has no end: by 10 where it goes with the
/// distance, by 3 with its root; by less than 1 where it ends.
const GROWTH: f64 = 2.0;
/// Least growth over the last tenth, as a part of the value: what is less may be rounding.
const FELT: f64 = 1e-6;
/// Powers of ten of the distance over which growth is looked at.
const DECADES: [i32; 4] = [-3, -4, -5, -6];

/// A dead-centre position at which the reach ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DeadEnd {
    /// Place on the axis.
    pub at: f64,
    /// The other end of the reach, or of the part of it that is looked at.
    pub other: f64,
}

impl DeadEnd {
    /// Both ends, the dead one first.
    pub(super) fn new([at, other]: [f64; 2]) -> Self {
        Self { at, other }
    }

    /// True for a place so near that its forces and speeds tell only how near it is.
    pub(super) fn is_at(&self, place: f64) -> bool {
        (place - self.at).abs() <= ROOM * (self.other - self.at).abs()
    }
}

/// Places ever nearer to an end, on the side of a free place.
pub(super) fn places_towards_end(end: f64, free: f64) -> [f64; 4] {
    DECADES.map(|decade| end + 10f64.powi(decade) * (free - end))
}

/// True where values taken at these places grow without bound, by ever more each time: so what
/// they grow on does not matter, and the farther ones may still have the other sign.
pub(super) fn unbounded(values: &[f64; 4]) -> bool {
    let [a, b, c, d] = *values;
    let steps = [b - a, c - b, d - c];
    let accelerates = steps.windows(2).all(|pair| pair[1] > GROWTH * pair[0]);
    accelerates && steps[1] > 0.0 && d > 0.0 && steps[2] > FELT * d
}

#[cfg(test)]
mod tests {
    use super::{DeadEnd, places_towards_end, unbounded};

    #[test]
    fn a_place_is_at_a_dead_end_by_its_distance_in_parts_of_the_reach() {
        let end = DeadEnd::new([0.25, 0.15]);
        assert!(end.is_at(0.25) && end.is_at(0.25 - 1e-7) && end.is_at(0.25 + 1e-7));
        assert!(!end.is_at(0.25 - 3e-7) && !end.is_at(0.15));
    }

    #[test]
    fn growth_with_a_root_of_the_distance_has_no_bound_and_a_finite_end_has_one() {
        let of = |f: fn(f64) -> f64| {
            unbounded(&places_towards_end(2.0, 3.0).map(|place| f(place - 2.0)))
        };
        assert!(of(|d| d.powf(-0.5)) && of(|d| 1.0 / d) && of(|d| d.powf(-1.5)));
        // From the other side of zero, and beside what stays.
        assert!(of(|d| d.powf(-0.5) - 50.0) && of(|d| d.powf(-0.5) - 500.0));
        assert!(of(|d| 1e4 + d.powf(-0.5)));
        assert!(!of(|d| -d.powf(-0.5)));
        assert!(!of(|d| 3.0 - d.sqrt()) && !of(|_| 0.0) && !of(|_| f64::NAN));
    }
}
