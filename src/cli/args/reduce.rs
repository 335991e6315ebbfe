//! Arguments of `dam reduce`.

use crate::cli::args::scene::{OutArgs, SceneArgs};
use clap::Args;

/// Arguments of `dam reduce`.
#[derive(Debug, Args)]
pub(crate) struct ReduceArgs {
    #[command(flatten)]
    pub(crate) scene: SceneArgs,
    /// How accurate the figures are to be: all, `1 %`, or one, `rocker.delta_abs="0.1 mrad"` (may
    /// be repeated) [default: run.accuracy of the scene, else 1 %]
    #[arg(long, value_name = "[FIGURE=]ACCURACY")]
    pub(crate) accuracy: Vec<String>,
    /// A result that must keep its accuracy: rocker.delta_abs (may be repeated) [default: those
    /// of run.accuracy, else of `expect`, else |δ| and contact force of elastic objects]
    #[arg(long, value_name = "FIGURE")]
    pub(crate) figure: Vec<String>,
    #[command(flatten)]
    pub(crate) out: OutArgs,
}
