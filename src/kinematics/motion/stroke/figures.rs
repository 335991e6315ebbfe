//! What a stroke is asked to be, and its figures for a given skewness.

use super::StrokeFigures;
use super::criterion::Criterion;
use super::section::RunSection;
use crate::fault::Fault;
use crate::kinematics::motion::law::RunLawSpec;

/// What is given of a stroke. Of stroke, span, greatest speed and uniform
/// section three must be given; the fourth follows.
#[derive(Clone, Debug, PartialEq)]
pub struct StrokeSpec {
    /// Law of the run-up.
    pub run_up: RunLawSpec,
    /// Law of the run-out, counted backwards.
    pub run_out: RunLawSpec,
    /// Π_III ≠ 0.
    pub stroke: Option<f64>,
    /// φ_III > 0.
    pub span: Option<f64>,
    /// Source of the skewness f.
    pub skewness: Skewness,
    /// ζ_Π, 0 ≤ ζ_Π < 1; not together with `uniform_span`.
    pub uniform_stroke: Option<f64>,
    /// ζ_φ, 0 ≤ ζ_φ < 1.
    pub uniform_span: Option<f64>,
    /// True: the uniform section that makes |Π′Π″| least; instead of the two before.
    pub uniform_optimum: bool,
    /// Π′_max, of the sign of the stroke.
    pub peak_speed: Option<f64>,
}

/// Source of the skewness f = (φ_III − φ_II)/φ_I.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Skewness {
    /// Given skewness, > 0 (problem 1).
    Given(f64),
    /// From λ > 0, the greatest acceleration of the run-up by that of the
    /// run-out (problem 2): f = λ·ν1/ν2, (1.20).
    AccelerationRatio(f64),
    /// The one that makes a criterion least.
    Optimum(Criterion),
}

/// Both laws and what relates them.
pub(super) struct Laws {
    pub(super) up: RunSection,
    pub(super) out: RunSection,
}

impl Laws {
    /// ν1.
    pub(super) fn speed_ratio(&self) -> f64 {
        self.up.speed / self.out.speed
    }

    /// ν2.
    pub(super) fn acceleration_ratio(&self) -> f64 {
        self.up.acceleration / self.out.acceleration
    }

    fn u(&self, f: f64) -> f64 {
        // Written so that neither a tiny nor a huge f leads to ∞/∞.
        let weight = f / (1.0 + f);
        1.0 / ((1.0 - weight) + self.speed_ratio() * weight)
    }

    /// G = U·θ′_1max: Π′_max·φ_III/Π_III without a uniform section.
    pub(super) fn g(&self, f: f64) -> f64 {
        self.u(f) * self.up.speed
    }
}

/// The stroke for a known skewness.
pub(super) fn figures(laws: &Laws, spec: &StrokeSpec, f: f64) -> Result<StrokeFigures, Vec<Fault>> {
    let g = laws.g(f);
    let given_share = match (spec.uniform_stroke, spec.uniform_span) {
        (Some(share), _) => Some(share),
        // (1.15), inverted.
        (None, Some(share)) => Some(share * g / (1.0 - share + share * g)),
        (None, None) if spec.uniform_optimum => Some(optimum_uniform_stroke(g)),
        (None, None) => None,
    };
    // r = Π′_max·φ_III/Π_III = ζ_Π/ζ_φ = G − ζ_Π·(G − 1), from (1.15), (1.23).
    let rate = |share: f64| g - share * (g - 1.0);
    let (stroke, span, share) = match (spec.stroke, spec.span, spec.peak_speed, given_share) {
        (Some(stroke), Some(span), _, Some(share)) => (stroke, span, share),
        (Some(stroke), Some(span), Some(speed), None) => {
            (stroke, span, share_of_speed(stroke, span, speed, g)?)
        }
        (None, Some(span), Some(speed), Some(share)) => (speed * span / rate(share), span, share),
        (Some(stroke), None, Some(speed), Some(share)) => {
            (stroke, rate(share) * stroke / speed, share)
        }
        _ => return Err(vec![Fault::new("", "too little is given", "")]),
    };
    let figures = structure(laws, f, stroke, span, share);
    if figures.is_finite() {
        Ok(figures)
    } else {
        let message = "these numbers lead beyond what can be computed with";
        Err(vec![Fault::new("", message, "")])
    }
}

