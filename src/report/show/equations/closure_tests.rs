//! The closing equations hold at positions that are solved for.

use super::tests::value;
use super::{Section, equations};
use crate::dynamics::model::{LinkageBody, Model, MultiLinkageBody};
use crate::frontend::lower::lower;
use crate::frontend::scene::{BuiltIn, Document, Overrides};
use crate::kinematics::linkage::multi::MultiMotion;
use crate::kinematics::linkage::spec::LinkageSpec;
use crate::math::jet::Jet;
use crate::report::math::{Expr, Index, Symbol};
use std::f64::consts::TAU;
use std::path::Path;

/// Rounding of positions, as a share of the terms.
const ROUNDING: f64 = 1e-10;

/// Coordinates of a position.
struct Position<'p> {
    spec: &'p LinkageSpec,
    angle: &'p dyn Fn(usize) -> f64,
    origin: &'p dyn Fn(usize) -> [f64; 2],
    pair: &'p dyn Fn(usize) -> f64,
    /// Values of the inputs, by the words of their symbols.
    inputs: &'p dyn Fn(&str) -> f64,
}

impl Position<'_> {
    fn of(&self, section: &Section, symbol: &Symbol) -> f64 {
        let Index::Word(word) = &symbol.index else {
            panic!("{symbol:?}");
        };
        let link = || {
            self.spec
                .links
                .iter()
                .position(|link| link.name == *word)
                .unwrap()
        };
        match symbol.letter {
            "θ" => (self.angle)(link()),
            "x" => (self.origin)(link())[0],
            "y" => (self.origin)(link())[1],
            "s" => {
                let pair = self.spec.pairs.iter().position(|pair| pair.name == *word);
                (self.pair)(pair.unwrap())
            }
            "l" => {
                let wanted = symbol.clone().expr();
                let entry = section.legend.iter().find(|entry| entry.symbol == wanted);
                entry
                    .unwrap_or_else(|| panic!("no legend of {symbol:?}"))
                    .values[0]
            }
            "φ" | "q" => (self.inputs)(word),
            letter => panic!("{letter}"),
        }
    }

    /// Checks every closing equation of a section; how many loops there were.
    fn check(&self, section: &Section, what: &str) -> usize {
        let mut loops = 0;
        for line in &section.lines {
            let of = |symbol: &Symbol| self.of(section, symbol);
            let is_loop = line.left == Expr::Number(0.0);
            let is_angle = matches!(&line.left, Expr::Symbol(left) if ["θ", "q"].contains(&left.letter))
                || line.remark == "the input"
                || ["gears", "belt", "rack"]
                    .iter()
                    .any(|kind| line.remark.starts_with(kind));
            if !is_loop && !is_angle {
                continue;
            }
            let terms = match &line.right {
                Expr::Sum(terms) => terms.clone(),
                one => vec![one.clone()],
            };
            let size = terms
                .iter()
                .map(|term| value(term, &of).abs())
                .fold(1e-3, f64::max);
            let defect = value(&line.left, &of) - value(&line.right, &of);
            // An angle is known up to turns.
            let defect = match is_loop {
                true => defect,
                false => defect
                    .abs()
                    .min((defect - (defect / TAU).round() * TAU).abs()),
            };
            let text = || format!("{} = {}", line.left.unicode(), line.right.unicode());
            assert!(
                defect.abs() <= ROUNDING * size,
                "{what}: {}: {defect:e}",
                text()
            );
            loops += usize::from(is_loop);
        }
        loops
    }
}

fn model_of(path: &Path) -> Option<Model> {
    let name = path.display().to_string();
    let document = Document::parse(&name, &std::fs::read(path).ok()?).ok()?;
    let reading = document.scene(&BuiltIn, &Overrides::none()).ok()?;
    lower(&reading.scene).ok()
}

