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
pub(crate) enum ApproachReference {
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

impl ApproachReference {
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
pub(crate) fn line_approach(load: f64, bodies: [(Material, ApproachReference); 2]) -> Option<f64> {
    let half = half_width(load, bodies)?;
    let of_body = |(material, backing): (Material, ApproachReference)| {
        let nu = material.poisson_ratio;
        let logarithm = match backing {
            ApproachReference::Cylinder(radius) => 2.0 * (4.0 * radius / half).ln() - 1.0,
            ApproachReference::Depth { depth, .. } => {
                2.0 * (2.0 * depth / half).ln() - nu / (1.0 - nu)
            }
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
fn half_width(load: f64, bodies: [(Material, ApproachReference); 2]) -> Option<f64> {
    let curvature: f64 = bodies.iter().map(|body| body.1.curvature()).sum();
    if !(curvature > 0.0 && load > 0.0) {
        return None;
    }
    let modulus = contact_modulus(bodies.map(|body| body.0));
    let half = (4.0 * load / (PI * modulus * curvature)).sqrt();
    let small = |body: &(Material, ApproachReference)| half <= SMALL * body.1.size();
    bodies.iter().all(small).then_some(half)
}

#[cfg(test)]
mod tests;
