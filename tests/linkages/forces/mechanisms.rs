//! The mechanisms of the reference, and their kinematics written down by hand:
//! independent of the library's own positions.

use super::jets::D2;
use dam::jet::Jet;
use dam::linkage::kinetostatics::{LinkPosition, Positions};
use dam::linkage::spec::{
    AssemblyChoice, AssemblySpec, ForceLaw, ForceSpec, LinkSpec, LinkageSpec, OutputKind,
    OutputSpec, PairKind, PairSpec, PointOf,
};
use serde_json::Value;

/// Positions written down by hand.
pub(super) struct Known {
    pub(super) links: Vec<LinkPosition>,
    pub(super) pairs: Vec<Jet>,
}

impl Positions for Known {
    fn link(&self, index: usize) -> LinkPosition {
        self.links[index]
    }

    fn pair_rates(&self, index: usize) -> [f64; 3] {
        let jet = self.pairs[index];
        [jet.first, jet.second, jet.third]
    }

    fn pair_coordinate(&self, index: usize) -> f64 {
        self.pairs[index].value
    }
}

/// Numbers of a case by name.
pub(super) struct Data<'a>(pub(super) &'a Value);

impl Data<'_> {
    pub(super) fn get(&self, name: &str) -> f64 {
        self.0[name].as_f64().unwrap_or_else(|| panic!("no {name}"))
    }

    fn link(&self, index: usize, name: &str) -> LinkSpec {
        LinkSpec {
            name: name.to_owned(),
            points: Vec::new(),
            mass: self.get(&format!("m{index}")),
            centre: [
                self.get(&format!("cx{index}")),
                self.get(&format!("cy{index}")),
            ],
            moment: self.get(&format!("J{index}")),
        }
    }

    fn pin(&self, index: usize, name: &str, on: PointOf, link: PointOf) -> PairSpec {
        PairSpec {
            name: name.to_owned(),
            on,
            link,
            kind: PairKind::Revolute {
                diameter: self.get(&format!("d{index}")),
            },
            friction: self.get(&format!("mu{index}")),
        }
    }

    fn guide(&self, name: &str, on: PointOf, link: PointOf, direction: f64) -> PairSpec {
        PairSpec {
            name: name.to_owned(),
            on,
            link,
            kind: PairKind::Sliding {
                direction,
                angle: 0.0,
                corners: [self.get("b1"), -self.get("b2")],
                half_height: self.get("c"),
            },
            friction: self.get("mu4"),
        }
    }
}

pub(super) fn of(link: usize, x: f64, y: f64) -> PointOf {
    PointOf {
        link: Some(link),
        at: [x, y],
    }
}

pub(super) fn ground(x: f64, y: f64) -> PointOf {
    PointOf {
        link: None,
        at: [x, y],
    }
}

fn force(name: &str, law: ForceLaw) -> ForceSpec {
    ForceSpec {
        name: name.to_owned(),
        law,
    }
}

pub(super) fn push(name: &str, point: PointOf, vector: [f64; 2]) -> ForceSpec {
    let law = ForceLaw::Force {
        point,
        force: vector,
        follows: false,
    };
    force(name, law)
}

fn link(x: D2, y: D2, angle: D2) -> LinkPosition {
    LinkPosition {
        origin: [x.0, y.0],
        cos: angle.0.cos(),
        sin: angle.0.sin(),
        first: [x.1, y.1, angle.1],
        second: [x.2, y.2, angle.2],
    }
}

fn jet(x: D2) -> Jet {
    Jet {
        value: x.0,
        first: x.1,
        second: x.2,
        third: 0.0,
    }
}

/// The mechanism of a case.
pub(super) fn spec(kind: &str, data: &Value) -> LinkageSpec {
    let d = Data(data);
    let mut spec = match kind {
        "slider_crank" => slider_crank(&d),
        "four_bar" => four_bar(&d),
        "slotted" => slotted(&d),
        other => panic!("unknown kind {other}"),
    };
    spec.gravity = [0.0, -d.get("g")];
    let output = match kind {
        "slider_crank" => OutputKind::Point {
            point: of(2, 0.0, 0.0),
            direction: d.get("beta_deg").to_radians(),
        },
        _ => OutputKind::Angle { link: 2 },
    };
    // Put together as the hand-written kinematics at an input of 0.4 rad.
    spec.start = 0.4;
    let place = known(kind, data, spec.start).0.links[1];
    spec.assembly = vec![AssemblySpec {
        link: 1,
        choice: AssemblyChoice::Angle(place.sin.atan2(place.cos)),
    }];
    spec.outputs = vec![OutputSpec {
        name: "output".to_owned(),
        kind: output,
    }];
    spec
}

fn slider_crank(d: &Data) -> LinkageSpec {
    let beta = d.get("beta_deg").to_radians();
    let (s, c) = beta.sin_cos();
    let (e, p) = (d.get("e"), d.get("P"));
    LinkageSpec {
        links: vec![d.link(1, "crank"), d.link(2, "rod"), d.link(3, "slider")],
        pairs: vec![
            d.pin(1, "R01", ground(0.0, 0.0), of(0, 0.0, 0.0)),
            d.pin(2, "R12", of(0, d.get("l1"), 0.0), of(1, 0.0, 0.0)),
            d.pin(3, "R23", of(1, d.get("l2"), 0.0), of(2, 0.0, 0.0)),
            d.guide("P03", ground(-e * s, e * c), of(2, 0.0, 0.0), beta),
        ],
        forces: vec![
            push("P", of(2, 0.0, 0.0), [p * c, p * s]),
            push(
                "F2",
                of(1, d.get("cx2"), d.get("cy2")),
                [d.get("Fx2"), d.get("Fy2")],
            ),
            force(
                "M2",
                ForceLaw::Couple {
                    link: 1,
                    couple: d.get("M2"),
                },
            ),
        ],
        ..LinkageSpec::default()
    }
}

