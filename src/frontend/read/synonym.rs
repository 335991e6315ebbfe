//! Second names of properties.

/// Names of one property: the one that canonical scenes have, and another.
const SYNONYMS: [(&str, &str); 3] = [
    ("inertia", "mass"),
    ("inertia", "moment_of_inertia"),
    ("moment", "moment_of_inertia"),
];

/// The other names that a property of this name may be written with. Which of them an object
/// takes is said by its reading.
pub fn synonyms(name: &str) -> impl Iterator<Item = &'static str> {
    let other = move |(one, other): &(&'static str, &'static str)| match () {
        () if *one == name => Some(*other),
        () if *other == name => Some(*one),
        () => None,
    };
    SYNONYMS.iter().filter_map(other)
}
