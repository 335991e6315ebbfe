//! The modes of one combination of engaged pairs.
//!
//! For an eigenpair (λ, x) of the pencil the *unconjugated* norm
//! ν = xᵀ(B + 2λJ)x makes the complex amplitude of the mode a row vector
//! times the state,
//!
//! a = 2·xᵀ(B q + J q̇ + λJ q)/ν,  q = Σ Re(a x),  q̇ = Σ Re(a λ x)
//!
//! (upper half-plane only, the 2 is the conjugate; a real λ counts once), and
//! ȧ = λa + (2/ν)·xᵀf under a force f. No inverse of a mode matrix is needed
//! and arbitrary link damping costs no more than proportional damping.
//!
//! A part of the tree that floats has the rigid motion of double root 0; its
//! centre moves as η̈ = xᵀf/xᵀJx and is kept in closed form apart from the lanes.

mod part;
mod response;

use super::lanes::{SIN_COS_LIMIT, V, WIDTH};
use super::pencil::C;

use super::problem::{PairState, TreeProblem};
use super::resonance::Resonance;
use crate::math::order::Total;
use part::cut_at_open_pairs;
use response::{law_force, response};

const ZERO: C = C::new(0.0, 0.0);

/// Most masses of a tree whose modes are separated: the work grows with the third
/// power of their number, that of a step of a method for stiff systems with the first.
const MOST_MASSES: usize = 200;

/// A lane is followed over steps of up to this many radians of it.
const FOLLOW: f64 = 3.2;

/// Kind of a lane: what it stands for in the propagation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum LaneKind {
    /// A mode of the tree.
    Mode,
    /// The response to harmonic j of the law.
    Harmonic(usize),
}

/// Lane: an exponential e^{λs} with its shape over the masses and its row vectors.
#[derive(Clone, Debug)]
pub(crate) struct Lane {
    pub(crate) kind: LaneKind,
    pub(crate) lambda: C,
    /// Motion of each mass for amplitude 1; for a harmonic: per unit of the law.
    pub(crate) shape: Vec<C>,
    /// a = row_q·q + row_v·q̇.
    pub(crate) row_q: Vec<C>,
    pub(crate) row_v: Vec<C>,
    /// ȧ = λa + row_f·f.
    pub(crate) row_f: Vec<C>,
}

/// Rigid motion of a floating part.
#[derive(Clone, Debug)]
pub(crate) struct Rigid {
    /// x: motion of each mass for a unit of the root's.
    pub(crate) shape: Vec<f64>,
    /// η = row·q, η̇ = row·q̇.
    pub(crate) row: Vec<f64>,
    /// η̈ = row_f·f.
    pub(crate) row_f: Vec<f64>,
    /// η̈ per unit of each harmonic of the law.
    pub(crate) push: Vec<C>,
}

/// The modes of one combination of engaged pairs, and the lanes that carry them.
#[derive(Clone, Debug)]
pub(crate) struct Basis {
    /// Number of masses.
    pub(crate) masses: usize,
    /// Ascending in |λ|.
    pub(crate) lanes: Vec<Lane>,
    /// Vectors that hold the lanes.
    pub(crate) blocks: usize,
    /// Re λ, Im λ.
    pub(crate) re: Vec<V>,
    pub(crate) im: Vec<V>,
    pub(crate) modulus: Vec<f64>,
    /// Moduli of the lanes side by side.
    pub(crate) moduli: Vec<V>,
    /// Length over which the lane can be followed, and every one before it (s).
    pub(crate) follow: Vec<f64>,
    /// The same for the flights of floating parts (s).
    pub(crate) follow_flights: f64,
    /// |λ|⁴, |λ|⁵.
    pub(crate) fourth: Vec<V>,
    pub(crate) fifth: Vec<V>,
    /// 1 where a vector holds a lane, 0 beyond the last.
    pub(crate) present: Vec<V>,
    /// Square of the lane's greatest motion of any mass for amplitude 1.
    pub(crate) extent: Vec<V>,
    /// Longest phase (s) for which sine and cosine are accurate.
    pub(crate) longest: f64,
    /// Longest phase (s) over which what drifts against dampers is a power series.
    pub(crate) drift: f64,
    /// Vectors that never fade: at least one, and all with a harmonic.
    pub(crate) kept: usize,
    /// Lane of each harmonic.
    pub(crate) harmonic: Vec<usize>,
    /// Its vector, and 1 where it stands in it.
    pub(crate) unit: Vec<(usize, V)>,
    /// Shapes by mass: re, im, then λ·shape re, im; index mass·blocks + block.
    pub(crate) shape: Vec<[V; 4]>,
    /// Rows by mass: row_q re, im, row_v re, im; index mass·blocks + block.
    pub(crate) row: Vec<[V; 4]>,
    /// Floating parts.
    pub(crate) rigid: Vec<Rigid>,
    /// Constant force of the flanks in contact (springs relaxed at the flank).
    pub(crate) flank_force: Vec<f64>,
    /// Masses that a rigid pair holds, each with its q.
    pub(crate) held: Vec<(usize, f64)>,
    /// The harmonics whose lanes stay empty, for they are at a mode's own frequency.
    pub(crate) resonance: Option<Box<Resonance>>,
}

