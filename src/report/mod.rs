//! Pictures and texts of models and runs, as pure functions: data in, text out.
//!
//! * [`html`]: the page of a run; [`compare`]: the page of several runs over each other.
//! * [`machine`]: the machine of a run, moving.
//! * [`mechanism`]: linkages to scale, still or moving.
//! * [`cam`]: disc cams: text, tables, drawings, DXF, the page on which they turn.
//! * [`kinematics`], [`forces`]: what a linkage does and carries.
//! * [`map`]: maps over parameters; [`methods`]: methods compared.
//! * [`csv`]: the samples as a table.
//! * [`law`]: laws of motion and synthesised strokes.
//! * [`steady`]: the steady motion of a machine.
//! * [`svg`]: the object graph, charts and maps as stand-alone pictures.
//! * [`show`]: the three models of a scene as text: graph, masses and links, equations.
//! * [`math`]: formulas, written as Unicode text or as LaTeX.
//! * [`diagram`]: the object graph with places for its objects; [`quantity`]: numbers for
//!   reading; [`ticks`]: places on axes; [`verdict`]: what is to be said of a run.

pub mod cam;
pub mod compare;
pub mod csv;
pub mod diagram;
#[cfg(test)]
mod fixture;
pub mod forces;
pub mod html;
pub mod kinematics;
pub mod law;
pub mod machine;
pub mod map;
pub mod math;
pub mod mechanism;
pub mod methods;
pub mod quantity;
pub mod show;
pub mod steady;
pub mod svg;
pub mod ticks;
pub mod verdict;
