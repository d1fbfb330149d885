//! The part of a roadmap in one region.

use std::collections::BTreeMap;

use super::graph::{RegionPlace, RoadNode, RoadNodeKind, RoadNodeNumber, Roadmap, Way};
use super::line::{least_clearance, straightened};
use super::links::links;
use super::network::{Network, Pruning, Stretch, network};
use super::options::RoadmapOptions;
use super::window::{Bounds, Window};
use crate::distance::DistanceField;
use crate::grid::Cell;
use crate::place::PlaceNumber;
use crate::region::{RegionKind, RegionMap, RegionNumber};

/// What all regions share.
pub(super) struct Ground<'a> {
    pub(super) map: &'a RegionMap,
    pub(super) field: &'a DistanceField,
    /// For each passage the cell where a robot passes it, if it fits through.
    pub(super) exits: &'a [Option<Cell>],
    /// For each passage its node.
    pub(super) passages: &'a [Option<RoadNodeNumber>],
    /// How many nodes those are.
    pub(super) passage_nodes: u32,
}

/// The nodes and ways of one region, by their numbers in the roadmap.
pub(super) struct RegionPart {
    pub(super) passages: Vec<(u32, RoadNodeNumber)>,
    pub(super) places: Vec<PlaceNumber>,
    pub(super) ways: Vec<usize>,
}

/// What a region adds to the roadmap. Its places and ways are counted from 0, and its nodes as if they were the first after those
/// of passages.
#[derive(Default)]
pub(super) struct RegionRoads {
    passages: Vec<(u32, RoadNodeNumber)>,
    nodes: Vec<RoadNode>,
    places: Vec<RegionPlace>,
    ways: Vec<Way>,
}

/// Where a robot passes each passage: the widest cell on the line across, if it fits through.
pub(super) fn exits(map: &RegionMap, field: &DistanceField, options: &RoadmapOptions) -> Vec<Option<Cell>> {
    let lattice = map.lattice();
    let exit = |line: [[f64; 2]; 2]| {
        let [a, b] = line.map(|end| lattice.cell_at(end));
        let cells = lattice.line(a?, b?).filter(|&cell| field.clearance(cell) >= options.radius);
        cells.max_by(|&a, &b| field.clearance(a).total_cmp(&field.clearance(b)).then(b.cmp(&a)))
    };
    map.passages.iter().map(|passage| exit(passage.gateway.line)).collect()
}

impl RegionRoads {
    /// The ways through a region.
    pub(super) fn new(
        ground: &Ground<'_>,
        region: RegionNumber,
        bounds: Bounds,
        options: &RoadmapOptions,
    ) -> Self {
        let Ground { map, field, exits, passages, .. } = *ground;
        let doors: Vec<Cell> =
            map.passages_of(region).filter_map(|passage| exits[passage as usize]).collect();
        let window = Window::new(map, region, bounds, field, &doors, options);
        let own: Vec<(u32, RoadNodeNumber, usize)> = map
            .passages_of(region)
            .filter_map(|passage| {
                let position = window.position(exits[passage as usize]?)?;
                Some((passage, passages[passage as usize]?, position))
            })
            .collect();
        let Some(middle) = window.middle(options.comfort) else { return RegionRoads::default() };
        let mut terminals: Vec<usize> = own.iter().map(|&(_, _, position)| position).collect();
        terminals.push(middle);
        let cell = map.lattice().resolution();
        let about = map.region(region);
        let fixed = terminals.len();
        let arm = options.arm * about.width / cell;
        if about.kind == RegionKind::Corridor {
            let least = (options.middle * about.width / 2.0) as f32;
            terminals.extend(window.waypoints(&terminals, arm as usize, least));
        }
        let links = links(&window, &terminals, options.detour);
        let pruning = Pruning { fixed, shortest: 2.0 * options.radius / cell, arm };
        let network = network(&window, &terminals, &links, pruning);
        let spots = match about.kind {
            RegionKind::Doorway if own.len() > 1 => Vec::new(),
            RegionKind::Corridor => {
                let junctions = network.junctions(arm);
                if junctions.is_empty() { vec![own.len()] } else { junctions }
            }
            _ => vec![own.len()],
        };
        let mut roads = RegionRoads::default();
        let mut nodes: BTreeMap<usize, RoadNodeNumber> = BTreeMap::new();
        for (number, &(passage, node, _)) in own.iter().enumerate() {
            nodes.insert(number, node);
            roads.passages.push((passage, node));
        }
        let mut drawing = Drawing { roads, nodes, ground, region };
        for spot in spots {
            drawing.add_place(spot, window.cell(network.nodes[spot]));
        }
        drawing.add_ways(&network, &window, options);
        drawing.roads
    }

