//! From a scene's file to a system.

use super::console;
use super::failure::Failure;
use super::interrupt::{self, Stage};
use super::shown;
use crate::ask::{ModelAssessment, PointSource};
use crate::budget::Budget;
use crate::cli::args::scene::SceneArgs;
use crate::frontend::diagnostics::Diagnostics;
use crate::frontend::scene::{
    BuiltIn, Catalogue, Document, Folder, LayeredCatalogue, Overrides, Reading, read_bounded,
};
use std::fs;
use std::sync::Arc;

pub(crate) use crate::Mechanism as Ready;

/// A scene's text with everything that its decoding needs.
pub(crate) struct Input<'a> {
    document: Document,
    folder: Box<dyn Catalogue + Sync + 'a>,
    overrides: Overrides,
    budget: Budget<'a>,
}

impl<'a> Input<'a> {
    /// A text that is no file, with what it may copy from and the time that there is for it.
    #[cfg(feature = "live")]
    pub(crate) fn of_text(
        (name, text): (&str, &str),
        folder: impl Catalogue + Sync + 'a,
        budget: Budget<'a>,
    ) -> Result<Self, Failure> {
        Ok(Self {
            document: Document::parse(name, text.as_bytes())?,
            folder: Box::new(folder),
            overrides: Overrides::none(),
            budget,
        })
    }

    /// Reads and parses the scene: a file, or standard input for `-`.
    pub(crate) fn load(args: &SceneArgs) -> Result<Self, Failure> {
        let (name, read) = match args.scene.as_os_str() == STANDARD_INPUT {
            true => (
                "standard input".to_owned(),
                read_bounded(std::io::stdin().lock()),
            ),
            false => (
                args.scene.display().to_string(),
                fs::File::open(&args.scene).and_then(read_bounded),
            ),
        };
        let bytes = read.map_err(|error| format!("cannot read the scene `{name}`: {error}"))?;
        let document = Document::parse(&name, &bytes)?;
        shown::adopt_units(document.text());
        Ok(Self {
            document,
            // What comes from standard input has no folder of its own.
            folder: Box::new(match args.scene.as_os_str() == STANDARD_INPUT {
                true => Folder::new("objects"),
                false => Folder::beside_scene(&args.scene),
            }),
            overrides: Overrides::new(args.set.clone()),
            budget: *interrupt::budget(),
        })
    }

    /// The scene's text.
    pub(crate) fn text(&self) -> &str {
        self.document.text()
    }

    /// The scene's text as a tree.
    pub(crate) fn document(&self) -> &Document {
        &self.document
    }

    /// Catalogue in which `from` looks: the folder beside the scene, then what is built
    /// in.
    pub(crate) fn catalogue(
        &self,
    ) -> LayeredCatalogue<'_, dyn Catalogue + Sync + 'a, dyn Catalogue + Sync> {
        LayeredCatalogue(&*self.folder, &BuiltIn)
    }

    /// Decodes the scene with further overrides.
    pub(crate) fn decode(&self, further: &[String]) -> Result<Reading, Diagnostics> {
        let mut all = self.overrides.arguments().to_vec();
        all.extend_from_slice(further);
        self.document.scene(&self.catalogue(), &Overrides::new(all))
    }

    /// What points of the scene are prepared from.
    pub(crate) fn point_source(&self) -> PointSource<'_, '_> {
        PointSource {
            document: &self.document,
            catalogue: Arc::new(self.catalogue()),
            settings: self.overrides.arguments(),
        }
    }

    /// Decodes the scene and builds its system; every fault of one stage at once.
    pub(crate) fn prepare(&self, further: &[String]) -> Result<Ready, Failure> {
        self.prepare_judging(further, ModelAssessment::Needed)
    }

    /// The same as it stands, and prints what is doubtful in its text.
    pub(crate) fn prepare_and_warn(&self, quiet: bool) -> Result<Ready, Failure> {
        let ready = self.prepare(&[])?;
        print_doubts(&ready.reading, quiet);
        Ok(ready)
    }

    /// The same, with the model judged as far as is said.
    pub(crate) fn prepare_judging(
        &self,
        further: &[String],
        judging: ModelAssessment,
    ) -> Result<Ready, Failure> {
        let reading = self.decode(further)?;
        interrupt::enter(Stage::Preparing);
        let ready = Ready::of_within(reading, judging, &self.budget)?;
        interrupt::enter(Stage::Answering);
        Ok(ready)
    }
}

/// Prints what is doubtful in the text of a scene.
pub(crate) fn print_doubts(reading: &Reading, quiet: bool) {
    if !quiet && !reading.warnings.is_empty() {
        console::diagnose(&reading.warnings);
    }
}

/// Stands for standard input in place of a file.
const STANDARD_INPUT: &str = "-";
