//! A scene's text, read once; decoded as often as wanted with other overrides.

mod hash;

use super::objects::ObjectTable;
use super::overrides::{self, Overrides};
use super::{Catalogue, Levels, TypedScene, address, root};
use crate::fault::Fault;
use crate::frontend::diagnostics::{Diagnostic, Diagnostics, Place, Severity, Source, Sources};
use crate::frontend::object::Registry;
use crate::frontend::read::{
    self, DeclaredNumber, Files, Member, Node, Parameters, Reader, TableFile, Value, did_you_mean,
};
use hash::hash;
use std::collections::BTreeMap;
use std::sync::{Arc, OnceLock};

/// A scene's text as a tree, and the kinds of objects that it may name.
#[derive(Clone, Debug)]
pub struct Document {
    sources: Sources,
    root: Node,
    registry: Registry,
    /// Levels of the objects that leave them open.
    levels: Levels,
    /// Text of the document, where that is not what it was read from.
    rewritten: Option<OnceLock<String>>,
}

/// A scene, read and checked, with what reading it left behind.
#[derive(Debug)]
pub struct Reading {
    /// The scene.
    pub scene: TypedScene,
    /// Warnings to the user.
    pub warnings: Diagnostics,
    /// The canonical scene: defaults filled in, SI units, names sorted.
    pub canonical: serde_json::Value,
    /// Places of the properties in the text.
    pub places: Places,
    /// Its named parameters.
    pub(super) parameters: Parameters,
}

/// Places of a scene's properties in its text.
#[derive(Clone, Debug)]
pub struct Places {
    sources: Sources,
    root: Node,
    files: Files,
}

impl Document {
    /// Reads a scene's text, with the standard kinds of objects. `name` is shown in
    /// diagnostics.
    ///
    /// # Errors
    /// Not UTF-8, larger than 4 MiB, nested deeper than 64, not strict JSON,
    /// names given twice.
    pub fn parse(name: &str, bytes: &[u8]) -> Result<Self, Diagnostics> {
        let mut sources = Sources::default();
        match read::parse(name, bytes, &mut sources) {
            Ok(root) => Ok(Self {
                sources,
                root,
                registry: Registry::standard(),
                levels: Levels::new(),
                rewritten: None,
            }),
            Err(faults) => Err(Diagnostics::new(sources, faults)),
        }
    }

    /// A scene made in code, of a tree without places: faults name the properties
    /// alone. With the standard kinds of objects.
    pub fn of_values(root: Node) -> Self {
        let mut sources = Sources::default();
        // Overrides are sources of their own, and come after it.
        sources.add(Arc::new(Source {
            name: "scene".to_owned(),
            text: String::new(),
        }));
        Self {
            sources,
            root,
            registry: Registry::standard(),
            levels: Levels::new(),
            rewritten: Some(OnceLock::new()),
        }
    }

    /// Changes the tree.
    pub fn edit(&mut self, change: impl FnOnce(&mut Node)) {
        change(&mut self.root);
        self.rewritten = Some(OnceLock::new());
    }

    /// The document as it was decoded: catalogue objects and tables of files copied in,
    /// properties overridden.
    #[must_use]
    pub fn decoded(&self, places: &Places) -> Self {
        let mut root = places.root.clone();
        read::put_in(&mut root, &places.files);
        Self {
            sources: places.sources.clone(),
            root,
            registry: self.registry.clone(),
            levels: self.levels.clone(),
            rewritten: Some(OnceLock::new()),
        }
    }

    /// The tree.
    pub fn root(&self) -> &Node {
        &self.root
    }

    /// The document with the kinds of objects of a registry.
    #[must_use]
    pub fn with_kinds(self, registry: Registry) -> Self {
        Self { registry, ..self }
    }

    /// The same with levels for objects that leave theirs open.
    #[must_use]
    pub fn with_levels(self, levels: Levels) -> Self {
        Self { levels, ..self }
    }

