//! All places of a grid with their stars, and how the medial axis connects their gateways: a
//! generalized Voronoi graph (section 2.2.2).

use hssh_topology::Olp;

use super::candidate::Candidates;
use super::connection::{OpenEnd, PlaceConnection, Resolved, connect};
use super::parts::{Parts, PlaceNumber, PlacedSection};
use super::section::{Section, Way, sections, ways};
use crate::distance::DistanceField;
use crate::grid::{Occupancy, OccupancyGrid};
use crate::place::constriction::constrictions;
use crate::place::gateway::gateway_on;
use crate::place::{Gateway, LocalStar, PlaceKind, PlaceOptions};
use crate::skeleton::{AxisPoint, FreeSpace, Skeleton};

/// A place in a grid.
#[derive(Clone, PartialEq, Debug)]
pub struct GridPlace {
    /// What it looks like; never a passage.
    pub kind: PlaceKind,
    /// The point of the medial axis with most room, in metres.
    pub center: [f64; 2],
    /// How far obstacles are from it, in metres.
    pub clearance: f64,
    /// Its star, with gateways and bearings.
    pub star: LocalStar,
}

/// The places of a grid and what connects them.
#[derive(Clone, Debug)]
pub struct PlaceGraph {
    /// The free space that was looked at.
    pub free: FreeSpace,
    /// Its medial axis.
    pub skeleton: Skeleton,
    /// The places: junctions in the order of their cells, then corners.
    pub places: Vec<GridPlace>,
    /// Which gateways lead to one another.
    pub connections: Vec<PlaceConnection>,
    /// Which gateways lead to where the grid shows no more.
    pub open_ends: Vec<OpenEnd>,
    /// Everywhere that the axis passes a narrow point, doors above all, whether or not it is the gateway
    /// of a place.
    pub constrictions: Vec<Gateway>,
    pub(super) parts: Parts,
}

/// Why a grid has no places.
#[derive(Clone, Copy, PartialEq, Debug, thiserror::Error)]
pub enum PlaceGraphError {
    /// No cell was ever seen.
    #[error("all {cells} cells of the grid are unknown: there is nothing to find places in")]
    AllUnknown {
        /// How many cells there are.
        cells: usize,
    },
    /// No cell is free.
    #[error(
        "none of the {cells} cells of the grid is free; if the image is inverted, say so with `negate: 1` in its YAML file"
    )]
    NothingFree {
        /// How many cells there are.
        cells: usize,
    },
    /// Nothing to be between.
    #[error("the grid has no obstacle: a medial axis lies between obstacles")]
    NoObstacle,
    /// Free, but nowhere wide enough.
    #[error(
        "no free space is {narrowest} m wide, the narrowest passage asked for: is the resolution of {resolution} m per cell right, and does the \
         image show what is free as its YAML file says (`negate`, `mode`, the thresholds)?"
    )]
    TooNarrow {
        /// The least width of a passage, in metres.
        narrowest: f64,
        /// Metres per cell.
        resolution: f64,
    },
}

impl PlaceGraph {
    /// Finds all places of a grid.
    ///
    /// # Errors
    /// If nothing of the grid is known or free, or if there is no obstacle or no room.
    pub fn new(grid: &OccupancyGrid, options: &PlaceOptions) -> Result<Self, PlaceGraphError> {
        let free = FreeSpace::new(grid, &options.skeleton);
        if free.is_empty() {
            return Err(PlaceGraphError::of(grid, free.field(), options.skeleton.narrowest_passage));
        }
        let skeleton = Skeleton::new(grid, &free, &options.skeleton);
        let candidates = Candidates::new(&skeleton, options);
        let sections = sections(&skeleton, &candidates);
        let all_ways = ways(&sections, candidates.all.len());
        let constrictions = constrictions(&skeleton, free.field(), &options.gateway);
        let mut graph = PlaceGraph {
            free,
            skeleton,
            places: Vec::new(),
            connections: Vec::new(),
            open_ends: Vec::new(),
            constrictions,
            parts: Parts::default(),
        };
        graph.parts.sections = sections.iter().map(PlacedSection::unplaced).collect();
        let mut resolved = Vec::new();
        for (candidate, ways) in candidates.all.iter().zip(all_ways) {
            let start = if candidate.is_tip { 1.0 } else { options.gateway.nearest };
            resolved.push(graph.resolve(candidate.center, start, ways, &sections, options));
        }
        let inner = |(index, &is_inner): (usize, &bool)| {
            let node = graph.skeleton.edges[index].nodes[0];
            let candidate = candidates.at_node[node.index()].filter(|_| is_inner)?;
            resolved[candidate].place
        };
        graph.parts.inner = candidates.is_inner.iter().enumerate().map(inner).collect();
        (graph.connections, graph.open_ends) = connect(&graph.skeleton, &sections, &resolved);
        Ok(graph)
    }

    /// A place.
    #[must_use]
    pub fn place(&self, place: PlaceNumber) -> &GridPlace {
        &self.places[place.index()]
    }

    /// Finds the gateways of a candidate, and adds it to the places if they make it one.
    fn resolve(
        &mut self,
        center: AxisPoint,
        start: f64,
        ways: Vec<Way>,
        sections: &[Section],
        options: &PlaceOptions,
    ) -> Resolved {
        let mut gateways = Vec::new();
        let mut positions = Vec::new();
        for way in &ways {
            let points = way.points(sections, &self.skeleton);
            let start = start * center.clearance;
            let (at, gateway) =
                gateway_on(&points, center.clearance, start, self.free.field(), &options.gateway);
            gateways.push(gateway);
            positions.push(at);
        }
        let star = LocalStar::new(center.point, &gateways, options);
        let place = star.and_then(|star| GridPlace::new(center, star));
        let Some(place) = place else { return Resolved { place: None, ways, olps: Vec::new() } };
        let number = PlaceNumber(self.places.len() as u32);
        for (way, at) in ways.iter().zip(positions) {
            self.parts.sections[way.section].claim(*way, number, at);
        }
        let olps = gateways.iter().filter_map(|gateway| place.star.olp_of(gateway)).collect::<Vec<Olp>>();
        self.places.push(place);
        Resolved { place: Some(number), ways, olps }
    }
}

impl GridPlace {
    /// The place with this star, unless it is a mere passage.
    fn new(center: AxisPoint, star: LocalStar) -> Option<Self> {
        let kind = star.kind();
        let place = GridPlace { kind, center: center.point, clearance: center.clearance, star };
        (kind != PlaceKind::Passage).then_some(place)
    }
}

impl PlaceGraphError {
    /// Why free space is empty.
    pub(crate) fn of(grid: &OccupancyGrid, field: &DistanceField, narrowest: f64) -> Self {
        let cells = grid.cells().len();
        if grid.count(Occupancy::Unknown) == cells {
            PlaceGraphError::AllUnknown { cells }
        } else if grid.count(Occupancy::Free) == 0 {
            PlaceGraphError::NothingFree { cells }
        } else if field.squared_cells(grid.lattice().cell(0)).is_none() {
            PlaceGraphError::NoObstacle
        } else {
            PlaceGraphError::TooNarrow { narrowest, resolution: grid.lattice().resolution() }
        }
    }
}
