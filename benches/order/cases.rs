//! Scenes with random parameters, of all the regimes that an elastic object may be in.

/// Seed of the parameters.
pub(crate) const SEED: u64 = 20_261_122;
/// Scenes of each regime.
pub(crate) const OF_EACH: usize = 4;

/// A scene, and the figures that are asked of it.
pub(crate) struct Case {
    pub(crate) regime: &'static str,
    pub(crate) number: usize,
    /// Lumping of the long chains that it is held against: balanced, where no pair may open.
    pub(crate) lumping: &'static str,
    /// The objects whose masses are to be chosen.
    pub(crate) elastic: &'static [&'static str],
    pub(crate) figures: &'static [&'static str],
    /// The scene; `@id` stands for how much of an elastic object is modelled.
    text: String,
}

impl Case {
    /// The scene with the level of every elastic object given by the same properties.
    pub(crate) fn scene(&self, level: &str) -> String {
        let one = |text: String, id: &&str| text.replace(&format!("@{id}"), level);
        self.elastic.iter().fold(self.text.clone(), one)
    }
}

/// Parameters: SplitMix64, the same on every machine.
struct Parameters(u64);

impl Parameters {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    fn between(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * self.unit()
    }
}

/// All cases.
pub(crate) fn cases() -> Vec<Case> {
    type Make = fn(&mut Parameters) -> String;
    type Regime = (
        &'static str,
        &'static [&'static str],
        &'static [&'static str],
        Make,
    );
    let regimes: [Regime; 8] = [
        ("rise", &["one"], &["one.delta_abs", "one.sigma"], rise),
        (
            "harmonic",
            &["one"],
            &["one.delta_abs", "one.peak_speed"],
            harmonic,
        ),
        (
            "two in a row",
            &["one", "two"],
            &["one.delta_abs", "two.delta_abs"],
            two,
        ),
        (
            "held by a force",
            &["one"],
            &["one.delta_abs", "one.sigma"],
            held,
        ),
        (
            "contact that opens",
            &["one"],
            &["one.delta_abs", "one.pair.max_contact_force"],
            contact,
        ),
        ("gap", &["one"], &["one.delta_abs", "one.peak_speed"], gap),
        (
            "motor",
            &["one"],
            &["one.delta_abs", "motor.peak_speed"],
            motor,
        ),
        (
            "work",
            &["one"],
            &["one.delta_abs", "one.peak_reaction"],
            work,
        ),
    ];
    let mut parameters = Parameters(SEED);
    let mut all = Vec::new();
    for (regime, elastic, figures, make) in regimes {
        for number in 1..=OF_EACH {
            let text = make(&mut parameters);
            let opens = ["held by a force", "contact that opens", "gap"].contains(&regime);
            all.push(Case {
                lumping: if opens { "ends" } else { "balanced" },
                regime,
                number,
                elastic,
                figures,
                text,
            });
        }
    }
    all
}

fn whole(objects: &str, run: &str) -> String {
    format!(
        r#"{{ "dam": 1, "name": "Order", "objects": {{ {objects} }}, "run": {{ "samples": 10, {run} }} }}"#
    )
}

fn drive(speed: f64) -> String {
    format!(r#""drive": {{ "kind": "drive", "motion": {{ "speed": {speed} }} }}"#)
}

/// A slider or a lever in a rise of 1.5 to 15 of its longest periods.
fn rise(p: &mut Parameters) -> String {
    let ratio = p.between(1.5, 15.0);
    let (kind, period) = match p.unit() < 0.5 {
        true => ("slider", 4.0),
        false => ("rocker", std::f64::consts::TAU / 1.222_260_057),
    };
    let capacity = p.between(0.0, 0.6);
    let duration = ratio * period;
    let angle = 0.05 * duration;
    let object = format!(
        r#""one": {{ "kind": "{kind}", "input": "drive", "inertia": 1, "stiffness": 1, "damping_capacity": {capacity}, @one,
            "position": {{ "cam": {{ "lift": 1, "rise": {angle}, "return": 1, "law": "cycloidal" }} }} }}"#
    );
    let run = format!(r#""duration": {duration}, "start": "on_law""#);
    whole(&format!("{}, {object}", drive(0.05)), &run)
}

/// A lever that swings at 0.05 to 0.8 of its first natural frequency.
fn harmonic(p: &mut Parameters) -> String {
    let omega = 1.222_260_057 * p.between(0.05, 0.8);
    let capacity = p.between(0.2, 0.8);
    let duration = 6.0 * std::f64::consts::TAU / omega;
    let object = format!(
        r#""one": {{ "kind": "rocker", "input": "drive", "inertia": 1, "stiffness": 1, "damping_capacity": {capacity}, @one,
            "position": {{ "sine": {{ "amplitude": 0.2 }} }} }}"#
    );
    whole(
        &format!("{}, {object}", drive(omega)),
        &format!(r#""duration": {duration}"#),
    )
}

