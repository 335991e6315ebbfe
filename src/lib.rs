//! Dynamic analysis of mechanisms: a machine mechanism is described as a graph of objects
//! (drives, shafts, cranks, rockers, sliders, cam followers, differentials, linkages), each
//! rigid or a chain of masses, joined by pairs that may have a gap or lift off. `dam` assembles its
//! equations of motion, follows it, and answers questions.
//!
//! # A scene in code
//!
//! A rocker of two masses, swung by a shaft and held on its cam by a constant moment:
//!
//! ```
//! use dam::prelude::*;
//!
//! let scene = Scene::new("Rocker of a cam mechanism")
//!     .add("shaft", Drive::speed("10 rev/s"))
//!     .add(
//!         "rocker",
//!         Rocker::on("shaft")
//!             .position(Position::sine("90 deg"))
//!             .inertia(0.1)
//!             .stiffness(1e7)
//!             .damping_capacity(0.4)
//!             .masses(2)
//!             .pair(Pair::force_closed())
//!             .load("closing", Load::constant("-600 N m")),
//!     )
//!     .duration("0.5 s");
//! let run = scene.run()?;
//! let (times, delta) = (run.times(), run.delta("rocker")?);
//! assert_eq!(times.len(), delta.len());
//! let figures = run.figures("rocker")?;
//! assert!((figures.delta_max - 0.00750).abs() < 1e-5); // rad
//! assert_eq!(run.figure("rocker", Figure::Separations)?, 65.0);
//! # Ok::<(), Error>(())
//! ```
//!
//! Numbers are in SI units, texts carry units. What is wrong is told all at once, each
//! fault with its property, by the one [`Error`]:
//!
//! ```
//! # use dam::prelude::*;
//! let wrong = Scene::new("Two mistakes")
//!     .add("shaft", Drive::speed("10 Hz"))
//!     .add("rocker", Rocker::on("shaf").position(Position::sine(1.0)).inertia(0.1))
//!     .duration(1);
//! let error = wrong.run().unwrap_err();
//! assert_eq!(error.faults()[0].path, "shaft.motion.speed");
//! assert!(error.to_string().contains("did you mean `shaft`?"));
//! ```
//!
//! # A scene from JSON
//!
//! [`Scene::read`] takes a file, [`Scene::from_json`] a text. Every property has an
//! address, by which it is set:
//!
//! ```
//! # use dam::prelude::*;
//! let scene = Scene::read("scenarios/rocker/two_masses.json")?;
//! for masses in [1, 2] {
//!     let run = scene.clone().set("rocker.masses", masses).duration(0.1).run()?;
//!     println!("{masses}: {} rad", run.figures("rocker")?.delta_max);
//! }
//! let comparison = scene.duration(0.1).compare("rocker.masses", [1, 2])?;
//! assert_eq!(comparison.runs.len(), 2);
//! # Ok::<(), Error>(())
//! ```
//!
//! # Your own position function
//!
//! Whatever JSON cannot state is given as a value: a [position
//! function](position::PositionFunction), or a whole [object](object::Object)
//! ([`build::OwnObject`]). A [kind](object::Kind) of objects of your own
//! ([`Scene::with_kind`]) has JSON, schema and diagnostics as well.
//!
//! ```
//! use dam::jet::Jet;
//! use dam::position::PositionFunction;
//! use dam::prelude::*;
//!
//! /// U = stroke·(1 − cos φ)/2.
//! #[derive(Debug)]
//! struct Eccentric {
//!     stroke: f64,
//! }
//!
//! impl PositionFunction for Eccentric {
//!     fn jet(&self, _: i64, phi: f64) -> Jet {
//!         let (half, (sin, cos)) = (self.stroke / 2.0, phi.sin_cos());
//!         Jet { value: half * (1.0 - cos), first: half * sin, second: half * cos, third: -half * sin }
//!     }
//! }
//!
//! let table = Slider::on("shaft")
//!     .position(Position::own(Eccentric { stroke: 0.02 }))
//!     .inertia("3 kg")
//!     .stiffness("5e6 N/m");
//! let scene = Scene::new("Shaking table")
//!     .add("shaft", Drive::speed("300 rpm"))
//!     .add("table", table)
//!     .duration(1.0);
//! assert!(scene.run()?.is_trusted());
//! # Ok::<(), Error>(())
//! ```
//!
//! # Where things are
//!
//! For everyday use:
//!
//! | module | what is there |
//! | --- | --- |
//! | [`prelude`] | what most programs need |
//! | [`ask`] | [`Scene`], [`Mechanism`], runs and maps as arrays |
//! | [`build`] | builders of everything a scene holds |
//! | [`record`] | the samples and figures of a run, and their keys |
//! | [`studies`] | the questions and all that their answers hold |
//! | [`report`] | results as text, JSON, CSV, pages and pictures |
//! | [`diagnostics`] | faults with their places |
//!
//! For objects, laws and formats of your own:
//!
//! | module | what is there |
//! | --- | --- |
//! | [`object`] | the trait [`Object`](object::Object), its ports, kinds and their registry |
//! | [`builder`] | what an object's lowering may say: nodes, links, laws, loads |
//! | [`position`], [`constraint`], [`motion`], [`load`], [`laws`] | functions that tie displacements to others and to time; forces |
//! | [`jet`], [`breaks`] | derivatives, and where a formula changes |
//! | [`read`], [`units`], [`scene`] | how texts become values: the declarations that read, check and describe |
//!
//! The machinery, each part usable by itself:
//!
//! | module | what is there |
//! | --- | --- |
//! | [`model`], [`graph`], [`lower`] | from a scene to plain data |
//! | [`system`], [`integrate`], [`exact`] | equations of motion, methods, motions in closed form |
//! | [`linkage`], [`cam`], [`steady`] | planar linkages, disc cams, machines with one degree of freedom |
//! | [`polynomial`], [`number`], [`expression`] | mathematics underneath |
//! | [`energy`] | the energy balance of a run |
//! | [`fault`], [`budget`] | faults of a model by the address of the property; what may end a computation |

pub mod ask;
pub mod budget;
pub mod cli;
mod dynamics;
mod error;
pub mod exact;
pub mod fault;
mod frontend;
mod kinematics;
mod math;
pub mod prelude;
pub mod report;
pub mod studies;
#[cfg(feature = "live")]
#[cfg_attr(
    not(feature = "studio"),
    expect(dead_code, reason = "a server needs more")
)]
pub mod studio;
pub mod units;

pub use ask::{Mechanism, Scene};
pub use dynamics::{builder, energy, integrate, laws, load, model, record, steady, system};
pub use error::Error;
pub use frontend::{build, diagnostics, graph, lower, object, read, scene};
pub use kinematics::{breaks, cam, constraint, linkage, motion, position};
pub use math::{expression, jet, number, polynomial};

/// The code on the page about the library runs.
#[cfg(doctest)]
#[doc = include_str!("../docs/site/guides/rust.md")]
struct RustPage;
