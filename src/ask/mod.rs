//! Asking in code: a [`Scene`] is read or built, run, and answers with arrays and
//! figures by typed keys.
//!
//! [`Scene`] is the description, cheap to copy and change; [`Mechanism`] is a scene that
//! was checked and made ready, to be asked several things. Both are asked alike:
//!
//! | method | question | answer |
//! | --- | --- | --- |
//! | [`run`](Scene::run) | how does it move | [`RunResult`] |
//! | [`compare`](Scene::compare) | what does a parameter change | [`Comparison`](crate::studies::compare::Comparison) |
//! | [`map`](Scene::map) | in which range does it work | [`Map`] |
//! | [`prepare_points`](Scene::prepare_points) | what are figures at many values of parameters | [`PreparedScene`], [`Point`] |
//! | [`find`](Scene::find) | which value of a parameter is best under conditions | [`FoundValue`](crate::studies::find::FoundValue) |
//! | [`optimize`](Scene::optimize) | which values of several variables are best under conditions | [`Optimization`](crate::studies::optimize::Optimization) |
//! | [`gradient`](Scene::gradient) | how do results depend on its numbers | [`Gradient`](crate::studies::gradient::Gradient) |
//! | [`tolerances`](Scene::tolerances) | what do tolerances of dimensions make of results | [`Tolerances`](crate::studies::tolerance::Tolerances) |
//! | [`identify`](Scene::identify) | which numbers explain a record of its motion | [`Identification`](crate::studies::identify::Identification) |
//! | [`verify`](Scene::verify) | does it meet what is expected of it | [`Requirement`](crate::studies::expectations::Requirement) |
//! | [`reduce`](Scene::reduce) | how little of it is needed | [`Reduction`](crate::studies::reduce::Reduction) |
//! | [`kinematics`](Scene::kinematics) | how does a linkage move | [`Kinematics`](crate::studies::kinematics::Kinematics) |
//! | [`forces`](Scene::forces) | which forces do its pairs carry | [`ForceStudy`](crate::studies::forces::ForceStudy) |
//! | [`cam`](Mechanism::cam) | can its cam be made, and does it keep its follower | [`FoundCam`] |
//! | [`law_cycle`](Mechanism::law_cycle) | what does an object follow over a cycle | [`FollowedCycle`] |
//! | [`compare_laws`](Scene::compare_laws) | which law of motion suits it | [`LawComparison`] |
//! | [`linearise`](Scene::linearise) | what are its linear equations | [`Linearisation`](crate::studies::linear::Linearisation) |
//! | [`response`](Scene::response) | how does it answer to a frequency | [`FrequencyResponse`](crate::studies::linear::FrequencyResponse) |
//! | [`orders`](Scene::orders) | which orders of its law shake it at which speed | [`OrdersAnswer`](crate::studies::orders::OrdersAnswer) |
//! | [`methods`](Mechanism::methods) | which method is soonest accurate | [`Study`](crate::studies::methods::Study) |
//! | [`steady`](Scene::steady) | how evenly does the machine turn | [`Answer`](crate::studies::steady::Answer) |
//!
//! All fail with the one [`Error`](crate::Error).
//!
//! The library prints nothing. It reads no files but scenes and the catalogue folders beside
//! them (`Scene::read`). The program makes the same [`Mechanism`].

mod cam;
mod ended;
mod find;
mod gradient;
mod identify;
mod law_comparison;
mod laws;
mod linear;
mod linkages;
mod map;
mod mechanism;
mod methods;
mod optimize;
mod prepared;
mod reduce;
mod run;
mod scene;
mod synthesis;
mod tolerance;
mod variables;

pub(crate) use cam::lift_off_speed;
pub use cam::{CamQuestion, FoundCam};
pub use find::FindQuestion;
pub(crate) use find::find;
pub use gradient::GradientQuestion;
pub(crate) use gradient::gradient;
pub(crate) use identify::identify;
pub use identify::{IdentifyQuestion, MeasuredRecord, USUAL_STARTS};
pub(crate) use law_comparison::compare as compare_laws;
pub use law_comparison::{LawComparison, LawQuestion};
pub use laws::FollowedCycle;
pub use map::{Map, MapQuestion};
pub use mechanism::{Mechanism, ModelAssessment};
pub use optimize::OptimizeQuestion;
pub(crate) use optimize::optimize;
pub(crate) use prepared::PointSource;
pub use prepared::{PointTable, PreparedScene};
pub use run::RunOptions;
pub use scene::Scene;
pub use synthesis::{StrokeQuestion, Synthesis};
pub use tolerance::ToleranceQuestion;
pub(crate) use tolerance::tolerance;

#[doc(no_inline)]
pub use crate::studies::prepared::{Point, PointFigure};
#[doc(no_inline)]
pub use crate::studies::run::RunResult;
