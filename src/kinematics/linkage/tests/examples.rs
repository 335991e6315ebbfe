//! Linkages to test with.

use crate::kinematics::linkage::spec::{
    AssemblyChoice, AssemblySpec, CouplingKind, CouplingSpec, ForceLaw, ForceSpec, LinkSpec,
    LinkageSpec, OutputKind, OutputSpec, PairKind, PairSpec, PointOf,
};

/// The ground.
pub(super) const GROUND: Option<usize> = None;

/// Adds to a linkage, piece by piece.
#[derive(Clone, Debug, Default)]
pub(super) struct Builder(pub(super) LinkageSpec);

impl Builder {
    pub(super) fn new(links: &[&str]) -> Self {
        let links = links.iter().map(|name| LinkSpec {
            name: (*name).to_owned(),
            ..LinkSpec::default()
        });
        Self(LinkageSpec {
            links: links.collect(),
            ..LinkageSpec::default()
        })
    }

    pub(super) fn pin(
        mut self,
        on: (Option<usize>, [f64; 2]),
        link: (Option<usize>, [f64; 2]),
    ) -> Self {
        let kind = PairKind::Revolute { diameter: 0.0 };
        self.pair(on, link, kind);
        self
    }

    /// A guide on link i along `direction` through its point.
    pub(super) fn slide(
        mut self,
        on: (Option<usize>, [f64; 2]),
        link: (Option<usize>, [f64; 2]),
        direction: f64,
        angle: f64,
    ) -> Self {
        let kind = PairKind::Sliding {
            direction,
            angle,
            corners: [0.01, -0.01],
            half_height: 0.01,
        };
        self.pair(on, link, kind);
        self
    }

    fn pair(
        &mut self,
        on: (Option<usize>, [f64; 2]),
        link: (Option<usize>, [f64; 2]),
        kind: PairKind,
    ) {
        let point = |(link, at): (Option<usize>, [f64; 2])| PointOf { link, at };
        self.0.pairs.push(PairSpec {
            name: format!("p{}", self.0.pairs.len()),
            on: point(on),
            link: point(link),
            kind,
            friction: 0.0,
        });
    }

    /// A coupling of two wheels, or of a wheel and a rack.
    pub(super) fn couple(
        mut self,
        wheels: [Option<usize>; 2],
        carrier: Option<usize>,
        kind: CouplingKind,
        offset: f64,
    ) -> Self {
        let name = format!("c{}", self.0.couplings.len());
        self.0.couplings.push(CouplingSpec {
            name,
            wheels,
            carrier,
            kind,
            offset,
        });
        self
    }

    pub(super) fn choose(mut self, link: usize, choice: AssemblyChoice) -> Self {
        self.0.assembly.push(AssemblySpec { link, choice });
        self
    }

    pub(super) fn start(mut self, start: f64) -> Self {
        self.0.start = start;
        self
    }

    pub(super) fn mass(mut self, link: usize, mass: f64, centre: [f64; 2], moment: f64) -> Self {
        let link = &mut self.0.links[link];
        (link.mass, link.centre, link.moment) = (mass, centre, moment);
        self
    }

    pub(super) fn force(mut self, law: ForceLaw) -> Self {
        let name = format!("f{}", self.0.forces.len());
        self.0.forces.push(ForceSpec { name, law });
        self
    }

    pub(super) fn output(mut self, kind: OutputKind) -> Self {
        let name = format!("o{}", self.0.outputs.len());
        self.0.outputs.push(OutputSpec { name, kind });
        self
    }
}

/// Crank at (0, 0), rocker at (d, 0); links lie along their x axes.
pub(super) fn four_bar([crank, coupler, rocker, frame]: [f64; 4]) -> Builder {
    Builder::new(&["crank", "coupler", "rocker"])
        .pin((GROUND, [0.0; 2]), (Some(0), [0.0; 2]))
        .pin((Some(0), [crank, 0.0]), (Some(1), [0.0; 2]))
        .pin((Some(1), [coupler, 0.0]), (Some(2), [rocker, 0.0]))
        .pin((GROUND, [frame, 0.0]), (Some(2), [0.0; 2]))
        .output(OutputKind::Angle { link: 2 })
}

