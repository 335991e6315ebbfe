//! All colours of charts and pages, for light and dark ground, and the colours of values.
//!
//! Pages have them as CSS variables; pictures that stand alone have the colours themselves,
//! since not every reader of SVG knows variables, and the dark ones under a media query.
//!
//! The colours of values are those of viridis (Stéfan van der Walt and Nathaniel Smith,
//! matplotlib, dedicated to the public domain under CC0), sixteen of them with straight lines
//! between: lightness grows evenly, so that they keep their order in print and for
//! colour-blind eyes.

/// A variable with its colour on light and on dark ground.
type Colour = (&'static str, &'static str, &'static str);

/// Lines over coloured values, on any ground: dark, and light beside them.
pub(in crate::report) const OVER: &str = "#10161c";
pub(in crate::report) const OVER_LIGHT: &str = "#ffffff";

const GENERAL: [Colour; 32] = [
    ("paper", "#ffffff", "#14181d"),
    ("panel", "#f6f7f9", "#1b2027"),
    ("box", "#ffffff", "#1f252d"),
    ("box-drive", "#e8f0f8", "#1d2c3c"),
    ("ink", "#17202a", "#e6eaee"),
    ("ink-soft", "#4f5a66", "#a0abb7"),
    ("line", "#d5dae0", "#38414b"),
    ("grid", "#e7eaee", "#262d35"),
    ("accent", "#b4451f", "#ef8a55"),
    ("shade", "rgba(196,84,32,.15)", "rgba(239,138,85,.2)"),
    ("rule", "#8f1d3f", "#f59ab5"),
    ("link", "#1d5a9e", "#7db4ee"),
    ("good", "#1d6b43", "#7fd3a5"),
    ("good-back", "#e6f3ec", "#173326"),
    ("mechanism", "#98420f", "#f5b183"),
    ("mechanism-back", "#fcefe3", "#3a2413"),
    ("numerical", "#8f1d3f", "#f59ab5"),
    ("numerical-back", "#fbe8ee", "#3d1725"),
    ("unfinished", "#4c5560", "#c3ccd5"),
    ("unfinished-back", "#eceff2", "#262d35"),
    ("faint", "#a9b2bb", "#5d6772"),
    ("over", OVER, OVER),
    ("over-light", OVER_LIGHT, OVER_LIGHT),
    ("kept", "#c0267a", "#c0267a"),
    ("part-0", "#8fb6dd", "#8fb6dd"),
    ("part-1", "#eab08c", "#eab08c"),
    ("part-2", "#96cbac", "#96cbac"),
    ("part-3", "#c8a9d8", "#c8a9d8"),
    ("part-4", "#d9c88c", "#d9c88c"),
    ("part-5", "#8fcbd4", "#8fcbd4"),
    ("part-6", "#dfa0bd", "#dfa0bd"),
    ("part-7", "#b4bdc6", "#b4bdc6"),
];

/// Colours of series, that keep apart in print and for colour-blind eyes, and their dashes.
pub(in crate::report) const SERIES: [(&str, &str, &str); 12] = [
    ("#1d5a9e", "#74aeec", ""),
    ("#c04f15", "#f2965c", "7 3"),
    ("#23804d", "#6fcf98", "2 2.5"),
    ("#8345a0", "#c99be0", "9 3 2 3"),
    ("#8a6a10", "#d9bb5c", "4 2"),
    ("#0b8296", "#5fc9db", "12 4"),
    ("#b0306a", "#ee86b2", "1.5 3.5"),
    ("#566370", "#aab4bf", "6 2 1 2"),
    ("#3a9bdc", "#b5d9ff", "14 3 3 3"),
    ("#7fa015", "#c3e06a", "3 6"),
    ("#6e3b1c", "#c99a7a", "10 2 2 2 2 2"),
    ("#e0609c", "#ffc2dc", "5 5 1 5"),
];

/// Colours of the verdicts on methods, the same on light and on dark ground.
pub(in crate::report) mod method_verdicts {
    pub(in crate::report) const CONVERGED: &str = "#8fc7a3";
    pub(in crate::report) const INACCURATE: &str = "#f0c36b";
    pub(in crate::report) const UNSTABLE: &str = "#e0705a";
    pub(in crate::report) const STEP_FLOOR: &str = "#b08ac6";
    pub(in crate::report) const SWITCHES_MISSED: &str = "#f0996b";
    pub(in crate::report) const CHATTER: &str = "#d97aa6";
    pub(in crate::report) const REFUSED: &str = "#c9ced5";
    pub(in crate::report) const GAVE_UP: &str = "#8d97a3";
    pub(in crate::report) const TIME_LIMIT: &str = "#9db8d6";
    pub(in crate::report) const NOT_JUDGED: &str = "#eef0f3";
}

/// Colours of the verdicts of maps, the same on light and on dark ground: blue works, yellow lifts
/// off, red fails, grey is not known. They are told apart without seeing red or green (P. Tol's
/// high-contrast scheme); verdicts of one hue differ in lightness.
pub(in crate::report) mod map_verdicts {
    pub(in crate::report) const IN_WORKING_ORDER: &str = "#4a86bf";
    pub(in crate::report) const LIFT_OFF_DIES_AWAY: &str = "#a3c8e8";
    pub(in crate::report) const LIFT_OFF: &str = "#ddaa33";
    pub(in crate::report) const THROWN_OFF: &str = "#bb5566";
    pub(in crate::report) const RESONANCE: &str = "#8c2f4a";
    pub(in crate::report) const STOPPED: &str = "#5a1a30";
    pub(in crate::report) const NOT_JUDGED: &str = "#b4bac1";
    pub(in crate::report) const NUMERICAL_FAILURE: &str = "#3c4249";
    pub(in crate::report) const REFUSED: &str = "#e6e9ec";
}

/// The style of charts, in the variables of a page.
pub(in crate::report) const STYLE: &str = include_str!("plot.css");

/// Number of the style of a series: colour, dash and shape of marks.
pub(super) fn style(index: usize) -> usize {
    index % SERIES.len()
}

fn css_variables(dark: bool) -> impl Iterator<Item = (String, &'static str)> {
    let of = move |(light, deep)| if dark { deep } else { light };
    let general = (GENERAL.iter()).map(move |(name, l, d)| ((*name).to_owned(), of((*l, *d))));
    let series = SERIES.iter().enumerate();
    general.chain(series.map(move |(k, (l, d, _))| (format!("series-{k}"), of((*l, *d)))))
}

/// The variables of a page, light, and dark where the reader wishes it and nothing is printed.
pub(in crate::report) fn of_page() -> String {
    let list = |dark| -> String {
        let one = |(name, colour)| format!("--{name}:{colour};");
        css_variables(dark).map(one).collect()
    };
    format!(
        ":root{{color-scheme:light dark;{}}}\n@media screen and (prefers-color-scheme:dark){{:root{{{}}}}}\n",
        list(false),
        list(true)
    )
}

/// A style with the colours of light ground in place of the variables, and those of dark
/// ground behind a media query.
pub(in crate::report) fn standing_alone(style: &str) -> String {
    // Only what has a colour of the page is different on dark ground.
    let coloured: String = style
        .split_inclusive('}')
        .filter(|rule| rule.contains("var("))
        .collect();
    let dark = match coloured.is_empty() {
        true => String::new(),
        false => format!(
            "@media screen and (prefers-color-scheme:dark){{{}}}",
            with_colours(&coloured, true)
        ),
    };
    with_colours(style, false) + &dark
}

/// A style with colours in place of `var(--ink)`.
fn with_colours(style: &str, dark: bool) -> String {
    let mut out = String::with_capacity(style.len());
    let mut rest = style;
    while let Some((before, after)) = rest.split_once("var(--") {
        let (name, after) = after.split_once(')').unwrap_or((after, ""));
        let name = name.split(',').next().unwrap_or(name).trim();
        let found = css_variables(dark).find(|(known, _)| known == name);
        out.push_str(before);
        out.push_str(found.map_or("inherit", |(_, colour)| colour));
        rest = after;
    }
    out + rest
}
