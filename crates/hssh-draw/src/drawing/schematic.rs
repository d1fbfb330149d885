//! Poses without odometry: every link is a measurement of length 1, and all of them are a pose graph.

use std::f64::consts::PI;

use hssh_metrics::{Edge, Information, Options, Pose, PoseGraph, PoseId, SolveError, chordal_poses, solve};
use hssh_topology::{PlaceId, TopologicalMap};

use super::relax;

/// The poses of the places; `ends` has the directions of the oriented local paths in their places' frames.
pub(super) fn poses(map: &TopologicalMap, ends: &[(PlaceId, f64)]) -> Result<Vec<Pose>, SolveError> {
    let mut graph = PoseGraph::new();
    for _ in map.places() {
        graph.add_pose(Pose::IDENTITY);
    }
    for (from, to) in map.links().filter(|&(from, to)| map.place(from) != map.place(to)) {
        let (leaving, entering) = (ends[from.index()].1, ends[to.index()].1);
        // One unit along the near end; there, the far end looks back.
        let relative_pose = Pose::new(leaving.cos(), leaving.sin(), leaving + PI - entering);
        let pose_of = |olp| PoseId(map.place(olp).number());
        let information = Information::identity();
        let edge = Edge { from: pose_of(from), to: pose_of(to), relative_pose, information };
        graph.add_edge(edge).expect("the two places are different and in the graph, the pose is finite");
    }
    graph.anchor_components();
    graph.set_poses(chordal_poses(&graph)?).expect("the initial poses are as many as the graph's");
    let poses = solve(&graph, &Options::default())?.poses;
    Ok(relax::set_apart(map, ends, poses))
}
