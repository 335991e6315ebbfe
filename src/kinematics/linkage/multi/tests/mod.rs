//! Kinematics and equations of motion against differences of positions alone.

mod cams;
mod cut;
pub(super) mod examples;
mod geared;
mod kinetostatics;
mod margins;
mod motion;
mod proposal;
mod redundant;
mod refusals;
mod singular;
mod welds;

use super::spec::MultiSpec;
use super::{MultiLinkage, MultiMotion, MultiWorkspace};
use crate::kinematics::linkage::spec::{ForceLaw, OutputKind, PointOf};
use crate::math::number::{Dual, Number};
use examples::all;

/// Position and rates near the start.
fn state(spec: &MultiSpec) -> (Vec<f64>, Vec<f64>) {
    let q = spec.inputs.iter().enumerate();
    let q = q
        .map(|(k, input)| input.start + 0.01 * (k as f64 + 1.0))
        .collect();
    let rates = (0..spec.inputs.len())
        .map(|k| 0.9 - 0.7 * k as f64)
        .collect();
    (q, rates)
}

/// All outputs of a position.
fn outputs(spec: &MultiSpec, space: &mut MultiWorkspace<f64>, q: &[f64]) -> Vec<f64> {
    let zero = vec![0.0; q.len()];
    space.solve(q, &zero).unwrap();
    let mut first = vec![0.0; q.len()];
    let outputs = spec.linkage.outputs.iter();
    outputs
        .map(|output| space.output(&output.kind, &mut first)[0])
        .collect()
}

/// Moved along a direction by a part of it.
fn moved(q: &[f64], along: &[f64], part: f64) -> Vec<f64> {
    q.iter().zip(along).map(|(q, way)| q + part * way).collect()
}

#[test]
fn every_pair_stays_closed() {
    for spec in all() {
        let linkage = MultiLinkage::new(spec.clone()).unwrap();
        let mut space = linkage.workspace::<f64>();
        let (q, rates) = state(&spec);
        space.solve(&q, &rates).unwrap();
        for pair in &spec.linkage.pairs {
            let place = |point: PointOf| match point.link {
                Some(link) => space.pose(link).to_ground(point.at),
                None => point.at,
            };
            let [p, r] = [place(pair.on), place(pair.link)];
            let gap = [r[0] - p[0], r[1] - p[1]];
            let off = match pair.direction() {
                None => gap[0].hypot(gap[1]),
                Some([u, v]) => {
                    let along = pair.on.link.map_or([u, v], |link| {
                        let pose = space.pose(link);
                        [pose.cos * u - pose.sin * v, pose.sin * u + pose.cos * v]
                    });
                    along[0] * gap[1] - along[1] * gap[0]
                }
            };
            assert!(off.abs() < 1e-14, "{}: {off:e}", pair.name);
        }
    }
}

#[test]
fn inputs_are_the_coordinates_that_they_name() {
    use super::spec::InputCoordinate;
    use crate::kinematics::linkage::spec::OutputSpec;
    for mut spec in all() {
        let kind = |coordinate: InputCoordinate| match coordinate {
            InputCoordinate::Pair(pair) => OutputKind::Pair { pair },
            InputCoordinate::Angle(link) => OutputKind::Angle { link },
            InputCoordinate::X(link) | InputCoordinate::Y(link) => OutputKind::Point {
                point: PointOf {
                    link: Some(link),
                    at: [0.0; 2],
                },
                direction: match coordinate {
                    InputCoordinate::X(_) => 0.0,
                    _ => std::f64::consts::FRAC_PI_2,
                },
            },
        };
        let outputs = spec.inputs.iter().map(|input| OutputSpec {
            name: input.name.clone(),
            kind: kind(input.coordinate),
        });
        spec.linkage.outputs = outputs.collect();
        let linkage = MultiLinkage::new(spec.clone()).unwrap();
        let mut space = linkage.workspace::<f64>();
        let (q, rates) = state(&spec);
        space.solve(&q, &rates).unwrap();
        let mut first = vec![0.0; q.len()];
        for (k, output) in linkage.outputs().iter().enumerate() {
            let [value, bent] = space.output(&output.kind, &mut first);
            approx::assert_abs_diff_eq!(value, q[k], epsilon = 1e-13);
            approx::assert_abs_diff_eq!(bent, 0.0, epsilon = 1e-11);
            for (other, first) in first.iter().enumerate() {
                let wanted = f64::from(u8::from(other == k));
                approx::assert_abs_diff_eq!(*first, wanted, epsilon = 1e-12);
            }
        }
    }
}

