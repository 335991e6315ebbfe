//! Nothing allocates where it must not. A process of its own: its allocator counts.

mod counting;

mod exact;
mod linkages;
mod runs;
