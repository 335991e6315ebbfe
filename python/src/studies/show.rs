//! The models of a scene.

use dam::ask::ModelAssessment;
use dam::report::show::scene::{ShownForm, ShownPart, document, show};
use dam::studies::Control;
use dam::{Error, Mechanism, Scene};
use pyo3::PyResult;
use pyo3::exceptions::PyValueError;

/// The part of a name.
///
/// # Errors
/// There is none.
pub(crate) fn part(name: &str) -> PyResult<ShownPart> {
    match name {
        "all" => Ok(ShownPart::All),
        "graph" => Ok(ShownPart::Graph),
        "model" => Ok(ShownPart::Model),
        "equations" => Ok(ShownPart::Equations),
        _ => {
            let message = format!("view: {name:?} is not one of all, graph, model, equations");
            Err(PyValueError::new_err(message))
        }
    }
}

/// The form of a name.
///
/// # Errors
/// There is none.
pub(crate) fn form(name: &str) -> PyResult<ShownForm> {
    match name {
        "text" => Ok(ShownForm::Text),
        "dot" => Ok(ShownForm::Dot),
        "svg" => Ok(ShownForm::Svg),
        "latex" => Ok(ShownForm::Latex),
        _ => {
            let message = format!("form: {name:?} is not one of text, dot, svg, latex");
            Err(PyValueError::new_err(message))
        }
    }
}

/// The models in words or as a picture.
///
/// # Errors
/// Everything that is wrong with the scene; the part has no such form.
pub(crate) fn ask(scene: &Scene, part: ShownPart, form: ShownForm) -> Result<String, Error> {
    let ready = ready(scene)?;
    let shown = show(part, form, &ready.system, &ready.settings);
    shown.map_err(|what| vec![dam::fault::Fault::new("", what, "")].into())
}

/// The models as a document.
///
/// # Errors
/// Everything that is wrong with the scene.
pub(crate) fn document_of(scene: &Scene) -> Result<String, Error> {
    let ready = ready(scene)?;
    Ok(document(&ready.scene().name, &ready.system, &ready.settings).to_string())
}

fn ready(scene: &Scene) -> Result<Mechanism, Error> {
    Mechanism::of_within(
        scene.decode()?,
        ModelAssessment::Needed,
        &Control::default(),
    )
}
