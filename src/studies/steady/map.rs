//! The map of the state over a period of the drive, and its derivative.

use super::sink::{Grid, Last};
use crate::budget::Budget;
use crate::dynamics::integrate::{
    Dynamics, Limits, Method, Modes, Settings, Sink, Stop, integrate,
};
use crate::dynamics::system::System;
use crate::exact::{Cursor, ExactRun, ExactTree, Halt, PairState, Part, Request, TreeProblem};
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
    fn even(time: f64, count: usize, columns: Vec<Vec<f64>>) -> Self {
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
    fn how(&self) -> &'static str;
}

/// A tree that is propagated exactly; its state is q, then q̇ of every mass.
#[derive(Debug)]
pub(super) struct TreeMap<'a> {
    part: &'a Part,
    budget: Budget<'a>,
    scales: Vec<f64>,
}

impl<'a> TreeMap<'a> {
    /// The map of a tree; sizes are those met in a period from a state.
    pub(super) fn new(
        part: &'a Part,
        state: &[f64],
        period: f64,
        budget: Budget<'a>,
    ) -> Result<Self, String> {
        let n = part.problem().masses.len();
        let tree = part.tree_at(&state[..n], &state[n..]);
        let request = Request {
            all_masses: true,
            ..request(period, 256)
        };
        let run = whole(&tree, &request, &budget)?;
        let mut scales: Vec<f64> = state.iter().map(|entry| entry.abs()).collect();
        for row in run.samples.chunks_exact(2 * n) {
            for (scale, value) in scales.iter_mut().zip(row) {
                *scale = scale.max(value.abs());
            }
        }
        scales
            .iter_mut()
            .for_each(|scale| *scale = scale.max(1e-12));
        Ok(Self {
            part,
            budget,
            scales,
        })
    }

    fn masses(&self) -> usize {
        self.part.problem().masses.len()
    }
}

impl Map for TreeMap<'_> {
    fn apply(&self, state: &[f64], time: f64) -> Result<Vec<f64>, String> {
        let n = self.masses();
        let tree = self.part.tree_at(&state[..n], &state[n..]);
        let run = whole(&tree, &request(time, 0), &self.budget)?;
        Ok(run.displacement.into_iter().chain(run.speed).collect())
    }

    fn monodromy(&self, state: &[f64], time: f64) -> Result<DMatrix<f64>, String> {
        let n = self.masses();
        let tree = self.part.tree_at(&state[..n], &state[n..]);
        let problem = tree.problem();
        let goes_on = || !self.budget.is_spent();
        let mut cursor = Cursor::of(&tree, &Request::new(time, 0), &goes_on)
            .map_err(|refusal| refusal.reason)?;
        let mut product = DMatrix::identity(2 * n, 2 * n);
        while cursor.advance().map_err(|refusal| refusal.reason)? {
            if cursor.counts().0 > MOST_STEPS {
                return Err(crawling(cursor.time()));
            }
            let phase = (rates(problem, cursor.states()) * cursor.length()).exp();
            product = phase * product;
            if let Some(switch) = cursor.switch()
                && (switch.before, switch.after.engaged()) == (PairState::Free, true)
            {
                impact(problem, switch.mass, &mut product);
            }
        }
        if let Some(spent) = self.budget.spent() {
            return Err(spent.to_string());
        }
        match product.iter().all(|entry| entry.is_finite()) {
            true => Ok(product),
            false => Err("the derivative of the motion is no finite number".to_owned()),
        }
    }

    fn orbit(&self, state: &[f64], time: f64, count: usize) -> Result<Orbit, String> {
        let n = self.masses();
        let tree = self.part.tree_at(&state[..n], &state[n..]);
        let request = Request {
            all_masses: true,
            ..request(time, count)
        };
        let run = whole(&tree, &request, &self.budget)?;
        let column = |mass: usize| {
            run.samples
                .iter()
                .skip(mass)
                .step_by(2 * n)
                .copied()
                .collect()
        };
        Ok(Orbit::even(time, count, (0..n).map(column).collect()))
    }

    fn scales(&self) -> &[f64] {
        &self.scales
    }

    fn how(&self) -> &'static str {
        "exact propagation of the variations through every switch"
    }
}

/// Most phases, and most steps of the search for switches, of a map: a mode that
/// vibrates so often in a turn would be followed for hours.
const MOST_STEPS: u64 = 1_000_000;

fn request(end: f64, samples: usize) -> Request {
    Request {
        all_steps: MOST_STEPS,
        ..Request::new(end, samples)
    }
}

/// A run to its end.
fn whole(tree: &ExactTree, request: &Request, budget: &Budget<'_>) -> Result<ExactRun, String> {
    let run = tree
        .run_while(request, &|| !budget.is_spent())
        .map_err(|refusal| refusal.reason)?;
    if let Some(spent) = budget.spent() {
        return Err(spent.to_string());
    }
    match run.halt {
        None => Ok(run),
        Some(Halt::Switches) => Err(format!("too many switches before t = {} s", run.time)),
        Some(Halt::Steps | Halt::Cancelled) => Err(crawling(run.time)),
    }
}

