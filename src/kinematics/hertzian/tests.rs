//! Of contacts after Hertz.

use super::{
    ApproachReference, ContactPressure, Material, contact_modulus, line_approach, line_pressure,
    point_pressure, point_stiffness,
};
use std::f64::consts::PI;

const STEEL: Material = Material {
    modulus: 206e9,
    poisson_ratio: 0.3,
};

const RUBBER: Material = Material {
    modulus: 2e6,
    poisson_ratio: 0.48,
};

/// ∫₀^∞ f ds by the rule of midpoints, s = exp(x − exp(−x)) and its slope (double
/// exponential).
fn over_all(f: impl Fn(f64) -> f64) -> f64 {
    let step = 0.01;
    let places = (-600..8000).map(|k| f64::from(k) * step);
    let terms = places.map(|x| {
        let s = (x - (-x).exp()).exp();
        f(s) * s * (1.0 + (-x).exp())
    });
    step * terms.sum::<f64>()
}

#[test]
fn a_ball_on_a_plate() {
    // Johnson: N = (4/3)·E*·√R·δ^(3/2); a ball of 10 mm under 100 N on its like of steel.
    let modulus = contact_modulus([STEEL; 2]);
    approx::assert_relative_eq!(modulus, 206e9 / 1.82, max_relative = 1e-14);
    let found = point_stiffness(modulus, [200.0, 200.0]).unwrap();
    let wanted = 4.0 / 3.0 * modulus * 0.005f64.sqrt();
    approx::assert_relative_eq!(found, wanted, max_relative = 1e-14);
    assert_eq!(point_stiffness(modulus, [200.0, 0.0]), None);
    assert_eq!(point_stiffness(modulus, [200.0, -1.0]), None);
}

#[test]
fn an_ellipse_of_contact_is_that_of_the_potential() {
    // A. E. H. Love: with q = ∫₀^∞ ds/√((a² + s)(b² + s)s) the approach is 3N·q/(4π·E*), and
    // the relative curvatures are 3N/(2π·E*)·∫₀^∞ ds/((a² + s)·√(…)), likewise with b.
    for b in [1.0 - 1e-4, 0.8, 0.3, 0.05, 0.002] {
        let root = |s: f64| ((1.0 + s) * (b * b + s) * s).sqrt();
        let approach = 0.75 / PI * over_all(|s| 1.0 / root(s));
        let curvature = |square: f64| 1.5 / PI * over_all(|s| 1.0 / ((square + s) * root(s)));
        let curvatures = [curvature(1.0), curvature(b * b)];
        // Under N = E* = 1: 1 = K·δ^(3/2).
        let found = point_stiffness(1.0, curvatures).unwrap();
        approx::assert_relative_eq!(found, approach.powf(-1.5), max_relative = 1e-8);
        // Under half an ellipsoid of pressure over π·a·b.
        let pressure = point_pressure(1.0, curvatures).unwrap();
        approx::assert_relative_eq!(pressure.of(1.0), 1.5 / (PI * b), max_relative = 1e-8);
    }
}

#[test]
fn pressures_follow_the_root_and_the_cube_root_of_the_force() {
    // Johnson: p₀ = (6N·E*²/(π³R²))^(1/3) of a ball of radius R on a plate.
    let modulus = contact_modulus([STEEL; 2]);
    let ball = point_pressure(modulus, [200.0, 200.0]).unwrap();
    let wanted = (6.0 * 100.0 * (modulus * 200.0 / PI).powi(2) / PI).cbrt();
    approx::assert_relative_eq!(ball.of(100.0), wanted, max_relative = 1e-14);
    approx::assert_relative_eq!(ball.of(800.0), 2.0 * wanted, max_relative = 1e-14);
    approx::assert_relative_eq!(ball.on_arm(0.1).of(10.0), wanted, max_relative = 1e-14);
    let line = ContactPressure::Line(3.0).on_arm(0.25);
    approx::assert_relative_eq!(line.of(1.0), 6.0, max_relative = 1e-14);
    approx::assert_relative_eq!(line.of(-4.0), 12.0, max_relative = 1e-14);
    assert_eq!(point_pressure(modulus, [200.0, 0.0]), None);
}

#[test]
fn the_force_does_not_depend_on_the_order_of_the_planes() {
    let [one, other] = [[10.0, 70.0], [70.0, 10.0]].map(|c| point_stiffness(1e11, c));
    assert_eq!(one, other);
    let near = |d: f64| point_stiffness(1.0, [1.0, 1.0 + d]).unwrap();
    approx::assert_relative_eq!(near(9e-8), near(1.1e-7), max_relative = 1e-8);
}

