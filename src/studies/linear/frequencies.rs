//! The frequencies of a response.

use super::model::LinearModel;
use crate::studies::axis::Axis;

/// Most numbers of a response: frequencies times pairs of input and output.
pub const MOST_NUMBERS: usize = 1_000_000;

/// Frequencies of a response where none are given.
const USUAL: usize = 400;

/// Whether frequencies (Hz) can be answered for so many pairs of input and output.
///
/// # Errors
/// What is wrong, and what would be right.
pub fn check(frequencies: &[f64], pairs: usize) -> Result<(), String> {
    if frequencies.is_empty() {
        return Err("no frequency is given; give LOW:HIGH or a list".to_owned());
    }
    if let Some(wrong) = frequencies
        .iter()
        .find(|one| !(one.is_finite() && **one >= 0.0))
    {
        return Err(format!(
            "{wrong} Hz is no frequency; give finite numbers from 0 on"
        ));
    }
    if let Some(pair) = frequencies.windows(2).find(|pair| pair[0] >= pair[1]) {
        let [before, after] = [pair[0], pair[1]];
        return Err(format!(
            "{after} Hz stands behind {before} Hz; give frequencies in ascending order, each once"
        ));
    }
    let numbers = frequencies.len().saturating_mul(pairs);
    match numbers > MOST_NUMBERS {
        true => Err(format!(
            "{} frequencies of {pairs} pairs of input and output are {numbers} values, and \
             {MOST_NUMBERS} are the most; give fewer frequencies, or name inputs and outputs",
            frequencies.len()
        )),
        false => Ok(()),
    }
}

/// Frequencies (Hz) around all natural frequencies of a model, with equal ratios.
pub fn usual(model: &LinearModel) -> Vec<f64> {
    let modes = model.trees.iter().filter_map(|tree| tree.equations.modes());
    let all: Vec<f64> = modes
        .flatten()
        .map(|mode| mode.frequency / std::f64::consts::TAU)
        .collect();
    let lowest = all.iter().copied().fold(f64::INFINITY, f64::min);
    let highest = all.iter().copied().fold(0.0, f64::max);
    match lowest.is_finite() && lowest > 0.0 {
        true => Axis::log("", rounded(0.1 * lowest), rounded(2.0 * highest), USUAL).values(),
        false => Axis::log("", 0.1, 1000.0, USUAL).values(),
    }
}

/// To two digits.
fn rounded(value: f64) -> f64 {
    let scale = 10f64.powi(value.log10().floor() as i32 - 1);
    (value / scale).round() * scale
}

#[cfg(test)]
mod tests {
    use super::check;

    #[test]
    fn what_is_no_list_of_frequencies_is_refused_with_its_place() {
        assert!(check(&[0.0, 1.0, 5.0], 3).is_ok());
        for (wrong, words) in [
            (vec![], "no frequency"),
            (vec![-1.0, 2.0], "-1 Hz is no frequency"),
            (vec![1.0, f64::NAN], "NaN Hz is no frequency"),
            (vec![5.0, 2.0], "2 Hz stands behind 5 Hz"),
            (vec![5.0, 5.0], "5 Hz stands behind 5 Hz"),
        ] {
            let said = check(&wrong, 1).unwrap_err();
            assert!(said.contains(words), "{said}");
        }
        let many: Vec<f64> = (0..1000).map(f64::from).collect();
        assert!(check(&many, 1000).is_ok());
        assert!(check(&many, 1001).unwrap_err().contains("1001000 values"));
    }
}
