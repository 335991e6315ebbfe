//! Tests of the equations of motion: their derivative, their energy, and
//! equations written down independently.

use super::System;
use super::testing::*;
use super::testing_random::*;
use crate::dynamics::integrate::{Dynamics, Modes};
use crate::dynamics::laws::LawInstance;
use crate::dynamics::model::*;
use crate::kinematics::position::Position;
use crate::math::number::Dual;
use std::sync::Arc;

fn derivatives(system: &System, time: f64, y: &[f64], modes: &Modes) -> Vec<f64> {
    let mut dy = vec![0.0; y.len()];
    system.derivatives(time, y, modes, &mut system.scratch(), &mut dy);
    dy
}

#[test]
fn the_tangent_agrees_with_differences() {
    let mut random = Random(1);
    for _ in 0..300 {
        let system = System::new(random_model(&mut random)).unwrap();
        let (y, modes) = (
            random_state(&system, &mut random),
            random_modes(&system, &mut random),
        );
        let direction = random_state(&system, &mut random);
        let mut tangent = vec![0.0; y.len()];
        system.tangent(
            0.3,
            &y,
            &modes,
            &direction,
            &mut system.scratch(),
            &mut tangent,
        );
        let at = |step: f64| {
            let y: Vec<f64> = y
                .iter()
                .zip(&direction)
                .map(|(y, d)| y + step * d)
                .collect();
            derivatives(&system, 0.3, &y, &modes)
        };
        let step = 1e-5;
        let (above, below) = (at(step), at(-step));
        for (i, &slope) in tangent.iter().enumerate() {
            let difference = (above[i] - below[i]) / (2.0 * step);
            // Tables over speed have kinks, which a difference may straddle.
            approx::assert_abs_diff_eq!(slope, difference, epsilon = 1e-5 * (1.0 + slope.abs()));
        }
    }
}

#[test]
fn branches_and_trains_taken_apart_move_as_in_the_whole() {
    let mut random = Random(7);
    let (mut branches, mut trains) = (0, 0);
    for _ in 0..2000 {
        let system = System::new(random_model(&mut random)).unwrap();
        let y = random_state(&system, &mut random);
        let modes = random_modes(&system, &mut random);
        let dy = derivatives(&system, 0.2, &y, &modes);
        let mut scratch = system.scratch();
        system.evaluate_fully(0.2, &y, &modes, &mut scratch);
        let own = &dy[system.coordinates()..];
        if system.frozen.trains.is_empty() {
            assert_eq!(own, scratch.accelerations);
        } else {
            // Summed in another order.
            approx::assert_relative_eq!(own[0], scratch.accelerations[0], max_relative = 1e-11);
        }
        branches += system.frozen.branches.len();
        trains += system.frozen.trains.len();
    }
    assert!(branches > 50 && trains > 10, "{branches} {trains}");
}

#[test]
fn energy_changes_by_the_power_of_drives_loads_and_dampers() {
    let mut random = Random(2);
    for _ in 0..1000 {
        let system = System::new(random_model(&mut random)).unwrap();
        let (y, modes) = (
            random_state(&system, &mut random),
            random_modes(&system, &mut random),
        );
        let time = random.between(-1.0, 1.0);
        let dy = derivatives(&system, time, &y, &modes);
        let moving: Vec<Dual> = y
            .iter()
            .zip(&dy)
            .map(|(&y, &dy)| Dual::new(y, dy))
            .collect();
        let mut scratch = system.scratch();
        let work = &mut scratch.dual_work;
        let [kinetic, elastic] =
            (system.frozen).energy(Dual::new(time, 1.0), &moving, &modes.0, work);
        let power = system.power(time, &y, &modes, &mut scratch);
        let energy = system.energy(time, &y, &modes, &mut scratch);
        assert_eq!(
            (energy.kinetic, energy.elastic),
            (kinetic.value, elastic.value)
        );
        let change = kinetic.derivative + elastic.derivative;
        let work_rate = power.drives + power.loads - power.dissipated;
        let size = 1.0 + kinetic.derivative.abs() + elastic.derivative.abs() + power.drives.abs();
        approx::assert_abs_diff_eq!(change, work_rate, epsilon = 1e-13 * size);
    }
}

impl System {
    /// True when x of an object's pair touches none of its flanks.
    fn clear_of_flanks(&self, object: usize, y: &[f64]) -> bool {
        let chain = self.chain(object).unwrap();
        let x = y[chain.first_coordinate];
        let sides = chain.contact.sides();
        let touches = |&side: &i64| chain.contact.engagement_conditions(side, x, 0.0)[0] > 0.0;
        !sides.iter().any(touches)
    }
}

