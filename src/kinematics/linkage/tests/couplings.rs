//! Gears, belts and racks: closed forms, Willis' equation, virtual power, equilibrium of the whole.

mod forces;

use super::examples::{Builder, GROUND};
use super::support::{closure_error, compare_with_differences, interior, linkage, solved, weighed};
use crate::kinematics::linkage::joints::{belt::Belt, gear::Gear, rack::Rack};
use crate::kinematics::linkage::spec::{CouplingKind, LinkageSpec};
use crate::kinematics::linkage::{GroupKind, Linkage};

const CRANK: Option<usize> = Some(0);

/// Cranks of 0.2 m about (0, 0) and 0.15 m about (0.6, 0), rods of 0.7 and 0.8 m: a five-bar whose
/// cranks are geared.
fn five_bar(ratio: f64) -> Builder {
    let (rod, coupler, second) = (Some(1), Some(2), Some(3));
    Builder::new(&["crank", "rod", "coupler", "second"])
        .pin((GROUND, [0.0; 2]), (CRANK, [0.0; 2]))
        .pin((CRANK, [0.2, 0.0]), (rod, [0.0; 2]))
        .pin((rod, [0.7, 0.0]), (coupler, [0.8, 0.0]))
        .pin((second, [0.15, 0.0]), (coupler, [0.0; 2]))
        .pin((second, [0.0; 2]), (GROUND, [0.6, 0.0]))
        .couple(
            [CRANK, second],
            GROUND,
            CouplingKind::Gear(Gear { ratio }),
            0.4,
        )
}

#[test]
fn a_geared_five_bar_is_the_meeting_of_two_circles() {
    let linkage = linkage(five_bar(-0.5));
    let structure = linkage.structure();
    assert_eq!(structure.mobility, 1);
    assert_eq!(structure.groups[1].kind, GroupKind::Newton { links: 1 });
    let described = "geared link: second (pair p4, coupling c0)";
    assert_eq!(structure.describe(1), described);
    // After two turns everything repeats.
    assert_eq!(linkage.range().period.map(|period| period.turns), Some(2));
    for k in 0..60 {
        let q = -9.0 + 0.61 * f64::from(k);
        let workspace = solved(&linkage, q);
        assert!(closure_error(&linkage, &workspace) < 1e-13);
        let other = 0.4 - 0.5 * q;
        assert!((workspace.angle(3) - other).abs() < 1e-13, "{q}");
        let (sin, cos) = other.sin_cos();
        let meeting = meeting(
            [0.2 * q.cos(), 0.2 * q.sin()],
            [0.6 + 0.15 * cos, 0.15 * sin],
            [0.7, 0.8],
        );
        let [x, y] = workspace.pose(1).to_ground([0.7, 0.0]);
        let off = (x - meeting[0]).hypot(y - meeting[1]);
        assert!(off < 1e-13, "{q}: off by {off}");
    }
}

/// Where circles about `a` and `b` meet, to the left of the way from one to the other.
fn meeting(a: [f64; 2], b: [f64; 2], [one, other]: [f64; 2]) -> [f64; 2] {
    let [dx, dy] = [b[0] - a[0], b[1] - a[1]];
    let apart = dx.hypot(dy);
    let along = (one * one - other * other + apart * apart) / (2.0 * apart);
    let across = (one * one - along * along).sqrt();
    [
        a[0] + (along * dx - across * dy) / apart,
        a[1] + (along * dy + across * dx) / apart,
    ]
}

/// The driven arm carries a planet, which rolls on a wheel of the ground.
fn rolling(ratio: f64) -> Builder {
    let (arm, planet) = (CRANK, Some(1));
    Builder::new(&["arm", "planet"])
        .pin((GROUND, [0.1, 0.2]), (arm, [0.0; 2]))
        .pin((arm, [0.3, 0.0]), (planet, [0.0; 2]))
        .couple(
            [GROUND, planet],
            arm,
            CouplingKind::Gear(Gear { ratio }),
            0.0,
        )
}

