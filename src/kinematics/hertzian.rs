//! Stiffness of the contact of two elastic bodies, from their geometry.
//!
//! H. Hertz's theory as in K. L. Johnson, *Contact Mechanics*, 1985, chapters 4 and 5: smooth
//! bodies that touch in a point or along a line, a contact that is small beside their radii,
//! no friction. Radii are positive where a body is convex, negative where it is hollow; a
//! flat body has the curvature 0.

use crate::math::roots::bracketed;
use std::f64::consts::PI;

/// Half widths greater than this share of the least radius (or depth) are no small contact.
const SMALL: f64 = 0.3;

/// Ratios of the relative radii that differ from 1 by less make a circle: what it changes is
/// of the second order.
const CIRCLE: f64 = 1e-7;

/// What a body is made of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Material {
    /// Young's modulus E (Pa), > 0.
    pub(crate) modulus: f64,
    /// Poisson's ratio ν, 0 ≤ ν ≤ 0.5.
    pub(crate) poisson_ratio: f64,
}

impl Material {
    /// (1 − ν²)/E (1/Pa).
    fn compliance(self) -> f64 {
        (1.0 - self.poisson_ratio * self.poisson_ratio) / self.modulus
    }
}

/// E* of two bodies (Pa): 1/E* = (1 − ν₁²)/E₁ + (1 − ν₂²)/E₂.
pub(crate) fn contact_modulus(bodies: [Material; 2]) -> f64 {
    1.0 / bodies.map(Material::compliance).iter().sum::<f64>()
}

/// K of N = K·p^(3/2) (N/m^(3/2)) where two bodies touch in a point; `curvatures`: the sums of
/// the bodies' curvatures in the two planes of principal curvature (1/m), which they share.
/// `None`: one of the sums is not greater than 0, so that they touch in more than a point.
///
/// Of equal sums K = (4/3)·E*·√R (Johnson, 4.23). Otherwise the contact is an ellipse with the
/// half axes a > b, e² = 1 − b²/a², and with R_e = √(R′R″), R′ ≥ R″, from
///
/// R′/R″ = ((a/b)²·E(e) − K(e))/(K(e) − E(e)),
/// F₁³ = 4/(π·e²)·(b/a)^(3/2)·√(((a/b)²·E(e) − K(e))·(K(e) − E(e))),
/// F₂ = (2/π)·√(b/a)·K(e)/F₁,
///
/// the approach is (9N²/(16·E*²·R_e))^(1/3)·F₂ (4.28 to 4.32).
pub(crate) fn point_stiffness(modulus: f64, curvatures: [f64; 2]) -> Option<f64> {
    let [least, most] = [
        curvatures[0].min(curvatures[1]),
        curvatures[0].max(curvatures[1]),
    ];
    if !(least > 0.0 && most.is_finite()) {
        return None;
    }
    let (ratio, mean) = (most / least, 1.0 / (least * most).sqrt());
    let [_, factor] = factors(ratio)?;
    Some(4.0 / 3.0 * modulus * mean.sqrt() * factor.powf(-1.5))
}

/// F₁ and F₂ at R′/R″ ≥ 1.
fn factors(ratio: f64) -> Option<[f64; 2]> {
    if ratio - 1.0 < CIRCLE {
        return Some([1.0; 2]);
    }
    // Over ln(a/b): the ratio of the axes is near (R′/R″)^(2/3), and never greater than R′/R″.
    let mut miss = |x: f64| Ellipse::of(x).ratio().ln() - ratio.ln();
    let found = bracketed(&mut miss, [1e-12, ratio.ln() + 1e-6], 1e-14);
    let ellipse = Ellipse::of(found.at);
    let shape = ellipse.axes.powf(-1.5) * (ellipse.larger * ellipse.smaller).sqrt();
    let first = (4.0 / (PI * ellipse.square) * shape).cbrt();
    let second = 2.0 / PI * ellipse.axes.powf(-0.5) * ellipse.complete / first;
    let both = [first, second];
    both.iter().all(|factor| factor.is_finite()).then_some(both)
}

