//! Whether the laser sees far enough to tell ways out from niches.

use super::error::SurveyWarning;
use crate::carmen::LaserLog;

/// A laser tells whether a way leads on if it sees this part of how far ways out have to lead…
const LEAST_PART: f64 = 0.5;
/// …unless so few beams bring nothing back that everything there is is nearer.
const OPEN: f64 = 0.05;

/// Says so if the laser sees less far than half of `depth`, the metres that ways out have to lead on, and there is more to be seen.
pub(super) fn short_sighted(log: &LaserLog, depth: f64) -> Option<SurveyWarning> {
    let ranges = || log.scans.iter().flat_map(|scan| &scan.scan.ranges);
    let reach = ranges().copied().filter(|range| range.is_finite()).fold(0.0, f64::max);
    let all = ranges().count();
    let open = ranges().filter(|range| !range.is_finite()).count();
    let is_short = reach < LEAST_PART * depth && open as f64 > OPEN * all as f64;
    is_short.then_some(SurveyWarning::ShortSighted { reach, depth })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_laser_that_sees_little_of_an_open_room_is_short_sighted() {
        let log = |ranges: &str| {
            let scan = |step: u32| format!("FLASER 4 {ranges} {step} 0 0 {step} 0 0 {step} h {step}\n");
            let text: String = (0..10).map(scan).collect();
            LaserLog::read(format!("PARAM robot_front_laser_max 3 h 0\n{text}").as_bytes()).unwrap()
        };
        let seen = short_sighted(&log("1 2.5 3 3"), 8.0);
        assert_eq!(seen, Some(SurveyWarning::ShortSighted { reach: 2.5, depth: 8.0 }));
        assert_eq!(short_sighted(&log("1 2.5 3 3"), 4.0), None, "it sees far enough");
        assert_eq!(short_sighted(&log("1 2.5 2 1"), 8.0), None, "a small room, and all of it");
    }
}
