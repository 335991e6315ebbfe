//! One linkage of several inputs on rotors at constant ratios, nothing elastic anywhere: the
//! equations of motion without the passes.

use crate::dynamics::system::frozen::{Frozen, Step};
use crate::dynamics::system::passes::Work;
use crate::dynamics::system::written::FrozenExpression;
use crate::math::linear::dense;
use crate::math::quantity::Quantity;

/// A linkage of several inputs whose inputs follow a rotor each.
#[derive(Clone, Debug, Default)]
pub(in crate::dynamics::system) struct Direct {
    /// Of each input the rotor, and the constants of all that goes with it.
    inputs: Vec<Drive>,
    /// The nodes that loads look at: number of the input, and how they follow its rotor.
    members: Vec<(usize, Member)>,
    /// Loads that are not constant: index, number of the input, ratio of its node.
    loads: Vec<(usize, usize, f64)>,
}

/// A rotor with what hangs on it.
#[derive(Clone, Copy, Debug)]
struct Drive {
    coordinate: usize,
    /// q = `ratio`·φ + `offset`.
    ratio: f64,
    offset: f64,
    /// Constant inertia of rotor and shafts, reduced to the rotor.
    inertia: f64,
    /// Constant loads on them, likewise.
    force: f64,
}

/// A node: φ = `ratio`·φ_rotor + `offset`.
#[derive(Clone, Copy, Debug)]
struct Member {
    node: usize,
    ratio: f64,
    offset: f64,
}

/// The inputs, where a system consists of nothing else; `None` for any other.
pub(in crate::dynamics::system) fn direct(frozen: &Frozen) -> Option<Direct> {
    let [multi] = &frozen.multi[..] else {
        return None;
    };
    let rubs = !frozen.groups.is_empty() || frozen.several.is_some() || !frozen.dry.is_empty();
    let apart = frozen.chains.is_empty() && !rubs && frozen.heavy.is_empty();
    if !apart || !frozen.linkages.is_empty() || !frozen.branches.is_empty() {
        return None;
    }
    // Rotor, ratio and offset of every node.
    let mut places: Vec<Option<(usize, f64, f64)>> = vec![None; frozen.inertia.len()];
    let mut rotors = Vec::new();
    for step in &frozen.steps {
        match step {
            Step::Rotor(rotor) => {
                places[rotor.node] = Some((rotor.coordinate, 1.0, 0.0));
                rotors.push(rotor.coordinate);
            }
            Step::Rigid(index) => {
                let rigid = frozen.rigids[*index];
                let law = &frozen.laws[rigid.law];
                let [ratio, offset] = law.position.constant_ratio()?;
                let (rotor, own, shift) = places[law.driver]?;
                let (ratio, offset) = (law.lever * ratio, law.lever * offset);
                places[rigid.node] = Some((rotor, own * ratio, shift * ratio + offset));
            }
            // What follows the linkage and bears nothing.
            Step::Constrained(index) => {
                frozen.constraints[*index].multi?;
            }
            Step::Prescribed(_) | Step::Chain(_) => return None,
        }
    }
    let mut found = Direct::default();
    for &node in &multi.nodes {
        let (coordinate, ratio, offset) = places[node]?;
        let taken = |own: &Drive| own.coordinate == coordinate;
        if found.inputs.iter().any(taken) {
            return None;
        }
        found.inputs.push(Drive {
            coordinate,
            ratio,
            offset,
            inertia: 0.0,
            force: 0.0,
        });
    }
    let number = |coordinate: usize| {
        let mut inputs = found.inputs.iter();
        inputs.position(|own| own.coordinate == coordinate)
    };
    if !rotors.into_iter().all(|rotor| number(rotor).is_some()) {
        return None;
    }
    let numbers: Vec<Option<usize>> = places.iter().map(|own| number((*own)?.0)).collect();
    for (node, place) in places.iter().enumerate() {
        let (inertia, force) = (frozen.inertia[node], frozen.constant_force[node]);
        match (place, numbers[node]) {
            (Some((_, ratio, _)), Some(number)) => {
                found.inputs[number].inertia += ratio * ratio * inertia;
                found.inputs[number].force += ratio * force;
            }
            _ if inertia == 0.0 && force == 0.0 => {}
            _ => return None,
        }
    }
    for (index, load) in frozen.loads.iter().enumerate() {
        let axis = load.argument.as_ref().and_then(|axis| axis.node);
        let written = load.written.iter().flat_map(FrozenExpression::nodes);
        for node in [load.node].into_iter().chain(axis).chain(written) {
            let ((_, ratio, offset), number) = (places[node]?, numbers[node]?);
            found.members.push((
                number,
                Member {
                    node,
                    ratio,
                    offset,
                },
            ));
        }
        if !load.has_series {
            return None;
        }
        found
            .loads
            .push((index, numbers[load.node]?, places[load.node]?.1));
    }
    Some(found)
}

impl Frozen {
    /// The accelerations of the rotors.
    #[inline]
    pub(in crate::dynamics::system) fn evaluate_direct<N: Quantity>(
        &self,
        direct: &Direct,
        (time, state, modes): (N, &[N], &[i64]),
        work: &mut Work<N>,
        out: &mut [N],
    ) {
        let (u, v) = state.split_at(self.coordinates);
        let count = direct.inputs.len();
        let own = &mut work.multi[0];
        for (number, drive) in direct.inputs.iter().enumerate() {
            own.inputs[number] = u[drive.coordinate].scale(drive.ratio) + N::from(drive.offset);
            own.rates[number] = v[drive.coordinate].scale(drive.ratio);
        }
        let finite = own.inputs.iter().all(|q| q.value().is_finite());
        own.assembled = finite && own.space.solve(&own.inputs, &own.rates).is_ok();
        if !own.assembled {
            return out.fill(N::from(f64::NAN));
        }
        own.space.reduce(true);
        let reduced = &own.space.reduced;
        let dense = &mut work.dense;
        let (matrix, right) = (
            &mut dense.matrix[..count * count],
            &mut dense.right[..count],
        );
        for (i, one) in direct.inputs.iter().enumerate() {
            for (j, other) in direct.inputs[..=i].iter().enumerate() {
                let mass = reduced.mass[i * count + j];
                matrix[i * count + j] = mass.scale(one.ratio * other.ratio);
            }
            matrix[i * count + i] += N::from(one.inertia);
            right[i] = reduced.force[i].scale(one.ratio) + N::from(one.force);
        }
        for &(number, member) in &direct.members {
            let coordinate = direct.inputs[number].coordinate;
            work.displacement[member.node] =
                u[coordinate].scale(member.ratio) + N::from(member.offset);
            work.speed[member.node] = v[coordinate].scale(member.ratio);
        }
        for &(index, number, ratio) in &direct.loads {
            let force = self.load(index, time, modes, work);
            work.dense.right[number] += force.scale(ratio);
        }
        let dense = &mut work.dense;
        let (matrix, right) = (
            &mut dense.matrix[..count * count],
            &mut dense.right[..count],
        );
        dense::factorise_symmetric(matrix, count);
        dense::solve_symmetric(matrix, right);
        for (drive, &acceleration) in direct.inputs.iter().zip(right.iter()) {
            out[drive.coordinate] = acceleration;
        }
    }
}
