//! The measured travels of an exploration, ready for hypotheses to be laid out by.

use hssh_causal::Odometry;
use hssh_metrics::{Covariance, Edge, Pose, PoseGraph, PoseId, UncertaintyError};
use hssh_topology::Position;
use nalgebra::{Matrix3, vector};

use crate::experience::Experience;
use crate::frames::{Frames, Trail};
use crate::visit::MeasurementError;

/// One measured travel: the arrival frame in the departure frame, as the robot saw the two.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MeasuredTravel {
    /// τ°.
    pub(crate) pose: Pose,
    /// C°.
    pub(crate) covariance: Covariance,
}

impl MeasuredTravel {
    /// # Errors
    /// If the covariance cannot be inverted.
    pub(crate) fn of(odometry: &Odometry) -> Result<Self, UncertaintyError> {
        let covariance = Matrix3::from_fn(|row, column| odometry.covariance[row][column]);
        let pose = Pose::new(odometry.x, odometry.y, odometry.theta);
        Ok(MeasuredTravel { pose, covariance: Covariance::new(covariance)? })
    }

    /// The travel between two places, given how the frames of its two visits are turned against theirs.
    pub(crate) fn between(&self, from: (PoseId, Pose), to: (PoseId, Pose)) -> PlacedTravel {
        let ((from, departure), (to, arrival)) = (from, to);
        let pose = departure.compose(self.pose).compose(arrival.inverse());
        PlacedTravel { from, to, pose, covariance: self.covariance.rotated(departure.theta) }
    }

    /// −½ ln |2πC|: the most that the log-density of the measurement can be.
    pub(crate) fn peak(&self) -> f64 {
        -0.5 * (self.covariance.log_determinant() + 3.0 * std::f64::consts::TAU.ln())
    }
}

/// All travels of an experience with the frames of its visits. It grows with the experience.
#[derive(Clone, Debug, Default)]
pub(crate) struct Measured {
    pub(crate) travels: Vec<MeasuredTravel>,
    pub(crate) frames: Frames,
}

/// A travel in the frames of the places that a hypothesis takes it to connect.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlacedTravel {
    pub(crate) from: PoseId,
    pub(crate) to: PoseId,
    pub(crate) pose: Pose,
    /// Along the axes of `from`.
    pub(crate) covariance: Covariance,
}

impl PlacedTravel {
    pub(crate) fn edge(&self) -> Edge {
        Edge::observed(self.from, self.to, self.pose, &self.covariance)
    }

    /// χ² if both ends are the same pose.
    pub(crate) fn chi2_as_loop(&self) -> f64 {
        let off = vector![self.pose.x, self.pose.y, self.pose.theta];
        off.dot(&(self.covariance.information().matrix() * off))
    }
}

impl Measured {
    /// Takes notice of the travels that are new.
    ///
    /// # Errors
    /// If a travel has no odometry, or a covariance that cannot be inverted.
    pub(crate) fn observe(&mut self, experience: &Experience) -> Result<(), MeasurementError> {
        for index in self.travels.len()..experience.observations.len() {
            let travel = index + 1;
            let odometry = experience.odometry(index).ok_or(MeasurementError::Missing { travel })?;
            let measured = MeasuredTravel::of(odometry);
            self.travels.push(measured.map_err(|problem| MeasurementError::Covariance { travel, problem })?);
        }
        self.frames.observe(experience);
        Ok(())
    }

    /// The pose graph of a hypothesis about the first travels: one pose per place, one edge per travel
    /// (section 4.2), and the first pose anchored. Travels from a place to itself are left out.
    pub(crate) fn graph(&self, trail: Trail<'_>, poses: impl Iterator<Item = Pose>) -> PoseGraph {
        let mut graph = PoseGraph::new();
        for pose in poses {
            graph.add_pose(pose);
        }
        let travels = (0..trail.visits() - 1).map(|travel| self.placed(trail, travel));
        for placed in travels.filter(|placed| placed.from != placed.to) {
            graph.add_edge(placed.edge()).expect("a hypothesis has its places, and odometry is finite");
        }
        graph.anchor(PoseId(0)).expect("every hypothesis has its first place");
        graph
    }

    /// A travel that a hypothesis explains.
    pub(crate) fn placed(&self, trail: Trail<'_>, travel: usize) -> PlacedTravel {
        self.travels[travel].between(trail.end(travel), trail.end(travel + 1))
    }

    /// The next travel of a hypothesis, if it leads to a place of the map.
    pub(crate) fn placed_to(&self, trail: Trail<'_>, travel: usize, to: Position) -> PlacedTravel {
        self.travels[travel].between(trail.end(travel), trail.end_at(travel + 1, to))
    }
}
