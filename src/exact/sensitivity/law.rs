//! A motion law that no formula states, as numbers: its pieces, each in polynomials.
//!
//! Between two breaks a law is smooth in time and in the numbers that make it. Each such piece is
//! cut into equal parts; in a part L̈ is a polynomial of the share σ of the part, and L and L̇ are
//! given at its start. These numbers, and the instants of the breaks, are what a parameter changes:
//! at a fixed share of a part they are smooth in it, wherever the breaks move.

use crate::exact::LAW_DEGREE;
use crate::exact::from_model::{PrescribedMotion, formulas_end};
use crate::math::chebyshev::{Nodes, in_powers};
use crate::math::number::Number;
use std::sync::LazyLock;

/// Places at which L̈ of a part is looked at.
const POINTS: usize = LAW_DEGREE + 4;

/// How far breaks are looked for, in lengths of the run: those that pass its end with a parameter
/// are among them.
const AHEAD: f64 = 1.25;

/// Most pieces.
const MOST: usize = 20_000;

/// Most parts of a piece.
const MOST_PARTS: usize = 512;

/// Coefficients beyond those kept, in units of the rounding of the parts of L̈.
const TAIL: f64 = 32.0 * f64::EPSILON;

/// A law in pieces.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct LawTable {
    /// The parts of all pieces.
    pub(crate) parts: Vec<LawPart>,
    /// Number of parts of every piece.
    counts: Vec<usize>,
    /// Time up to which breaks are looked for (s).
    horizon: f64,
}

/// A part of a law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LawPart {
    /// Start (s).
    pub(crate) start: f64,
    /// Length (s).
    pub(crate) length: f64,
    /// L at the start.
    pub(crate) value: f64,
    /// L̇ at the start.
    pub(crate) speed: f64,
    /// L̈ in Chebyshev's polynomials of 2σ − 1. (In powers of σ their rounding would be great.)
    pub(crate) acceleration: [f64; LAW_DEGREE + 1],
    /// Size of the numbers whose rounding is in L̈.
    pub(crate) size: f64,
}

struct Tables {
    nodes: Nodes<POINTS>,
    powers: [[f64; POINTS]; POINTS],
}

static TABLES: LazyLock<Tables> = LazyLock::new(|| Tables {
    nodes: Nodes::new(),
    powers: in_powers([-1.0, 2.0]),
});

impl LawTable {
    /// The law of a motion up to a time, cut as another one is, if that is given.
    ///
    /// # Errors
    /// It cannot be stated so, or not as the other one.
    pub(crate) fn of(
        motion: &PrescribedMotion,
        end: f64,
        like: Option<&Self>,
    ) -> Result<Self, String> {
        let (mut parts, mut counts) = (Vec::new(), Vec::new());
        let horizon = like.map_or(AHEAD * end, |like| like.horizon);
        let mut start = 0.0;
        let goes_on = |start: f64, count: usize| match like {
            // (A break at the very end begins no piece.)
            None => start < end * (1.0 - 1e-12),
            Some(like) => count < like.counts.len(),
        };
        while goes_on(start, counts.len()) {
            let formulas = motion.formulas(start);
            let until = formulas_end(motion, &formulas, start, horizon);
            let length = until - start;
            if length <= 0.0 || counts.len() >= MOST {
                return Err("its motion law changes its formula too often".to_owned());
            }
            let depth = motion.stages.len();
            let at = |time: f64| {
                let now = motion.at(&formulas, depth, time.min(formulas.until));
                [now.value, now.speed, now.acceleration, now.size]
            };
            let count = match like {
                None => parts_needed(&at, start, length)
                    .ok_or("its motion law is not smooth between its breaks")?,
                Some(like) => like.counts[counts.len()],
            };
            let share = length / count as f64;
            for index in 0..count {
                parts.push(part(&at, start + index as f64 * share, share).0);
            }
            counts.push(count);
            start = until;
        }
        Ok(Self {
            parts,
            counts,
            horizon,
        })
    }
}

/// The powers of σ of a sum of Chebyshev's polynomials of 2σ − 1.
pub(super) fn powers_of_share<N: Number>(series: [N; LAW_DEGREE + 1]) -> [N; LAW_DEGREE + 1] {
    let mut powers = [N::from(0.0); LAW_DEGREE + 1];
    for (c, row) in series.iter().zip(&TABLES.powers) {
        for (power, factor) in powers.iter_mut().zip(row) {
            *power += c.scale(*factor);
        }
    }
    powers
}

/// The number of equal parts in which a piece is a polynomial each, to rounding.
fn parts_needed(at: &dyn Fn(f64) -> [f64; 4], start: f64, length: f64) -> Option<usize> {
    let mut count = 1;
    while count <= MOST_PARTS {
        let share = length / count as f64;
        let all = (0..count).map(|index| part(at, start + index as f64 * share, share));
        let (mut rest, mut size) = (0.0f64, 0.0f64);
        for (own, own_rest) in all {
            (rest, size) = (rest.max(own_rest), size.max(own.size));
        }
        if rest <= TAIL * size {
            return Some(count);
        }
        count *= 2;
    }
    None
}

/// A part of a law, and what is left out of L̈. `at`: L, L̇, L̈ and the size by which that is
/// rounded.
fn part(at: &dyn Fn(f64) -> [f64; 4], start: f64, length: f64) -> (LawPart, f64) {
    let places = TABLES.nodes.places;
    let seen = places.map(|place| at(start + 0.5 * (1.0 + place) * length));
    let size = seen.iter().fold(0.0, |most: f64, now| most.max(now[3]));
    let series = TABLES.nodes.polynomial_through(&seen.map(|now| now[2]));
    let rest = series[LAW_DEGREE + 1..].iter();
    let rest = rest.fold(0.0, |most: f64, c| most.max(c.abs()));
    let [value, speed, ..] = at(start);
    let part = LawPart {
        start,
        length,
        value,
        speed,
        acceleration: std::array::from_fn(|k| series[k]),
        size,
    };
    (part, rest)
}
