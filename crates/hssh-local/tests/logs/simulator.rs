//! A robot with a laser among walls: exact ray casting, and logs written as CARMEN text.

use hssh_local::Scan;
use hssh_metrics::Pose;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

/// Walls as segments between two points, in metres.
pub(crate) type Walls = Vec<[[f64; 2]; 2]>;

/// The walls of free space made of axis-parallel boxes (low corner, high corner): every border of a box
/// that is not inside another box, in pieces of 25 cm.
pub(crate) fn around(boxes: &[[[f64; 2]; 2]]) -> Walls {
    const PIECE: f64 = 0.25;
    let is_inside = |[x, y]: [f64; 2]| {
        boxes.iter().any(|[low, high]| low[0] < x && x < high[0] && low[1] < y && y < high[1])
    };
    let mut walls = Walls::new();
    for [low, high] in boxes {
        let corners = [*low, [high[0], low[1]], *high, [low[0], high[1]]];
        for side in 0..4 {
            let (from, to) = (corners[side], corners[(side + 1) % 4]);
            let length = (to[0] - from[0]).abs() + (to[1] - from[1]).abs();
            let pieces = (length / PIECE).round() as u32;
            let at = |k: u32| {
                let part = f64::from(k) / f64::from(pieces);
                [from[0] + part * (to[0] - from[0]), from[1] + part * (to[1] - from[1])]
            };
            let is_wall = |k: u32| {
                let [a, b] = [at(k), at(k + 1)];
                !is_inside([(a[0] + b[0]) / 2.0, (a[1] + b[1]) / 2.0])
            };
            walls.extend((0..pieces).filter(|&k| is_wall(k)).map(|k| [at(k), at(k + 1)]));
        }
    }
    walls
}

/// What a laser of 180 beams sees from a pose; infinite beyond 30 m.
pub(crate) fn scan(walls: &Walls, pose: Pose) -> Scan {
    let mut scan = Scan::of_half_turn(vec![f64::INFINITY; 180]);
    for beam in 0..scan.ranges.len() {
        let (sin, cos) = (pose.theta + scan.bearing(beam)).sin_cos();
        let hits = walls.iter().filter_map(|wall| hit([pose.x, pose.y], [cos, sin], *wall));
        scan.ranges[beam] = hits.filter(|&range| range < 30.0).fold(f64::INFINITY, f64::min);
    }
    scan
}

/// The distance along a ray to a segment.
fn hit(from: [f64; 2], direction: [f64; 2], [a, b]: [[f64; 2]; 2]) -> Option<f64> {
    let cross = |u: [f64; 2], v: [f64; 2]| u[0] * v[1] - u[1] * v[0];
    let (along, to_a) = ([b[0] - a[0], b[1] - a[1]], [a[0] - from[0], a[1] - from[1]]);
    let determinant = cross(direction, along);
    if determinant.abs() < 1e-12 {
        return None;
    }
    let (range, part) = (cross(to_a, along) / determinant, cross(to_a, direction) / determinant);
    (range > 0.0 && (-1e-9..=1.0 + 1e-9).contains(&part)).then_some(range)
}

/// A log of scans from poses, with what odometry says of each.
pub(crate) fn log(walls: &Walls, poses: &[Pose], odometry: &[Pose]) -> String {
    let mut text = String::from("PARAM robot_front_laser_max 40.0 nohost 0\n");
    for (pose, raw) in poses.iter().zip(odometry) {
        text += "FLASER 180";
        for range in scan(walls, *pose).ranges {
            text += &format!(" {:.3}", range.min(50.0));
        }
        for pose in [pose, raw] {
            text += &format!(" {} {} {}", pose.x, pose.y, pose.theta);
        }
        text += " 0.0 nohost 0.0\n";
    }
    text
}

/// Poses along a polyline every `step` metres, with turns on the spot in steps of at most 0.3 rad.
pub(crate) fn drive(corners: &[[f64; 2]], step: f64) -> Vec<Pose> {
    let mut poses: Vec<Pose> = Vec::new();
    for pair in corners.windows(2) {
        let [dx, dy] = [pair[1][0] - pair[0][0], pair[1][1] - pair[0][1]];
        let heading = dy.atan2(dx);
        if let Some(&last) = poses.last() {
            let turn = Pose::new(0.0, 0.0, heading - last.theta).theta;
            let steps = (turn.abs() / 0.3).ceil();
            poses.extend(
                (1..=steps as u32)
                    .map(|k| Pose::new(last.x, last.y, last.theta + turn * f64::from(k) / steps)),
            );
        }
        let steps = (dx.hypot(dy) / step).ceil();
        poses.extend((0..=steps as u32).map(|k| {
            let part = f64::from(k) / steps;
            Pose::new(pair[0][0] + part * dx, pair[0][1] + part * dy, heading)
        }));
    }
    poses
}

/// What odometry says that drifts: `bend` radians for each metre, and noise.
pub(crate) fn drifting(poses: &[Pose], bend: f64, seed: u64) -> Vec<Pose> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut odometry = vec![Pose::IDENTITY];
    for pair in poses.windows(2) {
        let step = pair[0].between(pair[1]);
        let length = step.translation().norm();
        let mut noise = |sigma: f64| -> f64 {
            let normal: f64 = StandardNormal.sample(&mut rng);
            normal * sigma
        };
        let wrong = Pose::new(
            step.x + noise(0.02) * length.sqrt(),
            step.y + noise(0.01) * length.sqrt(),
            step.theta + bend * length + noise(0.002) * length.sqrt(),
        );
        odometry.push(odometry[odometry.len() - 1].compose(wrong));
    }
    odometry
}
