//! Arguments that name a scene, and where results go.

use clap::Args;
use std::path::{Path, PathBuf};

/// What every command on a scene takes.
#[derive(Debug, Args)]
pub(crate) struct SceneArgs {
    /// The scene: a JSON file; - reads it from standard input
    pub(crate) scene: PathBuf,
    /// Set a property before anything else: rocker.masses=10
    #[arg(long = "set", value_name = "PATH=VALUE")]
    pub(crate) set: Vec<String>,
    /// Print one JSON document on standard output and nothing else there
    #[arg(long)]
    pub(crate) json: bool,
    /// Say nothing on standard error but errors
    #[arg(long, short)]
    pub(crate) quiet: bool,
}

impl SceneArgs {
    /// A scene as it stands in its file.
    pub(crate) fn of(scene: &Path) -> Self {
        Self {
            scene: scene.to_owned(),
            set: Vec::new(),
            json: false,
            quiet: false,
        }
    }
}

/// Where results go.
#[derive(Debug, Args)]
pub(crate) struct OutArgs {
    /// Folder for the result files; made if it does not exist
    #[arg(long, value_name = "DIR")]
    pub(crate) out: Option<PathBuf>,
    /// Replace files in the folder even if they are not this scene's results
    #[arg(long, requires = "out")]
    pub(crate) force: bool,
}
