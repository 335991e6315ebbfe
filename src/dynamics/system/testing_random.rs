//! Random models, states and modes for the tests of the system.

use super::System;
use super::testing::*;
use crate::dynamics::integrate::Modes;
use crate::dynamics::laws::LawInstance;
use crate::dynamics::model::*;
use crate::kinematics::breaks::Breaks;
use crate::kinematics::position::Position;
use std::sync::Arc;

/// Deterministic random numbers (SplitMix64).
pub(super) struct Random(pub(super) u64);

impl Random {
    /// The next number, uniform in [0, 1).
    pub(super) fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Uniform between two bounds.
    pub(super) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// One of 0 … count − 1.
    pub(super) fn below(&mut self, count: usize) -> usize {
        (self.unit() * count as f64) as usize
    }
}

/// A random mechanism of up to six bodies behind a drive or a motor, with all
/// kinds of pairs and loads; numbers of order one.
pub(super) fn random_model(random: &mut Random) -> Model {
    let mut model = Model::default();
    if random.below(2) == 0 {
        add_drive(
            &mut model,
            random.between(0.5, 2.0),
            random.between(-1.0, 1.0),
        );
    } else {
        let rotor = add_rotor(&mut model, random.between(0.5, 2.0), 0.3, 1.1);
        add_load(&mut model, rotor, 0, "torque", random_load(random));
    }
    for _ in 0..1 + random.below(5) {
        let driver = random.below(model.objects.len());
        let body = random_body(random);
        let object = add_body(&mut model, driver, &body);
        for _ in 0..random.below(3) {
            let mass = random.below(model.objects[object].nodes.len());
            let law = random_load(random);
            add_load(&mut model, object, mass, "some", law);
        }
    }
    add_tables(&mut model, random);
    model
}

fn random_body(random: &mut Random) -> Body {
    let masses = random.below(4);
    let list = |random: &mut Random, count: usize, low: f64, high: f64| -> Vec<f64> {
        (0..count).map(|_| random.between(low, high)).collect()
    };
    let closure = [Closure::Bilateral, Closure::Force, Closure::Form][random.below(3)];
    let kappa = random.between(0.0, 0.5);
    Body {
        position: random_position(random),
        inertias: list(random, masses.max(1), 0.2, 2.0),
        stiffnesses: list(random, masses, 5.0, 50.0),
        dampings: list(random, masses, 0.0, 1.0),
        pair: Pair {
            closure,
            gap: [0.0, 0.1][random.below(2)],
            opens: [1.0, -1.0][random.below(2)],
            form: [
                ContactForm::default(),
                ContactForm::Proportional(Loss::Factor(kappa)),
            ][random.below(2)],
        },
    }
}

fn random_position(random: &mut Random) -> Position {
    match random.below(4) {
        0 => Position::Ratio {
            ratio: random.between(-1.5, 1.5),
            offset: random.between(-0.5, 0.5),
        },
        1 => Position::Sine {
            amplitude: random.between(0.3, 1.0),
            harmonic: random.between(0.5, 2.0),
            phase: random.between(0.0, 6.0),
            offset: 0.1,
        },
        2 => Position::Custom(Arc::new(Exponential)),
        _ => Position::Custom(Arc::new(TwoPieces)),
    }
}

fn random_load(random: &mut Random) -> LoadLaw {
    match random.below(7) {
        0 => LoadLaw::constant(random.between(-3.0, 3.0)),
        1 => LoadLaw::spring(random.between(0.0, 4.0), random.between(-2.0, 2.0)),
        2 => LoadLaw::viscous(random.between(0.0, 1.0)),
        3 => LawInstance::friction(random.between(0.0, 2.0), 0.7).law(),
        4 => LawInstance::linear_motor(3.0, 2.0).law(),
        5 => LawInstance::kloss([3.0, 0.3, 2.0]).law(),
        _ => LoadLaw::speed_table(vec![(-1.0, 2.0), (0.5, 1.0), (2.0, -1.0)]),
    }
}

/// A table over time on the last node and one over the drive's displacement.
fn add_tables(model: &mut Model, random: &mut Random) {
    let pieces = |random: &mut Random| {
        (0..3)
            .map(|_| LinearPiece {
                start: random.between(-1.0, 1.0),
                value: random.between(-2.0, 2.0),
                slope: random.between(-1.0, 1.0),
            })
            .collect()
    };
    for source in [TrackSource::Time, TrackSource::Node(0)] {
        let object = model.objects.len() - 1;
        model.tracks.push(Track {
            source,
            breaks: Breaks {
                points: vec![-0.5, 0.4],
                period: None,
            },
            repeats: false,
            stops: false,
            object,
        });
        let law = LoadLaw::Pieces {
            track: model.tracks.len() - 1,
            pieces: pieces(random),
        };
        add_load(model, object, 0, "table", law);
    }
}

/// A random state of a system.
pub(super) fn random_state(system: &System, random: &mut Random) -> Vec<f64> {
    let count = 2 * crate::dynamics::integrate::Dynamics::coordinates(system);
    (0..count).map(|_| random.between(-0.5, 0.5)).collect()
}

/// Random modes: pairs open or on one of their flanks, tracks in some segment.
pub(super) fn random_modes(system: &System, random: &mut Random) -> Modes {
    let frozen = &system.frozen;
    let pairs = frozen.pairs.iter().map(|&chain| {
        let sides = frozen.chains[chain].contact.sides();
        match random.below(sides.len() + 1) {
            0 => 0,
            side => sides[side - 1],
        }
    });
    let mut modes: Vec<i64> = pairs.collect();
    modes.extend(frozen.tracks.iter().map(|_| random.below(2) as i64));
    Modes(modes)
}
