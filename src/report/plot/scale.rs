//! How values lie along an axis, and where its ticks stand.

use super::{Axis, width_of};
use crate::report::quantity::{readable_scale, significant, superscript};

/// An axis with its ends, ready to be drawn.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::report) struct Scale {
    /// True: logarithmic.
    pub(super) log: bool,
    /// The ends, as logarithms of a logarithmic axis.
    pub(super) ends: [f64; 2],
    /// Shown number = value / factor.
    pub(super) factor: f64,
    /// Unit of the shown numbers.
    pub(super) unit: String,
    rows: Vec<String>,
}

/// A line of the grid.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tick {
    /// Place along the axis, 0 … 1.
    pub(super) share: f64,
    /// Label at the tick; may be empty.
    pub(super) label: String,
    /// True between powers of ten.
    pub(super) minor: bool,
    /// True at zero.
    pub(super) zero: bool,
}

/// From this many decades on a logarithmic axis shows powers of ten alone.
const WIDE: f64 = 2.5;

impl Scale {
    /// The scale of an axis between two values.
    pub(in crate::report) fn new(axis: &Axis, [from, to]: [f64; 2]) -> Self {
        let ends = match axis.log {
            true => [from.log10(), to.log10()],
            false => [from, to],
        };
        let ends = match ends.iter().all(|end| end.is_finite()) && ends[0] != ends[1] {
            true => ends,
            false => [0.0, 1.0],
        };
        let greatest = from.abs().max(to.abs());
        let wide = axis.log && (ends[1] - ends[0]).abs() > WIDE;
        let plain = wide || axis.fixed;
        let shown = readable_scale(if plain { 1.0 } else { 0.94 * greatest }, &axis.unit);
        Self {
            log: axis.log,
            ends,
            factor: if plain { 1.0 } else { shown.factor },
            unit: if plain { axis.unit.clone() } else { shown.unit },
            rows: axis.rows.clone(),
        }
    }

    /// Where a value lies, 0 … 1 within the axis; not a number where it has no place.
    pub(in crate::report) fn place_on_axis(&self, value: f64) -> f64 {
        let value = match self.log {
            true if value > 0.0 => value.log10(),
            true => f64::NAN,
            false => value,
        };
        (value - self.ends[0]) / (self.ends[1] - self.ends[0])
    }

    /// The value at a share of the axis.
    #[cfg(test)]
    fn at(&self, share: f64) -> f64 {
        let value = self.ends[0] + share * (self.ends[1] - self.ends[0]);
        if self.log { 10f64.powf(value) } else { value }
    }

    /// Ticks on an axis of that many pixels, about one every `pitch`.
    pub(super) fn ticks(&self, pixels: f64, pitch: f64) -> Vec<Tick> {
        if !self.rows.is_empty() {
            let rows = self.rows.iter().enumerate();
            return rows
                .map(|(row, name)| Tick {
                    share: self.place_on_axis(row as f64 + 0.5),
                    label: name.clone(),
                    minor: false,
                    zero: false,
                })
                .collect();
        }
        let count = (pixels / pitch).max(2.0) as usize;
        let (low, high) = (
            self.ends[0].min(self.ends[1]),
            self.ends[0].max(self.ends[1]),
        );
        if self.log {
            return self.powers(low, high, count);
        }
        let ends = [low / self.factor, high / self.factor];
        let found = match self.unit.as_str() {
            "deg" => angle_ticks(ends, count),
            _ => ticks(ends[0], ends[1], count),
        };
        let tick = |&value: &f64| Tick {
            share: self.place_on_axis(value * self.factor),
            label: found.label(value),
            minor: false,
            zero: value == 0.0,
        };
        found.values.iter().map(tick).collect()
    }

    /// Ticks between 10^low and 10^high.
    fn powers(&self, low: f64, high: f64, count: usize) -> Vec<Tick> {
        let decades = high - low;
        if decades < 0.7 {
            let found = ticks(
                10f64.powf(low) / self.factor,
                10f64.powf(high) / self.factor,
                count,
            );
            let tick = |&value: &f64| Tick {
                share: self.place_on_axis(value * self.factor),
                label: found.label(value),
                minor: false,
                zero: false,
            };
            return found.values.iter().map(tick).collect();
        }
        let every = (decades / count.max(1) as f64).ceil().max(1.0) as i32;
        let some = 3.0 * decades <= 1.6 * count as f64;
        let mut list = Vec::new();
        for decade in low.floor() as i32..=high.ceil() as i32 {
            for lead in 1..=9 {
                let value = f64::from(lead) * 10f64.powi(decade);
                let place = value.log10();
                let named = match lead {
                    1 => decade.rem_euclid(every) == 0,
                    2 | 5 => some,
                    _ => false,
                };
                if place < low - 1e-9 || place > high + 1e-9 || (lead > 1 && decades > 7.0) {
                    continue;
                }
                list.push(Tick {
                    share: self.place_on_axis(value),
                    label: if named {
                        self.label(value, lead, decade)
                    } else {
                        String::new()
                    },
                    minor: lead > 1,
                    zero: false,
                });
            }
        }
        list
    }

