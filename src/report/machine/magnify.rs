//! The factor by which deflections are magnified, so that they are seen.

use crate::report::html::player::Magnify;

/// How far the greatest deflection shall be seen to go (pixels).
const SEEN: f64 = 14.0;

/// The factor at which the greatest deflection, of that many pixels in truth, is
/// well seen, a round number; `None` where nothing deflects.
pub(super) fn magnify(pixels: f64) -> Option<Magnify> {
    if !(pixels > 0.0 && pixels.is_finite()) {
        return None;
    }
    let factor = round_below(SEEN / pixels).max(1.0);
    let powers = (0..=12).map(|power| 10f64.powi(power));
    let mut choices: Vec<f64> = powers.filter(|choice| *choice <= 100.0 * factor).collect();
    choices.push(factor);
    choices.sort_by(f64::total_cmp);
    choices.dedup();
    Some(Magnify { factor, choices })
}

/// The greatest of 1, 2 and 5 times a power of ten that is not greater.
fn round_below(value: f64) -> f64 {
    let power = 10f64.powi(value.log10().floor().clamp(-12.0, 12.0) as i32);
    let factors = [5.0, 2.0, 1.0].into_iter();
    let mut fitting = factors.map(|factor| factor * power);
    // A hair of slack keeps 5 from being called less than 5.
    fitting
        .find(|round| *round <= value * (1.0 + 1e-9))
        .unwrap_or(power)
}

#[cfg(test)]
mod tests {
    use super::magnify;

    #[test]
    fn the_greatest_deflection_is_seen_at_a_round_factor() {
        for (pixels, factor) in [
            (14.0, 1.0),
            (0.5, 20.0),
            (0.0028, 5000.0),
            (0.003, 2000.0),
            (400.0, 1.0),
        ] {
            let found = magnify(pixels).unwrap();
            assert_eq!(found.factor, factor, "{pixels}");
            assert!(found.choices.contains(&factor) && found.choices.contains(&1.0));
            assert!(found.choices.windows(2).all(|pair| pair[0] < pair[1]));
        }
        assert!(magnify(0.0).is_none() && magnify(f64::NAN).is_none());
        assert!(magnify(1e-30).is_some());
    }
}
