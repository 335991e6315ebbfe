//! Scenes as the library's user holds them.

use super::optimize::optimize;
use super::{
    FindQuestion, GradientQuestion, IdentifyQuestion, Mechanism, ModelAssessment, OptimizeQuestion,
    PointSource, PreparedScene, ToleranceQuestion,
};
use crate::Error;
use crate::frontend::diagnostics::{Diagnostic, Diagnostics};
use crate::frontend::object::{Kind, Registry};
use crate::frontend::read::Node;
use crate::frontend::scene::{
    BeforeBuiltIn, BuiltIn, Catalogue, Document, Folder, Overrides, Reading, read_bounded,
};
use crate::studies::Control;
use crate::studies::compare::{Comparison, compare};
use crate::studies::expectations::Requirement;
use crate::studies::find::FoundValue;
use crate::studies::forces::ForceStudy;
use crate::studies::gradient::Gradient;
use crate::studies::identify::Identification;
use crate::studies::kinematics::{Kinematics, Question};
use crate::studies::optimize::Optimization;
use crate::studies::run::RunResult;
use crate::studies::steady::Answer;
use crate::studies::tolerance::Tolerances;
use std::fmt;
use std::path::Path;
use std::str::FromStr;
use std::sync::Arc;

/// A scene: a mechanism, and how it is run. Read from JSON or built in code, with
/// properties set afterwards; checked whenever it is asked something.
///
/// ```
/// use dam::prelude::*;
///
/// let scene = Scene::new("A rocker on a shaft")
///     .add("shaft", Drive::speed("10 rev/s"))
///     .add("rocker", Rocker::on("shaft").position(Position::sine("90 deg")).masses(0).inertia(0.1))
///     .duration(0.2);
/// let run = scene.run()?;
/// assert_eq!(run.times().len(), run.speed("rocker")?.len());
/// # Ok::<(), Error>(())
/// ```
#[derive(Clone)]
pub struct Scene {
    document: Document,
    settings: Overrides,
    catalogue: Arc<dyn Catalogue + Send + Sync>,
    /// Faults of the building itself.
    faults: Vec<Diagnostic>,
}

impl Scene {
    /// A scene without objects.
    pub fn new(name: &str) -> Self {
        let mut root = Node::object();
        root.set_property("dam", 1);
        root.set_property("name", name);
        root.set_property("objects", Node::object());
        root.set_property("run", Node::object());
        Self::of(Document::of_values(root))
    }

