//! The JSON Schema is fresh and describes what the reading takes. A validator of
//! others judges it in `peers/tests/schema.rs`.

use dam::object::{Inputs, Registry};
use dam::scene::{BuiltIn, Document, Folder, LayeredCatalogue, Overrides, schema, schema_text};
use std::path::{Path, PathBuf};
use std::{env, fs};

const EVERYTHING: &str = include_str!("../schema_scene.json");

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
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

/// `DAM_BLESS=1 cargo test --test program schema` writes it anew.
#[test]
fn the_committed_schema_is_fresh() {
    let path = root().join("scenarios/scene.schema.json");
    if env::var_os("DAM_BLESS").is_some() {
        fs::write(&path, schema_text(&schema(&Registry::standard()))).expect("writing");
    }
    let committed = fs::read_to_string(&path).unwrap_or_default();
    assert!(
        committed == schema_text(&schema(&Registry::standard())),
        "scenarios/scene.schema.json is stale: run DAM_BLESS=1 cargo test --test program schema"
    );
}

#[test]
fn a_scene_with_every_property_is_read() {
    let document = Document::parse("everything.json", EVERYTHING.as_bytes()).expect("JSON");
    let reading = document.scene(&BuiltIn, &Overrides::none());
    if let Err(diagnostics) = &reading {
        panic!("{diagnostics}");
    }
}

/// Every property that the schema describes is used in a scene or catalogue object that the tests
/// here read, so that none can be described without being read.
#[test]
fn every_described_property_is_exercised() {
    let schema = schema(&Registry::standard());
    let mut exercised = EVERYTHING.to_owned();
    for folder in ["scenarios", "objects"] {
        let texts = files(&root().join(folder)).into_iter();
        let texts = texts.filter(|path| !path.ends_with("scene.schema.json"));
        exercised.extend(texts.map(|path| fs::read_to_string(path).expect("a scene")));
    }
    exercised.extend(laws_of_numbers(&schema).iter().map(ToString::to_string));
    let mut described = Vec::new();
    names(&schema, &mut described);
    described.sort();
    described.dedup();
    assert!(described.len() > 80, "{} properties", described.len());
    for name in described {
        assert!(
            exercised.contains(&format!("\"{name}\"")),
            "`{name}` is not exercised"
        );
    }
}

/// Where laws of forces are described, and a drive and an object behind it that have one.
const PLACES_OF_LAWS: [(&str, &str); 3] = [
    (
        "/turning_load",
        r#"{ "drive": { "kind": "drive", "motion": { "speed": 1 } },
            "it": { "kind": "crank", "input": "drive", "position": { "ratio": 1 },
                    "inertia": 1, "stiffness": 1000, "loads": { "own": LAW } } }"#,
    ),
    (
        "/drive/properties/motor/properties/torque",
        r#"{ "it": { "kind": "drive", "motor": { "inertia": 1, "torque": LAW } } }"#,
    ),
    (
        "/drive/properties/motor/properties/force",
        r#"{ "it": { "kind": "drive", "coordinate": "sliding",
                     "motor": { "mass": 1, "force": LAW } } }"#,
    ),
];

/// Objects with each law of a force that is described by numbers alone.
fn laws_of_numbers(schema: &serde_json::Value) -> Vec<serde_json::Value> {
    let mut found = Vec::new();
    for (place, objects) in PLACES_OF_LAWS {
        let laws = schema["$defs"].pointer(place).expect("laws are described");
        let one_of = laws["allOf"][0]["oneOf"].as_array().expect("one law");
        for name in one_of.iter().map(|one| &one["required"][0]) {
            let key = name.as_str().expect("a law");
            if let Some(numbers) = numbers(&laws["properties"][key]) {
                let law = serde_json::json!({ key: numbers }).to_string();
                let objects = objects.replace("LAW", &law);
                found.push(serde_json::from_str(&objects).expect("JSON"));
            }
        }
    }
    found
}

/// What a form takes that has nothing but numbers; `None`: it has something else.
fn numbers(form: &serde_json::Value) -> Option<serde_json::Value> {
    if let Some(properties) = form["properties"].as_object() {
        let entry = |(name, own)| Some((String::clone(name), number(own)?.into()));
        let all: Option<serde_json::Map<_, _>> = properties.iter().map(entry).collect();
        return all.filter(|_| form.get("allOf").is_none()).map(Into::into);
    }
    number(form).map(Into::into)
}

