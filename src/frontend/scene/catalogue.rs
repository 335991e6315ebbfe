//! Catalogues of object definitions that scenes copy with `from`.

use crate::frontend::diagnostics::Diagnostic;
use crate::frontend::read::no_folder;
use std::borrow::Cow;

include!(concat!(env!("OUT_DIR"), "/catalogue.rs"));

/// A file that a scene names: what it is called in messages, and its bytes.
pub type NamedBytes = (String, Vec<u8>);

/// A catalogue of object definitions, in which `from` looks; with the folder of a scene also
/// the tables beside it.
pub trait Catalogue {
    /// Name of the file and its text, for `rocker/steel-lever-205mm`.
    fn lookup(&self, name: &str) -> Option<(String, Cow<'_, str>)>;

    /// All names, ascending.
    fn names(&self) -> Vec<String>;

    /// A file in the folder of the scene, by the name that a table of the scene has for it.
    ///
    /// # Errors
    /// There is no such file, or no folder; the file lies outside or is too large.
    fn table(&self, _name: &str) -> Result<NamedBytes, Box<Diagnostic>> {
        Err(Box::new(no_folder()))
    }
}

/// One that somebody else holds.
impl<C: Catalogue + ?Sized> Catalogue for &C {
    fn lookup(&self, name: &str) -> Option<(String, Cow<'_, str>)> {
        (**self).lookup(name)
    }

    fn names(&self) -> Vec<String> {
        (**self).names()
    }

    fn table(&self, name: &str) -> Result<NamedBytes, Box<Diagnostic>> {
        (**self).table(name)
    }
}

/// The definitions built into the library.
#[derive(Clone, Copy, Debug, Default)]
pub struct BuiltIn;

impl Catalogue for BuiltIn {
    fn lookup(&self, name: &str) -> Option<(String, Cow<'_, str>)> {
        let found = BUILT_IN.iter().find(|entry| entry.0 == name)?;
        Some((format!("objects/{name}.json"), Cow::Borrowed(found.1)))
    }

    fn names(&self) -> Vec<String> {
        BUILT_IN.iter().map(|entry| entry.0.to_owned()).collect()
    }
}

/// Two catalogues, the first of which comes first.
#[derive(Clone, Copy, Debug)]
pub struct LayeredCatalogue<'a, A: ?Sized, B: ?Sized>(pub &'a A, pub &'a B);

impl<A: Catalogue + ?Sized, B: Catalogue + ?Sized> Catalogue for LayeredCatalogue<'_, A, B> {
    fn lookup(&self, name: &str) -> Option<(String, Cow<'_, str>)> {
        self.0.lookup(name).or_else(|| self.1.lookup(name))
    }

    fn names(&self) -> Vec<String> {
        let mut names = self.0.names();
        names.extend(self.1.names());
        names.sort();
        names.dedup();
        names
    }

    fn table(&self, name: &str) -> Result<NamedBytes, Box<Diagnostic>> {
        self.0.table(name)
    }
}

/// A catalogue that is looked into before what is built in.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BeforeBuiltIn<C>(pub(crate) C);

impl<C: Catalogue> Catalogue for BeforeBuiltIn<C> {
    fn lookup(&self, name: &str) -> Option<(String, Cow<'_, str>)> {
        self.0.lookup(name).or_else(|| BuiltIn.lookup(name))
    }

    fn names(&self) -> Vec<String> {
        LayeredCatalogue(&self.0, &BuiltIn).names()
    }

    fn table(&self, name: &str) -> Result<NamedBytes, Box<Diagnostic>> {
        self.0.table(name)
    }
}
