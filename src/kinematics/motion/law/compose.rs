//! From the description of a law to its pieces.

use super::form::Form;
use super::names::LawName;
use super::polynomial::{EndPolynomial, PolynomialSpec};
use super::spec::{LawSpec, RunLawSpec, SectionsSpec, check_polynomial, check_table};
use super::trapezoid::{Trapezoid, TrapezoidPart};
use super::{Law, Piece};
use crate::fault::{Fault, Faults};
use crate::kinematics::motion::Spline;

/// Rounding allowed in speeds that must not fall or turn back.
const SLACK: f64 = 1e-9;

impl Law {
    /// The law of a full stroke, from rest to rest.
    ///
    /// # Errors
    /// Everything wrong with its numbers; paths relative to the law.
    pub fn of_stroke(spec: &LawSpec) -> Result<Self, Vec<Fault>> {
        match spec {
            LawSpec::Named(name) => match (name.sections(), name) {
                (Some(sections), _) => Self::of_sections(&sections),
                (None, LawName::Harmonic) => Ok(Self::single(Form::Harmonic)),
                (None, LawName::Cycloidal) => Ok(Self::single(Form::Cycloidal)),
                (None, LawName::Polynomial345) => Ok(Self::single(Form::Polynomial345)),
                (None, _) => Ok(Self::single(Form::Polynomial4567)),
            },
            LawSpec::Scca { b, d } => {
                trapezoid("scca", *b, *d)?;
                Self::of_sections(&SectionsSpec::scca(*b, *d))
            }
            LawSpec::Sections(sections) => Self::of_sections(sections),
            LawSpec::Polynomial(spec) => {
                let law = Self::of_polynomial(spec)?;
                must_have("polynomial.start", &spec.start, &[0.0, 0.0], "θ(0), θ′(0)")?;
                must_have("polynomial.end", &spec.end, &[1.0, 0.0], "θ(1), θ′(1)")?;
                Ok(law)
            }
            LawSpec::Table(points) => {
                check_table(points)?;
                Self::of_spline(points, &Spline::clamped(points, (0.0, 0.0)))
            }
        }
    }

    /// The law of a run-up, from rest to uniform motion.
    ///
    /// # Errors
    /// Everything wrong with its numbers; a speed that turns back or is not
    /// greatest at τ = 1; paths relative to the law.
    pub fn of_run_up(spec: &RunLawSpec) -> Result<Self, Vec<Fault>> {
        let mut law = match spec {
            RunLawSpec::Trapezoid { s1, s2 } => Self::of_trapezoid(&trapezoid("", *s1, *s2)?),
            RunLawSpec::Polynomial(spec) => {
                let law = Self::of_polynomial(spec)?;
                must_have("polynomial.start", &spec.start, &[0.0, 0.0], "θ(0), θ′(0)")?;
                must_have("polynomial.end", &spec.end, &[1.0], "θ(1)")?;
                law
            }
            RunLawSpec::Table(points) => {
                check_table(points)?;
                let end = Spline::through(points).jet(1.0).first;
                Self::of_spline(points, &Spline::clamped(points, (0.0, end)))?
            }
        };
        law.run_up = true;
        law.check_run_up()?;
        Ok(law)
    }

    fn single(form: Form) -> Self {
        Self {
            joints: Vec::new(),
            pieces: vec![Piece::of_form(form)],
            run_up: false,
        }
    }

    fn of_trapezoid(trapezoid: &Trapezoid) -> Self {
        let parts = trapezoid.parts();
        let piece = |&(part, _)| Piece::of_form(Form::Trapezoid(*trapezoid, part));
        Self {
            joints: parts.iter().skip(1).map(|part| part.1).collect(),
            pieces: parts.iter().map(piece).collect(),
            run_up: true,
        }
    }

    fn of_polynomial(spec: &PolynomialSpec) -> Result<Self, Vec<Fault>> {
        check_polynomial(spec)?;
        let polynomial = EndPolynomial::new(spec);
        if !polynomial.is_finite() {
            let message = "these conditions lead to numbers too great to compute with";
            return Err(vec![Fault::new("polynomial", message, "")]);
        }
        Ok(Self::single(Form::Polynomial(polynomial)))
    }

    fn of_spline(points: &[(f64, f64)], spline: &Spline) -> Result<Self, Vec<Fault>> {
        if !spline.is_finite() {
            let message = "the curve through these points has slopes too great for numbers";
            let hint = "space the points more regularly";
            return Err(vec![Fault::new("table", message, hint)]);
        }
        let cubics = spline.coefficients().iter().zip(points);
        let pieces = cubics.map(|(cubic, point)| Piece {
            origin: point.0,
            ..Piece::of_form(Form::Cubic(*cubic))
        });
        let inner = &points[1..points.len() - 1];
        Ok(Self {
            joints: inner.iter().map(|point| point.0).collect(),
            pieces: pieces.collect(),
            run_up: false,
        })
    }

