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
    /// Number of equal intervals
    #[arg(long, default_value_t = 360, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub(crate) positions: u32,
    /// Print all positions as CSV
    #[arg(long, conflicts_with = "json")]
    pub(crate) csv: bool,
    /// Print the drawing of the position nearest to this place ("30 deg") as SVG
    #[arg(long, value_name = "PLACE", allow_hyphen_values = true, conflicts_with_all = ["json", "csv"])]
    pub(crate) svg: Option<String>,
    #[command(flatten)]
    pub(crate) out: OutArgs,
}
