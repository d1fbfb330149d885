//! Finds out which closure of a pose graph is wrong: graduated non-convexity.
#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use hssh_metrics::{Edge, Options, odometry_poses, read_pose_graph, screen_closures};

const GRAPH: &str = "\
EDGE_SE2 0 1  1 0 1.5708  100 0 0 100 0 1000
EDGE_SE2 1 2  1 0 1.5708  100 0 0 100 0 1000
EDGE_SE2 2 3  1 0 1.5708  100 0 0 100 0 1000
EDGE_SE2 3 0  1 0 1.5708  100 0 0 100 0 1000
EDGE_SE2 0 2  5 5 0.0     100 0 0 100 0 1000
";

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut graph = read_pose_graph(GRAPH.as_bytes())?.graph;
    graph.anchor_components();
    graph.set_poses(odometry_poses(&graph)?)?;
    let is_closure = |edge: &Edge| edge.to.0 != edge.from.0 + 1;
    let screening = screen_closures(&graph, is_closure, 11.34, &Options::default())?;
    for (edge, accepted) in graph.edges().iter().zip(&screening.accepted) {
        println!("{} to {}: {}", edge.from.0, edge.to.0, if *accepted { "believed" } else { "refused" });
    }
    assert_eq!(screening.accepted, [true, true, true, true, false]);
    Ok(())
}
