//! `dam cam`: the cam of an object in a scene.

mod lift_off;
mod question;

use super::args::{CamArgs, CamForm};
use super::console;
use super::failure::Failure;
use super::input::{Input, Ready};
use super::interrupt;
use super::law::told;
use super::output::{self, OutputFolder, ResultFile};
use super::status::Status;
use crate::kinematics::cam::DiscCam;
use crate::report::cam::{
    CamReport, NamedCurve, cam_text, curves, cycle_csv, dxf, page, picture, polygon_csv,
};
use crate::studies::cam::{CamFigures, CamForce, disc_cam, figures, objects_with_cam};
use serde_json::{Value, json};

const FILES: [&str; 6] = [
    "cam.json",
    "cycle.csv",
    "profile.csv",
    "profile.dxf",
    "cam.svg",
    "report.html",
];

/// Rows of the cycle's table in a turn.
const ROWS: usize = 720;

/// Everything found, ready to be written.
struct Found<'a> {
    ready: &'a Ready,
    id: &'a str,
    cam: &'a DiscCam,
    force: Option<&'a CamForce<'a>>,
    figures: CamFigures,
    curves: Vec<NamedCurve>,
    tolerance: f64,
}

/// Runs the command.
pub(crate) fn command(args: &CamArgs) -> Result<Status, Failure> {
    let input = Input::load(&args.scene)?;
    let ready = input.prepare(&[])?;
    let id = chosen(args, &ready)?;
    let folder = OutputFolder::asked(&args.out, &ready.scene().name, &FILES)?;
    let model = ready.system.model();
    let diagnose = |faults: Vec<crate::fault::Fault>| ready.reading.places.diagnose(&faults);
    let cam = disc_cam(ready.scene(), model, &id).map_err(diagnose)?;
    let asked = question::read(args, &cam)?;
    let index = model.objects.iter().position(|part| part.id == id);
    let index = index.ok_or_else(|| format!("there is no object `{id}`"))?;
    let force = CamForce::new(model, index, &cam, asked.speed);
    let force_or_why = force.as_ref().map_err(String::as_str);
    let mut found =
        figures(&cam, &asked.question, force_or_why).map_err(|faults| told(&faults, "--"))?;
    let mut status = Status::Answered;
    let _keeping = args.lift_off.then(interrupt::keep);
    if args.lift_off {
        match lift_off::search(args, &input, &ready, &id, force.as_ref().ok())? {
            Some(speed) => {
                if let Some(force) = &mut found.force {
                    force.elastic = Some(speed);
                }
            }
            None => {
                status = interrupt::status();
                if let (Some(spent), false) = (interrupt::budget().spent(), args.scene.quiet) {
                    console::talk(&format!(
                        "warning: the search for the lift-off of the elastic follower was ended \
                         before it had found it ({spent}): it is left out"
                    ));
                }
            }
        }
    }
    let curves = curves(&cam, asked.tolerance, asked.cutter);
    let found = Found {
        ready: &ready,
        id: &id,
        cam: &cam,
        force: force.as_ref().ok(),
        figures: found,
        curves: curves.map_err(|fault| told(&[fault], "--"))?,
        tolerance: asked.tolerance,
    };
    let show = || match args.scene.json {
        true => console::json(&found.document()),
        false => match args.form {
            CamForm::Text => console::text(&found.shown(args.form)?),
            form => console::data(&found.shown(form)?),
        },
    };
    let (hash, files) = (&ready.scene().hash, || found.files(&input));
    output::deliver(folder.as_ref(), "cam", hash, files, show)?;
    if let (Some(folder), false) = (&folder, args.scene.quiet) {
        folder.tell_report();
    }
    Ok(status)
}

/// The object asked for, or the only one with a cam.
fn chosen(args: &CamArgs, ready: &Ready) -> Result<String, Failure> {
    if let Some(id) = &args.object {
        return Ok(id.clone());
    }
    match objects_with_cam(ready.scene()).as_slice() {
        [only] => Ok((*only).to_owned()),
        [] => Err(Failure::Other(
            "no object of the scene tells of its cam: give a cam follower or rocker the property \
             `cam`, as in \"cam\": { \"base_radius\": \"20 mm\", \"contact\": { \"roller\": \"8 mm\" } }"
                .to_owned(),
        )),
        several => Err(Failure::Other(format!(
            "several objects tell of their cam: choose one with --object ({})",
            several.join(", ")
        ))),
    }
}

impl Found<'_> {
    fn document(&self) -> Value {
        let points = |curve: &NamedCurve| {
            json!({
                "name": curve.name,
                "closed": curve.polygon.closed,
                "points": curve.polygon.points.len(),
                "length": curve.polygon.length(),
            })
        };
        json!({
            "dam": 1,
            "scene": self.ready.scene().name,
            "hash": self.ready.scene().hash,
            "object": self.id,
            "cam": self.figures,
            "curves": self.curves.iter().map(points).collect::<Vec<_>>(),
            "tolerance": self.tolerance,
        })
    }

    fn shown(&self, form: CamForm) -> Result<String, String> {
        Ok(match form {
            CamForm::Text => cam_text(self.id, self.cam, &self.figures),
            CamForm::Cycle => self.cycle()?,
            CamForm::Profile => polygon_csv(&self.curves).map_err(|error| error.to_string())?,
            CamForm::Dxf => dxf(&self.curves, self.cam.geometry().base_radius),
            CamForm::Svg => self.drawing(),
        })
    }

    fn cycle(&self) -> Result<String, String> {
        let unit = self.figures.unit;
        cycle_csv(self.cam, unit, self.force, ROWS).map_err(|error| error.to_string())
    }

    fn drawing(&self) -> String {
        let from = self.cam.motion().range().0;
        picture(self.id, self.cam, from)
    }

    fn files(&self, input: &Input) -> Result<Vec<ResultFile>, Failure> {
        let report = page(&CamReport {
            name: &self.ready.scene().name,
            id: self.id,
            cam: self.cam,
            figures: &self.figures,
            force: self.force,
            curves: &self.curves,
            tolerance: self.tolerance,
            scene: input.text(),
            hash: &self.ready.scene().hash,
            version: env!("CARGO_PKG_VERSION"),
        });
        Ok(vec![
            ResultFile::new(FILES[0], format!("{:#}\n", self.document())),
            ResultFile::new(FILES[1], self.cycle()?),
            ResultFile::new(FILES[2], self.shown(CamForm::Profile)?),
            ResultFile::new(FILES[3], self.shown(CamForm::Dxf)?),
            ResultFile::new(FILES[4], self.drawing()),
            ResultFile::new(FILES[5], report),
        ])
    }
}
