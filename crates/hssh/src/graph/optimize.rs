//! Which of the library's solvers the options ask for, and what it found in terms common to all of them.

use std::collections::BTreeSet;

use hssh_metrics::{
    Edge, GraphFile, Kernel, Method, Options, Pose, PoseGraph, PoseId, Solution, StopReason, chordal_poses,
    closures, floating_poses, odometry_poses, relax, screen_closures, solve, solve_from_anywhere,
    solve_robustly,
};

use super::error::GraphFailure;
use super::options::{GraphOptions, KernelChoice, MethodChoice, StartChoice, USUAL_THRESHOLD, WrongClosures};

/// Sweeps of relaxation if no other number is asked for: one costs as much as a few edges, and it takes many.
const MAX_SWEEPS: usize = 10_000;

/// The poses found, and how.
#[derive(Clone, PartialEq, Debug)]
pub struct Optimum {
    /// The poses, by their ids.
    pub poses: Vec<Pose>,
    /// By which factor each edge counts; 0 if it was refused.
    pub weights: Vec<f64>,
    /// χ² of all edges where the search began.
    pub initial_chi2: f64,
    /// χ² of the edges that were not refused.
    pub chi2: f64,
    /// What was minimized instead of χ², if anything.
    pub robust_cost: Option<f64>,
    /// How often whatever is `counted` was done.
    pub steps: usize,
    /// `linear system`, `sweep` or `round`.
    pub counted: &'static str,
    /// Why it ended, in words.
    pub ending: &'static str,
    /// Whether it ended as it should.
    pub finished: bool,
}

/// Minimizes as the options say; every component of the graph must have an anchor.
pub(super) fn minimize(options: &GraphOptions, file: &GraphFile) -> Result<Optimum, GraphFailure> {
    let solver = Options {
        method: method(options.method),
        max_iterations: options.max_iterations.unwrap_or(Options::default().max_iterations),
        tolerance: options.tolerance,
        interrupted: options.interrupted,
    };
    if options.method == MethodChoice::Relaxation && options.wrong != WrongClosures::None {
        return Err(GraphFailure::WeighedRelaxation);
    }
    let graph = started(options, file)?;
    refuse_floating(&graph, file)?;
    match options.wrong {
        WrongClosures::Weighed { kernel, deviations } => {
            let (kernel, is_suspect) = (robust_kernel(kernel, deviations), suspects(&graph, file));
            let kernel = |edge: &Edge| is_suspect(edge).then_some(kernel);
            let found = robustly(&graph, kernel, &solver)?;
            match options.start {
                StartChoice::Best => better_from_screening(found, &graph, kernel, &is_suspect, &solver),
                _ => Ok(found),
            }
        }
        WrongClosures::Refused { threshold } => screened(&graph, suspects(&graph, file), threshold, &solver),
        WrongClosures::None if options.method == MethodChoice::Relaxation => {
            let max_iterations = options.max_iterations.unwrap_or(MAX_SWEEPS);
            relaxed(&graph, &Options { max_iterations, ..solver })
        }
        WrongClosures::None if !file.doubtful.is_empty() => {
            let doubtful: BTreeSet<_> =
                file.doubtful.iter().map(|&index| ends(&graph.edges()[index])).collect();
            let is_suspect = |edge: &Edge| doubtful.contains(&ends(edge));
            screened(&graph, is_suspect, USUAL_THRESHOLD, &solver)
        }
        WrongClosures::None => plainly(&graph, options.start, &solver),
    }
}

