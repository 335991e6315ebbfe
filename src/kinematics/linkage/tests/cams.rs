//! Cams: closed forms, pitch curves drawn independently, differences, what is refused.

mod forces;
mod refusals;

use super::examples::{Builder, GROUND, four_bar};
use super::support::{
    closure_error, compare_with_differences, interior, lift_table, linkage, solved, weighed,
};
use crate::kinematics::cam::Surface;
use crate::kinematics::linkage::spec::{
    AssemblyChoice, CamPairSpec, CouplingKind, LinkageSpec, OutputKind,
};
use crate::kinematics::linkage::{GroupKind, Linkage};
use crate::kinematics::motion::LawName;
use crate::kinematics::position::{CamSpec, PositionSpec};

const CAM: Option<usize> = Some(0);
const LEVER: Option<usize> = Some(1);

/// A circle of 0.05 m with a roller of 0.01 m, its centre where the cam's frame has its own.
fn circle(roller: [f64; 2]) -> CamPairSpec {
    CamPairSpec {
        centre: [0.0; 2],
        roller,
        roller_radius: 0.01,
        base_radius: 0.05,
        lift: None,
        direction: 0.0,
        sense: 1.0,
        surface: Surface::Disc,
    }
}

fn with_lift(roller: [f64; 2], lift: PositionSpec) -> CamPairSpec {
    CamPairSpec {
        lift: Some(lift),
        direction: 0.4,
        sense: -1.0,
        ..circle(roller)
    }
}

impl Builder {
    /// A cam of one link, a roller of another.
    fn cam(self, links: [Option<usize>; 2], cam: CamPairSpec) -> Self {
        self.couple(links, links[0], CouplingKind::Cam(Box::new(cam)), 0.0)
    }
}

/// A cam about the origin and a lever about (0.1, 0) with its roller at 0.08 m.
fn cam_and_lever(cam: CamPairSpec) -> Builder {
    Builder::new(&["cam", "lever"])
        .pin((GROUND, [0.0; 2]), (CAM, [0.0; 2]))
        .pin((GROUND, [0.1, 0.0]), (LEVER, [0.0; 2]))
        .cam([CAM, LEVER], cam)
        .choose(1, AssemblyChoice::Angle(2.3))
        .output(OutputKind::Angle { link: 1 })
}

const ROLLER: [f64; 2] = [0.08, 0.0];

fn eccentric() -> Builder {
    cam_and_lever(CamPairSpec {
        centre: [0.015, 0.004],
        ..circle(ROLLER)
    })
}

fn sine() -> Builder {
    let lift = PositionSpec::Sine {
        amplitude: 0.004,
        harmonic: 3.0,
        phase: 0.2,
        offset: 0.002,
    };
    cam_and_lever(with_lift(ROLLER, lift))
}

fn rise_and_return(law: LawName) -> PositionSpec {
    PositionSpec::Cam(CamSpec {
        lift: 0.02,
        rise: 2.0,
        dwell: 0.7,
        return_angle: 2.2,
        rise_law: law.into(),
        return_law: LawName::Cycloidal.into(),
        phase: 0.3,
    })
}

/// A cam fixed to the coupler of a four-bar moves a slide on the ground.
fn on_a_coupler() -> Builder {
    let slide = Some(3);
    let lift = PositionSpec::Sine {
        amplitude: 0.01,
        harmonic: 2.0,
        phase: 0.0,
        offset: 0.0,
    };
    let cam = CamPairSpec {
        centre: [0.2, 0.05],
        roller: [0.01, -0.02],
        base_radius: 0.08,
        ..with_lift([0.0; 2], lift)
    };
    let mut builder = four_bar([0.1, 0.4, 0.3, 0.35]).choose(1, AssemblyChoice::Branch(1.0));
    builder
        .0
        .links
        .push(crate::kinematics::linkage::spec::LinkSpec {
            name: "slide".to_owned(),
            ..Default::default()
        });
    builder
        .slide((GROUND, [0.15, 0.0]), (slide, [0.0; 2]), 1.5, 0.0)
        .cam([Some(1), slide], cam)
        .choose(
            3,
            AssemblyChoice::Near {
                point: [0.0; 2],
                place: [0.17, 0.26],
            },
        )
}

