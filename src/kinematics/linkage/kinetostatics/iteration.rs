//! Friction that belongs to the reactions it causes: τ = f(F₀ − K·τ).
//!
//! The plain iteration from τ = 0 comes first; it defines which solution is
//! returned where several exist. Where it cycles or runs away, it is damped,
//! then Newton's method is tried with the present signs.

use super::workspace::ForceWorkspace;

/// Method by which the friction was found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Method {
    /// There is no friction.
    None,
    /// Plain iteration from no friction.
    Plain,
    /// Damped iteration from no friction.
    Damped,
    /// Newton's method with the present signs.
    Newton,
    /// The search for all solutions.
    Search,
}

/// Course of the iteration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Convergence {
    /// Method that led to the result.
    pub method: Method,
    /// Iterations of all methods tried.
    pub iterations: usize,
    /// Greatest change of an unknown in the last of them, relative to the
    /// greatest unknown (moments over the length scale).
    pub change: f64,
}

/// Parts of the step that damped iterations take.
const DAMPINGS: [f64; 3] = [0.5, 0.2, 0.05];
/// Iterations of Newton's method at most.
const NEWTON: usize = 25;
/// At a standstill, Newton's method may move by this part of the scale.
const AT_STANDSTILL: f64 = 1e-6;
/// What is to come of an iteration when its number is up, in parts of the
/// scale, that still counts as nearly converged.
const NEARLY: f64 = 1e-2;
/// A residual is that of a solution below this part of the scale.
const RESIDUAL: f64 = 1e-11;
/// Rounding of F = F₀ − K·τ in parts of F₀: next to a singular position the difference is
/// much smaller than its terms, and no iteration comes below their rounding.
const FORCE_ROUNDING: f64 = 8.0 * f64::EPSILON;

impl ForceWorkspace {
    /// Sets the friction to zero and F to F₀.
    pub(super) fn without_friction(&mut self) {
        self.friction.clear();
        self.friction.resize(self.columns, 0.0);
        self.next.clear();
        self.next.resize(self.columns, 0.0);
        self.react();
        self.bare = self.greatest_magnitude();
    }

    /// Rounding error of F.
    fn rounding(&self) -> f64 {
        FORCE_ROUNDING * self.bare
    }

    /// Finds τ and F; `None` in `Ok` if no method converged.
    pub(super) fn solve_friction(&mut self, tolerance: f64, cap: usize) -> (Convergence, bool) {
        self.without_friction();
        let mut course = Convergence {
            method: Method::None,
            iterations: 0,
            change: 0.0,
        };
        if self.columns == 0 {
            return (course, true);
        }
        course.method = Method::Plain;
        if self.iterate_forces(1.0, tolerance, cap, &mut course) {
            return (course, true);
        }
        for damping in DAMPINGS {
            self.without_friction();
            course.method = Method::Damped;
            let cap = (cap as f64 / damping) as usize;
            if self.iterate_forces(damping, tolerance, cap, &mut course) {
                return (course, true);
            }
        }
        self.without_friction();
        course.method = Method::Newton;
        let found = self.newton(&mut course);
        (course, found)
    }

    /// τ ← τ + part·(f(F) − τ) until F stands still; false if it does not. An
    /// iteration that converges slowly is taken to its end by Newton's method.
    fn iterate_forces(
        &mut self,
        part: f64,
        tolerance: f64,
        cap: usize,
        course: &mut Convergence,
    ) -> bool {
        let mut before = [f64::INFINITY; 2];
        let mut rest = f64::INFINITY;
        for _ in 0..cap {
            self.update_friction();
            for (tau, next) in self.friction.iter_mut().zip(&self.next) {
                *tau += part * (next - *tau);
            }
            let change = self.react();
            let scale = self.greatest_magnitude();
            course.iterations += 1;
            course.change = if scale > 0.0 { change / scale } else { 0.0 };
            if !(change.is_finite() && scale < TOO_GREAT) {
                return false;
            }
            // What is still to come, if every change is `ratio` times the last;
            // over two steps, since forces and their friction may take turns.
            let ratio = (change / before[1]).sqrt();
            rest = if ratio < 1.0 {
                change / (1.0 - ratio)
            } else {
                f64::INFINITY
            };
            if change <= tolerance * scale + self.rounding() {
                return ratio < 0.5 || self.refine_by_newton(AT_STANDSTILL * scale, course);
            }
            before = [change, before[0]];
        }
        let scale = self.greatest_magnitude();
        rest <= NEARLY * scale && self.refine_by_newton(3.0 * rest + AT_STANDSTILL * scale, course)
    }

