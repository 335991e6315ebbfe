//! Arguments of `dam verify`.

use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// Arguments of `dam verify`.
#[derive(Debug, Args)]
pub(crate) struct VerifyArgs {
    /// The scenes: JSON files
    #[arg(required = true)]
    pub(crate) scenes: Vec<PathBuf>,
    /// Set a property of all of them before anything else: rocker.masses=10
    #[arg(long = "set", value_name = "PATH=VALUE")]
    pub(crate) set: Vec<String>,
    /// In which form
    #[arg(long, value_enum, default_value_t = VerifyForm::Text)]
    pub(crate) form: VerifyForm,
    /// Print one JSON document on standard output and nothing else there
    #[arg(long, conflicts_with = "form")]
    pub(crate) json: bool,
    /// Say nothing on standard error but errors
    #[arg(long, short)]
    pub(crate) quiet: bool,
}

/// Forms of output of `dam verify`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum VerifyForm {
    /// A table a scene
    Text,
    /// JUnit XML, as continuous integration reads it
    Junit,
}