#[test]
fn a_pair_loses_energy_and_never_gains_any() {
    let mut random = Random(3);
    let mut engaged_states = 0;
    for _ in 0..2000 {
        let system = System::new(random_model(&mut random)).unwrap();
        let y = random_state(&system, &mut random);
        let mut modes = random_modes(&system, &mut random);
        // The modes that belong to the state.
        for (component, &chain) in system.frozen.pairs.iter().enumerate() {
            let chain = &system.frozen.chains[chain];
            let (u, v) = system.frozen.deviations(chain, &y);
            let presses = |&&side: &&i64| {
                chain
                    .contact
                    .engagement_conditions(side, u[0], v[0])
                    .iter()
                    .all(|&h| h > 0.0)
            };
            modes.0[component] = chain
                .contact
                .sides()
                .iter()
                .find(presses)
                .copied()
                .unwrap_or(0);
            engaged_states += u64::from(modes.0[component] != 0);
        }
        let power = system.power(0.0, &y, &modes, &mut system.scratch());
        assert!(power.dissipated >= 0.0, "{power:?}");
        let mut out = vec![super::ObjectState::default(); system.model.objects.len()];
        system.observe(0.0, &y, &modes, &mut system.scratch(), &mut out);
        for (object, state) in out.iter().enumerate() {
            if let Some(component) = system.pair_component(object) {
                let engaged = modes.0[component] != 0;
                assert_eq!(engaged, state.contact_force > 0.0);
                // Clear of its flanks exactly while there is a lift.
                let clear = !engaged && system.clear_of_flanks(object, &y);
                assert_eq!(clear, state.lift > 0.0);
            }
        }
    }
    assert!(engaged_states > 500);
}

#[test]
fn a_rigid_slider_crank_with_motor_obeys_lagranges_equation() {
    let (crank, rod, flywheel, slide, rotor) = (0.1, 0.35, 0.4, 2.5, 0.05);
    let mut model = Model::default();
    let motor = add_rotor(&mut model, rotor, 0.2, 0.0);
    let rigid = |position, inertia| Body {
        position,
        inertias: vec![inertia],
        stiffnesses: vec![],
        dampings: vec![],
        pair: pair(Closure::Bilateral),
    };
    let gear = Position::Ratio {
        ratio: 0.25,
        offset: 0.0,
    };
    let shaft = add_body(&mut model, motor, &rigid(gear, flywheel));
    let law = Position::Custom(Arc::new(SliderCrank { crank, rod }));
    let press = add_body(&mut model, shaft, &rigid(law, slide));
    add_load(
        &mut model,
        motor,
        0,
        "torque",
        LawInstance::linear_motor(20.0, 150.0).law(),
    );
    add_load(
        &mut model,
        press,
        0,
        "technological",
        LoadLaw::viscous(30.0),
    );
    let system = System::new(model).unwrap();
    let mut random = Random(4);
    for _ in 0..200 {
        let (q, w) = (random.between(-20.0, 20.0), random.between(-200.0, 200.0));
        let dy = derivatives(&system, 0.0, &[q, w], &Modes::default());
        // θ = q/4; slide s(θ) by the cosine rule with the rod's angle β:
        // sin β = (r/l) sin θ, s = r cos θ + l cos β.
        let (theta, theta_speed) = (q / 4.0, w / 4.0);
        let beta = (crank / rod * theta.sin()).asin();
        let s1 = -crank * (theta + beta).sin() / beta.cos();
        let beta1 = crank * theta.cos() / (rod * beta.cos());
        let s2 = -crank
            * ((theta + beta).cos() * (1.0 + beta1) * beta.cos()
                + (theta + beta).sin() * beta.sin() * beta1)
            / beta.cos().powi(2);
        let inertia = rotor + (flywheel + slide * s1 * s1) / 16.0;
        let torque = 20.0 * (1.0 - w / 150.0) - 30.0 * s1 * theta_speed * s1 / 4.0;
        let bias = slide * s1 * s2 * theta_speed * theta_speed / 4.0;
        approx::assert_relative_eq!(
            dy[1],
            (torque - bias) / inertia,
            max_relative = 1e-12,
            epsilon = 1e-9
        );
        assert_eq!(dy[0], w);
    }
}
