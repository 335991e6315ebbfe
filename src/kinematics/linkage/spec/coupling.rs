//! Couplings between links in plain numbers: gears, belts, racks, cams.

use super::cam::CamPairSpec;

/// A coupling: one equation between links, such as that the angle of one follows that of another.
#[derive(Clone, Debug, PartialEq)]
pub struct CouplingSpec {
    /// Name of the coupling.
    pub name: String,
    /// The links with the wheels, with the wheel and the rack, or with the cam and the roller: indices into
    /// [`LinkageSpec::links`](super::LinkageSpec::links); `None`: the ground.
    pub wheels: [Option<usize>; 2],
    /// The link that carries both; `None`: the ground. Of a cam its own link.
    pub carrier: Option<usize>,
    /// Gears, a belt, a rack, or a cam.
    pub kind: CouplingKind,
    /// Angle of the second wheel, or displacement of the rack, seen from the carrier, where the
    /// first wheel's angle is zero (rad or m). Of a cam 0.
    pub offset: f64,
}

/// Kind of a coupling; of wheels with its ratio ρ, seen from the carrier.
#[derive(Clone, Debug, PartialEq)]
pub enum CouplingKind {
    /// Two gears: angle of the second over that of the first, negative for external teeth.
    Gear {
        /// ρ ≠ 0, and ≠ 1.
        ratio: f64,
    },
    /// A belt or chain over two pulleys.
    Belt {
        /// Radii (m): the first positive, the second negative for a crossed belt; ρ = r₁/r₂.
        radii: [f64; 2],
    },
    /// A gear and a rack on a guide of the carrier.
    Rack {
        /// Displacement of the rack along the guide over the angle of the gear ≠ 0 (m): the radius
        /// of the pitch circle. Positive: the rack lies to the right of the gear, seen along the
        /// guide.
        radius: f64,
    },
    /// A cam on which a roller or a point of another link runs.
    Cam(Box<CamPairSpec>),
}

impl CouplingKind {
    /// Ratio ρ: of two angles, or of the rack's displacement to the angle (m); 0 of a cam, which
    /// has none.
    pub fn ratio(&self) -> f64 {
        match *self {
            Self::Gear { ratio } => ratio,
            Self::Belt {
                radii: [one, other],
            } => one / other,
            Self::Rack { radius } => radius,
            Self::Cam(_) => 0.0,
        }
    }
}
