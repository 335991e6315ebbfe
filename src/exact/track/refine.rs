//! Climbing to what may pass the greatest value so far, and to the changes of
//! sign of δ, within a step.

use super::lanes_ahead::LanesAhead;
use super::{CUTS, Scene, Track, piece};
use crate::exact::bound::root_correction;
use crate::exact::hermite::{End, Piece, Point};
use crate::exact::lanes::{Arith, Task};
use crate::math::order::by_first;

/// A summit is looked for first where the last one was, if that is so near to
/// where it is expected, in lengths of the piece.
const NEAR_EXPECTED: f64 = 0.02;

/// [`Track::refine_extremum`], out of line.
pub(super) struct Climb<'a> {
    pub(super) track: &'a mut Track,
    pub(super) scene: Scene<'a>,
    pub(super) ahead: LanesAhead<'a>,
    pub(super) ends: (&'a Point, &'a Point),
    pub(super) figure: (usize, f64),
    pub(super) margin: f64,
}

impl Task for Climb<'_> {
    type Output = ();

    #[inline(always)]
    fn run<A: Arith>(self) {
        let Self {
            track,
            scene,
            ahead,
            ends,
            figure,
            margin,
        } = self;
        track.refine_extremum::<A>(scene, ahead, ends, figure, margin);
    }
}

/// [`Track::add_sign_changes`], out of line.
pub(super) struct Turns<'a> {
    pub(super) track: &'a mut Track,
    pub(super) scene: Scene<'a>,
    pub(super) ahead: LanesAhead<'a>,
    pub(super) ends: (&'a Point, &'a Point),
}

impl Task for Turns<'_> {
    type Output = ();

    #[inline(always)]
    fn run<A: Arith>(self) {
        self.track
            .add_sign_changes::<A>(self.scene, self.ahead, self.ends);
    }
}

impl Track {
    /// Finds the greatest value of sign·(functional k) in the step, where it
    /// passes the greatest so far by more than `margin`.
    #[inline(always)]
    pub(super) fn refine_extremum<A: Arith>(
        &mut self,
        scene: Scene,
        ahead: LanesAhead,
        (a, b): (&Point, &Point),
        (k, sign): (usize, f64),
        margin: f64,
    ) {
        let mut best = if sign > 0.0 {
            self.high.0[k]
        } else {
            -self.low.0[k]
        };
        let whole = piece(a, b, k, sign);
        let was = best;
        let mut place = whole.a.s;
        for end in [whole.a, whole.b] {
            if end.f > best {
                (best, place) = (end.f, end.s);
            }
        }
        self.pieces.clear();
        self.pieces.push(whole);
        let mut cuts = 0;
        while let Some(piece) = self.pieces.pop() {
            let (middle, flat) = self.loss_of::<A>(scene, ahead, piece.length(), k);
            let top = piece.range(middle, flat).1;
            if top <= best + margin || cuts >= CUTS {
                continue;
            }
            cuts += 1;
            let guess = piece.a.s + piece.extremum_place() * piece.length();
            let figure = (k, sign, best);
            let cut = self.refined_end::<A>(scene, figure, &piece, guess, margin);
            if cut.f > best {
                (best, place) = (cut.f, cut.s);
            }
            self.pieces.push(Piece { a: cut, b: piece.b });
            self.pieces.push(Piece { a: piece.a, b: cut });
        }
        if best > was {
            self.note_greatest((k, sign), best, place);
        }
    }

