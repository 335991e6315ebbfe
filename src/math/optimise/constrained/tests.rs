//! Optima in closed form, and those of the reference.

use super::{
    Multipliers, Problem, Slopes, SmoothPiece, SqpEnd, Values, bundle, flat_directions,
    multipliers, sqp, starts,
};
use serde_json::Value;

type OfAll<'f> = &'f dyn Fn(&[f64]) -> (f64, Vec<f64>);

/// Functions of variables over ranges; slopes are central differences.
struct Closed<'f> {
    ranges: &'f [[f64; 2]],
    equalities: usize,
    inequalities: usize,
    of_all: OfAll<'f>,
}

impl Closed<'_> {
    fn real(&self, at: &[f64]) -> Vec<f64> {
        let each = self.ranges.iter().zip(at);
        each.map(|([low, high], x)| low + (high - low) * x)
            .collect()
    }

    fn scaled(&self, at: &[f64]) -> Vec<f64> {
        let each = self.ranges.iter().zip(at);
        each.map(|([low, high], x)| (x - low) / (high - low))
            .collect()
    }

    /// The optimum from a start, with its multipliers in units.
    fn optimum(&self, start: &[f64]) -> (Vec<f64>, SqpEnd, Multipliers) {
        let (at, end) = sqp(self, &self.scaled(start), 1e-13, 200);
        let values = self.values(&at).unwrap();
        let active: Vec<bool> = values.conditions.iter().map(|c| *c > -1e-6).collect();
        let pieces = SmoothPiece::all(&self.slopes(&at).unwrap());
        let held = multipliers(self, &at, &active, &pieces);
        (self.real(&at), end, held)
    }
}

impl Problem for Closed<'_> {
    fn variables(&self) -> usize {
        self.ranges.len()
    }
    fn equalities(&self) -> usize {
        self.equalities
    }
    fn inequalities(&self) -> usize {
        self.inequalities
    }
    fn values(&self, at: &[f64]) -> Option<Values> {
        let (objective, conditions) = (self.of_all)(&self.real(at));
        let finite = objective.is_finite() && conditions.iter().all(|c| c.is_finite());
        finite.then_some(Values {
            objective,
            conditions,
        })
    }
    fn slopes(&self, at: &[f64]) -> Option<Slopes> {
        let step = 1e-6;
        let mut found = Slopes {
            objective: Vec::new(),
            conditions: vec![Vec::new(); self.equalities + self.inequalities],
        };
        for k in 0..at.len() {
            let moved = |d: f64| {
                let mut place = at.to_vec();
                place[k] += d;
                self.values(&place)
            };
            let (after, before) = (moved(step)?, moved(-step)?);
            found
                .objective
                .push((after.objective - before.objective) / (2.0 * step));
            let each = after.conditions.iter().zip(&before.conditions);
            for (slope, (after, before)) in found.conditions.iter_mut().zip(each) {
                slope.push((after - before) / (2.0 * step));
            }
        }
        Some(found)
    }
}

fn near(found: &[f64], wanted: &[f64], within: f64) {
    for (a, b) in found.iter().zip(wanted) {
        assert!(
            (a - b).abs() <= within * b.abs().max(1.0),
            "{found:?} {wanted:?}"
        );
    }
}

#[test]
fn a_parabola_between_a_line_and_bounds() {
    // x² + y² − 4x − 2y with x + y ≤ 2: (3/2, 1/2), worth 1 a unit of the limit.
    let of_all = |x: &[f64]| {
        let objective = x[0] * x[0] + x[1] * x[1] - 4.0 * x[0] - 2.0 * x[1];
        (objective, vec![x[0] + x[1] - 2.0])
    };
    let problem = Closed {
        ranges: &[[0.0, 5.0], [0.0, 5.0]],
        equalities: 0,
        inequalities: 1,
        of_all: &of_all,
    };
    let (at, end, held) = problem.optimum(&[4.0, 3.0]);
    assert_eq!(end, SqpEnd::Converged);
    near(&at, &[1.5, 0.5], 1e-7);
    near(&held.conditions, &[1.0], 1e-6);
    assert!(held.residual < 1e-6, "{held:?}");
    // A bound in place of the line: (1, 1) with the slope 2·1 − 4 = −2 at the upper bound of x.
    let problem = Closed {
        ranges: &[[0.0, 1.0], [0.0, 5.0]],
        equalities: 0,
        inequalities: 1,
        of_all: &|x| {
            (
                x[0] * x[0] + x[1] * x[1] - 4.0 * x[0] - 2.0 * x[1],
                vec![-1.0],
            )
        },
    };
    let (at, _, held) = problem.optimum(&[0.2, 3.0]);
    near(&at, &[1.0, 1.0], 1e-6);
    near(&held.bounds, &[-2.0, 0.0], 1e-6);
}

