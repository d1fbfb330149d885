//! The numbers that local maps go by.

/// The numbers that local maps go by, each beside its default.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct LocalMapOptions {
    /// Side of a cell in metres.
    pub resolution: f64,
    /// Side of the whole map in metres: what is farther from the robot is forgotten.
    pub side: f64,
    /// Metres: farther along a beam, nothing is believed.
    pub reach: f64,
    /// Evidence of a hit for an occupied cell, in nats.
    pub hit: f32,
    /// Evidence of a beam that goes through for a free cell, in nats.
    pub miss: f32,
    /// Radius in metres of the disc around the robot that is certainly free where it went…
    pub body: f64,
    /// …and the evidence for that, in nats.
    pub certainty: f32,
    /// A cell's evidence stays within these bounds, free and occupied, so that the map can change its mind.
    pub bounds: (f32, f32),
    /// A cell is free with less evidence than the first number and occupied with more than the second.
    pub thresholds: (f32, f32),
}

impl Default for LocalMapOptions {
    fn default() -> Self {
        LocalMapOptions {
            resolution: 0.1,
            side: 48.0,
            reach: 16.0,
            hit: 1.2,
            miss: 0.4,
            body: 0.35,
            certainty: 6.0,
            bounds: (-4.0, 5.0),
            thresholds: (-0.3, 0.5),
        }
    }
}
