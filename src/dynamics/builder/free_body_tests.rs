use super::{Continuum, FreeBody, free_lever_frequency, lever_shape};
use approx::{assert_abs_diff_eq, assert_relative_eq};

const BOTH: [Continuum; 2] = [Continuum::Rod, Continuum::Lever];

/// Displacements of the two ends of the continuum under a force cos ωt of 1 at the driven
/// end.
fn of_continuum(continuum: Continuum, z: f64) -> [f64; 2] {
    match continuum {
        Continuum::Rod => [-z.cos() / (z * z.sin()), -1.0 / (z * z.sin())],
        Continuum::Lever => {
            // φ′(0) = −1 and φ′(1) = 0.
            let [free, slope] = lever_shape(z, [1.0, 0.0]);
            let [held, own] = lever_shape(z, [0.0, 1.0]);
            let driven = own / slope;
            [driven, driven * free - held]
        }
    }
}

/// The same of the chain, by the balance of its masses from the last one on.
fn of_chain(body: &FreeBody, z: f64) -> [f64; 2] {
    let mut place = 1.0;
    let (mut force, mut output) = (0.0, 0.0);
    let masses = body.inertias.iter().zip(&body.stiffnesses);
    for ((inertia, stiffness), share) in masses.zip(&body.shares).rev() {
        output += share * place;
        force -= z * z * inertia * place;
        place += force / stiffness;
    }
    [place / force, output / force]
}

#[test]
fn the_chain_has_the_whole_inertia_and_its_masses_make_up_the_output() {
    for continuum in BOTH {
        for count in [0, 1, 2, 5, 16, 100] {
            let body = continuum.with_free_modes(count);
            assert_eq!(body.inertias.len(), count + 2);
            let positive = body.inertias.iter().chain(&body.stiffnesses);
            assert!(positive.clone().all(|one| *one > 0.0), "{body:?}");
            let inertia: f64 = body.inertias.iter().sum();
            assert_abs_diff_eq!(inertia, 1.0, epsilon = 1e-12);
            let shares: f64 = body.shares.iter().sum();
            assert_abs_diff_eq!(shares, 1.0, epsilon = 1e-9);
        }
    }
}

#[test]
fn slow_forces_at_the_contact_move_both_ends_as_those_of_the_continuum() {
    // 1/3 and −1/6 of a rod, 9/14 and −3/28 of a lever, whatever is kept.
    for (continuum, known) in BOTH
        .into_iter()
        .zip([[1.0 / 3.0, -1.0 / 6.0], [9.0 / 14.0, -3.0 / 28.0]])
    {
        for count in [0, 1, 3, 20] {
            let z = 1e-3;
            let found =
                of_chain(&continuum.with_free_modes(count), z).map(|end| end + 1.0 / (z * z));
            let exact = of_continuum(continuum, z).map(|end| end + 1.0 / (z * z));
            for ((found, exact), known) in found.into_iter().zip(exact).zip(known) {
                assert_abs_diff_eq!(found, known, epsilon = 1e-5);
                assert_abs_diff_eq!(exact, known, epsilon = 1e-5);
            }
        }
    }
}

#[test]
fn slow_forces_at_the_output_move_it_as_that_of_the_continuum() {
    // The free chain under the shares of a force at the output, less its motion as a whole:
    // the force in each link bends by what lies before it.
    for (continuum, known) in BOTH.into_iter().zip([1.0 / 3.0, 1.0 / 7.0]) {
        for count in [0, 1, 3, 20] {
            let body = continuum.with_free_modes(count);
            let (mut force, mut place, mut bent) = (0.0, 0.0, Vec::new());
            for (mass, stiffness) in body.stiffnesses.iter().enumerate() {
                // (Nothing is in the link to the contact.)
                place += force / stiffness;
                bent.push(place);
                force += body.inertias[mass] - body.shares[mass];
            }
            let sum = |by: &[f64]| bent.iter().zip(by).map(|(u, b)| u * b).sum::<f64>();
            let found = sum(&body.shares) - sum(&body.inertias);
            assert_abs_diff_eq!(found, known, epsilon = 1e-9);
        }
    }
}

#[test]
fn vibrations_are_those_of_the_free_object() {
    for continuum in BOTH {
        for z in [0.7, 1.9, 4.0] {
            let exact = of_continuum(continuum, z);
            let error = |count: usize| {
                let found = of_chain(&continuum.with_free_modes(count), z);
                let off = found.iter().zip(&exact).map(|(f, e)| (f - e).abs());
                off.fold(0.0, f64::max)
            };
            let [coarse, fine] = [8, 16].map(error);
            let order = (coarse / fine).log2();
            // The modes that are left out do φ_k(0)²/ω_k⁴: φ_k(0)² is even for a rod, and
            // grows with √ω of a lever.
            let expected = match continuum {
                Continuum::Rod => 3.0,
                Continuum::Lever => 2.5,
            };
            assert!(
                order > expected - 0.3,
                "{continuum:?} at {z}: {coarse} {fine}"
            );
            assert!(fine < 2e-3, "{continuum:?} at {z}: {fine}");
        }
    }
    // A rod without vibrations but that of its residual shape, ω² = 15: by hand.
    let body = Continuum::Rod.with_free_modes(0);
    assert_relative_eq!(body.stiffnesses[0], 4.0, max_relative = 1e-12);
    assert_relative_eq!(body.inertias[0], 4.0 / 9.0, max_relative = 1e-12);
    let square = body.stiffnesses[1] / (body.inertias[0] * body.inertias[1]);
    assert_relative_eq!(square, 15.0, max_relative = 1e-12);
}

#[test]
fn free_levers_have_the_frequencies_of_the_bessel_function_of_order_three_quarters() {
    // Zeros of J_{3/4}(√3·z/2) by its series, with its whole cancellation.
    for k in 1..=5 {
        let z = free_lever_frequency(k);
        let half = 3f64.sqrt() * z / 4.0;
        let (mut term, mut sum, mut scale) = (1.0, 0.0, 0.0f64);
        for j in 0..80 {
            sum += term;
            scale = scale.max(f64::abs(term));
            let n = f64::from(j) + 1.0;
            term *= -half * half / (n * (n + 0.75));
        }
        assert!(sum.abs() < 1e-12 * scale, "{k}: {z} {sum}");
        // One and one only in each interval of McMahon's series.
        let place = 3f64.sqrt() * z / 2.0 / std::f64::consts::PI - 0.125;
        assert_eq!(place.round() as usize, k);
    }
}
