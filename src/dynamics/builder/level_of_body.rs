//! The level at which a body models its uniform object, and the body at a level.

use super::level::{InertiaSplit, Level, Uniform};
use super::spec::BodySpec;

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
    use super::{BodySpec, InertiaSplit, Level, Uniform};
    use crate::dynamics::builder::level::Lumping;

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
