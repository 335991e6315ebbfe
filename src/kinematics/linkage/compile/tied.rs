//! Couplings made ready for the groups that they belong to.

use crate::kinematics::linkage::couplings::PitchCurve;
use crate::kinematics::linkage::elements::{Element, elements};
use crate::kinematics::linkage::newton::{Geared, Rolling, Second, Side, Tied};
use crate::kinematics::linkage::spec::{CamPairSpec, CouplingKind, CouplingSpec, LinkageSpec};

/// A coupling made ready, its sides being found by `own`.
pub(super) fn tied(
    spec: &LinkageSpec,
    coupling: &CouplingSpec,
    own: impl Fn(&Element) -> Side,
) -> Option<Tied> {
    match &coupling.kind {
        CouplingKind::Cam(cam) => rolling(coupling.wheels, cam, own)
            .map(Box::new)
            .map(Tied::Cam),
        _ => geared(spec, coupling, own).map(Tied::Wheels),
    }
}

/// A cam made ready.
fn rolling(
    [cam, roller]: [Option<usize>; 2],
    spec: &CamPairSpec,
    own: impl Fn(&Element) -> Side,
) -> Option<Rolling> {
    let side = |link: Option<usize>, point: [f64; 2]| {
        own(&Element {
            point,
            ..Element::of_link(link)
        })
    };
    Some(Rolling {
        cam: side(cam, spec.centre),
        roller: side(roller, spec.roller),
        curve: PitchCurve::new(spec).ok()?,
    })
}

/// Wheels made ready.
fn geared(
    spec: &LinkageSpec,
    coupling: &CouplingSpec,
    own: impl Fn(&Element) -> Side,
) -> Option<Geared> {
    let meeting = coupling.axis_positions(&spec.pairs).ok()?;
    let side = |link: Option<usize>| own(&Element::of_link(link));
    let second = match meeting.guide {
        None => Second::Wheel(side(coupling.wheels[1])),
        Some((guide, sense)) => {
            let sides = elements(&spec.pairs[guide]).each_ref().map(&own);
            Second::Rack(sides, sense)
        }
    };
    Some(Geared {
        wheel: side(coupling.wheels[0]),
        second,
        carrier: side(coupling.carrier),
        ratio: coupling.kind.ratio(),
        offset: coupling.offset,
    })
}