#[test]
fn derivatives_of_outputs_are_differences_of_positions() {
    let h = 1e-4;
    for spec in all() {
        let linkage = MultiLinkage::new(spec.clone()).unwrap();
        let mut space = linkage.workspace::<f64>();
        let (q, rates) = state(&spec);
        let here = outputs(&spec, &mut space, &q);
        let [before, after] = [-h, h].map(|h| outputs(&spec, &mut space, &moved(&q, &rates, h)));
        let mut at = Vec::new();
        for input in 0..q.len() {
            let mut unit = vec![0.0; q.len()];
            unit[input] = 1.0;
            let [one, other] = [-h, h].map(|h| outputs(&spec, &mut space, &moved(&q, &unit, h)));
            at.push([one, other]);
        }
        space.solve(&q, &rates).unwrap();
        for (index, output) in spec.linkage.outputs.iter().enumerate() {
            let mut first = vec![0.0; q.len()];
            let [value, bent] = space.output(&output.kind, &mut first);
            approx::assert_relative_eq!(value, here[index], max_relative = 1e-14);
            for (first, [one, other]) in first.iter().zip(&at) {
                let slope = (other[index] - one[index]) / (2.0 * h);
                approx::assert_relative_eq!(*first, slope, max_relative = 1e-5, epsilon = 1e-6);
            }
            let bend = (after[index] - 2.0 * value + before[index]) / (h * h);
            approx::assert_relative_eq!(bent, bend, max_relative = 1e-4, epsilon = 1e-5);
        }
    }
}

/// Kinetic energy at rates, from differences of positions along them; and the potential.
fn energies(spec: &MultiSpec, space: &mut MultiWorkspace<f64>, q: &[f64], v: &[f64]) -> [f64; 2] {
    let h = 1e-4;
    let zero = vec![0.0; q.len()];
    let links = spec.linkage.links.len();
    let mut places = |h: f64| -> Vec<[f64; 3]> {
        space.solve(&moved(q, v, h), &zero).unwrap();
        let place = |link: usize| {
            let [x, y] = space.pose(link).to_ground(spec.linkage.links[link].centre);
            let pose = space.pose(link);
            [x, y, pose.sin.atan2(pose.cos)]
        };
        (0..links).map(place).collect()
    };
    // Differences of fourth order.
    let [a, b, c, d] = [-2.0 * h, -h, h, 2.0 * h].map(&mut places);
    let mut kinetic = 0.0;
    for (link, own) in spec.linkage.links.iter().enumerate() {
        let rate =
            |k: usize| (8.0 * (c[link][k] - b[link][k]) - (d[link][k] - a[link][k])) / (12.0 * h);
        kinetic += 0.5 * own.mass * (rate(0).powi(2) + rate(1).powi(2));
        kinetic += 0.5 * own.moment * rate(2).powi(2);
    }
    space.solve(q, v).unwrap();
    [kinetic, space.energies()[1]]
}

