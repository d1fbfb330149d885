//! Optimizes a pose graph: that of a file in g2o, TORO or iSAM form, or a square that does not quite close.
#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use hssh_metrics::{Options, chordal_poses, read_pose_graph, solve};

const SQUARE: &str = "\
EDGE_SE2 0 1  1.0 0.0  1.5708  100 0 0 100 0 1000
EDGE_SE2 1 2  1.1 0.0  1.5708  100 0 0 100 0 1000
EDGE_SE2 2 3  1.0 0.0  1.5708  100 0 0 100 0 1000
EDGE_SE2 3 0  1.0 0.1  1.5708  100 0 0 100 0 1000
";

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let text = std::env::args().nth(1).map_or(Ok(SQUARE.to_owned()), std::fs::read_to_string)?;
    let mut file = read_pose_graph(text.as_bytes())?;
    file.graph.anchor_components();
    file.graph.set_poses(chordal_poses(&file.graph)?)?;
    let solution = solve(&file.graph, &Options::default())?;
    println!("χ² = {:.3} for {} measurements", solution.chi2, file.graph.edges().len());
    for pose in &solution.poses {
        println!("{:.3} {:.3} {:.1}°", pose.x, pose.y, pose.theta.to_degrees());
    }
    assert!(solution.is_converged());
    Ok(())
}
