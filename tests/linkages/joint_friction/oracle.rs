//! Linkages with joint friction in absolute coordinates: friction from the
//! Lagrange multipliers by a fixed point, directions by the signs of the pairs'
//! speeds, changes of sign located to rounding.

use crate::multipliers::{Mechanism, State, Vector, add, dot, minus, turned};
use dam::linkage::spec::{PairKind, PairSpec};
use nalgebra::{DMatrix, DVector};

/// Evaluations at most to locate an event.
const TRIES: usize = 100;
/// Fixed-point iterations at most.
const ITERATIONS: usize = 400;

/// Whether and how the mechanism moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Going {
    Forwards,
    Backwards,
    Rests,
}

impl Going {
    fn sign(self) -> f64 {
        match self {
            Self::Forwards => 1.0,
            Self::Backwards => -1.0,
            Self::Rests => 0.0,
        }
    }
}

/// What a run with friction leaves.
pub(crate) struct Course {
    pub(crate) state: State,
    /// Times at which the input came to a stop.
    pub(crate) stops: Vec<f64>,
    /// Time spent at rest (s).
    pub(crate) rest: f64,
    /// Work that friction took, ≥ 0 (J).
    pub(crate) loss: f64,
    /// Changes of direction of pairs while the input went on.
    pub(crate) changes: usize,
}

/// Rate of a pair's coordinate: of j against i.
fn rate(m: &Mechanism<'_>, pair: &PairSpec, state: &State) -> f64 {
    let (on, block) = (m.point(&pair.on, state), m.point(&pair.link, state));
    match pair.kind {
        PairKind::Revolute { .. } => block.turning - on.turning,
        PairKind::Sliding { direction, .. } => {
            let t = turned([1.0, 0.0], direction + m.angle(on.link, &state.place));
            dot(t, minus(block.speed, on.speed))
        }
    }
}

/// Signs of all pairs' speeds when the input goes forwards.
fn pattern(m: &Mechanism<'_>, state: &State) -> Vec<f64> {
    let input = rate(m, &m.spec.pairs[m.spec.driver], state);
    assert!(input != 0.0, "the pattern needs a motion");
    let sign = |pair| (rate(m, pair, state) / input).signum();
    m.spec.pairs.iter().map(sign).collect()
}

/// Which way everything slides, and how the blocks' corners are pressed: held
/// over a step, so that it is smooth.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Signs {
    /// Of the pairs' speeds.
    pub(crate) pairs: Vec<f64>,
    /// Of the forces on both corners of each pair's block; `None`: as they turn out.
    pub(crate) corners: Option<Vec<[f64; 2]>>,
}

/// Forces on both corners of a block; of a pin nothing.
fn corner_forces(pair: &PairSpec, [a, b]: [f64; 2]) -> [f64; 2] {
    match pair.kind {
        PairKind::Revolute { .. } => [1.0; 2],
        PairKind::Sliding {
            corners: [forward, back],
            ..
        } => {
            // N₁ + N₂ = a, b₁·N₁ + b₂·N₂ = b: two corners carry both.
            let first = (b - back * a) / (forward - back);
            [first, a - first]
        }
    }
}

/// Force and couple (or both forces) on link j from i: −λ.
fn reaction(m: &Mechanism<'_>, index: usize, found: &DVector<f64>) -> [f64; 2] {
    let n = 3 * m.spec.links.len();
    [-found[n + 2 * index], -found[n + 2 * index + 1]]
}

