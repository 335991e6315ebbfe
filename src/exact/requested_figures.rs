//! Which figures a run is to find.

/// The figures asked of a run; those not asked for stay at zero, and nothing is
/// climbed to for them. Extremes of accelerations and forces are what takes the
/// time of a run with many switches.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RequestedFigures {
    /// Extremes of δ.
    pub deviation: bool,
    /// Mean of |δ|.
    pub mean: bool,
    /// Greatest |φ̇| of the last mass.
    pub speed: bool,
    /// Greatest |φ̈| of the last mass.
    pub acceleration: bool,
    /// Greatest force of link 1, which is also that of its contact.
    pub force: bool,
    /// Greatest clearance of an open pair.
    pub lift: bool,
}

impl RequestedFigures {
    /// All figures.
    pub const ALL: Self = Self {
        deviation: true,
        mean: true,
        speed: true,
        acceleration: true,
        force: true,
        lift: true,
    };

    /// Extremes of δ alone.
    pub const DEVIATION: Self = Self {
        deviation: true,
        mean: false,
        speed: false,
        acceleration: false,
        force: false,
        lift: false,
    };

    /// Union of what either asks for.
    #[must_use]
    pub fn union(self, other: Self) -> Self {
        Self {
            deviation: self.deviation | other.deviation,
            mean: self.mean | other.mean,
            speed: self.speed | other.speed,
            acceleration: self.acceleration | other.acceleration,
            force: self.force | other.force,
            lift: self.lift | other.lift,
        }
    }

    /// Of the four functionals of a panel, which are asked for: δ, φ̇, φ̈, and
    /// the force of an engaged link or the clearance of an open one.
    pub(super) fn functionals(self, engaged: bool) -> [bool; 4] {
        let fourth = if engaged { self.force } else { self.lift };
        [self.deviation, self.speed, self.acceleration, fourth]
    }
}
