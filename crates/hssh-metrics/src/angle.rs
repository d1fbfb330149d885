//! The one function that wraps angles.

use std::f64::consts::{PI, TAU};

/// The angle in (−π, π] that differs from `angle` (radians) by a multiple of 2π.
///
/// Angles already in that interval are returned unchanged, to the last bit. NaN and infinities give NaN.
#[must_use]
pub fn wrap_angle(angle: f64) -> f64 {
    if -PI < angle && angle <= PI {
        return angle;
    }
    let positive = angle.rem_euclid(TAU);
    if positive > PI { positive - TAU } else { positive }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stays_in_the_half_open_interval_and_keeps_the_direction() {
        for base in [-3.0, -1.5, -1e-12, 0.0, 1e-12, 0.7, 3.1] {
            for turns in -5..=5 {
                let wrapped = wrap_angle(base + f64::from(turns) * TAU);
                assert!(-PI < wrapped && wrapped <= PI);
                assert!((wrapped - base).abs() < 1e-14 * 64.0);
            }
        }
        assert_eq!(wrap_angle(-PI), PI);
        assert_eq!(wrap_angle(PI), PI);
        assert_eq!(wrap_angle(-1e-300), -1e-300);
        assert!(wrap_angle(f64::NAN).is_nan());
        assert!(wrap_angle(f64::INFINITY).is_nan());
    }
}