    /// Levels of the objects that leave theirs open.
    pub(crate) fn levels(&self) -> &Levels {
        &self.levels
    }

    /// The kinds of objects that it may name.
    pub fn kinds(&self) -> &Registry {
        &self.registry
    }

    /// The same without what it expects of a run and without remarks: quicker to
    /// decode where a scene is decoded thousands of times with other values.
    #[must_use]
    pub fn without_expectations(&self) -> Self {
        let mut bare = self.clone();
        if let Value::Object(members) = &mut bare.root.value {
            members.retain(|member| {
                !["expect", "description", "$schema"].contains(&member.name.as_str())
            });
        }
        bare
    }

    /// The text itself; of a scene made or changed in code, the JSON that says the
    /// same.
    pub fn text(&self) -> &str {
        match &self.rewritten {
            None => self.sources.get(0).map_or("", |source| &source.text),
            // A tree has no names that are no texts: it can be written.
            Some(text) => {
                text.get_or_init(|| serde_json::to_string_pretty(&self.root).unwrap_or_default())
            }
        }
    }

    /// Decodes the scene, with catalogue objects copied in and properties
    /// overridden.
    ///
    /// # Errors
    /// Everything that is wrong, at once; warnings among it.
    pub fn scene(
        &self,
        catalogue: &dyn Catalogue,
        overrides: &Overrides,
    ) -> Result<Reading, Diagnostics> {
        let mut sources = self.sources.clone();
        let mut faults = Vec::new();
        // Overrides are the first sources that are added.
        let first = sources.count();
        let tree = self.tree(catalogue, overrides, &mut sources, &mut faults);
        let mut reader = Reader::new();
        reader.overrides = first..first + overrides.arguments().len();
        reader.files = files(&tree, catalogue, &mut sources);
        let known = ObjectTable::new(&self.registry);
        let (read, canonical) = reader.read(Some(&tree), "", |slot| root::read(slot, known));
        let unused = reader.unused_parameters();
        let wrong = reader
            .diagnostics
            .iter()
            .any(|one| one.severity == Severity::Error);
        reader
            .diagnostics
            .extend(unused.into_iter().filter(|_| !wrong));
        for mut fault in reader.diagnostics {
            // As it is addressed everywhere else: `rocker.pair.gap`.
            if let Some(address) = fault.path.strip_prefix("objects.") {
                fault.path = address.to_owned();
            }
            faults.push(fault);
        }
        let diagnostics = Diagnostics::new(sources.clone(), faults);
        match read {
            Some(read) if !diagnostics.has_errors() => {
                let mut scene = TypedScene {
                    name: read.name,
                    objects: read.objects,
                    run: read.run,
                    steady: read.steady,
                    optimize: read.optimize,
                    tolerance: read.tolerance,
                    identify: read.identify,
                    expect: read.expect,
                    measured: read.measured,
                    hash: hash(&canonical),
                };
                scene.set_levels(&self.levels);
                Ok(Reading {
                    scene,
                    warnings: diagnostics,
                    canonical,
                    places: Places {
                        sources,
                        root: tree,
                        files: reader.files,
                    },
                    parameters: reader.parameters,
                })
            }
            _ => Err(diagnostics),
        }
    }

    /// The numbers that reading it meets, with what is declared of them.
    pub(super) fn declared(&self, catalogue: &dyn Catalogue) -> Vec<DeclaredNumber> {
        let (mut sources, mut faults) = (self.sources.clone(), Vec::new());
        let tree = self.tree(catalogue, &Overrides::none(), &mut sources, &mut faults);
        let known = ObjectTable::new(&self.registry);
        let mut reader = Reader::of_numbers();
        reader.read(Some(&tree), "", |slot| root::read(slot, known));
        reader.numbers()
    }

    /// What is known of its objects, however faulty they are, and what a catalogue offers.
    pub(super) fn object_table(&self, catalogue: &dyn Catalogue) -> ObjectTable {
        let (mut sources, mut faults) = (self.sources.clone(), Vec::new());
        let tree = self.tree(catalogue, &Overrides::none(), &mut sources, &mut faults);
        ObjectTable::new(&self.registry).offering(Some(&tree), catalogue)
    }