#[test]
fn hock_and_schittkowski_71() {
    // W. Hock, K. Schittkowski: Test Examples for Nonlinear Programming Codes, 1981, problem 71.
    let of_all = |x: &[f64]| {
        let sum: f64 = x.iter().map(|x| x * x).sum();
        (
            x[0] * x[3] * (x[0] + x[1] + x[2]) + x[2],
            vec![sum - 40.0, 25.0 - x.iter().product::<f64>()],
        )
    };
    let problem = Closed {
        ranges: &[[1.0, 5.0]; 4],
        equalities: 1,
        inequalities: 1,
        of_all: &of_all,
    };
    let (at, _, held) = problem.optimum(&[1.0, 5.0, 5.0, 1.0]);
    near(&at, &[1.0, 4.742_999_64, 3.821_149_98, 1.379_408_29], 1e-6);
    // Multipliers as Ipopt gives them: of the sum −0.16147 of f by its value, of the product 0.55229.
    near(&held.conditions, &[0.161_468_57, 0.552_293_66], 1e-5);
}

#[test]
fn a_curved_valley_under_a_cubic() {
    // Rosenbrock's function in a disc of radius √2 has its least value 0 at (1, 1), on the edge.
    let of_all = |x: &[f64]| {
        let valley = (1.0 - x[0]).powi(2) + 100.0 * (x[1] - x[0] * x[0]).powi(2);
        (valley, vec![x[0] * x[0] + x[1] * x[1] - 1.5])
    };
    let problem = Closed {
        ranges: &[[-1.5, 1.5], [-1.5, 1.5]],
        equalities: 0,
        inequalities: 1,
        of_all: &of_all,
    };
    // Matlab's documentation of `fmincon`: (0.7864, 0.6177) for radius 1; here by Lagrange, below.
    let (at, _, held) = problem.optimum(&[-1.0, 1.0]);
    let [x, y] = [at[0], at[1]];
    assert!((x * x + y * y - 1.5).abs() < 1e-9);
    let slope = [
        -2.0 * (1.0 - x) - 400.0 * x * (y - x * x),
        200.0 * (y - x * x),
    ];
    near(&[slope[0] * y], &[slope[1] * x], 1e-6);
    assert!(held.conditions[0] > 0.0 && held.residual < 1e-4, "{held:?}");
}

/// The greatest of three functions over −1 … 3 (C. Charalambous, J. W. Bandler 1976, CB2).
struct GreatestOfThree;

impl GreatestOfThree {
    fn all(at: &[f64]) -> [(f64, [f64; 2]); 3] {
        let [x, y] = [4.0 * at[0] - 1.0, 4.0 * at[1] - 1.0];
        let growth = 2.0 * (y - x).exp();
        [
            (x * x + y.powi(4), [2.0 * x, 4.0 * y.powi(3)]),
            (
                (2.0 - x).powi(2) + (2.0 - y).powi(2),
                [-2.0 * (2.0 - x), -2.0 * (2.0 - y)],
            ),
            (growth, [-growth, growth]),
        ]
    }

    fn greatest(at: &[f64]) -> (f64, [f64; 2]) {
        let all = Self::all(at).into_iter();
        all.max_by(|one, other| one.0.total_cmp(&other.0)).unwrap()
    }
}

impl Problem for GreatestOfThree {
    fn variables(&self) -> usize {
        2
    }
    fn equalities(&self) -> usize {
        0
    }
    fn inequalities(&self) -> usize {
        0
    }
    fn values(&self, at: &[f64]) -> Option<Values> {
        Some(Values {
            objective: Self::greatest(at).0,
            conditions: vec![],
        })
    }
    fn slopes(&self, at: &[f64]) -> Option<Slopes> {
        let slope = Self::greatest(at).1;
        Some(Slopes {
            objective: slope.map(|slope| 4.0 * slope).to_vec(),
            conditions: vec![],
        })
    }
}

