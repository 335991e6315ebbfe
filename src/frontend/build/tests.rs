//! Builders know what the schema knows.

use super::*;
use crate::dynamics::laws::{OF_LOADS, contact};
use crate::frontend::object::{BUILT, Registry};
use crate::frontend::read::Node;
use crate::frontend::scene::schema;
use serde_json::Value as Json;
use std::collections::BTreeSet;

fn names<'n>(names: impl IntoIterator<Item = &'n str>) -> BTreeSet<String> {
    names.into_iter().map(str::to_owned).collect()
}

/// The properties of an object that the schema describes at a path.
fn described(schema: &Json, path: &[&str]) -> BTreeSet<String> {
    let mut at = &schema["$defs"];
    for (depth, name) in path.iter().enumerate() {
        at = if depth == 0 {
            &at[name]
        } else {
            &at["properties"][name]
        };
        if let Some(reference) = at["$ref"].as_str() {
            at = &schema["$defs"][reference.trim_start_matches("#/$defs/")];
        }
    }
    // One of several forms is the object.
    let forms = at["anyOf"].as_array();
    let object = forms.and_then(|forms| forms.iter().find(|form| form["type"] == "object"));
    let properties = object.unwrap_or(at)["properties"].as_object();
    let properties = properties.unwrap_or_else(|| panic!("no object at {path:?}"));
    // A builder has one name for a property.
    let second = |schema: &Json| {
        let doc = schema["description"].as_str();
        doc.is_some_and(|doc| doc.starts_with("Another name of"))
    };
    let own = properties.iter().filter(|(_, schema)| !second(schema));
    own.map(|(name, _)| name.clone()).collect()
}

/// Checks that methods and constructors together set what the schema describes.
fn same(schema: &Json, path: &[&str], methods: &[&str], others: &[&str]) {
    let known = names(methods.iter().chain(others).copied());
    assert_eq!(known, described(schema, path), "{path:?}");
}

#[test]
fn every_property_of_every_kind_can_be_built() {
    let schema = schema(&Registry::standard());
    let of_all = ["kind", "input", "from", "loads", "stops"];
    for (kind, methods) in BUILT {
        let (known, methods) = (described(&schema, &[kind]), names(methods.iter().copied()));
        assert!(methods.is_subset(&known), "{kind}: {methods:?}");
        let rest: Vec<&String> = known.difference(&methods).collect();
        let is_common = |own: &&String| of_all.contains(&own.as_str());
        assert!(rest.iter().all(is_common), "{kind}: {rest:?}");
    }
    let of_sums = [
        "kind",
        "from",
        "inputs",
        "loads",
        "stops",
        "planetary",
        "lever",
    ];
    same(
        &schema,
        &["differential"],
        Differential::PROPERTIES,
        &of_sums,
    );
    let of_drives = ["kind", "from", "motion", "motor", "loads"];
    same(&schema, &["drive"], Drive::PROPERTIES, &of_drives);
    let of_linkages = [
        "kind",
        "from",
        "input",
        "dimensions",
        "ground",
        "links",
        "pairs",
        "couplings",
        "assembly",
        "forces",
        "outputs",
        "inputs",
    ];
    same(&schema, &["linkage"], Linkage::PROPERTIES, &of_linkages);
    let of_inputs = ["pair", "x", "y", "angle", "loads"];
    same(
        &schema,
        &["linkage_input"],
        LinkageInput::PROPERTIES,
        &of_inputs,
    );
    same(
        &schema,
        &["linkage_link"],
        Link::PROPERTIES,
        &["points", "geometry"],
    );
    same(
        &schema,
        &["linkage_pair"],
        Joint::PROPERTIES,
        &["revolute", "sliding", "weld"],
    );
    same(&schema, &["rocker", "pair"], Pair::PROPERTIES, &["closure"]);
    same(&schema, &["sliding_stop"], Stop::PROPERTIES, &[]);
    // (What a contact law declares is set by its name, with or without a method.)
    let of_laws = contact::properties().into_iter().map(|(own, _)| own.key);
    let of_contacts: Vec<&str> = of_laws.chain(["from"]).collect();
    let contact = ["rocker", "pair", "contact"];
    same(&schema, &contact, Contact::PROPERTIES, &of_contacts);
    let from = ["rocker", "pair", "contact", "from"];
    let [line, point] = ["line", "point"].map(|shape| [&from[..], &[shape]].concat());
    same(&schema, &line, LineContact::PROPERTIES, &[]);
    same(&schema, &point, PointContact::PROPERTIES, &[]);
    let on_cam = [&from[..], &["cam"]].concat();
    same(&schema, &on_cam, CamContact::PROPERTIES, &["load"]);
}

#[test]
fn every_law_and_option_of_loads_can_be_built() {
    let schema = schema(&Registry::standard());
    let laws: Vec<&str> = Load::LAWS.iter().map(|law| law.0).collect();
    // (What the file of a law declares is set by its name, with or without a method.)
    let declared = OF_LOADS.iter().map(|law| law.key);
    let others: Vec<&str> = declared.chain(["mass", "unit", "over"]).collect();
    same(&schema, &["load"], &laws, &others);
    for (law, options) in Load::LAWS.iter().filter(|law| !law.1.is_empty()) {
        same(&schema, &["load", law], options, &[]);
    }
}

