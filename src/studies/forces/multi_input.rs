//! Kinetostatics of linkages of several inputs: the same study over their course.

use super::columns::columns_of_inputs;
use super::course::{Course, PositionSource};
use super::request::count;
use super::{ForceSettings, ForceStudy, solved};
use crate::fault::Fault;
use crate::kinematics::linkage::kinetostatics::{Kinetostatics, Options};
use crate::kinematics::linkage::multi::MultiMotion;
use crate::kinematics::linkage::multi::spec::MultiSpec;
use crate::studies::endless::DeadEnd;
use crate::studies::kinematics::AskedSeveral;

/// What belongs to several inputs.
#[derive(Clone, Debug)]
pub struct SeveralDrives {
    /// The linkage with its inputs.
    pub spec: MultiSpec,
    /// Motion of the inputs, in words.
    pub motion: String,
    /// What leads from row to row: `input coordinate`, `time` or `path`.
    pub axis: &'static str,
    /// Its SI unit; empty of a path, which goes from 0 to 1.
    pub unit: &'static str,
}

/// Forces in all pairs of a linkage of several inputs, and the driving force at each of these,
/// for a motion of all of them. Loads on inputs are among what drives them; loads on outputs
/// and what hangs on them are left out.
///
/// # Errors
///
/// Faults of the linkage's numbers. A position that cannot be solved is no error: its row
/// says why.
pub fn multi_input_forces(
    asked: &AskedSeveral<'_>,
    options: Options,
) -> Result<ForceStudy, Vec<Fault>> {
    let spec = asked.linkage.spec();
    let kinetostatics = Kinetostatics::of_inputs(spec)?;
    let [from, to] = asked.span();
    let closed = asked.closed;
    let course = Course::Even {
        from,
        to,
        count: count(asked.positions, [from, to], closed),
        // Where the inputs have speeds that are not those of their way, no work is done on it.
        speed: match asked.is_uniform() {
            true => asked.axis_rate(),
            false => 0.0,
        },
        acceleration: 0.0,
        closed,
    };
    let mut source = Source {
        asked,
        motion: MultiMotion::new(&asked.linkage),
    };
    let settings = ForceSettings {
        options,
        ..ForceSettings::default()
    };
    let columns = columns_of_inputs(spec);
    let mut study = solved(&kinetostatics, &mut source, course, settings, columns);
    let (axis, unit) = asked.axis();
    study.several = Some(SeveralDrives {
        spec: spec.clone(),
        motion: asked.motion(),
        axis,
        unit,
    });
    Ok(study)
}

/// The linkage at places of the axis.
struct Source<'q, 'a> {
    asked: &'q AskedSeveral<'a>,
    motion: MultiMotion,
}

impl PositionSource for Source<'_, '_> {
    type At = MultiMotion;

    fn at(&mut self, place: f64) -> Result<&MultiMotion, String> {
        let inputs = self.asked.inputs_at(place);
        if let Err(why) = self.motion.set_inputs(&inputs) {
            // From a singular position on it does not find its way: it starts anew.
            let mut anew = MultiMotion::new(&self.asked.linkage);
            anew.set_inputs(&inputs)
                .map_err(|_| self.asked.cause_in_words(why))?;
            self.motion = anew;
        }
        Ok(&self.motion)
    }

    fn limits(&self) -> Vec<DeadEnd> {
        self.asked.dead_ends()
    }
}
