//! The linkage moving, with the forces that its pairs carry.

use super::ForcesReport;
use crate::report::mechanism::{Arrow, ArrowSet, Axis, Drawing, MOST_FRAMES, Placement};
use crate::studies::forces::{Forces, Row};

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
        let links = forces.links.iter();
        links
            .map(|link| Placement {
                at: link.origin,
                turn: link.direction,
            })
            .collect()
    };
    let arrow = |name: String, read: &dyn Fn(&Forces) -> [[f64; 2]; 2]| {
        let (at, vector) = kept
            .iter()
            .map(|(_, _, forces)| read(forces).into())
            .unzip();
        Arrow { name, at, vector }
    };
    let named = |name: &str| format!("force in {name}");
    let pairs = study.linkage.pairs.iter().enumerate();
    let reactions = pairs
        .filter(|(pair, _)| !study.is_open(*pair))
        .map(|(pair, spec)| {
            arrow(named(&spec.name), &|forces| {
                let own = &forces.pairs[pair];
                [own.point, own.force]
            })
        });
    let open = &study.indeterminate.welds;
    let welds = study.linkage.welds.iter().enumerate();
    let welds = welds
        .filter(|(weld, _)| open.get(*weld) != Some(&true))
        .map(|(weld, spec)| {
            arrow(named(&spec.name), &|forces| {
                let own = &forces.welds[weld];
                [own.point, own.force]
            })
        });
    let open = &study.indeterminate.couplings;
    let couplings = study.linkage.couplings.iter().enumerate();
    let couplings = couplings
        .filter(|(index, spec)| spec.kind.words().is_one_force && open.get(*index) != Some(&true))
        .map(|(index, spec)| {
            arrow(named(&spec.name), &|forces| {
                let own = &forces.couplings[index];
                [own.point, own.force]
            })
        });
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
    let first = kept
        .first()
        .map_or(0.0, |(_, row, _)| row.motion.coordinate);
    let time = |row: &Row| {
        let speed = row.motion.speed.abs();
        let uniform = (row.motion.coordinate - first).abs() / if speed > 0.0 { speed } else { 1.0 };
        row.time.unwrap_or(uniform)
    };
    Drawing {
        spec: &study.linkage,
        frames: kept.iter().map(|(_, _, forces)| placed(forces)).collect(),
        axis: Axis {
            name: report.axis().name.to_owned(),
            unit: report.axis().unit().to_owned(),
            values: kept
                .iter()
                .map(|(index, _, _)| report.axis().shown(study.course.parameter(*index)))
                .collect(),
            times: kept.iter().map(|(_, row, _)| time(row)).collect(),
            closed: study.course.is_closed() && stride == 1,
        },
        paths: Vec::new(),
        arrows: vec![
            set(
                "reactions",
                true,
                reactions.chain(welds).chain(couplings).collect(),
            ),
            set("shaking force at the origin", false, vec![shaking]),
        ],
    }
}
