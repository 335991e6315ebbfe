//! An independent propagation of a `TreeProblem`: Taylor series of the motion
//! from J q̈ + B q̇ + K q = f and the rules of the pairs, in short fixed steps,
//! switches by bisection of the series. It shares nothing with `dam::exact`
//! but the statement of the problem: no modes, no bounds, no closed forms.

use dam::exact::{Law, PairState, Sine, TimeLoad, TreeObject, TreePair, TreeProblem};

/// Order of the series; steps are so short that the next term is far below rounding.
const ORDER: usize = 26;

/// A sine as the law.
pub(crate) fn sine(amplitude: f64, frequency: f64, phase: f64) -> Sine {
    Sine {
        amplitude,
        frequency,
        phase,
    }
}

/// A problem of `masses` behind sines, at rest on the law.
pub(crate) fn problem(masses: Vec<dam::exact::TreeMass>, sines: Vec<Sine>) -> TreeProblem {
    let n = masses.len();
    TreeProblem {
        masses,
        law: Law::Harmonic {
            mean: 0.0,
            slope: 0.0,
            sines,
        },
        displacement: vec![0.0; n],
        speed: vec![0.0; n],
        objects: vec![TreeObject {
            first: 0,
            output: vec![(n - 1, 1.0)],
            driver: None,
        }],
    }
}

/// A switch met: when, which mass, and the state after it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Met {
    pub(crate) time: f64,
    pub(crate) mass: usize,
    pub(crate) after: PairState,
}

/// The propagation by Taylor series.
pub(crate) struct Series<'a> {
    pub(crate) problem: &'a TreeProblem,
    pub(crate) states: Vec<PairState>,
    pub(crate) time: f64,
    pub(crate) q: Vec<f64>,
    pub(crate) v: Vec<f64>,
    pub(crate) met: Vec<Met>,
    /// Greatest step (s).
    pub(crate) step: f64,
}

impl<'a> Series<'a> {
    /// Starts in the given states.
    pub(crate) fn new(problem: &'a TreeProblem, states: Vec<PairState>, step: f64) -> Self {
        Self {
            problem,
            states,
            time: 0.0,
            q: problem.displacement.clone(),
            v: problem.speed.clone(),
            met: Vec::new(),
            step,
        }
    }

    /// Taylor coefficients of the force on mass `i` at the present time.
    fn force(&self, i: usize) -> Vec<f64> {
        let mass = &self.problem.masses[i];
        let law = self.law();
        let mut f = vec![0.0; ORDER];
        for (k, f) in f.iter_mut().enumerate() {
            let (one, two) = ((k + 1) as f64, ((k + 1) * (k + 2)) as f64);
            *f -= mass.ratio
                * (mass.inertia * two * law[k + 2]
                    + mass.ground_damping * one * law[k + 1]
                    + mass.ground_stiffness * law[k]);
        }
        f[0] -= mass.ground_stiffness * mass.offset;
        for load in &mass.loads {
            match load {
                TimeLoad::Constant(w) => f[0] += w,
                TimeLoad::Table(points) => {
                    let (w, slope) = table(points, self.time);
                    f[0] += w;
                    f[1] += slope;
                }
                TimeLoad::Pieces(_) => panic!("not in these tests"),
            }
        }
        f
    }

    /// Taylor coefficients of the law at the present time.
    fn law(&self) -> Vec<f64> {
        let mut out = vec![0.0; ORDER + 2];
        match &self.problem.law {
            Law::Harmonic { mean, slope, sines } => {
                out[0] = mean + slope * self.time;
                out[1] = *slope;
                for s in sines {
                    let theta = s.frequency * self.time + s.phase;
                    let mut scale = s.amplitude;
                    for (k, out) in out.iter_mut().enumerate() {
                        let quarter = [theta.sin(), theta.cos(), -theta.sin(), -theta.cos()];
                        *out += scale * quarter[k % 4];
                        scale *= s.frequency / (k + 1) as f64;
                    }
                }
            }
            Law::Spans(source) => {
                let span = source.span(self.time);
                let mut own = vec![0.0; ORDER + 2];
                own[0] = span.value;
                own[1] = span.speed;
                for (k, a) in span.acceleration.iter().enumerate() {
                    own[k + 2] = a / ((k + 1) * (k + 2)) as f64;
                }
                let tau = self.time - span.start;
                for (k, out) in out.iter_mut().enumerate() {
                    // Σ_j own_j·(j over k)·τ^{j−k}.
                    let mut binomial = 1.0;
                    for (j, own) in own.iter().enumerate().skip(k) {
                        *out += own * binomial * tau.powi((j - k) as i32);
                        binomial *= (j + 1) as f64 / (j + 1 - k) as f64;
                    }
                }
            }
        }
        out
    }

