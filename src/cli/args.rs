//! The command line's arguments.

mod cam;
mod course;
mod find;
mod forces;
mod gradient;
mod identify;
mod kinematics;
mod linear;
mod methods;
mod optimize;
mod reduce;
pub(crate) mod scene;
mod tolerance;
mod verify;

pub(crate) use cam::{CamArgs, CamForm};
pub(crate) use course::CourseArgs;
pub(crate) use find::{FindArgs, goal};
pub(crate) use forces::{ConventionName, Direction, ForcesArgs};
pub(crate) use gradient::GradientArgs;
pub(crate) use identify::{IdentifyArgs, RecordEnd};
pub(crate) use kinematics::KinematicsArgs;
pub(crate) use linear::{LineariseArgs, OrdersArgs, ResponseArgs};
pub(crate) use methods::MethodsArgs;
pub(crate) use optimize::OptimizeArgs;
pub(crate) use reduce::ReduceArgs;
pub(crate) use tolerance::ToleranceArgs;
pub(crate) use verify::{VerifyArgs, VerifyForm};

use super::law::args::LawCommand;
use super::steady::args::SteadyArgs;
use crate::frontend::scene::Template;
use crate::report::display_units::DisplayUnits;
use clap::builder::PossibleValue;
use clap::{Args, Parser, Subcommand, ValueEnum};
use scene::{OutArgs, SceneArgs};
use std::path::PathBuf;

/// Dynamic analysis of machine mechanisms: from a scene of elastic and rigid
/// objects to its motion, figures and pictures.
#[derive(Debug, Parser)]
#[command(name = "dam", version, about, max_term_width = 100)]
pub(crate) struct Cli {
    /// End after this much wall-clock time, keeping what was computed (seconds)
    #[arg(long, value_name = "SECONDS", value_parser = positive_seconds, global = true)]
    pub(crate) time_limit: Option<f64>,
    /// Units in which texts and pages show results, one for a quantity: mm,deg,rpm,kN; si for those
    /// of the SI [default: those that the scene uses]
    #[arg(long, value_name = "LIST", value_parser = units, global = true)]
    pub(crate) units: Option<DisplayUnits>,
    /// Significant digits of results in texts and on pages [default: 4; with `--units si` as many as
    /// each has]
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u8).range(1..=17), global = true)]
    pub(crate) significant: Option<u8>,
    /// What to do.
    #[command(subcommand)]
    pub(crate) command: Command,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Run a scene: its motion and its figures
    Run(RunArgs),
    /// Check a scene without running it
    Check(CheckArgs),
    /// Print the JSON Schema of scenes, for editors; or the results, units and codes of messages
    Schema(SchemaArgs),
    /// Begin a scene from a template
    New(NewArgs),
    /// Print the completions of a shell
    Completions(CompletionsArgs),
    /// Print the manual page of the program, or of a command: dam manual run | man -l -
    Manual(ManualArgs),
    /// Judge everything that scenes expect, by every study that it takes: a table, JUnit, the status
    Verify(VerifyArgs),
    /// Show the scene's object graph, its dynamic model and its equations
    Show(ShowArgs),
    /// Run a scene for several values of a parameter and compare the figures
    Compare(CompareArgs),
    /// Find the best value of a parameter under conditions on figures: the highest speed, the least
    /// preload, the smallest base circle
    Find(FindArgs),
    /// Derivatives of results by numbers of the scene, carried exactly through contacts
    Gradient(GradientArgs),
    /// Find the best values of several variables under conditions, from several starts
    Optimize(OptimizeArgs),
    /// What tolerances of dimensions make of results: stack, samples, the share that meets limits
    Tolerance(ToleranceArgs),
    /// Numbers of a scene from records of its motion, by least squares
    Identify(IdentifyArgs),
    /// Find the smallest scene that gives figures within their accuracy, and say what was left out
    Reduce(ReduceArgs),
    /// Laws of motion: list, show, synthesize, cycle, compare
    #[command(subcommand)]
    Law(LawCommand),
    /// Linear equations of elastic objects: matrices, state space A, B, C, D, natural modes, damping
    Linearise(LineariseArgs),
    /// Gain and phase over the frequency, with the peaks and the frequency up to which the model is
    /// right
    Response(ResponseArgs),
    /// Orders of the law and resonances over the speed of the drive: a Campbell diagram
    Orders(OrdersArgs),
    /// Work out the cam of an object: profile, checks, sizes, closing force, files to cut it
    Cam(CamArgs),
    /// Show a figure over one or two parameters, with a verdict and its cause for every point
    Map(MapArgs),
    /// Chart speed against accuracy of every method on a scene, and where and why methods fail
    Methods(MethodsArgs),
    /// Positions, transfer functions, speeds and accelerations of a linkage; the mechanism moving
    Kinematics(KinematicsArgs),
    /// Find the steady motion of a machine, size its flywheel; of an elastic scene the periodic
    /// motion and its stability
    Steady(SteadyArgs),
    /// Kinetostatics of a linkage: reactions, driving force, friction, transmission ratio, self-locking
    Forces(ForcesArgs),
    /// Change scenes in the browser, and watch their answers follow
    Studio(StudioArgs),
}

