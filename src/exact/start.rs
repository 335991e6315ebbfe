//! The states of the pairs just after t = 0.

use super::functional::Functional;
use super::lanes::Plain;
use super::law::LAW_DEGREE;
use super::pencil::C;
use super::problem::{Flank, PairState, Refusal, TreeProblem};

/// Derivatives looked at where a pair starts exactly on its flank, a few at first.
const ORDERS: [usize; 3] = [4, 16, 64];

/// States of all pairs just after t = 0, and for every pair function how many
/// of its leading derivatives are exactly zero there.
///
/// A pair that starts on its flank with Ẋ = 0 takes the side of the first
/// derivative of X that does not vanish. Derivatives follow from the equations
/// of motion, J q⁽ᵐ⁺²⁾ = f⁽ᵐ⁾ − B q⁽ᵐ⁺¹⁾ − K q⁽ᵐ⁾, in which exact zeros stay
/// exact: with the load on the last mass of ten and a sine for the law, the
/// first mass feels the law's jerk long before the load.
pub(crate) fn states(
    problem: &TreeProblem,
    functionals: &[Functional],
    first: &[usize],
) -> Result<(Vec<PairState>, Vec<usize>), Refusal> {
    let n = problem.masses.len();
    let (q, v) = (&problem.displacement, &problem.speed);
    let mut states = vec![PairState::Free; n];
    let mut zeros = vec![0; functionals.len()];
    let mut open: Vec<(usize, usize)> = Vec::new();
    for i in 0..n {
        let (_, count) = problem.masses[i].pair.flanks();
        for f in 0..count {
            let clear = &functionals[first[i] + 2 * f];
            let pull = &functionals[first[i] + 2 * f + 1];
            let x = clear.value(q, v);
            if x < 0.0 {
                let r = pull.value(q, v);
                states[i] = if r < 0.0 {
                    PairState::Engaged(f as u8)
                } else {
                    PairState::Pressed(f as u8)
                };
                zeros[first[i] + 2 * f + 1] = usize::from(r == 0.0);
            } else if x == 0.0
                && !matches!(states[i], PairState::Pressed(_) | PairState::Engaged(_))
            {
                open.push((i, f));
            }
        }
    }
    while !open.is_empty() {
        let mut found = (Vec::new(), None);
        for orders in ORDERS {
            let d = derivatives(problem, &states, orders);
            let least = open
                .iter()
                .filter_map(|&(i, f)| leading(problem, i, f, &d))
                .map(|l| l.0)
                .min();
            found = (d, least);
            if least.is_some() {
                break;
            }
        }
        let lead = |&(i, f): &(usize, usize)| leading(problem, i, f, &found.0);
        let Some(order) = found.1 else {
            // Nothing moves them: they rest on their flank, unloaded.
            for (i, f) in open.drain(..) {
                states[i] = PairState::Engaged(f as u8);
                zeros[first[i] + 2 * f + 1] = 4;
            }
            break;
        };
        let mut rest = Vec::new();
        for pair in open {
            let (i, f) = pair;
            match lead(&pair) {
                // What comes at a speed strikes at once: the walk finds the impact at t = 0.
                Some((1, sign)) if sign < 0.0 && problem.masses[i].restitution.is_some() => {}
                Some((o, sign)) if o == order => {
                    let at = first[i] + 2 * f;
                    if sign < 0.0 {
                        states[i] = PairState::Engaged(f as u8);
                        // The pull c·X + b·Ẋ leads by one order when damped.
                        let mass = &problem.masses[i];
                        let leads = match mass.restitution {
                            // Held, the force is J·Ẍ turned round.
                            Some(_) => 2,
                            None => usize::from(mass.damping > 0.0),
                        };
                        zeros[at + 1] = order.saturating_sub(leads).min(4);
                    } else {
                        zeros[at] = order.min(4);
                    }
                }
                _ if states[i] == PairState::Free => rest.push(pair),
                _ => {}
            }
        }
        open = rest;
    }
    Ok((states, zeros))
}

/// Order and sign of the first derivative of a flank's clearance that does not vanish.
fn leading(problem: &TreeProblem, i: usize, f: usize, d: &[f64]) -> Option<(usize, f64)> {
    let n = problem.masses.len();
    let mass = &problem.masses[i];
    let Flank { sign, .. } = mass.pair.flanks().0[f];
    d.chunks_exact(n)
        .enumerate()
        .skip(1)
        .find_map(|(order, d)| {
            let own = d[i];
            let base = mass.parent.map_or(0.0, |p| mass.lever * d[p]);
            let x = sign * (own - base);
            (x.abs() > 1e-14 * (own.abs() + base.abs()) && x.is_finite()).then_some((order, x))
        })
}

/// q and its derivatives at t = 0⁺, n numbers an order.
fn derivatives(problem: &TreeProblem, states: &[PairState], orders: usize) -> Vec<f64> {
    let n = problem.masses.len();
    let mut forcing = problem.law.forcing();
    problem
        .law
        .start::<Plain>(0.0, 0.0, &mut None, &mut forcing);
    let mut all = vec![0.0; (orders + 2) * n];
    all[..n].copy_from_slice(&problem.displacement);
    all[n..2 * n].copy_from_slice(&problem.speed);
    for order in 0..orders {
        let (known, force) = all.split_at_mut((order + 2) * n);
        let force = &mut force[..n];
        let d = |order: usize, i: usize| known[order * n + i];
        let law = |k: usize| -> f64 {
            // The k-th derivative of the law at t = 0.
            let mut sum = 0.0;
            for (z, omega) in forcing.harmonics.iter().zip(problem.law.frequencies()) {
                let mut w = *z;
                for _ in 0..k {
                    w = C::new(-w.im * omega, w.re * omega);
                }
                sum += w.re;
            }
            let mut scale = 1.0;
            for j in 1..=k {
                scale *= j as f64;
            }
            sum + forcing.law.get(k).map_or(0.0, |c| c * scale)
        };
        for (i, mass) in problem.masses.iter().enumerate() {
            force[i] += -mass.ratio
                * (mass.inertia * law(order + 2)
                    + mass.ground_damping * law(order + 1)
                    + mass.ground_stiffness * law(order))
                - mass.ground_damping * d(order + 1, i)
                - mass.ground_stiffness * d(order, i);
            if order == 0 {
                force[i] -= mass.ground_stiffness * mass.offset;
            }
            let mut load = [0.0; LAW_DEGREE + 1];
            for own in &mass.loads {
                own.add(0.0, 0.0, &mut None, &mut load);
            }
            let factorial: f64 = (1..=order).map(|k| k as f64).product();
            force[i] += load.get(order).map_or(0.0, |c| c * factorial);
            let (flanks, count) = mass.pair.flanks();
            let relaxed = match states[i] {
                _ if count == 0 => 0.0,
                PairState::Engaged(f) => {
                    let flank = flanks[usize::from(f)];
                    flank.sign * flank.offset
                }
                _ => continue,
            };
            let x = |k: usize| d(k, i) - mass.parent.map_or(0.0, |p| mass.lever * d(k, p));
            let spring = x(order) + if order == 0 { relaxed } else { 0.0 };
            let pull = mass.stiffness * spring + mass.damping * x(order + 1);
            force[i] -= pull;
            if let Some(p) = mass.parent {
                force[p] += mass.lever * pull;
            }
        }
        for (force, mass) in force.iter_mut().zip(&problem.masses) {
            *force /= mass.inertia;
        }
    }
    all
}
