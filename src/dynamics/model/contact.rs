//! Contacts of the model: an element of its own between an object and its law.

use super::{ContactLaw, NodeIndex};

/// A contact between an object and what its law asks for: an element of its own, whose
/// data do not depend on the number of masses. It stands in the link that holds the pair:
///
/// * before a rigid body that link is the contact alone, of no stiffness where it is rigid;
/// * before an undamped link 1, with a law without loss, it is contact and link 1 in series;
/// * else it ends at a massless point, from which link 1 leads on to mass 1. The forces on
///   that point are in balance, which determines its speed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactElement {
    /// Law of the contact force.
    pub law: ContactLaw,
    /// k_c (N/m or N·m/rad), or K of a power of the indentation; 0 of a rigid one.
    pub stiffness: f64,
    /// The link that holds the pair.
    pub link: usize,
    /// The massless point between contact and link 1.
    pub point: Option<NodeIndex>,
}
