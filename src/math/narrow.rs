//! Narrow stretches of a function of one variable: where it changes within a small part of
//! a span, so that long steps would pass over it unseen.
//!
//! The span is halved until samples of a panel show about all that bounds of the function
//! allow in it. Panels that had to become short for that are narrow.

/// A stretch in which steps must be short.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Narrow {
    /// Where it begins.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
    /// Longest step in it.
    pub longest: f64,
}

/// The golden section.
const GOLDEN: f64 = 0.618_033_988_749_894_9;
/// Samples of a panel less one.
const SAMPLES: usize = 8;
/// Samples of the whole span, for the size of the function.
const LOOKS: usize = 64;
/// Bounds may be so many times as wide as the range of the samples: they are wider than
/// the function is.
const WIDER: f64 = 4.0;
/// A change below this share of the greatest one does not count.
const COUNTS: f64 = 0.01;
/// Changes below this share of the bounds over the whole span are rounding.
const NOISE: f64 = 1e-9;
/// Least halvings one in another: samples of a whole span may all hit pulses that repeat.
const LEAST: u32 = 3;
/// Most halvings one in another, and most panels.
const DEEPEST: u32 = 24;
const MOST: usize = 4096;
/// Most panels of a step of an integration.
const MOST_OF_STEP: usize = 256;
/// A panel shorter than this share of the span is narrow.
const SHORT: f64 = 1.0 / 16.0;

/// A panel with the range of its samples.
#[derive(Clone, Copy, Debug)]
struct Panel {
    from: f64,
    to: f64,
    change: f64,
}

/// The narrow stretches between two places, ascending. `bounds` gives the least and the
/// greatest value that a function can have between two places, not numbers where nothing is
/// known; `value` the function.
///
/// Where bounds say nothing down to short panels, or there are too many, nothing is narrow.
pub(crate) fn narrow_stretches(
    from: f64,
    to: f64,
    bounds: impl Fn(f64, f64) -> [f64; 2],
    value: impl Fn(f64) -> f64,
) -> Vec<Narrow> {
    let whole = width(bounds(from, to));
    if whole == 0.0 {
        return Vec::new();
    }
    let noise = if whole.is_finite() {
        NOISE * whole
    } else {
        0.0
    };
    let mut panels = Vec::new();
    let asked = (noise, LEAST, MOST);
    let Some(greatest) = search([from, to], bounds, &value, asked, |panel| {
        panels.push(panel)
    }) else {
        return Vec::new();
    };
    let counts = (COUNTS * greatest).max(noise);
    join_neighbours(&panels, counts, SHORT * (to - from))
}

/// Where the first narrow stretch of a step of an integration begins, from 0 to 1, and the
/// longest step in it. Changes below `noise` do not count; dear where bounds are wide, the
/// search is given up early. It takes no memory.
pub(crate) fn narrow_within(
    bounds: impl Fn(f64, f64) -> [f64; 2],
    value: impl Fn(f64) -> f64,
    noise: f64,
) -> Option<(f64, f64)> {
    let none = Panel {
        from: 0.0,
        to: 0.0,
        change: 0.0,
    };
    let (mut panels, mut count) = ([none; MOST_OF_STEP], 0);
    let asked = (noise, 0, MOST_OF_STEP);
    let greatest = search([0.0, 1.0], bounds, &value, asked, |panel| {
        panels[count] = panel;
        count += 1;
    })?;
    let counts = (COUNTS * greatest).max(noise);
    let narrow = |panel: &Panel| panel.to - panel.from < 1.0 && panel.change > counts;
    let first = panels[..count].iter().position(narrow)?;
    let (from, mut end) = (panels[first].from, panels[first].from);
    let mut steepest = panels[first];
    for panel in panels[first..count]
        .iter()
        .take_while(|panel| narrow(panel))
    {
        if panel.from != end {
            break;
        }
        end = panel.to;
        if panel.change > steepest.change {
            steepest = *panel;
        }
    }
    Some((from, steepest.to - steepest.from))
}

/// Halves a span until each panel shows about all that bounds allow in it, at least `least`
/// times, and tells the panels, ascending: the greatest change that samples show. `None`:
/// there are more than `most`.
fn search(
    [from, to]: [f64; 2],
    bounds: impl Fn(f64, f64) -> [f64; 2],
    value: &impl Fn(f64) -> f64,
    (noise, least, most): (f64, u32, usize),
    mut tell: impl FnMut(Panel),
) -> Option<f64> {
    let mut greatest = match least {
        0 => 0.0,
        _ => samples(from, to, LOOKS, value).range,
    };
    // (Each halving leaves one panel that waits.)
    let mut open = [(from, to, 0); DEEPEST as usize + 2];
    let (mut waiting, mut looks) = (1, 0);
    while waiting > 0 {
        waiting -= 1;
        let (a, b, depth) = open[waiting];
        looks += 1;
        if looks > most {
            return None;
        }
        let Samples { range, shared } = samples(a, b, SAMPLES, value);
        greatest = greatest.max(range);
        let wide = width(bounds(a, b));
        let seen = wide <= (WIDER * shared).max(COUNTS * greatest).max(noise);
        let seen = seen && depth >= least;
        if seen || depth >= DEEPEST {
            // What nothing is known of is not called narrow.
            let change = if seen { range } else { 0.0 };
            tell(Panel {
                from: a,
                to: b,
                change,
            });
        } else {
            let middle = 0.5 * (a + b);
            open[waiting] = (middle, b, depth + 1);
            open[waiting + 1] = (a, middle, depth + 1);
            waiting += 2;
        }
    }
    Some(greatest)
}

