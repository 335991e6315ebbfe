//! Position functions as formulas.

use crate::dynamics::model::{Coordinate, Law};
use crate::kinematics::motion::cycle::{Cycle, Motion};
use crate::kinematics::position::{
    Cam, FourBar, Position, SliderCrank, SlottedDriver, SlottedLinkSpec, SlottedOutput, Table,
};
use crate::report::math::{Expr, Index, symbol};
use crate::report::quantity::{significant, with_unit};

/// U at the displacement `phi`, the lever included, as a formula; functions
/// without a closed formula are described in words.
pub fn formula(law: &Law, phi: Expr) -> Expr {
    match bare_formula(&law.position, phi) {
        Expr::Words(words) if law.lever != 1.0 => {
            Expr::Words(format!("{} times: {words}", significant(law.lever, 6)))
        }
        Expr::Words(words) => Expr::Words(words),
        bare => Expr::Number(law.lever).times(bare),
    }
}

/// The position function in a few words, for the edges of the object graph:
/// `U = 0.25φ`, `slider-crank 50/200 mm`.
pub fn summary(law: &Law, coordinate: Coordinate) -> String {
    let lever = if law.lever == 1.0 {
        String::new()
    } else {
        format!(", lever {}", significant(law.lever, 4))
    };
    let millimetres = |length: f64| significant(1e3 * length, 4);
    match &law.position {
        Position::SliderCrank(linkage) => {
            let lengths = [linkage.crank, linkage.rod].map(millimetres);
            format!("slider-crank {} mm{lever}", lengths.join("/"))
        }
        Position::FourBar(linkage) => {
            let lengths = [
                linkage.crank,
                linkage.coupler,
                linkage.rocker,
                linkage.frame,
            ];
            format!("four-bar {} mm{lever}", lengths.map(millimetres).join("/"))
        }
        Position::SlottedLink(linkage) => {
            let spec = linkage.spec();
            let lengths = [spec.crank, spec.frame].map(millimetres);
            format!("slotted link {} mm{lever}", lengths.join("/"))
        }
        Position::Cam(cam) => {
            let lift = cam.spec().lift * law.lever;
            format!("cam, lift {}", with_unit(lift, coordinate.unit(), 4))
        }
        Position::Plan(plan) => format!("plan of {} stations{lever}", plan.spec().stations.len()),
        Position::Table(table) if table.is_periodic() => format!("periodic table{lever}"),
        Position::Table(_) => format!("table{lever}"),
        Position::Linkage(output) => format!("output {} of the linkage{lever}", output.name()),
        Position::Custom(_) => format!("own function{lever}"),
        Position::Ratio { .. } | Position::Sine { .. } | Position::Polynomial(_) => {
            let phi = symbol("φ", Index::None).expr();
            format!("U = {}", formula(law, phi).unicode())
        }
    }
}

fn bare_formula(position: &Position, phi: Expr) -> Expr {
    match position {
        Position::Ratio { ratio, offset } => {
            Expr::sum(vec![Expr::Number(*ratio).times(phi), Expr::Angle(*offset)])
        }
        Position::Sine {
            amplitude,
            harmonic,
            phase,
            offset,
        } => {
            let argument = Expr::sum(vec![
                Expr::Number(*harmonic).times(phi),
                Expr::Angle(*phase),
            ]);
            let wave = Expr::Angle(*amplitude).times(function("sin", argument));
            Expr::sum(vec![wave, Expr::Angle(*offset)])
        }
        Position::Polynomial(coefficients) => polynomial(coefficients, &phi),
        Position::SliderCrank(linkage) => slider_crank(linkage, phi),
        Position::FourBar(linkage) => Expr::Words(four_bar(linkage)),
        Position::SlottedLink(linkage) => Expr::Words(slotted_link(linkage.spec())),
        Position::Cam(cam) => Expr::Words(cam_words(cam)),
        Position::Plan(plan) => Expr::Words(plan_words(plan)),
        Position::Table(table) => Expr::Words(table_words(table)),
        Position::Linkage(output) => Expr::Words(format!(
            "output {} of the linkage, over its input coordinate",
            output.name()
        )),
        Position::Custom(_) => Expr::Words("own function of the driver's displacement".into()),
    }
}

fn function(name: &'static str, argument: Expr) -> Expr {
    Expr::Function(name, Box::new(argument))
}

/// Σ a_k φᵏ without the terms that are zero.
fn polynomial(coefficients: &[f64], phi: &Expr) -> Expr {
    let term = |(power, &factor): (usize, &f64)| match (power, factor) {
        (_, 0.0) => Expr::Number(0.0),
        (0, factor) => Expr::Number(factor),
        (1, factor) => Expr::Number(factor.abs()).times(phi.clone()).signed(factor),
        (power, factor) => {
            let power = Expr::Power(Box::new(phi.clone()), power as u32);
            Expr::Number(factor.abs()).times(power).signed(factor)
        }
    };
    Expr::sum(coefficients.iter().enumerate().map(term).collect())
}

/// r·cos θ ± √(l² − (r·sin θ − e)²), lengths in metres.
fn slider_crank(linkage: &SliderCrank, phi: Expr) -> Expr {
    let theta = Expr::sum(vec![phi, Expr::Angle(linkage.phase)]);
    let crank = || Expr::Number(linkage.crank);
    let height = Expr::sum(vec![
        crank().times(function("sin", theta.clone())),
        Expr::Number(-linkage.offset),
    ]);
    let square = Expr::Number(linkage.rod).squared().minus(height.squared());
    let root = Expr::Root(Box::new(square));
    let across = crank().times(function("cos", theta));
    if linkage.branch >= 0.0 {
        across.plus(root)
    } else {
        across.minus(root)
    }
}

