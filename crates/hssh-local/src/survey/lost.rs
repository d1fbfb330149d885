//! Where a robot was lost: its scans lie on nothing that it saw before, or it has no odometry, or its laser is turned.

use super::error::SurveyWarning;
use super::evidence::Evidence;
use crate::carmen::{LaserLog, LaserTurn, LogWarning};
use crate::matching::Track;

/// Where the robot was lost: so many scans in a row, or so large a part of all, lie on nothing that was seen before; or
/// it has no odometry at all.
#[must_use]
pub fn doubts(log: &LaserLog, track: &Track) -> Vec<SurveyWarning> {
    const IN_A_ROW: usize = 5;
    const PART: f64 = 0.2;
    let mut warnings = Vec::new();
    let stretches = standing(log, track);
    let is_whole = |&(first, last, _): &(usize, usize, f64)| first == 0 && last + 1 == track.scans.len();
    if log.warnings.contains(&LogWarning::ScansAlone) || stretches.iter().any(is_whole) {
        warnings.push(SurveyWarning::NoOdometry);
    } else {
        let stands = |(first, last, metres)| SurveyWarning::OdometryStands {
            first: first + 1,
            last: last + 1,
            metres,
        };
        warnings.extend(stretches.into_iter().map(stands));
    }
    let mut runs: Vec<(usize, usize)> = Vec::new();
    for &scan in &track.lost {
        match runs.last_mut() {
            Some((_, last)) if *last + 1 == scan => *last = scan,
            _ => runs.push((scan, scan)),
        }
    }
    let long = runs.iter().filter(|(first, last)| last - first + 1 >= IN_A_ROW);
    warnings.extend(long.map(|&(first, last)| SurveyWarning::Lost { first: first + 1, last: last + 1 }));
    if warnings.is_empty() && track.lost.len() as f64 > PART * track.scans.len() as f64 {
        warnings.push(SurveyWarning::Lost {
            first: track.lost[0] + 1,
            last: track.lost[track.lost.len() - 1] + 1,
        });
    }
    warnings
}

/// Where the way breaks and the odometry jumps as well, nothing tells how the parts of the log lie to one another: that counts as being lost.
pub(super) fn carried(log: &LaserLog, evidence: &mut Evidence, warnings: &mut [SurveyWarning]) {
    /// So many scans after a jump may still lie on what was seen before.
    const AFTER: usize = 2;
    let jump = |warning: &LogWarning| match warning {
        LogWarning::Jump { at, .. } => Some(log.scans.partition_point(|scan| scan.at < *at)),
        _ => None,
    };
    let jumps: Vec<usize> = log.warnings.iter().filter_map(jump).collect();
    for warning in warnings {
        let SurveyWarning::Break { scan } = *warning else { continue };
        if jumps.iter().any(|jump| (*jump..=jump + AFTER).contains(&(scan - 1))) {
            *warning = SurveyWarning::Carried { scan };
            evidence.breaks -= 1;
            evidence.lost += 1;
        }
    }
}

/// The stretches of scans along which the odometry stands still and the scans go on: the first, the last, and how many metres away from the
/// first the scans get.
fn standing(log: &LaserLog, track: &Track) -> Vec<(usize, usize, f64)> {
    /// Metres from where it was that odometry stands still within…
    const STANDS: f64 = 0.05;
    /// …and that scans go on by at least.
    const MOVES: f64 = 1.0;
    let scans = &track.scans;
    let told = |from: usize, to: usize| log.scans[from].odometry.between(log.scans[to].odometry);
    let mut stretches = Vec::new();
    let mut from = 0;
    for to in 1..=scans.len() {
        if to < scans.len() && told(from, to).translation().norm() <= STANDS {
            continue;
        }
        let away = |scan: usize| scans[from].pose.between(scans[scan].pose).translation().norm();
        let metres = (from..to).map(away).fold(0.0, f64::max);
        if metres > MOVES {
            stretches.push((from, to - 1, metres));
        }
        from = to;
    }
    stretches
}

