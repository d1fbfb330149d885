//! The medial axis of free space: thinned to a graph, pruned, and told what is before its ends.

use super::anchor::anchors;
use super::free_space::FreeSpace;
use super::graph::{Skeleton, Tip};
use super::mask::Mask;
use super::options::SkeletonOptions;
use super::prune::prune;
use super::thinning::thin;
use super::tip::{cut_taper, tip};
use super::trace::trace;
use crate::grid::OccupancyGrid;

impl Skeleton {
    /// The medial axis of the free space of a grid.
    #[must_use]
    pub fn new(grid: &OccupancyGrid, free: &FreeSpace, options: &SkeletonOptions) -> Self {
        let axis = medial_axis(free, options);
        let mut skeleton = prune(trace(&axis, free.field()), options);
        for node in &mut skeleton.nodes {
            if let [end] = node.ends[..] {
                let points = &mut skeleton.edges[end.edge.index()].points;
                if end.is_last {
                    points.reverse();
                }
                let tip = tip(points, grid, free.field());
                if tip != Tip::Wall {
                    cut_taper(points, grid, free.field());
                }
                (node.at, node.tip) = (points[0], Some(tip));
                if end.is_last {
                    points.reverse();
                }
            }
        }
        skeleton
    }
}

/// The cells of the medial axis: free space thinned first down to its anchors and what connects them,
/// then, where anchors lie side by side, to lines of one cell.
pub(super) fn medial_axis(free: &FreeSpace, options: &SkeletonOptions) -> Mask {
    let mut mask = free.mask.clone();
    let is_anchor = anchors(&mask, free.field(), options.opening_angle);
    let rank = ranks(free);
    thin(&mut mask, |position| rank[position], |_, position| !is_anchor[position]);
    thin(&mut mask, |position| rank[position], |mask, position| !mask.is_end(position));
    mask
}

/// The distance of each cell to obstacles in quarters of a cell, by position.
fn ranks(free: &FreeSpace) -> Vec<u32> {
    let mut ranks = vec![0; free.mask.positions()];
    for position in free.mask.members() {
        let squared = free.field().squared_cells(free.mask.cell(position)).unwrap_or(0);
        ranks[position] = (4.0 * f64::from(squared).sqrt()).round() as u32;
    }
    ranks
}
