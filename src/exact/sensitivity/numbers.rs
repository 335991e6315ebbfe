//! The numbers of a tree as variables: any kind of number in place of those of a problem.

use super::law::{LawPart, LawTable, powers_of_share};
use crate::exact::{LAW_DEGREE, Law, Refusal, TimeLoad, TreeMass, TreeProblem};
use crate::math::number::Number;

/// How much more than other numbers those of a law in pieces are rounded.
const LAW_ROUNDING: f64 = 64.0;

/// The numbers of a problem.
#[derive(Clone, Debug)]
pub(super) struct TreeNumbers<N> {
    pub(super) masses: Vec<MassNumbers<N>>,
    pub(super) law: LawNumbers<N>,
    /// Deviations q at t = 0.
    pub(super) displacement: Vec<N>,
    /// q̇ at t = 0.
    pub(super) speed: Vec<N>,
    pub(super) objects: Vec<ObjectNumbers<N>>,
}

/// The law.
#[derive(Clone, Debug)]
pub(super) enum LawNumbers<N> {
    /// L = mean + slope·t + Σ amplitude·sin(frequency·t + phase).
    Harmonic {
        mean: N,
        slope: N,
        /// Amplitude, frequency, phase.
        sines: Vec<[N; 3]>,
    },
    /// Parts, one after the other.
    Parts(Vec<PartNumbers<N>>),
}

/// See [`super::law::LawPart`].
#[derive(Clone, Debug)]
pub(super) struct PartNumbers<N> {
    pub(super) start: N,
    pub(super) length: N,
    pub(super) value: N,
    pub(super) speed: N,
    /// L̈ in powers of the share of the part.
    pub(super) acceleration: [N; LAW_DEGREE + 1],
}

impl<N: Number> LawNumbers<N> {
    fn read(
        law: &Law,
        table: Option<&LawTable>,
        make: &mut dyn FnMut(f64, f64) -> N,
    ) -> Result<Self, Refusal> {
        match (law, table) {
            (Law::Harmonic { mean, slope, sines }, _) => Ok(Self::Harmonic {
                mean: make(*mean, mean.abs()),
                slope: make(*slope, slope.abs()),
                sines: (sines.iter())
                    .map(|sine| {
                        [sine.amplitude, sine.frequency, sine.phase].map(|own| make(own, own.abs()))
                    })
                    .collect(),
            }),
            (Law::Spans(_), Some(table)) => {
                let greatest = |of: &dyn Fn(&LawPart) -> f64| {
                    let sizes = table.parts.iter().map(|part| of(part).abs());
                    LAW_ROUNDING * sizes.fold(0.0, f64::max)
                };
                // (At the starts of its parts a cam with dwells may stand still everywhere.)
                let speed = |part: &LawPart| part.speed.abs() + part.size * part.length;
                let value = greatest(&|part| part.value.abs() + speed(part) * part.length);
                let speed = greatest(&speed);
                let bend = greatest(&|part| part.size);
                let parts = table.parts.iter().map(|part| PartNumbers {
                    start: make(part.start, part.start),
                    length: make(part.length, part.start + part.length),
                    value: make(part.value, value),
                    speed: make(part.speed, speed),
                    acceleration: powers_of_share(part.acceleration.map(|own| make(own, bend))),
                });
                Ok(Self::Parts(parts.collect()))
            }
            (Law::Spans(_), None) => Err(Refusal::new("", "its motion law is not known")),
        }
    }
}

/// See [`TreeMass`].
#[derive(Clone, Debug)]
pub(super) struct MassNumbers<N> {
    pub(super) parent: Option<usize>,
    pub(super) inertia: N,
    pub(super) ratio: N,
    pub(super) offset: N,
    pub(super) lever: N,
    pub(super) stiffness: N,
    pub(super) damping: N,
    pub(super) ground_stiffness: N,
    pub(super) ground_damping: N,
    pub(super) restitution: Option<N>,
    /// Sign and offset of the flanks; none of a bilateral link.
    pub(super) flanks: Vec<(f64, N)>,
    /// Sum of the constant loads.
    pub(super) load: N,
    /// Loads over time, as points (t, W).
    pub(super) tables: Vec<Vec<[N; 2]>>,
}

/// See [`crate::exact::TreeObject`].
#[derive(Clone, Debug)]
pub(super) struct ObjectNumbers<N> {
    pub(super) first: usize,
    pub(super) output: Vec<(usize, N)>,
    pub(super) driver: Option<(usize, N)>,
}