/// Crank at (0, 0), the slide's pin on the line y = offset.
pub(super) fn slider_crank(crank: f64, rod: f64, offset: f64) -> Builder {
    Builder::new(&["crank", "rod", "slide"])
        .pin((GROUND, [0.0; 2]), (Some(0), [0.0; 2]))
        .pin((Some(0), [crank, 0.0]), (Some(1), [0.0; 2]))
        .pin((Some(1), [rod, 0.0]), (Some(2), [0.0; 2]))
        .slide((GROUND, [0.0, offset]), (Some(2), [0.0; 2]), 0.0, 0.0)
        .output(OutputKind::Pair { pair: 3 })
}

/// Crank about O1, slotted link about O2, block pinned to the crank's end.
pub(super) fn slotted_link(o1: [f64; 2], o2: [f64; 2], crank: f64) -> Builder {
    Builder::new(&["crank", "block", "slot"])
        .pin((GROUND, o1), (Some(0), [0.0; 2]))
        .pin((Some(0), [crank, 0.0]), (Some(1), [0.0; 2]))
        .slide((Some(2), [0.0; 2]), (Some(1), [0.0; 2]), 0.0, 0.0)
        .pin((GROUND, o2), (Some(2), [0.0; 2]))
        .output(OutputKind::Angle { link: 2 })
        .output(OutputKind::Pair { pair: 2 })
}

/// Andrews' squeezing mechanism of seven bodies at rest (Test Set for IVP
/// Solvers, Bari, problem "andrews"). K2 and K4, K6 with the origin of their
/// angles as in that description; the input is the angle β of K1.
pub(super) fn andrews() -> Builder {
    let (d, da, e, ea) = (0.028, 0.0115, 0.02, 0.01421);
    let (rr, ra, ss, sa, sb) = (0.007, 0.00092, 0.035, 0.01874, 0.01043);
    let (sc, sd, ta, tb) = (0.018, 0.02, 0.02308, 0.00916);
    let (u, ua, ub, zf, zt, fa) = (0.04, 0.01228, 0.00449, 0.02, 0.04, 0.01421);
    let (a, b, c) = ([-0.06934, -0.00227], [-0.03635, 0.03273], [0.014, 0.072]);
    let (gamma, phi, delta) = (
        0.455_279_819_163_070_4,
        0.222_668_390_165_885_88,
        0.487_364_979_543_842_55,
    );
    let (omega, epsilon) = (-0.222_668_390_165_885_88, 1.230_547_444_549_821_2);
    let k = [0, 1, 2, 3, 4, 5, 6].map(Some);
    // The pin of K2 with K3, K4 and K6 lies at −d on its axis.
    let spring = ForceLaw::Strut {
        from: PointOf {
            link: GROUND,
            at: c,
        },
        to: PointOf {
            link: k[2],
            at: [sd, -sc],
        },
        rate: 4530.0,
        free_length: 0.07785,
        damping: 0.0,
        force: 0.0,
    };
    Builder::new(&["k1", "k2", "k3", "k4", "k5", "k6", "k7"])
        .pin((GROUND, [0.0; 2]), (k[0], [0.0; 2]))
        .pin((k[0], [rr, 0.0]), (k[1], [0.0; 2]))
        // K3 in the frame (cos γ, sin γ) at B: the closure is xb + ss sγ, yb − ss cγ.
        .pin((GROUND, b), (k[2], [0.0; 2]))
        .pin((k[1], [-d, 0.0]), (k[2], [0.0, -ss]))
        // K5 at A in the frame of δ, K4 in that of Φ + δ.
        .pin((GROUND, a), (k[4], [0.0; 2]))
        .pin((k[4], [zt, 0.0]), (k[3], [0.0, e]))
        .pin((k[1], [-d, 0.0]), (k[3], [0.0; 2]))
        // K7 at A in the frame of ε, K6 in that of Ω + ε.
        .pin((GROUND, a), (k[6], [0.0; 2]))
        .pin((k[6], [0.0, -u]), (k[5], [-zf, 0.0]))
        .pin((k[1], [-d, 0.0]), (k[5], [0.0; 2]))
        .mass(0, 0.04325, [ra, 0.0], 2.194e-6)
        .mass(1, 0.00365, [-da, 0.0], 4.410e-7)
        .mass(2, 0.02373, [sb, -sa], 5.255e-6)
        .mass(3, 0.00706, [0.0, e - (e - ea)], 5.667e-7)
        .mass(4, 0.07050, [ta, tb], 1.169e-5)
        .mass(5, 0.00706, [-zf + (zf - fa), 0.0], 5.667e-7)
        .mass(6, 0.05498, [-ub, -ua], 1.912e-5)
        .force(spring)
        .force(ForceLaw::Couple {
            link: 0,
            couple: 0.033,
        })
        .start(-0.061_713_890_014_276_45)
        .choose(1, AssemblyChoice::Angle(-0.061_713_890_014_276_45))
        .choose(2, AssemblyChoice::Angle(gamma))
        .choose(3, AssemblyChoice::Angle(phi + delta))
        .choose(4, AssemblyChoice::Angle(delta))
        .choose(5, AssemblyChoice::Angle(omega + epsilon))
        .choose(6, AssemblyChoice::Angle(epsilon))
}

