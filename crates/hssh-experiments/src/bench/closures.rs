//! What it costs to score a closure: by the rank-3 update, and by solving the whole linear system again.

use std::error::Error;

use hssh_metrics::{Covariance, Edge, Marginals, Method, Options, Pose, PoseGraph, PoseId, solve};

use crate::pose_graphs::time;
use crate::table::{aligned, grouped};

/// `cargo xtask bench closures`.
pub(crate) fn run(runs: usize) -> Result<(), Box<dyn Error>> {
    println!("Scoring closures between the last pose and every other, one thread, medians of {runs} runs.\n");
    let heads = [
        "poses",
        "solving again µs",
        "by update µs",
        "tabulated µs",
        "times cheaper",
        "closures/s",
        "table ms",
    ];
    let mut rows = vec![heads.map(str::to_owned).to_vec()];
    for poses in [10, 30, 100, 300] {
        rows.push(row(poses, runs)?);
    }
    println!("{}", aligned(&rows));
    println!(
        "Solving again is one linear system with the closure in it, the price of a closure by appendix B; the"
    );
    println!(
        "update answers from the covariances before it. Tabulated: with all covariances computed beforehand,"
    );
    println!("once, which takes the time in the last column.");
    Ok(())
}

fn row(poses: u32, runs: usize) -> Result<Vec<String>, Box<dyn Error>> {
    let covariance = Covariance::from_standard_deviations(0.3, 0.3, 0.03)?;
    let graph = loops(poses, &covariance)?;
    let marginals = Marginals::new(&graph)?;
    let tabulated = Marginals::new(&graph)?.tabulated();
    let last = PoseId(poses - 1);
    let others = 0..poses - 2; // the one before the last is its neighbor already
    let measured = Pose::new(0.4, -0.2, 0.05);

    let closed: Vec<PoseGraph> = others
        .clone()
        .map(|to| {
            let mut closed = graph.clone();
            closed.add_edge(Edge::observed(last, PoseId(to), measured, &covariance)).map(|()| closed)
        })
        .collect::<Result<_, _>>()?;
    let once = Options { method: Method::LinearizeOnce, ..Options::default() };
    let count = f64::from(poses - 2);
    let again =
        time(runs, || closed.iter().map(|closed| solve(closed, &once).map_or(0.0, |s| s.chi2)).sum::<f64>());
    let scored = |marginals: &Marginals| {
        let score = |to| {
            let scored = marginals.new_constraint(last, PoseId(to), measured, &covariance);
            scored.map_or(f64::NAN, |scored| scored.chi2_rise)
        };
        others.clone().map(score).sum::<f64>()
    };
    let updated = time(runs, || scored(&marginals));
    let looked_up = time(runs, || scored(&tabulated));
    let table = time(runs, || Marginals::new(&graph).map(Marginals::tabulated));
    let microseconds = |seconds: f64| format!("{:.2}", 1e6 * seconds / count);
    Ok(vec![
        poses.to_string(),
        microseconds(again.median),
        microseconds(updated.median),
        microseconds(looked_up.median),
        format!("{:.0}", again.median / looked_up.median),
        grouped((count / looked_up.median) as u64),
        format!("{:.2}", 1e3 * table.median),
    ])
}

/// A robot that goes around a block of eight places again and again and notices it every third time.
fn loops(poses: u32, covariance: &Covariance) -> Result<PoseGraph, Box<dyn Error>> {
    let mut graph = PoseGraph::new();
    let step =
        |index: u32| Pose::new(8.0, 0.0, if index % 2 == 1 { std::f64::consts::FRAC_PI_2 } else { 0.0 });
    let mut here = Pose::IDENTITY;
    for index in 0..poses {
        graph.add_pose(here);
        here = here.compose(step(index));
    }
    graph.anchor(PoseId(0))?;
    for index in 1..poses {
        graph.add_edge(Edge::observed(PoseId(index - 1), PoseId(index), step(index - 1), covariance))?;
        if index >= 8 && index % 3 == 0 {
            graph.add_edge(Edge::observed(PoseId(index), PoseId(index - 8), Pose::IDENTITY, covariance))?;
        }
    }
    Ok(graph)
}
