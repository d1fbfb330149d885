//! The roadmap of a grid: all steps from its regions to it.

use rayon::prelude::*;

use super::graph::{RoadNode, RoadNodeKind, RoadNodeNumber, Roadmap};
use super::options::RoadmapOptions;
use super::{connection, region, window};
use crate::distance::DistanceField;
use crate::grid::{Occupancy, OccupancyGrid};
use crate::region::{RegionMap, RegionNumber};
use crate::skeleton::UnknownSpace;

impl Roadmap {
    /// The roadmap of a grid with its regions.
    #[must_use]
    pub fn new(grid: &OccupancyGrid, map: &RegionMap, options: &RoadmapOptions) -> Self {
        let is_obstacle = |index: usize| match grid.cells()[index] {
            Occupancy::Free => false,
            Occupancy::Occupied => !map.is_sign(index),
            Occupancy::Unknown => options.unknown != UnknownSpace::Free && !map.is_sign(index),
        };
        let field = DistanceField::new(*grid.lattice(), is_obstacle);
        let exits = region::exits(map, &field, options);
        let bounds = window::bounds(map);
        let mut roadmap =
            Roadmap { nodes: Vec::new(), ways: Vec::new(), places: Vec::new(), connections: Vec::new() };
        let passages: Vec<Option<RoadNodeNumber>> = (0..map.passages.len())
            .map(|passage| {
                let position = grid.lattice().center(exits[passage]?);
                let region = map.passages[passage].regions[0];
                Some(roadmap.add(RoadNode { kind: RoadNodeKind::Passage(passage as u32), region, position }))
            })
            .collect();
        let passage_nodes = roadmap.nodes.len() as u32;
        let ground = region::Ground { map, field: &field, exits: &exits, passages: &passages, passage_nodes };
        // Each region by itself, on as many threads as there are; what they add is put together in their order.
        let roads: Vec<region::RegionRoads> = (0..map.regions.len())
            .into_par_iter()
            .map(|number| {
                region::RegionRoads::new(&ground, RegionNumber(number as u32), bounds[number], options)
            })
            .collect();
        let parts: Vec<region::RegionPart> =
            roads.into_iter().map(|roads| roads.add_to(&mut roadmap, passage_nodes)).collect();
        connection::connect(&mut roadmap, map, &parts, options);
        roadmap
    }
}
