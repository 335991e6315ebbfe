//! Line charts.
