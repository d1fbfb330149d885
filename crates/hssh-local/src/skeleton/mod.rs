//! The medial axis of free space as a graph: the points equally far from obstacles on several sides
//! (section 2.2.2, third definition of gateways).

mod anchor;
mod clutter;
mod free_space;
mod graph;
mod lobe;
mod mask;
mod medial_axis;
mod options;
mod prune;
#[cfg(test)]
mod tests;
mod thinning;
mod tip;
mod trace;

pub use free_space::FreeSpace;
pub(crate) use free_space::clear_field;
pub use graph::{
    AxisPoint, EdgeEnd, Skeleton, SkeletonEdge, SkeletonEdgeId, SkeletonNode, SkeletonNodeId, Tip,
};
pub(crate) use graph::{distance, distances, length};
pub use options::{SkeletonOptions, UnknownSpace};
