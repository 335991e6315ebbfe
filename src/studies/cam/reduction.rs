//! What a cam must carry: the inertia and the loads of everything that moves
//! with its follower, reduced to the follower, as if nothing gave way.
//!
//! With q(φ) = lever·U(φ) of the follower and r = dq_j/dq, r₂ = d²q_j/dq² of the
//! nodes j behind it, the force that the follower's pair must give is
//!
//! Σ r·(J·(r·q″ + r₂·q′²)·ω² − W_j),
//!
//! turned into the direction in which the pair opens.

use crate::dynamics::model::{
    Closure, Law, LinearPiece, Load, LoadLaw, Model, ObjectPart, Pair, Track, TrackSource,
};
use crate::dynamics::trajectory::transfer;
use crate::kinematics::cam::closing::{ClosingSpring, Demand};
use crate::kinematics::cam::search::evenly_spaced;
use crate::kinematics::cam::{DiscCam, FollowerMotion};
use crate::math::jet::Jet;
use std::f64::consts::TAU;

/// Most stretches of a turn.
const MOST_PIECES: usize = 20_000;

/// The follower with all it carries.
#[derive(Debug)]
pub(super) struct Reduction<'m> {
    model: &'m Model,
    law: &'m Law,
    /// Nodes of the follower and behind it, drivers first.
    nodes: Vec<usize>,
    /// Loads, with the place of each one's node in `nodes`.
    loads: Vec<(usize, &'m Load)>,
    /// First node of the follower.
    first: usize,
    pair: Pair,
    /// The springs that close the pair: those on the follower itself, else those on the one
    /// object behind it that has springs.
    pub(super) spring: ClosingSpring,
    /// Names of those springs.
    pub(super) springs: Vec<String>,
    /// Where they act, if they are behind the follower.
    behind: Option<SpringBehind>,
    /// Stretches of φ on which the demand is smooth.
    pub(super) pieces: Vec<[f64; 2]>,
    /// Notes on what is left out, in words.
    pub(super) notes: Vec<String>,
}

/// Springs on an object behind the follower.
#[derive(Clone, Copy, Debug)]
struct SpringBehind {
    /// Place of its node in [`Reduction::nodes`].
    place: usize,
    /// Sense of its displacement in which it is stretched by opening: 1 or −1.
    sense: f64,
}

/// Parts of a piece at whose ends the sense of a spring behind the follower is looked at.
const SENSES: usize = 32;
/// Share of the greatest ratio below which a spring behind the follower has no leverage there.
const LEAST_LEVER: f64 = 1e-9;

impl<'m> Reduction<'m> {
    /// The reduction of an object (index in the model) on its cam.
    ///
    /// # Errors
    /// A load that changes over time or with a motor's speed, in words.
    pub(super) fn new(model: &'m Model, object: usize, cam: &DiscCam) -> Result<Self, String> {
        let part = &model.objects[object];
        let first = part.nodes[0];
        let law = model.nodes[first].motion.law();
        let law = law.ok_or_else(|| format!("`{}` follows no law", part.id))?;
        let mut members = vec![false; model.objects.len()];
        members[object] = true;
        // A follower may stand before what drives it in the list of objects.
        for _ in 0..model.objects.len() {
            for (index, one) in model.objects.iter().enumerate() {
                members[index] |= one.inputs.iter().any(|input| members[input.driver]);
            }
        }
        let parts = model.objects.iter().zip(&members);
        if let Some((several, _)) = (parts.clone()).find(|(one, is)| **is && one.inputs.len() > 1) {
            let id = &several.id;
            return Err(format!(
                "`{id}` has several inputs: its load on the cam is not determined"
            ));
        }
        let mut nodes: Vec<usize> = parts
            .filter(|(_, member)| **member)
            .flat_map(|(part, _)| part.nodes.iter().copied())
            .collect();
        nodes.sort_unstable();
        let place = |node: usize| nodes.iter().position(|&other| other == node);
        let loads = model.loads.iter();
        let loads = loads.filter_map(|load| Some((place(load.node)?, load)));
        let mut found = Self {
            model,
            law,
            loads: loads.collect(),
            nodes,
            first,
            pair: pair_of(model, object),
            spring: ClosingSpring::default(),
            springs: Vec::new(),
            behind: None,
            pieces: Vec::new(),
            notes: Vec::new(),
        };
        found.sort_loads(object)?;
        found.pieces = found.smooth_pieces(cam.motion())?;
        found.find_spring_behind(cam);
        Ok(found)
    }