fn four_bar(d: &Data) -> LinkageSpec {
    LinkageSpec {
        links: vec![
            d.link(1, "crank"),
            d.link(2, "coupler"),
            d.link(3, "rocker"),
        ],
        pairs: vec![
            d.pin(1, "R01", ground(0.0, 0.0), of(0, 0.0, 0.0)),
            d.pin(2, "R12", of(0, d.get("l1"), 0.0), of(1, 0.0, 0.0)),
            d.pin(3, "R23", of(1, d.get("l2"), 0.0), of(2, d.get("l3"), 0.0)),
            d.pin(
                4,
                "R03",
                ground(d.get("xB0"), d.get("yB0")),
                of(2, 0.0, 0.0),
            ),
        ],
        forces: vec![
            force(
                "M3",
                ForceLaw::Couple {
                    link: 2,
                    couple: d.get("M3"),
                },
            ),
            push(
                "F2",
                of(1, d.get("px2"), d.get("py2")),
                [d.get("Fx2"), d.get("Fy2")],
            ),
        ],
        ..LinkageSpec::default()
    }
}

fn slotted(d: &Data) -> LinkageSpec {
    let origin = ground(d.get("xO1"), d.get("yO1"));
    LinkageSpec {
        links: vec![d.link(1, "crank"), d.link(2, "block"), d.link(3, "lever")],
        pairs: vec![
            d.pin(1, "R01", origin, of(0, 0.0, 0.0)),
            d.pin(2, "R12", of(0, d.get("l1"), 0.0), of(1, 0.0, 0.0)),
            d.pin(3, "R03", ground(0.0, 0.0), of(2, 0.0, 0.0)),
            d.guide("P32", of(2, 0.0, 0.0), of(1, 0.0, 0.0), 0.0),
        ],
        forces: vec![force(
            "M3",
            ForceLaw::Couple {
                link: 2,
                couple: d.get("M3"),
            },
        )],
        ..LinkageSpec::default()
    }
}

/// Positions of a case by hand, and the output's displacement.
pub(super) fn known(kind: &str, data: &Value, angle: f64) -> (Known, D2) {
    let d = Data(data);
    let (phi, zero) = (D2::variable(angle), D2::default());
    let (l1, x) = (d.get("l1"), D2::constant);
    match kind {
        "slider_crank" => {
            let beta = d.get("beta_deg").to_radians();
            let (s, c) = beta.sin_cos();
            let (bx, by) = (phi.cos() * l1, phi.sin() * l1);
            let (e, l2) = (d.get("e"), d.get("l2"));
            let (along, across) = (bx * c + by * s, by * c - bx * s - x(e));
            let stroke = along + (x(l2 * l2) - across * across).sqrt();
            let (cx, cy) = (stroke * c - x(e * s), stroke * s + x(e * c));
            let rod = (cy - by).atan2(cx - bx);
            let links = vec![
                link(zero, zero, phi),
                link(bx, by, rod),
                link(cx, cy, x(beta)),
            ];
            let pairs = [phi, rod - phi, x(beta) - rod, stroke];
            (
                Known {
                    links,
                    pairs: pairs.map(jet).to_vec(),
                },
                stroke,
            )
        }
        "four_bar" => {
            let (ax, ay) = (phi.cos() * l1, phi.sin() * l1);
            let (dx, dy) = (x(d.get("xB0")) - ax, x(d.get("yB0")) - ay);
            let (l2, l3) = (d.get("l2"), d.get("l3"));
            let r2 = dx * dx + dy * dy;
            let along = (r2 + x(l2 * l2 - l3 * l3)) * r2.recip() * 0.5;
            let across = (x(l2 * l2) * r2.recip() - along * along).sqrt() * d.get("branch");
            let (bx, by) = (ax + dx * along - dy * across, ay + dy * along + dx * across);
            let coupler = (by - ay).atan2(bx - ax);
            let rocker = (by - x(d.get("yB0"))).atan2(bx - x(d.get("xB0")));
            let links = vec![
                link(zero, zero, phi),
                link(ax, ay, coupler),
                link(x(d.get("xB0")), x(d.get("yB0")), rocker),
            ];
            let pairs = [phi, coupler - phi, rocker - coupler, rocker];
            (
                Known {
                    links,
                    pairs: pairs.map(jet).to_vec(),
                },
                rocker,
            )
        }
        _ => {
            let (ax, ay) = (
                phi.cos() * l1 + x(d.get("xO1")),
                phi.sin() * l1 + x(d.get("yO1")),
            );
            let lever = ay.atan2(ax);
            let slide = (ax * ax + ay * ay).sqrt();
            let links = vec![
                link(x(d.get("xO1")), x(d.get("yO1")), phi),
                link(ax, ay, lever),
                link(zero, zero, lever),
            ];
            let pairs = [phi, lever - phi, lever, slide];
            (
                Known {
                    links,
                    pairs: pairs.map(jet).to_vec(),
                },
                lever,
            )
        }
    }
}