    /// The summit near `guess`, with slope exactly zero; where there is none
    /// within the piece, or none higher than `best`, a point near `guess`.
    #[inline(always)]
    fn refined_end<A: Arith>(
        &mut self,
        scene: Scene,
        (k, sign, best): (usize, f64, f64),
        piece: &Piece,
        guess: f64,
        margin: f64,
    ) -> End {
        // Several functionals often have their summits at one instant.
        let near = (guess - self.look.s).abs() < NEAR_EXPECTED * piece.length()
            && self.look.s > piece.a.s
            && self.look.s < piece.b.s;
        let mut s = if near { self.look.s } else { guess };
        let mut first = None;
        for _ in 0..8 {
            let (jet, rest) = self.jet::<A>(scene, k, s);
            let f = jet.map(|x| x * sign);
            let plain = *first.get_or_insert(End {
                s,
                f: f[0],
                g: f[1],
            });
            let (x, _) = root_correction::<A>([f[1], f[2], f[3], 0.0, 0.0], 0.0);
            let target = s + x;
            if !(f[2] < 0.0 && target > piece.a.s && target < piece.b.s) {
                return plain;
            }
            let cube = rest * (x * x * x).abs();
            let value = f[0] + x * (f[1] + x * (f[2] * 0.5 + x * (f[3] * (1.0 / 6.0))));
            // What stays so far below that the bounds on either side tell it need
            // not be found to rounding.
            let slack = 0.25 * (f[1] * piece.length()).abs() + cube * x.abs() * (1.0 / 24.0);
            if value.max(f[0]) + slack <= best {
                return plain;
            }
            if cube * piece.length() <= 24.0 * margin || x.abs() <= 1e-15 * target {
                return End {
                    s: target,
                    f: value,
                    g: 0.0,
                };
            }
            s = target;
        }
        first.unwrap_or_default()
    }

    #[inline(always)]
    fn jet<A: Arith>(&mut self, scene: Scene, k: usize, s: f64) -> ([f64; 4], f64) {
        let phase = scene.phase;
        if s != self.look.s || s != self.e.s {
            phase.exponentials::<A>(scene.basis, s, &mut self.e);
            self.state.amplitudes::<A>(phase, &self.e, &mut self.look);
        }
        let lanes = (&self.look, phase.active);
        self.state.jet::<A>(scene.panel, lanes, &self.e, k)
    }

    /// Adds ∫|δ| up to every change of sign of δ in the step.
    ///
    /// An error d in the instant of a root costs only δ̇d² in the integral.
    #[inline(always)]
    pub(super) fn add_sign_changes<A: Arith>(
        &mut self,
        scene: Scene,
        ahead: LanesAhead,
        (a, b): (&Point, &Point),
    ) {
        let noise = self.state.noise(b.s, self.whole).0[0];
        self.roots.clear();
        self.pieces.clear();
        self.pieces.push(piece(a, b, 0, 1.0));
        let mut cuts = 0;
        while let Some(piece) = self.pieces.pop() {
            let (middle, flat) = self.loss_of::<A>(scene, ahead, piece.length(), 0);
            let (low, high) = piece.range(middle, flat);
            if low >= -noise || high <= noise || cuts >= CUTS {
                continue;
            }
            cuts += 1;
            let cut = self.root::<A>(scene, &piece, noise);
            self.pieces.push(Piece { a: cut, b: piece.b });
            self.pieces.push(Piece { a: piece.a, b: cut });
        }
        if self.roots.len() > 1 {
            by_first(&mut self.roots);
        }
        for &(_, primitive) in &self.roots {
            self.area += (primitive - self.turned).abs();
            self.turned = primitive;
        }
    }

