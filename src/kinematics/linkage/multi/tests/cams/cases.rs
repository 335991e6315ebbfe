//! Linkages of several inputs with cams on, and rollers at, every kind of link.

use crate::kinematics::cam::Surface;
use crate::kinematics::linkage::multi::spec::{InputCoordinate, MultiSpec};
use crate::kinematics::linkage::multi::tests::examples::{
    GROUND, at, bar, five_bar, guide, input, odd, output, pin,
};
use crate::kinematics::linkage::spec::{
    AssemblyChoice, AssemblySpec, CamPairSpec, CouplingKind, CouplingSpec, ForceLaw, ForceSpec,
    LinkSpec, LinkageSpec, OutputKind, PairSpec,
};
use crate::kinematics::linkage::tests::support::lift_table;
use crate::kinematics::motion::LawName;
use crate::kinematics::position::{CamSpec, PositionSpec};

/// Centre of the eccentric circle in the frame of the first crank.
pub(super) const CENTRE: [f64; 2] = [0.05, 0.02];
/// The roller in the frame of the lever.
pub(super) const ROLLER: [f64; 2] = [0.79, 0.05];
/// Radius of the pitch circle.
pub(super) const GAP: f64 = 0.23;

pub(super) fn sine(amplitude: f64, harmonic: f64) -> PositionSpec {
    PositionSpec::Sine {
        amplitude,
        harmonic,
        phase: 0.2,
        offset: 0.002,
    }
}

fn rise_and_return() -> PositionSpec {
    PositionSpec::Cam(CamSpec {
        lift: 0.02,
        rise: 2.0,
        dwell: 0.7,
        return_angle: 2.2,
        rise_law: LawName::Cycloidal.into(),
        return_law: LawName::Polynomial345.into(),
        phase: 0.3,
    })
}

fn cam(centre: [f64; 2], roller: [f64; 2], base_radius: f64) -> CamPairSpec {
    CamPairSpec {
        centre,
        roller,
        roller_radius: 0.02,
        base_radius,
        lift: None,
        direction: 0.4,
        sense: -1.0,
        surface: Surface::Disc,
    }
}

fn on_cam(name: &str, links: [Option<usize>; 2], cam: CamPairSpec) -> CouplingSpec {
    CouplingSpec {
        name: name.to_owned(),
        wheels: links,
        carrier: links[0],
        kind: CouplingKind::Cam(Box::new(cam)),
        offset: 0.0,
    }
}

fn angle(link: usize, angle: f64) -> AssemblySpec {
    AssemblySpec {
        link,
        choice: AssemblyChoice::Angle(angle),
    }
}

/// Links with their pairs, cams, and what stands at the start; the outputs are their angles and a
/// point of the last.
fn linkage(
    links: Vec<LinkSpec>,
    pairs: Vec<PairSpec>,
    couplings: Vec<CouplingSpec>,
    assembly: Vec<AssemblySpec>,
) -> LinkageSpec {
    let last = links.len() - 1;
    LinkageSpec {
        links,
        pairs,
        couplings,
        assembly,
        gravity: [0.3, -9.81],
        outputs: vec![
            output("angle", OutputKind::Angle { link: last }),
            output(
                "tip",
                OutputKind::Point {
                    point: at(Some(last), 0.3, 0.1),
                    direction: 0.4,
                },
            ),
        ],
        ..LinkageSpec::default()
    }
}

/// A crank carries the cam, the other one a lever with the roller.
fn two_cranks(cam: CamPairSpec) -> MultiSpec {
    MultiSpec {
        linkage: linkage(
            vec![odd("crank", 1.1), bar("servo", 0.1, 1.3), odd("lever", 0.9)],
            vec![
                pin("O", (GROUND, [0.0; 2]), (Some(0), [0.0; 2])),
                pin("P", (GROUND, [0.8, 0.1]), (Some(1), [0.0; 2])),
                pin("B", (Some(1), [0.1, 0.0]), (Some(2), [0.0; 2])),
            ],
            vec![on_cam("cam", [Some(0), Some(2)], cam)],
            vec![angle(2, 2.9)],
        ),
        inputs: vec![
            input("crank", InputCoordinate::Pair(0), 1.1),
            input("servo", InputCoordinate::Pair(1), 0.6),
        ],
    }
}

