use super::{Continuum, lever_shape};
use crate::math::quadrature::rule;

const BOTH: [Continuum; 2] = [Continuum::Rod, Continuum::Lever];

#[test]
fn levers_have_the_frequencies_of_the_bessel_functions() {
    // Zeros of d/ds[√s·J_{1/4}(√3·ω·s²/2)] at s = 1.
    let known = [1.2222600570, 4.9467992440, 8.5914967061, 12.2261761634];
    let found = Continuum::Lever.reduce(4).oscillators;
    for (mode, known) in found.iter().zip(known) {
        approx::assert_abs_diff_eq!(mode.frequency, known, epsilon = 1e-10);
    }
    // By the series of φ′(1) itself, Σ (4j + 1)·c_j with its whole cancellation.
    for z in known {
        let (mut term, mut slope) = (1.0, 0.0);
        for j in 0..60 {
            let n = 4.0 * f64::from(j);
            slope += (n + 1.0) * term;
            term *= -3.0 * z * z / ((n + 5.0) * (n + 4.0));
        }
        approx::assert_abs_diff_eq!(slope, 0.0, epsilon = 1e-4);
    }
}

#[test]
fn all_modes_together_are_the_whole() {
    for continuum in BOTH {
        let all = continuum.reduce(100);
        // Every number approaches nothing, with the power of the number of modes that
        // its series has.
        let half = continuum.reduce(50);
        let order = |of: fn(&super::Reduction) -> f64| (of(&half) / of(&all)).abs().log2();
        approx::assert_abs_diff_eq!(order(|one| one.under_force), 1.0, epsilon = 0.05);
        assert!(all.under_force > 0.0 && all.under_force < 0.01);
        assert!(all.residual_inertia > 0.0 && all.residual_inertia < 1e-5);
        let least = match continuum {
            Continuum::Rod => 0.95,
            Continuum::Lever => 0.4,
        };
        assert!(order(|one| one.driven_end) > least);
        assert!(all.driven_end > 0.0 && all.driven_end < 0.1);
    }
}

#[test]
fn modes_are_orthogonal_and_of_the_inertia_and_share_of_their_shapes() {
    // The shapes by quadrature of the power series in s, in place of the closed forms.
    let parts = 16;
    let (short, length) = (rule(7), 1.0 / f64::from(parts));
    let part = |k: i32| {
        let placed = short.iter();
        placed.map(move |(s, w)| ((f64::from(k) + s) * length, w * length))
    };
    let rule: Vec<(f64, f64)> = (0..parts).flat_map(part).collect();
    let weight = |continuum, s: f64| match continuum {
        Continuum::Rod => 1.0,
        Continuum::Lever => 3.0 * s * s,
    };
    let shape = |continuum, z: f64, s: f64| match continuum {
        Continuum::Rod => (z * s).sin(),
        // φ(s) of the frequency z is s times φ(1) of the frequency z·s².
        Continuum::Lever => s * lever_shape(z * s * s, [0.0, 1.0])[0],
    };
    for continuum in BOTH {
        let modes = continuum.reduce(4).oscillators;
        let over = |f: &dyn Fn(f64) -> f64| -> f64 {
            rule.iter()
                .map(|(s, w)| w * weight(continuum, *s) * f(*s))
                .sum()
        };
        for one in &modes {
            let own = |s: f64| shape(continuum, one.frequency, s);
            let (norm, gamma) = (over(&|s| own(s) * own(s)), over(&|s| own(s)));
            approx::assert_relative_eq!(one.inertia, gamma * gamma / norm, max_relative = 1e-9);
            let share = own(1.0) * gamma / norm;
            approx::assert_relative_eq!(one.share, share, max_relative = 1e-9);
            for other in modes.iter().filter(|other| *other != one) {
                let product = over(&|s| own(s) * shape(continuum, other.frequency, s));
                approx::assert_abs_diff_eq!(product / norm, 0.0, epsilon = 1e-9);
            }
        }
    }
}

#[test]
fn the_residual_coordinate_gives_way_as_the_modes_that_it_stands_for() {
    for continuum in BOTH {
        for count in 0..6 {
            let reduction = continuum.reduce(count);
            let [force, acceleration] = [reduction.under_force, reduction.under_acceleration];
            let end = reduction.driven_end;
            let with = reduction.with_residual();
            let own = with.oscillators[count];
            // An oscillator of the inertia M gives way by g²/(M·ω²) under a force at the
            // output, and by g/ω² under an acceleration.
            let stiffness = own.inertia * own.frequency.powi(2);
            approx::assert_relative_eq!(own.share.powi(2) / stiffness, force, max_relative = 1e-9);
            let under = own.share / own.frequency.powi(2);
            approx::assert_relative_eq!(under, acceleration, max_relative = 1e-9);
            assert!(with.driven_end > 0.0 && with.driven_end < end);
            // It stands above the last mode that is kept (Rayleigh).
            let next = continuum.reduce(count + 1).oscillators[count].frequency;
            assert!(own.frequency > next * (1.0 - 1e-12), "{count}: {own:?}");
        }
    }
}
