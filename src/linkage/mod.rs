//! Planar linkages of rigid links and lower pairs with one degree of freedom.
//!
//! A linkage is given in plain numbers ([`spec::LinkageSpec`]). Its structure
//! is found (mobility, Assur groups), its positions solved group by group, its
//! motion given by transfer functions of the input coordinate.

pub mod forces;
pub mod spec;
