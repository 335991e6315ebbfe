//! The machine of a run, moving, in one picture: cams and linkages to scale with what
//! drives them, other objects as levers of unit length or slides on their guides beside
//! them, joined by lines. Where objects deflect, the place that the law requires is drawn
//! pale beside the true one, the deflection magnified.

mod cams;
mod linkages;
mod loads;
mod magnify;
mod object_path;
mod station;
mod whole;

use super::cam;
use super::html::player::{Coordinates, Player};
use super::html::runs::player_tables;
use super::plot::Plots;
use super::quantity::escape;
use crate::dynamics::model::{Model, OUTPUT, ObjectPart};
use crate::dynamics::record::{Figures, Record, drive_cycle};
use crate::kinematics::cam::DiscCam;
use magnify::magnify;
use station::Station;
pub(in crate::report) use whole::Room;
use whole::Whole;

/// Most objects that are drawn; more would fill no screen.
const MOST: usize = 24;

/// How long a turn of the drive is played at normal speed, and a run without
/// turns (s).
const SECONDS_A_TURN: f64 = 2.5;
const SECONDS_A_RUN: f64 = 8.0;

/// Machine to draw.
#[derive(Clone, Copy, Debug)]
pub struct Machine<'a> {
    /// The mechanism.
    pub model: &'a Model,
    /// Cams whose geometry is known, by the id of their follower.
    pub cams: &'a [(String, DiscCam)],
}

impl Machine<'_> {
    /// The section of a page, which follows the samples of its charts. Empty where nothing can
    /// be drawn.
    pub(in crate::report) fn section(
        &self,
        figures: &Figures,
        record: &Record,
        plots: &mut Plots,
    ) -> String {
        let Some(moving) = self.moving(figures, record, plots, Room::Page) else {
            return String::new();
        };
        let style = match self.cams.is_empty() {
            true => String::new(),
            false => plots.style(cam::style()),
        };
        format!(
            "<h2>The machine moving</h2>\n{}{}",
            moving.player.figure(&(style + &moving.pictures)),
            moving.picture_note()
        )
    }

    /// What moves, and the pictures that it moves in; `None`: nothing can be drawn.
    pub(in crate::report) fn moving(
        &self,
        figures: &Figures,
        record: &Record,
        plots: &mut Plots,
        room: Room,
    ) -> Option<MovingMachine> {
        let all = self.drivers_first();
        let plotted = all
            .iter()
            .filter_map(|&part| Some((part, player_tables(plots, record, &part.id)?)));
        let (drawn, columns): (Vec<&ObjectPart>, Vec<Coordinates>) = plotted.take(MOST).unzip();
        let mut player = Player {
            id: "machine".to_owned(),
            seconds: self.seconds(record),
            turn: self.time_of_turn(),
            columns,
            times: Some(plots.places(&record.times)),
            ..Player::default()
        };
        let stations = |most: &[f64]| -> Vec<Station> {
            let of = |column: usize| Station::of(self, record, (column, most[column]), &drawn);
            (0..drawn.len()).flat_map(of).collect()
        };
        let free = vec![f64::INFINITY; drawn.len()];
        let most = whole::scales(&stations(&free), drawn.len());
        let mut stations = stations(&most);
        if stations.is_empty() || record.times.len() < 2 {
            return None;
        }
        let delta = |id: &str| figures.objects.get(id).map_or(0.0, |own| own.delta_abs);
        let deflections = stations
            .iter()
            .map(|one| delta(&one.id) * one.picture.pixels);
        player.magnify = magnify(deflections.fold(0.0, f64::max));
        let mut parts = 0;
        let firsts = stations.iter().map(|one| {
            parts += one.picture.bodies.len();
            parts - one.picture.bodies.len()
        });
        let firsts: Vec<usize> = firsts.collect();
        let whole = Whole::of(self.model, &drawn, &stations, &firsts, room);
        let loads = loads::arrows(self.model, &whole, record, plots);
        let arrows = loads.as_ref().map_or(String::new(), loads::layer);
        let pictures = whole.html(delta, &arrows);
        player.sets.extend(loads);
        let bodies = stations.iter_mut().map(|one| &mut one.picture.bodies);
        bodies.for_each(|own| player.bodies.append(own));
        Some(MovingMachine {
            player,
            pictures,
            drawn: [drawn.len(), all.len()],
        })
    }

    /// The scene's objects, drivers before what they drive; outputs belong to
    /// their linkage.
    fn drivers_first(&self) -> Vec<&ObjectPart> {
        let own =
            |part: &&ObjectPart| part.kind != OUTPUT && !part.is_inner() && !part.nodes.is_empty();
        let mut parts: Vec<&ObjectPart> = self.model.objects.iter().filter(own).collect();
        parts.sort_by_key(|part| part.nodes[0]);
        parts
    }

    fn seconds(&self, record: &Record) -> f64 {
        let duration = record.times.last().copied().unwrap_or(0.0);
        match self.time_of_turn() {
            Some(turn) => (SECONDS_A_TURN * duration / turn).max(2.0),
            None => SECONDS_A_RUN,
        }
    }

    /// The time of a turn of the drive (s); `None`: it does not turn evenly.
    fn time_of_turn(&self) -> Option<f64> {
        drive_cycle(self.model).ok().filter(|turn| *turn > 0.0)
    }
}

/// A machine that moves.
#[derive(Debug)]
pub(in crate::report) struct MovingMachine {
    /// Its motion.
    pub(in crate::report) player: Player,
    /// The pictures that it moves in.
    pub(in crate::report) pictures: String,
    /// Objects that are drawn, of all.
    drawn: [usize; 2],
}

impl MovingMachine {
    /// What is to be said of the pictures.
    pub(in crate::report) fn picture_note(&self) -> String {
        let mut text = String::from(
            "Angles are true; cams and linkages are to scale, a lever without geometry has unit \
             length. A scene does not place its objects in the plane: lines join them along the \
             flow of motion. The cursors of the charts below follow the machine.",
        );
        if self.player.magnify.is_some() {
            text.push_str(
                " Pale: the prescribed position; in full: the actual one, its deflection δ \
                 magnified by the factor beside the controls.",
            );
        }
        let [drawn, all] = self.drawn;
        if drawn < all {
            text.push_str(&format!(" {drawn} of {all} objects are drawn."));
        }
        format!("<p class=\"soft\">{}</p>\n", escape(&text))
    }
}
