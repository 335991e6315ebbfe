//! Which method for which system: `method: auto`.

use super::{Dynamics, Method, Modes};
use std::f64::consts::TAU;

/// What the choice of a method depends on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Situation {
    /// Greatest rate of the system (1/s): spectral radius of its Jacobian with
    /// every pair engaged, see [`fastest_rate`]. An explicit method must follow
    /// it even when nothing of it is to be seen in the motion.
    pub fastest: f64,
    /// Highest angular frequency (rad/s) that the motion shows: that of the
    /// drive, or, where pairs open and close, the base frequency of the
    /// objects that they hit.
    pub resolved: f64,
    /// True when the fastest motions are damped; BDF is not fit for others.
    pub damped: bool,
    /// Error wanted, relative to the scales of the state.
    pub tolerance: f64,
    /// Number of coordinates.
    pub coordinates: usize,
    /// Time to be simulated (s).
    pub duration: f64,
}

/// How a method behaves on an oscillator of 1 rad/s: measured with this
/// program over five oscillations.
struct Behaviour {
    method: Method,
    /// Step at tolerance 1e-8 (s).
    step: f64,
    /// The step grows with the tolerance to the power 1/`order`.
    order: f64,
    /// Greatest rate × step that remains stable.
    stable: f64,
    /// Cost of a step in evaluations, and what is added for every coordinate
    /// (solution of the linear system).
    cost: [f64; 2],
}

const BEHAVIOURS: [Behaviour; 4] = [
    Behaviour {
        method: Method::Dop853,
        step: 0.47,
        order: 8.0,
        stable: 6.1,
        cost: [16.0, 0.0],
    },
    Behaviour {
        method: Method::Dopri5,
        step: 0.064,
        order: 5.0,
        stable: 3.3,
        cost: [6.0, 0.0],
    },
    Behaviour {
        method: Method::Bdf,
        step: 0.034,
        order: 5.0,
        stable: f64::INFINITY,
        cost: [4.0, 0.2],
    },
    Behaviour {
        method: Method::Esdirk34,
        step: 0.0156,
        order: 4.0,
        stable: f64::INFINITY,
        cost: [5.0, 0.5],
    },
];

impl Behaviour {
    /// Steps (s) that accuracy and stability allow.
    fn steps(&self, situation: &Situation) -> [f64; 2] {
        let accurate = self.step * (situation.tolerance / 1e-8).powf(1.0 / self.order);
        [
            accurate / situation.resolved,
            self.stable / situation.fastest,
        ]
    }

    /// Evaluations for the whole run.
    fn evaluations(&self, situation: &Situation) -> f64 {
        let [accurate, stable] = self.steps(situation);
        let cost = self.cost[0] + self.cost[1] * situation.coordinates as f64;
        cost * situation.duration / accurate.min(stable).min(situation.duration)
    }
}

/// The method that is expected to need the least work, and why, in a sentence.
///
/// Explicit unless an implicit method needs less than half the work: its
/// larger steps must pay for the linear systems and for beginning anew after
/// every switch.
pub fn choose(situation: &Situation) -> (Method, String) {
    // Something is to be seen at least once in the run, and a system without
    // springs has no rate of its own.
    let resolved = situation.resolved.max(TAU / situation.duration);
    let situation = &Situation {
        resolved,
        fastest: situation.fastest.max(resolved),
        ..*situation
    };
    let implicit = if situation.damped {
        Method::Bdf
    } else {
        Method::Esdirk34
    };
    let least = |candidates: &dyn Fn(Method) -> bool| {
        let fit = BEHAVIOURS.iter().filter(|b| candidates(b.method));
        fit.min_by(|a, b| {
            a.evaluations(situation)
                .total_cmp(&b.evaluations(situation))
        })
        .expect("the list has methods of both kinds")
    };
    let explicit = least(&|m| matches!(m, Method::Dop853 | Method::Dopri5));
    let implicit = least(&|m| m == implicit);
    let work = explicit.evaluations(situation);
    let rate = situation.fastest / situation.resolved;
    let [accurate, stable] = explicit.steps(situation);
    if 2.0 * implicit.evaluations(situation) < work {
        let reason = format!(
            "the system's fastest rate, {:.2e} 1/s, is {rate:.0} times what the motion shows; \
             {} would be held to steps of {stable:.1e} s where {} takes {:.1e} s",
            situation.fastest,
            explicit.method,
            implicit.method,
            implicit.steps(situation)[0],
        );
        return (implicit.method, reason);
    }
    let bound = if accurate <= stable {
        "the tolerance"
    } else {
        "the system's fastest rate"
    };
    let reason = format!(
        "explicit, as the fastest rate, {:.2e} 1/s, is only {rate:.1} times what the motion shows; \
         {bound} asks for steps of about {:.1e} s",
        situation.fastest,
        accurate.min(stable),
    );
    (explicit.method, reason)
}

