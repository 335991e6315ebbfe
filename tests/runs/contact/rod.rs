//! A rod of mass 1 and stiffness 1 against a wall through a spring, at speed 1: the exact
//! solution by d'Alembert's waves, and how the chain of masses comes to it.

use super::{INTEGRATED, Wall, pair};
use dam::integrate::Method;
use dam::record::Quantity;

/// Indentation u(t) of the spring while the contact lasts, waves of two crossings and more.
pub(super) struct Waves(pub(super) f64);

impl Waves {
    fn indentation(&self, t: f64) -> f64 {
        let k = self.0;
        let first = |t: f64| (1.0 - (-k * t).exp()) / k;
        let second = |s: f64| -1.0 / k + (2.0 * s + first(2.0) + 1.0 / k) * (-k * s).exp();
        if t <= 2.0 {
            first(t)
        } else if t <= 4.0 {
            second(t - 2.0)
        } else {
            let (s, at) = (t - 4.0, second(2.0));
            let slope = 2.0 - 2.0 * k * first(2.0) - 2.0;
            1.0 / k + (slope * s - 2.0 * k * s * s + at - 1.0 / k) * (-k * s).exp()
        }
    }

    /// The first return to zero, by bisection after the maximum.
    pub(super) fn end(&self) -> f64 {
        let (mut low, mut high) = (2.0, 2.0);
        while self.indentation(high) > 0.0 {
            low = high;
            high += 1e-3;
        }
        for _ in 0..80 {
            let middle = 0.5 * (low + high);
            if self.indentation(middle) > 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        low
    }

    pub(super) fn force(&self) -> f64 {
        let steps = (0..=600_000).map(|step| f64::from(step) * 1e-5);
        let end = self.end();
        let inside = steps.take_while(|t| *t <= end);
        self.0 * inside.map(|t| self.indentation(t)).fold(0.0, f64::max)
    }

    /// Speed of the centre of mass afterwards over that before: the impulse less what it
    /// stops, by Simpson's rule between the arrivals of the waves.
    fn restitution(&self) -> f64 {
        let end = self.end();
        let parts = [[0.0, 2.0], [2.0, 4.0], [4.0, 6.0]];
        let parts = parts.map(|[from, to]: [f64; 2]| [from.min(end), to.min(end)]);
        let impulse = |[from, to]: [f64; 2]| {
            let count = 4000;
            let step = (to - from) / f64::from(count);
            let term = |at: i32| {
                let weight = match at {
                    0 => 1.0,
                    at if at == count => 1.0,
                    at if at % 2 == 0 => 2.0,
                    _ => 4.0,
                };
                // Where a wave arrives the later piece begins.
                let t = (from + step * f64::from(at)).min(to);
                weight * self.0 * self.indentation(t)
            };
            (0..=count).map(term).sum::<f64>() * step / 3.0
        };
        parts.into_iter().map(impulse).sum::<f64>() - 1.0
    }
}

/// Greatest force, contact time, restitution of the centre of mass, for k.
const TABLE: [[f64; 4]; 4] = [
    [0.5, 0.6639719079, 4.8033622288, 0.9993815878],
    [1.0, 0.8691420690, 3.6366615131, 0.9740810382],
    [10.0, 0.9999999979, 2.1678346989, 0.9948288393],
    [100.0, 1.0000000000, 2.0167834699, 0.9994828839],
];

#[test]
fn the_closed_form_is_that_of_the_table() {
    for [k, force, time, restitution] in TABLE {
        let waves = Waves(k);
        approx::assert_abs_diff_eq!(waves.restitution(), restitution, epsilon = 1e-9);
        approx::assert_abs_diff_eq!(waves.force(), force, epsilon = 1e-9);
        approx::assert_abs_diff_eq!(waves.end(), time, epsilon = 1e-9);
    }
}

pub(super) fn contact(k: f64) -> String {
    format!(r#"{{ "stiffness": {k:?} }}"#)
}

/// Errors of the greatest force and the contact time of a rod of n masses (%).
fn errors(masses: usize, k: f64, capacity: f64, method: Method) -> [f64; 2] {
    let wall = Wall::rod(masses, capacity, &contact(k), 6.0);
    let result = wall.run(method);
    let waves = Waves(k);
    let (own, exact) = (pair(&result), [waves.force(), waves.end()]);
    let depth = own.max_indentation.unwrap();
    approx::assert_relative_eq!(depth * k, own.max_contact_force, max_relative = 1e-7);
    [
        100.0 * (own.max_contact_force / exact[0] - 1.0),
        100.0 * (own.switch_times[0] / exact[1] - 1.0),
    ]
}

#[test]
fn a_chain_comes_to_the_waves() {
    // Measured on independent programs: n, k, errors of force and time (%).
    for (masses, k, force, time) in [
        (16, 1.0, -1.3, 1.3),
        (16, 10.0, 0.01, 3.6),
        (16, 100.0, 3.4, 5.0),
        (64, 1.0, -0.22, 0.33),
        (64, 10.0, 0.0, 0.57),
        (64, 100.0, 0.19, 1.6),
    ] {
        let found = errors(masses, k, 0.0, Method::Exact);
        approx::assert_abs_diff_eq!(found[0], force, epsilon = 0.06);
        approx::assert_abs_diff_eq!(found[1], time, epsilon = 0.06);
    }
}

/// Cells with inertia at both ends, the first at its far end: better where the wall is soft,
/// of the second order in time.
#[test]
fn balanced_cells_come_quicker_to_a_soft_wall() {
    for k in [0.5, 1.0] {
        let of = |masses, lumping: &str| {
            let wall = Wall::rod(masses, 0.0, &contact(k), 6.0);
            let lumped = format!("\"masses\": {masses}, \"lumping\": \"{lumping}\"");
            let text = wall
                .text()
                .replace(&format!("\"masses\": {masses}"), &lumped);
            let scene = dam::Scene::from_json(&text).unwrap();
            let result = dam::Mechanism::of(scene.decode().unwrap())
                .unwrap()
                .run()
                .unwrap();
            let waves = Waves(k);
            let own = pair(&result);
            let force = own.max_contact_force / waves.force() - 1.0;
            [force.abs(), (own.switch_times[0] / waves.end() - 1.0).abs()]
        };
        let [ends, balanced] = ["ends", "balanced"].map(|lumping| of(64, lumping));
        assert!(balanced[0] < 0.5 * ends[0], "{k}: {balanced:?} {ends:?}");
        assert!(balanced[1] < 0.1 * ends[1], "{k}: {balanced:?} {ends:?}");
        let coarse = of(16, "balanced");
        let order = (coarse[1] / balanced[1]).log2() / 2.0;
        assert!(order > 1.7, "{k}: order {order}");
    }
}

#[test]
fn all_methods_agree_and_damping_vanishes_in_the_limit() {
    let exact = errors(4, 10.0, 0.0, Method::Exact);
    for method in INTEGRATED.into_iter().chain([Method::Taylor]) {
        let own = errors(4, 10.0, 0.0, method);
        approx::assert_abs_diff_eq!(own[0], exact[0], epsilon = 1e-4);
        approx::assert_abs_diff_eq!(own[1], exact[1], epsilon = 1e-4);
    }
    // With a massless point behind the contact, hardly damped, and so stiff.
    for method in [Method::Rodas5p, Method::Radau] {
        let own = errors(4, 10.0, 1e-3, method);
        approx::assert_abs_diff_eq!(own[0], exact[0], epsilon = 0.1);
        approx::assert_abs_diff_eq!(own[1], exact[1], epsilon = 0.1);
    }
}

/// The order of the model chosen by itself: 2 % of the greatest force and of the time in
/// contact, within the interval stated, and 2 % of the restitution.
#[test]
fn as_many_masses_as_the_accuracy_needs() {
    let others = [2.5, 40.0].map(Waves);
    let others = others.map(|waves| [waves.0, waves.force(), waves.end(), waves.restitution()]);
    for [k, force, time, restitution] in TABLE.into_iter().chain(others) {
        let text = Wall::rod(1, 0.0, &contact(k), 6.0).text();
        // Six units of time less the time in contact.
        let accuracy = format!(
            r#""accuracy": {{ "body.pair.max_contact_force": "2 %",
                "body.pair.separated_time": "{} s" }},"#,
            0.02 * time
        );
        let text = text.replace("\"record\": \"all\",", &accuracy);
        let text = text.replace("\"masses\": 1", "\"masses\": \"auto\"");
        let scene = dam::Scene::from_json(&text).unwrap();
        let mut mechanism = dam::Mechanism::of(scene.decode().unwrap()).unwrap();
        mechanism.settings.masses = true;
        let certificate = mechanism.certificate.as_ref().unwrap();
        for (figure, exact, within) in [
            ("body.pair.max_contact_force", force, 0.02 * force),
            ("body.pair.separated_time", 6.0 - time, 0.02 * time),
        ] {
            let found = &certificate.accuracy[figure];
            let off = (found.value - exact).abs();
            assert!(off <= within && found.holds, "{k}: {off} {found:?}");
            assert!(off <= found.error.unwrap(), "{k}: {off} {found:?}");
        }
        assert!(certificate.models["body"].coordinates <= 128, "{k}");
        // The run that follows is that of the model chosen.
        let result = mechanism.run().unwrap();
        let found = &certificate.accuracy["body.pair.max_contact_force"];
        assert_eq!(pair(&result).max_contact_force, found.value);
        let model = mechanism.model();
        let body = model.objects.iter().find(|part| part.id == "body").unwrap();
        let momentum = body.nodes.iter().enumerate().map(|(mass, &node)| {
            let speed = Quantity::MassSpeed(mass + 1);
            let speeds = &result.record.column("body", speed).unwrap().values;
            model.nodes[node].inertia * speeds.last().unwrap()
        });
        let off = momentum.sum::<f64>() - restitution;
        assert!(
            off.abs() <= 0.02 * restitution,
            "{k}: {off} of {restitution}"
        );
    }
}
