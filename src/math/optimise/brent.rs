//! Brent's search for the greatest value of a smooth function.

use super::Peak;

/// Most evaluations for an extreme; some ten are usual.
const STEPS: usize = 60;
/// (3 − √5)/2, the part that golden section cuts off.
const CUT_OFF: f64 = 0.381_966_011_250_105_1;

/// The greatest value of a function next to a place between two others at which it is
/// less: steps to the vertex of a parabola through the last three places, or else golden
/// section (R. P. Brent, *Algorithms for Minimization without Derivatives*, 1973, chapter
/// 5). The place is found to a part `located` of the interval; `worth` is never a NaN.
pub(crate) fn brent(
    start: Peak,
    [mut low, mut high]: [f64; 2],
    located: f64,
    worth: &mut dyn FnMut(f64) -> f64,
) -> Peak {
    let near = located * (high - low);
    // The best place, the one before, and the one before that, with what they are worth.
    let mut best = (start.at, start.value);
    let (mut second, mut third) = (best, best);
    let (mut step, mut before_last) = (0.0f64, 0.0f64);
    for _ in 0..STEPS {
        let middle = 0.5 * (low + high);
        if (best.0 - middle).abs() <= 2.0 * near - 0.5 * (high - low) {
            break;
        }
        let vertex = vertex([best, second, third]);
        let inside = best.0 + vertex;
        // A parabola is trusted where its steps become shorter.
        if vertex.abs() < 0.5 * before_last.abs() && low < inside && inside < high {
            (before_last, step) = (step, vertex);
            if inside - low < 2.0 * near || high - inside < 2.0 * near {
                step = near.copysign(middle - best.0);
            }
        } else {
            before_last = if best.0 < middle {
                high - best.0
            } else {
                low - best.0
            };
            step = CUT_OFF * before_last;
        }
        let place = best.0
            + if step.abs() >= near {
                step
            } else {
                near.copysign(step)
            };
        let tried = (place, worth(place));
        if tried.1 >= best.1 {
            if tried.0 < best.0 {
                high = best.0;
            } else {
                low = best.0;
            }
            (third, second, best) = (second, best, tried);
        } else {
            if tried.0 < best.0 {
                low = tried.0;
            } else {
                high = tried.0;
            }
            if tried.1 >= second.1 || second.0 == best.0 {
                (third, second) = (second, tried);
            } else if tried.1 >= third.1 || third.0 == best.0 || third.0 == second.0 {
                third = tried;
            }
        }
    }
    Peak {
        value: best.1,
        at: best.0,
    }
}

/// From the first place to the vertex of the parabola through three; not a number where they do
/// not make one.
fn vertex([x, w, v]: [(f64, f64); 3]) -> f64 {
    let r = (x.0 - w.0) * (x.1 - v.1);
    let q = (x.0 - v.0) * (x.1 - w.1);
    let above = (x.0 - v.0) * q - (x.0 - w.0) * r;
    let below = 2.0 * (q - r);
    -above / below
}

#[cfg(test)]
mod tests {
    use super::brent;
    use crate::math::optimise::Peak;

    #[test]
    fn smooth_tops_cost_few_evaluations_and_kinks_are_found_too() {
        type Case = (fn(f64) -> f64, f64, usize);
        let cases: [Case; 3] = [
            (|x| -(x - 0.3) * (x - 0.3), 0.3, 12),
            (|x| (x - 0.2).cos() + 0.1 * x, 0.2 + 0.1f64.asin(), 20),
            (|x| -(x - 0.37).abs(), 0.37, 60),
        ];
        for (f, wanted, most) in cases {
            let mut count = 0;
            let start = Peak {
                value: f(0.0),
                at: 0.0,
            };
            let found = brent(start, [-1.0, 1.0], 1e-9, &mut |x| {
                count += 1;
                f(x)
            });
            assert!((found.at - wanted).abs() < 3e-8, "{found:?} {wanted}");
            assert!(count <= most, "{count}");
        }
    }
}