fn crawling(time: f64) -> String {
    format!(
        "its fastest mode makes exact propagation crawl: after {MOST_STEPS} steps it stands at \
         t = {} s",
        shown(time, 7)
    )
}

/// The matrix of the variations between switches: (δq, δq̇)′ = A·(δq, δq̇).
fn rates(problem: &TreeProblem, states: &[PairState]) -> DMatrix<f64> {
    let n = problem.masses.len();
    let mut rates = DMatrix::zeros(2 * n, 2 * n);
    for (i, mass) in problem.masses.iter().enumerate() {
        rates[(i, n + i)] = 1.0;
        rates[(n + i, i)] -= mass.ground_stiffness / mass.inertia;
        rates[(n + i, n + i)] -= mass.ground_damping / mass.inertia;
        let bilateral = mass.pair.flanks().1 == 0;
        if bilateral || states[i].engaged() {
            link(problem, i, [mass.stiffness, mass.damping], n, &mut rates);
        }
    }
    rates
}

/// Adds the force of a link, c·x + b·ẋ with x = q − lever·q_parent.
fn link(
    problem: &TreeProblem,
    i: usize,
    [stiffness, damping]: [f64; 2],
    n: usize,
    rates: &mut DMatrix<f64>,
) {
    let mass = &problem.masses[i];
    let ends: [Option<(usize, f64)>; 2] = [
        Some((i, 1.0)),
        mass.parent.map(|parent| (parent, -mass.lever)),
    ];
    for (row, weight) in ends.into_iter().flatten() {
        let factor = weight / problem.masses[row].inertia;
        for (column, share) in ends.into_iter().flatten() {
            rates[(n + row, column)] -= factor * stiffness * share;
            rates[(n + row, n + column)] -= factor * damping * share;
        }
    }
}

/// A free mass meets a flank: its damper's force sets in at once, so that a
/// variation that arrives earlier by δt feels it for δt longer. (All other
/// switches happen at zero force and leave variations as they are.) The speed
/// of approach cancels: δq̇ changes by −(b/J)·δx.
fn impact(problem: &TreeProblem, i: usize, product: &mut DMatrix<f64>) {
    let n = problem.masses.len();
    let mass = &problem.masses[i];
    let mut jump = DMatrix::zeros(2 * n, 2 * n);
    link(problem, i, [mass.damping, 0.0], n, &mut jump);
    *product += &jump * &*product;
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

/// The derivative of a map: central differences with two steps, extrapolated.
pub(super) fn differences(map: &dyn Map, state: &[f64], over: f64) -> Result<DMatrix<f64>, String> {
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
    let (coarse, fine) = (central(2.0 * DIFFERENCE)?, central(DIFFERENCE)?);
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
pub(super) fn follow(
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
        stop => Err(format!("it stopped at t = {at} s: {stop:?}")),
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

    fn follow(&self, state: &[f64], time: f64, sink: &mut dyn Sink) -> Result<(), String> {
        let modes = self.system.modes_at_start(state);
        follow(
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
        self.follow(state, time, &mut last)?;
        Ok(last.y)
    }

    fn orbit(&self, state: &[f64], time: f64, count: usize) -> Result<Orbit, String> {
        let mut grid = Grid::new(time / count as f64, state.len() / 2);
        self.follow(state, time, &mut grid)?;
        Ok(Orbit::even(time, count, grid.columns))
    }

    fn monodromy(&self, state: &[f64], time: f64) -> Result<DMatrix<f64>, String> {
        differences(self, state, time)
    }

    fn slopes(&self, state: &[f64], end: &[f64], time: f64) -> Result<DMatrix<f64>, String> {
        rough_differences(self, state, end, time)
    }

    fn scales(&self) -> &[f64] {
        self.system.scales()
    }

    fn how(&self) -> &'static str {
        "central differences of the integrated motion, extrapolated from two steps"
    }
}

#[cfg(test)]
mod tests {
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
            let moduli = map.monodromy(&start, turn).unwrap().complex_eigenvalues();
            let mut moduli: Vec<f64> = moduli.iter().map(|z| z.re.hypot(z.im)).collect();
            moduli.sort_by(|a, b| b.total_cmp(a));
            moduli
        });
        assert!(one[0] > 1e-4, "the test must see something: {one:?}");
        for (a, b) in one.iter().zip(&other) {
            approx::assert_abs_diff_eq!(*a, *b, epsilon = 1e-5);
        }
        let orbits = [&tree as &dyn Map, &general].map(|map| map.orbit(&start, turn, 50).unwrap());
        for (a, b) in orbits[0].columns.iter().zip(&orbits[1].columns) {
            assert_eq!((a.len(), b.len()), (50, 50));
            approx::assert_abs_diff_eq!(a[17], b[17], epsilon = 1e-8);
        }
    }
}
