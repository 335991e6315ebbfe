//! The top of a smooth function of which several values are known.
//!
//! The polynomial through all of them tells its place to some digits where a parabola
//! through three tells one: a look or two are left of the six or seven that climbing along
//! parabolas takes.

use super::parabola::{SamplePoint, bracket, highest, refine_maximum};

/// Looks at places that the polynomial tells; what is not found then is not smooth.
const BOLD: usize = 3;
/// Points at most.
const ROOM: usize = 7 + BOLD;
/// Part of what a value lies below another to which the polynomial has to tell it.
const TOLD: f64 = 1e-3;
/// Newton's iterations to the top of the polynomial, whose order is two.
const ITERATIONS: usize = 8;

/// The polynomial through some points, in Newton's form.
struct Course {
    places: [f64; ROOM],
    /// Divided differences from the first point on.
    first: [f64; ROOM],
    /// Divided differences back from the last point.
    last: [f64; ROOM],
    count: usize,
}

impl Course {
    fn through_points(points: &[SamplePoint]) -> Self {
        let mut own = Self {
            places: [0.0; ROOM],
            first: [0.0; ROOM],
            last: [0.0; ROOM],
            count: 0,
        };
        for &point in points {
            own.add(point);
        }
        own
    }

    fn add(&mut self, (place, value): SamplePoint) {
        let n = self.count;
        let mut next = value;
        for back in 0..n {
            let before = std::mem::replace(&mut self.last[back], next);
            next = (next - before) / (place - self.places[n - 1 - back]);
        }
        (self.last[n], self.first[n], self.places[n]) = (next, next, place);
        self.count += 1;
    }

    /// Value, slope and half the second derivative.
    fn at(&self, place: f64) -> [f64; 3] {
        let [mut value, mut slope, mut bend] = [self.first[self.count - 1], 0.0, 0.0];
        for k in (0..self.count - 1).rev() {
            let step = place - self.places[k];
            bend = bend * step + slope;
            slope = slope * step + value;
            value = value * step + self.first[k];
        }
        [value, slope, bend]
    }

    /// True where the highest point is at an end at which it still rises.
    fn rises_beyond(&self, points: &[SamplePoint; 7], top: usize) -> bool {
        match top {
            0 => self.at(points[0].0)[1] <= 0.0,
            6 => self.at(points[6].0)[1] >= 0.0,
            _ => false,
        }
    }

    /// Its top between the outer ones of three points, from a place near it on.
    fn top(&self, three: &[SamplePoint; 3], near: f64) -> Option<SamplePoint> {
        let (from, to) = (three[0].0, three[2].0);
        let mut place = near;
        for _ in 0..ITERATIONS {
            let [_, slope, bend] = self.at(place);
            let step = -0.5 * slope / bend;
            place += step;
            // Written so that a number that is none ends the search.
            if !(bend < 0.0 && from < place && place < to) {
                return None;
            }
            if step.abs() < 1e-8 * (to - from) {
                return Some((place, self.at(place)[0]));
            }
        }
        None
    }
}

/// Climbs to the top beside the highest of seven points of a function, which is number
/// `top`; `near`: about where.
pub(crate) fn refine_maximum_among(
    points: &[SamplePoint; 7],
    top: usize,
    near: f64,
    look: &mut impl FnMut(f64) -> f64,
) -> SamplePoint {
    let first = top.clamp(1, 5) - 1;
    let mut three = [points[first], points[first + 1], points[first + 2]];
    let resolution = 1e-9 * (three[2].0 - three[0].0);
    let (mut course, mut near) = (Course::through_points(points), near);
    // Where it rises to the very end there is none; a look tells whether that is so.
    if course.rises_beyond(points, top) {
        let told = course.at(near)[0];
        let new = (near, look(near));
        three = bracket(three, new);
        if (new.1 - told).abs() <= TOLD * (points[top].1 - new.1) {
            return points[top];
        }
        return refine_maximum(three, look);
    }
    for _ in 0..BOLD {
        let Some((place, hoped)) = course.top(&three, near) else {
            break;
        };
        let best = highest(&three);
        if (place - best.0).abs() < resolution || hoped - best.1 <= 1e-16 * best.1.abs() {
            return best;
        }
        let new = (place, look(place));
        three = bracket(three, new);
        course.add(new);
        near = place;
    }
    refine_maximum(three, look)
}

#[cfg(test)]
mod tests {
    use super::super::vertex;
    use super::{Course, refine_maximum_among};

    const PLACES: [f64; 7] = [0.0, 0.05, 0.23, 0.5, 0.77, 0.95, 1.0];

    #[test]
    fn a_polynomial_is_known_by_its_points() {
        let f = |x: f64| 2.0 - x + 3.0 * x.powi(4) - 0.5 * x.powi(6);
        let course = Course::through_points(&PLACES.map(|x| (x, f(x))));
        for x in [0.1, 0.6, 0.93] {
            let [value, slope, bend] = course.at(x);
            approx::assert_relative_eq!(value, f(x), max_relative = 1e-13);
            let expected = -1.0 + 12.0 * x.powi(3) - 3.0 * x.powi(5);
            approx::assert_abs_diff_eq!(slope, expected, epsilon = 1e-11);
            let expected = 18.0 * x.powi(2) - 7.5 * x.powi(4);
            approx::assert_abs_diff_eq!(bend, expected, epsilon = 1e-10);
        }
    }

    /// Number of looks, and the top found, of a function from its greatest value on.
    fn climbed(f: impl Fn(f64) -> f64) -> ((f64, f64), usize) {
        let points = PLACES.map(|x| (x, f(x)));
        let order = |a: &usize, b: &usize| points[*a].1.total_cmp(&points[*b].1);
        let top = (0..7).max_by(order).unwrap();
        let mut looks = 0;
        let first = top.clamp(1, 5) - 1;
        let near = vertex(&[points[first], points[first + 1], points[first + 2]]);
        let near = near.expect("a parabola with a top").0;
        let found = refine_maximum_among(&points, top, near, &mut |x| {
            looks += 1;
            f(x)
        });
        (found, looks)
    }

    #[test]
    fn a_smooth_top_takes_a_look_or_two() {
        for place in [0.02, 0.12, 0.37, 0.5, 0.69, 0.9, 0.97] {
            let (found, looks) = climbed(|x| 3.0 * (1.3 * (x - place)).cos() + 1.0);
            approx::assert_abs_diff_eq!(found.1, 4.0, epsilon = 1e-14);
            approx::assert_abs_diff_eq!(found.0, place, epsilon = 1e-6);
            assert!(looks <= 3, "{looks} looks at {place}");
        }
    }

    #[test]
    fn what_rises_to_its_end_takes_one_look() {
        // (A parabola through its last three values has its top before the end.)
        let f = |x: f64| 10.0 * (x - 0.9).powi(3) - (x - 0.9).powi(2);
        let (found, looks) = climbed(f);
        assert_eq!((found, looks), ((1.0, f(1.0)), 1));
        let (found, looks) = climbed(|x| f(1.0 - x));
        assert_eq!((found, looks), ((0.0, f(1.0)), 1));
    }

    #[test]
    fn a_top_with_a_corner_is_found_all_the_same() {
        let (found, looks) = climbed(|x| 1.0 - (x - 0.41).abs() * (1.0 + x));
        approx::assert_abs_diff_eq!(found.1, 1.0, epsilon = 1e-6);
        assert!(looks <= 27, "{looks}");
    }
}
