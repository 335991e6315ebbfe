//! Probe.
use dam::analysis::run::{RunResult, run};
use dam::analysis::{Control, RunSettings};
use dam::integrate::Method;
use dam::scene::{BuiltIn, Document, Overrides};
use dam::system::System;

fn solve(objects: &str, duration: f64, method: Method, tolerance: f64, step: Option<f64>) -> RunResult {
    let text = format!(r#"{{"dam":1,"name":"x","objects":{{{objects}}},"run":{{"duration":{duration},"start":"on_law"}}}}"#);
    let doc = Document::parse("t", text.as_bytes()).unwrap_or_else(|e| panic!("{e:?}"));
    let scene = doc.scene(&BuiltIn, &Overrides::none()).unwrap_or_else(|e| panic!("{e:?}")).scene;
    let system = System::new(dam::lower::lower(&scene).unwrap()).unwrap();
    let mut settings = RunSettings::of(&scene).unwrap();
    settings.method = Some(method);
    settings.tolerance = tolerance;
    settings.step = step;
    settings.samples = 100;
    let control = Control { wall_clock: Some(std::time::Duration::from_secs(20)), interrupt: None };
    run(&system, &settings, &control, &mut []).unwrap()
}

#[test]
fn probe() {
    let edge = 0.8f64.asin();
    println!("edge {} {}", edge, edge / 2.0);
    let ram = |rest: &str| format!(r#""ram":{{"kind":"slider","input":"d","position":{{"slider_crank":{{"crank":0.25,"rod":0.2}}}},{rest}}}"#);
    let given = r#""d":{"kind":"drive","motion":{"speed":2}},"#;
    let motor = r#""d":{"kind":"drive","motor":{"inertia":0.1,"speed":5,"torque":{"constant":3}}},"#;
    let rigid = r#""inertia":1,"masses":0"#;
    let elastic = r#""inertia":1,"stiffness":1e5,"masses":1"#;
    let damped = r#""inertia":1,"stiffness":1e5,"masses":2,"damping_capacity":0.4"#;
    let lever = r#""d":{"kind":"drive","motion":{"speed":2}},"l":{"kind":"rocker","input":"d","position":{"ratio":1},"inertia":0.1,"stiffness":1e4,"masses":1},"#;
    let cases = [
        ("given rigid", format!("{given}{}", ram(rigid))),
        ("given elastic", format!("{given}{}", ram(elastic))),
        ("given damped", format!("{given}{}", ram(damped))),
        ("motor rigid", format!("{motor}{}", ram(rigid))),
        ("motor elastic", format!("{motor}{}", ram(elastic))),
        ("motor damped", format!("{motor}{}", ram(damped))),
        ("lever rigid", format!("{lever}{}", ram(rigid).replace(r#""input":"d""#, r#""input":"l""#))),
    ];
    let only = std::env::var("CASE").unwrap_or_default();
    for (name, objects) in cases.iter().filter(|c| c.0.contains(&only)) {
        for method in Method::ALL {
            let begun = std::time::Instant::now();
            let r = solve(objects, std::env::var("DUR").map_or(1.0, |d| d.parse().unwrap()), method, 1e-8, (method == Method::Rk4).then_some(1e-4));
            let s = r.outcome.statistics;
            println!("{name} {method}: {:.15} {:?} {:?} trusted {} energy {:.1e} steps {} rej {} ev {} peak {:e} rows {} {:?} in {:?}",
                r.outcome.time, r.figures.run.stopped, r.figures.run.stopped_because.as_ref().map(|s| s.len()), r.is_trusted(), r.audit.error(), s.steps, s.rejected, s.evaluations,
                r.figures.objects["ram"].peak_speed, r.record.times.len(), r.record.times.last(), begun.elapsed());
            if r.figures.run.stopped.as_deref() != Some("dead_position") { println!("   {:?}", r.outcome.stop); }
        }
    }
}
