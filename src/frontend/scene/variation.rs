//! A scene decoded thousands of times with other values of the same few
//! properties: only the objects that hold them are decoded anew.

use super::address::{RESERVED, Step};
use super::objects::{self, ObjectTable};
use super::{Catalogue, Document, Levels, Overrides, StartSpec, TypedScene, overrides, run};
use crate::frontend::diagnostics::{Diagnostic, Diagnostics, Severity, Sources};
use crate::frontend::object::numbers;
use crate::frontend::read::{Files, Node, Parameters, Reader};

/// A scene with some properties set that are to be set again. Its scenes have
/// no hash: that of the values in force is not worked out.
#[derive(Debug)]
pub struct Variation {
    root: Node,
    scene: TypedScene,
    known: ObjectTable,
    /// The settings in force; none after settings that could not be taken.
    settings: Vec<String>,
    /// Levels of the objects that leave theirs open.
    levels: Levels,
    /// See [`Self::laws`].
    laws: u64,
    parameters: Parameters,
    files: Files,
}

impl Variation {
    /// Decodes a document with fixed overrides and first settings of the
    /// properties that vary.
    ///
    /// # Errors
    /// Everything that is wrong, as [`Document::scene`] says it.
    pub fn new(
        document: &Document,
        catalogue: &dyn Catalogue,
        fixed: &[String],
        settings: &[String],
    ) -> Result<Self, Diagnostics> {
        let all = fixed.iter().chain(settings).cloned();
        let reading = document.scene(catalogue, &Overrides::new(all))?;
        let files = reading.places.files().clone();
        let root = reading.places.into_root();
        let mut scene = reading.scene;
        scene.hash.clear();
        // What objects know of each other is not kept by a reading.
        let mut known = ObjectTable::new(document.kinds());
        let parameters = reading.parameters;
        Reader::of_parts(&parameters, &files).read(root.get("objects"), "objects", |slot| {
            objects::read(slot, &mut known)
        });
        Ok(Self {
            known,
            root,
            scene,
            settings: settings.to_vec(),
            levels: document.levels().clone(),
            laws: 0,
            parameters,
            files,
        })
    }

    /// The scene as it stands.
    pub fn scene(&self) -> &TypedScene {
        &self.scene
    }

    /// How often anything but plain numbers of chains was set, which change no
    /// law of motion: as long as this stays the same, all laws of motion, the
    /// duration and the number of masses do.
    pub fn laws(&self) -> u64 {
        self.laws
    }

    /// Sets the properties, in the order of [`Self::new`]; `None`: the scene
    /// must be decoded as a whole, since there is something wrong with these
    /// settings or they reach beyond the object they address.
    pub fn set(&mut self, settings: &[String]) -> Option<&TypedScene> {
        let before = std::mem::take(&mut self.settings);
        let mut touched: Vec<String> = Vec::new();
        for (number, setting) in settings.iter().enumerate() {
            if before.get(number) == Some(setting) {
                continue;
            }
            if let Some(name) = self.apply_setting(setting)?
                && !touched.contains(&name)
            {
                touched.push(name);
            }
        }
        self.laws += touched.len() as u64;
        for name in touched {
            match name.as_str() {
                "run" => self.read_run()?,
                id => self.read_object(id)?,
            }
            self.scene.set_levels(&self.levels);
        }
        self.settings = settings.to_vec();
        Some(&self.scene)
    }

    /// Puts a setting into the tree; returns the object that must be read, or
    /// `run`. `None`: it cannot be taken. No object: it is in the scene already.
    fn apply_setting(&mut self, setting: &str) -> Option<Option<String>> {
        let (mut sources, mut faults) = (Sources::default(), Vec::new());
        let one = Overrides::new([setting]);
        let changes = overrides::read(&one, &mut sources, &mut faults);
        let change = changes.first().filter(|change| !change.chooses_from())?;
        overrides::apply(&mut self.root, change).ok()?;
        match &change.parts[0].step {
            Step::Name(name) if name == "run" => Some(Some(name.clone())),
            Step::Name(name) if !RESERVED.contains(&name.as_str()) => {
                let number = change.number();
                let set = number.is_some_and(|number| self.set_number(setting, name, number));
                Some((!set).then(|| name.clone()))
            }
            _ => None,
        }
    }

