//! Every position function against finite differences.

use super::{
    CamSpec, LawName, LawSpec, Position, PositionSpec, SlottedDriver, SlottedLinkSpec,
    SlottedOutput,
};
use crate::math::jet::Jet;
use proptest::prelude::*;

fn sign(negative: bool) -> f64 {
    if negative { -1.0 } else { 1.0 }
}

fn law() -> impl Strategy<Value = LawSpec> {
    (0..LawName::ALL.len()).prop_map(|index| LawName::ALL[index].into())
}

/// Random descriptions of every kind.
fn specs() -> impl Strategy<Value = PositionSpec> {
    let length = 0.2f64..1.0;
    prop_oneof![
        (-3.0f64..3.0, -1.0f64..1.0)
            .prop_map(|(ratio, offset)| PositionSpec::Ratio { ratio, offset }),
        (0.1f64..2.0, 0.5f64..3.0, -3.0f64..3.0, -1.0f64..1.0).prop_map(
            |(amplitude, harmonic, phase, offset)| PositionSpec::Sine {
                amplitude,
                harmonic,
                phase,
                offset,
            }
        ),
        prop::collection::vec(-1.0f64..1.0, 1..7)
            .prop_map(|coefficients| PositionSpec::Polynomial { coefficients }),
        (
            prop::collection::vec((0.3f64..1.0, -1.0f64..1.0), 3..9),
            any::<bool>()
        )
            .prop_map(|(steps, periodic)| {
                let mut phi = -2.0;
                let mut points: Vec<(f64, f64)> = steps
                    .iter()
                    .map(|&(step, value)| {
                        phi += step;
                        (phi, value)
                    })
                    .collect();
                if periodic {
                    points.push((phi + 0.5, points[0].1));
                }
                PositionSpec::Table {
                    points,
                    periodic,
                    end_slopes: (0.3, -0.4),
                }
            }),
        (
            length.clone(),
            length.clone(),
            -0.5f64..0.5,
            any::<bool>(),
            -3.0f64..3.0
        )
            .prop_map(
                |(crank, rod, offset, minus, phase)| PositionSpec::SliderCrank {
                    crank,
                    rod,
                    offset,
                    branch: sign(minus),
                    phase,
                }
            ),
        (
            prop::array::uniform4(length.clone()),
            any::<bool>(),
            -3.0f64..3.0
        )
            .prop_map(|([crank, coupler, rocker, frame], minus, phase)| {
                PositionSpec::FourBar {
                    crank,
                    coupler,
                    rocker,
                    frame,
                    branch: sign(minus),
                    phase,
                }
            }),
        (
            length.clone(),
            0.0f64..1.0,
            (0usize..4, any::<bool>()),
            -3.0f64..3.0
        )
            .prop_map(|(crank, frame, (which, minus), phase)| {
                let (driver, output) = [
                    (SlottedDriver::Crank, SlottedOutput::Link),
                    (SlottedDriver::Crank, SlottedOutput::Block),
                    (SlottedDriver::Block, SlottedOutput::Link),
                    (SlottedDriver::Block, SlottedOutput::Crank),
                ][which];
                PositionSpec::SlottedLink(SlottedLinkSpec {
                    crank,
                    frame,
                    driver,
                    output,
                    branch: sign(minus),
                    phase,
                })
            }),
        (
            prop::array::uniform3(0.5f64..2.0),
            -1.0f64..1.0,
            law(),
            law(),
            -3.0f64..3.0
        )
            .prop_map(
                |([rise, dwell, return_angle], lift, rise_law, return_law, phase)| {
                    PositionSpec::Cam(CamSpec {
                        lift,
                        rise,
                        dwell,
                        return_angle,
                        rise_law,
                        return_law,
                        phase,
                    })
                }
            ),
    ]
}