#[test]
fn a_point_of_a_planet_draws_a_cycloid() {
    // On the outside of a wheel of three times its size, on the inside of one of four times.
    for (ratio, turns) in [(-3.0, 4.0), (4.0, -3.0)] {
        let linkage = linkage(rolling(ratio));
        assert_eq!(linkage.range().period.map(|period| period.turns), Some(1));
        for k in 0..40 {
            let q = 0.37 * f64::from(k);
            let workspace = solved(&linkage, q);
            assert!((workspace.angle(1) - turns * q).abs() < 1e-12, "{q}");
            let [x, y] = workspace.pose(1).to_ground([0.1, 0.0]);
            let (sin, cos) = (turns * q).sin_cos();
            let wanted = [
                0.1 + 0.3 * q.cos() + 0.1 * cos,
                0.2 + 0.3 * q.sin() + 0.1 * sin,
            ];
            let off = (x - wanted[0]).hypot(y - wanted[1]);
            assert!(off < 1e-13, "{q}: off by {off}");
        }
    }
}

/// Teeth of sun, planet and ring; the sun is driven, the ring stands, the carrier turns on the
/// sun's own axis.
const TEETH: [f64; 3] = [24.0, 18.0, 60.0];

fn planetary() -> Builder {
    let (sun, planet, carrier) = (CRANK, Some(1), Some(2));
    let [s, p, r] = TEETH;
    Builder::new(&["sun", "planet", "carrier"])
        .pin((GROUND, [0.0; 2]), (sun, [0.0; 2]))
        .pin((sun, [0.0; 2]), (carrier, [0.0; 2]))
        .pin((carrier, [0.21, 0.0]), (planet, [0.0; 2]))
        .couple(
            [sun, planet],
            carrier,
            CouplingKind::Gear(Gear { ratio: -s / p }),
            0.0,
        )
        .couple(
            [GROUND, planet],
            carrier,
            CouplingKind::Gear(Gear { ratio: r / p }),
            0.0,
        )
}

#[test]
fn a_planetary_gear_obeys_willis() {
    let linkage = linkage(planetary());
    let structure = linkage.structure();
    let described = "group of 2 links: planet, carrier (pairs p1, p2, couplings c0, c1)";
    assert_eq!(structure.describe(1), described);
    // Seven turns of the sun are two of the carrier; of the planet only three times as many are whole.
    assert_eq!(linkage.range().period.map(|period| period.turns), Some(21));
    let [s, p, r] = TEETH;
    for k in 0..40 {
        let q = -30.0 + 1.7 * f64::from(k);
        let workspace = solved(&linkage, q);
        let carrier = q * s / (s + r);
        assert!((workspace.angle(2) - carrier).abs() < 1e-12, "{q}");
        let planet = carrier - (q - carrier) * s / p;
        assert!((workspace.angle(1) - planet).abs() < 1e-12, "{q}");
        assert!((workspace.transfer(2, 1)[2] - s / (s + r)).abs() < 1e-14);
    }
}

#[test]
fn a_gear_train_that_does_not_repeat_soon_turns_for_ever() {
    let (sun, planet, carrier) = (CRANK, Some(1), Some(2));
    let (s, p, r) = (23.0, 31.0, 85.0);
    let spec = Builder::new(&["sun", "planet", "carrier"])
        .pin((GROUND, [0.0; 2]), (sun, [0.0; 2]))
        .pin((GROUND, [0.0; 2]), (carrier, [0.0; 2]))
        .pin((carrier, [0.21, 0.0]), (planet, [0.0; 2]))
        .couple(
            [sun, planet],
            carrier,
            CouplingKind::Gear(Gear { ratio: -s / p }),
            0.0,
        )
        .couple(
            [GROUND, planet],
            carrier,
            CouplingKind::Gear(Gear { ratio: r / p }),
            0.0,
        );
    let linkage = linkage(spec);
    assert_eq!(linkage.range().ends(), [f64::NEG_INFINITY, f64::INFINITY]);
    for q in [0.3, 1e3, -7e3, 2e5] {
        let workspace = solved(&linkage, q);
        let turned = q * s / (s + r);
        let near = 1e-15 * q.abs() + 1e-12;
        assert!((workspace.angle(2) - turned).abs() < 4.0 * near, "{q}");
        let planet = turned - (q - turned) * s / p;
        assert!((workspace.angle(1) - planet).abs() < 4.0 * near, "{q}");
    }
}

