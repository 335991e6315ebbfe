//! Stand-alone pictures: the object graph, line charts, charts on logarithmic axes, strips of regions.

pub mod chart;
pub mod graph;
mod legend;
pub mod log_chart;
pub mod map;
pub mod strips;

/// Characters per line that fit `width` at a font size, for a sans-serif face.
fn fits(width: f64, font_size: f64) -> usize {
    (width / (0.56 * font_size)).max(3.0) as usize
}

/// A coordinate for an SVG attribute: two decimals, no negative zero.
pub(in crate::report) fn coordinate(value: f64) -> String {
    let text = format!("{value:.2}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" {
        "0".into()
    } else {
        text.to_owned()
    }
}

/// A style whose colours are those of a page, `var(--ink, #17202a)`, with the colours
/// of its own instead: for pictures that stand alone, since not every reader of SVG
/// knows variables.
pub(in crate::report) fn without_variables(style: &str) -> String {
    let mut out = String::with_capacity(style.len());
    let mut rest = style;
    while let Some((before, variable)) = rest.split_once("var(") {
        let (given, after) = variable.split_once(')').unwrap_or((variable, ""));
        let own = given
            .split_once(", ")
            .map_or("inherit", |(_, colour)| colour);
        out.push_str(before);
        out.push_str(own);
        rest = after;
    }
    out + rest
}

#[cfg(test)]
mod tests {
    use super::without_variables;

    #[test]
    fn colours_of_a_page_are_left_out_of_pictures() {
        let style = ".a{fill:var(--ink, #17202a);stroke:#fff}.b{fill:var(--paper, #fff)}";
        assert_eq!(
            without_variables(style),
            ".a{fill:#17202a;stroke:#fff}.b{fill:#fff}"
        );
        assert_eq!(without_variables("plain"), "plain");
    }
}
