//! The drive of a machine.

use crate::dynamics::model::{Coordinate, Model, NodeMotion};
use crate::fault::Fault;
use crate::kinematics::motion::DriveMotion;

/// The drive of a model, or the one named.
///
/// # Errors
/// There are several and none is named; there is none of that name.
pub fn drive_of(model: &Model, named: Option<&str>) -> Result<usize, Vec<Fault>> {
    let is_drive = |&(_, part): &(usize, &crate::dynamics::model::ObjectPart)| part.is_drive();
    let mut drives = model.objects.iter().enumerate().filter(is_drive);
    let ids = || -> Vec<String> {
        let parts = model.objects.iter().filter(|part| part.is_drive());
        parts.map(|part| format!("`{}`", part.id)).collect()
    };
    let found = match named {
        Some(id) => drives.find(|(_, part)| part.id == id),
        None if ids().len() > 1 => {
            let message = "the scene has several drives";
            let hint = format!("name one: {}", ids().join(" or "));
            return Err(vec![Fault::new("steady.drive", message, hint)]);
        }
        None => drives.next(),
    };
    let Some((index, part)) = found else {
        let message = "there is no such drive";
        let hint = format!("the drives are {}", ids().join(", "));
        return Err(vec![Fault::new("steady.drive", message, hint)]);
    };
    if part.coordinate == Coordinate::Sliding {
        let message = format!(
            "`{}` slides: a steady motion needs a drive that turns",
            part.id
        );
        return Err(vec![Fault::new("steady.drive", message, "")]);
    }
    Ok(index)
}

/// A cycle is followed towards positive angles.
pub(super) fn backwards(model: &Model, drive: usize) -> Option<Fault> {
    let part = &model.objects[drive];
    match &model.nodes[part.nodes[0]].motion {
        NodeMotion::Prescribed {
            motion: DriveMotion::Constant { speed, .. },
            ..
        } if *speed < 0.0 => {
            let message = format!("`{}` turns backwards", part.id);
            let hint = "turn the mechanism round: a cycle goes towards positive angles";
            let path = format!("{}.motion.speed", part.id);
            Some(Fault::new(path, message, hint))
        }
        _ => None,
    }
}

/// The nodes that move with a node.
pub(in crate::studies::steady) fn nodes_moved_by(model: &Model, node: usize) -> Vec<bool> {
    let mut moved = vec![false; model.nodes.len()];
    moved[node] = true;
    // Drivers stand before what they drive.
    for index in 0..model.nodes.len() {
        match &model.nodes[index].motion {
            NodeMotion::Mass { law } | NodeMotion::Rigid { law } => {
                moved[index] |= moved[law.driver];
            }
            NodeMotion::Constrained { drivers, .. } => {
                moved[index] |= drivers.iter().any(|&driver| moved[driver]);
            }
            NodeMotion::Prescribed { .. } | NodeMotion::Rotor { .. } => {}
        }
    }
    moved
}

/// True when something elastic hangs on a drive.
pub fn is_elastic(model: &Model, drive: usize) -> bool {
    let moved = nodes_moved_by(model, model.objects[drive].nodes[0]);
    let masses = model.nodes.iter().zip(moved);
    masses
        .filter(|(_, moved)| *moved)
        .any(|(node, _)| matches!(node.motion, NodeMotion::Mass { .. }))
}

/// The speed of a drive with constant speed (rad/s).
pub fn constant_speed(model: &Model, drive: usize) -> Option<f64> {
    match &model.nodes[model.objects[drive].nodes[0]].motion {
        NodeMotion::Prescribed {
            motion: DriveMotion::Constant { speed, .. },
            ..
        } => Some(speed.abs()),
        _ => None,
    }
}