/// Spectral radius (1/s) of the Jacobian at a state: the mean growth of a
/// vector under repeated multiplication, in units of the scales. Good to a few
/// per cent, for real and complex dominant pairs alike; 0 for free masses.
pub fn fastest_rate<D: Dynamics>(dynamics: &D, time: f64, y: &[f64], modes: &Modes) -> f64 {
    const SETTLE: usize = 40;
    const MEASURE: usize = 160;
    let scales = dynamics.scales();
    let mut scratch = dynamics.scratch();
    // No symmetry of a chain may be orthogonal to the start.
    let start = |index: usize| 1.0 + 0.37 * ((index * 7 + 3) % 11) as f64;
    let mut vector: Vec<f64> = scales
        .iter()
        .enumerate()
        .map(|(i, s)| s * start(i))
        .collect();
    let mut image = vec![0.0; vector.len()];
    let mut logarithm = 0.0;
    for iteration in 0..SETTLE + MEASURE {
        dynamics.tangent(time, y, modes, &vector, &mut scratch, &mut image);
        let squares = image.iter().zip(scales).map(|(e, s)| (e / s).powi(2));
        let size = squares.sum::<f64>().sqrt();
        if !(size > 0.0 && size.is_finite()) {
            return 0.0;
        }
        if iteration >= SETTLE {
            logarithm += size.ln();
        }
        for (next, entry) in vector.iter_mut().zip(&image) {
            *next = entry / size;
        }
    }
    (logarithm / MEASURE as f64).exp()
}

#[cfg(test)]
mod tests {
    use super::super::problems::{Oscillator, Rocker, Thrown};
    use super::*;

    #[test]
    fn the_fastest_rate_agrees_with_closed_forms() {
        let rate = |damping: f64| {
            let system = Oscillator {
                damping,
                ..Oscillator::free(30.0)
            };
            fastest_rate(&system, 0.0, &[0.0, 0.0], &Modes::default())
        };
        approx::assert_relative_eq!(rate(0.0), 30.0, max_relative = 1e-2);
        approx::assert_relative_eq!(rate(0.2), 30.0, max_relative = 2e-2);
        // Overdamped: λ = −ω(ζ + √(ζ² − 1)).
        let expected = 30.0 * (5.0 + 24.0f64.sqrt());
        approx::assert_relative_eq!(rate(5.0), expected, max_relative = 1e-3);
        let free = Thrown::new(9.81, 1.0);
        assert_eq!(fastest_rate(&free, 0.0, &[0.0, 0.0], &Modes(vec![0])), 0.0);
    }

    fn rocker(masses: usize, tolerance: f64) -> (Method, String) {
        let system = Rocker::published(masses, 0.4);
        let (y, modes) = system.static_start();
        choose(&Situation {
            fastest: fastest_rate(&system, 0.0, &y, &modes),
            resolved: 1e4,
            damped: true,
            tolerance,
            coordinates: masses,
            duration: 0.5,
        })
    }

    #[test]
    fn a_stiff_chain_gets_an_implicit_method_and_a_short_one_an_explicit() {
        for tolerance in [1e-4, 1e-6, 1e-8] {
            let (method, why) = rocker(10, tolerance);
            assert_eq!(method, Method::Bdf, "{why}");
            assert!(why.contains("times what the motion shows"));
        }
        for tolerance in [1e-6, 1e-8, 1e-10] {
            assert_eq!(rocker(1, tolerance).0, Method::Dop853);
            assert_eq!(rocker(2, tolerance).0, Method::Dop853);
        }
    }

    #[test]
    fn a_system_at_rest_without_springs_has_a_method_and_a_readable_reason() {
        let (method, why) = choose(&Situation {
            fastest: 0.0,
            resolved: 0.0,
            damped: false,
            tolerance: 1e-8,
            coordinates: 1,
            duration: 2.0,
        });
        assert_eq!(method, Method::Dop853);
        assert!(!why.contains("NaN") && !why.contains("inf"), "{why}");
    }

    #[test]
    fn without_damping_no_bdf_and_a_loose_tolerance_prefers_the_lower_order() {
        let mut situation = Situation {
            fastest: 1e7,
            resolved: 100.0,
            damped: false,
            tolerance: 1e-5,
            coordinates: 4,
            duration: 1.0,
        };
        assert_eq!(choose(&situation).0, Method::Esdirk34);
        situation.fastest = 100.0;
        situation.tolerance = 1e-2;
        assert_eq!(choose(&situation).0, Method::Dopri5);
        situation.tolerance = 1e-9;
        let (method, why) = choose(&situation);
        assert_eq!(method, Method::Dop853);
        assert!(why.contains("the tolerance asks for steps"), "{why}");
    }
}
