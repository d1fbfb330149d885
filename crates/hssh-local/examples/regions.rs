//! Rooms, passages and ways of a grid map: two rooms with a door between them.
#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use hssh_local::{Lattice, Occupancy, OccupancyGrid, RegionMap, RegionOptions, Roadmap, RoadmapOptions};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let lattice = Lattice::new(240, 120, 0.05, [0.0, 0.0])?;
    let mut grid = OccupancyGrid::filled(lattice, Occupancy::Occupied);
    for cell in lattice.cells() {
        let is_inside = (10..110).contains(&cell.row) && (10..230).contains(&cell.column);
        let is_wall = (118..122).contains(&cell.column) && !(50..68).contains(&cell.row);
        if is_inside && !is_wall {
            grid.set(cell, Occupancy::Free);
        }
    }
    let map = RegionMap::new(&grid, &RegionOptions::default())?;
    let roadmap = Roadmap::new(&grid, &map, &RoadmapOptions::default());
    for passage in &map.passages {
        println!("{:.2} m wide, a door with {:.0}%", passage.gateway.width, 100.0 * passage.door_probability);
    }
    for way in &roadmap.ways {
        println!("a way of {:.1} m, {:.1} m wide", way.length, way.width);
    }
    assert_eq!(map.passages.len(), 1);
    Ok(())
}
