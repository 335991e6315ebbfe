//! Pictures and texts of models and runs, as pure functions: data in, text out.
//!
//! * [`abscissa`]: what runs are drawn over.
//! * [`accuracy`]: what its figures are worth, the error of the model included.
//! * [`requirements`]: what scenes expect, with verdicts.
//! * [`run`]: what a run found; [`compare`]: several runs over each other; [`html`]: what pages are
//!   made of.
//! * [`machine`]: the machine of a run, moving.
//! * [`mechanism`]: linkages to scale, still or moving.
//! * [`cam`]: disc cams: text, tables, drawings, DXF, the page on which they turn.
//! * [`kinematics`], [`forces`]: what a linkage does and carries.
//! * [`map`]: maps over parameters; [`methods`]: methods compared.
//! * [`findings`]: what a study found, as data, with one exporter each for text and page;
//!   [`csv`]: tables for other programs.
//! * [`find`]: the best value of a parameter; [`tolerance`]: what tolerances make of results;
//!   [`identify`]: numbers of a scene from records.
//! * [`fitted`]: texts in the width of a terminal.
//! * [`law`]: laws of motion and synthesised strokes.
//! * [`steady`]: the steady motion of a machine.
//! * [`plot`]: the one engine of all charts; [`svg`]: the object graph as a picture.
//! * [`show`]: the three models of a scene as text: graph, masses and links, equations.
//! * [`math`]: formulas, written as Unicode text or as LaTeX.
//! * [`display_units`]: the units and digits in which results are shown.
//! * [`diagram`]: the object graph with places for its objects; [`quantity`]: numbers for
//!   reading; [`verdict`]: what is to be said of a run.

pub mod abscissa;
pub mod accuracy;
mod addresses;
pub mod cam;
pub mod compare;
mod course;
pub mod csv;
pub mod diagram;
pub mod display_units;
pub mod find;
pub mod findings;
pub mod fitted;
#[cfg(test)]
mod fixture;
pub mod forces;
pub mod gradient;
pub mod html;
pub mod identify;
pub mod kinematics;
pub mod law;
pub mod linear;
#[cfg(feature = "live")]
pub(crate) mod live;
pub mod machine;
pub mod map;
pub mod math;
pub mod mechanism;
pub mod methods;
pub mod optimize;
mod order;
pub mod orders;
pub mod plot;
pub mod quantity;
pub mod reduce;
pub mod requirements;
pub mod run;
pub mod sentence;
pub mod show;
pub mod steady;
pub mod svg;
mod symbols;
mod thinned;
pub mod tolerance;
pub mod verdict;