    /// The root of δ about `near` behind the start of the phase (up to `most`),
    /// where Taylor's polynomial there is good enough for it: the integral of
    /// |δ| may be off by `allowed`. Nothing has to be evaluated for it.
    #[inline(always)]
    fn root_from<A: Arith>(
        &mut self,
        scene: Scene,
        (near, most): (f64, f64),
        allowed: f64,
    ) -> Option<End> {
        let Scene { panel, phase, .. } = scene;
        self.e.start(phase.active);
        self.state.write_start_of_phase(phase, &mut self.look);
        let lanes = (&self.look, phase.active);
        let (f, rest) = self.state.jet::<A>(panel, lanes, &self.e, 0);
        let off = |x: f64| rest * (x * x) * (x * x) * (1.0 / 24.0);
        if !error_is_negligible((near, off(near)), f[1] + near * f[2], allowed) {
            return None;
        }
        let value = |x: f64| f[0] + x * (f[1] + x * (f[2] * 0.5 + x * f[3] * (1.0 / 6.0)));
        let slope = |x: f64| f[1] + x * (f[2] + x * f[3] * 0.5);
        let mut x = near;
        for _ in 0..3 {
            x -= value(x) / slope(x);
        }
        let settled = value(x).abs() <= off(x).max(f64::EPSILON * f[0].abs());
        if !(x > 0.0 && x < most && settled && error_is_negligible((x, off(x)), slope(x), allowed))
        {
            return None;
        }
        let start = self
            .state
            .first_primitive::<A>(panel, phase.active, &self.look);
        let more = x * (f[0] + x * (f[1] * 0.5 + x * (f[2] / 6.0 + x * (f[3] / 24.0))));
        self.roots.push((x, start + more));
        Some(End {
            s: x,
            f: 0.0,
            g: slope(x),
        })
    }

    /// A root of δ in the piece (noted, value exactly zero), or a point to cut at.
    #[inline(always)]
    fn root<A: Arith>(&mut self, scene: Scene, piece: &Piece, noise: f64) -> End {
        let crosses = (piece.a.f > 0.0 && piece.b.f < 0.0) || (piece.a.f < 0.0 && piece.b.f > 0.0);
        let share = if crosses {
            piece.zero_crossing()
        } else {
            let turn = if piece.a.f + piece.b.f > 0.0 {
                -1.0
            } else {
                1.0
            };
            let end = |e: End| End {
                s: e.s,
                f: e.f * turn,
                g: e.g * turn,
            };
            Piece {
                a: end(piece.a),
                b: end(piece.b),
            }
            .extremum_place()
        };
        if crosses && piece.a.s == 0.0 {
            let allowed = noise * piece.length();
            let near = share * piece.length();
            if let Some(end) = self.root_from::<A>(scene, (near, piece.length()), allowed) {
                return end;
            }
        }
        let mut s = piece.a.s + share * piece.length();
        let mut first = None;
        for _ in 0..8 {
            let (f, rest) = self.jet::<A>(scene, 0, s);
            let plain = *first.get_or_insert(End {
                s,
                f: f[0],
                g: f[1],
            });
            let (x, _) = root_correction::<A>([f[0], f[1], f[2], f[3], 0.0], 0.0);
            let target = s + x;
            if !(crosses && target > piece.a.s && target < piece.b.s) {
                return plain;
            }
            // Of Taylor's polynomial, and of the reversed series.
            let bend = 0.5 * f[2] * x / f[1];
            let off = rest * (x * x) * (x * x) * (1.0 / 24.0)
                + 14.0 * (f[1] * x).abs() * (bend * bend) * (bend * bend);
            let allowed = noise * piece.length();
            if error_is_negligible((x, off), f[1], allowed) || x.abs() <= 1e-15 * target {
                let Scene { panel, phase, .. } = scene;
                let primitive = self.state.primitive::<A>(panel, phase, &self.look, &self.e);
                let more = x * (f[0] + x * (f[1] * 0.5 + x * (f[2] / 6.0 + x * (f[3] / 24.0))));
                self.roots.push((target, primitive + more));
                return End {
                    s: target,
                    f: 0.0,
                    g: f[1] + x * (f[2] + x * f[3] * 0.5),
                };
            }
            s = target;
        }
        first.unwrap_or_default()
    }
}

/// True when an error `off` of δ at a root a length x away moves ∫|δ| by less
/// than `allowed`: by half its square over the slope, and by what the integral
/// up to there is off.
#[inline(always)]
fn error_is_negligible((x, off): (f64, f64), slope: f64, allowed: f64) -> bool {
    off * off < allowed * slope.abs() && 0.2 * off * x.abs() < allowed
}
