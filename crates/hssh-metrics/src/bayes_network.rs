//! The Bayes network of a topological hypothesis (section 4.2, Figure 4.2): which measurement depends on which poses.

use std::collections::BTreeSet;
use std::f64::consts::TAU;
use std::fmt::Write;

use nalgebra::vector;

use crate::angle::wrap_angle;
use crate::graph::{Edge, GraphError, PoseGraph, PoseId};
use crate::pose::Pose;
use crate::uncertainty::Information;

/// What the robot measured on one travel: τ°, from π_s to π_e.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Measurement {
    /// The start pose π_s(i).
    pub start: PoseId,
    /// The end pose π_e(i).
    pub end: PoseId,
    /// τ°: the end pose as seen from the start pose.
    pub relative_pose: Pose,
    /// The information C⁻¹ of its three numbers, x and y along the axes of the start pose.
    pub information: Information,
}

/// A variable of the network.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Variable {
    /// π: the pose of a place.
    Pose(PoseId),
    /// τ: the measurement of the travel with that index, from 0.
    Measurement(usize),
}

/// BN(m, C): poses without parents, and measurements, each with an arrow from the two poses it was measured between.
///
/// Known are the measurements and the anchored poses, as a rule the first one; all other poses are hidden.
#[derive(Clone, PartialEq, Debug)]
pub struct BayesNetwork {
    known: Vec<bool>,
    measurements: Vec<Measurement>,
}

impl BayesNetwork {
    /// The network of a hypothesis with so many poses, the first of which is known: the origin.
    ///
    /// # Errors
    /// If a measurement names a pose that is not there, or has the same one twice.
    pub fn new(poses: usize, measurements: Vec<Measurement>) -> Result<Self, GraphError> {
        for &Measurement { start, end, .. } in &measurements {
            if let Some(pose) = [start, end].into_iter().find(|pose| pose.index() >= poses) {
                return Err(GraphError::NoSuchPose { pose, poses });
            }
            if start == end {
                return Err(GraphError::Loop(start));
            }
        }
        let known = (0..poses).map(|pose| pose == 0).collect();
        Ok(BayesNetwork { known, measurements })
    }

    /// All variables: the poses, then the measurements.
    pub fn variables(&self) -> impl Iterator<Item = Variable> + use<> {
        let poses = (0..self.known.len() as u32).map(|pose| Variable::Pose(PoseId(pose)));
        poses.chain((0..self.measurements.len()).map(Variable::Measurement))
    }

    /// The measurements, in the order of the travels.
    #[must_use]
    pub fn measurements(&self) -> &[Measurement] {
        &self.measurements
    }

    /// Whether the value of a variable is known: of every measurement, and of anchored poses.
    ///
    /// # Panics
    /// If the network has no such pose.
    #[must_use]
    pub fn is_known(&self, variable: Variable) -> bool {
        match variable {
            Variable::Pose(pose) => self.known[pose.index()],
            Variable::Measurement(_) => true,
        }
    }

