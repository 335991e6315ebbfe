//! What is refused, with its place.

use super::examples::{GROUND, five_bar, floating, input, pendulum, pin};
use crate::kinematics::linkage::multi::MultiLinkage;
use crate::kinematics::linkage::multi::spec::{InputCoordinate, MultiSpec};
use crate::kinematics::linkage::spec::{ForceLaw, ForceSpec};

fn refused(change: impl Fn(&mut MultiSpec), mut spec: MultiSpec) -> Vec<(String, String)> {
    change(&mut spec);
    let faults = MultiLinkage::new(spec).unwrap_err();
    faults
        .into_iter()
        .map(|fault| (fault.path, fault.message))
        .collect()
}

fn holds(found: &[(String, String)], path: &str, part: &str) {
    let one = found
        .iter()
        .find(|fault| fault.0 == path && fault.1.contains(part));
    assert!(one.is_some(), "{found:?}");
}

#[test]
fn too_few_inputs_and_too_many_are_told() {
    let few = refused(|spec| drop(spec.inputs.pop()), five_bar());
    holds(&few, "inputs", "1 inputs, and 4 moving links, 5 pairs");
    holds(
        &few,
        "links.left",
        "free to move while all inputs stand still",
    );
    let many = refused(
        |spec| {
            spec.inputs
                .push(input("third", InputCoordinate::Pair(2), 0.0))
        },
        five_bar(),
    );
    holds(&many, "inputs", "3 inputs");
}

#[test]
fn inputs_that_are_no_free_choice_are_told() {
    let twice = refused(
        |spec| spec.inputs[1].coordinate = InputCoordinate::Pair(0),
        five_bar(),
    );
    holds(&twice, "inputs.servo", "same coordinate");
    let part = refused(|spec| drop(spec.inputs.pop()), floating());
    holds(&part, "inputs.x", "floats by part");
    let again = refused(
        |spec| {
            spec.linkage
                .pairs
                .push(pin("again", (GROUND, [0.0, 0.0]), (Some(1), [0.5, 0.0])));
            spec.inputs
                .push(input("again", InputCoordinate::Pair(3), 0.0));
        },
        pendulum(3),
    );
    holds(&again, "inputs.again", "no free choice");
}

#[test]
fn what_cannot_be_assembled_is_told_in_metres() {
    let found = refused(|spec| spec.linkage.pairs[4].on.at = [5.0, 0.0], five_bar());
    holds(&found, "links.left", "cannot be joined at the start given");
}

#[test]
fn tables_over_one_input_are_refused() {
    let table = ForceSpec {
        name: "load".to_owned(),
        law: ForceLaw::CoupleTable {
            link: 0,
            points: vec![(0.0, 1.0)],
            period: None,
        },
    };
    let found = refused(|spec| spec.linkage.forces.push(table.clone()), five_bar());
    holds(&found, "forces.load", "linkage of one input");
}
