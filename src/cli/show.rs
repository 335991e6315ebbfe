//! `dam show`: the three models of a scene.

use super::args::{ShowArgs, ShowForm, View};
use super::console;
use super::failure::Failure;
use super::input::{Input, Ready};
use super::status::Status;
use crate::dynamics::model::{Coordinate, LinkageBody, ModalReduction, Model, MultiLinkageBody};
use crate::dynamics::system::{Regime, System};
use crate::exact::{Parts, Refusal};
use crate::report::diagram::Diagram;
use crate::report::show::equations::{equations, latex, text};
use crate::report::show::graph;
use crate::report::show::linkages::moved_by;
use crate::report::show::masses::{self, Frequencies};
use crate::report::show::reduced::modes;
use crate::report::svg::graph::svg;
use crate::studies::exact::{Mixed, mixed};
use crate::units::shown;
use serde_json::json;

/// Runs the command.
pub(crate) fn command(args: &ShowArgs) -> Result<Status, Failure> {
    refuse_form(args.view, args.form)?;
    let ready = Input::load(&args.scene)?.prepare_and_warn(args.scene.quiet)?;
    let model = ready.system.model();
    if args.scene.json {
        console::json(&document(&ready))?;
        return Ok(Status::Answered);
    }
    let out = match args.form {
        ShowForm::Dot => graph::dot(&Diagram::of(model)),
        ShowForm::Svg => svg(&Diagram::of(model)),
        ShowForm::Latex => latex(&equations(model)),
        ShowForm::Text => in_words(args.view, &ready),
    };
    console::print_text(&out)?;
    Ok(Status::Answered)
}

fn refuse_form(view: View, form: ShowForm) -> Result<(), Failure> {
    let fits = match form {
        ShowForm::Text => true,
        ShowForm::Dot | ShowForm::Svg => matches!(view, View::Graph | View::All),
        ShowForm::Latex => matches!(view, View::Equations | View::All),
    };
    if fits {
        return Ok(());
    }
    Err(Failure::Other(
        "the object graph comes as text, dot or svg (--view graph), the equations as text or \
         latex (--view equations), the model as text"
            .to_owned(),
    ))
}

fn in_words(view: View, ready: &Ready) -> String {
    let system = &ready.system;
    let model = system.model();
    // Only what is shown is worked out: frequencies of many masses take their time.
    let said = |part: View| match part {
        View::All => String::new(),
        View::Graph => graph::tree(&Diagram::of(model)),
        View::Model => masses::text(model, &frequencies(system)) + &exact_in_words(ready),
        View::Equations => text(&equations(model)),
    };
    if view != View::All {
        return format!("{}\n", said(view).trim_end());
    }
    let parts = [
        (View::Graph, "OBJECTS"),
        (View::Model, "DYNAMIC MODEL"),
        (View::Equations, "EQUATIONS"),
    ];
    let texts = parts.map(|(part, title)| format!("{title}\n\n{}\n", said(part).trim_end()));
    texts.join("\n")
}

/// Whether the scene is propagated exactly, and why not.
fn exact_in_words(ready: &Ready) -> String {
    let system = &ready.system;
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
    if let Some(found) = &ready.settings.of_accuracy {
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

fn document(ready: &Ready) -> serde_json::Value {
    let system = &ready.system;
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
        "scene": ready.scene().name,
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
    if let Some(found) = &ready.settings.of_accuracy {
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
