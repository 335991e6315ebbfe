//! The linkage that a position function is the short form of: without masses,
//! its links, pairs and branches written out.

use super::{FourBar, Position, SliderCrank, SlottedDriver, SlottedLink, SlottedOutput};
use crate::kinematics::linkage::spec::{
    AssemblyChoice, AssemblySpec, LinkSpec, LinkageSpec, NamedPoint, OutputKind, OutputSpec,
    PairKind, PairSpec, PointOf,
};

impl Position {
    /// The massless linkage whose first output is this function of its input
    /// coordinate, assembled as it stands at `phi` (an angle of the output may
    /// differ by whole turns); `None` for functions that are no linkage. Where it
    /// can fold flat the linkage goes on, the function is held to be dead.
    ///
    /// The ground's x axis is the one from which the function measures: the
    /// guide of a slider-crank, the line of the pivots of the others. `phi` must
    /// lie within reach ([`Position::reach_from`]).
    pub fn as_linkage(&self, phi: f64) -> Option<LinkageSpec> {
        match self {
            Self::SliderCrank(short) => Some(slider_crank(short, phi)),
            Self::FourBar(short) => Some(four_bar(short, phi)),
            Self::SlottedLink(short) => Some(slotted_link(short, phi)),
            _ => None,
        }
    }

    /// The property of a scene that states the linkage, and the branch on which it is assembled, +1
    /// or −1; `None` for functions that have one assembly mode.
    pub fn branch(&self) -> Option<(&'static str, f64)> {
        match self {
            Self::SliderCrank(short) => Some(("slider_crank", short.branch)),
            Self::FourBar(short) => Some(("four_bar", short.branch)),
            Self::SlottedLink(short) => Some(("slotted_link", short.branch_of_block()?)),
            Self::Ratio { .. }
            | Self::Sine { .. }
            | Self::Polynomial(_)
            | Self::Table(_)
            | Self::Cam(_)
            | Self::Plan(_)
            | Self::Linkage(_)
            | Self::Custom(_) => None,
        }
    }
}

const ORIGIN: [f64; 2] = [0.0; 2];

/// The end of a crank that stands at `phase` where its coordinate is 0.
fn crank_end(length: f64, phase: f64) -> [f64; 2] {
    let (sin, cos) = phase.sin_cos();
    [length * cos, length * sin]
}

fn link(name: &str, points: &[(&str, [f64; 2])]) -> LinkSpec {
    LinkSpec {
        name: name.to_owned(),
        points: named_points(points),
        ..LinkSpec::default()
    }
}

fn named_points(points: &[(&str, [f64; 2])]) -> Vec<NamedPoint> {
    let one = |(name, at): &(&str, [f64; 2])| NamedPoint {
        name: (*name).to_owned(),
        at: *at,
    };
    points.iter().map(one).collect()
}

fn of(link: usize, at: [f64; 2]) -> PointOf {
    let link = Some(link);
    PointOf { link, at }
}

fn ground_point(at: [f64; 2]) -> PointOf {
    PointOf { link: None, at }
}

fn pin_between(name: &str, on: PointOf, link: PointOf) -> PairSpec {
    pair(name, on, link, PairKind::PIN)
}

fn guide(name: &str, on: PointOf, link: PointOf) -> PairSpec {
    let kind = PairKind::Sliding {
        direction: 0.0,
        angle: 0.0,
        corners: [0.01, -0.01],
        half_height: 0.0,
    };
    pair(name, on, link, kind)
}

fn pair(name: &str, on: PointOf, link: PointOf, kind: PairKind) -> PairSpec {
    PairSpec {
        name: name.to_owned(),
        on,
        link,
        kind,
        friction: 0.0,
    }
}

/// The dyad of a link on a branch.
fn branch(link: usize, sign: f64) -> Vec<AssemblySpec> {
    let choice = AssemblyChoice::Branch(sign);
    vec![AssemblySpec { link, choice }]
}

fn output(name: &str, kind: OutputKind) -> Vec<OutputSpec> {
    vec![OutputSpec {
        name: name.to_owned(),
        kind,
    }]
}

