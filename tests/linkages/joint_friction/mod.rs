//! Linkages that move with the friction of their joints: against closed forms,
//! against absolute coordinates with multipliers and friction of their own.

mod oracle;
mod support;

mod closed_forms;
mod corners;
mod groups;
mod loose;
mod methods;
mod motions;
mod near_singular;
mod reference;
mod scenes;
mod several;
mod stops;
