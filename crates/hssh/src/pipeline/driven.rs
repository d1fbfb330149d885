//! The ways of a log's map as the robot drove them.

use hssh_local::{
    DistanceField, Occupancy, Survey, driven_line, global_poses, least_clearance, visit_frames,
};
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

/// By which scans the robot came to the middle of each place visited, and by which it left it, so that straight from there to the
/// middle nothing is in the way: it need not have been there itself.
pub(super) struct Approaches(Vec<Approach>);

#[derive(Clone, Copy)]
struct Approach {
    came: usize,
    nearest: usize,
    left: usize,
}

impl Approaches {
    /// Straight lines to the middle keep off walls by that many metres, if any do.
    const CLEAR: f64 = 0.35;
    /// Scans are looked at that are farther from the middle than the nearest by no more than that, in metres.
    const FARTHER: f64 = 2.0;

    pub(super) fn new(survey: &Survey) -> Self {
        Approaches((0..survey.visits.len()).map(|visit| Self::to(survey, visit)).collect())
    }

    fn to(survey: &Survey, index: usize) -> Approach {
        let visit = &survey.visits[index];
        let center = [visit.frame.x, visit.frame.y];
        let is_wall = |cell: usize| visit.grid.cells()[cell] != Occupancy::Free;
        let field = DistanceField::new(*visit.grid.lattice(), is_wall);
        let at = |scan: usize| {
            let pose = survey.track.scans[scan].pose;
            [pose.x, pose.y]
        };
        let off = |scan: usize| length(&[center, at(scan)]);
        let clearance = |scan: usize| least_clearance(&[center, at(scan)], &field);
        let reach = off(visit.reference) + Self::FARTHER;
        // The first scan from which the way is clear, or else that from which it is clearest.
        let best = |scans: &mut dyn Iterator<Item = usize>| {
            let mut best = (visit.reference, f64::NEG_INFINITY);
            for scan in scans.take_while(|&scan| off(scan) <= reach) {
                let clearance = clearance(scan);
                if clearance > best.1 {
                    best = (scan, clearance);
                }
                if best.1 >= Self::CLEAR {
                    break;
                }
            }
            best.0
        };
        let reference = |index: Option<usize>| {
            let visit = index.and_then(|index| survey.visits.get(index)).unwrap_or(visit);
            visit.reference
        };
        Approach {
            came: best(&mut (reference(index.checked_sub(1))..=visit.reference).rev()),
            nearest: visit.reference,
            left: best(&mut (visit.reference..=reference(Some(index + 1)))),
        }
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
        let scans = if from.left <= to.came { from.left..=to.came } else { from.nearest..=to.nearest };
        let driven = self.scans.get(scans).unwrap_or_default();
        let poses = std::iter::once(&ends[0]).chain(driven).chain([&ends[1]]);
        let points: Vec<[f64; 2]> =
            poses.filter(|pose| pose.is_finite()).map(|pose| [pose.x, pose.y]).collect();
        driven_line(&points)
    }
}

/// How long a line is, in metres.
pub(super) fn length(line: &[[f64; 2]]) -> f64 {
    line.windows(2).map(|pair| (pair[0][0] - pair[1][0]).hypot(pair[0][1] - pair[1][1])).sum()
}
