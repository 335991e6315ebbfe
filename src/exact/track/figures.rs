//! Figures of one object of a tree, and when they are met.

/// Figures of one object of a tree.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TreeFigures {
    /// Greatest δ.
    pub delta_max: f64,
    /// Least δ.
    pub delta_min: f64,
    /// Mean of |δ| over the run.
    pub sigma: f64,
    /// Greatest |φ̇| of the last mass.
    pub peak_speed: f64,
    /// Greatest |φ̈| of the last mass, both sides of a switch included.
    pub peak_acceleration: f64,
    /// Greatest |F| of link 1; with a pair also its greatest contact force.
    pub peak_reaction: f64,
    /// Greatest clearance from the nearest flank.
    pub max_lift: f64,
    /// Instants at which they are met.
    pub times: FigureTimes,
}

/// Instants of the extremes of an object (s); 0 where nothing passed the start.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FigureTimes {
    /// Of the greatest δ.
    pub delta_max: f64,
    /// Of the least δ.
    pub delta_min: f64,
    /// Of the greatest |φ̇|.
    pub peak_speed: f64,
    /// Of the greatest |φ̈|.
    pub peak_acceleration: f64,
    /// Of the greatest |F|.
    pub peak_reaction: f64,
    /// Of the greatest clearance.
    pub max_lift: f64,
}
