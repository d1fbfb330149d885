//! Constrictions of the medial axis against the doors of a real floor.

use std::error::Error;
use std::path::Path;

use hssh_local::{DoorOptions, Gateway, PlaceGraph, PlaceOptions, read_map};
use serde::Deserialize;

use crate::table::aligned;

/// A gateway is at a door if it is this near to the middle of the door, in metres.
const NEAR: f64 = 0.5;

/// What is taken for a door: no wider than so many metres, and hiding so many square metres.
const CRITERIA: [(f64, f64); 9] = [
    (0.9, 0.0),
    (1.1, 0.0),
    (1.5, 0.0),
    (1.8, 0.0),
    (1.1, 15.0),
    (1.1, 20.0),
    (1.1, 25.0),
    (1.1, 30.0),
    (1.8, 20.0),
];

/// A door of the floor.
#[derive(Deserialize)]
pub(super) struct Door {
    name: String,
    door_corner_pt_1: [f64; 2],
    door_corner_pt_2: [f64; 2],
}

/// The doors of the floor.
pub(super) fn read(folder: &Path) -> Result<Vec<Door>, Box<dyn Error>> {
    Ok(serde_saphyr::from_str(&std::fs::read_to_string(folder.join("doors.yaml"))?)?)
}

impl Door {
    fn middle(&self) -> [f64; 2] {
        let [a, b] = [self.door_corner_pt_1, self.door_corner_pt_2];
        [(a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0]
    }

    /// Whether a gateway is near to its middle.
    pub(super) fn is_at(&self, gateway: &Gateway) -> bool {
        let [dx, dy] = [self.middle()[0] - gateway.position[0], self.middle()[1] - gateway.position[1]];
        dx.hypot(dy) <= NEAR
    }
}

pub(super) fn report(folder: &Path) -> Result<String, Box<dyn Error>> {
    let doors = read(folder)?;
    let grid = read_map(&folder.join("3.yaml"))?;
    let graph = PlaceGraph::new(&grid, &PlaceOptions::default())?;
    let mut gateways = graph.constrictions.clone();
    let constrictions = gateways.len();
    gateways.extend(graph.places.iter().flat_map(|place| place.star.gateways()).copied());
    let mut rows = vec![
        [
            "widest",
            "hides",
            "constrictions",
            "at a door",
            "precision",
            "doors found",
            "recall",
            "gateways too: found",
            "recall",
        ]
        .map(str::to_owned)
        .to_vec(),
    ];
    for (widest, hidden) in CRITERIA {
        let criterion = DoorOptions { widest, least_hidden: hidden, ..DoorOptions::default() };
        let score = |gateways: &[Gateway]| score(&doors, &hssh_local::doors(&grid, gateways, &criterion));
        let (taken, at_door, found) = score(&gateways[..constrictions]);
        let (_, _, found_by_any) = score(&gateways);
        let percent = |part: usize, all: usize| format!("{:.0}%", 100.0 * part as f64 / all.max(1) as f64);
        rows.push(vec![
            format!("{widest:.1} m"),
            format!("{hidden:.0} m²"),
            taken.to_string(),
            at_door.to_string(),
            percent(at_door, taken),
            format!("{found} of {}", doors.len()),
            percent(found, doors.len()),
            found_by_any.to_string(),
            percent(found_by_any, doors.len()),
        ]);
    }
    let missed = doors.iter().filter(|door| gateways.iter().all(|gateway| !door.is_at(gateway)));
    let missed: Vec<&str> = missed.map(|door| door.name.as_str()).collect();
    Ok(format!(
        "gdc3: constrictions of the medial axis within {NEAR} m of a door, by how wide they may be and how much they hide\n{}no gateway at: {}\n",
        aligned(&rows),
        missed.join(" ")
    ))
}

/// How many gateways there are, how many of these are at a door, and how many doors have one.
fn score(doors: &[Door], gateways: &[Gateway]) -> (usize, usize, usize) {
    let at_door = gateways.iter().filter(|gateway| doors.iter().any(|door| door.is_at(gateway))).count();
    let found = doors.iter().filter(|door| gateways.iter().any(|gateway| door.is_at(gateway))).count();
    (gateways.len(), at_door, found)
}
