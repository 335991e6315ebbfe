//! Natural modes of trees, as a table.

use super::model::{LinearModel, NamedTree};
use super::signals::Signal;
use crate::exact::TreeMode;
use crate::fault::Fault;
use nalgebra::Complex;
use serde::Serialize;
use std::f64::consts::TAU;

/// Natural modes and poles of a tree.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TreeModes {
    /// Object whose law moves the tree.
    pub law: String,
    /// Object at whose output shapes are 1.
    pub output: String,
    /// Masses of the shapes, in their order, with the units of their displacements.
    pub masses: Vec<Signal>,
    /// The modes, lowest first.
    pub modes: Vec<Mode>,
    /// Eigenvalues of the damped tree with an imaginary part ≥ 0 (1/s), least modulus first.
    pub poles: Vec<[f64; 2]>,
    /// True where the dampers do not couple the modes: ζ and damped frequencies are exact. Else
    /// they are of first order in the damping, and `poles` are exact.
    pub uncoupled: bool,
    /// Static displacement of the output for a unit load on it (rad/(N·m) or m/N).
    pub static_compliance: f64,
}

/// A natural mode.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Mode {
    /// Undamped natural frequency (Hz).
    pub frequency: f64,
    /// Damped natural frequency (Hz); null of an overdamped mode.
    pub damped_frequency: Option<f64>,
    /// Damping ratio ζ.
    pub damping_ratio: f64,
    /// True where ζ ≥ 1: the mode does not oscillate.
    pub overdamped: bool,
    /// Displacement of each mass, 1 at the output; the greatest is 1 where the output rests.
    pub shape: Vec<f64>,
    /// Inertia that moves with this mode under the law (kg·m² or kg, referred to the law). The sum
    /// over all modes is the inertia that the law moves.
    pub effective_inertia: f64,
    /// Share of the static compliance of the output. All shares sum to 1.
    pub compliance_share: f64,
}

/// Greatest relative distance of a pole from that of an uncoupled mode.
const UNCOUPLED: f64 = 1e-8;

impl TreeModes {
    /// The modes of all trees of a model.
    ///
    /// # Errors
    /// The modes of a tree cannot be found.
    pub fn of(model: &LinearModel) -> Result<Vec<Self>, Vec<Fault>> {
        model.trees.iter().map(Self::of_tree).collect()
    }

    fn of_tree(tree: &NamedTree) -> Result<Self, Vec<Fault>> {
        let id = &tree.law().id;
        let failed = || {
            let message = "its natural frequencies cannot be separated";
            vec![Fault::new(id, message, "give fewer masses")]
        };
        let equations = &tree.equations;
        let found = equations.modes().ok_or_else(failed)?;
        let poles = equations.poles().ok_or_else(failed)?;
        let output = tree.last();
        let at_output = output.output();
        let compliance = |mode: &TreeMode| {
            let own = mode.shape[at_output];
            own * own / (mode.frequency * mode.frequency * mode.inertia)
        };
        let total: f64 = found.iter().rev().map(compliance).sum();
        let inertias = equations.inertias();
        let row = |mode: &TreeMode| {
            let moved = mode.shape.iter().zip(&inertias).zip(equations.ratios());
            let moved: f64 = moved.map(|((x, inertia), ratio)| x * inertia * ratio).sum();
            let ratio = mode.damping_ratio;
            let overdamped = ratio >= 1.0;
            let damped = mode.frequency * (1.0 - ratio).max(0.0).sqrt() * (1.0 + ratio).sqrt();
            Mode {
                frequency: mode.frequency / TAU,
                damped_frequency: (!overdamped).then_some(damped / TAU),
                damping_ratio: ratio,
                overdamped,
                shape: normalised(&mode.shape, at_output),
                effective_inertia: moved * moved / mode.inertia,
                compliance_share: compliance(mode) / total,
            }
        };
        let masses = tree.objects.iter().flat_map(|object| {
            let names = object.mass_names().into_iter();
            names.map(|name| Signal::new(name, object.units[0]))
        });
        Ok(Self {
            law: id.clone(),
            output: output.id.clone(),
            masses: masses.collect(),
            uncoupled: are_poles_of(&found, &poles),
            modes: found.iter().map(row).collect(),
            poles: poles.iter().map(|pole| [pole.re, pole.im]).collect(),
            static_compliance: total,
        })
    }
}

/// The shape with 1 at the output, or at the greatest where the output hardly moves.
fn normalised(shape: &[f64], output: usize) -> Vec<f64> {
    let size = |value: f64| value.abs();
    let greatest = shape.iter().fold(
        0.0,
        |most: f64, &x| if size(x) > size(most) { x } else { most },
    );
    let unit = match size(shape[output]) > 1e-9 * size(greatest) {
        true => shape[output],
        false => greatest,
    };
    shape.iter().map(|x| x / unit).collect()
}

/// Whether the poles are those of modes that dampers do not couple.
fn are_poles_of(modes: &[TreeMode], poles: &[Complex<f64>]) -> bool {
    let expected = modes.iter().flat_map(|mode| {
        let (omega, ratio) = (mode.frequency, mode.damping_ratio);
        let root = ((1.0 - ratio) * (1.0 + ratio)).abs().sqrt();
        match ratio < 1.0 {
            true => vec![Complex::new(-ratio, root) * omega],
            // (The slow one without cancellation.)
            false => vec![
                Complex::from(-omega / (ratio + root)),
                Complex::from(-omega * (ratio + root)),
            ],
        }
    });
    let mut expected: Vec<Complex<f64>> = expected.collect();
    expected.len() == poles.len()
        && poles.iter().all(|pole| {
            let near = |one: &Complex<f64>| (one - pole).norm();
            let place = (0..expected.len())
                .min_by(|&a, &b| near(&expected[a]).total_cmp(&near(&expected[b])));
            place.is_some_and(|place| {
                let own = expected.swap_remove(place);
                near(&own) <= UNCOUPLED * pole.norm()
            })
        })
}
