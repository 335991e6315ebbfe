//! Distributions: the normal one, the one of χ², the beta one, and what a count of successes says
//! of a share.

use super::roots::bracketed;

/// Distribution function of the standard normal distribution.
pub(crate) fn normal_share_below(x: f64) -> f64 {
    0.5 * libm::erfc(-x / std::f64::consts::SQRT_2)
}

/// Quantile of the standard normal distribution at a share in (0, 1), to some 10⁻¹⁵: algorithm
/// AS 241 (M. J. Wichura, Applied Statistics 37, 1988).
pub(crate) fn normal_quantile(share: f64) -> f64 {
    let q = share - 0.5;
    if q.abs() <= 0.425 {
        let r = 0.180_625 - q * q;
        return q * ratio(&CENTRE, r);
    }
    let r = (-share.min(1.0 - share).ln()).sqrt();
    let tail = match r <= 5.0 {
        true => ratio(&TAIL, r - 1.6),
        false => ratio(&FAR_TAIL, r - 5.0),
    };
    tail.copysign(q)
}

/// Coefficients of numerator and denominator, of rising powers.
type Ratio = [[f64; 8]; 2];

#[rustfmt::skip]
const CENTRE: Ratio = [
    [3.387_132_872_796_366_5, 133.141_667_891_784_38, 1_971.590_950_306_551_3, 13_731.693_765_509_46, 45_921.953_931_549_87, 67_265.770_927_008_7, 33_430.575_583_588_13, 2_509.080_928_730_122_7],
    [1.0, 42.313_330_701_600_91, 687.187_007_492_057_9, 5_394.196_021_424_751, 21_213.794_301_586_597, 39_307.895_800_092_71, 28_729.085_735_721_943, 5_226.495_278_852_854],
];
#[rustfmt::skip]
const TAIL: Ratio = [
    [1.423_437_110_749_683_5, 4.630_337_846_156_546, 5.769_497_221_460_691, 3.647_848_324_763_204_5, 1.270_458_252_452_368_4, 0.241_780_725_177_450_6, 0.022_723_844_989_269_184, 7.745_450_142_783_414e-4],
    [1.0, 2.053_191_626_637_759, 1.676_384_830_183_803_8, 0.689_767_334_985_1, 0.148_103_976_427_480_08, 0.015_198_666_563_616_457, 5.475_938_084_995_345e-4, 1.050_750_071_644_416_9e-9],
];
#[rustfmt::skip]
const FAR_TAIL: Ratio = [
    [6.657_904_643_501_103, 5.463_784_911_164_114, 1.784_826_539_917_291_3, 0.296_560_571_828_504_87, 0.026_532_189_526_576_124, 0.001_242_660_947_388_078_4, 2.711_555_568_743_487_6e-5, 2.010_334_399_292_288_1e-7],
    [1.0, 0.599_832_206_555_888, 0.136_929_880_922_735_8, 0.014_875_361_290_850_615, 7.868_691_311_456_133e-4, 1.846_318_317_510_054_8e-5, 1.421_511_758_316_446e-7, 2.044_263_103_389_939_8e-15],
];

fn ratio(coefficients: &Ratio, x: f64) -> f64 {
    let [above, below] = coefficients
        .each_ref()
        .map(|own| own.iter().rev().fold(0.0, |sum, one| sum * x + one));
    above / below
}

/// Probability that χ² of some degrees of freedom exceeds a value: the incomplete gamma function
/// Q(ν/2, χ²/2), by its series (DLMF 8.11.4) or continued fraction (DLMF 8.9.2, by Lentz's method).
pub(crate) fn chi_squared_share_above(degrees: f64, value: f64) -> f64 {
    let (a, x) = (0.5 * degrees, 0.5 * value);
    if x.is_nan() || a.is_nan() || a <= 0.0 {
        return f64::NAN;
    }
    if x <= 0.0 {
        return 1.0;
    }
    let power = (a * x.ln() - x - libm::lgamma(a)).exp();
    if x < a + 1.0 {
        let (mut term, mut sum, mut n) = (1.0 / a, 1.0 / a, a);
        while term > f64::EPSILON * sum {
            n += 1.0;
            term *= x / n;
            sum += term;
        }
        return 1.0 - power * sum;
    }
    let mut b = x + 1.0 - a;
    let (mut c, mut d) = (1e300, 1.0 / b);
    let mut fraction = d;
    for step in 1..1_000_000u32 {
        let step = f64::from(step);
        let part = step * (a - step);
        b += 2.0;
        d = 1.0 / away_from_zero(part * d + b);
        c = away_from_zero(b + part / c);
        fraction *= c * d;
        if (c * d - 1.0).abs() < f64::EPSILON {
            break;
        }
    }
    power * fraction
}

/// Distribution function of the beta distribution with parameters a, b > 0, at x in [0, 1]: the
/// continued fraction of DLMF 8.17.22 by Lentz's method.
pub(crate) fn beta_share_below(a: f64, b: f64, x: f64) -> f64 {
    if x <= 0.0 || x >= 1.0 {
        return x.clamp(0.0, 1.0);
    }
    if x > (a + 1.0) / (a + b + 2.0) {
        return 1.0 - beta_share_below(b, a, 1.0 - x);
    }
    let scale = libm::lgamma(a + b) - libm::lgamma(a) - libm::lgamma(b);
    let power = (scale + a * x.ln() + b * (-x).ln_1p()).exp();
    let (mut c, mut d, mut fraction) = (1.0, 0.0, 1.0);
    for step in 0..100_000u32 {
        let m = f64::from(step / 2);
        let part = match step {
            0 => 1.0,
            odd if odd % 2 == 1 => {
                -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0))
            }
            _ => m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m)),
        };
        d = 1.0 / away_from_zero(1.0 + part * d);
        c = away_from_zero(1.0 + part / c);
        fraction *= c * d;
        if step > 0 && (c * d - 1.0).abs() < f64::EPSILON {
            break;
        }
    }
    power * (fraction - 1.0) / a
}

