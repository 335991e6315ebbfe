//! Addresses of results and of parameters in words: `rocker.delta_abs` as greatest |δ| of rocker.

use super::quantity::capitalised;

/// Results of an object, in words.
pub(in crate::report) const RESULTS: [(&str, &str); 27] = [
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
    ("pair.max_indentation", "greatest indentation"),
    ("pair.margin", "least contact force"),
    ("pair.impacts.count", "impacts"),
    ("pair.impacts.max_impulse", "greatest impulse"),
    ("pair.impacts.loss", "energy lost in impacts"),
    ("pressing.max_pressure", "greatest pressure"),
    ("pressing.time", "time of the greatest pressure"),
    ("friction_loss", "energy lost to friction"),
    ("standstills", "standstills"),
    ("time_at_rest", "time at rest"),
];

/// Results of a whole run and of steady motion, in words.
const OF_THE_MACHINE: [(&str, &str); 22] = [
    ("run.time", "time reached"),
    ("run.steps", "accepted steps"),
    ("run.rejected", "rejected steps"),
    ("run.evaluations", "evaluations"),
    ("run.switches", "events"),
    ("run.energy_error", "energy error"),
    ("run.complete", "completeness of the run"),
    ("steady.mean_time", "mean speed over time"),
    ("steady.mean_angle", "mean speed over the angle"),
    ("steady.mean_midrange", "midrange speed"),
    ("steady.period", "period"),
    ("steady.least_speed", "least speed in the period"),
    ("steady.greatest_speed", "greatest speed in the period"),
    ("steady.speed_at_start", "speed at φ = 0"),
    ("steady.fluctuation", "coefficient of speed fluctuation"),
    ("steady.energy_at_start", "kinetic energy at φ = 0"),
    (
        "steady.reference_energy",
        "kinetic energy at the least inertia",
    ),
    (
        "steady.energy_fluctuation",
        "fluctuation of the kinetic energy",
    ),
    ("steady.cycle_work", "work of a cycle"),
    ("steady.balance", "moment that balances the cycle"),
    ("steady.multiplier", "multiplier of a cycle"),
    ("steady.flywheel", "inertia of the flywheel"),
];

/// A result in words; an address of which no words are known as it is.
pub(in crate::report) fn result_words(address: &str) -> String {
    let of_the_machine = OF_THE_MACHINE.iter().find(|(name, _)| *name == address);
    let known = of_the_machine.map(|(_, words)| (*words).to_owned());
    let known = known.or_else(|| of_a_study(address)).or_else(|| {
        RESULTS.iter().find_map(|(name, words)| {
            let object = address.strip_suffix(name)?.strip_suffix('.')?;
            Some(match words.strip_suffix(" at the end") {
                Some(words) => format!("{words} of {object} at the end"),
                None => format!("{words} of {object}"),
            })
        })
    });
    known.unwrap_or_else(|| address.to_owned())
}

/// A natural frequency, or a result of a cam.
fn of_a_study(address: &str) -> Option<String> {
    let number = |text: &str| text.parse::<usize>().is_ok();
    match address.split('.').collect::<Vec<_>>()[..] {
        ["frequency", at] if number(at) => Some(format!("natural frequency {at}")),
        ["frequency", "open", at] if number(at) => {
            Some(format!("natural frequency {at}, contacts separated"))
        }
        ["cam", ref object @ .., what] if !object.is_empty() => Some(format!(
            "{} of the cam of {}",
            what.replace('_', " "),
            object.join(".")
        )),
        _ => None,
    }
}

/// A text with the results that it addresses in words; code, options and a text that is nothing
/// but an address stay as they are.
pub(in crate::report) fn in_words(text: &str) -> String {
    let part = |c: char| c.is_alphanumeric() || matches!(c, '_' | '.');
    let (mut out, mut rest, mut code) = (String::with_capacity(text.len()), text, false);
    while let Some(first) = rest.chars().next() {
        let length = rest.find(|c: char| !part(c)).unwrap_or(rest.len());
        let token = &rest[..length.max(first.len_utf8())];
        let address = token.trim_end_matches('.');
        let free = !code && !out.ends_with(['=', '-', '/']) && !rest[length..].starts_with('=');
        let option = out
            .rsplit(' ')
            .nth(1)
            .is_some_and(|word| word.starts_with("--"));
        match free && !option && address.len() < text.len() && address.contains('.') {
            true => {
                let words = result_words(address) + &token[address.len()..];
                let begins = out.is_empty() || out.ends_with(". ");
                out.push_str(&if begins && words != token {
                    capitalised(&words)
                } else {
                    words
                });
            }
            false => out.push_str(token),
        }
        code ^= token == "`";
        rest = &rest[token.len()..];
    }
    out
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

/// A parameter in words where its object is named beside it: `rocker.pair.contact.stiffness` as
/// contact stiffness, a place in a list counted from 1, of a point as x or y.
#[cfg(feature = "live")]
pub(crate) fn property_words(path: &str) -> String {
    let (_, inner) = path.split_once('.').unwrap_or(("", path));
    let parts: Vec<&str> = inner.split('.').collect();
    let is_point = parts.len() > 1 && parts[parts.len() - 2] == "points";
    let told = parts
        .iter()
        .filter(|part| !SILENT.contains(part) && **part != "points");
    let words: Vec<String> = told.map(|part| listed(part, is_point)).collect();
    match words.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["loads", load, "constant"] => format!("load {load}"),
        ["loads", load, .., last] => format!("{last} of {load}"),
        [] => path.to_owned(),
        _ => words.join(" "),
    }
}

