//! Exponential, sine and cosine of several numbers at once, by polynomials.

use super::{Arith, V, WIDTH};

/// Adding and taking away 3·2⁵¹ rounds to the nearest integer, whose low bits
/// are then those of the sum.
pub(crate) const ROUND: f64 = 6_755_399_441_055_744.0;

/// Greatest |θ| for which [`sin_cos`] is accurate to rounding: the first part
/// of π/2 has 33 bits, so k·π/2 is exact for k < 2²⁰.
pub(crate) const SIN_COS_LIMIT: f64 = 1.0e6;

const EXP: [f64; 14] = [
    1.0,
    1.0,
    1.0 / 2.0,
    1.0 / 6.0,
    1.0 / 24.0,
    1.0 / 120.0,
    1.0 / 720.0,
    1.0 / 5_040.0,
    1.0 / 40_320.0,
    1.0 / 362_880.0,
    1.0 / 3_628_800.0,
    1.0 / 39_916_800.0,
    1.0 / 479_001_600.0,
    1.0 / 6_227_020_800.0,
];

/// Below it e^x is that of it, 5·10⁻¹³¹: nothing beside anything, and far enough above
/// the least numbers of double precision that products with amplitudes and their squares
/// keep all their digits. (Numbers without them cost a hundred times the time.)
const LEAST: f64 = -300.0;

/// eˣ for x ≤ 709; below [`LEAST`] the result is that of [`LEAST`].
///
/// x = k·ln 2 + r, |r| ≤ 0.347, Taylor polynomial of degree 13 of e^r (error
/// below 10⁻¹⁷) in Estrin's order, scaled by 2ᵏ through the exponent's bits.
#[inline(always)]
pub(crate) fn exp<A: Arith>(x: V) -> V {
    let x = x.map(|a| if a > LEAST { a } else { LEAST });
    let shifted = x.fma::<A>(V::splat(std::f64::consts::LOG2_E), V::splat(ROUND));
    let k = shifted - V::splat(ROUND);
    let r = k.fma::<A>(V::splat(-6.931_471_803_691_238e-1), x);
    let r = k.fma::<A>(V::splat(-1.908_214_929_270_587_7e-10), r);
    let scale = shifted.map(|a| f64::from_bits((a.to_bits() << 52).wrapping_add(0x3ff0 << 48)));
    let pair = |i: usize| r.fma::<A>(V::splat(EXP[i + 1]), V::splat(EXP[i]));
    let r2 = r * r;
    let r4 = r2 * r2;
    let low = pair(2).fma::<A>(r2, pair(0));
    let middle = pair(6).fma::<A>(r2, pair(4));
    let high = pair(10).fma::<A>(r2, pair(8));
    let high = (pair(12) * r4).fma::<A>(V::splat(1.0), high);
    high.fma::<A>(r4, middle).fma::<A>(r4, low) * scale
}

/// (sin θ, cos θ) for |θ| ≤ [`SIN_COS_LIMIT`].
///
/// θ = k·π/2 + r with π/2 in three parts; the polynomials on |r| ≤ π/4 are the
/// minimax ones of fdlibm (Sun Microsystems 1993: `k_sin.c`, `k_cos.c`), error
/// below 2⁻⁵⁷.
#[inline(always)]
pub(crate) fn sin_cos<A: Arith>(x: V) -> (V, V) {
    let shifted = x.fma::<A>(V::splat(std::f64::consts::FRAC_2_PI), V::splat(ROUND));
    let k = shifted - V::splat(ROUND);
    let r = k.fma::<A>(V::splat(-1.570_796_326_734_125_6), x);
    let r = k.fma::<A>(V::splat(-6.077_100_506_303_966e-11), r);
    let r = k.fma::<A>(V::splat(-2.022_266_248_795_950_6e-21), r);
    let z = r * r;
    let z2 = z * z;
    let two = |a: f64, b: f64| z.fma::<A>(V::splat(b), V::splat(a));
    let s = two(2.755_731_370_707_006_8e-6, -2.505_076_025_340_686_3e-8);
    let s = z2.fma::<A>(V::splat(1.589_690_995_211_55e-10), s);
    let s = s.fma::<A>(z2, two(8.333_333_333_322_49e-3, -1.984_126_982_985_795e-4));
    let s = s.fma::<A>(z, V::splat(-1.666_666_666_666_663_2e-1));
    let sin = (z * r).fma::<A>(s, r);
    let c = two(-2.755_731_435_139_066_3e-7, 2.087_572_321_298_175e-9);
    let c = z2.fma::<A>(V::splat(-1.135_964_755_778_819_5e-11), c);
    let c = c.fma::<A>(z2, two(-1.388_888_888_887_411e-3, 2.480_158_728_947_673e-5));
    let c = c.fma::<A>(z, V::splat(4.166_666_666_666_66e-2));
    let cos = z2.fma::<A>(c, z.fma::<A>(V::splat(-0.5), V::splat(1.0)));
    let mut out = (V::ZERO, V::ZERO);
    for i in 0..WIDTH {
        let bits = shifted.0[i].to_bits();
        let odd = bits & 1 == 1;
        let (a, b) = if odd {
            (cos.0[i], sin.0[i])
        } else {
            (sin.0[i], cos.0[i])
        };
        // Quadrants 2, 3 turn the sine round, 1, 2 the cosine.
        let sign_sin = (bits & 2) << 62;
        let sign_cos = (bits.wrapping_add(1) & 2) << 62;
        out.0.0[i] = f64::from_bits(a.to_bits() ^ sign_sin);
        out.1.0[i] = f64::from_bits(b.to_bits() ^ sign_cos);
    }
    out
}