impl Command {
    /// True when standard output is to be one JSON document.
    pub(crate) fn json(&self) -> bool {
        match self {
            Self::Schema(_)
            | Self::New(_)
            | Self::Completions(_)
            | Self::Manual(_)
            | Self::Studio(_) => false,
            Self::Law(args) => args.json(),
            Self::Steady(args) => args.json,
            Self::Verify(args) => args.json,
            Self::Run(RunArgs { scene, .. })
            | Self::Check(CheckArgs { scene })
            | Self::Show(ShowArgs { scene, .. })
            | Self::Compare(CompareArgs { scene, .. })
            | Self::Find(FindArgs { scene, .. })
            | Self::Gradient(GradientArgs { scene, .. })
            | Self::Optimize(OptimizeArgs { scene, .. })
            | Self::Tolerance(ToleranceArgs { scene, .. })
            | Self::Identify(IdentifyArgs { scene, .. })
            | Self::Reduce(ReduceArgs { scene, .. })
            | Self::Linearise(LineariseArgs { scene, .. })
            | Self::Response(ResponseArgs { scene, .. })
            | Self::Orders(OrdersArgs { scene, .. })
            | Self::Cam(CamArgs { scene, .. })
            | Self::Map(MapArgs { scene, .. })
            | Self::Methods(MethodsArgs { scene, .. })
            | Self::Kinematics(KinematicsArgs { scene, .. })
            | Self::Forces(ForcesArgs { scene, .. }) => scene.json,
        }
    }
}

/// Arguments of `dam schema`.
#[derive(Debug, Args)]
pub(crate) struct SchemaArgs {
    /// Offer the ids of this scene for `input`, and what its catalogue has for `from`
    pub(crate) scene: Option<PathBuf>,
    /// What is described; all but scenes as one JSON document
    #[arg(long, value_name = "WHAT", value_enum, default_value_t = SchemaSubject::Scenes)]
    pub(crate) of: SchemaSubject,
}

/// What `dam schema` describes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum SchemaSubject {
    /// The JSON Schema of scenes
    Scenes,
    /// Addresses of results, with unit, sign and meaning
    Results,
    /// Quantities and units
    Units,
    /// Codes of messages, with cause and remedy
    Codes,
}

/// Arguments of `dam run`.
#[derive(Debug, Args)]
pub(crate) struct RunArgs {
    #[command(flatten)]
    pub(crate) scene: SceneArgs,
    #[command(flatten)]
    pub(crate) out: OutArgs,
    /// Columns of the record, in place of what the scene says: `all` adds every mass and link
    #[arg(long, value_enum, value_name = "COLUMNS")]
    pub(crate) record: Option<Columns>,
    /// What charts are over: time, angle (of the first drive that turns, counted on), turns (over
    /// each other, 0 to 360 deg), last-turn; of another drive: angle:shaft. Record.csv then begins
    /// with the angle, counted on
    #[arg(long, value_name = "time|angle|turns|last-turn")]
    pub(crate) abscissa: Option<String>,
    /// Also run with loads changed by one part in 10¹⁰ and show how far each figure moves
    #[arg(long)]
    pub(crate) spread: bool,
    /// Judge figures, the error of the model included, in place of what the scene says: how
    /// accurate all are to be, `1 %`, or one, `rocker.delta_abs="0.1 mrad"` (may be repeated)
    #[arg(long, value_name = "[FIGURE=]ACCURACY")]
    pub(crate) accuracy: Vec<String>,
}

/// Arguments of `dam studio`.
#[derive(Debug, Args)]
pub(crate) struct StudioArgs {
    /// A scene, or a folder of scenes; the folder one is in if not given
    #[arg(value_name = "SCENE|FOLDER")]
    pub(crate) target: Option<PathBuf>,
    /// Do not open the browser: print the address, which lets in whoever has it
    #[arg(long)]
    pub(crate) no_open: bool,
    /// Serve on this port of 127.0.0.1; any that is free if not given
    #[arg(long, value_name = "PORT", value_parser = clap::value_parser!(u16).range(1..))]
    pub(crate) port: Option<u16>,
}

/// Arguments of `dam new`.
#[derive(Debug, Args)]
pub(crate) struct NewArgs {
    /// What kind of mechanism
    #[arg(value_enum)]
    pub(crate) template: Template,
    /// The file to make; without it the scene is printed
    pub(crate) file: Option<PathBuf>,
}

impl ValueEnum for Template {
    fn value_variants<'a>() -> &'a [Self] {
        &Self::ALL
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        Some(PossibleValue::new(self.name()).help(self.meaning()))
    }
}

/// Arguments of `dam completions`.
#[derive(Debug, Args)]
pub(crate) struct CompletionsArgs {
    /// The shell
    #[arg(value_enum)]
    pub(crate) shell: clap_complete::Shell,
}

/// Arguments of `dam manual`.
#[derive(Debug, Args)]
pub(crate) struct ManualArgs {
    /// The command: run; law show; without it the program
    pub(crate) command: Vec<String>,
}

