//! The same of linkages with several inputs.
//!
//! Their reach has no ends that are known. What was left out must hold at the start and on short ways
//! from there in many directions of the inputs. By how much it is missed is an analytic function of the
//! inputs: what vanishes all around the start vanishes as far as nothing is singular.

use super::search::{leave_out, possible_removals};
use super::{MISSED, POSITIONS, closure_error};
use crate::kinematics::linkage::multi::spec::{InputCoordinate, MultiSpec};
use crate::kinematics::linkage::multi::{MultiLinkage, MultiWorkspace};
use crate::kinematics::linkage::skeleton::Skeleton;
use crate::kinematics::linkage::spec::LinkageSpec;

/// Positions on each of the ways.
const STEPS: usize = 10;
/// Length of the ways: rad, or parts of the size.
const FAR: f64 = 0.5;
/// So near to a singular position a way ends: a step could lead into another assembly.
const SINGULAR: f64 = 0.03;
/// Positions that must be left of all ways.
const LEAST: usize = POSITIONS / 10;

/// The linkage that moves with its inputs although the count of its degrees of freedom says no;
/// `None` where it does not, or the search finds no reason. `solved`: it with welded links as one.
pub(in crate::kinematics::linkage) fn find_movable(
    spec: &MultiSpec,
    solved: &Skeleton,
    built: &dyn Fn(MultiSpec) -> Option<MultiLinkage>,
) -> Option<MultiLinkage> {
    let pairs = spec
        .inputs
        .iter()
        .filter_map(|input| match input.coordinate {
            InputCoordinate::Pair(pair) => Some(pair),
            _ => None,
        });
    let driven: Vec<usize> = pairs.collect();
    let candidates = || possible_removals(&solved.spec, &driven);
    leave_out(
        &spec.linkage,
        spec.inputs.len(),
        candidates,
        &|trial: &LinkageSpec| {
            let linkage = built(MultiSpec {
                linkage: trial.clone(),
                inputs: spec.inputs.clone(),
            });
            linkage.filter(holds_around_start)
        },
    )
}

/// Whether what was left out holds on ways from the start in many directions.
fn holds_around_start(linkage: &MultiLinkage) -> bool {
    let mut positions = 0;
    for way in 0..POSITIONS / STEPS {
        let mut workspace: MultiWorkspace<f64> = linkage.workspace();
        let rates = vec![0.0; linkage.inputs().len()];
        for step in 1..=STEPS {
            let inputs = inputs_along_path(linkage, way, step as f64 / STEPS as f64);
            let solved = workspace.solve(&inputs, &rates).is_ok();
            let margin = workspace.margin();
            if !solved || margin.is_some_and(|(_, margin)| margin < SINGULAR) {
                break;
            }
            let spec = &linkage.spec().linkage;
            if !(closure_error(spec, workspace.state(), linkage.typical_length()) <= MISSED) {
                return false;
            }
            positions += 1;
        }
    }
    positions >= LEAST
}

/// The inputs at a share of a way.
fn inputs_along_path(linkage: &MultiLinkage, way: usize, share: f64) -> Vec<f64> {
    let spec = &linkage.spec().linkage;
    let each = linkage.inputs().iter().enumerate();
    each.map(|(k, input)| {
        // Multiples of roots of different numbers fill the cube evenly.
        let direction = 2.0 * ((way as f64 + 1.0) * (k as f64 + 1.25).sqrt()).fract() - 1.0;
        let unit = match input.coordinate.slides(spec) {
            true => linkage.typical_length(),
            false => 1.0,
        };
        input.start + share * direction * FAR * unit
    })
    .collect()
}