/// By how much the laser is turned against the odometry, if that is clear: reckoned with, or not, where somebody said how the laser sits.
#[must_use]
pub fn turned_laser(log: &LaserLog, track: &Track) -> Option<SurveyWarning> {
    let doubted = || LaserTurn::of(log, track).filter(LaserTurn::is_clear).map(SurveyWarning::LaserTurned);
    log.laser_turn.map(SurveyWarning::TurnedWithLaser).or_else(doubted)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::matching::TrackedScan;
    use hssh_metrics::Pose;

    /// A log whose odometry advances by `step` metres from scan to scan.
    fn log(step: f64) -> LaserLog {
        let line =
            |scan: u32| format!("FLASER 3 1 2 1 0 0 0 {} 0 0 {scan} host {scan}\n", f64::from(scan) * step);
        let text: String = (0..40).map(line).collect();
        LaserLog::read(text.as_bytes()).unwrap()
    }

    fn track(lost: &[usize]) -> Track {
        let scan = |scan: u32| {
            let x = f64::from(scan) * 0.5;
            TrackedScan { pose: Pose::new(x, 0.0, 0.0), step: None, travelled: x }
        };
        Track { scans: (0..40).map(scan).collect(), lost: lost.to_vec() }
    }

    #[test]
    fn a_scan_here_and_there_is_no_loss() {
        assert_eq!(doubts(&log(0.5), &track(&[3, 4, 9, 20])), []);
    }

    #[test]
    fn many_in_a_row_or_in_all_are() {
        let row = doubts(&log(0.5), &track(&[3, 10, 11, 12, 13, 14, 30]));
        assert_eq!(row, [SurveyWarning::Lost { first: 11, last: 15 }]);
        let many: Vec<usize> = (0..40).step_by(3).collect();
        assert_eq!(doubts(&log(0.5), &track(&many)), [SurveyWarning::Lost { first: 1, last: 40 }]);
    }

    /// Twenty scans along a line, and twenty of another session, which counts from where it begins.
    #[test]
    fn a_break_at_a_jump_is_a_robot_that_was_carried() {
        let line = |scan: u32| {
            let x = f64::from(scan % 20) * 0.5;
            format!("FLASER 3 1 2 1 0 0 0 {x} 0 0 {scan} host {scan}\n")
        };
        let log = LaserLog::read((0..40).map(line).collect::<String>().as_bytes()).unwrap();
        let told = |scan: usize| {
            let mut evidence = Evidence { breaks: 1, ..Evidence::default() };
            let mut warnings = [SurveyWarning::Break { scan }];
            carried(&log, &mut evidence, &mut warnings);
            let [warning] = warnings;
            (warning, evidence.breaks, evidence.lost)
        };
        assert_eq!(told(21), (SurveyWarning::Carried { scan: 21 }, 0, 1));
        assert_eq!(told(11), (SurveyWarning::Break { scan: 11 }, 1, 0));
    }

    #[test]
    fn a_robot_that_moves_without_odometry_has_none() {
        assert_eq!(doubts(&log(0.0), &track(&[])), [SurveyWarning::NoOdometry]);
        assert_eq!(doubts(&log(0.0005), &track(&[])), [SurveyWarning::NoOdometry], "kilometres");
    }

    #[test]
    fn odometry_that_stops_on_the_way_stands_from_there_on() {
        let mut log = log(0.5);
        let stop = log.scans[30].odometry;
        log.scans[30..].iter_mut().for_each(|scan| scan.odometry = stop);
        assert_eq!(
            doubts(&log, &track(&[])),
            [SurveyWarning::OdometryStands { first: 31, last: 40, metres: 4.5 }]
        );
        // A robot that waits does not move.
        let mut waits = track(&[]);
        let there = waits.scans[30];
        waits.scans[30..].fill(there);
        assert_eq!(doubts(&log, &waits), []);
    }
}
