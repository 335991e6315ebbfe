//! Arguments of `dam law …`.

use crate::cli::args::scene::OutArgs;
use crate::cli::args::scene::SceneArgs;
use clap::{Args, Subcommand, ValueEnum};

/// Commands on laws of motion.
#[derive(Debug, Subcommand)]
pub(crate) enum LawCommand {
    /// List the named laws with their constants
    List(ListArgs),
    /// Show one law: constants, shocks, samples, diagrams
    Show(ShowArgs),
    /// Work out a stroke of run-up, uniform section and run-out
    #[command(visible_alias = "synthesise")]
    Synthesize(SynthesizeArgs),
    /// Show the whole cycle of a cam or plan in a scene: joints, extremes, shocks
    Cycle(CycleArgs),
    /// Rank laws by their constants and by the response of a scene
    Compare(CompareArgs),
}

impl LawCommand {
    /// True when the answer is wanted as JSON.
    pub(crate) fn json(&self) -> bool {
        match self {
            Self::List(args) => args.json,
            Self::Show(args) => args.form.json,
            Self::Synthesize(args) => args.form.json,
            Self::Cycle(args) => args.scene.json,
            Self::Compare(args) => args.scene.json,
        }
    }
}

/// Arguments of `dam law list`.
#[derive(Debug, Args)]
pub(crate) struct ListArgs {
    /// Print one JSON document
    #[arg(long)]
    pub(crate) json: bool,
    /// Print tables as CSV
    #[arg(long, conflicts_with = "json")]
    pub(crate) csv: bool,
}

/// In which form a law is shown.
#[derive(Debug, Args)]
pub(crate) struct FormArgs {
    /// Print one JSON document
    #[arg(long, conflicts_with = "form")]
    pub(crate) json: bool,
    /// In which form
    #[arg(long, value_enum, default_value_t = LawForm::Text)]
    pub(crate) form: LawForm,
    /// Equal steps of the samples in CSV
    #[arg(long, default_value_t = 360, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub(crate) samples: u32,
    #[command(flatten)]
    pub(crate) out: OutArgs,
}

/// Forms of output.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum LawForm {
    /// Plain text
    Text,
    /// Samples as a table
    Csv,
    /// Diagrams
    Svg,
}

/// Arguments of `dam law show`.
#[derive(Debug, Args)]
pub(crate) struct ShowArgs {
    /// The law: a name of `dam law list`, scca:B,D, trapezoid:S1,S2, or JSON as in a scene
    pub(crate) law: String,
    /// Take it as the law of a run-up (some names stand for both)
    #[arg(long)]
    pub(crate) run_up: bool,
    #[command(flatten)]
    pub(crate) form: FormArgs,
}

/// Arguments of `dam law synthesize`. Three of stroke, span, peak speed and
/// uniform section are given; the fourth follows.
#[derive(Debug, Args)]
pub(crate) struct SynthesizeArgs {
    /// Law of the run-up: a name, trapezoid:S1,S2, or JSON as in a scene
    #[arg(long, value_name = "LAW")]
    pub(crate) run_up: String,
    /// Law of the run-out, counted backwards; default: that of the run-up
    #[arg(long, value_name = "LAW")]
    pub(crate) run_out: Option<String>,
    /// Whole stroke: "50 mm", "30 deg"; negative: in the other direction
    #[arg(long, value_name = "LENGTH|ANGLE", allow_hyphen_values = true)]
    pub(crate) stroke: Option<String>,
    /// Angle of the driver for it: "120 deg"
    #[arg(long, value_name = "ANGLE", allow_hyphen_values = true)]
    pub(crate) span: Option<String>,
    /// Greatest speed per speed of the driver: "34 mm/rad", or a number
    #[arg(long, value_name = "PER_ANGLE", allow_hyphen_values = true)]
    pub(crate) peak_speed: Option<String>,
    /// Share of the stroke in uniform motion
    #[arg(long, value_name = "SHARE", allow_hyphen_values = true)]
    pub(crate) uniform_stroke: Option<f64>,
    /// Share of the span with uniform motion
    #[arg(long, value_name = "SHARE", allow_hyphen_values = true)]
    pub(crate) uniform_span: Option<f64>,
    /// The uniform section with the least torque |Π′Π″|
    #[arg(long)]
    pub(crate) uniform_optimum: bool,
    /// Angle of the run-out by that of the run-up; default 1
    #[arg(long, value_name = "F", allow_hyphen_values = true, group = "skewed")]
    pub(crate) skewness: Option<f64>,
    /// Greatest acceleration of the run-up by that of the run-out, in place of the skewness
    #[arg(
        long,
        value_name = "LAMBDA",
        allow_hyphen_values = true,
        group = "skewed"
    )]
    pub(crate) acceleration_ratio: Option<f64>,
    /// The skewness for which the greatest Π″ of the run-up plus WEIGHT times that of the run-out is least
    #[arg(
        long,
        value_name = "WEIGHT",
        allow_hyphen_values = true,
        group = "skewed"
    )]
    pub(crate) least_acceleration: Option<f64>,
    /// The skewness for which the greatest Π′Π″ of the run-up plus WEIGHT times that of the run-out is least
    #[arg(
        long,
        value_name = "WEIGHT",
        allow_hyphen_values = true,
        group = "skewed"
    )]
    pub(crate) least_torque: Option<f64>,
    #[command(flatten)]
    pub(crate) form: FormArgs,
}

/// Arguments of `dam law compare`.
#[derive(Debug, Args)]
pub(crate) struct CompareArgs {
    #[command(flatten)]
    pub(crate) scene: SceneArgs,
    /// Where the law stands in the scene: valve.position.cam.law
    #[arg(long, value_name = "PATH")]
    pub(crate) at: String,
    /// A law to compare: a name, scca:B,D, or JSON as in a scene; repeat it; default: all named ones
    #[arg(long, value_name = "LAW")]
    pub(crate) law: Vec<String>,
    /// What the laws are ranked by
    #[arg(long, value_enum, default_value_t = RankBy::ContactForce)]
    pub(crate) by: RankBy,
    /// Also find the speed of the drive at which the pair begins to open (some 70 short runs a law)
    #[arg(long)]
    pub(crate) lift_off: bool,
    /// Print a table as CSV
    #[arg(long, conflicts_with = "json")]
    pub(crate) csv: bool,
    #[command(flatten)]
    pub(crate) out: OutArgs,
}

/// Figures of the response.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum RankBy {
    /// Residual vibration in the dwells
    Residual,
    /// Greatest deviation
    Deviation,
    /// Greatest contact force
    ContactForce,
    /// Greatest torque asked of the driver
    DriverTorque,
    /// Lift-off speed (needs --lift-off)
    LiftOff,
}

/// Arguments of `dam law cycle`.
#[derive(Debug, Args)]
pub(crate) struct CycleArgs {
    #[command(flatten)]
    pub(crate) scene: SceneArgs,
    /// The object that follows the cam
    #[arg(long, value_name = "OBJECT")]
    pub(crate) of: String,
    /// In which form
    #[arg(long, value_enum, default_value_t = LawForm::Text, conflicts_with = "json")]
    pub(crate) form: LawForm,
    /// Equal steps of the samples in CSV
    #[arg(long, default_value_t = 360, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub(crate) samples: u32,
    #[command(flatten)]
    pub(crate) out: OutArgs,
}
