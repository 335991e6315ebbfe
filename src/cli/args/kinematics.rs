//! Arguments of `dam kinematics`.

use super::CourseArgs;
use crate::cli::args::scene::{OutArgs, SceneArgs};
use clap::Args;

/// Arguments of `dam kinematics`.
#[derive(Debug, Args)]
pub(crate) struct KinematicsArgs {
    #[command(flatten)]
    pub(crate) scene: SceneArgs,
    #[command(flatten)]
    pub(crate) course: CourseArgs,
    /// Of a linkage of several inputs: one that moves, from and to where, or is held:
    /// left=0:180 deg, right=40 deg; left alone goes a turn or as far as it can
    #[arg(
        long = "input",
        value_name = "NAME[=VALUE]",
        allow_hyphen_values = true,
        conflicts_with = "over"
    )]
    pub(crate) inputs: Vec<String>,
    /// Number of equal intervals
    #[arg(long, default_value_t = 360, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub(crate) positions: u32,
    /// Speed of the input at every position of a turn or range: "300 rpm", "0.2 m/s"; of several
    /// inputs for each: "left=300 rpm"
    #[arg(long, value_name = "[INPUT=]SPEED", allow_hyphen_values = true)]
    pub(crate) speed: Vec<String>,
    /// Acceleration of the input at every position of a turn or range; of several inputs for each
    #[arg(long, value_name = "[INPUT=]ACCELERATION", allow_hyphen_values = true)]
    pub(crate) acceleration: Vec<String>,
    /// Print all positions as CSV
    #[arg(long, conflicts_with = "json")]
    pub(crate) csv: bool,
    /// Print the drawing of the position nearest to this place ("30 deg") as SVG
    #[arg(long, value_name = "PLACE", allow_hyphen_values = true, conflicts_with_all = ["json", "csv"])]
    pub(crate) svg: Option<String>,
    #[command(flatten)]
    pub(crate) out: OutArgs,
}
