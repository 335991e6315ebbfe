//! Forces: virtual power, equilibrium of the whole, friction.

use super::{Builder, CRANK, GROUND, all, rack_on_a_lever, solved, weighed};
use crate::kinematics::linkage::Linkage;
use crate::kinematics::linkage::joints::gear::Gear;
use crate::kinematics::linkage::kinetostatics::{InputMotion, Kinetostatics, Options, Outcome};
use crate::kinematics::linkage::spec::CouplingKind;
use crate::kinematics::linkage::tests::kinetostatics::with_friction;
use crate::kinematics::linkage::tests::support::{check_driving_force, close, interior};

#[test]
fn driving_forces_are_those_of_virtual_power_and_the_frame_is_in_equilibrium() {
    let handle = ("rack on a lever", weighed(rack_on_a_lever()).0);
    for (name, spec) in all().into_iter().chain([handle]) {
        check_driving_force(name, spec);
    }
}

#[test]
fn the_force_of_teeth_drives_the_second_wheel() {
    // A wheel with a moment of inertia alone, driven through gears by one without: the force of the
    // teeth at the pitch radius is what accelerates it.
    let (radius, moment) = (0.06, 0.5);
    let second = Some(1);
    let spec = Builder::new(&["crank", "second"])
        .pin((GROUND, [0.0; 2]), (CRANK, [0.0; 2]))
        .pin((GROUND, [0.1, 0.0]), (second, [0.0; 2]))
        .couple(
            [CRANK, second],
            GROUND,
            CouplingKind::Gear(Gear {
                ratio: -0.04 / radius,
            }),
            0.0,
        )
        .mass(1, 1.0, [0.0; 2], moment);
    let linkage = Linkage::new(spec.0).unwrap();
    let solver = Kinetostatics::new(linkage.spec()).unwrap();
    let mut w = solver.workspace();
    let motion = InputMotion {
        coordinate: 0.3,
        speed: 2.0,
        acceleration: 9.0,
    };
    let at = solved(&linkage, 0.3);
    let options = Options::default();
    solver.solve(&at, motion, &options, &mut w).unwrap();
    // The second wheel accelerates backwards, so the force along its coordinate is negative.
    let wanted = -moment * 9.0 * 0.04 / radius / radius;
    let found = solver.coupling_force(0, &w).size;
    assert!(close(found, wanted, 1e-12, 0.0), "{found} {wanted}");
    // Its bearing carries the force of the teeth.
    let [_, y] = solver.force(1, &w);
    assert!(close(y.abs(), wanted.abs(), 1e-12, 0.0), "{y}");
}

#[test]
fn friction_of_the_pairs_takes_what_the_driver_gives_more() {
    for (name, spec) in all() {
        let spec = with_friction(spec, 0.05);
        let linkage = Linkage::new(spec).unwrap();
        let solver = Kinetostatics::new(linkage.spec()).unwrap();
        let mut w = solver.workspace();
        let coordinate = interior(&linkage, 0.37);
        let (speed, acceleration) = (1.7, -2.3);
        let motion = InputMotion {
            coordinate,
            speed,
            acceleration,
        };
        let at = solved(&linkage, coordinate);
        let options = Options::default();
        solver.solve(&at, motion, &options, &mut w).unwrap();
        let balance = solver.balance(&w);
        assert!(
            balance.loss > 0.0 && balance.residual < 1e-9,
            "{name}: {balance:?}"
        );
        let drive = w.driver_force();
        let back = solver.accelerate(&at, coordinate, speed, drive, &options, &mut w);
        let Outcome::Moves {
            acceleration: found,
        } = back.unwrap().outcome
        else {
            panic!("{name} stands");
        };
        assert!(close(found, acceleration, 1e-8, 1e-9), "{name}: {found}");
    }
}
