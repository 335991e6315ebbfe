//! Reactions of random linkages against virtual power: the driving force that
//! the free-body equations of all links give is that of the reduced equation.

use super::random::{FORMS, linkage};
use super::support::interior;
use crate::kinematics::linkage::Linkage;
use crate::kinematics::linkage::kinetostatics::{InputMotion, Kinetostatics, Options, Outcome};
use crate::kinematics::linkage::spec::{LinkageSpec, PairKind};
use proptest::prelude::*;

/// The motion that is asked for.
const SPEED: f64 = 1.7;
const ACCELERATION: f64 = -2.3;

pub(super) fn with_friction(mut spec: LinkageSpec, friction: f64) -> LinkageSpec {
    for pair in &mut spec.pairs {
        pair.friction = friction;
        match &mut pair.kind {
            PairKind::Revolute { diameter } => *diameter = 0.05,
            PairKind::Sliding {
                corners,
                half_height,
                ..
            } => {
                *corners = [0.4, -0.3];
                *half_height = 0.05;
            }
        }
    }
    spec
}

/// The greatest of the numbers that the comparison lives on.
fn scale(parts: &[f64]) -> f64 {
    parts.iter().fold(1e-6, |most, part| most.max(part.abs()))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 100, ..ProptestConfig::default() })]
    #[test]
    fn the_driving_force_is_that_of_virtual_power(
        seed: u64, dyads in 1usize..4, part in 0.05f64..0.95,
    ) {
        let spec = with_friction(linkage(seed, dyads, &FORMS).0, 0.0);
        let Ok(linkage) = Linkage::new(spec.clone()) else { return Ok(()) };
        let q = interior(&linkage, part);
        let mut at = linkage.workspace();
        linkage.solve(q, 3, &mut at).map_err(|e| TestCaseError::fail(e.to_string()))?;
        let solver = Kinetostatics::new(&spec).map_err(|e| TestCaseError::fail(format!("{e:?}")))?;
        let mut w = solver.workspace();
        let motion = InputMotion { coordinate: q, speed: SPEED, acceleration: ACCELERATION };
        let solved = solver.solve(&at, motion, &Options::default(), &mut w);
        // A dead-centre position of the driver is a singular matrix, and rightly refused.
        let Ok(solved) = solved else { return Ok(()) };
        if solved.condition.is_some() {
            return Ok(());
        }
        let reduced = linkage.reduced_linkage(&at);
        let parts = [
            reduced.inertia[0] * ACCELERATION,
            0.5 * reduced.inertia[1] * SPEED * SPEED,
            reduced.potential[1],
            -reduced.force[0],
            reduced.damping[0] * SPEED,
        ];
        let wanted: f64 = parts.iter().sum();
        let limit = 1e-8 * scale(&parts);
        prop_assert!((w.driver_force() - wanted).abs() <= limit, "{} {wanted}", w.driver_force());
        prop_assert!(solver.influence_error(&mut w) < 1e-8);
        prop_assert!(solver.balance(&w).residual < 1e-8);
    }

    /// With friction the driver covers its loss, and the acceleration follows
    /// from the driving force again.
    #[test]
    fn friction_only_takes(seed: u64, dyads in 1usize..4, part in 0.05f64..0.95) {
        let spec = with_friction(linkage(seed, dyads, &FORMS).0, 0.05);
        let Ok(linkage) = Linkage::new(spec.clone()) else { return Ok(()) };
        let q = interior(&linkage, part);
        let mut at = linkage.workspace();
        linkage.solve(q, 3, &mut at).map_err(|e| TestCaseError::fail(e.to_string()))?;
        let solver = Kinetostatics::new(&spec).map_err(|e| TestCaseError::fail(format!("{e:?}")))?;
        let mut w = solver.workspace();
        let motion = InputMotion { coordinate: q, speed: SPEED, acceleration: ACCELERATION };
        let options = Options::default();
        let Ok(solved) = solver.solve(&at, motion, &options, &mut w) else { return Ok(()) };
        if solved.condition.is_some() {
            return Ok(());
        }
        let balance = solver.balance(&w);
        prop_assert!(balance.loss >= 0.0 && balance.residual < 1e-7, "{balance:?}");
        for pair in 0..spec.pairs.len() {
            prop_assert!(solver.friction(pair, &w).loss >= -1e-12 * balance.loss);
        }
        let drive = w.driver_force();
        let back = solver.accelerate(&at, q, SPEED, drive, &options, &mut w);
        let Ok(back) = back else { return Ok(()) };
        // Where several accelerations are possible, another one may be found.
        if back.solved.is_some_and(|solved| solved.unique) {
            let Outcome::Moves { acceleration } = back.outcome else {
                return Err(TestCaseError::fail(format!("{back:?}")));
            };
            let reduced = linkage.reduced_linkage(&at);
            let size = scale(&[drive, reduced.inertia[1], reduced.potential[1]]);
            let limit = 1e-7 * (1.0 + size / reduced.inertia[0]);
            prop_assert!((acceleration - ACCELERATION).abs() <= limit, "{acceleration}");
        }
    }
}
