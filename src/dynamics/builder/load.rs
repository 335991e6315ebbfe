//! Loads on the masses of an object.

use super::pieces::{self, Pieces};
use super::spec::{LoadLawSpec, LoadSpec, MassChoice};
use super::written::NO_NODE_YET;
use super::{FREE_FALL, ModelBuilder, Place};
use crate::dynamics::model::{
    Coordinate, DryFriction, Load, LoadLaw, NodeIndex, TrackSource, WrittenLoad,
};
use crate::dynamics::stated::{LoadStatement, StatedLoad};
use crate::fault::Faults;
use crate::math::expression::Expression;

impl ModelBuilder {
    /// Lowers a load on an object with the given nodes; `driver` is the node
    /// over whose displacement windows and position tables run that name no other.
    pub fn load(&mut self, at: &Place, spec: &LoadSpec, nodes: &[NodeIndex], driver: NodeIndex) {
        let path = at.path(&format!("loads.{}", spec.name));
        self.load_at(path, at.object, spec, nodes, driver);
    }

    /// Adds a load, with its address, on the nodes of an object or of an output.
    pub(super) fn load_at(
        &mut self,
        path: String,
        object: usize,
        spec: &LoadSpec,
        nodes: &[NodeIndex],
        driver: NodeIndex,
    ) {
        let Some(chosen) = nodes_of_choice(spec.mass, nodes) else {
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
        for &node in chosen {
            // Faults of the law are the same for every mass: say them once.
            if self
                .load_on(&path, &spec.law, object, [node, driver])
                .is_none()
            {
                return;
            }
        }
    }

    /// Adds a load, with its address, on a node behind a driver; `None`: the law has faults.
    pub(super) fn load_on(
        &mut self,
        path: &str,
        spec: &LoadLawSpec,
        object: usize,
        [node, driver]: [NodeIndex; 2],
    ) -> Option<()> {
        let law = self.load_law(path, spec, object, node, driver)?;
        self.model.loads.push(Load {
            node,
            name: path.to_owned(),
            law,
        });
        if let Some(stated) = stated(spec) {
            self.state_load(stated, self.axis(spec, driver).unwrap_or(driver));
        }
        match spec {
            LoadLawSpec::Written(written) => self.wait_for(path, written.over.as_ref()),
            LoadLawSpec::Dry { over, .. } => self.wait_for(path, over.as_ref()),
            LoadLawSpec::Constant(_)
            | LoadLawSpec::TimeTable(_)
            | LoadLawSpec::PositionTable { .. }
            | LoadLawSpec::Window { .. }
            | LoadLawSpec::Declared(_)
            | LoadLawSpec::Weight { .. }
            | LoadLawSpec::SpeedTable(_)
            | LoadLawSpec::Custom(_) => {}
        }
        Some(())
    }

    /// The node whose displacement is the axis of a table or window; `None`: the object that it
    /// names has none yet.
    fn axis(&self, spec: &LoadLawSpec, driver: NodeIndex) -> Option<NodeIndex> {
        let over = match spec {
            LoadLawSpec::PositionTable { over, .. } | LoadLawSpec::Window { over, .. } => over,
            // (An expression reads what it is over beside its driver.)
            LoadLawSpec::Written(_)
            | LoadLawSpec::Constant(_)
            | LoadLawSpec::TimeTable(_)
            | LoadLawSpec::Declared(_)
            | LoadLawSpec::Dry { .. }
            | LoadLawSpec::Weight { .. }
            | LoadLawSpec::SpeedTable(_)
            | LoadLawSpec::Custom(_) => &None,
        };
        match over {
            Some(over) => self.outputs.get(over).copied(),
            None => Some(driver),
        }
    }

    /// Gives a track that waits for the node of another object this node.
    pub(super) fn connect_track(&mut self, waiting: usize, node: NodeIndex) {
        self.model.tracks[waiting].source = TrackSource::Node(node);
        let stated = &mut self.model.stated.loads;
        for (index, load) in self.model.loads.iter().enumerate() {
            let on_it = load.law.pieces().is_some_and(|own| own.0 == waiting);
            if let Some(statement) = stated.get_mut(&index).filter(|_| on_it) {
                statement.driver = node;
            }
        }
    }

    /// Notes what the scene states of the load added last.
    fn state_load(&mut self, stated: StatedLoad, driver: NodeIndex) {
        let last = self.model.loads.len() - 1;
        let statement = LoadStatement {
            law: stated,
            driver,
            share: 1.0,
        };
        self.model.stated.loads.insert(last, statement);
    }

    pub(super) fn load_law(
        &mut self,
        path: &str,
        spec: &LoadLawSpec,
        object: usize,
        node: NodeIndex,
        driver: NodeIndex,
    ) -> Option<LoadLaw> {
        let over_position = TrackSource::Node(self.axis(spec, driver).unwrap_or(NO_NODE_YET));
        let (source, pieces, property) = match spec {
            LoadLawSpec::TimeTable(points) => {
                (TrackSource::Time, pieces::table(points), "time_table")
            }
            LoadLawSpec::PositionTable {
                points,
                period: None,
                ..
            } => (
                over_position,
                pieces::table(points),
                "position_table.points",
            ),
            LoadLawSpec::PositionTable {
                points,
                period: Some(period),
                ..
            } => {
                let pieces = pieces::repeating_table(points, *period);
                (over_position, pieces, "position_table")
            }
            LoadLawSpec::Window {
                from,
                to,
                force,
                period,
                ..
            } => {
                let pieces = pieces::window([*from, *to], *force, *period);
                (over_position, pieces, "window")
            }
            LoadLawSpec::Written(written) => {
                return self.expression_law(path, written, node, driver);
            }
            LoadLawSpec::Dry {
                friction,
                engagement,
                ..
            } => return self.dry_law(path, *friction, engagement.as_ref(), [node, driver]),
            _ => return self.smooth_law(path, spec, object, node),
        };
        match pieces {
            Ok(Pieces { breaks, pieces }) => {
                let track = match (source, spec.over()) {
                    (TrackSource::Node(NO_NODE_YET), Some(over)) => {
                        self.waiting_track(path, over, breaks, object)
                    }
                    _ => self.track(source, (breaks, false), object),
                };
                Some(match track {
                    Some(track) => LoadLaw::Pieces { track, pieces },
                    // A single piece without an end.
                    None => LoadLaw::constant(pieces.first().map_or(0.0, |piece| piece.value)),
                })
            }
            Err(found) => {
                self.faults.absorb(&format!("{path}.{property}"), found);
                None
            }
        }
    }

    /// Laws that need no track.
    fn smooth_law(
        &mut self,
        path: &str,
        spec: &LoadLawSpec,
        object: usize,
        node: NodeIndex,
    ) -> Option<LoadLaw> {
        let mut faults = Faults::default();
        let law = match *spec {
            LoadLawSpec::Custom(ref load) => Some(LoadLaw::of(load.0.clone())),
            LoadLawSpec::Constant(force) => {
                faults.finite("constant", force);
                Some(LoadLaw::constant(force))
            }
            LoadLawSpec::Declared(ref declared) => {
                declared.check(&mut faults);
                Some(declared.law())
            }
            LoadLawSpec::SpeedTable(ref points) => {
                faults.points("table", points, 1);
                Some(LoadLaw::speed_table(points.clone()))
            }
            LoadLawSpec::Weight { inclination } => {
                faults.finite("weight.inclination", inclination);
                if self.model.objects[object].coordinate == Coordinate::Turning {
                    let message = "the weight of a turning object has no constant moment";
                    let hint = "weight is for sliding objects; give a load over the position";
                    faults.add("weight", message, hint);
                }
                let mass = self.model.nodes[node].inertia;
                Some(LoadLaw::constant(-mass * FREE_FALL * inclination.sin()))
            }
            LoadLawSpec::Written(_)
            | LoadLawSpec::TimeTable(_)
            | LoadLawSpec::PositionTable { .. }
            | LoadLawSpec::Window { .. }
            | LoadLawSpec::Dry { .. } => None,
        };
        match faults.check() {
            Ok(()) => law,
            Err(found) => {
                self.faults.absorb(path, found);
                None
            }
        }
    }

    /// Dry friction, with faults of its numbers. What never rubs is no load.
    fn dry_law(
        &mut self,
        path: &str,
        friction: DryFriction,
        engagement: Option<&Expression>,
        [node, driver]: [NodeIndex; 2],
    ) -> Option<LoadLaw> {
        let mut faults = Faults::default();
        faults.not_negative("friction.sliding", friction.sliding);
        if !(friction.static_limit >= friction.sliding) {
            let hint = "friction at rest is at least that of sliding; leave out `static` where they are equal";
            let message = "`static` is less than `sliding`";
            faults.add("friction.static", message, hint);
        }
        if let Some(speed) = friction.stribeck_speed {
            faults.positive("friction.stribeck_speed", speed);
        }
        if let Err(found) = faults.check() {
            self.faults.absorb(path, found);
            return None;
        }
        let always = engagement.and_then(|own| own.program().value.constant());
        let friction = always.map_or(friction, |by| friction.scaled(by.max(0.0)));
        Some(match friction.static_limit == 0.0 {
            true => LoadLaw::constant(0.0),
            false => LoadLaw::Dry {
                friction,
                engagement: engagement
                    .filter(|_| always.is_none())
                    .map(|expression| WrittenLoad::of(expression.clone(), 1.0, [node, driver])),
            },
        })
    }
}

/// The nodes a load acts on; `None` when there is no such mass.
fn nodes_of_choice(mass: MassChoice, nodes: &[NodeIndex]) -> Option<&[NodeIndex]> {
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

/// A load in the terms of the scene; `None`: it is supplied in code.
fn stated(law: &LoadLawSpec) -> Option<StatedLoad> {
    Some(match law {
        LoadLawSpec::Constant(force) => StatedLoad::Constant(*force),
        LoadLawSpec::TimeTable(points) => StatedLoad::OverTime(points.clone()),
        LoadLawSpec::PositionTable { points, period, .. } => {
            StatedLoad::OverDriver(points.clone(), *period)
        }
        LoadLawSpec::Window {
            from,
            to,
            force,
            period,
            ..
        } => StatedLoad::Window {
            between: [*from, *to],
            force: *force,
            period: *period,
        },
        LoadLawSpec::Declared(declared) => StatedLoad::declared(declared)?,
        LoadLawSpec::SpeedTable(points) => StatedLoad::OverSpeed(points.clone()),
        LoadLawSpec::Weight { inclination } => StatedLoad::Weight(*inclination),
        LoadLawSpec::Written(written) => StatedLoad::Written {
            expression: written.expression.clone(),
            factor: written.factor,
        },
        // (Its check reads the model: at rest its force is a reaction.)
        LoadLawSpec::Dry { .. } | LoadLawSpec::Custom(_) => return None,
    })
}
