//! All numbers that places, gateways and stars go by: the one calibration, for whole maps and along logs.

use serde::{Deserialize, Serialize};

use crate::skeleton::SkeletonOptions;

/// How places, their gateways and their stars are found in a grid, each number beside its meaning; lengths in
/// metres, angles in radians. In a file, what is left out is as in the default.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct PlaceOptions {
    /// What free space and its axis are, how wide a way is and how far a way out leads.
    pub skeleton: SkeletonOptions,
    /// Where gateways are.
    pub gateway: GatewayOptions,
    /// Which constrictions are doors.
    pub door: DoorOptions,
    /// Two junctions of the axis are one place if the way between them is at most this part of the
    /// larger clearance of the two. Default: 1.0: one lies in the free disc of the other.
    pub one_place: f64,
    /// A way that turns by at least this much within a few widths makes a corner. Default: 50°.
    pub corner: f64,
    /// A path goes on across a place if its two gateways point away from one another up to this much.
    /// Default: 30°, less than the 36° of a regular star of five.
    pub straight: f64,
    /// … and if the line through one of them passes the other by no more than this part of their mean
    /// width. Default: 1.0.
    pub aligned: f64,
    /// Around a point, cells that were not seen are free if they are this near to free ones: far away, beams are
    /// far apart. Default: 0.1 m.
    pub gap: f64,
    /// How far from a point the middle of its neighborhood, the widest point, is looked for. Default: 1.5 m.
    pub climb: f64,
    /// The neighborhood of a point reaches this far beyond the free disc around its middle. Default: 1.5 m.
    pub margin: f64,
    /// A point is at a place if the place's center is no farther away than this, beyond its clearance.
    /// Default: 2.0 m.
    pub arrival: f64,
}

impl Default for PlaceOptions {
    fn default() -> Self {
        PlaceOptions {
            skeleton: SkeletonOptions::default(),
            gateway: GatewayOptions::default(),
            door: DoorOptions::default(),
            one_place: 1.0,
            corner: 50_f64.to_radians(),
            straight: 30_f64.to_radians(),
            aligned: 1.0,
            gap: 0.1,
            climb: 1.5,
            margin: 1.5,
            arrival: 2.0,
        }
    }
}

impl PlaceOptions {
    /// How far a way out of a place leads where corridors count, in metres: rooms, niches and lobbies, as far as
    /// they are seen through their doors, end before.
    pub const CORRIDOR: f64 = 8.0;

    /// Places where corridors meet, as along logs: ways out lead [`CORRIDOR`](Self::CORRIDOR) metres on, and go on
    /// straight up to 40° and one and a half widths, for clutter pushes the middle of a corridor aside.
    #[must_use]
    pub fn corridors() -> Self {
        PlaceOptions { straight: 40_f64.to_radians(), aligned: 1.5, ..PlaceOptions::default() }
            .with_depth(Self::CORRIDOR)
    }

    /// The same options for ways out that lead `depth` metres on.
    #[must_use]
    pub fn with_depth(mut self, depth: f64) -> Self {
        self.skeleton.shallowest_branch = depth;
        self
    }

    /// How far a way out leads on, at least.
    #[must_use]
    pub fn depth(&self) -> f64 {
        self.skeleton.shallowest_branch
    }
}

/// Where along a way out of a place its gateway is; lengths in metres.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct GatewayOptions {
    /// Along the medial axis a gateway is at least this far from the place's center, as a part of the clearance
    /// there. Default: 0.5, which is where two corridors of one width that cross have theirs.
    pub nearest: f64,
    /// Along the medial axis it is looked for as far as this many times the clearance at the center …
    /// Default: 1.5.
    pub reach: f64,
    /// … and this many metres more.
    /// Default: 1.0 m.
    pub reach_beyond: f64,
    /// Of all points in reach the first one counts that is at most this part wider than the narrowest:
    /// a corridor begins where it has reached its width. Default: 0.1.
    pub as_narrow: f64,
    /// The outward direction is that of the medial axis over this length from the gateway on, or twice the
    /// clearance there if that is more. Default: 1.0 m.
    pub aim: f64,
    /// Around a point, the outward direction is that of the line fitted to the first metres of the way out,
    /// as far as this: it evens out clutter. Default: 6.0 m.
    pub fitted: f64,
    /// A constriction (not of a place, but anywhere along the axis) is narrower than the widest point
    /// within reach on either side by at least this factor. Default: 0.75.
    pub constriction: f64,
}

impl Default for GatewayOptions {
    fn default() -> Self {
        GatewayOptions {
            nearest: 0.5,
            reach: 1.5,
            reach_beyond: 1.0,
            as_narrow: 0.1,
            aim: 1.0,
            fitted: 6.0,
            constriction: 0.75,
        }
    }
}

/// What makes a constriction a door; lengths in metres.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct DoorOptions {
    /// The widest door. Default: 1.1 m.
    pub widest: f64,
    /// Points so far before and behind the constriction are compared. Default: 1.0 m.
    pub step: f64,
    /// What is in sight is counted as far as this. Default: 6.0 m.
    pub reach: f64,
    /// At least so many square metres are in sight from one of the two points only: a gap between two desks
    /// hides little of the room that both are in. Default: 20 m².
    pub least_hidden: f64,
}

impl Default for DoorOptions {
    fn default() -> Self {
        DoorOptions { widest: 1.1, step: 1.0, reach: 6.0, least_hidden: 20.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_file_says_what_differs_from_the_default() {
        let text = "arrival: 1.5\nskeleton: { shallowest_branch: 8 }\ngateway: { aim: 2 }\n";
        let read: PlaceOptions = serde_saphyr::from_str(text).unwrap();
        let mut expected = PlaceOptions { arrival: 1.5, ..PlaceOptions::default() }.with_depth(8.0);
        expected.gateway.aim = 2.0;
        assert_eq!(read, expected);
    }

    #[test]
    fn a_misspelled_number_is_refused() {
        for text in ["arival: 1.5", "skeleton: { depth: 8 }", "gateway: { aims: 2 }", "door: { wide: 1 }"] {
            assert!(serde_saphyr::from_str::<PlaceOptions>(text).is_err(), "{text}");
        }
    }
}
