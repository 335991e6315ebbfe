//! Natural frequencies of the linearised model, and how fast its fastest part is.
//!
//! Linearised about the position at t = 0, in absolute displacements of the
//! free nodes: rigid objects move with their driver by U′, an elastic link
//! stretches by φ₁ − U′·φ_driver; weights and springs of a linkage have the
//! stiffness V″. The stiffness that loaded laws add through U″
//! and damping are left out of the natural frequencies.

use super::System;
use super::linearised::LinearModel;
use super::linearised::Regime;
use super::pairs::OPEN;
use crate::dynamics::integrate::{Dynamics, Modes};
use crate::math::order::Total;
use nalgebra::{DMatrix, DVector, Schur, SymmetricEigen};

/// One natural mode of vibration, without damping.
#[derive(Clone, Debug, PartialEq)]
pub struct VibrationMode {
    /// ω (rad/s); 0 for a free motion of a rotor or of an open chain.
    pub frequency: f64,
    /// Absolute displacement of each coordinate, the largest +1 (angles in
    /// rad against lengths in m as they stand).
    pub shape: Vec<f64>,
}

/// Coordinates above which all eigenvalues take longer than many a run.
pub(crate) const MANY_COORDINATES: usize = 40;

/// Below this share of the highest frequency a mode is a free motion.
const FREE: f64 = 1e-7;

impl System {
    /// Natural frequencies and shapes at the position at t = 0, lowest first;
    /// one for each coordinate with inertia. With [`Regime::Open`] an open chain adds a free
    /// motion.
    pub fn modes_of_vibration(&self, regime: Regime) -> Vec<VibrationMode> {
        let linearised = self.linearised(regime);
        let n = linearised.mass.len();
        if n == 0 {
            return Vec::new();
        }
        let Some((scaled, unit)) = linearised.scaled() else {
            return Vec::new();
        };
        let eigen = SymmetricEigen::new(scaled);
        let highest = eigen
            .eigenvalues
            .iter()
            .fold(0.0, |a: f64, b| a.max(b.abs()));
        let mut modes: Vec<VibrationMode> = (0..n)
            .map(|k| {
                let square = eigen.eigenvalues[k];
                let free = square <= FREE * FREE * highest;
                let vector = eigen.eigenvectors.column(k).clone_owned();
                let vector = match &unit {
                    Some(unit) => unit * vector,
                    None => vector,
                };
                let shape = DVector::from_fn(n, |i, _| vector[i] / linearised.mass[i].sqrt());
                VibrationMode {
                    frequency: if free { 0.0 } else { square.sqrt() },
                    shape: normalised(&shape),
                }
            })
            .collect();
        modes.sort_by_cached_key(|mode| Total(mode.frequency));
        modes
    }

    /// The natural frequencies alone (rad/s), lowest first: of many masses in a small
    /// part of the time that their shapes take.
    pub fn natural_frequencies(&self, regime: Regime) -> Vec<f64> {
        let Some(squares) = self.linearised(regime).squares() else {
            return Vec::new();
        };
        let highest = squares.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
        let each = squares.into_iter().map(|square| {
            let free = square <= FREE * FREE * highest;
            if free { 0.0 } else { square.sqrt() }
        });
        each.collect()
    }

    /// The equations of small vibrations at the position at t = 0.
    fn linearised(&self, regime: Regime) -> LinearModel {
        self.frozen.linearised(regime, &self.start_modes())
    }

    /// The fastest rate |λ| of the linearised system with all pairs engaged,
    /// damping included (1/s): what an explicit method's step must resolve
    /// (|λ|·h below 2 to 6). With stiffness-proportional damping it can exceed
    /// the fastest frequency many times.
    ///
    /// Beyond some dozens of coordinates an estimate, good to a few per cent, in time
    /// in proportion to their number.
    pub fn fastest_rate(&self) -> f64 {
        if self.coordinates() > MANY_COORDINATES {
            let (y, modes) = self.engaged_start();
            return crate::dynamics::integrate::fastest_rate(self, 0.0, &y, &modes);
        }
        let jacobian = self.engaged_jacobian();
        let norm = jacobian.norm();
        if jacobian.is_empty() || !norm.is_finite() {
            return 0.0;
        }
        // The norm bounds every eigenvalue, should the iteration not converge.
        eigenvalues(jacobian).map_or(norm, |values| {
            values
                .iter()
                .fold(0.0, |a: f64, [re, im]| a.max(re.hypot(*im)))
        })
    }

