//! What counts as free space and which branches of its medial axis matter.

use serde::{Deserialize, Serialize};

/// What cells are that were never seen.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
pub enum UnknownSpace {
    /// Obstacles, the default: a robot must not travel where it has not looked, and the axis then stays
    /// within what was seen. An end of the axis at unknown cells is still told from one at a wall
    /// ([`Tip`](super::Tip)).
    #[default]
    Wall,
    /// Free: for floor plans in which only walls are drawn.
    Free,
    /// What it says: no robot goes there, as if it were an obstacle, but it is no wall that parts rooms. For maps of which
    /// parts were never looked into.
    Unexplored,
}

/// How the medial axis is found; lengths in metres, angles in radians.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct SkeletonOptions {
    /// What unknown cells are. Default: walls.
    pub unknown: UnknownSpace,
    /// Obstacles no longer and no wider than this are clutter and are ignored, unless they touch the
    /// border: legs of chairs, specks, cells that no beam has met. Default: 0.3 m.
    pub clutter: f64,
    /// Clutter no farther apart than this, in a row that is longer than [`clutter`](Self::clutter), is a wall that was
    /// seen in pieces; none is if it is 0. Default: 0.
    pub apart: f64,
    /// Passages narrower than this are closed. Default: 0.6 m.
    pub narrowest_passage: f64,
    /// The axis follows points whose nearest obstacles are at least this far apart in direction: two
    /// walls of a corridor are π apart, those of a room's corner π/2. Default: 2π/3.
    pub opening_angle: f64,
    /// Branches are left out if they reach less than this beyond the free disc at the junction they
    /// start from: niches and doors that are only ajar; also those that lead around an obstacle and back,
    /// as in a lobby with a table. So are pieces of free space whose whole axis is shorter. Default: 1.0 m.
    pub shallowest_branch: f64,
}

impl Default for SkeletonOptions {
    fn default() -> Self {
        SkeletonOptions {
            unknown: UnknownSpace::Wall,
            clutter: 0.3,
            apart: 0.0,
            narrowest_passage: 0.6,
            opening_angle: 2.0 * std::f64::consts::FRAC_PI_3,
            shallowest_branch: 1.0,
        }
    }
}