/// [`sin_cos`] of one number.
#[inline(always)]
pub(crate) fn sin_cos_one<A: Arith>(x: f64) -> (f64, f64) {
    let (s, c) = sin_cos::<A>(V::splat(x));
    (s.0[0], c.0[0])
}

/// cos x − 1 and sin x − x without cancellation, given sin x and cos x.
///
/// Free flight under a sine needs them against numbers 10⁴ times smaller than
/// the sine's amplitude. sin x − x is a series below 1.8 (eleven terms: error
/// 10⁻¹⁸), a difference above.
#[inline(always)]
pub(crate) fn cosine_and_sine_remainders<A: Arith>(x: V, sin: V, cos: V) -> (V, V) {
    let square = -(sin * sin) / (V::splat(1.0) + cos.map(f64::abs));
    let (series, plain) = (sin_minus::<A>(x), sin - x);
    let (mut cos_less, mut sin_less) = (cos - V::splat(1.0), plain);
    for i in 0..WIDTH {
        if cos.0[i] > 0.0 {
            cos_less.0[i] = square.0[i];
        }
        if x.0[i].abs() < 1.8 {
            sin_less.0[i] = series.0[i];
        }
    }
    (cos_less, sin_less)
}

/// [`cosine_and_sine_remainders`] of one number.
#[inline(always)]
pub(crate) fn reduced_one<A: Arith>(x: f64, sin: f64, cos: f64) -> (f64, f64) {
    let f = V::splat;
    let (c, l) = cosine_and_sine_remainders::<A>(f(x), f(sin), f(cos));
    (c.0[0], l.0[0])
}

/// Coefficients of (x − sin x)/x³ in powers of x².
const SIN_MINUS: [f64; 11] = [
    0.16666666666666666,
    -0.008333333333333333,
    0.0001984126984126984,
    -2.7557319223985893e-06,
    2.505210838544172e-08,
    -1.6059043836821613e-10,
    7.647163731819816e-13,
    -2.8114572543455206e-15,
    8.22063524662433e-18,
    -1.9572941063391263e-20,
    3.868170170630684e-23,
];

/// sin x − x by its series, in Estrin's order.
#[inline(always)]
fn sin_minus<A: Arith>(x: V) -> V {
    let z = x * x;
    let (z2, cube) = (z * z, -(x * z));
    let z4 = z2 * z2;
    let pair = |i: usize| z.fma::<A>(V::splat(SIN_MINUS[i + 1]), V::splat(SIN_MINUS[i]));
    let low = pair(2).fma::<A>(z2, pair(0));
    let middle = pair(6).fma::<A>(z2, pair(4));
    let high = z2.fma::<A>(V::splat(SIN_MINUS[10]), pair(8));
    let sum = high.fma::<A>(z4, middle).fma::<A>(z4, low);
    cube * sum
}

#[cfg(test)]
mod tests {
    use super::super::{FusedMultiplyAdd, Plain};
    use super::*;

    fn arguments() -> impl Iterator<Item = f64> {
        (0..4000).map(|i| {
            let u = (i as f64 * 0.618_033_988_749_894_9).fract();
            10f64.powf(-8.0 + 13.9 * u) * if i % 2 == 0 { 1.0 } else { -1.0 }
        })
    }

    fn check<A: Arith>() {
        for x in arguments() {
            let (s, c) = sin_cos::<A>(V::splat(x));
            let (ws, wc) = x.sin_cos();
            assert!((s.0[1] - ws).abs() < 2.5e-16, "sin {x}: {} {ws}", s.0[1]);
            assert!((c.0[2] - wc).abs() < 2.5e-16, "cos {x}: {} {wc}", c.0[2]);
            let y = -x.abs() % 300.0;
            let e = exp::<A>(V::splat(y)).0[3];
            assert!((e - y.exp()).abs() <= 1e-15 * y.exp(), "exp {y}: {e}");
        }
        assert_eq!(exp::<A>(V::splat(0.0)).0[0], 1.0);
        assert!(exp::<A>(V::splat(-1e300)).0[0] < 1e-130);
    }

    #[test]
    fn exponential_sine_and_cosine_are_good_to_rounding() {
        check::<Plain>();
        check::<FusedMultiplyAdd>();
    }

    #[test]
    fn reduced_functions_keep_their_digits_near_zero() {
        for x in [1e-9, 1e-4, 0.1, 1.0, 1.7] {
            let (c, s) = reduced_one::<Plain>(x, x.sin(), x.cos());
            let series = |first: f64, mut n: f64| {
                let (mut term, mut sum) = (first, first);
                for _ in 0..20 {
                    term *= -x * x / ((n + 1.0) * (n + 2.0));
                    sum += term;
                    n += 2.0;
                }
                sum
            };
            approx::assert_relative_eq!(c, series(-x * x / 2.0, 2.0), max_relative = 4e-16);
            approx::assert_relative_eq!(s, series(-x * x * x / 6.0, 3.0), max_relative = 4e-16);
        }
        let (c, s) = reduced_one::<Plain>(2.5, 2.5f64.sin(), 2.5f64.cos());
        assert_eq!((c, s), (2.5f64.cos() - 1.0, 2.5f64.sin() - 2.5));
    }
}
