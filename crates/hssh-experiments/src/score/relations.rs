//! Relations between poses that somebody verified by hand, and how far a trajectory is from them.

use std::collections::BTreeMap;
use std::error::Error;
use std::fs::File;
use std::path::Path;

use hssh_local::{LaserLog, LogPosition, LogReader, Message};
use hssh_metrics::Pose;

/// Two odometry messages, counted from 0, and the true pose of the second as seen from the first.
#[derive(Clone, Copy, PartialEq, Debug)]
struct Relation {
    ends: [usize; 2],
    relative: Pose,
}

/// A scan between odometry messages.
#[derive(Clone, Copy, PartialEq, Debug)]
struct ScanAt {
    /// The odometry message before it.
    message: usize,
    /// Raw odometry at the scan.
    odometry: Pose,
}

/// Relations of a log, and what it takes to know poses between its scans.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Relations {
    relations: Vec<Relation>,
    /// Of each odometry message.
    odometry: Vec<Pose>,
    scans: Vec<ScanAt>,
}

impl Relations {
    /// Reads the relations of a log; `scans` are those that are used of it.
    pub(crate) fn read(file: &Path, log: &Path, scans: &LaserLog) -> Result<Self, Box<dyn Error>> {
        let text = std::fs::read_to_string(file).map_err(|error| format!("{}: {error}", file.display()))?;
        let mut reader = LogReader::new(File::open(log)?)?;
        let (mut odometry, mut by_position) = (Vec::new(), BTreeMap::new());
        while let Some(message) = reader.next_message()? {
            match message {
                Message::Odometry(pose) => odometry.push(pose),
                Message::Laser(scan) => {
                    let message = odometry.len().saturating_sub(1);
                    by_position.insert(
                        LogPosition::Line(reader.line()),
                        ScanAt { message, odometry: scan.odometry },
                    );
                }
                _ => {}
            }
        }
        let scans: Option<Vec<ScanAt>> =
            scans.scans.iter().map(|scan| by_position.get(&scan.at).copied()).collect();
        let scans = scans.ok_or("a scan of the log is on no line")?;
        let mut relations = Vec::new();
        for line in text.lines().filter(|line| !line.trim().is_empty()) {
            relations.push(relation(line).ok_or_else(|| format!("{}: `{line}`", file.display()))?);
        }
        relations.retain(|relation| relation.ends.iter().all(|&end| end < odometry.len()));
        Ok(Relations { relations, odometry, scans })
    }

    /// The mean error of the relative poses that a trajectory, one pose for each scan, has for them: metres and radians.
    pub(crate) fn errors(&self, poses: &[Pose]) -> [f64; 2] {
        let (mut metres, mut radians) = (0.0, 0.0);
        for Relation { ends: [from, to], relative } in &self.relations {
            let error = relative.between(self.pose(poses, *from).between(self.pose(poses, *to)));
            metres += error.translation().norm();
            radians += error.theta.abs();
        }
        [metres, radians].map(|sum| sum / self.relations.len().max(1) as f64)
    }

    /// The pose at an odometry message: raw odometry carried on from the scans before and behind, blended by how near
    /// each is.
    fn pose(&self, poses: &[Pose], message: usize) -> Pose {
        let behind = self.scans.partition_point(|scan| scan.message <= message);
        let (before, behind) = (behind.saturating_sub(1), behind.min(self.scans.len() - 1));
        let carried =
            |scan: usize| poses[scan].compose(self.scans[scan].odometry.between(self.odometry[message]));
        let (start, end) = (self.scans[before].message, self.scans[behind].message);
        let first = carried(before);
        if end == start {
            return first;
        }
        let share = ((message as f64 - start as f64) / (end - start) as f64).clamp(0.0, 1.0);
        let last = carried(behind);
        let turn = Pose::new(0.0, 0.0, first.theta).between(Pose::new(0.0, 0.0, last.theta)).theta;
        let at = first.translation() * (1.0 - share) + last.translation() * share;
        Pose::new(at.x, at.y, first.theta + share * turn)
    }
}

/// `from to x y theta`.
fn relation(line: &str) -> Option<Relation> {
    let words: Vec<&str> = line.split_whitespace().collect();
    let [from, to, x, y, theta] = words[..] else { return None };
    let number = |word: &str| word.parse::<f64>().ok();
    Some(Relation {
        ends: [from.parse().ok()?, to.parse().ok()?],
        relative: Pose::new(number(x)?, number(y)?, number(theta)?),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(x: f64) -> Pose {
        Pose::new(x, 0.0, 0.0)
    }

    /// Five odometry messages a metre apart with a scan at the first and at the last of them.
    fn relations(line: &str) -> Relations {
        let scan = |message: usize| ScanAt { message, odometry: at(message as f64) };
        Relations {
            relations: vec![relation(line).unwrap()],
            odometry: (0..5).map(|x| at(f64::from(x))).collect(),
            scans: vec![scan(0), scan(4)],
        }
    }

    #[test]
    fn poses_between_scans_are_odometry_blended() {
        let between = relations("0 4 4 0 0");
        // The trajectory is 0.4 m longer than odometry: a quarter of that after a quarter of the way.
        let poses = [at(0.0), at(4.4)];
        for (message, x) in [(0, 0.0), (1, 1.1), (2, 2.2), (4, 4.4)] {
            assert!((between.pose(&poses, message).x - x).abs() < 1e-9, "{message}");
        }
    }

    #[test]
    fn errors_are_those_of_relative_poses() {
        let poses = [at(10.0), at(14.4)];
        let [metres, radians] = relations("1 3 2 0 0").errors(&poses);
        assert!((metres - 0.2).abs() < 1e-9 && radians < 1e-9, "{metres}");
        let [metres, radians] = relations("1 3 2.2 0 0.5").errors(&poses);
        assert!(metres < 1e-9 && (radians - 0.5).abs() < 1e-9, "{metres}");
    }

    #[test]
    fn what_is_no_relation_is_refused() {
        assert_eq!(relation("1 2 3 4"), None);
        assert_eq!(relation("1 2 x 4 5"), None);
    }
}