    /// The next instant at which the forcing changes its form.
    fn joint(&self) -> f64 {
        let mut next = f64::INFINITY;
        for mass in &self.problem.masses {
            for load in &mass.loads {
                if let TimeLoad::Table(points) = load {
                    for point in points.iter().filter(|p| p.0 > self.time) {
                        next = next.min(point.0);
                    }
                }
            }
        }
        if let Law::Spans(source) = &self.problem.law {
            next = next.min(source.span(self.time).end);
        }
        next
    }

    /// Taylor coefficients of every mass's q.
    fn series(&self) -> Vec<Vec<f64>> {
        let masses = &self.problem.masses;
        let n = masses.len();
        let force: Vec<Vec<f64>> = (0..n).map(|i| self.force(i)).collect();
        let mut c = vec![vec![0.0; ORDER + 2]; n];
        for i in 0..n {
            c[i][0] = self.q[i];
            c[i][1] = self.v[i];
        }
        for k in 0..ORDER {
            let mut f: Vec<f64> = (0..n)
                .map(|i| {
                    force[i][k]
                        - masses[i].ground_stiffness * c[i][k]
                        - masses[i].ground_damping * (k + 1) as f64 * c[i][k + 1]
                })
                .collect();
            for (i, mass) in masses.iter().enumerate() {
                let relaxed = match (mass.pair, self.states[i]) {
                    (TreePair::Bilateral, _) => 0.0,
                    (pair, PairState::Engaged(f)) => {
                        let flank = pair.flanks().0[usize::from(f)];
                        flank.sign * flank.offset
                    }
                    _ => continue,
                };
                let x = |order: usize| {
                    c[i][order] - mass.parent.map_or(0.0, |p| mass.lever * c[p][order])
                };
                let rest = if k == 0 { relaxed } else { 0.0 };
                let pull =
                    mass.stiffness * (x(k) + rest) + mass.damping * (k + 1) as f64 * x(k + 1);
                f[i] -= pull;
                if let Some(p) = mass.parent {
                    f[p] += mass.lever * pull;
                }
            }
            for i in 0..n {
                c[i][k + 2] = f[i] / masses[i].inertia / ((k + 1) * (k + 2)) as f64;
            }
        }
        c
    }

    /// Clearance X of flank `f` of mass `i` and its rate.
    pub(crate) fn clearance(&self, i: usize, f: usize) -> (f64, f64) {
        let mass = &self.problem.masses[i];
        let flank = mass.pair.flanks().0[f];
        let base = |x: &[f64]| x[i] - mass.parent.map_or(0.0, |p| mass.lever * x[p]);
        (
            flank.sign * base(&self.q) + flank.offset,
            flank.sign * base(&self.v),
        )
    }