/// Friction of all pairs on the links, given the multipliers and the signs.
fn rub(
    m: &Mechanism<'_>,
    state: &State,
    signs: &Signs,
    found: &DVector<f64>,
    right: &mut DVector<f64>,
) {
    for (index, (pair, sign)) in m.spec.pairs.iter().zip(&signs.pairs).enumerate() {
        let [a, b] = reaction(m, index, found);
        let (on, block) = (m.point(&pair.on, state), m.point(&pair.link, state));
        let mut act = |link: Option<usize>, force: Vector, couple: f64| {
            let Some(link) = link else { return };
            let centre = [state.place[3 * link], state.place[3 * link + 1]];
            let arm = minus(block.at, centre);
            right[3 * link] += force[0];
            right[3 * link + 1] += force[1];
            right[3 * link + 2] += couple + arm[0] * force[1] - arm[1] * force[0];
        };
        match pair.kind {
            PairKind::Revolute { diameter } => {
                let couple = -sign * pair.friction * 0.5 * diameter * a.hypot(b);
                act(block.link, [0.0; 2], couple);
                act(on.link, [0.0; 2], -couple);
            }
            PairKind::Sliding {
                direction,
                half_height,
                ..
            } => {
                let forces = corner_forces(pair, [a, b]);
                let held = signs.corners.as_ref().map(|corners| corners[index]);
                let pressed = held.unwrap_or(forces.map(f64::signum));
                let [first, second] = [pressed[0] * forces[0], pressed[1] * forces[1]];
                let t = turned([1.0, 0.0], direction + m.angle(on.link, &state.place));
                let pull = -sign * pair.friction * (first + second);
                // A corner that is pressed towards +n touches below the axis.
                let couple = -sign * pair.friction * half_height * a;
                act(block.link, t.map(|part| part * pull), couple);
                act(on.link, t.map(|part| -part * pull), -couple);
            }
        }
    }
}

/// Gauss's elimination with row pivots that skips zeros, of which the matrix is
/// full.
struct Factors {
    rows: Vec<Vec<f64>>,
    order: Vec<usize>,
}

impl Factors {
    fn new(matrix: &DMatrix<f64>) -> Self {
        let n = matrix.nrows();
        let row = |i: usize| matrix.row(i).iter().copied().collect();
        let mut rows: Vec<Vec<f64>> = (0..n).map(row).collect();
        let mut order: Vec<usize> = (0..n).collect();
        for k in 0..n {
            let size = |&i: &usize| rows[i][k].abs();
            let pivot = (k..n)
                .max_by(|a, b| size(a).total_cmp(&size(b)))
                .expect("a row");
            rows.swap(k, pivot);
            order.swap(k, pivot);
            let (upper, lower) = rows.split_at_mut(k + 1);
            let top = &upper[k];
            assert!(top[k] != 0.0, "independent pairs");
            for row in lower.iter_mut().filter(|row| row[k] != 0.0) {
                let factor = row[k] / top[k];
                row[k] = factor;
                for (entry, above) in row[k + 1..].iter_mut().zip(&top[k + 1..]) {
                    *entry -= factor * above;
                }
            }
        }
        Self { rows, order }
    }

    fn solve(&self, right: &DVector<f64>) -> DVector<f64> {
        let mut x: Vec<f64> = self.order.iter().map(|&i| right[i]).collect();
        let part = |row: &[f64], x: &[f64]| -> f64 {
            let pairs = row.iter().zip(x).filter(|(entry, _)| **entry != 0.0);
            pairs.map(|(entry, x)| entry * x).sum()
        };
        for (i, row) in self.rows.iter().enumerate() {
            x[i] -= part(&row[..i], &x[..i]);
        }
        for (i, row) in self.rows.iter().enumerate().rev() {
            x[i] = (x[i] - part(&row[i + 1..], &x[i + 1..])) / row[i];
        }
        DVector::from_vec(x)
    }
}

/// Accelerations and multipliers, sliding in the given directions; `None` where
/// the fixed point is not found.
fn solve(m: &Mechanism<'_>, state: &State, signs: &Signs) -> Option<DVector<f64>> {
    let (matrix, plain) = m.equations(state);
    let factors = Factors::new(&matrix);
    let mut found = factors.solve(&plain);
    let mut settled = 0;
    for _ in 0..ITERATIONS {
        let mut right = plain.clone();
        rub(m, state, signs, &found, &mut right);
        let next = factors.solve(&right);
        let change = (&next - &found).amax();
        found = next;
        // Rounding is reached a few iterations later.
        settled += usize::from(change <= 1e-12 * (1.0 + found.amax()));
        if settled == 3 {
            return Some(found);
        }
    }
    None
}

/// Accelerations of all links; `None` where there is no solution.
pub(crate) fn accelerations(m: &Mechanism<'_>, state: &State, signs: &Signs) -> Option<Vec<f64>> {
    let n = 3 * m.spec.links.len();
    solve(m, state, signs).map(|found| found.as_slice()[..n].to_vec())
}

/// Forces on all corners.
fn corners(m: &Mechanism<'_>, state: &State, signs: &Signs) -> Vec<[f64; 2]> {
    let found = solve(m, state, signs).expect("a solution");
    let pairs = m.spec.pairs.iter().enumerate();
    let of = |(index, pair): (usize, &PairSpec)| corner_forces(pair, reaction(m, index, &found));
    pairs.map(of).collect()
}