    /// Its tree with catalogue objects copied in, as far as there are any.
    #[cfg(feature = "live")]
    pub(super) fn copied(&self, catalogue: &dyn Catalogue) -> Node {
        let (mut sources, mut faults) = (self.sources.clone(), Vec::new());
        self.tree(catalogue, &Overrides::none(), &mut sources, &mut faults)
    }

    /// The tree to be decoded.
    fn tree(
        &self,
        catalogue: &dyn Catalogue,
        overrides: &Overrides,
        sources: &mut Sources,
        faults: &mut Vec<Diagnostic>,
    ) -> Node {
        let mut tree = self.root.clone();
        let changes = overrides::read(overrides, sources, faults);
        let (early, late): (Vec<_>, Vec<_>) =
            changes.iter().partition(|change| change.chooses_from());
        for change in early {
            faults.extend(
                overrides::apply(&mut tree, change)
                    .err()
                    .map(|fault| *fault),
            );
        }
        copy_from_catalogue(&mut tree, catalogue, sources, faults);
        for change in late {
            faults.extend(
                overrides::apply(&mut tree, change)
                    .err()
                    .map(|fault| *fault),
            );
        }
        tree
    }
}

/// Most files that a scene may name, and how large they may be together (bytes).
const MOST_FILES: usize = 100;
const MOST_OF_FILES: usize = 200_000_000;

/// Reads the files that a tree names.
fn files(tree: &Node, catalogue: &dyn Catalogue, sources: &mut Sources) -> Files {
    let (mut files, mut size) = (BTreeMap::new(), 0usize);
    for name in read::file_names(tree) {
        if files.contains_key(name) {
            continue;
        }
        let found = match files.len() < MOST_FILES && size <= MOST_OF_FILES {
            true => table_file(name, catalogue, sources, &mut size).map_err(|fault| *fault),
            false => {
                let message = format!(
                    "a scene takes at most {MOST_FILES} files, of {} MB together",
                    MOST_OF_FILES / 1_000_000
                );
                Err(Diagnostic::error("too-large", message))
            }
        };
        files.insert(name.to_owned(), found);
        // What comes after so many is wrong already.
        if files.len() > MOST_FILES {
            break;
        }
    }
    Arc::new(files)
}

fn table_file(
    name: &str,
    catalogue: &dyn Catalogue,
    sources: &mut Sources,
    size: &mut usize,
) -> Result<TableFile, Box<Diagnostic>> {
    let (name, bytes) = catalogue.table(name)?;
    *size += bytes.len();
    let wrong = |error: std::string::FromUtf8Error| {
        let at = error.utf8_error().valid_up_to();
        let line = error.as_bytes()[..at]
            .iter()
            .filter(|&&b| b == b'\n')
            .count()
            + 1;
        let message = format!("`{name}` is not UTF-8: line {line}");
        Box::new(Diagnostic::error("not-utf8", message).hint("save it as UTF-8"))
    };
    let mut text = String::from_utf8(bytes).map_err(wrong)?;
    // A byte-order mark is no part of the first name.
    if text.starts_with('\u{feff}') {
        text.drain(..'\u{feff}'.len_utf8());
    }
    let source = Arc::new(Source { name, text });
    let id = sources.add(source.clone());
    Ok(TableFile::new(source, id))
}