    /// Adds it to a roadmap that has the nodes of the passages already, of which there are so many.
    pub(super) fn add_to(self, roadmap: &mut Roadmap, passages: u32) -> RegionPart {
        let (nodes, places) = (roadmap.nodes.len() as u32 - passages, roadmap.places.len() as u32);
        let node = |RoadNodeNumber(node)| RoadNodeNumber(if node < passages { node } else { node + nodes });
        let place = |PlaceNumber(number)| PlaceNumber(number + places);
        roadmap.nodes.extend(self.nodes.into_iter().map(|node| match node.kind {
            RoadNodeKind::Place(number) => RoadNode { kind: RoadNodeKind::Place(place(number)), ..node },
            RoadNodeKind::Passage(_) | RoadNodeKind::Branch => node,
        }));
        let own_places = (0..self.places.len() as u32).map(|number| place(PlaceNumber(number))).collect();
        let own_ways = (roadmap.ways.len()..roadmap.ways.len() + self.ways.len()).collect();
        roadmap.places.extend(self.places.into_iter().map(|own| RegionPlace { node: node(own.node), ..own }));
        roadmap.ways.extend(self.ways.into_iter().map(|way| Way { ends: way.ends.map(node), ..way }));
        RegionPart { passages: self.passages, places: own_places, ways: own_ways }
    }
}

/// The ways of a region as they are drawn.
struct Drawing<'a> {
    roads: RegionRoads,
    /// For the nodes of its network, by their numbers there, those of the roadmap.
    nodes: BTreeMap<usize, RoadNodeNumber>,
    ground: &'a Ground<'a>,
    region: RegionNumber,
}

impl Drawing<'_> {
    /// Adds a place at a node of the network.
    fn add_place(&mut self, spot: usize, at: Cell) {
        let number = PlaceNumber(self.roads.places.len() as u32);
        let (region, center) = (self.region, self.ground.map.lattice().center(at));
        // A junction in a passage is the place of the region all the same.
        let node = self.node(spot, RoadNode { kind: RoadNodeKind::Place(number), region, position: center });
        let clearance = self.ground.field.clearance(at);
        self.roads.places.push(RegionPlace { region, node, center, clearance, star: None });
    }

    /// The node of the roadmap that stands for one of the network, with what it is if there is none yet.
    fn node(&mut self, spot: usize, new: RoadNode) -> RoadNodeNumber {
        let after = self.ground.passage_nodes + self.roads.nodes.len() as u32;
        *self.nodes.entry(spot).or_insert_with(|| {
            self.roads.nodes.push(new);
            RoadNodeNumber(after)
        })
    }

    /// Adds the ways of the network, and the branches where they part.
    fn add_ways(&mut self, network: &Network, window: &Window<'_>, options: &RoadmapOptions) {
        let lattice = self.ground.map.lattice();
        let region = self.region;
        let center = |position: usize| lattice.center(window.cell(position));
        for Stretch { ends, path, .. } in &network.ways {
            let cells: Vec<[f64; 2]> = path.iter().map(|&position| center(position)).collect();
            let line = straightened(&cells, options.straighten, options.radius, self.ground.field);
            let clearance = least_clearance(&line, self.ground.field);
            if clearance < options.radius {
                continue;
            }
            let ends = ends.map(|end| {
                let position = center(network.nodes[end]);
                self.node(end, RoadNode { kind: RoadNodeKind::Branch, region, position })
            });
            let length = line.windows(2).map(|pair| crate::skeleton::distance(pair[0], pair[1])).sum();
            self.roads.ways.push(Way { ends, region, line, length, width: 2.0 * clearance });
        }
    }
}
