//! Driving forces and reactions of several inputs: against the equations of motion, the powers,
//! and the equilibrium of the whole.

use super::examples;
use super::motion::at;
use crate::kinematics::linkage::kinetostatics::{Kinetostatics, Options};
use crate::kinematics::linkage::multi::spec::MultiSpec;
use crate::kinematics::linkage::multi::{MultiLinkage, MultiMotion};
use crate::kinematics::linkage::spec::PairKind;

/// Free-body equations of all links against M·q̈ − Q, which knows no reactions.
#[test]
fn driving_forces_are_those_of_the_equations_of_motion() {
    for spec in examples::all() {
        let (mut motion, starts) = ready(&spec);
        let solver = Kinetostatics::of_inputs(&spec).unwrap();
        let mut w = solver.workspace();
        for t in [0.0, 0.02, 0.05] {
            let inputs = at(&starts, t);
            motion.set_inputs(&inputs).unwrap();
            let rates: Vec<f64> = inputs.iter().map(|input| input.first).collect();
            solver
                .solve_over_time(&motion, &rates, &Options::default(), &mut w)
                .unwrap();
            let found = w.driver_forces().to_vec();
            let wanted = motion.required();
            let size = wanted.iter().fold(1.0f64, |most, x| most.max(x.abs()));
            for (found, wanted) in found.iter().zip(&wanted) {
                approx::assert_abs_diff_eq!(found, wanted, epsilon = 1e-9 * size);
            }
            assert!(solver.balance(&w).residual < 1e-9);
        }
    }
}

/// Σ power of the drivers = rate of the energy + power of dampers − power of given forces.
#[test]
fn powers_of_the_drivers_change_the_energy() {
    let h = 1e-4;
    for spec in examples::all() {
        let (mut motion, starts) = ready(&spec);
        let solver = Kinetostatics::of_inputs(&spec).unwrap();
        let mut w = solver.workspace();
        let energy = |motion: &mut MultiMotion, t: f64| {
            motion.set_inputs(&at(&starts, t)).unwrap();
            motion.energies().iter().sum::<f64>()
        };
        let t = 0.03;
        let (before, after) = (energy(&mut motion, t - h), energy(&mut motion, t + h));
        let (far, farther) = (
            energy(&mut motion, t - 2.0 * h),
            energy(&mut motion, t + 2.0 * h),
        );
        let rate = (8.0 * (after - before) - (farther - far)) / (12.0 * h);
        let inputs = at(&starts, t);
        motion.set_inputs(&inputs).unwrap();
        let rates: Vec<f64> = inputs.iter().map(|input| input.first).collect();
        solver
            .solve_over_time(&motion, &rates, &Options::default(), &mut w)
            .unwrap();
        let power = motion.power();
        let wanted = rate + power.dissipated - power.applied;
        approx::assert_relative_eq!(
            w.driver_force(),
            wanted,
            max_relative = 1e-7,
            epsilon = 1e-7
        );
    }
}

/// With friction the drivers take over what it loses, and all forces on the frame are in
/// equilibrium with inertia and weights.
#[test]
fn friction_is_paid_by_the_drivers_and_the_frame_is_in_equilibrium() {
    let mut losses = 0;
    for mut spec in examples::all() {
        for pair in &mut spec.linkage.pairs {
            // Little in guides, which wedge where their corners lie close together.
            pair.friction = if pair.slides() { 0.004 } else { 0.03 };
            match &mut pair.kind {
                PairKind::Revolute { diameter } => *diameter = 0.02,
                PairKind::Sliding { corners, .. } => *corners = [0.3, -0.3],
            }
        }
        let (mut motion, starts) = ready(&spec);
        let solver = Kinetostatics::of_inputs(&spec).unwrap();
        let mut w = solver.workspace();
        let inputs = at(&starts, 0.03);
        motion.set_inputs(&inputs).unwrap();
        let rates: Vec<f64> = inputs.iter().map(|input| input.first).collect();
        let mut power = |friction: bool| {
            let options = Options {
                friction,
                ..Options::default()
            };
            solver
                .solve_over_time(&motion, &rates, &options, &mut w)
                .unwrap();
            let (drive, balance) = (w.driver_force(), solver.balance(&w));
            let [frame, shaking, applied] =
                [solver.on_frame(&w), solver.shaking(&w), solver.applied(&w)];
            let size = frame.iter().fold(1.0f64, |most, x| most.max(x.abs()));
            for k in 0..3 {
                let rest = frame[k] - shaking[k] - applied[k];
                approx::assert_abs_diff_eq!(rest, 0.0, epsilon = 1e-8 * size);
            }
            (drive, balance)
        };
        let ((without, _), (with, balance)) = (power(false), power(true));
        assert!(balance.residual < 1e-9, "{balance:?}");
        approx::assert_relative_eq!(
            with - without,
            balance.loss,
            max_relative = 1e-7,
            epsilon = 1e-9
        );
        losses += usize::from(balance.loss > 0.0);
    }
    assert!(losses >= 5, "{losses}");
}

fn ready(spec: &MultiSpec) -> (MultiMotion, Vec<f64>) {
    let linkage = MultiLinkage::new(spec.clone()).unwrap();
    let starts = spec.inputs.iter().map(|input| input.start).collect();
    (MultiMotion::new(&linkage), starts)
}