    /// What each pair would do at the present state: the first mass whose
    /// state does not fit, with the state it should have.
    fn misfit(&self, fresh: &[(usize, PairState)]) -> Option<(usize, PairState)> {
        for (i, mass) in self.problem.masses.iter().enumerate() {
            for f in 0..mass.pair.flanks().1 {
                let (x, rate) = self.clearance(i, f);
                let pull = mass.stiffness * x + mass.damping * rate;
                let flank = f as u8;
                let next = match self.states[i] {
                    PairState::Engaged(own) if own == flank => {
                        let open = if mass.damping == 0.0 {
                            PairState::Free
                        } else {
                            PairState::Pressed(flank)
                        };
                        (pull > 0.0).then_some(open)
                    }
                    PairState::Pressed(own) if own == flank => {
                        if x > 0.0 {
                            Some(PairState::Free)
                        } else {
                            (pull < 0.0).then_some(PairState::Engaged(flank))
                        }
                    }
                    PairState::Engaged(_) => None,
                    _ => (x < 0.0).then_some(PairState::Engaged(flank)),
                };
                if let Some(next) = next
                    && !fresh.contains(&(i, next))
                {
                    return Some((i, next));
                }
            }
        }
        None
    }

    fn put(&mut self, c: &[Vec<f64>], s: f64) {
        for (i, c) in c.iter().enumerate() {
            let (mut q, mut v) = (0.0, 0.0);
            for &c in c.iter().rev() {
                v = v * s + q;
                q = q * s + c;
            }
            (self.q[i], self.v[i]) = (q, v);
        }
    }

    /// Goes to `end`, switching on the way.
    pub(crate) fn run(&mut self, end: f64) {
        // What has just been left may not come back within rounding.
        let mut left: Vec<(usize, PairState)> = Vec::new();
        while self.time < end {
            let c = self.series();
            let h = self.step.min(end - self.time).min(self.joint() - self.time);
            let start = self.time;
            self.put(&c, h);
            let Some(_) = self.misfit(&[]) else {
                self.time = if h == end - start { end } else { start + h };
                left.clear();
                continue;
            };
            // What does not fit just after the start either is rounding there.
            self.put(&c, h * 1e-7);
            let early = self.misfit(&[]);
            let excused: Vec<(usize, PairState)> =
                early.into_iter().filter(|e| left.contains(e)).collect();
            self.put(&c, h);
            if self.misfit(&excused).is_none() {
                self.time = start + h;
                left.clear();
                continue;
            }
            let (mut low, mut high) = (0.0, h);
            while high - low > 1e-17 + 2e-16 * high {
                let middle = 0.5 * (low + high);
                if middle == low || middle == high {
                    break;
                }
                self.put(&c, middle);
                if self.misfit(&excused).is_some() {
                    high = middle
                } else {
                    low = middle
                }
            }
            self.put(&c, high);
            let (mass, after) = self.misfit(&excused).expect("a misfit at the upper end");
            self.time = start + high;
            // A pressed pair that comes clear goes on unchanged: no switch.
            if after != PairState::Free || self.problem.masses[mass].damping == 0.0 {
                self.met.push(Met {
                    time: self.time,
                    mass,
                    after,
                });
            }
            left.push((mass, self.states[mass]));
            self.states[mass] = after;
        }
    }
}

fn table(points: &[(f64, f64)], time: f64) -> (f64, f64) {
    match points.iter().position(|p| p.0 > time) {
        Some(0) => (points[0].1, 0.0),
        Some(k) => {
            let (a, b) = (points[k - 1], points[k]);
            let slope = (b.1 - a.1) / (b.0 - a.0);
            (a.1 + slope * (time - a.0), slope)
        }
        None => (points.last().map_or(0.0, |p| p.1), 0.0),
    }
}

/// Greatest difference of q over the samples, relative to the greatest |q|.
pub(crate) fn motion_error(run: &dam::exact::ExactRun, rows: &[Vec<f64>]) -> f64 {
    let n = rows[0].len();
    let (mut worst, mut scale) = (0.0f64, 0.0f64);
    for (row, mine) in rows.iter().zip(run.samples.chunks(run.columns)) {
        for i in 0..n {
            worst = worst.max((row[i] - mine[i]).abs());
            scale = scale.max(row[i].abs());
        }
    }
    worst / scale
}

/// Rows of q at `count` equal intervals to `end`, switching on the way.
pub(crate) fn rows(series: &mut Series, end: f64, count: usize) -> Vec<Vec<f64>> {
    (1..=count)
        .map(|k| {
            series.run(end * (k as f64 / count as f64));
            series.q.clone()
        })
        .collect()
}