/// Greatest pressure between two bodies over the force that presses them together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ContactPressure {
    /// Along a line: so many times the root of the force.
    Line(f64),
    /// In a point: so many times the cube root of the force.
    Point(f64),
}

impl ContactPressure {
    /// Of a force (N, or N·m where the bodies touch on an arm) the pressure (Pa).
    pub(crate) fn of(self, force: f64) -> f64 {
        match self {
            Self::Line(factor) => factor * force.abs().sqrt(),
            Self::Point(factor) => factor * force.abs().cbrt(),
        }
    }

    /// The same over the moment of that force on an arm (m).
    pub(crate) fn on_arm(self, arm: f64) -> Self {
        match self {
            Self::Line(factor) => Self::Line(factor / arm.sqrt()),
            Self::Point(factor) => Self::Point(factor / arm.cbrt()),
        }
    }
}

/// The pressure of bodies that touch in a point, 3N/(2π·a·b), their curvatures as in
/// [`point_stiffness`]; √(a·b) = (3N·R_e/(4·E*))^(1/3)·F₁ (Johnson, 4.28 and 4.30).
pub(crate) fn point_pressure(modulus: f64, curvatures: [f64; 2]) -> Option<ContactPressure> {
    let [least, most] = [
        curvatures[0].min(curvatures[1]),
        curvatures[0].max(curvatures[1]),
    ];
    if !(least > 0.0 && most.is_finite()) {
        return None;
    }
    let [first, _] = factors(most / least)?;
    let size = (0.75 / (modulus * (least * most).sqrt())).cbrt() * first;
    Some(ContactPressure::Point(1.5 / (PI * size * size)))
}

/// An ellipse of contact.
struct Ellipse {
    /// a/b.
    axes: f64,
    /// e².
    square: f64,
    /// K(e).
    complete: f64,
    /// (a/b)²·E(e) − K(e).
    larger: f64,
    /// K(e) − E(e).
    smaller: f64,
}

impl Ellipse {
    /// Complete elliptic integrals by the arithmetic-geometric mean; K − E as a sum of its own,
    /// which does not cancel where the ellipse is nearly a circle.
    /// `logarithm`: ln(a/b) > 0.
    fn of(logarithm: f64) -> Self {
        let (axes, square) = (logarithm.exp(), -(-2.0 * logarithm).exp_m1());
        let (mut a, mut b) = (1.0, 1.0 / axes);
        let (mut sum, mut weight) = (0.5 * square, 0.5);
        while (a - b).abs() > 1e-16 * a {
            let half = 0.5 * (a - b);
            (a, b) = (0.5 * (a + b), (a * b).sqrt());
            weight *= 2.0;
            sum += weight * half * half;
            if weight > 1e6 {
                break;
            }
        }
        let complete = PI / (2.0 * a);
        let smaller = complete * sum;
        // (a/b)²·E − K = (a/b)²·(e²·K − (K − E)).
        let long = axes * axes;
        Self {
            axes,
            square,
            complete,
            larger: long * complete * (square - sum),
            smaller,
        }
    }

    /// R′/R″ that it belongs to.
    fn ratio(&self) -> f64 {
        self.larger / self.smaller
    }
}

/// How far one body of a contact along a line gives way: what its approach is counted from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Backing {
    /// A cylinder of this radius, up to its axis: it is pressed between the contact and a line
    /// opposite.
    Cylinder(f64),
    /// A flat or hollow body, up to this depth below its surface.
    Depth {
        /// Its curvature, ≤ 0 (1/m).
        curvature: f64,
        /// The depth (m), > 0.
        depth: f64,
    },
}

