//! Linkages with joint friction in absolute coordinates: friction from the
//! Lagrange multipliers by a fixed point, directions by the signs of the pairs'
//! speeds, changes of sign located by bisection of a step.

use crate::multipliers::{Mechanism, State, Vector, add, dot, minus, turned};
use dam::linkage::spec::{PairKind, PairSpec};
use nalgebra::DVector;

/// Bisections of a step: to rounding.
const HALVINGS: usize = 60;
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

/// Friction of all pairs on the links, given the multipliers and the signs.
/// Force and couple on link j from i are −λ.
fn rub(
    m: &Mechanism<'_>,
    state: &State,
    signs: &[f64],
    found: &DVector<f64>,
    right: &mut DVector<f64>,
) {
    let n = 3 * m.spec.links.len();
    for (index, (pair, sign)) in m.spec.pairs.iter().zip(signs).enumerate() {
        let [a, b] = [-found[n + 2 * index], -found[n + 2 * index + 1]];
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
                corners: [forward, back],
                half_height,
                ..
            } => {
                // N₁ + N₂ = a, b₁·N₁ + b₂·N₂ = b: two corners carry both.
                let first = (b - back * a) / (forward - back);
                let second = a - first;
                let t = turned([1.0, 0.0], direction + m.angle(on.link, &state.place));
                let pull = -sign * pair.friction * (first.abs() + second.abs());
                // A corner that is pressed towards +n touches below the axis.
                let couple = -sign * pair.friction * half_height * (first + second);
                act(block.link, t.map(|part| part * pull), couple);
                act(on.link, t.map(|part| -part * pull), -couple);
            }
        }
    }
}

/// Accelerations of all links, sliding in the given directions; `None` where
/// the fixed point is not found.
pub(crate) fn accelerations(m: &Mechanism<'_>, state: &State, signs: &[f64]) -> Option<Vec<f64>> {
    let n = 3 * m.spec.links.len();
    let (matrix, plain) = m.equations(state);
    let factors = matrix.lu();
    let mut found = factors.solve(&plain).expect("independent pairs");
    for _ in 0..ITERATIONS {
        let mut right = plain.clone();
        rub(m, state, signs, &found, &mut right);
        let next = factors.solve(&right).expect("independent pairs");
        let change = (&next - &found).amax();
        found = next;
        if change <= 1e-14 * (1.0 + found.amax()) {
            return Some(found.as_slice()[..n].to_vec());
        }
    }
    None
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
fn start(m: &Mechanism<'_>, state: &State, signs: &[f64]) -> Option<f64> {
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

/// One step of the classical Runge–Kutta method, directions fixed.
fn step(m: &Mechanism<'_>, state: &State, signs: &[f64], h: f64) -> (State, f64) {
    let of = |state: &State| accelerations(m, state, signs).expect("a solution");
    let moved = |speed: &[f64], a: &[f64], h: f64| State {
        place: add(&state.place, speed, h),
        speed: add(&state.speed, a, h),
    };
    let a1 = of(state);
    let s2 = moved(&state.speed, &a1, 0.5 * h);
    let a2 = of(&s2);
    let s3 = moved(&s2.speed, &a2, 0.5 * h);
    let a3 = of(&s3);
    let s4 = moved(&s3.speed, &a3, h);
    let a4 = of(&s4);
    let mean = |parts: [&[f64]; 4]| -> Vec<f64> {
        let [a, b, c, d] = parts;
        let one = |i: usize| (a[i] + 2.0 * (b[i] + c[i]) + d[i]) / 6.0;
        (0..a.len()).map(one).collect()
    };
    let speed = mean([&state.speed, &s2.speed, &s3.speed, &s4.speed]);
    let found = moved(&speed, &mean([&a1, &a2, &a3, &a4]), h);
    let loss = [
        (state, &a1, 1.0),
        (&s2, &a2, 2.0),
        (&s3, &a3, 2.0),
        (&s4, &a4, 1.0),
    ]
    .iter()
    .map(|(state, a, weight)| -power(m, state, a) * weight / 6.0 * h)
    .sum();
    (found, loss)
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
        let signs: Vec<f64> = seen.iter().map(|sign| sign * going.sign()).collect();
        let reach = |h: f64| step(m, &course.state, &signs, h);
        let stopped = |state: &State| rate(m, driver, state) * going.sign() <= 0.0;
        let turned = |state: &State| pattern(m, state) != seen;
        let bisect = |h: f64, over: &dyn Fn(&State) -> bool| {
            let (mut low, mut high) = (0.0, h);
            for _ in 0..HALVINGS {
                let middle = 0.5 * (low + high);
                match over(&reach(middle).0) {
                    true => high = middle,
                    false => low = middle,
                }
            }
            (low, high)
        };
        let (mut ahead, mut loss) = reach(h);
        let mut taken = h;
        let mut halt = false;
        if stopped(&ahead) {
            // Just before the stop, so that the pattern can be seen.
            taken = bisect(h, &stopped).0;
            (ahead, loss) = reach(taken);
            halt = true;
        }
        if taken > 0.0 && rate(m, driver, &ahead) != 0.0 && turned(&ahead) {
            let high = bisect(taken, &turned).1;
            if high < taken {
                taken = high;
                (ahead, loss) = reach(taken);
                halt = false;
            }
            course.changes += 1;
            seen = pattern(m, &ahead);
        }
        time += taken;
        course.loss += loss;
        course.state = ahead;
        if halt {
            course.stops.push(time);
            course.state.speed.iter_mut().for_each(|speed| *speed = 0.0);
            going = decide(m, &course.state, &seen);
            if going != Going::Rests {
                // Off the spot, in the direction decided.
                let signs: Vec<f64> = seen.iter().map(|sign| sign * going.sign()).collect();
                let little = 1e-9 * grid;
                (course.state, loss) = step(m, &course.state, &signs, little);
                course.loss += loss;
                time += little;
            }
        }
    }
    course
}
