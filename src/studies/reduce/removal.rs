//! What may be left out of a scene, each as a change of its tree.

use crate::dynamics::builder::spec::{Level, Lumping};
use crate::frontend::read::{Node, Value};
use crate::frontend::scene::edit::{property, remove_property, set_property};

/// Something that is left out of a scene, or modelled more simply.
#[derive(Clone, Debug, PartialEq)]
pub struct Removal {
    /// The object.
    pub object: String,
    /// What of it.
    pub part: Part,
}

/// What is left out of an object.
#[derive(Clone, Debug, PartialEq)]
pub enum Part {
    /// More of its elasticity than a level has.
    Level {
        /// The level before.
        from: Level,
        /// The lesser one.
        to: Level,
    },
    /// Its pair's opening: a pair that never opens is bilateral.
    Opening,
    /// The contact element of its pair.
    Contact,
    /// A load, by its name; of a linkage a spring, damper or force.
    Load(String),
    /// A stop, by its name.
    Stop(String),
    /// Friction in all joints of a linkage.
    JointFriction,
    /// Friction in one joint of a linkage.
    Friction(String),
    /// Weights of the links of a linkage.
    Gravity,
    /// Masses of all links of a linkage.
    Masses,
    /// Mass of one link of a linkage.
    Mass(String),
}

/// Properties of an object that give its level.
const LEVEL: [&str; 4] = ["masses", "lumping", "modes", "flexibility"];
/// Properties of a link that give its inertia.
const INERTIA: [&str; 5] = ["mass", "centre", "moment", "moment_of_inertia", "geometry"];

/// Everything that may be left out of the scene's objects, but for their levels.
/// `never_opens`: whether the pair of an object stays closed throughout the run.
pub(super) fn possible_removals(root: &Node, never_opens: impl Fn(&str) -> bool) -> Vec<Removal> {
    let objects = root.get("objects").map_or(&[][..], Node::members);
    let mut all = Vec::new();
    for object in objects {
        let of = |part| Removal {
            object: object.name.clone(),
            part,
        };
        let parts = removable_parts(&object.value, never_opens(&object.name));
        all.extend(parts.into_iter().map(of));
    }
    all
}

fn removable_parts(object: &Node, never_opens: bool) -> Vec<Part> {
    let names = |property: &str| {
        let members = object.get(property).map_or(&[][..], Node::members);
        members.iter().map(|member| member.name.clone())
    };
    let mut parts: Vec<Part> = names("loads")
        .chain(names("forces"))
        .map(Part::Load)
        .collect();
    parts.extend(names("stops").map(Part::Stop));
    if never_opens && (object.get("pair").is_some() || object.get("backlash").is_some()) {
        parts.push(Part::Opening);
    }
    if object
        .get("pair")
        .is_some_and(|pair| pair.get("contact").is_some())
    {
        parts.push(Part::Contact);
    }
    if is_true(object.get("joint_friction")) {
        parts.push(Part::JointFriction);
        let pairs = object.get("pairs").map_or(&[][..], Node::members);
        let rough = pairs
            .iter()
            .filter(|pair| pair.value.get("friction").is_some());
        parts.extend(rough.map(|pair| Part::Friction(pair.name.clone())));
    }
    if object
        .get("gravity")
        .is_some_and(|gravity| gravity.value != Value::Flag(false))
    {
        parts.push(Part::Gravity);
    }
    let links = object.get("links").map_or(&[][..], Node::members);
    let heavy = links
        .iter()
        .filter(|link| INERTIA.iter().any(|name| link.value.get(name).is_some()));
    let heavy: Vec<String> = heavy.map(|link| link.name.clone()).collect();
    if !heavy.is_empty() {
        parts.push(Part::Masses);
    }
    if heavy.len() > 1 {
        parts.extend(heavy.into_iter().map(Part::Mass));
    }
    parts
}

fn is_true(node: Option<&Node>) -> bool {
    node.is_some_and(|node| node.value == Value::Flag(true))
}

impl Removal {
    /// True when the other leaves out what this one does, and more.
    pub(super) fn is_within(&self, other: &Self) -> bool {
        let within = match (&self.part, &other.part) {
            (Part::Friction(_), Part::JointFriction) | (Part::Mass(_), Part::Masses) => true,
            (one, other) => one == other,
        };
        self.object == other.object && within
    }

