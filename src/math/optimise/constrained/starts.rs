//! Places to start from, evenly in all variables: a scrambled Sobol sequence.

use sobol_burley::sample;

/// Of which the scrambling is made: always the same.
const SEED: u32 = 0x0dab_5eed;

/// The coordinates of a start by its number, each between 0 and 1 (Owen's scrambling in base 2,
/// Burley 2020). The same on every machine.
pub(crate) fn starts(number: u32, variables: usize) -> Vec<f64> {
    let coordinate = |variable: usize| {
        let dimension = u32::try_from(variable).unwrap_or(0) % sobol_burley::NUM_DIMENSIONS;
        f64::from(sample(number, dimension, SEED))
    };
    (0..variables).map(coordinate).collect()
}