/// Replaces every `from` by what it names.
fn copy_from_catalogue(
    tree: &mut Node,
    catalogue: &dyn Catalogue,
    sources: &mut Sources,
    faults: &mut Vec<Diagnostic>,
) {
    let Value::Object(top) = &mut tree.value else {
        return;
    };
    let Some(objects) = top.iter_mut().find(|member| member.name == "objects") else {
        return;
    };
    let Value::Object(objects) = &mut objects.value.value else {
        return;
    };
    for object in objects {
        let Value::Object(members) = &mut object.value.value else {
            continue;
        };
        let Some(at) = members.iter().position(|member| member.name == "from") else {
            continue;
        };
        let from = members.remove(at);
        match catalogue_members(&from, &object.name, catalogue, sources) {
            Ok(mut copied) => {
                merge_dimensions(members, &mut copied);
                copied.retain(|copy| members.iter().all(|own| own.name != copy.name));
                members.append(&mut copied);
            }
            Err(mut found) => {
                faults.append(&mut found);
                // Its reading sees by this that something is missing.
                members.push(from);
            }
        }
    }
}

/// Named numbers are replaced one by one, all other properties as a whole.
fn merge_dimensions(own: &mut [Member], copied: &mut [Member]) {
    let of = |members: &[Member]| members.iter().position(|m| m.name == "dimensions");
    let (Some(mine), Some(theirs)) = (of(own), of(copied)) else {
        return;
    };
    if let (Value::Object(mine), Value::Object(theirs)) =
        (&mut own[mine].value.value, &mut copied[theirs].value.value)
    {
        theirs.retain(|copy| mine.iter().all(|own| own.name != copy.name));
        mine.append(theirs);
    }
}

fn catalogue_members(
    from: &Member,
    id: &str,
    catalogue: &dyn Catalogue,
    sources: &mut Sources,
) -> Result<Vec<Member>, Vec<Diagnostic>> {
    let fault = |code, message: String| {
        Diagnostic::error(code, message)
            .at(from.value.place.clone())
            .path(format!("{id}.from"))
    };
    let Some(name) = from.value.text() else {
        let message = format!("`from` must be a text, found {}", from.value.type_name());
        return Err(vec![fault("wrong-type", message)]);
    };
    let Some((file, text)) = catalogue.lookup(name) else {
        let names = catalogue.names();
        let guess = did_you_mean(name, names.iter().map(String::as_str));
        let all = || {
            format!(
                "the catalogue has {}",
                read::quoted_list(names.iter().map(String::as_str).take(40), "and")
            )
        };
        let message = format!("the catalogue has no object `{name}`");
        return Err(vec![
            fault("unknown-catalogue-object", message).hint(guess.unwrap_or_else(all)),
        ]);
    };
    let node = read::parse(&file, text.as_bytes(), sources)?;
    let Value::Object(mut members) = node.value else {
        let message = "a catalogue file holds one object's properties".to_owned();
        return Err(vec![
            Diagnostic::error("wrong-type", message).at(node.place),
        ]);
    };
    if let Some(nested) = members.iter().find(|member| member.name == "from") {
        let message = "a catalogue object cannot copy another one";
        return Err(vec![
            Diagnostic::error("contradiction", message).at(nested.name_place.clone()),
        ]);
    }
    members.retain(|member| !["source", "description"].contains(&member.name.as_str()));
    Ok(members)
}

impl Places {
    /// The files that it names.
    pub(super) fn files(&self) -> &Files {
        &self.files
    }

    /// The tree that was decoded.
    pub(super) fn into_root(self) -> Node {
        self.root
    }

    /// Place of the property at an address; that of the nearest part of the address that
    /// exists.
    pub fn locate(&self, path: &str) -> Place {
        address::place_of_address(&self.root, path)
    }

    /// Faults found later as diagnostics with their places.
    pub fn diagnose(&self, faults: &[Fault]) -> Diagnostics {
        let items = faults.iter().map(|fault| {
            let hint = (!fault.hint.is_empty()).then(|| fault.hint.clone());
            Diagnostic::error(fault.code, fault.message.clone())
                .at(self.locate(&fault.path))
                .label(fault.label.clone())
                .path(fault.path.clone())
                .maybe_hint(hint)
        });
        Diagnostics::new(self.sources.clone(), items.collect())
    }

    /// The texts that the scene was read from.
    pub fn sources(&self) -> &Sources {
        &self.sources
    }
}
