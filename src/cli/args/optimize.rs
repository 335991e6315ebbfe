//! Arguments of `dam optimize`.

use crate::cli::args::scene::{OutArgs, SceneArgs};
use clap::Args;

/// Arguments of `dam optimize`.
#[derive(Debug, Args)]
pub(crate) struct OptimizeArgs {
    #[command(flatten)]
    pub(crate) scene: SceneArgs,
    /// A variable and its range (may be repeated) [default: those of the scene's block `optimize`]:
    /// rocker.inertia=0.05:0.4; with :START for the value of the first start, with :log for equal ratios
    #[arg(long, value_name = "PATH=LOW:HIGH")]
    pub(crate) vary: Vec<String>,
    /// A condition on a result of the run or of another study, in any unit (may be repeated):
    /// "valve.pair.margin >= 50 N", "valve.pair.in_working_order = true"
    #[arg(long, value_name = "CONDITION")]
    pub(crate) subject: Vec<String>,
    /// Find the greatest value of a result or of a variable
    #[arg(
        long,
        value_name = "PATH",
        visible_alias = "maximise",
        conflicts_with = "minimize"
    )]
    pub(crate) maximize: Option<String>,
    /// Find the least value of a result or of a variable
    #[arg(long, value_name = "PATH", visible_alias = "minimise")]
    pub(crate) minimize: Option<String>,
    /// Number of starts [default: 8]: the first at the values of the scene, the others evenly in all
    /// ranges
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u16).range(1..=1000))]
    pub(crate) starts: Option<u16>,
    /// Threads; one for every processor core if not given
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) threads: Option<u16>,
    #[command(flatten)]
    pub(crate) out: OutArgs,
}
