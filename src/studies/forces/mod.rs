//! Kinetostatics over a course of the input: reactions, driving force,
//! transmission ratios, efficiency, self-locking, balance of the frame.

mod closing;
mod columns;
mod counterweight;
mod course;
mod cycle;
mod ends;
mod extremes;
mod figures;
mod loads;
mod massless;
mod multi_input;
mod open;
mod request;
mod row;
mod scan;
mod zones;

pub use crate::studies::endless::DeadEnd;
pub use columns::{Column, columns, columns_of_inputs};
pub use counterweight::Counterweight;
pub use course::{Course, Instant, PositionSource};
pub use cycle::CycleForces;
pub use extremes::{Extreme, Extremes};
pub use figures::{described_results, figures, figures_of_inputs};
pub use loads::{ActingLoads, loads_left_out};
pub use massless::{MasslessComparison, MasslessPoint, NEGLIGIBLE, compare_massless};
pub use multi_input::{SeveralDrives, multi_input_forces};
pub use open::Rests;
pub use request::{
    ForceChoice, LinkagePositions, NoForces, course_of, course_of_record, forces_of,
    only_loaded_output,
};
pub use row::{Forces, LinkPlace, PairForces, Row, Trouble};
pub use zones::{Zone, ZoneKind};

use crate::fault::Fault;
use crate::kinematics::linkage::kinetostatics::{
    BAD_CONDITION, Convention, ForceFailure, Indeterminate, Kinetostatics, Options,
};
use crate::kinematics::linkage::spec::LinkageSpec;
use crate::studies::check::{Check, worst};
use crate::studies::judgement::{Judgement, RunEnd};
use crate::units::shown;
use row::Solver;

/// Greatest share of the power, and of the transfer functions, by which checks may be off.
const CHECKED: f64 = 1e-8;

/// Settings of a study of forces.
#[derive(Clone, Debug, PartialEq)]
pub struct ForceSettings {
    /// Options of the solution of each position.
    pub options: Options,
    /// The output whose load the dynamic transmission ratio refers to, index
    /// into the linkage's outputs.
    pub output: Option<usize>,
    /// The forces that make up the load; `None`: all forces, couples and tables
    /// on the output's link.
    pub loads: Option<Vec<usize>>,
    /// Sign of the dynamic transmission ratio.
    pub convention: Convention,
}

impl Default for ForceSettings {
    fn default() -> Self {
        Self {
            options: Options::default(),
            output: None,
            loads: None,
            convention: Convention::Paper,
        }
    }
}

/// Forces over a course, with everything drawn from them.
#[derive(Clone, Debug)]
pub struct ForceStudy {
    /// The course.
    pub course: Course,
    /// Settings: what was asked.
    pub settings: ForceSettings,
    /// The linkage.
    pub linkage: LinkageSpec,
    /// Rows, one a position; of a turn its end as well.
    pub rows: Vec<Row>,
    /// Least and greatest value of each quantity, between the positions too.
    pub extremes: Vec<Extremes>,
    /// Derivatives of the driving force that grow without bound: the column's name and the
    /// place towards which.
    pub unbounded: Vec<(String, f64)>,
    /// Work, losses and efficiency over the course; none where the input rests,
    /// or where there are no forces on the way.
    pub cycle: Option<CycleForces>,
    /// Intervals of self-locking, of no solution, and out of reach.
    pub zones: Vec<Zone>,
    /// Forces that rigid links leave open, at any of the positions.
    pub indeterminate: Indeterminate,
    /// The counterweight on the input link that reduces the shaking force most.
    pub counterweight: Option<Counterweight>,
    /// Names of the loads on the outputs that follow from the motion of the input: they act over a
    /// turn or a range.
    pub acting: Vec<String>,
    /// Of a linkage of several inputs what belongs to these.
    pub several: Option<SeveralDrives>,
}

/// Solves all positions of a course.
///
/// # Errors
///
/// Faults of the linkage's numbers. A position that cannot be solved is no
/// error: its row says why.
pub fn study<S: PositionSource>(
    linkage: &LinkageSpec,
    source: &mut S,
    course: Course,
    settings: ForceSettings,
) -> Result<ForceStudy, Vec<Fault>> {
    let kinetostatics = Kinetostatics::new(linkage)?;
    let columns = columns(linkage, settings.output);
    let mut study = solved(&kinetostatics, source, course, settings, columns);
    // The end of a turn counts once.
    study.counterweight =
        counterweight::fit_counterweight(linkage, &study.rows[..study.course.len()]);
    Ok(study)
}

/// Solves all positions of a course, of one input or of several.
fn solved<S: PositionSource>(
    kinetostatics: &Kinetostatics,
    source: &mut S,
    course: Course,
    settings: ForceSettings,
    mut columns: Vec<Column>,
) -> ForceStudy {
    let mut solver = Solver::new(kinetostatics, source, &settings);
    let acting = solver.load_names();
    let mut rows: Vec<Row> = (0..course.rows())
        .map(|index| {
            let mut row = solver.row(&course.instant(index), true);
            row.time = course.time(index);
            row
        })
        .collect();
    let zones = zones::find(&mut solver, &course);
    ends::remove_unbounded_forces(&mut solver, &course, &mut rows);
    // The end of a turn counts once.
    let positions = &rows[..course.len()];
    let indeterminate = open::indeterminate_anywhere(&rows);
    open::mark_indeterminate(&mut columns, &indeterminate);
    let (extremes, unbounded) = extremes::find(&mut solver, &course, positions, &zones, &columns);
    let cycle = match indeterminate.drive {
        true => None,
        false => cycle::sum(&mut solver, &course, positions),
    };
    ForceStudy {
        course,
        settings,
        linkage: kinetostatics.spec().clone(),
        rows,
        extremes,
        unbounded,
        cycle,
        zones,
        indeterminate,
        counterweight: None,
        acting,
        several: None,
    }
}