    /// A few steps of Newton's method; false if they lead farther than `near`.
    fn refine_by_newton(&mut self, near: f64, course: &mut Convergence) -> bool {
        let [kept, _] = &mut self.scratch;
        kept.clear();
        kept.extend_from_slice(&self.friction);
        if !self.newton(course) {
            return false;
        }
        let mut pairs = self.friction.iter().zip(&self.scratch[0]);
        pairs.all(|(now, before)| (now - before).abs() <= near)
    }

    /// Newton's method on τ − f(F₀ − K·τ) from the present τ, with the signs
    /// that F has in each step.
    pub(super) fn newton(&mut self, course: &mut Convergence) -> bool {
        self.react();
        for _ in 0..NEWTON {
            self.update_friction();
            let scale = self.greatest_magnitude();
            let mut residual = 0.0f64;
            for a in 0..self.columns {
                self.next[a] -= self.friction[a];
                if !(self.next[a].abs() <= residual) {
                    residual = self.next[a].abs();
                }
            }
            if !(residual.is_finite() && scale < TOO_GREAT) {
                return false;
            }
            course.change = if scale > 0.0 { residual / scale } else { 0.0 };
            self.write_slopes();
            let enough = RESIDUAL * scale + self.rounding();
            if !self.small.factorise() {
                return residual <= enough;
            }
            self.small.solve(&mut self.next, 1);
            for (tau, step) in self.friction.iter_mut().zip(&self.next) {
                *tau += step;
            }
            course.iterations += 1;
            let change = self.react();
            if residual <= enough && change <= enough {
                return true;
            }
        }
        false
    }

    /// Matrix 1 + f′·K of the linearised friction at the present reactions.
    pub(super) fn write_slopes(&mut self) {
        self.small.clear(self.columns);
        for a in 0..self.columns {
            self.small.add(a, a, 1.0);
        }
        for index in 0..self.terms.len() {
            let term = self.terms[index];
            let slope = term.slope(&self.unknowns);
            for which in 0..term.width() {
                for column in 0..self.columns {
                    let [first, second] = [0, 1].map(|k| self.k(term.unknown + k, column));
                    let mut value = slope[which][0] * first + slope[which][1] * second;
                    if let Some((row, slope)) = term.by_holding(&self.unknowns) {
                        value += slope * self.k(row, column);
                    }
                    self.small.add(term.column + which, column, value);
                }
            }
        }
    }

    /// What friction changes by, into `next`, where the unknowns would change by `change` if it
    /// stayed as it is; the matrix of [`Self::write_slopes`] is factorised.
    pub(super) fn change_of_friction(&mut self, change: impl Fn(usize) -> f64) {
        self.next.clear();
        self.next.resize(self.columns, 0.0);
        for term in &self.terms {
            let slope = term.slope(&self.unknowns);
            let [a, b] = [0, 1].map(|k| change(term.unknown + k));
            for which in 0..term.width() {
                self.next[term.column + which] = slope[which][0] * a + slope[which][1] * b;
            }
            if let Some((row, slope)) = term.by_holding(&self.unknowns) {
                self.next[term.column] += slope * change(row);
            }
        }
        self.small.solve(&mut self.next, 1);
    }
}

/// Forces from which on their squares would not be numbers (N): an iteration that
/// grows that far has no end.
pub(super) const TOO_GREAT: f64 = 1e150;