/// Power of friction in a state, ≤ 0: what accelerates the masses less what
/// everything else does.
fn power(m: &Mechanism<'_>, state: &State, accelerations: &[f64]) -> f64 {
    let (matrix, plain) = m.equations(state);
    let n = 3 * m.spec.links.len();
    (0..n)
        .map(|row| {
            let inertia: f64 = (0..n)
                .map(|column| matrix[(row, column)] * accelerations[column])
                .sum();
            (inertia - plain[row]) * state.speed[row]
        })
        .sum()
}

/// Acceleration of the input pair, when everything starts from rest.
fn start(m: &Mechanism<'_>, state: &State, pairs: &[f64]) -> Option<f64> {
    let signs = &Signs {
        pairs: pairs.to_vec(),
        corners: None,
    };
    let found = accelerations(m, state, signs)?;
    let moved = State {
        place: state.place.clone(),
        speed: found,
    };
    Some(rate(m, &m.spec.pairs[m.spec.driver], &moved))
}

/// What a mechanism at rest does next.
pub(crate) fn decide(m: &Mechanism<'_>, state: &State, pattern: &[f64]) -> Going {
    let backwards: Vec<f64> = pattern.iter().map(|sign| -sign).collect();
    let forwards = start(m, state, pattern).is_some_and(|a| a > 0.0);
    let backwards = start(m, state, &backwards).is_some_and(|a| a < 0.0);
    match (forwards, backwards) {
        (true, true) => panic!("the motion is not determined"),
        (true, false) => Going::Forwards,
        (false, true) => Going::Backwards,
        (false, false) => Going::Rests,
    }
}

/// One step by the modified midpoint rule, extrapolated to order 10; signs are
/// held. With the work that friction takes on the way.
fn step(m: &Mechanism<'_>, state: &State, signs: &Signs, h: f64) -> (State, f64) {
    let n = state.place.len();
    // Places, speeds and work as one list.
    let slope = |y: &[f64]| {
        let state = unpacked(y, n);
        let a = accelerations(m, &state, signs).expect("a solution");
        let power = -power(m, &state, &a);
        [state.speed, a, vec![power]].concat()
    };
    let start = [&state.place[..], &state.speed[..], &[0.0]].concat();
    let first = slope(&start);
    let mut above: Vec<Vec<f64>> = Vec::new();
    for row in 0..5 {
        let substeps = 2 * (row + 1);
        let little = h / substeps as f64;
        let (mut before, mut here) = (start.clone(), add(&start, &first, little));
        for _ in 1..substeps {
            let next = add(&before, &slope(&here), 2.0 * little);
            (before, here) = (here, next);
        }
        // Aitken and Neville, in squares of the substep.
        let mut entries = vec![here];
        for (column, left) in above.iter().enumerate() {
            let ratio = substeps as f64 / (2 * (row - column)) as f64;
            let last = &entries[column];
            let change = add(last, left, -1.0);
            let better = add(last, &change, 1.0 / (ratio * ratio - 1.0));
            entries.push(better);
        }
        above = entries;
    }
    let found = &above[above.len() - 1];
    (unpacked(found, n), found[2 * n])
}

fn unpacked(y: &[f64], n: usize) -> State {
    State {
        place: y[..n].to_vec(),
        speed: y[n..2 * n].to_vec(),
    }
}

/// Where a function of the step falls below zero, from both sides, to
/// rounding: regula falsi (Illinois).
fn crossing(h: f64, start: f64, end: f64, of: impl Fn(f64) -> f64) -> [f64; 2] {
    let (mut low, mut high) = ((0.0, start.max(0.0)), (h, end));
    for round in 0..TRIES {
        if high.0 - low.0 <= 4.0 * f64::EPSILON * h {
            break;
        }
        let share = match round % 4 {
            3 => 0.5,
            _ => low.1 / (low.1 - high.1),
        };
        let middle = low.0 + share * (high.0 - low.0);
        let value = of(middle);
        if value < 0.0 {
            high = (middle, value);
            low.1 *= 0.5;
        } else {
            low = (middle, value);
            high.1 *= 0.5;
        }
    }
    [low.0, high.0]
}

