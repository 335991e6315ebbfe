//! Arguments of `dam steady`.

// Doc comments of arguments are the help of the program: `[deg]` is a unit.
#![allow(rustdoc::broken_intra_doc_links)]

use crate::cli::args::scene::{OutArgs, SceneArgs};
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// Arguments of `dam steady`.
#[derive(Debug, Args)]
pub(crate) struct SteadyArgs {
    /// The scene: a JSON file; - reads it from standard input
    #[arg(required_unless_present_any = ["table", "inertia"])]
    pub(crate) scene: Option<PathBuf>,
    /// Set a property before anything else: crank.inertia=0.02
    #[arg(long = "set", value_name = "PATH=VALUE", conflicts_with_all = ["table", "inertia"])]
    pub(crate) set: Vec<String>,
    #[command(flatten)]
    pub(crate) machine: MachineArgs,
    #[command(flatten)]
    pub(crate) question: QuestionArgs,
    #[command(flatten)]
    pub(crate) out: OutArgs,
    /// Print one JSON document on standard output and nothing else there
    #[arg(long)]
    pub(crate) json: bool,
    /// In which form
    #[arg(long, value_enum, default_value_t = SteadyForm::Text, conflicts_with = "json")]
    pub(crate) form: SteadyForm,
    /// Say nothing on standard error but errors
    #[arg(long, short)]
    pub(crate) quiet: bool,
}

/// A machine that is not a scene.
#[derive(Debug, Args)]
pub(crate) struct MachineArgs {
    /// Samples of a machine in place of a scene: a CSV file with the columns phi [deg], J [kg m^2]
    /// and A [N m] (work) or M [N m] (moment)
    #[arg(long, value_name = "FILE", conflicts_with_all = ["scene", "inertia"])]
    pub(crate) table: Option<PathBuf>,
    /// Reduced moment of inertia as an expression of phi (radians): "1.5 + 0.2*cos(phi)"
    #[arg(
        long,
        value_name = "EXPRESSION",
        conflicts_with = "scene",
        allow_hyphen_values = true
    )]
    pub(crate) inertia: Option<String>,
    /// Work of all forces as an expression of phi (J)
    #[arg(
        long,
        value_name = "EXPRESSION",
        requires = "inertia",
        conflicts_with_all = ["scene", "table"],
        allow_hyphen_values = true
    )]
    pub(crate) work: Option<String>,
    /// Moment of all forces as an expression of phi (N m)
    #[arg(
        long,
        value_name = "EXPRESSION",
        requires = "inertia",
        conflicts_with_all = ["scene", "table", "work"],
        allow_hyphen_values = true
    )]
    pub(crate) moment: Option<String>,
}

/// The question; in place of what the scene's `steady` block says.
#[derive(Debug, Args)]
pub(crate) struct QuestionArgs {
    /// Required mean speed: "300 rpm"
    #[arg(long, value_name = "SPEED", allow_hyphen_values = true)]
    pub(crate) mean_speed: Option<String>,
    /// What is meant by it
    #[arg(long, value_enum)]
    pub(crate) mean: Option<MeanChoice>,
    /// Angle after which the machine repeats: "720 deg"; default: as many turns as its ratios ask for
    #[arg(long, value_name = "ANGLE", allow_hyphen_values = true)]
    pub(crate) cycle: Option<String>,
    /// Add the constant moment that makes the work of a cycle zero
    #[arg(long)]
    pub(crate) balance: bool,
    /// Required coefficient of fluctuation (ω_max − ω_min)/ω_av: sizes a flywheel
    #[arg(long, value_name = "DELTA", allow_hyphen_values = true)]
    pub(crate) fluctuation: Option<String>,
    /// Elastic scenes: turns of the drive after which the motion may repeat, at most
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u16).range(1..=64))]
    pub(crate) periods: Option<u16>,
}

/// Readings of the mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum MeanChoice {
    /// Angle turned over time
    Time,
    /// Mean of ω over the angle
    Angle,
    /// Midway between the extremes
    Midrange,
}

/// Forms of output.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum SteadyForm {
    /// Plain text
    Text,
    /// The motion over the cycle as a table
    Csv,
    /// The energy-mass diagram
    Svg,
}

impl SteadyArgs {
    /// As the arguments of other commands on a scene.
    pub(crate) fn scene(&self) -> Option<SceneArgs> {
        Some(SceneArgs {
            scene: self.scene.clone()?,
            set: self.set.clone(),
            json: self.json,
            quiet: self.quiet,
        })
    }
}