#[test]
fn what_may_come_to_an_end_is_not_taken_for_endless() {
    // The rods of this five-bar are never at the same angle again, and may be in line some time.
    let linkage = linkage(five_bar(-97.0 / 101.0));
    assert!(linkage.range().ends().iter().all(|end| end.is_finite()));
}

/// Crank and connecting rod swing a lever with a gear, which moves a rack on an inclined guide.
fn rack() -> Builder {
    let (rod, lever, rack) = (Some(1), Some(2), Some(3));
    Builder::new(&["crank", "rod", "lever", "rack"])
        .pin((GROUND, [0.0; 2]), (CRANK, [0.0; 2]))
        .pin((CRANK, [0.1, 0.0]), (rod, [0.0; 2]))
        .pin((lever, [0.25, 0.0]), (rod, [0.4, 0.0]))
        .pin((GROUND, [0.45, 0.1]), (lever, [0.0; 2]))
        .slide((GROUND, [0.45, 0.0]), (rack, [0.0; 2]), 0.3, 0.0)
        .couple(
            [lever, rack],
            GROUND,
            CouplingKind::Rack(Rack { radius: 0.08 }),
            0.01,
        )
}

#[test]
fn a_rack_slides_by_the_arc_of_its_gear() {
    let linkage = linkage(rack());
    for k in 0..30 {
        let workspace = solved(&linkage, interior(&linkage, 0.02 + f64::from(k) / 31.0));
        assert!(closure_error(&linkage, &workspace) < 1e-13);
        let (gear, rack) = (workspace.pair(3), workspace.pair(4));
        assert!((rack.value - 0.01 - 0.08 * gear.value).abs() < 1e-14);
        assert!((rack.first - 0.08 * gear.first).abs() < 1e-13);
        assert!((rack.second - 0.08 * gear.second).abs() < 1e-12);
        assert!((rack.third - 0.08 * gear.third).abs() < 1e-11);
    }
}

/// A rack that lies on a swinging lever, its gear on the same lever: a handle that pulls out.
fn rack_on_a_lever() -> Builder {
    let (rod, lever, gear, rack) = (Some(1), Some(2), Some(3), Some(4));
    Builder::new(&["crank", "rod", "lever", "gear", "rack"])
        .pin((GROUND, [0.0; 2]), (CRANK, [0.0; 2]))
        .pin((CRANK, [0.1, 0.0]), (rod, [0.0; 2]))
        .pin((lever, [0.25, 0.0]), (rod, [0.4, 0.0]))
        .pin((GROUND, [0.45, 0.1]), (lever, [0.0; 2]))
        .pin((lever, [0.1, 0.02]), (gear, [0.0; 2]))
        .slide((rack, [0.0; 2]), (lever, [0.1, 0.07]), 0.2, 0.4)
        .couple(
            [GROUND, gear],
            lever,
            CouplingKind::Gear(Gear { ratio: -2.5 }),
            0.1,
        )
        .couple(
            [gear, rack],
            lever,
            CouplingKind::Rack(Rack { radius: -0.05 }),
            0.02,
        )
}

/// A belt from a pulley of the ground to one on a driven arm.
fn belt(second: f64) -> Builder {
    let (arm, pulley) = (CRANK, Some(1));
    let radii = [0.1, second];
    Builder::new(&["arm", "pulley"])
        .pin((GROUND, [0.0; 2]), (arm, [0.0; 2]))
        .pin((arm, [0.5, 0.1]), (pulley, [0.0; 2]))
        .couple(
            [GROUND, pulley],
            arm,
            CouplingKind::Belt(Belt { radii }),
            0.2,
        )
}

