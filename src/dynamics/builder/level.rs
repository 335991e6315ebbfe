//! Levels: how much of a uniform elastic object is modelled.

use super::spec::{BodySpec, InertiaSplit, Lumping};
use serde::Serialize;

/// A uniform elastic object, of which the model says how much is kept.
#[derive(Clone, Debug, PartialEq)]
pub struct Uniform {
    /// Total inertia J.
    pub inertia: f64,
    /// Stiffness c seen at the output.
    pub stiffness: f64,
    /// Specific damping capacity ψ.
    pub damping_capacity: f64,
    /// How J lies along the object.
    pub split: InertiaSplit,
}

/// How much of an elastic object is modelled.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case", tag = "level")]
pub enum Level {
    /// Nothing of its flexibility.
    Rigid,
    /// It gives way as under slow forces; no vibrations.
    Static,
    /// Its lowest vibration modes; the others give way as under slow forces.
    Modes {
        /// How many.
        count: usize,
    },
    /// A chain of masses.
    Masses {
        /// How many.
        count: usize,
        /// Where the inertia of each cell is put.
        lumping: Lumping,
    },
}

impl Level {
    /// Its coordinates, as it is named: modes or masses.
    pub fn coordinates(self) -> usize {
        match self {
            Self::Rigid | Self::Static => 0,
            Self::Modes { count } | Self::Masses { count, .. } => count,
        }
    }

    /// The level of the same family with so many times the coordinates; `None`: it has no
    /// coordinates to be multiplied.
    pub fn refined(self, times: usize) -> Option<Self> {
        match self {
            Self::Rigid | Self::Static => None,
            Self::Modes { count } => Some(Self::Modes {
                count: count * times,
            }),
            Self::Masses { count, lumping } => Some(Self::Masses {
                count: count * times,
                lumping,
            }),
        }
    }
}

impl BodySpec {
    /// The uniform object that a body is a model of, and at which level (`None`: open);
    /// `None`: explicit lists, which are their own truth, a rigid body, or shares of
    /// one's own, which are no continuum.
    pub fn uniform(&self) -> Option<(Uniform, Option<Level>)> {
        let (inertia, stiffness, damping_capacity, split, level) = match self {
            Self::Rigid { .. } | Self::Lists { .. } => return None,
            Self::Open(uniform) => return Some((uniform.clone(), None)),
            Self::Uniform {
                inertia,
                stiffness,
                damping_capacity,
                masses,
                split,
                lumping,
            } => {
                let (count, lumping) = (*masses, *lumping);
                let level = Level::Masses { count, lumping };
                (*inertia, *stiffness, *damping_capacity, split, level)
            }
            Self::Modes {
                inertia,
                stiffness,
                damping_capacity,
                modes,
                split,
            } => {
                let level = match *modes {
                    0 => Level::Static,
                    count => Level::Modes { count },
                };
                (*inertia, *stiffness, *damping_capacity, split, level)
            }
        };
        if matches!(split, InertiaSplit::Shares(_)) {
            return None;
        }
        let uniform = Uniform {
            inertia,
            stiffness,
            damping_capacity,
            split: split.clone(),
        };
        Some((uniform, Some(level)))
    }
}

impl Uniform {
    /// The body of the object at a level.
    pub fn at(&self, level: Level) -> BodySpec {
        let Self {
            inertia,
            stiffness,
            damping_capacity,
            split,
        } = self.clone();
        let modes = |modes| BodySpec::Modes {
            inertia,
            stiffness,
            damping_capacity,
            modes,
            split: split.clone(),
        };
        match level {
            Level::Rigid => BodySpec::Rigid { inertia },
            Level::Static => modes(0),
            Level::Modes { count } => modes(count),
            Level::Masses { count, lumping } => BodySpec::Uniform {
                inertia,
                stiffness,
                damping_capacity,
                masses: count,
                split: split.clone(),
                lumping,
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{BodySpec, InertiaSplit, Level, Lumping, Uniform};

    #[test]
    fn a_body_is_the_uniform_object_at_its_level() {
        let uniform = Uniform {
            inertia: 2.0,
            stiffness: 3.0,
            damping_capacity: 0.1,
            split: InertiaSplit::Cubes,
        };
        let lumping = Lumping::Balanced;
        for level in [
            Level::Static,
            Level::Modes { count: 3 },
            Level::Masses { count: 4, lumping },
        ] {
            let body = uniform.at(level);
            assert_eq!(body.uniform(), Some((uniform.clone(), Some(level))));
        }
        assert_eq!(uniform.at(Level::Rigid), BodySpec::Rigid { inertia: 2.0 });
        assert_eq!(uniform.at(Level::Rigid).uniform(), None);
        let open = BodySpec::Open(uniform.clone());
        assert_eq!(open.uniform(), Some((uniform.clone(), None)));
        let own = Uniform {
            split: InertiaSplit::Shares(vec![1.0]),
            ..uniform
        };
        assert_eq!(own.at(Level::Static).uniform(), None);
    }

    #[test]
    fn a_family_is_refined_within_itself() {
        let modes = Level::Modes { count: 3 };
        assert_eq!(modes.refined(4), Some(Level::Modes { count: 12 }));
        assert_eq!((Level::Static.refined(2), modes.coordinates()), (None, 3));
    }
}