fn one_input(model: &Model, body: &LinkageBody, section: &Section, what: &str) -> usize {
    let linkage = &body.linkage;
    let start = linkage.spec().start;
    let mut workspace = linkage.workspace();
    let mut loops = 0;
    for step in [-0.3, -0.11, 0.0, 0.07, 0.4, 1.3, 2.9] {
        let slides = linkage.spec().pairs[linkage.spec().driver].slides();
        let input = start
            + step
                * if slides {
                    0.05 * linkage.typical_length()
                } else {
                    1.0
                };
        if linkage.solve(input, 0, &mut workspace).is_err() {
            continue;
        }
        let id = &model.objects[body.object].id;
        let position = Position {
            spec: linkage.spec(),
            angle: &|link| workspace.angle(link),
            origin: &|link| {
                let pose = workspace.pose(link);
                [pose.x, pose.y]
            },
            pair: &|pair| workspace.pair(pair).value,
            inputs: &|word| {
                assert_eq!(word, id);
                input
            },
        };
        loops += position.check(section, &format!("{what} at {input}"));
    }
    loops
}

fn several_inputs(body: &MultiLinkageBody, section: &Section, what: &str) -> usize {
    let linkage = &body.linkage;
    let mut motion = MultiMotion::new(linkage);
    let mut loops = 0;
    for step in [0.0, 0.02, 0.05, -0.03, 0.5] {
        let inputs = linkage.inputs().iter().enumerate().map(|(k, input)| Jet {
            value: input.start + step * (1.0 + 0.3 * k as f64) * 0.1,
            ..Jet::default()
        });
        let inputs: Vec<Jet> = inputs.collect();
        if motion.set_inputs(&inputs).is_err() {
            continue;
        }
        let position = Position {
            spec: &linkage.spec().linkage,
            angle: &|link| motion.angle(link).value,
            origin: &|link| {
                let pose = motion.pose(link);
                [pose.x, pose.y]
            },
            pair: &|pair| motion.pair(pair).value,
            inputs: &|word| {
                let index = linkage.inputs().iter().position(|input| input.name == word);
                inputs[index.unwrap()].value
            },
        };
        loops += position.check(section, &format!("{what} at step {step}"));
    }
    loops
}

#[test]
fn closing_equations_hold_in_every_scenario_with_a_linkage() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("scenarios");
    let folders = std::fs::read_dir(root).unwrap().filter_map(Result::ok);
    let folders = folders.filter(|folder| folder.path().is_dir());
    let scenes = folders.flat_map(|folder| std::fs::read_dir(folder.path()).unwrap());
    let (mut of_one, mut of_several) = (0, 0);
    for scene in scenes.map(|entry| entry.unwrap().path()) {
        let Some(model) = model_of(&scene) else {
            continue;
        };
        let what = scene.file_name().unwrap().to_string_lossy().into_owned();
        let all = equations(&model).sections;
        let section = |object: usize| {
            let id = &model.objects[object].id;
            all.iter().find(|one| one.object == *id).unwrap()
        };
        for body in &model.linkages {
            of_one += one_input(&model, body, section(body.object), &what);
        }
        for body in &model.multi_linkages {
            of_several += several_inputs(body, section(body.object), &what);
        }
    }
    assert!(of_one > 200, "{of_one}");
    assert!(of_several >= 24, "{of_several}");
}

#[test]
fn the_loop_of_a_slider_crank_is_that_of_the_textbook() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let model = model_of(&root.join("scenarios/kinetostatics/slider_crank.json")).unwrap();
    let section = &equations(&model).sections;
    let lines: Vec<String> = (section.iter().flat_map(|one| &one.lines))
        .filter(|line| line.left == Expr::Number(0.0))
        .map(|line| line.right.unicode())
        .collect();
    let wanted = [
        "l_crank·cos(θ_crank) + l_rod·cos(θ_rod) − s_P03",
        "l_crank·sin(θ_crank) + l_rod·sin(θ_rod)",
    ];
    assert_eq!(lines, wanted);
}
