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
}

/// The nodes and ways of one region, by their numbers in the roadmap.
#[derive(Default)]
pub(super) struct RegionPart {
    pub(super) passages: Vec<(u32, RoadNodeNumber)>,
    pub(super) places: Vec<PlaceNumber>,
    pub(super) ways: Vec<usize>,
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

/// Adds the network of a region to the roadmap.
pub(super) fn add_region(
    roadmap: &mut Roadmap,
    ground: &Ground<'_>,
    region: RegionNumber,
    bounds: Bounds,
    options: &RoadmapOptions,
) -> RegionPart {
    let Ground { map, field, exits, passages } = *ground;
    let own: Vec<(u32, Cell, RoadNodeNumber)> = map
        .passages_of(region)
        .filter_map(|passage| Some((passage, exits[passage as usize]?, passages[passage as usize]?)))
        .collect();
    let doors: Vec<Cell> = own.iter().map(|&(_, cell, _)| cell).collect();
    let window = Window::new(map, region, bounds, field, &doors, options);
    let mut terminals: Vec<usize> = doors.iter().map(|&cell| window.position(cell)).collect();
    let Some(middle) = window.middle(options.comfort) else { return RegionPart::default() };
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
            if junctions.is_empty() { vec![doors.len()] } else { junctions }
        }
        _ => vec![doors.len()],
    };
    let mut part = RegionPart::default();
    let mut nodes: BTreeMap<usize, RoadNodeNumber> = BTreeMap::new();
    for (number, &(passage, _, node)) in own.iter().enumerate() {
        nodes.insert(number, node);
        part.passages.push((passage, node));
    }
    for spot in spots {
        // A junction in a passage is the place of the region all the same.
        let at = window.cell(network.nodes[spot]);
        let number = PlaceNumber(roadmap.places.len() as u32);
        let center = map.lattice().center(at);
        let node = match nodes.get(&spot) {
            Some(&node) => node,
            None => roadmap.add(RoadNode { kind: RoadNodeKind::Place(number), region, position: center }),
        };
        nodes.insert(spot, node);
        roadmap.places.push(RegionPlace { region, node, center, clearance: field.clearance(at), star: None });
        part.places.push(number);
    }
    add_ways(roadmap, &mut part, &network, &window, &mut nodes, (map, field, region), options);
    part
}

/// Adds the ways of a region, and the branches where they part.
fn add_ways(
    roadmap: &mut Roadmap,
    part: &mut RegionPart,
    network: &Network,
    window: &Window,
    nodes: &mut BTreeMap<usize, RoadNodeNumber>,
    (map, field, region): (&RegionMap, &DistanceField, RegionNumber),
    options: &RoadmapOptions,
) {
    let lattice = map.lattice();
    for Stretch { ends, path, .. } in &network.ways {
        let cells: Vec<[f64; 2]> =
            path.iter().map(|&position| lattice.center(window.cell(position))).collect();
        let line = straightened(&cells, options.straighten, options.radius, field);
        let clearance = least_clearance(&line, field);
        if clearance < options.radius {
            continue;
        }
        let ends = ends.map(|end| {
            *nodes.entry(end).or_insert_with(|| {
                let position = lattice.center(window.cell(network.nodes[end]));
                roadmap.add(RoadNode { kind: RoadNodeKind::Branch, region, position })
            })
        });
        let length = line.windows(2).map(|pair| crate::skeleton::distance(pair[0], pair[1])).sum();
        part.ways.push(roadmap.ways.len());
        roadmap.ways.push(Way { ends, region, line, length, width: 2.0 * clearance });
    }
}
