//! The places of a grid map: two corridors that cross, or a map of ROS `map_server` by its YAML file.
#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use hssh_local::{Lattice, Occupancy, OccupancyGrid, PlaceGraph, PlaceOptions, read_map};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let grid = std::env::args().nth(1).map_or_else(crossing, |file| Ok(read_map(file.as_ref())?))?;
    let graph = PlaceGraph::new(&grid, &PlaceOptions::default())?;
    for place in &graph.places {
        println!("{:?} at {:.1?}: {}", place.kind, place.center, place.star.star);
    }
    println!("{} connections", graph.connections.len());
    assert!(!graph.places.is_empty());
    Ok(())
}

/// Corridors 2 m wide and 20 m long, in cells of 0.1 m.
fn crossing() -> Result<OccupancyGrid, Box<dyn std::error::Error>> {
    let lattice = Lattice::new(220, 220, 0.1, [0.0, 0.0])?;
    let mut grid = OccupancyGrid::filled(lattice, Occupancy::Occupied);
    for cell in lattice.cells() {
        let [is_wide, is_long] =
            [100..120, 10..210].map(|range| [cell.row, cell.column].map(|at| range.contains(&at)));
        if is_wide[1] && is_long[0] || is_wide[0] && is_long[1] {
            grid.set(cell, Occupancy::Free);
        }
    }
    Ok(grid)
}
