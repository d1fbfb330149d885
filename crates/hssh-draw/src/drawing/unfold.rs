//! Another start for maps that fit no plane as a pose graph: places as far from each other as the travels
//! between them, which spreads a map out instead of folding it.

use hssh_metrics::Pose;
use nalgebra::Point2;

use super::spring::{Spring, misfit};
use crate::svg::{Point, toward};

/// Rounds of majorization.
const ROUNDS: usize = 80;

/// Poses at which the distances of places are close to the numbers of links between them (stress
/// majorization from `poses`), looking as their links want them to; mirrored if that fits the stars better.
pub(super) fn unfolded(poses: &[Pose], springs: &[Spring]) -> Vec<Pose> {
    let distances = link_distances(poses.len(), springs);
    let mut positions: Vec<Point> = poses.iter().map(|pose| pose.translation()).collect();
    for _ in 0..ROUNDS {
        positions =
            (0..positions.len()).map(|place| majorized(place, &positions, &distances[place])).collect();
    }
    let mirrored: Vec<Point> = positions.iter().map(|position| Point::new(-position.x, position.y)).collect();
    let (plain, mirrored) =
        (looking_along_links(&positions, springs), looking_along_links(&mirrored, springs));
    if misfit(&plain, springs) <= misfit(&mirrored, springs) { plain } else { mirrored }
}

/// By pair of places: the number of links between them; `None` if there is no way.
fn link_distances(places: usize, springs: &[Spring]) -> Vec<Vec<Option<u32>>> {
    let mut neighbours = vec![Vec::new(); places];
    for spring in springs {
        neighbours[spring.from].push(spring.to);
        neighbours[spring.to].push(spring.from);
    }
    let from = |start: usize| {
        let mut distances = vec![None; places];
        distances[start] = Some(0);
        let mut queue = std::collections::VecDeque::from([(start, 0)]);
        while let Some((place, distance)) = queue.pop_front() {
            for &next in &neighbours[place] {
                if distances[next].is_none() {
                    distances[next] = Some(distance + 1);
                    queue.push_back((next, distance + 1));
                }
            }
        }
        distances
    };
    (0..places).map(from).collect()
}

/// Where a place would be for all others to be at their distance, near ones counting more.
fn majorized(place: usize, positions: &[Point], distances: &[Option<u32>]) -> Point {
    let here = positions[place];
    let (mut sum, mut weights) = (Point::zeros(), 0.0);
    for (&there, distance) in positions.iter().zip(distances) {
        if let Some(distance) = distance.filter(|&distance| distance > 0).map(f64::from) {
            let gap = here - there;
            let weight = 1.0 / (distance * distance);
            sum += (there + gap * (distance / gap.norm().max(1e-6))) * weight;
            weights += weight;
        }
    }
    if weights > 0.0 { sum / weights } else { here }
}

/// These positions, each place turned so that its ends point along their links as well as they can.
fn looking_along_links(positions: &[Point], springs: &[Spring]) -> Vec<Pose> {
    let mut headings = vec![Point::zeros(); positions.len()];
    for spring in springs {
        let gap = positions[spring.to] - positions[spring.from];
        let bearing = gap.y.atan2(gap.x);
        headings[spring.from] += toward(bearing - spring.leaving);
        headings[spring.to] -= toward(bearing - spring.entering);
    }
    let positions = positions.iter().copied().map(Point2::from);
    positions.zip(headings).map(|(at, heading)| Pose::new(at.x, at.y, heading.y.atan2(heading.x))).collect()
}
