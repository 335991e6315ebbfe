//! Arguments of `dam forces`.

use super::CourseArgs;
use crate::cli::args::scene::{OutArgs, SceneArgs};
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// Arguments of `dam forces`.
#[derive(Debug, Args)]
pub(crate) struct ForcesArgs {
    #[command(flatten)]
    pub(crate) scene: SceneArgs,
    #[command(flatten)]
    pub(crate) course: CourseArgs,
    /// Over the motion in the record of a run of this scene: out/record.csv
    #[arg(long, value_name = "FILE", group = "over", conflicts_with_all = ["speed", "acceleration", "compare_massless"])]
    pub(crate) record: Option<PathBuf>,
    /// At chosen positions of the input, with a table of the reactions: 0:330:30 deg, or one of
    /// them: 30 deg
    #[arg(
        long,
        value_name = "FROM:TO:STEP",
        allow_hyphen_values = true,
        group = "over",
        conflicts_with = "positions"
    )]
    pub(crate) at: Option<String>,
    /// Number of equal intervals
    #[arg(long, default_value_t = 360, value_parser = clap::value_parser!(u32).range(1..=100_000))]
    pub(crate) positions: u32,
    /// The output whose load the dynamic transmission ratio refers to, and by name the forces that
    /// are this load: ram, or ram=cutting,drag. Default the only output with a force on its link
    #[arg(long, value_name = "OUTPUT[=FORCES]")]
    pub(crate) load: Option<String>,
    /// Sign of the dynamic transmission ratio [default: paper]
    #[arg(long, value_enum)]
    pub(crate) convention: Option<ConventionName>,
    /// Leave all friction out
    #[arg(long)]
    pub(crate) frictionless: bool,
    /// Direction of sliding where the input rests; without it friction at rest is not determined
    #[arg(long, value_enum)]
    pub(crate) direction: Option<Direction>,
    /// Compare the transmission ratio without masses with the full one at these values of
    /// m·ω²/P: 0.1,0.4,2.5,10
    #[arg(long, value_name = "LIST", value_delimiter = ',')]
    pub(crate) compare_massless: Vec<f64>,
    /// Print all positions as CSV
    #[arg(long, conflicts_with = "json")]
    pub(crate) csv: bool,
    #[command(flatten)]
    pub(crate) out: OutArgs,
}

/// Signs of the dynamic transmission ratio.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ConventionName {
    /// Without masses and friction −|i|
    Paper,
    /// Without masses and friction +|i|
    #[value(name = "load_positive")]
    LoadPositive,
}

/// Directions of the input.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Direction {
    /// Along the input coordinate
    Forwards,
    /// Against it
    Backwards,
}
