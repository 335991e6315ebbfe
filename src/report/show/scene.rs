//! The three models of a scene together, as `dam show` prints them: in words, and as a document.

use super::equations::{equations, latex, text};
use super::graph;
use super::linkages::moved_by;
use super::masses::{self, Frequencies};
use super::reduced::modes;
use crate::dynamics::model::{Coordinate, LinkageBody, ModalReduction, Model, MultiLinkageBody};
use crate::dynamics::system::{Regime, System};
use crate::exact::{Parts, Refusal};
use crate::report::diagram::Diagram;
use crate::report::svg::graph::svg;
use crate::studies::RunSettings;
use crate::studies::exact::{Mixed, mixed};
use crate::units::shown;
use serde_json::json;

/// A part of what is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShownPart {
    /// All three.
    All,
    /// The graph of objects.
    Graph,
    /// Masses, links, loads and natural frequencies.
    Model,
    /// The equations of motion.
    Equations,
}

/// In which form it is shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShownForm {
    /// In words.
    Text,
    /// Graphviz, of the graph.
    Dot,
    /// A drawing of the graph.
    Svg,
    /// The equations in LaTeX.
    Latex,
}

/// Whether a part has a form.
///
/// # Errors
/// It has not; which has which.
pub fn check_form(part: ShownPart, form: ShownForm) -> Result<(), String> {
    let fits = match form {
        ShownForm::Text => true,
        ShownForm::Dot | ShownForm::Svg => matches!(part, ShownPart::Graph | ShownPart::All),
        ShownForm::Latex => matches!(part, ShownPart::Equations | ShownPart::All),
    };
    fits.then_some(()).ok_or_else(|| {
        "the object graph comes as text, dot or svg (view graph), the equations as text or latex \
         (view equations), the model as text"
            .to_owned()
    })
}

/// The models of a scene in words or as a picture.
///
/// # Errors
/// As of [`check_form`].
pub fn show(
    part: ShownPart,
    form: ShownForm,
    system: &System,
    settings: &RunSettings,
) -> Result<String, String> {
    check_form(part, form)?;
    let model = system.model();
    Ok(match form {
        ShownForm::Text => in_words(part, system, settings),
        ShownForm::Dot => graph::dot(&Diagram::of(model)),
        ShownForm::Svg => svg(&Diagram::of(model)),
        ShownForm::Latex => latex(&equations(model)),
    })
}

fn in_words(view: ShownPart, system: &System, settings: &RunSettings) -> String {
    let model = system.model();
    // Only what is shown is worked out: frequencies of many masses take their time.
    let said = |part: ShownPart| match part {
        ShownPart::All => String::new(),
        ShownPart::Graph => graph::tree(&Diagram::of(model)),
        ShownPart::Model => {
            masses::text(model, &frequencies(system)) + &exact_in_words(system, settings)
        }
        ShownPart::Equations => text(&equations(model)),
    };
    if view != ShownPart::All {
        return format!("{}\n", said(view).trim_end());
    }
    let parts = [
        (ShownPart::Graph, "OBJECTS"),
        (ShownPart::Model, "DYNAMIC MODEL"),
        (ShownPart::Equations, "EQUATIONS"),
    ];
    let texts = parts.map(|(part, title)| format!("{title}\n\n{}\n", said(part).trim_end()));
    texts.join("\n")
}

/// Whether the scene is propagated exactly, and why not.
fn exact_in_words(system: &System, settings: &RunSettings) -> String {
    let parts = Parts::of(system).with_sound_trees(system);
    let mut out = "\nExact propagation\n".to_owned();
    for part in &parts.trees {
        let ids = part.objects.iter();
        let ids: Vec<_> = ids
            .map(|&object| system.model().objects[object].id.as_str())
            .collect();
        let masses = part.problem().masses.len();
        let (noun, list) = (if masses == 1 { "mass" } else { "masses" }, ids.join(", "));
        out.push_str(&format!("  applies to {list} ({masses} {noun})\n"));
    }
    for refusal in &parts.refusals {
        let (object, reason) = (&refusal.object, &refusal.reason);
        out.push_str(&format!("  does not apply: {object}: {reason}\n"));
    }
    if let Some(mixed) = mixed(system) {
        let ids = integrated(&mixed).join(", ");
        out.push_str(&format!("  beside it, `auto` integrates {ids}\n"));
    }
    if parts.trees.is_empty() && parts.refusals.is_empty() {
        out.push_str("  nothing is elastic: the motion follows from the drives\n");
    }
    if let Some(found) = &settings.of_accuracy {
        let tolerance = shown(found.tolerance, 3);
        out.push_str(&format!(
            "\nTolerance of a run\n  {tolerance}: {}\n",
            found.why
        ));
    }
    out
}

/// The objects that a mixed run integrates: what is driven, and motors.
fn integrated(mixed: &Mixed) -> Vec<String> {
    let own = &mixed.rest.system;
    let parts = own.model().objects.iter().enumerate();
    let moves = |object: usize| own.last_coordinate(object).is_some();
    let ids = parts.filter(|(object, part)| !part.is_drive() || moves(*object));
    ids.map(|(_, part)| part.id.clone()).collect()
}

