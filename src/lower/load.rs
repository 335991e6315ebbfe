//! Loads on the masses of an object.

use super::{FREE_FALL, Lowering};
use crate::breaks::Breaks;
use crate::fault::Faults;
use crate::model::{Coordinate, LinearPiece, Load, LoadLaw, NodeIndex, TrackSource};
use crate::object::spec::{LoadLawSpec, LoadSpec, MassChoice};

/// A piecewise-linear function of an axis.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Pieces {
    pub(super) breaks: Breaks,
    /// One for each piece of the breaks.
    pub(super) pieces: Vec<LinearPiece>,
}

impl<'a> Lowering<'a> {
    /// Lowers a load on an object with the given nodes; `driver` is the node
    /// over whose displacement windows and position tables run.
    pub(super) fn load(&mut self, id: &str, spec: &LoadSpec, nodes: &[NodeIndex], driver: usize) {
        let path = format!("{id}.loads.{}", spec.name);
        let Some(chosen) = chosen(spec.mass, nodes) else {
            if let MassChoice::Number(number) = spec.mass {
                let message = format!(
                    "there is no mass {number}, the masses are 1 to {}",
                    nodes.len()
                );
                let hint = "give one of these, `first`, `last` or `all`";
                self.faults.add(format!("{path}.mass"), message, hint);
            }
            return;
        };
        let object = self.indices[id];
        for &node in chosen {
            // Faults of the law are the same for every mass: say them once.
            let Some(law) = self.load_law(&path, &spec.law, object, node, driver) else {
                return;
            };
            self.model.loads.push(Load {
                node,
                name: path.clone(),
                law,
            });
        }
    }

    fn load_law(
        &mut self,
        path: &str,
        spec: &LoadLawSpec,
        object: usize,
        node: NodeIndex,
        driver: NodeIndex,
    ) -> Option<LoadLaw> {
        let mut faults = Faults::default();
        let law = match *spec {
            LoadLawSpec::Constant(force) => {
                faults.finite(&format!("{path}.constant"), force);
                LoadLaw::Constant(force)
            }
            LoadLawSpec::TimeTable(ref points) => {
                let pieces = table(&mut faults, &format!("{path}.time_table"), points, None)
                    .unwrap_or_default();
                self.pieces(TrackSource::Time, pieces, object)
            }
            LoadLawSpec::PositionTable { ref points, period } => {
                let path = format!("{path}.position_table");
                let pieces = table(&mut faults, &path, points, period).unwrap_or_default();
                self.pieces(TrackSource::Node(driver), pieces, object)
            }
            LoadLawSpec::Window {
                from,
                to,
                force,
                period,
            } => {
                let path = format!("{path}.window");
                let pieces = window(&mut faults, &path, [from, to], force, period);
                self.pieces(
                    TrackSource::Node(driver),
                    pieces.unwrap_or_default(),
                    object,
                )
            }
            LoadLawSpec::Spring { rate, preload } => {
                faults.not_negative(&format!("{path}.spring.rate"), rate);
                faults.finite(&format!("{path}.spring.preload"), preload);
                LoadLaw::Spring { rate, preload }
            }
            LoadLawSpec::Viscous(damping) => {
                faults.not_negative(&format!("{path}.viscous"), damping);
                LoadLaw::Viscous(damping)
            }
            LoadLawSpec::Weight { inclination } => {
                faults.finite(&format!("{path}.weight.inclination"), inclination);
                if self.model.objects[object].coordinate == Coordinate::Turning {
                    let message = "the weight of a turning object has no constant moment";
                    let hint = "weight is for sliding objects; give a load over the position";
                    faults.add(format!("{path}.weight"), message, hint);
                }
                let mass = self.model.nodes[node].inertia;
                LoadLaw::Constant(-mass * FREE_FALL * inclination.sin())
            }
            LoadLawSpec::Friction { force, width } => {
                faults.not_negative(&format!("{path}.friction.force"), force);
                faults.positive(&format!("{path}.friction.width"), width);
                LoadLaw::Friction { force, width }
            }
        };
        match faults.check() {
            Ok(()) => Some(law),
            Err(found) => {
                self.faults.append(found);
                None
            }
        }
    }

    /// A piecewise law with its track; a single piece without breaks is constant.
    fn pieces(&mut self, source: TrackSource, pieces: Pieces, object: usize) -> LoadLaw {
        let Pieces { breaks, pieces } = pieces;
        let track = match source {
            TrackSource::Time => self.time_track(breaks, object),
            TrackSource::Node(_) => self.track(source, breaks, object),
        };
        match track {
            Some(track) => LoadLaw::Pieces { track, pieces },
            None => LoadLaw::Constant(pieces.first().map_or(0.0, |piece| piece.value)),
        }
    }
}

