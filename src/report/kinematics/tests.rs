//! Units as they are read.

use super::angle_or;

#[test]
fn angles_read_in_degrees_and_reciprocals_take_no_prefix() {
    assert_eq!(angle_or(std::f64::consts::FRAC_PI_2, "rad"), "90 deg");
    assert_eq!(angle_or(-364.2, "1/rad"), "−364.2 1/rad");
    assert_eq!(angle_or(0.5, "1"), "0.5");
    assert_eq!(angle_or(0.05, "m"), "50 mm");
}
