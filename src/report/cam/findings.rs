//! What is known of a cam: the cam turning with its follower, figures, diagrams.

use super::figures::{contact, describe, figures};
use super::picture::{Follower, curves_to_draw, drawing, marks, moving_bodies, style};
use super::remarks::remarks;
use super::tables::PLACES;
use super::view::{View, view};
use super::{NamedCurve, charts};
use crate::kinematics::cam::DiscCam;
use crate::report::findings::{Findings, Item, Layout, Section, Source};
use crate::report::html::player::{
    Coordinates, PartDisplacement, Player, Reading, RowAxis, player_number,
};
use crate::report::mechanism::marks::scale_bar;
use crate::report::plot::Plots;
use crate::report::quantity::DIGITS;
use crate::report::sentence::Sentence;
use crate::report::verdict::{Verdict, capitalised};
use crate::studies::cam::{CamFigures, CamForce};
use crate::studies::judgement::{Judgement, RunEnd};
use serde_json::{Value, json};

/// How long a turn is played at normal speed (s).
const SECONDS: f64 = 6.0;

/// Everything that goes into the page of a cam.
#[derive(Clone, Copy, Debug)]
pub struct CamReport<'a> {
    /// Name of the scene.
    pub name: &'a str,
    /// Id of the object.
    pub id: &'a str,
    /// The cam.
    pub cam: &'a DiscCam,
    /// Figures that were found.
    pub figures: &'a CamFigures,
    /// The contact, if there is one to be known.
    pub force: Option<&'a CamForce<'a>>,
    /// Curves of the profile.
    pub curves: &'a [NamedCurve],
    /// Chord tolerance of the curves (m).
    pub tolerance: f64,
}

impl CamReport<'_> {
    /// The JSON document. `hash`: of the scene.
    pub fn document(&self, hash: &str) -> Value {
        let curve = |curve: &NamedCurve| {
            json!({
                "name": curve.name,
                "closed": curve.polygon.closed,
                "points": curve.polygon.points.len(),
                "length": curve.polygon.length(),
            })
        };
        json!({
            "dam": 1,
            "scene": self.name,
            "hash": hash,
            "verdict": self.judgement(),
            "rigid": self.figures.rigid(),
            "object": self.id,
            "cam": self.figures,
            "curves": self.curves.iter().map(curve).collect::<Vec<_>>(),
            "tolerance": self.tolerance,
        })
    }

    /// The verdict: its shape and its contact are as asked.
    pub fn judgement(&self) -> Judgement {
        Judgement::judge_result(RunEnd::Complete, &[], || match grave(self.figures).len() {
            0 => self.figures.contact(),
            _ => Judgement::NotInWorkingOrder,
        })
    }
}

/// What keeps the cam from being sound.
fn grave(figures: &CamFigures) -> Vec<String> {
    let all = remarks(figures).into_iter();
    all.filter_map(|(grave, text)| grave.then_some(text))
        .collect()
}

/// The cam turning, its figures, its diagrams.
pub fn findings<'a>(report: &CamReport<'a>, mut source: Source<'a>) -> Findings<'a> {
    let curves = report.curves.iter();
    let points: usize = curves.map(|curve| curve.polygon.points.len()).sum();
    let tolerance = super::words::length(report.tolerance);
    let text = format!("{points} points, the curves within {tolerance} of their chords");
    source.more.push(("Curves".to_owned(), text));
    let drawn = *report;
    let said = remarks(report.figures).into_iter().map(|(_, text)| text);
    let mut sections = vec![
        Section::new("Remarks").item(Item::Notes(said.collect())),
        Section::new("Cam and follower")
            .drawing(move |plots| turning(&drawn, plots))
            .legend(
                "Dotted: base circle; dashed: pitch curve. The mark on the cam points along the \
                 follower at φ = 0.",
            ),
        Section::new("Results").figures(figures(report.cam, report.figures)),
        Section::new("Over the turn").charts(
            Layout::Grid,
            "turn",
            charts::charts(report.cam, report.figures, report.force),
        ),
    ];
    if let Some(chart) = charts::springs(report.figures) {
        let section = Section::new("Closing spring");
        let section = section.charts(Layout::Wide(340.0), "", vec![chart]);
        let legend = "Springs above the line leave the reserve in contact at this speed.";
        sections.push(section.legend(legend));
    }
    Findings {
        title: format!("{}: the cam of {}", report.name, report.id),
        subtitle: describe(report.cam.geometry()),
        answer: Some(verdict(report)),
        warnings: Vec::new(),
        sections,
        source,
    }
}

fn verdict(report: &CamReport<'_>) -> Verdict {
    let (judgement, grave) = (report.judgement(), grave(report.figures));
    let Some(first) = grave.first() else {
        let shape = match report.figures.force {
            Some(_) => {
                "No undercut, no corner; pressure angle, face and closing force are as required."
            }
            None => "No undercut, no corner; pressure angle and face are as required.",
        };
        let why = match judgement {
            Judgement::NotJudged => unjudged(report.figures),
            _ => String::new(),
        };
        let text = format!("{shape} {why}");
        return Verdict::of_judgement(
            judgement,
            headline_of_sound_cam(report.figures),
            text.trim_end(),
        );
    };
    let text = match grave.len() {
        1 => Sentence::default(),
        count => format!("And {} more, listed below.", count - 1).into(),
    };
    Verdict::of_judgement(judgement, Sentence::read(&(capitalised(first) + ".")), text)
}

