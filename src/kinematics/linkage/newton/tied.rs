//! The joints of a group that is solved by iteration.
//!
//! Unlike pairs, wheels need angles over whole turns, not directions: a wheel that turns half as fast
//! is elsewhere after every other turn. Of what is placed already the angle nearest to that expected
//! is taken ([`State::near`]); of the group's own bodies it is the unknown itself.

use super::{NewtonGroup, Side};
use crate::kinematics::linkage::elements::{Element, Frame};
use crate::kinematics::linkage::joints::{CouplingSpec, Frames, Joint, Turns};
use crate::kinematics::linkage::spec::pair::PairSpec;
use crate::kinematics::linkage::state::{Scratch, State};
use crate::kinematics::linkage::vector::Vector;
use crate::math::series::Series;

/// A joint made ready.
#[derive(Clone, Debug)]
pub(in crate::kinematics::linkage) struct PreparedJoint {
    joint: Joint,
    /// Its links.
    links: [Side; 3],
}

/// Its links as they are now.
struct JointPlacement<'a> {
    links: &'a [Side; 3],
    state: &'a State,
    scratch: &'a Scratch,
}

impl PreparedJoint {
    /// A pair; `own`: on what a link is.
    pub(in crate::kinematics::linkage) fn of_pair(
        pair: &PairSpec,
        own: impl Fn(&Element) -> Side,
    ) -> Self {
        let [on, link] = [pair.on.link, pair.link.link].map(|link| own(&Element::of_link(link)));
        Self {
            joint: Joint::of_pair(pair),
            links: [on, link, on],
        }
    }

    /// A coupling that has been checked; `own`: on what a link is.
    pub(in crate::kinematics::linkage) fn of_coupling(
        coupling: &CouplingSpec,
        pairs: &[PairSpec],
        own: impl Fn(&Element) -> Side,
    ) -> Option<Self> {
        Some(Self {
            joint: coupling.to_joint(pairs)?,
            links: coupling.links().map(|link| own(&Element::of_link(link))),
        })
    }

    /// Number of its equations.
    pub(in crate::kinematics::linkage) fn rows(&self) -> usize {
        self.joint.shape().rows.len()
    }

    /// Sets its closing errors: rad, or lengths over the size.
    #[inline]
    pub(super) fn errors<const N: usize>(
        &self,
        state: &State,
        scratch: &Scratch,
        size: f64,
        mut set: impl FnMut(usize, Series<N>),
    ) {
        let measures = self.joint.shape().rows;
        self.joint
            .errors::<N>(&self.joint_placement(state, scratch), |row, error| {
                set(row, error.scale(measures[row].unit(size)));
            });
    }

    /// Adds its rows: derivatives of the errors by the unknowns (x, y, θ) of the group's bodies.
    #[inline]
    pub(super) fn derivatives(
        &self,
        state: &State,
        scratch: &Scratch,
        size: f64,
        mut add: impl FnMut(usize, usize, [f64; 3]),
    ) {
        let measures = self.joint.shape().rows;
        let placed = self.joint_placement(state, scratch);
        self.joint.rows::<1, f64>(&placed, |row, link, wrench| {
            let Side::Own { body, .. } = self.links[link] else {
                return;
            };
            let origin = [
                scratch.unknowns[3 * body][0],
                scratch.unknowns[3 * body + 1][0],
            ];
            let about = wrench.moment_and_force_about(Vector::constant(origin));
            let [turned, x, y] = measures[row].velocity_terms(about, size);
            add(row, body, [x.value(), y.value(), turned.value()]);
        });
    }

    /// Whether its links lie to each other as they are meant.
    pub(in crate::kinematics::linkage) fn is_proper(
        &self,
        state: &State,
        scratch: &Scratch,
    ) -> bool {
        self.joint.is_proper(&self.joint_placement(state, scratch))
    }

    /// True where angles count over whole turns.
    pub(in crate::kinematics::linkage) fn counts_whole_turns(&self) -> bool {
        !self.joint.shape().turning.is_empty()
    }

    /// The links placed before whose angles it needs.
    pub(in crate::kinematics::linkage) fn known_links(&self) -> impl Iterator<Item = usize> {
        let sides = self
            .joint
            .shape()
            .turning
            .iter()
            .map(|&link| self.links[link]);
        sides.filter_map(|side| match side {
            Side::Known(element) => element.link,
            Side::Own { .. } => None,
        })
    }

    fn joint_placement<'a>(&'a self, state: &'a State, scratch: &'a Scratch) -> JointPlacement<'a> {
        JointPlacement {
            links: &self.links,
            state,
            scratch,
        }
    }
}

impl<const N: usize> Frames<N, f64> for JointPlacement<'_> {
    #[inline]
    fn frame(&self, link: usize) -> Frame<N> {
        match &self.links[link] {
            Side::Known(element) => self.state.frame(element.link),
            Side::Own { body, part } => {
                let frame = NewtonGroup::frame::<N>(self.scratch, *body);
                match part.driven {
                    true => frame.then(&self.state.relative_frame()),
                    false => frame,
                }
            }
        }
    }
}

impl<const N: usize> Turns<N> for JointPlacement<'_> {
    fn angle(&self, link: usize) -> Series<N> {
        match &self.links[link] {
            Side::Known(element) => match element.link {
                Some(link) => self.state.angle(link),
                None => Series::constant(0.0),
            },
            Side::Own { body, part } => {
                let own = Series::load(&self.scratch.unknowns[3 * body + 2]);
                match part.driven {
                    true => own + self.state.relative_angle(),
                    false => own,
                }
            }
        }
    }
}