/// Problem 3: ζ_Π from the greatest speed, (1.23), (1.24).
pub(super) fn share_of_speed(
    stroke: f64,
    span: f64,
    speed: f64,
    g: f64,
) -> Result<f64, Vec<Fault>> {
    let mean = stroke / span;
    let r = speed / mean;
    // r = G without a uniform section is a case of its own: let rounding pass.
    let slack = 1e-12 * g;
    if !(r > 1.0 && r <= g + slack) {
        let message = format!(
            "{speed} lies outside the solvable interval {mean} < Π′_max ≤ {} \
             (mean speed … greatest speed without a uniform section)",
            g * mean
        );
        let hint = "towards the mean speed the accelerations grow without limit; \
                    more than the upper end needs other laws or another skewness";
        return Err(vec![Fault::new("peak_speed", message, hint)]);
    }
    Ok(((g - r) / (g - 1.0)).max(0.0))
}

/// (1.14)–(1.18) from Π_III, φ_III, f and ζ_Π.
pub(super) fn structure(laws: &Laws, f: f64, stroke: f64, span: f64, share: f64) -> StrokeFigures {
    let (nu1, g) = (laws.speed_ratio(), laws.g(f));
    let (up, out) = (&laws.up, &laws.out);
    let uniform_span = share / (share + g * (1.0 - share));
    let lift = stroke * (1.0 - share) / (1.0 + nu1 * f);
    let rest = nu1 * f * lift;
    let rise = span * (1.0 - uniform_span) / (1.0 + f);
    let fall = f * rise;
    let acceleration_run_up = lift / (rise * rise) * up.acceleration;
    let acceleration_run_out = (rest / (fall * fall) * out.acceleration).abs();
    StrokeFigures {
        stroke,
        span,
        stroke_run_up: lift,
        stroke_run_out: stroke * (1.0 + nu1 * f * share) / (1.0 + nu1 * f),
        angle_run_up: rise,
        angle_run_out: span * (1.0 + f * uniform_span) / (1.0 + f),
        uniform_stroke: share,
        uniform_span,
        skewness: f,
        speed_ratio: nu1,
        law_acceleration_ratio: laws.acceleration_ratio(),
        u: laws.u(f),
        acceleration_ratio: acceleration_run_up.abs() / acceleration_run_out,
        peak_speed: lift / rise * up.speed,
        acceleration_run_up,
        acceleration_run_out,
        product_run_up: lift * lift / (rise * rise * rise) * up.product,
        product_run_out: rest * rest / (fall * fall * fall) * out.product,
    }
}

impl StrokeFigures {
    /// True when every number is finite and every section has an extent.
    fn is_finite(&self) -> bool {
        let all = [
            self.stroke,
            self.span,
            self.peak_speed,
            self.acceleration_run_up,
            self.acceleration_run_out,
            self.product_run_up,
            self.product_run_out,
            self.acceleration_ratio,
        ];
        all.iter().all(|number| number.is_finite()) && self.angle_run_up > 0.0
    }
}

/// The uniform share of the stroke that makes |Π′Π″| least.
///
/// With x = 1 − ζ_Π both sections have |Π′Π″| ∝ (1 + (G − 1)·x)³/x, least at
/// x = 1/(2(G − 1)); for G ≤ 3/2 that is beyond x = 1, and no uniform section
/// is best.
pub fn optimum_uniform_stroke(g: f64) -> f64 {
    (1.0 - 0.5 / (g - 1.0)).max(0.0)
}
