//! The figures of an object by typed keys.

use super::ObjectFigures;
use std::fmt;

/// A figure of an object.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Figure {
    /// Greatest |δ|.
    DeltaAbs,
    /// Greatest δ.
    DeltaMax,
    /// Least δ.
    DeltaMin,
    /// Mean of |δ| over the run.
    Sigma,
    /// Greatest |φ̇|.
    PeakSpeed,
    /// Greatest |φ̈|.
    PeakAcceleration,
    /// Greatest |F| of link 1.
    PeakReaction,
    /// φ at the end.
    FinalDisplacement,
    /// φ̇ at the end.
    FinalSpeed,
    /// Number of times that the driving pair opens.
    Separations,
    /// Number of times that it closes.
    Closures,
    /// Total time for which it is open (s).
    SeparatedTime,
    /// Longest time for which it is open (s).
    LongestSeparation,
    /// Greatest clearance of the open pair.
    MaxLift,
    /// Greatest speed of approach at a closure.
    MaxApproachSpeed,
    /// Greatest contact force.
    MaxContactForce,
    /// Greatest indentation of the contact element.
    MaxIndentation,
    /// Number of impacts of a rigid contact.
    Impacts,
    /// Greatest impulse of one (N·s or N·m·s).
    MaxImpulse,
    /// Energy lost in them (J).
    ImpactLoss,
    /// Least contact force that the motion of a rigid object needs.
    Margin,
    /// 1: no separation within the window of steady figures; 0: there is one.
    InWorkingOrder,
    /// Greatest Hertzian pressure on a cam, or of a contact of known geometry (Pa).
    MaxPressure,
    /// Time of it (s).
    PressureTime,
    /// Number of times that the input of a linkage with joint friction stands still.
    Standstills,
    /// Time for which joint friction held it at rest (s).
    TimeAtRest,
    /// Energy lost to the friction of its joints (J).
    FrictionLoss,
    /// How often a mass comes onto a stop.
    StopClosures,
    /// Total time for which a stop is engaged (s).
    StopContactTime,
    /// Greatest speed at which a mass comes onto a stop.
    StopApproachSpeed,
    /// Greatest force of a stop.
    StopForce,
    /// Greatest indentation of a stop.
    StopIndentation,
    /// Number of impacts on a rigid stop.
    StopImpacts,
    /// Greatest impulse of one (N·s or N·m·s).
    StopMaxImpulse,
    /// Energy lost in them (J).
    StopImpactLoss,
    /// φ̇ at the end of a creep under regularised friction.
    CreepSpeed,
    /// Force that the friction bears there.
    CreepForce,
    /// Force that it can bear.
    CreepLimit,
    /// Begin of the creep (s).
    CreepFrom,
    /// End of it (s).
    CreepUntil,
}