/// Why a basis could not be made.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct NoBasis(pub(crate) String);

impl Basis {
    /// The modes of `problem` with its pairs in `states` (one per mass; ignored
    /// where the link is bilateral).
    pub(crate) fn new(problem: &TreeProblem, states: &[PairState]) -> Result<Self, NoBasis> {
        let n = problem.masses.len();
        if n > MOST_MASSES {
            return Err(NoBasis(format!(
                "the modes of its {n} masses are more than are separated, {MOST_MASSES} masses at most"
            )));
        }
        let mut lanes = Vec::new();
        let mut rigid: Vec<Rigid> = Vec::new();
        let mut resonant = Vec::new();
        for part in cut_at_open_pairs(problem, states) {
            part.modes(n, &mut lanes)?;
            rigid.extend(part.rigid(n));
        }
        for (j, omega) in problem.law.frequencies().enumerate() {
            for part in &mut rigid {
                let drive = C::new(0.0, omega);
                let push = (0..n)
                    .map(|i| law_force(problem, i, drive) * part.row_f[i])
                    .sum();
                part.push.push(push);
            }
            let shape = response(problem, &lanes, &rigid, omega).unwrap_or_else(|| {
                resonant.push((j, omega));
                vec![ZERO; n]
            });
            lanes.push(Lane {
                kind: LaneKind::Harmonic(j),
                lambda: C::new(0.0, omega),
                shape,
                row_q: vec![ZERO; n],
                row_v: vec![ZERO; n],
                row_f: vec![ZERO; n],
            });
        }
        lanes.sort_by_cached_key(|lane| Total(lane.lambda.norm()));
        let finite = |c: &C| c.re.is_finite() && c.im.is_finite();
        let sound = lanes.iter().all(|lane| {
            let all = [&lane.shape, &lane.row_q, &lane.row_v, &lane.row_f];
            finite(&lane.lambda) && all.iter().all(|v| v.iter().all(finite))
        });
        if !sound {
            return Err(NoBasis("a mode is not finite".into()));
        }
        let mut basis = Self::packed(n, lanes, rigid, flank_force(problem, states));
        basis.held = held_masses(problem, states);
        basis.resonance = Resonance::new(resonant).map(Box::new);
        Ok(basis)
    }

