//! Moving pictures of the scenes that are built in, for the first page: a short run each, worked out
//! when its card comes into sight.

use super::gallery::beginning;
use super::limits::{PREVIEW, PREVIEW_ROWS, PREVIEW_TURNS};
use super::messages::Beginning;
use crate::ask::{Mechanism, ModelAssessment};
use crate::budget::Budget;
use crate::dynamics::record::drive_cycle;
use crate::frontend::scene::{BuiltIn, Document, Overrides};
use crate::report::live;
use crate::studies::cam::disc_cams;
use crate::studies::run::RunResult;
use serde_json::Value;

/// The machine of a scene to begin with, moving; null: nothing of it can be drawn.
///
/// # Errors
/// There is no such scene.
pub(super) fn preview(of: &Beginning) -> Result<Value, String> {
    let text = beginning(of)?;
    let shorter = [true, false].into_iter();
    let mut found = shorter.filter_map(|short| drawn(&text, short));
    Ok(found.next().unwrap_or_default())
}

/// Its run, drawn; `short`: of a few turns alone, which not every scene allows.
fn drawn(text: &str, short: bool) -> Option<Value> {
    let document = Document::parse("scene", text.as_bytes()).ok()?;
    let reading = document.scene(&BuiltIn, &Overrides::none()).ok()?;
    let budget = Budget::FREE.within(PREVIEW);
    let mut mechanism = Mechanism::of_within(reading, ModelAssessment::Never, &budget).ok()?;
    shorten(&mut mechanism, short);
    let RunResult {
        figures, record, ..
    } = mechanism.run_within(&budget).ok()?;
    let model = mechanism.model();
    let cams = disc_cams(mechanism.scene(), model);
    live::moving(model, &cams, (&figures, &record))
}

/// As many samples as a small picture needs, no columns of masses.
fn shorten(mechanism: &mut Mechanism, short: bool) {
    let turn = drive_cycle(mechanism.model()).ok();
    let settings = &mut mechanism.settings;
    let [a_turn, least] = PREVIEW_ROWS;
    if let (Some(turn), true) = (turn, short && settings.window.is_none()) {
        settings.duration = settings.duration.min(PREVIEW_TURNS * turn);
    }
    let rows = turn.map_or(least, |turn| a_turn * settings.duration / turn);
    settings.samples = settings.samples.min(rows.max(least) as usize);
    settings.masses = false;
    settings.switch_rows = false;
    settings.closeups = false;
}

#[cfg(test)]
mod tests {
    use super::preview;
    use crate::frontend::scene::Template;
    use crate::studio::messages::Beginning;

    #[test]
    fn the_machines_of_templates_and_scenarios_move() {
        let templates = Template::ALL.map(|one| Beginning::Template(one.name().to_owned()));
        let scenarios = ["rocker/two_masses", "cams/measured_lift", "linkages/shaper"];
        let scenarios = scenarios.map(|name| Beginning::Scenario(name.to_owned()));
        for of in templates.into_iter().chain(scenarios) {
            let found = preview(&of).unwrap();
            assert!(
                found["pictures"].as_str().unwrap().contains("<svg"),
                "{of:?}"
            );
            let columns = found["columns"].as_array().unwrap().iter();
            let longest = columns.map(|one| one.as_array().unwrap().len()).max();
            assert!(
                (100..=2100).contains(&longest.unwrap()),
                "{of:?}: {longest:?}"
            );
            // Something of it is at another place in another row.
            let moves = found["moving"]["columns"]
                .as_array()
                .unwrap()
                .iter()
                .any(|one| {
                    let index = one["values"].as_u64().unwrap() as usize;
                    let values = found["columns"][index].as_array().unwrap();
                    values.iter().any(|value| *value != values[0])
                });
            assert!(moves, "{of:?}");
        }
        // It is stuck from the first instant on.
        let stuck = Beginning::Scenario("joint_friction/jamming_block".to_owned());
        assert!(preview(&stuck).unwrap().is_null());
        assert!(preview(&Beginning::Scenario("rocker".to_owned())).is_err());
    }
}
