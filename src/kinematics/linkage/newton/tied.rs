//! The couplings of a group that is solved by iteration: one equation each.
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

/// A coupling made ready.
#[derive(Clone, Debug)]
pub(in crate::kinematics::linkage) struct Tied {
    joint: Joint,
    /// Its links.
    links: [Side; 3],
}

/// Its links as they are now.
struct Placed<'a> {
    links: &'a [Side; 3],
    state: &'a State,
    scratch: &'a Scratch,
}

impl Tied {
    /// Of a coupling that has been checked; `own`: on what a link is.
    pub(in crate::kinematics::linkage) fn new(
        coupling: &CouplingSpec,
        pairs: &[PairSpec],
        own: impl Fn(&Element) -> Side,
    ) -> Option<Self> {
        Some(Self {
            joint: coupling.ready(pairs)?,
            links: coupling.links().map(|link| own(&Element::of_link(link))),
        })
    }

    /// Its closing error: rad, or a length over the size.
    pub(super) fn error<const N: usize>(
        &self,
        state: &State,
        scratch: &Scratch,
        size: f64,
    ) -> Series<N> {
        let error = self.joint.error::<N>(&self.placed(state, scratch));
        error.scale(self.joint.measure().unit(size))
    }

    /// Its row: derivatives of the error by the unknowns (x, y, θ) of the group's bodies.
    pub(super) fn derivatives(
        &self,
        state: &State,
        scratch: &Scratch,
        size: f64,
        mut add: impl FnMut(usize, [f64; 3]),
    ) {
        let measure = self.joint.measure();
        let placed = self.placed(state, scratch);
        self.joint.row::<1, f64>(&placed, |link, wrench| {
            let Side::Own { body, .. } = self.links[link] else {
                return;
            };
            let origin = [0, 1].map(|axis| scratch.unknowns[3 * body + axis][0]);
            let about = wrench.about(Vector::constant(origin));
            let [turned, x, y] = measure.entries(about, size).map(|entry| entry.value());
            add(body, [x, y, turned]);
        });
    }

    /// True where angles count over whole turns.
    pub(in crate::kinematics::linkage) fn turns(&self) -> bool {
        !self.joint.turning().is_empty()
    }

    /// The links placed before whose angles it needs.
    pub(in crate::kinematics::linkage) fn known_links(&self) -> impl Iterator<Item = usize> {
        let sides = self.joint.turning().iter().map(|&link| self.links[link]);
        sides.filter_map(|side| match side {
            Side::Known(element) => element.link,
            Side::Own { .. } => None,
        })
    }

    fn placed<'a>(&'a self, state: &'a State, scratch: &'a Scratch) -> Placed<'a> {
        Placed {
            links: &self.links,
            state,
            scratch,
        }
    }
}

impl<const N: usize> Frames<N, f64> for Placed<'_> {
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

impl<const N: usize> Turns<N> for Placed<'_> {
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