/// By least squares alone.
fn plainly(graph: &PoseGraph, start: StartChoice, solver: &Options) -> Result<Optimum, GraphFailure> {
    let solution = match start {
        StartChoice::Best => solve_from_anywhere(graph, solver)?,
        _ => solve(graph, solver)?,
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

fn method(option: MethodChoice) -> Method {
    match option {
        MethodChoice::LinearizeOnce => Method::LinearizeOnce,
        MethodChoice::GaussNewton => Method::GaussNewton,
        MethodChoice::LevenbergMarquardt => Method::LevenbergMarquardt,
        MethodChoice::Safeguarded | MethodChoice::Relaxation => Method::Safeguarded,
    }
}

/// The graph at the poses to start from.
fn started(options: &GraphOptions, file: &GraphFile) -> Result<PoseGraph, GraphFailure> {
    let mut graph = file.graph.clone();
    let resists_outliers = options.wrong != WrongClosures::None || !file.doubtful.is_empty();
    let poses = match options.start {
        StartChoice::Best if resists_outliers => odometry_poses(&graph)?,
        StartChoice::Best if options.method != MethodChoice::Relaxation => return Ok(graph),
        StartChoice::Best | StartChoice::Chordal => chordal_poses(&graph)?,
        StartChoice::Odometry => odometry_poses(&graph)?,
        StartChoice::File => match file.unplaced.first() {
            None => return Ok(graph),
            Some(first) => {
                return Err(GraphFailure::Unplaced {
                    unplaced: file.unplaced.len(),
                    poses: graph.poses().len(),
                    first: file.label(*first).unwrap_or_default(),
                });
            }
        },
    };
    graph.set_poses(poses).expect("there is one pose for each");
    Ok(graph)
}

fn relaxed(graph: &PoseGraph, options: &Options) -> Result<Optimum, GraphFailure> {
    let relaxation = relax(graph, options)?;
    Ok(Optimum {
        weights: vec![1.0; graph.edges().len()],
        initial_chi2: graph.chi2(),
        chi2: relaxation.chi2,
        robust_cost: None,
        steps: relaxation.sweeps,
        counted: "sweep",
        ending: if relaxation.converged { CONVERGED } else { unfinished(options) },
        finished: relaxation.converged,
        poses: relaxation.poses,
    })
}

fn ends(edge: &Edge) -> (PoseId, PoseId) {
    (edge.from, edge.to)
}

fn robust_kernel(kernel: KernelChoice, deviations: f64) -> Kernel {
    match kernel {
        KernelChoice::Huber => Kernel::Huber(deviations),
        KernelChoice::Cauchy => Kernel::Cauchy(deviations),
        KernelChoice::Dcs => Kernel::DynamicCovarianceScaling(deviations),
    }
}

fn robustly(
    graph: &PoseGraph,
    kernel: impl Fn(&Edge) -> Option<Kernel>,
    solver: &Options,
) -> Result<Optimum, GraphFailure> {
    let solution = solve_robustly(graph, kernel, solver)?;
    Ok(Optimum {
        initial_chi2: graph.chi2(),
        chi2: graph.chi2_at(&solution.poses),
        robust_cost: Some(solution.cost),
        steps: solution.rounds,
        counted: "round",
        ending: if solution.converged { CONVERGED } else { unfinished(solver) },
        finished: solution.converged,
        poses: solution.poses,
        weights: solution.weights,
    })
}

/// Where dead reckoning has drifted far, right closures fit it as badly as wrong ones, and a kernel that switches off what fits
/// badly never gets away from it. Deciding for each closure gets farther, and a second descent from there may cost less.
fn better_from_screening(
    found: Optimum,
    graph: &PoseGraph,
    kernel: impl Fn(&Edge) -> Option<Kernel>,
    is_suspect: impl Fn(&Edge) -> bool,
    solver: &Options,
) -> Result<Optimum, GraphFailure> {
    let Ok(screening) = screen_closures(graph, is_suspect, USUAL_THRESHOLD, solver) else { return Ok(found) };
    let mut anew = graph.clone();
    anew.set_poses(screening.solution.poses).expect("there is one pose for each");
    let other = robustly(&anew, kernel, solver)?;
    let is_better = other
        .robust_cost
        .zip(found.robust_cost)
        .is_some_and(|(other, found)| other < found - 1e-6 * (1.0 + found));
    Ok(if is_better { Optimum { initial_chi2: found.initial_chi2, ..other } } else { found })
}

fn screened(
    graph: &PoseGraph,
    is_suspect: impl Fn(&Edge) -> bool,
    threshold: f64,
    solver: &Options,
) -> Result<Optimum, GraphFailure> {
    let screening = screen_closures(graph, is_suspect, threshold, solver)?;
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

/// The edges that may be wrong: those between poses which dead reckoning does not join directly. Priors are believed.
fn suspects(graph: &PoseGraph, file: &GraphFile) -> impl Fn(&Edge) -> bool + use<> {
    let tree = graph.edges().iter().zip(closures(graph)).filter(|(_, closes)| !closes);
    let trusted: BTreeSet<_> = tree.map(|(edge, _)| (edge.from, edge.to)).collect();
    let world = file.world;
    move |edge| {
        !trusted.contains(&(edge.from, edge.to))
            && !trusted.contains(&(edge.to, edge.from))
            && world != Some(edge.from)
    }
}

/// Refuses a graph of which something could move without any measurement noticing.
fn refuse_floating(graph: &PoseGraph, file: &GraphFile) -> Result<(), GraphFailure> {
    let mut placed = graph.clone();
    // Where poses are given by edges alone, all are at the origin, and much looks as if it could move.
    placed.set_poses(odometry_poses(graph)?).expect("there is one pose for each");
    let floating = floating_poses(&placed);
    let labels: Vec<String> =
        floating.iter().filter_map(|&pose| file.label(pose)).map(|label| label.to_string()).collect();
    if labels.is_empty() {
        return Ok(());
    }
    let shown = labels.iter().take(8).cloned().collect::<Vec<_>>().join(", ");
    let more = if labels.len() > 8 { format!(" and {} more", labels.len() - 8) } else { String::new() };
    Err(GraphFailure::Floating { poses: shown + &more })
}

const CONVERGED: &str = "converged";
const INTERRUPTED: &str = "interrupted: these are the poses reached";
const NOT_YET: &str = "not converged yet: --max-iterations allows more";

/// Why what goes round by round did not come to its end.
fn unfinished(options: &Options) -> &'static str {
    if (options.interrupted)() { INTERRUPTED } else { NOT_YET }
}

fn ending(stop: StopReason) -> &'static str {
    match stop {
        StopReason::Converged => CONVERGED,
        StopReason::LinearizedOnce => "linearized once, as asked",
        StopReason::MaxIterations => NOT_YET,
        StopReason::Interrupted => INTERRUPTED,
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
