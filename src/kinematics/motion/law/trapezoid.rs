//! The modified trapezoid of general form: run-up from rest to uniform motion.

use crate::math::fourier::Terms;
use crate::math::jet::Jet;
use std::f64::consts::{FRAC_2_PI, PI};

/// A run-up law θ(τ), 0 ≤ τ ≤ 1, from rest to uniform motion: θ″ rises as a
/// quarter sine over the share `s1`, stays, and falls as a quarter cosine over
/// the share `s2`.
///
/// θ(0) = θ′(0) = 0, θ(1) = 1, θ′ is greatest at τ = 1, θ″ ≥ 0. With s1 = 0 or
/// s2 = 0 the acceleration jumps at that end (soft shock). Source: I. Vulfson,
/// *Dynamics of Cyclic Machines*, section 1.2, (1.8)–(1.10).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trapezoid {
    s1: f64,
    s2: f64,
    /// 2·s1/π: the rise of θ″ is sin(τ/p).
    p: f64,
    /// 2·s2/π: the fall of θ″ is cos(y/q), y counted from its start.
    q: f64,
    /// ∫g of the acceleration's shape g: its filling coefficient σ.
    filling: f64,
    /// Greatest θ″.
    peak: f64,
}

/// One of the three parts of the acceleration diagram.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TrapezoidPart {
    /// Quarter sine, 0 ≤ τ < s1.
    Rise,
    /// Constant, s1 ≤ τ ≤ 1 − s2.
    Flat,
    /// Quarter cosine, 1 − s2 < τ ≤ 1.
    Fall,
}

/// Rounding allowed in the shares.
const SLACK: f64 = 1e-12;

impl Trapezoid {
    /// The law with the shares `s1` of the rise and `s2` of the fall.
    ///
    /// # Errors
    /// Shares that are not finite, negative, or more than 1 together (beyond
    /// rounding of 1e-12), in words.
    pub fn new(s1: f64, s2: f64) -> Result<Self, String> {
        let sound = s1 >= -SLACK && s2 >= -SLACK && s1 + s2 <= 1.0 + SLACK;
        if !sound {
            return Err(format!(
                "the shares s1 = {s1} and s2 = {s2} do not describe a trapezoid: \
                 both must be at least 0 and together at most 1"
            ));
        }
        let s1 = s1.clamp(0.0, 1.0);
        let s2 = s2.clamp(0.0, 1.0 - s1);
        let (p, q) = (s1 * FRAC_2_PI, s2 * FRAC_2_PI);
        let filling = 1.0 - (1.0 - FRAC_2_PI) * (s1 + s2);
        let moment = p * p + 0.5 * ((1.0 - s2) * (1.0 - s2) - s1 * s1) + q - q * q;
        Ok(Self {
            s1,
            s2,
            p,
            q,
            filling,
            peak: 1.0 / (filling - moment),
        })
    }

    /// Shares (s1, s2) of rise and fall.
    pub fn shares(&self) -> (f64, f64) {
        (self.s1, self.s2)
    }

    /// Filling coefficient σ of the acceleration diagram.
    pub fn filling(&self) -> f64 {
        self.filling
    }

    /// Centre of gravity τ* of the acceleration diagram.
    pub fn centre(&self) -> f64 {
        1.0 - 1.0 / self.greatest_speed()
    }

    /// θ′(1), the greatest speed.
    pub fn greatest_speed(&self) -> f64 {
        self.peak * self.filling
    }

    /// Greatest θ″.
    pub fn greatest_acceleration(&self) -> f64 {
        self.peak
    }

    /// Greatest θ′θ″ and the τ at which it is reached.
    ///
    /// On the fall θ′θ″/a² = cos u·(e + q·sin u), whose derivative vanishes
    /// where 2q·sin²u + e·sin u − q = 0.
    pub fn greatest_product(&self) -> (f64, f64) {
        let square = self.peak * self.peak;
        if self.s2 == 0.0 {
            return (square * self.filling, 1.0);
        }
        let (e, q) = (self.speed_before_fall(), self.q);
        // The root in a form that does not cancel for a short fall (q ≪ e).
        let sin = 2.0 * q / (e + (e * e + 8.0 * q * q).sqrt());
        let u = sin.asin();
        let product = square * u.cos() * (e + q * sin);
        (product, 1.0 - self.s2 + q * u)
    }

    /// The parts that are there, with the τ at which each begins.
    pub fn parts(&self) -> Vec<(TrapezoidPart, f64)> {
        let all = [
            (TrapezoidPart::Rise, 0.0, self.s1),
            (TrapezoidPart::Flat, self.s1, 1.0 - self.s2),
            (TrapezoidPart::Fall, 1.0 - self.s2, 1.0),
        ];
        let there = all.into_iter().filter(|(_, from, to)| to - from > SLACK);
        there.map(|(part, from, _)| (part, from)).collect()
    }

    /// θ and its derivatives at `tau` by the formula of `part`.
    pub fn jet(&self, part: TrapezoidPart, tau: f64) -> Jet {
        let (s1, p, q) = (self.s1, self.p, self.q);
        let shape = match part {
            TrapezoidPart::Rise => {
                let x = tau / p;
                let (sin, cos) = x.sin_cos();
                Jet {
                    value: p * p * sine_deficit(x),
                    first: p * versine(x),
                    second: sin,
                    third: cos / p,
                }
            }
            TrapezoidPart::Flat => self.flat(tau - s1),
            TrapezoidPart::Fall => {
                let y = tau - 1.0 + self.s2;
                let (sin, cos) = (y / q).sin_cos();
                let before = self.flat(1.0 - self.s2 - s1);
                Jet {
                    value: before.value + before.first * y + q * q * versine(y / q),
                    first: before.first + q * sin,
                    second: cos,
                    third: -sin / q,
                }
            }
        };
        shape.scaled(self.peak)
    }

