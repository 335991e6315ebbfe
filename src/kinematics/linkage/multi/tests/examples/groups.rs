//! Groups of every kind behind several inputs.

use super::{GROUND, bar, guide, input, odd, output, pin};
use crate::kinematics::linkage::multi::spec::{InputCoordinate, MultiSpec};
use crate::kinematics::linkage::spec::{
    AssemblyChoice, AssemblySpec, LinkSpec, LinkageSpec, OutputKind, PairSpec,
};

/// Every further form of dyad behind two inputs: RPR, RRP, PRP, RPP.
pub(super) fn dyads() -> Vec<MultiSpec> {
    let base = |rest: Vec<PairSpec>, links: [LinkSpec; 2]| {
        let mut pairs = vec![
            pin("O", (GROUND, [0.0, 0.0]), (Some(0), [0.0, 0.0])),
            guide("Q", (GROUND, [0.9, 0.0]), (Some(1), [0.0, 0.0]), [0.3, 0.2]),
        ];
        pairs.extend(rest);
        let [one, other] = links;
        MultiSpec {
            linkage: LinkageSpec {
                links: vec![bar("crank", 0.3, 1.0), odd("ram", 0.7), one, other],
                pairs,
                gravity: [0.0, -9.81],
                outputs: vec![output("angle", OutputKind::Angle { link: 2 })],
                ..LinkageSpec::default()
            },
            inputs: vec![
                input("crank", InputCoordinate::Pair(0), 0.9),
                input("ram", InputCoordinate::Pair(1), 0.15),
            ],
        }
    };
    let links = || [odd("one", 0.8), odd("other", 0.9)];
    let crank = (Some(0), [0.3, 0.0]);
    let ram = (Some(1), [0.05, 0.1]);
    let (one, other) = (Some(2), Some(3));
    vec![
        // A block on a swinging guide.
        base(
            vec![
                pin("A", crank, (one, [0.0, 0.0])),
                guide("S", (one, [0.0, 0.05]), (other, [0.0, 0.02]), [0.1, 0.2]),
                pin("B", (other, [0.03, 0.01]), ram),
            ],
            links(),
        ),
        // A rod to a block on the ram's guide.
        base(
            vec![
                pin("A", crank, (one, [0.0, 0.0])),
                pin("B", (one, [0.9, 0.1]), (other, [0.1, 0.0])),
                guide("S", ram, (other, [0.0, 0.0]), [1.2, -0.1]),
            ],
            links(),
        ),
        // Two blocks on the guides of crank and ram, pinned together.
        base(
            vec![
                guide("R", crank, (one, [0.0, 0.02]), [0.2, 0.1]),
                pin("B", (one, [0.1, 0.1]), (other, [0.1, 0.0])),
                guide("S", (other, [0.0, 0.0]), ram, [1.2, -0.1]),
            ],
            links(),
        ),
        // A cross slide.
        base(
            vec![
                pin("A", crank, (one, [0.02, 0.0])),
                guide("R", (one, [0.0, 0.1]), (other, [0.0, 0.02]), [0.4, 0.1]),
                guide("S", ram, (other, [0.1, 0.0]), [1.5, 0.3]),
            ],
            links(),
        ),
    ]
}

/// A platform on three legs, two of their pins driven and the third ground on a carriage: a
/// group of four links that are found together.
pub(in crate::kinematics::linkage::multi) fn platform() -> MultiSpec {
    MultiSpec {
        linkage: LinkageSpec {
            links: vec![
                odd("platform", 3.0),
                bar("rod1", 0.8, 0.4),
                bar("rod2", 0.9, 0.5),
                bar("rod3", 0.85, 0.6),
                bar("crank1", 0.4, 0.7),
                bar("crank2", 0.35, 0.7),
                odd("carriage", 1.0),
            ],
            pairs: vec![
                pin("O1", (GROUND, [0.0, 0.0]), (Some(4), [0.0, 0.0])),
                pin("O2", (GROUND, [1.5, 0.0]), (Some(5), [0.0, 0.0])),
                guide(
                    "track",
                    (GROUND, [0.7, 1.6]),
                    (Some(6), [0.0, 0.0]),
                    [0.1, 0.0],
                ),
                pin("A1", (Some(4), [0.4, 0.0]), (Some(1), [0.0, 0.0])),
                pin("A2", (Some(5), [0.35, 0.0]), (Some(2), [0.0, 0.0])),
                pin("A3", (Some(6), [0.0, 0.0]), (Some(3), [0.0, 0.0])),
                pin("B1", (Some(1), [0.8, 0.0]), (Some(0), [0.0, 0.0])),
                pin("B2", (Some(2), [0.9, 0.0]), (Some(0), [0.5, 0.0])),
                pin("B3", (Some(3), [0.85, 0.0]), (Some(0), [0.2, 0.4])),
            ],
            assembly: vec![AssemblySpec {
                link: 0,
                choice: AssemblyChoice::Near {
                    point: [0.2, 0.1],
                    place: [0.7, 0.8],
                },
            }],
            gravity: [0.0, -9.81],
            outputs: vec![output("angle", OutputKind::Angle { link: 0 })],
            ..LinkageSpec::default()
        },
        inputs: vec![
            input("one", InputCoordinate::Pair(0), 1.3),
            input("three", InputCoordinate::Pair(2), 0.0),
            input("two", InputCoordinate::Pair(1), 1.8),
        ],
    }
}