/// Neighbours that are narrow as one stretch; its steps are no longer than the panel that changes most.
fn join_neighbours(panels: &[Panel], counts: f64, short: f64) -> Vec<Narrow> {
    let mut found: Vec<Narrow> = Vec::new();
    let mut most = 0.0;
    let narrow = |panel: &&Panel| panel.to - panel.from < short && panel.change > counts;
    for panel in panels.iter().filter(narrow) {
        let longest = panel.to - panel.from;
        match found.last_mut().filter(|last| last.to == panel.from) {
            Some(last) => {
                last.to = panel.to;
                if panel.change > most {
                    (most, last.longest) = (panel.change, longest);
                }
            }
            None => {
                most = panel.change;
                let Panel { from, to, .. } = *panel;
                found.push(Narrow { from, to, longest });
            }
        }
    }
    found
}

/// Infinite where nothing is known.
fn width([low, high]: [f64; 2]) -> f64 {
    let width = high - low;
    if width.is_nan() { f64::INFINITY } else { width }
}

/// What samples show of a function.
#[derive(Clone, Copy, Debug)]
struct Samples {
    /// From the least to the greatest.
    range: f64,
    /// From the second least to the second greatest: a pulse that one sample hits by chance
    /// is still narrower than their spacing.
    shared: f64,
}

/// Samples that are not numbers do not count.
fn samples(from: f64, to: f64, count: usize, value: &impl Fn(f64) -> f64) -> Samples {
    let (mut least, mut greatest) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    // Spaced by the golden section: pulses that repeat after a share of the span are not hit
    // by several of them, as by equally spaced ones.
    let inner = (1..count).map(|k| (k as f64 * GOLDEN).fract());
    let shares = [0.0, 1.0].into_iter().chain(inner);
    let places = shares.map(|share| from + (to - from) * share);
    for value in places.map(value).filter(|value| !value.is_nan()) {
        least = [least[0].min(value), least[1].min(value.max(least[0]))];
        greatest = [
            greatest[0].max(value),
            greatest[1].max(value.min(greatest[0])),
        ];
    }
    Samples {
        range: (greatest[0] - least[0]).max(0.0),
        shared: (greatest[1] - least[1]).max(0.0),
    }
}

#[cfg(test)]
mod tests {
    use super::{Narrow, narrow_stretches};
    use crate::math::expression::{Expression, Interval, RateBounds};

    /// The narrow stretches of the speed of an expression of t.
    fn of(text: &str, from: f64, to: f64) -> Vec<Narrow> {
        let expression = Expression::new(text, &["t"]).unwrap();
        let code = &expression.program().value;
        let none = |_: u16| crate::math::expression::OPEN;
        let bounds = |a: f64, b: f64| {
            let moving = RateBounds {
                value: Interval::between(a, b),
                rate: Interval::of(1.0),
            };
            let rate = code.evaluate(&[moving], &none).rate;
            [rate.low, rate.high]
        };
        let speed = |t: f64| {
            let dual = crate::math::number::Dual::new(t, 1.0);
            code.evaluate(&[dual], &none).derivative
        };
        narrow_stretches(from, to, bounds, speed)
    }

    #[test]
    fn a_pulse_is_found_wherever_it_is() {
        for place in [0.0131, 0.7, 0.7131, 5.0, 7.77, 12.5, 19.9] {
            for width in [0.3, 0.01, 1e-4] {
                let text = format!("3*t+0.01*exp(-((t-{place})/{width})^2)");
                let found = of(&text, 0.0, 20.0);
                let bend = |one: &Narrow| one.from < place + width && place - width < one.to;
                let here = found.iter().find(|one| bend(one));
                let here = here.unwrap_or_else(|| panic!("{text}: {found:?}"));
                assert!(here.longest < 4.0 * width, "{text}: {found:?}");
                let all: f64 = found.iter().map(|one| one.to - one.from).sum();
                assert!(all < 30.0 * width, "{text}: {found:?}");
            }
        }
    }

    #[test]
    fn what_changes_everywhere_is_narrow_nowhere() {
        for text in [
            "0.3*sin(20*t)",
            "20*t+0.5*sin(5*t)",
            "0.05*sin(11*t)+0.03*sin(17.3*t)",
            "t*sin(20*t)",
            "t^2",
            "0.2*(1-exp(-5*t))",
            "0.3",
            "1e-3*(t^3-4*t^4+6*t^5-4*t^6+t^7)",
        ] {
            let found = of(text, 0.0, 2.0);
            assert_eq!(found, [], "{text}");
        }
    }
}
