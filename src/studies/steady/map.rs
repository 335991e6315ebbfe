//! The map of the state over a period of the drive, and its derivative.
//!
//! It is taken over time behind prescribed drives, and over the angle of a drive on its motor
//! (`phase`). After which angle a machine repeats follows from its ratios (`cycle`). A moment
//! that holds a mean speed is one more entry of the state (`mean_speed`).

mod tree;

pub(super) use tree::TreeMap;

use super::sink::{Grid, Last};
use crate::budget::Budget;
use crate::dynamics::integrate::{
    Dynamics, Limits, Method, Modes, Settings, Sink, Stop, integrate,
};
use crate::dynamics::system::System;
use crate::studies::document::stop_in_words;
use crate::units::shown;
use nalgebra::DMatrix;

/// A motion as a list of states.
#[derive(Clone, Debug, Default)]
pub(super) struct Orbit {
    /// Times (s).
    pub(super) times: Vec<f64>,
    /// Columns of displacements, one a coordinate.
    pub(super) columns: Vec<Vec<f64>>,
}

impl Orbit {
    /// An orbit in equal steps of time.
    fn with_equal_steps(time: f64, count: usize, columns: Vec<Vec<f64>>) -> Self {
        let step = |i: usize| time * i as f64 / count as f64;
        Self {
            times: (1..=count).map(step).collect(),
            columns,
        }
    }
}

/// Carries a state over a time that starts at t = 0, or over an angle of the drive
/// that takes its place.
pub(super) trait Map {
    /// The state after `time` (s).
    ///
    /// # Errors
    /// Why it does not get there.
    fn apply(&self, state: &[f64], time: f64) -> Result<Vec<f64>, String>;

    /// The derivative of the state after `time` by the state at t = 0.
    ///
    /// # Errors
    /// As [`Map::apply`].
    fn monodromy(&self, state: &[f64], time: f64) -> Result<DMatrix<f64>, String>;

    /// The same as cheaply as it goes, to some digits: what a step of Newton's method
    /// needs. `end` is the state after `time`.
    ///
    /// # Errors
    /// As [`Map::apply`].
    fn slopes(&self, state: &[f64], _end: &[f64], time: f64) -> Result<DMatrix<f64>, String> {
        self.monodromy(state, time)
    }

    /// Displacements at `count` equal steps from t = 0 on, t = 0 left out.
    ///
    /// # Errors
    /// As [`Map::apply`].
    fn orbit(&self, state: &[f64], time: f64, count: usize) -> Result<Orbit, String>;

    /// Duration of the stretch (s).
    ///
    /// # Errors
    /// As [`Map::apply`].
    fn duration(&self, _state: &[f64], time: f64) -> Result<f64, String> {
        Ok(time)
    }

    /// Sizes of the state's entries, for differences and misses.
    fn scales(&self) -> &[f64];

    /// Way in which its derivative is found, in words.
    fn derivative_method(&self) -> &'static str;

    /// The derivative found another way.
    ///
    /// # Errors
    /// As [`Map::apply`].
    fn check(&self, state: &[f64], time: f64) -> Result<DMatrix<f64>, String>;

    /// That way, in words.
    fn derivative_check(&self) -> &'static str;
}

/// Any system, integrated; its state is y = [u, u̇].
#[derive(Debug)]
pub(super) struct SystemMap<'a> {
    system: &'a System,
    method: Method,
    budget: Budget<'a>,
}

/// Tolerance of the integration.
const TOLERANCE: f64 = 1e-12;
/// Steps of the differences, relative to the scales.
const DIFFERENCE: f64 = 1e-5;

/// Greater steps, by which differences are checked: rounding weighs less in them, curvature more.
const GREATER: f64 = 4.0 * DIFFERENCE;

/// The derivative of a map: central differences with two steps, extrapolated.
pub(super) fn derivative_by_differences(
    map: &dyn Map,
    state: &[f64],
    over: f64,
) -> Result<DMatrix<f64>, String> {
    extrapolated(map, state, over, DIFFERENCE)
}

