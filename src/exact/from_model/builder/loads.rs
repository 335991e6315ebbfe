//! Loads on the masses of the trees.

use super::{Builder, MovedNode, Role, load};
use crate::dynamics::model::{
    LinearPiece, Load, LoadLaw, LoadVariable, ObjectPart, TrackSource, WrittenLoad,
};
use crate::exact::from_model::prescribed::PrescribedMotion;
use crate::exact::{TimeLoad, TreeMass};
use crate::kinematics::breaks::Breaks;
use crate::kinematics::motion::{DriveMotion, WrittenMotion};
use crate::math::expression::{Expression, Program};

/// Places at which the pieces of a load over time end that are found beforehand.
const FOLLOWED: usize = 1000;

impl<'m> Builder<'m> {
    /// Adds a load to the mass that it acts on.
    pub(super) fn load(&mut self, load: &'m Load) {
        let Role::Moved(on) = self.roles[load.node] else {
            return;
        };
        let mass = &mut self.trees[on.tree].problem.masses[on.mass];
        let r = on.ratio;
        match &load.law {
            LoadLaw::Linear(own) => {
                mass.ground_stiffness += r * r * own.rate;
                mass.ground_damping += r * r * own.damping;
                add_constant(mass, r * own.force);
                // The mass's own offset is in its spring's force already.
                add_constant(mass, -r * own.rate * on.offset);
            }
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
            LoadLaw::Stop(_) => {
                self.refuse_load(load, on, "presses on one side alone, at a place of its own");
            }
            LoadLaw::Dry { .. } => self.refuse_load(load, on, "is dry friction, which sticks"),
            LoadLaw::Written(written) => self.add_expression_load(load, on, written),
            LoadLaw::Function { function, .. } => {
                self.refuse_load(load, on, function.why_not_linear());
            }
        }
    }

    /// An expression: what of it is linear in the motion of its own mass is a spring and
    /// a damper, the rest a load over time.
    fn add_expression_load(&mut self, load: &'m Load, on: MovedNode, written: &WrittenLoad) {
        let expression = &written.expression;
        let own = |wanted: LoadVariable| -> Vec<usize> {
            let variables = written.variables.iter().enumerate();
            let read = variables.filter(|(index, variable)| {
                **variable == wanted && expression.program().reads(*index)
            });
            read.map(|(index, _)| index).collect()
        };
        let [places, speeds] = [
            own(LoadVariable::Displacement(load.node)),
            own(LoadVariable::Speed(load.node)),
        ];
        let both: Vec<usize> = places.iter().chain(&speeds).copied().collect();
        let Some(linear) = expression.affine_in(&both) else {
            return self.refuse_load(
                load,
                on,
                "is an expression that is not linear in its motion",
            );
        };
        let (by_place, by_speed) = linear.factors.split_at(places.len());
        let [rate, damping] =
            [by_place, by_speed].map(|factors| -written.factor * factors.iter().sum::<f64>());
        if rate < 0.0 || damping < 0.0 {
            return self.refuse_load(load, on, "pushes away from rest, or drives what moves");
        }
        let r = on.ratio;
        let over_time = match linear.rest.value.constant() {
            Some(value) => Some(TimeLoad::Constant(r * written.factor * value)),
            None => self.over_time(written, &linear.rest, r),
        };
        let Some(over_time) = over_time else {
            let reason = "depends on a displacement that is not prescribed at constant speed";
            return self.refuse_load(load, on, reason);
        };
        let mass = &mut self.trees[on.tree].problem.masses[on.mass];
        mass.ground_stiffness += r * r * rate;
        mass.ground_damping += r * r * damping;
        // The mass's own offset is in its spring's force already.
        add_constant(mass, -r * rate * on.offset);
        match over_time {
            TimeLoad::Constant(value) => add_constant(mass, value),
            other => mass.loads.push(other),
        }
    }

    /// What depends on time, and on what turns or slides at constant speed.
    fn over_time(&self, written: &WrittenLoad, rest: &Program, ratio: f64) -> Option<TimeLoad> {
        let line = |variable: &LoadVariable| match *variable {
            LoadVariable::Time => Some([1.0, 0.0]),
            LoadVariable::Displacement(node) | LoadVariable::Speed(node) => {
                let Role::Prescribed(course, _) = &self.roles[node] else {
                    return None;
                };
                let (speed, angle) = course.line()?;
                match variable {
                    LoadVariable::Displacement(_) => Some([speed, angle]),
                    _ => Some([0.0, speed]),
                }
            }
        };
        let lines: Vec<Option<[f64; 2]>> = written.variables.iter().map(line).collect();
        let function = Expression::along_a_line(rest, &lines)?;
        let factor = ratio * written.factor;
        if let Some(value) = function.value.constant() {
            return Some(TimeLoad::Constant(factor * value));
        }
        // (Beyond so many places pieces are found as they are reached.)
        let text = written.expression.text();
        let (motion, _) = WrittenMotion::of(&function, text, 1.0, FOLLOWED);
        let course = PrescribedMotion::new(&DriveMotion::Written(Box::new(motion)));
        let whole = LinearPiece {
            start: 0.0,
            value: 0.0,
            slope: 1.0,
        };
        Some(load::load(course, &Breaks::NONE, &[whole], factor))
    }

    fn refuse_load(&mut self, load: &Load, on: MovedNode, reason: &str) {
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
            self.note_refusal(object, reason);
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
