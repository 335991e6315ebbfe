//! Arguments of `dam find`.

use crate::cli::args::scene::{OutArgs, SceneArgs};
use crate::studies::find::Aim;
use clap::Args;

/// Arguments of `dam find`.
#[derive(Debug, Args)]
pub(crate) struct FindArgs {
    #[command(flatten)]
    pub(crate) scene: SceneArgs,
    /// The parameter and its range: shaft.motion.speed=100:900 rpm; with :PLACES for another number
    /// of values that are looked at first (33), with :log for equal ratios between them
    #[arg(long, value_name = "PATH=FROM:TO")]
    pub(crate) vary: String,
    /// A condition on a result of the run or of another study, in any unit (may be repeated):
    /// "valve.pair.max_contact_force <= 900 N", "steady.fluctuation <= 2 %". With = the values at
    /// which the result is met
    #[arg(long, value_name = "CONDITION")]
    pub(crate) subject: Vec<String>,
    /// Find the greatest: the parameter itself, or a figure
    #[arg(
        long,
        value_name = "PATH",
        visible_alias = "maximise",
        conflicts_with = "minimize"
    )]
    pub(crate) maximize: Option<String>,
    /// Find the least: the parameter itself, or a figure
    #[arg(long, value_name = "PATH", visible_alias = "minimise")]
    pub(crate) minimize: Option<String>,
    /// Threads; one for every processor core if not given
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) threads: Option<u16>,
    #[command(flatten)]
    pub(crate) out: OutArgs,
}

/// What is to be greatest or least; `None`: nothing.
pub(crate) fn goal(maximize: &Option<String>, minimize: &Option<String>) -> Option<(Aim, String)> {
    let greatest = maximize.iter().map(|of| (Aim::Maximize, of));
    let least = minimize.iter().map(|of| (Aim::Minimize, of));
    let mut all = greatest.chain(least);
    all.next().map(|(aim, of)| (aim, of.clone()))
}
