//! The JSON Schema of scenes says yes and no where the reading does, by the word
//! of a validator that is not `dam`'s.

use dam::object::Registry;
use dam::scene::{BuiltIn, Document, Overrides, schema};
use std::fs;
use std::path::{Path, PathBuf};

const EVERYTHING: &str = include_str!("../../tests/schema_scene.json");

fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}

fn files(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let Ok(entries) = fs::read_dir(folder) else {
        return found;
    };
    for entry in entries {
        let path = entry.expect("an entry").path();
        if path.is_dir() {
            found.extend(files(&path));
        } else if path
            .extension()
            .is_some_and(|extension| extension == "json")
        {
            found.push(path);
        }
    }
    found.sort();
    found
}

fn validator() -> jsonschema::Validator {
    jsonschema::draft202012::new(&schema(&Registry::standard())).expect("a sound schema")
}

fn errors(scene: &serde_json::Value) -> String {
    let found = validator()
        .iter_errors(scene)
        .map(|e| format!("{}: {e}", e.instance_path()))
        .collect::<Vec<_>>();
    found.join("\n")
}

#[test]
fn a_scene_with_every_property_is_valid() {
    let scene: serde_json::Value = serde_json::from_str(EVERYTHING).expect("JSON");
    assert_eq!(errors(&scene), "");
}

/// The schema cannot say everything that the reading checks, but what it
/// refuses the reading must refuse too, and plain slips it must refuse itself.
#[test]
fn the_schema_refuses_plain_slips() {
    let validator = validator();
    let sound: serde_json::Value =
        serde_json::from_str(include_str!("../../tests/rocker_scene.json")).expect("JSON");
    assert!(validator.is_valid(&sound));
    type Slip = fn(&mut serde_json::Value);
    let slips: [(&str, Slip); 10] = [
        ("version", |scene| scene["dam"] = 2.into()),
        ("unknown property", |scene| {
            scene["objects"]["rocker"]["mases"] = 2.into()
        }),
        ("unknown kind", |scene| {
            scene["objects"]["rocker"]["kind"] = "roker".into()
        }),
        ("no position", |scene| {
            scene["objects"]["rocker"]
                .as_object_mut()
                .unwrap()
                .remove("position");
        }),
        ("no number", |scene| {
            scene["objects"]["rocker"]["inertia"] = "~0.1".into()
        }),
        ("negative", |scene| {
            scene["objects"]["rocker"]["stiffness"] = (-1).into()
        }),
        ("closure", |scene| {
            scene["objects"]["rocker"]["pair"]["closure"] = "glue".into()
        }),
        ("reserved id", |scene| {
            scene["objects"]["run"] = scene["objects"]["shaft"].clone()
        }),
        ("two positions", |scene| {
            scene["objects"]["rocker"]["position"]["ratio"] = 2.into()
        }),
        ("method", |scene| scene["run"]["method"] = "rk45".into()),
    ];
    for (name, slip) in slips {
        let mut scene = sound.clone();
        slip(&mut scene);
        assert!(!validator.is_valid(&scene), "{name}");
        let document = Document::parse("slip.json", scene.to_string().as_bytes()).expect("JSON");
        assert!(
            document.scene(&BuiltIn, &Overrides::none()).is_err(),
            "{name}"
        );
    }
    let mut copied = sound;
    copied["objects"]["rocker"] = serde_json::json!({ "from": "rocker/lever", "input": "shaft" });
    assert!(validator.is_valid(&copied));
}

#[test]
fn the_committed_scenes_are_valid() {
    for path in files(&root().join("scenarios")) {
        if path.ends_with("scene.schema.json") {
            continue;
        }
        let text = fs::read_to_string(&path).expect("a scene");
        let scene: serde_json::Value = serde_json::from_str(&text).expect("JSON");
        assert_eq!(errors(&scene), "", "{}", path.display());
    }
}