    /// Eigenvalues (real and imaginary part, 1/s) of the system linearised at
    /// t = 0 with all pairs engaged, damping included; two for each coordinate.
    /// A method is stable at a step h when every h·λ lies in its region of
    /// stability. `None` when they cannot be found. Takes time in proportion to
    /// the cube of the number of coordinates.
    pub fn eigenvalues(&self) -> Option<Vec<[f64; 2]>> {
        let jacobian = self.engaged_jacobian();
        if jacobian.is_empty() {
            return Some(Vec::new());
        }
        jacobian.norm().is_finite().then_some(())?;
        eigenvalues(jacobian)
    }

    /// Jacobian on the law at t = 0 with all pairs engaged, in units of the
    /// scales: numbers of one size, and no less exact.
    fn engaged_jacobian(&self) -> DMatrix<f64> {
        let n = self.frozen.coordinates;
        let (y, modes) = self.engaged_start();
        let mut scratch = self.scratch();
        let mut jacobian = DMatrix::zeros(2 * n, 2 * n);
        let (mut direction, mut column) = (vec![0.0; 2 * n], vec![0.0; 2 * n]);
        for j in 0..2 * n {
            direction[j] = self.scales_of_state()[j];
            self.tangent(0.0, &y, &modes, &direction, &mut scratch, &mut column);
            direction[j] = 0.0;
            for i in 0..2 * n {
                jacobian[(i, j)] = column[i] / self.scales_of_state()[i];
            }
        }
        jacobian
    }

    /// State on the law at t = 0, and modes with every pair engaged.
    pub(super) fn engaged_start(&self) -> (Vec<f64>, Modes) {
        (self.frozen.law_state(), Modes(self.start_modes()))
    }

    /// Modes at t = 0 with every pair engaged on its first flank.
    fn start_modes(&self) -> Vec<i64> {
        let mut modes = self.frozen.no_modes();
        self.frozen
            .locate_tracks(&self.frozen.law_state(), &mut modes);
        for (component, &chain) in self.frozen.pairs.iter().enumerate() {
            let sides = self.frozen.chains[chain].contact.sides();
            modes[component] = sides.first().copied().unwrap_or(OPEN);
        }
        modes
    }
}

/// Eigenvalues of a real matrix; `None` when the iteration does not converge.
pub(super) fn eigenvalues(matrix: DMatrix<f64>) -> Option<Vec<[f64; 2]>> {
    let schur = Schur::try_new(matrix, f64::EPSILON, 10_000)?;
    let values = schur.complex_eigenvalues();
    Some(values.iter().map(|value| [value.re, value.im]).collect())
}

/// A shape with its largest entry +1.
fn normalised(shape: &DVector<f64>) -> Vec<f64> {
    let largest = shape
        .iter()
        .fold(0.0f64, |a, &b| if b.abs() > a.abs() { b } else { a });
    let factor = if largest == 0.0 { 1.0 } else { 1.0 / largest };
    shape.iter().map(|entry| entry * factor).collect()
}

#[cfg(test)]
mod tests {
    use super::super::linearised::Regime;
    use super::super::testing::*;
    use super::System;
    use crate::dynamics::model::*;
    use crate::kinematics::position::Position;
    use std::f64::consts::PI;

    /// A uniform shaft of n equal masses; ψ by its damping list.
    fn shaft(masses: usize, damping: f64, closure: Closure) -> Body {
        let n = masses as f64;
        Body {
            position: Position::Ratio {
                ratio: 2.0,
                offset: 0.0,
            },
            inertias: vec![0.1 / n; masses],
            stiffnesses: vec![n * 1e7; masses],
            dampings: vec![damping; masses],
            pair: pair(closure),
        }
    }