/// An eccentric circle.
pub(super) fn eccentric() -> MultiSpec {
    two_cranks(cam(CENTRE, ROLLER, GAP - 0.02))
}

/// The same with a lift.
pub(super) fn with_lift() -> MultiSpec {
    two_cranks(CamPairSpec {
        lift: Some(sine(0.006, 3.0)),
        ..cam(CENTRE, ROLLER, GAP - 0.02)
    })
}

/// A cam on a rod of a five-bar moves a slide: one group after the other.
fn on_a_rod() -> MultiSpec {
    let mut spec = five_bar();
    let linkage = &mut spec.linkage;
    linkage.links.push(odd("slide", 0.7));
    let up = std::f64::consts::FRAC_PI_2;
    linkage.pairs.push(guide(
        "track",
        (GROUND, [0.33, 0.0]),
        (Some(4), [0.0; 2]),
        [up, 0.1],
    ));
    let profile = CamPairSpec {
        lift: Some(lift_table()),
        sense: 1.0,
        ..cam([0.3, 0.05], [0.01, 0.0], 0.08)
    };
    linkage
        .couplings
        .push(on_cam("cam", [Some(1), Some(4)], profile));
    linkage.assembly.push(AssemblySpec {
        link: 4,
        choice: AssemblyChoice::Near {
            point: [0.0; 2],
            place: [0.33, 0.62],
        },
    });
    linkage
        .outputs
        .insert(0, output("slide", OutputKind::Pair { pair: 5 }));
    spec
}

/// Two levers that roll on each other's cams: all sides of both are found together.
fn on_each_other() -> MultiSpec {
    let one = CamPairSpec {
        lift: Some(sine(0.006, 2.0)),
        ..cam([0.3, 0.0], [0.48, -0.034], 0.13)
    };
    let other = CamPairSpec {
        lift: Some(lift_table()),
        sense: 1.0,
        ..cam([0.3, 0.0], [0.55, -0.096], 0.1)
    };
    MultiSpec {
        linkage: linkage(
            vec![
                bar("crank", 0.2, 1.1),
                bar("servo", 0.2, 1.3),
                odd("left", 0.9),
                odd("right", 0.8),
            ],
            vec![
                pin("O", (GROUND, [0.0; 2]), (Some(0), [0.0; 2])),
                pin("P", (GROUND, [0.8, 0.1]), (Some(1), [0.0; 2])),
                pin("A", (Some(0), [0.2, 0.0]), (Some(2), [0.0; 2])),
                pin("B", (Some(1), [0.2, 0.0]), (Some(3), [0.0; 2])),
            ],
            vec![
                on_cam("one", [Some(2), Some(3)], one),
                on_cam("other", [Some(3), Some(2)], other),
            ],
            vec![angle(2, 0.1), angle(3, 3.0)],
        ),
        inputs: vec![
            input("crank", InputCoordinate::Pair(0), 1.1),
            input("servo", InputCoordinate::Pair(1), 0.6),
        ],
    }
}

/// A cylinder on a crank, its rod with a cam that a roller of the other crank holds: the third
/// input lies inside the group; `reversed`: the roller is on the rod.
fn on_a_cylinder(reversed: bool) -> MultiSpec {
    let lift = Some(sine(0.004, 2.0));
    let (links, profile) = match reversed {
        false => ([Some(3), Some(1)], cam([0.1, 0.03], [0.2, 0.0], 0.1)),
        true => ([Some(1), Some(3)], cam([0.2, 0.0], [0.1, 0.03], 0.1)),
    };
    MultiSpec {
        linkage: linkage(
            vec![
                bar("crank", 0.2, 1.1),
                bar("servo", 0.2, 1.3),
                odd("barrel", 0.9),
                odd("rod", 0.8),
            ],
            vec![
                pin("O", (GROUND, [0.0; 2]), (Some(0), [0.0; 2])),
                pin("P", (GROUND, [0.8, 0.1]), (Some(1), [0.0; 2])),
                pin("A", (Some(0), [0.2, 0.0]), (Some(2), [0.0; 2])),
                guide("lift", (Some(2), [0.0; 2]), (Some(3), [0.0; 2]), [0.0, 0.0]),
            ],
            vec![on_cam("cam", links, CamPairSpec { lift, ..profile })],
            vec![angle(2, -0.12)],
        ),
        inputs: vec![
            input("crank", InputCoordinate::Pair(0), 1.1),
            input("lift", InputCoordinate::Pair(3), 0.72),
            input("servo", InputCoordinate::Pair(1), 0.6),
        ],
    }
}