/// The roller of a lever, hung on the crank, runs along a cam of the ground.
fn on_the_ground() -> Builder {
    let lift = PositionSpec::Sine {
        amplitude: 0.02,
        harmonic: 2.0,
        phase: 0.1,
        offset: 0.0,
    };
    let cam = CamPairSpec {
        centre: [0.02, 0.01],
        base_radius: 0.2,
        ..with_lift([0.15, 0.0], lift)
    };
    Builder::new(&["crank", "lever"])
        .pin((GROUND, [0.0; 2]), (CAM, [0.0; 2]))
        .pin((CAM, [0.13, 0.0]), (LEVER, [0.0; 2]))
        .cam([GROUND, LEVER], cam)
        .choose(1, AssemblyChoice::Angle(0.8))
        .output(OutputKind::Angle { link: 1 })
}

/// The crank carries the roller, which moves a lever with a groove.
fn driven_by_the_roller() -> Builder {
    let cam = CamPairSpec {
        centre: [0.25, 0.0],
        surface: Surface::Groove,
        base_radius: 0.12,
        ..with_lift([0.05, 0.0], lift_table())
    };
    Builder::new(&["crank", "lever"])
        .pin((GROUND, [0.0; 2]), (CAM, [0.0; 2]))
        .pin((GROUND, [0.3, 0.0]), (LEVER, [0.0; 2]))
        .cam([LEVER, CAM], cam)
        .choose(1, AssemblyChoice::Angle(2.6))
}

/// A cylinder between two links that move: both sides of the driver carry something.
fn between_driven_links() -> Builder {
    let (barrel, rod, lever) = (Some(0), Some(1), Some(2));
    let cam = CamPairSpec {
        centre: [0.02, 0.03],
        base_radius: 0.08,
        ..circle([0.0, 0.12])
    };
    let mut builder = Builder::new(&["barrel", "rod", "lever"])
        .slide((barrel, [0.1, 0.0]), (rod, [0.0; 2]), 0.0, 0.0)
        .pin((GROUND, [0.0; 2]), (barrel, [0.0; 2]))
        .pin((rod, [0.1, 0.0]), (lever, [0.15, 0.0]))
        .pin((GROUND, [0.25, -0.1]), (lever, [0.0; 2]))
        .choose(2, AssemblyChoice::Angle(1.6))
        .start(0.05);
    builder
        .0
        .links
        .push(crate::kinematics::linkage::spec::LinkSpec {
            name: "follower".to_owned(),
            ..Default::default()
        });
    builder.0.travel = Some([0.03, 0.09]);
    builder
        .pin((GROUND, [0.3, 0.2]), (Some(3), [0.0; 2]))
        .cam([Some(1), Some(3)], cam)
        .choose(3, AssemblyChoice::Angle(2.0))
}

fn all() -> Vec<(&'static str, LinkageSpec)> {
    [
        ("eccentric", eccentric()),
        ("sine", sine()),
        (
            "rise and return",
            cam_and_lever(with_lift(ROLLER, rise_and_return(LawName::Cycloidal))),
        ),
        ("table", cam_and_lever(with_lift(ROLLER, lift_table()))),
        ("on a coupler", on_a_coupler()),
        ("on the ground", on_the_ground()),
        ("driven by the roller", driven_by_the_roller()),
        ("between driven links", between_driven_links()),
    ]
    .map(|(name, builder)| (name, weighed(builder).0))
    .into()
}

