//! Eigenvalues that coincide or nearly do: critical and nearly critical
//! damping, equal branches, and eigenvectors that elimination cannot give.
//!
//! Apart from each other such modes have amplitudes that grow like
//! 1/|λ₁ − λ₂| and cancel. Together they are harmless: with X, W the right and
//! left bases of the cluster's invariant subspace (WᵀX = 1) the state moves in
//! it as X e^{Ts} Wᵀy, T = WᵀAX, smooth through coincidence. Three forms of
//! e^{Ts}, all of them sums of exponentials, so that nothing else has to know:
//!
//! - no damping: the pencil is symmetric and has orthogonal eigenvectors;
//! - T a multiple of 1, or with independent eigenvectors: plain modes;
//! - otherwise interpolation of e^{zs} in N nodes on a circle about the mean c,
//!   z_k = c + d_k, d_k = r·e^{iθ_k}, d_k^N = −r^N:
//!
//!   e^{Ts} ≈ Σ_k e^{z_k s}·ℓ_k,  ℓ_k = (1/N) Σ_{p<N} (E/d_k)^p,  E = T − c,
//!
//!   in error by at most about s^N·e^{Re c·s}·(r^N + |λ − c|^N)/N!, which for
//!   decaying modes has the maximum (r/|Re c|)^N/√(2πN): 2·10⁻¹⁷ for N = 8 and
//!   r = |Re c|/100. Rounding is magnified by |Re c|/r = 100.
//!
//! Sources: N. J. Higham, Functions of Matrices, SIAM 2008, sections 1.2
//! (definition by interpolation) and 9.3 (blocks of close eigenvalues).

use super::basis::{Lane, LaneKind};
use super::dense::{self, Split, Subspace};
use super::pencil::{C, Pencil};
use crate::units::shown;
use nalgebra::DMatrix;

/// Modes nearer to each other than this share of |λ| are taken together.
const CLOSE: f64 = 1e-5;

/// So are modes whose unconjugated norm is lost to this share of its terms:
/// amplitudes would be in error by the square of its inverse.
const LOST: f64 = 0.02;

/// The next eigenvalue is farther away than the cluster is wide, by this factor.
const APART: f64 = 10.0;

/// Most modes that are taken together: equal branches and critical pairs are few.
/// Where more run into each other (long chains of overdamped links, whose rates
/// gather at stiffness over damping) nothing tells them apart, and trying takes
/// time that grows with the fourth power of their number.
const MOST_MEMBERS: usize = 64;

/// Nodes of the interpolation.
const NODES: usize = 8;

/// Radius of the circle as a share of |Re c|, and the most that members may
/// stray from c.
const RADIUS: f64 = 0.01;
const STRAY: f64 = 0.025;

/// Lanes that a problem of `masses` can need: an eigenvalue in the upper
/// half-plane takes up to [`NODES`], a real one half as many.
pub(crate) fn most_lanes(masses: usize) -> usize {
    masses * NODES
}

/// Eigenvalues that are taken together.
#[derive(Clone, Debug)]
struct Cluster {
    /// All of them; a real cluster holds its conjugates too.
    members: Vec<C>,
    /// True when it is its own conjugate.
    real: bool,
    mean: C,
    /// Distance from the mean to the next eigenvalue.
    gap: f64,
}

/// Mode: its eigenvalue (upper half-plane or real), eigenvector and norm.
#[derive(Clone, Debug)]
pub(crate) struct Mode {
    pub(crate) lambda: C,
    pub(crate) shape: Vec<C>,
    /// xᵀB.
    pub(crate) damping: Vec<C>,
    /// ν = xᵀ(B + 2λJ)x.
    pub(crate) norm: C,
    /// |ν| over the sum of its terms' sizes; 0 when not finite.
    pub(crate) kept: f64,
}

impl Mode {
    pub(crate) fn new(pencil: &Pencil, lambda: C) -> Self {
        let shape: Vec<C> = if lambda == C::default() {
            pencil.rigid_shape().into_iter().map(C::from).collect()
        } else {
            pencil.eigenvector(lambda)
        };
        let damping = pencil.apply_deformation_operator(
            &shape,
            |node| node.damping,
            |node| node.ground_damping,
        );
        let (mut norm, mut size) = (C::default(), 0.0);
        for (k, node) in pencil.nodes.iter().enumerate() {
            let term = shape[k] * shape[k] * (lambda * (2.0 * node.inertia));
            norm += shape[k] * damping[k] + term;
            size += term.norm() + (shape[k] * damping[k]).norm();
        }
        let kept = norm.norm() / size;
        Self {
            lambda,
            shape,
            damping,
            norm,
            kept: if kept.is_finite() { kept } else { 0.0 },
        }
    }

