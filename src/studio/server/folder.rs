//! The folder that is open: everything read or written lies below it, links resolved.

use crate::frontend::diagnostics::Diagnostic;
use crate::frontend::scene::{Catalogue, Folder as Objects, NamedBytes};
use crate::studio::limits::BODY;
use std::borrow::Cow;
use std::fs;
use std::path::{Component, Path, PathBuf};

/// The folder, links resolved.
#[derive(Clone, Debug)]
pub(super) struct Folder {
    root: PathBuf,
}

/// Folders below it that are looked into for scenes, and how many scenes are listed.
const DEPTH: usize = 4;
const MOST: usize = 500;

impl Folder {
    /// Opens a folder, or the one of a scene; with the scene's name in it.
    ///
    /// # Errors
    /// There is no such folder or scene.
    pub(super) fn open(target: Option<&Path>) -> Result<(Self, Option<String>), String> {
        let target = target.unwrap_or(Path::new("."));
        let shown = target.display();
        let real = target
            .canonicalize()
            .map_err(|error| format!("cannot open `{shown}`: {error}"))?;
        if real.is_dir() {
            return Ok((Self { root: real }, None));
        }
        let (folder, name) = (
            real.parent(),
            real.file_name().and_then(|name| name.to_str()),
        );
        let (Some(folder), Some(name), true) = (folder, name, real.is_file()) else {
            return Err(format!(
                "`{shown}` is neither a scene nor a folder of scenes"
            ));
        };
        let folder = Self {
            root: folder.to_owned(),
        };
        Ok((folder, Some(name.to_owned())))
    }

    /// Where it is.
    pub(super) fn path(&self) -> &Path {
        &self.root
    }

    /// Name of the folder itself.
    pub(super) fn name(&self) -> String {
        let name = self.root.file_name().unwrap_or_default();
        name.to_string_lossy().into_owned()
    }

    /// The file of a name below the folder.
    ///
    /// # Errors
    /// It leads out, or is no file.
    pub(super) fn file(&self, name: &str) -> Result<PathBuf, String> {
        let real = self.path_within(name)?.canonicalize().ok();
        let real = real.filter(|real| real.starts_with(&self.root) && real.is_file());
        real.ok_or_else(|| NO_FILE.to_owned())
    }

    /// The name of a file below the folder; `None`: it lies elsewhere, is gone, or is none.
    pub(super) fn name_of(&self, path: &Path) -> Option<String> {
        let name = path.strip_prefix(&self.root).ok()?;
        let name = name.components().map(|part| part.as_os_str().to_str());
        let name = name.collect::<Option<Vec<&str>>>()?.join("/");
        (self.file(&name).ok()? == path).then_some(name)
    }

    /// The place of a file to be made: its folder is there, it is not.
    ///
    /// # Errors
    /// It leads out, is there already, or is no name of a scene.
    pub(super) fn path_of_new_file(&self, name: &str) -> Result<PathBuf, String> {
        let path = self.path_within(name)?;
        if path.extension().is_none_or(|extension| extension != "json") {
            return Err("the name of a scene ends with .json".to_owned());
        }
        let folder = path.parent().and_then(|parent| parent.canonicalize().ok());
        let folder = folder.filter(|folder| folder.starts_with(&self.root));
        let (Some(folder), Some(name)) = (folder, path.file_name()) else {
            return Err("there is no such folder".to_owned());
        };
        let place = folder.join(name);
        match place.symlink_metadata() {
            Ok(_) => Err("a file of this name is there already".to_owned()),
            Err(_) => Ok(place),
        }
    }

    /// A name without anything that leads elsewhere.
    fn path_within(&self, name: &str) -> Result<PathBuf, String> {
        let parts = Path::new(name).components();
        let plain = parts
            .clone()
            .all(|part| matches!(part, Component::Normal(_)));
        let fine = plain && !name.is_empty() && name.len() < 1024;
        // Of other systems, where they would mean something.
        let fine = fine && !name.contains(['\\', '\0', ':']) && !name.ends_with('/');
        match fine {
            true => Ok(self.root.join(name)),
            false => Err(NO_FILE.to_owned()),
        }
    }

    /// The text of a file as it is.
    ///
    /// # Errors
    /// It cannot be read, is too large, or is no text.
    pub(super) fn read(path: &Path) -> Result<String, String> {
        use std::io::Read;
        let mut bytes = Vec::new();
        let read = fs::File::open(path)
            .and_then(|file| file.take(BODY as u64 + 1).read_to_end(&mut bytes));
        match read {
            Err(error) => Err(format!("the scene cannot be read: {}", error.kind())),
            Ok(_) if bytes.len() > BODY => Err("the scene is larger than 1 MB".to_owned()),
            Ok(_) => String::from_utf8(bytes).map_err(|_| "the scene is not UTF-8".to_owned()),
        }
    }

    /// The scenes below the folder by their names; links are not followed.
    pub(super) fn scenes(&self) -> Vec<String> {
        let mut found = Vec::new();
        collect_files(&self.root, "", 0, &mut found);
        found.sort();
        found
    }

    /// What scenes beside a file copy from with `from`.
    pub(super) fn catalogue(&self, scene: &Path) -> Shelf {
        Shelf {
            root: self.root.clone(),
            objects: Objects::beside_scene(scene),
            folder: scene.parent().unwrap_or(Path::new("")).join("objects"),
        }
    }
}

const NO_FILE: &str = "there is no such scene in this folder";

