//! The figures of an object by typed keys.

use super::{ObjectFigures, PairFigures};
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

impl Figure {
    /// All figures.
    pub const ALL: [Self; 40] = [
        Self::DeltaAbs,
        Self::DeltaMax,
        Self::DeltaMin,
        Self::Sigma,
        Self::PeakSpeed,
        Self::PeakAcceleration,
        Self::PeakReaction,
        Self::FinalDisplacement,
        Self::FinalSpeed,
        Self::Separations,
        Self::Closures,
        Self::SeparatedTime,
        Self::LongestSeparation,
        Self::MaxLift,
        Self::MaxApproachSpeed,
        Self::MaxContactForce,
        Self::MaxIndentation,
        Self::Impacts,
        Self::MaxImpulse,
        Self::ImpactLoss,
        Self::Margin,
        Self::InWorkingOrder,
        Self::MaxPressure,
        Self::PressureTime,
        Self::Standstills,
        Self::TimeAtRest,
        Self::FrictionLoss,
        Self::StopClosures,
        Self::StopContactTime,
        Self::StopApproachSpeed,
        Self::StopForce,
        Self::StopIndentation,
        Self::StopImpacts,
        Self::StopMaxImpulse,
        Self::StopImpactLoss,
        Self::CreepSpeed,
        Self::CreepForce,
        Self::CreepLimit,
        Self::CreepFrom,
        Self::CreepUntil,
    ];

    /// Address within the object: `pair.max_lift`.
    pub const fn address(self) -> &'static str {
        match self {
            Self::DeltaAbs => "delta_abs",
            Self::DeltaMax => "delta_max",
            Self::DeltaMin => "delta_min",
            Self::Sigma => "sigma",
            Self::PeakSpeed => "peak_speed",
            Self::PeakAcceleration => "peak_acceleration",
            Self::PeakReaction => "peak_reaction",
            Self::FinalDisplacement => "final.displacement",
            Self::FinalSpeed => "final.speed",
            Self::Separations => "pair.separations",
            Self::Closures => "pair.closures",
            Self::SeparatedTime => "pair.separated_time",
            Self::LongestSeparation => "pair.longest_separation",
            Self::MaxLift => "pair.max_lift",
            Self::MaxApproachSpeed => "pair.max_approach_speed",
            Self::MaxContactForce => "pair.max_contact_force",
            Self::MaxIndentation => "pair.max_indentation",
            Self::Impacts => "pair.impacts.count",
            Self::MaxImpulse => "pair.impacts.max_impulse",
            Self::ImpactLoss => "pair.impacts.loss",
            Self::Margin => "pair.margin",
            Self::InWorkingOrder => "pair.in_working_order",
            Self::MaxPressure => "pressing.max_pressure",
            Self::PressureTime => "pressing.time",
            Self::Standstills => "standstills",
            Self::TimeAtRest => "time_at_rest",
            Self::FrictionLoss => "friction_loss",
            Self::StopClosures => "stop.closures",
            Self::StopContactTime => "stop.contact_time",
            Self::StopApproachSpeed => "stop.max_approach_speed",
            Self::StopForce => "stop.max_contact_force",
            Self::StopIndentation => "stop.max_indentation",
            Self::StopImpacts => "stop.impacts.count",
            Self::StopMaxImpulse => "stop.impacts.max_impulse",
            Self::StopImpactLoss => "stop.impacts.loss",
            Self::CreepSpeed => "creep.speed",
            Self::CreepForce => "creep.force",
            Self::CreepLimit => "creep.limit",
            Self::CreepFrom => "creep.from",
            Self::CreepUntil => "creep.until",
        }
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
        let (joints, stop) = (self.joints.as_ref(), self.stop.as_ref());
        Some(match figure {
            Figure::DeltaAbs => self.delta_abs,
            Figure::DeltaMax => self.delta_max,
            Figure::DeltaMin => self.delta_min,
            Figure::Sigma => self.sigma,
            Figure::PeakSpeed => self.peak_speed,
            Figure::PeakAcceleration => self.peak_acceleration,
            Figure::PeakReaction => self.peak_reaction,
            Figure::FinalDisplacement => self.end.displacement,
            Figure::FinalSpeed => self.end.speed,
            Figure::MaxPressure => self.pressing?.max_pressure,
            Figure::PressureTime => self.pressing?.time,
            Figure::Standstills => joints?.standstills as f64,
            Figure::TimeAtRest => joints?.time_at_rest,
            Figure::FrictionLoss => joints?.friction_loss,
            Figure::StopClosures => stop?.closures as f64,
            Figure::StopContactTime => stop?.contact_time,
            Figure::StopApproachSpeed => stop?.max_approach_speed,
            Figure::StopForce => stop?.max_contact_force,
            Figure::StopIndentation => stop?.max_indentation,
            Figure::StopImpacts => stop?.impacts?.count as f64,
            Figure::StopMaxImpulse => stop?.impacts?.max_impulse,
            Figure::StopImpactLoss => stop?.impacts?.loss,
            Figure::CreepSpeed => self.creep?.speed,
            Figure::CreepForce => self.creep?.force,
            Figure::CreepLimit => self.creep?.limit,
            Figure::CreepFrom => self.creep?.from,
            Figure::CreepUntil => self.creep?.until,
            of_pair => return self.pair.as_ref()?.value(of_pair),
        })
    }
}

impl PairFigures {
    fn value(&self, figure: Figure) -> Option<f64> {
        match figure {
            Figure::Separations => Some(self.separations as f64),
            Figure::Closures => Some(self.closures as f64),
            Figure::SeparatedTime => Some(self.separated_time),
            Figure::LongestSeparation => Some(self.longest_separation),
            Figure::MaxLift => Some(self.max_lift),
            Figure::MaxApproachSpeed => Some(self.max_approach_speed),
            Figure::MaxContactForce => Some(self.max_contact_force),
            Figure::MaxIndentation => self.max_indentation,
            Figure::Impacts => Some(self.impacts?.count as f64),
            Figure::MaxImpulse => Some(self.impacts?.max_impulse),
            Figure::ImpactLoss => Some(self.impacts?.loss),
            Figure::Margin => self.margin,
            Figure::InWorkingOrder => self
                .in_working_order
                .map(|holds| f64::from(u8::from(holds))),
            _ => None,
        }
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