impl Backing {
    pub(crate) fn curvature(self) -> f64 {
        match self {
            Self::Cylinder(radius) => 1.0 / radius,
            Self::Depth { curvature, .. } => curvature,
        }
    }

    fn size(self) -> f64 {
        match self {
            Self::Cylinder(radius) => radius,
            Self::Depth { depth, .. } => depth,
        }
    }
}

/// Approach of two bodies (m) that touch along a line under a load per length of it (N/m), in
/// plane strain. `None`: their surfaces fit into each other, or the contact is not small.
///
/// With the half width a = √(4·P·R/(π·E*)) a cylinder is compressed by
/// P·(1 − ν²)/(π·E)·(2·ln(4R/a) − 1) between contact and axis (half of Johnson, 5.57), a
/// half-space by P·(1 − ν²)/(π·E)·(2·ln(2d/a) − ν/(1 − ν)) between contact and depth d (5.58;
/// so do C. Weber and K. Banaschek, *Formänderung und Profilrücknahme*, 1953, for gear teeth).
/// A line has no approach of its own: far away it grows without limit, and so depends on what
/// it is counted from.
pub(crate) fn line_approach(load: f64, bodies: [(Material, Backing); 2]) -> Option<f64> {
    let half = half_width(load, bodies)?;
    let of_body = |(material, backing): (Material, Backing)| {
        let nu = material.poisson_ratio;
        let logarithm = match backing {
            Backing::Cylinder(radius) => 2.0 * (4.0 * radius / half).ln() - 1.0,
            Backing::Depth { depth, .. } => 2.0 * (2.0 * depth / half).ln() - nu / (1.0 - nu),
        };
        load * material.compliance() / PI * logarithm
    };
    Some(bodies.map(of_body).iter().sum())
}

/// Greatest pressure (Pa) between bodies that touch along a line, under a load per length of it
/// (N/m): √(P·E*·κ/π), κ the sum of their curvatures (1/m) (Johnson, 4.45). `None`: they do not
/// bulge towards each other.
pub(crate) fn line_pressure(load: f64, modulus: f64, curvature: f64) -> Option<f64> {
    let fits = load >= 0.0 && curvature > 0.0 && curvature.is_finite();
    fits.then(|| (load * modulus * curvature / PI).sqrt())
}

/// a (m) of a contact along a line; `None`: see [`line_approach`].
fn half_width(load: f64, bodies: [(Material, Backing); 2]) -> Option<f64> {
    let curvature: f64 = bodies.iter().map(|body| body.1.curvature()).sum();
    if !(curvature > 0.0 && load > 0.0) {
        return None;
    }
    let modulus = contact_modulus(bodies.map(|body| body.0));
    let half = (4.0 * load / (PI * modulus * curvature)).sqrt();
    let small = |body: &(Material, Backing)| half <= SMALL * body.1.size();
    bodies.iter().all(small).then_some(half)
}

#[cfg(test)]
mod tests {
    use super::{
        Backing, ContactPressure, Material, contact_modulus, line_approach, line_pressure,
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
        let roller = (STEEL, Backing::Cylinder(radius));
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
            let flat = Backing::Depth {
                curvature: 0.0,
                depth,
            };
            let load = if material == STEEL { load } else { 1e-5 * load };
            let roller = (material, Backing::Cylinder(radius));
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
        let hollow = |radius: f64| Backing::Depth {
            curvature: -1.0 / radius,
            depth: 20e-3,
        };
        let bodies = |radius| [(STEEL, Backing::Cylinder(8e-3)), (STEEL, hollow(radius))];
        assert_eq!(line_approach(1e5, bodies(8e-3)), None);
        assert!(line_approach(1e5, bodies(16e-3)).is_some());
        let tight = line_approach(1e5, bodies(16e-3)).unwrap();
        let wide = line_approach(1e5, bodies(160e-3)).unwrap();
        assert!(tight < wide);
        assert_eq!(line_approach(1e10, bodies(16e-3)), None);
    }
}
