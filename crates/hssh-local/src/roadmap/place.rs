//! Places of a map: the middle of a region, or a junction of a corridor.

use crate::place::LocalStar;
use crate::region::RegionNumber;

use super::RoadNodeNumber;

/// A place.
#[derive(Clone, PartialEq, Debug)]
pub struct RegionPlace {
    /// The region it is in.
    pub region: RegionNumber,
    /// Its node in the roadmap.
    pub node: RoadNodeNumber,
    /// Where it is, in metres.
    pub center: [f64; 2],
    /// How far obstacles are from it, in metres.
    pub clearance: f64,
    /// Its star; a place without any way out has none.
    pub star: Option<LocalStar>,
}
