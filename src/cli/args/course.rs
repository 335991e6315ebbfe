//! Which linkage is looked at, and over what.

use clap::Args;

/// Which linkage is looked at, and over what.
#[derive(Debug, Args)]
pub(crate) struct CourseArgs {
    /// The linkage, where the scene has several
    #[arg(long, value_name = "ID")]
    pub(crate) object: Option<String>,
    /// Over one turn of the input, after which everything repeats
    #[arg(long, group = "over")]
    pub(crate) turn: bool,
    /// Over a range of the input coordinate: 0:180 deg
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
}