/// The nodes a load acts on; `None` when there is no such mass.
fn chosen(mass: MassChoice, nodes: &[NodeIndex]) -> Option<&[NodeIndex]> {
    let (first, last) = (nodes.first()?, nodes.last()?);
    match mass {
        MassChoice::First => Some(std::slice::from_ref(first)),
        MassChoice::Last => Some(std::slice::from_ref(last)),
        MassChoice::All => Some(nodes),
        MassChoice::Number(number) => number
            .checked_sub(1)
            .and_then(|index| nodes.get(index))
            .map(std::slice::from_ref),
    }
}

/// Straight lines between points; outside, constant or repeating.
pub(super) fn table(
    faults: &mut Faults,
    path: &str,
    points: &[(f64, f64)],
    period: Option<f64>,
) -> Option<Pieces> {
    let points_path = match period {
        Some(_) => format!("{path}.points"),
        None => path.to_owned(),
    };
    faults.points(&points_path, points, 2);
    if let Some(period) = period {
        faults.positive(&format!("{path}.period"), period);
    }
    if !faults.is_empty() {
        return None;
    }
    let mut points = points.to_vec();
    let (first, last) = (points[0], points[points.len() - 1]);
    let Some(period) = period else {
        let mut pieces = vec![flat(first)];
        pieces.extend(points.windows(2).map(|ends| line(ends[0], ends[1])));
        pieces.push(flat(last));
        return Some(Pieces {
            breaks: breaks(&points, None),
            pieces,
        });
    };
    let left = period - (last.0 - first.0);
    let closes = left.abs() <= 1e-9 * period;
    if left < 0.0 && !closes {
        let message = format!(
            "the points reach over {}, more than the period",
            last.0 - first.0
        );
        faults.add(
            format!("{path}.period"),
            message,
            "give the points of one period",
        );
    }
    if closes && last.1 != first.1 {
        let message = format!(
            "one period after {} the load is not {} but {}",
            first.0, first.1, last.1
        );
        let hint = "repeat the first value there, or leave that point out";
        let at = format!("{points_path}[{}]", points.len() - 1);
        faults.add(at, message, hint);
    }
    if !faults.is_empty() {
        return None;
    }
    if closes {
        points.pop();
    }
    let closing = (first.0 + period, first.1);
    let mut pieces: Vec<_> = points
        .windows(2)
        .map(|ends| line(ends[0], ends[1]))
        .collect();
    pieces.push(line(points[points.len() - 1], closing));
    Some(Pieces {
        breaks: breaks(&points, Some(period)),
        pieces,
    })
}

/// A force within a window, nothing outside.
pub(super) fn window(
    faults: &mut Faults,
    path: &str,
    [from, to]: [f64; 2],
    force: f64,
    period: Option<f64>,
) -> Option<Pieces> {
    faults.finite(&format!("{path}.from"), from);
    faults.finite(&format!("{path}.to"), to);
    faults.finite(&format!("{path}.force"), force);
    if to <= from {
        let message = format!("the window ends at {to}, not after its start {from}");
        faults.add(format!("{path}.to"), message, "give an end after the start");
    }
    if let Some(period) = period {
        faults.positive(&format!("{path}.period"), period);
        if to - from > period * (1.0 + 1e-12) {
            let message = format!("the window is longer than its period {period}");
            faults.add(format!("{path}.to"), message, "end it within one period");
        }
    }
    if !faults.is_empty() {
        return None;
    }
    let ends = [(from, force), (to, 0.0)];
    let (inside, outside) = (flat(ends[0]), flat(ends[1]));
    let always = period.is_some_and(|period| to - from >= period * (1.0 - 1e-12));
    Some(match period {
        _ if always => Pieces {
            breaks: Breaks::NONE,
            pieces: vec![inside],
        },
        Some(_) => Pieces {
            breaks: breaks(&ends, period),
            pieces: vec![inside, outside],
        },
        None => Pieces {
            breaks: breaks(&ends, None),
            pieces: vec![outside, inside, outside],
        },
    })
}

fn breaks(points: &[(f64, f64)], period: Option<f64>) -> Breaks {
    Breaks {
        points: points.iter().map(|point| point.0).collect(),
        period,
    }
}

fn flat((start, value): (f64, f64)) -> LinearPiece {
    LinearPiece {
        start,
        value,
        slope: 0.0,
    }
}

fn line(from: (f64, f64), to: (f64, f64)) -> LinearPiece {
    LinearPiece {
        start: from.0,
        value: from.1,
        slope: (to.1 - from.1) / (to.0 - from.0),
    }
}