/// The same with greater steps.
pub(super) fn derivative_by_greater_differences(
    map: &dyn Map,
    state: &[f64],
    over: f64,
) -> Result<DMatrix<f64>, String> {
    extrapolated(map, state, over, GREATER)
}

/// How differences are checked, in words.
pub(super) const AGAIN: &str = "differences with steps four times as great";

fn extrapolated(
    map: &dyn Map,
    state: &[f64],
    over: f64,
    difference: f64,
) -> Result<DMatrix<f64>, String> {
    let n = state.len();
    let central = |step: f64| -> Result<DMatrix<f64>, String> {
        let mut matrix = DMatrix::zeros(n, n);
        for column in 0..n {
            let h = step * map.scales()[column];
            let mut shifted = state.to_vec();
            shifted[column] = state[column] + h;
            let above = map.apply(&shifted, over)?;
            shifted[column] = state[column] - h;
            let below = map.apply(&shifted, over)?;
            for row in 0..n {
                matrix[(row, column)] = (above[row] - below[row]) / (2.0 * h);
            }
        }
        Ok(matrix)
    };
    let (coarse, fine) = (central(2.0 * difference)?, central(difference)?);
    Ok((fine * 4.0 - coarse) / 3.0)
}

/// The derivative of a map to some digits: differences to one side.
pub(super) fn rough_differences(
    map: &dyn Map,
    state: &[f64],
    end: &[f64],
    over: f64,
) -> Result<DMatrix<f64>, String> {
    let n = state.len();
    let mut matrix = DMatrix::zeros(n, n);
    for column in 0..n {
        let h = DIFFERENCE * map.scales()[column];
        let mut shifted = state.to_vec();
        shifted[column] += h;
        let moved = map.apply(&shifted, over)?;
        for row in 0..n {
            matrix[(row, column)] = (moved[row] - end[row]) / h;
        }
    }
    Ok(matrix)
}

/// Integrates a system from a state over a time into a sink, as finely as it goes.
///
/// # Errors
/// Why it does not get to the end.
pub(super) fn integrate_from(
    system: &System,
    method: Method,
    budget: Budget<'_>,
    state: &[f64],
    modes: &Modes,
    time: f64,
    sink: &mut dyn Sink,
) -> Result<(), String> {
    let settings = Settings {
        method,
        tolerance: TOLERANCE,
        step: None,
    };
    let limits = Limits {
        switches: 1_000_000,
        steps: 10_000_000,
        budget,
    };
    let outcome = integrate(system, 0.0, time, state, modes, &settings, &limits, sink);
    let at = outcome.time;
    match outcome.stop {
        Stop::Complete => Ok(()),
        Stop::Physical(stop) => Err(stop.message),
        Stop::Interrupted | Stop::WallClock { .. } => {
            let spent = budget.spent().map(|spent| spent.to_string());
            Err(spent.unwrap_or_else(|| "interrupted".to_owned()))
        }
        stop => Err(format!(
            "it stopped at t = {} s: {}",
            shown(at, 7),
            stop_in_words(&stop).1
        )),
    }
}

impl<'a> SystemMap<'a> {
    pub(super) fn new(system: &'a System, method: Method, budget: Budget<'a>) -> Self {
        Self {
            system,
            method,
            budget,
        }
    }

    fn integrate_from(&self, state: &[f64], time: f64, sink: &mut dyn Sink) -> Result<(), String> {
        let modes = self.system.modes_at_start(state);
        integrate_from(
            self.system,
            self.method,
            self.budget,
            state,
            &modes,
            time,
            sink,
        )
    }
}

