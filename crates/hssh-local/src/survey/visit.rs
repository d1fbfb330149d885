//! Visits: places as the robot met them, and the ways between them.

use hssh_metrics::{Covariance, Pose, PoseGraph, UncertainPose, UncertaintyError};
use hssh_topology::{Olp, PlaceId, Position};
use rustc_hash::FxHashMap;

use super::error::{SurveyError, SurveyWarning};
use super::evidence::Evidence;
use super::options::SurveyOptions;
use crate::closing::{ClosedTrack, Closure};
use crate::grid::OccupancyGrid;
use crate::matching::Track;
use crate::place::LocalStar;

/// One visit to a place.
#[derive(Clone, PartialEq, Debug)]
pub struct Visit {
    /// The first and the last scan from which the place was sighted.
    pub scans: (usize, usize),
    /// The scan taken nearest to the center.
    pub reference: usize,
    /// Which spot it was by the closed loops, counted from 0: visits to one spot show one star.
    pub spot: usize,
    /// The place's frame in the frame of the track: its origin is where the axes of the gateways meet, and
    /// it is turned as the track is.
    pub frame: Pose,
    /// The star, with bearings in the place's frame; its gateways lie in the frame of the track.
    pub star: LocalStar,
    /// By which end the robot came in; `None` if it started here.
    pub entry: Option<Olp>,
    /// By which end the robot went out; `None` if it stayed.
    pub exit: Option<Olp>,
    /// The local perceptual map of the place, in the frame of the track.
    pub grid: OccupancyGrid,
}

/// What a log tells about places.
#[derive(Clone, PartialEq, Debug)]
pub struct Survey {
    /// The visits in order; at least one.
    pub visits: Vec<Visit>,
    /// From each visit's frame to that of the next.
    pub travels: Vec<UncertainPose>,
    /// The robot's way, its loops closed; the steps are those measured from scan to scan.
    pub track: Track,
    /// Where the robot was before, as the laser shows.
    pub closures: Vec<Closure>,
    /// The tracked steps of all scans and what closes their loops, with the poses of the track.
    pub graph: PoseGraph,
    /// What speaks for these closures, and against them.
    pub evidence: Evidence,
    /// What was decided with little reason.
    pub warnings: Vec<SurveyWarning>,
}

impl Survey {
    pub(super) fn new(
        visits: Vec<Visit>,
        track: Track,
        ClosedTrack { graph, closures, .. }: ClosedTrack,
        evidence: Evidence,
        options: &SurveyOptions,
        warnings: Vec<SurveyWarning>,
    ) -> Result<Self, SurveyError> {
        let travels = visits
            .windows(2)
            .enumerate()
            .map(|(index, pair)| {
                travel(&pair[0], &pair[1], &track, options)
                    .map_err(|problem| SurveyError::Motion { visit: index, problem })
            })
            .collect::<Result<_, _>>()?;
        Ok(Survey { visits, travels, track, closures, graph, evidence, warnings })
    }
}

impl Survey {
    /// Whether a map has the visits at the same places as the closed loops have them. `positions` says for each visit
    /// which place it was to.
    #[must_use]
    pub fn agrees_with(&self, positions: &[Position]) -> bool {
        let mut place_of: FxHashMap<usize, PlaceId> = FxHashMap::default();
        let mut spot_of: FxHashMap<PlaceId, usize> = FxHashMap::default();
        self.visits.len() == positions.len()
            && self.visits.iter().zip(positions).all(|(visit, position)| {
                *place_of.entry(visit.spot).or_insert(position.place) == position.place
                    && *spot_of.entry(position.place).or_insert(visit.spot) == visit.spot
            })
    }
}

/// The relative pose of two frames: where the closed track has them, as well known as the robot's motion between
/// them, from the center of the one to the robot in it, on with the robot, and to the center of the other.
fn travel(
    from: &Visit,
    to: &Visit,
    track: &Track,
    options: &SurveyOptions,
) -> Result<UncertainPose, UncertaintyError> {
    let (center, heading) = options.place_fix;
    let covariance = Covariance::from_standard_deviations(center, center, heading)?;
    let robot_in = |visit: &Visit| {
        let mean = visit.frame.between(track.scans[visit.reference].pose);
        UncertainPose { mean, covariance }
    };
    let departure = robot_in(from);
    let arrival = robot_in(to).inverse()?;
    let measured = match track.motion(from.reference, to.reference)? {
        Some(motion) => departure.compose(&motion)?.compose(&arrival)?,
        None => departure.compose(&arrival)?,
    };
    Ok(UncertainPose { mean: from.frame.between(to.frame), covariance: measured.covariance })
}