#[test]
fn the_approach_of_a_roller_is_the_strain_along_its_axis() {
    // Johnson, 5.54 and 5.55: the stresses on the line of symmetry of a cylinder between
    // two loads; their strain added up from the contact to the axis.
    let (load, radius) = (1e5, 8e-3);
    let roller = (STEEL, ApproachReference::Cylinder(radius));
    let curvature = 2.0 / radius;
    let a = (4.0 * load / (PI * contact_modulus([STEEL; 2]) * curvature)).sqrt();
    let nu = 0.3;
    let strain = |z: f64| {
        let root = (a * a + z * z).sqrt();
        let across =
            1.0 / radius - 2.0 * (a * a + 2.0 * z * z) / (a * a * root) + 4.0 * z / (a * a);
        let along = -(2.0 / root + 2.0 / (2.0 * radius - z) - 1.0 / radius);
        load / PI * (1.0 - nu * nu) / STEEL.modulus * (along - nu / (1.0 - nu) * across)
    };
    // Simpson's rule over z = R·x³, finer near the contact.
    let count = 40_000;
    let term = |k: i32| {
        let x = f64::from(k) / f64::from(count);
        strain(radius * x.powi(3)) * 3.0 * radius * x * x
    };
    let inner = |k: i32| if k % 2 == 0 { 2.0 } else { 4.0 } * term(k);
    let sum = term(0) + term(count) + (1..count).map(inner).sum::<f64>();
    let one = -sum / (3.0 * f64::from(count));
    let both = line_approach(load, [roller; 2]).unwrap();
    // (Beyond terms of (a/R)², which the closed formula leaves out.)
    approx::assert_relative_eq!(both, 2.0 * one, max_relative = 1e-3);
}

#[test]
fn the_approach_of_a_half_space_is_the_strain_below_its_contact() {
    // A. Flamant: under a line load q the stresses on its axis plane at the depth z are
    // σ_z = −2q·z³/(π·r⁴) and σ_x = −2q·x²·z/(π·r⁴), r² = x² + z². Of a half ellipse of
    // pressure, x = z·tan θ, all of them added up; then the strain from the surface to the
    // depth d, in plane strain.
    let (load, radius) = (3e5, 12e-3);
    for (material, depth) in [(STEEL, 20e-3), (STEEL, 4e-3), (RUBBER, 20e-3)] {
        let flat = ApproachReference::Depth {
            curvature: 0.0,
            depth,
        };
        let load = if material == STEEL { load } else { 1e-5 * load };
        let roller = (material, ApproachReference::Cylinder(radius));
        let modulus = contact_modulus([material; 2]);
        let a = (4.0 * load * radius / (PI * modulus)).sqrt();
        let nu = material.poisson_ratio;
        let strain = |z: f64| {
            let widest = (a / z).atan();
            let count = 200;
            let (mut down, mut across) = (0.0, 0.0);
            for k in 0..count {
                let beta = PI * ((f64::from(k) + 0.5) / f64::from(count) - 0.5);
                let theta = widest * beta.sin();
                let x = z * theta.tan() / a;
                let pressure = 2.0 * load / (PI * a) * (1.0 - x * x).max(0.0).sqrt();
                let weight = pressure * widest * beta.cos() * PI / f64::from(count);
                down -= 2.0 / PI * weight * theta.cos().powi(2);
                across -= 2.0 / PI * weight * theta.sin().powi(2);
            }
            material.compliance() * (down - nu / (1.0 - nu) * across)
        };
        let count = 4000;
        let term = |k: i32| {
            let x = (f64::from(k) + 0.5) / f64::from(count);
            strain(depth * x.powi(3)) * 3.0 * depth * x * x / f64::from(count)
        };
        let own = -(0..count).map(term).sum::<f64>();
        // The roller's share is that of two rollers, halved.
        let both = line_approach(load, [roller, (material, flat)]).unwrap();
        let half = (4.0 * radius / a).ln() * 2.0 - 1.0;
        let rolled = load * material.compliance() / PI * half;
        // (Beyond terms of (a/d)².)
        let share = 2.0 * (a / depth).powi(2) + 1e-5;
        approx::assert_relative_eq!(both - rolled, own, max_relative = share);
    }
}

#[test]
fn the_pressure_along_a_line_carries_the_load() {
    let (load, curvature, modulus) = (2e5, 90.0, contact_modulus([STEEL; 2]));
    let greatest = line_pressure(load, modulus, curvature).unwrap();
    let half = (4.0 * load / (PI * modulus * curvature)).sqrt();
    // p(x) = p₀·√(1 − x²/a²), by the rule of midpoints over x = a·sin α.
    let count = 1000;
    let part = |k: i32| {
        let angle = PI * ((f64::from(k) + 0.5) / f64::from(count) - 0.5);
        greatest * half * angle.cos().powi(2) * PI / f64::from(count)
    };
    let sum: f64 = (0..count).map(part).sum();
    approx::assert_relative_eq!(sum, load, max_relative = 1e-9);
    assert_eq!(line_pressure(load, modulus, -1.0), None);
    assert_eq!(line_pressure(0.0, modulus, 1.0), Some(0.0));
}

#[test]
fn what_fits_into_each_other_has_no_small_contact() {
    let hollow = |radius: f64| ApproachReference::Depth {
        curvature: -1.0 / radius,
        depth: 20e-3,
    };
    let bodies = |radius| {
        [
            (STEEL, ApproachReference::Cylinder(8e-3)),
            (STEEL, hollow(radius)),
        ]
    };
    assert_eq!(line_approach(1e5, bodies(8e-3)), None);
    assert!(line_approach(1e5, bodies(16e-3)).is_some());
    let tight = line_approach(1e5, bodies(16e-3)).unwrap();
    let wide = line_approach(1e5, bodies(160e-3)).unwrap();
    assert!(tight < wide);
    assert_eq!(line_approach(1e10, bodies(16e-3)), None);
}
