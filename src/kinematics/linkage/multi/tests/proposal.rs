//! Inputs that are proposed where some are lacking.

use super::examples::{excavator, five_bar, floating, pendulum, platform};
use super::{MultiLinkage, MultiMotion};
use crate::kinematics::linkage::multi::proposal;
use crate::kinematics::linkage::multi::spec::{InputCoordinate, InputSpec, MultiSpec};
use crate::kinematics::linkage::spec::{AssemblyChoice, AssemblySpec, OutputKind};
use crate::math::jet::Jet;

fn bare(mut spec: MultiSpec) -> MultiSpec {
    spec.inputs.clear();
    spec
}

fn turned(spec: &mut MultiSpec, link: usize, angle: f64) {
    let choice = AssemblyChoice::Angle(angle);
    spec.linkage.assembly.push(AssemblySpec { link, choice });
}

/// The inputs of a proposal about pairs, read as a scene would read them.
fn inputs(spec: &MultiSpec, text: &str) -> Vec<InputSpec> {
    let json: serde_json::Value = serde_json::from_str(&format!("{{ {text} }}")).unwrap();
    let members = json.as_object().unwrap().iter();
    let one = |(name, of): (&String, &serde_json::Value)| {
        let named = of["pair"].as_str().unwrap();
        let pair = spec
            .linkage
            .pairs
            .iter()
            .position(|pair| pair.name == named);
        let start = of.get("start").map_or(0.0, |start| {
            let (number, unit) = start.as_str().unwrap().split_once(' ').unwrap();
            let number: f64 = number.parse().unwrap();
            if unit == "deg" {
                number.to_radians()
            } else {
                number
            }
        });
        InputSpec {
            name: name.clone(),
            coordinate: InputCoordinate::Pair(pair.unwrap()),
            start,
        }
    };
    members.map(one).collect()
}

#[test]
fn pairs_are_taken_from_the_ground_outwards_where_the_assembly_has_them() {
    let mut chain = bare(pendulum(3));
    turned(&mut chain, 0, 0.5);
    turned(&mut chain, 1, 0.25);
    // Backwards, so that no order of the pairs is an outward one.
    chain.linkage.pairs.reverse();
    assert_eq!(
        proposal(&chain).unwrap(),
        r#""pin0": { "pair": "pin0", "start": "28.6479 deg" }, "pin1": { "pair": "pin1", "start": "-14.3239 deg" }, "pin2": { "pair": "pin2" }"#
    );
    assert_eq!(proposal(&pendulum(3)), None);
}

#[test]
fn what_nothing_joins_to_the_ground_floats() {
    let mut free = bare(floating());
    let place = AssemblyChoice::Near {
        point: [0.0; 2],
        place: [0.2, -0.1],
    };
    free.linkage.assembly.push(AssemblySpec {
        link: 1,
        choice: place,
    });
    let text = proposal(&free).unwrap();
    let wanted = r#""crank_x": { "x": "crank", "start": "0.2 m" }, "crank_y": { "y": "crank", "start": "-0.1 m" }, "crank_angle": { "angle": "crank" }, "#;
    assert!(text.starts_with(wanted), "{text}");
    // What is there already stays.
    let mut lacks = floating();
    lacks.inputs.remove(1);
    let text = proposal(&lacks).unwrap();
    assert!(text.contains("pair") && !text.contains("crank_x"), "{text}");
}

/// Two rods almost in line: with the cranks as inputs, their pin would turn much faster than these.
#[test]
fn a_better_choice_is_proposed_near_a_singular_position() {
    let mut spec = bare(five_bar());
    turned(&mut spec, 0, 151.5f64.to_radians());
    turned(&mut spec, 3, 20f64.to_radians());
    let fastest = |spec: &MultiSpec| -> f64 {
        let linkage = MultiLinkage::new(spec.clone()).unwrap();
        let mut motion = MultiMotion::new(&linkage);
        let still = |input: &InputSpec| Jet {
            value: input.start,
            ..Jet::default()
        };
        let inputs: Vec<Jet> = spec.inputs.iter().map(still).collect();
        motion.set_inputs(&inputs).unwrap();
        let mut most = 0.0f64;
        for pair in 0..spec.linkage.pairs.len() {
            let mut first = vec![0.0; inputs.len()];
            motion.output_transfer(&OutputKind::Pair { pair }, &mut first);
            most = first.iter().fold(most, |most, rate| most.max(rate.abs()));
        }
        most
    };
    let mut cranks = spec.clone();
    cranks.inputs = inputs(
        &spec,
        r#""O": { "pair": "O", "start": "151.5 deg" }, "P": { "pair": "P", "start": "20 deg" }"#,
    );
    let text = proposal(&spec).unwrap();
    let mut proposed = spec.clone();
    proposed.linkage.assembly.clear();
    proposed.inputs = inputs(&spec, &text);
    let (before, after) = (fastest(&cranks), fastest(&proposed));
    assert!(before > 5.0 && after < 2.0, "{before} {after}: {text}");
    // It is put together as before.
    let end = |spec: &MultiSpec| {
        let linkage = MultiLinkage::new(spec.clone()).unwrap();
        let [x, y] = linkage.workspace::<f64>().pose(1).to_ground([0.7, 0.0]);
        [x, y]
    };
    let (one, other) = (end(&cranks), end(&proposed));
    assert!(
        (one[0] - other[0]).hypot(one[1] - other[1]) < 1e-4,
        "{text}"
    );
    // Its order among the pairs does not matter.
    let mut backwards = spec.clone();
    backwards.linkage.pairs.reverse();
    backwards.linkage.forces.clear();
    backwards.linkage.outputs.clear();
    assert_eq!(proposal(&backwards).unwrap(), text);
}

#[test]
fn every_linkage_gets_a_choice_that_it_takes() {
    for spec in [five_bar(), excavator(), platform(), pendulum(4), floating()] {
        let mut few = spec.clone();
        while few.inputs.pop().is_some() {
            if few
                .inputs
                .iter()
                .any(|input| input.coordinate.floating_link().is_some())
            {
                continue;
            }
            assert!(proposal(&few).is_some(), "{:?}", few.inputs);
        }
    }
    let mut few = five_bar();
    few.inputs.pop();
    let faults = MultiLinkage::new(few).unwrap_err();
    let told = &faults[0].hint;
    assert!(
        told.contains(r#"it would do with "P": { "pair": "P" }, each"#),
        "{told}"
    );
}
