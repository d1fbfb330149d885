//! Which of the library's solvers the options ask for, and what it found in terms common to all of them.

use std::collections::BTreeSet;

use hssh_metrics::{
    Edge, GraphFile, Kernel, Method, Options, Pose, PoseGraph, Solution, StopReason, chordal_poses, closures,
    odometry_poses, relax, screen_closures, solve, solve_from_anywhere, solve_robustly,
};

use crate::arguments::{GraphArguments, KernelOption, MethodOption, StartOption};
use crate::failure::Failure;

/// Sweeps of relaxation if no other number is asked for: one costs as much as a few edges, and it takes many.
const MAX_SWEEPS: usize = 10_000;

/// The poses found, and how.
pub(super) struct Optimum {
    pub(super) poses: Vec<Pose>,
    /// By which factor each edge counts; 0 if it was refused.
    pub(super) weights: Vec<f64>,
    /// χ² of all edges where the search began.
    pub(super) initial_chi2: f64,
    /// χ² of the edges that were not refused.
    pub(super) chi2: f64,
    /// What was minimized instead of χ², if anything.
    pub(super) robust_cost: Option<f64>,
    /// How often whatever is `counted` was done.
    pub(super) steps: usize,
    pub(super) counted: &'static str,
    /// Why it ended, in words.
    pub(super) ending: &'static str,
    /// Whether it ended as it should.
    pub(super) finished: bool,
}

/// Minimizes as the options say; every component of the graph must have an anchor.
pub(super) fn optimize(options: &GraphArguments, file: &GraphFile) -> Result<Optimum, Failure> {
    let solver = Options {
        method: method(options.method),
        max_iterations: options.max_iterations.unwrap_or(Options::default().max_iterations),
        tolerance: options.tolerance,
    };
    if options.method == MethodOption::Relaxation && (options.graduated || options.robust.is_some()) {
        let help = "relaxation weighs all edges alike: choose another --method with --robust and --graduated";
        return Err(Failure::Usage(help.to_owned()));
    }
    let graph = started(options, file)?;
    if let Some(kernel) = options.robust {
        return robustly(&graph, kernel, options.deviations, &solver);
    }
    if options.graduated {
        return screened(&graph, options.threshold, &solver);
    }
    if options.method == MethodOption::Relaxation {
        return relaxed(&graph, options.max_iterations.unwrap_or(MAX_SWEEPS), options.tolerance);
    }
    let solution = match options.start {
        StartOption::Best => solve_from_anywhere(&graph, &solver)?,
        _ => solve(&graph, &solver)?,
    };
    Ok(Optimum {
        weights: vec![1.0; graph.edges().len()],
        initial_chi2: solution.initial_chi2,
        chi2: solution.chi2,
        robust_cost: None,
        steps: solution.iterations,
        counted: "linear system",
        ending: ending(solution.stop),
        finished: finished(solution.stop),
        poses: solution.poses,
    })
}

fn method(option: MethodOption) -> Method {
    match option {
        MethodOption::LinearizeOnce => Method::LinearizeOnce,
        MethodOption::GaussNewton => Method::GaussNewton,
        MethodOption::LevenbergMarquardt => Method::LevenbergMarquardt,
        MethodOption::Safeguarded | MethodOption::Relaxation => Method::Safeguarded,
    }
}

/// The graph at the poses to start from.
fn started(options: &GraphArguments, file: &GraphFile) -> Result<PoseGraph, Failure> {
    let mut graph = file.graph.clone();
    let resists_outliers = options.robust.is_some() || options.graduated;
    let poses = match options.start {
        StartOption::Best if resists_outliers => odometry_poses(&graph)?,
        StartOption::Best if options.method != MethodOption::Relaxation => return Ok(graph),
        StartOption::Best | StartOption::Chordal => chordal_poses(&graph)?,
        StartOption::Odometry => odometry_poses(&graph)?,
        StartOption::File => match file.unplaced.first() {
            None => return Ok(graph),
            Some(first) => {
                return Err(Failure::Usage(format!(
                    "the file does not say where {} of its {} poses are, pose {} being the first: --start chordal \
                     and --start odometry need no poses",
                    file.unplaced.len(),
                    graph.poses().len(),
                    file.labels[first.index()]
                )));
            }
        },
    };
    graph.set_poses(poses).expect("there is one pose for each");
    Ok(graph)
}

