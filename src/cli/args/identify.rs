//! Arguments of `dam identify`.

use crate::cli::args::scene::{OutArgs, SceneArgs};
use clap::{Args, ValueEnum};

/// Arguments of `dam identify`.
#[derive(Debug, Args)]
pub(crate) struct IdentifyArgs {
    #[command(flatten)]
    pub(crate) scene: SceneArgs,
    /// A record of the motion (may be repeated) [default: those of the scene's block `identify`]: a CSV
    /// file with a header; its first column is the time. Settings for this record alone behind
    /// semicolons: "test.csv; shaft.motion.speed=300 rpm"
    #[arg(long, value_name = "FILE")]
    pub(crate) record: Vec<String>,
    /// A column of the records and the signal that it measures (may be repeated): x=rocker.delta
    #[arg(long = "match", value_name = "COLUMN=SIGNAL")]
    pub(crate) matched: Vec<String>,
    /// A number that is sought, and its range (may be repeated): rocker.stiffness="5:20 MN m/rad";
    /// with :START for the value of the first start, with :log for equal ratios
    #[arg(long, value_name = "PATH=LOW:HIGH")]
    pub(crate) vary: Vec<String>,
    /// Standard deviation of a column, to weigh several against each other: "x=1 µrad"
    #[arg(long, value_name = "COLUMN=VALUE")]
    pub(crate) sigma: Vec<String>,
    /// Number of starts [default: 8]: the first at the values of the scene, the others evenly in the
    /// ranges
    #[arg(long, value_name = "COUNT")]
    pub(crate) starts: Option<usize>,
    /// Use the records up to there and leave out all later rows
    #[arg(long, value_enum)]
    pub(crate) until: Option<RecordEnd>,
    /// Threads; one for every processor core if not given
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) threads: Option<u16>,
    /// Print the records with the fit as CSV
    #[arg(long, conflicts_with = "json")]
    pub(crate) csv: bool,
    #[command(flatten)]
    pub(crate) out: OutArgs,
}

/// Up to where records are used.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum RecordEnd {
    /// The first separation of a contact in the scene as it is
    #[value(name = "first_separation")]
    FirstSeparation,
}