#[test]
fn an_eccentric_circle_is_a_four_bar() {
    let linkage = linkage(eccentric());
    let structure = linkage.structure();
    assert_eq!(structure.mobility, 1);
    assert_eq!(structure.groups[1].kind, GroupKind::Newton { links: 1 });
    let described = "link on a cam: lever (pair p1, coupling c0)";
    assert_eq!(structure.describe(1), described);
    assert_eq!(linkage.range().period.map(|period| period.turns), Some(1));
    for k in 0..80 {
        let q = -9.0 + 0.31 * f64::from(k);
        let workspace = solved(&linkage, q);
        assert!(closure_error(&linkage, &workspace) < 1e-14);
        let [x, y] = workspace.pose(1).to_ground(ROLLER);
        let (sin, cos) = q.sin_cos();
        let centre = [0.015 * cos - 0.004 * sin, 0.015 * sin + 0.004 * cos];
        // Circles about both centres: law of cosines at the lever's pin.
        let (dx, dy) = (centre[0] - 0.1, centre[1]);
        let apart = dx.hypot(dy);
        let (lever, arm) = (ROLLER[0], 0.06);
        let inner = ((lever * lever + apart * apart - arm * arm) / (2.0 * lever * apart)).acos();
        let angle = dy.atan2(dx) - inner;
        let wanted = [0.1 + lever * angle.cos(), lever * angle.sin()];
        let off = (x - wanted[0]).hypot(y - wanted[1]);
        assert!(off < 1e-13, "{q}: off by {off}");
    }
}

#[test]
fn rollers_stay_on_their_pitch_curves() {
    for (name, spec) in all() {
        let linkage = Linkage::new(spec).unwrap_or_else(|faults| panic!("{name}: {faults:?}"));
        for k in 0..40 {
            let q = interior(&linkage, 0.01 + f64::from(k) / 41.0);
            let error = closure_error(&linkage, &solved(&linkage, q));
            assert!(error < 1e-13, "{name} at {q}: {error}");
        }
    }
}

#[test]
fn transfer_functions_are_derivatives() {
    for (name, spec) in all() {
        let linkage = Linkage::new(spec).unwrap();
        for k in 0..7 {
            let q = interior(&linkage, 0.08 + f64::from(k) / 8.0);
            compare_with_differences(&linkage, q).unwrap_or_else(|wrong| panic!("{name}: {wrong}"));
        }
    }
}

#[test]
fn a_roller_above_the_axis_rises_as_the_lift_says() {
    // A slide straight above the axis: its place is the radius that is under it.
    let slide = Some(1);
    let lift = rise_and_return(LawName::Polynomial345);
    let builder = Builder::new(&["cam", "slide"])
        .pin((GROUND, [0.0; 2]), (CAM, [0.0; 2]))
        .slide(
            (GROUND, [0.0; 2]),
            (slide, [0.0; 2]),
            std::f64::consts::FRAC_PI_2,
            0.0,
        )
        .cam([CAM, slide], with_lift([0.0; 2], lift.clone()))
        .choose(
            1,
            AssemblyChoice::Near {
                point: [0.0; 2],
                place: [0.0, 0.07],
            },
        );
    let linkage = linkage(builder);
    let law = crate::kinematics::position::Position::new(&lift).unwrap();
    for k in 0..90 {
        let q = 0.21 * f64::from(k);
        // Counted clockwise from 0.4 rad: what is under the roller grows with the cam's angle.
        let phi = q - std::f64::consts::FRAC_PI_2 + 0.4;
        let wanted = law.jet(law.breaks().segment_at(phi, 1.0), phi);
        let found = solved(&linkage, q).pair(1);
        assert!((found.value - 0.06 - wanted.value).abs() < 1e-14, "{q}");
        assert!((found.first - wanted.first).abs() < 1e-13, "{q}");
        assert!((found.second - wanted.second).abs() < 1e-12, "{q}");
        assert!((found.third - wanted.third).abs() < 1e-11, "{q}");
    }
}
