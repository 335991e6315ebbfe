//! Scenes drawn by a seed: every kind of motion of a drive before every kind of what is
//! driven, by every method, and the same scene written in other ways.
//!
//! `DAM_SCENES=N` draws as many (200), from `DAM_FIRST` on, and writes them
//! into the folder `DAM_WRITE`; see `tests/generated/all`.

#![expect(
    clippy::print_stdout,
    reason = "counts and differences are what is asked for"
)]

mod agreement;
mod draw;
mod scene;
mod twins;
