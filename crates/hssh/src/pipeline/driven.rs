//! The ways of a log's map as the robot drove them.

use hssh_local::{Occupancy, OccupancyGrid, Survey, driven_line, global_poses, visit_frames};
use hssh_metrics::{Pose, PoseGraph};
use hssh_topology::Position;

/// Where every scan was taken, in the frame of the first place of a map that has the visits at `positions`. `None` if the map has them
/// elsewhere than the survey and its places are not placed.
pub(super) fn scan_poses(
    survey: &Survey,
    positions: &[Position],
    places: Option<&PoseGraph>,
) -> Option<Vec<Pose>> {
    if survey.agrees_with(positions) {
        let first = survey.visits[0].frame;
        return Some(survey.track.scans.iter().map(|scan| first.between(scan.pose)).collect());
    }
    let mut frames = visit_frames(&survey.visits, positions, places?.poses());
    // Beyond the travels explained, the track goes on.
    for travel in &survey.travels[frames.len() - 1..] {
        frames.push(frames[frames.len() - 1].compose(travel.mean));
    }
    Some(global_poses(survey, &frames))
}

/// From which scan of each visit ways lead straight to the middle of the place, so that nothing stands between: the robot need not have
/// been there itself.
pub(super) struct Approaches(Vec<Approach>);

#[derive(Clone, Copy)]
struct Approach {
    scan: usize,
    nearest: usize,
}

impl Approaches {
    /// Straight lines to the middle keep off walls by that many metres, if any do.
    const CLEAR: f64 = 0.35;
    /// Scans are looked at that are farther from the middle than the nearest by no more than that, in metres.
    const FARTHER: f64 = 2.0;

    pub(super) fn new(survey: &Survey) -> Self {
        Approaches((0..survey.visits.len()).map(|visit| Self::to(survey, visit)).collect())
    }

    /// The scan next to the nearest one from which the way is clear, or else that from which it is clearest.
    fn to(survey: &Survey, index: usize) -> Approach {
        let visit = &survey.visits[index];
        let nearest = visit.reference;
        let center = [visit.frame.x, visit.frame.y];
        let at = |scan: usize| {
            let pose = survey.track.scans[scan].pose;
            [pose.x, pose.y]
        };
        let off = |scan: usize| length(&[center, at(scan)]);
        let is_near = |scan: &usize| off(*scan) <= off(nearest) + Self::FARTHER;
        let other = |index: Option<usize>| {
            index.and_then(|index| survey.visits.get(index)).map_or(nearest, |visit| visit.reference)
        };
        let before = (other(index.checked_sub(1))..nearest).rev().take_while(is_near);
        let behind = (nearest..=other(Some(index + 1))).take_while(is_near);
        let mut scans: Vec<usize> = before.chain(behind).collect();
        scans.sort_by_key(|scan| scan.abs_diff(nearest));
        let mut best = (nearest, f64::NEG_INFINITY);
        for scan in scans {
            let room = room_along(center, at(scan), &visit.grid, Self::CLEAR);
            if room > best.1 {
                best = (scan, room);
            }
            if room >= Self::CLEAR {
                break;
            }
        }
        Approach { scan: best.0, nearest }
    }
}

/// The travels of a log in the frame of a map's first place.
pub(super) struct Drives<'a> {
    approaches: &'a Approaches,
    positions: &'a [Position],
    places: &'a [Pose],
    scans: Vec<Pose>,
}

impl<'a> Drives<'a> {
    pub(super) fn new(
        survey: &Survey,
        approaches: &'a Approaches,
        positions: &'a [Position],
        places: &'a PoseGraph,
    ) -> Option<Self> {
        let scans = scan_poses(survey, positions, Some(places))?;
        Some(Drives { approaches, positions, places: places.poses(), scans })
    }

    /// The line of the travel from a visit to the next one, from place to place.
    pub(super) fn line(&self, visit: usize) -> Vec<[f64; 2]> {
        let place = |visit: usize| self.places[self.positions[visit].place.index()];
        let [from, to] = [visit, visit + 1].map(|visit| self.approaches.0[visit]);
        let ends = [place(visit), place(visit + 1)];
        // Between places near to one another there is no room for approaches.
        let scans = if from.scan <= to.scan { from.scan..=to.scan } else { from.nearest..=to.nearest };
        let driven = self.scans.get(scans).unwrap_or_default();
        let poses = std::iter::once(&ends[0]).chain(driven).chain([&ends[1]]);
        let points: Vec<[f64; 2]> =
            poses.filter(|pose| pose.is_finite()).map(|pose| [pose.x, pose.y]).collect();
        driven_line(&points)
    }
}

/// How far a straight line is from all that is not free, in metres, where it is nearest; no more than `most`, and 0 beyond the grid.
fn room_along(from: [f64; 2], to: [f64; 2], grid: &OccupancyGrid, most: f64) -> f64 {
    let steps = (length(&[from, to]) / grid.lattice().resolution()).ceil().max(1.0);
    let at = |step: u32| {
        let part = f64::from(step) / steps;
        [0, 1].map(|axis| from[axis] + part * (to[axis] - from[axis]))
    };
    (0..=steps as u32).map(|step| room_at(at(step), grid, most)).fold(most, f64::min)
}

fn room_at(point: [f64; 2], grid: &OccupancyGrid, most: f64) -> f64 {
    let lattice = grid.lattice();
    let Some(cell) = lattice.cell_at(point) else { return 0.0 };
    let reach = (most / lattice.resolution()).ceil() as i32;
    let around = (-reach..=reach).flat_map(|rows| (-reach..=reach).map(move |columns| (columns, rows)));
    let near = around.filter_map(|(columns, rows)| lattice.step(cell, columns, rows));
    let walls = near.filter(|&cell| grid.get(cell) != Occupancy::Free);
    let half = lattice.resolution() / 2.0;
    walls.map(|cell| (length(&[point, lattice.center(cell)]) - half).max(0.0)).fold(most, f64::min)
}

/// How long a line is, in metres.
pub(super) fn length(line: &[[f64; 2]]) -> f64 {
    line.windows(2).map(|pair| (pair[0][0] - pair[1][0]).hypot(pair[0][1] - pair[1][1])).sum()
}
