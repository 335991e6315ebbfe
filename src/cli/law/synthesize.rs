//! `dam law synthesize`: a stroke of run-up, uniform section and run-out.

use super::args::SynthesizeArgs;
use super::{deliver, told};
use crate::cli::failure::Failure;
use crate::fault::Fault;
use crate::frontend::object::law::{read_argument, run_up_law};
use crate::frontend::read::{Bounds, Wanted};
use crate::kinematics::motion::stroke::{Criterion, Skewness, Stroke, StrokeFigures, StrokeSpec};
use crate::report::findings::{Figure, Section};
use crate::report::law::{stroke_findings, stroke_rows};
use crate::units::{Quantity, parse, quantities as q, shown};
use serde_json::{Value, json};

pub(super) fn command(args: &SynthesizeArgs) -> Result<(), Failure> {
    let run_up = run_up_law(&args.run_up)?;
    let run_out = match &args.run_out {
        Some(text) => run_up_law(text)?,
        None => run_up.clone(),
    };
    let unit = unit(args);
    let spec = StrokeSpec {
        run_up,
        run_out,
        stroke: quantity(
            "--stroke",
            &args.stroke,
            Wanted::either(q::LENGTH, q::ANGLE),
        )?,
        span: quantity("--span", &args.span, q::ANGLE)?,
        skewness: skewness(args),
        uniform_stroke: args.uniform_stroke,
        uniform_span: args.uniform_span,
        uniform_optimum: args.uniform_optimum,
        peak_speed: quantity(
            "--peak-speed",
            &args.peak_speed,
            Wanted::either(q::LENGTH_PER_ANGLE, q::NUMBER),
        )?,
    };
    let stroke = Stroke::new(&spec).map_err(|faults| refused(faults, args))?;
    let words = format!("{} up, {} out", spec.run_up.words(), spec.run_out.words());
    let document = document(&stroke, &words, unit, spec.skewness);
    let mut more = Vec::new();
    if let Some(changes) = against_none(&spec, &stroke) {
        more.push(Section::new("Against no uniform section").figures(changes));
    }
    if let Skewness::Optimum(criterion) = spec.skewness {
        let value = criterion.of(stroke.figures());
        let figure = Figure::number("criterion", value, "", 10);
        more.push(Section::new("Skewness").figures(vec![figure]));
    }
    let rows = stroke_rows(&stroke, unit, args.form.samples as usize);
    let found = (&stroke_findings(&words, &stroke, unit, more), document);
    let shown = (args.form.json, args.form.form);
    deliver((&args.form.out, false), found, &rows, shown)
}

fn skewness(args: &SynthesizeArgs) -> Skewness {
    if let Some(lambda) = args.acceleration_ratio {
        Skewness::AccelerationRatio(lambda)
    } else if let Some(weight) = args.least_acceleration {
        Skewness::Optimum(Criterion::Acceleration { weight })
    } else if let Some(weight) = args.least_torque {
        Skewness::Optimum(Criterion::Product { weight })
    } else {
        Skewness::Given(args.skewness.unwrap_or(1.0))
    }
}

fn document(stroke: &Stroke, words: &str, unit: &str, skewness: Skewness) -> Value {
    let criterion = match skewness {
        Skewness::Optimum(criterion) => Some(criterion.of(stroke.figures())),
        _ => None,
    };
    json!({
        "dam": 1, "laws": words, "unit": unit, "figures": stroke.figures(), "criterion": criterion
    })
}

/// What a uniform section changes of the greatest Π′, |Π″| and |Π′Π″|, as shares of a
/// stroke without one (same stroke, span and skewness); `None` without one.
fn against_none(spec: &StrokeSpec, stroke: &Stroke) -> Option<Vec<Figure>> {
    let with = stroke.figures();
    let plain = StrokeSpec {
        stroke: Some(with.stroke),
        span: Some(with.span),
        skewness: Skewness::Given(with.skewness),
        uniform_stroke: Some(0.0),
        uniform_span: None,
        uniform_optimum: false,
        peak_speed: None,
        ..spec.clone()
    };
    if with.uniform_stroke <= 0.0 {
        return None;
    }
    let plain = Stroke::new(&plain).ok()?;
    let none = plain.figures();
    let change = |f: fn(&StrokeFigures) -> f64| f(with) / f(none) - 1.0;
    let figure = |name: &str, change: f64| {
        let sign = if change < 0.0 { "" } else { "+" };
        Figure::new(name, format!("{sign}{} %", shown(100.0 * change, 8)))
    };
    fn size(a: f64, b: f64) -> f64 {
        a.abs().max(b.abs())
    }
    let speed = change(|s| s.peak_speed.abs());
    let acceleration = change(|s| size(s.acceleration_run_up, s.acceleration_run_out));
    let product = change(|s| size(s.product_run_up, s.product_run_out));
    Some(vec![
        figure("greatest Π′", speed),
        figure("greatest |Π″|", acceleration),
        figure("greatest |Π′Π″|", product),
    ])
}

fn quantity(
    name: &str,
    text: &Option<String>,
    wanted: impl Into<Wanted>,
) -> Result<Option<f64>, Failure> {
    let Some(text) = text else {
        return Ok(None);
    };
    let wanted = wanted.into();
    let value = read_argument(name, text, |slot| slot.quantity(wanted, Bounds::ANY))?;
    Ok(Some(value))
}

/// Unit of the displacement: that of the stroke as given, else told by the speed.
fn unit(args: &SynthesizeArgs) -> &'static str {
    let fits = |text: &Option<String>, quantity: Quantity| {
        let measure = text.as_deref().and_then(|text| parse(text).ok());
        measure.is_some_and(|measure| quantity.accept(measure).is_ok())
    };
    let plain = |text: &str| text.trim().parse::<f64>().is_ok();
    let given = args.stroke.iter().chain(&args.peak_speed);
    let length = fits(&args.stroke, q::LENGTH) || fits(&args.peak_speed, q::LENGTH_PER_ANGLE);
    if length && !given.map(String::as_str).all(plain) {
        "m"
    } else if fits(&args.stroke, q::ANGLE) && !args.stroke.as_deref().is_some_and(plain) {
        "rad"
    } else {
        "unit"
    }
}

/// Faults in terms of the options.
fn refused(faults: Vec<Fault>, args: &SynthesizeArgs) -> Failure {
    let optimum = match args.least_torque {
        Some(_) => "least-torque",
        None => "least-acceleration",
    };
    let named: Vec<Fault> = faults
        .into_iter()
        .map(|mut fault| {
            if fault.path == "optimum" {
                fault.path = optimum.to_owned();
            }
            fault
        })
        .collect();
    told(&named, "--")
}
