//! Four functionals at one instant of a phase: values, slopes, jets, and what a
//! cubic between two instants may miss.

use super::{Panel, PanelPhase};
use crate::exact::basis::Basis;
use crate::exact::hermite::{Loss, Point};
use crate::exact::lanes::{Arith, V, WIDTH};
use crate::exact::phase::{Exponentials, Phase};

/// All lanes at one instant.
#[derive(Clone, Debug, Default)]
pub(crate) struct Amplitudes {
    /// Local time; that of no instant while they are unknown.
    pub(crate) s: f64,
    /// Real and imaginary part, and size of every active lane.
    lanes: Vec<[V; 3]>,
}

impl Amplitudes {
    pub(crate) fn new(blocks: usize) -> Self {
        Self {
            s: f64::NEG_INFINITY,
            lanes: vec![[V::ZERO; 3]; blocks],
        }
    }

    /// Takes those of another instant.
    #[inline(always)]
    pub(crate) fn copy_from(&mut self, other: &Self) {
        self.s = other.s;
        self.lanes.copy_from_slice(&other.lanes);
    }

    #[inline(always)]
    pub(super) fn get(&self, b: usize) -> [V; 3] {
        self.lanes[b]
    }
}

impl PanelPhase {
    /// The active lanes at the instant of `e`.
    #[inline(always)]
    pub(crate) fn amplitudes<A: Arith>(
        &self,
        phase: &Phase,
        e: &Exponentials,
        out: &mut Amplitudes,
    ) {
        out.s = e.s;
        let active = phase.active;
        let (re, im) = (&phase.re[..active], &phase.im[..active]);
        let (er, ei) = (&e.re[..active], &e.im[..active]);
        let (size, es) = (&self.size[..active], &e.size[..active]);
        for (b, out) in out.lanes[..active].iter_mut().enumerate() {
            *out = [
                re[b].fma::<A>(er[b], -(im[b] * ei[b])),
                re[b].fma::<A>(ei[b], im[b] * er[b]),
                size[b] * es[b],
            ];
        }
    }

    /// The lanes at the start of the phase.
    #[inline(always)]
    pub(crate) fn write_start_of_phase(&self, phase: &Phase, out: &mut Amplitudes) {
        out.s = 0.0;
        let active = phase.active;
        let (re, im) = (&phase.re[..active], &phase.im[..active]);
        let size = &self.size[..active];
        for (b, out) in out.lanes[..active].iter_mut().enumerate() {
            *out = [re[b], im[b], size[b]];
        }
    }

    /// Bounds of all lanes together over the phase.
    #[inline(always)]
    pub(crate) fn bounds_of_all_lanes<A: Arith>(&self, panel: &Panel, phase: &Phase) -> V {
        let mut sum = V::ZERO;
        let seen = &panel.lanes[..phase.active];
        for (b, size) in self.size[..phase.active].iter().enumerate() {
            for i in 0..WIDTH {
                sum = seen[b][i].size.fma::<A>(V::splat(size.0[i]), sum);
            }
        }
        sum
    }

    /// Values and slopes at the instant of `e`, of which `lanes` are the
    /// amplitudes; bounds on what follows.
    #[inline(always)]
    pub(crate) fn point<A: Arith>(
        &self,
        panel: &Panel,
        active: usize,
        lanes: &Amplitudes,
        e: &Exponentials,
    ) -> Point {
        let [mut value, mut slope] = self.slow_two::<A>(e);
        let mut turned = [V::ZERO; 2];
        let (mut fourth, mut envelope) = (self.slow4, V::ZERO);
        let seen = &panel.lanes[..active];
        for (b, [re, im, size]) in lanes.lanes[..active].iter().enumerate() {
            for i in 0..WIDTH {
                let lane = &seen[b][i];
                let w = &lane.weight;
                let (re, im) = (V::splat(re.0[i]), V::splat(im.0[i]));
                value = w[0].fma::<A>(re, value);
                turned[0] = w[1].fma::<A>(im, turned[0]);
                slope = w[2].fma::<A>(re, slope);
                turned[1] = w[3].fma::<A>(im, turned[1]);
                let size = V::splat(size.0[i]);
                fourth = lane.fourth.fma::<A>(size, fourth);
                envelope = lane.size.fma::<A>(size, envelope);
            }
        }
        Point {
            s: e.s,
            value: value - turned[0],
            slope: slope - turned[1],
            fourth,
            envelope,
        }
    }

    /// Value and slope of lane k alone.
    #[inline(always)]
    pub(crate) fn value_and_slope_of_lane<A: Arith>(
        &self,
        panel: &Panel,
        lanes: &Amplitudes,
        k: usize,
    ) -> [V; 2] {
        let [re, im, _] = lanes.get(k / WIDTH);
        let (re, im) = (V::splat(re.0[k % WIDTH]), V::splat(-im.0[k % WIDTH]));
        let w = &panel.lane_functionals(k).weight;
        [w[0].fma::<A>(re, w[1] * im), w[2].fma::<A>(re, w[3] * im)]
    }

    /// Envelope of lane k from an instant on.
    #[inline(always)]
    pub(crate) fn lane_size(&self, panel: &Panel, lanes: &Amplitudes, k: usize) -> V {
        panel.lane_functionals(k).size * V::splat(lanes.get(k / WIDTH)[2].0[k % WIDTH])
    }

