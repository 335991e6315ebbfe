//! Scenes to begin with.

/// A scene to begin with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Template {
    Lever,
    Cam,
    Linkage,
    Press,
    Shaft,
}

impl Template {
    /// All of them.
    pub(crate) const ALL: [Self; 5] = [
        Self::Lever,
        Self::Cam,
        Self::Linkage,
        Self::Press,
        Self::Shaft,
    ];

    /// Its name.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Lever => "lever",
            Self::Cam => "cam",
            Self::Linkage => "linkage",
            Self::Press => "press",
            Self::Shaft => "shaft",
        }
    }

    /// What it shows.
    pub(crate) fn meaning(self) -> &'static str {
        match self {
            Self::Lever => "A lever on a cam, elastic, held by a spring",
            Self::Cam => "A cam with a roller follower, to be sized and cut",
            Self::Linkage => "A slider-crank of links and joints",
            Self::Press => "A crank press on a motor",
            Self::Shaft => "A motor, an elastic shaft, a fan",
        }
    }

    /// The scene.
    pub(crate) fn text(self) -> &'static str {
        match self {
            Self::Lever => include_str!("templates/lever.json"),
            Self::Cam => include_str!("templates/cam.json"),
            Self::Linkage => include_str!("templates/linkage.json"),
            Self::Press => include_str!("templates/press.json"),
            Self::Shaft => include_str!("templates/shaft.json"),
        }
    }
}