    /// Reads a scene's file. Objects are copied (`from`) out of the folder `objects`
    /// beside it, then out of what is built in. Its tables may be files beside it.
    ///
    /// # Errors
    /// The file cannot be read, or is not strict JSON. What is wrong with the scene
    /// itself shows when it is asked something.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        let read = std::fs::File::open(path).and_then(read_bounded);
        let bytes = read.map_err(|error| Error::file(path, error))?;
        let document = Document::parse(&path.display().to_string(), &bytes)?;
        Ok(Self::of(document).with_catalogue(Folder::beside_scene(path)))
    }

    /// A scene from its JSON text.
    ///
    /// # Errors
    /// The text is not strict JSON.
    pub fn from_json(text: &str) -> Result<Self, Error> {
        Ok(Self::of(Document::parse("scene", text.as_bytes())?))
    }

    /// A scene of a document.
    pub fn of(document: Document) -> Self {
        Self {
            document,
            settings: Overrides::none(),
            catalogue: Arc::new(BuiltIn),
            faults: Vec::new(),
        }
    }

    /// With a further kind of objects, which takes the place of one of the same name.
    #[must_use]
    pub fn with_kind(mut self, kind: Kind) -> Self {
        let registry: Registry = self.document.kinds().clone();
        self.document = self.document.with_kinds(registry.with_kind(kind));
        self
    }

    /// With a catalogue that is looked into before what is built in.
    #[must_use]
    pub fn with_catalogue(mut self, catalogue: impl Catalogue + Send + Sync + 'static) -> Self {
        self.catalogue = Arc::new(BeforeBuiltIn(catalogue));
        self
    }

    /// Adds an object, of a builder of [`dam::build`](crate::frontend::build).
    #[must_use]
    pub fn add(mut self, id: &str, object: impl Into<Node>) -> Self {
        let (object, mut given_before) = (object.into(), false);
        self.document.edit(|root| {
            let objects = root.property("objects");
            given_before = objects.get(id).is_some();
            objects.set_property(id, object);
        });
        if given_before {
            let message = format!("the object `{id}` is given twice");
            let fault = Diagnostic::error("duplicate-property", message).path(id);
            self.faults
                .push(fault.hint("give each object an id of its own"));
        }
        self
    }

    /// Names a parameter, to which every number and every expression may refer:
    /// `.parameter("r", "50 mm")`, then `"2*r + 5 mm"`.
    #[must_use]
    pub fn parameter(mut self, name: &str, value: impl Into<Node>) -> Self {
        let value = value.into();
        self.document
            .edit(|root| root.property("parameters").set_property(name, value));
        self
    }

    /// Sets a property by its address: `rocker.pair.gap`, `run.tolerance`. Later
    /// settings win; they also reach what an object copies from the catalogue.
    #[must_use]
    pub fn set(mut self, address: &str, value: impl Into<Node>) -> Self {
        self.settings = self.settings.and(address, &value.into());
        self
    }

    /// With further settings as the program takes them: `rocker.pair.gap="0.1 mm"`.
    pub(super) fn with_arguments(&self, further: &[String]) -> Self {
        let mut all = self.settings.arguments().to_vec();
        all.extend_from_slice(further);
        Self {
            settings: Overrides::new(all),
            ..self.clone()
        }
    }

    /// Simulated time (s).
    #[must_use]
    pub fn duration(self, duration: impl Into<Node>) -> Self {
        self.of_run("duration", duration)
    }

    /// Error wanted in each object's δ, relative to its scale; default 1e-6.
    #[must_use]
    pub fn tolerance(self, tolerance: f64) -> Self {
        self.of_run("tolerance", tolerance)
    }

    /// Method of integration by its name; default `"auto"`.
    #[must_use]
    pub fn method(self, method: &str) -> Self {
        self.of_run("method", method)
    }

    /// Number of equal intervals between samples; default 1000.
    #[must_use]
    pub fn samples(self, samples: usize) -> Self {
        self.of_run("samples", samples)
    }

    /// Columns of every mass and link too, not of the objects alone.
    #[must_use]
    pub fn record_all(self) -> Self {
        self.of_run("record", "all")
    }

    /// Start of the run: `"kinetostatic"` (default), `"static"`, `"on_law"`.
    #[must_use]
    pub fn start(self, start: &str) -> Self {
        self.of_run("start", start)
    }

    /// Window of steady figures (s, s); default: the last whole cycle of the drive.
    #[must_use]
    pub fn window(self, from: impl Into<Node>, to: impl Into<Node>) -> Self {
        self.of_run("window", (from, to))
    }

    /// Writes a property of `run` into the scene itself, unless settings go before it.
    fn of_run(mut self, name: &str, value: impl Into<Node>) -> Self {
        let is_set = |setting: &String| setting.starts_with("run");
        if self.settings.arguments().iter().any(is_set) {
            return self.set(&format!("run.{name}"), value);
        }
        let value = value.into();
        self.document
            .edit(|root| root.property("run").set_property(name, value));
        self
    }

    /// The scene's text as JSON; what was [set](Self::set) by its address is not in it. Values that no text can state
    /// stand there by their `Debug` texts.
    pub fn json(&self) -> &str {
        self.document.text()
    }

    /// The scene as a document, without its settings.
    pub fn document(&self) -> &Document {
        &self.document
    }

    /// The settings made.
    pub fn settings(&self) -> &Overrides {
        &self.settings
    }

    /// Reads the scene: typed, in SI units, defaults filled in.
    ///
    /// # Errors
    /// Everything that is wrong with its text.
    pub fn decode(&self) -> Result<Reading, Error> {
        let found = self.document.scene(&*self.catalogue, &self.settings);
        let mut found = match found {
            Ok(reading) if self.faults.is_empty() => return Ok(reading),
            Ok(reading) => reading.warnings,
            Err(diagnostics) => diagnostics,
        };
        found.items.splice(0..0, self.faults.iter().cloned());
        Err(found.into())
    }

    /// Makes the scene ready to be asked several things. Where it leaves the level of an object
    /// open, or says in `run.accuracy` how accurate its figures are to be, it is run at several
    /// levels to judge that, as `dam run` does: see [`Mechanism::certificate`].
    ///
    /// # Errors
    /// Everything that is wrong with it.
    pub fn prepare(&self) -> Result<Mechanism, Error> {
        self.prepare_within(&Control::default())
    }

    /// The same, ended from outside.
    ///
    /// # Errors
    /// As of [`Self::prepare`].
    pub fn prepare_within(&self, control: &Control<'_>) -> Result<Mechanism, Error> {
        self.prepare_judging(ModelAssessment::Asked, control)
    }

    /// The same, judged as far as is said: what is not to be run needs no more than
    /// [`ModelAssessment::Needed`].
    ///
    /// # Errors
    /// As of [`Self::prepare`].
    pub fn prepare_judging(
        &self,
        judging: ModelAssessment,
        control: &Control<'_>,
    ) -> Result<Mechanism, Error> {
        Mechanism::of_within(self.decode()?, judging, control)
    }

    /// Ready for questions that are no run.
    fn unjudged(&self) -> Result<Mechanism, Error> {
        self.prepare_judging(ModelAssessment::Needed, &Control::default())
    }

    /// Whether the scene is right; what its user should know all the same, a line each.
    ///
    /// # Errors
    /// Everything that is wrong with it.
    pub fn check(&self) -> Result<Vec<String>, Error> {
        Ok(self
            .prepare_judging(ModelAssessment::Never, &Control::default())?
            .warnings())
    }

    /// Runs the scene.
    ///
    /// # Errors
    /// Everything that is wrong with it. A run that stops early is no error: see
    /// [`RunResult::is_complete`] and [`RunResult::is_trusted`].
    pub fn run(&self) -> Result<RunResult, Error> {
        self.prepare()?.run()
    }

    /// Runs the scene for several values of a parameter, and compares the figures with
    /// those of the last: `compare("rocker.masses", [1, 2, 10])`.
    ///
    /// # Errors
    /// Everything that is wrong with the scene for the first value with which anything
    /// is.
    pub fn compare<T: Into<Node>>(
        &self,
        address: &str,
        values: impl IntoIterator<Item = T>,
    ) -> Result<Comparison, Error> {
        let values: Vec<Node> = values.into_iter().map(Into::into).collect();
        let labels: Vec<String> = values.iter().map(Node::words).collect();
        let mut values = values.into_iter();
        compare(address, &labels, |label| {
            let value = values.next().unwrap_or_else(|| label.into());
            self.clone().set(address, value).run()
        })
    }

    /// Prepares the scene for many values of its parameters: what does not depend on them is
    /// done once, and a point then costs little more than its run. `parameters` are addresses
    /// of numbers of the scene, whose values are then in SI units; `figures` are those of
    /// expectations and of [`Scene::find`].
    ///
    /// ```
    /// # use dam::prelude::*;
    /// let scene = Scene::read("scenarios/rocker/two_masses.json")?;
    /// let prepared =
    ///     scene.prepare_points(&["rocker.inertia"], &["rocker.delta_max", "frequency.1"])?;
    /// let point = prepared.at(&[0.05])?;
    /// assert_eq!(point.verdict, Verdict::InWorkingOrder);
    /// assert!(point.value(0).is_some_and(|delta| delta < 1e-3));
    /// let table = prepared.table(&[[0.05], [-1.0]])?;
    /// assert_eq!(table.points[0], point);
    /// assert_eq!((table.points[1].verdict, table.points[1].value(0)), (Verdict::Refused, None));
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// Objects that leave their level open have one level at all points: the one that the
    /// figures need at the scene's own values ([`PreparedScene::levels`]). A run of a point
    /// takes at most 20 million steps.
    ///
    /// # Errors
    /// Everything that is wrong with the scene at its own values; an address that is no number
    /// of the scene, or is named twice; a figure that no run or study of the scene has.
    pub fn prepare_points(
        &self,
        parameters: &[impl AsRef<str>],
        figures: &[impl AsRef<str>],
    ) -> Result<PreparedScene, Error> {
        let parameters: Vec<&str> = parameters.iter().map(AsRef::as_ref).collect();
        let figures: Vec<&str> = figures.iter().map(AsRef::as_ref).collect();
        PreparedScene::of(self, &parameters, &figures)
    }

    /// The value of a parameter that meets conditions best: the highest speed at which a pair
    /// keeps its force, the least preload, the smallest base circle.
    ///
    /// ```
    /// # use dam::prelude::*;
    /// use dam::ask::FindQuestion;
    /// use dam::studies::Control;
    /// use dam::studies::find::Aim;
    ///
    /// let scene = Scene::read("scenarios/rocker/two_masses.json")?;
    /// let question = FindQuestion {
    ///     vary: "rocker.inertia=0.05:0.4:9".to_owned(),
    ///     subject: vec!["rocker.delta_abs <= 20 mrad".to_owned()],
    ///     goal: Some((Aim::Maximize, "rocker.inertia".to_owned())),
    ///     ..FindQuestion::default()
    /// };
    /// let found = scene.find(&question, &Control::default())?;
    /// assert!(found.is_answered());
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// The scene is wrong at every value that is tried; there is no such parameter or figure; a
    /// value has another unit than its figure.
    pub fn find(
        &self,
        question: &FindQuestion,
        control: &Control<'_>,
    ) -> Result<FoundValue, Error> {
        let prepare = |settings: &[String]| {
            self.with_arguments(settings)
                .prepare_judging(ModelAssessment::Needed, control)
        };
        super::find::find(question, &prepare, control, &|_| {})
    }

    /// The values of several variables that are best under conditions, from several starts.
    ///
    /// ```
    /// # use dam::prelude::*;
    /// use dam::ask::OptimizeQuestion;
    /// use dam::studies::Control;
    /// use dam::studies::find::Aim;
    ///
    /// let scene = Scene::read("scenarios/rocker/two_masses.json")?;
    /// let question = OptimizeQuestion {
    ///     vary: vec!["rocker.inertia=0.05:0.4".to_owned()],
    ///     subject: vec!["rocker.delta_abs <= 20 mrad".to_owned()],
    ///     goal: Some((Aim::Maximize, "rocker.inertia".to_owned())),
    ///     starts: 2,
    ///     ..OptimizeQuestion::default()
    /// };
    /// let found = scene.optimize(&question, &Control::default())?;
    /// let best = found.best().expect("an optimum");
    /// assert!(best.conditions[0].active);
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// Everything that is wrong with the question or with the scene. A start that cannot be run is
    /// no error: it has its cause.
    pub fn optimize(
        &self,
        question: &OptimizeQuestion,
        control: &Control<'_>,
    ) -> Result<Optimization, Error> {
        optimize(question, &self.point_source()?, control, &|_| {})
    }

    /// Derivatives of results of the run by numbers of the scene, carried through all contacts.
    ///
    /// ```
    /// # use dam::prelude::*;
    /// use dam::ask::GradientQuestion;
    /// use dam::studies::Control;
    ///
    /// let scene = Scene::read("scenarios/rocker/two_masses.json")?;
    /// let question = GradientQuestion {
    ///     by: vec!["rocker.inertia".to_owned()],
    ///     figures: vec!["rocker.delta_max".to_owned()],
    ///     ..GradientQuestion::default()
    /// };
    /// let found = scene.gradient(&question, &Control::default())?;
    /// let slope = found.figures[0].by[0].derivative.expect("a derivative");
    /// assert!((slope - 4.48636538940934).abs() < 1e-7);
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// The scene is wrong, or of a kind that has no derivatives; an address is no number, or no
    /// result of an elastic object.
    pub fn gradient(
        &self,
        question: &GradientQuestion,
        control: &Control<'_>,
    ) -> Result<Gradient, Error> {
        let prepare = |settings: &[String]| {
            self.with_arguments(settings)
                .prepare_judging(ModelAssessment::Needed, control)
        };
        let numbers = self.document.numbers(&*self.catalogue);
        super::gradient::gradient(question, &prepare, &numbers, control)
    }

    /// The tolerance of results: what tolerances of dimensions make of them.
    ///
    /// ```
    /// # use dam::prelude::*;
    /// use dam::ask::ToleranceQuestion;
    /// use dam::studies::Control;
    ///
    /// let scene = Scene::read("scenarios/kinetostatics/slider_crank.json")?;
    /// let question = ToleranceQuestion {
    ///     tolerances: vec!["mechanism.links.crank.points.A[0]=±0.05 mm".to_owned()],
    ///     figures: vec!["kinematics.mechanism.slide.stroke".to_owned()],
    ///     samples: Some(16),
    ///     ..ToleranceQuestion::default()
    /// };
    /// let found = scene.tolerances(&question, &Control::default())?;
    /// let stack = found.figures[0].first_order.as_ref().expect("a stack");
    /// // The stroke is twice the crank.
    /// assert!((stack.worst_case[1] - (0.12 + 1e-4)).abs() < 1e-13);
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// The scene is wrong, or has no results in the middle of the tolerances; an address is no
    /// number, or no result; a tolerance cannot be read.
    pub fn tolerances(
        &self,
        question: &ToleranceQuestion,
        control: &Control<'_>,
    ) -> Result<Tolerances, Error> {
        let prepare = |settings: &[String]| {
            self.with_arguments(settings)
                .prepare_judging(ModelAssessment::Needed, control)
        };
        let source = self.point_source()?;
        super::tolerance::tolerance(question, &source, &prepare, control, &|_, _| {})
    }

    /// Numbers of the scene from records of its motion, by least squares.
    ///
    /// ```
    /// # use dam::prelude::*;
    /// use dam::ask::{IdentifyQuestion, MeasuredRecord};
    /// use dam::studies::Control;
    ///
    /// let scene = Scene::read("scenarios/rocker/one_mass.json")?.set("run.duration", 0.02);
    /// let run = scene.run()?;
    /// let delta = run.delta("rocker")?;
    /// let rows = run.times().iter().zip(delta).map(|(t, x)| format!("{t:?},{x:?}"));
    /// let question = IdentifyQuestion {
    ///     records: vec![MeasuredRecord {
    ///         name: "test".to_owned(),
    ///         text: format!("t [s],x [rad]\n{}", rows.collect::<Vec<_>>().join("\n")),
    ///         settings: Vec::new(),
    ///     }],
    ///     signals: vec!["x=rocker.delta".to_owned()],
    ///     vary: vec!["rocker.inertia=0.05:0.3".to_owned()],
    ///     starts: Some(1),
    ///     ..IdentifyQuestion::default()
    /// };
    /// let found = scene.identify(&question, &Control::default())?;
    /// let (inertia, error) = found.estimates[0].value().expect("determined");
    /// assert!((inertia - 0.1).abs() < 1e-8 && error < 1e-8);
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// The scene is wrong, or can be run at no start; a record cannot be read; there is no such
    /// number, column or signal; there are no more values than numbers; `control` was spent before
    /// anything was known.
    pub fn identify(
        &self,
        question: &IdentifyQuestion,
        control: &Control<'_>,
    ) -> Result<Identification, Error> {
        super::identify::identify(question, &self.point_source()?, control, &|_| {})
    }

    /// Judges everything that the scene expects, in its order, by the run and the studies that
    /// it takes.
    ///
    /// ```
    /// # use dam::prelude::*;
    /// let scene = Scene::read("scenarios/rocker/two_masses.json")?;
    /// let requirements = scene.verify()?;
    /// assert!(!requirements.is_empty());
    /// assert!(requirements.iter().all(|one| one.holds()));
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// Everything that is wrong with the scene. What a study cannot answer is said at the
    /// requirement.
    pub fn verify(&self) -> Result<Vec<Requirement>, Error> {
        self.prepare()?.verify_within(&Control::default())
    }

    /// How a linkage of the scene moves.
    ///
    /// # Errors
    /// Everything that is wrong with the scene; what cannot be answered.
    pub fn kinematics(&self, question: &Question) -> Result<Kinematics, Error> {
        self.unjudged()?.kinematics(question)
    }

    /// Which forces a linkage of the scene carries.
    ///
    /// # Errors
    /// Everything that is wrong with the scene; what cannot be answered.
    pub fn forces(&self, question: &Question) -> Result<ForceStudy, Error> {
        self.unjudged()?.forces(question)
    }

    /// The steady motion that the scene's `steady` block asks for.
    ///
    /// # Errors
    /// Everything that is wrong with the scene; why there is no steady motion.
    pub fn steady(&self) -> Result<Answer, Error> {
        self.unjudged()?.steady()
    }

    /// Whether nothing went wrong in building it.
    pub(super) fn built_soundly(&self) -> Result<(), Error> {
        match self.faults.as_slice() {
            [] => Ok(()),
            faults => Err(Diagnostics::new(Default::default(), faults.to_vec()).into()),
        }
    }

    /// What its points are prepared from.
    ///
    /// # Errors
    /// Something went wrong in building it.
    pub(super) fn point_source(&self) -> Result<PointSource<'_, 'static>, Error> {
        self.built_soundly()?;
        Ok(PointSource {
            document: &self.document,
            catalogue: Arc::clone(&self.catalogue),
            settings: self.settings.arguments(),
        })
    }

    /// Where its objects are copied from.
    pub(super) fn catalogue(&self) -> &Arc<dyn Catalogue + Send + Sync> {
        &self.catalogue
    }
}

impl FromStr for Scene {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        Self::from_json(text)
    }
}

impl fmt::Debug for Scene {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Scene")
            .field("document", &self.document)
            .field("settings", &self.settings)
            .finish_non_exhaustive()
    }
}
