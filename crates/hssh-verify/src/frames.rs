//! How the frame of a visit stands in that of its place, from the bearings of corresponding ends; what new places
//! are worth.

use std::f64::consts::{PI, TAU};

use crate::header::NewPlace;
use crate::pose::{circular_mean, wrap};
use crate::route::{Route, Shape};

/// The bearings of all ends; those not measured are spread evenly, clockwise, to agree best with the measured ones.
pub(crate) fn filled_bearings(shape: &Shape) -> Vec<f64> {
    let spread = |end: usize| -TAU * end as f64 / shape.degree() as f64;
    let measured = shape.bearings.iter().enumerate();
    let gaps: Vec<f64> =
        measured.filter_map(|(end, bearing)| bearing.map(|bearing| bearing - spread(end))).collect();
    let offset = if gaps.is_empty() { 0.0 } else { circular_mean(gaps.into_iter()) };
    let fill = |(end, bearing): (usize, &Option<f64>)| bearing.unwrap_or(spread(end) + offset);
    shape.bearings.iter().enumerate().map(fill).collect()
}

/// The turn of the frame of a star with bearings `seen` in the frame of a place with bearings `kept`, if end `i` of
/// the star is end `i + rotation` of the place.
pub(crate) fn turn(seen: &[f64], kept: &[f64], rotation: usize) -> f64 {
    let n = seen.len();
    circular_mean((0..n).map(|end| kept[(end + rotation) % n] - seen[end]))
}

/// What each travel costs that leads to a new place: the density of its odometry, against a sure prediction's.
pub(crate) fn new_place_prices(route: &Route, prior: NewPlace) -> Vec<f64> {
    (0..route.travels()).map(|travel| new_place_price(route, travel, prior)).collect()
}

fn new_place_price(route: &Route, travel: usize, prior: NewPlace) -> f64 {
    let leg = &route.legs[travel];
    let motion = leg.motion.as_ref().expect("odometry is only made use of if every travel has it");
    let peak = -0.5 * (motion.covariance.determinant().ln() + 3.0 * TAU.ln());
    let log_density = match prior {
        NewPlace::Uniform(area) => -(area * TAU).ln(),
        NewPlace::Corridor { length, spread, deviation, crooked } => {
            let pose = motion.pose;
            let least = ((motion.covariance[(0, 0)] + motion.covariance[(1, 1)]) / 2.0).sqrt();
            let metres = pose.x.hypot(pose.y).max(least);
            let way = pose.y.atan2(pose.x);
            let back = wrap(way + PI - pose.theta);
            let direction = |angle: f64, bearing: Option<f64>| match bearing {
                None => -TAU.ln(),
                Some(bearing) => {
                    let off = wrap(angle - bearing) / deviation;
                    let straight = (-0.5 * off * off).exp() / (TAU.sqrt() * deviation);
                    ((1.0 - crooked) * straight + crooked / TAU).ln()
                }
            };
            let off = (metres / length).ln() / spread;
            let exit = route.shape(travel).bearings[leg.exit];
            let entry = route.shape(travel + 1).bearings[leg.entry];
            -0.5 * off * off - (metres * spread).ln() - 0.5 * TAU.ln() - metres.ln()
                + direction(way, exit)
                + direction(back, entry)
        }
    };
    peak - log_density
}