    /// Run-up, uniform motion and run-out joined with one speed, (1.11).
    fn of_sections(spec: &SectionsSpec) -> Result<Self, Vec<Fault>> {
        let mut faults = Faults::default();
        faults.positive("sections.skewness", spec.skewness);
        if !(0.0..1.0).contains(&spec.uniform) {
            let message = format!("{} is no share of the duration", spec.uniform);
            let hint = "give at least 0 and less than 1";
            faults.add("sections.uniform", message, hint);
        }
        let up = law_of_spec(&mut faults, "sections.run_up", &spec.run_up);
        let out = law_of_spec(&mut faults, "sections.run_out", &spec.run_out);
        faults.check()?;
        match (up, out) {
            (Some(up), Some(out)) => Ok(join_laws(&up, &out, spec)),
            _ => Err(Vec::new()),
        }
    }

    /// A run-up must not turn back, and be fastest at its end.
    fn check_run_up(&self) -> Result<(), Vec<Fault>> {
        let mut faults = Faults::default();
        let (end, peak) = (self.at(1.0).first, self.peak_of(&|jet| jet.first));
        let least = self.peak_of(&|jet| -jet.first);
        if -least.value < -SLACK {
            let message = format!("the speed θ′ is {} at τ = {}", -least.value, least.at);
            faults.add("", message, "a run-up must not turn back");
        }
        if peak.value > end * (1.0 + SLACK) + SLACK {
            let message = format!(
                "the speed θ′ is greatest, {}, at τ = {}, and {end} at τ = 1",
                peak.value, peak.at
            );
            faults.add("", message, "a run-up must be fastest at its end");
        }
        faults.check()
    }
}

fn law_of_spec(faults: &mut Faults, path: &str, spec: &RunLawSpec) -> Option<Law> {
    match Law::of_run_up(spec) {
        Ok(law) => Some(law),
        Err(found) => {
            faults.absorb(path, found);
            None
        }
    }
}

fn trapezoid(path: &str, s1: f64, s2: f64) -> Result<Trapezoid, Vec<Fault>> {
    Trapezoid::new(s1, s2).map_err(|message| vec![Fault::new(path, message, "")])
}

fn must_have(path: &str, given: &[f64], wanted: &[f64], what: &str) -> Result<(), Vec<Fault>> {
    if given.starts_with(wanted) {
        return Ok(());
    }
    let message = format!("the list begins {given:?}");
    let hint = format!("begin it with {wanted:?}: {what}");
    Err(vec![Fault::new(path, message, hint)])
}

fn join_laws(up: &Law, out: &Law, spec: &SectionsSpec) -> Law {
    let (f, uniform) = (spec.skewness, spec.uniform);
    let (first, last) = (up.at(1.0).first, out.at(1.0).first);
    // φ_I and b for a duration of 1; Π_I and k from equal speeds and a stroke of 1.
    let rise = (1.0 - uniform) / (1.0 + f);
    let fall = f * rise;
    let speed = 1.0 / (rise / first + uniform + fall / last);
    let (lift, rest) = (speed * rise / first, speed * fall / last);
    let (mut joints, mut pieces) = (Vec::new(), Vec::new());
    for piece in &up.pieces {
        pieces.push(Piece {
            form: piece.form.clone(),
            origin: rise * piece.origin,
            span: rise * piece.span,
            base: lift * piece.base,
            height: lift * piece.height,
        });
    }
    joints.extend(up.joints.iter().map(|joint| rise * joint));
    joints.push(rise);
    if uniform > 0.0 {
        pieces.push(Piece {
            form: Form::Uniform,
            origin: rise,
            span: 1.0,
            base: lift,
            height: speed,
        });
        joints.push(1.0 - fall);
    }
    let smooth = uniform == 0.0 && is_one_wave(up, out, spec);
    if smooth {
        // Both cosines are one wave: its formula holds beyond the middle.
        joints.pop();
    }
    for piece in out.pieces.iter().rev().skip(usize::from(smooth)) {
        pieces.push(Piece {
            form: piece.form.clone(),
            origin: 1.0 - fall * piece.origin,
            span: -fall * piece.span,
            base: 1.0 - rest * piece.base,
            height: -rest * piece.height,
        });
    }
    joints.extend(out.joints.iter().rev().map(|joint| 1.0 - fall * joint));
    Law {
        joints,
        pieces,
        run_up: false,
    }
}

/// True when the fall of a symmetric stroke's acceleration runs on through the
/// middle as the same cosine.
fn is_one_wave(up: &Law, out: &Law, spec: &SectionsSpec) -> bool {
    let fall = |law: &Law| match law.pieces.last().map(|piece| &piece.form) {
        Some(Form::Trapezoid(law, TrapezoidPart::Fall)) => Some(*law),
        _ => None,
    };
    spec.skewness == 1.0 && fall(up).is_some() && fall(up) == fall(out)
}