/// An elastic shaft with an elastic slider on it.
fn two(p: &mut Parameters) -> String {
    let speed = p.between(0.1, 0.4);
    let (inertia, stiffness) = (p.between(0.2, 1.0), p.between(2.0, 10.0));
    let capacity = p.between(0.2, 0.6);
    let objects = format!(
        r#"{}, "one": {{ "kind": "shaft", "input": "drive", "inertia": {inertia}, "stiffness": {stiffness}, "damping_capacity": {capacity}, @one }},
        "two": {{ "kind": "slider", "input": "one", "inertia": 1, "stiffness": 1, "damping_capacity": {capacity}, @two,
            "position": {{ "sine": {{ "amplitude": 0.3 }} }} }}"#,
        drive(speed)
    );
    let duration = 3.0 * std::f64::consts::TAU / speed;
    whole(&objects, &format!(r#""duration": {duration}"#))
}

/// A lever that a closing force holds to its law.
fn held(p: &mut Parameters) -> String {
    let omega = 1.222_260_057 * p.between(0.05, 0.4);
    let force = p.between(-2.0, -1.0);
    let object = format!(
        r#""one": {{ "kind": "rocker", "input": "drive", "inertia": 1, "stiffness": 1, "damping_capacity": 0.4, @one,
            "position": {{ "sine": {{ "amplitude": 0.2 }} }}, "pair": {{ "closure": "force" }},
            "loads": {{ "closing": {{ "constant": {force} }} }} }}"#
    );
    let duration = 4.0 * std::f64::consts::TAU / omega;
    whole(
        &format!("{}, {object}", drive(omega)),
        &format!(r#""duration": {duration}, "start": "static""#),
    )
}

/// A slider whose contact opens and closes.
fn contact(p: &mut Parameters) -> String {
    let omega = p.between(0.25, 0.6);
    let stiffness = p.between(2.0, 20.0);
    let force = -omega * omega * p.between(0.3, 0.7);
    let object = format!(
        r#""one": {{ "kind": "slider", "input": "drive", "inertia": 1, "stiffness": 1, "damping_capacity": 0.4, @one,
            "position": {{ "sine": {{ "amplitude": 1 }} }},
            "pair": {{ "closure": "force", "contact": {{ "law": "elastic", "stiffness": {stiffness} }} }},
            "loads": {{ "closing": {{ "constant": {force} }} }} }}"#
    );
    let duration = 1.5 * std::f64::consts::TAU / omega;
    whole(
        &format!("{}, {object}", drive(omega)),
        &format!(r#""duration": {duration}, "start": "static""#),
    )
}

/// A lever behind a pair with a gap.
fn gap(p: &mut Parameters) -> String {
    let omega = 1.222_260_057 * p.between(0.1, 0.4);
    let gap = p.between(0.002, 0.02);
    let object = format!(
        r#""one": {{ "kind": "rocker", "input": "drive", "inertia": 1, "stiffness": 1, "damping_capacity": 0.8, @one,
            "position": {{ "sine": {{ "amplitude": 0.2 }} }}, "pair": {{ "closure": "form", "gap": {gap} }} }}"#
    );
    let duration = 1.5 * std::f64::consts::TAU / omega;
    whole(
        &format!("{}, {object}", drive(omega)),
        &format!(r#""duration": {duration}"#),
    )
}

/// An elastic shaft that a motor runs up.
fn motor(p: &mut Parameters) -> String {
    let (stall, stiffness) = (p.between(5.0, 20.0), p.between(50.0, 500.0));
    let objects = format!(
        r#""motor": {{ "kind": "drive", "motor": {{ "inertia": 0.5, "torque": {{ "linear": {{ "stall_torque": {stall}, "no_load_speed": 20 }} }} }} }},
        "one": {{ "kind": "shaft", "input": "motor", "inertia": 1, "stiffness": {stiffness}, "damping_capacity": 0.4, @one,
            "loads": {{ "brake": {{ "viscous": 0.2 }} }} }}"#
    );
    whole(&objects, r#""duration": 3"#)
}

/// A slider that does work over a part of its stroke.
fn work(p: &mut Parameters) -> String {
    let omega = p.between(0.1, 0.35);
    let (from, width, force) = (
        p.between(0.3, 0.8),
        p.between(0.5, 1.5),
        p.between(-0.1, -0.02),
    );
    let to = from + width;
    let object = format!(
        r#""one": {{ "kind": "slider", "input": "drive", "inertia": 1, "stiffness": 1, "damping_capacity": 0.5, @one,
            "position": {{ "sine": {{ "amplitude": 0.3 }} }},
            "loads": {{ "work": {{ "window": {{ "from": {from}, "to": {to}, "force": {force} }} }} }} }}"#
    );
    let duration = 3.0 * std::f64::consts::TAU / omega;
    whole(
        &format!("{}, {object}", drive(omega)),
        &format!(r#""duration": {duration}"#),
    )
}