/// Each derivative against the five-point difference of the one before.
fn agrees_with_differences(position: &Position, phi: f64) -> Result<(), TestCaseError> {
    let segment = position.breaks().segment_at(phi, 1.0);
    let h = 1e-4;
    let jets = [-2.0, -1.0, 0.0, 1.0, 2.0].map(|k| position.jet(segment, phi + k * h));
    let middle = jets[2];
    prop_assert!(middle.is_finite());
    type Derivative = fn(&Jet) -> f64;
    let orders: [(Derivative, f64); 3] = [
        (|jet| jet.value, middle.first),
        (|jet| jet.first, middle.second),
        (|jet| jet.second, middle.third),
    ];
    let size = middle.value.abs() + middle.first.abs() + middle.second.abs() + middle.third.abs();
    for (order, (f, exact)) in orders.iter().enumerate() {
        let difference =
            (f(&jets[0]) - f(&jets[4]) + 8.0 * (f(&jets[3]) - f(&jets[1]))) / (12.0 * h);
        prop_assert!(
            (difference - exact).abs() <= 1e-6 * (1.0 + size),
            "derivative {} at {phi}: {exact}, difference {difference}",
            order + 1
        );
    }
    Ok(())
}

/// Distance from the places where differences do not tell: dead-centre positions and
/// knots of a spline.
fn well_placed(position: &Position, spec: &PositionSpec, phi: f64) -> bool {
    let near_knot = |points: &[(f64, f64)]| {
        let period = points[points.len() - 1].0 - points[0].0;
        points.iter().any(|point| {
            let distance = (phi - point.0) / period;
            (distance - distance.round()).abs() * period < 1e-3 || (phi - point.0).abs() < 1e-3
        })
    };
    match (spec, position.reach_from(phi)) {
        (PositionSpec::Table { points, .. }, _) => !near_knot(points),
        (_, Err(_)) => false,
        (_, Ok(Some((from, to)))) => (phi - from).min(to - phi) > 0.05,
        (_, Ok(None)) => true,
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, ..ProptestConfig::default() })]
    #[test]
    fn derivatives_agree_with_differences(spec in specs(), phi in -10.0f64..10.0) {
        let Ok(position) = Position::new(&spec) else { return Ok(()) };
        let steep = position.jet(position.breaks().segment_at(phi, 1.0), phi).third.abs() > 1e5;
        if well_placed(&position, &spec, phi) && !steep {
            agrees_with_differences(&position, phi)?;
        }
    }

    #[test]
    fn closed_forms_are_the_functions_over_one_period(spec in specs(), y in -1.0f64..1.0) {
        let Ok(position) = Position::new(&spec) else { return Ok(()) };
        let Some(pieces) = position.closed_form() else { return Ok(()) };
        let period = position.period().map_or(f64::NAN, |period| period.0);
        let whole: f64 = pieces.iter().map(|piece| 2.0 * piece.half).sum();
        prop_assert!((whole - period).abs() < 1e-12 * period, "{whole} {period}");
        for piece in &pieces {
            let phi = piece.middle + piece.half * y;
            let segment = position.breaks().segment_at(phi, 1.0);
            let expected = position.jet(segment, phi).value;
            let own = piece.terms.at(y);
            prop_assert!((own - expected).abs() < 1e-12 * (1.0 + expected.abs()), "{own} {expected}");
        }
    }

    #[test]
    fn any_numbers_are_refused_or_evaluated_without_panic(
        numbers in prop::array::uniform6(prop::num::f64::ANY),
        phi in prop::num::f64::ANY,
    ) {
        let [a, b, c, d, e, f] = numbers;
        let branch = sign(a < 0.0);
        for spec in [
            PositionSpec::SliderCrank { crank: a, rod: b, offset: c, branch, phase: d },
            PositionSpec::FourBar { crank: a, coupler: b, rocker: c, frame: d, branch, phase: e },
            PositionSpec::SlottedLink(SlottedLinkSpec {
                crank: a,
                frame: b,
                driver: if c > 0.0 { SlottedDriver::Crank } else { SlottedDriver::Block },
                output: SlottedOutput::Link,
                branch,
                phase: d,
            }),
            PositionSpec::Table {
                points: vec![(a, b), (c, d), (e, f)],
                periodic: a > c,
                end_slopes: (0.0, d),
            },
            PositionSpec::Polynomial { coefficients: numbers.to_vec() },
        ] {
            if let Ok(position) = Position::new(&spec) {
                let _ = position.jet(1, phi);
                let _ = position.reach_from(phi);
            }
        }
    }
}