fn away_from_zero(x: f64) -> f64 {
    if x.abs() < 1e-300 { 1e-300 } else { x }
}

/// Quantile of the beta distribution.
pub(crate) fn beta_quantile(a: f64, b: f64, share: f64) -> f64 {
    let mut miss = |x: f64| beta_share_below(a, b, x) - share;
    bracketed(&mut miss, [0.0, 1.0], 0.0).at
}

/// Interval of a share of which `successes` of `trials` were found, at a level of confidence
/// (C. J. Clopper and E. S. Pearson, Biometrika 26, 1934): it holds the share at least so often.
pub(crate) fn share_interval(successes: usize, trials: usize, level: f64) -> [f64; 2] {
    let (k, n, outside) = (successes as f64, trials as f64, 0.5 * (1.0 - level));
    let lower = match successes {
        0 => 0.0,
        _ => beta_quantile(k, n - k + 1.0, outside),
    };
    let upper = match successes == trials {
        true => 1.0,
        false => beta_quantile(k + 1.0, n - k, 1.0 - outside),
    };
    [lower, upper]
}

#[cfg(test)]
mod tests {
    use super::{
        beta_share_below, chi_squared_share_above, normal_quantile, normal_share_below,
        share_interval,
    };

    fn assert_close(found: f64, wanted: f64, within: f64) {
        let off = (found - wanted).abs();
        assert!(
            off <= within * wanted.abs().max(1e-300),
            "{found} and {wanted}"
        );
    }

    /// Values of SciPy 1.17.1 (`norm.ppf`, `norm.cdf`).
    #[test]
    fn the_normal_distribution_is_that_of_scipy() {
        for (share, x) in [
            (1e-10, -6.361340902404056),
            (0.00135, -2.9999769927033935),
            (0.025, -1.9599639845400545),
            (0.3, -0.5244005127080409),
            (0.8413447460685429, 1.0),
            (0.999, 3.090232306167813),
        ] {
            assert_close(normal_quantile(share), x, 1e-15);
            // (The distribution function multiplies the rounding of x by x².)
            assert_close(normal_share_below(x), share, 1e-15 * (4.0 + x * x));
        }
        assert_eq!(normal_quantile(0.5), 0.0);
        assert_close(normal_share_below(-6.0), 9.865876450376946e-10, 1e-14);
        // Each is the inverse of the other.
        for step in 1..1000 {
            let share = f64::from(step) / 1000.0;
            assert_close(normal_share_below(normal_quantile(share)), share, 4e-15);
        }
    }

    /// Values of SciPy 1.17.1 (`chi2.sf`).
    #[test]
    fn the_distribution_of_chi_squared_is_that_of_scipy() {
        for (degrees, value, share) in [
            (1.0, 3.84, 0.05004352124870519),
            (3.0, 0.5, 0.9188914116546758),
            (7.0, 20.0, 0.005569683072945574),
            (198.0, 150.0, 0.9954201891391407),
            (198.0, 260.0, 0.002039021937859725),
            (10000.0, 10300.0, 0.017638117447345406),
            (100000.0, 99000.0, 0.9875216843619172),
            (5.0, 400.0, 2.9666446590828377e-84),
        ] {
            assert_close(chi_squared_share_above(degrees, value), share, 1e-10);
        }
        assert_eq!(chi_squared_share_above(4.0, 0.0), 1.0);
        // Of two degrees of freedom it is exp(−χ²/2).
        assert_close(chi_squared_share_above(2.0, 7.0), (-3.5f64).exp(), 1e-14);
    }

    /// Values of SciPy 1.17.1 (`special.betainc`).
    #[test]
    fn the_beta_distribution_is_that_of_scipy() {
        for (a, b, x, share) in [
            (2.0, 3.0, 0.4, 0.5247999999999999),
            (0.5, 0.5, 0.1, 0.20483276469913345),
            (922.0, 79.0, 0.93, 0.8536272040046643),
            (40000.0, 5000.0, 0.89, 0.7728619464222104),
        ] {
            assert_close(beta_share_below(a, b, x), share, 1e-10);
        }
        assert_eq!(beta_share_below(2.0, 3.0, 0.0), 0.0);
        assert_eq!(beta_share_below(2.0, 3.0, 1.0), 1.0);
    }

    /// Values of SciPy 1.17.1 (`binomtest(…).proportion_ci(0.95, "exact")`).
    #[test]
    fn intervals_of_shares_are_those_of_scipy() {
        for (successes, trials, lower, upper) in [
            (0, 10, 0.0, 0.30849710781876294),
            (10, 10, 0.6915028921812371, 1.0),
            (3, 10, 0.06673951117773447, 0.652452850060008),
            (922, 1000, 0.9036063665974169, 0.937858786867286),
            (60000, 65536, 0.9133721406129937, 0.9176456711129922),
            (1, 131072, 1.931595269781496e-07, 4.250752479935614e-05),
        ] {
            let found = share_interval(successes, trials, 0.95);
            assert_close(found[0], lower, 1e-7);
            assert_close(found[1], upper, 1e-7);
        }
    }
}
