//! Arguments of `dam linearise` and `dam response`.

use crate::cli::args::scene::{OutArgs, SceneArgs};
use clap::Args;

/// Arguments of `dam linearise`.
#[derive(Debug, Args)]
pub(crate) struct LineariseArgs {
    #[command(flatten)]
    pub(crate) scene: SceneArgs,
    #[command(flatten)]
    pub(crate) out: OutArgs,
}

/// Arguments of `dam response`.
#[derive(Debug, Args)]
pub(crate) struct ResponseArgs {
    #[command(flatten)]
    pub(crate) scene: SceneArgs,
    /// Frequencies: 10:4000 Hz, with :200 behind it so many, with :linear equal differences between
    /// them; or a list: 10,500,1500 Hz [default: around all natural frequencies]
    #[arg(long, value_name = "LOW:HIGH[:COUNT]|LIST", allow_hyphen_values = true)]
    pub(crate) frequencies: Option<String>,
    /// An input: rocker.law, rocker.load (may be repeated) [default: every law]
    #[arg(long, value_name = "NAME")]
    pub(crate) input: Vec<String>,
    /// An output: rocker.delta, rocker.reaction (may be repeated) [default: all]
    #[arg(long, value_name = "NAME")]
    pub(crate) output: Vec<String>,
    /// Error of the model up to which a response counts as right [default: 1 %]
    #[arg(long, value_name = "SHARE")]
    pub(crate) accuracy: Option<String>,
    #[command(flatten)]
    pub(crate) out: OutArgs,
}

/// Arguments of `dam orders`.
#[derive(Debug, Args)]
pub(crate) struct OrdersArgs {
    #[command(flatten)]
    pub(crate) scene: SceneArgs,
    /// Speeds of the drive: 0:3000 rpm [default: up to twice the speed of the scene]
    #[arg(long, value_name = "LOW:HIGH", allow_hyphen_values = true)]
    pub(crate) speeds: Option<String>,
    /// Highest order of the drive
    #[arg(long, value_name = "ORDER", default_value_t = 20, value_parser = clap::value_parser!(u16).range(1..=10_000))]
    pub(crate) highest: u16,
    /// Amplitude of a deviation from which on a resonance counts: "0.1 mrad" [default: 1 % of the
    /// greatest deviation at the speed of the scene]
    #[arg(long, value_name = "DEVIATION")]
    pub(crate) accuracy: Option<String>,
    /// Speeds at which the greatest deviation is found
    #[arg(long, value_name = "COUNT", default_value_t = 60, value_parser = clap::value_parser!(u16).range(2..=10_000))]
    pub(crate) points: u16,
    #[command(flatten)]
    pub(crate) out: OutArgs,
}