fn relaxed(graph: &PoseGraph, sweeps: usize, tolerance: f64) -> Result<Optimum, Failure> {
    let relaxation = relax(graph, sweeps, tolerance)?;
    Ok(Optimum {
        weights: vec![1.0; graph.edges().len()],
        initial_chi2: graph.chi2(),
        chi2: relaxation.chi2,
        robust_cost: None,
        steps: relaxation.sweeps,
        counted: "sweep",
        ending: if relaxation.converged { CONVERGED } else { NOT_YET },
        finished: relaxation.converged,
        poses: relaxation.poses,
    })
}

fn robustly(
    graph: &PoseGraph,
    kernel: KernelOption,
    deviations: f64,
    solver: &Options,
) -> Result<Optimum, Failure> {
    let kernel = match kernel {
        KernelOption::Huber => Kernel::Huber(deviations),
        KernelOption::Cauchy => Kernel::Cauchy(deviations),
        KernelOption::Dcs => Kernel::DynamicCovarianceScaling(deviations),
    };
    let is_suspect = suspects(graph);
    let solution = solve_robustly(graph, |edge| is_suspect(edge).then_some(kernel), solver)?;
    Ok(Optimum {
        initial_chi2: graph.chi2(),
        chi2: graph.chi2_at(&solution.poses),
        robust_cost: Some(solution.cost),
        steps: solution.rounds,
        counted: "round",
        ending: if solution.converged { CONVERGED } else { NOT_YET },
        finished: solution.converged,
        poses: solution.poses,
        weights: solution.weights,
    })
}

fn screened(graph: &PoseGraph, threshold: f64, solver: &Options) -> Result<Optimum, Failure> {
    let screening = screen_closures(graph, suspects(graph), threshold, solver)?;
    let Solution { poses, chi2, stop, .. } = screening.solution;
    Ok(Optimum {
        weights: screening.accepted.iter().map(|&accepted| f64::from(u8::from(accepted))).collect(),
        initial_chi2: graph.chi2(),
        chi2,
        robust_cost: None,
        steps: screening.rounds,
        counted: "round",
        ending: ending(stop),
        finished: finished(stop),
        poses,
    })
}

/// The edges that may be wrong: those between poses which dead reckoning does not join directly.
fn suspects(graph: &PoseGraph) -> impl Fn(&Edge) -> bool + use<> {
    let tree = graph.edges().iter().zip(closures(graph)).filter(|(_, closes)| !closes);
    let trusted: BTreeSet<_> = tree.map(|(edge, _)| (edge.from, edge.to)).collect();
    move |edge| !trusted.contains(&(edge.from, edge.to)) && !trusted.contains(&(edge.to, edge.from))
}

const CONVERGED: &str = "converged";
const NOT_YET: &str = "not converged yet: --max-iterations allows more";

fn ending(stop: StopReason) -> &'static str {
    match stop {
        StopReason::Converged => CONVERGED,
        StopReason::LinearizedOnce => "linearized once, as asked",
        StopReason::MaxIterations => NOT_YET,
        StopReason::Stalled => {
            "stalled: no step lowers χ² although the linear model promises it; the worst edge may be contradicted by \
             half a turn"
        }
        StopReason::Diverged => {
            "diverged, and stopped before the numbers became infinite: --method safeguarded is safe"
        }
    }
}

fn finished(stop: StopReason) -> bool {
    matches!(stop, StopReason::Converged | StopReason::LinearizedOnce)
}
