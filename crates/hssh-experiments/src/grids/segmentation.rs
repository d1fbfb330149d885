//! How well regions agree with the true rooms of a floor plan.

use hssh_local::{Occupancy, OccupancyGrid, RegionMap};

/// Rooms smaller than this many square metres are slips of the pen.
const LEAST_ROOM: f64 = 1.0;

/// The true rooms of a plan.
pub(crate) struct Rooms {
    /// For each cell in row-major order its room.
    pub(crate) room_of: Vec<Option<u32>>,
    pub(super) count: usize,
}

/// The agreement of regions with rooms; only cells of true rooms count.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Agreement {
    /// Matthews' correlation coefficient of each room and the region that stands for it, averaged over the rooms. Pairs
    /// are made one to one, those with most cells in common first; a room that is left over counts 0.
    pub(super) mcc: f64,
    /// The largest part of each region that is in one room, averaged over the regions (Bormann et al., 2016).
    pub(super) precision: f64,
    /// The largest part of each room that is in one region, averaged over the rooms (Bormann et al., 2016).
    pub(super) recall: f64,
    /// F1 of rooms and regions of which the intersection is at least half of the union.
    pub(super) f1: f64,
    /// Regions of at least a square metre within true rooms.
    pub(super) regions: usize,
    /// True rooms.
    pub(super) rooms: usize,
}

impl Rooms {
    /// The connected groups of free cells, by sides.
    pub(super) fn of(grid: &OccupancyGrid) -> Self {
        let lattice = *grid.lattice();
        let mut room_of = vec![None; lattice.len()];
        let mut is_seen = vec![false; lattice.len()];
        let least = (LEAST_ROOM / lattice.resolution().powi(2)) as usize;
        let mut count = 0;
        for start in lattice.cells() {
            if grid.get(start) != Occupancy::Free || is_seen[lattice.index(start)] {
                continue;
            }
            is_seen[lattice.index(start)] = true;
            let mut room = vec![start];
            let mut at = 0;
            while at < room.len() {
                for near in lattice.side_neighbors(room[at]) {
                    let index = lattice.index(near);
                    if grid.get(near) == Occupancy::Free && !std::mem::replace(&mut is_seen[index], true) {
                        room.push(near);
                    }
                }
                at += 1;
            }
            if room.len() >= least {
                room.iter().for_each(|&cell| room_of[lattice.index(cell)] = Some(count as u32));
                count += 1;
            }
        }
        Rooms { room_of, count }
    }

    /// How many cells each room has.
    pub(super) fn areas(&self) -> impl Iterator<Item = usize> {
        let mut cells = vec![0; self.count];
        self.room_of.iter().flatten().for_each(|&room| cells[room as usize] += 1);
        cells.into_iter()
    }
}

impl Agreement {
    /// Scores the regions of a map against the rooms of the same plan.
    pub(super) fn of(map: &RegionMap, rooms: &Rooms) -> Self {
        let shared = shared(map, rooms);
        let of_room: Vec<f64> =
            (0..rooms.count).map(|room| shared.iter().map(|row| row[room]).sum()).collect();
        // The last row is what is in no region.
        let regions = &shared[..map.regions.len()];
        let of_region: Vec<f64> = regions.iter().map(|row| row.iter().sum()).collect();
        let all: f64 = of_room.iter().sum();
        let mcc = |room: usize, region: usize| {
            let hit = regions[region][room];
            let (extra, missing) = (of_region[region] - hit, of_room[room] - hit);
            let rest = all - hit - extra - missing;
            let norm = (hit + extra) * (hit + missing) * (rest + extra) * (rest + missing);
            if norm > 0.0 { (hit * rest - extra * missing) / norm.sqrt() } else { 0.0 }
        };
        let paired: f64 = pairs(regions).into_iter().map(|(region, room)| mcc(room, region)).sum();
        let least = LEAST_ROOM / map.lattice().resolution().powi(2);
        let large: Vec<usize> = (0..regions.len()).filter(|&region| of_region[region] >= least).collect();
        let most = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
        let precision = |&region: &usize| most(&mut regions[region].iter().copied()) / of_region[region];
        let recall = |room: usize| most(&mut regions.iter().map(|row| row[room])) / of_room[room];
        let is_found = |&room: &usize| {
            (0..regions.len()).any(|region| {
                let hit = regions[region][room];
                hit > 0.0 && 2.0 * hit >= of_region[region] + of_room[room] - hit
            })
        };
        let found = (0..rooms.count).filter(is_found).count();
        Agreement {
            mcc: paired / rooms.count as f64,
            precision: large.iter().map(precision).sum::<f64>() / large.len().max(1) as f64,
            recall: (0..rooms.count).map(recall).sum::<f64>() / rooms.count as f64,
            f1: 2.0 * found as f64 / (large.len() + rooms.count) as f64,
            regions: large.len(),
            rooms: rooms.count,
        }
    }

    /// The means of several plans.
    pub(super) fn mean(all: &[Agreement]) -> Self {
        let mean = |value: fn(&Agreement) -> f64| all.iter().map(value).sum::<f64>() / all.len() as f64;
        Agreement {
            mcc: mean(|one| one.mcc),
            precision: mean(|one| one.precision),
            recall: mean(|one| one.recall),
            f1: mean(|one| one.f1),
            regions: all.iter().map(|one| one.regions).sum(),
            rooms: all.iter().map(|one| one.rooms).sum(),
        }
    }

    /// The numbers as cells of a table.
    pub(super) fn cells(&self) -> [String; 5] {
        let [mcc, precision, recall, f1] =
            [self.mcc, self.precision, self.recall, self.f1].map(|value| format!("{value:.3}"));
        [mcc, precision, recall, f1, format!("{} of {}", self.regions, self.rooms)]
    }
}

/// How many cells each region shares with each room; the last row is of the cells in no region.
fn shared(map: &RegionMap, rooms: &Rooms) -> Vec<Vec<f64>> {
    let mut shared = vec![vec![0.0; rooms.count]; map.regions.len() + 1];
    for (cell, room) in map.lattice().cells().zip(&rooms.room_of) {
        if let Some(room) = room {
            let region = map.region_of(cell).map_or(map.regions.len(), |region| region.index());
            shared[region][*room as usize] += 1.0;
        }
    }
    shared
}

/// Regions and rooms, one to one, those first that share most.
fn pairs(regions: &[Vec<f64>]) -> Vec<(usize, usize)> {
    let mut candidates: Vec<(f64, usize, usize)> = Vec::new();
    for (region, row) in regions.iter().enumerate() {
        candidates.extend(
            row.iter()
                .enumerate()
                .filter(|(_, cells)| **cells > 0.0)
                .map(|(room, &cells)| (cells, region, room)),
        );
    }
    candidates.sort_by(|a, b| b.0.total_cmp(&a.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    let (mut pairs, mut has_room, mut has_region) = (Vec::new(), Vec::new(), Vec::new());
    for (_, region, room) in candidates {
        if !has_region.contains(&region) && !has_room.contains(&room) {
            has_region.push(region);
            has_room.push(room);
            pairs.push((region, room));
        }
    }
    pairs
}
