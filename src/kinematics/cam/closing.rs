//! The force that keeps a follower on its cam, at constant speed of the cam,
//! follower and cam being rigid and without friction.
//!
//! Along the displacement in which the pair opens, the contact must give
//!
//! P(φ, ω) = a(φ)·ω² + b(φ)·ω + f(φ) + preload + rate·x(φ)
//!
//! with the inertia a = J·U″ of everything that moves with the follower,
//! damping b, other loads f, and a closing spring stretched by x(φ) in the
//! direction of opening. A spring on an object behind the follower acts with the
//! share r(φ) of its force: r·(preload + rate·x) with its own displacement x.
//! Contact is kept where P ≥ 0 at every φ; what P is above zero is the margin.

use super::motion::intervals_per_piece;
use super::search::{At, evenly_spaced, refined};
use crate::math::optimise::golden;
use crate::math::roots::root;
use serde::Serialize;

/// Demand on the contact at an angle of the cam: the force that it must give, along the
/// displacement of opening (N or N·m).
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Demand {
    /// a: by ω².
    pub by_square: f64,
    /// b: by ω.
    pub by_speed: f64,
    /// f: of all loads but the closing springs.
    pub fixed: f64,
    /// x: displacement of the closing spring in the direction in which it is stretched by
    /// opening (m or rad).
    pub stretch: f64,
    /// r > 0: force of the contact over that of the closing spring; 1 of a spring on the
    /// follower itself.
    pub lever: f64,
}

impl Default for Demand {
    fn default() -> Self {
        Self {
            by_square: 0.0,
            by_speed: 0.0,
            fixed: 0.0,
            stretch: 0.0,
            lever: 1.0,
        }
    }
}

/// A closing spring: it presses with preload + rate·x.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct ClosingSpring {
    /// N/m or N·m/rad.
    pub rate: f64,
    /// At x = 0 (N or N·m).
    pub preload: f64,
}

/// The speed at which contact is lost.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum LetsGo {
    /// At this speed of the cam (rad/s), here.
    At(At),
    /// The pair is open even at rest; the force lacking there.
    AtRest(At),
    /// At no speed.
    Never,
}

/// Why no spring rate will do.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct NoRate {
    /// With the best rate this force is still lacking, here.
    pub lacking: At,
    /// The best rate.
    pub rate: f64,
}

/// Spring rates that keep contact.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Rates {
    /// Least rate, ≥ 0.
    pub from: f64,
    /// Greatest rate; null: any greater one.
    pub to: Option<f64>,
}

/// The question of closing: the demand over the pieces of a turn.
pub struct ClosureProblem<'a> {
    demand: &'a dyn Fn(usize, f64) -> Demand,
    /// The demand at places of every piece, both ends among them.
    samples: Vec<Vec<(f64, Demand)>>,
}

impl<'a> ClosureProblem<'a> {
    /// The demand at φ in a piece, over stretches (rad) on which it is smooth.
    pub fn new(pieces: &[[f64; 2]], demand: &'a dyn Fn(usize, f64) -> Demand) -> Self {
        let count = intervals_per_piece(pieces.len());
        let sampled = |(index, &ends): (usize, &[f64; 2])| {
            let places = evenly_spaced(ends, count);
            places.map(|phi| (phi, demand(index, phi))).collect()
        };
        Self {
            demand,
            samples: pieces.iter().enumerate().map(sampled).collect(),
        }
    }

    /// Greatest value of a function of the demand, and the first place.
    fn greatest(&self, f: &dyn Fn(&Demand) -> f64) -> At {
        let values = |samples: &Vec<(f64, Demand)>| {
            let values = samples.iter().map(|(phi, demand)| (*phi, f(demand)));
            values.collect::<Vec<(f64, f64)>>()
        };
        let samples: Vec<Vec<(f64, f64)>> = self.samples.iter().map(values).collect();
        refined(&samples, &|piece, phi| f(&(self.demand)(piece, phi)))
    }

    /// Least force P over the turn: the margin against lift-off.
    pub fn least_force(&self, spring: ClosingSpring, speed: f64) -> At {
        let found = self.greatest(&|demand| -demand.force(spring, speed));
        At {
            value: 0.0 - found.value,
            ..found
        }
    }

    /// Greatest force P over the turn.
    pub fn most(&self, spring: ClosingSpring, speed: f64) -> At {
        self.greatest(&|demand| demand.force(spring, speed))
    }

    /// The force that would have to pull without the spring: max −P.
    pub fn opening(&self, speed: f64) -> At {
        let found = self.greatest(&|demand| -demand.force(ClosingSpring::default(), speed));
        At {
            value: found.value.max(0.0),
            ..found
        }
    }

