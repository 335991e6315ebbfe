//! Contact forces that have no limit with the number of masses.
//!
//! A Kelvin–Voigt body whose end is suddenly moved at a speed v answers with a force that is
//! unbounded as t → 0+: of a uniform shaft v·√(Jcτ/(πt)), τ its damping over its stiffness.
//! In a chain of n masses link 1 is the first fragment, its damper n·b acts at the full
//! approach speed when the pair closes, and the force grows with n. That follows from how the
//! object is made, not from runs, which may look settled before it shows.
//!
//! The force of a rigid contact has none either: in an impact it is an impulse.

use crate::dynamics::builder::spec::BodySpec;
use crate::dynamics::model::{Closure, Model, ObjectPart};
use crate::dynamics::record::Figures;
use crate::frontend::scene::TypedScene;

/// What to say of each figure, of those asked by their addresses, that has no limit. Of a run
/// with its figures only if a pair has come down at a speed.
pub fn without_limit<'a>(
    scene: &TypedScene,
    model: &Model,
    asked: impl IntoIterator<Item = &'a str>,
    found: Option<&Figures>,
) -> Vec<String> {
    let strikes = |part: &ObjectPart| {
        let Some(figures) = found else { return true };
        let own = figures.objects.get(&part.id);
        let pair = own.and_then(|own| own.pair.as_ref());
        let stop = own.and_then(|own| own.stop.as_ref());
        let speeds = [
            pair.map(|pair| pair.max_approach_speed),
            stop.map(|stop| stop.max_approach_speed),
        ];
        speeds.into_iter().flatten().any(|speed| speed > 0.0)
    };
    let parts = model.objects.iter().enumerate();
    let parts =
        parts.filter_map(|(index, part)| Some((part, cause_of_limit(scene, model, index)?)));
    let parts: Vec<(&ObjectPart, Cause)> = parts.filter(|(part, _)| strikes(part)).collect();
    let mut told = Vec::new();
    for address in asked {
        let concerned = |(part, cause): &&(&ObjectPart, Cause)| {
            let id = &part.id;
            let driver = part.driver().map(|driver| &model.objects[driver].id);
            let driver = driver.filter(|_| *cause != Cause::Stop);
            address == format!("{id}.pair.max_contact_force")
                || address == format!("{id}.stop.max_contact_force")
                || address == format!("{id}.peak_reaction")
                || driver.is_some_and(|driver| address == format!("{driver}.peak_reaction"))
        };
        if let Some((part, cause)) = parts.iter().find(concerned) {
            told.push(message(address, part, *cause));
        }
    }
    told.sort();
    told.dedup();
    told
}

/// What a force has no limit by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Cause {
    /// The damper of link 1, which becomes stiffer with every mass.
    Damper,
    /// A rigid pair.
    Pair,
    /// A rigid stop.
    Stop,
}

fn cause_of_limit(scene: &TypedScene, model: &Model, object: usize) -> Option<Cause> {
    let part = &model.objects[object];
    if model.stop(object).is_some_and(|stop| stop.law.is_rigid()) {
        Some(Cause::Stop)
    } else if part.strikes().is_some() {
        Some(Cause::Pair)
    } else {
        grows(scene, model, part).then_some(Cause::Damper)
    }
}

/// True when the contact force of an object grows with its number of masses: it can open,
/// its link 1 is the contact too, and is damped. (Explicit lists are their own truth.)
fn grows(scene: &TypedScene, model: &Model, part: &ObjectPart) -> bool {
    let opens = model
        .elastic_pair(part)
        .is_some_and(|pair| pair.closure != Closure::Bilateral && pair.form.is_linear());
    let damped = (part.links.first()).is_some_and(|&link| model.links[link].damping > 0.0);
    let object = scene.objects.get(&part.id).map(|entry| &entry.object);
    let chain = object.and_then(|object| object.chain());
    let uniform = chain.is_some_and(|chain| matches!(chain.body, BodySpec::Uniform { .. }));
    part.contact.is_none() && opens && damped && uniform
}

fn message(address: &str, part: &ObjectPart, cause: Cause) -> String {
    let impulse = |impulse: &str| {
        format!(
            "{address} has no converged value: in an impact of a rigid contact the force is an \
             impulse. The result is the greatest force between impacts. `{impulse}` has a value. \
             With a contact stiffness the force has one too"
        )
    };
    match cause {
        Cause::Damper => {}
        Cause::Pair => return impulse(&format!("{}.pair.impacts.max_impulse", part.id)),
        Cause::Stop => return impulse(&format!("{}.stop.impacts.max_impulse", part.id)),
    }
    let (id, count) = (&part.id, part.nodes.len());
    let masses = if count == 1 { "mass" } else { "masses" };
    format!(
        "{address} diverges with the number of masses. The damper of link 1 of {id} is its \
         contact too: it acts at the full speed of approach and becomes stiffer with every mass. \
         The result is that of {count} {masses}. With `{id}.pair.contact` it converges"
    )
}

#[cfg(test)]
mod tests {
    use super::without_limit;
    use crate::frontend::lower::lower;
    use crate::frontend::scene::{BuiltIn, Document, Overrides};

    const SCENE: &[u8] = include_bytes!("../../scenarios/rocker/two_masses.json");

    fn told(overrides: &[&str]) -> usize {
        let document = Document::parse("two_masses.json", SCENE).unwrap();
        let overrides: Vec<String> = overrides.iter().map(|text| (*text).to_owned()).collect();
        let reading = document
            .scene(&BuiltIn, &Overrides::new(overrides))
            .unwrap();
        let model = lower(&reading.scene).unwrap();
        let asked = [
            "rocker.pair.max_contact_force",
            "rocker.peak_reaction",
            "shaft.peak_reaction",
            "rocker.delta_max",
        ];
        without_limit(&reading.scene, &model, asked, None).len()
    }

    #[test]
    fn a_rigid_contact_has_impulses() {
        let rigid = ["rocker.pair.contact.restitution=0.5", "rocker.masses=0"];
        assert_eq!(told(&rigid), 3);
    }

    #[test]
    fn a_damped_first_link_that_can_come_down_has_none() {
        assert_eq!(told(&[]), 3);
        assert_eq!(told(&["rocker.masses=40"]), 3);
        for limited in [
            "rocker.damping_capacity=0",
            "rocker.pair.closure=bilateral",
            "rocker.pair.law=hunt_crossley",
            "rocker.pair.contact.stiffness=1e8",
            "rocker.masses=0",
        ] {
            assert_eq!(told(&[limited]), 0, "{limited}");
        }
    }
}