    /// `10⁻⁴`, or `0.02` where the axis spans few decades.
    fn label(&self, value: f64, lead: i32, decade: i32) -> String {
        if (self.ends[1] - self.ends[0]).abs() <= WIDE {
            return significant(value / self.factor, 3);
        }
        let power = match decade {
            0 => "1".to_owned(),
            1 => "10".to_owned(),
            _ => format!("10{}", superscript(decade)),
        };
        match (lead, decade) {
            (1, _) => power,
            (_, 0) => lead.to_string(),
            _ => format!("{lead}·{power}"),
        }
    }

    /// `t, ms`; the name alone of a plain number.
    pub(super) fn title(&self, name: &str) -> String {
        match (name, self.unit.as_str()) {
            (name, "") => name.to_owned(),
            ("", unit) => unit.to_owned(),
            (name, unit) => format!("{name}, {unit}"),
        }
    }
}

/// Empties the labels that would touch one shown before them, on an axis of that many pixels.
pub(super) fn thinned(mut list: Vec<Tick>, pixels: f64, gap: f64) -> Vec<Tick> {
    list.sort_by(|a, b| a.share.total_cmp(&b.share));
    let mut end = f64::NEG_INFINITY;
    for tick in &mut list {
        let (at, half) = (tick.share * pixels, 0.5 * width_of(&tick.label));
        if at - half < end + gap {
            tick.label.clear();
        } else if !tick.label.is_empty() {
            end = at + half;
        }
    }
    list
}

/// Round tick values that lie within an axis.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::report) struct Ticks {
    /// Ascending values.
    pub(in crate::report) values: Vec<f64>,
    /// Digits after the point that tell neighbouring ticks apart.
    decimals: usize,
}

/// Ticks at multiples of 1, 2 or 5 times a power of ten between `low` and
/// `high`, about `count` of them. Empty for an axis without extent.
pub(in crate::report) fn ticks(low: f64, high: f64, count: usize) -> Ticks {
    let span = high - low;
    if !(span.is_finite() && span > 0.0) {
        return Ticks::default();
    }
    let step = round_step(span / count.max(1) as f64);
    ticks_at_multiples([low, high], count, [step, round_step(0.4 * step)])
}

/// Least number of ticks that say how an axis is divided, if there is room for more.
const FEW: usize = 3;

/// Ticks at the multiples of a step, or of the next smaller one where these are too few.
fn ticks_at_multiples(ends: [f64; 2], count: usize, [step, finer]: [f64; 2]) -> Ticks {
    let found = at_steps(ends, step);
    let more = at_steps(ends, finer);
    match found.values.len() < FEW && (FEW..=2 * count).contains(&more.values.len()) {
        true => more,
        false => found,
    }
}

/// Ticks at the multiples of a step.
fn at_steps([low, high]: [f64; 2], step: f64) -> Ticks {
    let (first, last) = ((low / step - 1e-9).ceil(), (high / step + 1e-9).floor());
    // Far from zero a tiny span is below the resolution of the numbers; a short axis may have no
    // round value on it.
    if step <= 0.0 || !(0.0..=1000.0).contains(&(last - first)) {
        return Ticks::default();
    }
    let values = (0..=(last - first) as usize)
        .map(|index| (first + index as f64) * step)
        .collect();
    let decimals = (-(step.log10() + 1e-9).floor()).clamp(0.0, 17.0) as usize;
    Ticks { values, decimals }
}

/// Parts of a turn that angles are counted in (degrees), where 1, 2 and 5 are too few.
const PARTS: [f64; 7] = [10.0, 15.0, 30.0, 60.0, 90.0, 180.0, 360.0];
/// Spans that are about one turn, which has a tick every 60 deg.
const ONE_TURN: [f64; 2] = [300.0, 400.0];

/// Ticks of an angle in degrees: from 10 deg on they are parts of a turn, or whole turns.
fn angle_ticks([low, high]: [f64; 2], count: usize) -> Ticks {
    let raw = (high - low) / count.max(1) as f64;
    let part = PARTS.iter().position(|part| raw <= *part * (1.0 + 1e-9));
    match part {
        _ if raw <= 5.0 => ticks(low, high, count),
        Some(part) if PARTS[part] < 60.0 && is_within(high - low, ONE_TURN) => {
            at_steps([low, high], 60.0)
        }
        Some(part) => {
            let steps = [PARTS[part], PARTS[part.saturating_sub(1)]];
            ticks_at_multiples([low, high], count, steps)
        }
        None if raw.is_finite() => {
            let turns = round_step(raw / 360.0);
            let finer = round_step(0.4 * turns).max(1.0);
            ticks_at_multiples(
                [low, high],
                count,
                [turns, finer].map(|turns| 360.0 * turns),
            )
        }
        None => Ticks::default(),
    }
}

fn is_within(value: f64, [least, most]: [f64; 2]) -> bool {
    (least..=most).contains(&value)
}

