//! Stick-slip states of directions with joint friction, and what probes do, as numbers
//! among the modes.

/// State of a direction with joint friction: of a free group's root, or of a linkage's
/// input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum StickSlip {
    /// Not known yet: friction is left out.
    Unset,
    /// Sliding against the positive direction.
    Backward,
    /// Held at rest by friction.
    Stuck,
    /// Sliding in the positive direction.
    Forward,
}

impl StickSlip {
    /// The state that a mode stands for.
    pub(crate) fn of(mode: i64) -> Self {
        match mode {
            0 => Self::Unset,
            2 => Self::Stuck,
            mode if mode < 0 => Self::Backward,
            _ => Self::Forward,
        }
    }

    /// The mode that stands for the state.
    pub(crate) const fn mode(self) -> i64 {
        match self {
            Self::Unset => 0,
            Self::Backward => -1,
            Self::Stuck => 2,
            Self::Forward => 1,
        }
    }

    /// −1 or 1 while sliding, else 0.
    pub(in crate::dynamics::system) const fn sense(self) -> f64 {
        match self {
            Self::Backward => -1.0,
            Self::Forward => 1.0,
            Self::Unset | Self::Stuck => 0.0,
        }
    }

    /// True while sliding.
    pub(in crate::dynamics::system) const fn slides(self) -> bool {
        matches!(self, Self::Backward | Self::Forward)
    }
}

/// Action of a probe where it fires.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ProbeAction {
    /// The direction breaks loose.
    Start(StickSlip),
    /// The run stops: the equations of motion have no solution, or several.
    Stop,
    /// Pairs press on another side.
    FlipSide,
}

impl ProbeAction {
    const STOP: i64 = 3;
    const FLIP_SIDE: i64 = 4;

    /// The action that a target of a switch stands for.
    pub(super) fn of(target: i64) -> Self {
        match target {
            Self::STOP => Self::Stop,
            Self::FLIP_SIDE => Self::FlipSide,
            mode => Self::Start(StickSlip::of(mode)),
        }
    }

    /// The target of a switch that stands for the action.
    pub(super) const fn target(self) -> i64 {
        match self {
            Self::Start(state) => state.mode(),
            Self::Stop => Self::STOP,
            Self::FlipSide => Self::FLIP_SIDE,
        }
    }
}
