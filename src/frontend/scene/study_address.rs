//! Addresses of results of other studies than the run.

use super::figures::CAM_FIGURES;
use super::span::SpanAddress;
use crate::dynamics::model::SpanFigure;

/// Address of a result of a study.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum StudyAddress<'a> {
    /// `kinematics.press.ram.time_ratio`, `forces.press.drive.greatest`.
    Linkage {
        study: &'static str,
        object: &'a str,
        name: &'a str,
    },
    /// `steady.mean_time`.
    Steady { name: &'a str },
    /// `cam.follower.least_radius`.
    Cam { object: &'a str, name: &'a str },
    /// `frequency.1`, the lowest with all pairs engaged; `frequency.open.1`.
    Frequency { open: bool, number: usize },
    /// A figure of the run, of kinematics or of forces within a part of the motion:
    /// `rocker.delta_max from 30 deg to 120 deg`.
    Within(SpanAddress<'a>),
}

impl<'a> StudyAddress<'a> {
    /// Reads an address; `None`: it is one of an object or of the run. (An object may be called
    /// `cam` or `frequency`: none of its results has such a name.)
    pub(crate) fn of(address: &'a str) -> Option<Self> {
        if let Some(within) = SpanAddress::of(address) {
            return Some(Self::Within(within));
        }
        let (study, rest) = address.split_once('.')?;
        let linkage = |study| {
            let (object, name) = rest.split_once('.')?;
            Some(Self::Linkage {
                study,
                object,
                name,
            })
        };
        match study {
            "kinematics" => linkage("kinematics"),
            "forces" => linkage("forces"),
            "steady" => Some(Self::Steady { name: rest }),
            "cam" => {
                let (object, name) = rest.rsplit_once('.')?;
                let is_cam = CAM_FIGURES.iter().any(|figure| figure.name == name);
                is_cam.then_some(Self::Cam { object, name })
            }
            "frequency" => {
                let open = rest.strip_prefix("open.");
                let number = open.unwrap_or(rest);
                let number: usize = number
                    .parse()
                    .ok()
                    .filter(|n: &usize| n.to_string() == number)?;
                Some(Self::Frequency {
                    open: open.is_some(),
                    number,
                })
            }
            _ => None,
        }
    }

    /// Study, object and name of a figure of kinematics or forces; `None`: it is of another study.
    pub(crate) fn of_course(self) -> Option<(&'static str, &'a str, &'a str)> {
        match self {
            Self::Linkage {
                study,
                object,
                name,
            } => Some((study, object, name)),
            _ => None,
        }
    }

    /// The figure of a run that an address names with a part of its motion; `None`: it is another
    /// address.
    pub(crate) fn span_of_run(address: &str) -> Option<SpanFigure> {
        let within = SpanAddress::of(address)?;
        let of_run = StudyAddress::of(within.figure).is_none();
        let span = within.span().ok().filter(|_| of_run)?;
        Some(SpanFigure {
            address: address.to_owned(),
            figure: within.figure.to_owned(),
            span,
        })
    }

    /// The commands that judge what is expected of it, the study's own first.
    pub(crate) fn judged_by(self) -> &'static [&'static str] {
        match self {
            Self::Linkage {
                study: "kinematics",
                ..
            } => &["kinematics"],
            Self::Linkage { .. } => &["forces"],
            Self::Steady { .. } => &["steady"],
            Self::Cam { .. } => &["cam", "run"],
            Self::Frequency { .. } => &["run"],
            // (Other commands look at the whole course.)
            Self::Within(within) => match Self::of(within.figure) {
                None => &["run"],
                Some(_) => &["verify"],
            },
        }
    }

    /// The object that the study is of; `None`: it is of the whole scene.
    pub(crate) fn object(self) -> Option<&'a str> {
        match self {
            Self::Linkage { object, .. } | Self::Cam { object, .. } => Some(object),
            Self::Steady { .. } | Self::Frequency { .. } | Self::Within(_) => None,
        }
    }

    /// True where `dam run` judges what is expected of it.
    pub(crate) fn is_judged_by_run(self) -> bool {
        self.judged_by().contains(&"run")
    }
}
