//! One topological map as a picture.

mod building;
mod clearance;
mod dot;
mod figure;
mod marks;

pub(crate) use clearance::Obstacles;
pub use dot::map_to_dot;
pub(crate) use dot::quoted;
pub use figure::draw_map;
pub(crate) use marks::Scene;

use crate::grid::RegionPicture;
use hssh_topology::{Measure, PlaceId, StarId, TopologicalMap};

/// What is drawn besides the map itself.
#[derive(Clone, PartialEq, Debug)]
pub struct MapOptions {
    /// A line above the map.
    pub title: Option<String>,
    /// Where the robot is: marked with the little arrow of Figure 2.5.
    pub current: Option<PlaceId>,
    /// Names of the stars, by number; written beside the places that have them. Missing and empty names
    /// are left out.
    pub star_names: Vec<String>,
    /// Whether to write a line below the map with its measure: f1, f2, f3, genus, pending gateways.
    pub measure: bool,
    /// The building around a measured map, drawn under it.
    pub building: Option<BuildingPicture>,
}

/// A building to be drawn, in the unit and frame of the places' poses.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct BuildingPicture {
    /// Rooms, corridors and what else there is.
    pub regions: Vec<RegionPicture>,
    /// Lines across doors.
    pub doors: Vec<[[f64; 2]; 2]>,
}

impl Default for MapOptions {
    fn default() -> Self {
        MapOptions { title: None, current: None, star_names: Vec::new(), measure: true, building: None }
    }
}

impl MapOptions {
    fn star_name(&self, star: StarId) -> Option<&str> {
        self.star_names.get(star.index()).map(String::as_str).filter(|name| !name.is_empty())
    }
}

/// The measure of a map in one line.
fn measure_line(map: &TopologicalMap) -> String {
    let Measure { undetermined_boundaries, paths, places, genus } = Measure::of(map);
    let counted = |count: u32, noun: &str| match count {
        1 => format!("1 {noun}"),
        _ => format!("{count} {noun}s"),
    };
    let closed = match map.pending_count() {
        0 => "closed".to_owned(),
        pending => format!("not closed: {}", counted(pending, "pending gateway")),
    };
    let (paths, places) = (counted(paths, "path"), counted(places, "place"));
    format!(
        "f1 = {undetermined_boundaries}  ·  f2 = {paths}  ·  f3 = {places}  ·  genus {genus}  ·  {closed}"
    )
}
