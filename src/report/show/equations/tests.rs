use super::{Index, equations, inertia_side, latex, reflected, symbol, text};
use crate::dynamics::laws::LawInstance;
use crate::dynamics::model::{
    Coordinate, Law, LoadLaw, Model, Node, NodeMotion, ObjectPart, PartInput,
};
use crate::frontend::lower::lower;
use crate::frontend::scene::{BuiltIn, Document, Overrides};
use crate::kinematics::position::Position;
use crate::report::diagram::Diagram;
use crate::report::fixture;
use crate::report::math::{Expr, Symbol};
use crate::report::show::reduced;

/// The golden texts. `DAM_BLESS=1 cargo test --lib golden` writes them anew;
/// read them before committing.
#[test]
fn golden_texts_of_four_models() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("src/report/show/golden");
    let fan_out = equations(&fixture::fan_out());
    let found = [
        ("rocker_2.txt", text(&equations(&fixture::rocker(2)))),
        ("rocker_10.txt", text(&equations(&fixture::rocker(10)))),
        ("fan_out.txt", text(&fan_out)),
        ("fan_out.tex", latex(&fan_out)),
        ("modes.txt", text(&equations(&modes_behind_a_contact()))),
    ];
    for (name, found) in found {
        let path = folder.join(name);
        if std::env::var_os("DAM_BLESS").is_some() {
            std::fs::write(&path, &found).unwrap();
        }
        let expected = std::fs::read_to_string(&path).unwrap();
        assert_eq!(found, expected, "{name}, found:\n{found}");
    }
}

/// A lever of one mode behind a contact element, which carries a rigid and an elastic object
/// and a brake: its output is a sum.
fn modes_behind_a_contact() -> Model {
    let text = r#"{ "dam": 1, "name": "Modes", "objects": {
        "shaft": { "kind": "drive", "motion": { "speed": 60 } },
        "lever": { "kind": "rocker", "input": "shaft", "position": { "sine": { "amplitude": 0.1 } },
            "inertia": 0.01, "stiffness": 400, "damping_capacity": 0.2, "modes": 1,
            "pair": { "closure": "force", "contact": { "stiffness": 900 } },
            "loads": { "closing": { "constant": -6 }, "brake": { "viscous": 0.3 } } },
        "ram": { "kind": "slider", "input": "lever", "position": { "ratio": 0.2 },
            "inertia": 2, "masses": 0 },
        "arm": { "kind": "rocker", "input": "lever", "position": { "ratio": 2 },
            "inertia": 0.001, "stiffness": 100, "masses": 1 } },
        "run": { "duration": 1 } }"#;
    let document = Document::parse("modes.json", text.as_bytes()).unwrap();
    let reading = document.scene(&BuiltIn, &Overrides::none()).unwrap();
    lower(&reading.scene).unwrap()
}

#[test]
fn modes_behind_a_contact_are_called_so_and_leave_no_column_empty() {
    let model = modes_behind_a_contact();
    let boxes = Diagram::of(&model).boxes;
    let lever = boxes.iter().find(|one| one.id == "lever").unwrap();
    assert_eq!(lever.detail, "modes");
    let table = reduced::table(&model).text();
    let head = table.lines().next().unwrap();
    assert_eq!(head.trim(), "object  part    share of the output");
    assert_eq!(table.lines().count(), 4, "{table}");
}

#[test]
fn latex_is_balanced_for_every_kind_of_load() {
    let mut model = fixture::rocker(7);
    for law in [
        LoadLaw::viscous(2.0),
        LawInstance::linear_motor(3.0, 9.0).law(),
        LoadLaw::speed_table(vec![(0.0, 1.0), (3.0, 0.5)]),
    ] {
        for node in 2..5 {
            let name = format!("rocker.loads.a_{node}%");
            model.loads.push(crate::dynamics::model::Load {
                node,
                name,
                law: law.clone(),
            });
        }
    }
    let text = latex(&equations(&model));
    let count = |pattern: &str| text.matches(pattern).count();
    assert_eq!(count("{"), count("}"));
    assert_eq!(count(r"\left"), count(r"\right"));
    assert_eq!(count(r"\begin{"), count(r"\end{"));
    assert_eq!(count("$") % 2, 0);
    assert!(text.is_ascii(), "a letter without its command: {text}");
    assert!(text.contains(r"a\_2\%"));
}

