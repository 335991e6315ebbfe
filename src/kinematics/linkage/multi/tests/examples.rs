//! Linkages of several inputs that cover every group, joint and force.

mod groups;

use crate::kinematics::linkage::multi::spec::{InputCoordinate, InputSpec, MultiSpec};
use crate::kinematics::linkage::spec::{
    AssemblyChoice, AssemblySpec, ForceLaw, ForceSpec, LinkSpec, LinkageSpec, OutputKind,
    OutputSpec, PairKind, PairSpec, PointOf,
};
use groups::dyads;
pub(in crate::kinematics::linkage::multi) use groups::platform;

pub(in super::super) const GROUND: Option<usize> = None;

/// A bar of length l along x, its mass in the middle.
pub(in super::super) fn bar(name: &str, length: f64, mass: f64) -> LinkSpec {
    LinkSpec {
        name: name.to_owned(),
        mass,
        centre: [0.5 * length, 0.0],
        moment: mass * length * length / 12.0,
        ..LinkSpec::default()
    }
}

/// A link of an odd shape.
pub(super) fn odd(name: &str, mass: f64) -> LinkSpec {
    LinkSpec {
        name: name.to_owned(),
        mass,
        centre: [0.11, -0.07],
        moment: 0.02 * mass,
        ..LinkSpec::default()
    }
}

pub(super) fn at(link: Option<usize>, x: f64, y: f64) -> PointOf {
    PointOf { link, at: [x, y] }
}

/// A pin between a point of one link and a point of another.
pub(in super::super) fn pin(
    name: &str,
    (on, p): (Option<usize>, [f64; 2]),
    (link, q): (Option<usize>, [f64; 2]),
) -> PairSpec {
    PairSpec {
        name: name.to_owned(),
        on: at(on, p[0], p[1]),
        link: at(link, q[0], q[1]),
        kind: PairKind::Revolute { diameter: 0.0 },
        friction: 0.0,
    }
}

pub(super) fn guide(
    name: &str,
    (on, p): (Option<usize>, [f64; 2]),
    (link, q): (Option<usize>, [f64; 2]),
    [direction, angle]: [f64; 2],
) -> PairSpec {
    PairSpec {
        kind: PairKind::Sliding {
            direction,
            angle,
            corners: [0.01, -0.01],
            half_height: 0.0,
        },
        ..pin(name, (on, p), (link, q))
    }
}

pub(in super::super) fn input(name: &str, coordinate: InputCoordinate, start: f64) -> InputSpec {
    InputSpec {
        name: name.to_owned(),
        coordinate,
        start,
    }
}

pub(super) fn output(name: &str, kind: OutputKind) -> OutputSpec {
    OutputSpec {
        name: name.to_owned(),
        kind,
    }
}

fn force(name: &str, law: ForceLaw) -> ForceSpec {
    ForceSpec {
        name: name.to_owned(),
        law,
    }
}

/// Two cranks and the two rods between them.
pub(in super::super) fn five_bar() -> MultiSpec {
    MultiSpec {
        linkage: LinkageSpec {
            links: vec![
                bar("crank", 0.3, 1.1),
                bar("left", 0.7, 0.9),
                bar("right", 0.6, 0.8),
                bar("servo", 0.25, 1.3),
            ],
            pairs: vec![
                pin("O", (GROUND, [0.0, 0.0]), (Some(0), [0.0, 0.0])),
                pin("A", (Some(0), [0.3, 0.0]), (Some(1), [0.0, 0.0])),
                pin("C", (Some(1), [0.7, 0.0]), (Some(2), [0.6, 0.0])),
                pin("B", (Some(3), [0.25, 0.0]), (Some(2), [0.0, 0.0])),
                pin("P", (GROUND, [0.8, 0.1]), (Some(3), [0.0, 0.0])),
            ],
            gravity: [0.3, -9.81],
            forces: vec![
                force(
                    "spring",
                    ForceLaw::Strut {
                        from: at(None, 0.2, 1.0),
                        to: at(Some(1), 0.4, 0.05),
                        rate: 220.0,
                        free_length: 0.3,
                        damping: 7.0,
                        force: 3.0,
                    },
                ),
                force(
                    "twist",
                    ForceLaw::Torsion {
                        pair: 2,
                        rate: 3.0,
                        free_angle: 1.0,
                        damping: 0.4,
                    },
                ),
                force(
                    "push",
                    ForceLaw::Force {
                        point: at(Some(2), 0.2, 0.1),
                        force: [4.0, -3.0],
                        follows: true,
                    },
                ),
                force(
                    "couple",
                    ForceLaw::Couple {
                        link: 3,
                        couple: 1.7,
                    },
                ),
            ],
            outputs: vec![
                output("angle", OutputKind::Angle { link: 2 }),
                output("own", OutputKind::Angle { link: 3 }),
                output(
                    "tip",
                    OutputKind::Point {
                        point: at(Some(1), 0.7, 0.2),
                        direction: 0.4,
                    },
                ),
                output("pin", OutputKind::Pair { pair: 2 }),
            ],
            ..LinkageSpec::default()
        },
        inputs: vec![
            input("crank", InputCoordinate::Pair(0), 1.1),
            input("servo", InputCoordinate::Pair(4), 0.6),
        ],
    }
}

