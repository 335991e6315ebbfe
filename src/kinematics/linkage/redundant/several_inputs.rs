//! The same of linkages with several inputs.
//!
//! Their reach has no ends that are known. So what was left out must hold at the start and on ways
//! from there in many directions of the inputs, each as far as the linkage can be put together.

use super::search::{candidates, leave_out};
use super::{MISSED, POSITIONS, missed};
use crate::kinematics::linkage::multi::spec::{InputCoordinate, MultiSpec};
use crate::kinematics::linkage::multi::{MultiLinkage, MultiWorkspace};
use crate::kinematics::linkage::skeleton::Skeleton;
use crate::kinematics::linkage::spec::LinkageSpec;
use std::f64::consts::PI;

/// Positions on each of the ways.
const STEPS: usize = 10;
/// Most positions on ways that end at once count for nothing; so many must be left.
const LEAST: usize = POSITIONS / 10;

/// The linkage that moves with its inputs although the count of its degrees of freedom says no;
/// `None` where it does not, or the search finds no reason. `solved`: it with welded links as one.
pub(in crate::kinematics::linkage) fn find_movable(
    spec: &MultiSpec,
    solved: &Skeleton,
    built: &dyn Fn(MultiSpec) -> Option<MultiLinkage>,
) -> Option<MultiLinkage> {
    let pairs = spec.inputs.iter().filter_map(|input| match input.coordinate {
        InputCoordinate::Pair(pair) => Some(pair),
        _ => None,
    });
    let driven: Vec<usize> = pairs.collect();
    let candidates = || candidates(&solved.spec, &driven);
    leave_out(&spec.linkage, spec.inputs.len(), candidates, &|trial: &LinkageSpec| {
        let linkage = built(MultiSpec {
            linkage: trial.clone(),
            inputs: spec.inputs.clone(),
        });
        linkage.filter(holds_around_start)
    })
}

/// Whether what was left out holds on ways from the start in many directions.
fn holds_around_start(linkage: &MultiLinkage) -> bool {
    let mut positions = 0;
    for way in 0..POSITIONS / STEPS {
        let mut workspace: MultiWorkspace<f64> = linkage.workspace();
        let rates = vec![0.0; linkage.inputs().len()];
        for step in 1..=STEPS {
            let inputs = inputs_on_way(linkage, way, step as f64 / STEPS as f64);
            if workspace.solve(&inputs, &rates).is_err() {
                break;
            }
            let spec = &linkage.spec().linkage;
            if !(missed(spec, workspace.state(), linkage.size()) <= MISSED) {
                return false;
            }
            positions += 1;
        }
    }
    positions >= LEAST
}

/// The inputs at a share of a way: its end lies up to half a turn, or the size, from the start.
fn inputs_on_way(linkage: &MultiLinkage, way: usize, share: f64) -> Vec<f64> {
    let spec = &linkage.spec().linkage;
    let each = linkage.inputs().iter().enumerate();
    each.map(|(k, input)| {
        // Multiples of roots of different numbers fill the cube evenly.
        let direction = 2.0 * ((way as f64 + 1.0) * (k as f64 + 1.25).sqrt()).fract() - 1.0;
        let far = match input.coordinate.slides(spec) {
            true => linkage.size(),
            false => PI,
        };
        input.start + share * direction * far
    })
    .collect()
}
