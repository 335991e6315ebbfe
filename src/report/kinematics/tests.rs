//! Pages and tables of a slider-crank.
