//! Coulomb's friction in the pairs as a function of the reactions.
//!
//! All friction of a linkage is a few scalars τ, one of a pin and two of a
//! guide, and acts on the links along fixed directions:
//!
//! * pin: a couple on link j, τ = −s·μ·(d/2)·√(X² + Y²);
//! * guide, along it: T⁽¹⁾ + T⁽²⁾ = −s·μ·(|N⁽¹⁾| + |N⁽²⁾|) at the block's
//!   reference point;
//! * guide, couple on the block: c·(δ₁T⁽¹⁾ + δ₂T⁽²⁾) = −s·μ·c·(N⁽¹⁾ + N⁽²⁾),
//!   since δ·|N| = N: which corner carries makes no jump.
//!
//! On link i everything is opposite. With the reactions F = F₀ − K·τ, which
//! the factorised equations give, what is sought is τ = f(F₀ − K·τ): as many
//! equations as there are scalars, not 3 a link.

/// Friction of one pair as it follows from its reactions; couples are divided by the
/// length scale of the linkage, so that every τ is a force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Term {
    /// Place of the pair's first reaction among the unknowns.
    pub(super) unknown: usize,
    /// Column of its first τ.
    pub(super) column: usize,
    /// Pin or guide.
    pub(super) law: Law,
    /// Signs of the normal forces on both corners of a block, where they are given;
    /// of a pin a direction near that of its reaction, which changes nothing. `None`:
    /// as they turn out.
    pub(super) pressed: Option<[f64; 2]>,
}

/// The factors of a pair's friction, each with the sign of the sliding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Law {
    /// s·μ·(d/2)/ℓ.
    Pin(f64),
    /// s·μ and s·μ·c/ℓ.
    Guide([f64; 2]),
    /// The couple on the block of a guide that friction holds with the force T along it, which
    /// both corners bear in the proportion of their normal forces: c/ℓ·T·(N⁽¹⁾ + N⁽²⁾) over
    /// |N⁽¹⁾| + |N⁽²⁾|.
    HeldGuide {
        /// c/ℓ.
        couple: f64,
        /// Place of T among the unknowns.
        holding: usize,
    },
}

impl Law {
    /// The law with the sign of the sliding.
    pub(super) fn sliding(self, sense: f64) -> Self {
        match self {
            Self::Pin(factor) => Self::Pin(sense * factor),
            Self::Guide(factors) => Self::Guide(factors.map(|factor| sense * factor)),
            held => held,
        }
    }

    /// The greatest friction along the sliding that two reactions allow.
    pub(super) fn greatest_friction(self, [a, b]: [f64; 2]) -> f64 {
        match self {
            Self::Pin(factor) => factor.abs() * (a * a + b * b).sqrt(),
            Self::Guide([along, _]) => along.abs() * (a.abs() + b.abs()),
            Self::HeldGuide { .. } => 0.0,
        }
    }
}

impl Term {
    /// The τ of this pair at the reactions `f`.
    #[inline]
    pub(super) fn friction(&self, f: &[f64], tau: &mut [f64]) {
        let [a, b] = [f[self.unknown], f[self.unknown + 1]];
        match self.law {
            Law::Pin(factor) => tau[self.column] = -factor * (a * a + b * b).sqrt(),
            Law::Guide([along, couple]) => {
                let pressed = match self.pressed {
                    Some([p, q]) => p * a + q * b,
                    None => a.abs() + b.abs(),
                };
                tau[self.column] = -along * pressed;
                tau[self.column + 1] = -couple * (a + b);
            }
            Law::HeldGuide { couple, holding } => {
                tau[self.column] = couple * f[holding] * ratio([a, b]);
            }
        }
    }

    /// Derivatives of this pair's τ by its two reactions: rows of one pin or
    /// of a guide (the second row of a pin is zero).
    #[inline]
    pub(super) fn slope(&self, f: &[f64]) -> [[f64; 2]; 2] {
        let [a, b] = [f[self.unknown], f[self.unknown + 1]];
        match self.law {
            Law::Pin(factor) => {
                let size = (a * a + b * b).sqrt();
                if size > 0.0 {
                    [[-factor * a / size, -factor * b / size], [0.0; 2]]
                } else {
                    [[0.0; 2]; 2]
                }
            }
            Law::Guide([along, couple]) => {
                let [p, q] = self.pressed.unwrap_or([sign(a), sign(b)]);
                [[-along * p, -along * q], [-couple, -couple]]
            }
            Law::HeldGuide { couple, holding } => {
                let size = a.abs() + b.abs();
                if size == 0.0 {
                    return [[0.0; 2]; 2];
                }
                let part = couple * f[holding] / size;
                let slope = [a, b].map(|n| part * (1.0 - ratio([a, b]) * sign(n)));
                [slope, [0.0; 2]]
            }
        }
    }

    /// The unknown besides its reactions that its τ follows from, and its derivative by it.
    #[inline]
    pub(super) fn by_holding(&self, f: &[f64]) -> Option<(usize, f64)> {
        match self.law {
            Law::HeldGuide { couple, holding } => {
                let normal = [f[self.unknown], f[self.unknown + 1]];
                Some((holding, couple * ratio(normal)))
            }
            _ => None,
        }
    }

    /// Number of its τ.
    pub(super) fn width(&self) -> usize {
        match self.law {
            Law::Pin(_) | Law::HeldGuide { .. } => 1,
            Law::Guide(_) => 2,
        }
    }
}

/// (a + b)/(|a| + |b|); 0 where nothing presses.
fn ratio([a, b]: [f64; 2]) -> f64 {
    match a.abs() + b.abs() {
        0.0 => 0.0,
        size => (a + b) / size,
    }
}

/// −1, 0 or 1.
pub(super) fn sign(x: f64) -> f64 {
    if x == 0.0 { 0.0 } else { x.signum() }
}

/// Sign of the sliding of a pair just after the position, in the direction of
/// motion (sgn⁺).
///
/// `rate`, `slope`, `curvature`: first three derivatives of the pair's relative
/// coordinate by the input coordinate; `scales` the size below which each of
/// them is rounding; `direction` the sign of the input speed.
#[inline]
pub(super) fn sliding_sign(rates: [f64; 3], scales: [f64; 3], direction: f64) -> f64 {
    let [rate, slope, curvature] = rates;
    if rate.abs() > scales[0] {
        rate.signum() * direction
    } else if slope.abs() > scales[1] {
        // x(q + dq)·q̇ = x′·dq·q̇, and dq has the sign of q̇.
        slope.signum()
    } else if curvature.abs() > scales[2] {
        curvature.signum() * direction
    } else {
        0.0
    }
}
