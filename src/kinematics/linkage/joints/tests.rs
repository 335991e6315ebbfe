//! The row of every kind against differences of its closing error, its rates against differences of
//! the row, and its forces against the power of the row.

use super::{CouplingKind, CouplingSpec, DECLARATIONS, Frames, Joint, Turns, Wrench};
use crate::kinematics::linkage::elements::Frame;
use crate::kinematics::linkage::spec::pair::{PairKind, PairSpec, PointOf};
use crate::kinematics::linkage::vector::Vector;
use crate::math::series::Series;

/// x, y, θ of each link as power series.
struct Links<const K: usize>([[Series<K>; 3]; 3]);

impl<const K: usize> Frames<K, f64> for Links<K> {
    fn frame(&self, link: usize) -> Frame<K> {
        let [x, y, angle] = self.0[link];
        Frame {
            at: Vector::new(x, y),
            direction: Vector::of_angle(angle),
        }
    }
}

impl<const K: usize> Turns<K> for Links<K> {
    fn angle(&self, link: usize) -> Series<K> {
        self.0[link][2]
    }
}

/// Poses far from where the joint closes, and a motion through them.
fn links<const K: usize>() -> Links<K> {
    let taylor = [
        [[0.1, 0.3, -0.2], [-0.2, 0.5, 0.1], [0.7, 1.1, -0.4]],
        [[0.6, -0.4, 0.3], [0.3, 0.2, 0.5], [-1.2, 0.6, 0.8]],
        [[0.2, 0.1, 0.4], [0.1, -0.3, 0.2], [0.4, -0.9, 0.3]],
    ];
    Links(taylor.map(|link| link.map(|own| Series(std::array::from_fn(|k| own[k])))))
}

/// A link moved along one of its coordinates.
fn moved(link: usize, unknown: usize, by: f64) -> Links<1> {
    let mut links = links::<1>();
    links.0[link][unknown].0[0] += by;
    links
}

fn pair(on: (usize, [f64; 2]), link: (usize, [f64; 2]), kind: PairKind) -> PairSpec {
    let point = |(link, at): (usize, [f64; 2])| PointOf {
        link: Some(link),
        at,
    };
    PairSpec {
        name: String::new(),
        on: point(on),
        link: point(link),
        kind,
        friction: 0.0,
    }
}

/// A coupling of links 0 and 1, with link 2 as their carrier.
pub(crate) struct Sample {
    name: &'static str,
    kind: CouplingKind,
    pairs: Vec<PairSpec>,
    /// How the second link moves against the carrier, where forces pass through its pins.
    carried: Option<Carried>,
}

/// How a link moves against its carrier.
#[derive(Clone, Copy)]
enum Carried {
    /// It turns.
    Turning,
    /// It slides in this direction.
    Sliding([f64; 2]),
}

/// Direction of the guide of what slides (rad).
const GUIDE: f64 = 0.3;

impl Sample {
    /// Of two links that need no carrier.
    pub(super) fn of_two(name: &'static str, kind: CouplingKind) -> Self {
        Self {
            name,
            kind,
            pairs: Vec::new(),
            carried: None,
        }
    }

    /// Of two wheels on pins of the carrier.
    pub(super) fn of_wheels(name: &'static str, kind: CouplingKind) -> Self {
        let pin = PairKind::Revolute { diameter: 0.0 };
        Self {
            pairs: vec![
                pair((2, [0.1, 0.0]), (0, [0.0; 2]), pin),
                pair((1, [0.0; 2]), (2, [0.5, 0.1]), pin),
            ],
            carried: Some(Carried::Turning),
            ..Self::of_two(name, kind)
        }
    }

    /// Of a wheel on a pin of the carrier and a slide: on a guide of the carrier, or with a
    /// guide of its own.
    pub(super) fn of_slide(name: &'static str, kind: CouplingKind, on_carrier: bool) -> Self {
        let guide = PairKind::Sliding {
            direction: GUIDE,
            angle: 0.2,
            corners: [0.0; 2],
            half_height: 0.0,
        };
        let mut sample = Self::of_wheels(name, kind);
        let (on, block) = if on_carrier { (2, 1) } else { (1, 2) };
        sample.pairs[1] = pair((on, [0.2, 0.1]), (block, [0.05, 0.1]), guide);
        let direction = [GUIDE.cos(), GUIDE.sin()];
        sample.carried = on_carrier.then_some(Carried::Sliding(direction));
        sample
    }

    fn ready(&self) -> Joint {
        let coupling = CouplingSpec {
            name: self.name.to_owned(),
            wheels: [Some(0), Some(1)],
            carrier: Some(2),
            kind: self.kind.clone(),
            offset: 0.3,
        };
        coupling
            .to_joint(&self.pairs)
            .expect("its links are joined")
    }
}

/// What the files of all kinds give, made ready.
fn couplings() -> Vec<(Sample, Joint)> {
    let samples = DECLARATIONS.iter().flat_map(|own| (own.samples)());
    let ready = |own: Sample| {
        let joint = own.ready();
        (own, joint)
    };
    samples.map(ready).collect()
}

/// All joints: the couplings, a pin and a guide.
fn all() -> Vec<(&'static str, Joint)> {
    let pin = PairKind::Revolute { diameter: 0.0 };
    let guide = PairKind::Sliding {
        direction: -0.6,
        angle: 0.9,
        corners: [0.0; 2],
        half_height: 0.0,
    };
    let of_coupling = |(sample, joint): (Sample, Joint)| (sample.name, joint);
    let mut all: Vec<(&str, Joint)> = couplings().into_iter().map(of_coupling).collect();
    for (name, kind) in [("pin", pin), ("guide", guide)] {
        let pair = pair((0, [0.2, -0.1]), (1, [0.1, 0.3]), kind);
        all.push((name, Joint::of_pair(&pair)));
    }
    all
}

