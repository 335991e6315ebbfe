//! How verdicts look: hatching over the colours of values, plain fills where
//! there is no value. Mechanism and computation never look alike.

use crate::analysis::map::Verdict;

/// Fill of cells of a verdict under their hatching, when they have no value.
pub(super) fn ground(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::NumericalFailure => "#b3124f",
        Verdict::Stopped => "#7d8791",
        Verdict::Refused => "#eceff2",
        _ => "#c9cfd5",
    }
}

/// Colour of a verdict where there is no colour of values: in strips under
/// curves and in legends.
pub(super) fn plain(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::InWorkingOrder => "#2f8f5b",
        Verdict::LiftOffDiesAway => "#8db8d8",
        Verdict::LiftOff => "#2d6aa8",
        Verdict::LiftOffNotJudged => "#6f8396",
        Verdict::ThrownOff => "#16324f",
        Verdict::Resonance => "#d98a1c",
        other => ground(other),
    }
}

/// Name of the hatching of a verdict; `None`: left plain.
pub(super) fn hatching(verdict: Verdict) -> Option<&'static str> {
    match verdict {
        Verdict::InWorkingOrder => None,
        Verdict::LiftOffDiesAway => Some("dam-dies"),
        Verdict::LiftOff => Some("dam-lifts"),
        Verdict::LiftOffNotJudged => Some("dam-unjudged"),
        Verdict::ThrownOff => Some("dam-thrown"),
        Verdict::Resonance => Some("dam-resonance"),
        Verdict::Stopped => Some("dam-stopped"),
        Verdict::NumericalFailure => Some("dam-failed"),
        Verdict::Refused => Some("dam-refused"),
    }
}

/// The hatchings. Lines are drawn dark and light side by side, so that they
/// show on every colour.
pub(super) fn patterns() -> String {
    let rise = "M-1 9L9 -1M-1 1L1 -1M7 9L9 7";
    let fall = "M-1 -1L9 9M7 -1L9 1M-1 7L1 9";
    let cross = "M-1 9L9 -1M-1 1L1 -1M7 9L9 7M-1 -1L9 9M7 -1L9 1M-1 7L1 9";
    let wide = "M-1 13L13 -1M-1 -1L13 13";
    let list = [
        ("dam-lifts", 8.0, rise),
        ("dam-dies", 8.0, fall),
        ("dam-unjudged", 8.0, "M0 4H3"),
        ("dam-thrown", 12.0, wide),
        ("dam-resonance", 6.0, "M3 0V6"),
        ("dam-stopped", 6.0, "M0 3H6"),
        ("dam-failed", 8.0, cross),
        ("dam-refused", 8.0, "M0 8L8 0"),
    ];
    let one = |(name, size, path): &(&str, f64, &str)| {
        format!(
            "<pattern id=\"{name}\" width=\"{size}\" height=\"{size}\" \
             patternUnits=\"userSpaceOnUse\"><path d=\"{path}\" fill=\"none\" stroke=\"#10161c\" \
             stroke-opacity=\".38\" stroke-width=\"1.5\"/><path d=\"{path}\" fill=\"none\" \
             stroke=\"#fff\" stroke-opacity=\".55\" stroke-width=\".6\"/></pattern>\n"
        )
    };
    format!(
        "<defs>\n{}</defs>\n",
        list.iter().map(one).collect::<String>()
    )
}
