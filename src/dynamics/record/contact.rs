//! Where in a step a driving pair is clear of its flanks, and how far.

use super::subdivision::{maximum, minimum};
use crate::dynamics::model::{Closure, Pair};
use crate::math::polynomial::first_positive;
use crate::math::polynomial::{Coefficients, MAX_DEGREE, Step};

/// A pair that can open, and where its deformation is found.
#[derive(Clone, Copy, Debug)]
pub(super) struct ContactMonitor {
    /// Component of the modes: 0 open, −1 on the lower flank, +1 on the upper.
    pub(super) component: usize,
    /// Signal that is the deformation x of link 1, but for `zero`.
    pub(super) coordinate: usize,
    /// What the signal is where x = 0: the place of a stop.
    pub(super) zero: f64,
    pub(super) pair: Pair,
}

impl ContactMonitor {
    /// Bernstein coefficients of x over a step.
    pub(super) fn deformation<'r>(&self, step: &Step<'_>, room: &'r mut Coefficients) -> &'r [f64] {
        let count = step.signal(self.coordinate, room).len();
        if self.zero != 0.0 {
            room[..count].iter_mut().for_each(|x| *x -= self.zero);
        }
        &room[..count]
    }

    /// Place in an open step where x leaves the flank that it still penetrates: the power
    /// lost there has a kink. (A pair opens inside its flank when damping takes the force
    /// to zero first.)
    pub(super) fn flank_exit(&self, mode: i64, x: &[f64], end: f64) -> Option<f64> {
        if mode != 0 {
            return None;
        }
        // Clearance of a flank: sign·x + offset, negative inside.
        let flanks: &[(f64, f64)] = match self.pair.closure {
            Closure::Bilateral => &[],
            Closure::Force => &[(self.pair.opens, 0.0)],
            Closure::Form => &[(1.0, 0.5 * self.pair.gap), (-1.0, 0.5 * self.pair.gap)],
        };
        flanks.iter().find_map(|&(sign, offset)| {
            let mut clearance: Coefficients = [0.0; MAX_DEGREE + 1];
            for (value, x) in clearance.iter_mut().zip(x) {
                *value = sign * x + offset;
            }
            if clearance[0] >= 0.0 {
                return None;
            }
            first_positive(&clearance[..x.len()]).filter(|&s| 0.0 < s && s < end)
        })
    }

    /// Greatest distance of x from the nearest flank on [0, `end`] with its place, if
    /// that is greater than `floor`.
    pub(super) fn greatest_clearance(&self, x: &[f64], end: f64, floor: f64) -> Option<(f64, f64)> {
        match self.pair.closure {
            Closure::Bilateral => None,
            Closure::Force if self.pair.opens >= 0.0 => maximum(x, end, floor),
            Closure::Force => minimum(x, end, -floor).map(|(x, place)| (-x, place)),
            Closure::Form => {
                // η/2 − |x| is greatest where |x| is least.
                let (least, low) = minimum(x, end, f64::MAX)?;
                let (most, high) = maximum(x, end, f64::MIN)?;
                let half = 0.5 * self.pair.gap;
                let (value, place) = if least > 0.0 {
                    (half - least, low)
                } else if most < 0.0 {
                    (half + most, high)
                } else {
                    (half, first_positive_of_either(x, end))
                };
                (value > floor).then_some((value, place))
            }
        }
    }
}

/// A place at which x, which takes both signs on [0, `end`] or touches zero, is zero.
fn first_positive_of_either(x: &[f64], end: f64) -> f64 {
    let mut turned: Coefficients = [0.0; MAX_DEGREE + 1];
    for (value, x) in turned.iter_mut().zip(x) {
        *value = -x;
    }
    let up = first_positive(x).filter(|&s| s > 0.0);
    let down = first_positive(&turned[..x.len()]).filter(|&s| s > 0.0);
    up.into_iter().chain(down).fold(end, f64::min)
}

#[cfg(test)]
mod tests {
    use super::ContactMonitor;
    use crate::dynamics::model::{Closure, ContactForm, Pair};

    fn opening(closure: Closure, gap: f64, opens: f64) -> ContactMonitor {
        let form = ContactForm::default();
        ContactMonitor {
            component: 0,
            coordinate: 0,
            zero: 0.0,
            pair: Pair {
                closure,
                gap,
                opens,
                form,
            },
        }
    }

    #[test]
    fn clearance_is_the_distance_to_the_nearest_flank() {
        let up = [0.0, 0.5, 1.0]; // x = s
        let force = |opens| {
            let pair = opening(Closure::Force, 0.0, opens);
            pair.greatest_clearance(&up, 1.0, 0.0)
        };
        assert_eq!((force(1.0), force(-1.0)), (Some((1.0, 1.0)), None));
        let form = opening(Closure::Form, 3.0, 1.0);
        let clearance = |x: &[f64]| form.greatest_clearance(x, 1.0, 0.0);
        assert_eq!(clearance(&up).unwrap().0, 1.5);
        assert_eq!(clearance(&[-1.0, -0.75, -0.5]), Some((1.0, 1.0)));
        assert_eq!(clearance(&[0.5, 0.75, 1.0]), Some((1.0, 0.0)));
        assert_eq!(clearance(&[-1.0, 0.0, 1.0]), Some((1.5, 0.5)));
        assert_eq!(clearance(&[-4.0, -4.0, -4.0]), None);
    }

    #[test]
    fn an_open_pair_leaves_its_flank_where_x_crosses_it() {
        let up = [-0.25, 0.25, 0.75]; // x = s − 1/4
        let force = opening(Closure::Force, 0.0, 1.0);
        assert_eq!(force.flank_exit(0, &up, 1.0), Some(0.25));
        assert_eq!(force.flank_exit(0, &up, 0.2), None);
        assert_eq!(force.flank_exit(-1, &up, 1.0), None);
        let turned = opening(Closure::Force, 0.0, -1.0);
        assert_eq!(turned.flank_exit(0, &up, 1.0), None);
        let down = [1.25, 0.75, 0.25]; // x = 5/4 − s, upper flank at 1
        let form = opening(Closure::Form, 2.0, 1.0);
        assert_eq!(form.flank_exit(0, &down, 1.0), Some(0.25));
    }
}