#[test]
fn the_greatest_of_three_functions_has_a_kink_at_its_least_value() {
    for number in 0..8 {
        let (at, _) = sqp(&GreatestOfThree, &starts(number, 2), 1e-12, 200);
        let found = bundle(&GreatestOfThree, &at, 1e-12).unwrap();
        near(&[found.values.objective], &[1.952_224_493_87], 1e-8);
        let place: Vec<f64> = found.at.iter().map(|x| 4.0 * x - 1.0).collect();
        near(&place, &[1.139_037_7, 0.899_559_9], 1e-5);
        // Slopes are about 10.
        let held = multipliers(&GreatestOfThree, &found.at, &[], &found.pieces);
        assert!(held.residual < 2e-3, "{held:?}");
    }
}

#[test]
fn a_place_without_values_is_not_gone_to() {
    // √(x − 0.3) has no value below 0.3, and its least value there.
    let of_all = |x: &[f64]| (x[0].powi(2), vec![0.2 - (x[0] - 0.3).sqrt()]);
    let problem = Closed {
        ranges: &[[0.0, 1.0]],
        equalities: 0,
        inequalities: 1,
        of_all: &of_all,
    };
    let (at, _, held) = problem.optimum(&[0.9]);
    near(&at, &[0.34], 1e-7);
    // d(0.3 + L²)²/dL = 2 · 0.34 · 2 · 0.2.
    near(&held.conditions, &[0.272], 1e-5);
    assert_eq!(sqp(&problem, &[0.1], 1e-10, 50).1, SqpEnd::NoValues);
}

fn reference(name: &str) -> Value {
    let text = std::fs::read_to_string("tests/reference/design-optimum-tolerance.json").unwrap();
    serde_json::from_str::<Value>(&text).unwrap()[name].clone()
}

fn number(value: &Value) -> f64 {
    value.as_str().unwrap().parse().unwrap()
}

/// A cam with harmonic motion and its spring: mass, eccentricity, angular speed, least force.
struct CamSpring {
    mass: f64,
    eccentricity: f64,
    speed: f64,
    least: f64,
}

impl CamSpring {
    fn of(case: &Value) -> Self {
        Self {
            mass: number(&case["mass"]),
            eccentricity: number(&case["eccentricity"]),
            speed: number(&case["rpm"]) * std::f64::consts::TAU / 60.0,
            least: number(&case["least_force_asked"]),
        }
    }

    /// Contact force by preload and stiffness at the two ends of the stroke: F + c·s + m·a.
    fn forces(&self, preload: f64, stiffness: f64) -> [f64; 2] {
        let inertia = self.mass * self.eccentricity * self.speed * self.speed;
        [
            preload + inertia,
            preload + 2.0 * stiffness * self.eccentricity - inertia,
        ]
    }
}

#[test]
fn the_least_preload_and_the_softest_spring_are_those_of_the_reference() {
    for name in ["cam_spring", "cam_spring_stiff"] {
        let case = reference(name);
        let cam = CamSpring::of(&case);
        let stiffness = number(&case["stiffness"]);
        let of_all = |x: &[f64]| {
            let [up, down] = cam.forces(x[0], stiffness);
            (x[0], vec![(cam.least - up.min(down)) / 10.0])
        };
        let problem = Closed {
            ranges: &[[0.0, 100.0]],
            equalities: 0,
            inequalities: 1,
            of_all: &of_all,
        };
        let (at, _, held) = problem.optimum(&[80.0]);
        near(&at, &[number(&case["A_least_preload"]["value"])], 1e-9);
        near(
            &[held.conditions[0] / 10.0],
            &[number(
                &case["A_least_preload"]["d_by"]["least_force_asked"],
            )],
            1e-6,
        );

        let softest = &case["B_softest_spring"];
        let most = number(&softest["greatest_force_allowed"]);
        let of_all = |x: &[f64]| {
            let [up, down] = cam.forces(x[1], x[0]);
            (
                x[0] / 1000.0,
                vec![
                    (cam.least - up.min(down)) / 10.0,
                    (up.max(down) - most) / 10.0,
                ],
            )
        };
        let problem = Closed {
            ranges: &[[0.0, 5000.0], [0.0, 100.0]],
            equalities: 0,
            inequalities: 2,
            of_all: &of_all,
        };
        for start in [[4000.0, 80.0], [10.0, 1.0], [2500.0, 5.0]] {
            let (at, _, held) = problem.optimum(&start);
            near(
                &at,
                &[number(&softest["stiffness"]), number(&softest["preload"])],
                1e-7,
            );
            // Per unit of the function over per unit of the conditions.
            let found = [
                held.conditions[0] * 1000.0 / 10.0,
                -held.conditions[1] * 1000.0 / 10.0,
            ];
            let wanted = [
                "d_stiffness_by_least_force_asked",
                "d_stiffness_by_greatest_force_allowed",
            ];
            near(
                &found,
                &wanted.map(|name| number(&softest["multipliers"][name])),
                1e-6,
            );
        }
    }
}

