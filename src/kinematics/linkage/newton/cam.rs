//! A cam and its roller inside a group that is solved by iteration: |p| = R(angle of p), with p the
//! roller's centre seen from the cam's own centre and in the cam's frame.

use super::{NewtonGroup, PairSide, Side};
use crate::kinematics::linkage::couplings::PitchCurve;
use crate::kinematics::linkage::state::{Scratch, State};
use crate::math::series::Series;

/// A cam made ready.
#[derive(Clone, Debug)]
pub(in crate::kinematics::linkage) struct Rolling {
    /// The cam: the point about which its pitch curve is polar, and the x axis of its frame.
    pub(in crate::kinematics::linkage) cam: Side,
    /// The roller's centre.
    pub(in crate::kinematics::linkage) roller: Side,
    pub(in crate::kinematics::linkage) curve: PitchCurve,
}

impl Rolling {
    /// Its closing error: a length over the size.
    pub(in crate::kinematics::linkage) fn error<const N: usize>(
        &self,
        group: &NewtonGroup,
        state: &State,
        scratch: &Scratch,
        size: f64,
    ) -> Series<N> {
        let [cam, roller] = self.sides::<N>(group, state, scratch);
        let seen = cam.along.mirrored().turn(roller.point - cam.point);
        self.curve.error([seen.x, seen.y]).scale(size.recip())
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
        let [cam, roller] = self.sides::<1>(group, state, scratch);
        let gap = roller.point - cam.point;
        let seen = cam.along.mirrored().turn(gap).value();
        let normal = cam.along.turn_constant(self.curve.gradient(seen));
        let [x, y] = normal.value();
        // As the cam turns, the roller's centre turns backwards in its frame.
        let turned = -normal.dot(gap.left()).value() / size;
        for (sign, seen, turned) in [(-1.0, &cam, turned), (1.0, &roller, 0.0)] {
            let Some(body) = seen.body else { continue };
            let row = &mut scratch.matrix[top + 3 * body..][..3];
            row[0] += sign * x;
            row[1] += sign * y;
            row[2] += sign * normal.dot(seen.arm.left()).value() / size + turned;
        }
    }

    fn sides<const N: usize>(
        &self,
        group: &NewtonGroup,
        state: &State,
        scratch: &Scratch,
    ) -> [PairSide<N>; 2] {
        [&self.cam, &self.roller].map(|side| group.seen::<N>(side, state, scratch))
    }
}
