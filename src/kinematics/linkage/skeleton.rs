//! What is solved in place of a linkage: without the constraints that are redundant, welded links
//! as one.
//!
//! A pin that is free along a direction of its link gets a hidden link, which slides along that
//! direction and carries the pin; a guide whose block may turn gets one between block and guide. So
//! what is left is an ordinary linkage with ordinary groups. Hidden links and pairs stand behind
//! all others, so that every number of the linkage means the same in both; nobody outside sees them.

use super::spec::{
    AssemblySpec, LinkSpec, LinkageSpec, PairKind, PairSpec, PointOf, Redundant, RedundantPart,
};
use super::structure::{Group, GroupKind};
use super::welds::{self, AttachedLink};

/// A linkage as it is solved.
#[derive(Clone, Debug)]
pub(super) struct Skeleton {
    /// The linkage, with hidden links and pairs behind its own.
    pub(super) spec: LinkageSpec,
    /// Pairs that are left out.
    left_out: Vec<usize>,
    /// Links that are attached to others, and have no pairs here.
    pub(super) attached: Vec<AttachedLink>,
    /// Number of the linkage's own links and pairs.
    own: [usize; 2],
}

impl Skeleton {
    /// Of a linkage with a driver whose redundant constraints are known.
    pub(super) fn of(linkage: &LinkageSpec) -> Self {
        let driven = linkage.pairs.get(linkage.driver);
        let driven = driven.map(|pair| [pair.on.link, pair.link.link]);
        Self::with_bases(linkage, driven.into_iter().flatten().flatten())
    }

    /// The same; `preferred`: links that are the bases of what is welded to them.
    pub(super) fn with_bases(
        linkage: &LinkageSpec,
        preferred: impl IntoIterator<Item = usize>,
    ) -> Self {
        let mut skeleton = Self {
            own: [linkage.links.len(), linkage.pairs.len()],
            left_out: Vec::new(),
            attached: welds::attached(linkage, preferred),
            spec: linkage.clone(),
        };
        welds::give_to_bases(&mut skeleton.spec, &skeleton.attached);
        let merged = skeleton.spec.clone();
        for redundant in &linkage.redundant {
            skeleton.leave_out(&merged, redundant);
        }
        skeleton
    }

    /// True for a pair that is solved.
    pub(super) fn solves(&self, pair: usize) -> bool {
        !self.left_out.contains(&pair)
    }

    fn leave_out(&mut self, linkage: &LinkageSpec, redundant: &Redundant) {
        let pair = redundant.pair;
        match redundant.part {
            RedundantPart::Whole => self.left_out.push(pair),
            RedundantPart::Couple => self.release_turning(pair),
            RedundantPart::Along(link) => {
                if let Some([u, v]) = redundant.free_direction(linkage) {
                    self.release_sliding(pair, link, v.atan2(u));
                }
            }
        }
    }

    /// Puts a hidden link between a pin and its link, free to slide along a direction of it.
    fn release_sliding(&mut self, pair: usize, link: usize, direction: f64) {
        let hidden = self.hidden_link(link);
        let pin = &mut self.spec.pairs[pair];
        let own = match pin.on.link == Some(link) {
            true => &mut pin.on,
            false => &mut pin.link,
        };
        let guide = std::mem::replace(own, origin(hidden));
        self.hidden_pair(
            guide,
            hidden,
            PairKind::Sliding {
                direction,
                angle: -direction,
                corners: [0.0; 2],
                half_height: 0.0,
            },
        );
        // The link has one assembly: what was said of it would ask for one of the hidden link's.
        let said = |choice: &AssemblySpec| choice.link != link;
        self.spec.assembly.retain(said);
    }

    /// Puts a hidden link between a block and its guide, on which the block turns.
    fn release_turning(&mut self, pair: usize) {
        let Some(link) = self.spec.pairs[pair]
            .link
            .link
            .or(self.spec.pairs[pair].on.link)
        else {
            return;
        };
        let hidden = self.hidden_link(link);
        let block = std::mem::replace(&mut self.spec.pairs[pair].link, origin(hidden));
        let kind = PairKind::PIN;
        self.hidden_pair(block, hidden, kind);
    }

    fn hidden_link(&mut self, like: usize) -> usize {
        self.spec.links.push(LinkSpec {
            name: self.spec.links[like].name.clone(),
            ..LinkSpec::default()
        });
        self.spec.links.len() - 1
    }

    fn hidden_pair(&mut self, on: PointOf, hidden: usize, kind: PairKind) {
        self.spec.pairs.push(PairSpec {
            name: String::new(),
            on,
            link: origin(hidden),
            kind,
            friction: 0.0,
        });
    }

    /// A group as it is told, without what is hidden.
    pub(super) fn without_hidden(&self, mut group: Group) -> Group {
        let [links, pairs] = self.own;
        let before = group.links.len();
        group.links.retain(|&link| link < links);
        group.pairs.retain(|&pair| pair < pairs);
        if group.links.len() < before {
            group.kind = match (group.kind, group.links.len()) {
                (GroupKind::Newton { .. }, count) if count > 1 => {
                    GroupKind::Newton { links: count }
                }
                _ => GroupKind::Overheld,
            };
        }
        group
    }
}

fn origin(link: usize) -> PointOf {
    PointOf {
        link: Some(link),
        at: [0.0; 2],
    }
}
