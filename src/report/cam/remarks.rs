//! What a designer must know of a cam, in sentences.

use super::figures::rpm;
use super::words::{angle_at, degrees, length};
use crate::kinematics::cam::Finding;
use crate::report::quantity::with_unit;
use crate::studies::cam::CamFigures;
use crate::studies::judgement::Judgement;

/// Remarks that a designer must know, the grave ones (`true`) first.
pub(super) fn remarks(found: &CamFigures) -> Vec<(bool, String)> {
    let mut list: Vec<(bool, String)> = found.findings.iter().map(remark).collect();
    if let Some(excess) = found.excess {
        let text = format!("pressure angle too great: {}", angle_at(excess));
        list.push((true, text));
    }
    if let Some(face) = &found.face
        && face.width.is_some_and(|width| width < face.needed_width)
    {
        let text = format!(
            "the face is too narrow: {} are needed",
            length(face.needed_width)
        );
        list.push((true, text));
    }
    if let Some(force) = &found.force {
        if force.lets_go.is_some() && force.margin.value < 0.0 {
            let place = degrees(force.margin.phi);
            list.push((
                true,
                format!("the follower lifts off at this speed, at {place}"),
            ));
        }
        if let Some(answer) = &force.closing
            && force.margin.value >= 0.0
            && force.margin.value < answer.reserve * (1.0 - 1e-9)
        {
            let text = format!(
                "the spring leaves {} in contact, less than the reserve of {}",
                with_unit(force.margin.value, force.unit, 6),
                with_unit(answer.reserve, force.unit, 6)
            );
            list.push((true, text));
        }
        if force.contact_verdict() == Judgement::NotInWorkingOrder {
            let text = "the elastic follower lifts off at this speed";
            list.push((true, text.to_owned()));
        }
        if let Some(speed) = force.lift_off_below() {
            let text = format!(
                "note: from {} on the follower lifts off in bands of speed, each about a resonance; \
                 at the speed of the cam it stays in contact",
                rpm(speed)
            );
            list.push((false, text));
        }
        list.extend(
            force
                .notes
                .iter()
                .map(|note| (false, format!("note: {note}"))),
        );
    }
    list.sort_by_cached_key(|(grave, _)| usize::from(!grave));
    list
}

fn remark(finding: &Finding) -> (bool, String) {
    match *finding {
        Finding::Undercut { flank, from, to } => {
            let which = if flank == 0 { "profile" } else { "outer flank" };
            let text = format!(
                "undercut: the {which} runs backwards from {} to {}",
                degrees(from),
                degrees(to)
            );
            (true, text)
        }
        Finding::Crossing { flank, phi } => {
            let which = if flank == 0 { "profile" } else { "outer flank" };
            let text = format!(
                "loop: the {which} crosses itself at {} and {}",
                degrees(phi[0]),
                degrees(phi[1])
            );
            (true, text)
        }
        Finding::Corner { at, turn, undercut } => {
            let more = if undercut { ", undercut" } else { "" };
            let text = format!(
                "hard shock at {}: a corner of {}{more}",
                degrees(at),
                degrees(turn)
            );
            (true, text)
        }
        Finding::Shock { at, radius, .. } => {
            let text = format!(
                "soft shock at {}: radius of curvature from {} to {}",
                degrees(at),
                length(radius[0]),
                length(radius[1])
            );
            (false, text)
        }
    }
}
