//! The five cases and their reference trajectories.

use crate::chain::Chain;

/// A problem with a known answer.
#[derive(Clone, Debug)]
pub(crate) struct Case {
    /// A … E.
    pub(crate) name: char,
    /// Its equations.
    pub(crate) chain: Chain,
    /// δ at t = kT/1000, k = 1 … 1000 (rad).
    pub(crate) reference: Vec<f64>,
    /// Switches of the contact after the start.
    pub(crate) switches: usize,
    /// How many times faster than the fastest other solver, and than CVODE,
    /// `dam` is meant to be.
    pub(crate) aim: [Option<f64>; 2],
}

/// Samples of every trajectory.
pub(crate) const SAMPLES: usize = 1000;

/// Unit of the numbers in the reference files (rad).
const UNIT: f64 = 1e-19;

impl Case {
    /// All five.
    pub(crate) fn all() -> Vec<Self> {
        let case = |name, masses, load, psi, duration, aim, text| {
            let chain = Chain::new(masses, [0.1, 1e7], load, psi, duration);
            let (reference, switches) = read(text);
            Self {
                name,
                chain,
                reference,
                switches,
                aim,
            }
        };
        let text = |name: char| match name {
            'A' => include_str!("../reference/A.txt"),
            'B' => include_str!("../reference/B.txt"),
            'C' => include_str!("../reference/C.txt"),
            'D' => include_str!("../reference/D.txt"),
            _ => include_str!("../reference/E.txt"),
        };
        vec![
            case('A', 1, 1000.0, 0.4, 1.0, [Some(200.0), None], text('A')),
            case(
                'B',
                1,
                600.0,
                0.4,
                1.0,
                [Some(40.0), Some(300.0)],
                text('B'),
            ),
            case(
                'C',
                2,
                600.0,
                0.4,
                1.0,
                [Some(50.0), Some(600.0)],
                text('C'),
            ),
            case(
                'D',
                10,
                1000.0,
                0.4,
                1.0,
                [Some(500.0), Some(3000.0)],
                text('D'),
            ),
            case('E', 1, 600.0, 0.0, 0.1, [Some(20.0), None], text('E')),
        ]
    }

    /// Greatest error of δ over the samples, relative to max|δ|. A sample that
    /// is not a number is an infinite error.
    pub(crate) fn error(&self, samples: &[f64]) -> f64 {
        assert!(
            (SAMPLES - 1..=SAMPLES).contains(&samples.len()),
            "{} samples",
            samples.len()
        );
        let largest = self.reference.iter().fold(0.0, |m: f64, q| m.max(q.abs()));
        let differences = samples.iter().zip(&self.reference).map(|(s, r)| {
            let difference = (s - r).abs();
            if difference.is_nan() {
                f64::INFINITY
            } else {
                difference
            }
        });
        differences.fold(0.0, f64::max) / largest
    }
}

/// Samples and number of switches of a reference file.
fn read(text: &str) -> (Vec<f64>, usize) {
    let lines = text.lines().filter(|line| !line.starts_with('#'));
    let mut lines = lines.peekable();
    let first = lines.next().expect("a line of switches");
    let count = first.strip_prefix("switches ").expect("switches first");
    let switches = count.parse().expect("a number of switches");
    let samples: Vec<f64> = lines
        .map(|line| UNIT * line.parse::<f64>().expect("a sample"))
        .collect();
    assert_eq!(samples.len(), SAMPLES);
    (samples, switches)
}
