//! A stroke worked out: run-up, uniform section and run-out.

use crate::Error;
use crate::fault::Fault;
use crate::frontend::object::law::{read_argument, run_up_law};
use crate::frontend::read::{Bounds, QuantityChoice};
use crate::kinematics::motion::stroke::{Skewness, Stroke, StrokeFigures, StrokeSpec};
use crate::units::{Quantity, parse, quantities as q};
use serde_json::{Value, json};

/// What is known of a stroke. Three of stroke, span, greatest speed and uniform section are
/// given; the fourth follows.
#[derive(Clone, Debug)]
pub struct StrokeQuestion {
    /// Law of the run-up: a name, `trapezoid:S1,S2`, or JSON as in a scene.
    pub run_up: String,
    /// Law of the run-out, counted backwards; that of the run-up, if none.
    pub run_out: Option<String>,
    /// Whole stroke: `50 mm`, `30 deg`; negative: in the other direction.
    pub stroke: Option<String>,
    /// Angle of the driver for it: `120 deg`.
    pub span: Option<String>,
    /// Greatest speed per speed of the driver: `34 mm/rad`, or a number.
    pub peak_speed: Option<String>,
    /// Share of the stroke in uniform motion.
    pub uniform_stroke: Option<f64>,
    /// Share of the span with uniform motion.
    pub uniform_span: Option<f64>,
    /// The uniform section with the least torque |Π′Π″|.
    pub uniform_optimum: bool,
    /// Angle of the run-out by that of the run-up, or what it follows from.
    pub skewness: Skewness,
}

/// A stroke that was worked out.
#[derive(Clone, Debug)]
pub struct Synthesis {
    /// What was asked for.
    pub spec: StrokeSpec,
    /// The stroke.
    pub stroke: Stroke,
    /// Unit of its displacement: `m`, `rad`, or `unit` where none was given.
    pub unit: &'static str,
}

impl StrokeQuestion {
    /// Works it out.
    ///
    /// ```
    /// use dam::ask::StrokeQuestion;
    /// use dam::motion::stroke::Skewness;
    ///
    /// let question = StrokeQuestion {
    ///     run_up: "sine".to_owned(),
    ///     run_out: None,
    ///     stroke: Some("50 mm".to_owned()),
    ///     span: Some("120 deg".to_owned()),
    ///     peak_speed: None,
    ///     uniform_stroke: Some(0.3),
    ///     uniform_span: None,
    ///     uniform_optimum: false,
    ///     skewness: Skewness::Given(1.0),
    /// };
    /// let found = question.answer()?;
    /// assert!((found.stroke.figures().stroke - 0.05).abs() < 1e-15);
    /// # Ok::<(), dam::Error>(())
    /// ```
    ///
    /// # Errors
    /// A law is none; a quantity cannot be read; what is given contradicts itself, or is too
    /// little or too much.
    pub fn answer(&self) -> Result<Synthesis, Error> {
        Ok(self.solve("")??)
    }

    /// The same; `prefix` goes before the names of what is given, and faults of the stroke come
    /// apart from those of reading.
    pub(crate) fn solve(&self, prefix: &str) -> Result<Result<Synthesis, Vec<Fault>>, Error> {
        let run_up = run_up_law(&self.run_up)?;
        let run_out = match &self.run_out {
            Some(text) => run_up_law(text)?,
            None => run_up.clone(),
        };
        let read = |name: &str, text: &Option<String>, wanted: QuantityChoice| match text {
            None => Ok(None),
            Some(text) => {
                let name = format!("{prefix}{name}");
                read_argument(&name, text, |slot| slot.quantity(wanted, Bounds::ANY)).map(Some)
            }
        };
        let displacement = QuantityChoice::either(q::LENGTH, q::ANGLE);
        let per_angle = QuantityChoice::either(q::LENGTH_PER_ANGLE, q::NUMBER);
        let spec = StrokeSpec {
            run_up,
            run_out,
            stroke: read("stroke", &self.stroke, displacement)?,
            span: read("span", &self.span, q::ANGLE.into())?,
            skewness: self.skewness,
            uniform_stroke: self.uniform_stroke,
            uniform_span: self.uniform_span,
            uniform_optimum: self.uniform_optimum,
            peak_speed: read("peak-speed", &self.peak_speed, per_angle)?,
        };
        let unit = self.unit();
        Ok(Stroke::new(&spec).map(|stroke| Synthesis { spec, stroke, unit }))
    }

    /// Unit of the displacement: that of the stroke as given, else told by the speed.
    fn unit(&self) -> &'static str {
        let fits = |text: &Option<String>, quantity: Quantity| {
            let measure = text.as_deref().and_then(|text| parse(text).ok());
            measure.is_some_and(|measure| quantity.accept(measure).is_ok())
        };
        let plain = |text: &str| text.trim().parse::<f64>().is_ok();
        let given = self.stroke.iter().chain(&self.peak_speed);
        let length = fits(&self.stroke, q::LENGTH) || fits(&self.peak_speed, q::LENGTH_PER_ANGLE);
        if length && !given.map(String::as_str).all(plain) {
            "m"
        } else if fits(&self.stroke, q::ANGLE) && !self.stroke.as_deref().is_some_and(plain) {
            "rad"
        } else {
            "unit"
        }
    }
}

impl Synthesis {
    /// The laws in words.
    pub fn words(&self) -> String {
        let (up, out) = (self.spec.run_up.words(), self.spec.run_out.words());
        format!("{up} up, {out} out")
    }

    /// The criterion that the skewness makes least, where it follows from one.
    pub fn criterion(&self) -> Option<f64> {
        match self.spec.skewness {
            Skewness::Optimum(criterion) => Some(criterion.of(self.stroke.figures())),
            _ => None,
        }
    }

    /// What a uniform section changes of the greatest Π′, |Π″| and |Π′Π″|, as shares of a stroke
    /// without one (same stroke, span and skewness); `None` without one.
    pub fn against_none(&self) -> Option<[f64; 3]> {
        let with = self.stroke.figures();
        if with.uniform_stroke <= 0.0 {
            return None;
        }
        let plain = StrokeSpec {
            stroke: Some(with.stroke),
            span: Some(with.span),
            skewness: Skewness::Given(with.skewness),
            uniform_stroke: Some(0.0),
            uniform_span: None,
            uniform_optimum: false,
            peak_speed: None,
            ..self.spec.clone()
        };
        let plain = Stroke::new(&plain).ok()?;
        let none = plain.figures();
        let change = |f: fn(&StrokeFigures) -> f64| f(with) / f(none) - 1.0;
        fn size(a: f64, b: f64) -> f64 {
            a.abs().max(b.abs())
        }
        Some([
            change(|s| s.peak_speed.abs()),
            change(|s| size(s.acceleration_run_up, s.acceleration_run_out)),
            change(|s| size(s.product_run_up, s.product_run_out)),
        ])
    }

    /// The JSON document.
    pub fn document(&self) -> Value {
        json!({
            "dam": 1, "laws": self.words(), "unit": self.unit, "figures": self.stroke.figures(),
            "criterion": self.criterion()
        })
    }
}
