//! Runge–Kutta integration of a tree's equations of motion in small fixed steps.

use super::super::*;

/// A pair's clearance and pull on flank f.
fn clearance(problem: &TreeProblem, i: usize, f: usize, q: &[f64], v: &[f64]) -> (f64, f64) {
    let mass = &problem.masses[i];
    let flank = mass.pair.flanks().0[f];
    let base = |y: &[f64]| mass.parent.map_or(0.0, |p| mass.lever * y[p]);
    let x = flank.sign * (q[i] - base(q)) + flank.offset;
    let rate = flank.sign * (v[i] - base(v));
    (x, mass.stiffness * x + mass.damping * rate)
}

/// L, L̇, L̈ at an instant, on the side of a joint where the second instant lies.
pub(super) type LawAt = dyn Fn(f64, f64) -> [f64; 3];

/// q̈ from the equations of motion.
fn acceleration(
    problem: &TreeProblem,
    law: &LawAt,
    states: &[PairState],
    (t, side): (f64, f64),
    q: &[f64],
    v: &[f64],
) -> Vec<f64> {
    let [l, dl, ddl] = law(t, side);
    let mut force: Vec<f64> = problem
        .masses
        .iter()
        .enumerate()
        .map(|(i, mass)| {
            let load: f64 = mass.loads.iter().map(|load| value(load, t)).sum();
            load - mass.inertia * mass.ratio * ddl
                - mass.ground_damping * (v[i] + mass.ratio * dl)
                - mass.ground_stiffness * (q[i] + mass.ratio * l + mass.offset)
        })
        .collect();
    for (i, mass) in problem.masses.iter().enumerate() {
        let pull = match states[i] {
            _ if mass.pair == TreePair::Bilateral => {
                let base = |y: &[f64]| mass.parent.map_or(0.0, |p| mass.lever * y[p]);
                mass.stiffness * (q[i] - base(q)) + mass.damping * (v[i] - base(v))
            }
            PairState::Engaged(f) => {
                let f = usize::from(f);
                mass.pair.flanks().0[f].sign * clearance(problem, i, f, q, v).1
            }
            _ => continue,
        };
        force[i] -= pull;
        if let Some(p) = mass.parent {
            force[p] += mass.lever * pull;
        }
    }
    force
        .iter()
        .zip(&problem.masses)
        .map(|(f, mass)| f / mass.inertia)
        .collect()
}

fn value(load: &TimeLoad, t: f64) -> f64 {
    match load {
        TimeLoad::Constant(w) => *w,
        TimeLoad::Table(points) => {
            let after = points.partition_point(|p| p.0 <= t);
            match after {
                0 => points[0].1,
                k if k == points.len() => points[k - 1].1,
                k => {
                    let (a, b) = (points[k - 1], points[k]);
                    a.1 + (b.1 - a.1) * (t - a.0) / (b.0 - a.0)
                }
            }
        }
        TimeLoad::Pieces(_) => panic!("not used here"),
    }
}

/// The state a pair has to leave its present one for, if any.
fn violated(
    problem: &TreeProblem,
    i: usize,
    state: PairState,
    q: &[f64],
    v: &[f64],
) -> Option<PairState> {
    let count = problem.masses[i].pair.flanks().1;
    let at = |f: usize| clearance(problem, i, f, q, v);
    match state {
        _ if count == 0 => None,
        PairState::Engaged(f) if at(usize::from(f)).1 > 0.0 => {
            let clear = problem.masses[i].damping == 0.0;
            Some(if clear {
                PairState::Free
            } else {
                PairState::Pressed(f)
            })
        }
        PairState::Pressed(f) => match at(usize::from(f)) {
            (x, _) if x > 0.0 => Some(PairState::Free),
            (_, pull) if pull < 0.0 => Some(PairState::Engaged(f)),
            _ => None,
        },
        PairState::Free => (0..count)
            .find(|f| at(*f).0 < 0.0)
            .map(|f| PairState::Engaged(f as u8)),
        PairState::Engaged(_) => None,
    }
}

/// End state and switches (engaged on one side of them).
pub(super) struct Integrated {
    pub(super) q: Vec<f64>,
    pub(super) v: Vec<f64>,
    pub(super) switches: Vec<f64>,
}

/// From the problem's start to `end` in so many steps.
pub(super) fn integrate(
    problem: &TreeProblem,
    law: &LawAt,
    start: &[PairState],
    end: f64,
    steps: usize,
) -> Integrated {
    let mut states = start.to_vec();
    let (mut q, mut v) = (problem.displacement.clone(), problem.speed.clone());
    let mut switches = Vec::new();
    let advance = |states: &[PairState], (t, side): (f64, f64), h: f64, q: &[f64], v: &[f64]| {
        let mix = |y: &[f64], k: &[f64], c: f64| -> Vec<f64> {
            y.iter().zip(k).map(|(y, k)| y + c * k).collect()
        };
        let a1 = acceleration(problem, law, states, (t, side), q, v);
        let (q2, v2) = (mix(q, v, h / 2.0), mix(v, &a1, h / 2.0));
        let a2 = acceleration(problem, law, states, (t + h / 2.0, side), &q2, &v2);
        let (q3, v3) = (mix(q, &v2, h / 2.0), mix(v, &a2, h / 2.0));
        let a3 = acceleration(problem, law, states, (t + h / 2.0, side), &q3, &v3);
        let (q4, v4) = (mix(q, &v3, h), mix(v, &a3, h));
        let a4 = acceleration(problem, law, states, (t + h, side), &q4, &v4);
        let sum = |y: &[f64], k: [&[f64]; 4]| -> Vec<f64> {
            (0..y.len())
                .map(|i| y[i] + h / 6.0 * (k[0][i] + 2.0 * k[1][i] + 2.0 * k[2][i] + k[3][i]))
                .collect()
        };
        (sum(q, [v, &v2, &v3, &v4]), sum(v, [&a1, &a2, &a3, &a4]))
    };
    let broken = |states: &[PairState], q: &[f64], v: &[f64]| {
        (0..states.len()).any(|i| violated(problem, i, states[i], q, v).is_some())
    };
    for k in 0..steps {
        let (mut t, last) = (
            end * k as f64 / steps as f64,
            end * (k + 1) as f64 / steps as f64,
        );
        let side = end * (k as f64 + 0.5) / steps as f64;
        for _ in 0..100 {
            let h = last - t;
            let (a, b) = advance(&states, (t, side), h, &q, &v);
            if !broken(&states, &a, &b) {
                (q, v) = (a, b);
                break;
            }
            let (mut low, mut high) = (0.0, h);
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                let (a, b) = advance(&states, (t, side), middle, &q, &v);
                if broken(&states, &a, &b) {
                    high = middle
                } else {
                    low = middle
                }
            }
            (q, v) = advance(&states, (t, side), high, &q, &v);
            t += high;
            for i in 0..states.len() {
                if let Some(next) = violated(problem, i, states[i], &q, &v) {
                    if next.engaged() != states[i].engaged() {
                        switches.push(t);
                    }
                    states[i] = next;
                }
            }
        }
    }
    Integrated { q, v, switches }
}
