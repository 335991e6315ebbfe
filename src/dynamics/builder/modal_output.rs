//! The output of an object that is reduced to modes: a sum, on which loads act.

use super::spec::{LoadLawSpec, LoadSpec};
use super::{InputConnection, ModelBuilder, Place};
use crate::dynamics::model::{Load, NodeIndex, Pair, WrittenLoad};
use crate::kinematics::constraint::Constraint;
use crate::kinematics::position::Position;

/// Shares of a force at the output that inner nodes get.
pub(super) type Shares = Vec<(NodeIndex, f64)>;

/// The node of the output: the sum of the nodes by their shares.
pub(super) fn sum(
    into: &mut ModelBuilder,
    at: &Place,
    shares: &Shares,
    pair: Pair,
) -> Option<NodeIndex> {
    let connected = |node| InputConnection {
        port: String::new(),
        output: at.id.clone(),
        coordinate: into.model.objects[at.object].coordinate,
        node,
    };
    let all: Vec<InputConnection> = shares.iter().map(|share| connected(share.0)).collect();
    let ratios = shares.iter().map(|share| share.1).collect();
    let sum = match Constraint::linear(ratios, 0.0) {
        Ok(constraint) => into.combine(at, &all.iter().collect::<Vec<_>>(), constraint),
        Err(faults) => {
            into.faults(at, "modes", faults);
            return None;
        }
    };
    let same = Position::Ratio {
        ratio: 1.0,
        offset: 0.0,
    };
    let law = into.law(at, "position", &sum, same, 1.0)?;
    Some(into.rigid(at, law, 0.0, pair))
}

/// A load on an object of modes: what does not depend on the motion of the output is
/// shared out to the modes. The constant force that it is, if it is one.
pub(super) fn load(
    into: &mut ModelBuilder,
    at: &Place,
    spec: &LoadSpec,
    shares: &Shares,
    [output, driver]: [NodeIndex; 2],
) -> f64 {
    if matches!(spec.law, LoadLawSpec::Weight { .. }) {
        let nodes: Vec<NodeIndex> = shares.iter().map(|share| share.0).collect();
        into.load(at, spec, &nodes, driver);
        return 0.0;
    }
    into.load(at, spec, &[output], driver);
    let known = |load: &Load| {
        let of_nothing = |written: &WrittenLoad| written.nodes().next().is_none();
        let given = load.law.pieces().is_some()
            || load.law.expression_load().is_some_and(of_nothing)
            || load.law.as_constant().is_some();
        // (Friction answers to the motion, whatever it is engaged by.)
        let given = given && load.law.dry_friction().is_none();
        given && load.node == output
    };
    let Some(load) = into.model.loads.pop_if(|load| known(load)) else {
        return 0.0;
    };
    let stated = into.model.stated.loads.remove(&into.model.loads.len());
    for &(node, share) in shares {
        if let Some(stated) = &stated {
            let mut own = stated.clone();
            own.share *= share;
            into.model.stated.loads.insert(into.model.loads.len(), own);
        }
        let mut law = load.law.clone();
        law.scale(share);
        let name = load.name.clone();
        into.model.loads.push(Load { node, name, law });
    }
    load.law.as_constant().unwrap_or(0.0)
}