    /// Sets a number of an object in place, where that is the same as reading.
    fn set_number(&mut self, setting: &str, id: &str, value: f64) -> bool {
        let address = setting.split('=').next().unwrap_or("").trim_end();
        let property = address.strip_prefix(id).and_then(|p| p.strip_prefix('.'));
        let written = self.root.get("objects").and_then(|all| all.get(id));
        let object = self.scene.objects.get_mut(id);
        let (Some(property), Some(written), Some(entry)) = (property, written, object) else {
            return false;
        };
        numbers::set(entry.object.as_mut(), written, property, value)
    }

    fn read_run(&mut self) -> Option<()> {
        let (node, known) = (self.root.get("run")?, &self.known);
        let mut reader = Reader::of_parts(&self.parameters, &self.files);
        let (found, _) = reader.read(Some(node), "run", |slot| run::read(slot, known));
        self.scene.run = read_without_faults(&reader, found)?;
        Some(())
    }

    fn read_object(&mut self, id: &str) -> Option<()> {
        let node = self.root.get("objects")?.get(id)?;
        let before = *self.known.objects.get(id)?;
        let mut reader = Reader::of_parts(&self.parameters, &self.files);
        let known = &mut self.known;
        let (found, _) = reader.read(Some(node), id, |slot| objects::read_object(slot, id, known));
        // The start has been read for the masses that there were.
        let after = known.objects.insert(id.to_owned(), before);
        let starts = matches!(self.scene.run.start, StartSpec::Explicit(_));
        let found =
            read_without_faults(&reader, found).filter(|_| !starts || after == Some(before))?;
        let place = self.scene.objects.get_mut(id)?;
        // What others see of it must not have changed.
        let same =
            place.connections == found.connections && place.object.ports() == found.object.ports();
        same.then(|| *place = found)
    }
}

/// What was read, if nothing was wrong with it.
fn read_without_faults<T>(reader: &Reader, found: Option<T>) -> Option<T> {
    let wrong = |fault: &Diagnostic| fault.severity == Severity::Error;
    found.filter(|_| !reader.diagnostics.iter().any(wrong))
}

#[cfg(test)]
mod tests {
    use super::{Document, Overrides, Variation};
    use crate::frontend::lower::lower;
    use crate::frontend::scene::BuiltIn;