    #[test]
    fn a_uniform_shaft_has_the_frequencies_of_the_closed_form() {
        for masses in [1, 2, 10] {
            let mut model = Model::default();
            let drive = add_drive(&mut model, 10.0, 0.0);
            add_body(&mut model, drive, &shaft(masses, 0.0, Closure::Force));
            let system = System::new(model).unwrap();
            let modes = system.modes_of_vibration(Regime::Engaged);
            let n = masses as f64;
            let exact = |k: usize| {
                2.0 * n * 1e4 * ((2 * k - 1) as f64 * PI / (2.0 * (2.0 * n + 1.0))).sin()
            };
            let alone = system.natural_frequencies(Regime::Engaged);
            assert_eq!(alone.len(), modes.len());
            for (k, mode) in modes.iter().enumerate() {
                approx::assert_relative_eq!(mode.frequency, exact(k + 1), max_relative = 1e-12);
                approx::assert_relative_eq!(alone[k], exact(k + 1), max_relative = 1e-12);
            }
            approx::assert_relative_eq!(system.fastest_rate(), exact(masses), max_relative = 1e-9);
            // Free at both ends: it drifts, then 2·n·ω₀·sin(kπ/2n).
            let open = system.modes_of_vibration(Regime::Open);
            assert_eq!(open[0].frequency, 0.0);
            assert!(open[0].shape.iter().all(|entry| (entry - 1.0).abs() < 1e-9));
            for (k, mode) in open.iter().enumerate().skip(1) {
                let exact = 2.0 * n * 1e4 * (k as f64 * PI / (2.0 * n)).sin();
                approx::assert_relative_eq!(mode.frequency, exact, max_relative = 1e-10);
            }
        }
    }

    #[test]
    fn a_rotor_and_a_geared_mass_vibrate_against_each_other() {
        // Behind a rigid gear of ratio 3, through a link with ratio 2.
        let mut model = Model::default();
        let motor = add_rotor(&mut model, 0.5, 0.0, 1.0);
        let gear = Body {
            position: Position::Ratio {
                ratio: 3.0,
                offset: 0.0,
            },
            inertias: vec![0.2],
            stiffnesses: vec![],
            dampings: vec![],
            pair: pair(Closure::Bilateral),
        };
        let gear = add_body(&mut model, motor, &gear);
        add_body(&mut model, gear, &shaft(1, 0.0, Closure::Bilateral));
        let system = System::new(model).unwrap();
        let modes = system.modes_of_vibration(Regime::Engaged);
        // ω² = c·(1/J + (2·3)²/(J_r + 9·J_gear)).
        let square: f64 = 1e7 * (1.0 / 0.1 + 36.0 / (0.5 + 9.0 * 0.2));
        assert_eq!(modes[0].frequency, 0.0);
        approx::assert_relative_eq!(
            modes[0].shape[0] * 6.0,
            modes[0].shape[1],
            max_relative = 1e-9
        );
        approx::assert_relative_eq!(modes[1].frequency, square.sqrt(), max_relative = 1e-12);
    }

    #[test]
    fn strong_damping_makes_a_system_faster_than_its_frequencies() {
        let mut model = Model::default();
        let drive = add_drive(&mut model, 10.0, 0.0);
        let damping = 10.0 * 2.0 * (0.1f64 * 1e7).sqrt();
        add_body(&mut model, drive, &shaft(1, damping, Closure::Force));
        let system = System::new(model).unwrap();
        // Damping ratio 10: λ = ω₀·(10 + √99).
        let exact = 1e4 * (10.0 + 99.0f64.sqrt());
        approx::assert_relative_eq!(system.fastest_rate(), exact, max_relative = 1e-9);
        let mut values = system.eigenvalues().unwrap();
        values.sort_by(|a, b| a[0].total_cmp(&b[0]));
        approx::assert_relative_eq!(values[0][0], -exact, max_relative = 1e-9);
        // The product of both is ω₀².
        approx::assert_relative_eq!(values[1][0], -1e8 / exact, max_relative = 1e-7);
        assert!(values.iter().all(|value| value[1] == 0.0));
    }
}
