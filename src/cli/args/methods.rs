//! Arguments of `dam methods`.

use super::positive_seconds;
use crate::cli::args::scene::{OutArgs, SceneArgs};
use clap::Args;

/// Arguments of `dam methods`.
#[derive(Debug, Args)]
pub(crate) struct MethodsArgs {
    #[command(flatten)]
    pub(crate) scene: SceneArgs,
    /// Error of δ wanted, relative to max|δ|: a method is recommended for it; with --models the
    /// model is chosen for it too [default: run.tolerance of the scene; with --models 0.01]
    #[arg(long, value_name = "ERROR", value_parser = parse_share)]
    pub(crate) accuracy: Option<f64>,
    /// Methods to try, by name; errors are taken against `exact` where it applies,
    /// named or not [default: all]
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    pub(crate) methods: Vec<String>,
    /// Tolerances to try [default: 1e-3, 1e-4, … 1e-13]
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = parse_share)]
    pub(crate) tolerances: Vec<f64>,
    /// Steps to try with methods of fixed step, in seconds. The greatest stable one is
    /// measured on this motion. The run grows to no more than three times what it should be.
    /// [default: from just beyond the greatest stable step downwards, halved each time]
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = positive_seconds)]
    pub(crate) steps: Vec<f64>,
    /// Choose the model too (rigid, static, modes, masses), and chart its error as a floor under
    /// the methods: they need to be no better than a tenth of it
    #[arg(long, conflicts_with = "x")]
    pub(crate) models: bool,
    /// Timed runs of each point; their median counts
    #[arg(long, value_name = "COUNT", default_value_t = 5,
          value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub(crate) repeats: u32,
    /// Longest wall-clock time of a point: one that takes longer is marked so,
    /// and finer settings are left out (seconds)
    #[arg(long, value_name = "SECONDS", default_value = "5", value_parser = positive_seconds)]
    pub(crate) point_limit: f64,
    /// Repeat over a parameter and chart where methods start to fail:
    /// rocker.stiffness=1e6:1e9:40:log
    #[arg(long, value_name = "PATH=FROM:TO:COUNT[:log]")]
    pub(crate) x: Option<String>,
    #[command(flatten)]
    pub(crate) out: OutArgs,
}

fn parse_share(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(value) if value > 0.0 && value < 1.0 => Ok(value),
        Ok(_) => Err("must be above 0 and below 1".to_owned()),
        Err(error) => Err(error.to_string()),
    }
}
