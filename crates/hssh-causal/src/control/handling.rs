//! How a robot handles: its size, its speed, and how exactly it does what a law says.

/// How a robot handles; metres, radians, seconds.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Handling {
    /// The robot is a disc of this radius.
    pub radius: f64,
    /// The greatest speed, metres per second.
    pub speed: f64,
    /// The greatest rate of turning, radians per second.
    pub turn: f64,
    /// Toward what is farther to the side than this it turns on the spot.
    pub widest_curve: f64,
    /// How far ahead it looks for the midline.
    pub look_ahead: f64,
    /// It keeps at least this much room between itself and what is in its way.
    pub margin: f64,
    /// The farthest that hill-climbing looks for a better position.
    pub climb: f64,
    /// A place is centered in when no position farther away than this is better.
    pub centered: f64,
}

impl Default for Handling {
    fn default() -> Self {
        Handling {
            radius: 0.25,
            speed: 0.6,
            turn: 1.0,
            widest_curve: 0.6,
            look_ahead: 0.8,
            margin: 0.1,
            climb: 3.0,
            centered: 0.1,
        }
    }
}
