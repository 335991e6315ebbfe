//! Couplings inside a group that is solved by iteration.
//!
//! Unlike all other equations of a linkage these need angles over whole turns, not directions: a
//! wheel that turns half as fast is elsewhere after every other turn. Of what is placed already the
//! angle nearest to that expected is taken ([`State::near`]); of the group's own bodies it is the
//! unknown itself.

use super::{NewtonGroup, Side};
use crate::kinematics::linkage::state::{Scratch, State};
use crate::math::series::Series;

/// A coupling made ready: seen from the carrier the second coordinate is ratio·(the first) + offset.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::kinematics::linkage) struct Geared {
    /// The first wheel.
    pub(in crate::kinematics::linkage) wheel: Side,
    /// The second wheel or the rack.
    pub(in crate::kinematics::linkage) second: Second,
    /// The carrier.
    pub(in crate::kinematics::linkage) carrier: Side,
    /// ρ.
    pub(in crate::kinematics::linkage) ratio: f64,
    /// The second coordinate where the first is zero (rad or m).
    pub(in crate::kinematics::linkage) offset: f64,
}

/// The second of two coupled links.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::kinematics::linkage) enum Second {
    /// A wheel.
    Wheel(Side),
    /// A rack: both sides of its guide, and the sign of the guide's coordinate.
    Rack([Side; 2], f64),
}

impl Geared {
    /// Its closing error: rad, or a length over the size.
    pub(in crate::kinematics::linkage) fn error<const N: usize>(
        &self,
        group: &NewtonGroup,
        state: &State,
        scratch: &Scratch,
        size: f64,
    ) -> Series<N> {
        let turned = |side: &Side| angle::<N>(side, state, scratch);
        let first = (turned(&self.wheel) - turned(&self.carrier)).scale(self.ratio);
        let second = match &self.second {
            Second::Wheel(side) => turned(side) - turned(&self.carrier),
            Second::Rack(sides, sense) => {
                let [i, j] = sides.map(|side| group.seen::<N>(&side, state, scratch));
                i.along.dot(j.point - i.point).scale(*sense)
            }
        };
        (second - first).shift(-self.offset).scale(self.unit(size))
    }

    /// Adds the derivatives of its error by the unknowns to the row of the matrix that begins
    /// at `top`.
    pub(in crate::kinematics::linkage) fn derivatives(
        &self,
        group: &NewtonGroup,
        state: &State,
        scratch: &mut Scratch,
        size: f64,
        top: usize,
    ) {
        let unit = self.unit(size);
        let mut turn = |side: &Side, factor: f64| {
            if let Side::Own { body, .. } = side {
                scratch.matrix[top + 3 * body + 2] += factor * unit;
            }
        };
        turn(&self.wheel, -self.ratio);
        turn(&self.carrier, self.ratio);
        match &self.second {
            Second::Wheel(side) => {
                turn(side, 1.0);
                turn(&self.carrier, -1.0);
            }
            Second::Rack(sides, sense) => {
                let factor = sense * unit;
                slide(sides, group, (state, scratch), (size, factor), top);
            }
        }
    }

    /// What makes the second coordinate a pure number.
    fn unit(&self, size: f64) -> f64 {
        match self.second {
            Second::Wheel(_) => 1.0,
            Second::Rack(..) => size.recip(),
        }
    }

    /// The links placed before whose angles it needs.
    pub(in crate::kinematics::linkage) fn known_links(&self) -> impl Iterator<Item = usize> {
        let second = match self.second {
            Second::Wheel(side) => Some(side),
            Second::Rack(..) => None,
        };
        let sides = [Some(self.wheel), Some(self.carrier), second];
        sides.into_iter().flatten().filter_map(|side| match side {
            Side::Known(element) => element.link,
            Side::Own { .. } => None,
        })
    }
}

/// Derivatives of a guide's coordinate by the unknowns, times `factor`.
fn slide(
    sides: &[Side; 2],
    group: &NewtonGroup,
    (state, scratch): (&State, &mut Scratch),
    (size, factor): (f64, f64),
    top: usize,
) {
    let [i, j] = sides.map(|side| group.seen::<1>(&side, state, scratch));
    let along = i.along.value();
    let tilt = factor * i.along.left().dot(j.point - i.point).value();
    for (sign, seen, tilt) in [(-factor, &i, tilt), (factor, &j, 0.0)] {
        let Some(body) = seen.body else { continue };
        let row = &mut scratch.matrix[top + 3 * body..][..3];
        row[0] += sign * along[0] * size;
        row[1] += sign * along[1] * size;
        row[2] += sign * i.along.dot(seen.arm.left()).value() + tilt;
    }
}

/// The angle of a side's link over whole turns (rad).
fn angle<const N: usize>(side: &Side, state: &State, scratch: &Scratch) -> Series<N> {
    match side {
        Side::Known(element) => match element.link {
            Some(link) => state.angle(link),
            None => Series::constant(0.0),
        },
        Side::Own { body, part } => {
            let own = Series::load(&scratch.unknowns[3 * body + 2]);
            if part.driven {
                own + state.relative_angle()
            } else {
                own
            }
        }
    }
}
