//! Addresses of results of other studies than the run.

use super::figures::CAM_FIGURES;

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
}

impl<'a> StudyAddress<'a> {
    /// Reads an address; `None`: it is one of an object or of the run. (An object may be called
    /// `cam` or `frequency`: none of its results has such a name.)
    pub(crate) fn of(address: &'a str) -> Option<Self> {
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
        }
    }

    /// The object that the study is of; `None`: it is of the whole scene.
    pub(crate) fn object(self) -> Option<&'a str> {
        match self {
            Self::Linkage { object, .. } | Self::Cam { object, .. } => Some(object),
            Self::Steady { .. } | Self::Frequency { .. } => None,
        }
    }

    /// True where `dam run` judges what is expected of it.
    pub(crate) fn is_of_run(self) -> bool {
        self.judged_by().contains(&"run")
    }
}
