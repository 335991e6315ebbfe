//! Methods over a parameter.

use super::{WHEEL, plan, system};
use dam::integrate::Method;
use dam::studies::Control;
use dam::studies::methods::Plan;
use dam::studies::methods::Verdict;
use dam::studies::methods::sweep::Sweep;
use dam::studies::methods::sweep::sweep;

fn swept(axis: &str, plan: &Plan) -> Sweep {
    let axis = dam::studies::axis::Axis::parse(axis).unwrap();
    let prepare = |x| Ok::<_, String>(system(WHEEL, &["wheel.damping=0", &axis.setting(x)]));
    let fail = |_, faults: Vec<dam::fault::Fault>| format!("{faults:?}");
    sweep(
        &axis,
        plan,
        &Control::default(),
        prepare,
        fail,
        &mut |_, _| {},
    )
    .unwrap()
}

#[test]
fn a_fixed_step_fails_where_the_scene_gets_too_stiff() {
    let methods = [Method::Exact, Method::Rk4, Method::Dop853];
    let found = swept(
        "wheel.stiffness=8000:800000:5:log",
        &plan(1e-6, &methods, &[], &[]),
    );
    assert_eq!(found.slices.len(), 5);
    // Half the stable step at the first value: unstable from four times the
    // stiffness on, and ω·h = √2·10^(k/4)·… there.
    let step = found.fixed_step.unwrap();
    approx::assert_relative_eq!(step * 4e5f64.sqrt(), 2f64.sqrt(), max_relative = 1e-6);
    for slice in &found.slices {
        let rk4 = slice.standing(Method::Rk4).unwrap();
        let product = step * (slice.x / 0.02).sqrt();
        let unstable = rk4.verdict == Verdict::Unstable;
        assert_eq!(unstable, product > 8f64.sqrt(), "{product}: {}", rk4.cause);
        let theory = rk4.stable_step_by_theory.unwrap();
        let measured = rk4.stable_step.unwrap();
        approx::assert_relative_eq!(measured, theory, max_relative = 0.05);
        let dop853 = slice.standing(Method::Dop853).unwrap();
        assert!(dop853.measured_seconds.is_some(), "{}", dop853.cause);
    }
    let strips = dam::report::methods::charts::regions(&found);
    assert_eq!(strips.y.rows.len(), 3);
    // The second method, at the first value and at the last.
    let kinds = strips.field.unwrap().kind;
    assert_ne!(kinds[5], kinds[9]);
    let csv = dam::report::methods::sweep_rows(&found).csv();
    assert!(csv.starts_with("wheel.stiffness [N m/rad],method,tolerance"));
}

#[test]
fn a_value_that_is_no_scene_ends_a_sweep_before_it_begins() {
    let axis = dam::studies::axis::Axis::parse("wheel.stiffness=8000:-8000:3").unwrap();
    let mut asked = Vec::new();
    let mut points = 0;
    let found = sweep(
        &axis,
        &plan(1e-6, &[Method::Exact, Method::Rk4], &[], &[]),
        &Control::default(),
        |x| {
            asked.push(x);
            match x > 0.0 {
                true => Ok(system(WHEEL, &[&axis.setting(x)])),
                false => Err(x),
            }
        },
        |x, _| x,
        &mut |_, _| points += 1,
    );
    assert_eq!((found.unwrap_err(), points), (0.0, 0));
    assert_eq!(asked, [8000.0, 0.0]);
}
