//! The places and connections of a real floor against its rooms.

use std::collections::{BTreeMap, BTreeSet};
use std::error::Error;
use std::path::Path;

use hssh_local::{Cell, Lattice, PlaceGraph, PlaceOptions, read_map};
use serde::Deserialize;

/// The rooms of the floor.
#[derive(Deserialize)]
pub(super) struct Rooms {
    /// Their names.
    pub(super) locations: Vec<String>,
    /// The outlines in the order of the names: columns and rows from the top, in turn.
    polygons: Vec<Vec<f64>>,
}

pub(super) fn report(folder: &Path) -> Result<String, Box<dyn Error>> {
    let rooms = Rooms::read(folder)?;
    let grid = read_map(&folder.join("3.yaml"))?;
    let lattice = *grid.lattice();
    let graph = PlaceGraph::new(&grid, &PlaceOptions::default())?;
    let room_of = |point: [f64; 2]| {
        let [column, row] = lattice.continuous(point);
        rooms.at([column, f64::from(lattice.height()) - row])
    };
    let with_place: BTreeSet<usize> = graph.places.iter().filter_map(|place| room_of(place.center)).collect();
    let lines = graph.connections.iter().map(|connection| &connection.line);
    let lines = lines.chain(graph.open_ends.iter().map(|open| &open.line));
    let lines = lines.map(|line| line.iter().map(|point| point.point));
    let found: BTreeSet<(usize, usize)> = lines.flat_map(|line| passages(line, &lattice, room_of)).collect();
    let truth = rooms.connections(folder)?;
    let right = found.intersection(&truth).count();
    let reached: BTreeSet<usize> = found.iter().flat_map(|&(a, b)| [a, b]).collect();
    let name = |&(a, b): &(usize, usize)| format!("{}-{}", rooms.locations[a], rooms.locations[b]);
    Ok(format!(
        "gdc3: {} places in {} of {} rooms, {} connections between places; rooms that the axis reaches from another: {}\n\
         pairs of rooms that the axis joins: {}, right {right} ({:.0}%); of the {} true pairs found: {:.0}%\n\
         wrong: {}\nmissed: {}\n",
        graph.places.len(),
        with_place.len(),
        rooms.locations.len(),
        graph.connections.len(),
        reached.len(),
        found.len(),
        100.0 * right as f64 / found.len().max(1) as f64,
        truth.len(),
        100.0 * right as f64 / truth.len().max(1) as f64,
        found.difference(&truth).map(name).collect::<Vec<_>>().join(" "),
        truth.difference(&found).map(name).collect::<Vec<_>>().join(" "),
    ))
}

/// The pairs of rooms that a line goes between, looked at from cell to cell; stretches outside all rooms are walls'
/// thickness.
pub(super) fn passages(
    line: impl Iterator<Item = [f64; 2]>,
    lattice: &Lattice,
    room_of: impl Fn([f64; 2]) -> Option<usize>,
) -> Vec<(usize, usize)> {
    let cells: Vec<Cell> = line.filter_map(|point| lattice.cell_at(point)).collect();
    let between = cells.windows(2).flat_map(|pair| lattice.line(pair[0], pair[1]));
    let mut rooms: Vec<usize> = between.filter_map(|cell| room_of(lattice.center(cell))).collect();
    rooms.dedup();
    rooms.windows(2).map(|pair| (pair[0].min(pair[1]), pair[0].max(pair[1]))).collect()
}

impl Rooms {
    pub(super) fn read(folder: &Path) -> Result<Self, Box<dyn Error>> {
        Ok(serde_saphyr::from_str(&std::fs::read_to_string(folder.join("locations.yaml"))?)?)
    }

    /// The room at a point in columns and rows from the top.
    pub(super) fn at(&self, point: [f64; 2]) -> Option<usize> {
        self.polygons.iter().position(|outline| is_inside(outline, point))
    }

    /// The true pairs of connected rooms.
    pub(super) fn connections(&self, folder: &Path) -> Result<BTreeSet<(usize, usize)>, Box<dyn Error>> {
        let yaml = std::fs::read_to_string(folder.join("connectivity.yaml"))?;
        let neighbors: BTreeMap<String, Vec<String>> = serde_saphyr::from_str(&yaml)?;
        let number = |name: &String| self.locations.iter().position(|other| other == name);
        let pairs = neighbors.iter().flat_map(|(room, others)| others.iter().map(move |other| (room, other)));
        let numbered = pairs.filter_map(|(room, other)| number(room).zip(number(other)));
        Ok(numbered.map(|(a, b)| (a.min(b), a.max(b))).collect())
    }
}

/// Whether a ray to the right leaves an outline an odd number of times.
fn is_inside(outline: &[f64], [x, y]: [f64; 2]) -> bool {
    let corner = |index: usize| [outline[2 * index], outline[2 * index + 1]];
    let corners = outline.len() / 2;
    let crossings = (0..corners).filter(|&index| {
        let ([ax, ay], [bx, by]) = (corner(index), corner((index + 1) % corners));
        (ay > y) != (by > y) && x < ax + (y - ay) / (by - ay) * (bx - ax)
    });
    crossings.count() % 2 == 1
}
