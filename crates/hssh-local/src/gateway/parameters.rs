//! How far from a place its gateways are looked for.

/// Where along a way out of a place its gateway is; lengths in metres.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct GatewayParameters {
    /// A gateway is at least this far from the place's center, as a part of the clearance there.
    /// Default: 0.5, which is where two corridors of one width that cross have theirs.
    pub nearest: f64,
    /// It is looked for as far as this many times the clearance at the center …  Default: 1.5.
    pub reach: f64,
    /// … and this many metres more. Default: 1.0 m.
    pub reach_beyond: f64,
    /// Of all points in reach the first one counts that is at most this part wider than the narrowest:
    /// a corridor begins where it has reached its width. Default: 0.1.
    pub as_narrow: f64,
    /// The outward direction is that of the axis over this length from the gateway on, or twice the
    /// clearance there if that is more. Default: 1.0 m.
    pub aim: f64,
    /// A constriction (not of a place, but anywhere along the axis) is narrower than the widest point
    /// within reach on either side by at least this factor. Default: 0.75.
    pub constriction: f64,
}

impl Default for GatewayParameters {
    fn default() -> Self {
        GatewayParameters {
            nearest: 0.5,
            reach: 1.5,
            reach_beyond: 1.0,
            as_narrow: 0.1,
            aim: 1.0,
            constriction: 0.75,
        }
    }
}