/// A groove of a lever on a crank, which a carriage bears, runs along a roller of the ground.
fn along_the_ground() -> MultiSpec {
    let groove = CamPairSpec {
        lift: Some(rise_and_return()),
        surface: Surface::Groove,
        ..cam([0.5, 0.0], [0.659, 0.395], 0.1)
    };
    MultiSpec {
        linkage: linkage(
            vec![
                odd("carriage", 2.0),
                bar("crank", 0.2, 1.1),
                odd("lever", 0.9),
            ],
            vec![
                guide("track", (GROUND, [0.0; 2]), (Some(0), [0.0; 2]), [0.0, 0.0]),
                pin("O", (Some(0), [0.0; 2]), (Some(1), [0.0; 2])),
                pin("A", (Some(1), [0.2, 0.0]), (Some(2), [0.0; 2])),
            ],
            vec![on_cam("cam", [Some(2), GROUND], groove)],
            vec![angle(2, 0.2)],
        ),
        inputs: vec![
            input("crank", InputCoordinate::Pair(1), 1.1),
            input("track", InputCoordinate::Pair(0), 0.1),
        ],
    }
}

/// The linkage of scenarios/linkages/cam_with_adjusted_lever.
pub(super) fn adjusted() -> MultiSpec {
    let link = |name: &str, mass: f64, centre: [f64; 2], moment: f64| LinkSpec {
        name: name.to_owned(),
        mass,
        centre,
        moment,
        ..LinkSpec::default()
    };
    let profile = CamPairSpec {
        lift: Some(PositionSpec::Sine {
            amplitude: 0.005,
            harmonic: 2.0,
            phase: 0.0,
            offset: 0.0,
        }),
        roller_radius: 0.012,
        direction: 0.0,
        sense: 1.0,
        ..cam([0.0; 2], [0.08, 0.0], 0.04)
    };
    let closing = ForceSpec {
        name: "closing".to_owned(),
        law: ForceLaw::Couple {
            link: 2,
            couple: 1.5,
        },
    };
    let linkage = linkage(
        vec![
            link("cam", 0.5, [0.0; 2], 0.0008),
            link("arm", 0.2, [0.01, 0.0], 0.00002),
            link("lever", 0.3, [0.04, 0.002], 0.0003),
        ],
        vec![
            pin("O", (GROUND, [0.0; 2]), (Some(0), [0.0; 2])),
            pin("P", (GROUND, [0.11, 0.0]), (Some(1), [0.0; 2])),
            pin("B", (Some(1), [0.02, 0.0]), (Some(2), [0.0; 2])),
        ],
        vec![on_cam("K", [Some(0), Some(2)], profile)],
        vec![angle(2, 2.74)],
    );
    MultiSpec {
        linkage: LinkageSpec {
            gravity: [0.0, -9.80665],
            forces: vec![closing],
            ..linkage
        },
        inputs: vec![
            input("arm", InputCoordinate::Pair(1), 2.0),
            input("cam", InputCoordinate::Pair(0), 0.5),
        ],
    }
}

pub(in super::super) fn all() -> Vec<MultiSpec> {
    vec![
        eccentric(),
        with_lift(),
        adjusted(),
        on_a_rod(),
        on_each_other(),
        on_a_cylinder(false),
        on_a_cylinder(true),
        along_the_ground(),
    ]
}