/// Of each row the derivatives by x, y and θ of each link: wrenches about the origin of its frame.
fn gradients<const K: usize>(joint: &Joint, links: &Links<K>) -> Vec<[[Series<K>; 3]; 3]> {
    let mut found = vec![[[Series::constant(0.0); 3]; 3]; joint.shape().rows.len()];
    joint.rows(links, |row, link, wrench| {
        let [moment, x, y] = wrench.moment_and_force_about(links.frame(link).at);
        for (sum, part) in found[row][link].iter_mut().zip([x, y, moment]) {
            *sum = *sum + part;
        }
    });
    found
}

fn errors<const K: usize>(joint: &Joint, links: &Links<K>) -> Vec<Series<K>> {
    let mut found = vec![Series::constant(f64::NAN); joint.shape().rows.len()];
    joint.errors(links, |row, error| found[row] = error);
    found
}

#[test]
fn the_rows_of_every_joint_are_the_gradients_of_its_errors() {
    let step = 1e-6;
    for (name, joint) in all() {
        let rows = gradients(&joint, &links::<1>());
        for (index, row) in rows.iter().enumerate() {
            assert!(row.iter().flatten().any(|entry| entry.value() != 0.0));
            for link in 0..3 {
                for unknown in 0..3 {
                    let error = |by: f64| errors(&joint, &moved(link, unknown, by))[index].value();
                    let slope = (error(step) - error(-step)) / (2.0 * step);
                    let found = row[link][unknown].value();
                    assert!((found - slope).abs() < 1e-8, "{name}: {found}, {slope}");
                }
            }
        }
    }
}

#[test]
fn rates_of_rows_are_those_of_the_errors_along_a_motion() {
    for (name, joint) in all() {
        let links = links::<3>();
        let rows = gradients(&joint, &links);
        for (row, error) in rows.iter().zip(errors(&joint, &links)) {
            // d/dt of the error is the power of the row, order by order.
            let mut power = [0.0; 2];
            for (own, motion) in row.iter().flatten().zip(links.0.iter().flatten()) {
                let rates = [motion.0[1], 2.0 * motion.0[2]];
                power[0] += own.0[0] * rates[0];
                power[1] += own.0[1] * rates[0] + own.0[0] * rates[1];
            }
            for (found, wanted) in power.into_iter().zip([error.0[1], 2.0 * error.0[2]]) {
                assert!((found - wanted).abs() < 1e-12, "{name}: {found}, {wanted}");
            }
        }
    }
}

#[test]
fn couplings_do_nothing_to_links_that_move_as_one() {
    for (Sample { name, .. }, joint) in couplings() {
        let mut sum = [0.0; 3];
        joint.rows(&links::<1>(), |_, _, wrench: Wrench<1>| {
            for (sum, part) in sum.iter_mut().zip(wrench.about_origin()) {
                *sum += part.value();
            }
        });
        assert!(sum.iter().all(|part| part.abs() < 1e-14), "{name}: {sum:?}");
    }
}

/// Velocities of the links at which pins and guides stay closed: the carrier turns about the origin,
/// the wheels against it at rates of their own, a rack along its guide.
fn powers(joint: &Joint, rates: [f64; 2], carried: Carried) -> [f64; 2] {
    // The carrier lies in the frame of the ground, its wheels on their axes.
    let at = |x: f64, y: f64, angle: f64| [x, y, angle].map(Series::constant);
    let links = Links::<1>([at(0.1, 0.0, 0.4), at(0.5, 0.1, -0.3), at(0.0, 0.0, 0.0)]);
    let axes = [[0.1, 0.0], [0.5, 0.1]];
    let turning = 0.7;
    let velocities: [[f64; 3]; 2] = [0, 1].map(|wheel| match carried {
        Carried::Sliding([u, v]) if wheel == 1 => [turning, rates[1] * u, rates[1] * v],
        _ => {
            let ([x, y], rate) = (axes[wheel], rates[wheel]);
            [turning + rate, rate * y, -rate * x]
        }
    });
    let mut row = 0.0;
    joint.rows(&links, |_, link, wrench| {
        let [moment, x, y] = wrench.about_origin().map(|part| part.value());
        let [w, u, v] = *velocities.get(link).unwrap_or(&[turning, 0.0, 0.0]);
        row += moment * w + x * u + y * v;
    });
    let mut forces = 0.0;
    for (act, [w, u, v]) in joint.acts(&links).iter().zip(velocities) {
        let ([x, y], [fx, fy]) = (act.at, act.force);
        forces += (x * fy - y * fx + act.couple) * w + fx * u + fy * v;
    }
    [row, forces]
}

#[test]
fn forces_on_wheels_are_the_row_turned_over_but_for_what_pins_carry() {
    for (Sample { name, carried, .. }, joint) in couplings() {
        let Some(carried) = carried else { continue };
        let [row, forces] = powers(&joint, [1.0, 0.0], carried);
        let ratio = forces / row;
        for rates in [[0.0, 1.0], [0.4, -1.3], [-2.0, 0.2]] {
            let [row, forces] = powers(&joint, rates, carried);
            assert!((forces - ratio * row).abs() < 1e-12, "{name}");
        }
    }
}
