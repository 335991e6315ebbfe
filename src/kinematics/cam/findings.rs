//! What is wrong with a cam: undercuts, loops, corners, shocks.
//!
//! Loops are found by Newton's method for two unknowns, in closed form.

use super::curve::Polygon;
use super::disc::DiscCam;
use super::motion::Piece;
use super::search::negative;
use super::spec::Contact;
use crate::math::jet::JUMP_ROUNDING;
use serde::Serialize;
use std::f64::consts::PI;

/// Something that a designer must know of a cam.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(tag = "what", rename_all = "snake_case")]
pub enum Finding {
    /// The profile runs backwards: the roller (the face) cuts away what it
    /// has to roll on. At both ends the profile has a cusp.
    Undercut {
        /// Flank: 0, of a groove 0 the inner and 1 the outer.
        flank: usize,
        /// Start of the interval (rad).
        from: f64,
        /// End of the interval (rad); beyond the turn where it passes its end.
        to: f64,
    },
    /// The profile crosses itself: the roller does not fit into a hollow, or
    /// a loop of an undercut is cut off.
    Crossing {
        /// Which flank.
        flank: usize,
        /// φ of the two branches (rad).
        phi: [f64; 2],
    },
    /// U′ jumps (a hard shock): the pitch curve has a corner.
    Corner {
        /// φ (rad).
        at: f64,
        /// Change of direction of the normal (rad), positive where convex.
        turn: f64,
        /// True where it undercuts a flank.
        undercut: bool,
    },
    /// U″ jumps (a soft shock): the radius of curvature of the profile jumps.
    Shock {
        /// φ (rad).
        at: f64,
        /// Radius of curvature before and after (m).
        radius: [f64; 2],
        /// U″ before and after.
        second: [f64; 2],
    },
}

/// Chord tolerance of the polygon searched for crossings, of the prime circle.
const COARSE: f64 = 1e-4;

impl DiscCam {
    /// Undercuts, crossings, corners and shocks of all flanks.
    ///
    /// Undercuts by sign changes of 1 ± r·κ (of the radius of curvature under a
    /// flat face), located to rounding; crossings on polygons within 1e-4 of
    /// the prime circle, with their places improved by Newton's method.
    pub fn findings(&self) -> Vec<Finding> {
        let mut found = Vec::new();
        let edge = self.geometry().contact == Contact::KnifeEdge;
        for (flank, offset) in self.geometry().flanks().into_iter().enumerate() {
            if !edge {
                let rate = |piece: &Piece, phi| {
                    let touch = self.touch(piece, phi);
                    self.curve_rates(&touch, offset).0
                };
                for [from, to] in negative(self.motion(), &rate) {
                    found.push(Finding::Undercut { flank, from, to });
                }
            }
            let tolerance = COARSE * self.geometry().prime_radius();
            if let Ok(polygon) = self.polygon(offset, tolerance) {
                for phi in self.crossings(&polygon, offset) {
                    found.push(Finding::Crossing { flank, phi });
                }
            }
        }
        self.shocks(&mut found);
        found
    }

    /// Crossings of a polygon, improved; those that turn out to be the same are
    /// told once.
    fn crossings(&self, polygon: &Polygon, offset: f64) -> Vec<[f64; 2]> {
        let mut list: Vec<[f64; 2]> = Vec::new();
        for rough in polygon.crossings() {
            let phi = self.improved(rough, offset).unwrap_or(rough);
            let same = |other: &[f64; 2]| {
                (other[0] - phi[0]).abs() < 1e-6 && (other[1] - phi[1]).abs() < 1e-6
            };
            if !list.iter().any(same) {
                list.push(phi);
            }
        }
        list
    }

    /// Newton's method for Q(φ₁) = Q(φ₂); `None` where it wanders off.
    fn improved(&self, rough: [f64; 2], offset: f64) -> Option<[f64; 2]> {
        let mut phi = rough;
        for _ in 0..30 {
            let sides = phi.map(|phi| {
                let (piece, phi) = self.motion().piece_at(phi);
                let point = self.curve_point(piece, phi, offset);
                let touch = self.touch(piece, phi);
                let rate = self.curve_rates(&touch, offset).0;
                // The curve runs along the normal turned by −90°, mirrored with the cam.
                let along = [touch.normal[1], -touch.normal[0]];
                let along = self.in_cam(self.in_machine(along), phi);
                (point, [along[0] * rate, along[1] * rate])
            });
            let [(p, u), (q, w)] = sides;
            let gap = [q[0] - p[0], q[1] - p[1]];
            let determinant = w[0] * u[1] - u[0] * w[1];
            let steps = [
                (w[0] * gap[1] - gap[0] * w[1]) / determinant,
                (u[0] * gap[1] - gap[0] * u[1]) / determinant,
            ];
            if !steps.iter().all(|step| step.is_finite()) {
                return None;
            }
            phi = [phi[0] + steps[0], phi[1] + steps[1]];
            let near = |index: usize| (phi[index] - rough[index]).abs() < 0.1;
            if !(near(0) && near(1)) {
                return None;
            }
            if steps.iter().all(|step| step.abs() < 1e-14) {
                break;
            }
        }
        ((phi[1] - phi[0]).abs() > 1e-9).then_some(phi)
    }

    /// Corners and jumps of curvature at the joints of the law.
    fn shocks(&self, found: &mut Vec<Finding>) {
        let [slope, bend] = self.motion().sizes();
        for (before, after) in self.motion().joints() {
            let (left, right) = (
                self.motion().jet(before, before.to),
                self.motion().jet(after, after.from),
            );
            if (right.first - left.first).abs() > JUMP_ROUNDING * slope {
                found.push(self.corner(before, after));
            } else if (right.second - left.second).abs() > JUMP_ROUNDING * bend {
                let radius = |piece: &Piece, phi: f64| self.at(piece, phi).profile_radius;
                found.push(Finding::Shock {
                    at: after.from,
                    radius: [radius(before, before.to), radius(after, after.from)],
                    second: [left.second, right.second],
                });
            }
        }
    }

    fn corner(&self, before: &Piece, after: &Piece) -> Finding {
        let (left, right) = (self.touch(before, before.to), self.touch(after, after.from));
        let angle = |normal: [f64; 2]| normal[1].atan2(normal[0]);
        let mut turn = angle(left.normal) - angle(right.normal);
        turn -= 2.0 * PI * (turn / (2.0 * PI)).round();
        // On a flat face the contact jumps along the face; forwards leaves a
        // straight side on the profile, backwards a loop.
        let jump =
            self.motion().jet(after, after.from).first - self.motion().jet(before, before.to).first;
        let flanks = self.geometry().flanks();
        let undercut = match self.geometry().roller() {
            Some(_) => flanks.iter().any(|flank| flank * turn < 0.0),
            None => jump < 0.0,
        };
        Finding::Corner {
            at: after.from,
            turn,
            undercut,
        }
    }
}
