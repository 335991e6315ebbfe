//! Parabolas through three points of a function, and a search that climbs along them.

/// Refinements after which the highest value seen is taken; the search gains
/// about two thirds of a digit of the place at the worst, most often far more.
const MOST_LOOKS: usize = 24;

/// A place and the value there.
pub(super) type SamplePoint = (f64, f64);

/// Top of the parabola through three points, when it lies between the outer ones.
#[inline]
pub(crate) fn vertex(points: &[SamplePoint; 3]) -> Option<SamplePoint> {
    let [(a, fa), (b, fb), (c, fc)] = *points;
    let (left, right) = ((fb - fa) / (b - a), (fc - fb) / (c - b));
    let bend = (right - left) / (c - a);
    if bend >= 0.0 || !bend.is_finite() {
        return None;
    }
    let place = 0.5 * (a + b) - 0.5 * left / bend;
    let value = fa + (place - a) * (left + (place - b) * bend);
    (a < place && place < c).then_some((place, value))
}

/// Climbs to the top between three points: parabolas through the best three
/// points, and a look into the wider side where they do not lead on.
pub(crate) fn refine_maximum(
    mut three: [SamplePoint; 3],
    look: &mut impl FnMut(f64) -> f64,
) -> SamplePoint {
    let (from, to) = (three[0].0, three[2].0);
    for _ in 0..MOST_LOOKS {
        let [(a, _), (b, fb), (c, _)] = three;
        let resolution = 1e-9 * (to - from);
        let wider = if b - a > c - b {
            0.5 * (a + b)
        } else {
            0.5 * (b + c)
        };
        let place = match vertex(&three) {
            Some((place, hoped)) => {
                if (place - b).abs() < resolution || hoped - fb <= 1e-16 * fb.abs() {
                    break;
                }
                place
            }
            None => wider,
        };
        if c - a < 4.0 * resolution {
            break;
        }
        three = bracket(three, (place, look(place)));
    }
    highest(&three)
}

/// The highest of three points; of equals the one in the middle.
pub(super) fn highest(three: &[SamplePoint; 3]) -> SamplePoint {
    let higher =
        |best: SamplePoint, point: &SamplePoint| if point.1 > best.1 { *point } else { best };
    three.iter().fold(three[1], higher)
}

/// The three neighbours around the higher of the old middle and the new point.
pub(super) fn bracket(three: [SamplePoint; 3], new: SamplePoint) -> [SamplePoint; 3] {
    let [left, middle, right] = three;
    match (new.0 < middle.0, new.1 > middle.1) {
        (true, true) => [left, new, middle],
        (true, false) => [new, middle, right],
        (false, true) => [middle, new, right],
        (false, false) => [left, middle, new],
    }
}

#[cfg(test)]
mod tests {
    use super::{refine_maximum, vertex};

    #[test]
    fn a_parabola_is_known_by_three_of_its_points() {
        let f = |x: f64| 2.0 - 3.0 * (x - 0.3) * (x - 0.3);
        let (place, value) = vertex(&[0.0, 0.2, 1.0].map(|x| (x, f(x)))).unwrap();
        approx::assert_relative_eq!(place, 0.3, max_relative = 1e-14);
        approx::assert_relative_eq!(value, 2.0, max_relative = 1e-14);
        assert!(vertex(&[0.4, 0.6, 1.0].map(|x| (x, f(x)))).is_none());
        assert!(vertex(&[0.0, 0.2, 1.0].map(|x| (x, -f(x)))).is_none());
    }

    #[test]
    fn the_way_to_the_top_is_short() {
        let mut looks = 0;
        let f = |x: f64| (1.3 * (x - 0.4)).cos();
        let top = refine_maximum([0.0, 0.5, 1.0].map(|x| (x, f(x))), &mut |x| {
            looks += 1;
            f(x)
        });
        approx::assert_abs_diff_eq!(top.0, 0.4, epsilon = 1e-7);
        approx::assert_abs_diff_eq!(top.1, 1.0, epsilon = 1e-15);
        assert!(looks <= 12, "{looks}");
    }
}
