//! How well a trajectory knows where the robot has been before, against the true poses.

use std::collections::BTreeMap;

use hssh_local::LaserLog;
use hssh_metrics::Pose;

use super::blur::blur;

/// The robot is back where it was if it travelled so far since, in metres.
const LEAST_TRAVEL: f64 = 15.0;
/// Scans this near to one another are compared in full, in metres; of very many, about this many pairs.
const CLOSE: f64 = 1.5;
const MOST_PAIRS: usize = 20_000;
/// Scans are at one spot if they are this near to one another, in metres…
const ONE_SPOT: f64 = 1.0;
/// …and truly back if they are this near: what is known is not exact either.
const TRULY: f64 = 3.0;

/// The true poses of a log, and where the robot came back.
pub(crate) struct Revisits<'a> {
    truth: &'a [Pose],
    along: Vec<f64>,
    /// Scans that truly are within [`CLOSE`], and within [`ONE_SPOT`].
    close: Vec<(usize, usize)>,
    same: Vec<(usize, usize)>,
}

impl<'a> Revisits<'a> {
    pub(crate) fn new(truth: &'a [Pose]) -> Self {
        let along = along(truth);
        let (close, same) = (back(truth, &along, CLOSE), back(truth, &along, ONE_SPOT));
        Revisits { truth, along, close, same }
    }

    /// How long the way is, in metres.
    pub(crate) fn length(&self) -> f64 {
        self.along.last().copied().unwrap_or(0.0)
    }

    /// The mean error of the relative pose of scans that truly are close to one another, metres and radians; none if there are
    /// no such scans.
    pub(crate) fn close_error(&self, poses: &[Pose]) -> Option<[f64; 2]> {
        let step = (self.close.len() / MOST_PAIRS).max(1);
        let errors: Vec<Pose> = self
            .close
            .iter()
            .step_by(step)
            .map(|&(earlier, later)| {
                let truth = self.truth[earlier].between(self.truth[later]);
                truth.between(poses[earlier].between(poses[later]))
            })
            .collect();
        let metres = mean(errors.iter().map(|error| error.translation().norm()))?;
        Some([metres, mean(errors.iter().map(|error| error.theta.abs()))?])
    }

    /// How far hits at revisits lie from one another's, placed by a trajectory: metres. None if there are no such scans.
    pub(crate) fn blur(&self, log: &LaserLog, poses: &[Pose]) -> Option<f64> {
        blur(log, self.truth, &self.close, poses)
    }

    /// Of the pairs of scans that truly are at one spot, the part that the trajectory has at one spot.
    pub(crate) fn recall(&self, poses: &[Pose]) -> Option<f64> {
        part(&self.same, |earlier, later| distance(poses, earlier, later) <= ONE_SPOT)
    }

    /// Of the pairs of scans that the trajectory has at one spot, the part that truly is back.
    pub(crate) fn precision(&self, poses: &[Pose]) -> Option<f64> {
        let said = back(poses, &self.along, ONE_SPOT);
        part(&said, |earlier, later| distance(self.truth, earlier, later) <= TRULY)
    }
}

/// How far the robot has travelled at each pose, in metres.
fn along(poses: &[Pose]) -> Vec<f64> {
    let mut travelled = 0.0;
    (0..poses.len())
        .map(|index| {
            travelled += index.checked_sub(1).map_or(0.0, |before| distance(poses, before, index));
            travelled
        })
        .collect()
}

/// The pairs of an earlier and a later pose that are this near to one another, with enough travel between.
fn back(poses: &[Pose], along: &[f64], radius: f64) -> Vec<(usize, usize)> {
    let square = |pose: &Pose| ((pose.x / radius).floor() as i64, (pose.y / radius).floor() as i64);
    let mut squares: BTreeMap<(i64, i64), Vec<usize>> = BTreeMap::new();
    let (mut pairs, mut entered) = (Vec::new(), 0);
    for later in 0..poses.len() {
        while entered < later && along[later] - along[entered] > LEAST_TRAVEL {
            squares.entry(square(&poses[entered])).or_default().push(entered);
            entered += 1;
        }
        let (column, row) = square(&poses[later]);
        for neighbor in (-1..=1).flat_map(|u| (-1..=1).map(move |v| (column + u, row + v))) {
            let there = squares.get(&neighbor).into_iter().flatten();
            let near = there.filter(|&&earlier| distance(poses, earlier, later) <= radius);
            pairs.extend(near.map(|&earlier| (earlier, later)));
        }
    }
    pairs
}

fn distance(poses: &[Pose], one: usize, other: usize) -> f64 {
    (poses[one].translation() - poses[other].translation()).norm()
}

fn part(pairs: &[(usize, usize)], is_so: impl Fn(usize, usize) -> bool) -> Option<f64> {
    mean(pairs.iter().map(|&(earlier, later)| f64::from(u8::from(is_so(earlier, later)))))
}

fn mean(values: impl ExactSizeIterator<Item = f64>) -> Option<f64> {
    let count = values.len();
    (count > 0).then(|| values.sum::<f64>() / count as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Out along a corridor and back again, a scan a metre; on the way back `shift` metres beside it.
    fn there_and_back(shift: f64) -> Vec<Pose> {
        let out = (0..=20).map(|x| Pose::new(f64::from(x), 0.0, 0.0));
        let home = (0..20).rev().map(|x| Pose::new(f64::from(x), shift, std::f64::consts::PI));
        out.chain(home).collect()
    }

    #[test]
    fn the_truth_scores_best() {
        let truth = there_and_back(0.0);
        let revisits = Revisits::new(&truth);
        assert!((revisits.length() - 40.0).abs() < 1e-9);
        assert_eq!(revisits.recall(&truth), Some(1.0));
        assert_eq!(revisits.precision(&truth), Some(1.0));
        assert!(revisits.close_error(&truth).unwrap()[0] < 1e-9);
    }

    #[test]
    fn a_way_back_that_is_seen_elsewhere_is_not_recalled() {
        let truth = there_and_back(0.0);
        let (near, far) = (there_and_back(0.5), there_and_back(4.0));
        let revisits = Revisits::new(&truth);
        assert!((revisits.close_error(&near).unwrap()[0] - 0.5).abs() < 1e-9);
        assert_eq!(revisits.precision(&near), Some(1.0));
        assert_eq!(revisits.recall(&far), Some(0.0));
        assert_eq!(revisits.precision(&far), None, "it says nothing");
    }

    /// 4 m beside the way out, which the trajectory takes for the same way.
    #[test]
    fn returns_that_are_none_cost_precision() {
        let truth = there_and_back(4.0);
        let revisits = Revisits::new(&truth);
        assert_eq!(revisits.precision(&there_and_back(0.0)), Some(0.0));
        assert_eq!(revisits.recall(&truth), None, "it never is back");
    }

    #[test]
    fn nothing_is_back_that_just_came_from_there() {
        // 7 m back from the turn it has travelled 14 m since it was here.
        assert_eq!(Revisits::new(&there_and_back(0.0)[..28]).same, []);
        assert_eq!(Revisits::new(&there_and_back(0.0)[..29]).same.len(), 2);
    }
}