fn slider_crank(short: &SliderCrank, phi: f64) -> LinkageSpec {
    let end = crank_end(short.crank, short.phase);
    let (o, g) = (ORIGIN, [0.0, short.offset]);
    LinkageSpec {
        links: vec![
            link("crank", &[("A", end)]),
            link("rod", &[("B", [short.rod, 0.0])]),
            link("slide", &[]),
        ],
        ground: named_points(&[("G", g), ("O", o)]),
        pairs: vec![
            pin_between("A", of(0, end), of(1, ORIGIN)),
            pin_between("B", of(1, [short.rod, 0.0]), of(2, ORIGIN)),
            pin_between("O", ground_point(o), of(0, ORIGIN)),
            guide("guide", ground_point(g), of(2, ORIGIN)),
        ],
        driver: 2,
        assembly: branch(2, short.branch),
        start: phi,
        outputs: output(
            "slide",
            OutputKind::Point {
                point: of(2, ORIGIN),
                direction: 0.0,
            },
        ),
        ..LinkageSpec::default()
    }
}

fn four_bar(short: &FourBar, phi: f64) -> LinkageSpec {
    let end = crank_end(short.crank, short.phase);
    let (o, c) = (ORIGIN, [short.frame, 0.0]);
    LinkageSpec {
        links: vec![
            link("coupler", &[("B", [short.coupler, 0.0])]),
            link("crank", &[("A", end)]),
            link("rocker", &[("B", [short.rocker, 0.0])]),
        ],
        ground: named_points(&[("C", c), ("O", o)]),
        pairs: vec![
            pin_between("A", of(1, end), of(0, ORIGIN)),
            pin_between("B", of(0, [short.coupler, 0.0]), of(2, [short.rocker, 0.0])),
            pin_between("C", ground_point(c), of(2, ORIGIN)),
            pin_between("O", ground_point(o), of(1, ORIGIN)),
        ],
        driver: 3,
        assembly: branch(2, short.branch),
        start: phi,
        outputs: output("rocker", OutputKind::Angle { link: 2 }),
        ..LinkageSpec::default()
    }
}

fn slotted_link(short: &SlottedLink, phi: f64) -> LinkageSpec {
    let spec = short.spec();
    let by_crank = spec.driver == SlottedDriver::Crank;
    let turned = if by_crank { spec.phase } else { 0.0 };
    let end = crank_end(spec.crank, turned);
    // Where the block drives, its coordinate counts from the phase on.
    let along = if by_crank { 0.0 } else { spec.phase };
    let (o1, o2) = ([spec.frame, 0.0], ORIGIN);
    let (watched, kind) = match spec.output {
        SlottedOutput::Link => ("slot", OutputKind::Angle { link: 2 }),
        SlottedOutput::Block => ("block", OutputKind::Pair { pair: 3 }),
        SlottedOutput::Crank => ("crank", OutputKind::Angle { link: 1 }),
    };
    LinkageSpec {
        links: vec![
            link("block", &[]),
            link("crank", &[("A", end)]),
            link("slot", &[]),
        ],
        ground: named_points(&[("O1", o1), ("O2", o2)]),
        pairs: vec![
            pin_between("A", of(1, end), of(0, ORIGIN)),
            pin_between("O1", ground_point(o1), of(1, ORIGIN)),
            pin_between("O2", ground_point(o2), of(2, ORIGIN)),
            guide("slide", of(2, [along, 0.0]), of(0, ORIGIN)),
        ],
        driver: if by_crank { 1 } else { 3 },
        // Driven by the crank, the block lies ahead of O2 in the slot. Driven by
        // the block, the dyad begins at O2: a crank that turns counterclockwise as
        // the block moves away has its end to the right of the line to O1.
        assembly: if by_crank {
            branch(2, 1.0)
        } else {
            branch(1, -spec.branch)
        },
        start: phi,
        outputs: output(watched, kind),
        ..LinkageSpec::default()
    }
}

#[cfg(test)]
mod tests {
    use crate::kinematics::linkage::Linkage;
    use crate::kinematics::position::{
        Position, PositionSpec, SlottedDriver, SlottedLinkSpec, SlottedOutput,
    };
    use std::f64::consts::TAU;

