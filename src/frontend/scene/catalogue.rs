//! Catalogues of object definitions that scenes copy with `from`.

use std::borrow::Cow;

include!(concat!(env!("OUT_DIR"), "/catalogue.rs"));

/// A catalogue of object definitions, in which `from` looks.
pub trait Catalogue {
    /// Name of the file and its text, for `rocker/steel-lever-205mm`.
    fn lookup(&self, name: &str) -> Option<(String, Cow<'_, str>)>;

    /// All names, ascending.
    fn names(&self) -> Vec<String>;
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
pub struct Layered<'a, A: ?Sized, B: ?Sized>(pub &'a A, pub &'a B);

impl<A: Catalogue + ?Sized, B: Catalogue + ?Sized> Catalogue for Layered<'_, A, B> {
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
}
