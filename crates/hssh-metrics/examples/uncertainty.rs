//! How well a robot knows where it is after two measured steps, and relative to the first of them.
#![allow(clippy::print_stdout, reason = "an example shows what it finds")]

use hssh_metrics::{Covariance, Edge, Marginals, Pose, PoseGraph};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let covariance = Covariance::from_standard_deviations(0.05, 0.02, 0.01)?;
    let step = Pose::new(2.0, 0.0, 0.1);
    let mut graph = PoseGraph::new();
    let start = graph.add_pose(Pose::IDENTITY);
    let middle = graph.add_pose(step);
    let end = graph.add_pose(step.compose(step));
    graph.add_edge(Edge::observed(start, middle, step, &covariance))?;
    graph.add_edge(Edge::observed(middle, end, step, &covariance))?;
    graph.anchor(start)?;
    let marginals = Marginals::new(&graph)?;
    for pose in [middle, end] {
        let covariance = marginals.covariance(pose);
        println!(
            "pose {}: ± {:.3} m, ± {:.3} m, ± {:.3} rad",
            pose.0,
            covariance[(0, 0)].sqrt(),
            covariance[(1, 1)].sqrt(),
            covariance[(2, 2)].sqrt()
        );
    }
    let (relative, covariance) = marginals.relative(middle, end);
    println!("from the middle: {:.2} m, ± {:.3} m", relative.x, covariance[(0, 0)].sqrt());
    assert!((covariance[(0, 0)].sqrt() - 0.05).abs() < 1e-9);
    Ok(())
}
