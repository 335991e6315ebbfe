//! Addresses of results and of parameters in words: `rocker.delta_abs` as greatest |δ| of rocker.

/// Results of an object, in words.
pub(in crate::report) const RESULTS: [(&str, &str); 18] = [
    ("delta_abs", "greatest |δ|"),
    ("delta_max", "greatest δ"),
    ("delta_min", "least δ"),
    ("sigma", "mean |δ|"),
    ("peak_speed", "peak speed"),
    ("peak_acceleration", "peak acceleration"),
    ("peak_reaction", "peak reaction"),
    ("final.displacement", "displacement at the end"),
    ("final.speed", "speed at the end"),
    ("pair.in_working_order", "working order"),
    ("pair.separations", "separations"),
    ("pair.closures", "closures"),
    ("pair.separated_time", "time separated"),
    ("pair.longest_separation", "longest separation"),
    ("pair.max_lift", "greatest lift"),
    ("pair.max_approach_speed", "greatest approach speed"),
    ("pair.max_contact_force", "greatest contact force"),
    ("pair.margin", "least contact force"),
];

/// A result of an object in words; an address of another study as it is.
pub(in crate::report) fn result_words(address: &str) -> String {
    let known = RESULTS.iter().find_map(|(name, words)| {
        let object = address.strip_suffix(name)?.strip_suffix('.')?;
        Some(format!("{words} of {object}"))
    });
    known.unwrap_or_else(|| address.to_owned())
}

/// Parts of an address that tell no property from another one.
const SILENT: [&str; 4] = ["motion", "position", "pair", "links"];

/// A parameter in words: `shaft.motion.speed` as speed of shaft; a place in a list as it is.
/// Different parameters have different words: of two stiffnesses one is that of the contact.
pub(in crate::report) fn parameter_words(path: &str) -> String {
    let parts: Vec<&str> = path.split('.').collect();
    if parts.iter().any(|part| part.parse::<usize>().is_ok()) {
        return path.to_owned();
    }
    let plain = |part: &str| part.replace('_', " ");
    match parts[..] {
        ["parameters", own] => own.to_owned(),
        [object, "loads", load, "constant"] => format!("load {load} on {object}"),
        [object, "loads", load, .., last] => format!("{} of {load} on {object}", plain(last)),
        [object, ref inner @ ..] if !inner.is_empty() => {
            let told = inner.iter().filter(|part| !SILENT.contains(part));
            let words: Vec<String> = told.map(|part| plain(part)).collect();
            format!("{} of {object}", words.join(" "))
        }
        _ => path.to_owned(),
    }
}

/// A condition in words: its result named, its relation as it is written by hand.
pub(in crate::report) fn condition_words(text: &str, figure: &str) -> String {
    let words = text.replacen(figure, &result_words(figure), 1);
    let order = "working order";
    let words = words.replace(">=", "≥").replace("<=", "≤");
    match words.contains(order) {
        true => words.trim_end_matches("≥ 1").trim_end().to_owned(),
        false => words,
    }
}

#[cfg(test)]
mod tests {
    use super::{condition_words, parameter_words, result_words};

    #[test]
    fn results_and_parameters_are_named() {
        assert_eq!(
            result_words("press.ram.delta_abs"),
            "greatest |δ| of press.ram"
        );
        assert_eq!(result_words("frequency.1"), "frequency.1");
        for (path, words) in [
            ("camshaft.motion.speed", "speed of camshaft"),
            ("rocker.inertia", "inertia of rocker"),
            (
                "follower.loads.spring.spring.preload",
                "preload of spring on follower",
            ),
            ("rocker.loads.closing.constant", "load closing on rocker"),
            ("parameters.n", "n"),
            ("bar.links.rod.points.C.0", "bar.links.rod.points.C.0"),
            ("frame.position.cam.law", "cam law of frame"),
            ("rocker.stiffness", "stiffness of rocker"),
            (
                "rocker.pair.contact.stiffness",
                "contact stiffness of rocker",
            ),
            ("rocker.damping_capacity", "damping capacity of rocker"),
        ] {
            assert_eq!(parameter_words(path), words);
        }
    }

    #[test]
    fn conditions_name_their_result() {
        let of = |text, figure| condition_words(text, figure);
        assert_eq!(
            of(
                "valve.pair.in_working_order >= 1",
                "valve.pair.in_working_order"
            ),
            "working order of valve"
        );
        assert_eq!(
            of(
                "valve.pair.max_contact_force <= 900 N",
                "valve.pair.max_contact_force"
            ),
            "greatest contact force of valve ≤ 900 N"
        );
    }
}
