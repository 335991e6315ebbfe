//! One equation between links, and how it meets the world that asks for it.

use crate::kinematics::linkage::elements::Frame;
use crate::kinematics::linkage::vector::Vector;
use crate::math::number::Number;
use crate::math::series::Series;

/// Frames of the links of a joint, counted 0, 1, 2 as
/// [`CouplingSpec::links`](super::CouplingSpec::links) has them.
pub(in crate::kinematics::linkage) trait Frames<const K: usize, T: Number> {
    /// The frame of a link.
    fn frame(&self, link: usize) -> Frame<K, T>;
}

/// The same with angles over whole turns.
pub(in crate::kinematics::linkage) trait Turns<const K: usize>:
    Frames<K, f64>
{
    /// The angle of a link (rad).
    fn angle(&self, link: usize) -> Series<K>;
}

/// The mechanics of a joint made ready: equations, error = 0.
pub(in crate::kinematics::linkage) trait Constraint {
    /// What is fixed of its equations.
    const SHAPE: Shape;

    /// Sets the closing error of each row (rad or m).
    fn errors<const K: usize>(&self, links: &impl Turns<K>, set: impl FnMut(usize, Series<K>));

    /// Adds the wrenches of each row on the links.
    fn rows<const K: usize, T: Number>(
        &self,
        links: &impl Frames<K, T>,
        add: impl FnMut(usize, usize, Wrench<K, T>),
    );

    /// What a unit of its force does to the first and the second link: the forces of the row, of
    /// length one. A kind whose forces pass through the pins of a carrier has its own.
    fn unit_force_acts(&self, links: &impl Frames<1, f64>) -> [Act; 2] {
        let mut acts = [Act::default(); 2];
        self.rows(links, |_, link, wrench| {
            if let (Some(act), Wrench::Force { at, force }) = (acts.get_mut(link), wrench) {
                let [x, y] = force.value();
                let size = self.sign_of_force() * x.hypot(y);
                act.at = at.value();
                act.force = [x / size, y / size];
            }
        });
        acts
    }

    /// −1 where a positive force makes the closing error smaller.
    fn sign_of_force(&self) -> f64 {
        1.0
    }

    /// Whether its links lie to each other as they are meant, where the equations hold in two ways.
    fn is_proper(&self, _links: &impl Frames<1, f64>) -> bool {
        true
    }
}

/// What is fixed of the equations of a kind of joint.
#[derive(Clone, Copy, Debug)]
pub(in crate::kinematics::linkage) struct Shape {
    /// Quantities of its closing errors, one an equation.
    pub(in crate::kinematics::linkage) rows: &'static [Measure],
    /// Number of links that the equations look at.
    pub(in crate::kinematics::linkage) links: usize,
    /// Links whose angles count over whole turns.
    pub(in crate::kinematics::linkage) turning: &'static [usize],
}

/// Quantity of a closing error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::kinematics::linkage) enum Measure {
    /// rad.
    Angle,
    /// m.
    Length,
}

impl Measure {
    /// What makes the closing error a pure number.
    #[inline(always)]
    pub(in crate::kinematics::linkage) fn unit(self, size: f64) -> f64 {
        match self {
            Self::Angle => 1.0,
            Self::Length => size.recip(),
        }
    }

    /// What velocities (ω, v over the size) contribute to the rate of that number.
    #[inline(always)]
    pub(in crate::kinematics::linkage) fn velocity_terms<const K: usize, T: Number>(
        self,
        [moment, x, y]: [Series<K, T>; 3],
        size: f64,
    ) -> [Series<K, T>; 3] {
        match self {
            Self::Angle => [moment, x.scale(size), y.scale(size)],
            Self::Length => [moment.scale(size.recip()), x, y],
        }
    }
}

/// Part of a row on one of the links.
#[derive(Clone, Copy, Debug)]
pub(in crate::kinematics::linkage) enum Wrench<const K: usize, T = f64> {
    /// A force at a point.
    Force {
        /// The point.
        at: Vector<K, T>,
        /// The force.
        force: Vector<K, T>,
    },
    /// A couple.
    Couple(Series<K, T>),
}

impl<const K: usize, T: Number> Wrench<K, T> {
    /// A constant couple.
    #[inline(always)]
    pub(in crate::kinematics::linkage) fn couple(value: f64) -> Self {
        Self::Couple(Series::fixed(value))
    }

    /// Its moment about the origin and its force.
    #[inline(always)]
    pub(in crate::kinematics::linkage) fn about_origin(self) -> [Series<K, T>; 3] {
        match self {
            Self::Force { at, force } => [at.cross(force), force.x, force.y],
            Self::Couple(couple) => {
                let none = Series::fixed(0.0);
                [couple, none, none]
            }
        }
    }

    /// Its moment about a point and its force.
    #[inline(always)]
    pub(in crate::kinematics::linkage) fn moment_and_force_about(
        self,
        point: Vector<K, T>,
    ) -> [Series<K, T>; 3] {
        match self {
            Self::Force { at, force } => [(at - point).cross(force), force.x, force.y],
            Self::Couple(_) => self.about_origin(),
        }
    }
}

/// A force at a point and a couple, such as what a unit of a joint's force does to one of its links.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(in crate::kinematics::linkage) struct Act {
    /// Where the force acts (m).
    pub(in crate::kinematics::linkage) at: [f64; 2],
    /// The force.
    pub(in crate::kinematics::linkage) force: [f64; 2],
    /// The couple.
    pub(in crate::kinematics::linkage) couple: f64,
}

impl Act {
    /// A force at a point.
    pub(in crate::kinematics::linkage) fn force(at: [f64; 2], force: [f64; 2]) -> Self {
        Self {
            at,
            force,
            couple: 0.0,
        }
    }

    /// So many times of it.
    #[inline(always)]
    pub(in crate::kinematics::linkage) fn times(&self, factor: f64) -> Self {
        Self {
            at: self.at,
            force: self.force.map(|part| factor * part),
            couple: factor * self.couple,
        }
    }

    /// Its force, and its moment about a point.
    #[inline(always)]
    pub(in crate::kinematics::linkage) fn moment_and_force_about(
        &self,
        [x, y]: [f64; 2],
    ) -> [f64; 3] {
        let [fx, fy] = self.force;
        [
            fx,
            fy,
            (self.at[0] - x) * fy - (self.at[1] - y) * fx + self.couple,
        ]
    }

    /// A force on the second link at a point, its reaction on the first.
    pub(in crate::kinematics::linkage) fn opposite(at: [f64; 2], force: [f64; 2]) -> [Self; 2] {
        let second = Self::force(at, force);
        [second.times(-1.0), second]
    }
}