fn exact_document(system: &System) -> serde_json::Value {
    let parts = Parts::of(system).with_sound_trees(system);
    let objects = parts.trees.iter().flat_map(|part| &part.objects);
    let refusal = |refusal: &Refusal| json!({ "object": refusal.object, "reason": refusal.reason });
    json!({
        "applies": parts.is_whole(),
        "objects": objects.map(|&object| &system.model().objects[object].id).collect::<Vec<_>>(),
        "beside": mixed(system).map(|mixed| integrated(&mixed)).unwrap_or_default(),
        "refusals": parts.refusals.iter().map(refusal).collect::<Vec<_>>(),
    })
}

fn frequencies(system: &System) -> Frequencies {
    Frequencies {
        engaged: system.natural_frequencies(Regime::Engaged),
        open: system.natural_frequencies(Regime::Open),
    }
}

/// The models of a scene as a document; `name`: that of the scene.
pub fn document(name: &str, system: &System, settings: &RunSettings) -> serde_json::Value {
    let model: &Model = system.model();
    let found = frequencies(system);
    let objects: Vec<_> = model
        .objects
        .iter()
        .map(|object| {
            json!({
                "id": object.id,
                "kind": object.kind,
                "coordinate": object.coordinate,
                "driver": object.driver().map(|driver| &model.objects[driver].id),
                "drivers": (object.inputs.iter())
                    .map(|input| &model.objects[input.driver].id)
                    .collect::<Vec<_>>(),
                "inertias": object.nodes.iter().map(|&node| model.nodes[node].inertia).collect::<Vec<_>>(),
                "stiffnesses": object.links.iter().map(|&link| model.links[link].stiffness).collect::<Vec<_>>(),
                "dampings": object.links.iter().map(|&link| model.links[link].damping).collect::<Vec<_>>(),
            })
        })
        .collect();
    let mut document = json!({
        "dam": 1,
        "scene": name,
        "objects": objects,
        "linkages": model.linkages.iter().map(|body| linkage(model, body)).collect::<Vec<_>>(),
        "multi_linkages": (model.multi_linkages.iter())
            .map(|body| multi_linkage(model, body))
            .collect::<Vec<_>>(),
        "natural_frequencies": { "unit": "rad/s", "engaged": found.engaged, "open": found.open },
        "exact": exact_document(system),
        "equations": { "text": text(&equations(model)), "latex": latex(&equations(model)) },
    });
    if !model.reduced.is_empty() {
        document["reduced"] = model
            .reduced
            .iter()
            .map(|one| reduction_json(model, one))
            .collect();
    }
    if let Some(found) = &settings.of_accuracy {
        document["tolerance"] = json!(found);
    }
    document
}

/// Reduction of an object: modes with their shares of the output, and what the others
/// give way by.
fn reduction_json(model: &Model, reduced: &ModalReduction) -> serde_json::Value {
    let modes = modes(model, reduced).map(|mode| match mode.frequency {
        Some(frequency) => {
            json!({ "id": mode.id, "share": mode.share, "natural_frequency": frequency })
        }
        None => json!({ "id": mode.id, "share": mode.share }),
    });
    json!({
        "id": model.objects[reduced.object].id,
        "modes": modes.collect::<Vec<_>>(),
        "under_acceleration": reduced.under_acceleration,
        "offset": reduced.offset,
    })
}

/// Structure and inputs of a linkage of several.
fn multi_linkage(model: &Model, body: &MultiLinkageBody) -> serde_json::Value {
    let (linkage, structure) = (&body.linkage, body.linkage.structure());
    let groups = (0..structure.groups.len()).map(|group| structure.describe(group));
    let inputs = linkage.inputs().iter().zip(moved_by(model, body));
    let inputs = inputs.map(|(input, what)| {
        json!({
            "name": input.name,
            "coordinate": linkage.describe(input),
            "start": input.start,
            "moved": what,
        })
    });
    json!({
        "id": model.objects[body.object].id,
        "mobility": structure.mobility,
        "explanation": structure.explanation,
        "groups": groups.collect::<Vec<_>>(),
        "inputs": inputs.collect::<Vec<_>>(),
    })
}

/// Structure and range of a linkage.
fn linkage(model: &Model, body: &LinkageBody) -> serde_json::Value {
    let (structure, range) = (body.linkage.structure(), body.linkage.range());
    let part = &model.objects[body.object];
    let turning = part.coordinate == Coordinate::Turning;
    let groups = (0..structure.groups.len()).map(|group| structure.describe(group));
    let end = |at: f64| at.is_finite().then_some(at);
    json!({
        "id": part.id,
        "mobility": structure.mobility,
        "explanation": structure.explanation,
        "redundant": structure.redundant,
        "groups": groups.collect::<Vec<_>>(),
        "reach": range.ends().map(end),
        "period": range.period.as_ref().map(|period| period.length),
        "change_points": range.changes.iter().map(|change| change.at).collect::<Vec<_>>(),
        "range": range.describe(structure, turning),
    })
}
