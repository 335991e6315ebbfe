//! Cams behind several inputs: an eccentric circle as a rod, rollers on their pitch curves.

mod cases;

use super::examples::{self, input, pin};
use super::motion::at;
use super::{MultiLinkage, MultiMotion, moved, state};
use crate::kinematics::linkage::joints::cam::PitchCurve;
use crate::kinematics::linkage::kinetostatics::{ForceWorkspace as Space, Kinetostatics, Options};
use crate::kinematics::linkage::multi::spec::{InputCoordinate, MultiSpec};
use crate::kinematics::linkage::spec::{
    AssemblyChoice, AssemblySpec, CamPairSpec, CouplingKind, LinkSpec,
};
use crate::math::jet::Jet;
pub(super) use cases::all;
use cases::{GAP, eccentric};

/// The same with a rod without mass in place of the cam.
fn with_rod() -> MultiSpec {
    let mut spec = eccentric();
    let linkage = &mut spec.linkage;
    linkage.couplings.clear();
    linkage.links.push(LinkSpec {
        name: "rod".to_owned(),
        ..LinkSpec::default()
    });
    let rod = Some(3);
    linkage
        .pairs
        .push(pin("C", (Some(0), cases::CENTRE), (rod, [0.0; 2])));
    linkage
        .pairs
        .push(pin("R", (rod, [GAP, 0.0]), (Some(2), cases::ROLLER)));
    spec
}

/// What is told at inputs and rates, all of it that does not name the group.
fn told(linkage: &MultiLinkage, q: &[f64], rates: &[f64]) -> Vec<f64> {
    let mut space = linkage.workspace::<f64>();
    space.solve(q, rates).unwrap();
    space.reduce(true);
    let pose = space.pose(2);
    let mut all = vec![pose.x, pose.y, pose.cos, pose.sin];
    let mut first = vec![0.0; q.len()];
    for output in linkage.outputs() {
        all.extend(space.output(&output.kind, &mut first));
        all.extend(&first);
    }
    all.extend(&space.reduced.mass);
    all.extend(&space.reduced.force);
    all.extend(space.energies());
    all.extend(space.distance_from_singular(0, &mut first));
    all.extend(&first);
    all
}

#[test]
fn an_eccentric_circle_is_a_rod_of_constant_length() {
    let [cam, rod] = [eccentric(), with_rod()].map(|spec| MultiLinkage::new(spec).unwrap());
    let described = "link on a cam: lever (pair B, coupling cam)";
    assert_eq!(cam.structure().describe(1), described);
    assert_eq!(cam.structure().mobility, 2);
    for k in 0..60 {
        let k = f64::from(k);
        let (q, rates) = ([1.1 + 0.37 * k, 0.6 - 0.23 * k], [0.9 - 0.1 * k, 1.3]);
        let [one, other] = [&cam, &rod].map(|linkage| told(linkage, &q, &rates));
        for (one, other) in one.iter().zip(&other) {
            let size = other.abs().max(1.0);
            approx::assert_abs_diff_eq!(one / size, other / size, epsilon = 2e-12);
        }
    }
}

/// The force that presses on the lever and those of the drivers at many positions.
fn pressed(
    spec: &MultiSpec,
    force: &dyn Fn(&Kinetostatics, &MultiMotion, &Space) -> f64,
) -> Vec<f64> {
    let linkage = MultiLinkage::new(spec.clone()).unwrap();
    let mut motion = MultiMotion::new(&linkage);
    let solver = Kinetostatics::of_inputs(spec).unwrap();
    let mut w = solver.workspace();
    let starts: Vec<f64> = spec.inputs.iter().map(|input| input.start).collect();
    let mut all = Vec::new();
    for k in 0..40 {
        let inputs = at(&starts, 0.1 * f64::from(k));
        motion.set_inputs(&inputs).unwrap();
        let rates: Vec<f64> = inputs.iter().map(|input| input.first).collect();
        solver
            .solve_over_time(&motion, &rates, &Options::default(), &mut w)
            .unwrap();
        all.push(force(&solver, &motion, &w));
        all.extend(w.driver_forces());
    }
    all
}