fn four_bar(linkage: &FourBar) -> String {
    let metres = |length: f64| significant(length, 6);
    format!(
        "angle of the rocker of a four-bar linkage: crank {} m, coupler {} m, rocker {} m, \
         frame {} m, {}, crank at φ{}",
        metres(linkage.crank),
        metres(linkage.coupler),
        metres(linkage.rocker),
        metres(linkage.frame),
        if linkage.branch >= 0.0 {
            "open"
        } else {
            "crossed"
        },
        added(linkage.phase)
    )
}

fn slotted_link(spec: &SlottedLinkSpec) -> String {
    let metres = |length: f64| significant(length, 6);
    let output = match spec.output {
        SlottedOutput::Link => "angle of the slotted link",
        SlottedOutput::Crank => "angle of the crank",
        SlottedOutput::Block => "distance of the block",
    };
    let driver = match spec.driver {
        SlottedDriver::Crank => format!("crank at φ{}", added(spec.phase)),
        SlottedDriver::Block => format!(
            "block at φ + {} m, {}",
            metres(spec.phase),
            if spec.branch >= 0.0 {
                "branch +"
            } else {
                "branch -"
            }
        ),
    };
    format!(
        "{output} of a slotted-link mechanism: crank {} m, frame {} m, {driver}",
        metres(spec.crank),
        metres(spec.frame)
    )
}

fn cam_words(cam: &Cam) -> String {
    let spec = cam.spec();
    let degrees = |angle: f64| significant(angle.to_degrees(), 6);
    let laws = if spec.rise_law == spec.return_law {
        format!("{} both ways", spec.rise_law.words())
    } else {
        format!(
            "{} up, {} down",
            spec.rise_law.words(),
            spec.return_law.words()
        )
    };
    format!(
        "cam: lift {}, rise {}°, dwell {}°, return {}°, {laws}, at φ{}",
        significant(spec.lift, 6),
        degrees(spec.rise),
        degrees(spec.dwell),
        degrees(spec.return_angle),
        added(spec.phase)
    )
}

/// Every station with the motion that leads on from it.
pub(super) fn plan_words(plan: &Cycle) -> String {
    let spec = plan.spec();
    let stations = spec.stations.iter().map(|station| {
        let motion = match &station.motion {
            Motion::Dwell => "dwell".to_owned(),
            Motion::Uniform => "uniform".to_owned(),
            Motion::Smooth => "smooth".to_owned(),
            Motion::Law(law) => law.words(),
        };
        let (at, to) = (
            significant(station.at, 6),
            significant(station.displacement, 6),
        );
        format!("{to} at {at}, {motion}")
    });
    let stations: Vec<String> = stations.collect();
    let again = match spec.period {
        Some(period) => format!("; again after {}", significant(period, 6)),
        None => String::new(),
    };
    let advance = match spec.advance {
        0.0 => String::new(),
        advance => format!(", advanced by {}", significant(advance, 6)),
    };
    format!("plan: {}{again}{advance}", stations.join("; "))
}

fn table_words(table: &Table) -> String {
    let (from, to) = table.ends();
    format!(
        "{} cubic spline through a table from φ = {} to {}",
        if table.is_periodic() {
            "periodic"
        } else {
            "clamped"
        },
        significant(from, 6),
        significant(to, 6)
    )
}

/// " + phase", or nothing.
fn added(phase: f64) -> String {
    let text = Expr::Angle(phase.abs()).unicode();
    match phase {
        0.0 => String::new(),
        phase if phase < 0.0 => format!(" − {text}"),
        _ => format!(" + {text}"),
    }
}

#[cfg(test)]
mod tests {
    use super::{formula, summary};
    use crate::dynamics::model::{Coordinate, Law};
    use crate::kinematics::position::{Position, PositionSpec};
    use crate::report::math::{Index, symbol};

    /// Summary and formula as text.
    fn shown(spec: &PositionSpec, lever: f64) -> (String, String) {
        let law = Law {
            driver: 0,
            position: Position::new(spec).unwrap(),
            lever,
            track: None,
        };
        let phi = symbol("φ", Index::None).expr();
        let text = formula(&law, phi).unicode();
        (summary(&law, Coordinate::Sliding), text)
    }

    #[test]
    fn position_functions_are_written_with_their_numbers() {
        let linkage = |offset, branch| PositionSpec::SliderCrank {
            crank: 0.05,
            rod: 0.2,
            offset,
            branch,
            phase: 0.0,
        };
        let (short, long) = shown(&linkage(0.0, 1.0), 1.0);
        assert_eq!(short, "slider-crank 50/200 mm");
        assert_eq!(long, "0.05·cos φ + √(0.2² − (0.05·sin φ)²)");
        let (_, long) = shown(&linkage(-0.01, -1.0), 2.0);
        assert_eq!(long, "2·(0.05·cos φ − √(0.2² − (0.05·sin φ + 0.01)²))");
        let polynomial = PositionSpec::Polynomial {
            coefficients: vec![0.5, -1.0, 0.0, 2.5],
        };
        assert_eq!(shown(&polynomial, 1.0).0, "U = 0.5 − φ + 2.5·φ³");
        let four_bar = PositionSpec::FourBar {
            crank: 0.04,
            coupler: 0.12,
            rocker: 0.08,
            frame: 0.13,
            branch: 1.0,
            phase: 0.0,
        };
        let (short, long) = shown(&four_bar, 1.0);
        assert_eq!(short, "four-bar 40/120/80/130 mm");
        assert!(long.ends_with("open, crank at φ"), "{long}");
    }
}
