//! Geometry of a disc cam and its follower, as plain numbers.

/// A disc cam and the follower that touches it.
///
/// The law of motion U(φ) says where the follower is; the geometry says how
/// it touches the cam. Lengths in metres, angles in radians.
#[derive(Clone, Debug, PartialEq)]
pub struct CamGeometry {
    /// Radius of the base circle, > 0: the smallest circle about the axis that
    /// the working profile touches (of a groove: its inner flank). There the
    /// follower is innermost.
    pub base_radius: f64,
    /// Guide of the follower.
    pub guide: Guide,
    /// Contact: the part of the follower that touches the cam.
    pub contact: Contact,
    /// Surface: the side of the cam that is touched.
    pub surface: Surface,
    /// +1: positive displacement takes the follower outwards, away from the
    /// axis; −1: inwards.
    pub outward: f64,
    /// +1: the cam turns counter-clockwise as its angle φ grows; −1: clockwise.
    pub sense: f64,
    /// For drawings. Translating: the direction of outward motion; turning:
    /// the direction from the cam's axis to the follower's.
    pub direction: f64,
    /// Interval of φ that the profile covers; `None`: a whole turn, closed.
    pub range: Option<(f64, f64)>,
    /// What cam and follower are made of, for the pressure between them.
    pub material: Option<CamMaterial>,
}

/// Material of cam and follower where they touch along a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CamMaterial {
    /// Length of the line of contact (m), > 0: the lesser of their thicknesses.
    pub thickness: f64,
    /// E* (Pa), > 0: 1/E* = (1 − ν₁²)/E₁ + (1 − ν₂²)/E₂.
    pub contact_modulus: f64,
    /// Young's moduli E of follower and cam (Pa), > 0.
    pub moduli: [f64; 2],
    /// Poisson's ratios ν of follower and cam.
    pub poisson_ratios: [f64; 2],
}

/// Guide of a follower.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Guide {
    /// Along a straight line.
    Translating {
        /// Distance of the line from the cam's axis, positive to the side on
        /// which the cam's surface moves outwards: a positive offset lowers
        /// the pressure angle while the follower moves outwards.
        offset: f64,
    },
    /// About a fixed axis.
    Turning {
        /// Distance between the axes of cam and follower, > 0.
        centre_distance: f64,
        /// From the follower's axis to the centre of the roller (the edge),
        /// > 0; without meaning for a flat face.
        arm: f64,
        /// +1: the follower moves outwards against the sense in which the cam
        /// turns; −1: with it.
        against: f64,
    },
}

impl Guide {
    /// The customary greatest pressure angle (rad): sliding followers jam sooner.
    pub fn customary_pressure_angle(self) -> f64 {
        match self {
            Self::Translating { .. } => 30f64.to_radians(),
            Self::Turning { .. } => 45f64.to_radians(),
        }
    }
}

/// Contact: the part of the follower that touches the cam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Contact {
    /// A roller, or a round face of that radius fixed to the follower.
    Roller {
        /// Radius of the roller, > 0.
        radius: f64,
    },
    /// A sharp edge.
    KnifeEdge,
    /// A flat face.
    Flat {
        /// Translating: angle between the face's normal and the direction of
        /// motion, |inclination| < π/2; positive where the normal is turned
        /// against the cam's sense of turning out of the direction of motion. Turning: not used.
        inclination: f64,
        /// Turning: distance of the face from the follower's axis, positive
        /// when the face lies between that axis and the cam. Translating: not used.
        face_offset: f64,
        /// Width of the face, to be compared with what is needed.
        width: Option<f64>,
    },
}

/// Surface: the side of the cam that is touched.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Surface {
    /// The outside of a disc.
    Disc,
    /// The inside of a hollow cam.
    Hollow,
    /// Both flanks of a groove.
    Groove,
}

impl CamGeometry {
    /// Radius of the roller; 0 of an edge, `None` of a flat face.
    pub fn roller(&self) -> Option<f64> {
        match self.contact {
            Contact::Roller { radius } => Some(radius),
            Contact::KnifeEdge => Some(0.0),
            Contact::Flat { .. } => None,
        }
    }

    /// Distance of the roller's centre (of the flat face) from the cam's axis
    /// when the follower is innermost: the prime circle.
    pub fn prime_radius(&self) -> f64 {
        self.surface
            .prime_radius(self.base_radius, self.roller().unwrap_or(0.0))
    }

    /// The geometry with another prime circle.
    #[must_use]
    pub fn with_prime_radius(&self, radius: f64) -> Self {
        let roller = self.roller().unwrap_or(0.0);
        let base_radius = match self.surface {
            Surface::Hollow => radius + roller,
            Surface::Disc | Surface::Groove => radius - roller,
        };
        Self {
            base_radius,
            ..self.clone()
        }
    }

    /// Offsets of the working profiles from the pitch curve, along the normal
    /// that points away from the axis.
    pub fn flanks(&self) -> Vec<f64> {
        self.surface.flanks(self.roller().unwrap_or(0.0))
    }
}

impl Surface {
    /// Radius of the pitch circle that belongs to a base circle and a roller.
    pub fn prime_radius(self, base: f64, roller: f64) -> f64 {
        match self {
            Self::Hollow => base - roller,
            Self::Disc | Self::Groove => base + roller,
        }
    }

    /// Offsets of the working profiles from the pitch curve of a roller, along the normal that
    /// points away from the axis.
    pub fn flanks(self, roller: f64) -> Vec<f64> {
        match self {
            Self::Disc => vec![-roller],
            Self::Hollow => vec![roller],
            Self::Groove => vec![-roller, roller],
        }
    }
}