/// A plate on three levers, one of them driven through a fourth: driver 0,
/// plate 1, levers 2, 3 and 4; the plate cannot be placed by dyads.
pub(super) fn triad() -> Builder {
    let plate = [[0.0, 0.0], [0.5, 0.1], [0.2, 0.45]];
    Builder::new(&["crank", "plate", "rod", "left", "right"])
        .pin((GROUND, [0.3, 0.0]), (Some(0), [0.0; 2]))
        .pin((Some(0), [0.08, 0.0]), (Some(2), [0.0; 2]))
        .pin((Some(2), [0.42, 0.0]), (Some(1), plate[0]))
        .pin((GROUND, [1.2, 0.2]), (Some(4), [0.0; 2]))
        .pin((Some(4), [0.4, 0.0]), (Some(1), plate[1]))
        .pin((GROUND, [-0.1, 1.1]), (Some(3), [0.0; 2]))
        .pin((Some(3), [0.79, 0.0]), (Some(1), plate[2]))
        .choose(
            1,
            AssemblyChoice::Near {
                point: [0.2, 0.2],
                place: [0.6, 0.6],
            },
        )
        .choose(1, AssemblyChoice::Angle(0.0))
        .choose(2, AssemblyChoice::Angle(1.4))
        .choose(3, AssemblyChoice::Angle(-0.3))
        .choose(4, AssemblyChoice::Angle(2.2))
        .mass(1, 2.0, [0.2, 0.2], 0.1)
        .output(OutputKind::Angle { link: 1 })
}

/// Cylinder 0 about (0.5, 0), rod 1 in it, boom 2 about the origin with the
/// rod's pin at 0.3 m: the input is the distance of the two pins.
pub(super) fn cylinder() -> Builder {
    let mut builder = Builder::new(&["cylinder", "rod", "boom"])
        .pin((GROUND, [0.5, 0.0]), (Some(0), [0.0; 2]))
        .slide((Some(0), [0.0; 2]), (Some(1), [0.0; 2]), 0.0, 0.0)
        .pin((Some(1), [0.0; 2]), (Some(2), [0.3, 0.0]))
        .pin((GROUND, [0.0; 2]), (Some(2), [0.0; 2]))
        .mass(2, 3.0, [0.2, 0.0], 0.05)
        .choose(2, AssemblyChoice::Angle(1.0))
        .start(0.4);
    builder.0.driver = 1;
    builder
}
