//! The rooms, corridors and doors of a grid map, and what leads from place to place: of a map's YAML file, or of a simulated floor.
#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use hssh::account::PlacesAccount;
use hssh::local::{RegionMap, RegionOptions, Roadmap, RoadmapOptions, read_map};
use hssh::world::{floor_plan, grid};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let grid = match std::env::args().nth(1) {
        Some(yaml) => read_map(yaml.as_ref())?,
        None => floor_plan(&grid(2, 2, 12.0)?, 2.4, 0.1)?,
    };
    let map = RegionMap::new(&grid, &RegionOptions::default())?;
    let options = RoadmapOptions::default();
    let account =
        PlacesAccount::of_regions("floor", &map, &Roadmap::new(&grid, &map, &options), options.radius);
    for (number, region) in account.regions.iter().enumerate() {
        println!("{}: {:.1} m²", region.title(number), region.area);
    }
    for connection in &account.connections {
        let [from, to] = &connection.ends;
        println!("place {} leads to place {}, {:.1} m", from.place, to.place, connection.length);
    }
    assert!(!account.regions.is_empty() && !account.places.is_empty());
    Ok(())
}
