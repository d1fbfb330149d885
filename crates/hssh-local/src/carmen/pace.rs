//! Whether what is ahead comes nearer as fast as the odometry says that the robot drives: if not, ranges and odometry are not in the same
//! unit, or the wheels are not as large as somebody took them for.

use super::error::LogWarning;
use super::raw::{RawLog, RawScan};

/// What is ahead is what beams show that lead aside by no more than this, in radians…
const ASIDE: f64 = 0.052;
/// …and it is one thing if their ranges differ by no more than this part.
const ONE_THING: f64 = 0.1;
/// Scans are compared between which the robot turned by no more than this, in radians…
const STRAIGHT: f64 = 0.05;
/// …and that are no more scans apart than this…
const WITHIN: usize = 60;
/// …if what is ahead came nearer by this part of its distance, and by so many standard deviations of a range.
const NEARER: f64 = 0.06;
const SIGMAS: f64 = 8.0;
/// Two comparisons agree if their paces differ by no more than this part.
const AGREE: f64 = 0.1;
/// A pace is known if so many agree on it…
const LEAST: usize = 8;
/// …and this part of all.
const MOST_OF: f64 = 0.5;
/// A pace is doubtful that is off by more than this factor.
const DOUBTFUL: f64 = 1.25;

impl RawLog {
    /// Warns if the walls come toward the robot faster or more slowly than it drives. `geometry` is how each scan looks: view and turn in
    /// radians.
    pub(crate) fn check_pace(
        &self,
        geometry: impl Fn(usize) -> (f64, f64),
        max_range: f64,
        warnings: &mut Vec<LogWarning>,
    ) {
        // In a unit that is too small most readings are beyond every limit.
        let seen = self.pace(&geometry, max_range).or_else(|| self.pace(&geometry, f64::INFINITY));
        if let Some(seen) = seen.filter(|seen| !(1.0 / DOUBTFUL..DOUBTFUL).contains(seen)) {
            warnings.push(LogWarning::OdometryScale { seen });
        }
    }

    /// How many times as fast as the odometry says, if that is clear. No unit matters here, nor how wide the steps are.
    pub(super) fn pace(&self, geometry: impl Fn(usize) -> (f64, f64), max_range: f64) -> Option<f64> {
        let sigma = self.noise(&geometry, max_range).unwrap_or(0.0);
        let ahead: Vec<Option<f64>> = self
            .scans
            .iter()
            .enumerate()
            .map(|(index, scan)| scan.ahead(geometry(index)).filter(|range| *range < max_range))
            .collect();
        let mut paces: Vec<f64> = Vec::new();
        let mut from = 0;
        while from < self.scans.len() {
            let told = |to: usize| {
                let step = self.step(&self.scans[from], &self.scans[to]);
                let nearer = ahead[from]? - ahead[to]?;
                (step.theta.abs() <= STRAIGHT).then_some((step.x, nearer))
            };
            let last = self.scans.len().min(from + WITHIN);
            let straight = (from + 1..last).map_while(|to| Some((to, told(to)?)));
            let least = (NEARER * ahead[from].unwrap_or(0.0)).max(SIGMAS * sigma);
            let compared = straight.into_iter().find(|(_, (_, nearer))| nearer.abs() > least);
            from = match compared {
                Some((to, (driven, nearer))) => {
                    paces.push(nearer / driven);
                    to
                }
                None => from + 1,
            };
        }
        agreed(paces)
    }
}

impl RawScan {
    /// The range of what is straight ahead, if that is one thing.
    fn ahead(&self, (view, turn): (f64, f64)) -> Option<f64> {
        let steps = (self.ranges.len() - self.ranges.len() % 2).max(1) as f64;
        let bearing = |beam: usize| turn + view * (beam as f64 / steps - 0.5);
        let is_ahead = |(beam, _): &(usize, &f64)| bearing(*beam).abs() <= ASIDE;
        let mut ranges: Vec<f64> =
            self.ranges.iter().enumerate().filter(is_ahead).map(|(_, range)| *range).collect();
        ranges.sort_by(f64::total_cmp);
        let (least, most) = (*ranges.first()?, *ranges.last()?);
        let middle = ranges[ranges.len() / 2];
        (least > 0.0 && most.is_finite() && most - least <= ONE_THING * middle).then_some(middle)
    }
}

/// The pace on which most agree: the middle one of the largest group that does.
fn agreed(mut paces: Vec<f64>) -> Option<f64> {
    let all = paces.len();
    paces.retain(|pace| *pace > 0.0 && pace.is_finite());
    paces.sort_by(f64::total_cmp);
    let group = |first: usize| {
        let most = paces[first] * (1.0 + 2.0 * AGREE);
        &paces[first..paces.partition_point(|pace| *pace <= most)]
    };
    let largest = (0..paces.len()).map(group).max_by_key(|group| group.len())?;
    let is_clear = largest.len() >= LEAST && largest.len() as f64 >= MOST_OF * all as f64;
    is_clear.then(|| largest[largest.len() / 2])
}
