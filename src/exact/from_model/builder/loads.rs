//! Loads on the masses of the trees.

use super::{Builder, Moved, Role, load};
use crate::dynamics::model::{Load, LoadLaw, ObjectPart, TrackSource};
use crate::exact::from_model::prescribed::PrescribedMotion;
use crate::exact::{TimeLoad, TreeMass};

impl<'m> Builder<'m> {
    /// Adds a load to the mass that it acts on.
    pub(super) fn load(&mut self, load: &'m Load) {
        let Role::Moved(on) = self.roles[load.node] else {
            return;
        };
        let mass = &mut self.trees[on.tree].problem.masses[on.mass];
        let r = on.ratio;
        match &load.law {
            LoadLaw::Constant(force) => add_constant(mass, r * force),
            LoadLaw::Spring { rate, preload } => {
                mass.ground_stiffness += r * r * rate;
                add_constant(mass, -r * preload);
                // The mass's own offset is in its spring's force already.
                add_constant(mass, -r * rate * on.offset);
            }
            LoadLaw::Viscous(damping) => mass.ground_damping += r * r * damping,
            LoadLaw::Pieces { track, pieces } => {
                let track = &self.model.tracks[*track];
                let breaks = &track.breaks;
                let made = match track.source {
                    TrackSource::Time => load::table(breaks, pieces, r)
                        .or_else(|| Some(load::load(PrescribedMotion::time(), breaks, pieces, r))),
                    TrackSource::Node(node) => match &self.roles[node] {
                        Role::Prescribed(course, _) => {
                            Some(load::load(course.clone(), breaks, pieces, r))
                        }
                        _ => None,
                    },
                };
                match made {
                    Some(made) => mass.loads.push(made),
                    None => self.refuse_load(
                        load,
                        on,
                        "depends on a displacement that is not prescribed",
                    ),
                }
            }
            LoadLaw::Friction { .. } => {
                self.refuse_load(load, on, "is friction, which is not linear")
            }
            LoadLaw::Stop(_) => {
                self.refuse_load(load, on, "presses on one side alone, at a place of its own");
            }
            LoadLaw::Custom { .. } => self.refuse_load(load, on, "is not known to be linear"),
            LoadLaw::LinearMotor { .. } | LoadLaw::Kloss { .. } | LoadLaw::SpeedTable(_) => {
                self.refuse_load(load, on, "is a motor's torque over its speed");
            }
        }
    }

    fn refuse_load(&mut self, load: &Load, on: Moved, reason: &str) {
        self.spoiled[on.tree] = true;
        let holds = |part: &ObjectPart| part.nodes.contains(&load.node);
        let object = self.model.objects.iter().position(holds).unwrap_or(0);
        let name = load.name.rsplit('.').next().unwrap_or(&load.name);
        let what = match load.law {
            LoadLaw::Stop(_) => "stop",
            _ => "load",
        };
        let reason = format!("its {what} `{name}` {reason}");
        let id = &self.model.objects[object].id;
        // A load on all masses is one load.
        if !self
            .refusals
            .iter()
            .any(|r| r.object == *id && r.reason == reason)
        {
            self.refuse(object, reason);
        }
    }
}

fn add_constant(mass: &mut TreeMass, force: f64) {
    if force == 0.0 {
        return;
    }
    for load in &mut mass.loads {
        if let TimeLoad::Constant(value) = load {
            *value += force;
            return;
        }
    }
    mass.loads.push(TimeLoad::Constant(force));
}