impl Map for SystemMap<'_> {
    fn apply(&self, state: &[f64], time: f64) -> Result<Vec<f64>, String> {
        let mut last = Last::default();
        self.integrate_from(state, time, &mut last)?;
        Ok(last.y)
    }

    fn orbit(&self, state: &[f64], time: f64, count: usize) -> Result<Orbit, String> {
        let mut grid = Grid::new(time / count as f64, state.len() / 2);
        self.integrate_from(state, time, &mut grid)?;
        Ok(Orbit::with_equal_steps(time, count, grid.columns))
    }

    fn monodromy(&self, state: &[f64], time: f64) -> Result<DMatrix<f64>, String> {
        derivative_by_differences(self, state, time)
    }

    fn slopes(&self, state: &[f64], end: &[f64], time: f64) -> Result<DMatrix<f64>, String> {
        rough_differences(self, state, end, time)
    }

    fn scales(&self) -> &[f64] {
        self.system.scales()
    }

    fn derivative_method(&self) -> &'static str {
        "central differences of the integrated motion, extrapolated from two steps"
    }

    fn check(&self, state: &[f64], time: f64) -> Result<DMatrix<f64>, String> {
        derivative_by_greater_differences(self, state, time)
    }

    fn derivative_check(&self) -> &'static str {
        AGAIN
    }
}

#[cfg(test)]
mod tests {
    use super::super::multipliers;
    use super::{Map, SystemMap, TreeMap};
    use crate::budget::Budget;
    use crate::dynamics::integrate::Method;
    use crate::dynamics::system::System;
    use crate::exact::Parts;
    use crate::frontend::lower::lower;
    use crate::frontend::scene::{BuiltIn, Document, Overrides};

    /// A lever that leaves its cam and meets it again, damped.
    const SCENE: &str = r#"{ "dam": 1, "name": "test", "objects": {
        "shaft": { "kind": "drive", "motion": { "speed": "1900 rpm" } },
        "valve": { "kind": "rocker", "input": "shaft", "masses": 2, "inertia": 0.1,
            "stiffness": 3e5, "damping_capacity": 0.5, "pair": { "closure": "force" },
            "position": { "sine": { "amplitude": "8 deg" } },
            "loads": { "closing": { "constant": -450 } } } },
        "run": { "duration": 1, "start": "static" } }"#;

    #[test]
    fn exact_propagation_and_integration_give_the_same_map_and_multipliers() {
        let document = Document::parse("test", SCENE.as_bytes()).unwrap();
        let reading = document.scene(&BuiltIn, &Overrides::none()).unwrap();
        let system = System::new(lower(&reading.scene).unwrap()).unwrap();
        let parts = Parts::of(&system);
        let start = system.initial_state().unwrap().y;
        let turn = 60.0 / 1900.0;
        let tree = TreeMap::new(&parts.trees[0], &start, turn, Budget::FREE).unwrap();
        let general = SystemMap::new(&system, Method::Dop853, Budget::FREE);
        // One tree: its q are the system's u.
        let (one, other) = (tree.apply(&start, turn), general.apply(&start, turn));
        let (one, other) = (one.unwrap(), other.unwrap());
        for ((a, b), scale) in one.iter().zip(&other).zip(tree.scales()) {
            approx::assert_abs_diff_eq!(a / scale, b / scale, epsilon = 1e-8);
        }
        let [one, other] = [&tree as &dyn Map, &general].map(|map| {
            let derivative = map.monodromy(&start, turn).unwrap();
            multipliers::of(&derivative, &map.check(&start, turn).unwrap())
        });
        assert!(
            one[0].modulus > 1e-4,
            "the test must see something: {one:?}"
        );
        // Those of the other way lie within what either says of its errors.
        for (a, b) in one.iter().zip(&other) {
            let off = (a.re - b.re).hypot(a.im - b.im);
            assert!(off <= 3.0 * (a.error + b.error), "{a:?} {b:?}");
            assert!(a.error < 1e-5 && b.error < 1e-5, "{a:?} {b:?}");
        }
        let orbits = [&tree as &dyn Map, &general].map(|map| map.orbit(&start, turn, 50).unwrap());
        for (a, b) in orbits[0].columns.iter().zip(&orbits[1].columns) {
            assert_eq!((a.len(), b.len()), (50, 50));
            approx::assert_abs_diff_eq!(a[17], b[17], epsilon = 1e-8);
        }
    }
}