    /// θ in closed form by the formula of `part`, on the interval about `place[0]` of half the
    /// length `place[1]`.
    pub(super) fn terms(&self, part: TrapezoidPart, place: [f64; 2]) -> Terms {
        let (s1, s2, p, q) = (self.s1, self.s2, self.p, self.q);
        // a + b·(τ − from) in powers of τ.
        let line = |from: f64, a: f64, b: f64| [a - b * from, b];
        let shape = match part {
            TrapezoidPart::Rise => {
                Terms::of_powers(&[0.0, p], place).plus_sine([-p * p, 1.0 / p, 0.0], place)
            }
            TrapezoidPart::Flat => {
                let [a, b] = line(s1, p * (s1 - p), p);
                Terms::of_powers(&[a + 0.5 * s1 * s1, b - s1, 0.5], place)
            }
            TrapezoidPart::Fall => {
                let (from, before) = (1.0 - s2, self.flat(1.0 - s2 - s1));
                let powers = line(from, before.value + q * q, before.first);
                // 1 − cos x, and cos x = sin(x + π/2).
                let cosine = [-q * q, 1.0 / q, 0.5 * PI - from / q];
                Terms::of_powers(&powers, place).plus_sine(cosine, place)
            }
        };
        shape.scaled(0.0, self.peak)
    }

    /// The shape on its flat part, `x` counted from its start.
    fn flat(&self, x: f64) -> Jet {
        let p = self.p;
        Jet {
            value: p * (self.s1 - p) + x * (p + 0.5 * x),
            first: p + x,
            second: 1.0,
            third: 0.0,
        }
    }

    /// θ′/a where the fall begins.
    fn speed_before_fall(&self) -> f64 {
        self.p + 1.0 - self.s1 - self.s2
    }
}

/// 1 − cos x without cancellation.
fn versine(x: f64) -> f64 {
    let half = (0.5 * x).sin();
    2.0 * half * half
}

/// x − sin x without cancellation: x³/6·(1 − x²/20·(1 − x²/42·(…))).
fn sine_deficit(x: f64) -> f64 {
    if x.abs() > PI / 3.0 {
        return x - x.sin();
    }
    let square = x * x;
    let mut sum = 1.0;
    for k in (2..=10).rev() {
        let n = f64::from(2 * k);
        sum = 1.0 - square / (n * (n + 1.0)) * sum;
    }
    x * square / 6.0 * sum
}

#[cfg(test)]
mod tests {
    use super::{Trapezoid, sine_deficit};
    use std::f64::consts::PI;

    #[test]
    fn named_points_have_the_published_constants() {
        let root = 3f64.sqrt();
        for (s1, s2, speed, acceleration, product, at) in [
            (0.0, 0.0, 2.0, 2.0, 4.0, 1.0),
            (0.5, 0.5, 2.0, PI, 0.75 * root * PI, 2.0 / 3.0),
            (0.0, 1.0, PI / 2.0, PI * PI / 4.0, PI.powi(3) / 16.0, 0.5),
        ] {
            let law = Trapezoid::new(s1, s2).unwrap();
            let (found, where_) = law.greatest_product();
            approx::assert_relative_eq!(law.greatest_speed(), speed, max_relative = 1e-14);
            approx::assert_relative_eq!(
                law.greatest_acceleration(),
                acceleration,
                max_relative = 1e-14
            );
            approx::assert_relative_eq!(found, product, max_relative = 1e-14);
            approx::assert_relative_eq!(where_, at, max_relative = 1e-14);
        }
    }

    #[test]
    fn shares_outside_the_triangle_are_refused() {
        for (s1, s2) in [(-1e-3, 0.5), (0.5, -0.1), (0.6, 0.5), (f64::NAN, 0.0)] {
            assert!(Trapezoid::new(s1, s2).unwrap_err().contains("at most 1"));
        }
        let rounded = Trapezoid::new(0.7, 0.3 + 1e-13).unwrap();
        assert!(rounded.shares().0 + rounded.shares().1 <= 1.0);
    }

    #[test]
    fn a_short_fall_tends_to_no_fall() {
        let (product, at) = Trapezoid::new(0.2, 1e-9).unwrap().greatest_product();
        let (limit, _) = Trapezoid::new(0.2, 0.0).unwrap().greatest_product();
        approx::assert_relative_eq!(product, limit, max_relative = 1e-8);
        assert!(at < 1.0 && at > 1.0 - 1e-8);
    }

    #[test]
    fn the_sine_deficit_is_exact_for_small_arguments_and_joins() {
        let x: f64 = 1e-3;
        let exact = x.powi(3) / 6.0 - x.powi(5) / 120.0 + x.powi(7) / 5040.0;
        approx::assert_relative_eq!(sine_deficit(x), exact, max_relative = 1e-15);
        for x in [1.0, 1.04, 1.05] {
            let plain = x - f64::sin(x);
            approx::assert_relative_eq!(sine_deficit(x), plain, max_relative = 1e-14);
        }
    }
}