    /// The mode as a lane over the pencil's own masses.
    fn mode_as_lane(&self, pencil: &Pencil) -> Lane {
        let factor = self.norm.inv() * if self.lambda.im == 0.0 { 1.0 } else { 2.0 };
        let inertia = |k: usize| self.shape[k] * (factor * pencil.nodes[k].inertia);
        let all = 0..pencil.nodes.len();
        Lane {
            kind: LaneKind::Mode,
            lambda: self.lambda,
            row_q: all
                .clone()
                .map(|k| self.damping[k] * factor + inertia(k) * self.lambda)
                .collect(),
            row_v: all.clone().map(inertia).collect(),
            row_f: all.map(|k| self.shape[k] * factor).collect(),
            shape: self.shape.clone(),
        }
    }
}

/// The lanes of a part with the eigenvalues `values` (its zeros excepted, but
/// for the one of a floating part that is dragged).
///
/// # Errors
/// Modes coincide, are hardly damped, and have no independent eigenvectors.
pub(crate) fn lanes(pencil: &Pencil, values: &[C]) -> Result<Vec<Lane>, String> {
    let modes: Vec<Mode> = values.iter().map(|l| Mode::new(pencil, *l)).collect();
    let clusters = find(&modes, pencil.floats());
    let mut out: Vec<Lane> = modes
        .iter()
        .filter(|mode| !clusters.iter().any(|c| c.members.contains(&mode.lambda)))
        .map(|mode| mode.mode_as_lane(pencil))
        .collect();
    for cluster in &clusters {
        out.extend(cluster.lanes(pencil)?);
    }
    Ok(out)
}

/// The clusters among the modes.
fn find(modes: &[Mode], floats: bool) -> Vec<Cluster> {
    let mut all: Vec<C> = modes.iter().map(|m| m.lambda).collect();
    all.extend(
        modes
            .iter()
            .filter(|m| m.lambda.im > 0.0)
            .map(|m| m.lambda.conj()),
    );
    let mut out: Vec<Cluster> = Vec::new();
    for mode in modes {
        if mode.lambda == C::default() || out.iter().any(|c| c.members.contains(&mode.lambda)) {
            continue;
        }
        let near = nearest_eigenvalue(&all, &[mode.lambda]).map_or(f64::INFINITY, |(_, d)| d);
        if mode.kept >= LOST && near > CLOSE * mode.lambda.norm() {
            continue;
        }
        let cluster = gather(&all, mode.lambda, mode.kept < LOST, floats);
        // A cluster that grew into an earlier one takes it over.
        out.retain(|c| !c.members.iter().any(|m| cluster.members.contains(m)));
        out.push(cluster);
    }
    out
}

/// The eigenvalue outside `members` that is nearest to one of them.
fn nearest_eigenvalue(all: &[C], members: &[C]) -> Option<(usize, f64)> {
    // Members are told from equal values by their number.
    let inside = |value: &C| members.iter().filter(|m| *m == value).count();
    let mut seen: Vec<(C, usize)> = Vec::new();
    let mut best: Option<(usize, f64)> = None;
    for (index, value) in all.iter().enumerate() {
        let count = match seen.iter_mut().find(|(v, _)| v == value) {
            Some((_, count)) => {
                *count += 1;
                *count
            }
            None => {
                seen.push((*value, 1));
                1
            }
        };
        if count <= inside(value) {
            continue;
        }
        let distance = members
            .iter()
            .fold(f64::INFINITY, |d, m| d.min((m - value).norm()));
        if best.is_none_or(|(_, d)| distance < d) {
            best = Some((index, distance));
        }
    }
    best
}

