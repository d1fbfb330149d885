//! Scores trajectories and maps of logs against poses and relations that are known.

mod blur;
mod fit;
mod places;
mod relations;
mod revisits;
mod walls;

pub(crate) use fit::{best_fit, root_mean_square};
pub(crate) use places::SamePlace;
pub(crate) use relations::Relations;
pub(crate) use revisits::Revisits;
pub(crate) use walls::Walls;

use hssh::answer::AnsweredMap;

/// How probable an answer says that a map is: the middle of its two bounds. What the map's places rest on is in it.
pub(crate) fn stated(map: &AnsweredMap) -> Option<f64> {
    map.probability.map(|[least, most]| (least + most) / 2.0)
}
