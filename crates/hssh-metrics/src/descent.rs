//! The solvers: the thesis's single linearization, Gauss–Newton, Levenberg–Marquardt, and both together.

use crate::graph::PoseGraph;
use crate::linear::Factor;
use crate::linearization::{LinearizationPoint, NormalEquations};
use crate::pose::Pose;
use crate::solution::{Options, Solution, SolveError, StopReason, check};

/// One linear system at l_e = l_s ⊕ τ°: appendix B as it stands.
pub(crate) fn linearize_once(graph: &PoseGraph) -> Result<Solution, SolveError> {
    let mut descent = Descent::begin(graph, LinearizationPoint::Measurement)?;
    let step = descent.step(0.0)?;
    if !step.chi2.is_finite() {
        return Err(SolveError::Overflow);
    }
    Ok(descent.end_after(step, StopReason::LinearizedOnce))
}

/// Full steps until they promise nothing any more.
pub(crate) fn gauss_newton(graph: &PoseGraph, options: &Options) -> Result<Solution, SolveError> {
    let mut descent = Descent::begin(graph, LinearizationPoint::Estimate)?;
    while descent.iterations < options.max_iterations {
        if (options.interrupted)() {
            return descent.end_here(StopReason::Interrupted);
        }
        let step = descent.step(0.0)?;
        if descent.is_negligible(&step, options) {
            return Ok(descent.end_converged(step));
        }
        if !step.chi2.is_finite() {
            return descent.end_here(StopReason::Diverged);
        }
        descent.take(step);
    }
    descent.end_here(StopReason::MaxIterations)
}

/// The damping after the first refused step: little, for informations differ by many orders of magnitude,
/// and damping that the stiffest unknowns do not notice holds the softest ones still.
const FIRST_DAMPING: f64 = 1e-8;
/// By how much damping rises when a step is refused, and falls when one is taken.
const DAMPING_FACTOR: f64 = 10.0;
/// Damping beyond which a step is too short to matter.
const LAST_DAMPING: f64 = 1e10;

/// Full steps as long as χ² falls, and damped ones where it would not. Only a full step can tell that
/// nothing is left to gain.
pub(crate) fn levenberg_marquardt(graph: &PoseGraph, options: &Options) -> Result<Solution, SolveError> {
    damped(Descent::begin(graph, LinearizationPoint::Estimate)?, options)
}

fn damped(mut descent: Descent<'_>, options: &Options) -> Result<Solution, SolveError> {
    let mut damping = 0.0;
    while descent.iterations < options.max_iterations {
        if (options.interrupted)() {
            return descent.end_here(StopReason::Interrupted);
        }
        match descent.step(damping) {
            Ok(step) if damping == 0.0 && descent.is_negligible(&step, options) => {
                return Ok(descent.end_converged(step));
            }
            Ok(step) if step.chi2 <= descent.chi2 => {
                descent.take(step);
                damping = if damping <= FIRST_DAMPING { 0.0 } else { damping / DAMPING_FACTOR };
            }
            _ if damping >= LAST_DAMPING => return descent.end_here(StopReason::Stalled),
            _ => damping = FIRST_DAMPING.max(damping * DAMPING_FACTOR),
        }
    }
    descent.end_here(StopReason::MaxIterations)
}

/// How many full steps may be taken before they have converged.
const FULL_STEPS: usize = 30;

/// Full steps, whether or not χ² falls; unless they converge to the lowest χ² met, damped steps from there.
pub(crate) fn safeguarded(graph: &PoseGraph, options: &Options) -> Result<Solution, SolveError> {
    let mut descent = Descent::begin(graph, LinearizationPoint::Estimate)?;
    let (mut best, mut lowest) = (descent.poses.clone(), descent.chi2);
    while descent.iterations < options.max_iterations.min(FULL_STEPS) && !(options.interrupted)() {
        let Ok(step) = descent.step(0.0) else { break };
        let converged = descent.is_negligible(&step, options);
        if converged && descent.chi2 <= lowest + options.tolerance * (1.0 + lowest) {
            return Ok(descent.end_converged(step));
        }
        if converged || !step.chi2.is_finite() {
            break;
        }
        descent.take(step);
        if descent.chi2 < lowest {
            (best, lowest) = (descent.poses.clone(), descent.chi2);
        }
    }
    descent.go_to(best, lowest);
    damped(descent, options)
}