/// The number 1, or the nearest to it that a form takes.
fn number(form: &serde_json::Value) -> Option<f64> {
    let forms = form["anyOf"].as_array();
    let forms = forms.map_or(std::slice::from_ref(form), Vec::as_slice);
    let own = forms.iter().find(|own| own["type"] == "number")?;
    let bound = |keyword: &str, none: f64| own[keyword].as_f64().unwrap_or(none);
    let least = bound("minimum", f64::NEG_INFINITY);
    Some(1f64.max(least).min(bound("maximum", f64::INFINITY)))
}

#[test]
fn laws_of_numbers_alone_are_read() {
    let laws = laws_of_numbers(&schema(&Registry::standard()));
    assert!(laws.len() >= 7, "{} laws", laws.len());
    for objects in laws {
        let scene = serde_json::json!({
            "dam": 1, "name": "law", "run": { "duration": 1 }, "objects": objects,
        });
        let document = Document::parse("law.json", scene.to_string().as_bytes()).expect("JSON");
        if let Err(diagnostics) = document.scene(&BuiltIn, &Overrides::none()) {
            panic!("{objects}: {diagnostics}");
        }
    }
}

fn names(schema: &serde_json::Value, found: &mut Vec<String>) {
    match schema {
        serde_json::Value::Object(map) => {
            for (keyword, value) in map {
                if keyword == "properties"
                    && let Some(properties) = value.as_object()
                {
                    found.extend(properties.keys().cloned());
                }
                names(value, found);
            }
        }
        serde_json::Value::Array(items) => items.iter().for_each(|item| names(item, found)),
        _ => {}
    }
}

#[test]
fn the_committed_scenes_are_read_and_name_the_schema() {
    for path in files(&root().join("scenarios")) {
        if path.ends_with("scene.schema.json") {
            continue;
        }
        let text = fs::read_to_string(&path).expect("a scene");
        let scene: serde_json::Value = serde_json::from_str(&text).expect("JSON");
        let named = scene["$schema"].as_str().unwrap_or_default();
        let schema = path.parent().expect("a folder").join(named);
        assert!(
            named.ends_with("scene.schema.json") && schema.exists(),
            "{}: {named}",
            path.display()
        );
        let document = Document::parse("scene.json", text.as_bytes()).expect("JSON");
        let beside = Folder::beside_scene(&path);
        let catalogue = LayeredCatalogue(&beside, &BuiltIn);
        if let Err(diagnostics) = document.scene(&catalogue, &Overrides::none()) {
            panic!("{}: {diagnostics}", path.display());
        }
    }
}

/// A scene with a catalogue object and what that needs, behind a drive with this motion.
fn scene_of(name: &str, drive: &serde_json::Value) -> serde_json::Value {
    use dam::scene::Catalogue;
    let (_, text) = BuiltIn.lookup(name).expect("a built-in object");
    let own: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    for property in ["kind", "source", "description"] {
        assert!(own[property].is_string(), "{name} has no `{property}`");
    }
    let registry = Registry::standard();
    let kind = registry.kind(own["kind"].as_str().expect("a text"));
    let inputs = kind.expect("a kind of the library").inputs;
    let is_left = |property: &str| own.get(property).is_none();
    let mut object = serde_json::json!({ "from": name });
    // (Of several inputs each hangs on what it says, or on nothing.)
    if is_left("input") && is_left("inputs") {
        match inputs {
            Inputs::None => {}
            Inputs::One | Inputs::OneOrSeveral => object["input"] = "the_drive".into(),
            Inputs::Several => {
                let drive = serde_json::json!({ "object": "the_drive" });
                object["inputs"] = serde_json::json!({ "sun": drive, "ring": drive });
            }
        }
    }
    let properties = &schema(&registry)["$defs"][own["kind"].as_str().expect("a text")];
    let has_position = properties["properties"].get("position").is_some();
    if has_position && is_left("position") && is_left("inputs") {
        object["position"] = serde_json::json!({ "ratio": 1 });
    }
    serde_json::json!({
        "dam": 1, "name": "catalogue", "run": { "duration": 1 },
        "objects": { "it": object, "the_drive": drive },
    })
}

#[test]
fn built_in_catalogue_objects_can_be_read() {
    use dam::scene::Catalogue;
    let drive = serde_json::json!({ "kind": "drive", "motion": { "speed": 1 } });
    for name in BuiltIn.names() {
        let scene = scene_of(&name, &drive);
        let document =
            Document::parse("catalogue.json", scene.to_string().as_bytes()).expect("JSON");
        if let Err(diagnostics) = document.scene(&BuiltIn, &Overrides::none()) {
            panic!("{name}: {diagnostics}");
        }
    }
}

