//! Public cases keep their digits.

#[allow(dead_code)] // What only the table shows.
#[path = "../../benches/public/board.rs"]
mod board;

use board::cases;
use std::path::Path;

/// Error at the tight tolerance, relative to the figure or to 1.
const KEPT: f64 = 2e-10;

#[test]
fn public_cases_keep_their_digits() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/public");
    let cases = cases(&folder);
    assert!(cases.len() >= 20, "the cases are there");
    let touching = cases.iter().filter(|case| case.contact_or_friction).count();
    assert!(touching >= 5, "five of them touch, strike or rub");
    for case in &cases {
        let said = [&case.program, &case.source, &case.truth];
        assert!(said.iter().all(|text| !text.is_empty()), "{}", case.name);
        for figure in &case.figures {
            let told = format!("{}, {} at {} s", case.name, figure.figure, figure.at);
            let off = |tolerance| {
                let found = case.run(figure, tolerance);
                assert!(found.steps > 0 && found.seconds > 0.0, "{told}");
                (found.value - figure.truth).abs()
            };
            let tight = off(Some(1e-12));
            let kept = KEPT * figure.truth.abs().max(1.0) + figure.truth_error;
            assert!(tight <= kept, "{told}: off by {tight:e}");
            // A hundred times nearer than what is stored, or at its last digit; than a reference,
            // at the tight tolerance.
            let stored = figure
                .stored
                .map_or(1e-4, |stored| (stored - figure.truth).abs());
            let own = if figure.reference { tight } else { off(None) };
            assert!(
                own <= (stored / 100.0).max(figure.last_digit) + figure.truth_error,
                "{told}: off by {own:e}, stored by {stored:e}"
            );
        }
    }
}