/// Value of a formula, given the values of its symbols.
pub(super) fn value(expr: &Expr, of: &dyn Fn(&Symbol) -> f64) -> f64 {
    let all = |list: &[Expr]| list.iter().map(|e| value(e, of)).collect::<Vec<_>>();
    match expr {
        Expr::Number(number) | Expr::Angle(number) => *number,
        Expr::Symbol(symbol) => of(symbol),
        Expr::Sum(terms) => all(terms).iter().sum(),
        Expr::Negative(inner) => -value(inner, of),
        Expr::Product(factors) => all(factors).iter().product(),
        Expr::Quotient(top, bottom) => value(top, of) / value(bottom, of),
        Expr::Power(base, power) => value(base, of).powi(power.cast_signed()),
        Expr::Function("cos", argument) => value(argument, of).cos(),
        Expr::Function("sin", argument) => value(argument, of).sin(),
        other => panic!("{other:?}"),
    }
}

/// A rotor with a rigid object behind a rigid object.
fn rigid_chain() -> Model {
    let wave = |driver, amplitude, phase| Law {
        driver,
        position: Position::Sine {
            amplitude,
            harmonic: 1.0,
            phase,
            offset: 0.0,
        },
        lever: 1.0,
        track: None,
    };
    let motions = [
        NodeMotion::Rotor {
            angle: 0.0,
            speed: 0.0,
        },
        NodeMotion::Rigid {
            law: wave(0, 0.8, 0.3),
        },
        NodeMotion::Rigid {
            law: wave(1, 1.7, 0.9),
        },
    ];
    let mut model = Model::default();
    for (index, (motion, id)) in motions.into_iter().zip(["m", "a", "b"]).enumerate() {
        let inertia = [0.4, 0.7, 1.1][index];
        model.nodes.push(Node { inertia, motion });
        model.objects.push(ObjectPart {
            id: id.into(),
            kind: "rocker",
            coordinate: Coordinate::Turning,
            nodes: vec![index],
            inputs: PartInput::behind_one_driver(index.checked_sub(1)),
            combination: None,
            driven_end: None,
            links: vec![],
            contact: None,
            rigid_pair: None,
            pressing: None,
        });
    }
    model
}

#[test]
fn reflected_inertia_and_bias_follow_from_the_kinetic_energy() {
    let (phi, rate, acceleration) = (0.6, 1.3, -2.1);
    // T(φ, φ̇) = m(φ)·φ̇²/2 gives m·φ̈ + m′·φ̇²/2 (Lagrange).
    let a = |phi: f64| 0.8 * (phi + 0.3).sin();
    let b = |phi: f64| 1.7 * (a(phi) + 0.9).sin();
    let slope = |f: &dyn Fn(f64) -> f64, x: f64| (f(x + 1e-5) - f(x - 1e-5)) / 2e-5;
    let mass = |phi: f64| 0.4 + 0.7 * slope(&a, phi).powi(2) + 1.1 * slope(&b, phi).powi(2);
    let expected = mass(phi) * acceleration + slope(&mass, phi) * rate * rate / 2.0;

    let model = rigid_chain();
    let own = symbol("J", Index::None).expr();
    let side = inertia_side(own, &symbol("φ", Index::None), &reflected(&model, 0));
    let jet = |symbol: &Symbol| match &symbol.index {
        Index::Word(word) if word == "a" => (0.7, 0.8, phi + 0.3),
        Index::Word(_) => (1.1, 1.7, a(phi) + 0.9),
        _ => (0.4, 0.0, 0.0),
    };
    let found = value(&side, &|symbol| {
        let (inertia, amplitude, argument): (f64, f64, f64) = jet(symbol);
        match (symbol.letter, symbol.dots, symbol.primes) {
            ("J", ..) => inertia,
            ("φ", 1, _) => rate,
            ("φ", 2, _) => acceleration,
            ("U", _, 1) => amplitude * argument.cos(),
            ("U", _, 2) => -amplitude * argument.sin(),
            _ => panic!("{symbol:?}"),
        }
    });
    approx::assert_relative_eq!(found, expected, max_relative = 1e-5);
}
