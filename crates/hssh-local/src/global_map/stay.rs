//! Which regions of a building the robot was in, one after the other (section 2.1.3).

use hssh_metrics::Pose;

use crate::region::{RegionMap, RegionNumber};

/// A stretch of the robot's way within one region.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Stay {
    /// The region.
    pub region: RegionNumber,
    /// The first and the last scan taken in it.
    pub scans: (usize, usize),
}

/// How far into a region the robot goes, at least, that has been there; in metres.
const WITHIN: f64 = 0.5;

/// The robot's way, scan by scan, as it leads through the regions of a map. Scans in no region belong to the stay before,
/// and so does a look into a region from its threshold.
#[must_use]
pub fn stays(map: &RegionMap, poses: &[Pose]) -> Vec<Stay> {
    let mut stays: Vec<Stay> = Vec::new();
    for (scan, pose) in poses.iter().enumerate() {
        match (map.region_at([pose.x, pose.y]), stays.last_mut()) {
            (Some(region), Some(stay)) if region == stay.region => stay.scans.1 = scan,
            (Some(region), _) => stays.push(Stay { region, scans: (scan, scan) }),
            (None, Some(stay)) => stay.scans.1 = scan,
            (None, None) => {}
        }
    }
    let is_look = |stay: &Stay| {
        let (first, last) = stay.scans;
        let away = |pose: &Pose| (pose.translation() - poses[first].translation()).norm();
        poses[first..=last].iter().all(|pose| away(pose) < WITHIN)
    };
    let mut kept: Vec<Stay> = Vec::new();
    for (at, stay) in stays.iter().enumerate() {
        let is_passed_over = is_look(stay)
            && kept
                .last()
                .is_some_and(|before| stays.get(at + 1).is_some_and(|after| after.region == before.region));
        match kept.last_mut() {
            Some(before) if is_passed_over || before.region == stay.region => before.scans.1 = stay.scans.1,
            _ => kept.push(*stay),
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::grid::{Cell, Lattice, Occupancy, OccupancyGrid};
    use crate::region::RegionOptions;

    /// Two rooms of 4 m with a door between them.
    fn rooms() -> RegionMap {
        let lattice = Lattice::new(90, 50, 0.1, [0.0, 0.0]).unwrap();
        let mut grid = OccupancyGrid::filled(lattice, Occupancy::Occupied);
        for cell in lattice.cells() {
            let Cell { column, row } = cell;
            let is_room = (2..43).contains(&column) || (45..88).contains(&column);
            let is_door = (20..29).contains(&row);
            if (2..48).contains(&row) && (is_room || is_door) && (2..88).contains(&column) {
                grid.set(cell, Occupancy::Free);
            }
        }
        RegionMap::new(&grid, &RegionOptions::default()).unwrap()
    }

    #[test]
    fn a_look_from_the_threshold_is_no_stay() {
        let map = rooms();
        assert_eq!(map.regions.len(), 2);
        let way = |xs: &[f64]| -> Vec<Pose> { xs.iter().map(|&x| Pose::new(x, 2.5, 0.0)).collect() };
        let told = |xs: &[f64]| -> Vec<(usize, usize)> {
            stays(&map, &way(xs)).into_iter().map(|stay| stay.scans).collect()
        };
        assert_eq!(told(&[2.0, 3.0, 4.0, 5.5, 7.0]), [(0, 2), (3, 4)]);
        assert_eq!(told(&[2.0, 3.0, 4.0, 4.7, 4.0, 2.0]), [(0, 5)], "a look");
        assert_eq!(told(&[2.0, 3.0, 4.0, 4.7, 6.0, 4.0, 2.0]), [(0, 2), (3, 4), (5, 6)], "a visit");
        assert_eq!(told(&[4.7, 4.0, 2.0]), [(0, 0), (1, 2)], "it began there");
        let [left, right] = [2.0, 7.0].map(|x| map.region_at([x, 2.5]).unwrap());
        let regions: Vec<RegionNumber> =
            stays(&map, &way(&[2.0, 7.0])).iter().map(|stay| stay.region).collect();
        assert_eq!(regions, [left, right]);
    }
}
