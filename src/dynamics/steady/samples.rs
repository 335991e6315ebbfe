//! What samples must be.

use super::profile::Extreme;
use super::refusal::{Field, Refusal};

/// Samples in a cycle at least.
pub(super) const LEAST: usize = 3;

/// Share of the cycle, and of J, by which a repeated end point may differ.
pub(super) const SAME_END: f64 = 1e-9;

/// The first least (`sense` −1) or greatest (1) of samples.
pub(super) fn extreme(positions: &[f64], values: &[f64], sense: f64) -> Extreme {
    let first = Extreme {
        value: values[0],
        at: positions[0],
    };
    let pairs = positions.iter().zip(values);
    pairs.fold(first, |best, (&at, &value)| {
        if sense * value > sense * best.value {
            Extreme { value, at }
        } else {
            best
        }
    })
}

pub(super) fn repeats_end(cycle: f64, positions: &[f64]) -> bool {
    let span = positions[positions.len() - 1] - positions[0];
    (span - cycle).abs() <= SAME_END * cycle
}

pub(super) fn too_few(count: usize) -> Field {
    Field {
        field: "position".to_owned(),
        message: format!("{count} samples in a cycle are too few"),
        hint: format!("give at least {LEAST}"),
    }
}

pub(super) fn check_inertia(positions: &[f64], inertia: &[f64]) -> Result<(), Refusal> {
    let bad = |pair: &(&f64, &f64)| !(*pair.1 > 0.0);
    match positions.iter().zip(inertia).find(bad) {
        Some((&position, &inertia)) => Err(Refusal::Inertia { position, inertia }),
        None => Ok(()),
    }
}

pub(super) fn faults(
    cycle: f64,
    positions: &[f64],
    inertia: &[f64],
    other: [(&str, &[f64]); 1],
) -> Vec<Field> {
    let mut faults = Vec::new();
    let mut add = |field: &str, message: String, hint: &str| {
        faults.push(Field {
            field: field.to_owned(),
            message,
            hint: hint.to_owned(),
        });
    };
    let sound = cycle.is_finite() && cycle > 0.0;
    if !sound {
        add("cycle", format!("{cycle} is not a positive number"), "");
    }
    let count = positions.len();
    if count < LEAST {
        let fault = too_few(count);
        add(&fault.field, fault.message, &fault.hint);
    }
    let columns = [("position", positions), ("inertia", inertia), other[0]];
    for (name, values) in columns {
        if values.len() != count {
            let message = format!("{} values for {count} positions", values.len());
            add(name, message, "give one for each position");
        }
        if let Some(row) = values.iter().position(|value| !value.is_finite()) {
            let message = format!("sample {row} is {}, not a finite number", values[row]);
            add(name, message, "");
        }
    }
    if let Some(row) = (1..count).find(|&i| positions[i] <= positions[i - 1]) {
        let (before, after) = (positions[row - 1], positions[row]);
        let message = format!("{after} does not come after {before}");
        add("position", message, "put the positions in ascending order");
    } else if sound && count > 0 && positions[count - 1] - positions[0] > cycle * (1.0 + SAME_END) {
        let span = positions[count - 1] - positions[0];
        let message = format!("the positions span {span} rad, the cycle only {cycle} rad");
        add("position", message, "give one cycle");
    }
    faults
}