    /// The closing spring behind a follower that has none itself: of one object, and acting in one
    /// sense over the turn. Others stay loads.
    fn find_spring_behind(&mut self, cam: &DiscCam) {
        if !self.springs.is_empty() {
            return;
        }
        let springs = self
            .loads
            .iter()
            .filter_map(|&(place, load)| match &load.law {
                LoadLaw::Linear(law) if law.rate != 0.0 => Some((place, law, &load.name)),
                _ => None,
            });
        let springs: Vec<_> = springs.collect();
        let Some(&(place, ..)) = springs.first() else {
            return;
        };
        let names: Vec<String> = springs.iter().map(|(.., name)| (*name).clone()).collect();
        if springs.iter().any(|(other, ..)| *other != place) {
            self.notes.push(format!(
                "{} act on several objects and are counted as loads: the closing spring is one on \
                 the follower, beside them",
                names.join(" and ")
            ));
            return;
        }
        let Some(sense) = self.sense_of_opening(cam, place) else {
            self.notes.push(format!(
                "{} has no leverage on the follower, or changes its sense, within the turn, and is \
                 counted as a load: the closing spring is one on the follower, beside it",
                names.join(" and ")
            ));
            return;
        };
        self.spring = springs
            .iter()
            .fold(ClosingSpring::default(), |sum, (_, law, _)| ClosingSpring {
                rate: sum.rate + law.rate,
                preload: sum.preload - sense * law.force,
            });
        self.springs = names;
        self.behind = Some(SpringBehind { place, sense });
    }

    /// The sense in which a node moves as the pair opens; `None`: it changes, or the node rests.
    fn sense_of_opening(&self, cam: &DiscCam, place: usize) -> Option<f64> {
        let pieces = self.pieces.iter().enumerate();
        let places = pieces
            .flat_map(|(piece, &ends)| evenly_spaced(ends, SENSES).map(move |phi| (piece, phi)));
        let ratios = places.map(|(piece, phi)| {
            let [q, first, _] = self.follower(cam, piece, phi);
            self.pair.opens * self.ratios(q, first)[place].first
        });
        let (least, most) = ratios.fold((f64::INFINITY, f64::NEG_INFINITY), |ends, ratio| {
            (ends.0.min(ratio), ends.1.max(ratio))
        });
        let floor = LEAST_LEVER * least.abs().max(most.abs());
        match (least > floor, most < -floor) {
            (true, _) => Some(1.0),
            (_, true) => Some(-1.0),
            (false, false) => None,
        }
    }

