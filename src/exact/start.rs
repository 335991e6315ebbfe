//! The states of the pairs just after t = 0.

use super::functional::Functional;
use super::lanes::Plain;
use super::law::{Forcing, LAW_DEGREE};
use super::pencil::C;
use super::problem::{Flank, PairState, Refusal, TreeMass, TreeProblem};

/// Derivatives looked at where a pair starts exactly on its flank, some at first.
const ORDERS: [usize; 2] = [16, 64];

/// Share of the shortest time of a problem in which no motion is told.
const AT_ONCE: f64 = 1e-9;

/// States of all pairs just after t = 0, and for every pair function how many
/// of its leading derivatives are exactly zero there.
///
/// A pair that starts on its flank with Ẋ = 0 takes the side of the first
/// derivative of X that does not vanish. Derivatives follow from the equations
/// of motion, J q⁽ᵐ⁺²⁾ = f⁽ᵐ⁾ − B q⁽ᵐ⁺¹⁾ − K q⁽ᵐ⁾, in which exact zeros stay
/// exact. With the load on the last mass of ten and a sine for the law, the
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

/// Order and sign of the derivative of a flank's clearance that moves it first: the lowest that
/// does not vanish, but for what another overtakes before any motion can be told.
fn leading(problem: &TreeProblem, i: usize, f: usize, d: &[f64]) -> Option<(usize, f64)> {
    let n = problem.masses.len();
    let mass = &problem.masses[i];
    let Flank { sign, .. } = mass.pair.flanks().0[f];
    let step = AT_ONCE * shortest(problem);
    let mut most = (0.0, None);
    let mut weight = 1.0;
    for (order, d) in d.chunks_exact(n).enumerate().skip(1) {
        weight *= step / order as f64;
        let own = d[i];
        let base = mass.parent.map_or(0.0, |p| mass.lever * d[p]);
        let x = sign * (own - base);
        let counts = x.abs() > 1e-14 * (own.abs() + base.abs()) && x.is_finite();
        if counts && (most.1.is_none() || x.abs() * weight > most.0) {
            most = (x.abs() * weight, Some((order, x)));
        }
    }
    most.1
}

/// The shortest time in which masses move by their links, or with the law (s).
fn shortest(problem: &TreeProblem) -> f64 {
    let of_mass = |mass: &TreeMass| {
        let rate = (mass.stiffness + mass.ground_stiffness) / mass.inertia;
        rate.sqrt().max(mass.damping / mass.inertia)
    };
    let masses = problem.masses.iter().map(of_mass);
    let fastest = masses.chain(problem.law.frequencies()).fold(0.0, f64::max);
    match fastest > 0.0 && fastest.is_finite() {
        true => fastest.recip(),
        false => 1.0,
    }
}

/// Share of the terms of a sum below which it is their rounding: forces that cancel leave
/// no derivative.
const ROUNDING: f64 = 1e-13;

/// A sum, and the sizes of its terms added up.
#[derive(Clone, Copy, Debug, Default)]
struct Sum {
    value: f64,
    size: f64,
}

impl Sum {
    fn of(value: f64) -> Self {
        let size = value.abs();
        Self { value, size }
    }

    fn add(&mut self, factor: f64, term: Self) {
        self.value += factor * term.value;
        self.size += factor.abs() * term.size;
    }

    /// Zero where it is rounding.
    fn zero_if_rounding(self) -> Self {
        match self.value.abs() <= ROUNDING * self.size {
            true => Self::default(),
            false => self,
        }
    }
}

/// The k-th derivative of the law at t = 0.
fn law(problem: &TreeProblem, forcing: &Forcing, k: usize) -> Sum {
    let mut sum = Sum::default();
    for (z, omega) in forcing.harmonics.iter().zip(problem.law.frequencies()) {
        let mut w = *z;
        for _ in 0..k {
            w = C::new(-w.im * omega, w.re * omega);
        }
        sum.value += w.re;
        sum.size += w.re.abs().max(w.im.abs());
    }
    // An acceleration that was fitted has coefficients that are known to the rounding of all
    // of it over its piece.
    let piece = forcing.end.min(forcing.reach);
    let size = |(j, c): (usize, &f64)| match j {
        _ if j == k => c.abs(),
        0 | 1 => 0.0,
        _ if k < 2 => 0.0,
        _ => c.abs() * piece.powi(j as i32 - k as i32),
    };
    let own = forcing.law.get(k).map_or(Sum::default(), |&value| Sum {
        value,
        size: {
            let sizes = forcing.law.iter().enumerate().map(size);
            sizes.filter(|size| size.is_finite()).sum()
        },
    });
    let factorial: f64 = (1..=k).map(|j| j as f64).product();
    sum.add(factorial, own);
    sum
}

