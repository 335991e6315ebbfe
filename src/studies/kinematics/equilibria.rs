//! Where a linkage stays by itself, and how it vibrates about there.
//!
//! On its input coordinate q the linkage alone obeys J·q̈ + ½·J′·q̇² = W − D·q̇ with W = −V′ + Q, the
//! weights, springs and forces. It rests where W = 0; about there x = q − q₀ obeys
//! J·ẍ + D·ẋ + k·x = 0 with the stiffness k = V″ − Q′.

use super::request::{KinematicsRequest, Over, whole_travel};
use crate::kinematics::linkage::{Linkage, ReducedLinkage, Workspace};
use crate::math::roots::{BISECTIONS, bisect, middle};

/// Intervals in which a root is looked for.
const INTERVALS: usize = 720;
/// Share of the greatest force, and of the parts of a stiffness, that is rounding.
const FORCE_ROUNDING: f64 = 1e-12;

/// A position in which a linkage rests when its input is left free.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Equilibrium {
    /// Input coordinate (rad or m).
    pub at: f64,
    /// k: what turns it back, by the input coordinate (N·m/rad or N/m); negative where it falls away.
    pub stiffness: f64,
    /// J: inertia on the input (kg·m² or kg).
    pub inertia: f64,
    /// D: damping on the input (N·m·s/rad or N·s/m).
    pub damping: f64,
}

impl Equilibrium {
    /// True where a small push leads back.
    pub fn is_stable(&self) -> bool {
        self.stiffness > 0.0
    }

    /// Natural angular frequency without damping √(k/J) (rad/s); `None` where it is not stable, or
    /// nothing has inertia.
    pub fn frequency(&self) -> Option<f64> {
        let square = self.stiffness / self.inertia;
        (square > 0.0 && square.is_finite()).then(|| square.sqrt())
    }

    /// Share of the damping that just keeps it from swinging, D/(2·√(k·J)).
    pub fn damping_ratio(&self) -> Option<f64> {
        let frequency = self.frequency()?;
        Some(self.damping / (2.0 * self.inertia * frequency))
    }

    /// Rate at which it leaves an equilibrium that is not stable (1/s): the greater root of
    /// J·λ² + D·λ + k = 0.
    pub fn growth(&self) -> Option<f64> {
        if self.is_stable() || !(self.inertia > 0.0) {
            return None;
        }
        let half = 0.5 * self.damping / self.inertia;
        let rate = self.stiffness.abs() / self.inertia;
        // The difference of both terms, without cancellation.
        Some(rate / (half + (half * half + rate).sqrt()))
    }
}

/// All equilibria over a period, or the whole reach, ascending; none where no weight, spring or
/// force acts, and where the input goes everywhere.
pub(super) fn find_equilibria(asked: &KinematicsRequest<'_>) -> Vec<Equilibrium> {
    let linkage = &asked.linkage;
    let (from, to, closed) = match whole_travel(linkage) {
        Over::Turn => {
            let range = linkage.range();
            let length = range.period.map_or(0.0, |period| period.length);
            (range.start, range.start + length, true)
        }
        Over::Range { from, to } => (from, to, false),
        Over::Time { .. } => return Vec::new(),
    };
    if !(from.is_finite() && to.is_finite() && from < to) {
        return Vec::new();
    }
    Seeker {
        linkage,
        work: linkage.workspace(),
    }
    .find_all([from, to], closed)
}

struct Seeker<'a> {
    linkage: &'a Linkage,
    work: Workspace,
}

impl Seeker<'_> {
    fn find_all(&mut self, [from, to]: [f64; 2], closed: bool) -> Vec<Equilibrium> {
        let place = |k: usize| from + (to - from) * k as f64 / INTERVALS as f64;
        let force = |k: usize, seeker: &mut Self| {
            // Both ends of a period are one place.
            let k = if closed { k % INTERVALS } else { k };
            seeker.force(place(k))
        };
        let forces: Vec<f64> = (0..=INTERVALS).map(|k| force(k, self)).collect();
        let greatest = forces.iter().filter(|w| w.is_finite());
        let greatest = greatest.fold(0.0f64, |most, w| most.max(w.abs()));
        let clean = |w: f64| {
            if w.abs() <= FORCE_ROUNDING * greatest {
                0.0
            } else {
                w
            }
        };
        let forces: Vec<f64> = forces.into_iter().map(clean).collect();
        let mut found = Vec::new();
        for k in 0..INTERVALS {
            let (a, b) = (forces[k], forces[k + 1]);
            if a == 0.0 && self.isolated(&forces, k, closed) {
                found.extend(self.at(place(k)));
            } else if a * b < 0.0 {
                let root = self.root(place(k), place(k + 1), a);
                found.extend(self.at(root));
            }
        }
        if !closed && forces[INTERVALS] == 0.0 && forces[INTERVALS - 1] != 0.0 {
            found.extend(self.at(to));
        }
        found
    }

    /// True where the force is zero at one place only, not all around it.
    fn isolated(&self, forces: &[f64], k: usize, closed: bool) -> bool {
        let before = match k.checked_sub(1) {
            Some(before) => forces[before],
            None if closed => forces[INTERVALS - 1],
            None => f64::NAN,
        };
        before != 0.0 && forces[k + 1] != 0.0
    }

    fn reduced_linkage(&mut self, q: f64) -> Option<ReducedLinkage> {
        self.linkage.solve(q, 2, &mut self.work).ok()?;
        Some(self.linkage.reduced_linkage(&self.work))
    }

    /// W, not a number where the linkage cannot be assembled.
    fn force(&mut self, q: f64) -> f64 {
        let reduced = self.reduced_linkage(q);
        reduced.map_or(f64::NAN, |reduced| reduced.force[0] - reduced.potential[1])
    }

    fn root(&mut self, low: f64, high: f64, sign: f64) -> f64 {
        middle(bisect([low, high], BISECTIONS, |q| {
            self.force(q) * sign > 0.0
        }))
    }

    fn at(&mut self, at: f64) -> Option<Equilibrium> {
        let reduced = self.reduced_linkage(at)?;
        let [spring, force] = [reduced.potential[2], reduced.force[1]];
        let stiffness = spring - force;
        let rounding = FORCE_ROUNDING * (spring.abs() + force.abs());
        Some(Equilibrium {
            at,
            stiffness: if stiffness.abs() <= rounding {
                0.0
            } else {
                stiffness
            },
            inertia: reduced.inertia[0],
            damping: reduced.damping[0],
        })
    }
}