/// Goes from `from` with steps of `h` through all changes of direction up to
/// `duration`.
pub(crate) fn integrate(m: &Mechanism<'_>, from: &State, duration: f64, steps: usize) -> Course {
    let driver = &m.spec.pairs[m.spec.driver];
    let mut course = Course {
        state: from.clone(),
        stops: Vec::new(),
        rest: 0.0,
        loss: 0.0,
        changes: 0,
    };
    let mut seen = pattern(m, from);
    let mut going = match rate(m, driver, from) > 0.0 {
        true => Going::Forwards,
        false => Going::Backwards,
    };
    let signs_of = |state: &State, seen: &[f64], going: Going| {
        let mut signs = Signs {
            pairs: seen.iter().map(|sign| sign * going.sign()).collect(),
            corners: None,
        };
        let forces = corners(m, state, &signs).into_iter();
        signs.corners = Some(forces.map(|of| of.map(f64::signum)).collect());
        signs
    };
    let mut signs = signs_of(from, &seen, going);
    let grid = duration / steps as f64;
    let mut time = 0.0;
    while time < duration - 1e-13 * duration {
        if going == Going::Rests {
            // Nothing depends on time: what rests stays at rest.
            course.rest = duration - time;
            break;
        }
        let next = (((time / grid) * (1.0 + 1e-12)).floor() + 1.0) * grid;
        let h = next.min(duration) - time;
        let reach = |h: f64| step(m, &course.state, &signs, h);
        // Events, the stop first: pairs and corners are looked at before it.
        // Each is a function that falls below zero.
        let stop = |state: &State| rate(m, driver, state) * going.sign();
        let turn = |state: &State| {
            let input = rate(m, driver, state);
            let pairs = m.spec.pairs.iter().zip(&seen);
            pairs.fold(f64::INFINITY, |least, (pair, sign)| {
                least.min(rate(m, pair, state) / input * sign)
            })
        };
        let tip = |state: &State| {
            let held = signs.corners.iter().flatten().flatten();
            let forces = corners(m, state, &signs);
            let pairs = forces.iter().flatten().zip(held);
            pairs.fold(f64::INFINITY, |least, (force, sign)| {
                least.min(force * sign)
            })
        };
        let locate = |h: f64, of: &dyn Fn(&State) -> f64| {
            let end = of(&reach(h).0);
            (end < 0.0).then(|| crossing(h, of(&course.state), end, |h| of(&reach(h).0)))
        };
        let (mut taken, mut event) = (h, Event::None);
        if let Some([before, _]) = locate(taken, &stop) {
            // Just before the stop, so that the directions can be seen.
            (taken, event) = (before, Event::Stop);
        }
        if taken > 0.0
            && let Some([_, after]) = locate(taken, &turn)
        {
            (taken, event) = (after, Event::Turn);
        }
        if taken > 0.0
            && let Some([_, after]) = locate(taken, &tip)
        {
            (taken, event) = (after, Event::Tip);
        }
        let (ahead, loss) = reach(taken);
        let signs_of_forces = |forces: Vec<[f64; 2]>| -> Vec<[f64; 2]> {
            forces.into_iter().map(|of| of.map(f64::signum)).collect()
        };
        let tips = (event == Event::Tip).then(|| signs_of_forces(corners(m, &ahead, &signs)));
        time += taken;
        course.loss += loss;
        course.state = ahead;
        match event {
            Event::None => {}
            Event::Tip => signs.corners = tips,
            Event::Turn => {
                course.changes += 1;
                seen = pattern(m, &course.state);
                signs = signs_of(&course.state, &seen, going);
            }
            Event::Stop => {
                course.stops.push(time);
                course.state.speed.iter_mut().for_each(|speed| *speed = 0.0);
                going = decide(m, &course.state, &seen);
                if going == Going::Rests {
                    continue;
                }
                // Off the spot, in the direction decided.
                signs = signs_of(&course.state, &seen, going);
                let little = 1e-9 * grid;
                let (off, loss) = step(m, &course.state, &signs, little);
                course.state = off;
                course.loss += loss;
                time += little;
            }
        }
    }
    course
}

/// What ends a step early.
#[derive(Clone, Copy, PartialEq)]
enum Event {
    None,
    /// The input stops.
    Stop,
    /// A pair changes its direction.
    Turn,
    /// The force on a corner changes its sign.
    Tip,
}