#[test]
fn the_mass_matrix_is_that_of_the_kinetic_energy() {
    for spec in all() {
        let linkage = MultiLinkage::new(spec.clone()).unwrap();
        let mut space = linkage.workspace::<f64>();
        let (q, v) = state(&spec);
        let [wanted, _] = energies(&spec, &mut space, &q, &v);
        space.reduce(true);
        let (m, mass) = (q.len(), &space.reduced.mass);
        let mut kinetic = 0.0;
        for i in 0..m {
            for j in 0..m {
                assert_eq!(mass[i * m + j], mass[j * m + i]);
                kinetic += 0.5 * mass[i * m + j] * v[i] * v[j];
            }
        }
        approx::assert_relative_eq!(kinetic, wanted, max_relative = 1e-9);
        approx::assert_relative_eq!(space.energies()[0], wanted, max_relative = 1e-9);
    }
}

/// Lagrange's equations: Qᵢ = ½·q̇ᵀ(∂M/∂qᵢ)q̇ − (dM/dt·q̇)ᵢ − ∂V/∂qᵢ, of weights and springs.
#[test]
fn the_forces_are_those_of_lagrange() {
    let h = 1e-4;
    for mut spec in all() {
        let keeps =
            |law: &ForceLaw| matches!(law, ForceLaw::Strut { .. } | ForceLaw::Torsion { .. });
        spec.linkage.forces.retain(|force| keeps(&force.law));
        for force in &mut spec.linkage.forces {
            if let ForceLaw::Strut { damping, .. } | ForceLaw::Torsion { damping, .. } =
                &mut force.law
            {
                *damping = 0.0;
            }
        }
        let linkage = MultiLinkage::new(spec.clone()).unwrap();
        let mut space = linkage.workspace::<f64>();
        let (q, v) = state(&spec);
        let m = q.len();
        let mut at = |q: &[f64]| {
            space.solve(q, &v).unwrap();
            space.reduce(true);
            let mass = space.reduced.mass.clone();
            let momentum = |i: usize| (0..m).map(|j| mass[i * m + j] * v[j]).sum::<f64>();
            let momenta: Vec<f64> = (0..m).map(momentum).collect();
            let kinetic: f64 = momenta.iter().zip(&v).map(|(p, v)| 0.5 * p * v).sum();
            (
                momenta,
                kinetic,
                space.energies()[1],
                space.reduced.force.clone(),
            )
        };
        let (before, after) = (at(&moved(&q, &v, -h)).0, at(&moved(&q, &v, h)).0);
        let force = at(&q).3;
        for i in 0..m {
            let mut unit = vec![0.0; m];
            unit[i] = 1.0;
            let (one, other) = (at(&moved(&q, &unit, -h)), at(&moved(&q, &unit, h)));
            let wanted = (other.1 - one.1 - other.2 + one.2) / (2.0 * h)
                - (after[i] - before[i]) / (2.0 * h);
            approx::assert_relative_eq!(force[i], wanted, max_relative = 2e-5, epsilon = 2e-5);
        }
    }
}

/// What dampers and forces take and give is what they do on the inputs.
#[test]
fn the_powers_are_those_of_the_forces_on_the_inputs() {
    let spec = examples::five_bar();
    let force = |spec: &MultiSpec| {
        let mut space = MultiLinkage::new(spec.clone()).unwrap().workspace::<f64>();
        let (q, v) = state(spec);
        space.solve(&q, &v).unwrap();
        space.reduce(true);
        let sum: f64 = space.reduced.force.iter().zip(&v).map(|(f, v)| f * v).sum();
        (sum, space.power())
    };
    let (whole, power) = force(&spec);
    let mut bare = spec.clone();
    bare.linkage
        .forces
        .retain(|force| matches!(force.law, ForceLaw::Strut { .. } | ForceLaw::Torsion { .. }));
    for force in &mut bare.linkage.forces {
        if let ForceLaw::Strut { damping, .. } | ForceLaw::Torsion { damping, .. } = &mut force.law
        {
            *damping = 0.0;
        }
    }
    let (rest, _) = force(&bare);
    assert!(power.dissipated > 0.1 && power.applied != 0.0);
    approx::assert_relative_eq!(
        whole - rest,
        power.applied - power.dissipated,
        max_relative = 1e-12
    );
}

