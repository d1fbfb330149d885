//! The stars of the nine places of the ACES floor, from the whole map and from a window around each.

use std::error::Error;
use std::path::Path;

use hssh_local::{OccupancyGrid, PlaceGraph, PlaceOptions, neighborhood, read_map};

use crate::table::aligned;

/// The side of the window around a place, in metres: corridors are to be seen as far as they count.
pub(super) const WINDOW: f64 = 28.0;
/// Ways out lead on so far, in metres, that what is beyond the corridors is none: niches, doors, lobbies.
const DEPTHS: [f64; 2] = [2.5, 8.0];
/// Corridors are so wide, in metres; doors that are ajar are not.
const NARROWEST: f64 = 0.8;

/// A place of the floor, by its name in the topology that was made by hand.
pub(crate) struct KnownPlace {
    pub(crate) name: String,
    pub(crate) point: [f64; 2],
    /// The number of gateways in the 3×3 grid of corridors.
    pub(crate) gateways: usize,
}

/// What counts as a place where corridors meet.
pub(super) fn corridors(depth: f64) -> PlaceOptions {
    let mut parameters = PlaceOptions::default();
    parameters.skeleton.narrowest_passage = NARROWEST;
    parameters.skeleton.shallowest_branch = depth;
    parameters
}

pub(super) fn report(data: &Path) -> Result<String, Box<dyn Error>> {
    let grid = read_map(&data.join("gridmap").join("aces.yaml"))?;
    let truth = known_places(data)?;
    let edges = known_edges(data)?;
    let mut text =
        "ACES: the nine places of the 3×3 grid of corridors, by how far a way out leads\n".to_owned();
    for depth in DEPTHS {
        let graph = PlaceGraph::new(&grid, &corridors(depth))?;
        let nearest = |place: &KnownPlace| {
            let away = |center: [f64; 2]| (center[0] - place.point[0]).hypot(center[1] - place.point[1]);
            let all = (0..graph.places.len()).map(|index| (index, away(graph.places[index].center)));
            all.min_by(|a, b| a.1.total_cmp(&b.1))
        };
        let found: Vec<(usize, f64)> = truth.iter().map(nearest).collect::<Option<_>>().ok_or("no places")?;
        let is_right = |(place, (index, _)): &(&KnownPlace, &(usize, f64))| {
            graph.places[*index].star.gateways().count() == place.gateways
        };
        let right = truth.iter().zip(&found).filter(is_right).count();
        let known: Vec<usize> = found.iter().map(|found| found.0).collect();
        let corridors = edges.iter().filter(|ends| {
            let [from, to] = ends.map(|end| known[end]);
            is_joined(&graph, from, to, &known)
        });
        let worst = found.iter().map(|found| found.1).fold(0.0, f64::max);
        text += &format!(
            "  {depth} m: {} places, {} connections; all nine within {worst:.1} m, {right} with the true number of gateways, {} of the {} corridors\n",
            graph.places.len(),
            graph.connections.len(),
            corridors.count(),
            edges.len()
        );
        if depth == DEPTHS[DEPTHS.len() - 1] {
            let mut rows = vec![["place", "in truth", "whole map", "window"].map(str::to_owned).to_vec()];
            for (place, (index, _)) in truth.iter().zip(&found) {
                rows.push(vec![
                    place.name.clone(),
                    place.gateways.to_string(),
                    graph.places[*index].star.star.to_string(),
                    local_star(&grid, place.point, &self::corridors(depth)),
                ]);
            }
            text += &aligned(&rows);
        }
    }
    Ok(text)
}

/// Whether connections lead from one place to another, by no other of the known ones.
fn is_joined(graph: &PlaceGraph, from: usize, to: usize, known: &[usize]) -> bool {
    let (mut reached, mut waiting) = (vec![from], vec![from]);
    while let Some(here) = waiting.pop() {
        for ends in graph.connections.iter().map(|found| found.ends.map(|end| end.0.index())) {
            let next = match ends {
                [a, b] if a == here => b,
                [a, b] if b == here => a,
                _ => continue,
            };
            if next == to {
                return true;
            }
            if !known.contains(&next) && !reached.contains(&next) {
                reached.push(next);
                waiting.push(next);
            }
        }
    }
    false
}

fn local_star(grid: &OccupancyGrid, point: [f64; 2], parameters: &PlaceOptions) -> String {
    let Some(window) = grid.window(point, WINDOW) else { return "off the map".to_owned() };
    match neighborhood(&window, point, parameters) {
        Ok(found) => format!("{:?} {}", found.kind, found.star.star),
        Err(error) => error.to_string(),
    }
}

/// The `PLACE` lines of the topology made by hand, with the degree that the `EDGE` lines give them.
pub(crate) fn known_places(data: &Path) -> Result<Vec<KnownPlace>, Box<dyn Error>> {
    let lines = topology(data)?;
    let ends: Vec<&String> = of_kind(&lines, "EDGE").flatten().collect();
    let place = |words: &[String]| match words {
        [name, x, y] => {
            let gateways = ends.iter().filter(|&&end| end == name).count();
            Ok(KnownPlace { name: name.clone(), point: [x.parse()?, y.parse()?], gateways })
        }
        _ => Err("aces-topology.txt: PLACE takes a name, x and y".into()),
    };
    of_kind(&lines, "PLACE").map(place).collect()
}

/// The `EDGE` lines, as positions in the list of places.
fn known_edges(data: &Path) -> Result<Vec<[usize; 2]>, Box<dyn Error>> {
    let (lines, places) = (topology(data)?, known_places(data)?);
    let number = |name: &String| places.iter().position(|place| place.name == *name);
    let edge = |words: &[String]| match words {
        [from, to] => number(from).zip(number(to)).map(|(from, to)| [from, to]),
        _ => None,
    };
    let edges: Option<Vec<[usize; 2]>> = of_kind(&lines, "EDGE").map(edge).collect();
    edges.ok_or_else(|| "aces-topology.txt: EDGE takes the names of two places".into())
}

fn topology(data: &Path) -> Result<Vec<Vec<String>>, Box<dyn Error>> {
    let text = std::fs::read_to_string(data.join("logs").join("aces-topology.txt"))?;
    Ok(text.lines().map(|line| line.split_whitespace().map(str::to_owned).collect()).collect())
}

/// The lines that begin with a word, without it.
fn of_kind<'a>(lines: &'a [Vec<String>], kind: &'static str) -> impl Iterator<Item = &'a [String]> {
    lines.iter().filter(move |line| line.first().is_some_and(|word| word == kind)).map(|line| &line[1..])
}