/// A figure, its address within the object, and how its value is read.
type FigureDeclaration = (Figure, &'static str, fn(&ObjectFigures) -> Option<f64>);

/// All figures in the order of the type.
#[rustfmt::skip]
const DECLARED: [FigureDeclaration; 40] = [
    (Figure::DeltaAbs, "delta_abs", |own| Some(own.delta_abs)),
    (Figure::DeltaMax, "delta_max", |own| Some(own.delta_max)),
    (Figure::DeltaMin, "delta_min", |own| Some(own.delta_min)),
    (Figure::Sigma, "sigma", |own| Some(own.sigma)),
    (Figure::PeakSpeed, "peak_speed", |own| Some(own.peak_speed)),
    (Figure::PeakAcceleration, "peak_acceleration", |own| Some(own.peak_acceleration)),
    (Figure::PeakReaction, "peak_reaction", |own| Some(own.peak_reaction)),
    (Figure::FinalDisplacement, "final.displacement", |own| Some(own.end.displacement)),
    (Figure::FinalSpeed, "final.speed", |own| Some(own.end.speed)),
    (Figure::Separations, "pair.separations", |own| Some(own.pair.as_ref()?.separations as f64)),
    (Figure::Closures, "pair.closures", |own| Some(own.pair.as_ref()?.closures as f64)),
    (Figure::SeparatedTime, "pair.separated_time", |own| Some(own.pair.as_ref()?.separated_time)),
    (Figure::LongestSeparation, "pair.longest_separation", |own| Some(own.pair.as_ref()?.longest_separation)),
    (Figure::MaxLift, "pair.max_lift", |own| Some(own.pair.as_ref()?.max_lift)),
    (Figure::MaxApproachSpeed, "pair.max_approach_speed", |own| Some(own.pair.as_ref()?.max_approach_speed)),
    (Figure::MaxContactForce, "pair.max_contact_force", |own| Some(own.pair.as_ref()?.max_contact_force)),
    (Figure::MaxIndentation, "pair.max_indentation", |own| own.pair.as_ref()?.max_indentation),
    (Figure::Impacts, "pair.impacts.count", |own| Some(own.pair.as_ref()?.impacts?.count as f64)),
    (Figure::MaxImpulse, "pair.impacts.max_impulse", |own| Some(own.pair.as_ref()?.impacts?.max_impulse)),
    (Figure::ImpactLoss, "pair.impacts.loss", |own| Some(own.pair.as_ref()?.impacts?.loss)),
    (Figure::Margin, "pair.margin", |own| own.pair.as_ref()?.margin),
    (Figure::InWorkingOrder, "pair.in_working_order", |own| own.pair.as_ref()?.in_working_order.map(|holds| f64::from(u8::from(holds)))),
    (Figure::MaxPressure, "pressing.max_pressure", |own| Some(own.pressing?.max_pressure)),
    (Figure::PressureTime, "pressing.time", |own| Some(own.pressing?.time)),
    (Figure::Standstills, "standstills", |own| Some(own.joints.as_ref()?.standstills as f64)),
    (Figure::TimeAtRest, "time_at_rest", |own| Some(own.joints.as_ref()?.time_at_rest)),
    (Figure::FrictionLoss, "friction_loss", |own| Some(own.joints.as_ref()?.friction_loss)),
    (Figure::StopClosures, "stop.closures", |own| Some(own.stop.as_ref()?.closures as f64)),
    (Figure::StopContactTime, "stop.contact_time", |own| Some(own.stop.as_ref()?.contact_time)),
    (Figure::StopApproachSpeed, "stop.max_approach_speed", |own| Some(own.stop.as_ref()?.max_approach_speed)),
    (Figure::StopForce, "stop.max_contact_force", |own| Some(own.stop.as_ref()?.max_contact_force)),
    (Figure::StopIndentation, "stop.max_indentation", |own| Some(own.stop.as_ref()?.max_indentation)),
    (Figure::StopImpacts, "stop.impacts.count", |own| Some(own.stop.as_ref()?.impacts?.count as f64)),
    (Figure::StopMaxImpulse, "stop.impacts.max_impulse", |own| Some(own.stop.as_ref()?.impacts?.max_impulse)),
    (Figure::StopImpactLoss, "stop.impacts.loss", |own| Some(own.stop.as_ref()?.impacts?.loss)),
    (Figure::CreepSpeed, "creep.speed", |own| Some(own.creep?.speed)),
    (Figure::CreepForce, "creep.force", |own| Some(own.creep?.force)),
    (Figure::CreepLimit, "creep.limit", |own| Some(own.creep?.limit)),
    (Figure::CreepFrom, "creep.from", |own| Some(own.creep?.from)),
    (Figure::CreepUntil, "creep.until", |own| Some(own.creep?.until)),
];

impl Figure {
    /// All figures.
    pub const ALL: [Self; 40] = {
        let mut all = [Self::DeltaAbs; 40];
        let mut index = 0;
        while index < all.len() {
            all[index] = DECLARED[index].0;
            assert!(all[index] as usize == index, "as in the type");
            index += 1;
        }
        all
    };

    /// Address within the object: `pair.max_lift`.
    pub const fn address(self) -> &'static str {
        DECLARED[self as usize].1
    }
}

