//! The linkage moving, with the forces that its pairs carry.

use super::ForcesReport;
use crate::report::mechanism::{Arrow, ArrowSet, Axis, Drawing, MOST_FRAMES, Placement};
use crate::studies::forces::{Forces, LinkPlace, Row};

/// The drawing: reactions on link j from link i, those of couplings on their second wheel or
/// roller, and the shaking force.
pub fn drawing<'a>(report: &ForcesReport<'a>) -> Drawing<'a> {
    let study = report.study;
    let solved: Vec<(usize, &Row, &Forces)> = study
        .rows
        .iter()
        .enumerate()
        .filter_map(|(index, row)| row.forces.as_ref().ok().map(|forces| (index, row, forces)))
        .collect();
    let stride = solved.len().div_ceil(MOST_FRAMES).max(1);
    let kept: Vec<_> = solved.into_iter().step_by(stride).collect();
    let placed = |forces: &Forces| {
        let place = |link: &LinkPlace| Placement {
            at: link.origin,
            turn: link.direction,
        };
        forces.links.iter().map(place).collect()
    };
    let arrow = |name: String, read: &dyn Fn(&Forces) -> [[f64; 2]; 2]| {
        let ends = kept.iter().map(|(_, _, forces)| read(forces).into());
        let (at, vector) = ends.unzip();
        Arrow { name, at, vector }
    };
    let mut reactions = Vec::new();
    let mut add = |open: Option<&bool>, name: &str, read: &dyn Fn(&Forces) -> [[f64; 2]; 2]| {
        if open != Some(&true) {
            reactions.push(arrow(format!("force in {name}"), read));
        }
    };
    let (linkage, open) = (&study.linkage, &study.indeterminate);
    for (k, pair) in linkage.pairs.iter().enumerate() {
        let read = |f: &Forces| [f.pairs[k].point, f.pairs[k].force];
        add(open.pairs.get(k), &pair.name, &read);
    }
    for (k, weld) in linkage.welds.iter().enumerate() {
        let read = |f: &Forces| [f.welds[k].point, f.welds[k].force];
        add(open.welds.get(k), &weld.name, &read);
    }
    let couplings = linkage.couplings.iter().enumerate();
    for (k, coupling) in couplings.filter(|(_, one)| one.kind.words().is_one_force) {
        let read = |f: &Forces| [f.couplings[k].point, f.couplings[k].force];
        add(open.couplings.get(k), &coupling.name, &read);
    }
    let shaking = arrow("shaking force".to_owned(), &|forces| {
        let [x, y, _] = forces.shaking;
        [[0.0; 2], [x, y]]
    });
    let set = |name: &str, shown: bool, arrows: Vec<Arrow>| ArrowSet {
        name: name.to_owned(),
        unit: "N".to_owned(),
        shown,
        arrows,
    };
    let first = kept.first();
    let first = first.map_or(0.0, |(_, row, _)| row.motion.coordinate);
    let axis = report.axis();
    let places = kept
        .iter()
        .map(|(index, ..)| study.course.parameter(*index));
    let time = |row: &Row| {
        let speed = row.motion.speed.abs();
        let uniform = (row.motion.coordinate - first).abs() / if speed > 0.0 { speed } else { 1.0 };
        row.time.unwrap_or(uniform)
    };
    Drawing {
        spec: &study.linkage,
        frames: kept.iter().map(|(_, _, forces)| placed(forces)).collect(),
        axis: Axis {
            name: axis.name.to_owned(),
            unit: axis.unit().to_owned(),
            values: places.map(|at| axis.in_unit(at)).collect(),
            times: kept.iter().map(|(_, row, _)| time(row)).collect(),
            closed: study.course.is_closed() && stride == 1,
        },
        paths: Vec::new(),
        arrows: vec![
            set("reactions", true, reactions),
            set("shaking force at the origin", false, vec![shaking]),
        ],
    }
}
