//! The scenes of the group `joint_friction`, one by one.

use dam::lower::lower;
use dam::scene::{BuiltIn, Document, Overrides};
use dam::studies::expectations::check;
use dam::studies::run::run;
use dam::studies::{Control, RunSettings};
use dam::system::System;

#[test]
fn they_keep_what_they_expect() {
    for name in [
        "press_runs_out",
        "stick_slip",
        "jamming_block",
        "arm_comes_to_rest",
    ] {
        let path = format!(
            "{}/scenarios/joint_friction/{name}.json",
            env!("CARGO_MANIFEST_DIR")
        );
        let bytes = std::fs::read(&path).expect("a scene");
        let document = Document::parse(name, &bytes).expect("JSON");
        let scene = match document.scene(&BuiltIn, &Overrides::none()) {
            Ok(reading) => reading.scene,
            Err(faults) => panic!("{}", faults.render(false)),
        };
        let system = System::new(lower(&scene).expect("a model")).expect("a system");
        let settings = RunSettings::of(&scene).expect("settings");
        let found = run(&system, &settings, &Control::default(), &mut []).expect("a run");
        let failed: Vec<String> = check(&scene.expect, &found)
            .into_iter()
            .filter(|verdict| !verdict.holds)
            .map(|verdict| verdict.message)
            .collect();
        assert!(
            failed.is_empty() && found.is_trusted(),
            "{name}: {failed:?}"
        );
    }
}
