//! Time in a bag: each message has the stamp of its sender and the time when it was recorded, by clocks that may differ, stand
//! still or go back.

use crate::ros::gather::Moment;

/// Stamps that go back by more than this are of a clock that was set, not of messages that overtook one another: nanoseconds.
const BACK: i64 = 1_000_000_000;
/// Odometry says where the robot is this long before its first reading and behind its last: nanoseconds.
pub(crate) const REACH: i64 = 500_000_000;

/// By which clock the messages of a bag are put in order.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Clock {
    /// That of their senders.
    Stamps,
    /// That of the recorder.
    Recorder,
}

/// Why the recorder's clock is taken.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum ClockProblem {
    /// No stamps at all.
    NoStamps,
    /// The stamps go back: so many seconds, at which scan, counted from 1.
    Back { seconds: f64, scan: usize },
    /// Scans and odometry are stamped by clocks that differ: by so many seconds where they begin.
    Differ { seconds: f64 },
}

impl Clock {
    pub(crate) fn time(self, moment: Moment) -> i64 {
        match self {
            Clock::Stamps => moment.stamp,
            Clock::Recorder => moment.recorded,
        }
    }

    fn goes_back(self, moments: &[Moment]) -> Option<(usize, i64)> {
        let mut latest = i64::MIN;
        moments.iter().enumerate().find_map(|(index, &moment)| {
            let time = self.time(moment);
            let back = latest.saturating_sub(time);
            latest = latest.max(time);
            (index > 0 && back > BACK).then_some((index, back))
        })
    }

    /// How many scans are within the time of the odometry.
    fn covered(self, scans: &[Moment], odometry: &[Moment]) -> usize {
        let times = || odometry.iter().map(|&moment| self.time(moment));
        let (Some(first), Some(last)) = (times().min(), times().max()) else { return 0 };
        scans.iter().filter(|&&scan| (first - REACH..=last + REACH).contains(&self.time(scan))).count()
    }
}

/// The clock that puts scans and odometry in order, and why it is not that of their senders.
pub(crate) fn choose(scans: &[Moment], odometry: &[Moment]) -> (Clock, Option<ClockProblem>) {
    let is_unstamped =
        |moments: &[Moment]| !moments.is_empty() && moments.iter().all(|moment| moment.stamp == 0);
    let is_worse = |problem| {
        let back = |clock: Clock| clock.goes_back(scans).or_else(|| clock.goes_back(odometry)).is_some();
        let covered = |clock: Clock| odometry.is_empty() || 2 * clock.covered(scans, odometry) > scans.len();
        // The recorder's clock is no help where it does no better.
        let is_better = !back(Clock::Recorder) && covered(Clock::Recorder);
        if is_better { (Clock::Recorder, Some(problem)) } else { (Clock::Stamps, Some(problem)) }
    };
    if is_unstamped(scans) || is_unstamped(odometry) {
        return (Clock::Recorder, Some(ClockProblem::NoStamps));
    }
    let back = Clock::Stamps.goes_back(scans).map(|(index, back)| (index + 1, back)).or_else(|| {
        let (index, back) = Clock::Stamps.goes_back(odometry)?;
        let behind = scans.iter().position(|scan| scan.recorded >= odometry[index].recorded);
        Some((behind.unwrap_or(scans.len()) + 1, back))
    });
    if let Some((scan, back)) = back {
        return is_worse(ClockProblem::Back { seconds: seconds(back), scan });
    }
    if !odometry.is_empty() && 2 * Clock::Stamps.covered(scans, odometry) <= scans.len() {
        let first = |moments: &[Moment]| moments.first().map_or(0, |moment| moment.stamp);
        return is_worse(ClockProblem::Differ { seconds: seconds(first(scans) - first(odometry)) });
    }
    (Clock::Stamps, None)
}

/// So many of the first moments come before the clock goes back.
pub(crate) fn before_back(clock: Clock, moments: &[Moment]) -> usize {
    clock.goes_back(moments).map_or(moments.len(), |(index, _)| index)
}

/// Nanoseconds as the seconds nearest to them.
pub(crate) fn seconds(nanoseconds: i64) -> f64 {
    // Exact where the number is, and correctly rounded where a quotient of two rounded numbers would not be.
    const EXACT: i64 = 1 << 53;
    if (-EXACT..EXACT).contains(&nanoseconds) {
        return nanoseconds as f64 / 1e9;
    }
    let text =
        format!("{}.{:09}", nanoseconds.div_euclid(1_000_000_000), nanoseconds.rem_euclid(1_000_000_000));
    text.parse().unwrap_or(nanoseconds as f64 / 1e9)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn moments(stamps: &[i64]) -> Vec<Moment> {
        let stamp = |(index, &stamp): (usize, &i64)| Moment {
            stamp: stamp * 1_000_000_000,
            recorded: 100_000_000_000 + index as i64 * 1_000_000_000,
        };
        stamps.iter().enumerate().map(stamp).collect()
    }

    #[test]
    fn senders_are_believed_unless_their_clocks_cannot_be_right() {
        let steady = moments(&[5, 6, 7, 8]);
        assert_eq!(choose(&steady, &steady), (Clock::Stamps, None));
        assert_eq!(choose(&steady, &[]), (Clock::Stamps, None));
        let other = moments(&[905, 906, 907, 908]);
        assert_eq!(
            choose(&steady, &other),
            (Clock::Recorder, Some(ClockProblem::Differ { seconds: -900.0 }))
        );
        let back = moments(&[5, 6, 1, 2]);
        assert_eq!(
            choose(&back, &back),
            (Clock::Recorder, Some(ClockProblem::Back { seconds: 5.0, scan: 3 }))
        );
        let none = moments(&[0, 0, 0, 0]);
        assert_eq!(choose(&none, &steady).1, Some(ClockProblem::NoStamps));
        assert_eq!(before_back(Clock::Stamps, &back), 2);
    }

    #[test]
    fn seconds_are_the_nearest_ones() {
        assert_eq!(seconds(21_019_900_000), 21.0199);
        assert_eq!(seconds(1_532_618_495_620_082_974), 1_532_618_495.620_082_9);
        assert_eq!(seconds(-1_500_000_000), -1.5);
    }
}
