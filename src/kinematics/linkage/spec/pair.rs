//! Lower pairs in plain numbers.

/// A point of a link or of the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointOf {
    /// Index into [`LinkageSpec::links`](super::LinkageSpec::links); `None`: the ground.
    pub link: Option<usize>,
    /// Coordinates in the frame of the link (m).
    pub at: [f64; 2],
}

/// What joins two links at a point, or slides on a line: a pair or a weld.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tie<'s> {
    /// Name of the pair or weld.
    pub(crate) name: &'s str,
    /// The points that it joins.
    pub(crate) ends: [PointOf; 2],
    /// Index of the pair that slides; `None`: the points lie on each other.
    pub(crate) slides: Option<usize>,
    /// Angle of the second link's frame less that of the first, if it is constant (rad).
    pub(crate) turned: Option<f64>,
    /// Direction of sliding in the frame of the first link (rad).
    pub(crate) direction: f64,
}

/// A kinematic pair that joins link i (`on`) to link j (`link`).
#[derive(Clone, Debug, PartialEq)]
pub struct PairSpec {
    /// Name of the pair.
    pub name: String,
    /// Point on link i: the pin, or a point of the guide's axis.
    pub on: PointOf,
    /// Point on link j: the pin, or the block's reference point on the axis.
    pub link: PointOf,
    /// Turning or sliding.
    pub kind: PairKind,
    /// Coefficient of Coulomb friction μ ≥ 0.
    pub friction: f64,
}

impl PairSpec {
    /// True for a block on a guide.
    pub fn slides(&self) -> bool {
        self.kind.slides()
    }

    /// As a tie; `index`: its place in the list of pairs.
    pub(super) fn tie(&self, index: usize) -> Tie<'_> {
        let (slides, turned, direction) = match self.kind {
            PairKind::Revolute { .. } => (None, None, 0.0),
            PairKind::Sliding {
                direction, angle, ..
            } => (Some(index), Some(direction + angle), direction),
        };
        Tie {
            name: &self.name,
            ends: [self.on, self.link],
            slides,
            turned,
            direction,
        }
    }

    /// Direction of the guide in the frame of link i, (cos ψ, sin ψ); `None` of a pin.
    pub(crate) fn direction(&self) -> Option<[f64; 2]> {
        match self.kind {
            PairKind::Revolute { .. } => None,
            PairKind::Sliding { direction, .. } => Some([direction.cos(), direction.sin()]),
        }
    }
}

/// Turning or sliding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PairKind {
    /// A pin. Its relative coordinate is the angle of j's frame less that of i's (rad).
    Revolute {
        /// Diameter d ≥ 0 of the pin (m), for friction.
        diameter: f64,
    },
    /// A guide on link i and a block on link j. Its relative coordinate is the
    /// displacement of j's point from i's point along the guide (m).
    Sliding {
        /// Direction of the guide in the frame of i (rad): t = (cos ψ, sin ψ).
        direction: f64,
        /// Angle of j's frame less the direction of the guide (rad), constant.
        angle: f64,
        /// Coordinates of the block's two corners along t from j's point (m),
        /// b₁ > b₂.
        corners: [f64; 2],
        /// Half the height c ≥ 0 of the block (m).
        half_height: f64,
    },
}

impl PairKind {
    /// A pin of which no diameter is said.
    pub(crate) const PIN: Self = Self::Revolute { diameter: 0.0 };

    /// True for a block on a guide.
    pub fn slides(&self) -> bool {
        matches!(self, Self::Sliding { .. })
    }

    /// Diameter of a pin (m).
    pub(crate) fn diameter(&self) -> Option<f64> {
        match *self {
            Self::Revolute { diameter } => Some(diameter),
            Self::Sliding { .. } => None,
        }
    }
}