/// Takes neighbours in until the next one is well apart.
fn gather(all: &[C], seed: C, lossy: bool, floats: bool) -> Cluster {
    let mut members = vec![seed];
    loop {
        let mean = members.iter().sum::<C>() / members.len() as f64;
        let width = members
            .iter()
            .fold(CLOSE * mean.norm(), |w, m| w.max((m - mean).norm()));
        let real = members
            .iter()
            .any(|m| m.im == 0.0 || members.contains(&m.conj()));
        let missing = members
            .iter()
            .find(|m| real && m.im != 0.0 && !members.contains(&m.conj()));
        if let Some(conjugate) = missing.map(|m| m.conj()) {
            members.push(conjugate);
            continue;
        }
        let next = nearest_eigenvalue(all, &members);
        let gap = next.map_or(f64::INFINITY, |(_, d)| d);
        // A lost norm names a mate that is close, if not that close, and not
        // merely the same mode of an equal branch.
        let alone = width <= CLOSE * mean.norm();
        let mate = lossy && alone && gap < 0.1 * mean.norm();
        match next {
            Some((index, _)) if (gap < APART * width || mate) && members.len() <= MOST_MEMBERS => {
                members.push(all[index]);
            }
            _ => {
                let mean = if real { C::new(mean.re, 0.0) } else { mean };
                let origin = if floats { mean.norm() } else { f64::INFINITY };
                return Cluster {
                    gap: gap.min(origin).min(mean.norm()),
                    members,
                    real,
                    mean,
                };
            }
        }
    }
}

impl Cluster {
    fn lanes(&self, pencil: &Pencil) -> Result<Vec<Lane>, String> {
        if self.members.len() > MOST_MEMBERS {
            return Err(format!(
                "more than {MOST_MEMBERS} of its modes run into each other about |λ| = {} rad/s",
                shown(self.mean.norm(), 7)
            ));
        }
        if !pencil.damped() {
            return dense::undamped_modes(pencil, self.mean.im, self.members.len())
                .ok_or_else(|| self.refusal());
        }
        let space = Subspace::new(pencil, self.mean, self.gap, self.members.len(), self.real)
            .ok_or_else(|| self.refusal())?;
        let m = self.members.len();
        let off = &space.t - DMatrix::from_diagonal_element(m, m, space.mean());
        let size = off.iter().fold(0.0f64, |s, e| s.max(e.norm()));
        // Equal to rounding: any basis is one of eigenvectors.
        if size <= 1e-13 * self.mean.norm() {
            return Ok(space.plain_modes(&Split::scalar(space.mean(), m)));
        }
        let split = Split::of(&space.t, self.real);
        let usable = |limit: f64| {
            split.as_ref().filter(|s| {
                s.condition < limit && (!self.real || s.values.iter().all(|l| l.im == 0.0))
            })
        };
        if let Some(split) = usable(1.0 / LOST) {
            return Ok(space.plain_modes(split));
        }
        let stray = self
            .members
            .iter()
            .fold(0.0f64, |w, l| w.max((l - self.mean).norm()));
        if stray <= STRAY * -self.mean.re {
            return Ok(self.interpolated(&space, &off));
        }
        usable(1e7)
            .map(|split| space.plain_modes(split))
            .ok_or_else(|| self.refusal())
    }

    fn interpolated(&self, space: &Subspace, off: &DMatrix<C>) -> Vec<Lane> {
        let m = self.members.len();
        let centre = space.mean();
        let radius = RADIUS * -centre.re;
        let mut powers = vec![DMatrix::<C>::identity(m, m)];
        for p in 1..NODES {
            powers.push(&powers[p - 1] * off);
        }
        // The conjugate nodes of a real cluster are the lanes' own conjugates.
        let nodes = if self.real { NODES / 2 } else { NODES };
        let mut out = Vec::with_capacity(nodes * m);
        for k in 0..nodes {
            let angle = std::f64::consts::TAU * (k as f64 + 0.5) / NODES as f64;
            let d = C::from_polar(radius, angle);
            let mut weight = DMatrix::<C>::zeros(m, m);
            let mut scale = C::new(1.0 / NODES as f64, 0.0);
            for power in &powers {
                weight += power * scale;
                scale /= d;
            }
            out.extend(space.lanes(&vec![centre + d; m], &weight, &DMatrix::identity(m, m), 2.0));
        }
        out
    }

    fn refusal(&self) -> String {
        if !self.mean.norm().is_finite() {
            return "a mode of it is faster than double precision can resolve".to_owned();
        }
        format!(
            "{} of its modes coincide at |λ| = {} rad/s and cannot be distinguished",
            self.members.len(),
            shown(self.mean.norm(), 7)
        )
    }
}