/// A part of an address in words, with its places in lists.
#[cfg(feature = "live")]
fn listed(part: &str, is_point: bool) -> String {
    let (name, places) = match part.find('[') {
        Some(at) => part.split_at(at),
        None => (part, ""),
    };
    let places = places.split(['[', ']']).filter(|place| !place.is_empty());
    let told = places.map(|place| match (place.parse::<usize>(), is_point) {
        (Ok(0), true) => " x".to_owned(),
        (Ok(1), true) => " y".to_owned(),
        (Ok(place), _) => format!(" {}", place + 1),
        (Err(_), _) => format!(" {place}"),
    });
    name.replace('_', " ") + &told.collect::<String>()
}

/// Settings as a label has them, `rocker.masses = 2`, their parameters in words.
pub(in crate::report) fn setting_words(label: &str) -> String {
    let one = |setting: &str| match setting.split_once(" = ") {
        Some((path, value)) => format!("{} = {value}", parameter_words(path)),
        None => setting.to_owned(),
    };
    label.split(", ").map(one).collect::<Vec<_>>().join(", ")
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
    use super::{condition_words, in_words, parameter_words, result_words, setting_words};

    #[test]
    fn results_and_parameters_are_named() {
        assert_eq!(
            result_words("press.ram.delta_abs"),
            "greatest |δ| of press.ram"
        );
        for (address, words) in [
            ("frequency.1", "natural frequency 1"),
            (
                "frequency.open.2",
                "natural frequency 2, contacts separated",
            ),
            ("rocker.final.speed", "speed of rocker at the end"),
            ("steady.fluctuation", "coefficient of speed fluctuation"),
            ("cam.valve.least_radius", "least radius of the cam of valve"),
            ("run.switches", "events"),
            ("run.first_times.caught", "run.first_times.caught"),
        ] {
            assert_eq!(result_words(address), words);
        }
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

    #[cfg(feature = "live")]
    #[test]
    fn properties_are_named_without_their_object() {
        use super::property_words;
        for (path, words) in [
            ("shaft.motion.speed", "speed"),
            ("rocker.damping_capacity", "damping capacity"),
            ("rocker.pair.contact.stiffness", "contact stiffness"),
            ("rocker.position.sine.amplitude", "sine amplitude"),
            ("rocker.loads.closing.constant", "load closing"),
            ("ram.loads.guide.friction.force", "force of guide"),
            ("bar.links.rod.points.C[1]", "rod C y"),
            ("cam.position.table.points[3][0]", "table points 4 1"),
            ("parameters.n", "n"),
            ("run.duration", "duration"),
            ("run", "run"),
        ] {
            assert_eq!(property_words(path), words);
        }
    }

    #[test]
    fn settings_name_their_parameters() {
        let words = setting_words("rocker.masses = 2, shaft.motion.speed = 5 rpm");
        assert_eq!(words, "masses of rocker = 2, speed of shaft = 5 rpm");
        assert_eq!(setting_words("map"), "map");
    }

    #[test]
    fn addresses_within_a_text_are_named_and_code_stays() {
        for (text, words) in [
            (
                "rocker.delta_abs leads to 0.0075 rad.",
                "Greatest |δ| of rocker leads to 0.0075 rad.",
            ),
            ("see run. It", "see run. It"),
            ("it has no lever.sigma.", "it has no mean |δ| of lever."),
            ("rocker.delta_abs", "rocker.delta_abs"),
            (
                "write --figure rocker.sigma, or `rocker.sigma`; δ of rocker.sigma: 1.5",
                "write --figure rocker.sigma, or `rocker.sigma`; δ of mean |δ| of rocker: 1.5",
            ),
            (
                "--accuracy rocker.delta_abs=1",
                "--accuracy rocker.delta_abs=1",
            ),
            (
                "see record.csv, e.g. run.json",
                "see record.csv, e.g. run.json",
            ),
        ] {
            assert_eq!(in_words(text), words);
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
