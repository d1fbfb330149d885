//! The stars of the nine places of the ACES floor, from the whole map and from a window around each.

use std::error::Error;
use std::path::Path;

use hssh_local::{OccupancyGrid, PlaceGraph, PlaceParameters, neighborhood, read_map};

use crate::table::aligned;

/// The side of the window around a place, in metres.
pub(super) const WINDOW: f64 = 14.0;

/// A place of the floor, by its name in the topology that was made by hand.
pub(super) struct KnownPlace {
    pub(super) name: String,
    pub(super) point: [f64; 2],
    /// The number of gateways in the 3×3 grid of corridors.
    pub(super) gateways: usize,
}

/// Gateways of corridors are wider than doors, and corridors are longer than niches.
pub(super) fn corridors() -> PlaceParameters {
    let mut parameters = PlaceParameters::default();
    parameters.skeleton.narrowest_passage = 1.0;
    parameters.skeleton.shallowest_branch = 2.5;
    parameters
}

pub(super) fn report(data: &Path) -> Result<String, Box<dyn Error>> {
    let grid = read_map(&data.join("gridmap").join("aces.yaml"))?;
    let parameters = corridors();
    let graph = PlaceGraph::new(&grid, &parameters)?;
    let mut rows = vec![["place", "in truth", "off by", "whole map", "window"].map(str::to_owned).to_vec()];
    for place in known_places(data)? {
        let away = |center: [f64; 2]| (center[0] - place.point[0]).hypot(center[1] - place.point[1]);
        let nearest = graph
            .places
            .iter()
            .min_by(|a, b| away(a.center).total_cmp(&away(b.center)))
            .ok_or("no places")?;
        rows.push(vec![
            place.name.clone(),
            place.gateways.to_string(),
            format!("{:.1} m", away(nearest.center)),
            nearest.star.star.to_string(),
            local_star(&grid, place.point, &parameters),
        ]);
    }
    Ok(format!(
        "ACES: {} places, {} connections; at the nine places of the 3×3 grid of corridors (the map also shows what lies beyond them)\n{}",
        graph.places.len(),
        graph.connections.len(),
        aligned(&rows)
    ))
}

fn local_star(grid: &OccupancyGrid, point: [f64; 2], parameters: &PlaceParameters) -> String {
    let Some(window) = grid.window(point, WINDOW) else { return "off the map".to_owned() };
    match neighborhood(&window, point, parameters) {
        Ok(found) => format!("{:?} {}", found.kind, found.star.star),
        Err(error) => error.to_string(),
    }
}

/// The `PLACE` lines of the topology made by hand, with the degree that the `EDGE` lines give them.
pub(super) fn known_places(data: &Path) -> Result<Vec<KnownPlace>, Box<dyn Error>> {
    let text = std::fs::read_to_string(data.join("logs").join("aces-topology.txt"))?;
    let words = |line: &str| line.split_whitespace().map(str::to_owned).collect::<Vec<_>>();
    let lines: Vec<Vec<String>> = text.lines().map(words).collect();
    let edges: Vec<&String> = lines
        .iter()
        .filter(|line| line.first().is_some_and(|word| word == "EDGE"))
        .flat_map(|line| &line[1..])
        .collect();
    let mut places = Vec::new();
    for line in lines.iter().filter(|line| line.first().is_some_and(|word| word == "PLACE")) {
        let [_, name, x, y] = &line[..] else {
            return Err("aces-topology.txt: PLACE takes a name, x and y".into());
        };
        let gateways = edges.iter().filter(|&&end| end == name).count();
        places.push(KnownPlace { name: name.clone(), point: [x.parse()?, y.parse()?], gateways });
    }
    Ok(places)
}
