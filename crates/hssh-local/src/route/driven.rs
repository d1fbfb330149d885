//! The line that a drive leaves on the floor, for others to drive by: without detours, and with no more corners than it needs.

use rustc_hash::FxHashMap;

/// Two points of a drive that are no farther apart, in metres, are joined: what lies between is a detour. No wall is between them, for
/// the robot is wider than that.
const JOINED: f64 = 0.3;
/// The line is nowhere farther from the way as driven, in metres, once detours are left out.
const OFF: f64 = 0.05;

/// A line from the first to the last of the points that a robot drove by, one after the other: all its corners are among these points,
/// it is nowhere farther than 5 cm from the drive or a gap of 30 cm in it, and where the drive comes back to within 30 cm of itself it goes straight on.
#[must_use]
pub fn driven_line(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    thinned(&without_detours(points))
}

/// From each point straight to the last one of the drive that is near.
fn without_detours(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let cell = |point: [f64; 2]| point.map(|coordinate| (coordinate / JOINED).floor() as i64);
    let mut in_cell: FxHashMap<[i64; 2], Vec<usize>> = FxHashMap::default();
    for (index, &point) in points.iter().enumerate() {
        in_cell.entry(cell(point)).or_default().push(index);
    }
    let last_near = |from: usize| {
        let [column, row] = cell(points[from]);
        let around = (-1..=1).flat_map(|up| (-1..=1).map(move |right| [column + right, row + up]));
        let last_of = |cell: [i64; 2]| {
            let indices = in_cell.get(&cell)?.iter().rev().copied();
            indices
                .take_while(|&index| index > from)
                .find(|&index| distance(points[from], points[index]) <= JOINED)
        };
        around.filter_map(last_of).max()
    };
    let mut line: Vec<[f64; 2]> = points.first().copied().into_iter().collect();
    let mut at = 0;
    while at + 1 < points.len() {
        at = last_near(at).unwrap_or(at + 1);
        line.push(points[at]);
    }
    line
}

/// The corners that the line needs (Douglas and Peucker's algorithm, with distances to the straight part and not to the line beyond it).
fn thinned(line: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut is_kept = vec![false; line.len()];
    let Some(last) = line.len().checked_sub(1) else { return Vec::new() };
    (is_kept[0], is_kept[last]) = (true, true);
    let mut open = vec![(0, last)];
    while let Some((first, last)) = open.pop() {
        let off = |&index: &usize| distance_to(line[index], line[first], line[last]);
        let farthest = (first + 1..last).max_by(|a, b| off(a).total_cmp(&off(b)));
        if let Some(corner) = farthest.filter(|corner| off(corner) > OFF) {
            is_kept[corner] = true;
            open.extend([(first, corner), (corner, last)]);
        }
    }
    line.iter().zip(is_kept).filter(|(_, is_kept)| *is_kept).map(|(&point, _)| point).collect()
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

/// How far a point is from a straight part.
fn distance_to(point: [f64; 2], from: [f64; 2], to: [f64; 2]) -> f64 {
    let along = [to[0] - from[0], to[1] - from[1]];
    let square = along[0] * along[0] + along[1] * along[1];
    let part = ((point[0] - from[0]) * along[0] + (point[1] - from[1]) * along[1]) / square;
    let part = if square > 0.0 { part.clamp(0.0, 1.0) } else { 0.0 };
    distance(point, [from[0] + part * along[0], from[1] + part * along[1]])
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Points every 10 cm along a line with these corners.
    fn drive(corners: &[[f64; 2]]) -> Vec<[f64; 2]> {
        let mut points = vec![corners[0]];
        for pair in corners.windows(2) {
            let steps = (distance(pair[0], pair[1]) / 0.1).round() as u32;
            let at = |step: u32| {
                let part = f64::from(step) / f64::from(steps);
                [0, 1].map(|axis| pair[0][axis] + part * (pair[1][axis] - pair[0][axis]))
            };
            points.extend((1..=steps).map(at));
        }
        points
    }

    #[test]
    fn a_straight_drive_is_a_straight_line() {
        assert_eq!(driven_line(&drive(&[[0.0, 0.0], [12.0, 0.0]])), [[0.0, 0.0], [12.0, 0.0]]);
        assert_eq!(driven_line(&[]), [[0.0; 2]; 0]);
        assert_eq!(driven_line(&[[1.0, 2.0]]), [[1.0, 2.0]]);
        assert_eq!(driven_line(&[[1.0, 2.0]; 50]), [[1.0, 2.0]; 2]);
    }

    #[test]
    fn corners_stay_and_detours_go() {
        let around = drive(&[[0.0, 0.0], [6.0, 0.0], [6.0, 5.0]]);
        let line = driven_line(&around);
        assert!(line.iter().any(|&corner| distance(corner, [6.0, 0.0]) < 0.35), "{line:?}");
        // Into a room and out again, three metres on the way.
        let detour = drive(&[[0.0, 0.0], [3.0, 0.0], [3.0, 4.0], [3.1, 4.0], [3.1, 0.0], [9.0, 0.0]]);
        let line = driven_line(&detour);
        assert!(line.iter().all(|point| point[1].abs() < 0.3), "{line:?}");
        // A turn on the spot, as odometry tells it.
        let wobble: Vec<[f64; 2]> =
            (0..40).map(f64::from).map(|step| [4.0 + 0.02 * step.sin(), 0.02 * step.cos()]).collect();
        let straight = drive(&[[0.0, 0.0], [4.0, 0.0]]);
        let on = drive(&[[4.0, 0.0], [8.0, 0.0]]);
        assert!(driven_line(&[straight, wobble, on].concat()).len() <= 4);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(300))]
        #[test]
        fn the_line_joins_the_ends_along_the_drive(
            steps in prop::collection::vec((-0.25_f64..0.25, -0.25_f64..0.25), 1..150),
        ) {
            let mut points = vec![[0.0, 0.0]];
            for (x, y) in steps {
                let last = points[points.len() - 1];
                points.push([last[0] + x, last[1] + y]);
            }
            let line = driven_line(&points);
            prop_assert_eq!((line.first(), line.last()), (points.first(), points.last()));
            // Its corners are points of the drive, in their order.
            let mut left = points.iter();
            for corner in &line {
                prop_assert!(left.any(|point| point == corner), "{:?} is no later point", corner);
            }
            // No part of it is far from the drive: half a gap, and what is cut off at corners.
            for pair in line.windows(2) {
                for part in 0..=20 {
                    let part = f64::from(part) / 20.0;
                    let at = [0, 1].map(|axis| pair[0][axis] + part * (pair[1][axis] - pair[0][axis]));
                    let off = points.iter().map(|&point| distance(point, at)).fold(f64::INFINITY, f64::min);
                    prop_assert!(off <= JOINED / 2.0_f64.sqrt() + OFF + 1e-9, "{} m at {:?}", off, at);
                }
            }
            // It does not come back to itself.
            let joined = without_detours(&points);
            for (index, &point) in joined.iter().enumerate() {
                for &other in joined.iter().skip(index + 2) {
                    prop_assert!(distance(point, other) > JOINED);
                }
            }
        }
    }
}
