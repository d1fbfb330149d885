//! Scans of several lasers of one robot as one that looks all around from where the first of them sits.
//!
//! A hit of another laser lies in the direction in which it is seen from there; of hits in one direction the nearest counts. Where no laser hit
//! anything, nothing is known. What a laser hit that the first one could not have seen, behind a corner of the robot's own width, stays in its
//! direction: the lasers of one robot are near one another.

use std::f64::consts::TAU;

use hssh_metrics::Pose;
use nalgebra::Vector2;

use super::sweep::Scan;

/// A merged scan has no more beams.
const MOST_BEAMS: f64 = 3_000.0;

/// What a laser and others see around the first one. With each of the others comes its frame, seen from the frame of the first: where it was when
/// it looked.
#[must_use]
pub fn scan_around(first: &Scan, others: &[(&Scan, Pose)]) -> Scan {
    let lasers = others.iter().map(|(scan, _)| *scan).chain([first]);
    let finest = lasers.map(step).fold(f64::INFINITY, f64::min);
    let beams = 2.0 * (TAU / finest / 2.0).clamp(1.0, MOST_BEAMS / 2.0).round();
    let mut around = Scan { ranges: vec![f64::INFINITY; beams as usize], view: TAU, turn: 0.0 };
    first.hits(f64::INFINITY).for_each(|(_, hit)| add(&mut around, hit));
    for (other, frame) in others {
        for (_, hit) in other.hits(f64::INFINITY) {
            add(&mut around, frame.translation() + frame.rotation() * hit);
        }
    }
    around
}

/// The angle between two beams.
fn step(scan: &Scan) -> f64 {
    scan.view / (scan.ranges.len() - scan.ranges.len() % 2).max(1) as f64
}

/// Adds a point that was hit.
fn add(around: &mut Scan, hit: Vector2<f64>) {
    let beams = around.ranges.len() as f64;
    let beam = ((hit.y.atan2(hit.x) / TAU + 0.5) * beams).round() as usize % around.ranges.len();
    around.ranges[beam] = around.ranges[beam].min(hit.norm());
}