/// The poses reached so far, and the equations linearized there.
struct Descent<'a> {
    graph: &'a PoseGraph,
    equations: NormalEquations,
    poses: Vec<Pose>,
    chi2: f64,
    initial_chi2: f64,
    /// How many linear systems were solved.
    iterations: usize,
}

/// What one linear system yields: where the free poses would go, and what that promises.
struct Step {
    poses: Vec<Pose>,
    chi2: f64,
    /// By how much the linear model says χ² falls; exact for an undamped step.
    promised_fall: f64,
    factor: Factor<3>,
}

impl<'a> Descent<'a> {
    fn begin(graph: &'a PoseGraph, point: LinearizationPoint) -> Result<Self, SolveError> {
        check(graph)?;
        let mut equations = NormalEquations::new(graph);
        equations.linearize(graph, graph.poses(), point);
        let chi2 = equations.chi2;
        if !chi2.is_finite() {
            return Err(SolveError::Overflow);
        }
        Ok(Descent {
            graph,
            equations,
            poses: graph.poses().to_vec(),
            chi2,
            initial_chi2: chi2,
            iterations: 0,
        })
    }

    /// Solves the linear system with a damped matrix.
    fn step(&mut self, damping: f64) -> Result<Step, SolveError> {
        self.iterations += 1;
        let step = self.solve_linear_system(damping);
        let chi2 = step.as_ref().map(|step| step.chi2);
        tracing::debug!(iteration = self.iterations, from = self.chi2, to = ?chi2, damping, "step");
        step
    }

    fn solve_linear_system(&self, damping: f64) -> Result<Step, SolveError> {
        let factor = self.equations.matrix.factorize(damping).map_err(|_| SolveError::Singular)?;
        let right_hand_side = &self.equations.right_hand_side;
        let increments = factor.solve(right_hand_side); // (B.15)
        let promised_fall = increments.iter().zip(right_hand_side).map(|(a, b)| a * b).sum();
        let poses = self.equations.moved(&self.poses, &increments);
        let chi2 = self.graph.chi2_at(&poses);
        Ok(Step { poses, chi2, promised_fall, factor })
    }

    fn is_negligible(&self, step: &Step, options: &Options) -> bool {
        step.promised_fall <= options.tolerance * (1.0 + self.chi2)
    }

    fn take(&mut self, step: Step) {
        self.go_to(step.poses, step.chi2);
    }

    /// Moves to poses with a known χ², and linearizes there.
    fn go_to(&mut self, poses: Vec<Pose>, chi2: f64) {
        (self.poses, self.chi2) = (poses, chi2);
        self.equations.linearize(self.graph, &self.poses, LinearizationPoint::Estimate);
    }

    /// Ends with an undamped step.
    fn end_after(self, step: Step, stop: StopReason) -> Solution {
        Solution {
            linearized_chi2: self.chi2 - step.promised_fall,
            poses: step.poses,
            initial_chi2: self.initial_chi2,
            chi2: step.chi2,
            log_determinant: step.factor.log_determinant(),
            iterations: self.iterations,
            stop,
        }
    }

    /// Ends with a negligible undamped step, unless rounding makes it a step up.
    fn end_converged(mut self, step: Step) -> Solution {
        let step = if step.chi2 <= self.chi2 {
            step
        } else {
            Step { poses: std::mem::take(&mut self.poses), chi2: self.chi2, ..step }
        };
        self.end_after(step, StopReason::Converged)
    }

    /// Ends at the poses reached, which takes one more factorization to know ln |A| and the linear minimum.
    fn end_here(mut self, stop: StopReason) -> Result<Solution, SolveError> {
        let step = self.solve_linear_system(0.0)?;
        let step = Step { poses: std::mem::take(&mut self.poses), chi2: self.chi2, ..step };
        Ok(self.end_after(step, stop))
    }
}
