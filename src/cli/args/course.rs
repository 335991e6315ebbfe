//! Which linkage is looked at, and over what.

use clap::Args;

/// Which linkage is looked at, and over what.
#[derive(Clone, Debug, Args)]
pub(crate) struct CourseArgs {
    /// The linkage, where the scene has several
    #[arg(long, value_name = "ID")]
    pub(crate) object: Option<String>,
    /// Over one turn of the input, after which everything repeats
    #[arg(long, group = "over")]
    pub(crate) turn: bool,
    /// Over a range of the input coordinate: 0:180 deg; at one position: 30:30 deg
    #[arg(
        long,
        value_name = "FROM:TO",
        allow_hyphen_values = true,
        group = "over"
    )]
    pub(crate) range: Option<String>,
    /// Over time, under the motion of the scene's drive; without a value over the scene's duration
    #[arg(long, value_name = "TIME", num_args = 0..=1, default_missing_value = "", group = "over")]
    pub(crate) time: Option<String>,
    /// With several inputs: one that moves, from and to where, or is held: left=0:180 deg,
    /// right=40 deg. The name alone: a turn, or as far as it can
    #[arg(
        long = "input",
        value_name = "NAME[=VALUE]",
        allow_hyphen_values = true,
        conflicts_with = "over"
    )]
    pub(crate) inputs: Vec<String>,
    /// Speed of the input at every position of a turn or range: "300 rpm", "0.2 m/s"; of several
    /// inputs for each: "left=300 rpm"
    #[arg(long, value_name = "[INPUT=]SPEED", allow_hyphen_values = true)]
    pub(crate) speed: Vec<String>,
    /// Acceleration of the input at every position of a turn or range; of several inputs for each
    #[arg(long, value_name = "[INPUT=]ACCELERATION", allow_hyphen_values = true)]
    pub(crate) acceleration: Vec<String>,
}

impl CourseArgs {
    /// Whether nothing is said but which linkage it is.
    pub(crate) fn is_of_scene(&self) -> bool {
        !self.turn
            && self.range.is_none()
            && self.time.is_none()
            && self.inputs.is_empty()
            && self.speed.is_empty()
            && self.acceleration.is_empty()
    }
}
