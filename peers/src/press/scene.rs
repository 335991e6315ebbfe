//! The scene: `scenarios/press/ejector.json`, with any number of masses.

use dam::integrate::{Dynamics, EventFunction, Modes};
use dam::lower::lower;
use dam::scene::{BuiltIn, Document, Overrides};
use dam::system::System;

/// The object whose δ is looked at.
const OBJECT: &str = "ejector";

/// The press as every solver needs it.
pub(crate) struct Press {
    /// The equations.
    pub(crate) system: System,
    /// State just after t = 0.
    pub(crate) start: Vec<f64>,
    /// Discrete state then.
    pub(crate) modes: Modes,
    /// What is watched: while the pair is engaged, while it is open. Both hold
    /// the same two functions of the state; their lesser one is positive
    /// exactly while the pair is engaged.
    pub(crate) watches: [EventFunction; 2],
    /// Which coordinate is δ.
    pub(crate) delta: usize,
    /// Time to be simulated (s).
    pub(crate) duration: f64,
    /// Coordinates in the order of the equations written by hand: motor,
    /// flywheel, crankshaft, ram, the ejector's masses.
    order: Vec<usize>,
}

impl Press {
    /// With a number of masses for the ejector.
    ///
    /// # Errors
    /// The scene is not what it is taken for.
    pub(crate) fn new(masses: usize) -> Result<Self, String> {
        let text = include_bytes!("../../../scenarios/press/ejector.json");
        let document = Document::parse("ejector.json", text).map_err(|d| d.to_string())?;
        let overrides = Overrides::new([format!("ejector.masses={masses}")]);
        let reading = document
            .scene(&BuiltIn, &overrides)
            .map_err(|diagnostics| diagnostics.to_string())?;
        let model = lower(&reading.scene).map_err(|faults| format!("{faults:?}"))?;
        let named = |part: &dam::model::ObjectPart| part.id == OBJECT;
        let object = model.objects.iter().position(named).ok_or("no ejector")?;
        let duration = reading.scene.run.duration;
        let system = System::new(model).map_err(|faults| format!("{faults:?}"))?;
        let initial = system.initial_state().map_err(|f| format!("{f:?}"))?;
        let delta = system.last_coordinate(object).ok_or("a rigid ejector")?;
        let pair = system.pair_component(object).ok_or("a bilateral pair")?;
        let watched = |modes: &Modes| {
            let mut watches = Vec::new();
            system.event_functions(modes, &mut watches);
            match watches.as_slice() {
                [only] if only.component == pair => Ok(*only),
                other => Err(format!("{} switches to look for", other.len())),
            }
        };
        let engaged = watched(&initial.modes)?;
        let mut open = initial.modes.clone();
        open.0[pair] = engaged.target;
        let watches = [engaged, watched(&open)?];
        if engaged.rising || watches[0].guards != watches[1].guards {
            return Err("the pair is open at the start".to_owned());
        }
        let mut order = Vec::new();
        for id in ["motor", "flywheel", "crankshaft", "ram", OBJECT] {
            let named = |part: &dam::model::ObjectPart| part.id == id;
            let object = system.model().objects.iter().position(named);
            let object = object.ok_or_else(|| format!("no {id}"))?;
            let last = system.last_coordinate(object).unwrap_or(0);
            let first = system.first_coordinate(object).unwrap_or(last);
            order.extend(first..=last);
        }
        Ok(Self {
            order,
            start: initial.y,
            modes: initial.modes,
            watches,
            delta,
            duration,
            system,
        })
    }

    /// A list over the state in the order of the equations written by hand, which
    /// have each speed behind its displacement.
    pub(crate) fn in_order(&self, list: &[f64]) -> Vec<f64> {
        let count = self.system.coordinates();
        let pair = |k: &usize| [list[*k], list[count + *k]];
        self.order.iter().flat_map(pair).collect()
    }

    /// Number of unknowns.
    pub(crate) fn unknowns(&self) -> usize {
        self.start.len()
    }

    /// Positive exactly while the pair is engaged; continuous through switches.
    pub(crate) fn pressing(&self, y: &[f64]) -> f64 {
        let count = self.system.coordinates();
        let guard = |guard: &dam::integrate::Guard| {
            guard.offset
                + guard.displacement * y[guard.signal]
                + guard.speed * y[count + guard.signal]
        };
        let [first, second] = &self.watches[0].guards;
        guard(first).min(guard(second))
    }

    /// The discrete state with the pair engaged or open.
    pub(crate) fn modes_with(&self, engaged: bool) -> Modes {
        let mut modes = self.modes.clone();
        let [leaving, closing] = &self.watches;
        let target = if engaged {
            closing.target
        } else {
            leaving.target
        };
        modes.0[leaving.component] = target;
        modes
    }
}