fn collect_files(folder: &Path, prefix: &str, depth: usize, found: &mut Vec<String>) {
    let Ok(entries) = fs::read_dir(folder) else {
        return;
    };
    for entry in entries.flatten() {
        let name = entry.file_name();
        let (Some(name), Ok(kind)) = (name.to_str(), entry.file_type()) else {
            continue;
        };
        let left_out = ["objects", "node_modules", "target"].contains(&name);
        if name.starts_with('.') || found.len() >= MOST {
            continue;
        }
        if kind.is_dir() && depth < DEPTH && !left_out {
            collect_files(&entry.path(), &format!("{prefix}{name}/"), depth + 1, found);
        } else if kind.is_file() && name.ends_with(".json") && is_scene(&entry.path()) {
            found.push(format!("{prefix}{name}"));
        }
    }
}

/// Whether a file says near its beginning that it is a scene.
fn is_scene(path: &Path) -> bool {
    use std::io::Read;
    let mut head = Vec::new();
    let read = fs::File::open(path).and_then(|file| file.take(512).read_to_end(&mut head));
    read.is_ok() && String::from_utf8_lossy(&head).contains("\"dam\"")
}

/// The objects beside a scene, as far as they lie below the folder.
#[derive(Clone, Debug)]
pub(super) struct Shelf {
    root: PathBuf,
    objects: Objects,
    folder: PathBuf,
}

impl Shelf {
    fn is_within(&self) -> bool {
        let real = self.folder.canonicalize();
        real.is_ok_and(|real| real.starts_with(&self.root))
    }
}

impl Catalogue for Shelf {
    fn lookup(&self, name: &str) -> Option<(String, Cow<'_, str>)> {
        if !self.is_within() {
            return None;
        }
        let (_, text) = self.objects.lookup(name)?;
        Some((format!("objects/{name}.json"), text))
    }

    fn names(&self) -> Vec<String> {
        match self.is_within() {
            true => self.objects.names(),
            false => Vec::new(),
        }
    }

    fn table(&self, name: &str) -> Result<NamedBytes, Box<Diagnostic>> {
        // The page need not know where the folder lies.
        let (_, bytes) = self.objects.table(name)?;
        Ok((name.to_owned(), bytes))
    }
}

#[cfg(all(test, unix))]
mod tests {
    use super::Folder;
    use crate::frontend::scene::Catalogue;
    use std::fs;
    use std::os::unix::fs::symlink;

    #[test]
    fn nothing_leads_out_of_the_folder() {
        let outer = tempfile::tempdir().unwrap();
        let (root, other) = (outer.path().join("open"), outer.path().join("other"));
        for folder in [&root, &other, &root.join("deep"), &other.join("objects")] {
            fs::create_dir_all(folder).unwrap();
        }
        let scene = r#"{"dam":1}"#;
        for file in [
            root.join("a.json"),
            root.join("deep/b.json"),
            other.join("c.json"),
        ] {
            fs::write(file, scene).unwrap();
        }
        fs::write(other.join("objects/o.json"), "{}").unwrap();
        symlink(other.join("c.json"), root.join("link.json")).unwrap();
        symlink(&other, root.join("away")).unwrap();
        symlink(root.join("a.json"), root.join("same.json")).unwrap();
        symlink(other.join("objects"), root.join("objects")).unwrap();
        let (folder, none) = Folder::open(Some(&root)).unwrap();
        assert_eq!(none, None);
        assert!(folder.file("a.json").is_ok() && folder.file("deep/b.json").is_ok());
        assert_eq!(
            folder.file("same.json").unwrap(),
            folder.file("a.json").unwrap()
        );
        let absolute = other.join("c.json").display().to_string();
        for name in [
            "link.json",
            "away/c.json",
            "../other/c.json",
            "deep/../a.json",
            "./a.json",
            "",
            ".",
            "/etc/passwd",
            &absolute,
            "deep",
            "a.json/",
            "a\\b.json",
            "nothing.json",
            "a.json\0",
        ] {
            assert!(folder.file(name).is_err(), "{name:?}");
        }
        for name in [
            "away/new.json",
            "../new.json",
            "a.json",
            "link.json",
            "new.txt",
            "no/new.json",
        ] {
            assert!(folder.path_of_new_file(name).is_err(), "{name}");
        }
        assert!(folder.path_of_new_file("deep/new.json").is_ok());
        assert_eq!(folder.scenes(), ["a.json", "deep/b.json"]);
        let shelf = folder.catalogue(&folder.file("a.json").unwrap());
        assert!(shelf.lookup("o").is_none() && shelf.names().is_empty());
        let table = "angle [deg],lift [mm]\n0,0\n";
        fs::write(other.join("lift.csv"), table).unwrap();
        fs::write(root.join("lift.csv"), table).unwrap();
        symlink(other.join("lift.csv"), root.join("link.csv")).unwrap();
        assert_eq!(shelf.table("lift.csv").unwrap().0, "lift.csv");
        for name in [
            "../other/lift.csv",
            "link.csv",
            "away/lift.csv",
            "/etc/passwd",
        ] {
            assert!(shelf.table(name).is_err(), "{name}");
        }
        let (of_scene, name) = Folder::open(Some(&root.join("link.json"))).unwrap();
        assert_eq!(
            (of_scene.name().as_str(), name.as_deref()),
            ("other", Some("c.json"))
        );
        let shelf = of_scene.catalogue(&of_scene.file("c.json").unwrap());
        assert_eq!(shelf.lookup("o").unwrap().0, "objects/o.json");
    }
}