#[cfg(test)]
mod tests {
    use super::{Equilibrium, Seeker};
    use crate::kinematics::linkage::Linkage;
    use crate::kinematics::linkage::spec::{
        ForceLaw, ForceSpec, LinkSpec, LinkageSpec, PairKind, PairSpec, PointOf,
    };
    use std::f64::consts::{PI, TAU};

    fn pendulum(rate: f64, damping: f64) -> Linkage {
        let pin = |link| PointOf { link, at: [0.0; 2] };
        Linkage::new(LinkageSpec {
            links: vec![LinkSpec {
                name: "rod".to_owned(),
                mass: 2.0,
                centre: [0.5, 0.0],
                moment: 0.1,
                ..LinkSpec::default()
            }],
            pairs: vec![PairSpec {
                name: "O".to_owned(),
                on: pin(None),
                link: pin(Some(0)),
                kind: PairKind::Revolute { diameter: 0.0 },
                friction: 0.0,
            }],
            gravity: [0.0, -9.81],
            forces: vec![ForceSpec {
                name: "spring".to_owned(),
                law: ForceLaw::Torsion {
                    pair: 0,
                    rate,
                    free_angle: -PI / 2.0,
                    damping,
                },
            }],
            ..LinkageSpec::default()
        })
        .unwrap()
    }

    fn found(linkage: &Linkage, from: f64, closed: bool) -> Vec<Equilibrium> {
        let work = linkage.workspace();
        Seeker { linkage, work }.find_all([from, from + TAU], closed)
    }

    #[test]
    fn a_pendulum_hangs_and_stands() {
        let linkage = pendulum(0.0, 0.3);
        let all = found(&linkage, 0.1, true);
        // m·g·l = 9.81, J = 0.1 + 2·0.25 = 0.6.
        let [standing, hanging] = all.as_slice() else {
            panic!("{all:?}")
        };
        approx::assert_relative_eq!(standing.at, PI / 2.0, epsilon = 1e-12);
        approx::assert_relative_eq!(hanging.at, 1.5 * PI, epsilon = 1e-12);
        let frequency = hanging.frequency().unwrap();
        approx::assert_relative_eq!(frequency, (9.81f64 / 0.6).sqrt(), max_relative = 1e-12);
        let ratio = 0.3 / (2.0 * (9.81f64 * 0.6).sqrt());
        approx::assert_relative_eq!(
            hanging.damping_ratio().unwrap(),
            ratio,
            max_relative = 1e-12
        );
        assert!(!standing.is_stable() && standing.frequency().is_none());
        let growth = standing.growth().unwrap();
        let rest = 0.6 * growth * growth + 0.3 * growth - 9.81;
        assert!(rest.abs() < 1e-12, "{rest}");
    }

    #[test]
    fn a_spring_adds_its_rate_and_an_input_without_forces_rests_nowhere_in_particular() {
        let linkage = pendulum(20.0, 0.0);
        // From the place below, where the spring is slack, it goes a turn and back no more.
        let all = found(&linkage, -PI / 2.0 - 3.0, false);
        let stable: Vec<_> = all.iter().filter(|one| one.is_stable()).collect();
        let lowest = stable
            .iter()
            .find(|one| (one.at + PI / 2.0).abs() < 1e-9)
            .unwrap();
        let wanted = ((9.81f64 + 20.0) / 0.6).sqrt();
        approx::assert_relative_eq!(lowest.frequency().unwrap(), wanted, max_relative = 1e-12);
        let mut spec = linkage.spec().clone();
        spec.forces.clear();
        spec.gravity = [0.0; 2];
        assert!(found(&Linkage::new(spec).unwrap(), 0.0, true).is_empty());
    }
}
