//! Bearings of a star's ends, and whether they agree with its clockwise order (Definition 2.1).

use std::f64::consts::TAU;

use hssh_topology::{Olp, OlpName, Star};

/// Two bearings closer than this many radians are one direction.
const SAME_DIRECTION: f64 = 1e-9;

/// Why numbers are no bearings of a star's ends.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum BearingError {
    /// Not a finite angle of at most one full turn either way.
    #[error("the bearing of `{0}` is no direction: it is more than a full turn away from 0")]
    OutOfRange(OlpName),
    /// Two ends point the same way.
    #[error("`{olp}` has the same bearing as `{before}`, but two ends of a star never coincide")]
    Coincide {
        /// The later end.
        olp: OlpName,
        /// The end it coincides with.
        before: OlpName,
    },
    /// Going clockwise from end to end takes more than one turn.
    #[error(
        "the bearing of `{olp}` contradicts the clockwise order of the ends: turning clockwise from `{before}` to `{olp}` passes `{first}`"
    )]
    NotClockwise {
        /// The end whose bearing does not fit.
        olp: OlpName,
        /// The end with a bearing before it in the star.
        before: OlpName,
        /// The first end with a bearing.
        first: OlpName,
    },
}

impl BearingError {
    /// The end whose bearing is wrong.
    #[must_use]
    pub fn olp(&self) -> OlpName {
        match *self {
            BearingError::OutOfRange(olp)
            | BearingError::Coincide { olp, .. }
            | BearingError::NotClockwise { olp, .. } => olp,
        }
    }
}

/// Checks that bearings, in radians counterclockwise, decrease along the clockwise order of the
/// star's ends and come around in one full turn. Ends without a bearing are passed over.
pub fn check_bearings(star: &Star, bearings: &[Option<f64>]) -> Result<(), BearingError> {
    let measured: Vec<(OlpName, f64)> = star
        .olps()
        .zip(bearings)
        .filter_map(|(olp, bearing): (Olp, _)| bearing.map(|radians| (star.name(olp), radians)))
        .collect();
    for &(olp, radians) in &measured {
        if !radians.is_finite() || radians.abs() > TAU {
            return Err(BearingError::OutOfRange(olp));
        }
    }
    let mut turned = 0.0;
    for pair in measured.windows(2) {
        let [(before, from), (olp, to)] = [pair[0], pair[1]];
        let turn = (from - to).rem_euclid(TAU);
        if turn.min(TAU - turn) < SAME_DIRECTION {
            return Err(BearingError::Coincide { olp, before });
        }
        turned += turn;
        let (first, _) = measured[0];
        if (turned - TAU).abs() < SAME_DIRECTION {
            return Err(BearingError::Coincide { olp, before: first });
        }
        if turned > TAU {
            return Err(BearingError::NotClockwise { olp, before, first });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(bearings: &[Option<f64>; 4]) -> Result<(), BearingError> {
        let radians = bearings.map(|degrees| degrees.map(f64::to_radians));
        check_bearings(&"0+ 1+ 0- 1-".parse().unwrap(), &radians)
    }

    /// Of the 24 ways to give four directions to four ends, the four rotations of the clockwise
    /// one are right, whatever turns are added to a direction.
    #[test]
    fn exactly_the_clockwise_orders_pass() {
        let directions = [100.0, 30.0, -80.0, -150.0];
        let mut passed = Vec::new();
        for code in 0..256_usize {
            let order = [code & 3, code >> 2 & 3, code >> 4 & 3, code >> 6];
            let bearings = order.map(|index| Some(directions[index]));
            let turned = order.map(|index| Some(directions[index] + if index == 2 { 360.0 } else { 0.0 }));
            assert_eq!(check(&bearings), check(&turned));
            if check(&bearings).is_ok() {
                passed.push(order);
            }
        }
        assert_eq!(passed, [[1, 2, 3, 0], [2, 3, 0, 1], [3, 0, 1, 2], [0, 1, 2, 3]]);
    }

    #[test]
    fn ends_without_bearing_are_passed_over() {
        assert_eq!(check(&[None; 4]), Ok(()));
        assert_eq!(check(&[None, Some(10.0), None, Some(80.0)]), Ok(()));
        assert_eq!(check(&[Some(90.0), None, Some(0.0), Some(-90.0)]), Ok(()));
        assert!(check(&[Some(90.0), None, Some(-90.0), Some(0.0)]).is_err());
    }

    #[test]
    fn one_direction_is_no_two_ends() {
        let coincide = |bearings| matches!(check(&bearings), Err(BearingError::Coincide { .. }));
        assert!(coincide([Some(180.0), Some(-180.0), None, None]));
        assert!(coincide([Some(0.0), Some(-120.0), Some(120.0), Some(0.0)]));
        assert!(matches!(check(&[Some(f64::NAN), None, None, None]), Err(BearingError::OutOfRange(_))));
        assert!(matches!(check(&[Some(361.0), None, None, None]), Err(BearingError::OutOfRange(_))));
    }
}
