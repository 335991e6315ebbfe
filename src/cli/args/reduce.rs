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
    /// A figure that is asked for, rocker.delta_abs (may be repeated) [default: those of
    /// run.accuracy, else those that the scene expects, else of every elastic object the greatest
    /// |δ| and the contact force]
    #[arg(long, value_name = "FIGURE")]
    pub(crate) figure: Vec<String>,
    #[command(flatten)]
    pub(crate) out: OutArgs,
}