    /// The speed (of the sign of `sense`) at which a spring lets go: with x = 1/ω,
    /// 1/ω* is the greatest over the turn of the positive roots of
    /// (f + preload + rate·x)·x² + b·x + a = 0. Without damping
    /// ω*² = min (f + preload + rate·x)/(−a) over all φ with a < 0.
    pub fn separation_speed(&self, spring: ClosingSpring, sense: f64) -> LetsGo {
        let rest = self.least_force(spring, 0.0);
        if rest.value < 0.0 {
            return LetsGo::AtRest(At {
                value: -rest.value,
                ..rest
            });
        }
        let found = self.greatest(&|demand| {
            let still = demand.force(spring, 0.0).max(0.0);
            inverse_speed(demand.by_square, sense * demand.by_speed, still)
        });
        match found.value > 0.0 {
            true => LetsGo::At(At {
                value: match found.value >= AT_ONCE {
                    true => 0.0,
                    false => 1.0 / found.value,
                },
                ..found
            }),
            false => LetsGo::Never,
        }
    }

    /// The least preload that with this rate leaves at least `reserve` in
    /// contact at a speed; negative where the spring might even pull.
    pub fn preload_for(&self, rate: f64, speed: f64, reserve: f64) -> At {
        let spring = ClosingSpring { rate, preload: 0.0 };
        self.greatest(&|demand| (reserve - demand.force(spring, speed)) / demand.lever)
    }

    /// The rates that with this preload leave at least `reserve` in contact.
    ///
    /// What is lacking, max (reserve − P), is the greatest of functions linear in
    /// the rate: convex, so that the rates that do form one interval.
    ///
    /// # Errors
    /// No rate does.
    pub fn rates_for(&self, preload: f64, speed: f64, reserve: f64) -> Result<Rates, NoRate> {
        let lacking = |rate: f64| {
            let spring = ClosingSpring { rate, preload };
            self.greatest(&|demand| reserve - demand.force(spring, speed))
        };
        let none = lacking(0.0);
        let stretch = self.greatest(&|demand| (demand.lever * demand.stretch).abs());
        let (stretch, lever) = (stretch.value, self.greatest(&|demand| demand.lever).value);
        let force = self.greatest(&|demand| demand.force(ClosingSpring::default(), speed).abs());
        let scale =
            (force.value + lever * preload.abs() + reserve.abs()) / stretch.max(f64::MIN_POSITIVE);
        if !(scale.is_finite() && scale > 0.0) {
            return match none.value <= 0.0 {
                true => Ok(Rates {
                    from: 0.0,
                    to: None,
                }),
                false => Err(NoRate {
                    lacking: none,
                    rate: 0.0,
                }),
            };
        }
        let best = place_of_lowest(&|rate| lacking(rate).value, scale);
        let at_best = lacking(best);
        let slack = 1e-12 * scale * stretch;
        if at_best.value > slack {
            return Err(NoRate {
                lacking: at_best,
                rate: best,
            });
        }
        let zero = |low: f64, high: f64| root(&|rate| lacking(rate).value, low, high);
        let from = match none.value <= 0.0 {
            true => 0.0,
            false => zero(0.0, best),
        };
        let far = FAR * scale;
        let to = (lacking(far).value > slack).then(|| zero(best, far));
        Ok(Rates { from, to })
    }
}

/// 1/ω of what lets go at any speed.
const AT_ONCE: f64 = 1e300;

/// Rates beyond this multiple of (forces by stretch) are called any rate.
const FAR: f64 = 1e6;

/// Where a convex function over 0 … [`FAR`]·`scale` is least; of a level bottom
/// some place of it.
fn place_of_lowest(f: &dyn Fn(f64) -> f64, scale: f64) -> f64 {
    // Over ln(1 + rate/scale): unimodal still, and all sizes are seen.
    let place = |x: f64| scale * x.exp_m1();
    place(golden(&mut |x| -f(place(x)), [0.0, FAR.ln_1p()], 90).at)
}

impl Demand {
    /// P at a speed with a spring.
    pub fn force(&self, spring: ClosingSpring, speed: f64) -> f64 {
        (self.by_square * speed + self.by_speed) * speed
            + self.fixed
            + self.lever * (spring.preload + spring.rate * self.stretch)
    }
}

/// Greatest x = 1/ω > 0 with s·x² + b·x + a = 0, beyond which a + bω-terms no
/// longer open the pair; 0 without one.
fn inverse_speed(a: f64, b: f64, still: f64) -> f64 {
    if still == 0.0 {
        // No force at rest: any speed opens where the first term does.
        let opens = b < 0.0 || (b == 0.0 && a < 0.0);
        return match (opens, b > 0.0 && a < 0.0) {
            (true, _) => AT_ONCE,
            (false, true) => -a / b,
            (false, false) => 0.0,
        };
    }
    let square = b * b - 4.0 * still * a;
    if square < 0.0 {
        return 0.0;
    }
    // The greater root; without differences of like numbers.
    let root = square.sqrt();
    let x = match b <= 0.0 {
        true => (root - b) / (2.0 * still),
        false => -2.0 * a / (b + root),
    };
    x.max(0.0)
}