/// 1, 2 or 5 times a power of ten, at least `raw`.
fn round_step(raw: f64) -> f64 {
    let power = 10f64.powf(raw.log10().floor());
    let lead = raw / power;
    let factor = [1.0, 2.0, 5.0]
        .into_iter()
        .find(|f| lead <= f * (1.0 + 1e-9));
    factor.unwrap_or(10.0) * power
}

impl Ticks {
    /// A tick's label, with a real minus sign and no negative zero.
    pub(in crate::report) fn label(&self, value: f64) -> String {
        let text = format!("{:.*}", self.decimals, value);
        match text.strip_prefix('-') {
            Some(rest) if rest.chars().any(|c| c.is_ascii_digit() && c != '0') => {
                format!("−{rest}")
            }
            Some(rest) => rest.to_owned(),
            None => text,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Scale, thinned, ticks};
    use crate::report::plot::Axis;

    #[test]
    fn ticks_are_round_and_inside() {
        let axis = ticks(-0.34, 7.6, 6);
        let labels: Vec<_> = axis.values.iter().map(|&v| axis.label(v)).collect();
        assert_eq!(labels, ["0", "2", "4", "6"]);
        let axis = ticks(0.0, 0.5, 5);
        assert_eq!(axis.values.len(), 6);
        assert_eq!(axis.label(axis.values[1]), "0.1");
        assert_eq!(ticks(-1.0, 1.0, 4).label(-0.5), "−0.5");
        assert_eq!(ticks(-1e-3, 1e-3, 4).label(-0.0), "0.0000");
    }

    #[test]
    fn an_axis_has_three_ticks_or_more_where_there_is_room() {
        for (ends, count, expected) in [
            ([-4.3, 4.3], 3, vec![-4.0, -2.0, 0.0, 2.0, 4.0]),
            ([0.0, 1872.0], 3, vec![0.0, 500.0, 1000.0, 1500.0]),
            ([0.0, 9.9], 4, vec![0.0, 2.0, 4.0, 6.0, 8.0]),
        ] {
            assert_eq!(ticks(ends[0], ends[1], count).values, expected);
        }
    }

    #[test]
    fn angles_are_counted_in_parts_of_a_turn_and_in_turns() {
        let of = |ends, pixels: f64, pitch| -> Vec<String> {
            let degrees = Axis {
                fixed: true,
                ..Axis::new("φ", "deg")
            };
            let list = Scale::new(&degrees, ends).ticks(pixels, pitch);
            list.into_iter().map(|tick| tick.label).collect()
        };
        let turn = ["0", "60", "120", "180", "240", "300", "360"];
        assert_eq!(of([0.0, 360.0], 1184.0, 78.0), turn);
        assert_eq!(of([0.0, 360.0], 500.0, 78.0), turn);
        assert_eq!(of([0.0, 1872.0], 100.0, 32.0), ["0", "720", "1440"]);
        let turns = ["0", "3600", "7200", "10800"];
        assert_eq!(of([0.0, 13279.0], 100.0, 32.0), turns);
        assert_eq!(of([93.0, 142.0], 100.0, 32.0), ["105", "120", "135"]);
    }

    #[test]
    fn an_axis_without_extent_has_no_ticks() {
        assert!(ticks(1.0, 1.0, 5).values.is_empty());
        assert!(ticks(0.0, f64::NAN, 5).values.is_empty());
        assert!(ticks(1.0, 0.0, 5).values.is_empty());
    }

    #[test]
    fn a_decade_takes_the_same_room_everywhere() {
        let axis = Axis {
            log: true,
            ..Axis::new("error", "")
        };
        let scale = Scale::new(&axis, [1e-9, 1e3]);
        let shares = [1e-6, 1e-3, 1.0].map(|value| scale.place_on_axis(value));
        approx::assert_abs_diff_eq!(
            shares[1] - shares[0],
            shares[2] - shares[1],
            epsilon = 1e-12
        );
        approx::assert_relative_eq!(
            scale.at(scale.place_on_axis(3e-5)),
            3e-5,
            max_relative = 1e-9
        );
        assert!(scale.place_on_axis(0.0).is_nan() && scale.place_on_axis(-1.0).is_nan());
        let named = scale.ticks(300.0, 48.0);
        assert!(named.iter().any(|tick| tick.label == "10⁻⁶"));
    }

    #[test]
    fn labels_of_ticks_never_touch() {
        for log in [false, true] {
            for (from, to) in [(1e-3, 1.0), (0.9, 1.1), (1e-9, 1e4), (123456.7, 123457.9)] {
                for pixels in [60.0, 150.0, 400.0, 1200.0] {
                    let axis = Axis {
                        log,
                        ..Axis::new("x", "m")
                    };
                    let scale = Scale::new(&axis, [from, to]);
                    let list = thinned(scale.ticks(pixels, 20.0), pixels, 6.0);
                    let shown: Vec<_> = list.iter().filter(|t| !t.label.is_empty()).collect();
                    for pair in shown.windows(2) {
                        let room = (pair[1].share - pair[0].share) * pixels;
                        let need = 0.5
                            * (super::width_of(&pair[0].label) + super::width_of(&pair[1].label));
                        assert!(room >= need, "{from} … {to} on {pixels}: {pair:?}");
                    }
                }
            }
        }
    }
}