    /// The arrows: from π_s(i) and from π_e(i) to τ_i, for every i.
    pub fn arrows(&self) -> impl Iterator<Item = (PoseId, usize)> + '_ {
        let parents = self.measurements.iter().map(|measurement| [measurement.start, measurement.end]);
        parents.enumerate().flat_map(|(index, parents)| parents.map(|parent| (parent, index)))
    }

    /// Whether two variables are independent once others are given: whether these d-separate them.
    ///
    /// All arrows lead from poses to measurements. A trail is therefore blocked where it passes a pose that is given
    /// or a measurement that is not.
    #[must_use]
    pub fn are_independent(&self, one: Variable, other: Variable, given: &BTreeSet<Variable>) -> bool {
        if given.contains(&one) || given.contains(&other) {
            return true; // nothing is left to learn about a variable that is given
        }
        let passes = |variable: Variable| match variable {
            Variable::Pose(_) => !given.contains(&variable),
            Variable::Measurement(_) => given.contains(&variable),
        };
        let (mut reached, mut fringe) = (BTreeSet::from([one]), vec![one]);
        while let Some(here) = fringe.pop() {
            for (pose, index) in self.arrows() {
                let (pose, measurement) = (Variable::Pose(pose), Variable::Measurement(index));
                let next = match here {
                    _ if here == pose => measurement,
                    _ if here == measurement => pose,
                    _ => continue,
                };
                if reached.insert(next) && passes(next) {
                    fringe.push(next);
                }
            }
        }
        !reached.contains(&other)
    }

    /// ln p(τ = τ° | π) at the given poses: the sum of ln (4.3) over the factors of (4.8).
    ///
    /// With a uniform density of the poses, the joint density differs from it by a constant.
    ///
    /// # Panics
    /// If there are fewer poses than the network has.
    #[must_use]
    pub fn log_density(&self, poses: &[Pose]) -> f64 {
        let factor = |measurement: &Measurement| {
            let predicted = poses[measurement.start.index()].between(poses[measurement.end.index()]); // (4.1)
            let measured = measurement.relative_pose;
            let difference = vector![
                predicted.x - measured.x,
                predicted.y - measured.y,
                wrap_angle(predicted.theta - measured.theta)
            ];
            let information = &measurement.information;
            let distance = difference.dot(&(information.matrix() * difference));
            0.5 * (information.log_determinant() - information.rank() as f64 * TAU.ln() - distance) // (4.3)
        };
        self.measurements.iter().map(factor).sum() // (4.8)
    }

    /// The factors of (4.8), one per line; poses and measurements are counted from 1, as in the thesis.
    ///
    /// ```
    /// # use hssh_metrics::{BayesNetwork, Covariance, Measurement, Pose, PoseId};
    /// let information = Covariance::from_standard_deviations(0.1, 0.1, 0.02)?.information();
    /// let travel = |start, end| Measurement {
    ///     start: PoseId(start), end: PoseId(end), relative_pose: Pose::new(8.0, 0.0, 0.0), information,
    /// };
    /// let there_and_back = BayesNetwork::new(2, vec![travel(0, 1), travel(1, 0)])?;
    /// assert_eq!(there_and_back.factorization(), "p(τ | π) =\n  p(τ1 | π1, π2)\n  p(τ2 | π2, π1)\n");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn factorization(&self) -> String {
        let mut text = "p(τ | π) =\n".to_owned();
        for (index, Measurement { start, end, .. }) in self.measurements.iter().enumerate() {
            let [start, end] = [start, end].map(|pose| pose.index() + 1);
            let _ = writeln!(text, "  p(τ{} | π{start}, π{end})", index + 1);
        }
        text
    }

    /// The network as Graphviz DOT in the manner of Figure 4.2: circles, shaded where the value is known.
    #[must_use]
    pub fn to_dot(&self) -> String {
        let mut text = "digraph BN {\n  node [shape=circle, fixedsize=true, width=0.5];\n".to_owned();
        for variable in self.variables() {
            let (name, label) = match variable {
                Variable::Pose(pose) => (format!("pi{}", pose.index() + 1), format!("π{}", pose.index() + 1)),
                Variable::Measurement(index) => (format!("tau{}", index + 1), format!("τ{}", index + 1)),
            };
            let shade = if self.is_known(variable) { ", style=filled, fillcolor=\"#d0d0d0\"" } else { "" };
            let _ = writeln!(text, "  {name} [label=\"{label}\"{shade}];");
        }
        for (pose, index) in self.arrows() {
            let _ = writeln!(text, "  pi{} -> tau{};", pose.index() + 1, index + 1);
        }
        text + "}\n"
    }
}

impl From<&PoseGraph> for BayesNetwork {
    /// The network of a pose graph: its anchored poses are known, its edges are the measurements.
    fn from(graph: &PoseGraph) -> Self {
        let measurement = |edge: &Edge| Measurement {
            start: edge.from,
            end: edge.to,
            relative_pose: edge.relative_pose,
            information: edge.start_frame_information(),
        };
        BayesNetwork {
            known: graph.pose_ids().map(|pose| graph.is_anchored(pose)).collect(),
            measurements: graph.edges().iter().map(measurement).collect(),
        }
    }
}
