//! Simulated tours of floor plans whose rooms are known: whether a room entered is a room of the map.

use std::collections::BTreeMap;
use std::error::Error;
use std::path::Path;
use std::time::Instant;

use hssh::answer::Answer;
use hssh::pipeline::{Input, MappingOptions, map};
use hssh_local::{OccupancyGrid, RegionMap, RegionOptions, Roadmap, RoadmapOptions, read_floor_plan};
use hssh_world::robot::{RobotOptions, Tour, round_trip};

use crate::grids::{RESOLUTION, Rooms, plan_names, plan_truth};
use crate::table::aligned;

/// A room or region counts that the robot was in for so many scans: on the threshold it is in either.
const LEAST_SCANS: usize = 10;

/// What came of one tour.
struct Toured {
    name: String,
    metres: f64,
    /// True rooms that the robot was in, and regions that the answer says it was in.
    rooms: usize,
    regions: usize,
    /// Scans in rooms, and those of them at which the answer names the region that stands for the room.
    scans: usize,
    right: usize,
    visits: [usize; 2],
    seconds: f64,
}

/// Leads a robot through every room of each plan, maps its log, and compares in which regions it was with the rooms.
pub(super) fn report(folder: &Path) -> Result<String, Box<dyn Error>> {
    let mut rows = vec![
        [
            "plan",
            "m",
            "rooms entered",
            "regions entered",
            "scans in the right one",
            "visits in a region",
            "s",
        ]
        .map(str::to_owned)
        .to_vec(),
    ];
    for name in plan_names(folder)? {
        let grid = read_floor_plan(&folder.join(format!("{name}.png")), RESOLUTION)?;
        let Toured { name, metres, rooms, regions, scans, right, visits, seconds } =
            toured(name.clone(), &grid, &plan_truth(folder, &name)?)?;
        rows.push(vec![
            name,
            format!("{metres:.0}"),
            rooms.to_string(),
            regions.to_string(),
            format!("{right} of {scans} ({:.1}%)", 100.0 * right as f64 / scans.max(1) as f64),
            format!("{} of {}", visits[0], visits[1]),
            format!("{seconds:.1}"),
        ]);
    }
    Ok(format!(
        "tours of floor plans: where the robot was, by the building that its log shows\n{}",
        aligned(&rows)
    ))
}

fn toured(name: String, grid: &OccupancyGrid, rooms: &Rooms) -> Result<Toured, Box<dyn Error>> {
    let regions = RegionMap::new(grid, &RegionOptions::default())?;
    let roadmap = Roadmap::new(grid, &regions, &RoadmapOptions::default());
    let line = round_trip(&roadmap);
    let tour = Tour::along(&line, grid, &RobotOptions::default(), 1);
    let started = Instant::now();
    let options = MappingOptions::default();
    let input = Input::from_log(name.as_str(), tour.to_carmen().as_bytes(), &options)?;
    let answer = map(&input, &options, &Default::default())?.answer;
    let seconds = started.elapsed().as_secs_f64();
    let mut shared: BTreeMap<(u32, u32), usize> = BTreeMap::new();
    let (mut in_room, mut in_region) = (BTreeMap::new(), BTreeMap::new());
    for (scan, moment) in (0..).zip(&tour.moments) {
        let cell = grid.lattice().cell_at([moment.pose.x, moment.pose.y]);
        let room = cell.and_then(|cell| rooms.room_of[grid.lattice().index(cell)]);
        let region = region_at(&answer, scan);
        if let Some(room) = room {
            *in_room.entry(room).or_insert(0) += 1;
            if let Some(region) = region {
                *shared.entry((room, region)).or_insert(0) += 1;
            }
        }
        if let Some(region) = region {
            *in_region.entry(region).or_insert(0) += 1;
        }
    }
    let entered =
        |counts: &BTreeMap<u32, usize>| counts.values().filter(|&&scans| scans >= LEAST_SCANS).count();
    let metres = line.windows(2).map(|pair| (pair[1][0] - pair[0][0]).hypot(pair[1][1] - pair[0][1])).sum();
    Ok(Toured {
        name,
        metres,
        rooms: entered(&in_room),
        regions: entered(&in_region),
        scans: in_room.values().sum(),
        right: paired(&shared),
        visits: [answer.visits.iter().filter(|visit| visit.region.is_some()).count(), answer.visits.len()],
        seconds,
    })
}

/// The region that an answer has the robot in at a scan.
fn region_at(answer: &Answer, scan: u64) -> Option<u32> {
    let stays = &answer.building.as_ref()?.stays;
    stays.iter().find(|stay| (stay.scans[0]..=stay.scans[1]).contains(&scan)).map(|stay| stay.region)
}

/// Scans of pairs of a room and a region, one to one, those first that share most.
fn paired(shared: &BTreeMap<(u32, u32), usize>) -> usize {
    let mut candidates: Vec<(usize, u32, u32)> =
        shared.iter().map(|(&(room, region), &scans)| (scans, room, region)).collect();
    candidates.sort_by(|a, b| b.0.cmp(&a.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    let (mut rooms, mut regions, mut right) = (Vec::new(), Vec::new(), 0);
    for (scans, room, region) in candidates {
        if !rooms.contains(&room) && !regions.contains(&region) {
            rooms.push(room);
            regions.push(region);
            right += scans;
        }
    }
    right
}