    const SCENE: &str = r#"{ "dam": 1, "name": "two",
        "objects": {
          "cam": { "kind": "drive", "motion": { "speed": "10 rev/s" } },
          "arm": { "kind": "rocker", "input": "cam", "position": { "sine": { "amplitude": 1 } },
            "inertia": 0.1, "stiffness": 1e6, "masses": 2, "pair": { "closure": "force" },
            "loads": { "closing": { "constant": -600 } } },
          "tip": { "kind": "rocker", "input": "arm", "position": { "ratio": 2 },
            "inertia": 0.01, "masses": 0 } },
        "run": { "duration": 1, "start": "static" } }"#;

    fn document() -> Document {
        Document::parse("scene.json", SCENE.as_bytes()).unwrap()
    }

    /// What a scene is lowered to, and how it is run.
    fn meaning(scene: &super::TypedScene) -> String {
        let run = &scene.run;
        format!("{:?} {run:?} {}", lower(scene), scene.name)
    }

    #[test]
    fn a_varied_scene_is_the_scene_decoded_as_a_whole() {
        let fixed = ["run.tolerance=1e-8".to_owned()];
        let document = document();
        let sets = [
            ["arm.inertia=0.2", "arm.stiffness=2e6"],
            ["arm.inertia=0.2", "arm.stiffness=3e6"],
            ["arm.inertia=\"300 kg cm2\"", "arm.stiffness=3e6"],
        ];
        let others = [
            ["cam.motion.speed=\"90 rpm\"", "run.duration=2"],
            ["cam.motion.speed=\"80 rpm\"", "run.duration=3"],
        ];
        let masses = [
            ["arm.masses=2", "tip.inertia=1"],
            ["arm.masses=3", "tip.inertia=2"],
        ];
        for sets in [&sets[..], &others, &masses] {
            let strings = |set: &[&str; 2]| set.map(str::to_owned);
            let first = strings(&sets[0]);
            let mut varied = Variation::new(&document, &BuiltIn, &fixed, &first).unwrap();
            for set in sets.iter().chain(sets.iter().rev()) {
                let all = fixed.iter().cloned().chain(strings(set));
                let whole = document.scene(&BuiltIn, &Overrides::new(all));
                let own = varied
                    .set(&strings(set))
                    .unwrap_or_else(|| panic!("{set:?}"));
                assert_eq!(meaning(own), meaning(&whole.unwrap().scene), "{set:?}");
                assert_eq!(own.hash, "");
            }
        }
    }

    #[test]
    fn numbers_set_in_place_mean_what_is_read() {
        let document = document();
        // The second value of each is set in place where that is the same.
        for (first, second, in_place) in [
            ("arm.inertia=0.2", "arm.inertia=0.3", true),
            ("arm.stiffness=2e6", "arm.stiffness=3e6", true),
            ("arm.damping_capacity=0.2", "arm.damping_capacity=0", true),
            (
                "arm.loads.closing.constant=-700",
                "arm.loads.closing.constant=7",
                true,
            ),
            ("tip.inertia=0.02", "tip.inertia=0", true),
            ("arm.damping=3", "arm.damping=4", false),
            ("arm.damping=3", "arm.inertia=0.4", false),
            ("arm.inertia=0.2", "arm.inertia=\"400 kg cm2\"", false),
            ("arm.masses=2", "arm.masses=1", false),
            ("tip.position.ratio=2", "tip.position.ratio=3", false),
            ("cam.motion.speed=10", "cam.motion.speed=20", false),
            ("tip.stiffness=3", "tip.stiffness=4", false),
        ] {
            let first = [first.to_owned()];
            let mut varied = Variation::new(&document, &BuiltIn, &[], &first).unwrap();
            let before = varied.laws();
            let both = [first[0].clone(), second.to_owned()];
            let whole = document.scene(&BuiltIn, &Overrides::new(both));
            let own = meaning(varied.set(&[second.to_owned()]).unwrap());
            assert_eq!(own, meaning(&whole.unwrap().scene), "{second}");
            assert_eq!(varied.laws() == before, in_place, "{second}");
        }
        // What is not allowed is refused as before, and leaves no trace.
        let good = ["arm.inertia=0.2".to_owned()];
        let mut varied = Variation::new(&document, &BuiltIn, &[], &good).unwrap();
        let wanted = meaning(varied.scene());
        for bad in [
            "arm.inertia=0",
            "arm.inertia=-1",
            "arm.inertia=1e999",
            "arm.inertia=1e-320",
        ] {
            assert!(varied.set(&[bad.to_owned()]).is_none(), "{bad}");
            assert_eq!(meaning(varied.set(&good).unwrap()), wanted, "{bad}");
        }
    }

    #[test]
    fn what_is_wrong_or_reaches_further_is_left_to_the_whole() {
        let document = document();
        let good = ["arm.inertia=0.2".to_owned()];
        let mut varied = Variation::new(&document, &BuiltIn, &[], &good).unwrap();
        let wanted = meaning(varied.scene());
        for bad in [
            "arm.inertia=-1",
            "arm.inertia=\"5 kg\"",
            "arm.input=nobody",
            "tip.input=cam",
            "arm.kind=slider",
            "tip.kind=slider",
            "nobody.inertia=1",
            "name=other",
            "arm.from=rocker/steel-lever-205mm",
            "no assignment",
        ] {
            let mut varied = Variation::new(&document, &BuiltIn, &[], &good).unwrap();
            assert!(varied.set(&[bad.to_owned()]).is_none(), "{bad}");
        }
        // After a bad value a good one is taken again, and leaves no trace of it.
        for bad in ["arm.inertia=-1", "arm.inertia=\"5 kg\""] {
            assert!(varied.set(&[bad.to_owned()]).is_none(), "{bad}");
            assert_eq!(meaning(varied.set(&good).unwrap()), wanted, "{bad}");
        }
    }
}
