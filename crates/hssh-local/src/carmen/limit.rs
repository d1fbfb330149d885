//! From which range on a reading means that nothing came back: what the log says, or what its readings say.

use super::error::{LogError, LogWarning, unit};
use super::raw::RawLog;

/// The parameter that says it.
const FRONT_LASER_MAX: &str = "robot_front_laser_max";
/// That range where neither parameter nor readings say it, in metres. Logs write nothing as 50, 80 or 81.9; no laser of
/// their time saw a wall at 50 m.
const DEFAULT: f64 = 50.0;
/// What is no more than this much shorter than the longest reading is at the limit, in metres.
const AT_LIMIT: f64 = 0.005;
/// Readings at the limit stand out if they are at least this part of all…
const LEAST_PART: f64 = 0.005;
/// …and so many…
const LEAST: usize = 20;
/// …and in the scans that have any there are so many, as a wall that is met head-on has in few scans…
const LEAST_A_SCAN: usize = 2;
/// …and this many times as many as there are down to nine tenths of it, as there are not of walls.
const PEAK: usize = 3;
/// A limit is doubted that more than this part of all readings exceed, of many lengths.
const MOST_BEYOND: f64 = 0.03;
/// With a smaller part of beams that came back, nothing can be made of a log.
const LEAST_RETURNED: f64 = 0.01;
/// Ranges of which the middle one, in millimetres, is between these many metres are millimetres.
const MILLIMETRES: std::ops::Range<f64> = 0.2..60.0;

impl RawLog {
    /// How many scans have a reading at a limit.
    fn scans_at(&self, limit: f64) -> usize {
        let is_at = |&range: &f64| (range - limit).abs() <= AT_LIMIT;
        self.scans.iter().filter(|scan| scan.ranges.iter().any(is_at)).count()
    }

    /// From how many metres on nothing came back. `geometry` is how each scan looks: view and turn in radians.
    ///
    /// # Errors
    /// If hardly a beam came back.
    pub(crate) fn limit(
        &self,
        geometry: impl Fn(usize) -> (f64, f64),
        warnings: &mut Vec<LogWarning>,
    ) -> Result<f64, LogError> {
        let said = self.parameter(FRONT_LASER_MAX).filter(|&metres| metres > 0.0);
        let usual = said.unwrap_or(DEFAULT);
        let readings =
            || self.scans.iter().flat_map(|scan| &scan.ranges).copied().filter(|&range| range > 0.0);
        let mut limit = usual;
        if let Some((peak, beams)) = peak(readings().filter(|&range| range < usual))
            && beams >= LEAST_A_SCAN * self.scans_at(peak)
        {
            limit = peak - AT_LIMIT;
            let beams = beams as u64;
            warnings.push(LogWarning::RangeLimit { limit: peak, beams, said });
        }
        let beams: usize = self.scans.iter().map(|scan| scan.ranges.len()).sum();
        if let Some(said) = said {
            let beyond = readings().filter(|&range| range >= said && range < DEFAULT);
            let (count, longest) = (beyond.clone().count(), beyond.clone().fold(0.0, f64::max));
            let like_walls = beyond.filter(|&range| range > said + AT_LIMIT && range < longest - AT_LIMIT);
            if like_walls.count() as f64 > MOST_BEYOND * beams as f64 {
                let (beyond, beams) = (count as u64, beams as u64);
                warnings.push(LogWarning::LimitDoubted { said, beyond, beams, longest });
            }
        }
        let returned = readings().filter(|&range| range < limit).count();
        if (returned as f64) < LEAST_RETURNED * beams as f64 {
            let mut finite: Vec<f64> = readings().filter(|range| range.is_finite()).collect();
            finite.sort_by(f64::total_cmp);
            let middle = finite.get(finite.len() / 2).copied().unwrap_or(0.0) / 1e3;
            let by_pace = self.pace(geometry, f64::INFINITY).and_then(unit);
            let unit = by_pace.or(MILLIMETRES.contains(&middle).then_some("millimetres"));
            let (returned, beams) = (returned as u64, beams as u64);
            return Err(LogError::NothingCameBack { returned, beams, limit, unit });
        }
        Ok(limit)
    }
}

/// The longest of some ranges and how often it occurs, if that is so often that it can be no wall.
fn peak(ranges: impl Iterator<Item = f64> + Clone) -> Option<(f64, usize)> {
    let longest = ranges.clone().fold(0.0, f64::max);
    let (mut all, mut at_limit, mut below) = (0, 0, 0);
    for range in ranges {
        all += 1;
        if range >= longest - AT_LIMIT {
            at_limit += 1;
        } else if range > 0.9 * longest {
            below += 1;
        }
    }
    let stands_out =
        at_limit >= LEAST && at_limit as f64 >= LEAST_PART * all as f64 && at_limit >= PEAK * below;
    stands_out.then_some((longest, at_limit))
}
