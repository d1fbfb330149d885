//! All parameters on the way from a grid to stars.

use crate::gateway::GatewayParameters;
use crate::skeleton::SkeletonParameters;

/// How places and their stars are found in a grid; lengths in metres, angles in radians.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct PlaceParameters {
    /// What free space and its axis are.
    pub skeleton: SkeletonParameters,
    /// Where gateways are.
    pub gateway: GatewayParameters,
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
}

impl Default for PlaceParameters {
    fn default() -> Self {
        PlaceParameters {
            skeleton: SkeletonParameters::default(),
            gateway: GatewayParameters::default(),
            one_place: 1.0,
            corner: 50_f64.to_radians(),
            straight: 30_f64.to_radians(),
            aligned: 1.0,
        }
    }
}
