//! The truth about the drive of a simulated robot, and what it took.

use std::fmt;

use hssh_local::PlaceNumber;
use hssh_metrics::Pose;
use hssh_topology::Olp;
use hssh_world::robot::{Drive, Stop};
use serde::{Deserialize, Serialize};

use crate::answer::{EndReference, counted};

/// The truth about a drive; metres and radians in the frame of the map that was driven through.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct DriveAccount {
    /// `hssh-drive`.
    pub format: String,
    /// 1.
    pub version: u32,
    /// The map, as it was given.
    pub name: String,
    /// How it ended, in words.
    pub ending: String,
    /// How far the robot drove: metres.
    pub metres: f64,
    /// How many scans it took.
    pub scans: u64,
    /// The places of the map.
    pub places: Vec<DrivePlace>,
    /// Which of their ends lead to one another.
    pub connections: Vec<[EndReference; 2]>,
    /// Where the robot centered itself.
    pub stops: Vec<DriveStop>,
}

/// A place of the map.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct DrivePlace {
    /// Its center.
    pub center: [f64; 2],
    /// Its star, as the thesis writes it.
    pub star: String,
}

/// Where the robot centered itself.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct DriveStop {
    /// Seconds since the start.
    pub time: f64,
    /// Where it was.
    pub pose: Pose,
    /// The place of the map that it was at; absent if it was at none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub place: Option<u32>,
    /// The place that it meant to be at, if it meant any.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub meant: Option<u32>,
    /// Metres from the place's center.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub off_center: Option<f64>,
    /// The end of the place that it left by; absent if it stayed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub exit: Option<String>,
}

impl DriveAccount {
    /// The account of a drive through a map with that name.
    #[must_use]
    pub fn new(name: &str, drive: &Drive) -> Self {
        let graph = &drive.graph;
        let end_name = |place: PlaceNumber, olp: Olp| graph.place(place).star.star.name(olp).to_string();
        let ends =
            |(place, olp): (PlaceNumber, Olp)| EndReference { place: place.0, end: end_name(place, olp) };
        let stop = |stop: &Stop| DriveStop {
            time: drive.moments.get(stop.moment).or(drive.moments.last()).map_or(0.0, |moment| moment.time),
            pose: stop.pose,
            place: stop.place.map(|place| place.0),
            meant: stop.meant.map(|place| place.0),
            off_center: stop.off_center,
            exit: stop.place.zip(stop.exit).map(|(place, exit)| end_name(place, exit)),
        };
        let steps = drive.moments.windows(2);
        let places = graph.places.iter();
        DriveAccount {
            format: "hssh-drive".to_owned(),
            version: 1,
            name: name.to_owned(),
            ending: drive.ending.to_string(),
            metres: steps.map(|pair| pair[0].pose.between(pair[1].pose).translation().norm()).sum(),
            scans: drive.moments.iter().filter(|moment| moment.scan.is_some()).count() as u64,
            places: places
                .map(|place| DrivePlace { center: place.center, star: place.star.star.to_string() })
                .collect(),
            connections: graph.connections.iter().map(|found| found.ends.map(ends)).collect(),
            stops: drive.stops.iter().map(stop).collect(),
        }
    }
}

/// What the robot did, in words.
impl fmt::Display for DriveAccount {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{}: {}, {}, {:.0} m, {}; {}\nplaces:",
            self.name,
            counted(self.places.len(), "place"),
            counted(self.stops.len().saturating_sub(1), "travel"),
            self.metres,
            counted(self.scans as usize, "scan"),
            self.ending
        )?;
        for stop in &self.stops {
            match stop.place {
                Some(place) => write!(f, " {place}")?,
                None => f.write_str(" ?")?,
            }
        }
        writeln!(f)
    }
}
