//! The mathematics that everything else stands on: numbers with derivatives, power
//! series, polynomials, searches, quadrature, linear systems. Nothing here knows of
//! mechanisms, and nothing here is taken from the rest of the crate.
//!
//! Look here before you write a search, a fit, a rule of quadrature or an elimination. Matrices
//! that are not small, and eigenvalues, are nalgebra's. If two things look alike, each has its
//! purpose:
//!
//! * [`series`] is as long as its caller requires, known when it is compiled;
//!   [`bounded_series`] carries a magnitude with each coefficient;
//! * [`optimise`], [`roots`] and [`quadrature`] state on their pages which function serves
//!   what.
//!
//! Some loops have a form of their own elsewhere, each for a reason on its page:
//!
//! * the searches of `exact`, `exact::pencil`, `system::forest` and `methods::limit`;
//! * the series of `system::taylor` and the fits of `linkages::table`;
//! * Newton's method for two unknowns in closed form in `cam::findings`;
//! * the integrators of `steady::extrapolation` and of `exact::independent_tests`, which is a check.
//!
//! `number`, `jet`, `polynomial` and `expression` are public at the top of the library. A test holds this
//! folder free of imports from others.

pub(crate) mod bounded_series;
pub(crate) mod chebyshev;
pub(crate) mod contour;
pub mod expression;
pub(crate) mod fourier;
pub(crate) mod fraction;
pub mod jet;
pub(crate) mod linear;
pub(crate) mod narrow;
pub mod number;
pub(crate) mod optimise;
pub(crate) mod order;
pub mod polynomial;
pub(crate) mod probability;
pub(crate) mod quadrature;
pub(crate) mod quantity;
pub(crate) mod roots;
pub(crate) mod series;

#[cfg(test)]
mod tests {
    use std::path::{Path, PathBuf};

    /// All files of a folder, those of its folders among them.
    fn files(folder: &Path) -> Vec<PathBuf> {
        let entries = std::fs::read_dir(folder).unwrap();
        let paths = entries.map(|entry| entry.unwrap().path());
        paths
            .flat_map(|path| match path.is_dir() {
                true => files(&path),
                false => vec![path],
            })
            .collect()
    }

    /// Beginnings of the paths in a text that leave the folder, by the name of the crate or
    /// by its parents.
    fn foreign(text: &str) -> Vec<String> {
        let squeezed: String = text.chars().filter(|c| !c.is_whitespace()).collect();
        let of = |from: &str, own: &str| -> Vec<String> {
            let rest = squeezed.split(from).skip(1);
            let foreign = rest.filter(|rest| own.is_empty() || !rest.starts_with(own));
            foreign
                .map(|rest| rest.chars().take(40).collect())
                .collect()
        };
        let names = [concat!("crate", "::"), concat!("dam", "::")];
        let mut found: Vec<String> = names.iter().flat_map(|name| of(name, "math::")).collect();
        found.extend(of(concat!("super", "::super", "::super"), ""));
        found
    }

    #[test]
    fn nothing_here_is_taken_from_the_rest_of_the_crate() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/math");
        let all = files(&folder);
        assert!(all.len() > 12, "{all:?}");
        for path in all {
            let text = std::fs::read_to_string(&path).unwrap();
            let found = foreign(&text);
            assert!(found.is_empty(), "{}: {found:?}", path.display());
        }
    }

    #[test]
    fn what_is_foreign_is_recognised() {
        let name = |parts: [&str; 2]| parts.concat();
        assert!(foreign(&name(["use crate", "::math::jet::Jet;"])).is_empty());
        assert_eq!(foreign(&name(["use crate", "::position::Cam;"])).len(), 1);
        assert_eq!(
            foreign(&name(["use crate", "::{position, math};"])).len(),
            1
        );
        assert_eq!(foreign(&name(["use dam", "::model;"])).len(), 1);
    }
}
