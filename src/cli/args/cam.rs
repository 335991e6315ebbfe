//! Arguments of `dam cam`.

use crate::cli::args::scene::{OutArgs, SceneArgs};
use clap::{Args, ValueEnum};

/// Arguments of `dam cam`.
#[derive(Debug, Args)]
pub(crate) struct CamArgs {
    #[command(flatten)]
    pub(crate) scene: SceneArgs,
    /// The object whose cam is looked at; needed when several tell of one
    #[arg(long, value_name = "OBJECT")]
    pub(crate) object: Option<String>,
    /// Speed of the cam: "600 rpm" [default: that of the scene]
    #[arg(long, value_name = "SPEED", allow_hyphen_values = true)]
    pub(crate) speed: Option<String>,
    /// Greatest pressure angle while the follower moves outwards
    /// [default: 30 deg, of a turning follower 45 deg]
    #[arg(long, value_name = "ANGLE")]
    pub(crate) pressure_angle: Option<String>,
    /// Greatest pressure angle while it moves inwards [default: the same]
    #[arg(long, value_name = "ANGLE")]
    pub(crate) return_pressure_angle: Option<String>,
    /// Greatest radius of the roller by the least radius of curvature of its path [default: 0.7]
    #[arg(long, value_name = "SHARE")]
    pub(crate) roller_factor: Option<f64>,
    /// Least radius of curvature of a profile under a flat face [default: 0]
    #[arg(long, value_name = "LENGTH")]
    pub(crate) least_radius: Option<String>,
    /// What is to be left in contact: a share of the greatest force that would open it without the
    /// spring (0.2), or a force ("50 N") [default: 0.2]
    #[arg(long, value_name = "SHARE|FORCE")]
    pub(crate) reserve: Option<String>,
    /// Find the least speed at which the elastic follower cannot stay on its cam (some 70 short runs)
    #[arg(long)]
    pub(crate) lift_off: bool,
    /// How far curves may stand off their chords in files and drawings
    #[arg(long, value_name = "LENGTH", default_value = "1 um")]
    pub(crate) tolerance: String,
    /// Also the path of the centre of a cutter (grinding wheel) of this radius
    #[arg(long, value_name = "LENGTH")]
    pub(crate) cutter: Option<String>,
    /// What goes to standard output
    #[arg(long, value_enum, default_value_t = CamForm::Text, conflicts_with = "json")]
    pub(crate) form: CamForm,
    #[command(flatten)]
    pub(crate) out: OutArgs,
}

/// Forms of output.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum CamForm {
    /// Figures in words
    Text,
    /// Motion, pressure angle, curvature, force over the turn as CSV
    Cycle,
    /// The points of profile, pitch curve and cutter path as CSV
    Profile,
    /// The same as DXF (release 12, millimetres)
    Dxf,
    /// The cam with its follower as a drawing
    Svg,
}
