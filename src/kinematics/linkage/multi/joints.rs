//! The inputs of a linkage as joints, from the ground outwards and inside groups.

use super::plan::{InnerJoint, TreeJoint, driver_of};
use super::spec::{InputCoordinate, InputSpec};
use super::welded::WeldedLinkage;
use crate::fault::Faults;
use crate::kinematics::linkage::compile::Bodies;
use crate::kinematics::linkage::elements::{Body, Element};
use crate::kinematics::linkage::plan::Driver;

/// The inputs, sorted into those that lead outwards and those inside groups.
pub(super) struct Joints {
    pub(super) tree: Vec<TreeJoint>,
    pub(super) inner: Vec<InnerJoint>,
    /// Of every link whether the tree places it.
    pub(super) placed: Vec<bool>,
    /// Number of all bodies.
    pub(super) bodies: usize,
}

/// A coordinate of a floating link as a pair: a guide along `along`, or a pin.
pub(super) fn floating_driver(along: [f64; 2], slides: bool) -> Driver {
    let element = Element {
        link: None,
        point: [0.0; 2],
        along,
    };
    Driver {
        on: element,
        link: element,
        sliding: slides.then_some([1.0, 0.0]),
    }
}

pub(super) fn joints(welded: &WeldedLinkage, faults: &mut Faults) -> Joints {
    let spec = &welded.spec;
    let linkage = &spec.linkage;
    let links = linkage.links.len();
    let mut floating: Vec<usize> = (spec.inputs.iter())
        .filter_map(|input| input.coordinate.floating_link())
        .collect();
    floating.sort_unstable();
    floating.dedup();
    let bodies = links + 2 * floating.len();
    let mut placed = vec![false; links];
    let mut tree = Vec::new();
    for (number, &link) in floating.iter().enumerate() {
        placed[link] = true;
        let between = links + 2 * number;
        let coordinates = [
            InputCoordinate::X(link),
            InputCoordinate::Y(link),
            InputCoordinate::Angle(link),
        ];
        let parents = [bodies, between, between + 1];
        let places = [between, between + 1, link];
        let drivers = [
            floating_driver([1.0, 0.0], true),
            floating_driver([0.0, 1.0], true),
            floating_driver([1.0, 0.0], false),
        ];
        for (k, driver) in drivers.into_iter().enumerate() {
            let own = |input: &InputSpec| input.coordinate == coordinates[k];
            // (Checked: a floating link has all three.)
            let Some(input) = spec.inputs.iter().position(own) else {
                continue;
            };
            tree.push(TreeJoint {
                body: places[k],
                parent: parents[k],
                input,
                driver,
                reversed: false,
                shift: 0.0,
            });
        }
    }
    let mut open: Vec<(usize, usize)> = (spec.inputs.iter().enumerate())
        .filter_map(|(input, own)| match own.coordinate {
            InputCoordinate::Pair(pair) => Some((input, pair)),
            _ => None,
        })
        .collect();
    loop {
        let stands = |link: Option<usize>| link.is_none_or(|link| placed[link]);
        let outwards = open.iter().position(|&(_, pair)| {
            let pair = &linkage.pairs[pair];
            stands(pair.on.link) != stands(pair.link.link)
        });
        let Some(place) = outwards else {
            break;
        };
        let (input, pair) = open.remove(place);
        let driver = driver_of(linkage, pair);
        let reversed = !stands(driver.on.link);
        let (parent, body) = match reversed {
            false => (driver.on.link, driver.link.link),
            true => (driver.link.link, driver.on.link),
        };
        let Some(body) = body else { continue };
        placed[body] = true;
        tree.push(TreeJoint {
            body,
            parent: parent.unwrap_or(bodies),
            input,
            shift: welded.shift(pair),
            driver,
            reversed,
        });
    }
    let mut inner: Vec<InnerJoint> = Vec::new();
    for (input, pair) in open {
        let driver = driver_of(linkage, pair);
        let path = format!("inputs.{}", spec.inputs[input].name);
        let name = &linkage.pairs[pair].name;
        let taken = |link: usize| {
            inner
                .iter()
                .any(|own| own.base == link || own.driven == link)
        };
        match (driver.on.link, driver.link.link) {
            (Some(base), Some(driven)) if !placed[base] && !placed[driven] => {
                if taken(base) || taken(driven) {
                    let message = format!(
                        "a link of `{name}` belongs to another input that lies between moving links"
                    );
                    let hint = "choose pairs as inputs that lead from the ground outwards";
                    faults.add(path, message, hint);
                    continue;
                }
                inner.push(InnerJoint {
                    base,
                    driven,
                    input,
                    shift: welded.shift(pair),
                    driver,
                });
            }
            _ => {
                let message =
                    format!("the other inputs place both links of `{name}`: it is no free choice");
                let hint = "name another pair, or leave this input out";
                faults.add(path, message, hint);
            }
        }
    }
    Joints {
        tree,
        inner,
        placed,
        bodies,
    }
}

/// The bodies that groups place; links that are welded to others are none of their own.
pub(super) fn bodies_of_groups(welded: &WeldedLinkage, joints: &Joints) -> Bodies {
    let links = joints.placed.len();
    let (mut list, mut of_link) = (Vec::new(), vec![None; links]);
    for link in 0..links {
        let own = |joint: &&InnerJoint| joint.base == link || joint.driven == link;
        let inner = joints.inner.iter().find(own);
        if joints.placed[link] || welded.attachment(link).is_some() || of_link[link].is_some() {
            continue;
        }
        let body = match inner {
            Some(joint) => Body {
                base: joint.base,
                driven: Some(joint.driven),
            },
            None => Body {
                base: link,
                driven: None,
            },
        };
        for link in body.links() {
            of_link[link] = Some(list.len());
        }
        list.push(body);
    }
    Bodies { list, of_link }
}
