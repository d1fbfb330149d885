//! The numbers that a simulated robot goes by.

use hssh_causal::control::Handling;
use hssh_local::{PlaceOptions, SurveyOptions};

use super::laser::Laser;
use super::odometer::Odometer;

/// The numbers that a simulated robot goes by, each beside its default; metres, radians, seconds.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct RobotOptions {
    /// Its size, and how it drives.
    pub handling: Handling,
    /// What it sees with.
    pub laser: Laser,
    /// How its wheels err.
    pub odometer: Odometer,
    /// How many travels it makes at most.
    pub travels: usize,
    /// Seconds from one command to the next.
    pub period: f64,
    /// A scan is logged every so many metres…
    pub scan_distance: f64,
    /// …or radians of turning.
    pub scan_turn: f64,
    /// It looks for a place-neighborhood every so many metres.
    pub look_distance: f64,
    /// How it makes its local map, and what it takes for a place.
    pub outlook: SurveyOptions,
    /// What the places of the whole map are, which the robot does not see: its [`Strategy`](super::Strategy) does.
    pub places: PlaceOptions,
    /// A control law that does not end within so many seconds has failed.
    pub patience: f64,
}

impl Default for RobotOptions {
    fn default() -> Self {
        // A robot centers in a place when it is in it, and not when it sees it coming.
        let place = PlaceOptions { arrival: 1.5, ..PlaceOptions::corridors() };
        RobotOptions {
            handling: Handling::default(),
            laser: Laser::default(),
            odometer: Odometer::default(),
            travels: 40,
            period: 0.1,
            scan_distance: 0.2,
            scan_turn: 0.2,
            look_distance: 0.4,
            outlook: SurveyOptions { place, ..SurveyOptions::default() },
            places: PlaceOptions::default(),
            patience: 120.0,
        }
    }
}

impl RobotOptions {
    /// The same robot with all its errors so many times as large.
    #[must_use]
    pub fn with_noise(mut self, factor: f64) -> Self {
        self.laser.noise *= factor;
        self.laser.dropouts = (self.laser.dropouts * factor).min(1.0);
        self.odometer.distance *= factor;
        self.odometer.heading *= factor;
        self.odometer.turn *= factor;
        self
    }
}