impl<N: Number> TreeNumbers<N> {
    /// Reads a problem; `make` is given its numbers, always in the same order.
    ///
    /// # Errors
    /// The law is known in fitted pieces alone, and no table of it is given; a load is.
    pub(super) fn read(
        (problem, table): (&TreeProblem, Option<&LawTable>),
        make: &mut dyn FnMut(f64, f64) -> N,
    ) -> Result<Self, Refusal> {
        let law = LawNumbers::read(&problem.law, table, make)?;
        let masses = problem
            .masses
            .iter()
            .map(|mass| MassNumbers::read(mass, make));
        let masses = masses.collect::<Result<_, _>>()?;
        // (The state at the start follows from balances, in which all its numbers are rounded.)
        let size = |all: &[f64]| all.iter().fold(0.0, |most: f64, one| most.max(one.abs()));
        let (place, rate) = (size(&problem.displacement), size(&problem.speed));
        let displacement = problem.displacement.iter().map(|&q| make(q, place));
        let displacement = displacement.collect();
        let speed = problem.speed.iter().map(|&v| make(v, rate)).collect();
        let objects = problem.objects.iter().map(|object| ObjectNumbers {
            first: object.first,
            output: (object.output.iter())
                .map(|&(mass, share)| (mass, make(share, 1.0)))
                .collect(),
            driver: object
                .driver
                .map(|(mass, ratio)| (mass, make(ratio, ratio.abs()))),
        });
        Ok(Self {
            objects: objects.collect(),
            masses,
            law,
            displacement,
            speed,
        })
    }
}

impl<N: Number> MassNumbers<N> {
    fn read(mass: &TreeMass, make: &mut dyn FnMut(f64, f64) -> N) -> Result<Self, Refusal> {
        let (flanks, count) = mass.pair.flanks();
        let (mut load, mut tables) = (0.0, Vec::new());
        for own in &mass.loads {
            match own {
                TimeLoad::Constant(value) => load += value,
                TimeLoad::Table(points) => tables.push(points),
                TimeLoad::Pieces(_) => {
                    return Err(Refusal::new(
                        "",
                        "a load on it is neither constant nor a table over time",
                    ));
                }
            }
        }
        let mut own = |value: f64| make(value, value.abs());
        Ok(Self {
            parent: mass.parent,
            inertia: own(mass.inertia),
            ratio: own(mass.ratio),
            offset: own(mass.offset),
            lever: own(mass.lever),
            stiffness: own(mass.stiffness),
            damping: own(mass.damping),
            ground_stiffness: own(mass.ground_stiffness),
            ground_damping: own(mass.ground_damping),
            restitution: mass.restitution.map(&mut own),
            flanks: (flanks[..count].iter())
                .map(|flank| (flank.sign, own(flank.offset)))
                .collect(),
            load: own(load),
            tables: (tables.into_iter())
                .map(|points| points.iter().map(|&(t, w)| [own(t), own(w)]).collect())
                .collect(),
        })
    }
}

/// The numbers of a problem, one after the other, each with the size by which it is rounded.
///
/// # Errors
/// As of [`TreeNumbers::read`].
pub(crate) fn flat_numbers(
    problem: &TreeProblem,
    table: Option<&LawTable>,
) -> Result<Vec<[f64; 2]>, Refusal> {
    let mut all = Vec::new();
    TreeNumbers::<f64>::read((problem, table), &mut |value, size| {
        all.push([value, size]);
        value
    })?;
    Ok(all)
}

/// True when two problems differ in numbers alone: as many masses, joined alike, with the same
/// kinds of pairs, laws and loads.
pub(crate) fn have_one_form(a: &TreeProblem, b: &TreeProblem) -> bool {
    let lists = |problem: &TreeProblem| {
        let masses = problem.masses.iter().map(|mass| {
            let (flanks, count) = mass.pair.flanks();
            let signs: Vec<f64> = flanks[..count].iter().map(|flank| flank.sign).collect();
            let points = mass.loads.iter().map(|load| match load {
                TimeLoad::Constant(_) | TimeLoad::Pieces(_) => 0,
                TimeLoad::Table(points) => points.len(),
            });
            let points: Vec<usize> = points.filter(|count| *count > 0).collect();
            (mass.parent, signs, points, mass.restitution.is_some())
        });
        let objects = problem.objects.iter().map(|object| {
            let output: Vec<usize> = object.output.iter().map(|one| one.0).collect();
            (object.first, output, object.driver.map(|one| one.0))
        });
        let sines = match &problem.law {
            Law::Harmonic { sines, .. } => Some(sines.len()),
            Law::Spans(_) => None,
        };
        (
            masses.collect::<Vec<_>>(),
            objects.collect::<Vec<_>>(),
            sines,
        )
    };
    lists(a) == lists(b)
}