/// A slider-crank on a frame that floats; the crank's pair is written the wrong way round.
pub(in super::super) fn floating() -> MultiSpec {
    MultiSpec {
        linkage: LinkageSpec {
            links: vec![
                odd("frame", 2.0),
                bar("crank", 0.1, 0.2),
                bar("rod", 0.3, 0.3),
                odd("slide", 0.4),
            ],
            pairs: vec![
                pin("O", (Some(1), [0.0, 0.0]), (Some(0), [0.02, 0.01])),
                pin("A", (Some(1), [0.1, 0.0]), (Some(2), [0.0, 0.0])),
                pin("B", (Some(2), [0.3, 0.0]), (Some(3), [0.0, 0.01])),
                guide(
                    "guide",
                    (Some(0), [0.0, -0.02]),
                    (Some(3), [0.01, 0.0]),
                    [0.1, 0.3],
                ),
            ],
            gravity: [0.0, -9.81],
            outputs: vec![
                output("way", OutputKind::Pair { pair: 3 }),
                output(
                    "x",
                    OutputKind::Point {
                        point: at(Some(3), 0.0, 0.0),
                        direction: 0.0,
                    },
                ),
            ],
            ..LinkageSpec::default()
        },
        inputs: vec![
            input("angle", InputCoordinate::Angle(0), 0.2),
            input("crank", InputCoordinate::Pair(0), -0.7),
            input("x", InputCoordinate::X(0), 0.05),
            input("y", InputCoordinate::Y(0), -0.03),
        ],
    }
}

/// A boom on a cylinder and an arm on it with a cylinder of its own, on a carriage: inputs
/// inside groups, and a guide written the wrong way round.
pub(in super::super) fn excavator() -> MultiSpec {
    MultiSpec {
        linkage: LinkageSpec {
            links: vec![
                odd("carriage", 5.0),
                odd("boom", 3.0),
                bar("barrel", 0.5, 0.6),
                bar("piston", 0.4, 0.3),
                odd("arm", 2.0),
                bar("barrel2", 0.4, 0.5),
                bar("piston2", 0.3, 0.2),
            ],
            pairs: vec![
                // Track: the carriage carries the guide, the ground the block.
                guide(
                    "track",
                    (Some(0), [0.0, 0.1]),
                    (GROUND, [0.0, 0.0]),
                    [0.0, 0.1],
                ),
                pin("hinge", (Some(0), [0.2, 0.1]), (Some(1), [0.0, 0.0])),
                pin("foot", (Some(0), [0.5, -0.1]), (Some(2), [0.0, 0.0])),
                guide(
                    "lift",
                    (Some(2), [0.0, 0.0]),
                    (Some(3), [0.0, 0.0]),
                    [0.0, 0.0],
                ),
                pin("eye", (Some(3), [0.1, 0.0]), (Some(1), [0.6, -0.1])),
                pin("elbow", (Some(1), [1.2, 0.0]), (Some(4), [0.0, 0.0])),
                pin("foot2", (Some(1), [0.5, 0.2]), (Some(5), [0.0, 0.0])),
                guide(
                    "crowd",
                    (Some(5), [0.0, 0.0]),
                    (Some(6), [0.0, 0.0]),
                    [0.0, 0.0],
                ),
                pin("eye2", (Some(6), [0.1, 0.0]), (Some(4), [-0.2, 0.1])),
            ],
            assembly: vec![
                AssemblySpec {
                    link: 1,
                    choice: AssemblyChoice::Angle(0.7),
                },
                AssemblySpec {
                    link: 4,
                    choice: AssemblyChoice::Angle(-0.3),
                },
            ],
            gravity: [0.0, -9.81],
            outputs: vec![
                output("boom", OutputKind::Angle { link: 1 }),
                output(
                    "tip",
                    OutputKind::Point {
                        point: at(Some(4), 0.8, 0.0),
                        direction: 1.2,
                    },
                ),
                output("eye", OutputKind::Pair { pair: 8 }),
            ],
            ..LinkageSpec::default()
        },
        inputs: vec![
            input("crowd", InputCoordinate::Pair(7), 0.45),
            input("lift", InputCoordinate::Pair(3), 0.5),
            input("track", InputCoordinate::Pair(0), 0.3),
        ],
    }
}

/// A chain of bars on pins.
pub(in super::super) fn pendulum(count: usize) -> MultiSpec {
    let mut linkage = LinkageSpec {
        gravity: [0.0, -9.80665],
        ..LinkageSpec::default()
    };
    let mut inputs = Vec::new();
    for index in 0..count {
        linkage
            .links
            .push(bar(&format!("bar{index}"), 0.5, 1.0 + 0.1 * index as f64));
        let before = match index {
            0 => (GROUND, [0.0, 0.0]),
            _ => (Some(index - 1), [0.5, 0.0]),
        };
        let name = format!("pin{index}");
        linkage
            .pairs
            .push(pin(&name, before, (Some(index), [0.0, 0.0])));
        inputs.push(input(
            &name,
            InputCoordinate::Pair(index),
            0.3 - 0.2 * index as f64,
        ));
    }
    linkage.outputs.push(output(
        "tip",
        OutputKind::Point {
            point: at(Some(count - 1), 0.5, 0.0),
            direction: 0.9,
        },
    ));
    MultiSpec { linkage, inputs }
}

pub(in super::super) fn all() -> Vec<MultiSpec> {
    let mut all = vec![five_bar(), floating(), excavator(), platform(), pendulum(4)];
    all.extend(dyads());
    all.extend([super::geared::planetary(), super::geared::rack()]);
    all.extend(super::cams::all());
    all.extend(super::cut::all().into_iter().map(|one| one.cut));
    all
}
