//! Do two models move alike as long as every mass follows its law?

use crate::model::{Law, Model, NodeMotion};
use crate::motion::DriveMotion;
use crate::position::Position;

/// True when the motions of all nodes on their laws are certainly the same:
/// constant speeds and the shortest laws, number by number. Others are not
/// compared.
pub(super) fn moves_alike(a: &Model, b: &Model) -> bool {
    a.nodes.len() == b.nodes.len()
        && a.objects.len() == b.objects.len()
        && (a.objects.iter().zip(&b.objects))
            .all(|(a, b)| a.nodes == b.nodes && a.driver == b.driver)
        && (a.nodes.iter().zip(&b.nodes)).all(|(a, b)| same_motion(&a.motion, &b.motion))
}

fn same_motion(a: &NodeMotion, b: &NodeMotion) -> bool {
    match (a, b) {
        (
            NodeMotion::Prescribed {
                motion: DriveMotion::Constant { speed, angle },
                track: None,
            },
            NodeMotion::Prescribed {
                motion:
                    DriveMotion::Constant {
                        speed: other_speed,
                        angle: other_angle,
                    },
                track: None,
            },
        ) => speed == other_speed && angle == other_angle,
        (NodeMotion::Mass { law: a }, NodeMotion::Mass { law: b })
        | (NodeMotion::Rigid { law: a }, NodeMotion::Rigid { law: b }) => same_law(a, b),
        _ => false,
    }
}

fn same_law(a: &Law, b: &Law) -> bool {
    let position = match (&a.position, &b.position) {
        (
            Position::Ratio { ratio, offset },
            Position::Ratio {
                ratio: other,
                offset: other_offset,
            },
        ) => ratio == other && offset == other_offset,
        (
            Position::Sine {
                amplitude,
                harmonic,
                phase,
                offset,
            },
            Position::Sine {
                amplitude: other_amplitude,
                harmonic: other_harmonic,
                phase: other_phase,
                offset: other_offset,
            },
        ) => {
            amplitude == other_amplitude
                && harmonic == other_harmonic
                && phase == other_phase
                && offset == other_offset
        }
        _ => false,
    };
    position && a.driver == b.driver && a.lever == b.lever && a.track == b.track
}

#[cfg(test)]
mod tests {
    use crate::lower::lower;
    use crate::scene::{BuiltIn, Document, Overrides};
    use crate::system::System;

    #[test]
    fn a_system_made_like_another_is_the_same_as_a_new_one() {
        let text = include_bytes!("../../scenarios/rocker/two_masses.json");
        let document = Document::parse("scene", text).unwrap();
        let model = |setting: &str| {
            let overrides = Overrides::new([setting]);
            lower(&document.scene(&BuiltIn, &overrides).unwrap().scene).unwrap()
        };
        let base = System::new(model("rocker.inertia=0.1")).unwrap();
        for (setting, alike) in [
            ("rocker.inertia=0.35", true),
            ("rocker.loads.closing.constant=-900", true),
            ("shaft.motion.speed=7 rev/s", false),
            ("rocker.masses=3", false),
        ] {
            let own = model(setting);
            assert_eq!(super::moves_alike(&own, base.model()), alike, "{setting}");
            let made = System::like(own.clone(), Some(&base)).unwrap();
            let new = System::new(own).unwrap();
            assert_eq!(made.scales, new.scales, "{setting}");
        }
    }
}
