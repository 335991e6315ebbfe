//! The results of kinematics with their addresses, units and meaning, for people.

use super::columns::{LINK, OUTPUT, POINT, Quantities, Quantity, SLIDE, heading};
use super::figures::{ENDS, LIMITS, STROKE, TRANSMISSION};

/// SI units of what turns or slides.
const BOTH: &[&str] = &["rad", "m"];

/// A result whose address has names of the scene in it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DescribedFigure {
    /// Address within the study. Words in capitals stand for names of the scene or for a
    /// number; END stands for one of [`ends`].
    pub address: String,
    /// SI units that it can have; `1` of a pure number.
    pub units: Vec<String>,
    /// Meaning, with the sign.
    pub meaning: String,
}

impl DescribedFigure {
    /// A result of this address.
    pub(in crate::studies) fn new(address: &str, units: &[&str], meaning: &str) -> Self {
        Self {
            address: address.to_owned(),
            units: units.iter().map(|unit| (*unit).to_owned()).collect(),
            meaning: meaning.to_owned(),
        }
    }
}

/// What END of an address stands for, with the meaning.
pub fn ends() -> &'static [(&'static str, &'static str)] {
    &ENDS
}

/// Extremes of a quantity of something whose own unit is one of `own`.
fn extremes(owner: &str, quantity: Quantity, own: &[&str], by: &str) -> DescribedFigure {
    let mut units: Vec<String> = Vec::new();
    for own in own {
        for input in BOTH {
            let unit = heading(owner, quantity, own, input).unit;
            if !units.contains(&unit) {
                units.push(unit);
            }
        }
    }
    DescribedFigure {
        address: format!("{owner}.{}{by}.END", quantity.name()),
        units,
        meaning: format!("{}.", quantity.meaning()),
    }
}

/// All results that kinematics can have.
pub fn described_results() -> Vec<DescribedFigure> {
    let mut all = Vec::new();
    let mut add = |owner: &str, own: &[&str], by: &str, quantities: &[Quantity]| {
        let one = |quantity: &Quantity| extremes(owner, *quantity, own, by);
        all.extend(quantities.iter().map(one));
    };
    let owners: [(&str, &Quantities, &[&str]); 4] = [
        ("OUTPUT", &OUTPUT, BOTH),
        ("links.LINK", &LINK, &["rad"]),
        ("links.LINK.POINT", &POINT, &["m"]),
        ("pairs.PAIR", &SLIDE, &["m"]),
    ];
    add("input", BOTH, "", OUTPUT.motion);
    for (owner, quantities, own) in owners {
        add(owner, own, "", &quantities.all().collect::<Vec<_>>());
    }
    // Of several inputs: each has its name, and a transfer function that of its input.
    add("INPUT", BOTH, "", OUTPUT.motion);
    for index in [0, 1, 3, 2] {
        let (owner, quantities, own) = owners[index];
        add(
            owner,
            own,
            ".INPUT",
            &quantities.first_transfer_functions().collect::<Vec<_>>(),
        );
    }
    for (owner, own) in [("OUTPUT", BOTH), ("pairs.PAIR", &["m"])] {
        for (what, meaning) in STROKE {
            let units = match what {
                "stroke" => own,
                "time_ratio" => &["1"],
                _ => BOTH,
            };
            let address = format!("{owner}.{what}");
            let meaning = format!("{meaning}.");
            all.push(DescribedFigure::new(&address, units, &meaning));
        }
    }
    let angle = "transmission_angles.LINK.END";
    all.push(DescribedFigure::new(angle, &["rad"], TRANSMISSION));
    for (end, meaning) in LIMITS {
        let meaning = format!("{meaning}.");
        all.push(DescribedFigure::new(
            &format!("limits.{end}"),
            BOTH,
            &meaning,
        ));
    }
    all
}
