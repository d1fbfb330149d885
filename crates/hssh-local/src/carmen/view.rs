//! Whether the scans turn as the odometry does: where the laser looks wider or less wide than is taken for granted, they do
//! not.

use super::error::LogWarning;
use super::raw::{RawLog, RawScan};

/// Scans are compared between which the robot turned by that many radians…
const TURNS: std::ops::Range<f64> = 0.08..0.6;
/// …and hardly moved, in metres.
const STANDS: f64 = 0.15;
/// So many scans behind one are tried for such a turn.
const WITHIN: usize = 6;
/// More pairs than this say no more.
const MOST_PAIRS: usize = 120;
/// With fewer pairs that tell, nothing is said.
const LEAST_PAIRS: usize = 8;
/// Ranges that differ by more than so many metres differ by so many.
const MOST_APART: f64 = 1.0;
/// A shift tells if the scans then differ by no more than this part of what they differ by on average of all shifts.
const CLEAR: f64 = 0.4;
/// Views are doubted that the scans contradict by more than this factor.
const DOUBTFUL: f64 = 1.25;

impl RawLog {
    /// Warns if scans turn otherwise than the odometry, with that view in radians. Where they turn the other way, as those of a laser that is
    /// mounted upside down, their beams are put in the usual order; unless the odometry is known to be the one that is mirrored.
    pub(super) fn check_view(&mut self, view: f64, is_told: bool, warnings: &mut Vec<LogWarning>) {
        let Some(scale) = self.scale_of_turns() else { return };
        if scale < 0.0 {
            let is_reckoned = !warnings.contains(&LogWarning::OtherHanded);
            warnings.push(LogWarning::Mirrored { is_reckoned });
            if is_reckoned {
                self.scans.iter_mut().for_each(|scan| scan.ranges.reverse());
            }
        }
        let scale = scale.abs();
        if !(1.0 / DOUBTFUL..DOUBTFUL).contains(&(scale / view)) {
            warnings.push(LogWarning::View { view, seen: scale.min(std::f64::consts::TAU), is_told });
        }
    }

    /// The view with which the scans turn as the odometry does, negative if they turn the other way: the middle one of what pairs of scans say.
    fn scale_of_turns(&self) -> Option<f64> {
        let turn = |one: &RawScan, other: &RawScan| {
            let step = self.trajectory[one.moment].pose.between(self.trajectory[other.moment].pose);
            let is_turn = TURNS.contains(&step.theta.abs()) && step.translation().norm() <= STANDS;
            is_turn.then_some(step.theta)
        };
        let pairs = self.scans.iter().enumerate().filter_map(|(index, one)| {
            let others = self.scans[index + 1..].iter().take(WITHIN);
            others.filter_map(|other| Some((one, other, turn(one, other)?))).next_back()
        });
        let pairs: Vec<_> = pairs.collect();
        let chosen = pairs.iter().step_by(pairs.len().div_ceil(MOST_PAIRS).max(1));
        let mut views: Vec<f64> = chosen
            .filter_map(|(one, other, turn)| {
                let shift = shift(&one.ranges, &other.ranges)?;
                let beams = one.ranges.len();
                Some(turn / shift * (beams - beams % 2) as f64)
            })
            .collect();
        views.sort_by(f64::total_cmp);
        (views.len() >= LEAST_PAIRS).then(|| views[views.len() / 2])
    }
}

/// By how many beams the second scan is turned to the left of the first, if that is clear and more than a few. Of scans with unequal numbers
/// of beams that is not asked.
pub(super) fn shift(first: &[f64], second: &[f64]) -> Option<f64> {
    const FEW: i64 = 4;
    if first.len() != second.len() {
        return None;
    }
    let beams = first.len() as i64;
    let apart = |shift: i64| {
        let overlap = 0.max(-shift)..beams.min(beams - shift);
        let length = overlap.end - overlap.start;
        let differences = overlap.map(|beam| {
            let difference = first[(beam + shift) as usize] - second[beam as usize];
            if difference.is_nan() { 0.0 } else { difference.abs().min(MOST_APART) }
        });
        differences.sum::<f64>() / length as f64
    };
    // Half a turn of a scan all around looks in a corridor as no turn does.
    let most = beams * 2 / 5;
    let all: Vec<(i64, f64)> = (-most..=most).map(|shift| (shift, apart(shift))).collect();
    let average = all.iter().map(|(_, apart)| apart).sum::<f64>() / all.len() as f64;
    let &(best, least) = all.iter().min_by(|a, b| a.1.total_cmp(&b.1))?;
    // Sub-beam: the vertex of the parabola through the best shift and its neighbors.
    let (before, after) = (apart(best - 1), apart(best + 1));
    let curvature = before - 2.0 * least + after;
    let vertex = if curvature > 0.0 { 0.5 * (before - after) / curvature } else { 0.0 };
    (least < CLEAR * average && best.abs() >= FEW).then_some(best as f64 + vertex)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shift_is_found() {
        let wall = |beam: f64| 3.0 + (0.13 * beam).sin() + 0.5 * (0.41 * beam).cos();
        let first: Vec<f64> = (0..180).map(|beam| wall(f64::from(beam))).collect();
        let second: Vec<f64> = (0..180).map(|beam| wall(f64::from(beam) + 11.3)).collect();
        assert!((shift(&first, &second).unwrap() - 11.3).abs() < 0.2);
        assert!((shift(&second, &first).unwrap() + 11.3).abs() < 0.2);
        assert_eq!(shift(&[2.0; 180], &[2.0; 180]), None, "a bare wall tells nothing");
    }
}
