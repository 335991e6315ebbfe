//! What the tests of linkages share.

use super::examples::Builder;
use crate::kinematics::cam::Surface;
use crate::kinematics::linkage::joints::{belt::Belt, gear::Gear};
use crate::kinematics::linkage::kinetostatics::{InputMotion, Kinetostatics, Options};
use crate::kinematics::linkage::spec::{CamPairSpec, CouplingKind, LinkageSpec, PairKind, PointOf};
use crate::kinematics::linkage::{Linkage, Reach, Workspace};
use crate::kinematics::position::{Position, PositionSpec};
use proptest::prelude::*;

pub(super) fn close(a: f64, b: f64, relative: f64, absolute: f64) -> bool {
    (a - b).abs() <= relative * a.abs().max(b.abs()) + absolute
}

/// The input at a part of the reach, or of a turn.
pub(super) fn interior(linkage: &Linkage, part: f64) -> f64 {
    let range = linkage.range();
    match &range.reach {
        Reach::Everywhere => range.start + 20.0 * (part - 0.5),
        Reach::Interval { lower, upper } => lower.at + part * (upper.at - lower.at),
    }
}

impl Workspace {
    /// The largest coordinate of a link's origin.
    pub(super) fn farthest(&self) -> f64 {
        let links = 0..self.core().spec.links.len();
        let far = links.map(|link| self.pose(link).x.hypot(self.pose(link).y));
        far.fold(0.0, f64::max)
    }

    /// The largest of all positions and transfer functions.
    pub(super) fn largest(&self) -> f64 {
        let mut most = self.farthest();
        for link in 0..self.core().spec.links.len() {
            for k in 1..=self.order() {
                for value in self.transfer(link, k) {
                    most = most.max(value.abs());
                }
            }
        }
        most
    }
}

/// The greatest error of any pair, from the poses and the plain numbers alone.
pub(super) fn closure_error(linkage: &Linkage, workspace: &Workspace) -> f64 {
    let place = |point: &PointOf| match point.link {
        Some(link) => workspace.pose(link).to_ground(point.at),
        None => point.at,
    };
    let direction = |link: Option<usize>| match link {
        Some(link) => {
            let pose = workspace.pose(link);
            pose.sin.atan2(pose.cos)
        }
        None => 0.0,
    };
    let mut most = 0.0f64;
    for link in 0..linkage.spec().links.len() {
        let pose = workspace.pose(link);
        most = most.max((pose.cos.hypot(pose.sin) - 1.0).abs());
    }
    for (index, pair) in linkage.spec().pairs.iter().enumerate() {
        let (on, to) = (place(&pair.on), place(&pair.link));
        let (dx, dy) = (to[0] - on[0], to[1] - on[1]);
        most = most.max(match pair.kind {
            PairKind::Revolute { .. } => dx.hypot(dy),
            PairKind::Sliding {
                direction: psi,
                angle,
                ..
            } => {
                let guide = direction(pair.on.link) + psi;
                let tilt = (direction(pair.link.link) - guide - angle).sin().abs();
                (dy * guide.cos() - dx * guide.sin()).abs().max(tilt)
            }
        });
        if index == linkage.spec().driver {
            most = most.max((workspace.pair(index).value - workspace.input()).abs());
        }
    }
    for coupling in &linkage.spec().couplings {
        let angle = |link: Option<usize>| link.map_or(0.0, |link| workspace.angle(link));
        let [one, other] = coupling.wheels;
        if let CouplingKind::Cam(cam) = &coupling.kind {
            let of = |link, at| place(&PointOf { link, at });
            most = most.max(off_the_pitch_curve(
                cam,
                direction(one),
                [of(one, cam.centre), of(other, cam.roller)],
            ));
            continue;
        }
        let ratio = match coupling.kind {
            CouplingKind::Gear(Gear { ratio }) => ratio,
            CouplingKind::Belt(Belt { radii: [r1, r2] }) => r1 / r2,
            _ => continue,
        };
        let first = ratio * (angle(one) - angle(coupling.carrier));
        let second = angle(other) - angle(coupling.carrier);
        most = most.max((second - first - coupling.offset).abs());
    }
    most
}

/// How far a roller is from its pitch curve, radially.
fn off_the_pitch_curve(cam: &CamPairSpec, turned: f64, [centre, roller]: [[f64; 2]; 2]) -> f64 {
    let [x, y] = [roller[0] - centre[0], roller[1] - centre[1]];
    let phi = cam.sense * (y.atan2(x) - turned - cam.direction);
    let lift = cam.lift.as_ref().map_or(0.0, |lift| {
        let law = Position::new(lift).unwrap();
        law.jet(law.breaks().segment_at(phi, 1.0), phi).value
    });
    let prime = match cam.surface {
        Surface::Hollow => cam.base_radius - cam.roller_radius,
        _ => cam.base_radius + cam.roller_radius,
    };
    (x.hypot(y) - prime - lift).abs()
}

/// All that has derivatives: poses, angles, pairs, outputs, energies.
fn everything(linkage: &Linkage, q: f64, workspace: &mut Workspace) -> Option<Vec<[f64; 4]>> {
    linkage.solve(q, 3, workspace).ok()?;
    let mut all = Vec::new();
    for link in 0..linkage.spec().links.len() {
        let pose = workspace.pose(link);
        let t = [1, 2, 3].map(|k| workspace.transfer(link, k));
        for (axis, value) in [pose.x, pose.y, workspace.angle(link)]
            .into_iter()
            .enumerate()
        {
            all.push([value, t[0][axis], t[1][axis], t[2][axis]]);
        }
        let at = PointOf {
            link: Some(link),
            at: [0.3, -0.4],
        };
        for jet in workspace.point(at) {
            all.push([jet.value, jet.first, jet.second, jet.third]);
        }
    }
    for pair in 0..linkage.spec().pairs.len() {
        let jet = workspace.pair(pair);
        all.push([jet.value, jet.first, jet.second, jet.third]);
    }
    let r = linkage.reduced_linkage(workspace);
    let unknown = f64::NAN;
    all.push([r.inertia[0], r.inertia[1], r.inertia[2], unknown]);
    all.push([r.potential[0], r.potential[1], r.potential[2], unknown]);
    all.push([r.force[0], r.force[1], unknown, unknown]);
    all.push([r.damping[0], r.damping[1], unknown, unknown]);
    Some(all)
}