#[test]
fn the_force_of_an_eccentric_circle_is_that_in_the_rod() {
    let cam = pressed(&eccentric(), &|solver, _, w| {
        solver.coupling_force(0, w).size
    });
    // What presses on the lever: away from the cam's centre, along the rod.
    let rod = pressed(&with_rod(), &|solver, motion, w| {
        let ([x, y], pose) = (solver.force(4, w), motion.pose(3));
        pose.cos * x + pose.sin * y
    });
    for (one, other) in cam.iter().zip(&rod) {
        let size = other.abs().max(1.0);
        approx::assert_abs_diff_eq!(one / size, other / size, epsilon = 1e-11);
    }
    assert!(cam.iter().step_by(3).any(|force| *force > 1.0), "{cam:?}");
}

/// At the start of scenarios/linkages/cam_with_adjusted_lever: accelerations, force and drives as
/// tests/reference/several_inputs.py has them, by a parameter of the pitch curve and multipliers.
#[test]
fn the_start_of_an_adjusted_lever_is_that_of_multipliers() {
    let spec = cases::adjusted();
    let linkage = MultiLinkage::new(spec.clone()).unwrap();
    let mut motion = MultiMotion::new(&linkage);
    let jet = |value, first, second| Jet {
        value,
        first,
        second,
        third: 0.0,
    };
    let [of_arm, of_cam] = [407.904_112_440_562_4, 506.898_110_393_548];
    let inputs = [jet(2.0, 0.0, of_arm), jet(0.5, 20.0, of_cam)];
    motion.set_inputs(&inputs).unwrap();
    let near = |found: f64, wanted: f64| {
        approx::assert_relative_eq!(found, wanted, max_relative = 1e-11);
    };
    let lever = motion.angle(2);
    near(lever.value, 2.744_763_569_774_158);
    near(lever.first, 1.134_008_034_681_137_6);
    near(lever.second, 32.939_938_710_234_266);
    let solver = Kinetostatics::of_inputs(&spec).unwrap();
    let mut w = solver.workspace();
    solver
        .solve_over_time(&motion, &[0.0, 20.0], &Options::default(), &mut w)
        .unwrap();
    near(solver.coupling_force(0, &w).size, 19.335_170_370_765_077);
    // Of the motors' torques what their own inertia leaves.
    near(w.driver_forces()[0], 2.0 - 0.004 * of_arm);
    near(
        w.driver_forces()[1],
        4.0 * (1.0 - 20.0 / 30.0) - 0.002 * of_cam,
    );
}

/// |p| − R(angle of p) of each cam at what was solved last, over its prime radius.
fn errors(spec: &MultiSpec, motion: &MultiMotion) -> Vec<f64> {
    let cams = spec.linkage.couplings.iter();
    cams.map(|coupling| {
        let CouplingKind::Cam(cam) = &coupling.kind else {
            unreachable!("only cams couple these links");
        };
        let place = |link: Option<usize>, point: [f64; 2]| match link {
            Some(link) => motion.pose(link).to_ground(point),
            None => point,
        };
        let [own, other] = coupling.wheels;
        let (centre, roller) = (place(own, cam.centre), place(other, cam.roller));
        let turned = own.map_or([1.0, 0.0], |link| {
            let pose = motion.pose(link);
            [pose.cos, pose.sin]
        });
        let [x, y] = [roller[0] - centre[0], roller[1] - centre[1]];
        let [cos, sin] = turned;
        let angle = (cos * y - sin * x).atan2(cos * x + sin * y);
        let curve = PitchCurve::new(cam).unwrap();
        (x.hypot(y) - curve.radius(angle).value) / cam.prime_radius()
    })
    .collect()
}

#[test]
fn rollers_stay_on_their_pitch_curves() {
    for spec in all() {
        let linkage = MultiLinkage::new(spec.clone()).unwrap();
        let mut motion = MultiMotion::new(&linkage);
        let starts: Vec<f64> = spec.inputs.iter().map(|input| input.start).collect();
        for k in -10..=10 {
            motion
                .set_inputs(&at(&starts, 0.015 * f64::from(k)))
                .unwrap();
            for error in errors(&spec, &motion) {
                assert!(error.abs() < 1e-14, "{k}: {error:e}");
            }
        }
    }
}

