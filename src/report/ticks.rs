//! Tick marks of axes at round numbers.

/// Round tick values that lie within an axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Ticks {
    /// Ascending values.
    pub values: Vec<f64>,
    /// Digits after the point that tell neighbouring ticks apart.
    pub decimals: usize,
}

/// Ticks at multiples of 1, 2 or 5 times a power of ten between `low` and
/// `high`, about `count` of them. Empty for an axis without extent.
pub fn ticks(low: f64, high: f64, count: usize) -> Ticks {
    let span = high - low;
    let none = Ticks {
        values: Vec::new(),
        decimals: 0,
    };
    if !(span.is_finite() && span > 0.0) {
        return none;
    }
    let step = round_step(span / count.max(1) as f64);
    let (first, last) = ((low / step - 1e-9).ceil(), (high / step + 1e-9).floor());
    // Far from zero a tiny span is below the resolution of the numbers.
    if step <= 0.0 || last - first > 1000.0 {
        return none;
    }
    let values = (0..=(last - first).max(0.0) as usize)
        .map(|index| (first + index as f64) * step)
        .collect();
    let decimals = (-(step.log10() + 1e-9).floor()).clamp(0.0, 17.0) as usize;
    Ticks { values, decimals }
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
    pub fn label(&self, value: f64) -> String {
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
    use super::ticks;

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
    fn an_axis_without_extent_has_no_ticks() {
        assert!(ticks(1.0, 1.0, 5).values.is_empty());
        assert!(ticks(0.0, f64::NAN, 5).values.is_empty());
        assert!(ticks(1.0, 0.0, 5).values.is_empty());
    }
}
