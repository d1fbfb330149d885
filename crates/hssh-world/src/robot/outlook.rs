//! What the robot makes of its surroundings: its local perceptual model, and the place-neighborhood in it
//! (section 2.2).

use std::f64::consts::PI;

use hssh_causal::control::{Exit, Vicinity};
use hssh_local::{Gateway, LatticeError, LocalMap, Scan, Sighting, SurveyOptions, Tracker, sight};
use hssh_metrics::{Pose, wrap_angle};
use nalgebra::Vector2;

/// Two readings of a neighborhood have their centers so near to one another, in metres, or within the
/// clearance there.
const SAME_CENTER: f64 = 1.0;

/// The robot's local perceptual model, made from what its laser and its wheels tell, and from nothing else.
pub(super) struct Outlook {
    options: SurveyOptions,
    tracker: Tracker,
    map: LocalMap,
    /// Where it took its last scan, in the frame of the model.
    scanned_at: Pose,
    /// What its wheels told since then.
    odometry: Vec<Pose>,
    here: Option<Here>,
    /// How many neighborhoods there were.
    count: u32,
}

/// The neighborhood that the robot is in.
struct Here {
    number: u32,
    sighting: Sighting,
}

impl Outlook {
    pub(super) fn new(options: SurveyOptions) -> Result<Self, LatticeError> {
        Ok(Outlook {
            options,
            tracker: Tracker::new(options.matching),
            map: LocalMap::new(Vector2::zeros(), options.local_map)?,
            scanned_at: Pose::IDENTITY,
            odometry: vec![Pose::IDENTITY],
            here: None,
            count: 0,
        })
    }

    /// Takes in what the wheels tell after a command: a pose in their own frame.
    pub(super) fn move_on(&mut self, odometry: Pose) {
        self.odometry.push(odometry);
    }

    /// Takes in what is seen ahead, by which the robot tracks itself, and behind.
    pub(super) fn take_in(&mut self, front: &Scan, back: &Scan) {
        let before = self.scanned_at;
        self.scanned_at = self.tracker.add(front, &self.odometry).pose;
        self.odometry.drain(..self.odometry.len() - 1);
        self.map.scroll_to(self.scanned_at.translation()).expect("a tracked pose is finite");
        self.map.insert(self.scanned_at, front);
        self.map.insert(self.scanned_at.compose(Pose::new(0.0, 0.0, PI)), back);
        self.map.clear_way(before, self.scanned_at);
    }

    /// Where the robot believes it is, in the frame of the model.
    pub(super) fn pose(&self) -> Pose {
        let [first, .., last] = self.odometry[..] else { return self.scanned_at };
        self.scanned_at.compose(first.between(last))
    }

    /// Looks whether the robot is in a neighborhood, and in which. Gateways stay as they were read first.
    pub(super) fn look(&mut self) {
        let found = self.sighting().filter(|found| found.is_place);
        self.here = match (self.here.take(), found) {
            (Some(here), Some(found)) if is_same(&here.sighting, &found) => Some(here),
            (_, Some(sighting)) => {
                self.count += 1;
                Some(Here { number: self.count, sighting })
            }
            (_, None) => None,
        };
    }

    /// Reads the gateways of the neighborhood again: they show best from its center.
    pub(super) fn read_again(&mut self) {
        let found = self.sighting().filter(|found| found.is_place);
        if let (Some(here), Some(found)) = (&mut self.here, found) {
            here.sighting = found;
        }
    }

    /// What is around the robot, in the frame of the model.
    pub(super) fn sighting(&self) -> Option<Sighting> {
        let at = self.pose().translation();
        sight(&self.map.window(at, self.options.window)?, at, &self.options.place)
    }

    /// The gateways of the neighborhood, in the frame of the model.
    pub(super) fn gateways(&self) -> impl Iterator<Item = &Gateway> {
        self.here.iter().flat_map(|here| &here.sighting.gateways)
    }

    /// The neighborhood as it looks from where the robot is.
    pub(super) fn vicinity(&self) -> Option<Vicinity> {
        let (here, from) = (self.here.as_ref()?, self.pose());
        let seen = |point: Vector2<f64>| -> [f64; 2] {
            (from.rotation().transpose() * (point - from.translation())).into()
        };
        let exit = |gateway: &Gateway| Exit {
            position: seen(gateway.position.into()),
            bearing: wrap_angle(gateway.bearing - from.theta),
            width: gateway.width,
        };
        Some(Vicinity {
            number: here.number,
            center: Some(seen(here.sighting.center)),
            gateways: self.gateways().map(exit).collect(),
        })
    }
}

fn is_same(one: &Sighting, other: &Sighting) -> bool {
    (one.center - other.center).norm() <= one.clearance.max(SAME_CENTER)
}