impl ForceStudy {
    /// Rows that were solved.
    pub fn solved(&self) -> impl Iterator<Item = (&Row, &Forces)> {
        let rows = self.rows.iter();
        rows.filter_map(|row| row.forces.as_ref().ok().map(|forces| (row, forces)))
    }

    /// All quantities, in the order of tables.
    pub fn columns(&self) -> Vec<Column> {
        let mut list = match &self.several {
            Some(several) => columns_of_inputs(&several.spec),
            None => columns(&self.linkage, self.settings.output),
        };
        open::mark_indeterminate(&mut list, &self.indeterminate);
        list
    }

    /// SI unit of a quantity; empty where there is none of this name.
    pub fn unit(&self, name: &str) -> String {
        let mut all = self.columns().into_iter();
        let column = all.find(|column| column.name == name);
        column.map_or(String::new(), |column| column.unit)
    }

    /// Unit of what leads from row to row where that is not the time of a record: the input
    /// coordinate, or of several inputs what these say.
    pub fn coordinate_unit(&self) -> &'static str {
        if let Some(several) = &self.several {
            return several.unit;
        }
        columns::units(&self.linkage.pairs[self.linkage.driver].kind)[0]
    }

    /// Unit of the driving force.
    pub fn drive_unit(&self) -> &'static str {
        columns::units(&self.linkage.pairs[self.linkage.driver].kind)[1]
    }

    /// The greatest residual of the power balance over all positions.
    pub fn worst_balance(&self) -> f64 {
        let residuals = self.solved().map(|(_, forces)| forces.balance.residual);
        worst(residuals)
    }

    /// The greatest deviation of the influence coefficients from the transfer
    /// functions.
    pub fn worst_influence(&self) -> f64 {
        let errors = self.solved().map(|(_, forces)| forces.influence_error);
        worst(errors)
    }

    /// The checks of the forces, with their bounds.
    pub fn checks(&self) -> Vec<Check> {
        let mut checks = vec![Check {
            name: "power balance",
            value: self.worst_balance(),
            bound: CHECKED,
        }];
        // Of several inputs there are none.
        if self.several.is_none() {
            checks.push(Check {
                name: "influence coefficients",
                value: self.worst_influence(),
                bound: CHECKED,
            });
        }
        let unknown = |row: &&Row| {
            let none = row.forces.as_ref().err();
            none.is_some_and(|why| *why == Trouble::Failure(ForceFailure::NotFinite))
        };
        checks.push(Check {
            name: "count of positions whose forces are not finite numbers",
            value: self.rows.iter().filter(unknown).count() as f64,
            bound: 0.0,
        });
        checks
    }

    /// The verdict: the forces are known at all positions, and their checks hold.
    pub fn judgement(&self) -> Judgement {
        let known = self.solved().count() == self.rows.len();
        Judgement::judge_result(RunEnd::Complete, &self.checks(), || match known {
            true => Judgement::InWorkingOrder,
            false => Judgement::NotInWorkingOrder,
        })
    }

    /// Number of positions that have no forces where there should be some: at a dead-centre position
    /// that ends the reach there are none.
    pub fn missing(&self) -> usize {
        let rows = self.rows.iter();
        rows.filter(|row| matches!(&row.forces, Err(why) if *why != Trouble::EndOfReach))
            .count()
    }

    /// Everything that the user should know besides the figures.
    pub fn warnings(&self) -> Vec<String> {
        let mut warnings = Vec::new();
        let count = |f: &dyn Fn(&Forces) -> bool| self.solved().filter(|(_, x)| f(x)).count();
        let several = count(&|forces| forces.solved.solutions > 1);
        if several > 0 {
            warnings.push(format!(
                "friction is so strong that {several} positions have more than one solution. The \
                 one that continues from no friction is given; if there is none, the one with the \
                 least friction"
            ));
        }
        let bad = count(&|forces| forces.solved.condition.is_some_and(|c| c > BAD_CONDITION));
        if bad > 0 {
            warnings.push(format!(
                "{bad} positions are so near to a dead-centre position that the condition number \
                 is above {}",
                shown(BAD_CONDITION, 1)
            ));
        }
        warnings.extend(self.checks().iter().filter_map(Check::failure));
        let missing = self.missing();
        let ends = self.rows.len() - self.solved().count() - missing;
        if ends > 0 {
            warnings.push(
                "the range of motion ends in a dead-centre position, towards which forces grow \
                 without bound. They cannot be known there. A range that ends before it has \
                 greatest forces, and work"
                    .to_owned(),
            );
        }
        if self.indeterminate.drive {
            warnings.push(
                "the friction of statically indeterminate joints leaves the driving force \
                 undetermined: it, its work and its losses are missing"
                    .to_owned(),
            );
        }
        if missing + ends == 0
            && !self.indeterminate.drive
            && self.cycle.is_none()
            && self.course.panels().is_some()
        {
            warnings.push(
                "between two positions there are no forces: work, losses and efficiency of the \
                 course are missing; more positions show where"
                    .to_owned(),
            );
        }
        if missing > 0 {
            let reasons = self.rows.iter().filter_map(|row| row.forces.as_ref().err());
            let first = reasons.into_iter().find(|why| **why != Trouble::EndOfReach);
            let reason = first.map(ToString::to_string).unwrap_or_default();
            warnings.push(format!(
                "{missing} of {} positions have no forces; the first: {reason}",
                self.rows.len()
            ));
        }
        warnings.extend(self.lacking_closing_forces());
        warnings
    }
}