    /// What Hermite's cubic may miss over a length h from an instant (`None`:
    /// from the start of the phase on), of the first `follow` lanes.
    ///
    /// A lane of size z (decaying) misses at most z·(|λ|h)⁴/144 on the middle
    /// coefficient. Where it turns fast its own cubic is bounded instead: by
    /// its values, and |λ|h/4 for its slopes.
    #[inline(always)]
    pub(crate) fn interpolation_error<A: Arith>(
        &self,
        basis: &Basis,
        panel: &Panel,
        (lanes, follow): (Option<&Amplitudes>, usize),
        h: f64,
    ) -> Loss {
        let share = quartic(h);
        let mut middle = self.slow4 * V::splat(share);
        let mut flat = V::ZERO;
        for b in 0..follow.div_ceil(WIDTH) {
            let size = lanes.map_or(self.size[b], |lanes| lanes.get(b)[2]);
            let (bent, level) = lane_errors::<A>(basis, b, h, share);
            let (curved, leveled) = (size * bent, size * level);
            for i in 0..WIDTH.min(follow - b * WIDTH) {
                let own = panel.lanes[b][i].size;
                if bent.0[i] < level.0[i] {
                    middle = own.fma::<A>(V::splat(curved.0[i]), middle);
                } else {
                    flat = own.fma::<A>(V::splat(leveled.0[i]), flat);
                }
            }
        }
        Loss { middle, flat }
    }

    /// The same for functional f alone, of all lanes: what is missed on the
    /// middle coefficient and on every one.
    #[inline(always)]
    pub(crate) fn loss_of<A: Arith>(
        &self,
        basis: &Basis,
        panel: &Panel,
        (lanes, active): (&Amplitudes, usize),
        h: f64,
        f: usize,
    ) -> (f64, f64) {
        let share = quartic(h);
        let (mut middle, mut flat) = (V::ZERO, V::ZERO);
        let own = &panel.own[f * basis.blocks..][..active];
        for (b, own) in own.iter().enumerate() {
            let size = own.size * lanes.get(b)[2];
            let (bent, level) = lane_errors::<A>(basis, b, h, share);
            let curved = bent.zip(level, |bent, level| if bent < level { bent } else { 0.0 });
            let leveled = bent.zip(level, |bent, level| if bent < level { 0.0 } else { level });
            middle = size.fma::<A>(curved, middle);
            flat = size.fma::<A>(leveled, flat);
        }
        (A::fma(self.slow4.0[f], share, middle.sum()), flat.sum())
    }

    /// Functional f and three derivatives at the instant of `e`, of which `lanes`
    /// are the amplitudes, and a bound on its fourth from there on.
    #[inline(always)]
    pub(crate) fn jet<A: Arith>(
        &self,
        panel: &Panel,
        (lanes, active): (&Amplitudes, usize),
        e: &Exponentials,
        f: usize,
    ) -> ([f64; 4], f64) {
        let mut sums = [V::ZERO; 4];
        let mut rest = V::ZERO;
        let blocks = panel.primitive.len();
        let own = &panel.own[f * blocks..][..active];
        for (b, [re, im, size]) in lanes.lanes[..active].iter().enumerate() {
            for order in 0..4 {
                let w = &own[b].weight[order];
                sums[order] = w[0].fma::<A>(*re, sums[order]) - w[1] * *im;
            }
            rest = own[b].fourth.fma::<A>(*size, rest);
        }
        let mut jet = self.slow_one::<A>(e, f);
        for order in 0..4 {
            jet[order] += sums[order].sum();
        }
        (jet, self.slow4.0[f] + rest.sum())
    }

    /// Primitive of the first functional at the instant of `e`, of which `lanes`
    /// are the amplitudes.
    #[inline(always)]
    pub(crate) fn primitive<A: Arith>(
        &self,
        panel: &Panel,
        phase: &Phase,
        lanes: &Amplitudes,
        e: &Exponentials,
    ) -> f64 {
        let mut resting = 0.0;
        for &k in &panel.resting {
            let (b, i) = (k / WIDTH, k % WIDTH);
            let w = &panel.lane_functionals(k).weight;
            resting += w[0].0[0] * phase.re[b].0[i] - w[1].0[0] * phase.im[b].0[i];
        }
        let start = self.first_primitive::<A>(panel, phase.active, lanes);
        start + resting * e.s + self.slow_primitive::<A>(e)
    }

    /// The same at the start of the phase, where the lanes are all there is.
    #[inline(always)]
    pub(crate) fn first_primitive<A: Arith>(
        &self,
        panel: &Panel,
        active: usize,
        lanes: &Amplitudes,
    ) -> f64 {
        let mut sum = V::ZERO;
        let own = &panel.primitive[..active];
        for (b, [re, im, _]) in lanes.lanes[..active].iter().enumerate() {
            sum = own[b][0].fma::<A>(*re, sum) - own[b][1] * *im;
        }
        sum.sum()
    }
}

/// Share of a fourth derivative that a cubic misses on the middle coefficient.
#[inline(always)]
fn quartic(h: f64) -> f64 {
    let square = h * h;
    square * square * (1.0 / 144.0)
}

/// What lanes of size 1 miss over a length h: followed, and by their own bounds.
#[inline(always)]
fn lane_errors<A: Arith>(basis: &Basis, b: usize, h: f64, share: f64) -> (V, V) {
    let level = basis.moduli[b].fma::<A>(V::splat(0.25 * h), V::splat(2.0));
    (basis.fourth[b] * V::splat(share), level)
}
