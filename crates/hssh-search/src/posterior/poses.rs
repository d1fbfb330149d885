//! The poses of a layout, shared with the layouts that it grew from.

use std::ops::Index;
use std::sync::Arc;

use hssh_metrics::Pose;
use serde::ser::SerializeSeq;
use serde::{Deserialize, Serialize, Serializer};

/// How many poses are shared at once.
pub(super) const SHARED: usize = 128;

/// Poses in order. A copy shares all of them but the last few, so that layouts that grow pose by pose do not take the square of their
/// length.
#[derive(Clone, PartialEq, Debug, Default, Deserialize)]
#[serde(from = "Vec<Pose>")]
pub(crate) struct Poses {
    shared: Vec<Arc<[Pose]>>,
    last: Vec<Pose>,
}

impl Poses {
    /// Adds a pose.
    pub(crate) fn push(&mut self, pose: Pose) {
        self.last.push(pose);
        if self.last.len() == SHARED {
            self.shared.push(Arc::from(std::mem::take(&mut self.last)));
        }
    }

    /// Those that copies share, [`SHARED`] at a time, before the last few. `None` if the last are too many.
    pub(super) fn of(shared: Vec<Arc<[Pose]>>, last: Vec<Pose>) -> Option<Self> {
        (last.len() < SHARED).then_some(Poses { shared, last })
    }

    /// Those that copies share, [`SHARED`] at a time.
    pub(super) fn shared(&self) -> &[Arc<[Pose]>] {
        &self.shared
    }

    /// The rest.
    pub(super) fn last(&self) -> &[Pose] {
        &self.last
    }

    /// How many there are.
    pub(crate) fn len(&self) -> usize {
        SHARED * self.shared.len() + self.last.len()
    }

    /// All of them.
    pub(crate) fn iter(&self) -> impl Iterator<Item = Pose> + '_ {
        self.shared.iter().flat_map(|shared| shared.iter()).chain(&self.last).copied()
    }
}

/// One after the other, whatever is shared.
impl Serialize for Poses {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut poses = serializer.serialize_seq(Some(self.len()))?;
        for pose in self.iter() {
            poses.serialize_element(&pose)?;
        }
        poses.end()
    }
}

impl From<Vec<Pose>> for Poses {
    fn from(poses: Vec<Pose>) -> Self {
        poses.into_iter().collect()
    }
}

impl Index<usize> for Poses {
    type Output = Pose;

    fn index(&self, pose: usize) -> &Pose {
        match self.shared.get(pose / SHARED) {
            Some(shared) => &shared[pose % SHARED],
            None => &self.last[pose - SHARED * self.shared.len()],
        }
    }
}

impl FromIterator<Pose> for Poses {
    fn from_iter<I: IntoIterator<Item = Pose>>(poses: I) -> Self {
        let mut all = Poses::default();
        poses.into_iter().for_each(|pose| all.push(pose));
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn copies_grow_apart() {
        let pose = |index: usize| Pose::new(index as f64, 0.0, 0.0);
        for length in [0, 1, SHARED - 1, SHARED, SHARED + 1, 3 * SHARED] {
            let poses: Poses = (0..length).map(pose).collect();
            let mut longer = poses.clone();
            longer.push(pose(length));
            assert_eq!((poses.len(), longer.len()), (length, length + 1));
            assert!(longer.iter().eq((0..=length).map(pose)));
            assert!((0..=length).all(|index| longer[index] == pose(index)));
            assert!(poses.iter().eq((0..length).map(pose)));
        }
    }
}
