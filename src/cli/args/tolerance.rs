//! Arguments of `dam tolerance`.

use crate::cli::args::scene::{OutArgs, SceneArgs};
use clap::Args;

/// Arguments of `dam tolerance`.
#[derive(Debug, Args)]
pub(crate) struct ToleranceArgs {
    #[command(flatten)]
    pub(crate) scene: SceneArgs,
    /// A number of the scene with its tolerance (may be repeated) [default: those of the scene's
    /// block `tolerance`]: rocker.pair.gap="±0.02 mm". Other forms are "+-0.02 mm uniform", "+0.01 -0.03 mm", "±1 %" and "h7". A limit is 3 standard
    /// deviations from the middle unless it is uniform. Numbers with commas between them deviate by
    /// the same
    #[arg(long, value_name = "PATH=TOLERANCE")]
    pub(crate) tol: Vec<String>,
    /// Results of the run or of other studies [default: those of the limits, else those of elastic
    /// objects asked for most]: rocker.delta_max,kinematics.press.ram.stroke
    #[arg(
        long,
        value_name = "FIGURES",
        value_delimiter = ',',
        visible_alias = "figure"
    )]
    pub(crate) figures: Vec<String>,
    /// A limit that samples are to meet, in any unit (may be repeated): "rocker.delta_max <= 0.2
    /// mrad"
    #[arg(long, value_name = "CONDITION")]
    pub(crate) limit: Vec<String>,
    /// Samples of the tolerances; 0 for the stack alone [default: 4096]
    #[arg(long, value_name = "COUNT")]
    pub(crate) samples: Option<usize>,
    /// Seed of the samples [default: 1]
    #[arg(long, value_name = "NUMBER")]
    pub(crate) seed: Option<u32>,
    /// Threads; one for every processor core if not given
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) threads: Option<u16>,
    /// Print the samples as CSV
    #[arg(long, conflicts_with = "json")]
    pub(crate) csv: bool,
    #[command(flatten)]
    pub(crate) out: OutArgs,
}
