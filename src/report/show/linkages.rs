//! Linkages as text: mobility, groups, inputs, outputs, what rubs.

use super::units;
use crate::dynamics::model::{Coordinate, Model, MultiLinkageBody, NodeMotion, OUTPUT};
use crate::kinematics::linkage::spec::{LinkageSpec, PairKind, PairSpec};
use crate::report::quantity::significant;

/// Mobility, groups, branches and range of every linkage.
pub(super) fn linkages(model: &Model) -> String {
    let mut out = String::new();
    for body in &model.linkages {
        let part = &model.objects[body.object];
        let linkage = &body.linkage;
        out.push_str(&format!("\nLinkage {}\n", part.id));
        for line in linkage.structure().to_string().lines() {
            out.push_str(&format!("  {line}\n"));
        }
        let turning = part.coordinate == Coordinate::Turning;
        let range = linkage.range().describe(linkage.structure(), turning);
        out.push_str(&format!("  input {range}\n"));
        let outputs = model
            .objects
            .iter()
            .filter(|one| one.is_driven_by(body.object));
        let outputs: Vec<String> = (outputs.filter(|one| one.kind == OUTPUT))
            .map(|one| format!("{} ({})", one.id, units(one.coordinate).displacement))
            .collect();
        if !outputs.is_empty() {
            out.push_str(&format!("  outputs {}\n", outputs.join(", ")));
        }
        if body.friction.is_some() {
            out.push_str(&format!(
                "  joint friction {}\n",
                friction_description(linkage.spec())
            ));
        }
    }
    out
}

/// Mobility, groups and branches of every linkage of several inputs, and what moves each
/// input.
pub(super) fn multi_linkages(model: &Model) -> String {
    let mut out = String::new();
    for body in &model.multi_linkages {
        let linkage = &body.linkage;
        out.push_str(&format!("\nLinkage {}\n", model.objects[body.object].id));
        for line in linkage.structure().to_string().lines() {
            out.push_str(&format!("  {line}\n"));
        }
        for (input, what) in linkage.inputs().iter().zip(moved_by(model, body)) {
            let coordinate = linkage.describe(input);
            out.push_str(&format!("  input {}: {coordinate}, {what}\n", input.name));
        }
        let outputs = body.outputs.iter().filter_map(|node| {
            let one = model
                .objects
                .iter()
                .find(|part| part.nodes.contains(node))?;
            Some(format!(
                "{} ({})",
                one.id,
                units(one.coordinate).displacement
            ))
        });
        let outputs: Vec<String> = outputs.collect();
        if !outputs.is_empty() {
            out.push_str(&format!("  outputs {}\n", outputs.join(", ")));
        }
        if body.friction.is_some() {
            let pairs = friction_description(&linkage.spec().linkage);
            out.push_str(&format!("  joint friction {pairs}\n"));
        }
    }
    out
}

/// What moves each input of a linkage of several, in words.
pub fn moved_by<'m>(
    model: &'m Model,
    body: &'m MultiLinkageBody,
) -> impl Iterator<Item = String> + 'm {
    body.inputs
        .iter()
        .map(|&node| match &model.nodes[node].motion {
            NodeMotion::Rigid { law } => {
                let mut parts = model.objects.iter();
                let driver = parts.find(|part| part.nodes.last() == Some(&law.driver));
                format!(
                    "moved by {}",
                    driver.map_or("its driver", |part| part.id.as_str())
                )
            }
            _ => "free".to_owned(),
        })
}

/// The pairs with friction, each with its numbers.
fn friction_description(linkage: &LinkageSpec) -> String {
    let millimetres = |length: f64| significant(1e3 * length, 4);
    let pairs = linkage.pairs.iter().filter(|pair| pair.friction > 0.0);
    let of = |pair: &PairSpec| {
        let size = match pair.kind {
            PairKind::Revolute { diameter } => format!("d = {} mm", millimetres(diameter)),
            PairKind::Sliding {
                corners: [forward, back],
                half_height,
                ..
            } => format!(
                "corners at {} and {} mm, height {} mm",
                millimetres(forward),
                millimetres(back),
                millimetres(2.0 * half_height)
            ),
        };
        let friction = significant(pair.friction, 4);
        format!("{} (μ = {friction}, {size})", pair.name)
    };
    pairs.map(of).collect::<Vec<_>>().join(", ")
}
