//! The two sample grids of EVG-Thin: a four-way crossing, open and closed at its four ends.

use std::error::Error;
use std::path::Path;

use hssh_local::{PlaceGraph, PlaceOptions, read_floor_plan};

/// Metres per pixel: the samples name none; corridors are then about 4 m wide.
const RESOLUTION: f64 = 0.05;

pub(super) fn report(folder: &Path) -> Result<String, Box<dyn Error>> {
    let mut text = "EVG-Thin samples: the star of the crossing\n".to_owned();
    for name in ["test1.pgm", "test2.pgm"] {
        let grid = read_floor_plan(&folder.join(name), RESOLUTION)?;
        let graph = PlaceGraph::new(&grid, &PlaceOptions::default())?;
        let stars = graph.places.iter().map(|place| format!("{:?} {}", place.kind, place.star.star));
        text += &format!(
            "  {name}: {}; {} connections, {} open ends\n",
            stars.collect::<Vec<_>>().join("; "),
            graph.connections.len(),
            graph.open_ends.len()
        );
    }
    Ok(text)
}