/// A position does not depend on the way to it: from far away as in small steps, and back again.
#[test]
fn far_positions_are_those_of_small_steps() {
    for spec in [eccentric(), cases::with_lift()] {
        let linkage = MultiLinkage::new(spec).unwrap();
        let [mut near, mut far] = [(); 2].map(|()| linkage.workspace::<f64>());
        let (from, to) = ([1.1, 0.6], [28.0, -17.3]);
        let still = [0.0; 2];
        for k in 0..=4000 {
            let along = [to[0] - from[0], to[1] - from[1]];
            near.solve(&moved(&from, &along, f64::from(k) / 4000.0), &still)
                .unwrap();
        }
        far.solve(&to, &still).unwrap();
        let [one, other] = [&near, &far].map(|space| space.pose(2));
        approx::assert_abs_diff_eq!(one.cos, other.cos, epsilon = 1e-13);
        approx::assert_abs_diff_eq!(one.sin, other.sin, epsilon = 1e-13);
    }
}

/// A link between a placed cam and a placed roller is held once more than it may be.
#[test]
fn a_cam_between_links_that_inputs_place_is_told() {
    let mut spec = eccentric();
    spec.linkage.couplings[0].wheels = [Some(0), Some(1)];
    spec.inputs
        .push(input("lever", InputCoordinate::Pair(2), 2.0));
    spec.linkage.assembly.clear();
    let faults = MultiLinkage::new(spec).unwrap_err();
    let told = |fault: &&crate::fault::Fault| fault.path == "couplings.cam";
    assert!(faults.iter().any(|fault| told(&fault)), "{faults:?}");
}

#[test]
fn profiles_are_refused_as_behind_one_input_and_undercuts_are_told() {
    let cam = |change: &dyn Fn(&mut CamPairSpec)| {
        let mut spec = cases::with_lift();
        if let CouplingKind::Cam(cam) = &mut spec.linkage.couplings[0].kind {
            change(cam);
        }
        MultiLinkage::new(spec)
    };
    let faults = cam(&|cam| cam.lift = Some(cases::sine(0.006, 2.5))).unwrap_err();
    assert_eq!(faults[0].path, "couplings.cam.cam.lift");
    assert!(faults[0].message.contains("does not repeat after a turn"));
    assert!(cam(&|_| ()).unwrap().remarks().is_empty());
    let sharp = cam(&|cam| cam.lift = Some(cases::sine(0.006, 30.0))).unwrap();
    let [remark] = <[String; 1]>::try_from(sharp.remarks()).unwrap();
    assert!(remark.contains("`cam` is undercut"), "{remark}");
}

/// Without a link placed by inputs alone beside it: the inputs that lack are proposed all the same.
#[test]
fn inputs_that_lack_are_proposed() {
    let mut spec = eccentric();
    spec.inputs.truncate(1);
    spec.linkage.assembly = vec![AssemblySpec {
        link: 2,
        choice: AssemblyChoice::Angle(2.9),
    }];
    let faults = MultiLinkage::new(spec).unwrap_err();
    let hint = &faults[0].hint;
    assert!(hint.contains("it would do with"), "{hint}");
}

/// The start of every example is regular and its cams are ready for derivatives.
#[test]
fn every_example_moves_with_each_of_its_inputs() {
    for spec in all() {
        let linkage = MultiLinkage::new(spec.clone()).unwrap();
        let (q, rates) = state(&spec);
        let mut space = linkage.workspace::<f64>();
        space.solve(&q, &rates).unwrap();
        let mut first = vec![0.0; q.len()];
        let output = &spec.linkage.outputs[0].kind;
        space.output(output, &mut first);
        assert!(first.iter().all(|first| first.abs() > 1e-4), "{first:?}");
    }
    assert!(all().len() >= 6 && examples::all().len() > all().len());
}