/// Every derivative against the difference of sixth order of the one before.
pub(super) fn compare_with_differences(linkage: &Linkage, q: f64) -> Result<(), TestCaseError> {
    let mut workspace = linkage.workspace();
    let sizes: Vec<f64> = [4.0, 1.0]
        .iter()
        .map(|factor| factor * 2e-4 * linkage.core.plan.size)
        .collect();
    let mut differences: Vec<Vec<[f64; 4]>> = Vec::new();
    for &h in &sizes {
        let mut sum: Vec<[f64; 4]> = Vec::new();
        for (k, weight) in [(1.0, 45.0), (2.0, -9.0), (3.0, 1.0)] {
            let (Some(up), Some(down)) = (
                everything(linkage, q + k * h, &mut workspace),
                everything(linkage, q - k * h, &mut workspace),
            ) else {
                return Ok(());
            };
            sum.resize(up.len(), [0.0; 4]);
            for (sum, (up, down)) in sum.iter_mut().zip(up.iter().zip(&down)) {
                for i in 0..4 {
                    sum[i] += weight * (up[i] - down[i]) / (60.0 * h);
                }
            }
        }
        differences.push(sum);
    }
    let Some(exact) = everything(linkage, q, &mut workspace) else {
        return Ok(());
    };
    for (row, exact) in exact.iter().enumerate() {
        let size = exact
            .iter()
            .filter(|x| x.is_finite())
            .fold(1.0f64, |m, x| m.max(x.abs()));
        for order in 0..3 {
            let (coarse, fine) = (differences[0][row][order], differences[1][row][order]);
            // Where the two differences do not agree they tell nothing.
            if !((coarse - fine).abs() <= 1e-5 * size) || exact[order + 1].is_nan() {
                continue;
            }
            prop_assert!(
                (fine - exact[order + 1]).abs() <= 2e-7 * size,
                "quantity {row}, derivative {}: {}, difference {fine}",
                order + 1,
                exact[order + 1]
            );
        }
    }
    Ok(())
}

pub(super) fn linkage(builder: Builder) -> Linkage {
    Linkage::new(weighed(builder).0).unwrap_or_else(|faults| panic!("{faults:?}"))
}

/// Every link with mass, a centre beside its axis and a moment, so that no zero hides anything.
pub(super) fn weighed(mut builder: Builder) -> Builder {
    for link in 0..builder.0.links.len() {
        let k = link as f64;
        builder = builder.mass(link, 1.0 + 0.3 * k, [0.02 * k, 0.03], 0.01 + 0.004 * k);
    }
    builder.0.gravity = [0.0, -9.80665];
    builder
}

pub(super) fn solved(linkage: &Linkage, q: f64) -> Workspace {
    let mut workspace = linkage.workspace();
    let found = linkage.solve(q, 3, &mut workspace);
    found.unwrap_or_else(|out| panic!("{q}: {out}"));
    workspace
}

/// The driving force is that of virtual power, powers and influence coefficients close, and the
/// frame is in equilibrium.
pub(super) fn check_driving_force(name: &str, spec: LinkageSpec) {
    let linkage = Linkage::new(spec).unwrap();
    let solver = Kinetostatics::new(linkage.spec()).unwrap();
    let mut w = solver.workspace();
    for k in 0..12 {
        let coordinate = interior(&linkage, 0.03 + f64::from(k) / 13.0);
        let (speed, acceleration) = (1.7, -2.3);
        let motion = InputMotion {
            coordinate,
            speed,
            acceleration,
        };
        let at = solved(&linkage, coordinate);
        let options = Options::default();
        solver.solve(&at, motion, &options, &mut w).unwrap();
        let reduced = linkage.reduced_linkage(&at);
        let wanted = reduced.inertia[0] * acceleration
            + 0.5 * reduced.inertia[1] * speed * speed
            + reduced.potential[1];
        let drive = w.driver_force();
        assert!(
            close(drive, wanted, 1e-11, 1e-11),
            "{name}: {drive} {wanted}"
        );
        assert!(solver.balance(&w).residual < 1e-11, "{name}");
        assert!(solver.influence_error(&mut w) < 1e-11, "{name}");
        let (frame, shaking) = (solver.on_frame(&w), solver.shaking(&w));
        let applied = solver.applied(&w);
        for axis in 0..3 {
            let off = frame[axis] - shaking[axis] - applied[axis];
            assert!(off.abs() < 1e-9, "{name}: axis {axis} off by {off}");
        }
    }
}

/// A lift over a turn by a table.
pub(in crate::kinematics::linkage) fn lift_table() -> PositionSpec {
    let points = [0.0, 0.002, 0.007, 0.009, 0.006, 0.001, 0.0];
    let step = std::f64::consts::TAU / 6.0;
    let points = points.into_iter().enumerate();
    PositionSpec::Table {
        points: points.map(|(k, lift)| (step * k as f64, lift)).collect(),
        periodic: true,
        end_slopes: (0.0, 0.0),
    }
}