/// Whether `dam check` finds a scene right, and everything that it says of it but that.
fn checked(scene: &str) -> (bool, String) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("scene.json");
    fs::write(&path, scene).expect("writing");
    let check = std::process::Command::new(env!("CARGO_BIN_EXE_dam"))
        .arg("check")
        .arg(&path)
        .output()
        .expect("the program");
    let said = String::from_utf8_lossy(&check.stderr).into_owned();
    (check.status.success(), said)
}

/// Wherever the drive stands at the start: what a catalogue object says of itself suits it there.
#[test]
fn catalogue_objects_and_templates_give_no_warning_of_themselves() {
    use dam::scene::Catalogue;
    for name in BuiltIn.names() {
        let mut right = 0;
        for k in 0..8 {
            let turning = serde_json::json!({ "speed": 1, "angle": 0.1 + 0.8 * f64::from(k) });
            let sliding =
                serde_json::json!({ "speed": 0.01, "displacement": 0.21 + 0.02 * f64::from(k) });
            let drives = [
                serde_json::json!({ "kind": "drive", "motion": turning }),
                serde_json::json!({ "kind": "drive", "coordinate": "sliding", "motion": sliding }),
            ];
            // What is driven by a sliding input says so of a turning one.
            let checks = drives.map(|drive| checked(&scene_of(&name, &drive).to_string()));
            let fit = checks.iter().filter(|(is_right, _)| *is_right);
            for (_, said) in fit {
                assert!(!said.contains("approximate"), "{name}, {k}: {said}");
                assert!(!said.contains("warning"), "{name}, {k}: {said}");
                right += 1;
            }
        }
        assert!(right >= 8, "{name} is right {right} times");
    }
    for template in ["lever", "cam", "linkage", "press", "shaft"] {
        let new = std::process::Command::new(env!("CARGO_BIN_EXE_dam"))
            .args(["new", template])
            .output()
            .expect("the program");
        let (is_right, said) = checked(&String::from_utf8_lossy(&new.stdout));
        assert!(is_right && !said.contains("warning"), "{template}: {said}");
    }
}

/// What is offered for a property of a kind.
fn offered(schema: &serde_json::Value, kind: &str, property: &str) -> Vec<String> {
    let examples = &schema["$defs"][kind]["properties"][property]["examples"];
    let texts = examples.as_array().into_iter().flatten();
    texts
        .map(|text| text.as_str().unwrap().to_owned())
        .collect()
}

#[test]
fn editors_are_offered_units_catalogue_objects_and_the_ids_of_a_scene() {
    let general = schema(&Registry::standard());
    let units = offered(&general, "rocker", "stiffness");
    for unit in ["1 N m/rad", "1 kN m/rad"] {
        assert!(units.iter().any(|text| text == unit), "{units:?}");
    }
    assert_eq!(offered(&general, "slider", "masses"), [""; 0]);
    let from = offered(&general, "rocker", "from");
    assert!(from.iter().any(|name| name == "rocker/steel-lever-205mm"));
    // Only what is of this kind.
    assert!(
        from.iter().all(|name| name.starts_with("rocker/")),
        "{from:?}"
    );
    assert_eq!(offered(&general, "rocker", "input"), [""; 0]);
    // A scene that is being written: its objects are faulty still.
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("scene.json");
    fs::write(
        &path,
        r#"{ "dam": 1, "objects": { "shaft": { "kind": "drive" },
            "press": { "from": "linkage/toggle-press" }, "lever": { "kind": "rocker", "input": "" } } }"#,
    )
    .unwrap();
    let own = folder.path().join("objects");
    fs::create_dir(&own).unwrap();
    fs::write(own.join("mine.json"), r#"{ "kind": "rocker" }"#).unwrap();
    let printed = std::process::Command::new(env!("CARGO_BIN_EXE_dam"))
        .arg("schema")
        .arg(&path)
        .output()
        .unwrap();
    assert_eq!(printed.status.code(), Some(0));
    let printed: serde_json::Value = serde_json::from_slice(&printed.stdout).unwrap();
    let input = offered(&printed, "rocker", "input");
    for id in ["shaft", "press", "lever", "press.ram"] {
        assert!(input.iter().any(|text| text == id), "{id}: {input:?}");
    }
    assert!(offered(&printed, "rocker", "from").contains(&"mine".to_owned()));
}