#[test]
fn a_belt_from_a_fixed_pulley_turns_the_one_on_an_arm() {
    for second in [0.16, -0.16, 0.1] {
        let linkage = linkage(belt(second));
        for k in 0..20 {
            let q = 0.5 * f64::from(k);
            // Seen from the arm the fixed pulley turns by −q. Of equal pulleys the second only shifts.
            let wanted = q - q * 0.1 / second + 0.2;
            let turned = solved(&linkage, q).angle(1);
            assert!((turned - wanted).abs() < 1e-12, "{second} {q}: {turned}");
        }
    }
}

fn all() -> [(&'static str, LinkageSpec); 8] {
    [
        ("five-bar", five_bar(-0.5)),
        ("five-bar with internal gears", five_bar(2.0)),
        ("outside", rolling(-3.0)),
        ("inside", rolling(4.0)),
        ("planetary gear", planetary()),
        ("rack", rack()),
        ("belt", belt(0.16)),
        ("crossed belt", belt(-0.16)),
    ]
    .map(|(name, builder)| (name, weighed(builder).0))
}

#[test]
fn transfer_functions_are_derivatives() {
    let specs = all().into_iter().map(|(_, spec)| spec);
    for spec in specs.chain([weighed(rack_on_a_lever()).0]) {
        let linkage = Linkage::new(spec).unwrap();
        for k in 0..7 {
            let q = interior(&linkage, 0.08 + f64::from(k) / 8.0);
            compare_with_differences(&linkage, q).unwrap();
        }
    }
}

/// What is wrong with a five-bar whose gears are changed.
fn refused(change: impl Fn(&mut LinkageSpec)) -> String {
    let mut spec = five_bar(-0.5).0;
    change(&mut spec);
    let faults = Linkage::new(spec).expect_err("it is refused");
    let line = |fault: &crate::fault::Fault| format!("{}: {}", fault.path, fault.message);
    faults.iter().map(line).collect::<Vec<_>>().join("; ")
}

#[test]
fn couplings_that_cannot_be_are_told() {
    let of_kind = |kind: CouplingKind| refused(|spec| spec.couplings[0].kind = kind.clone());
    let same = of_kind(CouplingKind::Gear(Gear { ratio: 1.0 }));
    assert!(
        same.contains("couplings.c0: internal gears of the same size"),
        "{same}"
    );
    let great = of_kind(CouplingKind::Gear(Gear { ratio: 1e9 }));
    assert!(great.contains("its ratio is 1e9"), "{great}");
    let radii = [0.1, 0.8];
    let big = of_kind(CouplingKind::Belt(Belt { radii }));
    assert!(big.contains("0.6 m apart, the radii take 0.7 m"), "{big}");
    let guide = of_kind(CouplingKind::Rack(Rack { radius: 0.1 }));
    assert!(
        guide.contains("no guide joins the rack `second` to the ground"),
        "{guide}"
    );
    let axis = refused(|spec| spec.couplings[0].wheels = [CRANK, Some(2)]);
    assert!(
        axis.contains("`coupler` does not turn about a point of the ground"),
        "{axis}"
    );
    let twice = refused(|spec| spec.couplings[0].wheels = [CRANK, CRANK]);
    assert!(twice.contains("`crank` occurs in it twice"), "{twice}");
    let named = refused(|spec| spec.couplings[0].name = "p4".to_owned());
    assert!(
        named.contains("couplings.p4: a pair or another coupling"),
        "{named}"
    );
    // A second pair of gears between the same wheels leaves no freedom.
    let more = refused(|spec| {
        let again = spec.couplings[0].clone();
        let name = "c1".to_owned();
        spec.couplings
            .push(crate::kinematics::linkage::spec::CouplingSpec { name, ..again });
    });
    assert!(more.contains("c0") && more.contains("c1"), "{more}");
    let one_axis = refused(|spec| spec.pairs[4].link.at = [0.0; 2]);
    assert!(
        one_axis.contains("both wheels turn about the same point"),
        "{one_axis}"
    );
}
