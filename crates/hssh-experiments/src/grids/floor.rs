//! The regions, doors and connections of a real floor: as scanned, with furniture, against what is known of it.

use std::collections::BTreeSet;
use std::error::Error;
use std::path::Path;

use hssh_local::{
    DistanceField, Occupancy, Passage, RegionMap, RegionOptions, Roadmap, RoadmapOptions, read_map,
};

use super::bottleneck::bottleneck;
use super::doors::{self, Door};
use super::rooms::{Rooms, passages};
use super::segmentation::{self, Agreement};

/// Doors count that are no wider and no narrower than this, in metres, by the passage found at them.
const DOOR_WIDTHS: std::ops::RangeInclusive<f64> = 0.6..=1.15;

pub(super) fn report(folder: &Path) -> Result<String, Box<dyn Error>> {
    let grid = read_map(&folder.join("3.yaml"))?;
    let map = RegionMap::new(&grid, &RegionOptions::default())?;
    let roadmap = Roadmap::new(&grid, &map, &RoadmapOptions::default());
    let rooms = Rooms::read(folder)?;
    let lattice = *grid.lattice();
    let room_of = |point: [f64; 2]| {
        let [column, row] = lattice.continuous(point);
        rooms.at([column, f64::from(lattice.height()) - row])
    };
    let found: BTreeSet<(usize, usize)> = roadmap
        .connections
        .iter()
        .flat_map(|connection| passages(connection.line.iter().copied(), &lattice, room_of))
        .collect();
    let truth = rooms.connections(folder)?;
    let right = found.intersection(&truth).count();
    let percent = |part: usize, all: usize| 100.0 * part as f64 / all.max(1) as f64;
    let true_rooms = segmentation::Rooms {
        room_of: lattice
            .cells()
            .map(|cell| {
                let is_free = grid.get(cell) == Occupancy::Free;
                room_of(lattice.center(cell)).filter(|_| is_free).map(|room| room as u32)
            })
            .collect(),
        count: rooms.locations.len(),
    };
    let field = DistanceField::new(lattice, |index| grid.cells()[index] != Occupancy::Free);
    let closed = RegionOptions::default().narrowest;
    let missed: Vec<((usize, usize), f64)> = truth
        .difference(&found)
        .map(|&(a, b)| ((a, b), bottleneck(&field, &true_rooms.room_of, [a as u32, b as u32])))
        .collect();
    let open = truth.len() - missed.iter().filter(|&&(_, width)| width < closed).count();
    let missed = missed
        .iter()
        .map(|&((a, b), width)| format!("{}-{} {width:.2} m", rooms.locations[a], rooms.locations[b]));
    let [mcc, precision, recall, f1, regions] = Agreement::of(&map, &true_rooms).cells();
    let mut text = format!(
        "gdc3: regions: MCC {mcc}, precision {precision}, recall {recall}, F1 {f1}, {regions}\n\
         pairs of rooms that connections join: {}, right {right} ({:.0}%); of the {} true pairs found: {:.0}%; \
         of the {open} that the map shows to be connected by at least {closed} m: {:.0}%\n\
         missed, with the width of the widest way: {}\n",
        found.len(),
        percent(right, found.len()),
        truth.len(),
        percent(right, truth.len()),
        percent(right, open),
        missed.collect::<Vec<_>>().join(", "),
    );
    let doors = doors::read(folder)?;
    let wide = |door: &&Door| {
        let at = map.passages.iter().filter(|passage| door.is_at(&passage.gateway));
        at.map(|passage| passage.gateway.width)
            .reduce(f64::min)
            .is_none_or(|width| DOOR_WIDTHS.contains(&width))
    };
    let counted: Vec<&Door> = doors.iter().filter(wide).collect();
    for least in [0.3, 0.4, 0.5, 0.6] {
        let taken: Vec<&Passage> =
            map.passages.iter().filter(|passage| passage.door_probability >= least).collect();
        let at_door =
            taken.iter().filter(|passage| doors.iter().any(|door| door.is_at(&passage.gateway))).count();
        let hit =
            counted.iter().filter(|door| taken.iter().any(|passage| door.is_at(&passage.gateway))).count();
        let (precision, recall) = (percent(at_door, taken.len()), percent(hit, counted.len()));
        text += &format!(
            "doors with a probability of at least {least}: {}, {at_door} at a door ({precision:.0}%); of {} doors of \
             {:.1} to {:.2} m found {hit} ({recall:.0}%), F1 {:.2}\n",
            taken.len(),
            counted.len(),
            DOOR_WIDTHS.start(),
            DOOR_WIDTHS.end(),
            2.0 * precision * recall / (precision + recall).max(f64::MIN_POSITIVE) / 100.0
        );
    }
    Ok(text)
}