#[test]
fn springs_that_are_equally_good_are_a_stretch() {
    for name in ["cam_spring", "cam_spring_stiff"] {
        let case = reference(name);
        let cam = CamSpring::of(&case);
        let of_all = |x: &[f64]| {
            let [up, down] = cam.forces(x[1], x[0]);
            (
                up.max(down) / 100.0,
                vec![(cam.least - up.min(down)) / 100.0],
            )
        };
        let problem = Closed {
            ranges: &[[0.0, 5000.0], [0.0, 100.0]],
            equalities: 0,
            inequalities: 1,
            of_all: &of_all,
        };
        for start in [[4500.0, 60.0], [100.0, 90.0]] {
            let (at, _) = sqp(&problem, &problem.scaled(&start), 1e-13, 200);
            let found = bundle(&problem, &at, 1e-12).unwrap();
            near(
                &[100.0 * found.values.objective],
                &[number(&case["C_not_unique"]["value"])],
                1e-9,
            );
            let active: Vec<bool> = found.values.conditions.iter().map(|c| *c > -1e-6).collect();
            let held = multipliers(&problem, &found.at, &active, &found.pieces);
            let slopes = problem.slopes(&found.at).unwrap();
            let flat = flat_directions(&problem, &found.at, (&found.values, &slopes), &held);
            assert_eq!(flat.len(), 1, "{found:?} {held:?}");
            let mut ends: Vec<Vec<f64>> =
                flat[0].ends.iter().map(|end| problem.real(end)).collect();
            ends.sort_by(|a, b| a[0].total_cmp(&b[0]));
            near(
                &[ends[0][0]],
                &[number(&case["C_not_unique"]["stiffness_from"])],
                1e-6,
            );
            near(
                &[ends[1][0]],
                &[number(&case["C_not_unique"]["stiffness_to"])],
                1e-6,
            );
        }
    }
}

#[test]
fn the_counterweight_has_its_optimum_at_a_kink() {
    // Of a slotted link: greatest of (1 − K)² and K² over a turn, in mrω².
    let of_all = |x: &[f64]| ((1.0 - x[0]).abs().max(x[0].abs()), vec![]);
    let problem = Closed {
        ranges: &[[0.0, 1.3]],
        equalities: 0,
        inequalities: 0,
        of_all: &of_all,
    };
    for start in [0.05, 0.4, 1.2] {
        let (at, _) = sqp(&problem, &problem.scaled(&[start]), 1e-13, 200);
        let found = bundle(&problem, &at, 1e-12).unwrap();
        near(
            &problem.real(&found.at),
            &[number(&reference("counterweight")["K"])],
            1e-8,
        );
        let held = multipliers(&problem, &found.at, &[], &found.pieces);
        assert!(held.residual < 1e-6, "{found:?} {held:?}");
    }
}

#[test]
fn residual_vibration_vanishes_at_every_whole_ratio() {
    let residual = |r: f64| {
        let pi = std::f64::consts::PI;
        ((pi * r).sin() / (pi * r * (r * r - 1.0))).abs()
    };
    for number in 0..20 {
        let start = 1.2 + 5.3 * starts(number, 1)[0];
        let of_all = |x: &[f64]| (residual(x[0]), vec![]);
        let problem = Closed {
            ranges: &[[1.2, 6.5]],
            equalities: 0,
            inequalities: 0,
            of_all: &of_all,
        };
        let (at, _) = sqp(&problem, &problem.scaled(&[start]), 1e-13, 200);
        let found = bundle(&problem, &at, 1e-13).unwrap();
        let ratio = problem.real(&found.at)[0];
        let end = ratio >= 6.5 - 1e-9;
        assert!(
            end || (ratio - ratio.round()).abs() < 1e-6,
            "{start} {ratio}"
        );
    }
}

#[test]
fn starts_fill_the_range_and_stay_the_same() {
    let all: Vec<f64> = (0..16).map(|number| starts(number, 3)[2]).collect();
    // One in every sixteenth: what a Sobol sequence is for.
    let mut parts: Vec<usize> = all.iter().map(|x| (16.0 * x) as usize).collect();
    parts.sort_unstable();
    assert_eq!(parts, (0..16).collect::<Vec<_>>());
    assert_eq!(starts(5, 3), starts(5, 3));
}