    /// The object on which the closing spring acts: the follower, or one behind it.
    pub(super) fn spring_owner(&self) -> Option<&'m ObjectPart> {
        let node = self
            .behind
            .map_or(self.first, |behind| self.nodes[behind.place]);
        let mut parts = self.model.objects.iter();
        parts.find(|part| part.nodes.contains(&node))
    }

    /// True where the closing spring acts on an object behind the follower.
    pub(super) fn has_spring_behind(&self) -> bool {
        self.behind.is_some()
    }

    /// Closing springs, and loads that have no place here.
    fn sort_loads(&mut self, object: usize) -> Result<(), String> {
        let own = &self.model.objects[object].nodes;
        let loads = self.loads.clone();
        for (_, load) in loads {
            match &load.law {
                LoadLaw::Linear(law) if law.rate != 0.0 && own.contains(&load.node) => {
                    self.spring.rate += law.rate;
                    self.spring.preload -= self.pair.opens * law.force;
                    self.springs.push(load.name.clone());
                }
                LoadLaw::Function { function, .. } if function.regularised_friction().is_some() => {
                    self.notes
                        .push(format!("{} (friction) is not counted", load.name));
                }
                LoadLaw::Dry { .. } => {
                    self.notes
                        .push(format!("{} (friction) is not counted", load.name));
                }
                LoadLaw::Pieces { track, .. }
                    if self.model.tracks[*track].source == TrackSource::Time =>
                {
                    return Err(format!("{} changes over time, not with the cam", load.name));
                }
                LoadLaw::Pieces { track, .. } => self.check_axis(&load.name, *track)?,
                LoadLaw::Stop(_) => {
                    self.notes.push(format!(
                        "{} (a stop) is not counted: the cam is taken to carry the follower",
                        load.name
                    ));
                }
                LoadLaw::Function { .. } | LoadLaw::Written(_) => {
                    return Err(format!("{} is no load that this study knows", load.name));
                }
                LoadLaw::Linear(_) => {}
            }
        }
        Ok(())
    }

    /// Refuses a load over a displacement that the angle of the cam does not determine, or that
    /// does not repeat with it.
    fn check_axis(&self, name: &str, track: usize) -> Result<(), String> {
        let track = &self.model.tracks[track];
        let TrackSource::Node(node) = track.source else {
            return Ok(());
        };
        if node == self.law.driver || self.nodes.contains(&node) {
            return Ok(());
        }
        let owner = self.model.objects.iter();
        let owner = owner.clone().find(|part| part.nodes.contains(&node));
        let id = owner.map_or("another object", |part| part.id.as_str());
        let Some([ratio, _]) = self.cam_over(node) else {
            return Err(format!(
                "{name} is over the displacement of `{id}`, which does not drive the cam at a constant ratio"
            ));
        };
        let repeats = |period: f64| {
            let times = TAU / (period * ratio).abs();
            (times - times.round()).abs() <= 1e-9 && times > 0.5
        };
        match track.breaks.period.is_some_and(repeats) {
            true => Ok(()),
            false => Err(format!(
                "{name} does not repeat with each turn of the cam: it is over the displacement of `{id}`"
            )),
        }
    }

    /// The angle of the cam over the displacement x of a node that drives it by constant
    /// ratios, r·x + s; `None`: it does not.
    fn cam_over(&self, node: usize) -> Option<[f64; 2]> {
        self.model.constant_ratio(self.law.driver, node)
    }

    /// The pieces of the law, cut where a load over the cam's angle has a break.
    fn smooth_pieces(&self, motion: &FollowerMotion) -> Result<Vec<[f64; 2]>, String> {
        let (from, to) = motion.range();
        let mut edges: Vec<f64> = motion.pieces().iter().map(|piece| piece.from).collect();
        edges.push(to);
        for (_, load) in &self.loads {
            let LoadLaw::Pieces { track, .. } = &load.law else {
                continue;
            };
            let track = &self.model.tracks[*track];
            let TrackSource::Node(node) = track.source else {
                continue;
            };
            let Some([ratio, offset]) = self.cam_over(node) else {
                continue;
            };
            let over = [(from - offset) / ratio, (to - offset) / ratio];
            let mut segment = track.breaks.segment_at(over[0].min(over[1]), 1.0);
            loop {
                let edge = track.breaks.edges(segment).1;
                // Written so that an edge that is no number ends the search.
                if !(edge < over[0].max(over[1])) {
                    break;
                }
                edges.push(ratio * edge + offset);
                segment += 1;
                if edges.len() > MOST_PIECES {
                    return Err(format!("{} changes too often within a turn", load.name));
                }
            }
        }
        edges.sort_by(f64::total_cmp);
        let least = 1e-12 * (to - from);
        edges.dedup_by(|b, a| *b - *a <= least);
        Ok(edges.windows(2).map(|pair| [pair[0], pair[1]]).collect())
    }

    /// The pair.
    pub(super) fn pair(&self) -> Pair {
        self.pair
    }

    /// Factor from the law to the follower's displacement.
    pub(super) fn lever(&self) -> f64 {
        self.law.lever
    }

    /// Inertia of the follower itself with all that hangs on it by constant
    /// ratios or not, at φ.
    pub(super) fn inertia(&self, cam: &DiscCam, piece: usize, phi: f64) -> f64 {
        let [q, ..] = self.follower(cam, piece, phi);
        let ratios = self.ratios(q, 1.0);
        let terms = self.nodes.iter().zip(&ratios);
        terms
            .map(|(&node, ratio)| self.model.nodes[node].inertia * ratio.first * ratio.first)
            .sum()
    }

    /// q, q′, q″ of the follower at φ of one of [`Self::pieces`].
    pub(super) fn follower(&self, cam: &DiscCam, piece: usize, phi: f64) -> [f64; 3] {
        let [from, to] = self.pieces[piece];
        let motion = cam.motion();
        let jet = motion.jet(motion.piece_at(0.5 * (from + to)).0, phi);
        let (lever, outward) = (self.law.lever, cam.geometry().outward);
        [
            lever * (motion.innermost() + outward * jet.value),
            lever * outward * jet.first,
            lever * outward * jet.second,
        ]
    }

    /// Displacements of all nodes over the follower's, at its displacement q: values, r and
    /// r₂. The sign of `sense` is that in which the follower moves.
    fn ratios(&self, q: f64, sense: f64) -> Vec<Jet> {
        let mut found: Vec<Jet> = Vec::with_capacity(self.nodes.len());
        for &node in &self.nodes {
            let own = Jet {
                value: q,
                first: 1.0,
                ..Jet::default()
            };
            let ratio = match self.model.nodes[node].motion.law() {
                Some(law) if law.driver != self.law.driver || node != self.first => {
                    match self.nodes.iter().position(|&other| other == law.driver) {
                        Some(place) => {
                            let driver = found[place];
                            let sense = sense * driver.first;
                            transfer(self.model, law, driver.value, sense).composed_with(driver)
                        }
                        // Another mass of the follower itself.
                        None => own,
                    }
                }
                _ => own,
            };
            found.push(ratio);
        }
        found
    }

    /// Demand on the pair at φ of one of [`Self::pieces`], without the closing springs.
    pub(super) fn demand(&self, cam: &DiscCam, piece: usize, phi: f64) -> Demand {
        let [q, first, second] = self.follower(cam, piece, phi);
        let ratios = self.ratios(q, first);
        let mut found = Demand {
            stretch: self.pair.opens * q,
            ..Demand::default()
        };
        if let Some(behind) = self.behind {
            let ratio = ratios[behind.place];
            found.stretch = behind.sense * ratio.value;
            found.lever = (self.pair.opens * ratio.first).abs();
        }
        for (&node, ratio) in self.nodes.iter().zip(&ratios) {
            let acceleration = ratio.first * second + ratio.second * first * first;
            found.by_square += self.model.nodes[node].inertia * acceleration * ratio.first;
        }
        for &(place, load) in &self.loads {
            let ratio = ratios[place];
            let closing = self.springs.contains(&load.name);
            match &load.law {
                LoadLaw::Linear(law) => {
                    found.by_speed += law.damping * ratio.first * ratio.first * first;
                    if !closing {
                        found.fixed -= (law.force - law.rate * ratio.value) * ratio.first;
                    }
                }
                LoadLaw::Pieces { track, pieces } => {
                    let track = &self.model.tracks[*track];
                    let x = self.table_argument(track, phi, q, &ratios);
                    // (Of what the angle of the cam gives, the piece is known beyond rounding.)
                    let at = match track.source {
                        TrackSource::Node(node) if !self.nodes.contains(&node) => {
                            let middle = 0.5 * (self.pieces[piece][0] + self.pieces[piece][1]);
                            self.table_argument(track, middle, q, &ratios)
                        }
                        _ => x,
                    };
                    found.fixed -= linear_load_at(track, pieces, x, at) * ratio.first;
                }
                // (What is not summed up here was refused, or is told as left out.)
                LoadLaw::Stop(_)
                | LoadLaw::Dry { .. }
                | LoadLaw::Written(_)
                | LoadLaw::Function { .. } => {}
            }
        }
        found.by_square *= self.pair.opens;
        found.by_speed *= self.pair.opens;
        found.fixed *= self.pair.opens;
        found
    }

    /// The argument of a load's table.
    fn table_argument(&self, track: &Track, phi: f64, q: f64, ratios: &[Jet]) -> f64 {
        match track.source {
            TrackSource::Node(node) => match self.nodes.iter().position(|&other| other == node) {
                Some(place) => ratios[place].value,
                None => self
                    .cam_over(node)
                    .map_or(q, |[ratio, offset]| (phi - offset) / ratio),
            },
            TrackSource::Time => phi,
        }
    }
}

fn pair_of(model: &Model, object: usize) -> Pair {
    model.pair(&model.objects[object]).unwrap_or(Pair {
        closure: Closure::Bilateral,
        gap: 0.0,
        opens: 1.0,
        form: crate::dynamics::model::ContactForm::default(),
    })
}

/// A table's force at x, by the piece that holds `at`.
fn linear_load_at(track: &Track, pieces: &[LinearPiece], x: f64, at: f64) -> f64 {
    let (index, shift) = track.breaks.piece(track.breaks.segment_at(at, 1.0));
    pieces.get(index).map_or(0.0, |piece| {
        piece.value + piece.slope * (x - shift - piece.start)
    })
}
