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
    /// True when the motion has a power series ([`Dynamics::expands`]).
    pub expands: bool,
    /// True when the equations have kinks that no switch marks (blocks whose corners
    /// change the side on which they press): long steps of high order miss them.
    pub kinks: bool,
    /// Error wanted, relative to the scales of the state.
    pub tolerance: f64,
    /// Number of coordinates.
    pub coordinates: usize,
    /// Time to be simulated (s).
    pub duration: f64,
}

/// How a method behaves: steps as measured with this program on an oscillator of
/// 1 rad/s (the implicit methods: on the press of the scenarios, in proportion to
/// Dopri5, as long as keeps the error within the tolerance: Rodas5P misses it
/// eightfold otherwise), costs on the same press. Series follow their coefficients; the bound of stability
/// given is that of the exponential series of degree 12, about (p + ½·ln 2πp)/e.
struct Behaviour {
    method: Method,
    /// Step at tolerance 1e-8 (s).
    step: f64,
    /// The step grows with the tolerance to the power 1/`order`.
    order: f64,
    /// Greatest rate × step that remains stable.
    stable: f64,
    /// Cost of a step in evaluations, and what is added for every coordinate up
    /// to [`FULL`] (columns of the Jacobian) …
    cost: [f64; 2],
    /// … and for every digit of the tolerance.
    digit: f64,
}

/// Coordinates above which a Jacobian has no more columns that must be taken
/// one by one.
const FULL: f64 = 6.0;

/// Where accuracy limits the step of the explicit method, the implicit one must be
/// expected to need less than this share of its work: its behaviour is known from a
/// stiff system.
const SOFT: f64 = 0.4;

const BEHAVIOURS: [Behaviour; 5] = [
    Behaviour {
        method: Method::Taylor,
        step: 1.75,
        order: 40.0,
        stable: 5.0,
        cost: [3.0, 0.0],
        digit: 0.8,
    },
    Behaviour {
        method: Method::Dop853,
        step: 0.47,
        order: 8.0,
        stable: 6.1,
        cost: [25.0, 0.0],
        digit: 0.0,
    },
    Behaviour {
        method: Method::Dopri5,
        step: 0.064,
        order: 5.0,
        stable: 3.3,
        cost: [6.0, 0.0],
        digit: 0.0,
    },
    Behaviour {
        method: Method::Rodas5p,
        step: 0.083,
        order: 5.0,
        stable: f64::INFINITY,
        cost: [5.0, 0.8],
        digit: 0.0,
    },
    Behaviour {
        method: Method::Radau,
        step: 0.67,
        order: 8.0,
        stable: f64::INFINITY,
        cost: [8.0, 2.1],
        digit: 0.0,
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

    /// Work of the whole run in evaluations.
    fn work(&self, situation: &Situation) -> f64 {
        let [accurate, stable] = self.steps(situation);
        let columns = (situation.coordinates as f64).min(FULL);
        let digits = -situation.tolerance.log10();
        let cost = self.cost[0] + self.cost[1] * columns + self.digit * digits;
        cost * situation.duration / accurate.min(stable).min(situation.duration)
    }
}

/// The method that is expected to need the least work, and why, in a sentence.
///
/// One of the library's own or of `ode_solvers`; explicit unless the implicit
/// one is expected to need less.
pub fn choose(situation: &Situation) -> (Method, String) {
    // Something is to be seen at least once in the run, and a system without
    // springs has no rate of its own.
    let resolved = situation.resolved.max(TAU / situation.duration);
    let situation = &Situation {
        resolved,
        fastest: situation.fastest.max(resolved),
        ..*situation
    };
    let implicit = |behaviour: &Behaviour| behaviour.stable.is_infinite();
    let least = |wanted: bool| {
        let fit = BEHAVIOURS.iter().filter(|b| {
            implicit(b) == wanted
                && (situation.expands || b.method != Method::Taylor)
                && !(situation.kinks && b.method == Method::Radau)
        });
        fit.min_by(|a, b| a.work(situation).total_cmp(&b.work(situation)))
            .expect("the list has methods of both kinds")
    };
    let (explicit, implicit) = (least(false), least(true));
    let rate = situation.fastest / situation.resolved;
    let [accurate, stable] = explicit.steps(situation);
    let bar = if stable < accurate { 1.0 } else { SOFT };
    if implicit.work(situation) < bar * explicit.work(situation) {
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
    let series = match explicit.method {
        Method::Taylor => "power series, ",
        _ => "explicit, ",
    };
    let reason = format!(
        "{series}as the fastest rate, {:.2e} 1/s, is only {rate:.1} times what the motion shows; \
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
            expands: true,
            kinks: false,
            tolerance,
            coordinates: masses,
            duration: 0.5,
        })
    }

    #[test]
    fn a_stiff_chain_gets_the_implicit_method_and_a_short_one_power_series() {
        for tolerance in [1e-4, 1e-6, 1e-8] {
            let (method, why) = rocker(10, tolerance);
            assert_eq!(method, Method::Radau, "{why}");
            assert!(why.contains("times what the motion shows"));
        }
        for tolerance in [1e-6, 1e-8, 1e-10] {
            let (method, why) = rocker(1, tolerance);
            assert_eq!(method, Method::Taylor, "{why}");
            assert!(why.starts_with("power series"), "{why}");
        }
    }

    #[test]
    fn a_system_at_rest_without_springs_has_a_method_and_a_readable_reason() {
        let (method, why) = choose(&Situation {
            fastest: 0.0,
            resolved: 0.0,
            expands: true,
            kinks: false,
            tolerance: 1e-8,
            coordinates: 1,
            duration: 2.0,
        });
        assert_eq!(method, Method::Taylor);
        assert!(!why.contains("NaN") && !why.contains("inf"), "{why}");
    }

    #[test]
    fn what_has_no_series_gets_a_method_of_stages_by_its_tolerance() {
        let mut situation = Situation {
            fastest: 1e7,
            resolved: 100.0,
            expands: false,
            kinks: false,
            tolerance: 1e-5,
            coordinates: 4,
            duration: 1.0,
        };
        assert_eq!(choose(&situation).0, Method::Radau);
        situation.fastest = 100.0;
        situation.tolerance = 1e-2;
        assert_eq!(choose(&situation).0, Method::Dopri5);
        situation.tolerance = 1e-11;
        let (method, why) = choose(&situation);
        assert_eq!(method, Method::Dop853);
        situation.kinks = true;
        (situation.fastest, situation.tolerance) = (1e7, 1e-8);
        assert_eq!(choose(&situation).0, Method::Rodas5p);
        assert!(why.contains("the tolerance asks for steps"), "{why}");
    }

    #[test]
    fn no_method_that_a_build_may_lack_is_ever_chosen() {
        for behaviour in &BEHAVIOURS {
            let needs = matches!(
                behaviour.method,
                Method::Bdf | Method::TrBdf2 | Method::Esdirk34
            );
            assert!(!needs, "{}", behaviour.method);
        }
    }
}