#[test]
fn every_position_function_and_option_can_be_built() {
    let schema = schema(&Registry::standard());
    let functions: Vec<&str> = Position::FUNCTIONS.iter().map(|one| one.0).collect();
    same(&schema, &["position"], &functions, &[]);
    let mut options = BTreeSet::new();
    for (function, made_with) in Position::FUNCTIONS {
        let all = described(&schema, &["position", function]);
        let given = names(made_with.iter().copied());
        assert!(given.is_subset(&all), "{function}");
        options.extend(all.difference(&given).cloned());
    }
    assert_eq!(options, names(Position::OPTIONS.iter().copied()));
}

#[test]
fn dimensions_and_cams_can_be_built() {
    let schema = schema(&Registry::standard());
    let kinds = BUILT.iter().filter(|(_, own)| own.contains(&"geometry"));
    let geometries = kinds.map(|(kind, _)| described(&schema, &[kind, "geometry"]));
    let all: BTreeSet<String> = geometries.flatten().collect();
    assert_eq!(all, names(Geometry::PROPERTIES.iter().copied()));
    same(&schema, &["disc_cam"], DiscCam::PROPERTIES, &[]);
}

#[test]
fn stations_forces_and_outputs_can_be_built() {
    let schema = schema(&Registry::standard());
    let plan = &schema["$defs"]["position"]["properties"]["plan"]["properties"];
    let station = plan["stations"]["items"]["properties"].as_object();
    let known = Station::PROPERTIES.iter().chain(&["at", "displacement"]);
    let in_schema: BTreeSet<String> = station.unwrap().keys().cloned().collect();
    assert_eq!(names(known.copied()), in_schema);
    assert!(LinkageForce::PROPERTIES.is_empty() && AnyObject::PROPERTIES.contains(&"input"));
    let json = |node: Node| serde_json::to_value(node).unwrap();
    let made = [
        LinkageForce::constant("a.b", 1, 2),
        LinkageForce::couple("a", 1),
        LinkageForce::spring("a.b", "c.d", 1, 2),
        LinkageForce::damper("a.b", "c.d", 1),
        LinkageForce::torsion("a", 1, 2),
        LinkageForce::table("a.b", [(0, 1)]),
    ];
    for force in made.map(|force| json(force.into())) {
        for (law, options) in force.as_object().unwrap() {
            let given = names(options.as_object().unwrap().keys().map(String::as_str));
            assert!(
                given.is_subset(&described(&schema, &["linkage_force", law])),
                "{law}"
            );
        }
    }
    let couplings = [
        Coupling::internal_gears(["a", "b"], [20, 40]).carrier("c"),
        Coupling::crossed_belt(["a", "b"], [0.04, 0.08]).offset(0.1),
        Coupling::rack("a", "b", 0.03),
        Coupling::cam("a.C", "b.R", 0.05)
            .roller_radius(0.01)
            .lift(Position::sine(0.002).harmonic(2))
            .direction("30 deg")
            .sense("clockwise")
            .surface("groove"),
    ];
    for coupling in couplings.map(|coupling| json(coupling.into())) {
        for (kind, options) in coupling.as_object().unwrap() {
            let given = names(options.as_object().unwrap().keys().map(String::as_str));
            let known = described(&schema, &["linkage_coupling", kind]);
            assert!(given.is_subset(&known), "{kind}: {known:?}");
        }
    }
}

#[test]
fn a_built_value_is_the_json_that_says_the_same() {
    let json = |node: Node| serde_json::to_value(node).unwrap();
    let drive = Drive::run_up("600 rpm", 0.5).angle(1).law("sine");
    let wanted = r#"{"kind":"drive","motion":{"run_up":{"speed":"600 rpm","time":0.5,"angle":1,"law":"sine"}}}"#;
    assert_eq!(
        json(drive.into()),
        serde_json::from_str::<Json>(wanted).unwrap()
    );
    let motor = Drive::motor(0.2, Torque::linear(100, 20)).start_speed(5);
    let wanted = r#"{"kind":"drive","motor":{"inertia":0.2,"torque":{"linear":{"stall_torque":100,"no_load_speed":20}},"speed":5}}"#;
    assert_eq!(
        json(motor.into()),
        serde_json::from_str::<Json>(wanted).unwrap()
    );
    let window = Load::window("30 deg", "60 deg", -40)
        .period(3.0)
        .mass("first");
    let wanted =
        r#"{"window":{"from":"30 deg","to":"60 deg","force":-40,"period":3},"mass":"first"}"#;
    assert_eq!(
        json(window.into()),
        serde_json::from_str::<Json>(wanted).unwrap()
    );
    let pair = Rocker::on("a").set("pair.gap", 1e-3);
    let wanted = r#"{"kind":"rocker","input":"a","pair":{"gap":0.001}}"#;
    assert_eq!(
        json(pair.into()),
        serde_json::from_str::<Json>(wanted).unwrap()
    );
}

#[test]
fn what_has_no_method_is_set_by_its_name() {
    let friction = Load::new()
        .set("friction.force", 5)
        .set("friction.width", 0.1);
    assert_eq!(friction, Load::friction(5, 0.1));
    assert_eq!(Load::new().set("viscous", 2), Load::viscous(2));
    // The law need not be set first.
    let spring = Node::from(Load::new().mass("all").set("spring.rate", 3).preload(1));
    let spring = spring.get("spring").expect("a law");
    assert!(spring.get("rate").is_some() && spring.get("preload").is_some());
    let rack = Coupling::new()
        .set("rack.wheels", ["a", "b"])
        .set("rack.radius", 0.03);
    assert_eq!(rack.offset(0.1), Coupling::rack("a", "b", 0.03).offset(0.1));
}