/// q and its derivatives at t = 0⁺, n numbers an order.
fn derivatives(problem: &TreeProblem, states: &[PairState], orders: usize) -> Vec<f64> {
    let n = problem.masses.len();
    let mut forcing = problem.law.forcing();
    problem
        .law
        .start::<Plain>(0.0, 0.0, &mut None, &mut forcing);
    let start = problem.displacement.iter().chain(&problem.speed);
    let mut all: Vec<Sum> = start.map(|&value| Sum::of(value)).collect();
    for order in 0..orders {
        let known = |k: usize, i: usize| all[k * n + i];
        let motion = [0, 1, 2].map(|more| law(problem, &forcing, order + more));
        let mut force = vec![Sum::default(); n];
        for (i, mass) in problem.masses.iter().enumerate() {
            let own = [known(order, i), known(order + 1, i)];
            from_outside(mass, order, motion, own, &mut force[i]);
            let stretch = |k: usize| {
                let mut x = known(k, i);
                if let Some(p) = mass.parent {
                    x.add(-mass.lever, known(k, p));
                }
                x
            };
            if let Some(pull) = pull(mass, states[i], order, stretch) {
                force[i].add(-1.0, pull);
                if let Some(p) = mass.parent {
                    force[p].add(mass.lever, pull);
                }
            }
        }
        let next = force.iter().zip(&problem.masses).map(|(force, mass)| {
            let mut acceleration = Sum::default();
            acceleration.add(1.0 / mass.inertia, *force);
            acceleration.zero_if_rounding()
        });
        let next: Vec<Sum> = next.collect();
        all.extend(next);
    }
    all.into_iter().map(|own| own.value).collect()
}

/// Adds the derivative of an order of what acts on a mass besides its link, for the
/// derivatives of the law and of its own motion from that order on.
fn from_outside(mass: &TreeMass, order: usize, motion: [Sum; 3], own: [Sum; 2], force: &mut Sum) {
    let on = [mass.ground_stiffness, mass.ground_damping, mass.inertia];
    for (factor, law) in on.into_iter().zip(motion) {
        force.add(-mass.ratio * factor, law);
    }
    for (factor, own) in on.into_iter().zip(own) {
        force.add(-factor, own);
    }
    if order == 0 {
        force.add(-mass.ground_stiffness, Sum::of(mass.offset));
    }
    let mut load = [0.0; LAW_DEGREE + 1];
    for own in &mass.loads {
        own.add(0.0, 0.0, &mut None, &mut load);
    }
    let factorial: f64 = (1..=order).map(|k| k as f64).product();
    let load = load.get(order).map_or(0.0, |c| c * factorial);
    force.add(1.0, Sum::of(load));
}

/// The derivative of an order of the pull of a mass's link, X's own being `stretch`; `None`
/// where the pair is open.
fn pull(
    mass: &TreeMass,
    state: PairState,
    order: usize,
    stretch: impl Fn(usize) -> Sum,
) -> Option<Sum> {
    let (flanks, count) = mass.pair.flanks();
    let relaxed = match state {
        _ if count == 0 => 0.0,
        PairState::Engaged(f) => {
            let flank = flanks[usize::from(f)];
            flank.sign * flank.offset
        }
        PairState::Free | PairState::Pressed(_) => return None,
    };
    let mut pull = Sum::default();
    pull.add(mass.stiffness, stretch(order));
    pull.add(mass.damping, stretch(order + 1));
    if order == 0 {
        pull.add(mass.stiffness, Sum::of(relaxed));
    }
    Some(pull)
}