/// Columns of a record.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum Columns {
    /// Six of each object
    Objects,
    /// Displacement and speed of every mass and the force of every link too
    All,
}

/// Arguments of `dam check`.
#[derive(Debug, Args)]
pub(crate) struct CheckArgs {
    #[command(flatten)]
    pub(crate) scene: SceneArgs,
}

/// Arguments of `dam show`.
#[derive(Debug, Args)]
pub(crate) struct ShowArgs {
    #[command(flatten)]
    pub(crate) scene: SceneArgs,
    /// What to show
    #[arg(long, value_enum, default_value_t = View::All)]
    pub(crate) view: View,
    /// In which form; the object graph also as DOT or SVG, the equations also as LaTeX
    #[arg(long, value_enum, default_value_t = ShowForm::Text)]
    pub(crate) form: ShowForm,
}

/// The three models of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum View {
    /// All three
    All,
    /// The graph of objects
    Graph,
    /// Masses, links, loads and natural frequencies
    Model,
    /// The equations of motion
    Equations,
}

/// Forms of output of `dam show`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum ShowForm {
    /// Plain text
    Text,
    /// Graphviz (graph)
    Dot,
    /// A drawing (graph)
    Svg,
    /// LaTeX (equations)
    Latex,
}

/// Arguments of `dam compare`.
#[derive(Debug, Args)]
pub(crate) struct CompareArgs {
    #[command(flatten)]
    pub(crate) scene: SceneArgs,
    /// The parameter and its values: rocker.masses=1,2,10
    #[arg(long, value_name = "PATH=LIST")]
    pub(crate) over: String,
    /// Also compare a result of another study: frequency.1, steady.mean_time,
    /// cam.follower.least_radius, kinematics.press.ram.speed.greatest
    #[arg(long, value_name = "FIGURE")]
    pub(crate) figure: Vec<String>,
    /// What charts and records are over, as of `dam run`: time, angle, turns, last-turn
    #[arg(long, value_name = "time|angle|turns|last-turn")]
    pub(crate) abscissa: Option<String>,
    #[command(flatten)]
    pub(crate) out: OutArgs,
}

/// Arguments of `dam map`.
#[derive(Debug, Args)]
pub(crate) struct MapArgs {
    #[command(flatten)]
    pub(crate) scene: SceneArgs,
    /// The parameter along the map: rocker.inertia=0.05:1:20, or …:20:log; a unit may follow
    /// the ends: shaft.motion.speed=100:900 rpm:50. A number of masses may be 0: rigid, on its
    /// law, with lift-off where its pair would have to pull
    #[arg(long, value_name = "PATH=FROM:TO:COUNT")]
    pub(crate) x: String,
    /// The parameter up the map; without it the map is a curve
    #[arg(long, value_name = "PATH=FROM:TO:COUNT")]
    pub(crate) y: Option<String>,
    /// The figure shown, of the run or of another study (frequency.1, steady.mean_time,
    /// cam.follower.least_radius); max|δ| of the last elastic object if not given
    #[arg(long, value_name = "FIGURE")]
    pub(crate) figure: Option<String>,
    /// One map for each value: rocker.masses=1,2. Lists that go together are separated by
    /// semicolons; given several times, the lists multiply
    #[arg(long, value_name = "PATH=LIST")]
    pub(crate) panels: Vec<String>,
    /// Do not run every cell a second time with its loads changed by one part in 10¹⁰. Twice as
    /// fast, but nothing is said of cells whose figure is not determined
    #[arg(long)]
    pub(crate) unchecked: bool,
    /// Digits to which a figure is to be known. A cell whose figure moves by more than one of
    /// the last when its loads change by one part in 10¹⁰ is marked as not determined
    #[arg(long, value_name = "COUNT", default_value_t = 3, value_parser = clap::value_parser!(u8).range(1..=12))]
    pub(crate) digits: u8,
    /// Threads; one for every processor core if not given
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub(crate) threads: Option<u16>,
    #[command(flatten)]
    pub(crate) out: OutArgs,
    /// Go on where an interrupted map into the same folder was
    #[arg(long, requires = "out")]
    pub(crate) resume: bool,
    /// Work out these cells alone, counted row by row from 0 (TO is not among them), and print them
    /// for --merge: a map shared out over machines or jobs
    #[arg(long, value_name = "FROM:TO", conflicts_with_all = ["out", "resume", "merge", "json"])]
    pub(crate) cells: Option<String>,
    /// Put the map together of the outputs of --cells, all other arguments being the same
    #[arg(long, value_name = "FILE", num_args = 1.., conflicts_with = "resume")]
    pub(crate) merge: Vec<PathBuf>,
}

fn units(text: &str) -> Result<DisplayUnits, String> {
    DisplayUnits::listed(text)
}

pub(crate) fn positive_seconds(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        // Duration::from_secs_f64 panics beyond about 1.8e19 s.
        Ok(seconds) if seconds > 0.0 && seconds < 1e15 => Ok(seconds),
        Ok(_) => Err("must be above 0 and below 1e15 seconds".to_owned()),
        Err(error) => Err(error.to_string()),
    }
}