impl fmt::Display for Figure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.address())
    }
}

impl ObjectFigures {
    /// The value of a figure; `None`: the object has none such, or it has no value
    /// (a bilateral pair, no window).
    pub fn value(&self, figure: Figure) -> Option<f64> {
        DECLARED[figure as usize].2(self)
    }
}

#[cfg(test)]
mod tests {
    use super::Figure;
    use crate::dynamics::record::{
        CreepFigures, Figures, FinalState, ImpactFigures, JointFigures, ObjectFigures, PairFigures,
        PressingFigures, RunSummary, StopFigures,
    };
    use std::collections::{BTreeMap, BTreeSet};

    /// Every figure has another value.
    fn all_different() -> ObjectFigures {
        ObjectFigures {
            delta_abs: 20.0,
            delta_max: 1.0,
            delta_min: 2.0,
            sigma: 3.0,
            peak_speed: 4.0,
            peak_acceleration: 5.0,
            peak_reaction: 6.0,
            end: FinalState {
                displacement: 7.0,
                speed: 8.0,
            },
            pair: Some(PairFigures {
                separations: 9,
                closures: 10,
                separated_time: 11.0,
                longest_separation: 12.0,
                max_lift: 13.0,
                max_approach_speed: 14.0,
                max_contact_force: 15.0,
                max_indentation: Some(21.0),
                impacts: Some(ImpactFigures {
                    count: 27,
                    max_impulse: 28.0,
                    loss: 29.0,
                }),
                margin: Some(16.0),
                switch_times: Vec::new(),
                in_working_order: Some(false),
            }),
            pressing: Some(PressingFigures {
                max_pressure: 33.0,
                time: 34.0,
            }),
            joints: Some(JointFigures {
                standstills: 17,
                time_at_rest: 18.0,
                friction_loss: 19.0,
            }),
            stop: Some(StopFigures {
                closures: 22,
                contact_time: 23.0,
                max_approach_speed: 24.0,
                max_contact_force: 25.0,
                max_indentation: 26.0,
                impacts: Some(ImpactFigures {
                    count: 30,
                    max_impulse: 31.0,
                    loss: 32.0,
                }),
                switch_times: Vec::new(),
            }),
            creep: Some(CreepFigures {
                speed: 35.0,
                force: 36.0,
                limit: 37.0,
                from: 38.0,
                until: 39.0,
            }),
        }
    }

    #[test]
    fn keys_and_addresses_name_the_same_figures() {
        let figures = Figures {
            dam: 1,
            scene: String::new(),
            hash: String::new(),
            units: BTreeMap::new(),
            objects: BTreeMap::from([("a".to_owned(), all_different())]),
            run: RunSummary::default(),
            studies: BTreeMap::new(),
            warnings: Vec::new(),
        };
        let known = figures.addresses();
        for figure in Figure::ALL {
            let address = format!("a.{figure}");
            assert_eq!(
                figures.objects["a"].value(figure),
                known[&address],
                "{address}"
            );
        }
        let keys: BTreeSet<String> = Figure::ALL.map(|figure| format!("a.{figure}")).into();
        let of_objects = known
            .into_keys()
            .filter(|address| address.starts_with("a."));
        assert_eq!(of_objects.collect::<BTreeSet<String>>(), keys);
    }

    #[test]
    fn a_bilateral_pair_has_no_figures() {
        let bare = ObjectFigures::default();
        assert_eq!(bare.value(Figure::MaxLift), None);
        assert_eq!(bare.value(Figure::Standstills), None);
        assert_eq!(bare.value(Figure::DeltaMax), Some(0.0));
    }
}
