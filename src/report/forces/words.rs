//! Quantities of the forces of a linkage in words.

/// What drives an input, by the SI unit of its column: a moment where the input turns.
pub(super) fn driving(unit: &str) -> &'static str {
    match unit {
        "N m" => "driving moment",
        _ => "driving force",
    }
}

/// Quantities that no joint and no input has a part in.
const OF_ALL: [(&str, &str); 10] = [
    ("ratio", "kinematic ratio i"),
    ("chi", "dynamic transmission ratio χ"),
    ("efficiency", "efficiency"),
    ("power.drive", "power of the driver"),
    ("power.loss", "power lost to friction"),
    ("shaking.force", "shaking force"),
    ("shaking.moment", "shaking moment"),
    ("frame.force", "force of all joints on the frame"),
    ("frame.moment", "moment of all joints on the frame"),
    ("drive", ""),
];

/// What a joint has, by the end of its address.
const OF_A_JOINT: [(&str, &str); 4] = [
    ("force", "force in"),
    ("n1", "force at corner 1 of"),
    ("n2", "force at corner 2 of"),
    ("couple", "couple in"),
];

/// The quantity of an address in words, which depend on its unit; the address where it has none.
pub(super) fn quantity_words(address: &str, unit: &str, inputs: &[&str]) -> String {
    let known = OF_ALL.iter().find(|(name, _)| *name == address);
    // (A joint may be called `drive` too.)
    let at = address
        .split_once('.')
        .filter(|(_, at)| inputs.contains(at));
    match (known, at) {
        (Some(("drive", _)), _) => driving(unit).to_owned(),
        (Some((_, words)), _) => (*words).to_owned(),
        (None, Some(("drive", input))) => format!("{} at {input}", driving(unit)),
        (None, Some(("power", input))) => format!("power of the driver at {input}"),
        (None, _) => of_a_joint(address).unwrap_or_else(|| address.to_owned()),
    }
}

fn of_a_joint(address: &str) -> Option<String> {
    let (joint, what) = address.rsplit_once('.')?;
    let (_, words) = OF_A_JOINT.iter().find(|(name, _)| *name == what)?;
    Some(format!("{words} {joint}"))
}

/// What a derivative is by, in words: `R12.friction` as friction of R12.
pub(super) fn cause_words(address: &str) -> String {
    match address.rsplit_once('.') {
        Some((owner, "moment")) => format!("moment of inertia of {owner}"),
        Some((owner, what)) => format!("{} of {owner}", what.replace('_', " ")),
        None => address.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::{cause_words, quantity_words};

    #[test]
    fn quantities_and_causes_are_named() {
        for (address, unit, words) in [
            ("drive", "N m", "driving moment"),
            ("drive", "N", "driving force"),
            ("drive.left", "N m", "driving moment at left"),
            ("power.left", "W", "power of the driver at left"),
            ("power.loss", "W", "power lost to friction"),
            ("P03.n2", "N", "force at corner 2 of P03"),
            ("slot.pin.force", "N", "force in slot.pin"),
            ("chi", "m", "dynamic transmission ratio χ"),
            ("drive.force", "N", "force in drive"),
            ("something", "", "something"),
        ] {
            assert_eq!(quantity_words(address, unit, &["left"]), words);
        }
        assert_eq!(cause_words("R12.friction"), "friction of R12");
        assert_eq!(cause_words("rod.moment"), "moment of inertia of rod");
    }
}