/// What a sound cam comes to: its greatest pressure angle, and up to which speed it keeps contact.
fn headline_of_sound_cam(figures: &CamFigures) -> Sentence {
    let sizes = figures.pressure.map(|at| at.value.abs());
    let angle = sizes[0].max(sizes[1]);
    let flat = figures.face.is_some();
    let shape =
        (!flat).then(|| Sentence::from("Greatest pressure angle ").angle_or(angle, "rad", DIGITS));
    let needed = figures.face.as_ref().map(|face| {
        Sentence::from("The face needs a width of ").quantity(face.needed_width, "m", DIGITS)
    });
    let contact = figures.force.as_ref().and_then(contact);
    let parts = [shape, needed, contact];
    Sentence::joined(parts.into_iter().flatten(), "; ").words(".")
}

/// Why the contact of a sound cam is not judged.
fn unjudged(figures: &CamFigures) -> String {
    match (&figures.force_missing, figures.rigid()) {
        (Some(why), _) => format!("The contact force is not known: {why}."),
        (None, Some(_)) => {
            "The follower is elastic: `--lift-off` finds the speed at which it lifts off."
                .to_owned()
        }
        (None, None) => String::new(),
    }
}

/// The drawing with its controls.
fn turning(report: &CamReport<'_>, plots: &Plots) -> String {
    let curves = curves_to_draw(report.cam);
    let view = view(report.cam, &curves);
    let [w, h] = [view.size[0], view.size[1] + 16.0].map(|size| format!("{size:.0}"));
    let picture = format!(
        "<svg class=\"mechanism\" viewBox=\"0 0 {w} {h}\" width=\"{w}\" height=\"{h}\" role=\"img\" \
         aria-label=\"cam and follower\">\n{}{}{}</svg>\n",
        drawing(
            report.cam,
            &curves,
            &view,
            report.cam.motion().range().0,
            None
        ),
        marks(report.cam, &view, true),
        scale_bar(view.scale, [14.0, view.size[1] + 2.0]),
    );
    plots.style(style()) + &player(report, &view).figure(&picture)
}

/// What the player moves: cam and follower, and readings over the turn.
fn player(report: &CamReport<'_>, view: &View) -> Player {
    let cam = report.cam;
    let (from, to) = cam.motion().range();
    let places: Vec<f64> = (0..=PLACES)
        .map(|step| from + (to - from) * step as f64 / PLACES as f64)
        .collect();
    let mut columns: Vec<(&str, &str, Vec<f64>)> = Vec::new();
    let column = |f: &dyn Fn(f64) -> f64| places.iter().map(|&phi| f(phi)).collect::<Vec<f64>>();
    let state = |phi: f64| {
        let (piece, phi) = cam.motion().piece_at(phi);
        cam.at(piece, phi)
    };
    let lift = column(&|phi| state(phi).lift);
    let (factor, unit) = match report.figures.unit {
        "rad" => (1f64.to_degrees(), "deg"),
        _ => (1e3, "mm"),
    };
    columns.push((
        "displacement",
        unit,
        lift.iter().map(|s| s * factor).collect(),
    ));
    columns.push((
        "pressure angle",
        "deg",
        column(&|phi| state(phi).pressure_angle.to_degrees()),
    ));
    columns.push((
        "radius of curvature",
        "mm",
        column(&|phi| 1e3 * state(phi).profile_radius),
    ));
    if let Some(force) = report.force {
        let at = |phi: f64| {
            let (piece, phi) = cam.motion().piece_at(phi);
            force.at_within_piece(phi, piece.from, piece.to)
        };
        columns.push(("contact force", "N", column(&|phi| at(phi)[1])));
        columns.push(("torque of the cam", "N m", column(&|phi| at(phi)[2])));
    }
    // Numbers for reading: six digits, nothing for what is not finite.
    let plain = |value: &f64| format!("{value:.5e}").parse::<f64>().ok();
    let plain = |value: &f64| plain(value).filter(|value| value.is_finite());
    let readings = columns.iter().map(|(name, unit, values)| Reading {
        name: (*name).to_owned(),
        unit: (*unit).to_owned(),
        values: values.iter().map(plain).collect(),
    });
    let follower = Follower {
        column: 1,
        factor: 1.0,
        base: 0.0,
        shown: PartDisplacement::True,
    };
    Player {
        id: "cam".to_owned(),
        axis: Some(RowAxis {
            name: "φ".to_owned(),
            unit: "deg".to_owned(),
            values: places
                .iter()
                .map(|phi: &f64| player_number(phi.to_degrees(), 6))
                .collect(),
            times: Vec::new(),
            closed: cam.motion().is_closed(),
        }),
        seconds: SECONDS,
        scale: Some([1.0 / view.scale, view.origin[0], view.origin[1]]),
        names: vec!["cam".to_owned(), "follower".to_owned()],
        readings: readings.collect(),
        columns: vec![
            Coordinates::Own { own: places },
            Coordinates::Own { own: lift },
        ],
        bodies: moving_bodies(cam, view, 0, &follower).into(),
        ..Player::default()
    }
}