    /// Changes the scene's tree; nothing where there is nothing to be left out.
    pub(super) fn apply(&self, root: &mut Node) {
        let id = &self.object;
        match &self.part {
            Part::Level { to, .. } => set_level(root, id, *to),
            Part::Opening => {
                remove_property(root, &format!("{id}.backlash"));
                for name in ["gap", "opens", "law"] {
                    remove_property(root, &format!("{id}.pair.{name}"));
                }
                set_property(root, &format!("{id}.pair.closure"), "bilateral");
            }
            Part::Contact => {
                remove_property(root, &format!("{id}.pair.contact"));
            }
            Part::Load(name) => {
                let _ = remove_property(root, &format!("{id}.loads.{name}"))
                    || remove_property(root, &format!("{id}.forces.{name}"));
            }
            Part::Stop(name) => {
                remove_property(root, &format!("{id}.stops.{name}"));
            }
            Part::JointFriction => {
                remove_property(root, &format!("{id}.joint_friction"));
            }
            Part::Friction(pair) => {
                remove_property(root, &format!("{id}.pairs.{pair}.friction"));
            }
            Part::Gravity => {
                remove_property(root, &format!("{id}.gravity"));
            }
            Part::Masses => {
                let links = property(root, &format!("{id}.links"));
                let links = links.map_or(&[][..], Node::members).iter();
                let links: Vec<String> = links.map(|link| link.name.clone()).collect();
                for link in links {
                    take_mass(root, id, &link);
                }
            }
            Part::Mass(link) => take_mass(root, id, link),
        }
    }
}

fn take_mass(root: &mut Node, id: &str, link: &str) {
    for name in INERTIA {
        remove_property(root, &format!("{id}.links.{link}.{name}"));
    }
}

/// Gives an object of the tree a level. Its state at the start, where that is given, is that
/// of the whole body.
pub(super) fn set_level(root: &mut Node, id: &str, level: Level) {
    for name in LEVEL {
        remove_property(root, &format!("{id}.{name}"));
    }
    match level {
        Level::Rigid => set_property(root, &format!("{id}.masses"), 0),
        Level::Static => set_property(root, &format!("{id}.flexibility"), "static"),
        Level::Modes { count } => set_property(root, &format!("{id}.modes"), count),
        Level::Masses { count, lumping } => {
            set_property(root, &format!("{id}.masses"), count);
            if lumping == Lumping::Balanced {
                set_property(root, &format!("{id}.lumping"), "balanced");
            }
        }
    }
    let start = format!("run.start.{id}");
    if level.coordinates() == 0 {
        remove_property(root, &start);
    }
    for name in ["displacement", "speed"] {
        let address = format!("{start}.{name}");
        let whole = match property(root, &address).map(|node| &node.value) {
            Some(Value::List(masses)) => masses.first().cloned(),
            _ => None,
        };
        if let Some(whole) = whole {
            let count = match level {
                Level::Masses { count, .. } => count,
                _ => 1,
            };
            set_property(root, &address, vec![whole; count]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Part, Removal, possible_removals, set_level};
    use crate::dynamics::builder::spec::Level;
    use crate::frontend::scene::Document;

    fn scene() -> Document {
        let text = r#"{ "objects": {
            "lever": { "kind": "rocker", "masses": 3, "lumping": "balanced", "pair": { "closure": "force" },
                "loads": { "spring": {}, "weight": {} }, "stops": { "seat": {} } },
            "press": { "kind": "linkage", "joint_friction": true, "gravity": true,
                "pairs": { "pin": { "friction": 0.1 }, "slide": {} },
                "links": { "rod": { "mass": 1 }, "ram": { "geometry": {} }, "crank": {} } } },
            "run": { "start": { "lever": { "displacement": [1, 2, 3], "speed": [4, 5, 6] } } } }"#;
        Document::parse("scene", text.as_bytes()).expect("JSON")
    }

    #[test]
    fn what_a_scene_has_may_be_left_out() {
        let found = possible_removals(scene().root(), |id| id == "lever");
        let parts: Vec<&Part> = found.iter().map(|one| &one.part).collect();
        let name = |name: &str| name.to_owned();
        assert_eq!(
            parts,
            [
                &Part::Load(name("spring")),
                &Part::Load(name("weight")),
                &Part::Stop(name("seat")),
                &Part::Opening,
                &Part::JointFriction,
                &Part::Friction(name("pin")),
                &Part::Gravity,
                &Part::Masses,
                &Part::Mass(name("rod")),
                &Part::Mass(name("ram")),
            ]
        );
        let mut root = scene().root().clone();
        for one in &found {
            one.apply(&mut root);
        }
        assert_eq!(possible_removals(&root, |_| false), []);
        let one = |part| Removal {
            object: name("press"),
            part,
        };
        assert!(one(Part::Mass(name("rod"))).is_within(&one(Part::Masses)));
        assert!(!one(Part::Masses).is_within(&one(Part::Mass(name("rod")))));
    }

    #[test]
    fn a_level_takes_the_place_of_another_and_of_its_start() {
        let mut root = scene().root().clone();
        set_level(&mut root, "lever", Level::Modes { count: 2 });
        let text = root.json();
        assert!(text.contains(r#""modes":2"#), "{text}");
        assert!(
            !text.contains("masses") && !text.contains("lumping"),
            "{text}"
        );
        assert!(text.contains(r#""displacement":[1],"speed":[4]"#), "{text}");
        set_level(&mut root, "lever", Level::Rigid);
        let text = root.json();
        assert!(
            text.contains(r#""masses":0"#) && !text.contains("displacement"),
            "{text}"
        );
    }
}
