//! Arguments of `dam gradient`.

use crate::cli::args::scene::{OutArgs, SceneArgs};
use clap::Args;

/// Arguments of `dam gradient`.
#[derive(Debug, Args)]
pub(crate) struct GradientArgs {
    #[command(flatten)]
    pub(crate) scene: SceneArgs,
    /// Numbers of the scene by which results are differentiated:
    /// rocker.inertia,rocker.loads.closing.constant
    #[arg(long, value_name = "PATHS", value_delimiter = ',', required = true)]
    pub(crate) by: Vec<String>,
    /// Results of elastic objects [default: those asked for most]:
    /// rocker.delta_max,rocker.pair.margin
    #[arg(
        long,
        value_name = "FIGURES",
        value_delimiter = ',',
        visible_alias = "figure"
    )]
    pub(crate) figures: Vec<String>,
    /// Compare the derivatives with differences of runs, also of many parameters or events [default:
    /// up to 5 parameters and 1000 events]
    #[arg(long, conflicts_with = "no_check")]
    pub(crate) check: bool,
    /// Do not compare the derivatives with differences of runs
    #[arg(long)]
    pub(crate) no_check: bool,
    /// Print the table as CSV
    #[arg(long, conflicts_with = "json")]
    pub(crate) csv: bool,
    #[command(flatten)]
    pub(crate) out: OutArgs,
}
