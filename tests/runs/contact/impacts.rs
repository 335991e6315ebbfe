//! Impacts with loss: the coefficient of restitution in its implicit closed form, and the
//! massless point between contact and damped link against an integration of first order.

use super::{INTEGRATED, Wall, figures, pair};
use dam::integrate::Method;

/// ∫ v dv/(1 + χ·v) from 0: with m·v·dv = −e(p)·(1 + χ·v)·dp the same before and after.
fn spent(chi: f64, v: f64) -> f64 {
    v / chi - (chi * v).ln_1p() / (chi * chi)
}

/// Speed after an impact at speed v.
fn after(chi: f64, v: f64) -> f64 {
    let (mut low, mut high) = (0.0, v.min((1.0 - 1e-15) / chi));
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if spent(chi, -middle) < spent(chi, v) {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

#[test]
fn restitution_over_speed() {
    let chi = 0.4;
    for v in [0.05, 0.5, 2.0, 5.0] {
        for (law, stiffness, power) in [("hunt_crossley", 900.0f64, 2.0), ("hertz", 4000.0, 2.5)] {
            let contact = format!(
                r#"{{ "law": "{law}", "stiffness": {stiffness:?}, "dissipation": {chi:?} }}"#
            );
            let taylor = (law != "hertz").then_some(Method::Taylor);
            for method in INTEGRATED.into_iter().chain(taylor) {
                let result = Wall::rigid(&contact, v, 2.0).run(method);
                let speed = figures(&result).end.speed;
                approx::assert_relative_eq!(speed, after(chi, v), max_relative = 1e-6);
                // All energy of the motion is spent at the deepest: k·p^power/power = spent.
                let depth = (power * spent(chi, v) / stiffness).powf(1.0 / power);
                let found = pair(&result).max_indentation.unwrap();
                approx::assert_relative_eq!(found, depth, max_relative = 1e-6);
                assert_eq!(pair(&result).separations, 1);
            }
        }
    }
}

/// Contact law N(p, ṗ) = e(p)·(1 + χ·ṗ) + d·ṗ.
#[derive(Clone, Copy)]
struct Law {
    stiffness: f64,
    power: f64,
    damping: f64,
    dissipation: f64,
}

impl Law {
    fn elastic(&self, p: f64) -> f64 {
        self.stiffness * p.max(0.0).powf(self.power)
    }
}

/// Peak force, time of parting and speed of the mass then, of one mass 1 on a link (1, b)
/// that ends on the contact: integrated as it stands, with the point's own equation.
fn reference(law: Law, b: f64) -> [f64; 3] {
    // z: indentation, u: indentation of the mass, v its speed.
    let rate = |[z, u, v]: [f64; 3]| {
        let lost = law.damping + law.dissipation * law.elastic(z);
        ((u - z) + b * v - law.elastic(z)) / (b + lost)
    };
    let force = |y: [f64; 3]| (y[1] - y[0]) + b * (y[2] - rate(y));
    let slope = |y: [f64; 3]| [rate(y), y[2], -force(y)];
    let h = 2e-5;
    let step = |y: [f64; 3], h: f64| {
        let go = |by: [f64; 3], h: f64| std::array::from_fn(|i| y[i] + h * by[i]);
        let k1 = slope(y);
        let k2 = slope(go(k1, 0.5 * h));
        let k3 = slope(go(k2, 0.5 * h));
        let k4 = slope(go(k3, h));
        std::array::from_fn(|i| y[i] + h / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]))
    };
    let (mut y, mut time, mut peak) = ([0.0, 0.0, 1.0], 0.0, 0.0f64);
    loop {
        let next: [f64; 3] = step(y, h);
        if next[0] > 0.0 && force(next) > 0.0 {
            peak = peak.max(force(next));
            (y, time) = (next, time + h);
            continue;
        }
        let (mut low, mut high) = (0.0, h);
        for _ in 0..50 {
            let middle = 0.5 * (low + high);
            let there: [f64; 3] = step(y, middle);
            if there[0] > 0.0 && force(there) > 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        let end: [f64; 3] = step(y, low);
        return [peak, time + low, end[2]];
    }
}

#[test]
fn the_massless_point_is_a_state_of_first_order() {
    let law = |stiffness, power, damping, dissipation| Law {
        stiffness,
        power,
        damping,
        dissipation,
    };
    for (text, law, b) in [
        (r#"{ "stiffness": 10 }"#, law(10.0, 1.0, 0.0, 0.0), 0.05),
        (
            r#"{ "law": "kelvin_voigt", "stiffness": 10, "damping": 0.2 }"#,
            law(10.0, 1.0, 0.2, 0.0),
            0.05,
        ),
        (
            r#"{ "law": "kelvin_voigt", "stiffness": 10, "damping": 0.2 }"#,
            law(10.0, 1.0, 0.2, 0.0),
            0.0,
        ),
        (
            r#"{ "law": "hunt_crossley", "stiffness": 10, "dissipation": 0.3 }"#,
            law(10.0, 1.0, 0.0, 0.3),
            0.05,
        ),
        (
            r#"{ "law": "hertz", "stiffness": 20, "dissipation": 0.3 }"#,
            law(20.0, 1.5, 0.0, 0.3),
            0.05,
        ),
    ] {
        let [peak, time, speed] = reference(law, b);
        let capacity = b * std::f64::consts::TAU;
        let taylor = (law.power == 1.0).then_some(Method::Taylor);
        for method in INTEGRATED.into_iter().chain(taylor) {
            let wall = Wall {
                duration: time + 1e-3,
                ..Wall::rod(1, capacity, text, 0.0)
            };
            let result = wall.run(method);
            let own = pair(&result);
            approx::assert_relative_eq!(own.max_contact_force, peak, max_relative = 2e-6);
            approx::assert_relative_eq!(own.switch_times[0], time, max_relative = 1e-6);
            // (Open, link 1 carries nothing: the mass flies on.)
            approx::assert_relative_eq!(figures(&result).end.speed, -speed, max_relative = 1e-6);
            let wall = &result.figures.objects["wall"];
            approx::assert_relative_eq!(
                wall.peak_reaction,
                own.max_contact_force,
                max_relative = 1e-9
            );
        }
    }
}
