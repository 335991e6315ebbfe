//! Gears, belts and racks behind several inputs.

use super::MultiLinkage;
use super::examples::{GROUND, bar, guide, input, odd, output, pin};
use crate::kinematics::linkage::joints::{belt::Belt, gear::Gear, rack::Rack};
use crate::kinematics::linkage::multi::spec::{InputCoordinate, MultiSpec};
use crate::kinematics::linkage::spec::{
    AssemblyChoice, AssemblySpec, CouplingKind, CouplingSpec, LinkageSpec, OutputKind,
};

fn coupled(
    name: &str,
    wheels: [Option<usize>; 2],
    carrier: Option<usize>,
    kind: CouplingKind,
) -> CouplingSpec {
    CouplingSpec {
        name: name.to_owned(),
        wheels,
        carrier,
        kind,
        offset: 0.1,
    }
}

/// Teeth of sun, planet and ring.
const TEETH: [f64; 3] = [24.0, 18.0, 60.0];

/// Sun and ring are driven; the planet and its carrier are found together.
pub(super) fn planetary() -> MultiSpec {
    let (sun, ring, carrier, planet) = (Some(0), Some(1), Some(2), Some(3));
    let [s, p, r] = TEETH;
    let gear = |ratio| CouplingKind::Gear(Gear { ratio });
    MultiSpec {
        linkage: LinkageSpec {
            links: vec![
                odd("sun", 1.0),
                odd("ring", 2.0),
                odd("carrier", 1.5),
                odd("planet", 0.5),
            ],
            pairs: vec![
                pin("S", (GROUND, [0.1, 0.0]), (sun, [0.0, 0.0])),
                pin("R", (GROUND, [0.1, 0.0]), (ring, [0.0, 0.0])),
                pin("C", (GROUND, [0.1, 0.0]), (carrier, [0.0, 0.0])),
                pin("A", (carrier, [0.21, 0.0]), (planet, [0.0, 0.0])),
            ],
            couplings: vec![
                coupled("inner", [sun, planet], carrier, gear(-s / p)),
                coupled("outer", [ring, planet], carrier, gear(r / p)),
            ],
            gravity: [0.0, -9.81],
            outputs: vec![
                output("carrier", OutputKind::Angle { link: 2 }),
                output("planet", OutputKind::Angle { link: 3 }),
            ],
            ..LinkageSpec::default()
        },
        inputs: vec![
            input("ring", InputCoordinate::Pair(1), 0.3),
            input("sun", InputCoordinate::Pair(0), 0.7),
        ],
    }
}

/// A five-bar with two driven cranks; a gear on the rod's pin moves a rack along the other rod,
/// and a belt turns a pulley at its end.
pub(super) fn rack() -> MultiSpec {
    let (crank, servo, rod, coupler) = (Some(0), Some(1), Some(2), Some(3));
    let (slide, pulley) = (Some(4), Some(5));
    let track = guide(
        "track",
        (coupler, [0.3, 0.05]),
        (slide, [0.0, 0.0]),
        [0.4, 0.2],
    );
    MultiSpec {
        linkage: LinkageSpec {
            links: vec![
                bar("crank", 0.2, 1.1),
                bar("servo", 0.15, 1.3),
                bar("rod", 0.7, 0.9),
                bar("coupler", 0.7, 0.8),
                odd("slide", 0.6),
                odd("pulley", 0.4),
            ],
            pairs: vec![
                pin("O", (GROUND, [0.0, 0.0]), (crank, [0.0, 0.0])),
                pin("A", (crank, [0.2, 0.0]), (rod, [0.0, 0.0])),
                pin("C", (rod, [0.7, 0.0]), (coupler, [0.7, 0.0])),
                pin("B", (servo, [0.15, 0.0]), (coupler, [0.0, 0.0])),
                pin("P", (GROUND, [0.6, 0.0]), (servo, [0.0, 0.0])),
                track,
                pin("W", (rod, [0.3, 0.1]), (pulley, [0.0, 0.0])),
            ],
            couplings: vec![
                coupled(
                    "feed",
                    [rod, slide],
                    coupler,
                    CouplingKind::Rack(Rack { radius: 0.07 }),
                ),
                coupled(
                    "belt",
                    [crank, pulley],
                    rod,
                    CouplingKind::Belt(Belt {
                        radii: [0.05, -0.08],
                    }),
                ),
            ],
            assembly: vec![AssemblySpec {
                link: 2,
                choice: AssemblyChoice::Angle(1.0),
            }],
            gravity: [0.0, -9.81],
            outputs: vec![
                output("slide", OutputKind::Pair { pair: 5 }),
                output("pulley", OutputKind::Angle { link: 5 }),
            ],
            ..LinkageSpec::default()
        },
        inputs: vec![
            input("left", InputCoordinate::Pair(0), 1.1),
            input("right", InputCoordinate::Pair(4), 0.6),
        ],
    }
}

#[test]
fn a_planetary_gear_adds_the_turns_of_sun_and_ring() {
    let linkage = MultiLinkage::new(planetary()).unwrap();
    assert_eq!(linkage.structure().mobility, 2);
    let mut space = linkage.workspace::<f64>();
    let [s, p, r] = TEETH;
    let mut first = [0.0; 2];
    // Far apart, so that many turns lie between.
    for (ring, sun) in [(0.3, 0.7), (40.0, -3.0), (-25.0, 60.0), (0.3, 0.7)] {
        space.solve(&[ring, sun], &[0.0; 2]).unwrap();
        // planet − carrier = −s/p (sun − carrier) + 0.1 = r/p (ring − carrier) + 0.1
        let carrier = (s * sun + r * ring) / (s + r);
        let planet = carrier - (sun - carrier) * s / p + 0.1;
        let [found, _] = space.output(&OutputKind::Angle { link: 2 }, &mut first);
        approx::assert_abs_diff_eq!(found, carrier, epsilon = 1e-11);
        approx::assert_abs_diff_eq!(first[0], r / (s + r), epsilon = 1e-13);
        approx::assert_abs_diff_eq!(first[1], s / (s + r), epsilon = 1e-13);
        let [found, _] = space.output(&OutputKind::Angle { link: 3 }, &mut first);
        approx::assert_abs_diff_eq!(found, planet, epsilon = 1e-11);
    }
}

#[test]
fn a_rack_on_a_rod_follows_the_angle_between_both_rods() {
    let linkage = MultiLinkage::new(rack()).unwrap();
    let mut space = linkage.workspace::<f64>();
    let mut first = [0.0; 2];
    for k in 0..20 {
        let q = [1.1 + 0.09 * f64::from(k), 0.6 - 0.05 * f64::from(k)];
        space.solve(&q, &[0.0; 2]).unwrap();
        let mut angle = |link| space.output(&OutputKind::Angle { link }, &mut first)[0];
        let (crank, rod, coupler, pulley) = (angle(0), angle(2), angle(3), angle(5));
        let belt = pulley - rod - (crank - rod) * -0.05 / 0.08;
        approx::assert_abs_diff_eq!(belt, 0.1, epsilon = 1e-12);
        let [slid, _] = space.output(&OutputKind::Pair { pair: 5 }, &mut first);
        approx::assert_abs_diff_eq!(slid, 0.07 * (rod - coupler) + 0.1, epsilon = 1e-12);
    }
}