    /// The linkage against the formula, with all derivatives, over its reach.
    fn same(spec: &PositionSpec, start: f64) {
        let short = Position::new(spec).expect("a position");
        let linkage = short.as_linkage(start).expect("a linkage");
        let turning = !matches!(spec, PositionSpec::SliderCrank { .. })
            && !matches!(spec, PositionSpec::SlottedLink(s) if s.output == SlottedOutput::Block);
        let linkage = Linkage::new(linkage).unwrap_or_else(|faults| panic!("{spec:?}: {faults:?}"));
        let mut work = linkage.workspace();
        let reach = short.reach_from(start).expect("within reach");
        let (from, to) = reach.unwrap_or((start - 9.0, start + 9.0));
        match (reach, linkage.range().ends()) {
            (None, ends) => assert_eq!(ends, [f64::NEG_INFINITY, f64::INFINITY], "{spec:?}"),
            (Some((from, to)), [lower, upper]) => assert!(
                (from - lower).abs() + (to - upper).abs() < 1e-9,
                "{spec:?}: {from} {to} {lower} {upper}"
            ),
        }
        let mut turns = None;
        for step in 1..200 {
            let q = from + (to - from) * f64::from(step) / 200.0;
            linkage.solve(q, 3, &mut work).expect("within reach");
            let (long, short) = (linkage.output(0, &work), short.jet(0, q));
            let size = short.first.abs() + short.second.abs() + short.third.abs();
            for (a, b) in [
                (long.first, short.first),
                (long.second, short.second),
                (long.third, short.third),
            ] {
                assert!(
                    (a - b).abs() <= 1e-10 * (1.0 + size),
                    "{spec:?} at {q}: {a} {b}"
                );
            }
            let off = long.value - short.value;
            let whole = if turning { (off / TAU).round() } else { 0.0 };
            assert!((off - whole * TAU).abs() < 1e-12, "{spec:?} at {q}: {off}");
            assert_eq!(*turns.get_or_insert(whole), whole, "{spec:?} at {q} jumps");
        }
    }

    #[test]
    fn a_slider_crank_is_its_linkage() {
        for (branch, phase) in [(1.0, 0.0), (-1.0, 0.7), (1.0, -2.0)] {
            for (crank, rod, offset) in [(0.05, 0.2, 0.0), (0.05, 0.2, -0.03), (0.1, 0.06, 0.02)] {
                let spec = PositionSpec::SliderCrank {
                    crank,
                    rod,
                    offset,
                    branch,
                    phase,
                };
                same(&spec, 0.1 - phase);
            }
        }
    }

    #[test]
    fn a_four_bar_is_its_linkage() {
        for (branch, phase) in [(1.0, 0.0), (-1.0, 0.4)] {
            for [crank, coupler, rocker, frame] in [
                [0.04, 0.12, 0.1, 0.13],
                [0.13, 0.12, 0.1, 0.05],
                [0.2, 0.1, 0.16, 0.25],
            ] {
                let spec = PositionSpec::FourBar {
                    crank,
                    coupler,
                    rocker,
                    frame,
                    branch,
                    phase,
                };
                same(&spec, 0.5 - phase);
            }
        }
    }

    #[test]
    fn a_slotted_link_is_its_linkage() {
        use SlottedDriver::{Block, Crank};
        for (crank, frame) in [(0.1, 0.3), (0.3, 0.1)] {
            for (driver, output, branch, phase) in [
                (Crank, SlottedOutput::Link, 1.0, 0.3),
                (Crank, SlottedOutput::Block, 1.0, -1.0),
                (Block, SlottedOutput::Link, 1.0, 0.02),
                (Block, SlottedOutput::Crank, 1.0, 0.0),
                (Block, SlottedOutput::Link, -1.0, 0.0),
                (Block, SlottedOutput::Crank, -1.0, -0.01),
            ] {
                let spec = PositionSpec::SlottedLink(SlottedLinkSpec {
                    crank,
                    frame,
                    driver,
                    output,
                    branch,
                    phase,
                });
                let start = if driver == Crank { 0.4 } else { 0.31 - phase };
                same(&spec, start);
            }
        }
    }

    #[test]
    fn what_is_no_linkage_has_none() {
        let ratio = Position::Ratio {
            ratio: 2.0,
            offset: 0.0,
        };
        assert!(ratio.as_linkage(0.0).is_none());
    }
}