/// Numbers with derivatives are those of the same equations.
#[test]
fn dual_numbers_are_differences_of_the_equations() {
    let h = 1e-6;
    for spec in all() {
        let linkage = MultiLinkage::new(spec.clone()).unwrap();
        let mut space = linkage.workspace::<f64>();
        let mut duals = linkage.workspace::<Dual>();
        let (q, v) = state(&spec);
        let m = q.len();
        let along: Vec<f64> = (0..2 * m).map(|k| 0.4 - 0.3 * k as f64).collect();
        let of = |values: &[f64], along: &[f64]| -> Vec<Dual> {
            let pairs = values.iter().zip(along);
            pairs.map(|(&value, &way)| Dual::new(value, way)).collect()
        };
        duals
            .solve(&of(&q, &along[..m]), &of(&v, &along[m..]))
            .unwrap();
        duals.reduce(true);
        let mut at = |h: f64| {
            let (q, v) = (moved(&q, &along[..m], h), moved(&v, &along[m..], h));
            space.solve(&q, &v).unwrap();
            space.reduce(true);
            let mut all = space.reduced.mass.clone();
            all.extend(&space.reduced.force);
            let mut first = vec![0.0; m];
            for output in &spec.linkage.outputs {
                all.extend(space.output(&output.kind, &mut first));
                all.extend(&first);
            }
            all
        };
        let (before, here, after) = (at(-h), at(0.0), at(h));
        let mut found = duals.reduced.mass.clone();
        found.extend(&duals.reduced.force);
        let mut first = vec![Dual::from(0.0); m];
        for output in &spec.linkage.outputs {
            found.extend(duals.output(&output.kind, &mut first));
            found.extend(&first);
        }
        for (index, found) in found.iter().enumerate() {
            approx::assert_relative_eq!(
                found.value(),
                here[index],
                max_relative = 1e-11,
                epsilon = 1e-12
            );
            let slope = (after[index] - before[index]) / (2.0 * h);
            let size = here[index].abs().max(1.0);
            approx::assert_abs_diff_eq!(found.derivative / size, slope / size, epsilon = 2e-6);
        }
    }
}

/// An output as a constraint: its value and all derivatives to the third.
#[test]
fn outputs_as_constraints_have_their_derivatives() {
    use super::MultiOutput;
    use crate::kinematics::constraint::{ConstraintFunction, ConstraintJet};
    let h = 1e-5;
    for spec in [
        examples::five_bar(),
        examples::floating(),
        examples::platform(),
    ] {
        let linkage = MultiLinkage::new(spec.clone()).unwrap();
        let (q, _) = state(&spec);
        let m = q.len();
        for output in 0..spec.linkage.outputs.len() {
            let constraint = MultiOutput::new(&linkage, output);
            let at = |q: &[f64]| {
                let mut jet = ConstraintJet::new(m);
                constraint.jet(q, &mut jet);
                jet
            };
            let here = at(&q);
            for l in 0..m {
                let mut unit = vec![0.0; m];
                unit[l] = 1.0;
                let (one, other) = (at(&moved(&q, &unit, -h)), at(&moved(&q, &unit, h)));
                let near = |found: f64, one: f64, other: f64| {
                    let slope = (other - one) / (2.0 * h);
                    approx::assert_relative_eq!(found, slope, max_relative = 1e-5, epsilon = 1e-5);
                };
                near(here.first[l], one.value, other.value);
                for i in 0..m {
                    near(here.second[i * m + l], one.first[i], other.first[i]);
                    for j in 0..m {
                        let place = i * m + j;
                        near(
                            here.third[place * m + l],
                            one.second[place],
                            other.second[place],
                        );
                    }
                }
            }
        }
    }
}