    fn packed(n: usize, lanes: Vec<Lane>, rigid: Vec<Rigid>, flank_force: Vec<f64>) -> Self {
        let blocks = lanes.len().div_ceil(WIDTH).max(1);
        let pack = |f: &dyn Fn(&Lane) -> f64| -> Vec<V> {
            let mut out = vec![V::ZERO; blocks];
            for (k, lane) in lanes.iter().enumerate() {
                out[k / WIDTH].0[k % WIDTH] = f(lane);
            }
            out
        };
        let re = pack(&|l| l.lambda.re);
        let im = pack(&|l| l.lambda.im);
        let (mut shape, mut row) = (
            vec![[V::ZERO; 4]; n * blocks],
            vec![[V::ZERO; 4]; n * blocks],
        );
        for (k, lane) in lanes.iter().enumerate() {
            for i in 0..n {
                let at = i * blocks + k / WIDTH;
                let (place, speed) = (lane.shape[i], lane.shape[i] * lane.lambda);
                let (q, v) = (lane.row_q[i], lane.row_v[i]);
                let both = [
                    [place.re, place.im, speed.re, speed.im],
                    [q.re, q.im, v.re, v.im],
                ];
                for part in 0..4 {
                    shape[at][part].0[k % WIDTH] = both[0][part];
                    row[at][part].0[k % WIDTH] = both[1][part];
                }
            }
        }
        let modulus: Vec<f64> = lanes.iter().map(|l| l.lambda.norm()).collect();
        let moduli = pack(&|l| l.lambda.norm());
        let follow = modulus.iter().map(|m| FOLLOW / m).collect();
        let harmonics = lanes.iter().filter(|l| l.kind != LaneKind::Mode);
        let swing = harmonics.fold(0.0f64, |m, l| m.max(l.lambda.im));
        let follow_flights = if rigid.is_empty() {
            f64::INFINITY
        } else {
            FOLLOW / swing
        };
        let fourth = pack(&|l| l.lambda.norm().powi(4));
        let fifth = pack(&|l| l.lambda.norm().powi(5));
        let present = pack(&|_| 1.0);
        let extent = pack(&|l| l.shape.iter().fold(0.0, |m, x| x.norm_sqr().max(m)));
        let fastest = lanes.iter().fold(0.0f64, |m, l| m.max(l.lambda.im.abs()));
        let longest = 0.5 * SIN_COS_LIMIT / fastest;
        let drift = time_of_slow_modes(&lanes);
        let mut harmonic = Vec::new();
        for (k, lane) in lanes.iter().enumerate() {
            if let LaneKind::Harmonic(j) = lane.kind {
                if harmonic.len() <= j {
                    harmonic.resize(j + 1, 0);
                }
                harmonic[j] = k;
            }
        }
        let unit = |k: usize| {
            let mut one = V::ZERO;
            one.0[k % WIDTH] = 1.0;
            (k / WIDTH, one)
        };
        let unit = harmonic.iter().map(|&k| unit(k)).collect();
        let kept = harmonic.iter().fold(1, |m, k| m.max(k / WIDTH + 1));
        Self {
            masses: n,
            blocks,
            drift,
            kept,
            re,
            im,
            modulus,
            moduli,
            follow,
            follow_flights,
            fourth,
            fifth,
            present,
            extent,
            longest,
            harmonic,
            unit,
            shape,
            row,
            rigid,
            lanes,
            flank_force,
            held: Vec::new(),
            resonance: None,
        }
    }
}

/// A part that only dampers hold has a mode 0 and one that decays slowly, whose
/// answers to a force, finite polynomials of 1/λ², would cancel; as power series,
/// which hold for a while, they hardly do.
fn time_of_slow_modes(lanes: &[Lane]) -> f64 {
    if lanes.iter().all(|lane| lane.lambda != ZERO) {
        return f64::INFINITY;
    }
    let modes = lanes.iter().filter(|lane| lane.kind == LaneKind::Mode);
    let sizes = modes.map(|lane| lane.lambda.norm());
    let slowest = sizes
        .filter(|size| *size > 0.0)
        .fold(f64::INFINITY, f64::min);
    0.99 * SLOW / slowest
}

/// The masses that a rigid pair holds on a flank, and where.
fn held_masses(problem: &TreeProblem, states: &[PairState]) -> Vec<(usize, f64)> {
    let mut held = Vec::new();
    for (i, mass) in problem.masses.iter().enumerate() {
        if let (Some(_), PairState::Engaged(f)) = (mass.restitution, states[i]) {
            let flank = mass.pair.flanks().0[usize::from(f)];
            held.push((i, -flank.sign * flank.offset));
        }
    }
    held
}

/// Engaged on a flank at x = ∓η/2 the link is relaxed there, not at 0.
fn flank_force(problem: &TreeProblem, states: &[PairState]) -> Vec<f64> {
    let mut force = vec![0.0; problem.masses.len()];
    for (i, mass) in problem.masses.iter().enumerate() {
        let (flanks, count) = mass.pair.flanks();
        if let (PairState::Engaged(f), true) = (states[i], count > 0) {
            let flank = flanks[usize::from(f)];
            let pull = mass.stiffness * flank.sign * flank.offset;
            force[i] -= pull;
            if let Some(p) = mass.parent {
                force[p] += mass.lever * pull;
            }
        }
    }
    force
}

/// A mode with |λ|·(length of the span) below this gets its response to a
/// polynomial as a Taylor series, the others as a finite polynomial.
pub(super) const SLOW: f64 = 3.0;
